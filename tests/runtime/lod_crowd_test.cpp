// Views of many instances: budgets that do not suffice, one level an instance, windows, split dispatches, and the
// device's budget against the CPU's.
#include "shaders/shared/lod.h"
#include "surface/lod/grid.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/limited_device.h"
#include "tests/support/lod_budget.h"
#include "tests/support/lod_surface.h"
#include "tests/support/meshes.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/test_view.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <random>
#include <set>

namespace supple::test {
namespace {

using surface::lod::Form;

class LodCrowds : public CrowdContexts, public testing::WithParamInterface<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, LodCrowds, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

cage::Cage bumpySphere(uint32_t faces) {
    return perturbed(cage::makeCubeSphere(faces), 0.05f, 3);
}

SuppleGroupDesc groupOf(SuppleAsset asset, uint32_t capacity, const TestView& view,
                        SuppleScheme scheme = SUPPLE_SCHEME_PREP) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = capacity;
    desc.scheme = scheme;
    desc.view = view.handle();
    return desc;
}

/// In rows of eight, three units from each other, away from the camera.
std::vector<SuppleInstance> spawnRows(Crowd& crowd, uint32_t count, uint32_t columns = 8) {
    std::vector<SuppleInstance> instances;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t row = i / columns;
        const glm::vec3 place(3.0f * static_cast<float>(i % columns) - 1.5f * static_cast<float>(columns - 1), 0.0f,
                              -3.0f * static_cast<float>(row));
        instances.push_back(crowd.spawn());
        crowd.pose(instances.back(), SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), place));
    }
    return instances;
}

TEST_P(LodCrowds, ATenthOfTheBudgetStaysValidAndStable) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 120000);
    Crowd crowd(context, groupOf(context.createAsset(bumpySphere(3)), 64, view));
    ASSERT_TRUE(crowd.valid());
    const std::vector<SuppleInstance> instances = spawnRows(crowd, 64);
    EXPECT_EQ(suppleSetPriority(context.handle(), instances.back(), 3), SUPPLE_OK); // the farthest is not to go
    const uint32_t patches = crowd.output().surface.patchCount;

    view.look({0.0f, 3.0f, 25.0f});
    context.run(crowd.group());
    context.run(crowd.group());
    const uint32_t needed = view.statistics().vertexCount;
    EXPECT_EQ(view.statistics().shortfall, 0u);
    view.camera.vertexBudget = needed / 10;

    // 152 frames from one place, 224 that come closer, 224 that pass by.
    const uint32_t stride = lessInWide(GetParam(), 1, 4);
    std::map<uint32_t, uint32_t> turns; // by slot: how often it came or went
    std::set<uint32_t> before;
    uint32_t fewest = ~0u, most = 0;
    float distance = 25.0f;
    for (uint32_t frame = 0; frame < 600; frame += stride) {
        if (frame == 152) {
            EXPECT_TRUE(turns.empty()) << "nothing moved";
        }
        distance *= frame < 152 || frame >= 376 ? 1.0f : std::pow(0.997f, static_cast<float>(stride));
        view.look({frame < 376 ? 0.0f : 0.05f * static_cast<float>(frame - 376), 3.0f, distance});
        context.run(crowd.group());
        const LodSurface surface = readLodSurface(crowd);
        std::map<uint32_t, uint32_t> drawn; // patches by slot
        for (const LodSurface::Patch& patch : surface.patches) {
            ++drawn[patch.slot];
        }
        std::set<uint32_t> slots;
        for (const auto& [slot, count] : drawn) {
            ASSERT_EQ(count, patches) << "slot " << slot << " in frame " << frame;
            slots.insert(slot);
        }
        ASSERT_TRUE(slots.contains(63)) << frame;
        if (frame > 0) {
            for (uint32_t slot = 0; slot < 64; ++slot) {
                turns[slot] += slots.contains(slot) != before.contains(slot) ? 1 : 0;
                if (turns[slot] == 0) {
                    turns.erase(slot);
                }
            }
            const SuppleViewStatistics last = view.statistics(); // of the frame before
            ASSERT_LE(last.vertexCount, needed / 10) << frame;
            ASSERT_EQ(last.shortfall, 1u) << frame;
            ASSERT_EQ(last.instanceCount, 64u);
            ASSERT_EQ(last.drawnInstanceCount, before.size());
            ASSERT_EQ(last.droppedInstanceCount, 64u - before.size());
            ASSERT_GE(last.wantedVertexCount, 64u * patches * 4u) << "missing ones count at their coarsest";
        }
        if (frame % 24 == 0) {
            ASSERT_EQ(matchSides(surface).unmatched, 0u) << frame;
        }
        before = slots;
        fewest = std::min(fewest, static_cast<uint32_t>(slots.size()));
        most = std::max(most, static_cast<uint32_t>(slots.size()));
    }
    uint32_t worst = 0;
    for (const auto& [slot, count] : turns) {
        worst = std::max(worst, count);
    }
    std::printf("%u vertices needed, %u allowed: %u to %u of 64 instances drawn, %zu came or went, one %u times\n",
                needed, needed / 10, fewest, most, turns.size(), worst);
    EXPECT_LE(worst, 4u);
}

