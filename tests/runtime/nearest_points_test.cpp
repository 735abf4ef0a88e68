// Nearest points on the device, beside dense samples and the searches on the CPU; instances, frames, recordings.
#include "tests/support/asked_pool.h"
#include "tests/support/bent_tube.h"
#include "tests/support/crowd.h"
#include "tests/support/dense_triangles.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/read_character.h"
#include "tests/support/recordings.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"
#include "tests/support/worst.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <optional>
#include <random>

namespace supple::test {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity(), kNoNumber = std::numeric_limits<float>::quiet_NaN();

SupplePlace placeAt(const glm::vec3& at, float most = kFar) {
    return {{at.x, at.y, at.z}, most};
}

bool areSameHits(const std::vector<SuppleHit>& a, const std::vector<SuppleHit>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(SuppleHit)) == 0;
}

class NearestPoints : public CrowdContexts {
    const ValidationGuard guard_;
};

/// A surface in a pose, places round it, and what is nearest to them.
struct NearTruth {
    Surfaces surfaces;
    std::vector<glm::vec3> cage;
    double extent = 0.0;
    std::vector<SupplePlace> places;
    std::vector<double> samples; ///< how far the nearest dense sample is
    std::vector<double> onCpu;   ///< how far the point is that suppleFindPoints finds
    std::vector<SuppleHit> hits; ///< of the first mapping
};
NearTruth nearTruth(const Surfaces& surfaces, std::vector<glm::vec3> cage, uint32_t count, uint32_t along) {
    const DenseTriangles dense(surfaces, cage, along);
    NearTruth truth{surfaces, std::move(cage), dense.extent, {}, {}, {}, {}};
    std::mt19937 random(3);
    const auto number = [&] { return 2.0 * static_cast<double>(random() % 65536) / 65536.0 - 1.0; };
    std::vector<glm::vec3> at;
    for (uint32_t k = 0; k < count; ++k) { // in the box, and around it
        const glm::dvec3 way(number(), number(), number());
        at.emplace_back(dense.middle + (k % 2 == 0 ? 1.0 : 2.0) * dense.half * way);
        truth.places.push_back(placeAt(at.back()));
        truth.samples.push_back(dense.nearest(at.back()));
    }
    SupplePointQuery query = queryOf(SUPPLE_FIND_NEAREST, count, &at[0].x);
    std::vector<SuppleSurfaceJet> jets(count);
    query.cage = &truth.cage[0].x;
    query.cageVertexCount = static_cast<uint32_t>(truth.cage.size());
    query.jets = jets.data();
    (void)found(surfaces, query);
    for (uint32_t k = 0; k < count; ++k) {
        truth.onCpu.push_back(glm::distance(runtime::vectorAt(jets[k].position), glm::dvec3(at[k])));
    }
    return truth;
}

/// What nearest points are off by, in parts of the extent, but for counts.
struct NearFigures {
    uint32_t places = 0, wrong = 0, farther = 0, nearer = 0;
    double apart = 0.0, off = 0.0, normal = 0.0, beyond = 0.0; ///< beyond: the CPU's distance
};

void compareNearest(const NearTruth& truth, const std::vector<SuppleHit>& hits, NearFigures& figures) {
    runtime::CpuPose pose(truth.surfaces);
    ASSERT_TRUE(pose.build(reinterpret_cast<const std::byte*>(truth.cage.data()), sizeof(glm::vec3), {}));
    ASSERT_EQ(hits.size(), truth.places.size());
    for (size_t k = 0; k < hits.size(); ++k) {
        const SuppleHit& hit = hits[k];
        ASSERT_EQ(hit.group, 0u) << k;
        const glm::dvec3 place = runtime::vectorAt(truth.places[k].position), at = runtime::vectorAt(hit.position),
                         normal = runtime::vectorAt(hit.normal);
        ++figures.places;
        figures.wrong += double{hit.t} > truth.samples[k] + 0.01 * truth.extent ? 1 : 0;
        figures.farther += double{hit.t} > truth.onCpu[k] + 1e-3 * truth.extent ? 1 : 0;
        figures.nearer += double{hit.t} < truth.onCpu[k] - 1e-3 * truth.extent ? 1 : 0;
        raise(figures.beyond, (double{hit.t} - truth.onCpu[k]) / truth.extent);
        raise(figures.apart, std::abs(glm::distance(place, at) - double{hit.t}) / truth.extent);
        SuppleSurfaceJet there;
        ASSERT_TRUE(pose.evaluate({&hit.point, 1}, &there, {})) << "face " << hit.point.face;
        raise(figures.off, glm::distance(runtime::vectorAt(there.position), at) / truth.extent);
        const glm::dvec3 n = glm::cross(runtime::vectorAt(there.du), runtime::vectorAt(there.dv));
        raise(figures.normal, glm::distance(glm::normalize(n), normal));
        EXPECT_EQ(hit.flags, glm::dot(normal, at - place) > 0.0 ? uint32_t{SUPPLE_HIT_BACK} : 0u) << k;
    }
}

