// Bounds of instances without a view, and on the CPU, frames later: against the surface vertices that the device wrote.
#include "tests/support/allocation_count.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/sample_assets.h"

#include <algorithm>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <random>

namespace supple::test {
namespace {

struct Corners {
    glm::vec3 low, high;
};
Corners cornersOf(const SuppleBounds& bounds) {
    return {{bounds.min[0], bounds.min[1], bounds.min[2]}, {bounds.max[0], bounds.max[1], bounds.max[2]}};
}
Corners boxOf(const std::vector<glm::vec3>& points) {
    Corners box{points.at(0), points.at(0)};
    for (const glm::vec3& p : points) {
        box = {glm::min(box.low, p), glm::max(box.high, p)};
    }
    return box;
}
bool holds(const Corners& outer, const Corners& inner) {
    return glm::all(glm::lessThanEqual(outer.low, inner.low)) &&
           glm::all(glm::greaterThanEqual(outer.high, inner.high));
}

/// A frame that has run and one that has begun behind it.
class InstanceBounds : public CrowdContexts {
protected:
    [[nodiscard]] std::optional<Corners> read(Crowd& crowd, SuppleInstance instance, uint64_t* frame = nullptr) {
        SuppleBounds bounds{};
        const SuppleResult result = suppleReadInstanceBounds(crowd.context().handle(), instance, &bounds, frame);
        EXPECT_TRUE(result == SUPPLE_OK || result == SUPPLE_NOT_READY) << suppleResultString(result);
        return result == SUPPLE_OK ? std::optional(cornersOf(bounds)) : std::nullopt;
    }
    /// As the device has it.
    [[nodiscard]] static Corners onDevice(Crowd& crowd, uint32_t slot) {
        SuppleBufferRange range{};
        EXPECT_EQ(suppleGetInstanceBounds(crowd.context().handle(), crowd.group(), &range), SUPPLE_OK);
        EXPECT_EQ(range.stride, 32u);
        const std::vector<glm::vec4> all = as<glm::vec4>(crowd.read(range));
        EXPECT_EQ(all.at(2 * slot + 1).w, 0.0f);
        return {glm::vec3(all.at(2 * slot)), glm::vec3(all.at(2 * slot + 1))};
    }
};

SuppleGroupDesc withBounds(SuppleAsset asset, uint32_t capacity, SuppleScheme scheme = SUPPLE_SCHEME_AUTO) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = capacity;
    desc.scheme = scheme;
    desc.rate = 2;
    desc.flags = SUPPLE_GROUP_BOUNDS;
    return desc;
}

TEST_F(InstanceBounds, HoldTheSurfaceWithoutAView) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE}) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        for (const SuppleScheme scheme : {SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_FRAGMENTS, SUPPLE_SCHEME_POLYGONS}) {
            Crowd crowd(own, withBounds(own.asset(kPip), 4, scheme));
            ASSERT_TRUE(crowd.valid());
            std::vector<SuppleInstance> all;
            for (uint32_t i = 0; i < 3; ++i) {
                all.push_back(crowd.spawn());
                crowd.pose(all[i], 0, 0.2 * i,
                           glm::translate(glm::mat4(1.0f), glm::vec3(10.0f * float(i), 1.0f, 0.0f)));
            }
            crowd.setVisible(all[1], false);
            crowd.run();
            own.beginFrame();
            for (const uint32_t i : {0u, 2u}) {
                const Corners box = onDevice(crowd, i), surface = boxOf(asPositions(crowd.positions(i)));
                EXPECT_TRUE(holds(box, surface));
                // P_m may reach out by 0.4 of the box of its cage.
                EXPECT_LT(glm::length(box.high - box.low), 2.2f * glm::length(surface.high - surface.low));
                const std::optional<Corners> onHost = read(crowd, all[i]);
                ASSERT_TRUE(onHost);
                EXPECT_EQ(onHost->low, box.low);
                EXPECT_EQ(onHost->high, box.high);
            }
            EXPECT_FALSE(read(crowd, all[1])) << "hidden";
        }
    }
}

