#include "tools/supple/limit_surface.h"

#include "cage/features.h"
#include "tools/reference/fragments.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <nanoflann.hpp>
#include <optional>

namespace supple::tools {
namespace {

namespace subdivision = surface::subdivision;

/// Points computed, of which few are kept; and points kept, 36 bytes each.
constexpr uint64_t kWantedSamples = 120'000'000;
constexpr uint64_t kMostPoints = 40'000'000;
constexpr uint32_t kFewestSteps = 3; ///< half of its points must still carry a cubic
constexpr uint32_t kMostSteps = 6;
/// Segments of a side: of a sector whose surface is bicubic, and the most of one that is so piece by piece towards its
/// corner. Beside semi-sharp creases the pieces are strips, and all points are kept.
enum class Kind : uint8_t { regular, irregular, semiSharp };
constexpr uint32_t kRegularSegments = 8;
constexpr uint32_t kIrregularSegments = 16;
/// Points of a sector's side that the tree holds: enough for Newton's method to start in the right place.
constexpr uint32_t kTreeSegments = 8;
constexpr size_t kStarts = 12; ///< nearest points looked at
/// Points are equally near whose distances differ by less than this fraction of the cage's extent: float's rounding.
constexpr double kTie = 1e-6;

/// The cage's faces round each face, the face itself among them.
struct Neighbourhoods {
    struct Neighbour {
        uint32_t face = 0;
        bool sameSide = false; ///< reached round a common vertex without crossing a hard crease
    };
    std::vector<uint32_t> starts{0};
    std::vector<Neighbour> neighbours;
    std::vector<uint8_t> creased; ///< per face: some neighbour is on the other side

    [[nodiscard]] std::span<const Neighbour> of(uint32_t face) const {
        return std::span(neighbours).subspan(starts[face], starts[face + 1] - starts[face]);
    }
};

Neighbourhoods neighbourhoods(const cage::Cage& cage, const cage::Topology& topology) {
    const cage::Features features = cage::buildFeatures(cage, topology);
    Neighbourhoods result;
    std::vector<Neighbourhoods::Neighbour> found;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        found.assign(1, {face, true});
        for (uint32_t corner = cage.faceStarts[face]; corner < cage.faceStarts[face + 1]; ++corner) {
            const uint32_t vertex = cage.faceVertices[corner];
            const uint32_t first = topology.spokeStarts[vertex];
            const uint32_t sectors = topology.sectorCount(vertex), spokes = topology.spokeCount(vertex);
            const uint32_t own = topology.cornerSpokes[corner] - first;
            const auto faceAt = [&](uint32_t sector) {
                return topology.cornerFaces[topology.sectorCorners[first + sector]];
            };
            for (uint32_t sector = 0; sector < sectors; ++sector) {
                found.push_back({faceAt(sector), false});
            }
            // Counter-clockwise from sector k one crosses spoke k + 1, clockwise spoke k; an open fan's end has no face
            // behind it.
            const auto crosses = [&](uint32_t spoke) {
                const bool end = topology.boundary[vertex] != 0 && (spoke == 0 || spoke == sectors);
                return !end && !features.hard(cage::spokeEdge(cage, topology, first + spoke % spokes));
            };
            for (uint32_t k = 1, at = own; k < sectors && crosses(at + 1); ++k) {
                at = (at + 1) % sectors;
                found.push_back({faceAt(at), true});
            }
            for (uint32_t k = 1, at = own; k < sectors && crosses(at); ++k) {
                at = (at + sectors - 1) % sectors;
                found.push_back({faceAt(at), true});
            }
        }
        std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
            return a.face != b.face ? a.face < b.face : a.sameSide && !b.sameSide;
        });
        found.erase(
            std::unique(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.face == b.face; }),
            found.end());
        result.creased.push_back(
            std::any_of(found.begin(), found.end(), [](const auto& n) { return !n.sameSide; }) ? 1 : 0);
        result.neighbours.insert(result.neighbours.end(), found.begin(), found.end());
        result.starts.push_back(static_cast<uint32_t>(result.neighbours.size()));
    }
    return result;
}

/// Lagrange's cubic through four neighbouring points of a row at `at` (in segments): the first of them, weights of the
/// value and of its derivative.
struct Cubic {
    uint32_t first = 0;
    std::array<double, 4> value{}, slope{};
};

