#include "skinning/reach.h"

#include "skinning/chord.h"
#include "skinning/coarse_clip.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace supple::skinning {

namespace {

/// The device poses in floats (docs/playback.md).
constexpr double kFloatSlack = 5e-5;

/// What the clips and the rest pose give to a node.
struct NodeRange {
    Box translation = emptyBox();
    double scale = 0.0; ///< the largest, as a length
    bool moves = false; ///< a clip has a channel of it
};

/// Calls visit(value, width) with all numbers that no value of the channel leaves: a spline stays within the control
/// points of its Bezier form.
template <class F>
void forHull(const cage::Channel& channel, F&& visit) {
    const size_t width = channel.width();
    std::vector<double> value(width);
    const auto at = [&](size_t row, size_t k) { return static_cast<double>(channel.values[row * width + k]); };
    const bool spline = channel.interpolation == cage::Interpolation::cubicSpline;
    for (size_t key = 0; key < channel.times.size(); ++key) {
        // In-tangent, value, out-tangent; a third of the time to the neighbor leads to a control point.
        const std::array<size_t, 2> neighbors{key > 0 ? key - 1 : key, std::min(key + 1, channel.times.size() - 1)};
        for (size_t point = 0; point < (spline ? 3 : 1); ++point) {
            for (size_t k = 0; k < width; ++k) {
                value[k] = at(spline ? 3 * key + 1 : key, k);
                if (point > 0) {
                    const double third = (static_cast<double>(channel.times[neighbors[point - 1]]) -
                                          static_cast<double>(channel.times[key])) /
                                         3.0;
                    value[k] += third * at(3 * key + (point == 1 ? 0 : 2), k);
                }
            }
            visit(std::span<const double>(value));
        }
    }
}

double longest(const Box& box) {
    return glm::length(glm::max(glm::abs(box.low), glm::abs(box.high)));
}

class ReachFinder {
public:
    explicit ReachFinder(const cage::Character& character)
        : character_(character), ranges_(character.skeleton.nodes.size()), places_(ranges_.size()),
          weights_(character.morphs.targets.size()) {}

    [[nodiscard]] Reach find() {
        takeRest();
        const NodeOrder order = nodeOrder(character_);
        for (const cage::Clip& clip : character_.clips) {
            take(clip);
            if (const std::optional<cage::Clip> twin = coarseClip(order, clip)) {
                take(*twin);
            }
        }
        takeDrivers();
        for (const uint32_t node : character_.skeleton.parentsFirst) {
            place(node);
        }
        for (const Place& place : places_) {
            reach_.anchored.push_back(place.anchor != cage::kNone ? 1 : 0);
        }
        takeTargets();
        takeVertices();
        takeAnchor();
        return std::move(reach_);
    }

private:
    /// Where a node can be: fixed by a matrix, or within a radius of the box of its anchor.
    struct Place {
        uint32_t anchor = cage::kNone; ///< none: it is fixed
        glm::dmat4 fixed{1.0};
        Box origin; ///< of the anchor
        double radius = 0.0, scale = 1.0;
    };

    void takeRest() {
        for (size_t n = 0; n < ranges_.size(); ++n) {
            const cage::Node& node = character_.skeleton.nodes[n];
            extend(ranges_[n].translation, glm::dvec3(node.hasMatrix ? glm::vec3(node.matrix[3]) : node.translation));
            ranges_[n].scale = node.hasMatrix
                                   ? normOf(glm::dmat3(glm::dmat4(node.matrix)))
                                   : static_cast<double>(std::max(
                                         {std::abs(node.scale.x), std::abs(node.scale.y), std::abs(node.scale.z)}));
        }
        for (size_t t = 0; t < weights_.size(); ++t) {
            weights_[t] = std::abs(static_cast<double>(character_.morphs.weights[t]));
        }
    }

