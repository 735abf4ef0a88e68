// Smooth texture coordinates on the device (docs/smooth_uvs.md): against stored values and limits in double; their bits
// on both sides of edges, at rates and at levels; the tangents that they give; what schemes cannot do.
#include "cage/single_joint.h"
#include "cage/uv_channel.h"
#include "cpu/grid_sample.h"
#include "surface/fragments/smooth_uvs.h"
#include "surface/pm/mesh.h"
#include "surface/schemes.h"
#include "surface/subdivision/mesh.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/json_vectors.h"
#include "tests/support/loop_triangles.h"
#include "tests/support/meshes.h"
#include "tests/support/tangent_word.h"
#include "tests/support/test_view.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace supple::test {
namespace {

using cage::kNone;
using cage::UvMode;

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / 3.14159265358979323846;
}

/// A smooth map of space, so that all corners of a vertex have one value.
glm::vec2 mapped(const glm::vec3& p) {
    return {0.5f + 0.3f * p.x + 0.1f * p.y * p.z + 0.07f * p.z, 0.5f + 0.3f * p.y + 0.08f * p.x * p.z - 0.05f * p.z};
}
cage::Cage withMap(cage::Cage cage) {
    cage.cornerUvs.clear();
    for (const uint32_t v : cage.faceVertices) {
        cage.cornerUvs.push_back(mapped(cage.positions[v]));
    }
    return cage;
}

/// The same cut at random round half of the vertices: seams, darts, junctions, values that stand in two runs.
std::vector<glm::vec2> cutAtRandom(const cage::Cage& cage, uint32_t seed) {
    std::vector<glm::vec2> uvs = withMap(cage).cornerUvs;
    const cage::Topology topology = *cage::buildTopology(cage);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        if (share(random) < 0.5f) {
            continue;
        }
        std::vector<glm::vec2> offsets{glm::vec2(0.0f)};
        size_t run = 0;
        for (uint32_t k = 0; k < topology.sectorCount(v); ++k) {
            if (k > 0 && share(random) < 0.4f) {
                offsets.emplace_back(0.1f * share(random), 0.1f * share(random));
                run = share(random) < 0.3f ? 0 : offsets.size() - 1;
            }
            uvs[topology.sectorCorners[topology.spokeStarts[v] + k]] += offsets[run];
        }
    }
    return uvs;
}
cage::Cage withSeams(cage::Cage cage, uint32_t seed = 11) {
    cage.cornerUvs = cutAtRandom(cage, seed);
    return cage;
}

/// One seam round the cage, which halves the vertices that it passes: faces on one side have values of their own.
cage::Cage withStraightSeam(cage::Cage cage) {
    cage = withMap(std::move(cage));
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        float height = 0.0f;
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            height += cage.positions[cage.faceVertices[c]].y;
        }
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1] && height > 0.0f; ++c) {
            cage.cornerUvs[c] += glm::vec2(2.0f, 0.5f);
        }
    }
    return cage;
}

cage::Cage roughQuads() {
    return perturbed(biped(), 0.05f, 3);
}
cage::Cage roughMixed() {
    return perturbed(withCutQuads(biped(), 0.4, 5), 0.05f, 3);
}
cage::Cage roughOpen() {
    return perturbed(withCutQuads(grid(5, 4), 0.3, 2), 0.1f, 4);
}
cage::Cage roughTriangles() {
    return perturbed(withCutQuads(grid(5, 4), 1.0, 2), 0.1f, 4);
}
cage::Cage creasedTriangles() {
    cage::Cage cage = roughTriangles();
    cage.creases = {{8, 9, 0.7f}, {9, 10, 1.7f}, {9, 15, 2.5f}, {14, 15, 1.7f}};
    return cage;
}
cage::Cage roughGrid() {
    return perturbed(grid(5, 4), 0.1f, 4);
}

/// Closed.
cage::Cage roughTriangleBiped() {
    return perturbed(withCutQuads(biped(), 1.0, 5), 0.05f, 3);
}

SuppleGroupDesc smoothDesc(SuppleAsset asset, SuppleScheme scheme, uint32_t rate, UvMode mode, uint32_t flags = 0) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = 1;
    desc.scheme = scheme;
    desc.rate = rate;
    desc.vertexFormat = SUPPLE_VERTEX_24;
    desc.flags = SUPPLE_GROUP_ATTRIBUTES | flags;
    desc.uvInterpolation = static_cast<SuppleUvInterpolation>(static_cast<uint32_t>(mode) + 1);
    return desc;
}

