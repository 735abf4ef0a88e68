// Groups of several surfaces: each part is drawn as in a group that has its scheme for all parts, to the bit.
#include "tests/support/depth_pyramid.h"
#include "tests/support/drawn_patches.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/side_by_side.h"
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

constexpr uint32_t kInstances = 3;

/// The scheme of each part. Two parts have the first one, with others between them.
constexpr SuppleScheme kPartSchemes[] = {
    SUPPLE_SCHEME_PM,       SUPPLE_SCHEME_LOOP,      SUPPLE_SCHEME_PREP,          SUPPLE_SCHEME_BLEND,
    SUPPLE_SCHEME_POLYGONS, SUPPLE_SCHEME_FRAGMENTS, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_PM};
constexpr uint32_t kPartCount = std::size(kPartSchemes), kSurfaceCount = kPartCount - 1;

/// All faces are quads, which every scheme takes.
cage::Character bipeds() {
    return sideBySide(biped(), "biped", kPartCount);
}

struct SurfacesCase {
    const char* name;
    bool viewed;
    uint32_t flags; ///< of the group
    uint32_t viewFlags;
};
constexpr SurfacesCase kSurfacesCases[] = {
    {"grids", false, SUPPLE_GROUP_MOTION, 0},
    {"view", true, 0, SUPPLE_VIEW_MOTION | SUPPLE_VIEW_CULL},
    {"backFaces", true, 0, SUPPLE_VIEW_BACK_FACES},
};

class Surfaces : public CrowdContexts, public testing::WithParamInterface<SurfacesCase> {};
INSTANTIATE_TEST_SUITE_P(Kinds, Surfaces, testing::ValuesIn(kSurfacesCases),
                         [](const auto& param) { return std::string(param.param.name); });
class SurfacesOnce : public CrowdContexts {};

/// A group, with its view if it has one, and its instances.
struct SurfacesStage {
    /// `desc` without asset, capacity and what follows from the case.
    SurfacesStage(CrowdContext& context, const SurfacesCase& c, SuppleAsset asset, SuppleGroupDesc desc,
                  uint32_t room = 2000000) {
        desc.asset = asset;
        desc.capacity = kInstances;
        desc.rate = c.viewed ? 8 : 4;
        desc.vertexFormat = SUPPLE_VERTEX_24;
        desc.flags |= c.flags;
        if (c.viewed) {
            view = std::make_unique<TestView>(context, room, c.viewFlags);
            const glm::mat4 seen =
                glm::perspectiveRH_ZO(1.0f, 1.0f, 0.1f, 2000.0f) *
                glm::lookAt(glm::vec3(18.0f, -60.0f, 3.0f), glm::vec3(18.0f, 0.0f, 0.0f), glm::vec3(0, 0, 1));
            std::memcpy(view->camera.viewProjection, &seen, sizeof(seen));
            view->look({18.0f, -60.0f, 3.0f});
            desc.view = view->handle();
        }
        crowd = std::make_unique<Crowd>(context, desc);
        for (uint32_t i = 0; i < kInstances && crowd->valid(); ++i) {
            instances.push_back(crowd->spawn());
        }
    }
    /// The last one is far away, so that it has another rate.
    void place(uint32_t frame) const {
        for (uint32_t i = 0; i < instances.size(); ++i) {
            const float at = static_cast<float>(i), along = 0.1f * static_cast<float>(frame);
            const glm::vec3 where(2.0f * at - 2.0f + along, i == 2 ? 1200.0f : at, 0.0f);
            crowd->pose(instances[i], SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), where));
        }
    }

    std::unique_ptr<TestView> view; ///< outlives the group
    std::unique_ptr<Crowd> crowd;
    std::vector<SuppleInstance> instances;
};

SuppleGroupDesc mixed() {
    SuppleGroupDesc desc{};
    desc.partSchemes = kPartSchemes;
    desc.partSchemeCount = kPartCount;
    return desc;
}

/// What is drawn of a part: by slot and by what the part has of patches, or ranges of a mesh, in their order.
using DrawnPart = std::map<std::pair<uint32_t, uint32_t>, DrawnCorners>;

