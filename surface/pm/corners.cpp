#include "surface/pm/corners.h"

#include "surface/pm/weights.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::surface::pm {
namespace {

/// A right angle stays one while its inner tangents are at most half an edge off.
constexpr double kGoodMisfit = 0.25;
constexpr uint32_t kFlat = 6, kWidest = 11;
/// A curve is bent by at most 60 degrees where it becomes smooth: a sharper bend is meant to be seen.
constexpr double kMostBend = 0.5;

/// The unit vector; zero where there is no direction.
glm::dvec3 directionOf(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

/// How far the tangents of a corner's inner edges are from these edges, if its tangents at its ends are `first` and
/// `last`: the mean of |3 t_j - (X_j - p)|^2 / |X_j - p|^2. All vectors are relative to p.
double cornerMisfit(uint32_t width, const glm::dvec3& first, const glm::dvec3& last,
                    std::span<const glm::dvec3> innerEdges) {
    const auto facets = static_cast<uint32_t>(innerEdges.size() + 1);
    double sum = 0.0;
    for (uint32_t j = 1; j < facets; ++j) {
        const auto [own, other] = cornerTurn(j, facets, width);
        const glm::dvec3 edge = innerEdges[j - 1];
        const double length = glm::dot(edge, edge);
        const glm::dvec3 off = 3.0 * (own * first + other * last) - edge;
        sum += length > 0.0 ? glm::dot(off, off) / length : 0.0;
    }
    return facets > 1 ? sum / (facets - 1) : 0.0;
}

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

    [[nodiscard]] double misfit(const Fan& fan, uint32_t width) const {
        std::vector<glm::dvec3> inner;
        for (uint32_t j = 1; j < fan.facets; ++j) {
            inner.push_back(edge(fan, j));
        }
        return cornerMisfit(width, endTangent(fan, 0), endTangent(fan, 1), inner);
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
            if (fan.kind != FanKind::corner || fan.facets < 2 || fan.joined()) {
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
                const uint32_t own = mesh_.slotSpokes[fan.firstSlot + (end == 0 ? 0 : fan.facets)];
                for (size_t k = 0; k < 2; ++k) {
                    if (own == mesh_.slotSpokes[slots[k]]) {
                        const double sum = 3.0 * (lengths[0] + lengths[1]);
                        fan.ends[end] = {slots[1 - k], lengths[1 - k] / sum, lengths[k] / sum};
                    }
                }
            }
            if (fan.ends[0].partner != cage::kNone && fan.ends[1].partner != cage::kNone &&
                mesh_.slotSpokes[fan.ends[0].partner] == mesh_.slotSpokes[fan.firstSlot + fan.facets]) {
                fan.kind = FanKind::straight;
            }
        }
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