/// What a group of one instance has written.
struct Written {
    explicit Written(Crowd& crowd) {
        crowd.pose(crowd.spawn(), SUPPLE_BIND_POSE, 0.0, glm::mat4(1.0f));
        crowd.run();
        const SuppleVertexStreams streams = crowd.output().streams;
        vertices = as<uint32_t>(crowd.read(streams.vertices));
        attributes = as<uint32_t>(crowd.read(streams.attributes));
        if (streams.uvs1.size > 0) {
            uvs1 = as<uint32_t>(crowd.read(streams.uvs1));
        }
        if (streams.tangents.size > 0) {
            tangents = as<uint32_t>(crowd.read(streams.tangents));
        }
    }
    using Bits = std::array<uint32_t, 2>;
    [[nodiscard]] Bits bits(size_t v) const { return {attributes[4 * v], attributes[4 * v + 1]}; }
    [[nodiscard]] glm::dvec2 uv(size_t v) const {
        const Bits own = bits(v);
        return {std::bit_cast<float>(own[0]), std::bit_cast<float>(own[1])};
    }
    [[nodiscard]] std::array<uint32_t, 3> position(size_t v) const {
        return {vertices[6 * v], vertices[6 * v + 1], vertices[6 * v + 2]};
    }
    [[nodiscard]] glm::vec3 place(size_t v) const {
        const auto p = position(v);
        return {std::bit_cast<float>(p[0]), std::bit_cast<float>(p[1]), std::bit_cast<float>(p[2])};
    }
    std::vector<uint32_t> vertices, attributes, uvs1, tangents;
};

/// Where the patches of a group's grids have their samples, in the order of the tables.
struct Grids {
    Grids(const Crowd& crowd, SuppleScheme scheme, const cage::Cage& cage, uint32_t rate) {
        surface::Recipe recipe{.scheme = static_cast<surface::SchemeId>(scheme)};
        recipe.rate = surface::schemeOf(recipe.scheme).tableRate(rate, false);
        tables = std::move(*surface::buildTables(recipe, cage));
        const SuppleGridOutput grid = crowd.output().grid;
        segments = grid.rate;
        for (uint32_t r = 0; r < grid.drawRangeCount; ++r) {
            const SuppleDrawRange& range = grid.drawRanges[r];
            for (uint32_t p = 0; p < range.patchCount; ++p) {
                firstVertices.push_back(range.firstVertex + p * range.samplesPerPatch);
                domains.push_back(static_cast<surface::Domain>(range.domain));
            }
        }
        EXPECT_EQ(firstVertices.size(), tables.patches.size());
    }
    [[nodiscard]] size_t along(uint32_t patch, uint32_t side, uint32_t k) const {
        return firstVertices[patch] + surface::edgeSample(domains[patch], segments, side, k);
    }
    surface::Tables tables;
    uint32_t segments = 0;
    std::vector<uint32_t> firstVertices;
    std::vector<surface::Domain> domains;
};

/// An edge between two patches that is not discontinuous.
struct InnerEdge {
    uint32_t patch = 0, side = 0, other = 0, otherSide = 0;
    uint32_t kind = 0; ///< 0: regular ends; 1: an irregular end; 2: an end on a seam that halves it; 3: on another seam
};

/// Those of a cage whose faces are patches.
std::vector<InnerEdge> innerEdges(const cage::Cage& cage, const surface::Tables& tables, UvMode mode) {
    const cage::Topology topology = *cage::buildTopology(cage);
    std::vector<float> edges, vertices(cage.vertexCount(), 0.0f);
    for (const cage::Topology::Edge& edge : topology.edges) {
        edges.push_back(edge.twin == kNone ? cage::kHardSharpness : 0.0f);
    }
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        vertices[v] = topology.boundary[v] != 0 && topology.sectorCount(v) == 1 ? cage::kHardSharpness : 0.0f;
    }
    const cage::UvChannel channel = *cage::buildUvChannel(cage, topology, {edges, vertices}, cage.cornerUvs, mode);
    std::vector<std::pair<uint32_t, uint32_t>> byCorner(cage.cornerCount()); // patch and its corner
    for (uint32_t p = 0; p < tables.patches.size(); ++p) {
        const surface::PatchInfo& patch = tables.patches[p];
        for (uint32_t i = 0; i < patch.cornerCount; ++i) {
            uint32_t c = cage.faceStarts[patch.face];
            while (cage.faceVertices[c] != patch.corners[i]) {
                ++c;
            }
            byCorner[c] = {p, i};
        }
    }
    std::vector<InnerEdge> result;
    for (uint32_t e = 0; e < topology.edges.size(); ++e) {
        const auto [corner, twin] = topology.edges[e];
        if (twin == kNone || channel.cutEdges[e] != 0) {
            continue;
        }
        InnerEdge edge{byCorner[corner].first, byCorner[corner].second, byCorner[twin].first, byCorner[twin].second, 0};
        for (const uint32_t c : {corner, twin}) {
            const uint32_t v = cage.faceVertices[c], own = channel.cage.faceVertices[c];
            const uint32_t faces = topology.sectorCount(v), size = channel.topology.sectorCount(own);
            const bool closed = topology.boundary[v] == 0;
            uint32_t kind = topology.effectiveValence(v) == 4 ? 0 : 1;
            if (channel.rules[own] != cage::UvChannel::Rule::match) {
                const bool halves =
                    (closed ? 2 * size == faces : size == faces) && channel.rules[own] == cage::UvChannel::Rule::crease;
                kind = halves ? 2 : 3;
            }
            edge.kind = std::max(edge.kind, kind);
        }
        result.push_back(edge);
    }
    return result;
}