Cubic cubicAt(double at, uint32_t segments) {
    Cubic cubic;
    cubic.first = static_cast<uint32_t>(std::clamp(std::floor(at) - 1.0, 0.0, static_cast<double>(segments - 3)));
    const double t = at - cubic.first;
    const double a = t, b = t - 1.0, c = t - 2.0, d = t - 3.0;
    cubic.value = {-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0};
    cubic.slope = {-(c * d + b * d + b * c) / 6.0, (c * d + a * d + a * c) / 2.0, -(b * d + a * d + a * b) / 2.0,
                   (b * c + a * c + a * b) / 6.0};
    return cubic;
}

/// Per face of the isolated level.
std::vector<Kind> kindsOf(const subdivision::Mesh& mesh) {
    std::vector<Kind> kinds(mesh.cage.faceCount(), Kind::regular);
    for (const subdivision::Fragment& fragment : mesh.fragments) {
        const auto spokes = std::span(mesh.spokeSharpness).subspan(fragment.firstSpoke, fragment.spokes());
        const auto semiSharp = [](float s) { return s > 0.0f && s < surface::kInfiniteSharpness; };
        const auto smooth = [](float s) { return s == 0.0f; };
        Kind kind = Kind::irregular;
        if (semiSharp(fragment.centreSharpness) || std::any_of(spokes.begin(), spokes.end(), semiSharp)) {
            kind = Kind::semiSharp;
        } else if (fragment.sectors == 4 && !fragment.open && smooth(fragment.centreSharpness) &&
                   std::all_of(spokes.begin(), spokes.end(), smooth)) {
            kind = Kind::regular;
        }
        for (uint32_t h = 0; h < fragment.sectors; ++h) {
            kinds[mesh.sectorFaces[fragment.firstSector + h]] = kind;
        }
    }
    return kinds;
}

} // namespace

struct LimitSurface::Data {
    /// What nanoflann asks of a set of points.
    struct Cloud {
        const Data& data;
        [[nodiscard]] size_t kdtree_get_point_count() const {
            return data.sectors.size() * (kTreeSegments + 1) * (kTreeSegments + 1);
        }
        [[nodiscard]] double kdtree_get_pt(size_t index, size_t axis) const {
            return data.positions[data.treePoint(static_cast<uint32_t>(index)).index][static_cast<int>(axis)];
        }
        template <class Box>
        bool kdtree_get_bbox(Box& /*box*/) const {
            return false;
        }
    };
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, uint32_t>;

    /// A face of the isolated level. Towards its corner 0, where alone it may be irregular, further grids of as many
    /// segments each follow, over half the side of the one before.
    struct Sector {
        uint32_t face = 0; ///< of the cage
        uint32_t segments = 0;
        uint32_t levels = 1;
        size_t first = 0; ///< point
        [[nodiscard]] size_t gridPoints() const { return size_t{segments + 1} * (segments + 1); }
    };
    struct TreePoint {
        uint32_t sector = 0, i = 0, j = 0;
        size_t index = 0; ///< into positions
    };

    std::vector<Sector> sectors;
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    Neighbourhoods around;
    double extent = 0.0;
    Cloud cloud{*this};
    std::unique_ptr<Tree> tree;

    [[nodiscard]] TreePoint treePoint(uint32_t index) const {
        constexpr uint32_t kSide = kTreeSegments + 1;
        TreePoint point;
        point.sector = index / (kSide * kSide);
        const Sector& sector = sectors[point.sector];
        const uint32_t stride = sector.segments / kTreeSegments;
        point.i = index % kSide * stride;
        point.j = index / kSide % kSide * stride;
        point.index = sector.first + size_t{point.j} * (sector.segments + 1) + point.i;
        return point;
    }

    /// The finest grid that has the place, and the place in that grid's segments.
    struct Place {
        size_t first = 0;
        double u = 0.0, v = 0.0, scale = 1.0;
    };
    [[nodiscard]] static Place place(const Sector& sector, double u, double v) {
        Place place{sector.first, u, v, 1.0};
        for (uint32_t level = 1; level < sector.levels && 2.0 * std::max(place.u, place.v) <= sector.segments;
             ++level) {
            place.first += sector.gridPoints();
            place.u *= 2.0;
            place.v *= 2.0;
            place.scale *= 2.0;
        }
        return place;
    }

