// Parts that instances hide: what is drawn is what is drawn without hiding, less the hidden parts, to the bit.
#include "shaders/shared/surface.h"
#include "surface/schemes.h"
#include "tests/support/drawn_patches.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/logged_context.h"
#include "tests/support/meshes.h"
#include "tests/support/test_view.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <iterator>
#include <set>

namespace supple::test {
namespace {

constexpr uint32_t kHiddenParts = 40; ///< more than a word of a mask has bits
constexpr uint32_t kHiddenInstances = 3;

/// A cage in runs of faces of about equal length, one part each, sewn where they meet; two materials in turns.
cage::Character inParts(cage::Cage cage, uint32_t parts) {
    cage::Character c;
    c.name = "in parts";
    c.cage = std::move(cage);
    c.skeleton.nodes.resize(1 + parts);
    c.parts.clear();
    for (uint32_t p = 0; p < parts; ++p) {
        c.skeleton.nodes[1 + p].name = "part " + std::to_string(p);
        cage::Part& part = c.parts.emplace_back();
        part.name = c.skeleton.nodes[1 + p].name;
        part.node = 1 + p;
        part.firstFace = c.cage.faceCount() * p / parts;
        part.joints = {0};
    }
    for (uint32_t n = 0; n < c.skeleton.nodes.size(); ++n) {
        c.skeleton.parentsFirst.push_back(n);
    }
    c.skin.joints = {0};
    c.skin.inverseBinds = {glm::mat4(1.0f)};
    c.weights.starts = {0};
    for (uint32_t v = 0; v < c.cage.vertexCount(); ++v) {
        c.weights.influences.push_back({0, 1.0f});
        c.weights.starts.push_back(v + 1);
        c.cage.sourceVertices.push_back(v);
    }
    c.materials.resize(2);
    for (uint32_t f = 0; f < c.cage.faceCount(); ++f) {
        c.cage.faceMaterials.push_back(f / 3 % 2);
    }
    return c;
}

struct HiddenCase {
    const char* name;
    SuppleScheme scheme;
    bool quads; ///< the scheme takes nothing else
    bool viewed;
    uint32_t flags; ///< of the group
    uint32_t viewFlags;
};

constexpr uint32_t kMotion = SUPPLE_GROUP_MOTION, kViewMotion = SUPPLE_VIEW_MOTION;
constexpr HiddenCase kHiddenCases[] = {
    {"prep", SUPPLE_SCHEME_PREP, true, false, kMotion, 0},
    {"prepMesh", SUPPLE_SCHEME_PREP, true, false, kMotion | SUPPLE_GROUP_INDEXED_MESH, 0},
    {"prepLevels", SUPPLE_SCHEME_PREP, true, true, 0, kViewMotion | SUPPLE_VIEW_CULL},
    {"pm", SUPPLE_SCHEME_PM, false, false, kMotion, 0},
    {"pmMesh", SUPPLE_SCHEME_PM, false, false, SUPPLE_GROUP_INDEXED_MESH, 0},
    {"pmLevels", SUPPLE_SCHEME_PM, false, true, 0, kViewMotion},
    {"pmBackFaces", SUPPLE_SCHEME_PM, false, true, 0, SUPPLE_VIEW_BACK_FACES},
    {"pmOneLevel", SUPPLE_SCHEME_PM, false, true, SUPPLE_GROUP_ONE_LEVEL, SUPPLE_VIEW_BACK_FACES},
    {"blend", SUPPLE_SCHEME_BLEND, false, false, 0, 0},
    {"blendLevels", SUPPLE_SCHEME_BLEND, false, true, 0, kViewMotion},
    {"fragments", SUPPLE_SCHEME_FRAGMENTS, false, false, kMotion, 0},
    {"fragmentsRates", SUPPLE_SCHEME_FRAGMENTS, false, true, 0, kViewMotion | SUPPLE_VIEW_CULL},
    {"loop", SUPPLE_SCHEME_LOOP, false, false, kMotion, 0},
    {"loopLevels", SUPPLE_SCHEME_LOOP, false, true, 0, kViewMotion},
    {"catmullClark", SUPPLE_SCHEME_CATMULL_CLARK, false, false, kMotion, 0},
    {"catmullClarkMesh", SUPPLE_SCHEME_CATMULL_CLARK, false, false, kMotion | SUPPLE_GROUP_INDEXED_MESH, 0},
    {"catmullClarkLevels", SUPPLE_SCHEME_CATMULL_CLARK, false, true, 0, kViewMotion | SUPPLE_VIEW_BACK_FACES},
    {"polygons", SUPPLE_SCHEME_POLYGONS, false, false, kMotion, 0},
    {"polygonsRates", SUPPLE_SCHEME_POLYGONS, false, true, 0, kViewMotion},
};

class HiddenParts : public CrowdContexts, public testing::WithParamInterface<HiddenCase> {};
INSTANTIATE_TEST_SUITE_P(Kinds, HiddenParts, testing::ValuesIn(kHiddenCases),
                         [](const auto& param) { return std::string(param.param.name); });

/// Only patches at levels are counted.
std::vector<HiddenCase> levelCases() {
    std::vector<HiddenCase> cases;
    std::copy_if(std::begin(kHiddenCases), std::end(kHiddenCases), std::back_inserter(cases), [](const HiddenCase& c) {
        return c.viewed && surface::schemeOf(static_cast<surface::SchemeId>(c.scheme)).hasLevels;
    });
    return cases;
}
class HiddenPartsAtLevels : public HiddenParts {};
INSTANTIATE_TEST_SUITE_P(Kinds, HiddenPartsAtLevels, testing::ValuesIn(levelCases()),
                         [](const auto& param) { return std::string(param.param.name); });

class HiddenPartsOnce : public CrowdContexts {};

bool subdivides(SuppleScheme scheme) {
    return scheme == SUPPLE_SCHEME_FRAGMENTS;
}

using Hidden = std::array<std::set<uint32_t>, kHiddenInstances>;

/// A group, with its view if it has one, and its instances.
struct HiddenStage {
    HiddenStage(CrowdContext& context, const HiddenCase& c, SuppleAsset asset) {
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.capacity = kHiddenInstances;
        desc.scheme = c.scheme;
        desc.rate = c.viewed ? 8 : 4; // several rates
        desc.vertexFormat = SUPPLE_VERTEX_24;
        desc.flags = c.flags;
        if (c.viewed) {
            view = std::make_unique<TestView>(context, 400000, c.viewFlags);
            const glm::mat4 seen = glm::perspectiveRH_ZO(1.0f, 1.0f, 0.1f, 1000.0f) *
                                   glm::lookAt(glm::vec3(0.0f, -9.0f, 3.0f), glm::vec3(0.0f), glm::vec3(0, 0, 1));
            std::memcpy(view->camera.viewProjection, &seen, sizeof(seen));
            view->look({0.0f, -9.0f, 3.0f});
            desc.view = view->handle();
        }
        crowd = std::make_unique<Crowd>(context, desc);
        for (uint32_t i = 0; i < kHiddenInstances && crowd->valid(); ++i) {
            instances.push_back(crowd->spawn());
        }
    }
    /// The last one is far away, so that it has another rate.
    void place(uint32_t frame) const {
        for (uint32_t i = 0; i < instances.size(); ++i) {
            const float at = static_cast<float>(i), along = 0.1f * static_cast<float>(frame);
            const glm::vec3 where(2.0f * at - 2.0f + along, i == 2 ? 400.0f : at, 0.0f);
            crowd->pose(instances[i], SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), where));
        }
    }
    void hide(const Hidden& hidden) const {
        for (uint32_t i = 0; i < kHiddenInstances; ++i) {
            for (uint32_t p = 0; p < kHiddenParts; ++p) {
                EXPECT_EQ(suppleSetPartVisible(crowd->context().handle(), instances[i], p, hidden[i].count(p) ? 0 : 1),
                          SUPPLE_OK);
            }
        }
    }

