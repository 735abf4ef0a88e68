// The reader of a build without meshoptimizer: compressed files are refused by name, all others are read as ever.
#include "tests/cage/gltf/compressed.h"
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;

GltfBuilder triangle() {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0}}]}])";
    return b;
}

TEST(GltfWithoutMeshopt, RefusesCompressedFiles) {
    for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        EXPECT_EQ(messageOf(compressed(triangle(), extension)),
                  std::string("t.glb: bufferView 0 ") + extension +
                      ": this build of Supple reads no meshopt-compressed files (SUPPLE_WITH_MESHOPT is off)");
    }
}

TEST(GltfWithoutMeshopt, ReadsOthers) {
    EXPECT_EQ(readWell(triangle().glb()).cage.positions.size(), 3u);
}

} // namespace
} // namespace supple::cage
