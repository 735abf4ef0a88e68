// T-corners: vertices of neighbours on a face's edge.
#include "cage/formats/reader.h"
#include "tests/cage/gltf/builder.h"
#include "tests/cage/gltf/reading.h"
#include "tests/cage/repair/repaired.h"

#include <algorithm>
#include <map>

namespace supple::cage {
namespace {

using namespace test;

/// A cube of corners at +-1 whose face at z = 1 is two quads, with vertices 8 and 9 in the middle of its edges (4, 5)
/// and (7, 6). Faces 1 and 3 have the whole edges.
Cage splitCube() {
    std::vector<glm::vec3> positions = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1},
                                        {1, -1, 1},   {1, 1, 1},   {-1, 1, 1}, {0, -1, 1},  {0, 1, 1}};
    return makeCage(std::move(positions),
                    {{3, 2, 1, 0}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 8, 9, 7}, {8, 5, 6, 9}});
}

size_t openEdges(const Cage& cage) {
    const Result<Topology> topology = buildTopology(cage);
    EXPECT_TRUE(topology.ok());
    return static_cast<size_t>(std::count_if(topology->edges.begin(), topology->edges.end(),
                                             [](const Topology::Edge& edge) { return edge.twin == kNone; }));
}

/// The same faces, whatever corner they begin at.
bool sameFace(std::vector<uint32_t> face, const std::vector<uint32_t>& other) {
    for (size_t turns = 0; turns < face.size(); ++turns) {
        if (face == other) {
            return true;
        }
        std::rotate(face.begin(), face.begin() + 1, face.end());
    }
    return false;
}

/// Two rows of quads above each other, which meet on the line y = 0 from x = 0 to 4: `above` and `below` are the places
/// of their vertices on it. Vertices: those on the line by x, then those above, then those below. Faces from the left.
Cage rows(const std::vector<float>& above, const std::vector<float>& below) {
    std::map<float, uint32_t> onLine;
    for (const auto* places : {&above, &below}) {
        for (const float x : *places) {
            onLine.emplace(x, 0u);
        }
    }
    std::vector<glm::vec3> positions;
    for (auto& [x, vertex] : onLine) {
        vertex = static_cast<uint32_t>(positions.size());
        positions.emplace_back(x, 0, 0);
    }
    Faces faces;
    for (const bool up : {true, false}) {
        const std::vector<float>& places = up ? above : below;
        const auto first = static_cast<uint32_t>(positions.size());
        for (const float x : places) {
            positions.emplace_back(x, up ? 1 : -1, 0);
        }
        for (uint32_t i = 0; i + 1 < places.size(); ++i) {
            const uint32_t a = onLine[places[i]], b = onLine[places[i + 1]];
            faces.push_back(up ? std::vector<uint32_t>{a, b, first + i + 1, first + i}
                               : std::vector<uint32_t>{first + i, first + i + 1, b, a});
        }
    }
    return makeCage(std::move(positions), faces);
}

TEST(RepairTCorners, QuadsBecomeFiveSided) {
    const Cage cube = splitCube();
    ASSERT_EQ(openEdges(cube), 6u);
    const Repaired r = afterRepair(cube);
    EXPECT_EQ(r.found, Strings{"cage: 2 T-corners, the first is vertex 8 on edge (4, 5) of face 1"});
    EXPECT_EQ(r.repairs, Strings{"made five-sided facets"});
    EXPECT_EQ(openEdges(r.cage), 0u);
    EXPECT_EQ(r.cage.positions, cube.positions);
    const Faces before = facesOf(cube), after = facesOf(r.cage);
    ASSERT_EQ(after.size(), 7u);
    for (const size_t f : {0, 2, 4, 5, 6}) {
        EXPECT_EQ(after[f], before[f]) << f;
    }
    EXPECT_TRUE(sameFace(after[1], {0, 1, 5, 8, 4}));
    EXPECT_TRUE(sameFace(after[3], {2, 3, 7, 9, 6}));
    EXPECT_TRUE(afterRepair(r.cage).found.empty());
}

