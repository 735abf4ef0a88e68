// Tangents of surface vertices (docs/tangents.md) against differences of positions and texture coordinates, which know
// nothing of schemes; and their signs.
#include "cage/tangents.h"
#include "surface/grid.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/shared_assets.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/tangent_word.h"
#include "tests/support/test_view.h"
#include "tools/common/character_file.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <optional>
#include <span>

namespace supple::test {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * kDegrees;
}

/// All that a group's streams hold. Vertices of 24 bytes.
struct Streams {
    explicit Streams(const Crowd& crowd) {
        const SuppleVertexStreams streams = crowd.output().streams;
        vertices = as<float>(crowd.read(streams.vertices));
        attributes = as<float>(crowd.read(streams.attributes));
        tangents = as<uint32_t>(crowd.read(streams.tangents));
    }
    [[nodiscard]] glm::dvec3 position(size_t v) const {
        return {vertices[6 * v], vertices[6 * v + 1], vertices[6 * v + 2]};
    }
    [[nodiscard]] glm::dvec3 normal(size_t v) const {
        return {vertices[6 * v + 3], vertices[6 * v + 4], vertices[6 * v + 5]};
    }
    [[nodiscard]] glm::dvec2 uv(size_t v) const { return {attributes[4 * v], attributes[4 * v + 1]}; }

    std::vector<float> vertices, attributes;
    std::vector<uint32_t> tangents;
};

/// Where a neighbouring sample lies, in steps along two directions, the second to the left of the first.
using Neighbour = std::function<std::optional<size_t>(int along, int across)>;

/// Derivatives of the position and the texture coordinates in one direction, by differences of second order.
struct Slope {
    glm::dvec3 position{0.0};
    glm::dvec2 uv{0.0};
};
std::optional<Slope> slopeOf(const Streams& streams, const Neighbour& at, int along, int across, bool even) {
    const auto combine = [&](std::initializer_list<std::pair<int, double>> terms) -> std::optional<Slope> {
        Slope slope;
        for (const auto& [steps, weight] : terms) {
            const std::optional<size_t> v = at(steps * along, steps * across);
            if (!v) {
                return std::nullopt;
            }
            slope.position += weight * streams.position(*v);
            slope.uv += weight * streams.uv(*v);
        }
        return slope;
    };
    std::optional<Slope> slope = combine({{-1, -0.5}, {1, 0.5}});
    if (even) { // steps of one length
        slope = slope ? slope : combine({{0, -1.5}, {1, 2.0}, {2, -0.5}});
        return slope ? slope : combine({{0, 1.5}, {-1, -2.0}, {-2, 0.5}});
    }
    slope = slope ? slope : combine({{0, -1.0}, {1, 1.0}});
    return slope ? slope : combine({{0, 1.0}, {-1, -1.0}});
}

struct Measured {
    std::vector<double> degrees; ///< from the differences
    double fromPlane = 0.0;      ///< the largest angle out of the plane that the normal stands on
    uint32_t samples = 0, wrongSigns = 0, flat = 0;

    void add(const Streams& streams, size_t vertex, const Neighbour& at, bool even) {
        ++samples;
        const glm::dvec4 tangent = decodeTangent(streams.tangents[vertex]);
        const glm::dvec3 t(tangent);
        fromPlane = std::max(fromPlane, std::abs(90.0 - angleBetween(t, streams.normal(vertex))));
        const std::optional<Slope> a = slopeOf(streams, at, 1, 0, even), b = slopeOf(streams, at, 0, 1, even);
        if (!a || !b) {
            return;
        }
        const double det = a->uv.x * b->uv.y - a->uv.y * b->uv.x;
        const glm::dvec3 expected = -tangent.w * (b->uv.y * a->position - a->uv.y * b->position);
        const double scale =
            glm::length(a->position) * glm::length(b->uv) + glm::length(b->position) * glm::length(a->uv);
        if (!(glm::length(expected) > 1e-3 * scale) || std::abs(det) < 1e-2 * glm::length(a->uv) * glm::length(b->uv)) {
            ++flat; // no direction to speak of
            return;
        }
        wrongSigns += (det > 0.0) == (tangent.w > 0.0) ? 1 : 0;
        degrees.push_back(angleBetween(t, expected));
    }
    [[nodiscard]] double mean() const {
        double sum = 0.0;
        for (const double d : degrees) {
            sum += d;
        }
        return sum / static_cast<double>(degrees.size());
    }
    [[nodiscard]] double share(double most) const {
        return static_cast<double>(std::ranges::count_if(degrees, [&](double d) { return d <= most; })) /
               static_cast<double>(degrees.size());
    }
    void print(const std::string& what) const {
        std::printf("%s: %zu samples of %u, mean %.4f degrees, %.4f within 1, %.5f within 5, out of the plane by %.4f, "
                    "%u wrong signs, %u flat\n",
                    what.c_str(), degrees.size(), samples, mean(), share(1.0), share(5.0), fromPlane, wrongSigns, flat);
    }
};

