// What says which vertices of a glTF file are one: every source, their order, and how each is refused.
#include "cage/topology.h"
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>
#include <limits>

namespace supple::cage {
namespace {

using namespace test;

/// Two triangles that meet at vertex (1, 1, 0) alone, vertices 2 and 3: sewing would keep them apart.
GltfBuilder twoTriangles() {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 2, 1, 0, 2, 2, 0});
    return b;
}

GltfBuilder withMesh(GltfBuilder b, const std::string& attributes, const std::string& more = "") {
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0)" + attributes + "}" + more + "}]}]";
    return b;
}

GltfBuilder withNumbers(const std::vector<float>& numbers) {
    GltfBuilder b = twoTriangles();
    b.addFloats("SCALAR", numbers);
    return withMesh(b, R"(,"_CAGE_VERTEX":1)");
}

TEST(GltfWeld, CageVertexAttribute) {
    EXPECT_EQ(readWell(withMesh(twoTriangles(), "")).cage.vertexCount(), 6u);
    const Character c = readWell(withNumbers({4, 3, 2, 2, 1, 0}));
    EXPECT_EQ(c.parts[0].weldSource, WeldSource::vertexAttribute);
    EXPECT_STREQ(weldSourceName(c.parts[0].weldSource), "_CAGE_VERTEX");
    EXPECT_EQ(c.warnings, (Strings{"mesh 0: 1 vertex has faces that are no single fan: vertex 2 of 2 fans; one vertex "
                                   "for each fan"}))
        << "the bow tie is the file's own";
    EXPECT_EQ(c.cage.sourceVertices, (std::vector<uint32_t>{5, 4, 2, 1, 0, 2})) << "in the order of the numbers";
    EXPECT_EQ(c.cage.faceVertices, (std::vector<uint32_t>{4, 3, 2, 5, 1, 0}));
    EXPECT_EQ(c.seamVertexCount, 1u);

    GltfBuilder integers = twoTriangles();
    integers.addIntegers("SCALAR", 5123, {7, 8, 9, 9, 10, 11});
    EXPECT_EQ(readWell(withMesh(integers, R"(,"_CAGE_VERTEX":1)")).cage.vertexCount(), 6u) << "with the copy";
}

TEST(GltfWeld, CageVertexAttributeRefusals) {
    const std::string name = "t.glb: mesh 0 primitive 0 _CAGE_VERTEX";
    EXPECT_EQ(messageOf(withNumbers({0, 1, 2.5f, 3, 4, 5})), name + "[2]: not a number of a vertex");
    EXPECT_EQ(messageOf(withNumbers({0, 1, 2, -1, 4, 5})), name + "[3]: not a number of a vertex");
    EXPECT_EQ(messageOf(withNumbers({0, 1, 2, 3, std::numeric_limits<float>::quiet_NaN(), 5})),
              name + "[4]: not a number of a vertex");
    EXPECT_EQ(messageOf(withNumbers({0, 1, 2, 3, 4, 16777218})), name + "[5]: not a number of a vertex");
    EXPECT_EQ(messageOf(withNumbers({0, 1, 2, 3, 4})), name + ": 5 elements for 6 vertices");
    EXPECT_EQ(messageOf(withNumbers({0, 1, 2, 2, 0, 5})),
              "t.glb: mesh 0 _CAGE_VERTEX: merges vertices 0 and 4, which differ in position");
    GltfBuilder b = twoTriangles();
    b.addFloats("VEC2", std::vector<float>(12));
    EXPECT_EQ(messageOf(withMesh(b, R"(,"_CAGE_VERTEX":1)")), name + ": VEC2 instead of SCALAR");
    b = twoTriangles();
    b.addIntegers("SCALAR", 5122, std::vector<uint32_t>(6));
    EXPECT_EQ(messageOf(withMesh(b, R"(,"_CAGE_VERTEX":1)")), name + ": SHORT components are not allowed here");
}

TEST(GltfWeld, NumbersComeFromAllPrimitivesOrNone) {
    GltfBuilder b = twoTriangles();
    b.addFloats("SCALAR", {0, 1, 2, 2, 4, 5});
    b.addIntegers("SCALAR", 5121, {0, 1, 2});
    b.addIntegers("SCALAR", 5121, {3, 4, 5});
    b.addIntegers("SCALAR", 5121, {0, 1, 2, 2, 4, 5});
    const auto primitive = [](int indices, const std::string& attribute, const std::string& more) {
        return R"({"attributes":{"POSITION":0)" + attribute + R"(},"indices":)" + std::to_string(indices) + more + "}";
    };
    const std::string attribute = R"(,"_CAGE_VERTEX":1)";
    const std::string extension = R"(,"extensions":{"SUPPLE_mesh_cage":{"cageVertices":4}})";
    b.meshes = R"([{"primitives":[)" + primitive(2, attribute, "") + "," + primitive(3, "", "") + "]}]";
    Character c = readWell(b);
    EXPECT_EQ(c.parts[0].weldSource, WeldSource::equality);
    EXPECT_EQ(c.warnings, (Strings{"mesh 0: _CAGE_VERTEX is not on all primitives; not used"}));
    b.meshes = R"([{"primitives":[)" + primitive(2, attribute, extension) + "," + primitive(3, attribute, "") + "]}]";
    EXPECT_EQ(messageOf(b), "t.glb: mesh 0 primitive 1: no cageVertices of SUPPLE_mesh_cage, which other primitives of "
                            "the mesh have");
    b.meshes = R"([{"primitives":[)" + primitive(2, attribute, extension) + "," + primitive(3, "", extension) + "]}]";
    c = readWell(b);
    EXPECT_EQ(c.parts[0].weldSource, WeldSource::cageExtension);
    EXPECT_EQ(c.cage.vertexCount(), 6u) << "five, and a copy for the bow tie";
    EXPECT_EQ(c.sourceVertexCount, 6u) << "primitives over the same accessors share their vertices";
}