    std::unique_ptr<TestView> view; ///< outlives the group
    std::unique_ptr<Crowd> crowd;
    std::vector<SuppleInstance> instances;
};

cage::Cage cageOf(const HiddenCase& c) {
    return c.quads ? biped() : withMergedFaces(withCutQuads(biped(), 0.3, 3), 4, 5);
}

TEST_P(HiddenParts, AreNotDrawnAndNothingElseChanges) {
    const ValidationGuard guard;
    const HiddenCase& c = GetParam();
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        const SuppleAsset asset = own.createAsset(inParts(cageOf(c), kHiddenParts));
        HiddenStage hiding(own, c, asset), whole(own, c, asset);
        ASSERT_TRUE(hiding.crowd->valid() && whole.crowd->valid());
        const std::vector<uint32_t> parts = partsOfKeys(*whole.crowd, asset);
        ASSERT_EQ(std::set<uint32_t>(parts.begin(), parts.end()).size(), kHiddenParts);

        const std::set<uint32_t> all = [] {
            std::set<uint32_t> every;
            for (uint32_t p = 0; p < kHiddenParts; ++p) {
                every.insert(p);
            }
            return every;
        }();
        const Hidden frames[] = {
            {}, {{{}, {1}, {}}}, {{{}, {1}, {}}}, {{{3, 35}, {35}, {0, 35, 39}}}, {{all, all, all}}, {{{}, {}, {7}}},
            {},
        };
        bool isVisible = true;
        for (uint32_t frame = 0; frame < std::size(frames); ++frame) {
            SCOPED_TRACE("frame " + std::to_string(frame));
            const Hidden& hidden = frames[frame];
            hiding.hide(hidden);
            if (isVisible == (frame == 3)) { // the parts of an instance that is not seen stay as they are
                isVisible = !isVisible;
                hiding.crowd->setVisible(hiding.instances[0], isVisible);
                whole.crowd->setVisible(whole.instances[0], isVisible);
            }
            hiding.place(frame);
            whole.place(frame);
            hiding.crowd->run();
            whole.crowd->run();
            const DrawnPatches expected = drawnPatches(*whole.crowd), drawn = drawnPatches(*hiding.crowd);
            ASSERT_FALSE(expected.empty());
            if (c.viewed && subdivides(c.scheme)) {
                EXPECT_NE(expected.begin()->first.rate, std::prev(expected.end())->first.rate) << "several rates";
            }
            size_t shown = 0, wrong = 0, tooMany = 0;
            for (const auto& [key, corners] : expected) {
                if (hidden[key.slot].count(parts[key.patch]) != 0) {
                    tooMany += drawn.count(key);
                    continue;
                }
                ++shown;
                const auto found = drawn.find(key);
                wrong += found == drawn.end() || found->second != corners ? 1 : 0;
            }
            EXPECT_EQ(tooMany, 0u) << "of hidden parts";
            EXPECT_EQ(wrong, 0u) << "of " << shown << " patches";
            EXPECT_EQ(drawn.size(), shown);
            if (std::all_of(hidden.begin(), hidden.end(), [](const auto& one) { return one.empty(); })) {
                const auto bytes = [](const Crowd& crowd) { return crowd.read(crowd.output().indirect()); };
                EXPECT_TRUE(c.viewed || bytes(*hiding.crowd) == bytes(*whole.crowd)) << "the same commands";
            }
        }
    }
}

