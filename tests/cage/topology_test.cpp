#include "cage/topology.h"
#include "tests/support/meshes.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace supple::cage {
namespace {

using test::Faces;
using test::makeCage;

std::vector<glm::vec3> points(size_t count) {
    return std::vector<glm::vec3>(count, glm::vec3(0.0f));
}

std::string faultOf(const Cage& cage) {
    const Result<Topology> result = buildTopology(cage);
    if (result.ok()) {
        return "accepted";
    }
    EXPECT_EQ(result.error().code, ErrorCode::asset);
    return result.error().message;
}

std::string faultOf(size_t vertexCount, const Faces& polygons) {
    return faultOf(makeCage(points(vertexCount), polygons));
}

/// Everything the header promises, checked against the faces themselves.
void checkTopology(const Cage& cage) {
    Result<Topology> result = buildTopology(cage);
    ASSERT_TRUE(result.ok()) << result.error().message;
    const Topology& t = *result;
    const uint32_t cornerCount = cage.cornerCount();
    ASSERT_EQ(t.cornerFaces.size(), cornerCount);
    ASSERT_EQ(t.cornerSpokes.size(), cornerCount);
    ASSERT_EQ(t.cornerSpokesBack.size(), cornerCount);
    ASSERT_EQ(t.twins.size(), cornerCount);
    ASSERT_EQ(t.cornerEdges.size(), cornerCount);
    ASSERT_EQ(t.boundary.size(), cage.vertexCount());
    ASSERT_EQ(t.spokeStarts.size(), cage.vertexCount() + 1);
    ASSERT_EQ(t.spokeVertices.size(), t.spokeStarts.back());
    ASSERT_EQ(t.sectorCorners.size(), t.spokeStarts.back());

    std::map<std::pair<uint32_t, uint32_t>, uint32_t> halfEdges;
    std::vector<std::set<uint32_t>> cornersOf(cage.vertexCount());
    std::vector<uint32_t> next(cornerCount);
    std::vector<uint32_t> previous(cornerCount);
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        const uint32_t sides = cage.sides(f);
        for (uint32_t j = 0; j < sides; ++j) {
            const uint32_t c = cage.faceStarts[f] + j;
            next[c] = cage.faceStarts[f] + (j + 1) % sides;
            previous[c] = cage.faceStarts[f] + (j + sides - 1) % sides;
            EXPECT_EQ(nextCorner(cage, f, c), next[c]);
            EXPECT_EQ(previousCorner(cage, f, c), previous[c]);
            EXPECT_EQ(t.cornerFaces[c], f);
            halfEdges[{cage.faceVertices[c], cage.faceVertices[next[c]]}] = c;
            cornersOf[cage.faceVertices[c]].insert(c);
        }
    }
    uint32_t edgeCount = 0;
    uint32_t lastOwner = 0;
    for (uint32_t c = 0; c < cornerCount; ++c) {
        const auto twin = halfEdges.find({cage.faceVertices[next[c]], cage.faceVertices[c]});
        EXPECT_EQ(t.twins[c], twin == halfEdges.end() ? kNone : twin->second);
        ASSERT_LT(t.cornerEdges[c], t.edges.size());
        const Topology::Edge& edge = t.edges[t.cornerEdges[c]];
        EXPECT_EQ(edge.corner, std::min(c, t.twins[c]));
        EXPECT_EQ(edge.twin, t.twins[edge.corner]);
        if (edge.corner == c) {
            EXPECT_TRUE(edgeCount == 0 || lastOwner < c);
            EXPECT_EQ(t.cornerEdges[c], edgeCount);
            lastOwner = c;
            ++edgeCount;
        }
    }
    EXPECT_EQ(t.edges.size(), edgeCount);

    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        const uint32_t base = t.spokeStarts[v];
        const uint32_t spokes = t.spokeCount(v);
        const uint32_t sectors = t.sectorCount(v);
        ASSERT_EQ(sectors, cornersOf[v].size());
        ASSERT_EQ(spokes, sectors + t.boundary[v]);
        std::set<uint32_t> walked;
        for (uint32_t k = 0; k < sectors; ++k) {
            const uint32_t c = t.sectorCorners[base + k];
            ASSERT_LT(c, cornerCount);
            EXPECT_EQ(cage.faceVertices[c], v);
            walked.insert(c);
            EXPECT_EQ(t.cornerSpokes[c], base + k);
            EXPECT_EQ(t.cornerSpokesBack[c], base + (k + 1) % spokes);
            // Spoke k runs to the next vertex of the face, spoke k+1 to the previous one: counter-clockwise.
            EXPECT_EQ(t.spokeVertices[base + k], cage.faceVertices[next[c]]);
            EXPECT_EQ(t.spokeVertices[base + (k + 1) % spokes], cage.faceVertices[previous[c]]);
        }
        EXPECT_EQ(walked, cornersOf[v]);
        if (t.boundary[v] != 0) {
            EXPECT_EQ(t.twins[t.sectorCorners[base]], kNone);
            EXPECT_EQ(t.sectorCorners[base + sectors], kNone);
            EXPECT_EQ(t.twins[previous[t.sectorCorners[base + sectors - 1]]], kNone);
            EXPECT_EQ(t.effectiveValence(v), 2 * sectors);
        } else {
            EXPECT_EQ(t.sectorCorners[base], *cornersOf[v].begin());
            EXPECT_EQ(t.effectiveValence(v), sectors);
        }
    }
}

