#include "runtime/points/find_points.h"

#include "runtime/cpu_group.h"
#include "runtime/points/gltf_points.h"
#include "runtime/points/point_domains.h"
#include "runtime/points/ray_tree.h"
#include "runtime/points/seed_tree.h"
#include "runtime/points/uv_tree.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace supple::runtime {
namespace {

constexpr int kRounds = 10;
constexpr double kLongestStep = 0.25;
/// Places are equally near if their distances differ by less than this part of the extent.
constexpr double kTie = 1e-6;
/// A part of the surface is searched if it may be nearer than what was found by more than this part of the extent.
constexpr double kMissed = 5e-4;
constexpr size_t kMostMore = 4; ///< such parts are searched: beside a vertex of many faces all may be so near

/// Newton's method for the distance, held to a domain.
class NearestInDomain {
public:
    NearestInDomain(const CpuPose& pose, const PointDomain& domain, const glm::dvec3& to)
        : pose_(pose), domain_(domain), to_(to) {}

    struct Found {
        double a = 0.0, b = 0.0, distance = 0.0; ///< the distance is squared
    };
    [[nodiscard]] Result<Found> from(double a, double b) const {
        Found best{a, b, 0.0};
        Result<SuppleSurfaceJet> jet = jetAt(best);
        if (!jet) {
            return jet.error();
        }
        best.distance = distanceOf(*jet);
        for (int round = 0; round < kRounds; ++round) {
            glm::dvec2 step = stepAt(*jet, best);
            bool nearer = false;
            for (int halving = 0; halving < 6 && !nearer && step != glm::dvec2(0.0); ++halving, step *= 0.5) {
                const glm::dvec2 at = domain_.held(glm::dvec2(best.a, best.b) + step);
                Found next{at.x, at.y, 0.0};
                const Result<SuppleSurfaceJet> there = jetAt(next);
                if (!there) {
                    return there.error();
                }
                next.distance = distanceOf(*there);
                nearer = next.distance < best.distance;
                if (nearer) {
                    best = next;
                    jet = *there;
                }
            }
            if (!nearer) {
                break;
            }
        }
        return best;
    }

private:
    [[nodiscard]] Result<SuppleSurfaceJet> jetAt(const Found& place) const {
        const SuppleSurfacePoint point = domain_.at(place.a, place.b);
        SuppleSurfaceJet jet;
        const Status evaluated = pose_.evaluate({&point, 1}, &jet, {});
        return evaluated ? Result<SuppleSurfaceJet>(jet) : evaluated.error();
    }
    [[nodiscard]] double distanceOf(const SuppleSurfaceJet& jet) const {
        const glm::dvec3 e = vectorAt(jet.position) - to_;
        return glm::dot(e, e);
    }
    /// On a border that the gradient pushes against, only the way along it is left.
    [[nodiscard]] glm::dvec2 stepAt(const SuppleSurfaceJet& jet, const Found& at) const {
        const glm::dvec3 e = vectorAt(jet.position) - to_, du = vectorAt(jet.du), dv = vectorAt(jet.dv);
        const glm::dvec2 g(glm::dot(du, e), glm::dot(dv, e));
        double aa = glm::dot(du, du), ab = glm::dot(du, dv), bb = glm::dot(dv, dv);
        const double fullAa = aa + glm::dot(vectorAt(jet.duu), e), fullAb = ab + glm::dot(vectorAt(jet.duv), e),
                     fullBb = bb + glm::dot(vectorAt(jet.dvv), e);
        if (fullAa > 0.0 && fullAa * fullBb > fullAb * fullAb) { // else Gauss and Newton
            aa = fullAa, ab = fullAb, bb = fullBb;
        }
        const auto along = [&](const glm::dvec2& way) {
            const double bend = way.x * (aa * way.x + ab * way.y) + way.y * (ab * way.x + bb * way.y);
            return bend > 0.0 ? -(glm::dot(g, way) / bend) * way : glm::dvec2(0.0);
        };
        const bool holdsA = (at.a <= 0.0 && g.x > 0.0) || (domain_.isQuad && at.a >= 1.0 && g.x < 0.0);
        const bool holdsB = (at.b <= 0.0 && g.y > 0.0) || (domain_.isQuad && at.b >= 1.0 && g.y < 0.0);
        const bool onSlant = !domain_.isQuad && at.a + at.b >= 1.0 && g.x + g.y < 0.0;
        const double area = aa * bb - ab * ab;
        glm::dvec2 step(0.0);
        if (holdsA || holdsB) {
            step = holdsA && holdsB ? step : along(holdsA ? glm::dvec2(0.0, 1.0) : glm::dvec2(1.0, 0.0));
        } else if (onSlant) {
            step = along({1.0, -1.0});
        } else if (area > 0.0) {
            step = {(ab * g.y - bb * g.x) / area, (ab * g.x - aa * g.y) / area};
        }
        const double length = std::max(std::abs(step.x), std::abs(step.y));
        return length > kLongestStep ? (kLongestStep / length) * step : step;
    }