TEST_F(InstanceBounds, AGroupOfAViewHasTheSame) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    ASSERT_TRUE(own.valid());
    SuppleViewDesc asked{};
    asked.structSize = sizeof(asked);
    asked.maxVertices = 1u << 18;
    SuppleView view{};
    ASSERT_EQ(suppleCreateView(own.handle(), &asked, &view), SUPPLE_OK);
    SuppleCameraDesc camera{};
    camera.structSize = sizeof(camera);
    camera.pixelsPerUnit = 400.0f;
    camera.position[2] = 5.0f;
    ASSERT_EQ(suppleSetCamera(own.handle(), view, &camera), SUPPLE_OK);
    {
        SuppleGroupDesc desc = withBounds(own.asset(kPip), 2, SUPPLE_SCHEME_PM);
        Crowd without(own, desc);
        desc.view = view;
        Crowd with(own, desc);
        ASSERT_TRUE(without.valid() && with.valid());
        const SuppleInstance a = without.spawn(), b = with.spawn();
        without.pose(a, 0, 0.3, glm::mat4(1.0f));
        with.pose(b, 0, 0.3, glm::mat4(1.0f));
        const SuppleGroup groups[] = {without.group(), with.group()};
        own.run(groups);
        own.beginFrame();
        uint64_t frame = 0;
        const std::optional<Corners> mine = read(without, a, &frame), views = read(with, b);
        ASSERT_TRUE(mine && views);
        EXPECT_EQ(frame + 1, own.frame);
        EXPECT_EQ(mine->low, views->low);
        EXPECT_EQ(mine->high, views->high);
        EXPECT_EQ(onDevice(with, 0).low, views->low);
    }
    EXPECT_EQ(suppleDestroyView(own.handle(), view), SUPPLE_OK);
}

TEST_F(InstanceBounds, AreOfTheNewestCompletedFrame) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    ASSERT_TRUE(own.valid());
    SuppleAsset tube{};
    ASSERT_EQ(createTube(own.handle(), tube), SUPPLE_OK);
    Crowd crowd(own, withBounds(tube, 2, SUPPLE_SCHEME_CAGE));
    ASSERT_TRUE(crowd.valid());
    const SuppleGroup group = crowd.group();
    const SuppleInstance a = crowd.spawn();
    const auto place = [&](float x) {
        crowd.pose(a, SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), glm::vec3(x, 0.0f, 0.0f)));
    };
    EXPECT_FALSE(read(crowd, a)) << "nothing was recorded";
    place(0.0f);
    crowd.run();
    EXPECT_FALSE(read(crowd, a)) << "the host has not said that the frame is complete";
    own.beginFrame();
    const std::optional<Corners> first = read(crowd, a);
    ASSERT_TRUE(first);

    // Two frames in flight: with each, what is read is of the one that is said to be complete.
    const uint64_t start = own.frame;
    Commands flights[2]{Commands(own.device()), Commands(own.device())};
    for (uint64_t k = 0; k < 7; ++k) {
        Commands& commands = flights[k % 2];
        commands.wait();
        place(1.0f + static_cast<float>(k));
        const uint64_t frame = start + 1 + k, completed = k < 2 ? start : frame - 2;
        own.frame = frame;
        ASSERT_EQ(suppleBeginFrame(own.handle(), frame, completed), SUPPLE_OK);
        commands.record([&](VkCommandBuffer buffer) { EXPECT_EQ(own.record(buffer, {&group, 1}), SUPPLE_OK); });
        commands.submit();
        uint64_t of = 0;
        const std::optional<Corners> box = read(crowd, a, &of);
        ASSERT_TRUE(box) << "recording leaves the newest completed copy alone";
        EXPECT_EQ(of, k < 2 ? start - 1 : completed);
        EXPECT_NEAR(box->low.x, first->low.x + (k < 2 ? 0.0f : static_cast<float>(k) - 1.0f), 1e-5f);
    }
    for (Commands& commands : flights) {
        commands.wait();
    }
    // Frames that do not record the group leave its box as it was; a cancelled one has none.
    own.beginFrame();
    own.beginFrame();
    uint64_t of = 0;
    ASSERT_TRUE(read(crowd, a, &of));
    EXPECT_EQ(of, start + 7);
    own.cancel(group);
    own.beginFrame();
    ASSERT_TRUE(read(crowd, a, &of));
    EXPECT_EQ(of, start + 7);
}

