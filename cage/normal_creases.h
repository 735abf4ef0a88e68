// Hard edges as creases: those of a file's normals, and those whose faces meet at an angle.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <vector>

namespace supple::cage {

struct Topology;

/// Which edges with split normals become infinitely sharp when a character is made.
enum class NormalCreases {
    never,
    wherePartly, ///< those of parts of plain triangles that are hard in places: creasePartlySplitNormals()
    all
};

/// From this share on, hard edges are everywhere: of the edges where the surface bends, since an edge within a flat
/// face is never hard. Measured: boxes have 92 to 100 %, box-like robots and flat-shaded characters 73 to 100 %, a
/// figure of blocks 70 %, a sword and a shield with spikes 57 and 54 %; armour and other props, which have smooth faces
/// between their hard edges, 0 to 45 %; cages modelled for subdivision 0 to 3 %.
inline constexpr double kHardShare = 0.5;

/// The edges of a group of parts.
struct EdgeCounts {
    uint64_t bent = 0; ///< between faces that do not lie in one plane
    uint64_t hard = 0; ///< of these, edges whose normals are split

    [[nodiscard]] bool isHardEverywhere() const {
        return hard > 0 && static_cast<double>(hard) >= kHardShare * static_cast<double>(bent);
    }
};
/// Counts for each group of sewn parts, at the place of its smallest part. `groups`: sewnTo() (cage/parts.h).
[[nodiscard]] std::vector<EdgeCounts> countHardEdges(const Cage& cage, const Topology& topology,
                                                     const std::vector<uint32_t>& groups);

/// Makes the edges with split normals infinitely sharp in parts of plain triangles of which some edges are so, but not
/// those everywhere: smooth schemes would melt what the normals keep. Parts that are sewn together count as one. A
/// warning says how many edges and parts that are.
void creasePartlySplitNormals(Character& character);

/// Makes every edge whose normals are split (hasSplitNormals() of cage/corner_normals.h) infinitely sharp, so that
/// smooth schemes keep it. Returns how many edges that are. A cage that is no manifold stays as it is. O(corners log
/// corners).
uint32_t creaseSplitNormals(Cage& cage);

/// Makes every edge infinitely sharp at which the mean planes of its two faces meet at more than `degrees`. Returns how
/// many edges that are. A cage that is no manifold stays as it is. O(corners log corners).
uint32_t creaseAngles(Cage& cage, double degrees);

} // namespace supple::cage