// Ten that nothing scales at first come closer than their budget allows: they lose levels little by little, and what
// there is is used.
TEST_P(LodCrowds, TheUntouchableAreScaledLast) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    constexpr uint32_t kLimit = 12'000;
    TestView view(context, kLimit);
    Crowd crowd(context, groupOf(context.createAsset(bumpySphere(3)), 20, view));
    ASSERT_TRUE(crowd.valid());
    const std::vector<SuppleInstance> instances = spawnRows(crowd, 20, 10);
    for (size_t i = 0; i < 10; ++i) { // the row before
        EXPECT_EQ(suppleSetPriority(context.handle(), instances[i], 3), SUPPLE_OK);
    }
    float distance = 60.0f, last = 1.0f, fall = 1.0f;
    uint32_t scaled = 0, free = 0, least = ~0u, most = 0;
    for (uint32_t step = 0; distance > 12.0f; ++step, distance *= 0.99f) {
        view.camera.edgeLength = 8.0f;
        view.look({0.0f, 3.0f, distance});
        context.run(crowd.group());
        if (step == 0) {
            continue; // statistics are of the frame before
        }
        const SuppleViewStatistics now = view.statistics();
        ASSERT_LE(now.vertexCount, kLimit) << step;
        ASSERT_EQ(now.drawnInstanceCount, 20u) << step;
        ASSERT_LE(now.levelScales[3], last) << step;
        ASSERT_LE(now.levelScales[0], now.levelScales[3]) << step;
        ASSERT_EQ(now.shortfall, now.levelScales[3] < 1.0f ? 1u : 0u) << step;
        if (now.shortfall != 0) {
            fall = std::max(fall, last / now.levelScales[3]);
            least = std::min(least, now.vertexCount);
            most = std::max(most, now.vertexCount);
            ++scaled;
        } else {
            ++free;
        }
        if (step % 20 == 0) {
            ASSERT_EQ(matchSides(readLodSurface(crowd)).unmatched, 0u) << step;
        }
        last = now.levelScales[3];
    }
    std::printf("%u steps without, %u scaled down to %.3f, at most %.2f %% a step; %u to %u of %u vertices\n", free,
                scaled, static_cast<double>(last), 100.0 * (static_cast<double>(fall) - 1.0), least, most, kLimit);
    EXPECT_GT(free, 10u);
    EXPECT_GT(scaled, 20u);
    EXPECT_LT(last, 0.8f);
    EXPECT_LT(fall, 1.04f); // a bin is 1.1 %, and a step of the camera 1 %
    EXPECT_GT(least, kLimit * 8 / 10);
}