TEST(RepairTCorners, TheNewCornerHasWhatTheEdgeHasThere) {
    Cage row = rows({0, 4}, {0, 1, 4});
    for (uint32_t c = 0; c < row.cornerCount(); ++c) {
        const glm::vec3 at = row.positions[row.faceVertices[c]];
        const bool above = c < 4;
        row.cornerUvs.emplace_back(above ? 10.0f + at.x : 0.25f * at.x, at.y);
        row.cornerUvs1.emplace_back(3.0f * at.x, above ? 1.0f : 0.0f);
        row.cornerColors.emplace_back(at.x / 4.0f, above ? 1.0f : 0.0f, 0.0f, 1.0f);
        row.cornerNormals.emplace_back(0.0f, 0.0f, 1.0f);
        row.cornerTangents.emplace_back(1.0f, 0.0f, 0.0f, above ? -1.0f : 1.0f);
    }
    row.faceMaterials = {7, 8, 9};
    const Repaired r = afterRepair(row);
    EXPECT_EQ(r.found, Strings{"cage: 1 T-corner: vertex 1 on edge (0, 2) of face 0"});
    EXPECT_EQ(r.repairs, Strings{"made a five-sided facet"});
    ASSERT_EQ(r.cage.sides(0), 5u);
    ASSERT_EQ(r.cage.cornerUvs.size(), r.cage.cornerCount());
    const auto corner = static_cast<uint32_t>(
        std::find(r.cage.faceVertices.begin(), r.cage.faceVertices.begin() + 5, 1u) - r.cage.faceVertices.begin());
    ASSERT_LT(corner, 5u);
    EXPECT_EQ(r.cage.cornerUvs[corner], glm::vec2(11.0f, 0.0f));
    EXPECT_EQ(r.cage.cornerUvs1[corner], glm::vec2(3.0f, 1.0f));
    EXPECT_EQ(r.cage.cornerColors[corner], glm::vec4(0.25f, 1.0f, 0.0f, 1.0f));
    EXPECT_EQ(r.cage.cornerNormals[corner], glm::vec3(0.0f, 0.0f, 1.0f));
    EXPECT_EQ(r.cage.cornerTangents[corner], glm::vec4(1.0f, 0.0f, 0.0f, -1.0f));
    EXPECT_EQ(r.cage.faceMaterials, (Indices{7, 8, 9}));
    // Every other corner has what it had.
    for (uint32_t f = 0; f < 3; ++f) {
        for (uint32_t c = r.cage.faceStarts[f]; c < r.cage.faceStarts[f + 1]; ++c) {
            const glm::vec3 at = r.cage.positions[r.cage.faceVertices[c]];
            EXPECT_EQ(r.cage.cornerUvs[c], glm::vec2(f == 0 ? 10.0f + at.x : 0.25f * at.x, at.y));
        }
    }
}

TEST(RepairTCorners, NormalsGoOnAcrossASmoothEdge) {
    Cage row = rows({0, 4}, {0, 1, 4});
    const glm::vec3 up(0, 0, 1), tilted = glm::normalize(glm::vec3(0.5f, 0, 1)), other(0, 1, 0);
    const auto normalAtTCorner = [&](const glm::vec3& ofFace) {
        row.cornerNormals.clear();
        for (uint32_t c = 0; c < row.cornerCount(); ++c) {
            row.cornerNormals.push_back(row.faceVertices[c] == 1 ? tilted : c < 4 ? ofFace : up);
        }
        const Repaired r = afterRepair(row);
        const auto found = std::find(r.cage.faceVertices.begin(), r.cage.faceVertices.begin() + 5, 1u);
        return r.cage.cornerNormals[static_cast<size_t>(found - r.cage.faceVertices.begin())];
    };
    EXPECT_EQ(normalAtTCorner(up), tilted);
    EXPECT_EQ(normalAtTCorner(other), other);
    EXPECT_EQ(normalAtTCorner(glm::vec3(0.0f)), glm::vec3(0.0f)) << "a flat face stays flat";
}

