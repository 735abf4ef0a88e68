// Loop on the device against OpenSubdiv's limit surface: its shapes of triangles, and cages made for the tests.
#include "tests/support/loop_triangles.h"
#include "tests/support/meshes.h"
#include "tests/support/prep_surface.h"
#include "tests/support/shared_assets.h"
#include "tests/support/subdivision_zoo.h"
#include "tools/common/character_file.h"
#ifdef SUPPLE_HAS_OPENSUBDIV
#include "tests/support/limit_figures.h"
#include "tests/support/loop_limit.h"
#include "tests/support/worst.h"
#endif

#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

#ifndef SUPPLE_HAS_OPENSUBDIV

TEST(LoopOpenSubdiv, onTheDevice) {
    GTEST_SKIP() << "built without OpenSubdiv (opensubdiv/far/topologyRefiner.h and the library osdCPU)";
}

#else

constexpr uint32_t kLoopRate = 5; ///< no sample lies where a step of subdivision has a vertex

/// Every `stride`-th sample. At corners normals are not compared: OpenSubdiv's derivatives there are those of one face.
LimitFigures compareWithLimit(host::Device& device, const cage::Cage& cage, uint32_t stride) {
    LimitFigures figures;
    const LoopTriangles triangles(cage);
    GpuOptions options;
    options.scheme = SUPPLE_SCHEME_LOOP;
    options.mapping = SUPPLE_MAPPING_NARROW;
    options.flags = 0;
    options.rate = kLoopRate;
    GpuSurface gpu(device, cage, options);
    if (!gpu.valid()) {
        ADD_FAILURE() << "no group";
        return figures;
    }
    gpu.evaluate();
    cage::Cage faces = triangles.isolation.parent.cage; // of the same vertices
    faces.creases = cage.creases;
    faces.sharpVertices = cage.sharpVertices;
    faces.roundCorners = cage.roundCorners;
    const std::vector<glm::dvec3> positions = doublePositions(faces);
    const double size = sizeOf(positions);
    const LoopLimit limit(faces, positions);
    const PatchFaces found = triangles.patches(gpu.patches());
    uint32_t next = 0;
    for (uint32_t p = 0; p < found.faces.size(); ++p) {
        uint32_t s = 0;
        for (uint32_t j = 0; j <= kLoopRate; ++j) {
            for (uint32_t i = 0; i + j <= kLoopRate; ++i, ++s) {
                if (next++ % stride != 0) {
                    continue;
                }
                const double segments = kLoopRate;
                const uint32_t k = kLoopRate - i - j;
                const glm::dvec3 at = LoopTriangles::inFace({k / segments, i / segments, j / segments},
                                                            found.firstCorners[found.faces[p]]);
                const LoopLimit::Point expected = limit.at(found.faces[p], at.y, at.z);
                const GpuSurface::Vertex& vertex = gpu.vertex(0, p, s);
                const bool corner = std::max({i, j, k}) == kLoopRate;
                raise(corner ? figures.corner : figures.position,
                      glm::length(glm::dvec3(vertex.position) - expected.position) / size);
                ++figures.samples;
                if (corner) {
                    continue;
                }
                const double angle = angleDegrees(vertex.normal, expected.normal());
                ++figures.normals;
                figures.steep += angle > 0.05 ? 1 : 0;
                raise(figures.normal, angle);
            }
        }
    }
    return figures;
}

void expectTheLimit(const LimitFigures& figures) {
    EXPECT_LE(figures.position, 3e-7);
    EXPECT_LE(figures.corner, 2e-5);
    EXPECT_LE(static_cast<double>(figures.steep), 1e-3 * static_cast<double>(figures.normals)) << figures.normal;
}

TEST(LoopOpenSubdiv, onTheDevice) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    const std::string folder = sharedFolder() + "meshes/opensubdiv";
    LimitFigures all;
    uint32_t shapes = 0, refused = 0;
    for (const std::string& path : filesBelow(folder, {".obj"})) {
        const std::string name = std::filesystem::path(path).filename().string();
        if (!name.starts_with("loop_")) {
            continue;
        }
        SCOPED_TRACE(name);
        const Result<host::CharacterFile> file = host::readCharacterFile(path);
        if (!file) {
            std::printf("  not read: %s\n", file.error().message.c_str());
            ++refused;
            continue;
        }
        cage::Cage cage = file->character.cage;
        cage.faceMaterials.clear(); // the group is made of arrays without them
        cage.faceParts.clear();
        const LimitFigures figures = compareWithLimit(*device, cage, 1 + cage.faceCount() / 200);
        expectTheLimit(figures);
        if (figures.position > 3e-7 || figures.corner > 1e-6 || figures.steep > 0) {
            figures.print(name.c_str());
        }
        all.add(figures);
        ++shapes;
    }
    std::printf("%u shapes, %u not read. ", shapes, refused);
    all.print("All");
    if (shapes == 0) {
        std::printf("all shapes left out: %s is not present\n", folder.c_str());
    }
    LimitFigures zoo;
    for (const SubdivisionCage& made : subdivisionZoo()) {
        SCOPED_TRACE(made.name);
        const LimitFigures figures = compareWithLimit(*device, made.cage, 1);
        expectTheLimit(figures);
        zoo.add(figures);
    }
    zoo.print("Cages made for tests");
}

#endif

} // namespace
} // namespace supple::test
