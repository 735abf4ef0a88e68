// Catmull-Clark on the device against OpenSubdiv's limit surface: shapes, characters and cages made for the tests.
#include "tests/support/exact_quads.h"
#include "tests/support/shared_assets.h"
#include "tests/support/subdivision_zoo.h"
#include "tools/common/character_file.h"
#ifdef SUPPLE_HAS_OPENSUBDIV
#include "tests/support/catmull_clark_limit.h"
#include "tests/support/limit_figures.h"
#include "tests/support/prep_surface.h"
#include "tests/support/worst.h"
#endif

#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

#ifndef SUPPLE_HAS_OPENSUBDIV

TEST(ExactOpenSubdiv, onTheDevice) {
    GTEST_SKIP() << "built without OpenSubdiv (opensubdiv/far/topologyRefiner.h and the library osdCPU)";
}

#else

constexpr uint32_t kRate = 5; ///< along a quad's edge: no sample lies where a step of subdivision has a vertex

/// Every `stride`-th sample. At corners normals are not compared: OpenSubdiv's derivatives there are those of one quad.
LimitFigures compare(host::Device& device, const cage::Cage& cage, uint32_t stride) {
    LimitFigures figures;
    const ExactQuads quads(cage);
    GpuOptions options;
    options.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
    options.mapping = SUPPLE_MAPPING_NARROW;
    options.flags = 0;
    options.rate = quads.rateFor(kRate);
    GpuSurface gpu(device, cage, options);
    if (!gpu.valid()) {
        ADD_FAILURE() << "no group";
        return figures;
    }
    gpu.evaluate();
    const std::vector<glm::dvec3> positions = doublePositions(cage);
    const double size = sizeOf(positions);
    const CatmullClarkLimit limit(cage, positions);
    const QuadsOfFaces named(cage, quads);
    const PatchFaces found = quads.patches(gpu.patches());
    uint32_t next = 0;
    for (uint32_t p = 0; p < found.faces.size(); ++p) {
        for (uint32_t s = 0; s < gpu.sampleCount(p); ++s) {
            if (next++ % stride != 0) {
                continue;
            }
            const uint32_t i = s % (kRate + 1), j = s / (kRate + 1), face = found.faces[p];
            const glm::dvec2 at = ExactQuads::inFace(static_cast<double>(i) / kRate, static_cast<double>(j) / kRate,
                                                     found.firstCorners[face]);
            const auto [cageFace, part, uv] = named.at(face, at);
            const CatmullClarkLimit::Point expected = limit.at(cageFace, part, uv.x, uv.y);
            const GpuSurface::Vertex& vertex = gpu.vertex(0, p, s);
            const bool corner = i % kRate == 0 && j % kRate == 0;
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
    return figures;
}

void expectEqual(const LimitFigures& figures) {
    EXPECT_LE(figures.position, 1e-6);
    EXPECT_LE(figures.corner, 2e-5);
    EXPECT_LE(static_cast<double>(figures.steep), 1e-3 * static_cast<double>(figures.normals)) << figures.normal;
}

/// Compares no more than some thousand samples of a file.
LimitFigures compareFile(host::Device& device, const std::string& path, uint32_t& refused) {
    const Result<host::CharacterFile> file = host::readCharacterFile(path);
    if (!file) {
        std::printf("  not read: %s\n", file.error().message.c_str());
        ++refused;
        return {};
    }
    cage::Cage cage = file->character.cage;
    cage.faceMaterials.clear(); // the group is made of arrays without them
    cage.faceParts.clear();
    const std::string name = std::filesystem::path(path).filename().string();
    SCOPED_TRACE(name);
    const LimitFigures figures = compare(device, cage, 1 + cage.faceCount() / 200);
    expectEqual(figures);
    if (figures.position > 5e-7 || figures.corner > 1e-6 || figures.steep > 0) {
        figures.print(name.c_str());
    }
    return figures;
}

TEST(ExactOpenSubdiv, onTheDevice) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    const std::string folder = sharedFolder() + "meshes";
    const std::vector<std::string> shapes = filesBelow(folder, {".obj"});
    if (shapes.empty()) {
        std::printf("all shared meshes left out: %s is not present\n", folder.c_str());
    }
    for (const auto& [name, paths] : {std::pair("meshes", shapes), std::pair("characters", allCharacters())}) {
        LimitFigures all;
        uint32_t refused = 0;
        for (const std::string& path : paths) {
            all.add(compareFile(*device, path, refused));
        }
        std::printf("%zu %s, %u not read. ", paths.size(), name, refused);
        all.print("All");
    }
    LimitFigures zoo;
    for (const SubdivisionCage& made : subdivisionZoo()) {
        SCOPED_TRACE(made.name);
        const LimitFigures figures = compare(*device, made.cage, 1);
        expectEqual(figures);
        zoo.add(figures);
    }
    zoo.print("Cages made for tests");
}

#endif

} // namespace
} // namespace supple::test