    struct Point {
        glm::dvec3 position{0.0}, du{0.0}, dv{0.0};
    };
    /// Through every stride-th point of a grid; u and v in steps of as many segments.
    [[nodiscard]] Point onGrid(size_t first, uint32_t segments, double u, double v, uint32_t stride) const {
        const Cubic cu = cubicAt(u, segments / stride), cv = cubicAt(v, segments / stride);
        Point point;
        for (uint32_t j = 0; j < 4; ++j) {
            const size_t row = first + size_t{cv.first + j} * stride * (segments + 1);
            glm::dvec3 value(0.0), slope(0.0);
            for (uint32_t i = 0; i < 4; ++i) {
                const glm::dvec3& p = positions[row + size_t{cu.first + i} * stride];
                value += cu.value[i] * p;
                slope += cu.slope[i] * p;
            }
            point.position += cv.value[j] * value;
            point.du += cv.value[j] * slope;
            point.dv += cv.slope[j] * value;
        }
        return point;
    }
    /// `stride` 2: the surface as it would be through every second point.
    [[nodiscard]] Point at(const Sector& sector, double u, double v, uint32_t stride = 1) const {
        const Place where = place(sector, u, v);
        Point point = onGrid(where.first, sector.segments, where.u / stride, where.v / stride, stride);
        point.du *= where.scale / stride;
        point.dv *= where.scale / stride;
        return point;
    }
    [[nodiscard]] glm::dvec3 normalAt(const Sector& sector, double u, double v) const {
        const Place where = place(sector, u, v);
        const Cubic cu = cubicAt(where.u, sector.segments), cv = cubicAt(where.v, sector.segments);
        glm::dvec3 normal(0.0);
        for (uint32_t j = 0; j < 4; ++j) {
            const size_t row = where.first + size_t{cv.first + j} * (sector.segments + 1);
            for (uint32_t i = 0; i < 4; ++i) {
                normal += cv.value[j] * cu.value[i] * glm::dvec3(normals[row + cu.first + i]);
            }
        }
        return normal;
    }

    void add(const subdivision::SectorGrid<double>& grid, uint32_t face, uint32_t steps, Kind kind) {
        const uint32_t all = 1u << steps;
        Sector sector;
        sector.face = face;
        sector.segments = kind == Kind::regular     ? std::min(kRegularSegments, all)
                          : kind == Kind::irregular ? std::min(kIrregularSegments, all)
                                                    : all;
        sector.levels = kind == Kind::irregular ? static_cast<uint32_t>(std::bit_width(all / sector.segments)) : 1;
        sector.first = positions.size();
        const uint32_t row = all + 1;
        for (uint32_t level = 0; level < sector.levels; ++level) {
            const uint32_t stride = all / sector.segments >> level;
            for (uint32_t j = 0; j <= sector.segments; ++j) {
                for (uint32_t i = 0; i <= sector.segments; ++i) {
                    const subdivision::Sample<double>& sample =
                        grid.samples[size_t{j} * stride * row + size_t{i} * stride];
                    positions.push_back(sample.position);
                    normals.emplace_back(sample.normal);
                }
            }
        }
        sectors.push_back(sector);
    }

