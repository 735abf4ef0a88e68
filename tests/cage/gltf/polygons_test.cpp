// Where a glTF file's polygons come from: every source, their order, and how each is refused.
#include "cage/topology.h"
#include "tests/cage/face_lists.h"
#include "tests/cage/gltf/reading.h"

#include <functional>
#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;

/// Two quads and a pentagon round vertex 4 of a flat patch of eight vertices, in triangles that are no fans in order.
///
///   6---7
///   | 2  `.
///   3---4---5
///   | 0 | 1 |
///   0---1---2
struct Patch {
    GltfBuilder b;
    int positions = b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0, 0, 2, 0, 1, 2, 0});
    int indices = b.addIntegers("SCALAR", 5123, {0, 1, 3, 1, 4, 3, 1, 2, 4, 2, 5, 4, 3, 4, 6, 4, 7, 6, 4, 5, 7});

    GltfBuilder& with(const std::string& extensions, const std::string& meshMore = "") {
        b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1,"extensions":{)" + extensions + "}}]" +
                   meshMore + "}]";
        return b;
    }
    std::string list(const std::string& key, const std::vector<uint32_t>& values, int componentType = 5123) {
        return "\"" + key + "\":" + std::to_string(b.addIntegers("SCALAR", componentType, values));
    }
    std::string floats(const std::string& key, const std::vector<float>& values) {
        return "\"" + key + "\":" + std::to_string(b.addFloats("SCALAR", values));
    }
};

std::string extension(const std::string& name, const Strings& members) {
    std::string text;
    for (const std::string& member : members) {
        text += (text.empty() ? "" : ",") + member;
    }
    return "\"" + name + "\":{" + text + "}";
}

std::string cageExtension(const Strings& members) {
    return extension("SUPPLE_mesh_cage", members);
}

const Faces kPolygons = {{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 5, 7, 6}};
const std::vector<uint32_t> kCounts = {4, 4, 5};
const std::vector<uint32_t> kCorners = {0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 5, 7, 6};

// ---- SUPPLE_mesh_cage -----------------------------------------------------------------------------------------------

TEST(GltfPolygons, CageExtension) {
    for (const int componentType : {5121, 5123, 5125}) {
        Patch patch;
        const std::string counts = patch.list("faceVertexCounts", kCounts, componentType);
        const std::string corners = patch.list("faceVertexIndices", kCorners, componentType);
        const Character c =
            readWell(patch.with(cageExtension({counts, corners, patch.list("holeIndices", {1, 2}, componentType)})));
        EXPECT_EQ(c.warnings, Strings());
        EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::cageExtension);
        EXPECT_EQ(c.parts[0].weldSource, WeldSource::equality);
        EXPECT_EQ(facesOf(c.cage), kPolygons);
        EXPECT_EQ(c.cage.holes, (std::vector<uint32_t>{1, 2}));
        EXPECT_TRUE(buildTopology(c.cage).ok());
    }
}

TEST(GltfPolygons, CageExtensionKeepsCornerAttributes) {
    // Two triangles that a viewer sees as one quad with a seam; the polygon says which vertex each corner is.
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0});
    b.addFloats("VEC2", {0, 0, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0});
    b.addIntegers("SCALAR", 5121, {4});
    b.addIntegers("SCALAR", 5121, {0, 1, 4, 5});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"extensions":)"
               R"({"SUPPLE_mesh_cage":{"faceVertexCounts":2,"faceVertexIndices":3}}}]}])";
    const Character c = readWell(b);
    EXPECT_EQ(facesOf(c.cage), (Faces{{0, 1, 2, 3}}));
    EXPECT_EQ(c.cage.cornerUvs[2], glm::vec2(4, 0));
    EXPECT_EQ(c.cage.sourceVertices, (std::vector<uint32_t>{0, 1, 4, 5}));
    EXPECT_EQ(c.warnings, (Strings{"mesh 0: 2 vertices have no face; left out"}));
}