class SmoothUvs : public CrowdContexts {};

struct UvCase {
    const char* name;
    SuppleScheme scheme;
    cage::Cage (*cage)();
};
const UvCase kUvCases[] = {
    {"prep", SUPPLE_SCHEME_PREP, roughQuads},
    {"prepOpen", SUPPLE_SCHEME_PREP, roughGrid},
    {"pm", SUPPLE_SCHEME_PM, roughMixed},
    {"pmOpen", SUPPLE_SCHEME_PM, roughOpen},
    {"pmPolar", SUPPLE_SCHEME_PM, [] { return cappedCylinder(7, 4); }},
    {"pmPentagons", SUPPLE_SCHEME_PM, dodecahedron},
    {"blend", SUPPLE_SCHEME_BLEND, roughQuads},
    {"blendOpen", SUPPLE_SCHEME_BLEND, roughGrid},
    {"catmullClark", SUPPLE_SCHEME_CATMULL_CLARK, roughQuads},
    {"catmullClarkOpen", SUPPLE_SCHEME_CATMULL_CLARK, roughGrid},
    {"loop", SUPPLE_SCHEME_LOOP, roughTriangleBiped},
    {"loopOpen", SUPPLE_SCHEME_LOOP, roughTriangles},
    {"loopCreased", SUPPLE_SCHEME_LOOP, creasedTriangles},
};
class SmoothUvsOf : public SmoothUvs, public testing::WithParamInterface<UvCase> {};
INSTANTIATE_TEST_SUITE_P(Schemes, SmoothUvsOf, testing::ValuesIn(kUvCases),
                         [](const auto& param) { return std::string(param.param.name); });

TEST_P(SmoothUvsOf, AgreeInEveryBitOnEdgesThatAreNotDiscontinuous) {
    const ValidationGuard guard;
    const UvCase& c = GetParam();
    const cage::Cage cage = withSeams(c.cage());
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        const SuppleAsset asset = own.createAsset(cage);
        for (const UvMode mode : {UvMode::cornersPlus1, UvMode::none}) {
            for (const uint32_t rate : {5u, 8u}) {
                Crowd crowd(own, smoothDesc(asset, c.scheme, rate, mode));
                ASSERT_TRUE(crowd.valid());
                const Written written(crowd);
                const Grids grids(crowd, c.scheme, cage, rate);
                size_t compared = 0, different = 0;
                for (const InnerEdge& edge : innerEdges(cage, grids.tables, mode)) {
                    for (uint32_t k = 0; k <= grids.segments; ++k, ++compared) {
                        const size_t a = grids.along(edge.patch, edge.side, k);
                        const size_t b = grids.along(edge.other, edge.otherSide, grids.segments - k);
                        different += written.bits(a) != written.bits(b) ? 1 : 0;
                    }
                }
                EXPECT_GT(compared, 20u);
                EXPECT_EQ(different, 0u) << "of " << compared << ", rate " << rate << ", " << cage::uvModeName(mode);
            }
        }
        (void)own.takeLines();
    }
}

/// Tangents of the two sides of an edge. Linear texture coordinates fail this: the test sees.
TEST_P(SmoothUvsOf, GiveTangentsThatGoOnAcrossEdges) {
    const ValidationGuard guard;
    const UvCase& c = GetParam();
    const cage::Cage cage = withStraightSeam(c.cage());
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        const SuppleAsset asset = own.createAsset(cage);
        for (const UvMode mode : {UvMode::cornersPlus1, UvMode::all}) {
            Crowd crowd(own, smoothDesc(asset, c.scheme, 8, mode, SUPPLE_GROUP_TANGENTS));
            ASSERT_TRUE(crowd.valid());
            const Written written(crowd);
            const Grids grids(crowd, c.scheme, cage, 8);
            double sum = 0.0, worst = 0.0;
            size_t compared = 0;
            for (const InnerEdge& edge : innerEdges(cage, grids.tables, UvMode::cornersPlus1)) {
                for (uint32_t k = 1; k < grids.segments && edge.kind < 3; ++k) {
                    const size_t a = grids.along(edge.patch, edge.side, k);
                    const size_t b = grids.along(edge.other, edge.otherSide, grids.segments - k);
                    if ((written.tangents[a] ^ written.tangents[b]) >> 31 != 0) {
                        continue; // the texture coordinates fold there
                    }
                    const double angle = degreesBetween(glm::dvec3(decodeTangent(written.tangents[a])),
                                                        glm::dvec3(decodeTangent(written.tangents[b])));
                    sum += angle;
                    worst = std::max(worst, angle);
                    ++compared;
                }
            }
            const double mean = sum / static_cast<double>(compared);
            std::printf("%s, %s: %zu samples, mean %.5f, at most %.4f degrees\n", c.name, cage::uvModeName(mode),
                        compared, mean, worst);
            ASSERT_GT(compared, 10u);
            if (mode == UvMode::all) {
                EXPECT_GT(mean, 1.0);
            } else {
                EXPECT_LT(mean, 0.002);
                EXPECT_LT(worst, 0.1);
            }
        }
        (void)own.takeLines();
    }
}