TEST(RepairTCorners, SeveralOnAnEdgeAndInAFace) {
    const Repaired r = afterRepair(rows({0, 4}, {0, 1, 2, 4}));
    EXPECT_EQ(r.found, Strings{"cage: 2 T-corners, the first is vertex 1 on edge (0, 3) of face 0"});
    EXPECT_EQ(r.repairs, Strings{"made a six-sided facet"});
    EXPECT_TRUE(sameFace(facesOf(r.cage)[0], {0, 1, 2, 3, 5, 4}));
    EXPECT_EQ(openEdges(r.cage), 8u); // three above, five below
    // A cube of which two opposite faces are cut across each other: each other face has one T-corner or two.
    std::vector<glm::vec3> positions = splitCube().positions;
    positions.insert(positions.end(), {{-1, 0, -1}, {1, 0, -1}});
    Faces faces = facesOf(splitCube());
    faces[0] = {3, 2, 11, 10};
    faces.push_back({10, 11, 1, 0});
    const Repaired cube = afterRepair(makeCage(positions, faces));
    EXPECT_EQ(cube.found, Strings{"cage: 4 T-corners, the first is vertex 8 on edge (4, 5) of face 1"});
    EXPECT_EQ(cube.repairs, Strings{"made five-sided facets"});
    EXPECT_EQ(openEdges(cube.cage), 0u);
}

TEST(RepairTCorners, TrianglesBecomeQuadsAndPentagonsSixSided) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, 0, 0}, {1, -1, 0}};
    const Repaired r = afterRepair(makeCage(positions, {{0, 1, 2}, {0, 4, 3}, {3, 4, 1}}));
    EXPECT_EQ(r.repairs, Strings{"made a four-sided facet"});
    // The fan from vertex 0 would have a flat triangle.
    EXPECT_EQ(facesOf(r.cage)[0], (std::vector<uint32_t>{3, 1, 2, 0}));
    EXPECT_EQ(openEdges(r.cage), 4u);
    const std::vector<glm::vec3> five = {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 2, 0}, {-1, 1, 0}, {1, 0, 0}, {1, -1, 0}};
    const Repaired six = afterRepair(makeCage(five, {{0, 1, 2, 3, 4}, {0, 6, 5}, {5, 6, 1}}));
    EXPECT_EQ(six.repairs, Strings{"made a six-sided facet"});
    EXPECT_EQ(openEdges(six.cage), 6u);
    const Repaired both = afterRepair(rows({0, 1, 4}, {0, 0.5f, 1, 2, 3, 4}));
    EXPECT_EQ(both.repairs, Strings{"made facets of 5 to 6 sides"});
}

TEST(RepairTCorners, WhereTwoMeetThereIsOneFan) {
    const Cage cage = rows({0, 2, 4}, {0, 1, 2, 3, 4});
    ASSERT_FALSE(buildTopology(cage).ok()); // at x = 2 the faces above and those below are two fans
    const Repaired r = repaired(cage);
    EXPECT_EQ(r.found, Strings{"cage: 2 T-corners, the first is vertex 1 on edge (0, 2) of face 0"});
    EXPECT_EQ(r.repairs, Strings{"made five-sided facets"});
    EXPECT_EQ(r.cage.vertexCount(), cage.vertexCount());
    EXPECT_TRUE(r.cage.sharpVertices.empty());
}

TEST(RepairTCorners, OpeningsStay) {
    const auto expectNone = [](const Cage& cage, const char* what) {
        const Repaired r = afterRepair(cage);
        EXPECT_TRUE(std::none_of(r.found.begin(), r.found.end(), [](const std::string& found) {
            return found.find("T-corner") != std::string::npos;
        })) << what;
        EXPECT_EQ(r.cage.faceStarts, cage.faceStarts) << what;
    };
    expectNone(withoutFaces(grid(4, 4), {5, 6, 9}), "a hole");
    Cage slit = rows({0, 4}, {0, 1, 4});
    slit.positions[1].y = -0.005f; // more than a thousandth of the edge
    expectNone(slit, "a slit");
    slit.positions[1].y = -0.003f;
    EXPECT_EQ(afterRepair(slit).found.size(), 1u);
    expectNone(rows({0, 1, 4}, {0, 2, 4}), "both sides of the line are cut, at different places");
    // A cape of two sides with one outline: the one below is two faces.
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 0, 0}};
    expectNone(makeCage(positions, {{0, 1, 2}, {3, 0, 2}, {1, 3, 2}}), "back to back");
    // A face does not close on itself.
    expectNone(makeCage({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}}, {{0, 1, 2}}), "flat");
    expectNone(makeCage({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {{0, 1, 2, 3}}), "a point");
}