/// Number of a grid's sample, if it is one (SuppleDomain). Of pentagons: in one sector.
std::optional<size_t> gridSample(SuppleDomain domain, int rate, int sector, int i, int j) {
    if (i < 0 || j < 0) {
        return std::nullopt;
    }
    if (domain == SUPPLE_DOMAIN_QUAD || domain == SUPPLE_DOMAIN_POLAR) {
        return i <= rate && j <= rate ? std::optional<size_t>(j * (rate + 1) + i) : std::nullopt;
    }
    if (domain == SUPPLE_DOMAIN_TRIANGLE) {
        return i + j <= rate ? std::optional<size_t>(j * (rate + 1) - j * (j - 1) / 2 + i) : std::nullopt;
    }
    return i + j < rate ? std::optional<size_t>(sector * rate * (rate + 1) / 2 + j * rate - j * (j - 1) / 2 + i)
                        : std::nullopt;
}

/// Measures the instance in slot 0, whose vertices are counted as attributes are.
Measured measureGrids(const Crowd& crowd) {
    const Streams streams(crowd);
    const SuppleGridOutput grid = crowd.output().grid;
    const int rate = static_cast<int>(grid.rate);
    Measured measured;
    for (uint32_t r = 0; r < grid.drawRangeCount; ++r) {
        const SuppleDrawRange& range = grid.drawRanges[r];
        const int sectors = range.domain == SUPPLE_DOMAIN_PENTAGON ? 5 : 1;
        for (uint32_t p = 0; p < range.patchCount; ++p) {
            const size_t own = range.firstVertex + size_t{p} * range.samplesPerPatch;
            for (int s = 0; s < sectors; ++s) {
                for (int j = 0; j <= rate; ++j) {
                    for (int i = 0; gridSample(range.domain, rate, s, i, j); ++i) {
                        const Neighbour at = [&](int along, int across) -> std::optional<size_t> {
                            const auto sample = gridSample(range.domain, rate, s, i + along, j + across);
                            return sample ? std::optional<size_t>(own + *sample) : std::nullopt;
                        };
                        measured.add(streams, *at(0, 0), at, true);
                    }
                }
            }
        }
    }
    return measured;
}

/// Texture coordinates that differ by face in size, direction and, with `mirrored`, hand.
cage::Cage withUvs(cage::Cage cage, bool mirrored = false) {
    cage.cornerUvs.clear();
    for (uint32_t f = 0; f + 1 < cage.faceStarts.size(); ++f) {
        const float turn = 0.7f * static_cast<float>(f), size = 1.0f + 0.1f * static_cast<float>(f % 5);
        const float hand = mirrored && f % 2 == 1 ? -1.0f : 1.0f;
        const uint32_t count = cage.faceStarts[f + 1] - cage.faceStarts[f];
        for (uint32_t k = 0; k < count; ++k) {
            const float angle = hand * 6.2831853f * (static_cast<float>(k) + 0.08f * static_cast<float>(k % 2)) /
                                static_cast<float>(count);
            cage.cornerUvs.emplace_back(size * std::cos(angle + turn), 0.8f * size * std::sin(angle + turn));
        }
    }
    return cage;
}