TEST_P(LodCrowds, OneLevelAnInstance) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    const struct {
        SuppleScheme scheme;
        const char* name;
        cage::Cage cage;
        float least = 0.84f, most = 1.25f; ///< of what the finest asks for
    } cases[] = {{SUPPLE_SCHEME_PREP, "p-rep", bumpySphere(4)},
                 {SUPPLE_SCHEME_PM, "P_m", cage::makeSplitTorus(8, 7)},
                 {SUPPLE_SCHEME_CATMULL_CLARK, "Catmull-Clark", cage::makeSplitTorus(8, 7), 0.7f},
                 {SUPPLE_SCHEME_CATMULL_CLARK, "Catmull-Clark, sphere", bumpySphere(4), 0.84f, 1.5f},
                 {SUPPLE_SCHEME_LOOP, "Loop", inTriangles(bumpySphere(4)), 0.84f, 1.4f},
                 {SUPPLE_SCHEME_BLEND, "blend, quads", bumpySphere(4)},
                 {SUPPLE_SCHEME_BLEND, "blend, triangles", inTriangles(bumpySphere(4)), 0.68f, 1.35f}}; // a step first
    for (const auto& [scheme, name, cage, least, most] : cases) {
        SCOPED_TRACE(name);
        TestView view(context, 400000);
        const SuppleAsset asset = context.createAsset(cage);
        Crowd perEdge(context, groupOf(asset, 8, view, scheme));
        SuppleGroupDesc desc = groupOf(asset, 8, view, scheme);
        desc.flags = SUPPLE_GROUP_ONE_LEVEL;
        Crowd whole(context, desc);
        ASSERT_TRUE(perEdge.valid() && whole.valid());
        (void)spawnRows(perEdge, 5, 1);
        (void)spawnRows(whole, 5, 1);
        double low = 10.0, high = 0.0;
        for (const float distance : {60.0f, 20.0f, 8.0f, 4.0f}) {
            view.look({0.3f * distance, 0.2f * distance, 0.93f * distance});
            const SuppleGroup groups[] = {perEdge.group(), whole.group()};
            context.run(groups);
            const auto levelOf = [](const LodSurface::Patch& patch, size_t pair) {
                return 2.0f * patch.levels[2 * pair] + 1.0f;
            };
            std::map<uint32_t, float> wanted, largest;
            const LodSurface edges = readLodSurface(perEdge), one = readLodSurface(whole);
            EXPECT_EQ(edges.patches.size(), one.patches.size());
            for (const LodSurface::Patch& patch : edges.patches) {
                for (size_t pair = 0; pair < 6; ++pair) {
                    wanted[patch.slot] = std::max(wanted[patch.slot], levelOf(patch, pair));
                }
            }
            for (const LodSurface::Patch& patch : one.patches) {
                const uint32_t sides = surface::lod::sides(static_cast<Form>(patch.grid));
                const size_t pairs = static_cast<Form>(patch.grid) == Form::quad ? 6 : 1 + sides;
                const float level = largest.try_emplace(patch.slot, levelOf(patch, 0)).first->second;
                for (size_t pair = 0; pair < pairs; ++pair) {
                    ASSERT_EQ(levelOf(patch, pair), level) << "slot " << patch.slot;
                }
            }
            EXPECT_EQ(matchSides(one).unmatched, 0u);
            for (const auto& [slot, level] : largest) {
                const auto ratio = static_cast<double>(level / wanted[slot]);
                low = std::min(low, ratio);
                high = std::max(high, ratio);
                EXPECT_GE(level, least * wanted[slot]);
                EXPECT_LE(level, most * wanted[slot]);
            }
        }
        std::printf("%s: one level %.2f to %.2f of what the finest edge or inside asks for\n", name, low, high);
    }
}

/// Positions by slot and patch, each patch's in the order of its samples.
using ByPatch = std::map<std::pair<uint32_t, uint32_t>, PositionBits>;
ByPatch byPatch(const LodSurface& surface) {
    ByPatch result;
    for (const LodSurface::Patch& patch : surface.patches) {
        const auto first = surface.positions.begin() + patch.firstVertex;
        const uint32_t samples = surface::lod::sampleCount(static_cast<Form>(patch.grid), patch.capacity);
        const bool fresh =
            result.try_emplace({patch.slot, patch.patch}, first, first + samples).second; // once and no more
        EXPECT_TRUE(fresh) << "slot " << patch.slot << ", patch " << patch.patch;
    }
    return result;
}

/// Patches that are not the same in both.
size_t differing(const ByPatch& a, const ByPatch& b) {
    size_t count = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
    for (const auto& [patch, positions] : a) {
        const auto found = b.find(patch);
        count += found == b.end() || found->second != positions ? 1 : 0;
    }
    return count;
}

/// What a view draws of a crowd, and how many commands it took.
struct Drawn {
    ByPatch patches;
    WrappedVulkan counts;
    float levelScale = 0.0f;
};
Drawn drawThrough(LimitedDevice& device, uint32_t instances, uint32_t capacity) {
    Drawn drawn;
    if (device.context() != nullptr) {
        CrowdContext& context = *device.context();
        TestView view(context, 300000, SUPPLE_VIEW_MOTION);
        Crowd crowd(context, groupOf(context.createAsset(bumpySphere(2)), capacity, view));
        EXPECT_TRUE(crowd.valid());
        // The visible ones all over the slots.
        const uint32_t step = capacity / instances;
        for (uint32_t slot = 0; slot < capacity; ++slot) {
            const SuppleInstance instance = crowd.spawn();
            const uint32_t i = slot / step, row = i / 24;
            crowd.setVisible(instance, slot % step == 0 && i < instances);
            crowd.pose(
                instance, SUPPLE_BIND_POSE, 0.0,
                glm::translate(glm::mat4(1.0f), 3.0f * glm::vec3(i % 24 - 11.5f, 0.0f, -static_cast<float>(row))));
        }
        for (int frame = 0; frame < 3; ++frame) { // until nothing is new
            view.camera.smallestEdge = 8.0f;
            view.look({0.0f, 5.0f, 16.0f});
            drawn.counts = device.count(crowd.group());
        }
        drawn.patches = byPatch(readLodSurface(crowd));
        context.run(crowd.group());
        drawn.levelScale = view.statistics().levelScales[0];
        EXPECT_EQ(drawn.patches.size(), size_t{instances} * crowd.output().surface.patchCount);
    }
    return drawn;
}

