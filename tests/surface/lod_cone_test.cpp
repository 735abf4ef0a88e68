// Cones of normals: that they hold the normals, and how many patches that show their back they find, on characters.
#include "surface/lod/cone.h"

#include "cage/gltf_reader.h"
#include "tests/support/meshes.h"
#include "tests/support/prep_surface.h"
#include "tests/support/shared_assets.h"

#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <random>

namespace supple::surface::lod {
namespace {

constexpr uint32_t kRate = 8;

TEST(LodCone, holdsEveryNormal) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    uint32_t narrow = 0;
    for (uint32_t n = 0; n < 2000; ++n) {
        BicubicNet g;
        const double roughness = 0.02 + 0.1 * (n % 5);
        for (uint32_t k = 0; k < 16; ++k) {
            const uint32_t row = k / 4;
            g[k] = {k % 4 + roughness * normal(random), row + roughness * normal(random), roughness * normal(random)};
        }
        const NormalCone cones[] = {coneOfProducts(g), coneOfDifferences(g)};
        prep::Patch<double> patch{};
        patch.g = g;
        for (const NormalCone& cone : cones) {
            narrow += cone.cosine > 0.0 ? 1 : 0;
            for (uint32_t k = 0; k < 25 && cone.cosine > 0.0; ++k) {
                const auto sample = prep::evaluate<double>(patch, test::parameterPair<double>(k % 5, 4),
                                                           test::parameterPair<double>(k / 5, 4));
                ASSERT_GE(glm::dot(glm::normalize(glm::cross(sample.du, sample.dv)), cone.axis), cone.cosine - 1e-9);
            }
        }
    }
    EXPECT_GT(narrow, 2000U);
}

TEST(LodCone, findsMostPatchesThatShowTheirBack) {
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    size_t patches = 0, away = 0, byNet = 0, byProducts = 0, byDifferences = 0, perturbed = 0;
    for (const std::string& path : test::allQuadCharacters()) {
        const Result<cage::Character> character = cage::readGltfFile(path);
        ASSERT_TRUE(character.ok()) << character.error().message;
        const std::vector<glm::dvec3> positions = test::doublePositions(character->cage);
        const double size = test::extent(positions);
        glm::dvec3 middle(0.0);
        for (const glm::dvec3& p : positions) {
            middle += p / double(positions.size());
        }
        const test::PrepSurface<double> surface(character->cage, positions);
        for (uint32_t view = 0; view < 4; ++view) {
            const glm::dvec3 direction = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
            const glm::dvec3 camera = middle + direction * size * (view % 2 == 0 ? 0.9 : 4.0);
            for (uint32_t f = view; f < surface.patches.size(); f += 4) {
                if (surface.patches[f].perturbed) {
                    ++perturbed;
                    continue;
                }
                const BicubicNet& g = surface.patches[f].g;
                bool back = true;
                for (uint32_t k = 0; k < (kRate + 1) * (kRate + 1) && back; ++k) {
                    const auto sample = surface.at(f, k % (kRate + 1), k / (kRate + 1), kRate);
                    back = glm::dot(glm::cross(sample.du, sample.dv), sample.position - camera) >= 0.0;
                }
                const bool found[] = {netShowsItsBack(g, camera), showsItsBack(coneOfProducts(g), g, camera),
                                      showsItsBack(coneOfDifferences(g), g, camera)};
                EXPECT_TRUE(back || !(found[0] || found[1] || found[2])) << path << ", face " << f;
                ++patches;
                away += back ? 1 : 0;
                byNet += found[0] ? 1 : 0;
                byProducts += found[1] ? 1 : 0;
                byDifferences += found[2] ? 1 : 0;
            }
        }
    }
    std::printf("%zu bicubic patches (%zu more perturbed): %zu show their back; found by the net %zu, by the cone of "
                "products %zu, by the cones of differences %zu\n",
                patches, perturbed, away, byNet, byProducts, byDifferences);
    EXPECT_GT(byNet * 10, away * 7);
    EXPECT_GT(byProducts * 10, away * 5);
    EXPECT_GE(byNet, byProducts);
    EXPECT_GE(byProducts, byDifferences);
}

} // namespace
} // namespace supple::surface::lod