TEST(GltfPolygons, CageExtensionRefusals) {
    const auto with = [](const std::function<Strings(Patch&)>& members) {
        Patch patch;
        return messageOf(patch.with(cageExtension(members(patch))));
    };
    const auto lists = [&](const std::vector<uint32_t>& counts, const std::vector<uint32_t>& corners) {
        return with([&](Patch& p) {
            return Strings{p.list("faceVertexCounts", counts), p.list("faceVertexIndices", corners)};
        });
    };
    const std::string name = "t.glb: mesh 0 primitive 0 SUPPLE_mesh_cage";
    EXPECT_EQ(lists(kCounts, kCorners), "accepted");
    EXPECT_EQ(lists({4, 2, 7}, kCorners), name + " faceVertexCounts[1]: 2 corners, at least 3 are needed");
    EXPECT_EQ(lists({4, 4, 4}, kCorners), name + " faceVertexIndices: 13 indices for faces of 12 corners");
    EXPECT_EQ(lists({4, 4, 60000}, kCorners), name + " faceVertexIndices: 13 indices for faces of 60008 corners");
    EXPECT_EQ(lists({3}, {0, 1, 8}),
              name + " faceVertexIndices: vertex 8 of face 0 is out of range: the primitive has 8");
    EXPECT_EQ(lists({3, 3}, {0, 1, 3, 1, 4, 1}), name + " faceVertexIndices: face 1 repeats vertex 1");
    EXPECT_EQ(with([](Patch& p) { return Strings{p.list("faceVertexCounts", {4})}; }),
              name + ": faceVertexCounts without faceVertexIndices");
    EXPECT_EQ(with([](Patch& p) { return Strings{p.list("faceVertexIndices", {4})}; }),
              name + ": faceVertexIndices without faceVertexCounts");
    EXPECT_EQ(with([](Patch& p) { return Strings{p.list("holeIndices", {0})}; }),
              name + ": holeIndices without faceVertexCounts");
    EXPECT_EQ(with([](Patch& p) {
                  return Strings{p.floats("faceVertexCounts", {4}), p.list("faceVertexIndices", {0, 1, 4, 3})};
              }),
              name + " faceVertexCounts: FLOAT components are not allowed here");
    EXPECT_EQ(with([](Patch&) {
                  return Strings{R"("faceVertexCounts":0)", R"("faceVertexIndices":1)"};
              }),
              name + " faceVertexCounts: VEC3 instead of SCALAR");
    EXPECT_EQ(with([](Patch&) { return Strings{R"("faceVertexCounts":9)"}; }),
              name + " faceVertexCounts: accessor 9 is out of range: the file has 2");
    EXPECT_EQ(with([](Patch& p) {
                  return Strings{p.list("faceVertexCounts", kCounts), p.list("faceVertexIndices", kCorners),
                                 p.list("holeIndices", {3})};
              }),
              name + " holeIndices[0]: face 3 is out of range: the primitive has 3");
    EXPECT_EQ(with([](Patch& p) {
                  return Strings{p.list("faceVertexCounts", kCounts), p.list("faceVertexIndices", kCorners),
                                 p.list("holeIndices", {2, 1})};
              }),
              name + " holeIndices[1]: not more than the one before it");
    EXPECT_EQ(with([](Patch&) { return Strings{R"("scheme":"quadratic")"}; }),
              name + " scheme: \"quadratic\" is not allowed");
    EXPECT_EQ(with([](Patch&) { return Strings{R"("scheme":3)"}; }), name + " scheme: not a string");
    Patch patch;
    EXPECT_EQ(messageOf(patch.with(R"("SUPPLE_mesh_cage":[])")),
              "t.glb: mesh 0 primitive 0 SUPPLE_mesh_cage: not an object");
}

TEST(GltfPolygons, CageExtensionSaysWhatACageWasMadeFor) {
    for (uint32_t kind = 0; kind <= static_cast<uint32_t>(MadeFor::none); ++kind) {
        Patch patch;
        const std::string name = madeForName(static_cast<MadeFor>(kind));
        const Character c = readWell(patch.with(cageExtension({R"("scheme":")" + name + "\""})));
        EXPECT_EQ(c.parts[0].madeFor, static_cast<MadeFor>(kind));
        EXPECT_EQ(c.warnings, Strings());
    }
    Patch patch;
    EXPECT_FALSE(readWell(patch.with(cageExtension({}))).parts[0].madeFor.has_value());
}

TEST(GltfPolygons, CageExtensionRoundsCorners) {
    for (const char* rule : {"edgeOnly", "edgeAndCorner"}) {
        Patch patch;
        const std::string counts = patch.list("faceVertexCounts", kCounts);
        const std::string corners = patch.list("faceVertexIndices", kCorners);
        const Character c = readWell(
            patch.with(cageExtension({counts, corners, R"("interpolateBoundary":")" + std::string(rule) + "\""})));
        EXPECT_EQ(c.warnings, Strings());
        const std::vector<uint32_t> ofOneFace = {0, 2, 6, 7};
        EXPECT_EQ(c.cage.roundCorners, rule == std::string("edgeOnly") ? ofOneFace : std::vector<uint32_t>());
    }
}

TEST(GltfPolygons, CageExtensionRulesAreTheHosts) {
    Patch patch;
    const Character c = readWell(patch.with(cageExtension(
        {R"("scheme":"loop")", R"("interpolateBoundary":"none")", R"("faceVaryingLinearInterpolation":"all")",
         R"("triangleSubdivisionRule":"smooth")", R"("future":{"a":[1]})"})));
    EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::triangles)
        << "an extension without polygons leaves them to others";
    EXPECT_EQ(c.warnings,
              (Strings{"mesh 0 primitive 0 SUPPLE_mesh_cage interpolateBoundary: \"none\" is not followed",
                       "mesh 0 primitive 0 SUPPLE_mesh_cage triangleSubdivisionRule: \"smooth\" is not followed"}));
}

// ---- creases and corners of SUPPLE_mesh_cage ------------------------------------------------------------------------

