// Level of detail on every character: what two patches share is the same, bit for bit, however far apart their levels
// and capacities are. Cameras stand in and round the character, so that levels run from 1 to 63 over one surface.
#include "cage/gltf/reader.h"
#include "surface/schemes.h"
#include "tests/support/blend_surface.h"
#include "tests/support/exact_quads.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_random.h"
#include "tests/support/shared_assets.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <random>
#include <set>

namespace supple::test {
namespace {

struct LodCase {
    const char* name;
    SuppleScheme scheme;
    SuppleCreaseMode creases = SUPPLE_CREASES_CUT;

    /// The repository's own, and every `step`th of the others, another one in each mapping: each takes seconds. The
    /// blending surface, which takes longest, on the repository's own. lod_exact_test.cpp and lod_blend_test.cpp have
    /// more.
    [[nodiscard]] std::vector<std::string> characters(SuppleMapping mapping, size_t step) const {
        return scheme == SUPPLE_SCHEME_BLEND ? filesBelow(SUPPLE_SAMPLE_ASSETS, {".glb"})
                                             : sampledCharacters(step, mapping == SUPPLE_MAPPING_NARROW ? 0 : 1);
    }
    [[nodiscard]] surface::Recipe recipe() const {
        surface::Recipe recipe;
        recipe.scheme = static_cast<surface::SchemeId>(scheme);
        recipe.blend.creases =
            creases == SUPPLE_CREASES_CURVE ? surface::blend::CreaseMode::curve : surface::blend::CreaseMode::cut;
        return recipe;
    }
    /// Two schemes may subdivide their cage first: corners are then told by the refined cage.
    void nameCorners(const cage::Cage& cage, std::vector<surface::PatchInfo>& patches) const {
        if (scheme == SUPPLE_SCHEME_BLEND) {
            ::supple::test::nameCorners(blendMesh(cage, recipe().blend), patches);
        } else if (scheme == SUPPLE_SCHEME_CATMULL_CLARK) {
            ::supple::test::nameCorners(ExactQuads(cage), patches);
        }
    }
};
constexpr LodCase kLodCases[] = {{"p-rep", SUPPLE_SCHEME_PREP},
                                 {"P_m", SUPPLE_SCHEME_PM},
                                 {"Catmull-Clark", SUPPLE_SCHEME_CATMULL_CLARK},
                                 {"Loop", SUPPLE_SCHEME_LOOP},
                                 {"blend", SUPPLE_SCHEME_BLEND},
                                 {"blend, curves", SUPPLE_SCHEME_BLEND, SUPPLE_CREASES_CURVE}};

class LodCharacters : public CrowdContexts, public testing::WithParamInterface<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, LodCharacters, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

TEST_P(LodCharacters, neighboursAgreeBitForBit) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (const LodCase& c : kLodCases) {
        uint32_t characters = 0;
        Borders all;
        size_t triangles = 0, scaledFrames = 0;
        std::set<uint32_t> capacities;
        // Four cameras on the repository's own; on others the second, which has a budget, and one of the rest in turn.
        constexpr uint32_t kRest[] = {0, 2, 3};
        for (const std::string& path : c.characters(GetParam(), lessInWide(GetParam(), 3, 6))) {
            const std::string name = std::filesystem::path(path).filename().string();
            const Result<cage::Character> character = cage::readGltfFile(path);
            ASSERT_TRUE(character.ok());
            if (const auto tables = surface::buildTables(c.recipe(), character->cage); !tables.ok()) {
                std::printf("left out: %s: %s\n", name.c_str(), tables.error().message.c_str());
                continue;
            }
            SuppleViewDesc viewDesc{};
            viewDesc.structSize = sizeof(viewDesc);
            viewDesc.maxVertices = 2'000'000;
            viewDesc.vertexFormat = SUPPLE_VERTEX_24;
            SuppleView view{};
            ASSERT_EQ(suppleCreateView(context.handle(), &viewDesc, &view), SUPPLE_OK);
            {
                SuppleGroupDesc desc{};
                desc.asset = context.asset(path);
                desc.capacity = 1;
                desc.scheme = c.scheme;
                const SuppleBlendOptions blend{sizeof(blend), c.creases, 0.0f};
                desc.blend = &blend;
                desc.view = view;
                Crowd crowd(context, desc);
                ASSERT_TRUE(crowd.valid()) << name;
                const SuppleInstance instance = crowd.spawn();
                std::vector<surface::PatchInfo> patches = patchesOf(crowd);
                c.nameCorners(character->cage, patches);
                const auto count = static_cast<uint32_t>(patches.size());
                ++characters;
                glm::vec3 low(1e30f), high(-1e30f);
                for (const glm::vec3& p : character->cage.positions) {
                    low = glm::min(low, p);
                    high = glm::max(high, p);
                }
                const float size = glm::length(high - low);
                for (uint32_t frame = 0; frame < 4; ++frame) {
                    if (!isOwnCharacter(path) && frame != 1 && frame != kRest[characters % 3]) {
                        continue;
                    }
                    if (crowd.clipCount() > 0) {
                        crowd.pose(instance, frame % crowd.clipCount(), unit(random), glm::mat4(1.0f));
                    }
                    // Inside the box twice, then round it; one frame that its budget scales down.
                    const glm::vec3 inside = low + (high - low) * glm::vec3{unit(random), unit(random), unit(random)};
                    const glm::vec3 from = frame < 2 ? inside : inside + size * (frame == 2 ? 0.3f : 2.0f);
                    SuppleCameraDesc camera{};
                    camera.structSize = sizeof(camera);
                    camera.pixelsPerUnit = 869.0f;
                    camera.nearest = 0.01f * size;
                    camera.smallestEdge = frame == 1 ? 1.0f : 3.0f;
                    camera.edgeLength = frame == 3 ? 5.0f : 0.0f;
                    camera.vertexBudget = frame == 1 ? 20 * count : 0;
                    std::copy_n(&from.x, 3, camera.position);
                    ASSERT_EQ(suppleSetCamera(context.handle(), view, &camera), SUPPLE_OK);
                    context.run(crowd.group());
                    const LodSurface surface = readLodSurface(crowd);
                    SCOPED_TRACE(name + ", " + c.name + ", frame " + std::to_string(frame));
                    SuppleViewStatistics statistics{};
                    statistics.structSize = sizeof(statistics);
                    if (suppleGetViewStatistics(context.handle(), view, &statistics) == SUPPLE_OK) {
                        scaledFrames += statistics.levelScales[0] < 1.0f ? 1 : 0;
                        EXPECT_EQ(statistics.shortfall, 0u);
                    }
                    triangles += expectClosed(surface, patches, all).triangles;
                    for (const LodSurface::Patch& patch : surface.patches) {
                        capacities.insert(patch.capacity);
                    }
                }
            }
            EXPECT_EQ(suppleDestroyView(context.handle(), view), SUPPLE_OK);
        }
        std::printf("%s: %u characters, %zu shared edges, %zu samples, %zu triangles, %zu capacities, %zu frames "
                    "scaled down\n",
                    c.name, characters, all.edges, all.samples, triangles, capacities.size(), scaledFrames);
        EXPECT_GT(all.edges, 0u);
        // All of them with the shared characters.
        EXPECT_GE(capacities.size(), 6u);
        EXPECT_GT(scaledFrames, 0u);
    }
}

TEST(LodRandom, LevelsAndCapacitiesLeaveNoCracks) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE}) {
        RandomLevels random(mapping);
        ASSERT_TRUE(random.valid());
        Borders all;
        size_t triangles = 0, groups = 0;
        std::set<uint32_t> capacities;
        for (const LodCase& c : kLodCases) {
            for (const std::string& path : c.characters(mapping, 6)) {
                Result<cage::Character> character = cage::readGltfFile(path);
                ASSERT_TRUE(character.ok());
                const cage::Cage cage = character->cage;
                SuppleGroupDesc desc{};
                desc.scheme = c.scheme;
                const SuppleBlendOptions blend{sizeof(blend), c.creases, 0.0f};
                desc.blend = &blend;
                // Levels of the repository's own go up to 63. Of others, and in the wide mapping, it is the faces that
                // count: they have fewer vertices.
                const bool all63 = isOwnCharacter(path) && mapping == SUPPLE_MAPPING_NARROW;
                const uint32_t budget = all63 ? 0 : 1'000'000;
                std::optional<RandomLevels::Drawn> drawn = random.draw(std::move(*character), desc, budget);
                if (!drawn) {
                    continue; // the test above prints which cages a scheme refuses, and why
                }
                c.nameCorners(cage, drawn->patches);
                SCOPED_TRACE(path + ", " + c.name);
                triangles += expectClosed(drawn->surface, drawn->patches, all).triangles;
                ++groups;
                for (const LodSurface::Patch& patch : drawn->surface.patches) {
                    capacities.insert(patch.capacity);
                }
            }
        }
        std::printf("%s: %zu characters and schemes, %zu border samples, %zu triangles, %zu capacities\n",
                    mappingName(mapping).c_str(), groups, all.samples, triangles, capacities.size());
        EXPECT_GE(groups, 4u);
        EXPECT_GE(capacities.size(), 8u); // the coarsest are rare: all of a patch must be at level 1
    }
}

} // namespace
} // namespace supple::test