TEST_P(LodCrowds, CommandsDoNotCountInstances) {
    LimitedDevice device(GetParam(), [](WrappedVulkan&) {});
    const Drawn one = drawThrough(device, 1, 1000);
    for (const uint32_t instances : {10u, 100u, 1000u}) {
        const Drawn many = drawThrough(device, instances, 1000);
        EXPECT_EQ(many.counts.dispatches, one.counts.dispatches);
        EXPECT_EQ(many.counts.indirectDispatches, one.counts.indirectDispatches);
        EXPECT_EQ(many.counts.barriers, one.counts.barriers);
        EXPECT_EQ(many.counts.copies, one.counts.copies);
    }
    std::printf("%llu dispatches, %llu indirect ones, %llu barriers\n",
                static_cast<unsigned long long>(one.counts.dispatches),
                static_cast<unsigned long long>(one.counts.indirectDispatches),
                static_cast<unsigned long long>(one.counts.barriers));
    EXPECT_GT(one.counts.indirectDispatches, 3u);
}

TEST_P(LodCrowds, SplitDispatchesAndWindowsDrawTheSame) {
    const uint32_t instances = lessInWide(GetParam(), 700, 175), capacity = 5600;
    const auto drawnOn = [&](const std::function<void(WrappedVulkan&)>& limit) {
        LimitedDevice device(GetParam(), limit);
        return drawThrough(device, instances, capacity);
    };
    const Drawn whole = drawnOn([](WrappedVulkan&) {});
    const Drawn split = drawnOn([](WrappedVulkan& w) { w.maxComputeWorkGroupCountX = 3; });
    EXPECT_EQ(differing(split.patches, whole.patches), 0u);
    const Drawn windows = drawnOn([](WrappedVulkan& w) {
        w.maxStorageBufferRange = 16u << 20; // of 5,600 instances the pool has more
    });
    for (const Drawn* drawn : {&whole, &split, &windows}) {
        EXPECT_EQ(drawn->levelScale, 1.0f) << "room depends on how many windows there are";
    }
    EXPECT_GT(windows.counts.indirectDispatches, whole.counts.indirectDispatches) << "there is one window";
    EXPECT_EQ(differing(windows.patches, whole.patches), 0u);
}

/// The largest of a record's levels.
float levelOf(const LodSurface::Patch& patch) {
    const auto form = static_cast<Form>(patch.grid);
    const size_t pairs = form == Form::quad ? 6 : 1 + surface::lod::sides(form);
    float level = 0.0f;
    for (size_t pair = 0; pair < pairs; ++pair) {
        level = std::max(level, 2.0f * patch.levels[2 * pair] + 1.0f);
    }
    return level;
}

constexpr double kElasticities[] = {1.0, 0.5, 0.25, 0.0}; // the defaults

/// Histograms without patches.
std::vector<surface::lod::budget::Priority> nothingWanted() {
    std::vector<surface::lod::budget::Priority> wanted(SUPPLE_PRIORITY_COUNT);
    for (size_t p = 0; p < wanted.size(); ++p) {
        wanted[p].elasticity = kElasticities[p];
    }
    return wanted;
}

