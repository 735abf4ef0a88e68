// Pipelines of groups that are to come (suppleMakePipelines): creating the groups then makes none.
#include "tests/support/gpu_surface.h"
#include "tests/support/logged_context.h"
#include "tests/support/sample_assets.h"
#include "tests/support/soft_assets.h"
#include "tools/bench/pipeline_watch.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <thread>

namespace supple::test {
namespace {

struct PlannedCase {
    const char* name;
    SuppleGroupDesc desc;
    bool inView = false;
    uint32_t viewFlags = 0;
    const std::string* file = &kWren;
};
const std::string kDrivenArm = std::string(SUPPLE_TEST_DATA) + "/drivers/arm.glb";
constexpr uint32_t kStreams = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS | SUPPLE_GROUP_MOTION;
/// The last part of ten has another scheme than the others.
constexpr SuppleScheme kPartSchemes[10] = {
    SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_AUTO,
    SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_POLYGONS};
const PlannedCase kPlannedCases[] = {
    {"parts", {.scheme = SUPPLE_SCHEME_PM, .rate = 2, .partSchemes = kPartSchemes, .partSchemeCount = 10}},
    {"auto", {.flags = kStreams | SUPPLE_GROUP_BOUNDS, .rate = 4}},
    {"patches", {.flags = SUPPLE_GROUP_PATCHES, .scheme = SUPPLE_SCHEME_PM, .rate = 3}},
    {"mesh", {.flags = kStreams | SUPPLE_GROUP_INDEXED_MESH, .scheme = SUPPLE_SCHEME_PM, .rate = 3}},
    {"quads", {.scheme = SUPPLE_SCHEME_CATMULL_CLARK, .rate = 4, .vertexFormat = SUPPLE_VERTEX_24}},
    {"fragments", {.flags = SUPPLE_GROUP_MOTION, .scheme = SUPPLE_SCHEME_FRAGMENTS, .rate = 4}},
    {"blend", {.scheme = SUPPLE_SCHEME_BLEND, .rate = 4, .skinning = SUPPLE_SKINNING_DUAL_QUATERNION}},
    {"centers", {.rate = 3, .skinning = SUPPLE_SKINNING_CENTERS_OF_ROTATION}},
    {"mush", {.scheme = SUPPLE_SCHEME_CAGE, .skinning = SUPPLE_SKINNING_DELTA_MUSH}},
    {"polygons", {.flags = SUPPLE_GROUP_ATTRIBUTES, .scheme = SUPPLE_SCHEME_POLYGONS}},
    {"playing", {.scheme = SUPPLE_SCHEME_PM, .rate = 2, .poseSource = SUPPLE_POSES_PLAYBACK}},
    {"rated", {.flags = SUPPLE_GROUP_UPDATE_RATES, .scheme = SUPPLE_SCHEME_CAGE, .poseSource = SUPPLE_POSES_PLAYBACK}},
    {"drivers", {.scheme = SUPPLE_SCHEME_CAGE, .poseSource = SUPPLE_POSES_PLAYBACK}, false, 0, &kDrivenArm},
    {"soft",
     {.flags = SUPPLE_GROUP_SOFT, .scheme = SUPPLE_SCHEME_CAGE, .poseSource = SUPPLE_POSES_PLAYBACK},
     false,
     0,
     &kCapedFile},
    {"cages", {.scheme = SUPPLE_SCHEME_PM, .rate = 2, .poseSource = SUPPLE_POSES_CAGE_BUFFER}},
    {"cage", {.scheme = SUPPLE_SCHEME_CAGE}},
    {"levels",
     {.scheme = SUPPLE_SCHEME_PM, .vertexFormat = SUPPLE_VERTEX_24},
     true,
     SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL | SUPPLE_VIEW_OCCLUSION},
    {"backFaces", {.scheme = SUPPLE_SCHEME_CATMULL_CLARK}, true, SUPPLE_VIEW_BACK_FACES},
    {"oneLevel", {.flags = SUPPLE_GROUP_ONE_LEVEL, .scheme = SUPPLE_SCHEME_PM}, true},
    {"rates", {.scheme = SUPPLE_SCHEME_FRAGMENTS, .rate = 4}, true, SUPPLE_VIEW_MOTION},
    {"autoInView", {.rate = 4, .poseSource = SUPPLE_POSES_PLAYBACK}, true, SUPPLE_VIEW_ATTRIBUTES},
};

std::vector<std::byte> bytesOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> chars((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    std::vector<std::byte> copy(chars.size());
    std::memcpy(copy.data(), chars.data(), chars.size());
    return copy;
}

class PlannedPipelines : public testing::TestWithParam<PlannedCase> {
protected:
    void SetUp() override {
        ASSERT_NE(testDevice(), nullptr);
        desc = GetParam().desc;
        desc.structSize = sizeof(desc);
        desc.capacity = 2;
        planned = {&desc, GetParam().inView ? 1u : 0u, GetParam().viewFlags};
    }
    [[nodiscard]] SupplePrepared prepare(SuppleMapping mapping, bool withGroup) const {
        const std::vector<std::byte> bytes = bytesOf(*GetParam().file);
        SuppleAssetDesc asset{};
        asset.structSize = sizeof(asset);
        asset.name = "character";
        asset.bytes = bytes.data();
        asset.byteCount = bytes.size();
        SupplePrepareDesc all{};
        all.structSize = sizeof(all);
        all.mapping = mapping;
        all.asset = &asset;
        all.groups = &planned;
        all.groupCount = withGroup ? 1 : 0;
        SupplePrepared prepared = nullptr;
        EXPECT_EQ(supplePrepare(&all, &prepared), SUPPLE_OK);
        return prepared;
    }
    void createAll(SuppleContext context, SupplePrepared prepared, SuppleGroup& group) {
        SuppleAssetDesc assetDesc{};
        assetDesc.structSize = sizeof(assetDesc);
        assetDesc.prepared = prepared;
        ASSERT_EQ(suppleCreateAsset(context, &assetDesc, &desc.asset), SUPPLE_OK);
        if (GetParam().inView) {
            SuppleViewDesc view{};
            view.structSize = sizeof(view);
            view.flags = GetParam().viewFlags;
            view.maxVertices = 1u << 20;
            view.vertexFormat = GetParam().desc.vertexFormat;
            ASSERT_EQ(suppleCreateView(context, &view, &desc.view), SUPPLE_OK);
        }
        ASSERT_EQ(suppleCreateGroup(context, &desc, &group), SUPPLE_OK);
    }

    SuppleGroupDesc desc{};
    SupplePlannedGroup planned{};
};
INSTANTIATE_TEST_SUITE_P(Kinds, PlannedPipelines, testing::ValuesIn(kPlannedCases),
                         [](const auto& param) { return std::string(param.param.name); });

TEST_P(PlannedPipelines, AreAllThatTheGroupNeeds) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE}) {
        bench::PipelineWatch watch;
        LoggedContext context(*testDevice(), [&](SuppleContextDesc& contextDesc) {
            contextDesc.mapping = mapping;
            contextDesc.getInstanceProcAddr = bench::PipelineWatch::getInstanceProcAddr();
        });
        ASSERT_EQ(context.result(), SUPPLE_OK);
        const SupplePrepared prepared = prepare(mapping, true), bare = prepare(mapping, false);
        std::thread([&] { EXPECT_EQ(suppleMakePipelines(context.handle(), prepared, &planned, 1), SUPPLE_OK); }).join();
        const size_t made = watch.pipelines().size();
        const bool none = desc.scheme == SUPPLE_SCHEME_CAGE && desc.poseSource == SUPPLE_POSES_CAGE_BUFFER;
        EXPECT_EQ(made > 0, !none);
        const bool mixes = std::ranges::any_of(watch.pipelines(), [](const bench::WatchedPipeline& pipeline) {
            return pipeline.name.find("pose, between") != std::string::npos;
        });
        EXPECT_EQ(mixes, (desc.flags & SUPPLE_GROUP_UPDATE_RATES) != 0);
        // Nor does it, where tables were not prepared, make others.
        EXPECT_EQ(suppleMakePipelines(context.handle(), bare, &planned, 1), SUPPLE_OK);
        EXPECT_EQ(watch.pipelines().size(), made);
        SuppleGroup group{};
        createAll(context.handle(), prepared, group);
        std::string late;
        for (size_t i = made; i < watch.pipelines().size(); ++i) {
            late += watch.pipelines()[i].name + "; ";
        }
        EXPECT_EQ(watch.pipelines().size(), made) << late;
        if (!GetParam().inView && GetParam().name == std::string("quads")) {
            EXPECT_EQ(suppleSetRate(context.handle(), group, 2), SUPPLE_OK);
            EXPECT_EQ(watch.pipelines().size(), made);
        }
        suppleDestroyPrepared(prepared);
        suppleDestroyPrepared(bare);
    }
}