TEST(GltfPolygons, CreasesByVertex) {
    Patch patch;
    const std::string counts = patch.list("faceVertexCounts", kCounts);
    const std::string corners = patch.list("faceVertexIndices", kCorners);
    const Strings members = {counts,
                             corners,
                             patch.list("creaseIndices", {4, 1, 4, 3, 1, 4}),
                             patch.floats("creaseSharpnesses", {10, 2.5f, 3}),
                             patch.list("cornerIndices", {4, 0}),
                             patch.floats("cornerSharpnesses", {10, 0.5f})};
    // What the extension says comes before extras of the same kind.
    const Character c = readWell(patch.with(cageExtension(members), R"(,"extras":{"creases":[[0,1,9]],"corners":7})"));
    EXPECT_EQ(c.warnings, Strings());
    ASSERT_EQ(c.cage.creases.size(), 2u);
    EXPECT_EQ(c.cage.creases[0].a, 4u);
    EXPECT_EQ(c.cage.creases[0].b, 1u);
    EXPECT_EQ(c.cage.creases[0].sharpness, 10.0f);
    EXPECT_EQ(c.cage.creases[1].sharpness, 2.5f);
    ASSERT_EQ(c.cage.sharpVertices.size(), 2u);
    EXPECT_EQ(c.cage.sharpVertices[0].vertex, 4u);
    EXPECT_EQ(c.cage.sharpVertices[1].sharpness, 0.5f);
}

TEST(GltfPolygons, CreasesByCageVertex) {
    // Two primitives; the second numbers its vertices the other way round. Cage vertices keep the file's order.
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    b.addFloats("VEC3", {1, 1, 0, 1, 0, 0, 2, 0, 0, 2, 1, 0});
    b.addIntegers("SCALAR", 5121, {4});
    b.addIntegers("SCALAR", 5121, {0, 1, 2, 3});
    b.addIntegers("SCALAR", 5125, {70, 20, 30, 60}); // cage vertices of the first
    b.addIntegers("SCALAR", 5125, {30, 20, 50, 40}); // of the second
    b.addIntegers("SCALAR", 5121, {20, 30});
    b.addFloats("SCALAR", {8});
    b.addIntegers("SCALAR", 5121, {50, 70});
    b.addFloats("SCALAR", {10, 1});
    b.addIntegers("SCALAR", 5121, {0, 1, 2, 0, 2, 3});
    const auto primitive = [](int positions, int numbers, const std::string& more) {
        return R"({"attributes":{"POSITION":)" + std::to_string(positions) +
               R"(},"indices":10,"extensions":{"SUPPLE_mesh_cage":{"faceVertexCounts":2,"faceVertexIndices":3,)"
               R"("cageVertices":)" +
               std::to_string(numbers) + more + "}}}";
    };
    b.meshes = R"([{"primitives":[)" +
               primitive(0, 4, R"(,"creaseIndices":6,"creaseSharpnesses":7,"cornerIndices":8,"cornerSharpnesses":9)") +
               "," + primitive(1, 5, "") + "]}]";
    const Character c = readWell(b);
    EXPECT_EQ(c.warnings, Strings());
    EXPECT_EQ(c.parts[0].weldSource, WeldSource::cageExtension);
    EXPECT_EQ(c.cage.positions,
              (std::vector<glm::vec3>{{1, 0, 0}, {1, 1, 0}, {2, 1, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 0}}));
    EXPECT_EQ(facesOf(c.cage), (Faces{{5, 0, 1, 4}, {1, 0, 3, 2}}));
    EXPECT_EQ(c.seamVertexCount, 2u);
    ASSERT_EQ(c.cage.creases.size(), 1u);
    EXPECT_EQ(c.cage.creases[0].a, 0u);
    EXPECT_EQ(c.cage.creases[0].b, 1u);
    ASSERT_EQ(c.cage.sharpVertices.size(), 2u);
    EXPECT_EQ(c.cage.sharpVertices[0].vertex, 3u) << "a cage vertex of another primitive";
    EXPECT_EQ(c.cage.sharpVertices[1].vertex, 5u);
    EXPECT_TRUE(buildTopology(c.cage).ok());
}