    /// The point of a sector that is nearest to another.
    struct Foot {
        double u = 0.0, v = 0.0;
        double distance = std::numeric_limits<double>::max();
    };
    /// Gauss-Newton within the sector from a place in it; at its border along it.
    [[nodiscard]] Foot project(const Sector& sector, double u, double v, const glm::dvec3& p,
                               uint32_t stride = 1) const {
        constexpr int kSteps = 30;
        const double side = sector.segments;
        Point here = at(sector, u, v, stride);
        Foot foot{u, v, glm::distance(here.position, p)};
        for (int step = 0; step < kSteps; ++step) {
            const glm::dvec3 r = p - here.position;
            const double ru = glm::dot(r, here.du), rv = glm::dot(r, here.dv);
            const bool stuckU = (foot.u <= 0.0 && ru < 0.0) || (foot.u >= side && ru > 0.0);
            const bool stuckV = (foot.v <= 0.0 && rv < 0.0) || (foot.v >= side && rv > 0.0);
            const double uu = glm::dot(here.du, here.du), vv = glm::dot(here.dv, here.dv),
                         uv = glm::dot(here.du, here.dv);
            const double determinant = uu * vv - uv * uv;
            double du = 0.0, dv = 0.0;
            if (!stuckU && !stuckV && determinant > 1e-12 * uu * vv) {
                du = (vv * ru - uv * rv) / determinant;
                dv = (uu * rv - uv * ru) / determinant;
            } else {
                du = stuckU || uu == 0.0 ? 0.0 : ru / uu;
                dv = stuckV || vv == 0.0 ? 0.0 : rv / vv;
            }
            // A step that leads away from the point is halved; one that is nothing in double's terms ends the search.
            bool nearer = false;
            for (int halving = 0; halving < 8 && !nearer; ++halving, du *= 0.5, dv *= 0.5) {
                Foot next{std::clamp(foot.u + du, 0.0, side), std::clamp(foot.v + dv, 0.0, side), 0.0};
                if (std::abs(next.u - foot.u) + std::abs(next.v - foot.v) < 1e-10) {
                    break;
                }
                const Point there = at(sector, next.u, next.v, stride);
                next.distance = glm::distance(there.position, p);
                if (next.distance < foot.distance) {
                    foot = next;
                    here = there;
                    nearer = true;
                }
            }
            if (!nearer) {
                break;
            }
        }
        return foot;
    }
};

LimitSurface::LimitSurface(std::unique_ptr<Data> data) : data_(std::move(data)) {}
LimitSurface::LimitSurface(LimitSurface&&) noexcept = default;
LimitSurface::~LimitSurface() = default;

Result<LimitSurface> LimitSurface::build(const cage::Cage& cage, std::span<const glm::dvec3> positions) {
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    if (!topology) {
        return topology.error();
    }
    const Result<subdivision::Mesh> mesh = subdivision::buildMesh(cage, subdivision::Subdivision::catmullClark);
    if (!mesh) {
        return mesh.error();
    }
    auto data = std::make_unique<Data>();
    const uint64_t sectors = mesh->sectorFaces.size();
    const auto samples = [&](uint32_t steps) { return sectors * ((1u << steps) + 1) * ((1u << steps) + 1); };
    uint32_t steps = kMostSteps;
    while (steps > kFewestSteps && samples(steps) > kWantedSamples) {
        --steps;
    }
    if (samples(kFewestSteps) > kMostPoints) {
        return Error{ErrorCode::limit, std::to_string(cage.faceCount()) + " faces are too many to compare"};
    }
    const std::vector<Kind> kinds = kindsOf(*mesh);
    const std::vector<glm::dvec3> isolated = subdivision::isolate<double>(*mesh, positions);
    subdivision::forEachSector<double>(*mesh, isolated, steps, [&](const subdivision::SectorGrid<double>& grid) {
        if (!std::binary_search(mesh->cage.holes.begin(), mesh->cage.holes.end(), grid.face)) {
            data->add(grid, mesh->sourceFaces[grid.face], steps, kinds[grid.face]);
        }
    });
    if (data->sectors.empty()) {
        return Error{ErrorCode::asset, "all faces are holes"};
    }
    glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
    for (const glm::dvec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    data->extent = glm::distance(low, high);
    data->around = neighbourhoods(cage, *topology);
    data->tree = std::make_unique<Data::Tree>(3, data->cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16));
    data->tree->buildIndex();
    return LimitSurface(std::move(data));
}

struct LimitSurface::Probe::State {
    explicit State(const Data& of) : data(of), marks(of.around.creased.size(), 0) {}

    enum Mark : uint8_t { kElsewhere = 0, kOtherSide = 1, kSameSide = 2 };

    const Data& data;
    std::vector<uint8_t> marks; ///< per face of the cage: Mark
    uint32_t marked = std::numeric_limits<uint32_t>::max();

    struct Hit : Data::Foot {
        uint32_t sector = 0;
    };
    std::vector<Hit> hits; ///< one a sector that was tried

    /// Keeps the nearest points whose faces are marked at least so.
    struct NearestMarked {
        using DistanceType = double;
        using IndexType = uint32_t;

        const State& state;
        uint8_t mark;
        size_t count = 0;
        std::array<std::pair<double, uint32_t>, kStarts> found{};

