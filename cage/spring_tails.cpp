#include "cage/spring_tails.h"

#include <algorithm>

namespace supple::cage {

namespace {

constexpr double kLeafTail = 0.07; // metres: what VRM 0.x gives a bone without children

} // namespace

std::vector<uint32_t> firstChildren(const Skeleton& skeleton) {
    std::vector<uint32_t> first(skeleton.nodes.size(), kNone);
    for (uint32_t node = 0; node < skeleton.nodes.size(); ++node) {
        if (const uint32_t parent = skeleton.nodes[node].parent; parent != kNone) {
            first[parent] = std::min(first[parent], node);
        }
    }
    return first;
}

std::optional<glm::dvec3> tailInTree(const Skeleton& skeleton, std::span<const uint32_t> firstChild,
                                     std::span<const glm::dmat4> places, uint32_t node) {
    if (firstChild[node] != kNone) {
        return glm::dvec3(places[firstChild[node]][3]);
    }
    const uint32_t parent = skeleton.nodes[node].parent;
    if (parent == kNone) {
        return std::nullopt;
    }
    const glm::dvec3 head(places[node][3]), way = head - glm::dvec3(places[parent][3]);
    const double length = glm::length(way);
    return length > kShortestTail ? std::optional(head + way * (kLeafTail / length)) : std::nullopt;
}

} // namespace supple::cage