// A crowd all round a camera that turns on its place, five heroes among it, half of what is seen beyond the budget.
// What a patch asks for does not depend on where the camera looks: what a step must draw, and how far it is scaled
// down, follows on the CPU from the levels of a frame that sees everything and has no budget.
TEST_P(LodCrowds, ATurningCameraKeepsItsBudget) {
    namespace budget = surface::lod::budget;
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    constexpr uint32_t kSpheres = 150, kMixed = 30;
    const uint32_t steps = lessInWide(GetParam(), 360, 120);
    TestView view(context, 400'000, SUPPLE_VIEW_CULL);
    Crowd spheres(context, groupOf(context.createAsset(bumpySphere(3)), kSpheres, view));
    const cage::Cage faces = perturbed(withMergedFaces(withCutQuads(cage::makeCubeSphere(3), 0.4, 3), 12, 5), 0.03f, 5);
    Crowd mixed(context, groupOf(context.createAsset(faces), kMixed, view, SUPPLE_SCHEME_PM));
    ASSERT_TRUE(spheres.valid() && mixed.valid());
    const Crowd* const crowds[] = {&spheres, &mixed};
    const SuppleGroup groups[] = {spheres.group(), mixed.group()};
    std::mt19937 random(17);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<uint32_t> priorities[2]; // by group and slot
    uint32_t heroes = 0;
    for (const auto& [crowd, count, g] : {std::tuple(&spheres, kSpheres, 0), std::tuple(&mixed, kMixed, 1)}) {
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t own = g == 0 ? 3 : 2; // heroes of this group, the nearest
            const bool hero = i < own;
            const float angle = hero ? 1.2566f * static_cast<float>(heroes) : 6.2832f * unit(random);
            const float away = hero ? 5.0f : 9.0f + 26.0f * std::sqrt(unit(random));
            heroes += hero ? 1 : 0;
            const SuppleInstance instance = crowd->spawn(); // slots rise
            priorities[g].push_back(hero ? 1 : 0);
            EXPECT_EQ(suppleSetPriority(context.handle(), instance, priorities[g].back()), SUPPLE_OK);
            crowd->pose(instance, SUPPLE_BIND_POSE, 0.0,
                        glm::translate(glm::mat4(1.0f), away * glm::vec3(std::cos(angle), 0.0f, std::sin(angle))));
        }
    }
    ASSERT_EQ(heroes, 5u);
    const glm::vec3 eye(0.0f, 1.0f, 0.0f);
    view.look(eye); // everything is inside
    context.run(groups);
    context.run(groups);
    const SuppleViewStatistics all = view.statistics();
    ASSERT_EQ(all.levelScales[0], 1.0f);
    ASSERT_EQ(all.drawnInstanceCount, kSpheres + kMixed);

    // What every instance asks for, and its box.
    std::vector<std::vector<float>> levels[2]; // by group, slot and patch
    std::vector<std::array<glm::dvec3, 2>> boxes[2];
    uint32_t runs = 0;
    for (size_t g = 0; g < 2; ++g) {
        runs += crowds[g]->output().levels.drawCount / shared::kCapacityCount;
        levels[g].assign(priorities[g].size(), std::vector<float>(crowds[g]->output().surface.patchCount));
        for (const LodSurface::Patch& patch : readLodPatches(*crowds[g])) {
            levels[g][patch.slot][patch.patch] = levelOf(patch);
            ASSERT_TRUE(levelOf(patch) > 1.01f && levelOf(patch) < 62.9f) << "beyond what records tell";
        }
        const std::vector<std::byte> bytes = crowds[g]->read(crowds[g]->output().bounds);
        for (size_t slot = 0; slot < priorities[g].size(); ++slot) {
            glm::vec4 ends[2];
            std::memcpy(ends, bytes.data() + slot * sizeof(ends), sizeof(ends));
            boxes[g].push_back({glm::dvec3(ends[0]), glm::dvec3(ends[1])});
        }
    }
    const uint32_t padding = runs * 3 * 64,
                   limit = all.vertexCount / 8; // a quarter is seen; runtime/view.cpp has the padding
    view.camera.vertexBudget = limit;

    const glm::mat4 projection = glm::perspectiveRH_ZO(glm::radians(55.0f), 16.0f / 9.0f, 0.1f, 100.0f);
    using Seen = std::set<std::pair<size_t, uint32_t>>; // group and slot
    struct Step {
        Seen seen;
        uint64_t vertices = 0, wanted = 0;
        double x = 0.0;
    } before;
    float scale = 0.0f, least = 1.0f, most = 0.0f, change = 0.0f;
    uint32_t came = 0, went = 0, still = 0, over = 0, fullest = 0;
    double worst = 0.0;
    std::vector<bool> heroSeen(5);
    for (uint32_t step = 0; step <= steps; ++step) {
        const float angle = 6.2832f * static_cast<float>(step) / static_cast<float>(steps);
        const glm::vec3 ahead(std::cos(angle), 0.0f, std::sin(angle));
        const glm::mat4 both = projection * glm::lookAt(eye, eye + ahead, glm::vec3(0.0f, 1.0f, 0.0f));
        std::memcpy(view.camera.viewProjection, &both, sizeof(both));
        view.look(eye);
        context.run(groups);

        if (step > 0) { // of the step before
            const SuppleViewStatistics now = view.statistics();
            over += now.vertexCount > limit ? 1 : 0;
            fullest = std::max(fullest, now.vertexCount);
            ASSERT_EQ(now.instanceCount, kSpheres + kMixed);
            ASSERT_EQ(now.drawnInstanceCount, before.seen.size()) << step;
            ASSERT_EQ(now.droppedInstanceCount + now.occludedInstanceCount + now.shortfall, 0u) << step;
            uint32_t patches = 0;
            for (const auto& [g, slot] : before.seen) {
                patches += crowds[g]->output().surface.patchCount;
            }
            ASSERT_EQ(now.patchCount, patches) << step;
            ASSERT_GE(now.vertexCount, before.vertices) << step;
            ASSERT_LE(now.vertexCount, before.vertices + padding) << step;
            ASSERT_GE(now.wantedVertexCount, before.wanted) << step;
            ASSERT_LE(now.wantedVertexCount, before.wanted + before.wanted / 10) << step;
            const double x = -std::log2(static_cast<double>(now.levelScales[0])) * shared::kBinsPerOctave;
            ASSERT_NEAR(x, before.x, 0.01 + 1e-4 * before.x) << step;
            worst = std::max(worst, std::abs(x - before.x));
            ASSERT_NEAR(now.levelScales[1], std::sqrt(now.levelScales[0]), 1e-5f) << step;
            if (scale > 0.0f) {
                change = std::max(change, std::max(now.levelScales[0] / scale, scale / now.levelScales[0]) - 1.0f);
                // What only comes cannot raise levels, what only goes cannot lower them, and nothing changes nothing.
                if (came == 0) {
                    ASSERT_GE(now.levelScales[0], scale) << step;
                }
                if (went == 0) {
                    ASSERT_LE(now.levelScales[0], scale) << step;
                }
                still += came == 0 && went == 0 ? 1 : 0;
            }
            scale = now.levelScales[0];
            least = std::min(least, scale);
            most = std::max(most, scale);
        }

        Step here;
        std::vector<budget::Priority> wanted = nothingWanted();
        std::vector<LodSurface::Patch> drawn[2];
        for (size_t g = 0; g < 2; ++g) {
            std::map<uint32_t, uint32_t> counts;
            drawn[g] = readLodPatches(*crowds[g]);
            for (const LodSurface::Patch& patch : drawn[g]) {
                ++counts[patch.slot];
                wanted[priorities[g][patch.slot]].forms[static_cast<size_t>(patch.grid)].add(
                    static_cast<double>(levels[g][patch.slot][patch.patch]));
                here.vertices += surface::lod::sampleCount(static_cast<Form>(patch.grid), patch.capacity);
            }
            for (const auto& [slot, count] : counts) {
                ASSERT_EQ(count, crowds[g]->output().surface.patchCount) << step;
                here.seen.insert({g, slot});
            }
            // Drawn is whose box no plane of the frustum has wholly behind it.
            for (uint32_t slot = 0; slot < priorities[g].size(); ++slot) {
                const auto& [low, high] = boxes[g][slot];
                double nearest = 1e30;
                for (int k = 0; k < 6; ++k) {
                    const glm::dmat4 rows = glm::transpose(glm::dmat4(both));
                    const glm::dvec4 plane = k == 4       ? rows[2]
                                             : k == 5     ? rows[3] - rows[2]
                                             : k % 2 == 0 ? rows[3] + rows[k / 2]
                                                          : rows[3] - rows[k / 2];
                    const glm::dvec3 corner(plane.x > 0 ? high.x : low.x, plane.y > 0 ? high.y : low.y,
                                            plane.z > 0 ? high.z : low.z);
                    nearest = std::min(nearest, glm::dot(glm::dvec3(plane), corner) + plane.w);
                }
                if (std::abs(nearest) > 1e-4) {
                    ASSERT_EQ(here.seen.contains({g, slot}), nearest > 0.0) << "slot " << slot << ", step " << step;
                }
            }
        }
        const budget::Solution solution = budget::solve(wanted, limit - padding);
        ASSERT_TRUE(solution.fits);
        here.x = solution.x;
        here.wanted = budget::vertexCount(wanted, 0.0);
        // Levels are those, scaled by what the priority takes of it, and find room in their capacities.
        for (size_t g = 0; g < 2; ++g) {
            for (const LodSurface::Patch& patch : drawn[g]) {
                const uint32_t priority = priorities[g][patch.slot];
                const auto level = static_cast<double>(levels[g][patch.slot][patch.patch]);
                const double expected = budget::scaledLevel(level, kElasticities[priority], here.x);
                const auto own = static_cast<double>(levelOf(patch));
                ASSERT_LE(own, patch.capacity);
                ASSERT_NEAR(own / expected, 1.0, 1e-3) << "slot " << patch.slot << ", step " << step;
                if (priority == 1) {
                    heroSeen[patch.slot + (g == 1 ? 3 : 0)] = true;
                }
            }
        }
        came = went = 0;
        for (const auto& who : here.seen) {
            came += before.seen.contains(who) ? 0 : 1;
        }
        for (const auto& who : before.seen) {
            went += here.seen.contains(who) ? 0 : 1;
        }
        before = std::move(here);
    }
    EXPECT_EQ(over, 0u);
    EXPECT_LT(most, 0.95f) << "the budget does not bind";
    EXPECT_GT(still, 0u);
    EXPECT_EQ(std::count(heroSeen.begin(), heroSeen.end(), true), 5);
    std::printf(
        "%u of %u vertices at most, levels scaled by %.3f to %.3f, at most %.1f %% a step, in %u of %u steps nothing "
        "came or went; x within %.1e of the reference's\n",
        fullest, limit, static_cast<double>(most), static_cast<double>(least), 100.0 * static_cast<double>(change),
        still, steps, worst);
}

