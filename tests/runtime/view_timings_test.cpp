// What suppleGetTimings has of views: an entry a pass, however many passes there are, and whether the budget was
// enough.
#include "tests/support/depth_pyramid.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/shared_assets.h"
#include "tests/support/test_view.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

namespace supple::test {
namespace {

class ViewTimings : public CrowdContexts, public testing::WithParamInterface<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, ViewTimings, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

/// Of the frame before, which has been completed: begins the next one.
std::vector<SuppleTiming> timingsOf(CrowdContext& context) {
    context.beginFrame();
    uint32_t count = 0;
    EXPECT_EQ(suppleGetTimings(context.handle(), sizeof(SuppleTiming), nullptr, &count), SUPPLE_OK);
    std::vector<SuppleTiming> timings(count);
    EXPECT_EQ(suppleGetTimings(context.handle(), sizeof(SuppleTiming), timings.data(), &count), SUPPLE_OK);
    for (const SuppleTiming& timing : timings) {
        EXPECT_EQ(timing.frame, context.frame - 1);
    }
    return timings;
}

std::vector<std::string> passesOf(const std::vector<SuppleTiming>& timings, SuppleGroup group) {
    std::vector<std::string> passes;
    for (const SuppleTiming& timing : timings) {
        if (timing.group.id == group.id) {
            passes.emplace_back(suppleGetPassName(timing.pass));
        }
    }
    return passes;
}

TEST_P(ViewTimings, EveryPassOfEveryGroupIsDelivered) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 400'000,
                  SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL | SUPPLE_VIEW_OCCLUSION);
    const DepthPicture picture{64, 64, false, std::vector<float>(64 * 64, 1.0f)};
    const auto pyramid = DepthPyramid::create(context.device(), picture, 64, 64);
    ASSERT_NE(pyramid, nullptr);
    const glm::mat4 projection = glm::perspectiveRH_ZO(glm::radians(45.0f), 1.0f, 0.1f, 100.0f) *
                                 glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, -1.0f, -6.0f));
    std::array<float, 16> columns{};
    std::memcpy(columns.data(), &projection, sizeof(columns));
    const SuppleDepthPyramidDesc desc = pyramid->desc(columns);
    EXPECT_EQ(suppleSetDepthPyramid(context.handle(), view.handle(), &desc), SUPPLE_OK);
    view.camera.pixelsPerUnit = 60.0f; // coarse
    view.look({0.0f, 1.0f, 6.0f});

    SuppleGroupDesc groupDesc{};
    groupDesc.capacity = 2;
    groupDesc.view = view.handle();
    groupDesc.poseSource = SUPPLE_POSES_PLAYBACK;
    std::vector<std::unique_ptr<Crowd>> crowds;
    std::vector<SuppleGroup> groups;
    for (const auto& [file, scheme] :
         {std::pair("pip.glb", SUPPLE_SCHEME_PM), std::pair("pip_quads.glb", SUPPLE_SCHEME_PREP),
          std::pair("pip.glb", SUPPLE_SCHEME_PM), std::pair("pip_quads.glb", SUPPLE_SCHEME_PREP)}) {
        groupDesc.asset = context.asset(std::string(SUPPLE_SAMPLE_ASSETS) + "/" + file);
        groupDesc.scheme = scheme;
        crowds.push_back(std::make_unique<Crowd>(context, groupDesc));
        ASSERT_TRUE(crowds.back()->valid());
        (void)crowds.back()->spawn();
        groups.push_back(crowds.back()->group());
    }
    const std::vector<std::string> every = {"upload", "pose",  "pose",       "deform",   "bounds",
                                            "bounds", "list",  "vertex",     "assemble", "level",
                                            "level",  "place", "attributes", "evaluate", "motion"};
    for (const size_t count : {size_t{1}, groups.size()}) {
        const std::span<const SuppleGroup> some(groups.data(), count);
        for (int frame = 0; frame < 3; ++frame) {
            context.evaluate(some, SUPPLE_RECORD_TIMINGS);
            const std::vector<SuppleTiming> timings = timingsOf(context);
            double end = 0.0;
            for (const SuppleTiming& timing : timings) {
                EXPECT_GE(timing.gpuBegin, end) << suppleGetPassName(timing.pass);
                EXPECT_GE(timing.gpuEnd, timing.gpuBegin) << suppleGetPassName(timing.pass);
                end = timing.gpuEnd;
            }
            for (size_t g = 0; g < count; ++g) {
                std::vector<std::string> wanted = every;
                if (g == 0) {
                    wanted.insert(std::ranges::find(wanted, "place"), "solve");
                } else if (frame > 1) {
                    wanted.erase(wanted.begin()); // the first uploads what is the view's in every frame
                }
                EXPECT_EQ(passesOf(timings, groups[g]), wanted)
                    << count << " groups, group " << g << ", frame " << frame;
            }
        }
    }
}

