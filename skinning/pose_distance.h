// How far apart two poses of a character are, as whoever looks at it sees it: what packed clips are measured by.
#pragma once

#include "cage/character.h"
#include "skinning/pose.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::skinning {

/// Distances of vertices that are skinned linearly, and of the *shell*: three points around each joint, 0.015 of the
/// extent away. With the shell, sockets and joints that move no vertex count too.
class PoseDistance {
public:
    /// The character must outlive this.
    explicit PoseDistance(const cage::Character& character);

    [[nodiscard]] const cage::Character& character() const { return character_; }
    /// The diagonal of the box of the rest pose.
    [[nodiscard]] double extent() const { return extent_; }

    /// Distance moved per radian of a node's rotation, or per unit of its translation or scale, in the rest pose.
    [[nodiscard]] double reach(uint32_t node, cage::ChannelPath path) const {
        switch (path) {
        case cage::ChannelPath::translation:
            return parentScale_[node];
        case cage::ChannelPath::rotation:
            return reach_[node] + drivenReach_[node];
        default:
            return reach_[node];
        }
    }
    /// From here on, reach() counts the morph targets that drivers set by a node.
    void takeDrivers();
    /// By morph target: distance moved per unit of its weight, in the rest pose.
    [[nodiscard]] std::span<const double> targetReaches() const { return targetReach_; }

    /// The vertices farthest from the joints that they follow, and all vertices.
    [[nodiscard]] std::span<const uint32_t> watched() const { return watched_; }
    [[nodiscard]] std::span<const uint32_t> all() const { return all_; }

    /// One matrix a node, in model space.
    void globalsOf(const Pose& pose, std::vector<glm::dmat4>& globals) const;

    /// Where the watched vertices are, then the points of all shells.
    void place(const std::vector<glm::dmat4>& globals, std::vector<glm::dvec3>& points) const;

    /// The largest distance between two poses, in extents: of these vertices, and of all shells.
    [[nodiscard]] double between(const std::vector<glm::dmat4>& a, const std::vector<glm::dmat4>& b,
                                 std::span<const uint32_t> vertices) const;

    /// Raises `largest`, by node, to the distance of vertices that follow a joint, and of its shell, in extents.
    void takeLargest(const std::vector<glm::dmat4>& a, const std::vector<glm::dmat4>& b,
                     std::vector<double>& largest) const;

private:
    [[nodiscard]] glm::dvec3 vertex(uint32_t v, const std::vector<glm::dmat4>& globals) const;
    [[nodiscard]] glm::dvec3 shellPoint(const glm::dmat4& m, int axis) const;
    void measureExtent(const std::vector<glm::dmat4>& globals);
    void measureReach(const std::vector<glm::dmat4>& globals);
    void measureTargets(const std::vector<glm::dmat4>& globals);
    void watch(const std::vector<glm::dmat4>& globals);

    const cage::Character& character_;
    std::vector<glm::dmat4> inverseBinds_;
    std::vector<double> reach_, parentScale_; ///< by node
    std::vector<double> drivenReach_;         ///< by node: by takeDrivers()
    std::vector<double> targetReach_;
    std::vector<uint32_t> watched_, all_;
    double extent_ = 0.0;
};

} // namespace supple::skinning
