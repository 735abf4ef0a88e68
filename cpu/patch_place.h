// Where the patches of a scheme's tables lie in the faces of the mesh that they are made of.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "cpu/place.h"
#include "surface/schemes.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
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

/// By patch of a scheme's tables.
class PatchPlaces {
public:
    /// Finds the patches of all faces of a mesh whose first vertices are the cage's. `sourceFaces`: the cage's face by
    /// face of the mesh; none: its own. `turned`: turnedQuad or turnedTriangle.
    [[nodiscard]] Status find(const cage::Cage& mesh, std::span<const uint32_t> sourceFaces, uint32_t cageVertices,
                              std::span<const surface::PatchInfo> patches, Turned (*turned)(uint32_t firstCorner));
    void add(const PatchPlace& place) { places_.push_back(place); }
    [[nodiscard]] const PatchPlace& operator[](size_t patch) const { return places_[patch]; }
    /// The place of a sample of the patch's grid: see gridPlace.
    [[nodiscard]] Place ofSample(uint32_t patch, surface::Domain domain, uint32_t rate, uint32_t sample,
                                 double inside) const;

private:
    std::vector<PatchPlace> places_;
};

/// Faces that fragments draw: those of the isolated mesh, four of each face before, in the order of the device.
[[nodiscard]] std::vector<uint32_t> drawnFaces(const cage::Cage& isolated);

} // namespace supple::cpu
