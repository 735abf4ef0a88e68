// Which nodes of two skeletons are the same, by their names.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::cage {

struct NodeMatch {
    std::vector<uint32_t> partners;    ///< by node of `from`: the node of `to`, or kNone
    std::vector<std::string> repeated; ///< names that several nodes have and that nothing tells apart
};

/// Nodes of equal names. A name that several nodes of a skeleton have is told apart by the names of all nodes above;
/// what these leave over is matched once, the first node of each skeleton in the order parentsFirst. Nodes without a
/// name have no partner.
[[nodiscard]] NodeMatch matchNodes(const Skeleton& from, const Skeleton& to);

/// Where two matched skeletons differ most in the length of a bone.
struct BoneDifference {
    uint32_t node = kNone; ///< of `from`; kNone: none by more than 1 %
    float from = 0.0f, to = 0.0f;
};

/// Bones are nodes whose parents are partners as well; the length is the distance to the parent. Bones that the clips
/// of `from` stretch are left out. One that they hold at another length than it has at rest differs if both lengths do.
[[nodiscard]] BoneDifference compareBones(const Skeleton& from, const std::vector<Clip>& clips, const Skeleton& to,
                                          const NodeMatch& match);

} // namespace supple::cage
