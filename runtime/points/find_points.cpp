#include "runtime/points/find_points.h"

#include "runtime/cpu_group.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace supple::runtime {
namespace {

/// Samples along a side of a piece that searches begin from, and how many of the nearest are taken.
constexpr uint32_t kSeedsAlong = 4;
constexpr size_t kSeeds = 8;
constexpr int kRounds = 10;
constexpr double kLongestStep = 0.25;

glm::dvec3 vectorAt(const float* v) {
    return {v[0], v[1], v[2]};
}

/// What points count by: a quad, a triangle, or of a face of more sides the triangle of a side and the middle.
struct Piece {
    uint32_t face = 0, side = 0;
    bool isQuad = false;

    [[nodiscard]] SuppleSurfacePoint at(double a, double b) const {
        return {face, side, static_cast<float>(a), static_cast<float>(b)};
    }
};
std::vector<Piece> piecesOf(const CpuGroup& group) {
    std::vector<Piece> pieces;
    const cage::Cage& cage = group.cage();
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const uint32_t sides = cage.sides(face);
        for (uint32_t side = 0; side < (sides > 4 ? sides : 1); ++side) {
            const Piece piece{face, side, sides == 4};
            if (group.find(piece.at(0.25, 0.25)).place.fault == nullptr) { // not a hole
                pieces.push_back(piece);
            }
        }
    }
    return pieces;
}

/// Cells of a piece: squares, or triangles in triangles.
struct Cell {
    glm::dvec2 origin{0.0}, x{0.0}, y{0.0};
};
std::vector<Cell> cellsOf(bool isQuad, uint32_t along) {
    const double width = 1.0 / along;
    std::vector<Cell> cells;
    for (uint32_t j = 0; j < along; ++j) {
        for (uint32_t i = 0; i < (isQuad ? along : along - j); ++i) {
            const glm::dvec2 origin(i * width, j * width), x(width, 0.0), y(0.0, width);
            cells.push_back({origin, x, y});
            if (!isQuad && i + j + 1 < along) { // the one that is turned
                cells.push_back({origin + x + y, -x, -y});
            }
        }
    }
    return cells;
}

/// Takes the nearest of many points, by a tree that halves them along the longest side of their box.
class SeedTree {
public:
    struct Seed {
        glm::dvec3 position{0.0};
        uint32_t piece = 0;
        double a = 0.0, b = 0.0;
    };
    explicit SeedTree(std::vector<Seed> seeds) : seeds_(std::move(seeds)), axes_(seeds_.size(), 0) {
        split(0, seeds_.size());
    }

    /// The nearest, in rising order of their distance.
    [[nodiscard]] std::vector<Seed> nearest(const glm::dvec3& to) const {
        std::vector<std::pair<double, size_t>> best;
        search(0, seeds_.size(), to, best);
        std::vector<Seed> found;
        for (const auto& [distance, seed] : best) {
            found.push_back(seeds_[seed]);
        }
        return found;
    }

private:
    void split(size_t begin, size_t end) {
        if (end - begin < 2) {
            return;
        }
        glm::dvec3 low = seeds_[begin].position, high = low;
        for (size_t k = begin; k < end; ++k) {
            low = glm::min(low, seeds_[k].position);
            high = glm::max(high, seeds_[k].position);
        }
        const glm::dvec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const size_t middle = (begin + end) / 2;
        const auto at = [&](size_t k) { return seeds_.begin() + static_cast<ptrdiff_t>(k); };
        std::nth_element(at(begin), at(middle), at(end),
                         [&](const Seed& x, const Seed& y) { return x.position[axis] < y.position[axis]; });
        axes_[middle] = static_cast<uint8_t>(axis);
        split(begin, middle);
        split(middle + 1, end);
    }
    void search(size_t begin, size_t end, const glm::dvec3& to, std::vector<std::pair<double, size_t>>& best) const {
        if (begin == end) {
            return;
        }
        const size_t middle = (begin + end) / 2;
        const glm::dvec3 offset = seeds_[middle].position - to;
        const std::pair<double, size_t> own(glm::dot(offset, offset), middle);
        best.insert(std::upper_bound(best.begin(), best.end(), own), own);
        best.resize(std::min(best.size(), kSeeds));
        const double apart = offset[axes_[middle]]; // negative: the point lies behind the plane
        const auto visit = [&](bool below) {
            below ? search(begin, middle, to, best) : search(middle + 1, end, to, best);
        };
        visit(apart > 0.0);
        if (best.size() < kSeeds || apart * apart < best.back().first) {
            visit(apart <= 0.0);
        }
    }

