// Queries of many rays: trees over pieces, and that rays meet through them, to the bit, what few rays meet without.
#include "runtime/api/entry.h"
#include "shaders/shared/queries.h"
#include "tests/support/asked_pool.h"
#include "tests/support/bent_tube.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/limited_device.h"
#include "tests/support/read_character.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace supple::test {
namespace {

/// What frames find that ask for few rays each.
std::vector<SuppleHit> askFew(AskedPool& pool, std::span<const SuppleRay> rays) {
    std::vector<SuppleHit> all;
    for (size_t first = 0; first < rays.size(); first += shared::kRaysPerLane) {
        const std::vector<SuppleHit> hits = pool.run(
            AskedPool::descOf(rays.subspan(first, std::min<size_t>(shared::kRaysPerLane, rays.size() - first))));
        all.insert(all.end(), hits.begin(), hits.end());
    }
    return all;
}
/// What the pool has of its first group.
const runtime::QueryGroup& inside(const CrowdContext& context, const AskedPool& pool) {
    return *context.handle()->context->queryPools.at(pool.handle().id)->members()[0].group;
}

/// Rays from all sides at instances that stand in a row, many of which graze them, and some that are none.
std::vector<SuppleRay> raysAround(uint32_t instances, float spacing, float size, uint32_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> number(-1.0f, 1.0f);
    const auto any = [&] { return glm::vec3(number(random), number(random), number(random)); };
    std::vector<SuppleRay> rays;
    for (uint32_t k = 0; k < count; ++k) {
        const glm::vec3 middle(spacing * static_cast<float>(k % instances), 0.0f, 0.0f);
        const glm::vec3 from = middle + 3.0f * size * glm::normalize(any() + glm::vec3(0.01f)),
                        to = middle + size * any();
        rays.push_back({{from.x, from.y, from.z},
                        0.0f,
                        {to.x - from.x, to.y - from.y, to.z - from.z},
                        std::numeric_limits<float>::infinity()});
    }
    rays[count / 2].direction[0] = std::numeric_limits<float>::quiet_NaN();
    rays[count / 3].tMax = 0.5f;
    for (int i = 0; i < 3; ++i) { // along the row, through all of them
        rays[count - 1].origin[i] = i == 0 ? -5.0f * size : 0.02f * size;
        rays[count - 1].direction[i] = i == 0 ? 1.0f : 0.0f;
    }
    return rays;
}

void expectSameHits(const std::vector<SuppleHit>& hits, const std::vector<SuppleHit>& wanted) {
    ASSERT_EQ(hits.size(), wanted.size());
    size_t met = 0;
    for (size_t k = 0; k < hits.size(); ++k) {
        EXPECT_EQ(std::memcmp(&hits[k], &wanted[k], sizeof(SuppleHit)), 0)
            << "ray " << k << ": t " << hits[k].t << " and " << wanted[k].t << ", face " << hits[k].point.face
            << " and " << wanted[k].point.face << ", slot " << hits[k].slot << " and " << wanted[k].slot;
        met += wanted[k].group != SUPPLE_NO_HIT ? 1 : 0;
    }
    EXPECT_GT(met, hits.size() / 8);
    EXPECT_LT(met, hits.size());
}

class ManyRays : public CrowdContexts {
    const ValidationGuard guard_;
};

/// Two groups whose instances have the same surface in the same place: of equal hits the first group's and the first
/// instance's counts.
TEST_F(ManyRays, MeetWhatFewDo) {
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        const SuppleAsset asset = own.createAsset(bentTube());
        for (const SuppleScheme scheme :
             {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_LOOP, SUPPLE_SCHEME_CAGE}) {
            SCOPED_TRACE(mappingName(mapping) + ", scheme " + std::to_string(scheme));
            Crowd first(own, askedGroup(asset, scheme, 5, 1)), second(own, askedGroup(asset, scheme, 4, 1));
            for (Crowd* const crowd : {&first, &second}) {
                for (int k = 0; k < 4; ++k) {
                    const float at = k == 3 ? 1.0f : static_cast<float>(k);
                    crowd->pose(crowd->spawn(), 0, 0.3 * at,
                                glm::rotate(glm::translate(glm::mat4(1.0f), {12.0f * at, 0.0f, 0.0f}), 1.3f * at,
                                            glm::vec3(1.0f, 0.3f, -0.4f)));
                }
            }
            const std::vector<SuppleRay> rays = raysAround(3, 12.0f, 3.0f, 96);
            AskedPool many(own, {second.group(), first.group()}, rays.size()),
                few(own, {second.group(), first.group()}, shared::kRaysPerLane);
            const std::vector<SuppleHit> wanted = askFew(few, rays);
            expectSameHits(many.run(rays), wanted);
            expectSameHits(askFew(many, rays), wanted);
            EXPECT_TRUE(std::any_of(wanted.begin(), wanted.end(), [](const SuppleHit& hit) { return hit.slot == 1; }));
            for (const SuppleHit& hit : wanted) {
                EXPECT_TRUE(hit.group == SUPPLE_NO_HIT || (hit.group == 0 && hit.slot != 3)) << hit.group << hit.slot;
            }
        }
    }
}