TEST(GltfPolygons, CreaseRefusals) {
    const auto with = [](const std::vector<uint32_t>& indices, const std::vector<float>& sharpnesses,
                         const std::vector<uint32_t>& numbers = {}) {
        Patch patch;
        Strings members = {patch.list("creaseIndices", indices), patch.floats("creaseSharpnesses", sharpnesses)};
        if (!numbers.empty()) {
            members.push_back(patch.list("cageVertices", numbers));
        }
        return messageOf(patch.with(cageExtension(members)));
    };
    const std::string name = "t.glb: mesh 0 primitive 0 SUPPLE_mesh_cage creaseIndices";
    const std::string sharpness = "t.glb: mesh 0 primitive 0 SUPPLE_mesh_cage creaseSharpnesses";
    EXPECT_EQ(with({0, 1}, {1}), "accepted");
    EXPECT_EQ(with({0, 1, 2}, {1}), sharpness + ": 1 sharpness for 3 indices");
    EXPECT_EQ(with({0, 1}, {1, 2}), sharpness + ": 2 sharpnesses for 2 indices");
    EXPECT_EQ(with({0, 1}, {-1}), sharpness + "[0]: not a number of at least 0");
    EXPECT_EQ(with({0, 1}, {std::nanf("")}), sharpness + "[0]: not a number of at least 0");
    EXPECT_EQ(with({0, 8}, {1}), name + "[1]: vertex 8 is out of range: the primitive has 8");
    EXPECT_EQ(with({3, 3}, {1}), name + "[0]: both ends are one vertex of the cage");
    EXPECT_EQ(with({10, 11}, {1}, {10, 11, 12, 13, 14, 15, 16, 17}), "accepted");
    EXPECT_EQ(with({10, 9}, {1}, {10, 11, 12, 13, 14, 15, 16, 17}), name + "[1]: the mesh has no cage vertex 9");
    Patch patch;
    EXPECT_EQ(messageOf(patch.with(cageExtension({patch.list("creaseIndices", {0, 1})}))),
              "t.glb: mesh 0 primitive 0 SUPPLE_mesh_cage: creaseIndices without creaseSharpnesses");
    EXPECT_EQ(messageOf(patch.with(cageExtension({patch.floats("cornerSharpnesses", {1})}))),
              "t.glb: mesh 0 primitive 0 SUPPLE_mesh_cage: cornerSharpnesses without cornerIndices");
    // A vertex that no face of the file uses has no place in the cage, and its crease none either.
    const std::string counts = patch.list("faceVertexCounts", {4});
    const std::string corners = patch.list("faceVertexIndices", {0, 1, 4, 3});
    const Strings members = {counts,
                             corners,
                             patch.list("creaseIndices", {0, 1, 1, 2}),
                             patch.floats("creaseSharpnesses", {1, 1}),
                             patch.list("cornerIndices", {2}),
                             patch.floats("cornerSharpnesses", {1})};
    const Character c = readWell(patch.with(cageExtension(members)));
    EXPECT_EQ(c.cage.creases.size(), 1u);
    EXPECT_EQ(
        c.warnings,
        (Strings{"mesh 0: 4 vertices have no face; left out",
                 "mesh 0 primitive 0 SUPPLE_mesh_cage creaseIndices[2]: a crease at a vertex without a face; left "
                 "out",
                 "mesh 0 primitive 0 SUPPLE_mesh_cage cornerIndices[0]: a vertex without a face; left out"}));
}

TEST(GltfPolygons, CreaseScalarsAndSets) {
    Patch patch;
    const std::string counts = patch.list("faceVertexCounts", kCounts);
    const std::string corners = patch.list("faceVertexIndices", kCorners);
    const std::string edges = patch.list("creaseIndices", {4, 1, 4, 3, 1, 4});
    const std::string sharpnesses = patch.floats("creaseSharpnesses", {1, 2.5f, 3});
    const auto set = [&](const std::string& name, const std::vector<uint32_t>& creases) {
        return R"({"name":")" + name + R"(",)" + patch.list("creases", creases) + "}";
    };
    const std::string scalars = patch.list("creaseScalarIndices", {4, 3, 3, 4});
    const std::string alphas = patch.floats("creaseScalars", {0, 1});
    const Character c =
        readWell(patch.with(cageExtension({counts, corners, edges, sharpnesses, scalars, alphas,
                                           R"("creaseSets":[)" + set("a", {1}) + "," + set("b", {2}) + "]"})));
    EXPECT_EQ(c.warnings, Strings());
    EXPECT_EQ(c.cage.creaseSets, (Strings{"a", "b"}));
    ASSERT_EQ(c.cage.creases.size(), 2u);
    EXPECT_EQ(c.cage.creases[0].sharpness, 3.0f) << "of one edge the sharper counts, and the first set";
    EXPECT_EQ(c.cage.creases[0].set, 1u);
    EXPECT_EQ(c.cage.creases[1].set, 0u);
    ASSERT_EQ(c.cage.creaseScalars.size(), 2u);
    EXPECT_EQ(c.cage.creaseScalars[0].vertex, 4u);
    EXPECT_EQ(c.cage.creaseScalars[0].toward, 3u);
    EXPECT_EQ(c.cage.creaseScalars[0].alpha, 0.0f);
    EXPECT_EQ(c.cage.creaseScalars[1].alpha, 1.0f);

    const std::string name = "t.glb: mesh 0 primitive 0 SUPPLE_mesh_cage";
    const auto refusal = [&](const Strings& more) {
        Strings members = {counts, corners, edges, sharpnesses};
        members.insert(members.end(), more.begin(), more.end());
        return messageOf(patch.with(cageExtension(members)));
    };
    EXPECT_EQ(refusal({scalars}), name + ": creaseScalarIndices without creaseScalars");
    EXPECT_EQ(refusal({scalars, patch.floats("creaseScalars", {0.5f, 1.25f})}),
              name + " creaseScalars[1]: not a number from 0 to 1");
    EXPECT_EQ(refusal({R"("creaseSets":[{"creases":0}])"}), name + " creaseSets[0]: no name");
    EXPECT_EQ(refusal({R"("creaseSets":[)" + set("a", {3}) + "]"}),
              "t.glb: mesh 0 primitive 0 crease set \"a\": crease 3 is out of range: the primitive has 3");
    EXPECT_EQ(refusal({R"("creaseSets":[)" + set("a", {1}) + "," + set("b", {1}) + "]"}),
              "t.glb: mesh 0 primitive 0 crease set \"b\": crease 1 is in a set already");
    EXPECT_EQ(messageOf(patch.with(cageExtension({counts, corners, R"("creaseSets":[)" + set("a", {1}) + "]"}))),
              name + ": creaseSets without creaseIndices");
}