    std::vector<Seed> seeds_;
    std::vector<uint8_t> axes_; ///< of the seed in the middle of a range
};

/// Newton's method for the distance, held to a piece.
class NearestInPiece {
public:
    NearestInPiece(const CpuPose& pose, const Piece& piece, const glm::dvec3& to)
        : pose_(pose), piece_(piece), to_(to) {}

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
                Found next = held(best.a + step.x, best.b + step.y);
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
        const SuppleSurfacePoint point = piece_.at(place.a, place.b);
        SuppleSurfaceJet jet;
        const Status evaluated = pose_.evaluate({&point, 1}, &jet, {});
        return evaluated ? Result<SuppleSurfaceJet>(jet) : evaluated.error();
    }
    [[nodiscard]] double distanceOf(const SuppleSurfaceJet& jet) const {
        const glm::dvec3 e = vectorAt(jet.position) - to_;
        return glm::dot(e, e);
    }
    [[nodiscard]] Found held(double a, double b) const {
        a = std::clamp(a, 0.0, 1.0);
        b = std::clamp(b, 0.0, 1.0);
        if (!piece_.isQuad && a + b > 1.0) { // straight to the slant
            const double over = 0.5 * (a + b - 1.0);
            a = std::clamp(a - over, 0.0, 1.0);
            b = 1.0 - a;
        }
        return {a, b, 0.0};
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
        const bool holdsA = (at.a <= 0.0 && g.x > 0.0) || (piece_.isQuad && at.a >= 1.0 && g.x < 0.0);
        const bool holdsB = (at.b <= 0.0 && g.y > 0.0) || (piece_.isQuad && at.b >= 1.0 && g.y < 0.0);
        const bool onSlant = !piece_.isQuad && at.a + at.b >= 1.0 && g.x + g.y < 0.0;
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
    const Piece& piece_;
    glm::dvec3 to_;
};

/// All cells of all pieces, with the jets at their middles.
Status forEachCell(const CpuPose& pose, std::span<const Piece> pieces, uint32_t along,
                   const std::function<void(uint32_t piece, const Cell&, const SuppleSurfaceJet&)>& visit) {
    const std::array<std::vector<Cell>, 2> cells{cellsOf(false, along), cellsOf(true, along)};
    for (uint32_t p = 0; p < pieces.size(); ++p) {
        const std::vector<Cell>& own = cells[pieces[p].isQuad ? 1 : 0];
        const double middle = pieces[p].isQuad ? 0.5 : 1.0 / 3.0;
        std::vector<SuppleSurfacePoint> points;
        for (const Cell& cell : own) {
            const glm::dvec2 at = cell.origin + middle * (cell.x + cell.y);
            points.push_back(pieces[p].at(at.x, at.y));
        }
        std::vector<SuppleSurfaceJet> jets(points.size());
        if (Status evaluated = pose.evaluate(points, jets.data(), {}); !evaluated) {
            return evaluated;
        }
        for (size_t k = 0; k < own.size(); ++k) {
            visit(p, own[k], jets[k]);
        }
    }
    return success();
}

