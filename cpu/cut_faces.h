// Faces that a scheme cuts into parts: Loop and polygons into triangles, P_m into quads and pentagons.
#pragma once

#include "cage/character.h"
#include "cpu/place.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::cpu {

/// Finds places in the parts. The map is affine in each triangle of a part, and one on the whole face: a square, or of
/// more sides a regular polygon.
class CutFaces {
public:
    explicit CutFaces(const cage::Cage& cage) : parts_(cage.faceCount()) {}

    /// A part of a face, with its vertices in the order of the piece's corners. Three: the piece's parameters are the
    /// weights of corners 1 and 2. Four: (u, v). Five: those of a sector (PatchSet::evaluate()).
    void add(const cage::Cage& cage, uint32_t face, uint32_t piece, std::span<const uint32_t> vertices);

    [[nodiscard]] bool has(uint32_t face) const { return !parts_[face].empty(); }
    /// The face must have parts.
    [[nodiscard]] Place find(const FacePoint& point) const;

private:
    struct Part {
        uint32_t piece = 0;
        uint32_t sides = 0; ///< of the face
        uint32_t first = 0; ///< into corners_
        uint32_t cornerCount = 0;
    };

    std::vector<std::vector<Part>> parts_; ///< by face
    std::vector<uint32_t> corners_;        ///< numbers in the face
};

} // namespace supple::cpu