void askForNearest(CrowdContext& own, const cage::Character& character, SuppleScheme scheme, uint32_t count,
                   std::optional<NearTruth>& truth, NearFigures& figures) {
    Crowd crowd(own, askedGroup(own.createAsset(character), scheme));
    ASSERT_TRUE(crowd.valid());
    AskedPool pool(own, {crowd.group()}, count, SUPPLE_QUERY_POOL_NEAREST);
    const SuppleInstance away = crowd.spawn(), posed = crowd.spawn();
    crowd.pose(away, 0, 0.0, glm::translate(glm::mat4(1.0f), {-500.0f, 0.0f, 0.0f}));
    crowd.pose(posed, 0, 0.8,
               glm::rotate(glm::translate(glm::mat4(1.0f), {40.0f, -1.0f, 0.5f}), 0.7f, glm::vec3(0.3f, 1.0f, 0.2f)));
    crowd.run();
    const std::vector<glm::vec4> words = as<glm::vec4>(crowd.slotBytes(crowd.output().info.deformedCage, posed.slot));
    const std::vector<glm::vec3> cage(words.begin(), words.begin() + character.cage.vertexCount());
    if (!truth) {
        const Surfaces surfaces = surfacesOf(character, scheme);
        ASSERT_NE(surfaces, nullptr);
        truth = nearTruth(surfaces, cage, count, character.cage.faceCount() > 1000 ? 16 : 32);
    }
    ASSERT_EQ(cage, truth->cage);
    const std::vector<SuppleHit> hits = pool.run(truth->places);
    EXPECT_TRUE(std::all_of(hits.begin(), hits.end(), [&](const SuppleHit& hit) { return hit.slot == posed.slot; }));
    EXPECT_TRUE(truth->hits.empty() || areSameHits(hits, truth->hits)) << "the other mapping";
    truth->hits = hits;
    compareNearest(*truth, hits, figures);
}

void print(SuppleScheme scheme, const NearFigures& own) {
    std::printf("scheme %u: %u of %u wrong; %u nearer than on the CPU, %u farther, by %.1e at most; t %.1e, off %.1e, "
                "normal %.1e\n",
                scheme, own.wrong, own.places, own.nearer, own.farther, own.beyond, own.apart, own.off, own.normal);
}

constexpr double kMostFarther = 0.001;

TEST_F(NearestPoints, AreAsNearAsDenseSamples) {
    NearFigures all;
    for (const SuppleScheme scheme :
         {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_LOOP, SUPPLE_SCHEME_BLEND,
          SUPPLE_SCHEME_POLYGONS, SUPPLE_SCHEME_CAGE}) {
        std::optional<NearTruth> truth;
        NearFigures own;
        for (const SuppleMapping mapping : kMappings) {
            // All schemes have the same kernel: squares, triangles and a cage tell.
            const bool tells =
                scheme == SUPPLE_SCHEME_PM || scheme == SUPPLE_SCHEME_LOOP || scheme == SUPPLE_SCHEME_CAGE;
            if (mapping == SUPPLE_MAPPING_WIDE && !tells) {
                continue;
            }
            SCOPED_TRACE(mappingName(mapping) + ", scheme " + std::to_string(scheme));
            askForNearest(context(mapping), bentTube(), scheme, 200, truth, own);
        }
        print(scheme, own);
        EXPECT_LE(own.off, 2e-5);
        EXPECT_LE(own.apart, 1e-6);
        EXPECT_LE(own.beyond, 1e-5);
        EXPECT_LE(own.normal, 1e-2);
        all.wrong += own.wrong;
        all.farther += own.farther;
        all.places += own.places;
    }
    EXPECT_LE(all.wrong, kMostFarther * all.places);
    EXPECT_LE(all.farther, kMostFarther * all.places);
}