TEST(Topology, cube) {
    const Cage cage = test::cube();
    checkTopology(cage);
    const Topology t = *buildTopology(cage);
    EXPECT_EQ(t.edges.size(), 12u);
    for (uint32_t v = 0; v < 8; ++v) {
        EXPECT_EQ(t.effectiveValence(v), 3u);
        EXPECT_EQ(t.boundary[v], 0);
    }
    // Vertex 0, by hand: faces {0,2,3,1}, {0,1,5,4}, {0,4,6,2}; seen from outside 2 -> 1 -> 4 runs counter-clockwise.
    EXPECT_EQ(t.spokeVertices[0], 2u);
    EXPECT_EQ(t.spokeVertices[1], 1u);
    EXPECT_EQ(t.spokeVertices[2], 4u);
}

TEST(Topology, openGrid) {
    const Cage cage = test::grid(3, 2);
    checkTopology(cage);
    const Topology t = *buildTopology(cage);
    EXPECT_EQ(t.edges.size(), 17u);
    EXPECT_EQ(t.effectiveValence(0), 2u);
    EXPECT_EQ(t.effectiveValence(1), 4u);
    EXPECT_EQ(t.effectiveValence(5), 4u);
    EXPECT_EQ(t.boundary[5], 0);
    // Corner vertex 0: spoke 0 to vertex 1 (no face on its clockwise side), spoke 1 to vertex 4.
    EXPECT_EQ(t.spokeVertices[t.spokeStarts[0]], 1u);
    EXPECT_EQ(t.spokeVertices[t.spokeStarts[0] + 1], 4u);
}

TEST(Topology, singlePolygons) {
    checkTopology(makeCage(points(3), {{0, 1, 2}}));
    checkTopology(makeCage(points(4), {{3, 1, 0, 2}}));
    checkTopology(makeCage(points(7), {{6, 5, 4, 3, 2, 1, 0}}));
}

TEST(Topology, mixedPolygons) {
    checkTopology(test::prism(3));
    checkTopology(test::prism(5));
    checkTopology(test::prism(9));
    checkTopology(test::withoutFaces(test::prism(7), {7}));
    checkTopology(test::withoutFaces(test::prism(7), {0, 3}));
}

TEST(Topology, otherCages) {
    checkTopology(test::torus(5, 4));
    checkTopology(test::trapezohedron(7));
    checkTopology(test::fan(5, 2, 6.28, true));
    checkTopology(test::fan(5, 2, 4.0, false));
    checkTopology(test::rotatedFaces(test::trapezohedron(12)));
    // Boundaries that meet in no vertex, two separate components.
    Cage two = test::cube();
    const Cage other = test::grid(2, 2);
    for (const uint32_t v : other.faceVertices) {
        two.faceVertices.push_back(v + 8);
    }
    for (uint32_t f = 0; f < other.faceCount(); ++f) {
        two.faceStarts.push_back(two.faceStarts.back() + 4);
    }
    two.positions.insert(two.positions.end(), other.positions.begin(), other.positions.end());
    checkTopology(two);
}

