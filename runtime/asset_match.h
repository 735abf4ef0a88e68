// What of one version of an asset is what of another, by names.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <vector>

namespace supple::runtime {

/// Where names repeat, the n-th of one version is the n-th of the other.
struct AssetMatch {
    /// Both are the same asset: everything is where it was.
    bool same = true;
    // By number in the new version: the number in the old one, or kNone.
    std::vector<uint32_t> parts, joints, targets, creaseSets;
    // By number in the old version: the number in the new one, or kNone.
    std::vector<uint32_t> clips, nodes;

    /// Morph targets match if their parts do, too.
    [[nodiscard]] static AssetMatch of(const cage::Character& before, const cage::Character& now);
};

} // namespace supple::runtime