/// Limits of the subdivision on the device are those in double, in all modes.
TEST_F(SmoothUvs, OfSubdivisionAreTheLimits) {
    const ValidationGuard guard;
    struct Case {
        SuppleScheme scheme;
        surface::Subdivision subdivision;
        cage::Cage cage;
    };
    using surface::Subdivision;
    const Case cases[] = {{SUPPLE_SCHEME_FRAGMENTS, Subdivision::catmullClark, withSeams(roughQuads())},
                          {SUPPLE_SCHEME_FRAGMENTS, Subdivision::catmullClark, withSeams(roughOpen())}};
    for (const Case& c : cases) {
        for (const SuppleMapping mapping : kMappings) {
            SCOPED_TRACE(mappingName(mapping));
            CrowdContext& own = context(mapping);
            ASSERT_TRUE(own.valid());
            const SuppleAsset asset = own.createAsset(c.cage);
            for (const UvMode mode :
                 {UvMode::none, UvMode::cornersOnly, UvMode::cornersPlus1, UvMode::cornersPlus2, UvMode::boundaries}) {
                Crowd crowd(own, smoothDesc(asset, c.scheme, 8, mode));
                ASSERT_TRUE(crowd.valid());
                const Written written(crowd);
                const Grids grids(crowd, c.scheme, c.cage, 8);
                std::vector<std::string> notes;
                const auto begin = surface::subdivision::beginSteps(c.cage, c.subdivision, notes);
                const uint32_t isolation = grids.tables.isolationSteps;
                const auto limits = surface::fragments::limitUvs(*begin, begin->cage.cornerUvs,
                                                                 {c.subdivision, isolation, 3 - isolation, mode, true});
                ASSERT_TRUE(limits);
                double worst = 0.0;
                const size_t samples = surface::sampleCount(grids.domains[0], grids.segments);
                ASSERT_EQ(limits->size(), samples * grids.firstVertices.size());
                for (size_t i = 0; i < limits->size(); ++i) {
                    worst = std::max(worst, glm::distance(written.uv(grids.firstVertices[0] + i), (*limits)[i].value));
                }
                EXPECT_LT(worst, 1e-6) << cage::uvModeName(mode);
            }
            (void)own.takeLines();
        }
    }
}

/// Rate 8 in the four quarters of triangles: a sample of a face, by how far it is from corner 0 along the two edges.
class QuarterSamples {
public:
    explicit QuarterSamples(std::vector<surface::fragments::UvSample> limits) : limits_(std::move(limits)) {
        constexpr int kHalf = kRate / 2;
        for (uint32_t index = 0; index < surface::sampleCount(surface::Domain::triangle, kHalf); ++index) {
            const surface::GridSample at = surface::gridSample(surface::Domain::triangle, kHalf, index);
            const int i = static_cast<int>(at.i), j = static_cast<int>(at.j), rest = kHalf - i - j;
            const std::array<std::array<int, 2>, 4> places = {
                {{i, j}, {kHalf + rest, i}, {j, kHalf + rest}, {kHalf - j, i + j}}};
            for (uint32_t part = 0; part < 4; ++part) {
                found_[places[part]] = {part, index};
            }
        }
    }
    [[nodiscard]] glm::dvec2 at(uint32_t face, int i, int j) const {
        const auto [part, index] = found_.at({i, j});
        return limits_[(4 * face + part) * surface::sampleCount(surface::Domain::triangle, kRate / 2) + index].value;
    }
    static constexpr uint32_t kRate = 8;

private:
    std::vector<surface::fragments::UvSample> limits_;
    std::map<std::array<int, 2>, std::array<uint32_t, 2>> found_;
};

