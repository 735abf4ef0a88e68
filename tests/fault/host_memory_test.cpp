// Every allocation of every public function fails, one after the other: the call says so, changes nothing, and the
// call after it does what the first would have done.
#include "tests/fault/every_call.h"
#include "tests/fault/vulkan_faults.h"
#include "tests/support/host_memory.h"
#include "tests/support/logged_context.h"

#include <array>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

namespace supple::test {
namespace {

Fault faultOf(Failure kind) {
    return {[kind](uint64_t n) { failHostMemory(n, kind); }, liftHostFailure, SUPPLE_ERROR_HOST_MEMORY};
}

TEST(HostMemory, EveryAllocationOfEveryFunctionMayFail) {
    const std::unique_ptr<host::Device> device = deviceThrough(&faultyGetInstanceProcAddr, false);
    ASSERT_NE(device, nullptr);
    const std::vector<std::byte> sound = makeEveryCall(*device, makeOnce, quiet, false);
    ASSERT_FALSE(sound.empty());
    for (const Failure kind : {Failure::all, Failure::one}) {
        resetHostMemory();
        Calls calls(faultOf(kind));
        EXPECT_TRUE(makeEveryCall(*device, std::bind_front(&Calls::make, &calls), quiet, false) == sound);
        EXPECT_GT(calls.positions(), 1000u);
        // The driver keeps some of its own; a byte for each failure would be seen.
        const int64_t left = hostMemory().live;
        EXPECT_LT(left, static_cast<int64_t>(calls.positions())) << "something leaked";
        std::printf("  %s: %llu allocations failed, %lld bytes left\n",
                    kind == Failure::one ? "one" : "that and all after it",
                    static_cast<unsigned long long>(calls.positions()), static_cast<long long>(left));
    }
}

TEST(HostMemory, ARateThatCannotBeSetLeavesTheGroupAsItWas) {
    const std::unique_ptr<host::Device> device = deviceThrough(&faultyGetInstanceProcAddr, false);
    ASSERT_NE(device, nullptr);
    LoggedContext context(*device, quiet);
    SuppleAsset asset{};
    ASSERT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
    const SmallGroup group = createGroup(context.handle(), asset, {.rate = 8});
    ASSERT_EQ(group.result, SUPPLE_OK);
    struct Output {
        uint32_t vertices = 0, samplesPerPatch = 0;
        std::vector<std::byte> bits;
        bool operator==(const Output&) const = default;
    };
    const auto output = [&] {
        SuppleGridOutput grid{};
        grid.structSize = sizeof(grid);
        EXPECT_EQ(suppleGetGridOutput(context.handle(), group.group, 0, &grid), SUPPLE_OK);
        context.evaluate({&group.group, 1});
        return Output{grid.vertexCount, grid.drawRanges[0].samplesPerPatch, surfaceBits(context, group.group)};
    };
    const Output before = output();
    ASSERT_FALSE(before.bits.empty());
    uint64_t failed = 0;
    for (bool fails = true; fails; ++failed) {
        failHostMemory(failed, Failure::all);
        const SuppleResult result = suppleSetRate(context.handle(), group.group, 5);
        fails = liftHostFailure();
        EXPECT_EQ(result, fails ? SUPPLE_ERROR_HOST_MEMORY : SUPPLE_OK) << failed;
        EXPECT_EQ(output() == before, fails) << failed;
    }
    EXPECT_GT(failed, 5u);
}

TEST(HostMemory, DestroyingTakesNone) {
    const std::unique_ptr<host::Device> device = deviceThrough(&faultyGetInstanceProcAddr, false);
    ASSERT_NE(device, nullptr);
    LoggedContext context(*device, quiet);
    SuppleAsset asset{};
    ASSERT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
    SuppleViewDesc viewDesc{};
    viewDesc.structSize = sizeof(viewDesc);
    viewDesc.maxVertices = 4096;
    SuppleView view{};
    ASSERT_EQ(suppleCreateView(context.handle(), &viewDesc, &view), SUPPLE_OK);
    std::vector<SmallGroup> made;
    std::vector<SuppleGroup> groups;
    for (int i = 0; i < 5; ++i) { // so that lists of any first size are full
        made.push_back(createGroup(context.handle(), asset, {.scheme = SUPPLE_SCHEME_CAGE}));
        groups.push_back(made.back().group);
    }
    context.evaluate(groups);
    const uint64_t before = deviceMemoryOf(context.handle());
    failHostMemory(0, Failure::all);
    std::array<SuppleResult, 12> results{};
    for (size_t i = 0; i < made.size(); ++i) {
        results[2 * i] = suppleDestroyInstance(context.handle(), made[i].instances[0]);
        results[2 * i + 1] = suppleDestroyGroup(context.handle(), made[i].group);
    }
    results[10] = suppleDestroyView(context.handle(), view);
    results[11] = suppleDestroyAsset(context.handle(), asset);
    EXPECT_FALSE(liftHostFailure()) << "an allocation was asked for";
    for (const SuppleResult result : results) {
        EXPECT_EQ(result, SUPPLE_OK);
    }
    // The frame that has recorded the groups may still draw them.
    EXPECT_GT(deviceMemoryOf(context.handle()), before / 2);
    const uint64_t inFlight = deviceMemoryOf(context.handle());
    context.beginFrame();
    EXPECT_LT(deviceMemoryOf(context.handle()), inFlight) << "the frame is complete";
}

TEST(HostMemory, AContextThatCannotBeMadeIsNotThere) {
    const std::unique_ptr<host::Device> device = deviceThrough(&faultyGetInstanceProcAddr, false);
    ASSERT_NE(device, nullptr);
    SuppleContextDesc desc = host::contextDesc(*device);
    quiet(desc);
    for (const Failure kind : {Failure::all, Failure::one}) {
        Calls calls(faultOf(kind), 3);
        SuppleContext context = nullptr;
        calls.make("suppleCreateContext", [&] {
            const SuppleResult result = suppleCreateContext(&desc, &context);
            EXPECT_EQ(context != nullptr, result == SUPPLE_OK);
            return result;
        });
        suppleDestroyContext(context);
        std::printf("  suppleCreateContext: %llu allocations failed\n",
                    static_cast<unsigned long long>(calls.positions()));
    }
}

} // namespace
} // namespace supple::test
