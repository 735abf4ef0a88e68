// Parts of vertex and index buffers: welded, paired and cut as the primitives of a glTF file.
#include "runtime/arrays/character_arrays.h"

#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <supple/supple.hpp>
#include <vector>

namespace supple::test {
namespace {

using Strings = std::vector<std::string>;

/// Two quads side by side as four triangles, of two primitives whose vertices are split along the common edge.
struct TwoQuads {
    std::vector<float> left{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, right{1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0};
    std::vector<float> uvs{0, 0, 1, 0, 1, 1, 0, 1};
    std::vector<uint32_t> triangles{0, 1, 2, 0, 2, 3};
    std::vector<uint8_t> hidden{0, 0, 1, 1, 0, 0};
    std::vector<uint32_t> counts{4}, corners{0, 1, 2, 3}, numbers[2] = {{0, 1, 2, 3}, {1, 4, 5, 2}};
    SuppleNodeDesc node = sized<SuppleNodeDesc>();
    std::vector<SupplePrimitiveDesc> primitives{sized<SupplePrimitiveDesc>(), sized<SupplePrimitiveDesc>()};
    SupplePartDesc part = sized<SupplePartDesc>();
    SuppleCharacterDesc desc = sized<SuppleCharacterDesc>();

    TwoQuads() {
        node.parent = SUPPLE_NO_NODE;
        for (size_t p = 0; p < 2; ++p) {
            primitives[p].vertexCount = 4;
            primitives[p].positions = p == 0 ? left.data() : right.data();
            primitives[p].uvs = uvs.data();
            primitives[p].material = SUPPLE_NO_MATERIAL;
            primitives[p].triangleCount = 2;
            primitives[p].triangles = triangles.data();
        }
        part.primitiveCount = 2;
        part.primitives = primitives.data();
        desc.nodeCount = desc.partCount = 1;
        desc.nodes = &node;
        desc.parts = &part;
    }
    TwoQuads(const TwoQuads&) = delete;
    TwoQuads& operator=(const TwoQuads&) = delete;
};

using Change = std::function<void(TwoQuads&)>;

Result<cage::Character> readQuads(const Change& change, cage::Pairing pairing = cage::Pairing::never) {
    TwoQuads quads;
    change(quads);
    return runtime::characterFromArrays(quads.desc, "quads", {}, pairing);
}

void expectQuads(const Change& change, cage::PolygonSource source, cage::Pairing pairing = cage::Pairing::never) {
    const Result<cage::Character> read = readQuads(change, pairing);
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->cage.faceStarts, (std::vector<uint32_t>{0, 4, 8}));
    EXPECT_EQ(read->cage.vertexCount(), 6u);
    EXPECT_EQ(read->seamVertexCount, 2u);
    EXPECT_EQ(read->cage.cornerUvs.size(), 8u);
    EXPECT_EQ(read->parts[0].polygonSource, source);
    EXPECT_TRUE(read->parts[0].rigid);
}

TEST(PrimitiveArrays, AreWelded) {
    const Result<cage::Character> read = readQuads([](TwoQuads&) {});
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->cage.faceCount(), 4u);
    EXPECT_EQ(read->cage.vertexCount(), 6u);
    EXPECT_EQ(read->cage.sourceVertices, (std::vector<uint32_t>{0, 1, 2, 3, 5, 6}));
    EXPECT_EQ(read->sourceVertexCount, 8u);
    EXPECT_EQ(read->parts[0].weldSource, cage::WeldSource::equality);
    EXPECT_EQ(read->warnings, Strings());
}

TEST(PrimitiveArrays, BecomePolygons) {
    expectQuads([](TwoQuads&) {}, cage::PolygonSource::pairedTriangles, cage::Pairing::always);
    expectQuads(
        [](TwoQuads& q) {
            for (SupplePrimitiveDesc& primitive : q.primitives) {
                primitive.polygons = SUPPLE_POLYGONS_FANS;
            }
        },
        cage::PolygonSource::ngonEncoding);
    expectQuads(
        [](TwoQuads& q) {
            for (SupplePrimitiveDesc& primitive : q.primitives) {
                primitive.polygons = SUPPLE_POLYGONS_HIDDEN_EDGES;
                primitive.hiddenEdges = q.hidden.data();
            }
        },
        cage::PolygonSource::hiddenEdges);
    expectQuads(
        [](TwoQuads& q) {
            for (SupplePrimitiveDesc& primitive : q.primitives) {
                primitive.polygons = SUPPLE_POLYGONS_LISTED;
                primitive.faceCount = 1;
                primitive.faceVertexCounts = q.counts.data();
                primitive.faceVertexIndices = q.corners.data();
            }
        },
        cage::PolygonSource::arrays);
}

TEST(PrimitiveArrays, SayWhichVerticesAreOne) {
    static const uint32_t kCrease[] = {1, 2}, kHole = 0, kSet = 1;
    static const float kSharpness = 3.0f;
    static const char* const kNames[] = {"unused", "seam"};
    static const SuppleCreaseScalar kScalar{2, 1, 0.0f};
    const Result<cage::Character> read = readQuads([](TwoQuads& q) {
        for (size_t p = 0; p < 2; ++p) {
            SupplePrimitiveDesc& primitive = q.primitives[p];
            primitive.cageVertices = q.numbers[p].data();
            primitive.polygons = SUPPLE_POLYGONS_LISTED;
            primitive.faceCount = 1;
            primitive.faceVertexCounts = q.counts.data();
            primitive.faceVertexIndices = q.corners.data();
        }
        q.primitives[1].creaseCount = 1;
        q.primitives[1].creaseVertices = kCrease; // numbers
        q.primitives[1].creaseSharpnesses = &kSharpness;
        q.primitives[1].creaseSetCount = 2;
        q.primitives[1].creaseSetNames = kNames;
        q.primitives[1].creaseSets = &kSet;
        q.primitives[0].creaseScalarCount = 1;
        q.primitives[0].creaseScalars = &kScalar;
        q.primitives[1].holeCount = 1;
        q.primitives[1].holes = &kHole;
        q.part.roundCorners = 1;
    });
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->parts[0].weldSource, cage::WeldSource::given);
    ASSERT_EQ(read->cage.creases.size(), 1u);
    EXPECT_EQ(read->cage.creases[0].a, 1u);
    EXPECT_EQ(read->cage.creases[0].b, 2u);
    EXPECT_EQ(read->cage.creaseSets.at(read->cage.creases[0].set), "seam");
    ASSERT_EQ(read->cage.creaseScalars.size(), 1u);
    EXPECT_EQ(read->cage.creaseScalars[0].vertex, 2u);
    EXPECT_EQ(read->cage.creaseScalars[0].toward, 1u);
    EXPECT_EQ(read->cage.holes, std::vector<uint32_t>{1});
    EXPECT_EQ(read->cage.roundCorners, (std::vector<uint32_t>{0, 3, 4, 5}));
}