/// Loop patches have the limits of Loop, with hard creases, on a border and where larger faces are cut.
TEST_F(SmoothUvs, OfLoopPatchesAreTheLimits) {
    const ValidationGuard guard;
    cage::Cage creased = withSeams(roughTriangles());
    for (uint32_t c = 0; c < 3; ++c) { // a ring: at tips of darts the masks of limitUvs() are not the limit
        creased.creases.push_back({creased.faceVertices[c], creased.faceVertices[(c + 1) % 3], cage::kHardSharpness});
    }
    for (const cage::Cage& cage : {withSeams(roughTriangles()), creased, withSeams(roughOpen())}) {
        std::vector<std::string> notes;
        const auto begin = surface::subdivision::beginSteps(cage, surface::Subdivision::loop, notes);
        ASSERT_TRUE(begin);
        const LoopTriangles triangles(cage);
        for (const SuppleMapping mapping : kMappings) {
            SCOPED_TRACE(mappingName(mapping));
            CrowdContext& own = context(mapping);
            ASSERT_TRUE(own.valid());
            const SuppleAsset asset = own.createAsset(cage);
            for (const UvMode mode :
                 {UvMode::none, UvMode::cornersOnly, UvMode::cornersPlus1, UvMode::cornersPlus2, UvMode::boundaries}) {
                Crowd crowd(own, smoothDesc(asset, SUPPLE_SCHEME_LOOP, QuarterSamples::kRate, mode));
                ASSERT_TRUE(crowd.valid());
                const Written written(crowd);
                const Grids grids(crowd, SUPPLE_SCHEME_LOOP, cage, QuarterSamples::kRate);
                const auto limits = surface::fragments::limitUvs(*begin, begin->cage.cornerUvs,
                                                                 {surface::Subdivision::loop, 1, 2, mode, true});
                ASSERT_TRUE(limits);
                const QuarterSamples expected(*limits);
                ASSERT_EQ(grids.tables.patches.size(), begin->cage.faceCount());
                const PatchFaces found = triangles.patches(grids.tables.patches);
                double worst = 0.0;
                for (uint32_t p = 0; p < grids.firstVertices.size(); ++p) {
                    const uint32_t face = found.faces[p];
                    for (uint32_t s = 0; s < surface::sampleCount(grids.domains[p], grids.segments); ++s) {
                        const surface::GridSample at = surface::gridSample(grids.domains[p], grids.segments, s);
                        const glm::dvec3 weights =
                            LoopTriangles::inFace({grids.segments - at.i - at.j, at.i, at.j}, found.firstCorners[face]);
                        const glm::dvec2 limit =
                            expected.at(face, static_cast<int>(weights.y), static_cast<int>(weights.z));
                        worst = std::max(worst, glm::distance(written.uv(grids.firstVertices[p] + s), limit));
                    }
                }
                EXPECT_LT(worst, 1e-6) << cage::uvModeName(mode);
            }
            (void)own.takeLines();
        }
    }
}

/// Exact patches have the limits of Catmull-Clark, whose samples they share at this rate.
TEST_F(SmoothUvs, OfExactPatchesAreThoseOfCatmullClark) {
    const ValidationGuard guard;
    for (cage::Cage cage : {withSeams(roughQuads()), withSeams(roughOpen())}) {
        cage.creases.push_back({cage.faceVertices[0], cage.faceVertices[1], 1.7f});
        for (const SuppleMapping mapping : kMappings) {
            SCOPED_TRACE(mappingName(mapping));
            CrowdContext& own = context(mapping);
            ASSERT_TRUE(own.valid());
            const SuppleAsset asset = own.createAsset(cage);
            for (const UvMode mode :
                 {UvMode::none, UvMode::cornersOnly, UvMode::cornersPlus1, UvMode::cornersPlus2, UvMode::boundaries}) {
                Crowd exact(own, smoothDesc(asset, SUPPLE_SCHEME_CATMULL_CLARK, 8, mode));
                Crowd refined(own, smoothDesc(asset, SUPPLE_SCHEME_FRAGMENTS, 8, mode));
                ASSERT_TRUE(exact.valid() && refined.valid());
                const Written a(exact), b(refined);
                const uint32_t count = exact.output().grid.vertexCount, others = refined.output().grid.vertexCount;
                double worst = 0.0;
                for (uint32_t v = 0; v < count; ++v) {
                    double nearest = 1e30; // of those at the same place: on seams there are several
                    for (uint32_t w = 0; w < others; ++w) {
                        if (glm::distance(a.place(v), b.place(w)) < 2e-6f) {
                            nearest = std::min(nearest, glm::distance(a.uv(v), b.uv(w)));
                        }
                    }
                    worst = std::max(worst, nearest);
                }
                EXPECT_LT(worst, 1e-6) << cage::uvModeName(mode) << ", " << count << " samples";
            }
            (void)own.takeLines();
        }
    }
}