class LodCrowdsOnce : public CrowdContexts {};

/// A thousand instances of 54 patches come closer in 400 steps, under half a million vertices; the `heroes` nearest the
/// path have a quarter of the crowd's elasticity. In one mapping: the passes that decide are held to be alike above,
/// and lavapipe evaluates the narrow one sooner.
void comeCloser(CrowdContext& context, uint32_t heroes) {
    constexpr uint32_t kInstances = 1000, kLimit = 500'000, kSteps = 400;
    TestView view(context, kLimit);
    Crowd crowd(context, groupOf(context.createAsset(bumpySphere(3)), kInstances, view));
    ASSERT_TRUE(crowd.valid());
    std::mt19937 random(11);
    std::uniform_real_distribution<float> depth(32.0f, 230.0f), aside(-60.0f, 60.0f);
    for (uint32_t i = 0; i < kInstances; ++i) {
        const float z = -depth(random), x = aside(random); // one by one: compilers differ in the order of arguments
        glm::vec3 at(x, 0.0f, z);
        const SuppleInstance instance = crowd.spawn();
        if (i < heroes) {
            at = {8.0f * (static_cast<float>(i) - 2.0f), 0.0f, -45.0f};
            EXPECT_EQ(suppleSetPriority(context.handle(), instance, 2), SUPPLE_OK);
        }
        crowd.pose(instance, SUPPLE_BIND_POSE, 0.0, glm::scale(glm::translate(glm::mat4(1.0f), at), glm::vec3(3.5f)));
    }
    view.camera.edgeLength = 8.0f;
    uint32_t over = 0, least = ~0u, most = 0, leastWanted = ~0u, mostWanted = 0, rises = 0;
    float first = 0.0f, last = 2.0f, fall = 1.0f, rise = 1.0f;
    const uint32_t patches = crowd.output().surface.patchCount;
    // By patch: the level it turned round at, in which direction it goes, and how often it turned by over 2 %.
    struct Path {
        float extreme = 0.0f;
        int direction = 0;
        uint32_t turns = 0;
    };
    std::vector<Path> paths(size_t{kInstances} * patches);
    for (uint32_t step = 0; step <= kSteps; ++step) {
        view.look({0.0f, 0.0f, -0.072f * static_cast<float>(step)});
        context.run(crowd.group());
        for (const LodSurface::Patch& patch : readLodPatches(crowd)) {
            const float level = levelOf(patch);
            ASSERT_LE(level, static_cast<float>(patch.capacity)) << step;
            Path& path = paths[size_t{patch.slot} * patches + patch.patch];
            if (path.extreme == 0.0f || (path.direction >= 0 && level > path.extreme) ||
                (path.direction <= 0 && level < path.extreme)) {
                if (path.extreme > 0.0f && path.direction == 0) {
                    path.direction = level > path.extreme ? 1 : -1;
                }
                path.extreme = level;
            } else if (std::max(level / path.extreme, path.extreme / level) > 1.02f) {
                path = {level, level > path.extreme ? 1 : -1, path.turns + 1};
            }
        }
        if (step == 0) {
            continue; // statistics are of the frame before
        }
        const SuppleViewStatistics now = view.statistics();
        over += now.vertexCount > kLimit ? 1 : 0;
        ASSERT_EQ(now.shortfall, 0u) << step;
        ASSERT_EQ(now.drawnInstanceCount, kInstances);
        ASSERT_EQ(now.patchCount, kInstances * patches);
        ASSERT_NEAR(now.levelScales[2], std::pow(now.levelScales[0], 0.25f), 1e-5f);
        if (step > 1) {
            fall = std::max(fall, last / now.levelScales[0]);
            rise = std::max(rise, now.levelScales[0] / last);
            rises += now.levelScales[0] > last ? 1 : 0;
        } else {
            first = now.levelScales[0];
        }
        last = now.levelScales[0];
        least = std::min(least, now.vertexCount);
        most = std::max(most, now.vertexCount);
        leastWanted = std::min(leastWanted, now.wantedVertexCount);
        mostWanted = std::max(mostWanted, now.wantedVertexCount);
    }
    const auto turned = std::count_if(paths.begin(), paths.end(), [](const Path& path) { return path.turns > 1; });
    std::printf(
        "%u to %u vertices wanted, %u to %u of %u written; levels scaled by %.3f to %.3f, down by at most %.2f %% a "
        "step, up by %.2f %% in %u steps; levels of %.2f %% of the patches turn more than once by 2 %%\n",
        leastWanted, mostWanted, least, most, kLimit, static_cast<double>(first), static_cast<double>(last),
        100.0 * (static_cast<double>(fall) - 1.0), 100.0 * (static_cast<double>(rise) - 1.0), rises,
        100.0 * static_cast<double>(turned) / static_cast<double>(paths.size()));
    EXPECT_EQ(over, 0u);
    EXPECT_GT(leastWanted, kLimit) << "nothing to do";
    EXPECT_GT(least, kLimit * 9 / 10) << "the limit is not used";
    EXPECT_EQ(rises, 0u);
    EXPECT_LT(fall, 1.011f) << "by more than a bin a step";
    EXPECT_EQ(turned, 0);
}