/// Texture coordinates that go on from face to face.
cage::Cage withMapOver(cage::Cage cage) {
    cage.cornerUvs.clear();
    for (const uint32_t v : cage.faceVertices) {
        const glm::vec3& p = cage.positions[v];
        cage.cornerUvs.emplace_back(p.x + 0.37f * p.z + 0.1f * p.y * p.y, p.y - 0.21f * p.z);
    }
    return cage;
}

struct TangentCase {
    const char* name;
    SuppleScheme scheme;
    cage::Cage (*cage)();
    double within5 = 0.997; ///< share of the samples within 5 degrees
};
cage::Cage roughBiped() {
    return perturbed(biped(), 0.08f, 3);
}
cage::Cage roughPolygons() {
    return perturbed(withMergedFaces(withCutQuads(biped(), 0.4, 5), 40, 7), 0.05f, 3);
}
cage::Cage creased() {
    return withRandomSharpness(roughPolygons(), 5);
}
const TangentCase kPatchCases[] = {
    {"prep", SUPPLE_SCHEME_PREP, roughBiped},
    {"pm", SUPPLE_SCHEME_PM, roughPolygons},
    {"pmPolar", SUPPLE_SCHEME_PM, [] { return cappedCylinder(7, 4); }},
    {"pmPentagons", SUPPLE_SCHEME_PM, dodecahedron},
    {"catmullClark", SUPPLE_SCHEME_CATMULL_CLARK, roughBiped},
    {"blend", SUPPLE_SCHEME_BLEND, roughBiped},
    {"loop", SUPPLE_SCHEME_LOOP, roughPolygons},
    {"loopCreased", SUPPLE_SCHEME_LOOP, creased, 0.993},
};
const TangentCase kFragmentCases[] = {
    {"fragments", SUPPLE_SCHEME_FRAGMENTS, roughPolygons},
    {"fragmentsCreased", SUPPLE_SCHEME_FRAGMENTS, creased, 0.993},
};

class Tangents : public CrowdContexts {};
class TangentsOf : public Tangents, public testing::WithParamInterface<TangentCase> {};
INSTANTIATE_TEST_SUITE_P(Patches, TangentsOf, testing::ValuesIn(kPatchCases),
                         [](const auto& param) { return std::string(param.param.name); });
INSTANTIATE_TEST_SUITE_P(Fragments, TangentsOf, testing::ValuesIn(kFragmentCases),
                         [](const auto& param) { return std::string(param.param.name); });
/// Fragments have no levels and no indexed mesh.
class TangentsOfPatches : public TangentsOf {};
INSTANTIATE_TEST_SUITE_P(Schemes, TangentsOfPatches, testing::ValuesIn(kPatchCases),
                         [](const auto& param) { return std::string(param.param.name); });

SuppleGroupDesc tangentDesc(SuppleAsset asset, SuppleScheme scheme, uint32_t rate) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = 1;
    desc.scheme = scheme;
    desc.rate = rate;
    desc.vertexFormat = SUPPLE_VERTEX_24;
    desc.flags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS;
    return desc;
}

void pose(Crowd& crowd) {
    crowd.pose(crowd.spawn(), SUPPLE_BIND_POSE, 0.0,
               glm::rotate(glm::scale(glm::mat4(1.0f), {1.0f, 1.3f, 0.8f}), 0.7f, glm::normalize(glm::vec3(1, 2, 3))));
    crowd.run();
}

TEST_P(TangentsOf, PointWhereTheSecondCoordinateStandsStill) {
    const ValidationGuard guard;
    const TangentCase& c = GetParam();
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        Crowd crowd(own, tangentDesc(own.createAsset(withUvs(c.cage())), c.scheme, 16));
        ASSERT_TRUE(crowd.valid());
        pose(crowd);
        const Measured measured = measureGrids(crowd);
        measured.print(std::string(c.name) + ", " + mappingName(mapping));
        EXPECT_LT(measured.mean(), 0.4);
        EXPECT_GT(measured.share(1.0), 0.93);
        EXPECT_GT(measured.share(5.0), c.within5);
        EXPECT_LT(measured.fromPlane, 0.02);
        EXPECT_EQ(measured.wrongSigns, 0u);
        EXPECT_LT(measured.flat, measured.samples / 20);
        (void)own.takeLines();
    }
}