TEST(Topology, proceduralCages) {
    const Cage sphere = makeCubeSphere(15);
    EXPECT_EQ(sphere.faceCount(), 1350u);
    EXPECT_EQ(sphere.vertexCount(), 1352u);
    checkTopology(sphere);
    checkTopology(makeCubeSphere(1));
    const Topology s = *buildTopology(sphere);
    std::map<uint32_t, uint32_t> valences;
    for (uint32_t v = 0; v < sphere.vertexCount(); ++v) {
        ++valences[s.effectiveValence(v)];
    }
    EXPECT_EQ(valences, (std::map<uint32_t, uint32_t>{{3, 8}, {4, 1344}}));

    const Cage split = makeSplitTorus(18, 12);
    EXPECT_EQ(split.faceCount(), 1296u);
    checkTopology(split);
    const Topology t = *buildTopology(split);
    for (uint32_t f = 0; f < split.faceCount(); ++f) {
        std::multiset<uint32_t> corners;
        for (uint32_t c = split.faceStarts[f]; c < split.faceStarts[f + 1]; ++c) {
            corners.insert(t.effectiveValence(split.faceVertices[c]));
        }
        EXPECT_EQ(corners, (std::multiset<uint32_t>{3, 4, 4, 6}));
    }

    EXPECT_EQ(makeCubeSphere(0).faceCount(), 0u);
    EXPECT_EQ(makeSplitTorus(2, 12).faceCount(), 0u);
}

TEST(Topology, proceduralCagesFaceOutwards) {
    const Cage sphere = makeCubeSphere(4);
    for (uint32_t f = 0; f < sphere.faceCount(); ++f) {
        const auto p = [&](uint32_t j) { return sphere.positions[sphere.faceVertices[4 * f + j]]; };
        EXPECT_GT(glm::dot(glm::cross(p(2) - p(0), p(3) - p(1)), p(0) + p(1) + p(2) + p(3)), 0.0f);
    }
    const Cage split = makeSplitTorus(18, 12);
    for (uint32_t f = 0; f < split.faceCount(); ++f) {
        const auto p = [&](uint32_t j) { return split.positions[split.faceVertices[4 * f + j]]; };
        const glm::vec3 centre = (p(0) + p(1) + p(2) + p(3)) / 4.0f;
        const glm::vec3 ring = glm::normalize(glm::vec3(centre.x, 0.0f, centre.z));
        EXPECT_GT(glm::dot(glm::cross(p(2) - p(0), p(3) - p(1)), centre - ring), 0.0f);
    }
}

TEST(TopologyFaults, empty) {
    EXPECT_EQ(faultOf(Cage{}), "the cage has no faces");
    EXPECT_EQ(faultOf(3, {}), "the cage has no faces");
}

TEST(TopologyFaults, brokenArrays) {
    Cage cage = test::cube();
    cage.faceStarts[0] = 2;
    EXPECT_EQ(faultOf(cage), "the corners of face 0 start at 2 and not at 0");
    cage = test::cube();
    cage.faceStarts[3] = 4;
    EXPECT_EQ(faultOf(cage), "face 2: ends at corner 4, before its start at 8");
    cage = test::cube();
    cage.faceVertices.pop_back();
    EXPECT_EQ(faultOf(cage), "the faces have 24 corners, but 23 vertex indices are given");
    cage.faceVertices.clear();
    EXPECT_EQ(faultOf(cage), "the faces have 24 corners, but 0 vertex indices are given");
    cage = test::cube();
    cage.faceStarts.back() = 0xFFFFFFFFu;
    EXPECT_EQ(faultOf(cage), "the faces have 4294967295 corners, but 24 vertex indices are given");
}

TEST(TopologyFaults, tooFewCorners) {
    EXPECT_EQ(faultOf(3, {{0, 1, 2}, {0, 1}}), "face 1: two corners, at least three are needed");
    EXPECT_EQ(faultOf(3, {{0, 1, 2}, {}}), "face 1: no corners, at least three are needed");
    EXPECT_EQ(faultOf(3, {{2}}), "face 0: one corner, at least three are needed");
}

TEST(TopologyFaults, outOfRange) {
    EXPECT_EQ(faultOf(4, {{0, 1, 2}, {0, 2, 4}}), "face 1: corner 2 is vertex 4, but there are only 4 vertices");
    EXPECT_EQ(faultOf(4, {{0, kNone, 2}}), "face 0: corner 1 is vertex 4294967295, but there are only 4 vertices");
    EXPECT_EQ(faultOf(0, {{0, 1, 2}}), "face 0: corner 0 is vertex 0, but there are only 0 vertices");
}