TEST(GltfWeld, MergedVerticesThatDifferInSkinOrMorphs) {
    GltfBuilder b = twoTriangles();
    b.addFloats("SCALAR", {0, 1, 2, 2, 4, 5});
    b.addIntegers("VEC4", 5121, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    b.addFloats("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    b.addFloats("VEC3", {0, 0, 0, 0, 0, 0, 0, 0, 7, 0, 0, 8, 0, 0, 0, 0, 0, 0});
    b.nodes = R"([{"mesh":0,"skin":0},{},{}])";
    b.more = R"(,"skins":[{"joints":[1,2]}])";
    const Character c =
        readWell(withMesh(b, R"(,"_CAGE_VERTEX":1,"JOINTS_0":2,"WEIGHTS_0":3)", R"(,"targets":[{"POSITION":4}])"));
    EXPECT_EQ(
        c.warnings,
        (Strings{"mesh 0 _CAGE_VERTEX: merges 1 pair of vertices that differ in skin (first: vertices 2 and 3); "
                 "the first one's is taken",
                 "mesh 0 _CAGE_VERTEX: merges 1 pair of vertices that differ in morph targets (first: vertices 2 "
                 "and 3); the first one's is taken",
                 "mesh 0: 1 vertex has faces that are no single fan: vertex 2 of 2 fans; one vertex for each fan"}));
    EXPECT_EQ(c.weights.influences[2].joint, 0u);
    EXPECT_EQ(c.weights.influences[5].joint, 0u);
    EXPECT_EQ(c.morphs.targets[0].deltas, (std::vector<glm::vec3>{{0, 0, 7}, {0, 0, 7}}));
}

// ---- EXT_mesh_manifold ----------------------------------------------------------------------------------------------

/// Two tetrahedra that touch in a vertex, as a soup of 24 vertices in two primitives of one index buffer; the merges
/// join each of them, and leave the two vertices at the origin apart. (Sewing finds the same; the file says it.)
struct Manifold {
    GltfBuilder b;
    std::string sparse; ///< of the accessor of all indices
    std::vector<uint32_t> mergeIndices;
    std::vector<uint32_t> mergeValues;

    Manifold() {
        const glm::vec3 p[7] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
        std::vector<float> positions;
        std::vector<uint32_t> first(8, kNone);
        std::vector<uint32_t> all;
        const std::vector<uint32_t> corners = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3, 7, 4, 5, 7, 6, 4, 7, 5, 6, 4, 6, 5};
        for (uint32_t i = 0; i < corners.size(); ++i) {
            const glm::vec3 at = p[corners[i] % 7];
            positions.insert(positions.end(), {at.x, at.y, at.z});
            all.push_back(i);
            if (first[corners[i]] == kNone) {
                first[corners[i]] = i;
            } else {
                mergeIndices.push_back(i);
                mergeValues.push_back(first[corners[i]]);
            }
        }
        b.addFloats("VEC3", positions);
        b.addIntegers("SCALAR", 5121, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
        b.addIntegers("SCALAR", 5121, {12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23});
        b.addIntegers("SCALAR", 5121, all);
        setMerges(mergeIndices, mergeValues);
    }
    void setMerges(const std::vector<uint32_t>& indices, const std::vector<uint32_t>& values) {
        const std::string i = std::to_string(b.addIntegers("SCALAR", 5121, indices));
        const std::string v = std::to_string(b.addIntegers("SCALAR", 5121, values));
        sparse = R"(,"sparse":{"count":)" + std::to_string(indices.size()) + R"(,"indices":{"bufferView":)" + i +
                 R"(,"componentType":5121},"values":{"bufferView":)" + v + "}}";
        setExtension(R"({"manifoldPrimitive":{"indices":3,"mode":4,"attributes":{"POSITION":0}},"mergeIndices":)" + i +
                     R"(,"mergeValues":)" + v + "}");
    }
    void setExtension(const std::string& extension) {
        b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0},)"
                   R"("indices":2}],"extensions":{"EXT_mesh_manifold":)" +
                   extension + "}}]";
    }
    [[nodiscard]] Result<Character> read(bool isSparse = true, bool strict = false) const {
        std::string json = b.json();
        const std::string indices = R"("count":24,"type":"SCALAR")";
        json.insert(json.find(indices) + indices.size(), isSparse ? sparse : "");
        return readGltf(packGlb(json, b.binary()), "t.glb", "", {.strict = strict});
    }
    [[nodiscard]] std::string message() const {
        const Result<Character> result = read(true, true);
        return result.ok() ? "accepted" : result.error().message;
    }
};