TEST(PlannedPipelinesErrors, SayWhichGroup) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    LoggedContext context(*testDevice());
    const SuppleAssetDesc tube = tubeDesc();
    SupplePrepareDesc prepareDesc{};
    prepareDesc.structSize = sizeof(prepareDesc);
    prepareDesc.asset = &tube;
    SupplePrepared prepared = nullptr;
    ASSERT_EQ(supplePrepare(&prepareDesc, &prepared), SUPPLE_OK);
    SuppleGroupDesc good{}, bad{};
    good.structSize = bad.structSize = sizeof(good);
    good.capacity = bad.capacity = 1;
    bad.scheme = SUPPLE_SCHEME_BLEND;
    bad.flags = SUPPLE_GROUP_PATCHES; // which it does not have
    const SupplePlannedGroup groups[] = {{&good, 0, 0}, {&bad, 0, 0}};
    EXPECT_EQ(suppleMakePipelines(context.handle(), prepared, groups, 2), SUPPLE_ERROR_ARGUMENT);
    const std::vector<LogLine> lines = context.takeLines();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].text.find("suppleMakePipelines: groups[1]: "), std::string::npos) << lines[0].text;
    EXPECT_EQ(suppleMakePipelines(context.handle(), prepared, groups, 1), SUPPLE_OK);
    suppleDestroyPrepared(prepared);
}

} // namespace
} // namespace supple::test