TEST_F(LodCrowdsOnce, AThousandComeCloserWithinTheBudget) {
    const ValidationGuard guard;
    comeCloser(CrowdContexts::context(SUPPLE_MAPPING_NARROW), 0);
}

TEST_F(LodCrowdsOnce, AThousandAndFiveHeroesComeCloserWithinTheBudget) {
    const ValidationGuard guard;
    comeCloser(CrowdContexts::context(SUPPLE_MAPPING_NARROW), 5);
}

// The solver on the device against the one on the CPU, from the levels of a frame without a budget.
TEST_P(LodCrowds, TheBudgetIsTheReferences) {
    namespace budget = surface::lod::budget;
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 1100000);
    const SuppleAsset sphere = context.createAsset(bumpySphere(3)),
                      torus = context.createAsset(cage::makeSplitTorus(8, 7));
    Crowd quads(context, groupOf(sphere, 40, view)), mixed(context, groupOf(torus, 40, view, SUPPLE_SCHEME_PM));
    ASSERT_TRUE(quads.valid() && mixed.valid());
    const SuppleGroup groups[] = {quads.group(), mixed.group()};
    std::map<uint32_t, uint32_t> priorities[2];
    for (Crowd* const crowd : {&quads, &mixed}) {
        const std::vector<SuppleInstance> instances = spawnRows(*crowd, 40);
        for (uint32_t i = 0; i < 40; ++i) {
            priorities[crowd == &mixed ? 1 : 0][i] = i % 5 == 0 ? i % 4 : 0; // slots rise
            EXPECT_EQ(suppleSetPriority(context.handle(), instances[i], i % 5 == 0 ? i % 4 : 0), SUPPLE_OK);
        }
    }
    // Near enough that no level is below 1, where records do not tell them.
    view.camera.chordError = 0.05f;
    view.camera.smallestEdge = 1.0f;
    const auto run = [&](uint32_t vertexBudget) {
        view.camera.vertexBudget = vertexBudget;
        view.look({0.0f, 4.0f, 14.0f});
        context.run(groups);
        context.run(groups);
        return view.statistics();
    };
    const SuppleViewStatistics free = run(0);
    ASSERT_EQ(free.levelScales[0], 1.0f) << free.wantedVertexCount;
    std::vector<budget::Priority> wanted = nothingWanted();
    float least = 64.0f, most = 0.0f;
    uint32_t runs = 0;
    for (const Crowd* crowd : {&quads, &mixed}) {
        runs += crowd->output().levels.drawCount / shared::kCapacityCount;
        for (const LodSurface::Patch& patch : readLodSurface(*crowd).patches) {
            const float level = levelOf(patch);
            wanted[priorities[crowd == &mixed ? 1 : 0][patch.slot]].forms[static_cast<size_t>(patch.grid)].add(
                static_cast<double>(level));
            least = std::min(least, level);
            most = std::max(most, level);
        }
    }
    ASSERT_GT(least, 1.01f);
    ASSERT_LT(most, 62.9f);
    const uint32_t padding = runs * 3 * 64; // runtime/view.cpp
    double worst = 0.0;
    for (const uint32_t percent : {95u, 80u, 60u, 45u, 30u}) {
        const uint32_t limit = free.vertexCount / 100 * percent;
        const budget::Solution expected = budget::solve(wanted, limit - padding);
        ASSERT_TRUE(expected.fits) << percent;
        const SuppleViewStatistics now = run(limit);
        EXPECT_EQ(now.shortfall, 0u);
        const double x = -std::log2(static_cast<double>(now.levelScales[0])) * shared::kBinsPerOctave;
        EXPECT_NEAR(x, expected.x, 0.01 + 1e-4 * expected.x) << percent << " %";
        worst = std::max(worst, std::abs(x - expected.x));
        for (size_t p = 0; p < wanted.size(); ++p) {
            EXPECT_NEAR(now.levelScales[p], std::exp2(-kElasticities[p] * expected.x / shared::kBinsPerOctave), 1e-4);
        }
        const uint64_t vertices = budget::vertexCount(wanted, x);
        EXPECT_GE(now.vertexCount + 200, vertices);
        EXPECT_LE(now.vertexCount, vertices + padding);
    }
    std::printf("levels %.2f to %.2f, %u vertices: x within %.1e of the reference's\n", static_cast<double>(least),
                static_cast<double>(most), free.vertexCount, worst);
}

} // namespace
} // namespace supple::test