TEST_P(HiddenPartsAtLevels, ViewsCountThem) {
    const HiddenCase& c = GetParam();
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        const SuppleAsset asset = own.createAsset(inParts(cageOf(c), kHiddenParts));
        const HiddenStage stage(own, c, asset);
        ASSERT_TRUE(stage.crowd->valid());
        const std::vector<uint32_t> parts = partsOfKeys(*stage.crowd, asset);
        const Hidden frames[] = {{{{2, 3}, {}, {38}}}, {{{2}, {5, 6}, {}}}, {}};
        stage.place(0);
        for (const Hidden& hidden : frames) {
            stage.hide(hidden);
            uint32_t count = 0;
            for (const std::set<uint32_t>& one : hidden) {
                count += static_cast<uint32_t>(
                    std::count_if(parts.begin(), parts.end(), [&](uint32_t part) { return one.count(part) != 0; }));
            }
            stage.crowd->run();
            const auto drawn = static_cast<uint32_t>(drawnPatches(*stage.crowd).size());
            own.beginFrame(); // the frame is complete
            const SuppleViewStatistics statistics = stage.view->statistics();
            EXPECT_EQ(statistics.hiddenPatchCount, count);
            EXPECT_EQ(statistics.patchCount, drawn);
            EXPECT_EQ(statistics.patchCount + statistics.hiddenPatchCount + statistics.backFaceCount,
                      kHiddenInstances * parts.size());
            const bool backFaces = (c.viewFlags & SUPPLE_VIEW_BACK_FACES) != 0 && c.scheme != SUPPLE_SCHEME_BLEND;
            EXPECT_EQ(statistics.backFaceCount > 0, backFaces);
        }
    }
}