TEST(GltfWeld, Manifold) {
    const Manifold file;
    const Result<Character> c = file.read();
    ASSERT_TRUE(c.ok()) << c.error().message;
    EXPECT_EQ(c->warnings, Strings());
    EXPECT_EQ(c->parts[0].weldSource, WeldSource::meshManifold);
    EXPECT_EQ(c->cage.vertexCount(), 8u);
    EXPECT_EQ(c->sourceVertexCount, 24u);
    EXPECT_TRUE(buildTopology(c->cage).ok());

    // A file that says nothing is merged says that its vertices are whole.
    Manifold whole;
    whole.setExtension(R"({"manifoldPrimitive":{"indices":3,"attributes":{"POSITION":0}}})");
    const Result<Character> soup = whole.read(false);
    ASSERT_TRUE(soup.ok()) << soup.error().message;
    EXPECT_EQ(soup->cage.vertexCount(), 24u);

    // Where a tool has written the merged indices themselves, what they were is lost.
    const Result<Character> dense = file.read(false);
    ASSERT_TRUE(dense.ok()) << dense.error().message;
    EXPECT_EQ(dense->parts[0].weldSource, WeldSource::equality);
    EXPECT_EQ(dense->warnings,
              (Strings{"mesh 0 EXT_mesh_manifold: its indices are not sparse, so what they were before "
                       "merging is lost; not used"}));
}

TEST(GltfWeld, ManifoldComesAfterNumbers) {
    Manifold file;
    std::vector<float> numbers(24);
    for (size_t i = 0; i < numbers.size(); ++i) {
        numbers[i] = static_cast<float>(i);
    }
    const std::string attribute = R"("_CAGE_VERTEX":)" + std::to_string(file.b.addFloats("SCALAR", numbers)) + ",";
    for (size_t place = 0; (place = file.b.meshes.find(R"({"attributes":{"POSITION")", place)) != std::string::npos;) {
        file.b.meshes.insert(place + 15, attribute);
    }
    const Result<Character> c = file.read();
    ASSERT_TRUE(c.ok()) << c.error().message;
    EXPECT_EQ(c->parts[0].weldSource, WeldSource::vertexAttribute);
    EXPECT_EQ(c->cage.vertexCount(), 24u);
}

TEST(GltfWeld, ManifoldRefusals) {
    const std::string name = "t.glb: mesh 0 EXT_mesh_manifold";
    const auto with = [](const std::string& extension) {
        Manifold file;
        file.setExtension(extension);
        return file.message();
    };
    EXPECT_EQ(with("{}"), name + ": no manifoldPrimitive with attributes");
    EXPECT_EQ(with("3"), "t.glb: mesh 0 EXT_mesh_manifold: not an object");
    EXPECT_EQ(with(R"({"manifoldPrimitive":{"attributes":{"POSITION":0}}})"),
              name + " manifoldPrimitive: indices is missing");
    EXPECT_EQ(with(R"({"manifoldPrimitive":{"indices":3,"attributes":{}}})"),
              name + " manifoldPrimitive: POSITION is missing");
    EXPECT_EQ(with(R"({"manifoldPrimitive":{"indices":3,"attributes":{"POSITION":1}}})"),
              name + " manifoldPrimitive: its POSITION is not that of mesh 0 primitive 0");
    EXPECT_EQ(with(R"({"manifoldPrimitive":{"indices":3,"attributes":{"POSITION":0}},"mergeIndices":4})"),
              name + ": mergeIndices without mergeValues");
    EXPECT_EQ(
        with(R"({"manifoldPrimitive":{"indices":3,"attributes":{"POSITION":0}},"mergeIndices":4,"mergeValues":9})"),
        name + " mergeValues: accessor 9 is out of range: the file has 6");
    const auto merging = [](const std::vector<uint32_t>& indices, const std::vector<uint32_t>& values) {
        Manifold file;
        file.setMerges(indices, values);
        return file.message();
    };
    EXPECT_EQ(merging({3}, {0}), "t.glb: mesh 0: 1 vertex has faces that are no single fan: vertex 0 of 2 fans");
    EXPECT_EQ(merging({24}, {0}), name + " mergeIndices[0]: 24 is out of range: the manifoldPrimitive has 24 indices");
    EXPECT_EQ(merging({3}, {24}), name + " mergeValues[0]: vertex 24 is out of range: the mesh has 24");
    EXPECT_EQ(merging({3}, {1}), name + ": merges vertices 3 and 1, which differ in position");
}

} // namespace
} // namespace supple::cage