TEST_F(ManyRays, MeetACharacter) {
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        Crowd crowd(own, askedGroup(own.createAsset(readCharacter(kPipQuads)), SUPPLE_SCHEME_PM, 3, 1));
        for (int k = 0; k < 3; ++k) {
            crowd.pose(crowd.spawn(), 0, 0.3 * k,
                       glm::translate(glm::mat4(1.0f), {40.0f + 2.0f * static_cast<float>(k), 0.0f, 0.0f}));
        }
        std::vector<SuppleRay> rays = raysAround(3, 2.0f, 0.8f, 80);
        for (SuppleRay& ray : rays) {
            ray.origin[0] += 40.0f;
            ray.origin[1] += 0.8f;
        }
        AskedPool many(own, {crowd.group()}, rays.size()), few(own, {crowd.group()}, 1 + shared::kRaysPerLane / 2);
        std::vector<SuppleHit> wanted;
        for (size_t k = 0; k < rays.size(); k += 5) {
            const std::vector<SuppleHit> hits = few.run(AskedPool::descOf(std::span(rays).subspan(k, 5)));
            wanted.insert(wanted.end(), hits.begin(), hits.end());
        }
        expectSameHits(many.run(rays), wanted);
    }
}

/// Pools share the pieces that a reload makes. A pool of few rays makes them first, in whatever order pools come, and
/// it needs no trees.
TEST_F(ManyRays, MeetAnAssetThatIsReloaded) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    cage::Character tube = bentTube();
    const SuppleAsset asset = own.createAsset(tube);
    Crowd crowd(own, askedGroup(asset, SUPPLE_SCHEME_CATMULL_CLARK, 2, 1));
    crowd.pose(crowd.spawn(), 0, 0.3, glm::mat4(1.0f));
    const std::vector<SuppleRay> rays = raysAround(1, 1.0f, 3.0f, 100);
    AskedPool few(own, {crowd.group()}, shared::kRaysPerLane), many(own, {crowd.group()}, rays.size()),
        last(own, {crowd.group()}, shared::kRaysPerLane);
    const std::vector<SuppleHit> before = many.run(rays);
    for (glm::vec3& p : tube.cage.positions) {
        p.y *= 1.2f;
    }
    ASSERT_EQ(own.reloadAsset(asset, tube), SUPPLE_OK);
    const std::vector<SuppleHit> hits = many.run(rays);
    expectSameHits(hits, askFew(few, rays));
    expectSameHits(hits, askFew(last, rays));
    EXPECT_NE(std::memcmp(hits.data(), before.data(), hits.size() * sizeof(SuppleHit)), 0);
}

