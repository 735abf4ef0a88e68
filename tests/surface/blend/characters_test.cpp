// The blending surface of characters and meshes as they are found: bits, floats, and where it folds.
#include "cage/gltf/reader.h"
#include "tests/support/blend_borders.h"
#include "tests/support/shared_assets.h"

#include <array>
#include <cstdio>
#include <filesystem>

namespace supple::surface::blend {
namespace {

Result<cage::Character> readFile(const std::string& path) {
    const bool obj = std::filesystem::path(path).extension() == ".obj";
    return obj ? test::readObjFile(path) : cage::readGltfFile(path);
}

/// Samples whose normal looks away from the face's.
struct Folds {
    uint64_t samples = 0, folded = 0;
};

Folds foldsOf(const cage::Cage& cage, const Mesh& mesh) {
    constexpr uint32_t kRate = 4;
    const test::BlendSurface<double> surface(mesh, test::doublePositions(cage));
    const Evaluator<double> evaluator = surface.at(kRate);
    Folds folds;
    for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
        const auto corner = [&](uint32_t k) { return surface.coefficients[mesh.corners[4 * f + k].chart][0]; };
        const glm::dvec3 face = glm::cross(corner(2) - corner(0), corner(3) - corner(1));
        for (uint32_t s = 0; s < (kRate + 1) * (kRate + 1); ++s) {
            const glm::dvec3 normal = evaluator.at(f, s % (kRate + 1), s / (kRate + 1)).normal;
            ++folds.samples;
            folds.folded += glm::dot(normal, face) < 0.0 ? 1 : 0;
        }
    }
    return folds;
}

TEST(BlendCharacters, charactersAndMeshes) {
    constexpr std::array<uint32_t, 2> kRates{5, 8};
    std::vector<std::string> paths = test::filesBelow(test::sharedFolder() + "meshes", {".obj"});
    const std::vector<std::string> characters = test::allCharacters();
    paths.insert(paths.end(), characters.begin(), characters.end());
    test::BlendCounts counts;
    test::BlendErrors errors;
    Folds all;
    uint32_t tested = 0;
    for (const std::string& path : paths) {
        const Result<cage::Character> character = readFile(path);
        ASSERT_TRUE(character.ok()) << character.error().message;
        const cage::Cage& cage = character->cage;
        const Result<Mesh> mesh = buildMesh(cage);
        const std::string name = std::filesystem::path(path).filename().string();
        if (!mesh.ok()) {
            EXPECT_FALSE(cage::buildTopology(cage).ok()) << name << ": " << mesh.error().message;
            continue;
        }
        ++tested;
        const uint64_t differing = counts.differ;
        test::compareSides(cage, *mesh, kRates, counts);
        EXPECT_EQ(counts.differ, differing) << name;
        test::compareFloats(cage, *mesh, errors);
        const Folds folds = foldsOf(cage, *mesh);
        all.samples += folds.samples;
        all.folded += folds.folded;
        if (folds.folded * 200 > folds.samples) {
            std::printf("%-40s %s, %.1f%% of %llu samples look away from their face\n", name.c_str(),
                        mesh->refined ? "refined" : "quads",
                        100.0 * static_cast<double>(folds.folded) / static_cast<double>(folds.samples),
                        static_cast<unsigned long long>(folds.samples));
        }
    }
    std::printf("%u of %zu files; %llu shared points, %llu differ; positions within %.1e of the extent, %llu of %llu "
                "normals off by more than 0.05 degrees; %llu of %llu samples look away from their face\n",
                tested, paths.size(), static_cast<unsigned long long>(counts.points),
                static_cast<unsigned long long>(counts.differ), errors.position,
                static_cast<unsigned long long>(errors.turned), static_cast<unsigned long long>(errors.normals),
                static_cast<unsigned long long>(all.folded), static_cast<unsigned long long>(all.samples));
    EXPECT_GT(tested, 0u);
    EXPECT_LT(errors.position, 2e-6);
    EXPECT_LT(static_cast<double>(errors.turned), 1e-3 * static_cast<double>(errors.normals));
}

} // namespace
} // namespace supple::surface::blend