glm::vec3 normalOf(std::span<const std::byte> vertex, SuppleVertexFormat format) {
    const std::span<const std::byte> own = vertex.subspan(sizeof(glm::vec3));
    glm::vec3 normal{0.0f};
    if (format == SUPPLE_VERTEX_24) {
        std::memcpy(&normal, own.data(), sizeof(normal));
        return normal;
    }
    uint32_t packed = 0;
    std::memcpy(&packed, own.data(), sizeof(packed));
    return decodeOctahedral(packed);
}

/// Positions to the bit. Normals may be rounded otherwise by another pipeline.
void expectSameVertices(std::span<const std::byte> a, std::span<const std::byte> b, SuppleVertexFormat format) {
    const size_t stride = format == SUPPLE_VERTEX_24 ? 24 : 16;
    ASSERT_EQ(a.size(), b.size());
    size_t positions = 0;
    double turned = 0.0;
    for (size_t v = 0; v + stride <= a.size(); v += stride) {
        positions += std::memcmp(&a[v], &b[v], sizeof(glm::vec3)) == 0 ? 0 : 1;
        turned = std::max(turned,
                          angleBetween(normalOf(a.subspan(v, stride), format), normalOf(b.subspan(v, stride), format)));
    }
    EXPECT_EQ(positions, 0u) << "of " << a.size() / stride;
    EXPECT_LT(turned, 0.01) << "degrees";
}

TEST_P(TangentsOf, CostNothingElse) {
    const ValidationGuard guard;
    const TangentCase& c = GetParam();
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        const SuppleAsset asset = own.createAsset(withUvs(c.cage()));
        for (const SuppleVertexFormat format : {SUPPLE_VERTEX_16, SUPPLE_VERTEX_24}) {
            SuppleGroupDesc desc = tangentDesc(asset, c.scheme, 5);
            desc.vertexFormat = format;
            // Which tangents would choose.
            desc.uvInterpolation = SUPPLE_UV_LINEAR_CORNERS_PLUS1;
            desc.flags |= SUPPLE_GROUP_MOTION;
            Crowd with(own, desc);
            desc.flags &= ~uint32_t{SUPPLE_GROUP_TANGENTS};
            Crowd without(own, desc);
            ASSERT_TRUE(with.valid() && without.valid());
            pose(with);
            pose(without);
            const SuppleVertexStreams a = with.output().streams, b = without.output().streams;
            EXPECT_EQ(a.tangents.stride, 4u);
            EXPECT_EQ(a.tangents.size / 4, a.vertices.size / a.vertices.stride);
            EXPECT_EQ(b.tangents.buffer, VkBuffer{VK_NULL_HANDLE});
            const size_t count = with.output().grid.vertexCount; // behind them is room between instances
            const auto bytes = [&](const Crowd& crowd, const SuppleBufferRange& range) {
                std::vector<std::byte> own = crowd.read(range);
                own.resize(count * range.stride);
                return own;
            };
            expectSameVertices(bytes(with, a.vertices), bytes(without, b.vertices), format);
            EXPECT_TRUE(bytes(with, a.attributes) == bytes(without, b.attributes));
            EXPECT_TRUE(bytes(with, a.previousPositions) == bytes(without, b.previousPositions));
        }
        (void)own.takeLines();
    }
}

/// Number of a level's sample, if it is one (SuppleGrid). Of rings: along side `side`, i to its end and j inwards.
std::optional<size_t> levelSample(SuppleGrid grid, int capacity, int side, int i, int j) {
    if (grid == SUPPLE_GRID_QUAD) {
        return gridSample(SUPPLE_DOMAIN_QUAD, capacity, 0, i, j);
    }
    const int sides = grid == SUPPLE_GRID_TRIANGLE_RINGS ? 3 : grid == SUPPLE_GRID_QUAD_RINGS ? 4 : 5;
    if (j < 0 || 2 * j > capacity - 1 || i < j || i > capacity - j) {
        return std::nullopt;
    }
    const int before = sides * j * (capacity + 1 - j), each = capacity - 2 * j;
    const int next = i == capacity - j ? (side + 1) % sides * each : side * each + i - j;
    return before + next;
}