TEST_P(ViewTimings, AShortfallShowsInEveryFrameThatHasOne) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView tight(context, 120'000), ample(context, 120'000);
    SuppleGroupDesc desc{};
    desc.asset = context.createAsset(cage::makeCubeSphere(3));
    desc.capacity = 64;
    desc.scheme = SUPPLE_SCHEME_PREP;
    desc.view = tight.handle();
    Crowd first(context, desc);
    desc.view = ample.handle();
    Crowd second(context, desc);
    ASSERT_TRUE(first.valid() && second.valid());
    for (Crowd* crowd : {&first, &second}) {
        for (int i = 0; i < 64; ++i) {
            const glm::vec3 place(3.0f * static_cast<float>(i % 8) - 10.5f, 0.0f, -3.0f * static_cast<float>(i / 8));
            crowd->pose(crowd->spawn(), SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), place));
        }
    }
    const SuppleGroup groups[] = {second.group(), first.group()};
    uint32_t needed = 0;
    const auto run = [&](uint32_t vertexBudget, uint32_t frames) {
        tight.camera.vertexBudget = vertexBudget;
        float distance = 25.0f;
        uint32_t shortfalls = 0;
        for (uint32_t frame = 0; frame < frames; ++frame) {
            distance *= 0.99f;
            tight.look({0.0f, 3.0f, distance});
            ample.look({0.0f, 3.0f, 25.0f});
            context.evaluate(groups, SUPPLE_RECORD_TIMINGS);
            const std::vector<SuppleTiming> timings = timingsOf(context);
            const SuppleViewStatistics statistics = tight.statistics();
            EXPECT_EQ(statistics.frame, context.frame - 1);
            EXPECT_EQ(ample.statistics().shortfall, 0u);
            needed = std::max(needed, statistics.vertexCount);
            uint32_t here = 0;
            for (size_t i = 0; i < timings.size(); ++i) {
                if (timings[i].pass != SUPPLE_PASS_SHORTFALL) {
                    continue;
                }
                ++here;
                EXPECT_EQ(timings[i].group.id, first.group().id);
                EXPECT_EQ(timings[i].points, statistics.droppedInstanceCount);
                EXPECT_EQ(timings[i].bytes, uint64_t{statistics.wantedVertexCount - statistics.vertexCount} * 24);
                EXPECT_EQ(timings[i].gpuBegin, timings[i].gpuEnd);
                EXPECT_GT(i, 0u);
                EXPECT_EQ(timings[i > 0 ? i - 1 : 0].pass, SUPPLE_PASS_SOLVE);
                EXPECT_EQ(timings[i > 0 ? i - 1 : 0].gpuEnd, timings[i].gpuBegin);
            }
            EXPECT_EQ(here, statistics.shortfall);
            shortfalls += here;
        }
        return shortfalls;
    };
    EXPECT_EQ(run(0, 4), 0u);
    EXPECT_EQ(run(needed * 6 / 10, 8), 0u) << "levels alone are scaled";
    EXPECT_EQ(run(needed / 10, 12), 12u);
    EXPECT_EQ(run(0, 4), 0u);
}

} // namespace
} // namespace supple::test