    void take(const cage::Clip& clip) {
        for (const cage::Channel& channel : clip.channels) {
            take(channel);
        }
    }
    void take(const cage::Channel& channel) {
        if (channel.path == cage::ChannelPath::weights) {
            forHull(channel, [&](std::span<const double> value) {
                for (size_t k = 0; k < value.size() && channel.firstTarget + k < weights_.size(); ++k) {
                    double& most = weights_[channel.firstTarget + k];
                    most = std::max(most, std::abs(value[k]));
                }
            });
            return;
        }
        if (isRest(channel)) {
            return;
        }
        NodeRange& range = ranges_[channel.node];
        range.moves = true;
        if (channel.path == cage::ChannelPath::translation) {
            forHull(channel, [&](std::span<const double> value) {
                extend(range.translation, glm::dvec3(value[0], value[1], value[2]));
            });
        } else if (channel.path == cage::ChannelPath::scale) {
            forHull(channel, [&](std::span<const double> value) {
                range.scale = std::max({range.scale, std::abs(value[0]), std::abs(value[1]), std::abs(value[2])});
            });
        }
    }

    /// They add to what clips have.
    void takeDrivers() {
        for (const cage::PoseDriver& driver : character_.drivers) {
            for (const uint32_t target : driver.targets) {
                weights_[target] += static_cast<double>(std::max(-driver.low, driver.high));
            }
        }
    }

    /// Whether all that the channel gives is the node's rest pose.
    [[nodiscard]] bool isRest(const cage::Channel& channel) const {
        const cage::Node& node = character_.skeleton.nodes[channel.node];
        const glm::quat& turn = node.rotation;
        const std::array<float, 4> rest =
            channel.path == cage::ChannelPath::rotation ? std::array<float, 4>{turn.x, turn.y, turn.z, turn.w}
            : channel.path == cage::ChannelPath::scale
                ? std::array<float, 4>{node.scale.x, node.scale.y, node.scale.z, 0.0f}
                : std::array<float, 4>{node.translation.x, node.translation.y, node.translation.z, 0.0f};
        const size_t width = channel.width();
        const bool spline = channel.interpolation == cage::Interpolation::cubicSpline;
        for (size_t i = 0; i < channel.values.size(); ++i) {
            const bool tangent = spline && i / width % 3 != 1;
            if (channel.values[i] != (tangent ? 0.0f : rest[i % width])) {
                return false;
            }
        }
        return true;
    }

    void place(uint32_t n) {
        const cage::Node& node = character_.skeleton.nodes[n];
        const NodeRange& range = ranges_[n];
        const Place parent = node.parent != cage::kNone ? places_[node.parent] : Place{};
        Place& own = places_[n];
        if (parent.anchor != cage::kNone) {
            own = parent;
            own.radius += parent.scale * longest(range.translation);
            own.scale *= range.scale;
        } else if (range.moves) {
            own.anchor = n;
            own.origin = movedBy(parent.fixed, range.translation);
            own.scale = normOf(glm::dmat3(parent.fixed)) * range.scale;
        } else {
            const Transform rest{glm::dvec3(node.translation), glm::dquat(node.rotation), glm::dvec3(node.scale)};
            own.fixed = parent.fixed * localMatrix(node, rest);
            own.scale = normOf(glm::dmat3(own.fixed));
        }
    }

    void takeTargets() {
        const cage::Morphs& morphs = character_.morphs;
        morphed_.assign(character_.cage.positions.size(), 0.0);
        for (size_t t = 0; t < weights_.size(); ++t) {
            double most = 0.0;
            for (size_t k = 0; k < morphs.targets[t].vertices.size(); ++k) {
                const double length = glm::length(glm::dvec3(morphs.targets[t].deltas[k]));
                most = std::max(most, length);
                morphed_[morphs.targets[t].vertices[k]] += weights_[t] * length;
            }
            reach_.deltas.push_back(most);
        }
        for (const double morphed : morphed_) {
            reach_.morphed = std::max(reach_.morphed, morphed);
        }
    }