/// Several groups of one view, and a budget: what is hidden takes no room.
TEST_F(HiddenPartsOnce, TakeNoRoomInTheBudget) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const HiddenCase c{"levels", SUPPLE_SCHEME_PM, false, true, 0, 0};
    const HiddenStage stage(own, c, own.createAsset(inParts(cageOf(c), kHiddenParts)));
    ASSERT_TRUE(stage.crowd->valid());
    stage.view->camera.chordError = 0.05f;
    stage.view->camera.vertexBudget = 30000;
    stage.view->look({0.0f, -9.0f, 3.0f});
    stage.place(0);
    const auto statistics = [&] {
        stage.crowd->run();
        own.beginFrame();
        return stage.view->statistics();
    };
    const SuppleViewStatistics whole = statistics();
    EXPECT_LT(whole.levelScales[0], 1.0f);
    std::set<uint32_t> most;
    for (uint32_t p = 2; p < kHiddenParts; ++p) {
        most.insert(p);
    }
    stage.hide({most, most, most});
    const SuppleViewStatistics less = statistics();
    EXPECT_EQ(less.levelScales[0], 1.0f) << "two parts of forty fit";
    EXPECT_LT(less.wantedVertexCount, whole.wantedVertexCount / 4);
}

TEST_F(HiddenPartsOnce, AreStateOfAnInstance) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const HiddenCase c{"grids", SUPPLE_SCHEME_PM, false, false, 0, 0};
    HiddenStage stage(own, c, own.createAsset(inParts(cageOf(c), kHiddenParts)));
    ASSERT_TRUE(stage.crowd->valid());
    const auto hide = [&](SuppleInstance instance, uint32_t part, uint32_t visible) {
        return suppleSetPartVisible(own.handle(), instance, part, visible);
    };
    const auto refused = [&](SuppleInstance instance, uint32_t part, uint32_t visible, int message) {
        EXPECT_EQ(hide(instance, part, visible), SUPPLE_ERROR_ARGUMENT);
        EXPECT_EQ(own.takeError(), message);
    };
    const auto count = [&] {
        stage.crowd->run();
        return drawnPatches(*stage.crowd).size();
    };
    stage.place(0);
    const size_t all = count();
    refused(stage.instances[0], kHiddenParts, 0, SUPPLE_MESSAGE_OUT_OF_RANGE);
    refused(stage.instances[0], ~0u, 0, SUPPLE_MESSAGE_OUT_OF_RANGE);
    refused(stage.instances[0], 0, 2, SUPPLE_MESSAGE_OUT_OF_RANGE);
    refused({stage.instances[0].group, 0, stage.instances[0].generation + 1}, 0, 0, SUPPLE_MESSAGE_STALE_HANDLE);
    EXPECT_EQ(count(), all) << "a refused call does nothing";

    EXPECT_EQ(hide(stage.instances[1], 4, 0), SUPPLE_OK);
    EXPECT_EQ(hide(stage.instances[1], 4, 0), SUPPLE_OK);
    const size_t less = count();
    EXPECT_LT(less, all);
    own.cancel(stage.crowd->group());
    EXPECT_EQ(count(), less) << "what a cancelled frame did not upload comes later";
    stage.crowd->setVisible(stage.instances[1], false);
    EXPECT_EQ(count(), all / 3 * 2);
    stage.crowd->setVisible(stage.instances[1], true);
    EXPECT_EQ(count(), less) << "it hides what it hid";
    stage.crowd->destroy(stage.instances[1]);
    const SuppleInstance gone = stage.instances[1];
    stage.instances[1] = stage.crowd->spawn();
    EXPECT_EQ(stage.instances[1].slot, gone.slot);
    EXPECT_EQ(count(), all) << "a new instance shows all parts";
    refused(gone, 0, 0, SUPPLE_MESSAGE_STALE_HANDLE);
}

