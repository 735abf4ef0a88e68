// What views and their groups refuse, and that the groups of a view lie where hosts can bind them.
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_surface.h"
#include "tests/support/meshes.h"
#include "tests/support/side_by_side.h"
#include "tests/support/test_view.h"
#include "tools/common/procedural.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <numeric>

namespace supple::test {
namespace {

class ViewLimits : public CrowdContexts, public testing::WithParamInterface<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, ViewLimits, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

/// The text of the only line since the last call, which is an error of this kind.
std::string errorText(CrowdContext& context, SuppleMessage message) {
    const std::vector<LogLine> lines = context.takeLines();
    EXPECT_EQ(lines.size(), 1u);
    EXPECT_TRUE(!lines.empty() && lines[0].message == message);
    return lines.empty() ? "" : lines[0].text;
}

/// Of p-rep: two classes, a run each.
SuppleGroupDesc groupWithTwoRuns(CrowdContext& context, const TestView& view, uint32_t segments) {
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.asset = context.createAsset(cage::makeCubeSphere(segments));
    desc.capacity = 1;
    desc.scheme = SUPPLE_SCHEME_PREP;
    desc.view = view.handle();
    return desc;
}

/// Corners of triangles by the bits of their positions, in an order of their own.
std::vector<std::array<std::array<uint32_t, 3>, 3>> sortedTriangles(const LodSurface& surface) {
    std::vector<std::array<std::array<uint32_t, 3>, 3>> corners;
    for (const auto& [a, b, c] : surface.triangles) {
        corners.push_back({surface.positions[a], surface.positions[b], surface.positions[c]});
    }
    std::sort(corners.begin(), corners.end());
    return corners;
}

TEST_P(ViewLimits, PaddingLeavesSomethingOrTheGroupIsRefused) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 1500);
    SuppleGroupDesc desc = groupWithTwoRuns(context, view, 2);
    context.takeLines();
    Crowd first(context, desc);
    ASSERT_TRUE(first.valid());
    const uint32_t runs = first.output().levels.drawCount / 10;
    const uint32_t more = 1499 / 192 / runs - 1; // groups that there is room for besides
    ASSERT_GE(more, 1u);
    std::vector<std::unique_ptr<Crowd>> others;
    for (uint32_t i = 0; i < more; ++i) {
        others.push_back(std::make_unique<Crowd>(context, desc));
        ASSERT_TRUE(others.back()->valid());
    }
    context.takeLines();
    SuppleGroup refused{};
    EXPECT_EQ(suppleCreateGroup(context.handle(), &desc, &refused), SUPPLE_ERROR_LIMIT);
    EXPECT_EQ(refused.id, 0u);
    const std::string text = errorText(context, SUPPLE_MESSAGE_LIMIT);
    EXPECT_NE(text.find(std::to_string(192 * runs * (more + 2))), std::string::npos) << text;
    EXPECT_NE(text.find("maxVertices is 1500"), std::string::npos) << text;
    // Those that are left still draw, and when one goes there is room again.
    others.pop_back();
    context.takeLines();
    view.look({0.0f, 0.0f, 100.0f});
    context.run(first.group()); // frees it
    context.run(first.group());
    Crowd again(context, desc);
    EXPECT_TRUE(again.valid());
    (void)first.spawn();
    context.run(first.group());
    EXPECT_EQ(readLodSurface(first).patches.size(), first.output().surface.patchCount);
}

TEST_P(ViewLimits, RunsOfAGroupLieSideBySide) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 100'000, 0, 200), other(context, 100'000); // 200: as 256, whole steps
    SuppleGroupDesc desc = groupWithTwoRuns(context, view, 4);
    SuppleGroupDesc wider = desc; // regular, triangles, other quads
    wider.asset = context.createAsset(withCutQuads(cage::makeCubeSphere(8), 0.05, 1));
    wider.scheme = SUPPLE_SCHEME_PM;
    wider.view = other.handle();
    const uint32_t widerRuns = Crowd(context, wider).output().levels.drawCount / 10;
    ASSERT_GE(widerRuns, 3u);
    ASSERT_LE(widerRuns, 4u);
    wider.view = view.handle();
    const auto refusal = [&](const SuppleGroupDesc& wanted) {
        context.takeLines();
        SuppleGroup refused{};
        EXPECT_EQ(suppleCreateGroup(context.handle(), &wanted, &refused), SUPPLE_ERROR_LIMIT);
        return errorText(context, SUPPLE_MESSAGE_LIMIT);
    };

    std::vector<std::unique_ptr<Crowd>> groups;
    for (uint32_t i = 0; i < 128; ++i) {
        groups.push_back(std::make_unique<Crowd>(context, desc));
        ASSERT_TRUE(groups.back()->valid()) << i;
    }
    const std::string full = refusal(desc);
    EXPECT_NE(full.find("the group has 2 runs"), std::string::npos) << full;
    EXPECT_NE(full.find("0 of the view's 256 are free"), std::string::npos) << full;
    groups[0]->end();
    groups[2]->end();
    view.look({0.0f, 0.0f, 100.0f});
    context.run(groups[1]->group()); // frees them
    context.run(groups[1]->group());
    const std::string apart = refusal(wider);
    EXPECT_NE(apart.find("the group has " + std::to_string(widerRuns) + " runs"), std::string::npos) << apart;
    EXPECT_NE(apart.find("4 of the view's 256 are free, but not side by side"), std::string::npos) << apart;
    EXPECT_TRUE(Crowd(context, desc).valid());
}