TEST(RepairTCorners, CreasesGoToThePieces) {
    Cage row = rows({0, 4}, {0, 1, 4});
    row.creases = {{2, 0, 3.0f}, {1, 2, 5.0f}, {3, 4, 1.0f}};
    row.creaseScalars = {{0, 2, 0.25f}, {2, 0, 0.5f}, {1, 2, 0.125f}};
    const Repaired r = afterRepair(row);
    std::map<std::pair<uint32_t, uint32_t>, float> creases, scalars;
    for (const Crease& crease : r.cage.creases) {
        creases[std::minmax(crease.a, crease.b)] = crease.sharpness;
    }
    for (const CreaseScalar& scalar : r.cage.creaseScalars) {
        scalars[{scalar.vertex, scalar.toward}] = scalar.alpha;
    }
    EXPECT_EQ(creases,
              (std::map<std::pair<uint32_t, uint32_t>, float>{{{0, 1}, 3.0f}, {{1, 2}, 5.0f}, {{3, 4}, 1.0f}}));
    EXPECT_EQ(scalars, (std::map<std::pair<uint32_t, uint32_t>, float>{
                           {{0, 1}, 0.25f}, {{1, 0}, 0.3125f}, {{1, 2}, 0.125f}, {{2, 1}, 0.5f}}));
    EXPECT_EQ(r.cage.creases.size(), 3u);
    EXPECT_EQ(r.cage.creaseScalars.size(), 4u);
}

TEST(RepairTCorners, SkinAndMorphsStay) {
    SkinWeights weights;
    for (uint32_t v = 0; v < 10; ++v) {
        weights.starts.push_back(v);
        weights.influences.push_back({v % 3, 1.0f});
    }
    weights.starts.push_back(10);
    const Morphs morphs{{MorphTarget{"wide", {2, 8}, {{1, 0, 0}, {0, 1, 0}}}}, {}};
    const Repaired r = afterRepair(splitCube(), weights, morphs);
    EXPECT_EQ(openEdges(r.cage), 0u);
    EXPECT_EQ(r.weights.starts, weights.starts);
    for (uint32_t v = 0; v < 10; ++v) {
        EXPECT_EQ(r.weights.influences[v].joint, v % 3);
    }
    EXPECT_EQ(r.morphs.targets[0].vertices, (Indices{2, 8}));
}

TEST(RepairTCorners, FacesTurnedAgainstTheirNeighboursJoinToo) {
    Cage cube = splitCube();
    std::reverse(cube.faceVertices.begin() + 4, cube.faceVertices.begin() + 8);
    const Repaired r = repaired(cube);
    EXPECT_EQ(r.found, (Strings{"cage: 2 T-corners, the first is vertex 8 on edge (4, 5) of face 1",
                                "cage: 1 face is turned against its neighbours: face 1"}));
    EXPECT_EQ(openEdges(r.cage), 0u);
    EXPECT_TRUE(sameFace(facesOf(r.cage)[1], {0, 1, 5, 8, 4}));
}

TEST(RepairTCorners, AVertexThatOneFaceHasLeavesIt) {
    // The neighbour has it between two of its own corners: it would be an inner vertex of two faces.
    Cage cube = supple::test::cube();
    Faces faces = facesOf(cube);
    std::vector<glm::vec3> positions = cube.positions;
    positions.push_back(0.5f * (positions[faces[0][0]] + positions[faces[0][1]]));
    faces[0].insert(faces[0].begin() + 1, 8);
    const Repaired r = afterRepair(makeCage(positions, faces));
    ASSERT_EQ(r.found.size(), 2u);
    EXPECT_NE(r.found[0].find("1 T-corner: vertex 8 on edge"), std::string::npos);
    EXPECT_EQ(r.repairs[1], "dissolved");
    EXPECT_EQ(openEdges(r.cage), 0u);
    EXPECT_EQ(r.cage.vertexCount(), 8u);
}