DrawnPart drawnPart(const DrawnPatches& drawn, const std::vector<uint32_t>& parts, uint32_t part) {
    std::map<uint32_t, uint32_t> places;
    for (uint32_t patch = 0; patch < parts.size(); ++patch) {
        if (parts[patch] == part) {
            places.emplace(patch, static_cast<uint32_t>(places.size()));
        }
    }
    DrawnPart result;
    for (const auto& [key, corners] : drawn) {
        const auto found = places.find(key.patch);
        if (found != places.end()) {
            EXPECT_TRUE(result.emplace(std::pair(key.slot, found->second), corners).second) << "drawn at two rates";
        }
    }
    return result;
}

/// Ranges of meshes are listed once per rate.
std::vector<uint32_t> partsOfSurface(const Crowd& crowd, SuppleAsset asset, uint32_t surface) {
    std::vector<uint32_t> parts = partsOfKeys(crowd, asset, surface);
    const SuppleGridOutput& grid = crowd.output(surface).grid;
    if (grid.rateCount > 1 && parts.size() == grid.drawRangeCount) {
        parts.resize(grid.rates[0].drawRangeCount);
    }
    return parts;
}

TEST_P(Surfaces, DrawPartsAsGroupsOfOneSchemeDo) {
    const ValidationGuard guard;
    const SurfacesCase& c = GetParam();
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        const SuppleAsset asset = own.createAsset(bipeds());
        const SurfacesStage several(own, c, asset, mixed());
        ASSERT_TRUE(several.crowd->valid());
        ASSERT_EQ(several.crowd->output().info.surfaceCount, kSurfaceCount);
        DrawnPatches drawn[2][kSurfaceCount];
        for (uint32_t frame = 0; frame < 2; ++frame) {
            several.place(frame);
            several.crowd->run();
            for (uint32_t s = 0; s < kSurfaceCount; ++s) {
                drawn[frame][s] = drawnPatches(*several.crowd, s);
            }
        }
        for (uint32_t s = 0; s < kSurfaceCount; ++s) {
            SCOPED_TRACE("surface " + std::to_string(s));
            const SuppleSurfaceInfo surface = several.crowd->output(s).surface;
            EXPECT_EQ(surface.scheme, kPartSchemes[s]);
            const std::vector<uint32_t> expected =
                s == 0 ? std::vector<uint32_t>{0, kPartCount - 1} : std::vector<uint32_t>{s};
            EXPECT_TRUE(std::ranges::equal(std::span(surface.parts, surface.partCount), expected));
            SuppleGroupDesc desc{};
            desc.scheme = kPartSchemes[s];
            const SurfacesStage alone(own, c, asset, desc);
            ASSERT_TRUE(alone.crowd->valid());
            EXPECT_EQ(alone.crowd->output().info.surfaceCount, 1u);
            const std::vector<uint32_t> parts = partsOfSurface(*several.crowd, asset, s);
            const std::vector<uint32_t> aloneParts = partsOfSurface(*alone.crowd, asset, 0);
            for (uint32_t frame = 0; frame < 2; ++frame) {
                alone.place(frame);
                alone.crowd->run();
                const DrawnPatches all = drawnPatches(*alone.crowd);
                size_t count = 0;
                for (const uint32_t part : expected) {
                    const DrawnPart is = drawnPart(drawn[frame][s], parts, part);
                    const DrawnPart wanted = drawnPart(all, aloneParts, part);
                    EXPECT_FALSE(wanted.empty());
                    EXPECT_TRUE(is == wanted) << "part " << part << ", frame " << frame;
                    count += is.size();
                }
                EXPECT_EQ(drawn[frame][s].size(), count) << "nothing of other parts";
            }
        }
    }
}

/// Cages that the host writes are gathered as those that joints move.
TEST_F(SurfacesOnce, OfCagesThatTheHostWrites) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        const SuppleAsset asset = own.createAsset(bipeds());
        SuppleGroupDesc desc = mixed();
        const SurfacesStage posed(own, kSurfacesCases[0], asset, desc);
        desc.poseSource = SUPPLE_POSES_CAGE_BUFFER;
        const SurfacesStage written(own, kSurfacesCases[0], asset, desc);
        ASSERT_TRUE(posed.crowd->valid() && written.crowd->valid());
        posed.place(1);
        posed.crowd->run();
        const SuppleBufferRange from = posed.crowd->output().info.deformedCage;
        const SuppleBufferRange to = written.crowd->output().info.deformedCage;
        ASSERT_EQ(from.size, to.size);
        written.crowd->run([&](VkCommandBuffer commands) {
            const VkBufferCopy region{from.offset, to.offset, to.size};
            vkCmdCopyBuffer(commands, from.buffer, to.buffer, 1, &region);
        });
        for (uint32_t s = 0; s < kSurfaceCount; ++s) {
            const DrawnPatches expected = drawnPatches(*posed.crowd, s);
            EXPECT_FALSE(expected.empty());
            EXPECT_TRUE(drawnPatches(*written.crowd, s) == expected) << s;
        }
    }
}