/// P_m against the stored samples.
TEST_F(SmoothUvs, OfPmAreThoseOfTheVectors) {
    const ValidationGuard guard;
    using nlohmann::json;
    const json vectors = parseFile(SUPPLE_TEST_DATA "/uvs/attributes_frames.json");
    const std::vector<glm::dvec3> positions = jsonVectors(vectors.at("vertices"));
    cage::Cage cage = makeCage({positions.begin(), positions.end()}, vectors.at("faces").get<Faces>());
    for (const json& face : vectors.at("uv")) {
        for (const json& uv : face) {
            cage.cornerUvs.emplace_back(uv.at(0).get<float>(), uv.at(1).get<float>());
        }
    }
    CrowdContext& own = context(SUPPLE_MAPPING_WIDE);
    ASSERT_TRUE(own.valid());
    Crowd crowd(own,
                smoothDesc(own.createAsset(cage), SUPPLE_SCHEME_PM, 4, UvMode::cornersPlus1, SUPPLE_GROUP_TANGENTS));
    ASSERT_TRUE(crowd.valid());
    const Written written(crowd);
    const Grids grids(crowd, SUPPLE_SCHEME_PM, cage, 4);
    double worst = 0.0, worstAngle = 0.0;
    size_t compared = 0;
    for (const json& stored : vectors.at("patches")) {
        const auto corners = stored.at("corners").get<std::vector<uint32_t>>();
        uint32_t p = 0;
        while (p < grids.tables.patches.size() &&
               !std::equal(corners.begin(), corners.end(), grids.tables.patches[p].corners.begin(),
                           grids.tables.patches[p].corners.begin() + grids.tables.patches[p].cornerCount)) {
            ++p;
        }
        ASSERT_LT(p, grids.tables.patches.size());
        for (const json& sample : stored.at("samples")) {
            if (sample.at("kind") != "smooth") {
                continue;
            }
            const json& at = sample.at("at");
            const auto quarter = [&](size_t i) {
                return static_cast<uint32_t>(std::lround(at.at(i).get<double>() * 4.0));
            };
            uint32_t index = 0;
            if (grids.domains[p] == surface::Domain::pentagon) {
                const uint32_t sector = at.at(0), i = quarter(1), j = quarter(2);
                index = sector * 10 + j * 4 - j * (j - 1) / 2 + i;
            } else if (grids.domains[p] == surface::Domain::triangle) {
                index = quarter(1) * 5 - quarter(1) * (quarter(1) - 1) / 2 + quarter(0);
            } else {
                index = quarter(1) * 5 + quarter(0);
            }
            const size_t v = grids.firstVertices[p] + index;
            const json& uv = sample.at("uv");
            worst = std::max(worst, glm::distance(written.uv(v), glm::dvec2(uv.at(0), uv.at(1))));
            worstAngle = std::max(worstAngle, degreesBetween(glm::dvec3(decodeTangent(written.tangents[v])),
                                                             jsonVector(sample.at("tangent"))));
            ++compared;
        }
    }
    std::printf("%zu samples, at most %.2e and %.4f degrees off\n", compared, worst, worstAngle);
    EXPECT_GT(compared, 50u);
    EXPECT_LT(worst, 1e-6);
    EXPECT_LT(worstAngle, 0.1);
    (void)own.takeLines();
}

/// Points on the seamless map's samples with one position have one pair of texture coordinates, whatever the grid: at
/// levels every patch has its own.
class SmoothUvsAtLevels : public SmoothUvs, public testing::WithParamInterface<UvCase> {};
INSTANTIATE_TEST_SUITE_P(Schemes, SmoothUvsAtLevels,
                         testing::Values(kUvCases[0], kUvCases[1], kUvCases[2], kUvCases[3], kUvCases[4], kUvCases[5],
                                         kUvCases[7], // blend's charts do not agree where a map folds
                                         kUvCases[8], kUvCases[9], kUvCases[10], kUvCases[11]),
                         [](const auto& param) { return std::string(param.param.name); });

TEST_P(SmoothUvsAtLevels, AgreeInEveryBit) {
    const ValidationGuard guard;
    const UvCase& c = GetParam();
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        TestView view(own, 400000, SUPPLE_VIEW_ATTRIBUTES);
        SuppleGroupDesc desc = smoothDesc(own.createAsset(withMap(c.cage())), c.scheme, 0, UvMode::cornersPlus1);
        desc.flags = 0;
        desc.view = view.handle();
        Crowd crowd(own, desc);
        ASSERT_TRUE(crowd.valid());
        view.look({0.0f, 0.0f, 6.0f});
        const Written written(crowd);
        const SuppleLevelOutput levels = crowd.output().levels;
        const auto buckets = as<std::array<uint32_t, 4>>(crowd.read(levels.buckets));
        const auto records = as<std::array<uint32_t, 16>>(crowd.read(levels.patches));
        std::map<std::array<uint32_t, 3>, size_t> known;
        size_t shared = 0, different = 0;
        double worst = 0.0;
        for (uint32_t d = 0; d < levels.drawCount; ++d) {
            const SuppleLevelDraw& draw = levels.draws[d];
            const uint32_t n = draw.capacity;
            const uint32_t sides = draw.grid == SUPPLE_GRID_TRIANGLE_RINGS ? 3
                                   : draw.grid == SUPPLE_GRID_QUAD_RINGS   ? 4
                                                                           : 5;
            const uint32_t samples = draw.grid == SUPPLE_GRID_QUAD ? (n + 1) * (n + 1) : sides * (n + 1) * (n + 1) / 4;
            for (uint32_t p = 0; p < buckets[d][2]; ++p) {
                const auto& record = records[buckets[d][0] + p];
                for (uint32_t s = 0; record[0] != 0xFFFFFFFFu && s < samples; ++s) {
                    const size_t v = record[2] + s;
                    const auto [at, isNew] = known.try_emplace(written.position(v), v);
                    shared += isNew ? 0 : 1;
                    different += written.bits(at->second) != written.bits(v) ? 1 : 0;
                    worst = std::max(worst, glm::distance(written.uv(at->second), written.uv(v)));
                }
            }
        }
        EXPECT_GT(shared, 100u);
        EXPECT_LT(worst, 1e-6) << "of " << shared;
        // Where a map folds, each side of an exact patch's edge rounds by itself, unless the fold halves its vertices.
        const bool exact = c.scheme == SUPPLE_SCHEME_CATMULL_CLARK || c.scheme == SUPPLE_SCHEME_LOOP;
        if (!exact || c.cage == &roughGrid || c.cage == &roughTriangles) {
            EXPECT_EQ(different, 0u) << "of " << shared;
        }
        (void)own.takeLines();
    }
}