Measured measureLevels(const Crowd& crowd) {
    const Streams streams(crowd);
    const SuppleLevelOutput levels = crowd.output().levels;
    const auto buckets = as<std::array<uint32_t, 4>>(crowd.read(levels.buckets));
    const auto records = as<std::array<uint32_t, 16>>(crowd.read(levels.patches));
    Measured measured;
    for (uint32_t d = 0; d < levels.drawCount; ++d) {
        const SuppleLevelDraw& draw = levels.draws[d];
        const int capacity = static_cast<int>(draw.capacity);
        const int sides = draw.grid == SUPPLE_GRID_QUAD             ? 1
                          : draw.grid == SUPPLE_GRID_TRIANGLE_RINGS ? 3
                          : draw.grid == SUPPLE_GRID_QUAD_RINGS     ? 4
                                                                    : 5;
        for (uint32_t p = 0; p < buckets[d][2]; ++p) {
            const auto& record = records[buckets[d][0] + p];
            for (int s = 0; record[0] != 0xFFFFFFFFu && s < sides; ++s) {
                for (int j = 0; j <= capacity; ++j) {
                    for (int i = 0; i <= capacity; ++i) {
                        const Neighbour at = [&](int along, int across) -> std::optional<size_t> {
                            const auto sample = levelSample(draw.grid, capacity, s, i + along, j + across);
                            return sample ? std::optional<size_t>(record[2] + *sample) : std::nullopt;
                        };
                        if (at(0, 0) && (sides == 1 || i < capacity - j)) {
                            measured.add(streams, *at(0, 0), at, false);
                        }
                    }
                }
            }
        }
    }
    return measured;
}

TEST_P(TangentsOfPatches, PointThereAtLevelsToo) {
    const ValidationGuard guard;
    const TangentCase& c = GetParam();
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        TestView view(own, 400000, SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_TANGENTS | SUPPLE_VIEW_MOTION);
        SuppleGroupDesc desc = tangentDesc(own.createAsset(withUvs(c.cage())), c.scheme, 0);
        desc.flags = 0;
        desc.view = view.handle();
        Crowd crowd(own, desc);
        ASSERT_TRUE(crowd.valid());
        view.look({0.0f, 0.0f, 4.0f});
        pose(crowd);
        const Measured measured = measureLevels(crowd);
        measured.print(std::string(c.name) + " at levels, " + mappingName(mapping));
        EXPECT_GT(measured.degrees.size(), 2000u);
        EXPECT_LT(measured.mean(), 4.0); // of differences of first order
        EXPECT_GT(measured.share(20.0), 0.97);
        EXPECT_LT(measured.fromPlane, 0.02);
        EXPECT_LT(measured.wrongSigns, measured.samples / 200);
        (void)own.takeLines();
    }
}

class TangentsOfLoopPatches : public Tangents, public testing::WithParamInterface<bool> {};
INSTANTIATE_TEST_SUITE_P(Uvs, TangentsOfLoopPatches, testing::Bool(),
                         [](const auto& param) { return std::string(param.param ? "Smooth" : "Linear"); });

