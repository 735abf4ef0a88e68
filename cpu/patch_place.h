// Where the patches of a scheme's tables lie in the faces of the mesh that they are made of.
#pragma once

#include "cage/character.h"
#include "cpu/place.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace supple::cpu {

/// An affine map from a place's own parameters to another two.
struct Turned {
    glm::dvec2 origin{0.0}, x{1.0, 0.0}, y{0.0, 1.0};

    /// place.x and y, and their slopes, become those of the other two.
    void apply(Place& place) const;
};
/// The parameters of a patch as those of a quad whose corner `firstCorner` is the patch's corner 0.
[[nodiscard]] Turned turnedQuad(uint32_t firstCorner);
/// The same of triangles, by the weights of corners 1 and 2.
[[nodiscard]] Turned turnedTriangle(uint32_t firstCorner);

/// Where a patch lies in the faces of the mesh that it is made of.
struct PatchPlace {
    uint32_t face = 0;
    Turned turned;
};

/// Faces that fragments draw: those of the isolated mesh, four of each face before, in the order of the device.
[[nodiscard]] std::vector<uint32_t> drawnFaces(const cage::Cage& isolated);

} // namespace supple::cpu