TEST_P(ViewLimits, MoreVerticesThanTheHistogramCountsAreRefused) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    context.takeLines();
    SuppleViewDesc desc{};
    desc.structSize = sizeof(desc);
    desc.maxVertices = SUPPLE_MAX_VIEW_VERTICES + 1;
    SuppleView view{};
    EXPECT_EQ(suppleCreateView(context.handle(), &desc, &view), SUPPLE_ERROR_LIMIT);
    EXPECT_NE(errorText(context, SUPPLE_MESSAGE_LIMIT).find("50331648"), std::string::npos);
}

TEST_P(ViewLimits, WithoutAFaceThereIsNoGroup) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 100'000);
    view.look({0.0f, 0.0f, 5.0f});
    cage::Cage quads = cage::makeCubeSphere(2), triangles = gyroBipyramid(5);
    for (cage::Cage* cage : {&quads, &triangles}) {
        cage->holes.resize(cage->faceCount());
        std::iota(cage->holes.begin(), cage->holes.end(), 0u);
    }
    const SuppleAsset assets[] = {context.createAsset(quads), context.createAsset(triangles)};
    context.takeLines();
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_FRAGMENTS,
                                      SUPPLE_SCHEME_LOOP, SUPPLE_SCHEME_BLEND, SUPPLE_SCHEME_CATMULL_CLARK}) {
        for (const bool ofView : {false, true}) {
            SuppleGroupDesc desc{};
            desc.structSize = sizeof(desc);
            desc.asset = assets[scheme == SUPPLE_SCHEME_LOOP ? 1 : 0];
            desc.capacity = 2;
            desc.scheme = scheme;
            desc.view = ofView ? view.handle() : SuppleView{};
            SuppleGroup group{};
            EXPECT_EQ(suppleCreateGroup(context.handle(), &desc, &group), SUPPLE_ERROR_ASSET) << scheme;
            const std::string text = errorText(context, SUPPLE_MESSAGE_ASSET_REFUSED);
            EXPECT_NE(text.find("every face is a hole"), std::string::npos) << text;
        }
    }
    // The cage alone there is.
    SuppleGroupDesc desc{};
    desc.asset = assets[0];
    desc.capacity = 1;
    desc.scheme = SUPPLE_SCHEME_CAGE;
    Crowd cage(context, desc);
    ASSERT_TRUE(cage.valid());
    (void)cage.spawn();
    context.run(cage.group());
}

// Sixty characters and more in one view: each comes out as it does alone.
TEST_P(ViewLimits, AViewHasRoomForManyGroups) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 400'000), alone(context, 100'000);
    SuppleGroupDesc desc = groupWithTwoRuns(context, view, 2);
    const auto place = [](Crowd& crowd, float x) {
        crowd.pose(crowd.spawn(), SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), glm::vec3(x, 0.0f, 0.0f)));
    };
    std::vector<std::unique_ptr<Crowd>> crowds;
    std::vector<SuppleGroup> groups;
    for (uint32_t i = 0; i < 170; ++i) { // 340 runs
        crowds.push_back(std::make_unique<Crowd>(context, desc));
        ASSERT_TRUE(crowds.back()->valid());
        groups.push_back(crowds.back()->group());
        place(*crowds.back(), i == 169 ? 0.5f : 0.25f * static_cast<float>(i) - 20.0f);
    }
    desc.view = alone.handle();
    Crowd single(context, desc);
    ASSERT_TRUE(single.valid());
    place(single, 0.5f);
    groups.push_back(single.group());
    view.look({0.0f, 0.0f, 12.0f});
    alone.look({0.0f, 0.0f, 12.0f});
    context.run(groups);
    size_t patches = 0;
    for (const auto& crowd : crowds) {
        const size_t own = readLodPatches(*crowd).size();
        EXPECT_EQ(own, crowd->output().surface.patchCount);
        patches += own;
    }
    const LodSurface last = readLodSurface(*crowds.back()), wanted = readLodSurface(single);
    EXPECT_EQ(sortedTriangles(last), sortedTriangles(wanted));
    EXPECT_EQ(matchSides(last).unmatched, 0u);
    context.run(groups);
    EXPECT_EQ(view.statistics().patchCount, patches);
}

