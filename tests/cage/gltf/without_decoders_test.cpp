// The reader of a build without meshoptimizer and Draco: compressed files are refused by name, all others are read as
// ever.
#include "tests/cage/gltf/compressed.h"
#include "tests/cage/gltf/draco.h"
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

TEST(GltfWithoutDecoders, RefusesMeshopt) {
    for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        EXPECT_EQ(messageOf(compressed(triangle(), extension)),
                  std::string("t.glb: bufferView 0 ") + extension +
                      ": this build of Supple reads no meshopt-compressed files (SUPPLE_WITH_MESHOPT is off)");
    }
}

TEST(GltfWithoutDecoders, RefusesDraco) {
    const GltfBuilder b = plainMesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
    EXPECT_EQ(messageOf(dracoCompressed(b)),
              "t.glb: mesh 0 primitive 0 KHR_draco_mesh_compression: this build of Supple reads no Draco-compressed "
              "files (SUPPLE_WITH_DRACO is off)");
    EXPECT_EQ(readWell(dracoCompressed(b, {.fallback = true})).cage.positions.size(), 3u);
}

TEST(GltfWithoutDecoders, ReadsOthers) {
    EXPECT_EQ(readWell(triangle().glb()).cage.positions.size(), 3u);
}

} // namespace
} // namespace supple::cage
