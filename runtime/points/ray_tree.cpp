#include "runtime/points/ray_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace supple::runtime {
namespace {

constexpr int kRayRounds = 12;
constexpr double kLongestRayStep = 0.3;
/// Steps that floats do not tell apart.
constexpr double kShortestRayStep = 1e-8;
/// A triangle is taken for a beginning if the ray passes it by so many of its widths: with less, of two points of a
/// bent domain the farther may be found.
constexpr double kTriangleSlack = 1.0;
/// A hit may be beside the ray by this part of the extent.
constexpr double kRayTolerance = 2e-6;

} // namespace

/// What one ray looks for.
class RayTree::Search {
public:
    Search(const RayTree& tree, const Ray& ray) : tree_(tree), ray_(ray), length_(glm::length(ray.direction)) {
        const glm::dvec3 d = ray.direction / length_;
        const glm::dvec3 size = glm::abs(d);
        const glm::dvec3 least = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                                 : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                      : glm::dvec3(0, 0, 1);
        x_ = glm::normalize(glm::cross(d, least));
        y_ = glm::cross(d, x_);
    }

    [[nodiscard]] Status lookAt(uint32_t number) {
        const PointDomain& domain = tree_.domains_[number];
        const SampleGrid grid{domain.isQuad, tree_.alongOf(domain)};
        const glm::vec3* const samples = &tree_.samples_[tree_.firsts_[number]];
        Status status = success();
        grid.forEachTriangle([&](const glm::uvec2& p, const glm::uvec2& q, const glm::uvec2& r) {
            const auto sampleOf = [&](const glm::uvec2& k) { return glm::dvec3(samples[grid.number(k.x, k.y)]); };
            const std::optional<glm::dvec2> weights = passes(sampleOf(p), sampleOf(q), sampleOf(r));
            if (status && weights) {
                const glm::dvec2 first = grid.at(p.x, p.y);
                status = begin(number, first + weights->x * (grid.at(q.x, q.y) - first) +
                                           weights->y * (grid.at(r.x, r.y) - first));
            }
        });
        return status;
    }
    [[nodiscard]] const std::optional<Hit>& best() const { return best_; }

private:
    /// What a search has come nearest to the ray.
    struct Nearest {
        double distance = std::numeric_limits<double>::infinity();
        glm::dvec2 at{0.0};
        glm::dvec3 position{0.0};
    };
    /// The weights of q and r where the ray meets the plane of a triangle, if that is not far off it.
    [[nodiscard]] std::optional<glm::dvec2> passes(const glm::dvec3& p, const glm::dvec3& q,
                                                   const glm::dvec3& r) const {
        const glm::dvec2 at = across(p), e = across(q) - at, f = across(r) - at;
        const double area = e.x * f.y - e.y * f.x;
        const glm::dvec2 weights = glm::dvec2(f.x * at.y - f.y * at.x, e.y * at.x - e.x * at.y) / area;
        return weights.x >= -kTriangleSlack && weights.y >= -kTriangleSlack &&
                       weights.x + weights.y <= 1.0 + kTriangleSlack
                   ? std::optional(weights)
                   : std::nullopt;
    }
    /// Where a point is, seen along the ray.
    [[nodiscard]] glm::dvec2 across(const glm::dvec3& p) const {
        const glm::dvec3 e = p - ray_.origin;
        return {glm::dot(x_, e), glm::dot(y_, e)};
    }
    [[nodiscard]] Status begin(uint32_t number, const glm::dvec2& seed) {
        const PointDomain& domain = tree_.domains_[number];
        glm::dvec2 at = domain.held(seed);
        Nearest nearest;
        for (int round = 0; round <= kRayRounds; ++round) {
            const SuppleSurfacePoint point = domain.at(at.x, at.y);
            SuppleSurfaceJet jet;
            if (Status evaluated = tree_.pose_->evaluate({&point, 1}, &jet, {}); !evaluated) {
                return evaluated;
            }
            const glm::dvec3 position = vectorAt(jet.position);
            const glm::dvec2 off = across(position), du(glm::dot(x_, vectorAt(jet.du)), glm::dot(y_, vectorAt(jet.du))),
                             dv(glm::dot(x_, vectorAt(jet.dv)), glm::dot(y_, vectorAt(jet.dv)));
            if (const double distance = glm::length(off); distance < nearest.distance) {
                nearest = {distance, at, position};
            }
            const double area = du.x * dv.y - du.y * dv.x;
            glm::dvec2 step = glm::dvec2(dv.x * off.y - dv.y * off.x, du.y * off.x - du.x * off.y) / area;
            const double length = std::max(std::abs(step.x), std::abs(step.y));
            if (!(length < std::numeric_limits<double>::infinity())) {
                break; // seen edge on
            }
            step *= length > kLongestRayStep ? kLongestRayStep / length : 1.0;
            const glm::dvec2 next = domain.held(at + step);
            if (glm::all(glm::lessThan(glm::abs(next - at), glm::dvec2(kShortestRayStep)))) {
                break;
            }
            at = next;
        }
        if (nearest.distance <= tree_.tolerance_) {
            take(number, nearest);
        }
        return success();
    }
    void take(uint32_t number, const Nearest& found) {
        const double t = glm::dot(found.position - ray_.origin, ray_.direction) / (length_ * length_);
        if (t >= 0.0 && (!best_ || t < best_->t)) {
            best_ = Hit{number, found.at.x, found.at.y, t};
        }
    }

    const RayTree& tree_;
    Ray ray_;
    double length_;
    glm::dvec3 x_{0.0}, y_{0.0}; ///< of unit length, at right angles to the ray
    std::optional<Hit> best_;
};