// So many runs that workgroups do not take their places together (shaders/lod/place.comp).
TEST_P(ViewLimits, AGroupMayHaveManyMaterials) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 400'000);
    constexpr uint32_t kMaterials = 96;
    cage::Character character = sideBySide(cage::makeCubeSphere(8), "patchwork", 1);
    character.materials.resize(kMaterials);
    cage::Cage& sphere = character.cage;
    sphere.faceMaterials.clear();
    for (uint32_t f = 0; f < sphere.faceCount(); ++f) {
        sphere.faceMaterials.push_back(f * kMaterials / sphere.faceCount());
    }
    SuppleGroupDesc desc = groupWithTwoRuns(context, view, 2);
    desc.asset = context.createAsset(character);
    desc.capacity = 3;
    Crowd crowd(context, desc);
    ASSERT_TRUE(crowd.valid());
    ASSERT_GT(crowd.output().levels.drawCount, 10 * kMaterials);
    for (const float x : {-3.0f, 0.0f, 3.0f}) {
        crowd.pose(crowd.spawn(), SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), glm::vec3(x, 0.0f, 0.0f)));
    }
    view.look({0.0f, 0.0f, 12.0f});
    context.run(crowd.group());
    const LodSurface surface = readLodSurface(crowd);
    EXPECT_EQ(surface.patches.size(), 3 * crowd.output().surface.patchCount);
    EXPECT_EQ(matchSides(surface).unmatched, 0u);
}

// Any number of runs may stand before a group's.
TEST_P(ViewLimits, HostsMayBindWhatIsHandedOut) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 300'000);
    SuppleGroupDesc desc{};
    desc.capacity = 2;
    desc.view = view.handle();
    std::vector<std::unique_ptr<Crowd>> crowds;
    std::vector<SuppleGroup> groups;
    const SuppleAsset sphere = context.createAsset(cage::makeCubeSphere(2)),
                      torus = context.createAsset(cage::makeSplitTorus(8, 7));
    const auto add = [&](SuppleAsset asset, SuppleScheme scheme) {
        desc.asset = asset;
        desc.scheme = scheme;
        crowds.push_back(std::make_unique<Crowd>(context, desc));
        ASSERT_TRUE(crowds.back()->valid());
        const auto place = static_cast<float>(crowds.size());
        crowds.back()->pose(crowds.back()->spawn(), SUPPLE_BIND_POSE, 0.0,
                            glm::translate(glm::mat4(1.0f), glm::vec3(3.0f * place - 9.0f, 0.0f, -2.0f * place)));
    };
    add(sphere, SUPPLE_SCHEME_PREP);
    add(torus, SUPPLE_SCHEME_PM);
    add(sphere, SUPPLE_SCHEME_BLEND);
    add(torus, SUPPLE_SCHEME_CATMULL_CLARK);
    add(sphere, SUPPLE_SCHEME_PM);
    const auto check = [&] {
        groups.clear();
        for (const auto& crowd : crowds) {
            groups.push_back(crowd->group());
        }
        view.look({0.0f, 2.0f, 12.0f});
        context.run(groups);
        size_t patches = 0;
        for (const auto& crowd : crowds) {
            const host::GroupOutput output = crowd->output();
            EXPECT_EQ(output.levels.buckets.offset % 256, 0u);
            EXPECT_EQ(output.levels.patches.offset % 256, 0u);
            const LodSurface surface = readLodSurface(*crowd);
            EXPECT_EQ(surface.patches.size(), output.surface.patchCount);
            EXPECT_EQ(matchSides(surface).unmatched, 0u);
            patches += surface.patches.size();
        }
        context.run(groups);
        EXPECT_EQ(view.statistics().patchCount, patches);
    };
    check();
    // A hole in between, and what takes it.
    crowds.erase(crowds.begin() + 1);
    check();
    check();
    add(sphere, SUPPLE_SCHEME_PREP);
    check();
}

} // namespace
} // namespace supple::test