TEST_P(TangentsOfLoopPatches, FollowTheMap) {
    const ValidationGuard guard;
    const bool smooth = GetParam();
    const cage::Cage triangles = inTriangles(roughBiped());
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        TestView view(own, 400000, SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_TANGENTS);
        const SuppleAsset asset = own.createAsset(smooth ? withMapOver(triangles) : withUvs(triangles));
        SuppleGroupDesc desc = tangentDesc(asset, SUPPLE_SCHEME_LOOP, 15);
        desc.uvInterpolation = smooth ? SUPPLE_UV_LINEAR_CORNERS_PLUS1 : SUPPLE_UV_LINEAR_ALL;
        Crowd atRate(own, desc);
        desc.flags = 0;
        desc.view = view.handle();
        Crowd atLevels(own, desc);
        ASSERT_TRUE(atRate.valid() && atLevels.valid());
        view.look({0.0f, 0.0f, 4.0f});
        pose(atRate);
        pose(atLevels);
        const Measured rate = measureGrids(atRate), levels = measureLevels(atLevels);
        rate.print(std::string("Loop patches, ") + mappingName(mapping));
        levels.print(std::string("Loop patches at levels, ") + mappingName(mapping));
        EXPECT_LT(rate.mean(), 0.4);
        EXPECT_GT(rate.share(5.0), 0.99);
        EXPECT_GT(levels.degrees.size(), 2000u);
        EXPECT_LT(levels.mean(), 4.0); // of differences of first order
        EXPECT_GT(levels.share(20.0), 0.97);
        for (const Measured* measured : {&rate, &levels}) {
            EXPECT_LT(measured->fromPlane, 0.02);
            // A smooth map may turn over inside a face that is seen from its side, whose sign is that of its corners.
            EXPECT_LT(measured->wrongSigns, measured->samples / (smooth ? 100 : 200) + 1);
        }
        (void)own.takeLines();
    }
}

/// For every vertex of a mesh the samples of the grid that it stands for: its triangles come patch by patch. None at
/// the apex of polar patches, which has a tangent for every direction.
std::vector<std::vector<size_t>> samplesOfVertices(const Crowd& grid, const Crowd& mesh) {
    const SuppleGridOutput own = grid.output().grid;
    std::vector<std::vector<size_t>> samples(mesh.output().grid.vertexCount);
    const auto indices = as<uint32_t>(mesh.read(mesh.output().grid.indices));
    size_t next = 0;
    for (uint32_t r = 0; r < own.drawRangeCount; ++r) {
        const SuppleDrawRange& range = own.drawRanges[r];
        const auto triangles = surface::gridIndices(static_cast<surface::Domain>(range.domain), own.rate);
        for (uint32_t p = 0; p < range.patchCount; ++p) {
            for (const uint16_t sample : triangles) {
                const uint32_t vertex = indices.at(next++);
                if (range.domain != SUPPLE_DOMAIN_POLAR || sample < own.rate * (own.rate + 1)) {
                    samples.at(vertex).push_back(range.firstVertex + size_t{p} * range.samplesPerPatch + sample);
                }
            }
        }
    }
    EXPECT_EQ(next, indices.size());
    return samples;
}

/// Charts that share their borders. `mirrored`: they meet in folds.
cage::Cage withSharedUvs(cage::Cage cage, bool mirrored) {
    const float across = cage.positions[0].z;
    cage.cornerUvs.clear();
    for (const uint32_t vertex : cage.faceVertices) {
        const glm::vec3 p = cage.positions[vertex];
        cage.cornerUvs.emplace_back((mirrored ? std::abs(p.x) : p.x) + 0.37f * p.z,
                                    p.y + 0.3f * std::abs(p.z - across));
    }
    return cage;
}

/// A vertex of an indexed mesh has the tangent that one of its patches has there, and no patch of the other hand.
void compareWithPatches(const Crowd& grid, const Crowd& mesh, const std::string& what) {
    const Streams a(grid), b(mesh);
    const std::vector<std::vector<size_t>> samples = samplesOfVertices(grid, mesh);
    double worst = 0.0, fromPlane = 0.0;
    size_t shared = 0, hands = 0;
    for (size_t v = 0; v < samples.size(); ++v) {
        const glm::dvec4 tangent = decodeTangent(b.tangents[v]);
        double nearest = 180.0;
        for (const size_t sample : samples[v]) {
            const glm::dvec4 there = decodeTangent(a.tangents[sample]);
            nearest = std::min(nearest, angleBetween(glm::dvec3(tangent), glm::dvec3(there)));
            hands += there.w != tangent.w ? 1 : 0;
            shared += sample != samples[v].front() ? 1 : 0;
        }
        worst = std::max(worst, samples[v].empty() ? 0.0 : nearest);
        fromPlane = std::max(fromPlane, std::abs(90.0 - angleBetween(glm::dvec3(tangent), b.normal(v))));
    }
    std::printf("%s: %zu vertices, %zu more samples, up to %.4f degrees from a patch's, out of the plane by %.4f\n",
                what.c_str(), samples.size(), shared, worst, fromPlane);
    EXPECT_LE(worst, 0.1);
    EXPECT_LE(fromPlane, 0.05);
    EXPECT_EQ(hands, 0u);
    EXPECT_GT(shared, 0u);
}