TEST(PrimitiveArrays, ShareVertices) {
    const Result<cage::Character> read = readQuads([](TwoQuads& q) {
        static const uint32_t kFirst[] = {0, 1, 2}, kSecond[] = {0, 2, 3};
        q.primitives[0].triangleCount = q.primitives[1].triangleCount = 1;
        q.primitives[0].triangles = kFirst;
        q.primitives[1].triangles = kSecond;
        q.primitives[1].positions = nullptr;
        q.primitives[1].sharedVertices = 1;
    });
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->cage.vertexCount(), 4u);
    EXPECT_EQ(read->sourceVertexCount, 4u);
    EXPECT_EQ(read->seamVertexCount, 0u);
}

TEST(PrimitiveArrays, AreRefusedByName) {
    const struct {
        const char* message;
        Change change;
    } faults[] = {
        {"part 0: both cage and primitives",
         [](TwoQuads& q) {
             static const SuppleCageDesc kCage = sized<SuppleCageDesc>();
             q.part.cage = &kCage;
         }},
        {"part 0: influences without a skin", [](TwoQuads& q) { q.part.influences.perVertex = 1; }},
        {"part 0 primitive 1: positions is null", [](TwoQuads& q) { q.primitives[1].positions = nullptr; }},
        {"part 0 primitive 1: 1 position is not finite or beyond 1e+09: vertex 2",
         [](TwoQuads& q) { q.right[6] = std::numeric_limits<float>::infinity(); }},
        {"part 0 primitive 0: 1 corner names no vertex: vertex 4 of 4 in triangle 1\nquads: part 0 primitive 1: 1 "
         "corner "
         "names no vertex: vertex 4 of 4 in triangle 1",
         [](TwoQuads& q) { q.triangles[5] = 4; }},
        {"part 0 primitive 1: material 0 of 0", [](TwoQuads& q) { q.primitives[1].material = 0; }},
        {"part 0 primitive 1: cageVertices are not on all primitives",
         [](TwoQuads& q) { q.primitives[1].cageVertices = q.numbers[1].data(); }},
        {"part 0 primitive 0: sharedVertices 1 is not the number + 1 of a primitive before it with as many vertices",
         [](TwoQuads& q) {
             q.primitives[0].sharedVertices = 1;
             q.primitives[0].positions = nullptr;
         }},
        {"part 0 primitive 1: no such polygons",
         [](TwoQuads& q) { q.primitives[1].polygons = static_cast<SupplePrimitivePolygons>(4); }},
        {"part 0 primitive 1: hiddenEdges is null",
         [](TwoQuads& q) { q.primitives[1].polygons = SUPPLE_POLYGONS_HIDDEN_EDGES; }},
        {"part 0 primitive 1: 1 face repeats a vertex: face 0",
         [](TwoQuads& q) {
             q.corners[3] = 2;
             q.primitives[1].polygons = SUPPLE_POLYGONS_LISTED;
             q.primitives[1].faceCount = 1;
             q.primitives[1].faceVertexCounts = q.counts.data();
             q.primitives[1].faceVertexIndices = q.corners.data();
         }},
        {"part 0: no triangle is left",
         [](TwoQuads& q) { q.primitives[0].triangleCount = q.primitives[1].triangleCount = 0; }},
        {"part 0 primitive 1 creases[0]: vertex 9 is out of range: the primitive has 4",
         [](TwoQuads& q) {
             static const uint32_t kCrease[] = {9, 1};
             static const float kSharpness = 1.0f;
             q.primitives[1].creaseCount = 1;
             q.primitives[1].creaseVertices = kCrease;
             q.primitives[1].creaseSharpnesses = &kSharpness;
         }},
        {"part 0 primitive 1: 1 crease scalar has an alpha that is not in [0, 1]: crease scalar 0",
         [](TwoQuads& q) {
             static const SuppleCreaseScalar kScalar{0, 1, 1.5f};
             q.primitives[1].creaseScalarCount = 1;
             q.primitives[1].creaseScalars = &kScalar;
         }},
        {"part 0 primitive 1: 1 crease is in no such set: set 1 of 0, of crease 0",
         [](TwoQuads& q) {
             static const uint32_t kCrease[] = {0, 1}, kSet = 1;
             static const float kSharpness = 1.0f;
             q.primitives[1].creaseCount = 1;
             q.primitives[1].creaseVertices = kCrease;
             q.primitives[1].creaseSharpnesses = &kSharpness;
             q.primitives[1].creaseSets = &kSet;
         }},
    };
    for (const auto& fault : faults) {
        SCOPED_TRACE(fault.message);
        const Result<cage::Character> read = readQuads(fault.change);
        ASSERT_FALSE(read.ok());
        EXPECT_EQ(read.error().message, std::string("quads: ") + fault.message);
    }
}

} // namespace
} // namespace supple::test
