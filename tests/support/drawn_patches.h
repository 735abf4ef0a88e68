// What a group's indirect commands draw: every surface vertex of every triangle, found as a vertex shader finds it.
#pragma once

#include "tests/support/crowd.h"

#include <compare>
#include <cstdint>
#include <map>
#include <vector>

namespace supple::test {

/// Whose triangles they are. Of meshes: a draw range instead of a patch.
struct DrawnKey {
    uint32_t slot = 0;
    uint32_t rate = 0; ///< of a view's groups with rates: which one
    uint32_t patch = 0;

    [[nodiscard]] auto operator<=>(const DrawnKey&) const = default;
};

/// Of triangles in the order of their indices, for every corner: the bits of its surface vertex, of its previous
/// position and, with levels, its capacity.
using DrawnCorners = std::vector<uint32_t>;
using DrawnPatches = std::map<DrawnKey, DrawnCorners>;

/// Reads what the last frame left. Fails where a patch is drawn twice, and where a draw reads outside its lists.
[[nodiscard]] DrawnPatches drawnPatches(const Crowd& crowd, uint32_t surface = 0);

/// The part of every patch of an instance, of meshes of every draw range.
[[nodiscard]] std::vector<uint32_t> partsOfKeys(const Crowd& crowd, SuppleAsset asset, uint32_t surface = 0);

} // namespace supple::test