TEST_P(TangentsOfPatches, AnIndexedMeshAreThoseOfOneOfItsPatches) {
    const TangentCase& c = GetParam();
    if (c.scheme == SUPPLE_SCHEME_BLEND) {
        return; // it has no indexed mesh
    }
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        for (const bool mirrored : {false, true}) {
            const SuppleAsset asset = own.createAsset(withSharedUvs(c.cage(), mirrored));
            for (const bool smooth : {false, true}) {
                SuppleGroupDesc desc = tangentDesc(asset, c.scheme, 5);
                desc.uvInterpolation = smooth ? SUPPLE_UV_LINEAR_CORNERS_PLUS1 : SUPPLE_UV_LINEAR_ALL;
                Crowd grid(own, desc);
                desc.flags |= SUPPLE_GROUP_INDEXED_MESH;
                Crowd mesh(own, desc);
                ASSERT_TRUE(grid.valid() && mesh.valid());
                pose(grid);
                pose(mesh);
                compareWithPatches(grid, mesh, std::string(c.name) + (smooth ? ", smooth" : ", linear"));
            }
        }
        (void)own.takeLines();
    }
}

/// The mean angle between the tangents of an indexed mesh and MikkTSpace's of its triangles, at their corners.
double fromMikkTSpace(const Crowd& crowd) {
    const Streams streams(crowd);
    const auto indices = as<uint32_t>(crowd.read(crowd.output().grid.indices));
    cage::Cage refined;
    for (size_t v = 0; v < streams.tangents.size(); ++v) {
        refined.positions.emplace_back(streams.position(v));
    }
    std::vector<uint32_t> corners;
    std::vector<glm::vec3> normals;
    for (const uint32_t v : indices) {
        corners.push_back(static_cast<uint32_t>(corners.size()));
        refined.cornerUvs.emplace_back(streams.uv(v));
        normals.emplace_back(streams.normal(v));
    }
    refined.faceVertices = indices;
    for (uint32_t c = 0; c <= corners.size(); c += 3) {
        refined.faceStarts.push_back(c);
    }
    const std::vector<glm::vec4> theirs = cage::triangleTangents(refined, corners, normals, refined.cornerUvs);
    double sum = 0.0;
    size_t count = 0;
    for (const uint32_t c : corners) {
        const glm::dvec4 own = decodeTangent(streams.tangents[indices[c]]);
        if (glm::length(glm::vec3(theirs[c])) > 0.0f && theirs[c].w == static_cast<float>(own.w)) {
            sum += angleBetween(glm::dvec3(own), glm::dvec3(glm::vec3(theirs[c])));
            ++count;
        }
    }
    EXPECT_GT(count, indices.size() * 49 / 50);
    return sum / static_cast<double>(count);
}

