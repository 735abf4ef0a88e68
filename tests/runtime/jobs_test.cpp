// Pipelines made on the host's threads (SuppleContextDesc.runJobs).
#include "tests/support/gpu_surface.h"
#include "tests/support/logged_context.h"

#include <atomic>
#include <functional>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace supple::test {
namespace {

/// Four threads, whatever the machine has.
struct Threads {
    uint32_t calls = 0, jobs = 0;
    std::thread::id caller;

    static void run(uint32_t count, void (*job)(void*, uint32_t), void* jobData, void* user) {
        auto& threads = *static_cast<Threads*>(user);
        ++threads.calls;
        threads.jobs += count;
        EXPECT_EQ(std::this_thread::get_id(), threads.caller);
        std::atomic<uint32_t> next{0};
        std::vector<std::jthread> all;
        for (uint32_t t = 0; t < 4; ++t) {
            all.emplace_back([&] {
                for (uint32_t i = next++; i < count; i = next++) {
                    job(jobData, i);
                }
            });
        }
    }
};

std::vector<std::byte> bitsWith(const std::function<void(SuppleContextDesc&)>& adjust, SuppleScheme scheme) {
    LoggedContext context(*testDevice(), adjust);
    EXPECT_EQ(context.result(), SUPPLE_OK);
    SuppleAsset asset{};
    EXPECT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
    SuppleGroupDesc desc{};
    desc.scheme = scheme;
    desc.flags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_MOTION;
    const SmallGroup group = createGroup(context.handle(), asset, desc);
    EXPECT_EQ(group.result, SUPPLE_OK);
    context.evaluate({&group.group, 1});
    EXPECT_TRUE(context.takeLines().empty());
    return surfaceBits(context, group.group);
}

TEST(Jobs, GroupsHaveTheSameBits) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_FRAGMENTS}) {
        Threads threads;
        threads.caller = std::this_thread::get_id();
        const std::vector<std::byte> side = bitsWith(
            [&](SuppleContextDesc& desc) {
                desc.runJobs = &Threads::run;
                desc.jobsUser = &threads;
            },
            scheme);
        EXPECT_GE(threads.jobs, 5u);
        EXPECT_LT(threads.calls, threads.jobs); // several at a time
        EXPECT_FALSE(side.empty());
        EXPECT_EQ(side, bitsWith({}, scheme));
    }
}

/// Leaves out its first job while `lazy`.
std::function<void(SuppleContextDesc&)> lazyHost(bool& lazy) {
    return [&lazy](SuppleContextDesc& desc) {
        desc.runJobs = [](uint32_t count, void (*job)(void*, uint32_t), void* jobData, void* user) {
            for (uint32_t i = *static_cast<bool*>(user) ? 1 : 0; i < count; ++i) {
                job(jobData, i);
            }
        };
        desc.jobsUser = &lazy;
    };
}

TEST(Jobs, AGroupWhoseJobsAreNotRunIsRefused) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    bool lazy = true;
    LoggedContext context(*testDevice(), lazyHost(lazy));
    SuppleAsset asset{};
    ASSERT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
    EXPECT_EQ(createGroup(context.handle(), asset).result, SUPPLE_ERROR_ARGUMENT);
    const std::vector<LogLine> lines = context.takeLines();
    ASSERT_FALSE(lines.empty());
    EXPECT_NE(lines.back().text.find("runJobs has not run its job"), std::string::npos) << lines.back().text;
    lazy = false;
    const SmallGroup group = createGroup(context.handle(), asset);
    ASSERT_EQ(group.result, SUPPLE_OK);
    context.evaluate({&group.group, 1});
    EXPECT_FALSE(surfaceBits(context, group.group).empty());
}

TEST(Jobs, AGroupOfAViewWhoseJobsAreNotRunIsRefused) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    bool lazy = false;
    LoggedContext context(*testDevice(), lazyHost(lazy));
    SuppleAsset asset{};
    ASSERT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
    SuppleViewDesc viewDesc{};
    viewDesc.structSize = sizeof(viewDesc);
    viewDesc.maxVertices = 100000;
    SuppleView view{};
    ASSERT_EQ(suppleCreateView(context.handle(), &viewDesc, &view), SUPPLE_OK);
    SuppleGroupDesc desc{};
    desc.view = view;
    lazy = true;
    context.takeLines();
    EXPECT_EQ(createGroup(context.handle(), asset, desc).result, SUPPLE_ERROR_ARGUMENT);
    const std::vector<LogLine> lines = context.takeLines();
    ASSERT_FALSE(lines.empty());
    EXPECT_NE(lines.back().text.find("runJobs has not run its job"), std::string::npos) << lines.back().text;
    lazy = false;
    EXPECT_EQ(createGroup(context.handle(), asset, desc).result, SUPPLE_OK);
    EXPECT_TRUE(context.takeLines().empty());
}

} // namespace
} // namespace supple::test