TEST_P(Surfaces, HidePartsOfAny) {
    const ValidationGuard guard;
    const SurfacesCase& c = GetParam();
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const SuppleAsset asset = own.createAsset(bipeds());
    const SurfacesStage hiding(own, c, asset, mixed()), whole(own, c, asset, mixed());
    ASSERT_TRUE(hiding.crowd->valid() && whole.crowd->valid());
    const std::set<std::pair<uint32_t, uint32_t>> hidden = {{0, 1}, {0, 2}, {0, 4}, {1, 0}, {1, 3}, {1, 5}, {1, 6}};
    for (const auto& [instance, part] : hidden) {
        EXPECT_EQ(suppleSetPartVisible(own.handle(), hiding.instances[instance], part, 0), SUPPLE_OK);
    }
    hiding.place(0);
    whole.place(0);
    hiding.crowd->run();
    whole.crowd->run();
    uint32_t hiddenAtLevels = 0;
    for (uint32_t s = 0; s < kSurfaceCount; ++s) {
        const std::vector<uint32_t> parts = partsOfSurface(*whole.crowd, asset, s);
        const DrawnPatches drawn = drawnPatches(*hiding.crowd, s);
        DrawnPatches expected = drawnPatches(*whole.crowd, s);
        std::erase_if(expected, [&](const auto& patch) {
            return hidden.count({patch.first.slot, parts[patch.first.patch % parts.size()]}) != 0;
        });
        EXPECT_TRUE(drawn == expected) << "surface " << s;
        for (const auto& [instance, part] : hidden) {
            hiddenAtLevels += whole.crowd->output(s).hasLevels()
                                  ? static_cast<uint32_t>(std::count(parts.begin(), parts.end(), part))
                                  : 0;
        }
    }
    if (c.viewed) {
        own.beginFrame(); // the frame is complete
        EXPECT_EQ(hiding.view->statistics().hiddenPatchCount, hiddenAtLevels);
    }
}

/// Where there is no room, all surfaces of an instance are left out together.
TEST_F(SurfacesOnce, OfAnInstanceAreLeftOutTogether) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const SuppleAsset asset = own.createAsset(bipeds());
    const SurfacesStage stage(own, kSurfacesCases[1], asset, mixed());
    ASSERT_TRUE(stage.crowd->valid());
    stage.view->camera.vertexBudget = 8000;
    stage.view->look({18.0f, -60.0f, 3.0f});
    stage.place(0);
    stage.crowd->run();
    std::set<uint32_t> slots[kSurfaceCount];
    for (uint32_t s = 0; s < kSurfaceCount; ++s) {
        for (const auto& [key, corners] : drawnPatches(*stage.crowd, s)) {
            slots[s].insert(key.slot);
        }
        EXPECT_EQ(slots[s], slots[0]) << "surface " << s;
    }
    own.beginFrame();
    const SuppleViewStatistics statistics = stage.view->statistics();
    EXPECT_GT(statistics.droppedInstanceCount, 0u);
    EXPECT_EQ(slots[0].size() + statistics.droppedInstanceCount, kInstances);
    EXPECT_FALSE(slots[0].empty());
}