/// The character of the samples, bent by a clip.
TEST_F(NearestPoints, LieOnABentCharacter) {
    NearFigures own;
    std::optional<NearTruth> truth;
    askForNearest(context(SUPPLE_MAPPING_NARROW), readCharacter(kPipQuads), SUPPLE_SCHEME_PM, 64, truth, own);
    print(SUPPLE_SCHEME_PM, own);
    EXPECT_EQ(own.wrong, 0u);
    EXPECT_EQ(own.farther, 0u);
    EXPECT_LE(own.beyond, 1e-5);
    EXPECT_LE(own.off, 3e-6);
    EXPECT_LE(own.normal, 1e-3);
}

/// Among all instances of all groups, up to a distance, and the lower face of two.
TEST_F(NearestPoints, SayWhichInstanceOfWhichGroupIsNear) {
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        const SuppleAsset asset = own.createAsset(cage::makeCubeSphere(2));
        Crowd first(own, askedGroup(asset, SUPPLE_SCHEME_CAGE, 4)),
            second(own, askedGroup(asset, SUPPLE_SCHEME_CAGE, 4));
        AskedPool pool(own, {second.group(), first.group()}, 64, SUPPLE_QUERY_POOL_NEAREST);
        const auto spawn = [](Crowd& crowd, float x) {
            const SuppleInstance made = crowd.spawn();
            const glm::mat4 place = glm::translate(glm::mat4(1.0f), {x, 0.0f, 0.0f});
            EXPECT_EQ(suppleSetTransform(crowd.context().handle(), made, &place[0][0]), SUPPLE_OK);
            return made;
        };
        const SuppleInstance near = spawn(first, 0.0f);
        spawn(first, 10.0f);
        spawn(second, 20.0f);
        std::vector<SuppleHit> hits =
            pool.run({placeAt({1.5f, 0.1f, 0.1f}), placeAt({11.5f, 0.1f, 0.1f}), placeAt({18.0f, 0.1f, 0.1f}),
                      placeAt({14.0f, 0.0f, 0.0f}, 0.5f), placeAt({0.1f, 0.1f, 0.1f})});
        const auto expectHit = [&](size_t place, uint32_t group, uint32_t slot) {
            EXPECT_EQ(hits[place].group, group) << place;
            EXPECT_EQ(hits[place].slot, slot) << place;
        };
        expectHit(0, 1, 0);
        expectHit(1, 1, 1);
        expectHit(2, 0, 0);
        EXPECT_EQ(hits[3].group, SUPPLE_NO_HIT);
        EXPECT_EQ(hits[3].t, kFar);
        EXPECT_EQ(hits[3].point.face, SUPPLE_NO_FACE);
        expectHit(4, 1, 0);
        EXPECT_EQ(hits[4].flags, uint32_t{SUPPLE_HIT_BACK}) << "it is inside";
        EXPECT_EQ(hits[0].flags, 0u);
        // Up to a distance, which is reached.
        hits = pool.run(
            {placeAt({1.5f, 0.1f, 0.1f}, 1.0001f * hits[0].t), placeAt({1.5f, 0.1f, 0.1f}, 0.9999f * hits[0].t)});
        expectHit(0, 1, 0);
        EXPECT_EQ(hits[1].group, SUPPLE_NO_HIT);
        first.setVisible(near, false);
        hits = pool.run({placeAt({1.5f, 0.1f, 0.1f})});
        expectHit(0, 1, 1);
        first.setVisible(near, true);
        // Beside each vertex of the cage several faces are equally near: that of the lowest is the point.
        const cage::Cage ball = cage::makeCubeSphere(2);
        std::vector<SupplePlace> places;
        for (const glm::vec3& vertex : ball.positions) {
            places.push_back(placeAt(glm::vec3(20.0f, 0.0f, 0.0f) + 1.5f * vertex));
        }
        hits = pool.run(places);
        for (uint32_t v = 0; v < ball.vertexCount(); ++v) {
            const auto corner = std::find(ball.faceVertices.begin(), ball.faceVertices.end(), v);
            EXPECT_EQ(hits[v].point.face, static_cast<uint32_t>(corner - ball.faceVertices.begin()) / 4) << v;
        }
    }
}