// ---- EXT_mesh_polygon -----------------------------------------------------------------------------------------------

std::string meshPolygon(Patch& patch, int componentType, const std::vector<uint32_t>& loops,
                        const std::vector<uint32_t>& loopOffsets, const std::vector<uint32_t>& offsets) {
    return extension("EXT_mesh_polygon",
                     {"\"count\":" + std::to_string(loopOffsets.size()),
                      patch.list("loopIndices", loops, componentType), patch.list("loopIndicesOffsets", loopOffsets),
                      patch.list("indicesOffsets", offsets)});
}

TEST(GltfPolygons, MeshPolygon) {
    for (const auto& [componentType, r] : {std::pair{5121, 0xFFu}, {5123, 0xFFFFu}, {5125, 0xFFFFFFFFu}}) {
        Patch patch;
        const Character c = readWell(patch.with(
            meshPolygon(patch, componentType, {0, 1, 4, 3, r, 1, 2, 5, 4, r, 3, 4, 5, 7, 6}, {0, 5, 10}, {0, 6, 12})));
        EXPECT_EQ(c.warnings, Strings());
        EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::meshPolygon);
        EXPECT_EQ(facesOf(c.cage), kPolygons);
        // Some write no restart values between polygons, some one behind the last.
        EXPECT_EQ(
            facesOf(readWell(patch.with(meshPolygon(patch, componentType, {0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 5, 7, 6, r},
                                                    {0, 4, 8}, {0, 6, 12})))
                        .cage),
            kPolygons);
    }
}

TEST(GltfPolygons, MeshPolygonThatCannotBeUsed) {
    Patch patch;
    const std::string pierced =
        meshPolygon(patch, 5121, {0, 1, 4, 3, 255, 1, 2, 5, 255, 4, 5, 7, 255, 3, 4, 5, 7, 6}, {0, 5, 13}, {0, 6, 12});
    Character c = readWell(patch.with(pierced + R"(,"FB_ngon_encoding":{})"));
    EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::ngonEncoding) << "the next source is used";
    EXPECT_EQ(c.warnings,
              (Strings{"mesh 0 primitive 0 EXT_mesh_polygon: 1 polygon has a hole (first: polygon 1), which "
                       "no face of a cage can; not used"}));
    patch.b.more = R"(,"extensionsRequired":["EXT_mesh_polygon","KHR_mesh_primitive_restart"])";
    EXPECT_EQ(messageOf(patch.b),
              "t.glb: mesh 0 primitive 0 EXT_mesh_polygon: 1 polygon has a hole (first: polygon 1), "
              "which no face of a cage can");
    patch.b.more = "";
    c = readWell(
        patch.with(extension("EXT_mesh_polygon", {R"("triangleIndices":1)", R"("triangleIndicesOffsets":1)"})));
    EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::triangles);
    EXPECT_EQ(c.warnings, (Strings{"mesh 0 primitive 0 EXT_mesh_polygon: a form of the draft that is not understood, "
                                   "without count; not used"}));
}

TEST(GltfPolygons, MeshPolygonOfTheLaterDraft) {
    Patch patch;
    patch.b.meshes =
        R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0},"indices":1,)"
        R"("mode":2,"extensions":{"EXT_mesh_polygon":{"triangleIndices":1,"triangleIndicesOffsets":1}}}]}])";
    EXPECT_EQ(
        readWell(patch.b).warnings,
        (Strings{"mesh 0 primitive 1: LINE_LOOP instead of TRIANGLES, with EXT_mesh_polygon in a form of the draft "
                 "that is not understood; left out"}));
    patch.b.more = R"(,"extensionsRequired":["EXT_mesh_polygon"])";
    EXPECT_EQ(messageOf(patch.b),
              "t.glb: mesh 0 primitive 1: LINE_LOOP instead of TRIANGLES, with EXT_mesh_polygon in a "
              "form of the draft that is not understood");
}