/// A device that binds little: instances lie in several windows, and there are trees of a few at a time.
TEST_F(ManyRays, GoThroughTreesInTurn) {
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        LimitedDevice limited(mapping, [](WrappedVulkan& says) { says.maxStorageBufferRange = 1u << 14; });
        ASSERT_NE(limited.context(), nullptr);
        CrowdContext& own = *limited.context();
        SuppleGroupDesc desc = askedGroup(own.createAsset(bentTube()), SUPPLE_SCHEME_CAGE, 50, 1);
        desc.flags = SUPPLE_GROUP_WINDOWS;
        Crowd crowd(own, desc);
        ASSERT_TRUE(crowd.valid());
        for (int k = 0; k < 50; ++k) {
            crowd.pose(crowd.spawn(), 0, 0.02 * k,
                       glm::translate(glm::mat4(1.0f), {8.0f * static_cast<float>(k), 0.0f, 0.0f}));
        }
        const std::vector<SuppleRay> rays = raysAround(50, 8.0f, 2.5f, 80);
        AskedPool many(own, {crowd.group()}, rays.size()), few(own, {crowd.group()}, shared::kRaysPerLane);
        EXPECT_GE(inside(own, many).turns(), 6u);
        EXPECT_EQ(inside(own, few).tree(), nullptr);
        expectSameHits(many.run(rays), askFew(few, rays));
    }
}

/// A node of a tree, as it lies on the device.
struct TreeNode {
    glm::vec4 low{}, high{};
};

/// The box of each node is that of its children, and the leaves have every piece.
TEST_F(ManyRays, TreesHoldTheirLeaves) {
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        Crowd crowd(own, askedGroup(own.createAsset(bentTube()), SUPPLE_SCHEME_LOOP, 2, 1));
        for (int k = 0; k < 2; ++k) {
            crowd.pose(crowd.spawn(), 0, 0.4 * k,
                       glm::translate(glm::mat4(1.0f), {12.0f * static_cast<float>(k), 0.0f, 0.0f}));
        }
        const std::vector<SuppleRay> rays = raysAround(2, 12.0f, 3.0f, 40);
        AskedPool pool(own, {crowd.group()}, rays.size());
        (void)pool.run(rays);
        const uint32_t pieces = inside(own, pool).pieces()->count;
        const std::vector<TreeNode> nodes = as<TreeNode>(
            crowd.read({inside(own, pool).tree()->nodes(), 0, 2 * 2 * pieces * sizeof(TreeNode), sizeof(TreeNode)}));
        ASSERT_GT(pieces, 100u);
        for (uint32_t tree = 0; tree < 2; ++tree) {
            const std::span<const TreeNode> nodesOf = std::span(nodes).subspan(size_t{2} * pieces * tree, 2 * pieces);
            std::vector<uint32_t> isThere(pieces);
            glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
            for (uint32_t leaf = pieces; leaf < 2 * pieces; ++leaf) {
                ++isThere.at(static_cast<size_t>(nodesOf[leaf].low.w));
                low = glm::min(low, glm::vec3(nodesOf[leaf].low));
                high = glm::max(high, glm::vec3(nodesOf[leaf].high));
            }
            EXPECT_EQ(isThere, std::vector<uint32_t>(pieces, 1));
            EXPECT_EQ(glm::vec3(nodesOf[1].low), low);
            EXPECT_EQ(glm::vec3(nodesOf[1].high), high);
            for (uint32_t n = 1; n < pieces; ++n) {
                EXPECT_EQ(glm::vec3(nodesOf[n].low),
                          glm::min(glm::vec3(nodesOf[2 * n].low), glm::vec3(nodesOf[2 * n + 1].low)));
                EXPECT_EQ(glm::vec3(nodesOf[n].high),
                          glm::max(glm::vec3(nodesOf[2 * n].high), glm::vec3(nodesOf[2 * n + 1].high)));
            }
        }
    }
}

