// Batches on the host's threads: the same bits as on one, and what becomes of hosts that do not run their jobs.
#include "tests/support/cpu_group.h"
#include "tests/support/meshes.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#if defined(__linux__)
#include <pthread.h>
#endif
#include <random>
#include <thread>
#include <type_traits>

namespace supple::test {
namespace {

/// Four threads, in no order.
struct CpuThreads {
    uint32_t calls = 0;
    bool lazy = false; ///< leaves out the first job

    static void run(uint32_t count, void (*job)(void*, uint32_t), void* jobData, void* user) {
        auto& threads = *static_cast<CpuThreads*>(user);
        ++threads.calls;
        std::atomic<uint32_t> next{threads.lazy ? 1u : 0u};
        std::vector<std::jthread> all;
        for (uint32_t t = 0; t < 4; ++t) {
            all.emplace_back([&] {
                for (uint32_t i = next++; i < count; i = next++) {
                    job(jobData, count - 1 - i);
                }
            });
        }
    }
};

std::vector<SuppleSurfacePoint> randomPoints(const cage::Cage& cage, uint32_t count, uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<SuppleSurfacePoint> points(count);
    for (SuppleSurfacePoint& point : points) {
        const auto number = [&] { return static_cast<float>(random() % 1024) / 1024.0f; };
        point.face = random() % cage.faceCount();
        const uint32_t sides = cage.sides(point.face);
        point.side = sides > 4 ? random() % sides : 0;
        point.a = number();
        point.b = number();
        if (sides != 4 && point.a + point.b > 1.0f) {
            point.a = 1.0f - point.a;
            point.b = 1.0f - point.b;
        }
    }
    return points;
}

template <class T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(CpuJobs, GiveTheSameBits) {
    const cage::Cage cage = perturbed(cage::makeCubeSphere(16), 0.002f, 1);
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK,
                                      SUPPLE_SCHEME_LOOP, SUPPLE_SCHEME_BLEND, SUPPLE_SCHEME_FRAGMENTS}) {
        CpuOptions options;
        options.scheme = scheme;
        const cage::Cage own = scheme == SUPPLE_SCHEME_LOOP ? withCutQuads(cage, 1.0, 1) : cage;
        CpuGroup one(own, options), many(own, options);
        ASSERT_TRUE(one.valid() && many.valid());
        CpuThreads threads;
        const SuppleCpuJobs jobs{&CpuThreads::run, &threads};
        ASSERT_EQ(one.build(own.positions), SUPPLE_OK);
        ASSERT_EQ(many.build(own.positions, &jobs), SUPPLE_OK);
        const CpuGroup::Vertices a = one.evaluate(0, 5), b = many.evaluate(0, 5, &jobs);
        EXPECT_TRUE(sameBits(a.positions, b.positions) && sameBits(a.normals, b.normals)) << scheme;
        // The second time backwards: what lies beside a point says nothing about it.
        std::vector<SuppleSurfacePoint> points = randomPoints(own, 3000, 7);
        const std::vector<SuppleSurfaceJet> there = one.at(points);
        std::reverse(points.begin(), points.end());
        std::vector<SuppleSurfaceJet> back = many.at(points, &jobs);
        std::reverse(back.begin(), back.end());
        EXPECT_TRUE(sameBits(there, back)) << scheme;
        EXPECT_GE(threads.calls, 3u);
    }
}