/// Renderers and baking programs make tangents of triangles. The finer these are, the nearer they come to the surface's
/// own.
TEST_F(Tangents, AreWhatMikkTSpaceConvergesTo) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    std::vector<std::string> paths = sharedAssets({"characters/spot_uvsplit.glb"});
    paths.push_back(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip_quads.glb");
    paths.push_back(std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb");
    for (const std::string& path : paths) {
        SCOPED_TRACE(path);
        const Result<host::CharacterFile> file = host::readCharacterFile(path);
        ASSERT_TRUE(file.ok());
        const SuppleAsset asset = own.createAsset(file->character.cage);
        for (const SuppleScheme scheme : {SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_PM}) {
            std::vector<double> means;
            for (const uint32_t rate : {2u, 4u, 8u}) {
                SuppleGroupDesc desc = tangentDesc(asset, scheme, rate);
                desc.flags |= SUPPLE_GROUP_INDEXED_MESH;
                Crowd crowd(own, desc);
                ASSERT_TRUE(crowd.valid());
                crowd.pose(crowd.spawn(), SUPPLE_BIND_POSE, 0.0, glm::mat4(1.0f));
                crowd.run();
                means.push_back(fromMikkTSpace(crowd));
            }
            std::printf("%s, scheme %d: %.3f, %.3f, %.3f degrees from MikkTSpace at rates 2, 4, 8\n",
                        std::filesystem::path(path).filename().c_str(), static_cast<int>(scheme), means[0], means[1],
                        means[2]);
            EXPECT_LT(means[1], 0.5 * means[0]);
            EXPECT_LT(means[2], 0.5 * means[1]);
            EXPECT_LT(means[2], 0.5);
        }
        (void)own.takeLines();
    }
}

TEST_F(Tangents, HaveTheSignOfTheirFace) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    Crowd crowd(own, tangentDesc(own.createAsset(withUvs(roughBiped(), true)), SUPPLE_SCHEME_PM, 6));
    ASSERT_TRUE(crowd.valid());
    pose(crowd);
    const Streams streams(crowd);
    const SuppleGridOutput grid = crowd.output().grid;
    uint32_t negative = 0, patches = 0;
    for (uint32_t r = 0; r < grid.drawRangeCount; ++r) {
        const SuppleDrawRange& range = grid.drawRanges[r];
        for (uint32_t p = 0; p < range.patchCount; ++p, ++patches) {
            const size_t first = range.firstVertex + size_t{p} * range.samplesPerPatch;
            const uint32_t sign = streams.tangents[first] >> 31;
            negative += sign;
            for (size_t s = 1; s < range.samplesPerPatch; ++s) {
                EXPECT_EQ(streams.tangents[first + s] >> 31, sign) << "range " << r << ", patch " << p;
            }
        }
    }
    EXPECT_GT(negative, patches / 4);
    EXPECT_LT(negative, 3 * patches / 4);
    (void)own.takeLines();
}

/// No texture coordinates, all in a point, and all on a line.
TEST_F(Tangents, AreSomeDirectionWhereThereIsNone) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        for (int kind = 0; kind < 3; ++kind) {
            SCOPED_TRACE(kind);
            cage::Cage cage = withUvs(roughPolygons());
            for (glm::vec2& uv : cage.cornerUvs) {
                uv = kind == 1 ? glm::vec2(0.3f) : glm::vec2(uv.x, 0.5f);
            }
            if (kind == 0) {
                cage.cornerUvs.clear();
            }
            Crowd crowd(own, tangentDesc(own.createAsset(cage), SUPPLE_SCHEME_PM, 4));
            ASSERT_TRUE(crowd.valid());
            pose(crowd);
            const Streams streams(crowd);
            const uint32_t count = crowd.output().grid.vertexCount;
            for (uint32_t v = 0; v < count; ++v) {
                const glm::dvec4 tangent = decodeTangent(streams.tangents[v]);
                ASSERT_NEAR(glm::length(glm::dvec3(tangent)), 1.0, 1e-6);
                ASSERT_NEAR(angleBetween(glm::dvec3(tangent), streams.normal(v)), 90.0, 0.02) << v;
                ASSERT_EQ(tangent.w, 1.0);
            }
        }
        (void)own.takeLines();
    }
}

TEST_F(Tangents, AreRefusedWithoutAttributes) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    SuppleGroupDesc desc = tangentDesc(own.createAsset(withUvs(roughBiped())), SUPPLE_SCHEME_FRAGMENTS, 4);
    desc.structSize = sizeof desc;
    desc.flags = SUPPLE_GROUP_TANGENTS;
    SuppleGroup group{};
    (void)own.takeLines();
    EXPECT_EQ(suppleCreateGroup(own.handle(), &desc, &group), SUPPLE_ERROR_ARGUMENT);
    EXPECT_NE(own.takeLines().at(0).text.find("TANGENTS go with ATTRIBUTES"), std::string::npos);
}

} // namespace
} // namespace supple::test