/// Places with numbers that are none have nothing, and the others are as without them.
TEST_F(NearestPoints, BadPlacesHaveNone) {
    const std::vector<SupplePlace> bad{placeAt({kNoNumber, 0, 0}), placeAt({0, kFar, 0}),
                                       placeAt({0, 0, -3e38f}),    placeAt({0, 0, 0}, kNoNumber),
                                       placeAt({0, 0, 0}, -1.0f),  placeAt({0, 0, 0}, -kFar)};
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        Crowd crowd(own, askedGroup(own.createAsset(bentTube()), SUPPLE_SCHEME_PM));
        AskedPool pool(own, {crowd.group()}, 64, SUPPLE_QUERY_POOL_NEAREST);
        (void)crowd.spawn();
        std::vector<SupplePlace> good, mixed;
        for (size_t k = 0; k < 20; ++k) { // more than a lane looks at at once
            good.push_back(placeAt({0.3f * static_cast<float>(k), 1.0f, 2.0f}));
            mixed.push_back(bad[k % bad.size()]);
            mixed.push_back(good.back());
        }
        const std::vector<SuppleHit> alone = pool.run(good), hits = pool.run(mixed);
        for (size_t k = 0; k < good.size(); ++k) {
            EXPECT_EQ(hits[2 * k].group, SUPPLE_NO_HIT) << k;
            EXPECT_TRUE(areSameHits({hits[2 * k + 1]}, {alone[k]})) << k;
            EXPECT_EQ(alone[k].group, 0u);
        }
        // Rays may come in other frames of the pool.
        const SuppleRay ray{{0.9f, 0.2f, 9.0f}, 0.0f, {0.0f, 0.0f, -1.0f}, kFar};
        SuppleQueryDesc rays = AskedPool::batchOf(1);
        rays.hostRays = &ray;
        EXPECT_EQ(pool.run(rays)[0].group, 0u);
        EXPECT_TRUE(areSameHits(pool.run(good), alone));
    }
}

/// Coordinates that are not finite belong to their instance alone. Places of the device are those of the host.
TEST_F(NearestPoints, TakePlacesOfTheDevice) {
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        const cage::Cage ball = cage::makeCubeSphere(2);
        SuppleGroupDesc desc = askedGroup(own.createAsset(ball), SUPPLE_SCHEME_CAGE, 2);
        desc.poseSource = SUPPLE_POSES_CAGE_BUFFER;
        Crowd crowd(own, desc);
        AskedPool pool(own, {crowd.group()}, 32, SUPPLE_QUERY_POOL_NEAREST);
        (void)crowd.spawn(), (void)crowd.spawn();
        std::vector<glm::vec4> cages[2];
        for (const glm::vec3& p : ball.positions) { // one of the other's vertices is none
            cages[0].emplace_back(p, 1.0f);
            cages[1].emplace_back(p.x + (cages[1].empty() ? kNoNumber : 0.01f), p.y, p.z, 1.0f);
        }
        const SuppleBufferRange range = crowd.output().info.deformedCage;
        crowd.run([&](VkCommandBuffer commands) {
            for (size_t slot = 0; slot < 2; ++slot) {
                vkCmdUpdateBuffer(commands, range.buffer,
                                  range.offset + slot * range.stride * crowd.output().info.cageVerticesPerInstance,
                                  cages[slot].size() * sizeof(glm::vec4), cages[slot].data());
            }
        });
        // The vertices of the first instance, with 1 for the farthest distance, are places.
        SuppleQueryDesc ofDevice = AskedPool::batchOf(20);
        ofDevice.places = {range.buffer, range.offset, 20 * sizeof(SupplePlace), 0};
        const std::vector<SuppleHit> hits = pool.run(ofDevice);
        std::vector<SupplePlace> places;
        for (size_t k = 0; k < 20; ++k) {
            places.push_back(placeAt(ball.positions[k], 1.0f));
            EXPECT_EQ(hits[k].slot, 0u) << k;
            EXPECT_LE(hits[k].t, 1e-6f);
        }
        EXPECT_TRUE(areSameHits(pool.run(places), hits));
    }
}