TEST(CpuJobs, ThatAreNotRunAreRefused) {
    const cage::Cage cage = perturbed(cage::makeCubeSphere(16), 0.002f, 1);
    CpuOptions options;
    options.scheme = SUPPLE_SCHEME_PM;
    CpuGroup group(cage, options);
    CpuThreads threads;
    threads.lazy = true;
    const SuppleCpuJobs jobs{&CpuThreads::run, &threads};
    EXPECT_EQ(group.build(cage.positions, &jobs), SUPPLE_ERROR_ARGUMENT);
    ASSERT_FALSE(group.lines().empty());
    EXPECT_EQ(group.lines().back(), "suppleCpuBuildPose: runJobs has not run each of its jobs once");
    SuppleSurfaceJet jet{};
    const SuppleSurfacePoint point{0, 0, 0.5f, 0.5f};
    EXPECT_EQ(suppleCpuEvaluatePoints(group.pose(), &point, 1, &jet, nullptr), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(group.lines().back(), "suppleCpuEvaluatePoints: the pose is not built");
    threads.lazy = false;
    EXPECT_EQ(group.build(cage.positions, &jobs), SUPPLE_OK);
    EXPECT_EQ(suppleCpuEvaluatePoints(group.pose(), &point, 1, &jet, &jobs), SUPPLE_OK);
}

/// What a host does with jobs 0..count-1.
void runWrongly(const std::function<void(uint32_t count, const std::function<void(uint32_t)>& job)>& how) {
    const cage::Cage cage = perturbed(cage::makeCubeSphere(16), 0.002f, 1);
    CpuOptions options;
    options.scheme = SUPPLE_SCHEME_PM;
    CpuGroup group(cage, options);
    ASSERT_EQ(group.build(cage.positions), SUPPLE_OK);
    using How = std::decay_t<decltype(how)>;
    How own = how;
    const SuppleCpuJobs jobs{[](uint32_t count, void (*job)(void*, uint32_t), void* jobData, void* user) {
                                 (*static_cast<How*>(user))(count, [&](uint32_t i) { job(jobData, i); });
                             },
                             &own};
    const std::vector<SuppleSurfacePoint> points = randomPoints(cage, 3000, 7);
    std::vector<SuppleSurfaceJet> jets(points.size());
    EXPECT_EQ(suppleCpuEvaluatePoints(group.pose(), points.data(), 3000, jets.data(), &jobs), SUPPLE_ERROR_ARGUMENT);
    ASSERT_FALSE(group.lines().empty());
    EXPECT_EQ(group.lines().back(), "suppleCpuEvaluatePoints: runJobs has not run each of its jobs once");
}

TEST(CpuJobs, OneThatIsRunTwiceHidesNoneThatIsNot) {
    runWrongly([](uint32_t count, const std::function<void(uint32_t)>& job) {
        for (uint32_t i = 0; i < count; ++i) {
            job(i == 1 ? 0 : i);
        }
    });
    runWrongly([](uint32_t count, const std::function<void(uint32_t)>& job) {
        for (uint32_t i = 0; i <= count; ++i) { // all of them, and the first again
            job(i % count);
        }
    });
}

TEST(CpuJobs, OneThatDoesNotExistWritesNothing) {
    runWrongly([](uint32_t count, const std::function<void(uint32_t)>& job) {
        for (uint32_t i = 0; i < count; ++i) {
            job(i);
        }
        job(count);
        job(0xFFFFFFFFu);
    });
}

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// Runs each job on a stack of its own, and notes how much of it was used.
struct PaintedStacks {
    static constexpr size_t kSize = size_t{256} * 1024;
    size_t most = 0;

    static void run(uint32_t count, void (*job)(void*, uint32_t), void* jobData, void* user) {
        struct Call {
            void (*job)(void*, uint32_t);
            void* jobData;
            uint32_t number;
        };
        for (uint32_t i = 0; i < count; ++i) {
            Call call{job, jobData, i};
            void* const stack = std::aligned_alloc(4096, kSize);
            std::memset(stack, 0xA5, kSize);
            pthread_attr_t attributes;
            pthread_attr_init(&attributes);
            pthread_attr_setstack(&attributes, stack, kSize);
            pthread_t thread{};
            EXPECT_EQ(pthread_create(
                          &thread, &attributes,
                          [](void* data) -> void* {
                              const Call& own = *static_cast<Call*>(data);
                              own.job(own.jobData, own.number);
                              return nullptr;
                          },
                          &call),
                      0);
            pthread_join(thread, nullptr);
            pthread_attr_destroy(&attributes);
            const auto* bytes = static_cast<const unsigned char*>(stack); // it grows downwards
            size_t untouched = 0;
            while (untouched < kSize && bytes[untouched] == 0xA5) {
                ++untouched;
            }
            auto& own = *static_cast<PaintedStacks*>(user);
            own.most = std::max(own.most, kSize - untouched);
            std::free(stack);
        }
    }
};

/// What the header says, and what the thread itself takes.
TEST(CpuJobs, FitTheStacksOfFibers) {
    const cage::Cage cage = perturbed(cage::makeCubeSphere(16), 0.002f, 1);
    for (const SuppleScheme scheme :
         {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_LOOP, SUPPLE_SCHEME_BLEND,
          SUPPLE_SCHEME_FRAGMENTS, SUPPLE_SCHEME_POLYGONS}) {
        CpuOptions options;
        options.scheme = scheme;
        CpuGroup group(cage, options);
        PaintedStacks stacks[3];
        const auto jobs = [&](int k) { return SuppleCpuJobs{&PaintedStacks::run, &stacks[k]}; };
        const SuppleCpuJobs building = jobs(0), pointing = jobs(1), gridding = jobs(2);
        ASSERT_EQ(group.build(cage.positions, &building), SUPPLE_OK);
        (void)group.at(randomPoints(cage, 3000, 7), &pointing);
        (void)group.evaluate(0, 5, &gridding);
        std::printf("scheme %d: pose %zu, points %zu, grid %zu bytes of stack\n", static_cast<int>(scheme),
                    stacks[0].most, stacks[1].most, stacks[2].most);
        for (const PaintedStacks& one : stacks) {
            EXPECT_LE(one.most, size_t{40} * 1024) << scheme;
        }
    }
}
#endif

} // namespace
} // namespace supple::test