/// An asset of one part; a group without a surface; another rate.
TEST_F(HiddenPartsOnce, OfOneAndOfNoSurface) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    SuppleGroupDesc desc{};
    desc.asset = own.createAsset(biped());
    desc.capacity = 2;
    desc.rate = 3;
    Crowd crowd(own, desc);
    desc.scheme = SUPPLE_SCHEME_CAGE;
    Crowd cages(own, desc);
    ASSERT_TRUE(crowd.valid() && cages.valid());
    const SuppleInstance one = crowd.spawn(), other = crowd.spawn(), cage = cages.spawn();
    for (const SuppleInstance instance : {one, cage}) {
        EXPECT_EQ(suppleSetPartVisible(own.handle(), instance, 0, 0), SUPPLE_OK);
        EXPECT_EQ(suppleSetPartVisible(own.handle(), instance, 1, 0), SUPPLE_ERROR_ARGUMENT);
    }
    own.run(cages.group());
    for (const uint32_t rate : {3u, 2u}) {
        crowd.setRate(rate);
        crowd.run();
        const DrawnPatches drawn = drawnPatches(crowd);
        EXPECT_EQ(drawn.size(), crowd.output().surface.patchCount);
        EXPECT_TRUE(
            std::all_of(drawn.begin(), drawn.end(), [&](const auto& patch) { return patch.first.slot == other.slot; }));
    }
}

TEST_F(HiddenPartsOnce, NeedFirstInstanceInIndirectCommands) {
    host::Device& device = *testDevice();
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    // What the device was created with, but for this feature.
    features.pNext = static_cast<const VkPhysicalDeviceFeatures2*>(device.enabledFeatures())->pNext;
    LoggedContext own(device, [&](SuppleContextDesc& desc) { desc.enabledFeatures = &features; });
    ASSERT_EQ(own.result(), SUPPLE_OK);
    SuppleAsset asset{};
    ASSERT_EQ(createTube(own.handle(), asset), SUPPLE_OK);
    const SmallGroup grids = createGroup(own.handle(), asset);
    ASSERT_EQ(grids.result, SUPPLE_OK);
    own.takeLines();
    EXPECT_EQ(suppleSetPartVisible(own.handle(), grids.instances[0], 0, 0), SUPPLE_ERROR_UNSUPPORTED);
    const std::vector<LogLine> lines = own.takeLines();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].message, SUPPLE_MESSAGE_FEATURE_DISABLED);
    EXPECT_NE(lines[0].text.find("drawIndirectFirstInstance"), std::string::npos) << lines[0].text;
    EXPECT_EQ(suppleSetPartVisible(own.handle(), grids.instances[0], 0, 1), SUPPLE_OK);

    SuppleViewDesc viewDesc{};
    viewDesc.structSize = sizeof(viewDesc);
    viewDesc.maxVertices = 100000;
    SuppleView view{};
    ASSERT_EQ(suppleCreateView(own.handle(), &viewDesc, &view), SUPPLE_OK);
    SuppleGroupDesc desc{};
    desc.view = view;
    const SmallGroup levels = createGroup(own.handle(), asset, desc);
    ASSERT_EQ(levels.result, SUPPLE_OK);
    EXPECT_EQ(suppleSetPartVisible(own.handle(), levels.instances[0], 0, 0), SUPPLE_OK) << "its draws need nothing";

    // Nor may a group draw these instances in grids while one hides a part.
    SuppleGroupDesc follows{};
    follows.structSize = sizeof follows;
    follows.asset = asset;
    follows.rate = 2;
    follows.instancesOf = levels.group;
    SuppleGroup follower{};
    EXPECT_EQ(suppleCreateGroup(own.handle(), &follows, &follower), SUPPLE_ERROR_UNSUPPORTED);
    EXPECT_EQ(suppleSetPartVisible(own.handle(), levels.instances[0], 0, 1), SUPPLE_OK);
    EXPECT_EQ(suppleCreateGroup(own.handle(), &follows, &follower), SUPPLE_OK);
    EXPECT_EQ(suppleSetPartVisible(own.handle(), levels.instances[0], 0, 0), SUPPLE_ERROR_UNSUPPORTED);
    EXPECT_EQ(suppleDestroyGroup(own.handle(), follower), SUPPLE_OK);
    EXPECT_EQ(suppleSetPartVisible(own.handle(), levels.instances[0], 0, 0), SUPPLE_OK);
}

} // namespace
} // namespace supple::test