    void takeVertices() {
        const cage::Skin& skin = character_.skin;
        reach_.joints.assign(skin.joints.size(), emptyBox());
        reach_.blended = emptyBox();
        reach_.sizes.resize(skin.joints.size());
        for (size_t j = 0; j < reach_.sizes.size(); ++j) {
            reach_.sizes[j] = places_[skin.joints[j]].scale * normOf(glm::dmat3(glm::dmat4(skin.inverseBinds[j])));
        }
        double stretch = 0.0;
        for (size_t v = 0; v < character_.cage.positions.size(); ++v) {
            const glm::dvec3 position(character_.cage.positions[v]);
            double heaviest = 0.0;
            for (uint32_t i = character_.weights.starts[v]; i < character_.weights.starts[v + 1]; ++i) {
                const cage::Influence& influence = character_.weights.influences[i];
                const glm::dmat4 bind(skin.inverseBinds[influence.joint]);
                const Place& place = places_[skin.joints[influence.joint]];
                const double size = reach_.sizes[influence.joint];
                stretch = std::max(stretch, size);
                extend(reach_.joints[influence.joint], position);
                extend(reach_.blended, boxAt(place, glm::dvec3(bind * glm::dvec4(position, 1.0)), size * morphed_[v]));
                heaviest = std::max(heaviest, static_cast<double>(influence.weight));
            }
            // See BoundsFinder::dualQuaternionError (clip_bounds.cpp): quaternions that may be far apart.
            reach_.dualQuaternions =
                std::max(reach_.dualQuaternions, std::max(1.0 - heaviest, 0.0) * (1.0 + 1.0 / heaviest));
        }
        const double size = glm::length(reach_.blended.high - reach_.blended.low);
        const double far = longest(reach_.blended);
        reach_.blended = grownBy(reach_.blended, kFloatSlack * (size + far));
        for (const double delta : reach_.deltas) {
            reach_.targets.push_back(stretch * delta);
        }
    }

    /// Where a point of the joint's space can be.
    [[nodiscard]] static Box boxAt(const Place& place, const glm::dvec3& local, double around) {
        if (place.anchor == cage::kNone) {
            const glm::dvec3 at(place.fixed * glm::dvec4(local, 1.0));
            return grownBy({at, at}, around);
        }
        return grownBy(place.origin, place.radius + place.scale * glm::length(local) + around);
    }

    void takeAnchor() {
        for (size_t j = 0; j < reach_.joints.size(); ++j) {
            if (isEmpty(reach_.joints[j])) {
                continue;
            }
            const Place& place = places_[character_.skin.joints[j]];
            if (place.anchor == cage::kNone || (reach_.anchor != cage::kNone && reach_.anchor != place.anchor)) {
                reach_.anchor = cage::kNone;
                return;
            }
            reach_.anchor = place.anchor;
            reach_.anchorPath = place.origin.high - place.origin.low;
        }
    }

    const cage::Character& character_;
    std::vector<NodeRange> ranges_;
    std::vector<Place> places_;
    std::vector<double> weights_; ///< by morph target: the largest of all clips
    std::vector<double> morphed_; ///< by vertex: how far these can move it
    Reach reach_;
};

} // namespace

Reach reachOf(const cage::Character& character) {
    return ReachFinder(character).find();
}

double reachedBy(std::span<const float> morphWeights, std::span<const double> targets) {
    double sum = 0.0;
    for (size_t t = 0; t < morphWeights.size(); ++t) {
        sum += std::abs(static_cast<double>(morphWeights[t])) * targets[t];
    }
    return sum;
}

Box dualQuaternionBounds(const Reach& reach, const Box& linear) {
    return grownBy(linear, reach.dualQuaternions * glm::length(linear.high - linear.low));
}

Box bindBounds(const Reach& reach, std::span<const float> morphWeights) {
    Box box = emptyBox();
    for (const Box& joint : reach.joints) {
        extend(box, joint);
    }
    return grownBy(box, reachedBy(morphWeights, reach.deltas));
}

Box paletteBounds(const Reach& reach, std::span<const Affine> palette, std::span<const float> morphWeights) {
    const double morphed = reachedBy(morphWeights, reach.deltas);
    Box box = emptyBox();
    for (size_t j = 0; j < palette.size(); ++j) {
        if (isEmpty(reach.joints[j])) {
            continue;
        }
        const glm::dvec3 middle = 0.5 * (reach.joints[j].low + reach.joints[j].high);
        const glm::dvec3 half = 0.5 * (reach.joints[j].high - reach.joints[j].low) + morphed;
        glm::dvec3 at, around;
        for (int r = 0; r < 3; ++r) {
            const glm::dvec4 row(palette[j].rows[r]);
            at[r] = glm::dot(glm::dvec3(row), middle) + row.w;
            around[r] = glm::dot(glm::abs(glm::dvec3(row)), half);
        }
        extend(box, {at - around, at + around});
    }
    return grownBy(box, kFloatSlack * (glm::length(box.high - box.low) + longest(box)));
}

} // namespace supple::skinning