Result<RayTree> RayTree::plant(const CpuPose& pose, std::span<const PointDomain> domains) {
    RayTree tree(pose, domains);
    if (Status sampled = tree.sample(); !sampled) {
        return sampled.error();
    }
    tree.order_.resize(domains.size());
    std::iota(tree.order_.begin(), tree.order_.end(), 0u);
    if (!domains.empty()) {
        (void)tree.split(0, static_cast<uint32_t>(domains.size()));
        const Box& all = tree.nodes_[0].box;
        const double farthest = glm::length(glm::max(glm::abs(all.low), glm::abs(all.high)));
        tree.tolerance_ =
            kRayTolerance * glm::distance(all.low, all.high) + 4.0 * std::numeric_limits<float>::epsilon() * farthest;
    }
    return tree;
}

Status RayTree::sample() {
    std::vector<SuppleSurfacePoint> points;
    std::vector<SuppleSurfaceJet> jets;
    for (const PointDomain& domain : domains_) {
        const SampleGrid grid{domain.isQuad, alongOf(domain)};
        points.clear();
        for (uint32_t j = 0; j <= grid.along; ++j) {
            for (uint32_t i = 0; i < grid.rowLength(j); ++i) {
                const glm::dvec2 at = grid.at(i, j);
                points.push_back(domain.at(at.x, at.y));
            }
        }
        jets.resize(points.size());
        if (Status evaluated = pose_->evaluate(points, jets.data(), {}); !evaluated) {
            return evaluated;
        }
        const size_t first = samples_.size();
        firsts_.push_back(first);
        for (const SuppleSurfaceJet& jet : jets) {
            samples_.emplace_back(jet.position[0], jet.position[1], jet.position[2]);
        }
        boxes_.push_back(boxOf(domain.isQuad, grid.along, std::span(samples_).subspan(first)));
    }
    return success();
}

RayTree::Box RayTree::boxOf(bool isQuad, uint32_t along, std::span<const glm::vec3> samples) {
    const SampleGrid grid{isQuad, along};
    Box box{samples[0], samples[0]};
    glm::vec3 bend(0.0f);
    const auto bendOf = [&](uint32_t from, uint32_t middle, uint32_t to) {
        bend = glm::max(bend, glm::abs(samples[from] - 2.0f * samples[middle] + samples[to]));
    };
    for (uint32_t j = 0; j <= along; ++j) {
        for (uint32_t i = 0; i < grid.rowLength(j); ++i) {
            const uint32_t own = grid.number(i, j);
            box.add(samples[own]);
            if (grid.has(i + 2, j)) {
                bendOf(own, grid.number(i + 1, j), grid.number(i + 2, j));
            }
            if (grid.has(i, j + 2)) {
                bendOf(own, grid.number(i, j + 1), grid.number(i, j + 2));
            }
            if (j >= 2 && grid.has(i + 2, j - 2)) {
                bendOf(own, grid.number(i + 1, j - 1), grid.number(i + 2, j - 2));
            }
        }
    }
    // Between samples a chord is off by 1/8 of a second difference, along either number. Between them it may be larger.
    box.low -= 0.5f * bend;
    box.high += 0.5f * bend;
    return box;
}

uint32_t RayTree::split(uint32_t begin, uint32_t end) {
    const auto number = static_cast<uint32_t>(nodes_.size());
    Node node{boxes_[order_[begin]], begin, end, 0};
    for (uint32_t k = begin; k < end; ++k) {
        node.box.add(boxes_[order_[k]]);
    }
    nodes_.push_back(node);
    if (end - begin > 1) {
        const glm::vec3 size = node.box.high - node.box.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const uint32_t middle = begin + (end - begin) / 2;
        const auto at = [&](uint32_t k) { return order_.begin() + static_cast<ptrdiff_t>(k); };
        std::nth_element(at(begin), at(middle), at(end), [&](uint32_t x, uint32_t y) {
            return boxes_[x].low[axis] + boxes_[x].high[axis] < boxes_[y].low[axis] + boxes_[y].high[axis];
        });
        (void)split(begin, middle);
        const uint32_t second = split(middle, end);
        nodes_[number].second = second;
    }
    return number;
}

std::optional<double> RayTree::enters(const Ray& ray, const Box& box) const {
    double from = 0.0, to = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double low = box.low[axis] - tolerance_ - ray.origin[axis],
                     high = box.high[axis] + tolerance_ - ray.origin[axis], d = ray.direction[axis];
        if (d == 0.0) {
            if (low > 0.0 || high < 0.0) {
                return std::nullopt;
            }
            continue;
        }
        from = std::max(from, std::min(low / d, high / d));
        to = std::min(to, std::max(low / d, high / d));
    }
    return from <= to ? std::optional(from) : std::nullopt;
}

std::vector<RayTree::Candidate> RayTree::candidates(const Ray& ray) const {
    std::vector<Candidate> met;
    std::vector<uint32_t> open;
    if (!nodes_.empty()) {
        open.push_back(0);
    }
    while (!open.empty()) {
        const uint32_t number = open.back();
        open.pop_back();
        const Node& node = nodes_[number];
        const std::optional<double> from = enters(ray, node.box);
        if (!from) {
            continue;
        }
        if (node.second == 0) {
            met.emplace_back(*from, order_[node.begin]);
        } else {
            open.push_back(number + 1);
            open.push_back(node.second);
        }
    }
    std::sort(met.begin(), met.end());
    return met;
}

Result<std::optional<RayTree::Hit>> RayTree::find(const Ray& ray) const {
    Search search(*this, ray);
    for (const auto& [from, domain] : candidates(ray)) {
        if (search.best() && search.best()->t < from) {
            break;
        }
        if (Status looked = search.lookAt(domain); !looked) {
            return looked.error();
        }
    }
    return search.best();
}

} // namespace supple::runtime
