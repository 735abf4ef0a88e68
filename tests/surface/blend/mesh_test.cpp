// Charts, kinds of vertices, the first step for cages of other faces, refusals.
#include "tests/support/blend_surface.h"
#include "tests/support/subdivision_zoo.h"

#include <algorithm>
#include <set>
#include <string>

namespace supple::surface::blend {
namespace {

using test::blendMesh;

/// The classes of a vertex's charts.
std::vector<ChartClass> classesAt(const Mesh& mesh, uint32_t vertex) {
    std::vector<ChartClass> classes;
    for (uint32_t i = mesh.chartStarts[vertex]; i < mesh.chartStarts[vertex + 1]; ++i) {
        classes.push_back(mesh.classOf(i));
    }
    return classes;
}

using Classes = std::vector<ChartClass>;

cage::Cage withCreases(cage::Cage cage, std::vector<cage::Crease> creases) {
    cage.creases = std::move(creases);
    return cage;
}

TEST(BlendMesh, chartsCoverEveryCornerOnce) {
    for (const CreaseMode mode : test::kCreaseModes) {
        for (const test::SubdivisionCage& entry : test::subdivisionZoo()) {
            SCOPED_TRACE(entry.name);
            const Mesh mesh = blendMesh(entry.cage, {mode});
            ASSERT_EQ(mesh.corners.size(), 4u * mesh.cage.faceCount());
            ASSERT_EQ(mesh.chartStarts.size(), mesh.cage.vertexCount() + 1u);
            EXPECT_TRUE(std::is_sorted(mesh.classes.begin(), mesh.classes.end()));
            std::set<std::pair<uint32_t, uint32_t>> sectors;
            for (uint32_t c = 0; c < mesh.cage.cornerCount(); ++c) {
                const Corner& corner = mesh.corners[c];
                const Chart& chart = mesh.charts[corner.chart];
                const ChartClass& chartClass = mesh.classOf(corner.chart);
                ASSERT_EQ(chart.vertex, mesh.cage.faceVertices[c]);
                if (chartClass.kind == ChartKind::point) {
                    EXPECT_EQ(corner.sector, 0u);
                    continue;
                }
                EXPECT_LT(corner.sector, chartClass.sectors);
                EXPECT_TRUE(sectors.insert({corner.chart, corner.sector}).second);
                const uint32_t face = 4 * (c / 4);
                const auto after = [&](uint32_t k) { return mesh.cage.faceVertices[face + (c + k) % 4]; };
                const uint32_t count = chartClass.ringPoints();
                const auto ring = [&](uint32_t i) { return mesh.ring[chart.firstRing + i % count]; };
                if (chartClass.kind != ChartKind::curve) {
                    EXPECT_EQ(ring(2 * corner.sector), after(1));
                    EXPECT_EQ(ring(2 * corner.sector + 1), after(2));
                    EXPECT_EQ(ring(2 * corner.sector + 2), after(3));
                } else {
                    EXPECT_TRUE(corner.sector > 0 || ring(0) == after(1));
                    EXPECT_TRUE(corner.sector + 1 < chartClass.sectors || ring(1) == after(3));
                }
            }
            uint32_t expected = 0, points = 0;
            for (uint32_t i = 0; i < mesh.charts.size(); ++i) {
                EXPECT_EQ(mesh.charts[i].firstRing, points);
                points += mesh.classOf(i).ringPoints();
                expected += mesh.classOf(i).sectors;
            }
            EXPECT_EQ(points, mesh.ring.size());
            EXPECT_EQ(sectors.size(), expected);
        }
    }
}

TEST(BlendMesh, quadsStayAsTheyAre) {
    const cage::Cage cage = test::rotatedFaces(test::jack());
    const Mesh mesh = blendMesh(cage);
    EXPECT_FALSE(mesh.refined);
    EXPECT_EQ(mesh.cage.faceVertices, cage.faceVertices);
    EXPECT_EQ(mesh.cage.positions, cage.positions);
    EXPECT_TRUE(mesh.notes.empty());
    ASSERT_EQ(mesh.stencils.rows(), cage.vertexCount());
    EXPECT_EQ(mesh.hostVertices, cage.vertexCount());
    EXPECT_EQ(classesAt(mesh, 0)[0].kind, ChartKind::interior);
}

TEST(BlendMesh, otherFacesTakeAStepFirst) {
    cage::Cage cage = test::cappedCylinder(7, 3);
    cage.holes = {2};
    for (uint32_t c = 0; c < cage.cornerCount(); ++c) {
        cage.cornerUvs.emplace_back(c, 1.0f);
    }
    const Mesh mesh = blendMesh(cage);
    EXPECT_TRUE(mesh.refined);
    EXPECT_TRUE(test::allQuads(mesh.cage));
    EXPECT_EQ(mesh.cage.faceCount(), cage.cornerCount());
    ASSERT_EQ(mesh.notes.size(), 1u);
    EXPECT_EQ(mesh.notes[0], "14 of 28 faces are no quads: the cage takes one step of Catmull-Clark first");
    // The same step as the rules say in double.
    const test::RefinedCage expected = test::refineCatmullClark(cage, test::doublePositions(cage), true);
    const std::vector<glm::dvec3> positions =
        applyStencils<double>(mesh.stencils, std::span<const glm::dvec3>(test::doublePositions(cage)));
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        EXPECT_LT(glm::distance(positions[v], expected.positions[v]), 1e-15);
    }
    for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
        EXPECT_EQ(std::binary_search(mesh.cage.holes.begin(), mesh.cage.holes.end(), f), mesh.sourceFaces[f] == 2);
        EXPECT_LT(mesh.cage.faceVertices[4 * f], mesh.hostVertices);
        EXPECT_EQ(mesh.cage.faceVertices[4 * f], cage.faceVertices[f]); // a face a corner, in order
        EXPECT_EQ(mesh.cage.cornerUvs[4 * f], cage.cornerUvs[f]);
        EXPECT_GE(mesh.cage.faceVertices[4 * f + 2], mesh.hostVertices);
    }
}

