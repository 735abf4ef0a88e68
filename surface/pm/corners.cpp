#include "surface/pm/corners.h"

#include "surface/pm/weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

namespace supple::surface::pm {
namespace {

/// A right angle stays one while its inner tangents are at most half an edge off.
constexpr double kGoodMisfit = 0.25;
constexpr uint32_t kFlat = 6, kWidest = 11;
constexpr double kTiny = std::numeric_limits<double>::min();
/// A curve is bent by at most 60 degrees where it becomes smooth: a sharper bend is meant to be seen.
constexpr double kMostBend = 0.5;

/// The unit vector; zero where there is no direction.
glm::dvec3 directionOf(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

/// No tangent inside a corner is longer than this share of its edge.
constexpr double kLongest = 0.5;
/// Ends are shortened at most as often: each time brings the longest tangent to its measure.
constexpr uint32_t kShortenings = 32;

/// The fans round one vertex, none of them closed.
class VertexCorners {
public:
    VertexCorners(Mesh& mesh, std::span<Fan> fans) : mesh_(mesh), fans_(fans) {}

    void shape() {
        while (join()) {
        }
        for (Fan& fan : fans_) {
            if (fan.kind == FanKind::corner && fan.facets > 1) {
                fan.width = static_cast<uint8_t>(bestWidth(fan));
            }
        }
        for (uint32_t k = 0; k < kShortenings && shorten(); ++k) {
        }
    }

private:
    [[nodiscard]] glm::dvec3 edge(const Fan& fan, uint32_t j) const { return spoke(fan.firstSlot + j); }
    [[nodiscard]] glm::dvec3 spoke(uint32_t slot) const {
        const cage::Topology& topology = mesh_.topology;
        return glm::dvec3(mesh_.cage.positions[topology.spokeVertices[mesh_.slotSpokes[slot]]]) -
               glm::dvec3(mesh_.cage.positions[fans_.front().vertex]);
    }

    [[nodiscard]] glm::dvec3 endTangent(const Fan& fan, size_t end) const {
        const FanEnd& at = fan.ends[end];
        const glm::dvec3 own = at.own * edge(fan, end == 0 ? 0 : fan.facets);
        return at.partner == cage::kNone ? own : own - at.other * spoke(at.partner);
    }

    [[nodiscard]] glm::dvec3 tangent(const Fan& fan, uint32_t width, uint32_t j) const {
        const CornerTurn at = cornerTurn(j, fan.facets, width);
        return at.first * endTangent(fan, 0) + at.last * endTangent(fan, 1);
    }

    /// How far the tangents inside a corner of that width are from their edges: the mean of |3 t_j - (X_j - p)|^2 /
    /// |X_j - p|^2, where tangents that are too long count as long as the edge.
    [[nodiscard]] double misfit(const Fan& fan, uint32_t width) const {
        double sum = 0.0;
        for (uint32_t j = 1; j < fan.facets; ++j) {
            const glm::dvec3 own = 3.0 * tangent(fan, width, j);
            const double length = glm::length(edge(fan, j));
            const glm::dvec3 off = own / std::max({glm::length(own), length, kTiny}) - directionOf(edge(fan, j));
            sum += length > 0.0 ? glm::dot(off, off) : 0.0;
        }
        return sum / (fan.facets - 1);
    }

    [[nodiscard]] uint32_t bestWidth(const Fan& fan) const {
        uint32_t best = kRightAngle;
        double least = misfit(fan, best);
        if (least <= kGoodMisfit) {
            return best;
        }
        for (uint32_t width = kRightAngle; width <= kWidest; ++width) {
            const double own = width == kFlat ? least : misfit(fan, width);
            if (own < least) {
                least = own;
                best = width;
            }
        }
        return best;
    }

    /// Joins the two edges that end a fan, where that is far better than any width. Says whether it did.
    bool join() {
        Fan* best = nullptr;
        double most = 0.0;
        for (Fan& fan : fans_) {
            if (fan.kind != FanKind::corner || fan.facets < 2 || !fan.plainEnds()) {
                continue;
            }
            const double cosine = glm::dot(directionOf(edge(fan, 0)), directionOf(edge(fan, fan.facets)));
            const double gain = misfit(fan, bestWidth(fan)) - (1.0 + cosine);
            if (cosine <= -kMostBend && gain > most) {
                most = gain;
                best = &fan;
            }
        }
        if (best == nullptr) {
            return false;
        }
        joinEnds(*best);
        return true;
    }

    /// The tangents are those of the quadratic curve through A, p and B, so that none is longer than 2/3 of its edge.
    void joinEnds(const Fan& through) {
        const std::array<uint32_t, 2> slots{through.firstSlot, through.firstSlot + through.facets};
        const std::array<double, 2> lengths{glm::length(spoke(slots[0])), glm::length(spoke(slots[1]))};
        for (Fan& fan : fans_) {
            for (size_t end = 0; end < 2; ++end) {
                for (size_t k = 0; k < 2; ++k) {
                    if (spokeOf(fan, end) == mesh_.slotSpokes[slots[k]]) {
                        const double sum = 3.0 * (lengths[0] + lengths[1]);
                        fan.ends[end] = {slots[1 - k], lengths[1 - k] / sum, lengths[k] / sum};
                    }
                }
            }
            if (fan.ends[0].partner != cage::kNone && fan.ends[1].partner != cage::kNone &&
                mesh_.slotSpokes[fan.ends[0].partner] == spokeOf(fan, 1)) {
                fan.kind = FanKind::straight;
            }
        }
    }

    /// Shortens the end that makes the longest tangent inside a corner too long. Says whether there was one.
    bool shorten() {
        const Fan* longest = nullptr;
        size_t end = 0;
        double most = 1.0 + 1e-6;
        for (const Fan& fan : fans_) {
            for (uint32_t j = 1; fan.kind == FanKind::corner && j < fan.facets; ++j) {
                const double length = kLongest * glm::length(edge(fan, j));
                const double excess = length > 0.0 ? glm::length(tangent(fan, fan.width, j)) / length : 0.0;
                if (excess > most) {
                    const CornerTurn at = cornerTurn(j, fan.facets, fan.width);
                    most = excess;
                    longest = &fan;
                    end = std::abs(at.first) * glm::length(endTangent(fan, 0)) <
                                  std::abs(at.last) * glm::length(endTangent(fan, 1))
                              ? 1
                              : 0;
                }
            }
        }
        if (longest != nullptr) {
            scaleEnd(*longest, end, 1.0 / most);
        }
        return longest != nullptr;
    }

    /// Of all fans that end at this edge, or at the other edge of its curve.
    void scaleEnd(const Fan& of, size_t end, double factor) {
        const uint32_t partner = of.ends[end].partner;
        const uint32_t own = spokeOf(of, end), other = partner == cage::kNone ? own : mesh_.slotSpokes[partner];
        for (Fan& fan : fans_) {
            for (size_t k = 0; k < 2; ++k) {
                if (spokeOf(fan, k) == own || spokeOf(fan, k) == other) {
                    fan.ends[k].own *= factor;
                    fan.ends[k].other *= factor;
                }
            }
        }
    }

    [[nodiscard]] uint32_t spokeOf(const Fan& fan, size_t end) const {
        return mesh_.slotSpokes[fan.firstSlot + (end == 0 ? 0 : fan.facets)];
    }

    Mesh& mesh_;
    std::span<Fan> fans_;
};

} // namespace

void shapeCorners(Mesh& mesh) {
    for (size_t first = 0; first < mesh.fans.size();) {
        size_t last = first + 1;
        while (last < mesh.fans.size() && mesh.fans[last].vertex == mesh.fans[first].vertex) {
            ++last;
        }
        const std::span<Fan> fans = std::span(mesh.fans).subspan(first, last - first);
        if (std::any_of(fans.begin(), fans.end(),
                        [](const Fan& fan) { return fan.kind == FanKind::corner && fan.facets > 1; })) {
            VertexCorners(mesh, fans).shape();
        }
        first = last;
    }
}

} // namespace supple::surface::pm