/// Rays and places of the host are in a recording, and one that begins late makes the pools that there are.
TEST_F(NearestPoints, AreRecorded) {
    using runtime::kCallNumber;
    namespace calls = runtime::calls;
    const cage::Character tube = bentTube();
    for (const bool isLate : {false, true}) {
        CrowdContext own(*testDevice(), SUPPLE_MAPPING_AUTO, 2, isLate ? SUPPLE_CONTEXT_RECORDABLE : 0);
        Recorded recorded;
        if (!isLate) {
            ASSERT_EQ(recorded.start(own.handle()), SUPPLE_OK);
        }
        Crowd crowd(own, askedGroup(own.createAsset(tube), SUPPLE_SCHEME_PM));
        auto gone = std::make_unique<Crowd>(own, askedGroup(own.createAsset(tube), SUPPLE_SCHEME_CAGE));
        AskedPool pool(own, {crowd.group()}, 8, SUPPLE_QUERY_POOL_NEAREST);
        auto ended = std::make_unique<AskedPool>(own, std::vector{crowd.group()}, 8, SUPPLE_QUERY_POOL_NEAREST);
        SuppleQueryPool ofBoth{}, ofGone{};
        const SuppleGroup both[] = {gone->group(), crowd.group()};
        SuppleQueryPoolDesc desc{};
        desc.structSize = sizeof(desc);
        desc.groups = both;
        desc.groupCount = 2;
        desc.rayCount = 4;
        ASSERT_EQ(suppleCreateQueryPool(own.handle(), &desc, &ofBoth), SUPPLE_OK);
        desc.groupCount = 1;
        ASSERT_EQ(suppleCreateQueryPool(own.handle(), &desc, &ofGone), SUPPLE_OK);
        crowd.pose(crowd.spawn(), 0, 0.5, glm::mat4(1.0f));
        EXPECT_EQ(pool.run({placeAt({0, 1, 2}), placeAt({1, 1, 2})})[0].group, 0u);
        ended.reset();
        gone.reset();
        if (isLate) {
            own.beginFrame(); // one that has recorded nothing
            ASSERT_EQ(recorded.start(own.handle()), SUPPLE_OK);
        }
        EXPECT_EQ(pool.run({placeAt({0, 1, 2})})[0].group, 0u);
        const SuppleRay ray{{0.9f, 0.2f, 9.0f}, 0.0f, {0.0f, 0.0f, -1.0f}, kFar};
        SuppleQueryDesc rays = AskedPool::batchOf(1);
        rays.hostRays = &ray;
        rays.groups = both + 1;
        rays.groupCount = 1;
        EXPECT_EQ(pool.run(rays)[0].group, 0u);
        const SuppleTriangleHit triangle{0, 0, 0, 0, 0, 8.0f, {}};
        rays.hostTriangles = &triangle;
        (void)pool.run(rays);
        own.beginFrame(); // the last one is complete
        const ReadRecording told = expectReplayed(own.handle(), recorded, 6, {kMappings, 1});
        EXPECT_TRUE(told.calls.contains(kCallNumber<calls::CreateQueryPool>));
        EXPECT_TRUE(told.calls.contains(kCallNumber<calls::RecordQueries>));
        EXPECT_EQ(told.calls.contains(kCallNumber<calls::DestroyQueryPool>), !isLate);
        EXPECT_EQ(suppleDestroyQueryPool(own.handle(), ofBoth), SUPPLE_OK);
        EXPECT_EQ(suppleDestroyQueryPool(own.handle(), ofGone), SUPPLE_OK);
    }
}

} // namespace
} // namespace supple::test
