// Levels of edges as the device writes them, against the reference's from the same cubics, for both measures.
#include "cage/gltf/reader.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_budget.h"
#include "tests/support/lod_surface.h"
#include "tests/support/test_view.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

class LodLevels : public CrowdContexts, public testing::WithParamInterface<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, LodLevels, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

TEST_P(LodLevels, EdgesHaveTheReferencesOfBothMeasures) {
    namespace budget = surface::lod::budget;
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    const std::string path = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip_quads.glb";
    const Result<cage::Character> character = cage::readGltfFile(path);
    ASSERT_TRUE(character.ok());
    glm::vec3 low(1e30f), high(-1e30f);
    for (const glm::vec3& p : character->cage.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const float size = glm::length(high - low);
    // Corners and controls of edges 0..3 in g[i + 4 j].
    constexpr size_t kBorders[4][4] = {{0, 1, 2, 3}, {3, 7, 11, 15}, {12, 13, 14, 15}, {0, 4, 8, 12}};
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM}) {
        TestView view(context, 4'000'000);
        SuppleGroupDesc desc{};
        desc.asset = context.asset(path);
        desc.capacity = 1;
        desc.scheme = scheme;
        desc.rate = 1;
        desc.flags = SUPPLE_GROUP_PATCHES;
        Crowd patches(context, desc); // for its coefficients
        desc.flags = 0;
        desc.view = view.handle();
        Crowd levels(context, desc);
        ASSERT_TRUE(patches.valid() && levels.valid());
        const SuppleInstance one = patches.spawn(), other = levels.spawn();
        const std::vector<surface::PatchInfo> infos = patchesOf(levels);
        for (const bool lengths : {true, false}) { // 8-pixel edges, or errors
            double worst = 0.0, least = 100.0, most = 0.0;
            size_t compared = 0, between = 0;
            for (uint32_t frame = 0; frame < 6; ++frame) {
                for (const auto& [crowd, instance] : {std::pair(&patches, one), std::pair(&levels, other)}) {
                    crowd->pose(instance, frame % crowd->clipCount(), 0.17 * frame, glm::mat4(1.0f));
                }
                view.camera.edgeLength = lengths ? 8.0f : 0.0f;
                view.camera.chordError = 0.1f;
                view.camera.smallestEdge = 2.0f;
                const float away = size * (0.2f + 0.3f * static_cast<float>(frame));
                view.look(0.5f * (low + high) + away * glm::normalize(glm::vec3(0.3f, 0.5f, 1.0f)));
                const SuppleGroup groups[] = {patches.group(), levels.group()};
                context.run(groups);
                budget::Measure measure;
                measure.camera = {view.camera.position[0], view.camera.position[1], view.camera.position[2]};
                measure.focal = static_cast<double>(view.camera.pixelsPerUnit);
                measure.chordError = lengths ? 0.0 : static_cast<double>(view.camera.chordError);
                measure.edgeLength = static_cast<double>(lengths ? 8.0f : view.camera.smallestEdge);
                const std::vector<std::byte> bytes = patches.read(patches.output().surface.patchCoefficients);
                const auto coefficient = [&](uint32_t patch, size_t k) {
                    glm::vec3 c;
                    std::memcpy(&c, bytes.data() + (size_t{patch} * SUPPLE_PATCH_STRIDE + k) * 16, sizeof(c));
                    return glm::dvec3(c);
                };
                const LodSurface surface = readLodSurface(levels);
                ASSERT_EQ(surface.patches.size(), infos.size());
                for (const LodSurface::Patch& patch : surface.patches) {
                    const auto kind = static_cast<SupplePatchClass>(infos[patch.patch].patchClass);
                    if (kind != SUPPLE_PATCH_REGULAR && kind != SUPPLE_PATCH_PERTURBED) {
                        continue; // their borders are their neighbors', too
                    }
                    for (size_t e = 0; e < 4; ++e) {
                        std::array<glm::dvec3, 4> cubic;
                        for (size_t k = 0; k < 4; ++k) {
                            cubic[k] = coefficient(patch.patch, kBorders[e][k]);
                        }
                        const double wanted = budget::scaledLevel(budget::edgeLevel(cubic, measure), 1.0, 0.0);
                        const double level = 2.0 * static_cast<double>(patch.levels[2 * (2 + e)]) + 1.0;
                        worst = std::max(worst, std::abs(level / wanted - 1.0));
                        least = std::min(least, wanted);
                        most = std::max(most, wanted);
                        between += wanted > 1.0 && wanted < 63.0 ? 1 : 0;
                        ++compared;
                    }
                }
                context.run(groups);
                ASSERT_EQ(view.statistics().levelScales[0], 1.0f);
            }
            std::printf("scheme %d, %s: %zu edges, %zu between 1 and 63, levels %.2f to %.2f, off by at most %.1e\n",
                        scheme, lengths ? "edges of 8 pixels" : "errors", compared, between, least, most, worst);
            EXPECT_GT(between, compared / 4);
            EXPECT_GT(most, 8.0);
            EXPECT_LT(worst, 1e-4); // the bend is a difference of floats
        }
    }
}

} // namespace
} // namespace supple::test