/// Some passes come more often than in any group of one surface: every one has its place among the timestamps.
TEST_F(SurfacesOnce, AreTimedPassByPass) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const DepthPicture picture{64, 64, false, std::vector<float>(64 * 64, 1.0f)};
    const auto pyramid = DepthPyramid::create(own.device(), picture, 64, 64);
    ASSERT_NE(pyramid, nullptr);
    constexpr SurfacesCase kAll{"all", true, 0,
                                SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL | SUPPLE_VIEW_OCCLUSION};
    SuppleGroupDesc desc = mixed();
    desc.poseSource = SUPPLE_POSES_PLAYBACK;
    cage::Character walking = bipeds();
    walking.clips.push_back(
        {"walk", 1.0, {{0, cage::ChannelPath::translation, cage::Interpolation::linear, {0, 1}, {0, 0, 0, 1, 0, 0}}}});
    const SurfacesStage stage(own, kAll, own.createAsset(walking), desc);
    ASSERT_TRUE(stage.crowd->valid());
    SupplePlaybackLayer layer{};
    layer.weight = 1.0f;
    SupplePlaybackDesc playback{};
    playback.structSize = sizeof(playback);
    playback.layers = &layer;
    playback.layerCount = 1;
    playback.rootMotion = SUPPLE_ROOT_MOTION_GROUND;
    ASSERT_EQ(suppleSetPlayback(own.handle(), stage.instances[0], &playback), SUPPLE_OK);
    std::array<float, 16> columns{};
    std::memcpy(columns.data(), stage.view->camera.viewProjection, sizeof(columns));
    const SuppleDepthPyramidDesc seen = pyramid->desc(columns);
    ASSERT_EQ(suppleSetDepthPyramid(own.handle(), stage.view->handle(), &seen), SUPPLE_OK);
    const SuppleGroup group = stage.crowd->group();
    own.evaluate({&group, 1}, SUPPLE_RECORD_TIMINGS);
    own.beginFrame();
    uint32_t count = 0;
    ASSERT_EQ(suppleGetTimings(own.handle(), sizeof(SuppleTiming), nullptr, &count), SUPPLE_OK);
    std::vector<SuppleTiming> timings(count);
    ASSERT_EQ(suppleGetTimings(own.handle(), sizeof(SuppleTiming), timings.data(), &count), SUPPLE_OK);
    // The surfaces of a pass follow each other, each with an entry of its own.
    std::vector<std::string> passes;
    std::map<std::string, std::vector<uint32_t>> surfacesOf;
    double end = 0.0;
    for (size_t i = 0; i < timings.size(); ++i) {
        const SuppleTiming& timing = timings[i];
        const char* const name = suppleGetPassName(timing.pass);
        const uint32_t before = i > 0 ? timings[i - 1].surface : SUPPLE_NO_SURFACE;
        const bool next = timing.surface != SUPPLE_NO_SURFACE && before != SUPPLE_NO_SURFACE &&
                          timing.surface > before && passes.back() == name;
        if (!next) {
            passes.emplace_back(name);
        }
        surfacesOf[name].push_back(timing.surface);
        EXPECT_GE(timing.gpuBegin, end) << name;
        EXPECT_GE(timing.gpuEnd, timing.gpuBegin) << name;
        end = timing.gpuEnd;
    }
    const std::vector<std::string> expected = {"upload",   "attributes", "pose",     "pose",  "pose",   "deform",
                                               "deform",   "bounds",     "bounds",   "list",  "vertex", "assemble",
                                               "level",    "level",      "solve",    "place", "place",  "place",
                                               "assemble", "attributes", "evaluate", "motion"};
    EXPECT_EQ(passes, expected);
    EXPECT_EQ(surfacesOf["evaluate"], (std::vector<uint32_t>{0, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(surfacesOf["deform"], (std::vector<uint32_t>{SUPPLE_NO_SURFACE, 0, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(surfacesOf["list"], std::vector<uint32_t>{SUPPLE_NO_SURFACE});
}

/// One of two parts that are sewn is named: it counts for both. Two are named: they must agree.
TEST_F(SurfacesOnce, SewnPartsHaveOneScheme) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    cage::Character sewn = bipeds();
    const uint32_t faces = sewn.cage.faceCount();
    for (cage::Part& part : sewn.parts) {
        part.joints.clear(); // all of them, as faces of other parts need them
    }
    sewn.parts[1].firstFace -= 4; // takes faces of the biped before
    for (uint32_t f = 0; f < faces; ++f) {
        if (f >= sewn.parts[1].firstFace && sewn.cage.faceParts[f] == 0) {
            sewn.cage.faceParts[f] = 1;
        }
    }
    const SuppleAsset asset = own.createAsset(sewn);
    const auto surfaces = [&](std::vector<SuppleScheme> schemes) {
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.capacity = 1;
        desc.partSchemes = schemes.data();
        desc.partSchemeCount = static_cast<uint32_t>(schemes.size());
        const Crowd crowd(own, desc);
        EXPECT_TRUE(crowd.valid());
        std::vector<std::vector<uint32_t>> parts;
        for (uint32_t s = 0; crowd.valid() && s < crowd.output().info.surfaceCount; ++s) {
            const SuppleSurfaceInfo surface = crowd.output(s).surface;
            parts.emplace_back(surface.parts, surface.parts + surface.partCount);
        }
        return parts;
    };
    using Parts = std::vector<std::vector<uint32_t>>;
    EXPECT_EQ(surfaces({}), (Parts{{0, 1, 2, 3, 4, 5, 6, 7}})) << "auto: all polygons are known";
    EXPECT_EQ(surfaces({SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_LOOP}), (Parts{{0, 1}, {2, 3, 4, 5, 6, 7}}));
    EXPECT_EQ(surfaces({SUPPLE_SCHEME_LOOP}), (Parts{{0, 1}, {2, 3, 4, 5, 6, 7}}));
    const SuppleScheme two[] = {SUPPLE_SCHEME_LOOP, SUPPLE_SCHEME_BLEND};
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.asset = asset;
    desc.capacity = 1;
    desc.partSchemes = two;
    desc.partSchemeCount = 2;
    SuppleGroup group{};
    EXPECT_EQ(suppleCreateGroup(own.handle(), &desc, &group), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_CONFLICT);
}

/// What AUTO takes; what it does without; which rates it has.
TEST_F(SurfacesOnce, OfAuto) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const SuppleScheme schemes[] = {SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_POLYGONS};
    const SuppleAsset asset = own.createAsset(bipeds());
    SupplePartInfo part{};
    part.structSize = sizeof(part);
    ASSERT_EQ(suppleGetPartInfo(own.handle(), asset, 1, &part), SUPPLE_OK);
    EXPECT_EQ(part.scheme, SUPPLE_SCHEME_CATMULL_CLARK);
    EXPECT_STREQ(part.schemeReason, "its polygons are known");

    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = 1;
    desc.rate = 4;
    desc.partSchemes = schemes;
    desc.partSchemeCount = 2;
    Crowd crowd(own, desc);
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance instance = crowd.spawn();
    crowd.pose(instance, SUPPLE_BIND_POSE, 0.0, glm::mat4(1.0f));
    crowd.setRate(2);
    crowd.run();
    EXPECT_EQ(crowd.output(0).grid.rate, 2u);
    EXPECT_EQ(crowd.output(1).grid.rate, 1u);
    EXPECT_EQ(suppleSetRate(own.handle(), crowd.group(), 5), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_OUT_OF_RANGE);
    EXPECT_EQ(crowd.output(0).grid.rate, 2u) << "as it was";

    desc.flags = SUPPLE_GROUP_PATCHES;
    SuppleGroup group{};
    desc.structSize = sizeof(desc);
    EXPECT_EQ(suppleCreateGroup(own.handle(), &desc, &group), SUPPLE_ERROR_ARGUMENT) << "polygons by name has none";
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_CONFLICT);
}

/// AUTO takes Loop for smooth triangles, with a semi-sharp crease too.
TEST_F(SurfacesOnce, OfAutoShareSamples) {
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    const cage::Cage smooth = withCutQuads(biped(), 1.0, 5);
    cage::Cage creased = smooth;
    creased.creases.push_back({creased.faceVertices[0], creased.faceVertices[1], 1.7f});
    for (const bool sharp : {false, true}) {
        const SuppleAsset asset = own.createAsset(sharp ? creased : smooth);
        SupplePartInfo part{};
        part.structSize = sizeof(part);
        ASSERT_EQ(suppleGetPartInfo(own.handle(), asset, 0, &part), SUPPLE_OK);
        EXPECT_EQ(part.scheme, SUPPLE_SCHEME_LOOP);
        SuppleGroupDesc desc{};
        desc.structSize = sizeof(desc);
        desc.asset = asset;
        desc.capacity = 1;
        desc.rate = 4;
        desc.flags = SUPPLE_GROUP_INDEXED_MESH;
        SuppleGroup group{};
        ASSERT_EQ(suppleCreateGroup(own.handle(), &desc, &group), SUPPLE_OK);
        SuppleSurfaceInfo info{};
        info.structSize = sizeof(info);
        ASSERT_EQ(suppleGetSurfaceInfo(own.handle(), group, 0, &info), SUPPLE_OK);
        EXPECT_EQ(info.tessellation, SUPPLE_TESSELLATION_INDEXED_MESH);
        EXPECT_EQ(suppleDestroyGroup(own.handle(), group), SUPPLE_OK);
        desc.scheme = SUPPLE_SCHEME_LOOP;
        EXPECT_EQ(suppleCreateGroup(own.handle(), &desc, &group), SUPPLE_OK);
    }
}

} // namespace
} // namespace supple::test
