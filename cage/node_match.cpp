#include "cage/node_match.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace supple::cage {
namespace {

constexpr float kSameLength = 0.01f;   ///< relative
constexpr float kShortestBone = 1e-3f; ///< of the longest; shorter ones are offsets rather than bones

/// Numbers for the lists of names from a root down to a node: equal lists have equal numbers.
class Paths {
public:
    [[nodiscard]] std::vector<uint32_t> of(const Skeleton& skeleton) {
        std::vector<uint32_t> paths(skeleton.nodes.size());
        for (const uint32_t n : skeleton.parentsFirst) {
            const Node& node = skeleton.nodes[n];
            const uint32_t above = node.parent == kNone ? kNone : paths[node.parent];
            paths[n] = known_.try_emplace({above, node.name}, static_cast<uint32_t>(known_.size())).first->second;
        }
        return paths;
    }

private:
    std::map<std::pair<uint32_t, std::string_view>, uint32_t> known_;
};

/// The nodes of one name in `from` and in `to`, parents first.
struct Namesakes {
    std::vector<uint32_t> from, to;
};

/// Matches nodes whose path no other node of their skeleton has.
void matchByPath(const Namesakes& nodes, const std::vector<uint32_t>& fromPaths, const std::vector<uint32_t>& toPaths,
                 std::vector<uint32_t>& partners) {
    std::map<uint32_t, Namesakes> byPath;
    for (const uint32_t n : nodes.from) {
        byPath[fromPaths[n]].from.push_back(n);
    }
    for (const uint32_t n : nodes.to) {
        byPath[toPaths[n]].to.push_back(n);
    }
    for (const auto& [path, same] : byPath) {
        if (same.from.size() == 1 && same.to.size() == 1) {
            partners[same.from[0]] = same.to[0];
        }
    }
}

/// Shortest and longest that the clips make the bones, by node; none where they do not move it.
std::vector<std::optional<std::pair<float, float>>> animatedLengths(size_t nodes, const std::vector<Clip>& clips) {
    std::vector<std::optional<std::pair<float, float>>> lengths(nodes);
    for (const Clip& clip : clips) {
        for (const Channel& channel : clip.channels) {
            if (channel.path != ChannelPath::translation) {
                continue;
            }
            const bool cubic = channel.interpolation == Interpolation::cubicSpline;
            for (size_t k = cubic ? 1 : 0; 3 * k < channel.values.size(); k += cubic ? 3 : 1) {
                const float* at = &channel.values[3 * k];
                const float length = glm::length(glm::vec3(at[0], at[1], at[2]));
                std::optional<std::pair<float, float>>& range = lengths[channel.node];
                range = range ? std::pair(std::min(range->first, length), std::max(range->second, length))
                              : std::pair(length, length);
            }
        }
    }
    return lengths;
}

float restLength(const Node& node) {
    return glm::length(node.hasMatrix ? glm::vec3(node.matrix[3]) : node.translation);
}

float differenceOf(const BoneDifference& bone) {
    return std::abs(bone.from - bone.to) / std::max({bone.from, bone.to, std::numeric_limits<float>::min()});
}

} // namespace

NodeMatch matchNodes(const Skeleton& from, const Skeleton& to) {
    Paths paths;
    const std::vector<uint32_t> fromPaths = paths.of(from), toPaths = paths.of(to);
    std::map<std::string_view, Namesakes> byName;
    for (const uint32_t n : from.parentsFirst) {
        byName[from.nodes[n].name].from.push_back(n);
    }
    for (const uint32_t n : to.parentsFirst) {
        byName[to.nodes[n].name].to.push_back(n);
    }
    NodeMatch match;
    match.partners.assign(from.nodes.size(), kNone);
    for (const auto& [name, nodes] : byName) {
        if (name.empty() || nodes.from.empty() || nodes.to.empty()) {
            continue;
        }
        if (nodes.from.size() == 1 && nodes.to.size() == 1) {
            match.partners[nodes.from[0]] = nodes.to[0];
            continue;
        }
        matchByPath(nodes, fromPaths, toPaths, match.partners);
        const auto isAlone = [&](uint32_t n) { return match.partners[n] == kNone; };
        if (std::none_of(nodes.from.begin(), nodes.from.end(), isAlone)) {
            continue;
        }
        match.repeated.emplace_back(name);
        const bool taken = std::any_of(nodes.from.begin(), nodes.from.end(),
                                       [&, first = nodes.to[0]](uint32_t n) { return match.partners[n] == first; });
        if (isAlone(nodes.from[0]) && !taken) {
            match.partners[nodes.from[0]] = nodes.to[0];
        }
    }
    return match;
}

BoneDifference compareBones(const Skeleton& from, const std::vector<Clip>& clips, const Skeleton& to,
                            const NodeMatch& match) {
    const auto animated = animatedLengths(from.nodes.size(), clips);
    std::vector<BoneDifference> bones;
    float longest = 0.0f;
    for (uint32_t n = 0; n < from.nodes.size(); ++n) {
        const uint32_t partner = match.partners[n];
        const uint32_t parent = from.nodes[n].parent;
        if (partner == kNone || parent == kNone || match.partners[parent] == kNone ||
            match.partners[parent] != to.nodes[partner].parent) {
            continue;
        }
        BoneDifference bone{n, restLength(from.nodes[n]), restLength(to.nodes[partner])};
        if (animated[n]) {
            const auto [least, most] = *animated[n];
            const bool isStretched = most - least > kSameLength * most;
            if (isStretched || differenceOf(bone) <= kSameLength) {
                continue;
            }
            bone.from = most;
        }
        longest = std::max({longest, bone.from, bone.to});
        bones.push_back(bone);
    }
    BoneDifference worst;
    float largest = kSameLength;
    for (const BoneDifference& bone : bones) {
        const float difference = differenceOf(bone);
        if (std::max(bone.from, bone.to) > kShortestBone * longest && difference > largest) {
            largest = difference;
            worst = bone;
        }
    }
    return worst;
}

} // namespace supple::cage