TEST(TopologyFaults, repeatedVertex) {
    EXPECT_EQ(faultOf(4, {{0, 1, 2, 1}}), "face 0: vertex 1 appears more than once");
    EXPECT_EQ(faultOf(4, {{0, 1, 2}, {2, 2, 3}}), "face 1: vertex 2 appears more than once");
}

TEST(TopologyFaults, crowdedEdge) {
    EXPECT_EQ(faultOf(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), "edge (0, 1): three faces meet here: 0, 1, 2");
    Faces book;
    for (uint32_t k = 0; k < 12; ++k) {
        book.push_back({0, 1, 2 + k});
    }
    EXPECT_EQ(faultOf(14, book), "edge (0, 1): 12 faces meet here: 0, 1, 2, 3, 4, 5, 6, 7, ...");
}

TEST(TopologyFaults, flippedFace) {
    Cage cage = test::cube();
    std::reverse(cage.faceVertices.begin() + 8, cage.faceVertices.begin() + 12);
    EXPECT_EQ(faultOf(cage), "edge (1, 0): flipped orientation: faces 0 and 2 run along it in the same direction");
    EXPECT_EQ(faultOf(4, {{0, 1, 2}, {3, 1, 2}}),
              "edge (1, 2): flipped orientation: faces 0 and 1 run along it in the same direction");
    EXPECT_EQ(faultOf(4, {{0, 2, 1}, {3, 2, 1}}),
              "edge (2, 1): flipped orientation: faces 0 and 1 run along it in the same direction");
}

TEST(TopologyFaults, duplicateFace) {
    EXPECT_EQ(faultOf(3, {{0, 1, 2}, {1, 2, 0}}),
              "edge (0, 1): duplicate face: faces 0 and 1 run along it in the same direction");
    Cage cage = test::cube();
    cage.faceVertices.insert(cage.faceVertices.end(), {3, 1, 0, 2}); // face 0 once more
    cage.faceStarts.push_back(28);
    EXPECT_EQ(faultOf(cage), "edge (0, 1): three faces meet here: 0, 2, 6 (6 duplicates 0)");
}

TEST(TopologyFaults, bowTie) {
    EXPECT_EQ(faultOf(5, {{0, 1, 2}, {0, 3, 4}}),
              "vertex 0: several separate fans of faces meet here (two faces, one in the first fan)");
    // Two tetrahedra that share vertex 0: closed fans.
    EXPECT_EQ(faultOf(7, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {6, 5, 4}}),
              "vertex 0: several separate fans of faces meet here (six faces, three in the first fan)");
    // One closed fan and one open one.
    EXPECT_EQ(faultOf(6, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}, {0, 4, 5}}),
              "vertex 0: several separate fans of faces meet here (four faces, one in the first fan)");
}

TEST(TopologyFaults, isolatedVertex) {
    EXPECT_EQ(faultOf(4, {{0, 1, 3}}), "vertex 2: no face uses it");
    EXPECT_EQ(faultOf(4, {{0, 1, 2}}), "vertex 3: no face uses it");
}

TEST(TopologyFaults, interiorValenceTwo) {
    // Two quads back to back, and two quads that share two edges.
    EXPECT_EQ(faultOf(4, {{0, 1, 2, 3}, {3, 2, 1, 0}}), "vertex 0: interior valence 2, between faces 0 and 1");
    EXPECT_EQ(faultOf(5, {{0, 1, 2, 3}, {0, 3, 2, 4}}), "vertex 3: interior valence 2, between faces 0 and 1");
}

TEST(Topology, hubIsFast) {
    // 200,000 triangles round one vertex: the pairing and the walk stay near linear.
    constexpr uint32_t kCount = 200000;
    Faces polygons;
    for (uint32_t k = 0; k < kCount; ++k) {
        polygons.push_back({0, 1 + k, 1 + (k + 1) % kCount});
    }
    const Result<Topology> result = buildTopology(makeCage(points(kCount + 1), polygons));
    ASSERT_TRUE(result.ok()) << result.error().message;
    EXPECT_EQ(result->effectiveValence(0), kCount);
}

} // namespace
} // namespace supple::cage