/// Instances that are not finite are not met, and keep nothing from the others.
TEST_F(ManyRays, MissWhatIsNotFinite) {
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        const cage::Character tube = bentTube();
        SuppleGroupDesc desc = askedGroup(own.createAsset(tube), SUPPLE_SCHEME_CATMULL_CLARK, 2, 1);
        desc.poseSource = SUPPLE_POSES_CAGE_BUFFER;
        Crowd crowd(own, desc);
        (void)crowd.spawn(), (void)crowd.spawn();
        const SuppleBufferRange range = crowd.output().info.deformedCage;
        crowd.run([&](VkCommandBuffer commands) {
            for (size_t slot = 0; slot < 2; ++slot) {
                std::vector<glm::vec4> cage;
                for (const glm::vec3& p : tube.cage.positions) {
                    cage.emplace_back(p, 1.0f);
                }
                if (slot == 0) { // a part of it
                    cage[3].y = std::numeric_limits<float>::quiet_NaN();
                    cage[9].x = std::numeric_limits<float>::infinity();
                }
                vkCmdUpdateBuffer(commands, range.buffer,
                                  range.offset + slot * range.stride * crowd.output().info.cageVerticesPerInstance,
                                  cage.size() * sizeof(cage[0]), cage.data());
            }
        });
        const std::vector<SuppleRay> rays = raysAround(1, 1.0f, 3.0f, 100);
        AskedPool many(own, {crowd.group()}, rays.size()), few(own, {crowd.group()}, shared::kRaysPerLane);
        const std::vector<SuppleHit> hits = many.run(rays);
        expectSameHits(hits, askFew(few, rays));
        for (const uint32_t slot : {0u, 1u}) {
            EXPECT_TRUE(std::any_of(hits.begin(), hits.end(), [&](const SuppleHit& hit) { return hit.slot == slot; }));
        }
    }
}

/// The pass queries has a time, and its memory counts.
TEST_F(ManyRays, AreTimedAndTakeMemory) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    Crowd crowd(own, askedGroup(own.createAsset(bentTube()), SUPPLE_SCHEME_PM, 3, 1));
    crowd.pose(crowd.spawn(), 0, 0.0, glm::mat4(1.0f));
    const std::vector<SuppleRay> rays = raysAround(1, 1.0f, 3.0f, 40);
    const auto scratch = [&] {
        SuppleMemoryUse use{};
        use.structSize = sizeof(use);
        EXPECT_EQ(suppleGetContextMemory(own.handle(), &use), SUPPLE_OK);
        return use.scratch;
    };
    const uint64_t before = scratch();
    AskedPool pool(own, {crowd.group()}, rays.size());
    EXPECT_GE(scratch() - before, uint64_t{64} * 3 * inside(own, pool).pieces()->count);
    for (const bool isTimed : {false, true}) {
        own.beginFrame();
        ASSERT_TRUE(own.device().submitAndWait([&](VkCommandBuffer commands) {
            const SuppleGroup group = crowd.group();
            SuppleRecordDesc record{};
            record.structSize = sizeof(record);
            record.flags = isTimed ? SUPPLE_RECORD_TIMINGS : 0;
            record.groups = &group;
            record.groupCount = 1;
            record.before = record.after = kAnyUse;
            EXPECT_EQ(suppleRecord(own.handle(), commands, &record), SUPPLE_OK);
            SuppleQueryDesc desc{};
            desc.structSize = sizeof(desc);
            desc.hostRays = rays.data();
            desc.rayCount = static_cast<uint32_t>(rays.size());
            desc.before = desc.after = kAnyUse;
            EXPECT_EQ(suppleRecordQueries(own.handle(), commands, pool.handle(), &desc), SUPPLE_OK);
        }));
    }
    own.beginFrame();
    std::array<SuppleTiming, 64> timings{};
    auto count = static_cast<uint32_t>(timings.size());
    ASSERT_EQ(suppleGetTimings(own.handle(), sizeof(timings[0]), timings.data(), &count), SUPPLE_OK);
    ASSERT_GT(count, 1u);
    const SuppleTiming& last = timings[count - 1];
    EXPECT_STREQ(suppleGetPassName(last.pass), "queries");
    EXPECT_EQ(last.pass, SUPPLE_PASS_QUERIES);
    EXPECT_EQ(last.group.id, 0u);
    EXPECT_EQ(last.surface, SUPPLE_NO_SURFACE);
    EXPECT_EQ(last.points, rays.size());
    EXPECT_EQ(last.bytes, rays.size() * sizeof(SuppleHit));
    EXPECT_GT(last.gpuEnd, last.gpuBegin);
    EXPECT_GE(last.gpuBegin, timings[count - 2].gpuEnd);
}

} // namespace
} // namespace supple::test