/// A cage that takes a step of subdivision first.
TEST_F(SmoothUvs, OfBlendedPolygonsAgreeOnBothSidesOfEdges) {
    const ValidationGuard guard;
    const cage::Cage cage = withMap(roughOpen()); // seen from above, so that nothing folds
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        Crowd crowd(own, smoothDesc(own.createAsset(cage), SUPPLE_SCHEME_BLEND, 8, UvMode::cornersPlus1));
        ASSERT_TRUE(crowd.valid());
        const Written written(crowd);
        std::map<std::array<uint32_t, 3>, Written::Bits> known;
        size_t shared = 0, different = 0;
        for (size_t v = 0; v < crowd.output().grid.vertexCount; ++v) {
            const auto [at, isNew] = known.try_emplace(written.position(v), written.bits(v));
            shared += isNew ? 0 : 1;
            different += at->second != written.bits(v) ? 1 : 0;
        }
        EXPECT_GT(shared, 300u);
        EXPECT_EQ(different, 0u) << "of " << shared;
        (void)own.takeLines();
    }
}

/// The second set by itself, and the first beside it.
TEST_P(SmoothUvsOf, OfTheSecondSetAreAsOfTheFirst) {
    const ValidationGuard guard;
    const UvCase& c = GetParam();
    cage::Cage first = withSeams(c.cage(), 11), second = first, both = first;
    second.cornerUvs = both.cornerUvs1 = cutAtRandom(first, 29);
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        const auto make = [&](const cage::Cage& cage) {
            return smoothDesc(own.createAsset(cage), c.scheme, 4, UvMode::cornersPlus1);
        };
        Crowd crowd(own, make(both)), ofFirst(own, make(first)), ofSecond(own, make(second));
        ASSERT_TRUE(crowd.valid() && ofFirst.valid() && ofSecond.valid());
        const Written written(crowd), a(ofFirst), b(ofSecond);
        const uint32_t count = crowd.output().grid.vertexCount;
        ASSERT_GE(written.uvs1.size(), 2 * size_t{count});
        size_t different = 0;
        for (uint32_t v = 0; v < count; ++v) {
            different += written.bits(v) != a.bits(v) ? 1 : 0;
            different += Written::Bits{written.uvs1[2 * v], written.uvs1[2 * v + 1]} != b.bits(v) ? 1 : 0;
        }
        EXPECT_EQ(different, 0u);
        (void)own.takeLines();
    }
}

/// Samples of an indexed mesh are those of the grids.
TEST_F(SmoothUvs, OfIndexedMeshesAreThoseOfGrids) {
    const ValidationGuard guard;
    for (const UvCase& c : {UvCase{"prep", SUPPLE_SCHEME_PREP, roughQuads}, UvCase{"pm", SUPPLE_SCHEME_PM, roughMixed},
                            UvCase{"polar", SUPPLE_SCHEME_PM, [] { return cappedCylinder(7, 4); }},
                            UvCase{"catmullClark", SUPPLE_SCHEME_CATMULL_CLARK, roughQuads},
                            UvCase{"catmullClarkMixed", SUPPLE_SCHEME_CATMULL_CLARK, roughMixed},
                            UvCase{"loop", SUPPLE_SCHEME_LOOP, roughTriangleBiped},
                            UvCase{"loopOpen", SUPPLE_SCHEME_LOOP, roughTriangles}}) {
        cage::Cage cage = withSeams(c.cage());
        cage.cornerUvs1 = cutAtRandom(cage, 29);
        for (const SuppleMapping mapping : kMappings) {
            SCOPED_TRACE(std::string(c.name) + mappingName(mapping));
            CrowdContext& own = context(mapping);
            ASSERT_TRUE(own.valid());
            const SuppleAsset asset = own.createAsset(cage);
            Crowd grids(own, smoothDesc(asset, c.scheme, 5, UvMode::cornersPlus1));
            Crowd mesh(own, smoothDesc(asset, c.scheme, 5, UvMode::cornersPlus1, SUPPLE_GROUP_INDEXED_MESH));
            ASSERT_TRUE(grids.valid() && mesh.valid());
            const Written a(grids), b(mesh);
            using Key = std::array<uint32_t, 7>; // position and both sets
            const auto keyOf = [](const Written& written, size_t v) {
                const auto p = written.position(v);
                const auto uv = written.bits(v);
                return Key{p[0], p[1], p[2], uv[0], uv[1], written.uvs1[2 * v], written.uvs1[2 * v + 1]};
            };
            std::map<Key, uint32_t> known;
            for (uint32_t v = 0; v < grids.output().grid.vertexCount; ++v) {
                ++known[keyOf(a, v)];
            }
            size_t missing = 0;
            const uint32_t count = mesh.output().grid.vertexCount;
            for (uint32_t v = 0; v < count; ++v) {
                missing += known.count(keyOf(b, v)) == 0 ? 1 : 0;
            }
            EXPECT_GT(count, 500u);
            EXPECT_EQ(missing, 0u) << "of " << count;
            (void)own.takeLines();
        }
    }
}

