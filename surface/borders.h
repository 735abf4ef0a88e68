// Patch records: the border curves that they imply, and what names a border that is no cubic.
#pragma once

#include "base/result.h"
#include "surface/scheme.h"

#include <array>
#include <vector>

namespace supple::surface {

/// The pool indices of a border cubic: one end, its tangent, the tangent of the other end, the other end. Two patches
/// at an edge have the same four, in opposite order. Two patches at a crease do not.
using BorderCurve = std::array<uint32_t, 4>;

/// The word of a patch record that names a corner's spoke and the next one around the vertex (SUPPLE_SPOKE).
[[nodiscard]] uint32_t spokeWord(uint32_t spoke, uint32_t next);
/// Finds out whether the words of patch records have enough bits for all spokes of a cage.
class SpokeLimits {
public:
    void add(uint32_t vertex, uint32_t spokes);
    /// Refuses with the number of a vertex that has too many.
    [[nodiscard]] Status check() const;

private:
    size_t count_ = 0;
    uint32_t vertex_ = 0, most_ = 0; ///< the vertex with the most spokes
};

/// Pool indices of the 16 coefficients of a bicubic patch, row by row in v.
[[nodiscard]] std::array<uint32_t, 16> netIndices(const Tables& tables, const uint32_t* record, PatchClass patchClass);

/// Table elements of a patch record.
[[nodiscard]] uint32_t recordElements(const Tables& tables, PatchClass patchClass);

/// The name of point k in the net of an irregular quad or triangle: its pool index. If the point is there more than
/// once (Tables::copies), it is the index of the first.
[[nodiscard]] uint32_t quadNetPoint(const Tables& tables, const uint32_t* record, uint32_t k);
[[nodiscard]] uint32_t triangleNetPoint(const Tables& tables, const uint32_t* record, uint32_t k);
/// Pool index of the normal of a corner of an irregular quad or triangle, shared::kNoNormal if it has none.
[[nodiscard]] uint32_t quadNormal(const uint32_t* record, uint32_t corner);
[[nodiscard]] uint32_t triangleNormal(const uint32_t* record, uint32_t corner);

/// The border curves of a patch whose borders are cubics, by side of its grid. A polar patch has four; one of them is
/// the apex.
[[nodiscard]] std::vector<BorderCurve> borderCurves(const Tables& tables, const uint32_t* record,
                                                    PatchClass patchClass);

} // namespace supple::surface