TEST(BlendMesh, halvesOfSharpEdgesAreSharp) {
    cage::Cage cage = test::perturbed(test::cappedCylinder(6, 4), 0.1f, 3); // rings of 6, then the two poles
    for (uint32_t k = 0; k < 6; ++k) {
        const uint32_t next = (k + 1) % 6;
        cage.creases.push_back({6 + k, 6 + next, 1.0f});
        cage.creases.push_back({12 + k, 12 + next, 0.9f}); // below the threshold
    }
    for (const CreaseMode mode : test::kCreaseModes) {
        const Mesh mesh = blendMesh(cage, {mode});
        ASSERT_TRUE(mesh.refined);
        const ChartKind kind = mode == CreaseMode::cut ? ChartKind::cut : ChartKind::curve;
        EXPECT_EQ(std::count(mesh.edgeSharp.begin(), mesh.edgeSharp.end(), 1), 12);
        uint32_t creased = 0;
        for (uint32_t v = 0; v < mesh.cage.vertexCount(); ++v) {
            const Classes classes = classesAt(mesh, v);
            if (classes.size() == 2) {
                ++creased;
                EXPECT_EQ(classes, (Classes{{kind, 2}, {kind, 2}}));
            }
        }
        EXPECT_EQ(creased, 12u);
        // A sharp edge's middle is on the edge, a smooth one's is not.
        const std::vector<glm::vec3> p =
            applyStencils<float>(mesh.stencils, std::span<const glm::vec3>(cage.positions));
        const cage::Topology topology = *cage::buildTopology(cage);
        for (const cage::Crease& crease : cage.creases) {
            const uint32_t edge = cage::findEdge(cage, topology, crease.a, crease.b);
            const glm::vec3 middle = 0.5f * (cage.positions[crease.a] + cage.positions[crease.b]);
            const float distance = glm::distance(p[cage.vertexCount() + edge], middle);
            EXPECT_EQ(distance < 1e-6f, crease.sharpness >= 1.0f);
        }
    }
}

// The vertices of the grid of four by four are 5 y + x.
TEST(BlendMesh, kindsByTheNumberOfSharpEdges) {
    const cage::Cage flat = test::grid(4, 4);
    struct Case {
        const char* what;
        std::vector<cage::Crease> creases;
        uint32_t vertex;
        Classes cut, curve;
    };
    const ChartClass kPoint{ChartKind::point, 0};
    const std::vector<Case> cases{
        {"none", {}, 12, {{ChartKind::interior, 4}}, {{ChartKind::interior, 4}}},
        {"a tip", {{12, 11, 5.0f}}, 12, {{ChartKind::interior, 4}}, {kPoint}},
        {"straight through",
         {{12, 11, 1.0f}, {12, 13, 1.0f}},
         12,
         {{ChartKind::cut, 2}, {ChartKind::cut, 2}},
         {{ChartKind::curve, 2}, {ChartKind::curve, 2}}},
        {"round a corner", {{12, 11, 1.0f}, {12, 7, 1.0f}}, 12, {}, {}},
        {"three", {{12, 11, 1.0f}, {12, 13, 1.0f}, {12, 7, 1.0f}}, 12, {kPoint}, {kPoint}},
        {"soft", {{12, 11, 0.99f}, {12, 13, 0.99f}}, 12, {{ChartKind::interior, 4}}, {{ChartKind::interior, 4}}},
        {"a boundary", {}, 2, {{ChartKind::boundary, 2}}, {{ChartKind::boundary, 2}}},
        {"a boundary's corner", {}, 0, {{ChartKind::boundary, 1}}, {{ChartKind::boundary, 1}}},
        {"into a boundary", {{2, 7, 1.0f}}, 2, {kPoint}, {kPoint}},
        {"along a boundary", {{1, 2, 1.0f}, {2, 3, 1.0f}}, 2, {{ChartKind::boundary, 2}}, {{ChartKind::curve, 2}}},
        {"an end on a boundary", {{1, 2, 1.0f}}, 2, {{ChartKind::boundary, 2}}, {kPoint}},
        {"round a boundary's corner",
         {{1, 0, 1.0f}, {0, 5, 1.0f}},
         0,
         {{ChartKind::boundary, 1}},
         {{ChartKind::curve, 1}}},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.what);
        const cage::Cage cage = withCreases(flat, c.creases);
        for (const CreaseMode mode : test::kCreaseModes) {
            Classes classes = classesAt(blendMesh(cage, {mode}), c.vertex);
            if (c.cut.empty()) { // which side comes first hangs on the fan
                ASSERT_EQ(classes.size(), 2u);
                EXPECT_EQ(std::min(classes[0].sectors, classes[1].sectors), 1u);
                EXPECT_EQ(std::max(classes[0].sectors, classes[1].sectors), 3u);
            } else {
                EXPECT_EQ(classes, mode == CreaseMode::cut ? c.cut : c.curve);
            }
        }
    }
}