        [[nodiscard]] size_t size() const { return count; }
        [[nodiscard]] bool full() const { return count == kStarts; }
        [[nodiscard]] double worstDist() const {
            return full() ? found.back().first : std::numeric_limits<double>::max();
        }
        bool addPoint(double distance, uint32_t index) {
            const uint32_t face = state.data.sectors[state.data.treePoint(index).sector].face;
            if (state.marks[face] < mark || distance >= worstDist()) {
                return true;
            }
            size_t place = full() ? kStarts - 1 : count++;
            for (; place > 0 && found[place - 1].first > distance; --place) {
                found[place] = found[place - 1];
            }
            found[place] = {distance, index};
            return true;
        }
        void sort() const {} ///< later versions of nanoflann ask for it
    };

    void markRound(uint32_t face) {
        if (face == marked) {
            return;
        }
        if (marked < marks.size()) {
            for (const Neighbourhoods::Neighbour& n : data.around.of(marked)) {
                marks[n.face] = kElsewhere;
            }
        }
        for (const Neighbourhoods::Neighbour& n : data.around.of(face)) {
            marks[n.face] = n.sameSide ? kSameSide : kOtherSide;
        }
        marked = face;
    }

    /// Fills `hits` with the sectors about p whose faces are marked at least `mark`; returns the nearest.
    Hit search(const glm::dvec3& p, uint8_t mark) {
        hits.clear();
        Hit best;
        glm::dvec3 from = p;
        // The nearest grid point may lie on another sector than the nearest point: where the search ends on a border
        // it goes on across it.
        for (int round = 0; round < 4; ++round) {
            NearestMarked nearest{*this, mark};
            data.tree->findNeighbors(nearest, &from[0], {});
            std::optional<Hit> improved;
            for (size_t k = 0; k < nearest.count; ++k) {
                const Data::TreePoint start = data.treePoint(nearest.found[k].second);
                if (std::any_of(hits.begin(), hits.end(), [&](const Hit& h) { return h.sector == start.sector; })) {
                    continue;
                }
                hits.push_back({data.project(data.sectors[start.sector], start.i, start.j, p), start.sector});
                if (hits.back().distance < best.distance) {
                    best = hits.back();
                    improved = hits.back();
                }
            }
            if (!improved) {
                break;
            }
            const Data::Sector& sector = data.sectors[improved->sector];
            const double side = sector.segments;
            if (improved->u > 0.0 && improved->u < side && improved->v > 0.0 && improved->v < side) {
                break;
            }
            from = data.at(sector, improved->u, improved->v).position;
        }
        return best;
    }
};

LimitSurface::Probe::Probe(const LimitSurface& surface) : state_(std::make_unique<State>(*surface.data_)) {}
LimitSurface::Probe::~Probe() = default;

LimitSurface::Deviation LimitSurface::Probe::measure(uint32_t face, const glm::dvec3& position,
                                                     const glm::dvec3& normal, bool withDoubt) {
    State& state = *state_;
    state.markRound(face);
    Deviation deviation;
    const State::Hit hit = state.search(position, State::kOtherSide);
    deviation.distance = hit.distance;
    if (withDoubt) {
        const auto coarser = state.data.project(state.data.sectors[hit.sector], hit.u, hit.v, position, 2);
        deviation.doubt = std::abs(coarser.distance - hit.distance);
    }
    double nearest = hit.distance;
    if (state.data.around.creased[face] != 0) {
        nearest = state.search(position, State::kSameSide).distance;
    }
    deviation.degrees = -1.0;
    for (const State::Hit& near : state.hits) {
        const glm::dvec3 own = state.data.normalAt(state.data.sectors[near.sector], near.u, near.v);
        if (near.distance > nearest + kTie * state.data.extent || glm::dot(own, own) == 0.0 ||
            glm::dot(normal, normal) == 0.0) {
            continue;
        }
        // Not by the arc cosine, which small angles are lost in.
        const double degrees =
            std::atan2(glm::length(glm::cross(normal, own)), glm::dot(normal, own)) * 180.0 / glm::pi<double>();
        deviation.degrees = deviation.degrees < 0.0 ? degrees : std::min(deviation.degrees, degrees);
    }
    return deviation;
}

} // namespace supple::tools