TEST(RepairTCorners, NoFaceTakesAVertexTwice) {
    // Two sides of face 0 lie nearly on one line, and so do two chains that have vertex 4 in common. Vertex 6 is near
    // the second side alone.
    const std::vector<glm::vec3> positions = {{0, 0, 0},  {4, 0, 0},       {1, 0.0039f, 0},   {0, 1, 0}, {2, 0, 0},
                                              {2, -1, 0}, {3, 0.0041f, 0}, {1.5f, 0.003f, 0}, {2, 1, 1}};
    const Cage cage =
        makeCage(positions, {{0, 1, 2, 3}, {4, 0, 5}, {1, 4, 5}, {6, 1, 8}, {4, 6, 8}, {7, 4, 8}, {2, 7, 8}});
    const Repaired r = afterRepair(cage);
    ASSERT_FALSE(r.found.empty());
    EXPECT_EQ(r.found[0], "cage: 1 T-corner: vertex 4 on edge (0, 1) of face 0");
    EXPECT_EQ(r.cage.sides(0), 5u);
}

TEST(RepairTCorners, PartsAreNamed) {
    Cage row = rows({0, 4}, {0, 1, 4});
    row.faceParts = {0, 1, 1};
    CageNames names{{"mesh 0", "mesh 1"}, {}};
    for (const uint32_t vertex : row.faceVertices) {
        names.cornerVertices.push_back(vertex + 100);
    }
    const Repaired r = afterRepair(row, {}, {}, names);
    EXPECT_EQ(r.found, Strings{"mesh 0: 1 T-corner: vertex 101 of mesh 1 on edge (100, 102) of face 0"});
    EXPECT_EQ(r.cage.faceParts, (Indices{0, 1, 1}));
}

TEST(RepairTCorners, TheFilesTrianglesStayElsewhere) {
    Cage row = rows({0, 4}, {0, 1, 4});
    row.faceTriangles = {0, 1, 3, 1, 2, 3, 4, 5, 7, 5, 6, 7, 8, 9, 10, 8, 10, 11};
    const Repaired r = afterRepair(row);
    ASSERT_EQ(r.cage.faceTriangles.size(), 21u);
    double area = 0.0;
    for (size_t t = 0; t < 9; t += 3) {
        const auto at = [&](size_t i) { return r.cage.positions[r.cage.faceVertices[r.cage.faceTriangles[t + i]]]; };
        const float twice = glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
        EXPECT_GT(twice, 0.5f);
        area += 0.5 * twice;
    }
    EXPECT_DOUBLE_EQ(area, 4.0);
    EXPECT_EQ(Indices(r.cage.faceTriangles.begin() + 9, r.cage.faceTriangles.end()),
              (Indices{5, 6, 8, 6, 7, 8, 9, 10, 11, 9, 11, 12}));
}

TEST(RepairTCorners, FilesOfEveryFormat) {
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 -1 0\nv 1 -1 0\nv 2 -1 0\n"
                            "f 1 3 4 5\nf 6 7 2 1\nf 7 8 3 2\n";
    const std::string line = "1 T-corner: vertex 1 on edge (0, 2) of face 0";
    const Result<Character> read = readCharacter(toBytes(obj), "t.obj", "");
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read->warnings, Strings{"file: " + line + "; made a five-sided facet"});
    const Result<Character> strict = readCharacter(toBytes(obj), "t.obj", "", {.strict = true});
    ASSERT_FALSE(strict.ok());
    EXPECT_EQ(strict.error().message, "t.obj: file: " + line);
    // glTF: triangles as they are, where a triangle takes the corner.
    const GltfBuilder b = plainMesh({0, 0, 0, 1, 0, 0, 2, 0, 0, 1, 1, 0, 1, -1, 0}, {0, 2, 3, 0, 4, 1, 1, 4, 2});
    EXPECT_EQ(readWell(b).warnings, Strings{"mesh 0: " + line + "; made a four-sided facet"});
    const Result<Character> refused = readGltf(b.glb(), "t.glb", "", {.strict = true});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().message, "t.glb: mesh 0: " + line);
}

} // namespace
} // namespace supple::cage