TEST_F(InstanceBounds, ANewInstanceNeverGetsTheOldOnesBox) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    ASSERT_TRUE(own.valid());
    SuppleAsset tube{};
    ASSERT_EQ(createTube(own.handle(), tube), SUPPLE_OK);
    Crowd crowd(own, withBounds(tube, 4, SUPPLE_SCHEME_CAGE));
    ASSERT_TRUE(crowd.valid());
    std::mt19937 random(3);
    struct Member {
        SuppleInstance instance{};
        float x = 0.0f;
    };
    std::map<uint32_t, Member> members;
    float next = 0.0f;
    for (int step = 0; step < 60; ++step) {
        const uint32_t slot = random() % 4;
        if (members.count(slot) != 0) {
            crowd.destroy(members[slot].instance);
            members.erase(slot);
        }
        if (random() % 3 != 0 && members.size() < 4) {
            next += 100.0f;
            const Member member{crowd.spawn(), next};
            crowd.pose(member.instance, SUPPLE_BIND_POSE, 0.0,
                       glm::translate(glm::mat4(1.0f), glm::vec3(next, 0.0f, 0.0f)));
            EXPECT_FALSE(read(crowd, member.instance));
            members[member.instance.slot] = member;
        }
        crowd.run();
        own.beginFrame();
        for (const auto& [at, member] : members) {
            const std::optional<Corners> box = read(crowd, member.instance);
            ASSERT_TRUE(box) << "slot " << at;
            EXPECT_LT(box->low.x, member.x + 50.0f);
            EXPECT_GT(box->high.x, member.x - 50.0f);
        }
    }
}

TEST_F(InstanceBounds, ReadingAllocatesNothing) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    ASSERT_TRUE(own.valid());
    SuppleAsset tube{};
    ASSERT_EQ(createTube(own.handle(), tube), SUPPLE_OK);
    Crowd crowd(own, withBounds(tube, 3, SUPPLE_SCHEME_CAGE));
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance a = crowd.spawn();
    crowd.run();
    own.beginFrame();
    SuppleBounds bounds{};
    const uint64_t before = allocationsCounted();
    {
        const AllocationCount count;
        EXPECT_EQ(suppleReadInstanceBounds(own.handle(), a, &bounds, nullptr), SUPPLE_OK);
    }
    EXPECT_EQ(allocationsCounted(), before);
}

TEST_F(InstanceBounds, GroupsWithoutTheFlagHaveNone) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    ASSERT_TRUE(own.valid());
    SuppleAsset tube{};
    ASSERT_EQ(createTube(own.handle(), tube), SUPPLE_OK);
    SuppleGroupDesc desc = withBounds(tube, 1, SUPPLE_SCHEME_CAGE);
    desc.flags = 0;
    Crowd crowd(own, desc);
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance a = crowd.spawn();
    SuppleBounds bounds{};
    SuppleBufferRange range{};
    EXPECT_EQ(suppleReadInstanceBounds(own.handle(), a, &bounds, nullptr), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_CONFLICT);
    EXPECT_EQ(suppleGetInstanceBounds(own.handle(), crowd.group(), &range), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_CONFLICT);
}

} // namespace
} // namespace supple::test