Status findNearest(const CpuPose& pose, std::span<const Piece> pieces, const float* positions,
                   std::span<SuppleSurfacePoint> out) {
    std::vector<SeedTree::Seed> seeds;
    const Status made =
        forEachCell(pose, pieces, kSeedsAlong, [&](uint32_t p, const Cell& cell, const SuppleSurfaceJet& jet) {
            const glm::dvec2 at = cell.origin + (pieces[p].isQuad ? 0.5 : 1.0 / 3.0) * (cell.x + cell.y);
            seeds.push_back({vectorAt(jet.position), p, at.x, at.y});
        });
    if (!made) {
        return made;
    }
    const SeedTree tree(std::move(seeds));
    for (size_t k = 0; k < out.size(); ++k) {
        const glm::dvec3 to = vectorAt(positions + 3 * k);
        double least = std::numeric_limits<double>::infinity();
        for (const SeedTree::Seed& seed : tree.nearest(to)) {
            const auto found = NearestInPiece(pose, pieces[seed.piece], to).from(seed.a, seed.b);
            if (!found) {
                return found.error();
            }
            const Piece& piece = pieces[seed.piece];
            const bool tied = found->distance == least && piece.face < out[k].face;
            if (found->distance < least || tied) {
                least = found->distance;
                out[k] = piece.at(found->a, found->b);
            }
        }
    }
    return success();
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

Status scatter(const CpuPose& pose, std::span<const Piece> pieces, uint32_t seed, std::span<SuppleSurfacePoint> out) {
    struct Area {
        uint32_t piece = 0;
        Cell cell;
        double end = 0.0; ///< of the running sum
    };
    std::vector<Area> areas;
    double sum = 0.0;
    const Status made =
        forEachCell(pose, pieces, kSeedsAlong, [&](uint32_t p, const Cell& cell, const SuppleSurfaceJet& jet) {
            sum += glm::length(glm::cross(vectorAt(jet.du), vectorAt(jet.dv))) * (pieces[p].isQuad ? 1.0 : 0.5);
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
        if (!pieces[area->piece].isQuad && x + y > 1.0) {
            x = 1.0 - x;
            y = 1.0 - y;
        }
        const glm::dvec2 at = area->cell.origin + x * area->cell.x + y * area->cell.y;
        out[k] = pieces[area->piece].at(at.x, at.y);
    }
    return success();
}

/// The texture coordinates of a piece's corners.
class PieceUvs {
public:
    PieceUvs(const cage::Cage& cage, std::span<const glm::vec2> uvs, const Piece& piece) {
        const uint32_t first = cage.faceStarts[piece.face], sides = cage.sides(piece.face);
        const auto corner = [&](uint32_t k) { return glm::dvec2(uvs[first + k % sides]); };
        if (sides <= 4) {
            count_ = sides;
            for (uint32_t k = 0; k < sides; ++k) {
                corners_[k] = corner(k);
            }
            return;
        }
        corners_ = {corner(piece.side), corner(piece.side + 1), {}, {}};
        for (uint32_t k = 0; k < sides; ++k) {
            corners_[2] += corner(k) / static_cast<double>(sides);
        }
    }

    /// The numbers of the point that has the coordinates, if the piece covers them.
    [[nodiscard]] std::optional<glm::dvec2> find(const glm::dvec2& uv) const {
        const auto [low, high] = box();
        if (uv.x < low.x || uv.y < low.y || uv.x > high.x || uv.y > high.y) {
            return std::nullopt;
        }
        return count_ == 4 ? inQuad(uv - corners_[0]) : inTriangle(uv - corners_[0]);
    }

private:
    static double crossOf(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }
    static bool isIn(double t) { return t >= -1e-9 && t <= 1.0 + 1e-9; }
    [[nodiscard]] std::pair<glm::dvec2, glm::dvec2> box() const {
        glm::dvec2 low = corners_[0], high = low;
        for (uint32_t k = 1; k < count_; ++k) {
            low = glm::min(low, corners_[k]);
            high = glm::max(high, corners_[k]);
        }
        return {low, high};
    }
    [[nodiscard]] std::optional<glm::dvec2> inTriangle(const glm::dvec2& h) const {
        const glm::dvec2 x = corners_[1] - corners_[0], y = corners_[2] - corners_[0];
        const double area = crossOf(x, y), a = crossOf(h, y) / area, b = crossOf(x, h) / area;
        return isIn(a) && isIn(b) && a + b <= 1.0 + 1e-9 ? std::optional(glm::dvec2(a, b)) : std::nullopt;
    }
    /// h = u e + v f + u v g, by the quadratic for v in its stable form.
    [[nodiscard]] std::optional<glm::dvec2> inQuad(const glm::dvec2& h) const {
        const glm::dvec2 e = corners_[1] - corners_[0], f = corners_[3] - corners_[0],
                         g = (corners_[0] - corners_[1]) + (corners_[2] - corners_[3]);
        const double k2 = crossOf(g, f), k1 = crossOf(e, f) + crossOf(h, g), k0 = crossOf(h, e);
        const double root = k1 * k1 - 4.0 * k2 * k0;
        if (!(root >= 0.0)) {
            return std::nullopt;
        }
        const double s = -0.5 * (k1 + std::copysign(std::sqrt(root), k1));
        for (const double v : {k0 / s, s / k2}) {
            const glm::dvec2 across = e + v * g, rest = h - v * f;
            const double u = std::abs(across.x) > std::abs(across.y) ? rest.x / across.x : rest.y / across.y;
            if (isIn(u) && isIn(v)) {
                return glm::dvec2(u, v);
            }
        }
        return std::nullopt;
    }

    std::array<glm::dvec2, 4> corners_{};
    uint32_t count_ = 3;
};

Status findUvs(const CpuGroup& group, std::span<const Piece> pieces, const SupplePointQuery& query,
               std::span<SuppleSurfacePoint> out) {
    const cage::Cage& cage = group.cage();
    const std::vector<glm::vec2>& uvs = query.uvSet == 0 ? cage.cornerUvs : cage.cornerUvs1;
    if (uvs.empty()) {
        return Error{ErrorCode::range, "the character has no UV set " + std::to_string(query.uvSet)};
    }
    std::vector<PieceUvs> covers;
    covers.reserve(pieces.size());
    for (const Piece& piece : pieces) {
        covers.emplace_back(cage, uvs, piece);
    }
    for (size_t k = 0; k < out.size(); ++k) {
        const glm::dvec2 uv(query.values[2 * k], query.values[2 * k + 1]);
        out[k] = {SUPPLE_NO_FACE, 0, 0.0f, 0.0f};
        for (size_t p = 0; p < pieces.size() && out[k].face == SUPPLE_NO_FACE; ++p) {
            if (const std::optional<glm::dvec2> at = covers[p].find(uv)) {
                out[k] = pieces[p].at(std::clamp(at->x, 0.0, 1.0), std::clamp(at->y, 0.0, 1.0));
            }
        }
    }
    return success();
}

} // namespace

Status findPoints(const std::shared_ptr<const CpuGroup>& group, const SupplePointQuery& query,
                  std::span<SuppleSurfacePoint> out) {
    const std::vector<Piece> pieces = piecesOf(*group);
    if (pieces.empty()) {
        return Error{ErrorCode::argument, "the surfaces have no faces"};
    }
    if (query.kind == SUPPLE_FIND_UV) {
        return findUvs(*group, pieces, query, out);
    }
    const cage::Cage& cage = group->cage();
    if (query.cage != nullptr && query.cageVertexCount != cage.vertexCount()) {
        return Error{ErrorCode::range, std::to_string(query.cageVertexCount) + " vertices for a cage of " +
                                           std::to_string(cage.vertexCount())};
    }
    CpuPose pose(group);
    const void* const positions = query.cage != nullptr ? static_cast<const void*>(query.cage) : cage.positions.data();
    if (Status built = pose.build(static_cast<const std::byte*>(positions), sizeof(glm::vec3), {}); !built) {
        return built;
    }
    return query.kind == SUPPLE_FIND_NEAREST ? findNearest(pose, pieces, query.values, out)
                                             : scatter(pose, pieces, query.seed, out);
}

} // namespace supple::runtime
