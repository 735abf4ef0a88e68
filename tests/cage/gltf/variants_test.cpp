// KHR_materials_variants: other materials for the same primitives, by name.
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;

/// Two triangles with materials 0 and 1. In "night" the first has material 2; in "day" both have 1.
GltfBuilder withVariants(const std::string& first = R"({"variants":[1],"material":2},{"variants":[0],"material":1})") {
    GltfBuilder b = plainMesh({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, {0, 1, 2});
    const std::string other = std::to_string(b.addIntegers("SCALAR", 5125, {2, 1, 3}));
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0,"extensions":)"
               R"({"KHR_materials_variants":{"mappings":[)" +
               first + R"(]}}},{"attributes":{"POSITION":0},"indices":)" + other + R"(,"material":1}]}])";
    b.more = R"(,"materials":[{"name":"a"},{"name":"b"},{"name":"c"}],"extensionsUsed":["KHR_materials_variants"],)"
             R"("extensions":{"KHR_materials_variants":{"variants":[{"name":"day"},{"name":"night"},{"name":"day"},)"
             R"({}]}})";
    return b;
}

std::vector<uint32_t> materialsOf(const GltfBuilder& b, const std::string& variant) {
    GltfOptions options = kKeepTriangles;
    options.variant = variant;
    const Character c = readWell(b, options);
    EXPECT_EQ(c.materials.size(), 3u);
    return c.cage.faceMaterials;
}

TEST(GltfVariants, TheirMaterialsAreThoseOfTheFaces) {
    EXPECT_EQ(readWell(withVariants()).materialVariants, (Strings{"day", "night"}));
    EXPECT_EQ(saidOf(withVariants().glb()), "");
    EXPECT_EQ(materialsOf(withVariants(), ""), (std::vector<uint32_t>{0, 1}));
    EXPECT_EQ(materialsOf(withVariants(), "day"), (std::vector<uint32_t>{1, 1}));
    EXPECT_EQ(materialsOf(withVariants(), "night"), (std::vector<uint32_t>{2, 1}));
}

TEST(GltfVariants, ANameThatIsNotThereIsRefused) {
    GltfOptions options = kKeepTriangles;
    options.variant = "dusk";
    EXPECT_EQ(messageOf(withVariants().glb(), ErrorCode::argument, options),
              "t.glb: file: no material variant \"dusk\"; it has \"day\", \"night\"");
    EXPECT_EQ(messageOf(skinnedQuad().glb(), ErrorCode::argument, options),
              "t.glb: file: no material variant \"dusk\"; it has none");
}

TEST(GltfVariants, WrongMappingsAreLeftOut) {
    GltfOptions options = kKeepTriangles;
    options.variant = "night";
    const auto warningsOf = [&](const std::string& first) {
        const Character c = readWell(withVariants(first), options);
        EXPECT_EQ(c.cage.faceMaterials, (std::vector<uint32_t>{0, 1}));
        return c.warnings;
    };
    const std::string place = "mesh 0 primitive 0 KHR_materials_variants mapping 0";
    EXPECT_EQ(warningsOf("7"), Strings{place + ": not an object; left out"});
    EXPECT_EQ(warningsOf(R"({"variants":[1],"material":3})"),
              Strings{place + " material: material 3 is out of range: the file has 3; left out"});
    EXPECT_EQ(warningsOf(R"({"variants":[4],"material":2})").size(), 1u);
    EXPECT_EQ(warningsOf(R"({"variants":[1]})").size(), 1u);
    EXPECT_EQ(warningsOf(""), Strings());
}

} // namespace
} // namespace supple::cage