TEST(GltfPolygons, MeshPolygonRefusals) {
    const auto with = [](const std::vector<uint32_t>& loops, const std::vector<uint32_t>& loopOffsets,
                         const std::vector<uint32_t>& offsets) {
        Patch patch;
        return messageOf(patch.with(meshPolygon(patch, 5121, loops, loopOffsets, offsets)));
    };
    const std::string name = "t.glb: mesh 0 primitive 0 EXT_mesh_polygon ";
    const std::vector<uint32_t> loops = {0, 1, 4, 3, 255, 1, 2, 5, 4, 255, 3, 4, 5, 7, 6};
    EXPECT_EQ(with(loops, {0, 5, 10}, {0, 6, 12}), "accepted");
    EXPECT_EQ(with(loops, {0, 5, 10}, {0, 6}), name + "indicesOffsets: 2 offsets for 3 polygons");
    EXPECT_EQ(with(loops, {1, 5, 10}, {0, 6, 12}), name + "loopIndicesOffsets[0]: not 0");
    EXPECT_EQ(with(loops, {0, 5, 5}, {0, 6, 12}), name + "loopIndicesOffsets[2]: not more than the one before it");
    EXPECT_EQ(with(loops, {0, 5, 15}, {0, 6, 12}), name + "loopIndicesOffsets[2]: 15 is out of range: the list has 15");
    EXPECT_EQ(with(loops, {0, 5, 10}, {0, 6, 21}), name + "indicesOffsets[2]: 21 is out of range: the list has 21");
    EXPECT_EQ(with(loops, {0, 5, 10}, {0, 5, 12}), name + "indicesOffsets[1]: not the beginning of a triangle");
    EXPECT_EQ(with(loops, {0, 5, 13}, {0, 6, 12}),
              name + "loopIndices: polygon 2 has 2 corners, at least 3 are needed");
    EXPECT_EQ(with({0, 1, 4, 1}, {0}, {0}), name + "loopIndices: face 0 repeats vertex 1");
    EXPECT_EQ(with({0, 1, 8}, {0}, {0}), name + "loopIndices: vertex 8 of face 0 is out of range: the primitive has 8");
    EXPECT_EQ(with({0, 1, 5, 255, 1, 2, 5}, {0, 4}, {0, 6}),
              name + "loopIndices: vertex 5 of polygon 0 is in none of its triangles");
    Patch patch;
    EXPECT_EQ(
        messageOf(patch.with(extension("EXT_mesh_polygon", {R"("count":1)", R"("loopIndices":99)",
                                                            R"("loopIndicesOffsets":1)", R"("indicesOffsets":1)"}))),
        name + "loopIndices: accessor 99 is out of range: the file has 2");
    EXPECT_EQ(
        messageOf(patch.with(extension("EXT_mesh_polygon", {R"("count":0)", R"("loopIndices":1)",
                                                            R"("loopIndicesOffsets":1)", R"("indicesOffsets":1)"}))),
        name + "count: zero");
    EXPECT_EQ(
        messageOf(patch.with(extension("EXT_mesh_polygon", {R"("count":1)", R"("loopIndices":0)",
                                                            R"("loopIndicesOffsets":1)", R"("indicesOffsets":1)"}))),
        name + "loopIndices: VEC3 instead of SCALAR");
}

// ---- EXT_mesh_primitive_edge_visibility -----------------------------------------------------------------------------

/// Two bits an edge: 0 hidden, 1 silhouette, 2 hard, 3 hard again.
std::vector<uint32_t> packEdges(const std::vector<uint32_t>& edges) {
    std::vector<uint32_t> bytes((edges.size() + 3) / 4, 0);
    for (size_t e = 0; e < edges.size(); ++e) {
        bytes[e / 4] |= edges[e] << (2 * (e % 4));
    }
    return bytes;
}

/// Of Patch's triangles: the diagonals hidden, all else hard.
const std::vector<uint32_t> kEdges = {2, 0, 2, 2, 2, 0, 2, 0, 3, 2, 2, 0, 3, 0, 2, 0, 2, 0, 3, 2, 0};

TEST(GltfPolygons, HiddenEdges) {
    Patch patch;
    const auto visibility = [&](const std::vector<uint32_t>& edges) {
        return extension("EXT_mesh_primitive_edge_visibility", {patch.list("visibility", packEdges(edges), 5121)});
    };
    Character c = readWell(patch.with(visibility(kEdges)));
    EXPECT_EQ(c.warnings, Strings());
    EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::hiddenEdges);
    EXPECT_EQ(facesOf(c.cage), kPolygons);

    // A silhouette edge is written once, and hidden where it is met again: no edge to merge across.
    std::vector<uint32_t> edges = kEdges;
    edges[1] = 1;
    EXPECT_EQ(facesOf(readWell(patch.with(visibility(edges))).cage),
              (Faces{{0, 1, 3}, {1, 4, 3}, {1, 2, 5, 4}, {3, 4, 5, 7, 6}}));

    // Hidden edges all round vertex 4 make no polygon.
    c = readWell(patch.with(visibility(std::vector<uint32_t>(21, 0))));
    EXPECT_EQ(c.cage.faceCount(), 7u);
    EXPECT_EQ(c.warnings,
              (Strings{"mesh 0 primitive 0: EXT_mesh_primitive_edge_visibility: 1 region of hidden edges is "
                       "no simple polygon; left in triangles"}));
}

TEST(GltfPolygons, LineStringsAreVisibleEdges) {
    Patch patch;
    std::vector<uint32_t> edges = kEdges;
    for (const size_t e : {size_t{3}, size_t{8}, size_t{4}, size_t{12}}) {
        edges[e] = 0; // 1-4 and 4-3, of both their faces
    }
    const std::string visibility = patch.list("visibility", packEdges(edges), 5121);
    const std::string strings = R"("lineStrings":[{)" + patch.list("indices", {1, 4, 3, 255, 0, 1}, 5121) + "}]";
    EXPECT_EQ(
        facesOf(readWell(patch.with(extension("EXT_mesh_primitive_edge_visibility", {visibility, strings}))).cage),
        kPolygons);
}