TEST(BlendMesh, theThresholdCanBeMoved) {
    const cage::Cage cage = withCreases(test::grid(4, 4), {{11, 12, 0.5f}, {12, 13, 3.0f}});
    const auto sharp = [&](float threshold) {
        const Mesh mesh = blendMesh(cage, {CreaseMode::cut, threshold});
        return std::count(mesh.edgeSharp.begin(), mesh.edgeSharp.end(), 1);
    };
    EXPECT_EQ(sharp(1.0f), 1);
    EXPECT_EQ(sharp(0.5f), 2);
    EXPECT_EQ(sharp(4.0f), 0);
}

TEST(BlendMesh, sharpVerticesArePoints) {
    cage::Cage cage = test::grid(4, 4);
    cage.sharpVertices = {{12, cage::kHardSharpness}, {2, cage::kHardSharpness}, {6, 3.0f}};
    const Mesh mesh = blendMesh(cage);
    EXPECT_EQ(classesAt(mesh, 12)[0].kind, ChartKind::point);
    EXPECT_EQ(classesAt(mesh, 2)[0].kind, ChartKind::point);
    EXPECT_EQ(classesAt(mesh, 6)[0].kind, ChartKind::interior);
}

TEST(BlendMesh, edgesBetweenPointsLieStill) {
    // Two corners of three sharp edges each, and a smooth edge from one to the other.
    const cage::Cage cage =
        withCreases(test::grid(5, 4),
                    {{13, 12, 1.0f}, {13, 7, 1.0f}, {13, 19, 1.0f}, {14, 15, 1.0f}, {14, 8, 1.0f}, {14, 20, 1.0f}});
    for (const CreaseMode mode : test::kCreaseModes) {
        const Mesh mesh = blendMesh(cage, {mode});
        const uint32_t edge = cage::findEdge(mesh.cage, mesh.topology, 13, 14);
        EXPECT_EQ(mesh.edgeSharp[edge], 0);
        EXPECT_TRUE(flatAcross(mesh, mesh.topology.edges[edge].corner));
        EXPECT_TRUE(flatAcross(mesh, mesh.topology.edges[edge].twin));
        const uint32_t other = cage::findEdge(mesh.cage, mesh.topology, 1, 2);
        EXPECT_FALSE(flatAcross(mesh, mesh.topology.edges[other].corner));
    }
}

TEST(BlendMesh, namesWhatItDoesNotUse) {
    cage::Cage cage = withCreases(test::grid(2, 2), {{0, 8, 2.0f}});
    cage.creaseScalars = {{0, 1, 0.5f}};
    const Mesh mesh = blendMesh(cage);
    ASSERT_EQ(mesh.notes.size(), 2u);
    EXPECT_NE(mesh.notes[0].find("(0, 8)"), std::string::npos);
    EXPECT_NE(mesh.notes[1].find("crease scalars"), std::string::npos);
}

TEST(BlendMesh, refusesByName) {
    const auto refusal = [](const cage::Cage& cage) {
        const Result<Mesh> mesh = buildMesh(cage);
        return mesh.ok() ? std::string() : mesh.error().message;
    };
    // Three squares on one edge.
    const std::vector<glm::vec3> points{{0.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f},  {1.0f, 0.0f, 0.0f},
                                        {1.0f, 1.0f, 0.0f}, {-1.0f, 0.0f, 0.0f}, {-1.0f, 1.0f, 0.0f},
                                        {0.0f, 0.0f, 1.0f}, {0.0f, 1.0f, 1.0f}};
    EXPECT_NE(refusal(test::makeCage(points, {{0, 2, 3, 1}, {1, 5, 4, 0}, {0, 1, 7, 6}})).find("edge (0, 1)"),
              std::string::npos);
    // Two squares round a vertex, closed.
    const cage::Cage pillow = test::makeCage({points.begin(), points.begin() + 4}, {{0, 2, 3, 1}, {1, 3, 2, 0}});
    EXPECT_NE(refusal(pillow).find("valence 2"), std::string::npos) << refusal(pillow);
    EXPECT_FALSE(refusal({}).empty());
}

} // namespace
} // namespace supple::surface::blend