    const CpuPose& pose_;
    const PointDomain& domain_;
    glm::dvec3 to_;
};

/// The disk that a cell's surface lies near to, by its jet.
SeedTree::Seed seedOf(const Cell& cell, bool isQuad, uint32_t domain, const SuppleSurfaceJet& jet) {
    const glm::dvec2 at = cell.middle(isQuad);
    const glm::dvec3 du = vectorAt(jet.du), dv = vectorAt(jet.dv), across = glm::cross(du, dv);
    const double area = glm::length(across);
    double reach = 0.0, bend = 0.0;
    const glm::dvec2 corners[] = {cell.origin, cell.origin + cell.x, cell.origin + cell.y,
                                  cell.origin + cell.x + cell.y};
    for (const glm::dvec2& corner : std::span(corners, isQuad ? 4 : 3)) {
        const glm::dvec2 way = corner - at, size = glm::abs(way);
        reach = std::max(reach, glm::length(way.x * du + way.y * dv));
        bend = std::max(bend, 0.5 * (glm::length(vectorAt(jet.duu)) * size.x * size.x +
                                     2.0 * glm::length(vectorAt(jet.duv)) * size.x * size.y +
                                     glm::length(vectorAt(jet.dvv)) * size.y * size.y));
    }
    const glm::dvec3 normal = area > 0.0 ? across / area : glm::dvec3(0.0);
    if (area <= 0.0) {
        bend += reach;
    }
    return {vectorAt(jet.position), domain, at.x, at.y, normal, static_cast<float>(reach), static_cast<float>(bend)};
}

/// Numbers from 0 to 1, the same for a seed everywhere (splitmix64).
class RandomNumbers {
public:
    explicit RandomNumbers(uint64_t seed) : state_(seed) {}
    double operator()() {
        uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30u)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27u)) * 0x94D049BB133111EBu;
        return static_cast<double>((z ^ (z >> 31u)) >> 11u) * 0x1p-53;
    }

private:
    uint64_t state_;
};

} // namespace

/// The surfaces in one pose, with what searches of every kind begin from.
class PointFinder {
public:
    explicit PointFinder(std::shared_ptr<const CpuGroup> group)
        : domains_(pointDomains(*group)), pose_(std::move(group)) {}

    /// `cage`: of all vertices.
    [[nodiscard]] Status build(const float* cage) {
        if (Status built = pose_.build(reinterpret_cast<const std::byte*>(cage), sizeof(glm::vec3), {}); !built) {
            return built;
        }
        tree_.reset();
        rays_.reset();
        return success();
    }
    [[nodiscard]] const std::vector<PointDomain>& domains() const { return domains_; }
    [[nodiscard]] bool isOf(const std::shared_ptr<const CpuGroup>& group) const {
        return &pose_.group() == group.get();
    }

    [[nodiscard]] Status findNearest(const float* positions, std::span<SuppleSurfacePoint> out);
    [[nodiscard]] Status scatter(uint32_t seed, std::span<SuppleSurfacePoint> out) const;
    /// `rays`: six numbers each.
    [[nodiscard]] Status cast(const float* rays, std::span<SuppleSurfacePoint> out);
    /// What the surface is at points; zeros where there is none.
    [[nodiscard]] Status evaluate(std::span<const SuppleSurfacePoint> points, SuppleSurfaceJet* jets) const;

private:
    /// All cells of all domains, with the jets at their middles.
    Status forEachCell(const std::function<void(uint32_t domain, const Cell&, const SuppleSurfaceJet&)>& visit) const;
    Status plant();
    [[nodiscard]] Result<SuppleSurfacePoint> nearestTo(const glm::dvec3& to) const;

    std::vector<PointDomain> domains_;
    CpuPose pose_;
    std::optional<SeedTree> tree_; ///< made when a nearest point is asked for
    std::optional<RayTree> rays_;  ///< made when a ray is
    double extent_ = 0.0;
};