TEST(GltfPolygons, HiddenEdgesAcrossSeams) {
    // The quad's triangles share no vertex; corners are those of the triangles on the boundary.
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0});
    b.addIntegers("SCALAR", 5121, packEdges({2, 2, 0, 0, 2, 2}));
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"extensions":)"
               R"({"EXT_mesh_primitive_edge_visibility":{"visibility":1}}}]}])";
    EXPECT_EQ(facesOf(readWell(b).cage), (Faces{{0, 1, 2, 3}}));
}

TEST(GltfPolygons, HiddenEdgeRefusals) {
    Patch patch;
    const std::string name = "t.glb: mesh 0 primitive 0 EXT_mesh_primitive_edge_visibility";
    const auto with = [&](const Strings& members) {
        return messageOf(patch.with(extension("EXT_mesh_primitive_edge_visibility", members)));
    };
    EXPECT_EQ(with({}), name + ": neither visibility nor lineStrings");
    EXPECT_EQ(with({R"("visibility":1)"}), name + " visibility: UNSIGNED_SHORT components are not allowed here");
    EXPECT_EQ(with({patch.list("visibility", {1, 2, 3, 4, 5}, 5121)}), name + " visibility: 5 bytes for 7 triangles");
    EXPECT_EQ(with({R"("lineStrings":[3])"}), name + " lineString 0: not an object");
    EXPECT_EQ(with({R"("lineStrings":[{}])"}), name + " lineString 0: indices is missing");
    EXPECT_EQ(with({R"("lineStrings":[{)" + patch.list("indices", {0, 8}) + "}]"}),
              name + " lineString 0 indices[1]: vertex 8 is out of range: the primitive has 8");
}

// ---- triangles as they are, FB_ngon_encoding, pairs -----------------------------------------------------------------

TEST(GltfPolygons, NgonEncodingWhereThePrimitiveCarriesIt) {
    const std::vector<float> grid = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
    const std::vector<uint32_t> quads = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    GltfBuilder b = plainMesh(grid, quads, R"(,"extensions":{"FB_ngon_encoding":{}})");
    Character c = readWell(b.glb());
    EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::ngonEncoding);
    ASSERT_EQ(c.cage.faceCount(), 2u);
    EXPECT_EQ(face(c.cage, 0), (std::vector<uint32_t>{0, 1, 4, 3}));
    EXPECT_EQ(face(c.cage, 1), (std::vector<uint32_t>{1, 2, 5, 4}));

    // Assimp lists the extension as used whether or not a primitive has it.
    b = plainMesh(grid, quads);
    b.more = R"(,"extensionsUsed":["FB_ngon_encoding"])";
    c = readWell(b.glb());
    EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::triangles);
    EXPECT_EQ(c.cage.faceCount(), 4u);
}

const GltfOptions kPairAlways{.pairing = Pairing::always};

TEST(GltfPolygons, TrianglesThatMakeGoodQuadsArePaired) {
    const std::vector<float> grid = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
    GltfBuilder b = plainMesh(grid, {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4});
    for (const Pairing pairing : {Pairing::whereClean, Pairing::always}) {
        const Character c = readWell(b.glb(), {.pairing = pairing});
        EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::pairedTriangles);
        ASSERT_EQ(c.cage.faceCount(), 2u);
        EXPECT_EQ(face(c.cage, 0), (std::vector<uint32_t>{0, 1, 4, 3}));
        EXPECT_EQ(face(c.cage, 1), (std::vector<uint32_t>{1, 2, 5, 4}));
        // What draws triangles draws those of the file.
        EXPECT_EQ(c.cage.faceTriangles, (std::vector<uint32_t>{2, 0, 1, 2, 3, 0, 6, 4, 5, 6, 7, 4}));
        // Nobody has to be told of what he asked for.
        EXPECT_EQ(c.warnings, pairing == Pairing::always
                                  ? Strings{}
                                  : Strings{"file: triangles of 1 of 1 part paired into 2 quads, 0 left"});
    }
    const Character c = readWell(b.glb(), {.pairing = Pairing::never});
    EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::triangles);
    EXPECT_EQ(c.cage.faceCount(), 4u);
    EXPECT_EQ(c.warnings, Strings{});
    // The order of the triangles is nothing to go by after an optimizer.
    const GltfBuilder shuffled = plainMesh(grid, {1, 5, 4, 4, 0, 1, 5, 1, 2, 0, 4, 3});
    EXPECT_EQ(readWell(shuffled.glb(), {}).warnings,
              Strings{"file: triangles of 1 of 1 part paired into 2 quads, 0 left"});
    // One triangle more.
    const GltfBuilder more = plainMesh({0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0, 3, 0.5f, 0},
                                       {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 6, 5});
    EXPECT_EQ(readWell(more.glb(), {}).warnings, Strings{"file: triangles of 1 of 1 part paired into 2 quads, 1 left"});
}

TEST(GltfPolygons, TrianglesThatMakeFewGoodQuadsStay) {
    // A rhombus of two equilateral triangles, and a triangle that is left.
    const GltfBuilder b =
        plainMesh({0, 0, 0, 1, 0, 0, 0.5f, 0.866f, 0, 1.5f, 0.866f, 0, 2, 0, 0}, {0, 1, 2, 1, 3, 2, 1, 4, 3});
    EXPECT_EQ(readWell(b.glb(), {}).parts[0].polygonSource, PolygonSource::triangles);
    EXPECT_EQ(readWell(b.glb(), {}).cage.faceCount(), 3u);
    EXPECT_EQ(readWell(b.glb(), {}).warnings, Strings{});
    EXPECT_EQ(readWell(b.glb(), kPairAlways).parts[0].polygonSource, PolygonSource::pairedTriangles);
    EXPECT_EQ(readWell(b.glb(), kPairAlways).cage.faceCount(), 2u);
}