TEST_F(SmoothUvs, ThatASchemeLacksAreRefusedByName) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const SuppleAsset asset = own.createAsset(withMap(roughQuads()));
    const auto refused = [&](SuppleScheme scheme, UvMode mode, const std::string& words) {
        SuppleGroupDesc desc = smoothDesc(asset, scheme, 4, mode);
        desc.structSize = sizeof desc;
        SuppleGroup group{};
        (void)own.takeLines();
        EXPECT_EQ(suppleCreateGroup(own.handle(), &desc, &group), SUPPLE_ERROR_ARGUMENT);
        EXPECT_NE(own.takeLines().at(0).text.find(words), std::string::npos) << words;
    };
    refused(SUPPLE_SCHEME_BLEND, UvMode::boundaries,
            "blend does not interpolate texture coordinates by \"boundaries\"");
    refused(SUPPLE_SCHEME_POLYGONS, UvMode::none, "polygons does not interpolate texture coordinates by \"none\"");
    SuppleGroupDesc desc = smoothDesc(asset, SUPPLE_SCHEME_PM, 4, UvMode::all);
    desc.structSize = sizeof desc;
    desc.uvInterpolation = static_cast<SuppleUvInterpolation>(7);
    SuppleGroup group{};
    EXPECT_EQ(suppleCreateGroup(own.handle(), &desc, &group), SUPPLE_ERROR_ARGUMENT);
}

/// What the file says counts, and is told where a scheme cannot do it.
TEST_F(SmoothUvs, FollowTheFile) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    cage::Character character;
    character.name = "file";
    character.cage = withSeams(roughQuads());
    cage::bindToOneJoint(character, "node");
    const auto uvsOf = [&](SuppleScheme scheme, uint32_t interpolation, std::string* told = nullptr) {
        SuppleGroupDesc desc = smoothDesc(own.createAsset(character), scheme, 4, UvMode::all);
        desc.uvInterpolation = static_cast<SuppleUvInterpolation>(interpolation);
        (void)own.takeLines();
        Crowd crowd(own, desc);
        EXPECT_TRUE(crowd.valid());
        for (const auto& line : own.takeLines()) {
            if (told != nullptr) {
                *told += line.text + "\n";
            }
        }
        const Written written(crowd);
        const auto end = written.attributes.begin() + 4 * static_cast<std::ptrdiff_t>(crowd.output().grid.vertexCount);
        return std::vector<uint32_t>(written.attributes.begin(), end);
    };
    EXPECT_EQ(uvsOf(SUPPLE_SCHEME_PM, SUPPLE_UV_FROM_FILE), uvsOf(SUPPLE_SCHEME_PM, SUPPLE_UV_LINEAR_ALL));
    character.parts[0].uvMode = UvMode::boundaries;
    EXPECT_EQ(uvsOf(SUPPLE_SCHEME_PM, SUPPLE_UV_FROM_FILE), uvsOf(SUPPLE_SCHEME_PM, SUPPLE_UV_LINEAR_BOUNDARIES));
    EXPECT_NE(uvsOf(SUPPLE_SCHEME_PM, SUPPLE_UV_FROM_FILE), uvsOf(SUPPLE_SCHEME_PM, SUPPLE_UV_LINEAR_NONE));
    std::string told;
    EXPECT_EQ(uvsOf(SUPPLE_SCHEME_BLEND, SUPPLE_UV_FROM_FILE, &told), uvsOf(SUPPLE_SCHEME_BLEND, SUPPLE_UV_LINEAR_ALL));
    EXPECT_NE(told.find("by \"boundaries\": they are linear"), std::string::npos) << told;
}

} // namespace
} // namespace supple::test