Status PointFinder::forEachCell(
    const std::function<void(uint32_t domain, const Cell&, const SuppleSurfaceJet&)>& visit) const {
    const cage::Cage& cage = pose_.group().cage();
    std::vector<Cell> cells;
    std::pair<bool, uint32_t> kind(false, 0); // of the cells
    std::vector<SuppleSurfacePoint> points;
    std::vector<SuppleSurfaceJet> jets;
    for (uint32_t p = 0; p < domains_.size(); ++p) {
        const PointDomain& domain = domains_[p];
        const std::pair<bool, uint32_t> own(domain.isQuad, cellsAlong(cage.sides(domain.face)));
        if (own != kind) {
            kind = own;
            cells = cellsOf(kind.first, kind.second);
            jets.resize(cells.size());
        }
        points.clear();
        for (const Cell& cell : cells) {
            const glm::dvec2 at = cell.middle(domain.isQuad);
            points.push_back(domain.at(at.x, at.y));
        }
        if (Status evaluated = pose_.evaluate(points, jets.data(), {}); !evaluated) {
            return evaluated;
        }
        for (size_t k = 0; k < cells.size(); ++k) {
            visit(p, cells[k], jets[k]);
        }
    }
    return success();
}

Status PointFinder::plant() {
    std::vector<SeedTree::Seed> seeds;
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    Status made = forEachCell([&](uint32_t p, const Cell& cell, const SuppleSurfaceJet& jet) {
        const glm::dvec3 position = vectorAt(jet.position);
        low = glm::min(low, position);
        high = glm::max(high, position);
        seeds.push_back(seedOf(cell, domains_[p].isQuad, p, jet));
    });
    if (made) {
        extent_ = glm::distance(low, high);
        tree_.emplace(std::move(seeds));
    }
    return made;
}

Result<SuppleSurfacePoint> PointFinder::nearestTo(const glm::dvec3& to) const {
    struct Candidate {
        const PointDomain* domain = nullptr;
        NearestInDomain::Found found;
    };
    std::vector<Candidate> candidates;
    Status status = success();
    double least = std::numeric_limits<double>::infinity();
    const auto descend = [&](const SeedTree::Seed& seed) {
        const PointDomain& domain = domains_[seed.domain];
        const auto found = NearestInDomain(pose_, domain, to).from(seed.a, seed.b);
        if (!found) {
            status = found.error();
            return;
        }
        candidates.push_back({&domain, *found});
        least = std::min(least, found->distance);
    };
    const std::vector<std::pair<double, size_t>> nearest = tree_->nearest(to);
    for (const auto& [distance, seed] : nearest) {
        descend((*tree_)[seed]);
    }
    const auto worthIt = [&] { return std::sqrt(least) - kMissed * extent_; };
    for (const auto& [atLeast, seed] : tree_->mayBeNearer(to, worthIt(), kMostMore)) {
        const size_t own = seed;
        const bool isKnown =
            std::any_of(nearest.begin(), nearest.end(), [&](const auto& other) { return other.second == own; });
        if (!isKnown && atLeast < worthIt()) {
            descend((*tree_)[seed]);
        }
    }
    if (!status) {
        return status.error();
    }
    // Faces that meet at a point differ by rounding there.
    const double most = std::sqrt(least) + kTie * extent_;
    const Candidate* best = nullptr;
    for (const Candidate& own : candidates) {
        if (std::sqrt(own.found.distance) > most) {
            continue;
        }
        const auto rank = [](const Candidate& c) { return std::tuple(c.domain->face, c.found.distance); };
        if (best == nullptr || rank(own) < rank(*best)) {
            best = &own;
        }
    }
    return best->domain->at(best->found.a, best->found.b);
}

Status PointFinder::findNearest(const float* positions, std::span<SuppleSurfacePoint> out) {
    if (!tree_) {
        if (Status planted = plant(); !planted) {
            return planted;
        }
    }
    for (size_t k = 0; k < out.size(); ++k) {
        const Result<SuppleSurfacePoint> found = nearestTo(vectorAt(positions + 3 * k));
        if (!found) {
            return found.error();
        }
        out[k] = *found;
    }
    return success();
}

Status PointFinder::scatter(uint32_t seed, std::span<SuppleSurfacePoint> out) const {
    struct Area {
        uint32_t domain = 0;
        Cell cell;
        double end = 0.0; ///< of the running sum
    };
    std::vector<Area> areas;
    double sum = 0.0;
    Status made = forEachCell([&](uint32_t p, const Cell& cell, const SuppleSurfaceJet& jet) {
        sum += glm::length(glm::cross(vectorAt(jet.du), vectorAt(jet.dv))) * cell.size(domains_[p].isQuad);
        areas.push_back({p, cell, sum});
    });
    if (!made) {
        return made;
    }
    RandomNumbers number(seed);
    for (size_t k = 0; k < out.size(); ++k) {
        // A point for each of as many equal parts of the area.
        const double target = sum * ((static_cast<double>(k) + number()) / static_cast<double>(out.size()));
        const auto area = std::min(
            std::upper_bound(areas.begin(), areas.end(), target, [](double t, const Area& own) { return t < own.end; }),
            areas.end() - 1);
        double x = number(), y = number();
        if (!domains_[area->domain].isQuad && x + y > 1.0) {
            x = 1.0 - x;
            y = 1.0 - y;
        }
        const glm::dvec2 at = area->cell.origin + x * area->cell.x + y * area->cell.y;
        out[k] = domains_[area->domain].at(at.x, at.y);
    }
    return success();
}

