// The records of patches, written and read, and their borders: pool indices, side by side. For the classes whose
// borders are cubics (p-rep, P_m).
#pragma once

#include "base/result.h"
#include "surface/scheme.h"

#include <array>
#include <vector>

namespace supple::surface {

/// End, its tangent, the other end's tangent, other end. Patches that have an edge in common have the same four, read
/// backwards; across a crease they do not.
using BorderCurve = std::array<uint32_t, 4>;

/// The spoke of a corner in a bicubic record: its own number, and that of the next one round the vertex.
[[nodiscard]] uint32_t spokeWord(uint32_t spoke, uint32_t next);
/// Whether words hold the spokes of all fans round vertices; refuses by the vertex.
class SpokeLimits {
public:
    void add(uint32_t vertex, uint32_t spokes);
    [[nodiscard]] Status check() const;

private:
    size_t count_ = 0;
    uint32_t vertex_ = 0, most_ = 0; ///< the fullest one
};

/// Pool indices of the 16 coefficients of a bicubic patch, row by row in v.
[[nodiscard]] std::array<uint32_t, 16> netIndices(const Tables& tables, const uint32_t* record, PatchClass patchClass);

/// Elements of a patch record.
[[nodiscard]] uint32_t recordElements(const Tables& tables, PatchClass patchClass);

/// Border curves by side of the grid: a polar patch has four, one of them the apex.
[[nodiscard]] std::vector<BorderCurve> borderCurves(const Tables& tables, const uint32_t* record,
                                                    PatchClass patchClass);

} // namespace supple::surface