TEST(GltfPolygons, AttributesAndNormalsKeepTrianglesApart) {
    // A seam of UVs or of normals on the diagonal says that these were two faces.
    for (const std::string attribute : {"TEXCOORD_0", "NORMAL"}) {
        for (const bool seam : {false, true}) {
            GltfBuilder b;
            b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0});
            const float other = seam ? 0.5f : 0.0f;
            if (attribute == "NORMAL") {
                b.addFloats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, other, 0, 1, 0, 0, 1, 0, 0, 1});
            } else {
                b.addFloats("VEC2", {0, 0, 1, 0, 1, 1, 0, other, 1, 1, 0, 1});
            }
            b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0,")" + attribute + R"(":1}}]}])";
            EXPECT_EQ(readWell(b.glb(), {}).cage.faceCount(), seam ? 2u : 1u) << attribute;
            EXPECT_EQ(readWell(b.glb(), kPairAlways).cage.faceCount(), seam ? 2u : 1u) << attribute;
        }
    }
    // A fold over the shared edge too.
    const GltfBuilder fold = plainMesh({0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 0, 0.1f}, {0, 1, 2, 0, 2, 3});
    EXPECT_EQ(readWell(fold.glb(), {}).cage.faceCount(), 2u);
    EXPECT_EQ(readWell(fold.glb(), kPairAlways).cage.faceCount(), 2u);
}

TEST(GltfPolygons, EncodedPolygonsAreNeverPaired) {
    const GltfBuilder b =
        plainMesh({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 2, 3, 0}, R"(,"extensions":{"FB_ngon_encoding":{}})");
    const Character c = readWell(b.glb(), {.pairing = Pairing::always});
    EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::ngonEncoding);
    EXPECT_EQ(c.cage.faceCount(), 2u);
}

// ---- order ----------------------------------------------------------------------------------------------------------

TEST(GltfPolygons, SourcesInOrder) {
    Patch patch;
    const std::string counts = patch.list("faceVertexCounts", {4, 4, 3, 3, 3});
    const std::string corners = patch.list("faceVertexIndices", {0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 6, 4, 7, 6, 4, 5, 7});
    const Strings all = {
        cageExtension({counts, corners}),
        meshPolygon(patch, 5121, {0, 1, 4, 3, 255, 1, 2, 5, 4, 255, 3, 4, 5, 7, 6}, {0, 5, 10}, {0, 6, 12}),
        R"("FB_ngon_encoding":{})",
        extension("EXT_mesh_primitive_edge_visibility", {patch.list("visibility", packEdges(kEdges), 5121)})};
    const PolygonSource sources[] = {PolygonSource::cageExtension, PolygonSource::meshPolygon,
                                     PolygonSource::ngonEncoding, PolygonSource::hiddenEdges,
                                     PolygonSource::pairedTriangles};
    const uint32_t faceCounts[] = {5, 3, 7, 3, 4};
    for (size_t first = 0; first < 5; ++first) {
        std::string extensions;
        for (size_t i = first; i < 4; ++i) {
            // Last first: the order in the file does not matter.
            extensions.insert(0, extensions.empty() ? all[i] : all[i] + ",");
        }
        const Character c = readWell(patch.with(extensions), {.pairing = Pairing::always});
        EXPECT_EQ(c.parts[0].polygonSource, sources[first]);
        EXPECT_EQ(c.cage.faceCount(), faceCounts[first]) << polygonSourceName(c.parts[0].polygonSource);
    }
    EXPECT_EQ(readWell(patch.with("")).parts[0].polygonSource, PolygonSource::triangles);
}

TEST(GltfPolygons, EveryPrimitiveHasItsOwnSource) {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    b.addFloats("VEC3", {1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0});
    b.addIntegers("SCALAR", 5121, {0, 1, 2, 0, 2, 3});
    b.addIntegers("SCALAR", 5121, {4});
    b.addIntegers("SCALAR", 5121, {0, 1, 2, 3});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":2},)"
               R"({"attributes":{"POSITION":1},"indices":2,"extensions":{"SUPPLE_mesh_cage":)"
               R"({"faceVertexCounts":3,"faceVertexIndices":4,"holeIndices":5}}}]}])";
    b.addIntegers("SCALAR", 5121, {0});
    const Character c = readWell(b);
    EXPECT_EQ(c.parts[0].polygonSource, PolygonSource::cageExtension) << "the best of them names the whole";
    EXPECT_EQ(facesOf(c.cage), (Faces{{0, 1, 2}, {0, 2, 3}, {1, 4, 5, 2}}));
    EXPECT_EQ(c.cage.holes, (std::vector<uint32_t>{2}));
    EXPECT_TRUE(buildTopology(c.cage).ok());
}

} // namespace
} // namespace supple::cage