Status PointFinder::cast(const float* rays, std::span<SuppleSurfacePoint> out) {
    if (!rays_) {
        Result<RayTree> planted = RayTree::plant(pose_, domains_);
        if (!planted) {
            return planted.error();
        }
        rays_.emplace(std::move(*planted));
    }
    for (size_t k = 0; k < out.size(); ++k) {
        const auto hit = rays_->find({vectorAt(rays + 6 * k), vectorAt(rays + 6 * k + 3)});
        if (!hit) {
            return hit.error();
        }
        out[k] = *hit ? domains_[(*hit)->domain].at((*hit)->a, (*hit)->b) : kNoPoint;
    }
    return success();
}

Status PointFinder::evaluate(std::span<const SuppleSurfacePoint> points, SuppleSurfaceJet* jets) const {
    const auto isFound = [](const SuppleSurfacePoint& point) { return point.face != SUPPLE_NO_FACE; };
    for (size_t begin = 0, end = 0; begin < points.size(); begin = end) {
        end = begin + 1;
        while (end < points.size() && isFound(points[end]) == isFound(points[begin])) {
            ++end;
        }
        if (!isFound(points[begin])) {
            std::fill(jets + begin, jets + end, SuppleSurfaceJet{});
        } else if (Status made = pose_.evaluate(points.subspan(begin, end - begin), jets + begin, {}); !made) {
            return made;
        }
    }
    return success();
}

namespace {

Status findUvs(const CpuGroup& group, const SupplePointQuery& query, std::span<SuppleSurfacePoint> out) {
    const cage::Cage& cage = group.cage();
    const std::vector<glm::vec2>& uvs = query.uvSet == 0 ? cage.cornerUvs : cage.cornerUvs1;
    if (uvs.empty()) {
        return Error{ErrorCode::range, "the character has no UV set " + std::to_string(query.uvSet)};
    }
    const std::vector<PointDomain> domains = pointDomains(group);
    const UvTree tree(cage, uvs, domains);
    const size_t each = std::max(1u, query.pointsEach);
    std::fill(out.begin(), out.end(), kNoPoint);
    for (size_t k = 0; k < query.count; ++k) {
        const auto found = tree.find({query.values[2 * k], query.values[2 * k + 1]}, each);
        for (size_t i = 0; i < found.size(); ++i) {
            const glm::dvec2 at = glm::clamp(found[i].at, 0.0, 1.0);
            out[k * each + i] = domains[found[i].domain].at(at.x, at.y);
        }
    }
    return success();
}

/// Kinds that look at the cage alone.
bool isOfFile(const SupplePointQuery& query) {
    return query.kind == SUPPLE_FIND_UV || query.kind == SUPPLE_FIND_GLTF;
}

} // namespace

Status findPoints(const std::shared_ptr<const CpuGroup>& group, std::shared_ptr<PointFinder>& kept,
                  const SupplePointQuery& query, std::span<SuppleSurfacePoint> out) {
    if (isOfFile(query)) {
        Status found = query.kind == SUPPLE_FIND_UV ? findUvs(*group, query, out)
                                                    : findGltfPoints(*group, {query.gltf, query.count}, out);
        if (!found || query.jets == nullptr) {
            return found;
        }
    }
    const cage::Cage& cage = group->cage();
    if (query.cage != nullptr && query.cageVertexCount != cage.vertexCount()) {
        return Error{ErrorCode::range, std::to_string(query.cageVertexCount) + " vertices for a cage of " +
                                           std::to_string(cage.vertexCount())};
    }
    std::shared_ptr<PointFinder> finder = query.cage == nullptr ? kept : nullptr;
    if (finder == nullptr || !finder->isOf(group)) {
        finder = std::make_shared<PointFinder>(group);
        const float* const positions = query.cage != nullptr ? query.cage : &cage.positions[0].x;
        if (Status built = finder->build(positions); !built) {
            return built;
        }
    }
    if (query.cage == nullptr) {
        kept = finder;
    }
    if (finder->domains().empty()) {
        return Error{ErrorCode::argument, "the surfaces have no faces"};
    }
    Status found = success(); // the points of other kinds stand in out already
    if (query.kind == SUPPLE_FIND_NEAREST) {
        found = finder->findNearest(query.values, out);
    } else if (query.kind == SUPPLE_FIND_RAY) {
        found = finder->cast(query.values, out);
    } else if (query.kind == SUPPLE_FIND_SCATTER) {
        found = finder->scatter(query.seed, out);
    }
    return found && query.jets != nullptr ? finder->evaluate(out, query.jets) : found;
}

} // namespace supple::runtime
