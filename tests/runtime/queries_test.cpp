// Queries on the device: what rays meet, beside dense triangles and the searches on the CPU; batches, frames, mistakes.
#include "runtime/queries/query_pieces.h"
#include "tests/support/asked_pool.h"
#include "tests/support/bent_tube.h"
#include "tests/support/crowd.h"
#include "tests/support/dense_triangles.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/read_character.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/sample_assets.h"
#include "tests/support/side_by_side.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/test_view.h"
#include "tests/support/worst.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <optional>
#include <tuple>

namespace supple::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();

SuppleRay rayOf(const glm::vec3& origin, const glm::vec3& direction, float tMin = 0.0f, float tMax = kInfinity) {
    return {{origin.x, origin.y, origin.z}, tMin, {direction.x, direction.y, direction.z}, tMax};
}
std::vector<SuppleRay> raysOf(const std::vector<TestRay>& from) {
    std::vector<SuppleRay> rays;
    for (const TestRay& ray : from) {
        rays.push_back(rayOf(ray.origin, ray.direction));
    }
    return rays;
}

std::vector<glm::vec3> deformedCage(const Crowd& crowd, uint32_t slot, size_t vertices) {
    const std::vector<glm::vec4> all = as<glm::vec4>(crowd.slotBytes(crowd.output().info.deformedCage, slot));
    std::vector<glm::vec3> cage;
    for (size_t v = 0; v < vertices; ++v) {
        cage.emplace_back(all[v]);
    }
    return cage;
}

/// What hits are off by, in parts of the extent, but for counts.
struct Figures {
    uint32_t rays = 0, hits = 0, wrong = 0, differ = 0;
    double beside = 0.0, off = 0.0, normal = 0.0;
    std::vector<double> apart; ///< from what the search on the CPU finds

    void sort() { std::sort(apart.begin(), apart.end()); } ///< for median() and largest()
    [[nodiscard]] double median() const { return apart.empty() ? 0.0 : apart[apart.size() / 2]; }
    [[nodiscard]] double largest() const { return apart.empty() ? 0.0 : apart.back(); }
};

/// An instance in a pose, and what rays meet of it.
struct Truth {
    Surfaces surfaces;
    std::vector<glm::vec3> cage;
    double extent = 0.0;
    std::vector<TestRay> rays;
    std::vector<double> nearest;           ///< t in dense triangles
    std::vector<SuppleSurfacePoint> onCpu; ///< what suppleFindPoints finds
    std::vector<SuppleSurfaceJet> jets;    ///< there
};
/// `along`: of the triangles.
Truth truthOf(const Surfaces& surfaces, std::vector<glm::vec3> cage, uint32_t count, uint32_t along) {
    const DenseTriangles dense(surfaces, cage, along);
    Truth truth{surfaces, std::move(cage), dense.extent, {}, {}, {}, {}};
    truth.rays = raysAt(dense, surfaces, truth.cage, count);
    for (const TestRay& ray : truth.rays) {
        truth.nearest.push_back(dense.first(ray));
    }
    SupplePointQuery query = queryOf(SUPPLE_FIND_RAY, count, &truth.rays[0].origin.x);
    query.cage = &truth.cage[0].x;
    query.cageVertexCount = static_cast<uint32_t>(truth.cage.size());
    truth.jets.resize(count);
    query.jets = truth.jets.data();
    truth.onCpu = found(surfaces, query);
    return truth;
}

/// Counts a hit of the device.
void compare(const Truth& truth, const runtime::CpuPose& pose, size_t k, const SuppleHit& hit, Figures& figures) {
    const glm::dvec3 o(truth.rays[k].origin), d(truth.rays[k].direction);
    const double length = glm::length(d);
    ++figures.rays;
    if (hit.group == SUPPLE_NO_HIT) {
        EXPECT_EQ(hit.t, kInfinity);
        EXPECT_EQ(hit.point.face, SUPPLE_NO_FACE);
        figures.wrong += std::isinf(truth.nearest[k]) ? 0 : 1;
        figures.differ += truth.onCpu[k].face != SUPPLE_NO_FACE ? 1 : 0;
        return;
    }
    ++figures.hits;
    // What is met in front of the triangles is right: it lies on the surface and on the ray, and triangles cut corners.
    figures.wrong += (double{hit.t} - truth.nearest[k]) * length > 0.01 * truth.extent ? 1 : 0;
    raise(figures.beside, glm::distance(runtime::vectorAt(hit.position), o + double{hit.t} * d) / truth.extent);
    SuppleSurfaceJet there;
    ASSERT_TRUE(pose.evaluate({&hit.point, 1}, &there, {})) << "face " << hit.point.face;
    raise(figures.off,
          glm::distance(runtime::vectorAt(there.position), runtime::vectorAt(hit.position)) / truth.extent);
    const glm::dvec3 n = glm::normalize(glm::cross(runtime::vectorAt(there.du), runtime::vectorAt(there.dv)));
    raise(figures.normal, glm::distance(n, runtime::vectorAt(hit.normal)));
    EXPECT_EQ(hit.flags, glm::dot(runtime::vectorAt(hit.normal), d) > 0.0 ? uint32_t{SUPPLE_HIT_BACK} : 0u);
    const double t = glm::dot(runtime::vectorAt(truth.jets[k].position) - o, d) / (length * length);
    const double apart = std::abs(t - double{hit.t}) * length / truth.extent;
    if (truth.onCpu[k].face == SUPPLE_NO_FACE || apart > 0.01) {
        ++figures.differ;
    } else {
        figures.apart.push_back(apart);
    }
}

/// The share of rays that may be wrong, where a third of them graze the surface.
constexpr double kMostWrong = 0.004;

void print(SuppleScheme scheme, SuppleMapping mapping, Figures& own) {
    own.sort();
    std::printf("scheme %u %-7s %u of %u wrong, %u others than on the CPU; apart %.1e, at most %.1e; off %.1e, normal "
                "%.1e, beside %.1e\n",
                scheme, mappingName(mapping).c_str(), own.wrong, own.rays, own.differ, own.median(), own.largest(),
                own.off, own.normal, own.beside);
}

class Queries : public CrowdContexts {
    const ValidationGuard guard_;
};

constexpr SuppleScheme kQuerySchemes[] = {SUPPLE_SCHEME_PREP,      SUPPLE_SCHEME_PM,    SUPPLE_SCHEME_CATMULL_CLARK,
                                          SUPPLE_SCHEME_LOOP,      SUPPLE_SCHEME_BLEND, SUPPLE_SCHEME_POLYGONS,
                                          SUPPLE_SCHEME_FRAGMENTS, SUPPLE_SCHEME_CAGE};

/// Poses a character on the device, and compares what rays meet. `truth`: of the first call; cages have the same bits
/// in both mappings.
void compareCharacter(CrowdContext& own, const cage::Character& character, SuppleScheme scheme, uint32_t count,
                      std::optional<Truth>& truth, Figures& figures) {
    Crowd crowd(own, askedGroup(own.createAsset(character), scheme));
    ASSERT_TRUE(crowd.valid());
    AskedPool pool(own, {crowd.group()}, count);
    (void)crowd.spawn(); // out of the way
    const SuppleInstance posed = crowd.spawn();
    crowd.pose(posed, 0, 0.8,
               glm::rotate(glm::translate(glm::mat4(1.0f), {40.0f, -1.0f, 0.5f}), 0.7f, glm::vec3(0.3f, 1.0f, 0.2f)));
    crowd.run();
    const std::vector<glm::vec3> cage = deformedCage(crowd, posed.slot, character.cage.positions.size());
    if (!truth) {
        const Surfaces surfaces = surfacesOf(character, scheme);
        ASSERT_NE(surfaces, nullptr);
        truth = truthOf(surfaces, cage, count, character.cage.faceCount() > 1000 ? 16 : 32);
    }
    ASSERT_EQ(cage, truth->cage);
    const std::vector<SuppleHit> hits = pool.run(raysOf(truth->rays));
    ASSERT_EQ(hits.size(), count);
    runtime::CpuPose pose(truth->surfaces);
    ASSERT_TRUE(pose.build(reinterpret_cast<const std::byte*>(cage.data()), sizeof(cage[0]), {}));
    for (size_t k = 0; k < hits.size(); ++k) {
        EXPECT_TRUE(hits[k].group == SUPPLE_NO_HIT || (hits[k].group == 0 && hits[k].slot == posed.slot));
        compare(*truth, pose, k, hits[k], figures);
    }
    EXPECT_GT(figures.hits, figures.rays / 3);
}

TEST_F(Queries, RaysMeetWhatDenseTrianglesDo) {
    Figures all;
    for (const SuppleScheme scheme : kQuerySchemes) {
        std::optional<Truth> truth;
        for (const SuppleMapping mapping : kMappings) {
            SCOPED_TRACE(mappingName(mapping) + ", scheme " + std::to_string(scheme));
            Figures own;
            compareCharacter(context(mapping), bentTube(), scheme, 200, truth, own);
            print(scheme, mapping, own);
            all.wrong += own.wrong;
            all.differ += own.differ;
            all.rays += own.rays;
            EXPECT_LE(own.off, 2e-5);
            EXPECT_LE(own.beside, 3e-6);
            EXPECT_LE(own.normal, 1e-2);
        }
    }
    EXPECT_LE(all.wrong, kMostWrong * all.rays);
    EXPECT_LE(all.differ, kMostWrong * all.rays);
}

/// The character of the samples, bent by a clip.
TEST_F(Queries, RaysMeetABentCharacter) {
    const cage::Character character = readCharacter(kPipQuads);
    Figures all;
    for (const auto& [scheme, mapping] :
         {std::pair(SUPPLE_SCHEME_PM, SUPPLE_MAPPING_NARROW),
          std::pair(SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_MAPPING_WIDE),
          std::pair(SUPPLE_SCHEME_PREP, SUPPLE_MAPPING_NARROW), std::pair(SUPPLE_SCHEME_LOOP, SUPPLE_MAPPING_NARROW)}) {
        SCOPED_TRACE(mappingName(mapping) + ", scheme " + std::to_string(scheme));
        Figures own;
        std::optional<Truth> truth;
        compareCharacter(context(mapping), character, scheme, 120, truth, own);
        print(scheme, mapping, own);
        all.wrong += own.wrong;
        all.differ += own.differ;
        all.rays += own.rays;
        EXPECT_LE(own.off, 3e-4);
        EXPECT_LE(own.beside, 3e-5);
        EXPECT_LE(own.normal, 5e-2);
    }
    EXPECT_LE(all.wrong, kMostWrong * all.rays);
    EXPECT_LE(all.differ, kMostWrong * all.rays);
}

/// Where the first of some rays begins.
glm::vec3 beside(uint32_t slot) {
    return {0.9f, 3.0f * static_cast<float>(slot) + 0.2f, 9.0f};
}
/// Instances side by side, each before the next ray of rows().
void poseInRow(Crowd& crowd, const std::vector<SuppleInstance>& instances) {
    for (size_t k = 0; k < instances.size(); ++k) {
        crowd.pose(instances[k], 0, 0.2 * static_cast<double>(k),
                   glm::translate(glm::mat4(1.0f), {0.0f, 3.0f * static_cast<float>(k), 0.0f}));
    }
}
/// A ray at each of `count` instances, then one that passes them all.
std::vector<SuppleRay> rows(uint32_t count) {
    std::vector<SuppleRay> rays;
    for (uint32_t k = 0; k < count; ++k) {
        rays.push_back(rayOf(beside(k), {0.0f, 0.0f, -0.5f}));
    }
    rays.push_back(rayOf({0.9f, 50.0f, 9.0f}, {0.0f, 0.0f, -1.0f}));
    return rays;
}
bool haveSameBits(const std::vector<SuppleHit>& a, const std::vector<SuppleHit>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(SuppleHit)) == 0;
}

TEST_F(Queries, SayWhichInstanceOfWhichGroupIsMet) {
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        const SuppleAsset asset = own.createAsset(bentTube());
        Crowd near(own, askedGroup(asset, SUPPLE_SCHEME_CATMULL_CLARK, 4)),
            far(own, askedGroup(asset, SUPPLE_SCHEME_PM, 4));
        AskedPool pool(own, {far.group(), near.group()}, 8);
        std::vector<SuppleInstance> front{near.spawn(), near.spawn()}, back;
        for (uint32_t k = 0; k < 4; ++k) {
            back.push_back(far.spawn());
        }
        poseInRow(near, front);
        for (size_t k = 0; k < back.size(); ++k) {
            far.pose(back[k], 0, 0.0, glm::translate(glm::mat4(1.0f), {0.0f, 3.0f * static_cast<float>(k), -8.0f}));
        }
        const std::vector<SuppleRay> rays = rows(4);
        std::vector<SuppleHit> hits = pool.run(rays);
        const auto expectHit = [&](size_t ray, uint32_t group, uint32_t slot) {
            EXPECT_EQ(hits[ray].group, group) << ray;
            EXPECT_EQ(hits[ray].slot, slot) << ray;
        };
        for (uint32_t k = 0; k < 4; ++k) {
            expectHit(k, k < 2 ? 1 : 0, k);
        }
        EXPECT_EQ(hits[4].group, SUPPLE_NO_HIT);
        near.setVisible(front[0], false);
        hits = pool.run(rays);
        expectHit(0, 0, 0);
        expectHit(1, 1, 1);
        near.setVisible(front[0], true);
        // Between two numbers of t, and in front of nothing.
        hits = pool.run({rayOf(beside(0), {0, 0, -0.5f}, 0.0f, 2.0f), rayOf(beside(0), {0, 0, -0.5f}, 25.0f),
                         rayOf(beside(0), {0, 0, 0.5f}), rayOf(beside(0), {0, 0, -0.5f}, -100.0f)});
        EXPECT_EQ(hits[0].group, SUPPLE_NO_HIT);
        expectHit(1, 0, 0);
        EXPECT_EQ(hits[2].group, SUPPLE_NO_HIT);
        expectHit(3, 1, 0);
        // From inside, it is met from behind.
        hits =
            pool.run({rayOf({0.9f, 0.2f, 0.0f}, {0.0f, 0.0f, 1.0f}), rayOf({0.9f, 0.2f, 5.0f}, {0.0f, 0.0f, -1.0f})});
        EXPECT_EQ(hits[0].flags, uint32_t{SUPPLE_HIT_BACK});
        EXPECT_EQ(hits[1].flags, 0u);
    }
}

/// Rays with numbers that are none meet nothing, and the others are as without them.
TEST_F(Queries, BadRaysMeetNothing) {
    const std::vector<SuppleRay> bad{
        rayOf({kNan, 0.2f, 9.0f}, {0, 0, -1}),          rayOf({kInfinity, 0.2f, 9.0f}, {0, 0, -1}),
        rayOf({0.9f, 0.2f, 9.0f}, {0, 0, 0}),           rayOf({0.9f, 0.2f, 9.0f}, {0, kNan, -1}),
        rayOf({0.9f, 0.2f, 9.0f}, {0, 0, -kInfinity}),  rayOf({0.9f, 0.2f, 9.0f}, {0, 0, -1}, kNan),
        rayOf({0.9f, 0.2f, 9.0f}, {0, 0, -1}, 0, kNan), rayOf({0.9f, 0.2f, 9.0f}, {0, 0, -1}, kInfinity),
        rayOf({0.9f, 0.2f, 9.0f}, {0, 0, -1}, 5, 4),    rayOf({3e38f, 0.2f, 9.0f}, {-3e38f, 0, 0}),
        rayOf({0.9f, 0.2f, 9.0f}, {0, 0, -1e-38f}),     rayOf({0.9f, 0.2f, 9.0f}, {0, 0, -1}, 0, -kInfinity)};
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        Crowd crowd(own, askedGroup(own.createAsset(bentTube()), SUPPLE_SCHEME_PREP));
        AskedPool pool(own, {crowd.group()}, 64);
        poseInRow(crowd, {crowd.spawn(), crowd.spawn()});
        const std::vector<SuppleRay> good = rows(2);
        const std::vector<SuppleHit> alone = pool.run(good);
        std::vector<SuppleRay> mixed;
        for (size_t k = 0; k < bad.size(); ++k) {
            mixed.push_back(bad[k]);
            mixed.push_back(good[k % good.size()]);
        }
        const std::vector<SuppleHit> hits = pool.run(mixed);
        for (size_t k = 0; k < bad.size(); ++k) {
            EXPECT_EQ(hits[2 * k].group, SUPPLE_NO_HIT) << k;
            EXPECT_TRUE(haveSameBits({hits[2 * k + 1]}, {alone[k % good.size()]})) << k;
        }
        EXPECT_EQ(alone[0].group, 0u);
        // Directions of any length.
        for (const float length : {1e-20f, 1e20f}) {
            const std::vector<SuppleHit> scaled = pool.run({rayOf(beside(0), {0, 0, -length})});
            EXPECT_NEAR(scaled[0].t * length / (0.5f * alone[0].t), 1.0f, 1e-5f);
        }
    }
}

/// Rays of the device are those of the host; and hits come frames later.
TEST_F(Queries, TakeRaysOfTheDeviceAndAreReadFramesLater) {
    CrowdContext own(*testDevice(), SUPPLE_MAPPING_AUTO, 3);
    Crowd crowd(own, askedGroup(own.createAsset(bentTube()), SUPPLE_SCHEME_PM));
    AskedPool pool(own, {crowd.group()}, 40);
    poseInRow(crowd, {crowd.spawn(), crowd.spawn(), crowd.spawn()});
    std::vector<SuppleRay> rays;
    while (rays.size() < 40) { // more than a lane looks at at once
        const std::vector<SuppleRay> more = rows(3);
        rays.insert(rays.end(), more.begin(), more.end());
    }
    rays.resize(40);
    const std::vector<SuppleHit> ofHost = pool.run(rays);
    SuppleQueryOutput output{};
    output.structSize = sizeof(output);
    ASSERT_EQ(suppleGetQueryOutput(own.handle(), pool.handle(), &output), SUPPLE_OK);
    EXPECT_EQ(output.rayCount, 40u);
    EXPECT_TRUE(haveSameBits(as<SuppleHit>(crowd.read(output.hits)), ofHost));
    for (size_t k = 0; k + 4 < rays.size(); ++k) {
        EXPECT_TRUE(haveSameBits({ofHost[k]}, {ofHost[k + 4]})) << k;
    }
    // The deformed cage's buffer stands for one of the host's: rays are copied from it.
    const SuppleBufferRange cage = crowd.output().info.deformedCage;
    own.beginFrame();
    SuppleQueryDesc desc = pool.descOf(rays);
    desc.hostRays = nullptr;
    desc.rays = {cage.buffer, cage.offset + 32, 3 * sizeof(SuppleRay), 0};
    desc.rayCount = 3;
    ASSERT_TRUE(own.device().submitAndWait([&](VkCommandBuffer commands) {
        const SuppleGroup group = crowd.group();
        EXPECT_EQ(own.record(commands, {&group, 1}), SUPPLE_OK);
        EXPECT_EQ(suppleRecordQueries(own.handle(), commands, pool.handle(), &desc), SUPPLE_OK);
    }));
    const std::vector<SuppleRay> copied = as<SuppleRay>(crowd.read({cage.buffer, cage.offset + 32, 96, 0}));
    own.beginFrame();
    const std::vector<SuppleHit> ofDevice = pool.read();
    EXPECT_TRUE(haveSameBits(pool.run(copied), ofDevice));

    // Three frames in flight: the newest complete one is read.
    Commands commands(own.device());
    const SuppleGroup group = crowd.group();
    const auto record = [&](uint32_t count) {
        commands.record([&](VkCommandBuffer buffer) {
            EXPECT_EQ(own.record(buffer, {&group, 1}), SUPPLE_OK);
            SuppleQueryDesc batch = pool.descOf(rays);
            batch.rayCount = count;
            EXPECT_EQ(suppleRecordQueries(own.handle(), buffer, pool.handle(), &batch), SUPPLE_OK);
        });
    };
    own.beginFrame();
    record(5);
    commands.submit();
    uint64_t frame = 0;
    EXPECT_EQ(pool.read(&frame).size(), 3u) << "those of run()";
    EXPECT_EQ(frame, own.frame - 2);
    commands.wait();
    own.beginFrame();
    record(7);
    EXPECT_EQ(suppleCancelFrame(own.handle()), SUPPLE_OK);
    own.beginFrame();
    EXPECT_EQ(pool.read(&frame).size(), 5u) << "a cancelled frame has no hits";
    EXPECT_EQ(frame, own.frame - 2);
    SuppleHit one{};
    uint32_t room = 1;
    EXPECT_EQ(suppleReadHits(own.handle(), pool.handle(), &one, &room, nullptr), SUPPLE_INCOMPLETE);
    EXPECT_EQ(room, 5u);
    EXPECT_TRUE(haveSameBits({one}, {ofHost[0]}));
}

/// What the host makes anew or destroys.
TEST_F(Queries, FollowTheirGroups) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const SuppleAsset asset = own.createAsset(bentTube());
    auto first = std::make_unique<Crowd>(own, askedGroup(asset, SUPPLE_SCHEME_PM, 2));
    Crowd second(own, askedGroup(own.createAsset(bentTube()), SUPPLE_SCHEME_CATMULL_CLARK, 2));
    AskedPool pool(own, {first->group(), second.group()}, 8);
    std::vector<SuppleInstance> instances{first->spawn(), first->spawn()};
    poseInRow(*first, instances);
    second.pose(second.spawn(), 0, 0.0, glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, -8.0f}));
    const std::vector<SuppleHit> before = pool.run(rows(3));
    EXPECT_EQ(before[0].group, 0u);
    ASSERT_EQ(suppleSetCapacity(own.handle(), first->group(), 5), SUPPLE_OK);
    instances.push_back(first->spawn());
    poseInRow(*first, instances);
    std::vector<SuppleHit> hits = pool.run(rows(3));
    EXPECT_TRUE(haveSameBits({hits[0], hits[1]}, {before[0], before[1]}));
    EXPECT_EQ(hits[2].slot, 2u);
    ASSERT_EQ(own.reloadAsset(asset, bentTube(6)), SUPPLE_OK);
    hits = pool.run(rows(3));
    for (uint32_t k = 0; k < 3; ++k) {
        EXPECT_EQ(hits[k].slot, k);
        EXPECT_EQ(hits[k].group, 0u);
    }
    EXPECT_FALSE(haveSameBits({hits[0]}, {before[0]}));
    first.reset();
    hits = pool.run(rows(1), {second.group()});
    EXPECT_EQ(hits[0].group, 1u) << "groups keep their numbers";
    second.end();
    own.beginFrame();
    Commands commands(own.device());
    commands.record([&](VkCommandBuffer buffer) {
        const std::vector<SuppleRay> rays = rows(1);
        const SuppleQueryDesc desc = pool.descOf(rays);
        EXPECT_EQ(suppleRecordQueries(own.handle(), buffer, pool.handle(), &desc), SUPPLE_ERROR_ARGUMENT);
        EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_OUT_OF_ORDER);
    });
}

/// No level of detail changes a hit. Who is out of sight is met only if the group poses all.
TEST_F(Queries, MeetGroupsOfViews) {
    const glm::vec3 behind(0.0f, 0.0f, 500.0f); // the camera
    const std::vector<SuppleRay> rays{rayOf(beside(0), {0.0f, 0.0f, -0.5f}),
                                      rayOf(beside(1) + behind, {0.0f, 0.0f, -0.5f})};
    const auto poseBoth = [&](Crowd& crowd) {
        crowd.pose(crowd.spawn(), 0, 0.4, glm::mat4(1.0f));
        crowd.pose(crowd.spawn(), 0, 0.6, glm::translate(glm::mat4(1.0f), behind + glm::vec3(0.0f, 3.0f, 0.0f)));
    };
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        SuppleGroupDesc desc = askedGroup(own.createAsset(bentTube()), SUPPLE_SCHEME_PM, 2);
        Crowd atRate(own, desc);
        AskedPool ofRate(own, {atRate.group()}, 2);
        poseBoth(atRate);
        const std::vector<SuppleHit> wanted = ofRate.run(rays);
        for (uint32_t k = 0; k < 2; ++k) {
            EXPECT_EQ(wanted[k].group, 0u);
            EXPECT_EQ(wanted[k].slot, k);
        }
        for (const bool posesUnseen : {false, true}) {
            SCOPED_TRACE(mappingName(mapping) + (posesUnseen ? ", all are posed" : ""));
            TestView view(own, 1u << 17, SUPPLE_VIEW_CULL);
            desc.view = view.handle();
            desc.flags = posesUnseen ? SUPPLE_GROUP_POSE_UNSEEN : 0;
            Crowd seen(own, desc);
            ASSERT_TRUE(seen.valid());
            AskedPool pool(own, {seen.group()}, 2);
            poseBoth(seen);
            std::vector<uint32_t> vertices;
            for (const float away : {20.0f, 400.0f}) {
                view.look({4.0f, 0.0f, away}, {4.0f, 0.0f, 0.0f}, glm::perspectiveRH_ZO(0.9f, 1.0f, 0.1f, 1000.0f));
                const std::vector<SuppleHit> hits = pool.run(rays);
                EXPECT_TRUE(haveSameBits({hits[0]}, {wanted[0]})) << away;
                EXPECT_EQ(hits[1].group, posesUnseen ? 0u : SUPPLE_NO_HIT) << away;
                EXPECT_EQ(haveSameBits({hits[1]}, {wanted[1]}), posesUnseen) << away;
                EXPECT_EQ(view.statistics().drawnInstanceCount, 1u) << away;
                vertices.push_back(view.statistics().vertexCount);
            }
            EXPECT_LT(vertices[1], vertices[0]) << "the level is another one";
        }
    }
}

/// What a pose mirrors has its normals outside.
TEST_F(Queries, MeetMirroredInstances) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    Crowd crowd(own, askedGroup(own.createAsset(bentTube()), SUPPLE_SCHEME_CATMULL_CLARK));
    AskedPool pool(own, {crowd.group()}, 4);
    crowd.pose(crowd.spawn(), 0, 0.4, glm::scale(glm::mat4(1.0f), {1.0f, 1.0f, -1.0f}));
    const SuppleHit hit = pool.run({rayOf({0.9f, 0.1f, 9.0f}, {0.0f, 0.0f, -1.0f})})[0];
    EXPECT_EQ(hit.group, 0u);
    EXPECT_EQ(hit.flags, 0u);
    EXPECT_GT(hit.normal[2], 0.0f);
}

/// Coordinates that are not finite belong to their instance alone.
TEST_F(Queries, MissInstancesThatAreNotFinite) {
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        const cage::Cage ball = cage::makeCubeSphere(2);
        SuppleGroupDesc desc = askedGroup(own.createAsset(ball), SUPPLE_SCHEME_CAGE, 2);
        desc.poseSource = SUPPLE_POSES_CAGE_BUFFER;
        Crowd crowd(own, desc);
        AskedPool pool(own, {crowd.group()}, 4);
        (void)crowd.spawn(), (void)crowd.spawn();
        std::vector<glm::vec4> cages[2];
        for (const glm::vec3& p : ball.positions) {
            cages[0].emplace_back(kNan, p.y, kInfinity, 1.0f);
            cages[1].emplace_back(p, 1.0f);
        }
        const SuppleBufferRange range = crowd.output().info.deformedCage;
        crowd.run([&](VkCommandBuffer commands) {
            for (size_t slot = 0; slot < 2; ++slot) {
                vkCmdUpdateBuffer(commands, range.buffer,
                                  range.offset + slot * range.stride * crowd.output().info.cageVerticesPerInstance,
                                  cages[slot].size() * sizeof(glm::vec4), cages[slot].data());
            }
        });
        const std::vector<SuppleHit> hits = pool.run({rayOf({0.1f, 0.2f, 9.0f}, {0.0f, 0.0f, -1.0f})});
        EXPECT_EQ(hits[0].group, 0u);
        EXPECT_EQ(hits[0].slot, 1u);
    }
}

/// A triangle that is drawn of an instance, as acceleration structures count it.
struct DrawnTriangle {
    uint32_t geometry = 0, primitive = 0;
    std::array<glm::dvec3, 3> corners{};
};
std::vector<DrawnTriangle> drawnTriangles(const Crowd& crowd, uint32_t slot, uint32_t surface = 0) {
    const SuppleGridOutput grid = crowd.output(surface).grid;
    const SuppleBufferRange stream = crowd.output(surface).streams.vertices;
    const std::vector<std::byte> stored = crowd.slotBytes(stream, slot);
    std::vector<glm::vec3> vertices(stored.size() / stream.stride);
    for (size_t v = 0; v < vertices.size(); ++v) {
        std::memcpy(&vertices[v], &stored[v * stream.stride], sizeof(vertices[v]));
    }
    const std::vector<std::byte> bytes = crowd.read(grid.indices);
    const auto small = as<uint16_t>(bytes);
    const auto large = as<uint32_t>(bytes);
    std::vector<DrawnTriangle> triangles;
    for (uint32_t g = 0; g < grid.drawRangeCount; ++g) {
        const SuppleDrawRange& range = grid.drawRanges[g];
        const bool isMesh = range.domain == SUPPLE_DOMAIN_MESH;
        const uint32_t each = range.indexCount / 3;
        for (uint32_t t = 0; t < each * (isMesh ? 1 : range.patchCount); ++t) {
            DrawnTriangle own{g, t, {}};
            for (uint32_t k = 0; k < 3; ++k) {
                const uint32_t at = range.firstIndex + 3 * (t % each) + k;
                const uint32_t index = grid.indices.stride == 2 ? small[at] : large[at];
                own.corners[k] = vertices[index + (isMesh ? 0 : range.firstVertex + t / each * range.samplesPerPatch)];
            }
            triangles.push_back(own);
        }
    }
    return triangles;
}
/// What a tracer of these triangles says.
SuppleTriangleHit traced(const std::vector<DrawnTriangle>& triangles, const TestRay& ray, uint32_t slot) {
    SuppleTriangleHit hit{SUPPLE_NO_HIT, 0, slot, 0, 0, kInfinity, {}};
    for (const DrawnTriangle& own : triangles) {
        const double t = DenseTriangles::meet(ray, own.corners[0], own.corners[1], own.corners[2]);
        if (t < double{hit.t}) {
            hit = {0, 0, slot, own.geometry, own.primitive, static_cast<float>(t), {}};
        }
    }
    return hit;
}

/// What drawn triangles say is met becomes the points of the surface that rays meet themselves.
TEST_F(Queries, RefineHitsOfTriangles) {
    const cage::Character tube = bentTube();
    struct Case {
        SuppleScheme scheme;
        uint32_t flags;
    };
    for (const auto& [scheme, flags] :
         {Case{SUPPLE_SCHEME_PM, 0}, Case{SUPPLE_SCHEME_CATMULL_CLARK, 0},
          Case{SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_GROUP_INDEXED_MESH}, Case{SUPPLE_SCHEME_LOOP, 0},
          Case{SUPPLE_SCHEME_POLYGONS, 0}, Case{SUPPLE_SCHEME_FRAGMENTS, 0}}) {
        const Surfaces surfaces = surfacesOf(tube, scheme);
        ASSERT_NE(surfaces, nullptr);
        for (const SuppleMapping mapping : kMappings) {
            SCOPED_TRACE(mappingName(mapping) + ", scheme " + std::to_string(scheme));
            CrowdContext& own = context(mapping);
            SuppleGroupDesc desc = askedGroup(own.createAsset(tube), scheme);
            desc.flags = flags;
            desc.rate = 4;
            Crowd crowd(own, desc);
            ASSERT_TRUE(crowd.valid());
            AskedPool pool(own, {crowd.group()}, 80);
            (void)crowd.spawn();
            const SuppleInstance posed = crowd.spawn();
            crowd.pose(posed, 0, 0.8, glm::translate(glm::mat4(1.0f), {0.0f, 30.0f, 0.0f}));
            crowd.run();
            const std::vector<glm::vec3> cage = deformedCage(crowd, posed.slot, tube.cage.positions.size());
            const std::vector<TestRay> rays = raysAt(DenseTriangles(surfaces, cage, 2), surfaces, cage, 80);
            const std::vector<DrawnTriangle> triangles = drawnTriangles(crowd, posed.slot);
            std::vector<SuppleTriangleHit> hardware;
            for (const TestRay& ray : rays) {
                hardware.push_back(traced(triangles, ray, posed.slot));
            }
            const std::vector<SuppleHit> cast = pool.run(raysOf(rays)), hits = pool.run(raysOf(rays), {}, hardware);
            uint32_t met = 0, same = 0;
            for (size_t k = 0; k < hits.size(); ++k) {
                if (hardware[k].group == SUPPLE_NO_HIT) {
                    EXPECT_EQ(hits[k].group, SUPPLE_NO_HIT);
                    continue;
                }
                ++met;
                EXPECT_EQ(hits[k].group, 0u);
                EXPECT_EQ(hits[k].slot, posed.slot);
                const glm::dvec3 d(rays[k].direction);
                EXPECT_LE(glm::distance(runtime::vectorAt(hits[k].position),
                                        glm::dvec3(rays[k].origin) + double{hardware[k].t} * d),
                          1.0);
                same += std::abs(hits[k].t - cast[k].t) * glm::length(d) < 1e-4 ? 1 : 0;
            }
            std::printf("scheme %u %-7s %zu triangles: %u of %u hits are those of cast rays\n", scheme,
                        mappingName(mapping).c_str(), triangles.size(), same, met);
            EXPECT_GT(met, 40u);
            EXPECT_GE(same, met - met / 20); // silhouettes differ
        }
    }
}

/// Two balls of triangles. Catmull-Clark subdivides the first one before it has patches, so these have half the rate.
TEST_F(Queries, RefineHitsOfSurfacesAtOtherRates) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const std::array schemes{SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_LOOP};
    SuppleGroupDesc desc =
        askedGroup(own.createAsset(sideBySide(inTriangles(cage::makeCubeSphere(2)), "ball", 2)), SUPPLE_SCHEME_AUTO);
    desc.rate = 5;
    desc.partSchemes = schemes.data();
    desc.partSchemeCount = 2;
    Crowd crowd(own, desc);
    ASSERT_TRUE(crowd.valid());
    AskedPool pool(own, {crowd.group()}, 1024);
    const SuppleInstance instance = crowd.spawn();
    crowd.pose(instance, SUPPLE_BIND_POSE, 0.0, glm::mat4(1.0f));
    for (const uint32_t rate : {5u, 4u}) {
        ASSERT_EQ(suppleSetRate(own.handle(), crowd.group(), rate), SUPPLE_OK);
        crowd.run();
        ASSERT_NE(crowd.output(0).grid.rates[0].rate, crowd.output(1).grid.rates[0].rate);
        for (uint32_t surface = 0; surface < 2; ++surface) {
            std::vector<SuppleRay> rays;
            std::vector<SuppleTriangleHit> hardware;
            std::vector<glm::dvec3> middles;
            const std::vector<DrawnTriangle> triangles = drawnTriangles(crowd, instance.slot, surface);
            for (size_t k = 0; k < triangles.size(); k += triangles.size() / 500) {
                const auto& [a, b, c] = triangles[k].corners;
                const glm::dvec3 out = glm::normalize(glm::cross(b - a, c - a)), middle = (a + b + c) / 3.0;
                middles.push_back(middle);
                rays.push_back(rayOf(middle + out, -out));
                hardware.push_back(
                    {0, surface, instance.slot, triangles[k].geometry, triangles[k].primitive, 1.0f, {}});
            }
            const std::vector<SuppleHit> hits = pool.run(rays, {}, hardware);
            for (size_t k = 0; k < hits.size(); ++k) {
                ASSERT_EQ(hits[k].group, 0u) << surface << ", rate " << rate << ", triangle " << k;
                EXPECT_LT(glm::distance(runtime::vectorAt(hits[k].position), middles[k]), 0.02) << surface << " " << k;
            }
        }
    }
}

/// Triangles that there are not are nothing that is met.
TEST_F(Queries, RefineNothingOfTrianglesThatAreNone) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    Crowd crowd(own, askedGroup(own.createAsset(bentTube()), SUPPLE_SCHEME_PM));
    AskedPool pool(own, {crowd.group()}, 16);
    poseInRow(crowd, {crowd.spawn()});
    const SuppleRay ray = rows(1)[0];
    const SuppleHit cast = pool.run({ray})[0];
    const std::vector<SuppleTriangleHit> triangles{{SUPPLE_NO_HIT, 0, 0, 0, 0, cast.t, {}},
                                                   {1, 0, 0, 0, 0, cast.t, {}},
                                                   {0, 1, 0, 0, 0, cast.t, {}},
                                                   {0, 0, 3, 0, 0, cast.t, {}},
                                                   {0, 0, UINT32_MAX, 0, 0, cast.t, {}},
                                                   {0, 0, 0, 99, 0, cast.t, {}},
                                                   {0, 0, 0, 0, 1u << 30u, cast.t, {}},
                                                   {0, 0, 0, 0, UINT32_MAX, cast.t, {}},
                                                   {0, 0, 0, 0, 0, kNan, {}},
                                                   {0, 0, 0, 0, 0, kInfinity, {}}};
    std::vector<SuppleRay> rays(triangles.size(), ray);
    for (const SuppleHit& hit : pool.run(rays, {}, triangles)) {
        EXPECT_EQ(hit.group, SUPPLE_NO_HIT);
    }
    rays.assign(1, rayOf({kNan, 0, 0}, {0, 0, -1}));
    EXPECT_EQ(pool.run(rays, {}, {{0, 0, 0, 0, 0, 1.0f, {}}})[0].group, SUPPLE_NO_HIT);
}

/// Until the pieces are uploaded, their group is not met.
TEST_F(Queries, WaitForUploads) {
    CrowdContext own(*testDevice());
    ASSERT_EQ(suppleSetUploadBudget(own.handle(), 4096), SUPPLE_OK);
    Crowd crowd(own, askedGroup(own.createAsset(bentTube()), SUPPLE_SCHEME_CATMULL_CLARK));
    poseInRow(crowd, {crowd.spawn()});
    const auto state = [&] {
        SuppleUploadState state{};
        state.structSize = sizeof(state);
        EXPECT_EQ(suppleGetUploadState(own.handle(), &state), SUPPLE_OK);
        return state;
    };
    for (int frame = 0; frame < 1000 && state().complete == 0; ++frame) {
        crowd.run();
    }
    AskedPool pool(own, {crowd.group()}, 4);
    EXPECT_EQ(state().complete, 0u);
    EXPECT_EQ(pool.run(rows(1))[0].group, SUPPLE_NO_HIT);
    for (int frame = 0; frame < 1000 && state().complete == 0; ++frame) {
        own.beginFrame();
        ASSERT_TRUE(own.device().submitAndWait(
            [&](VkCommandBuffer commands) { EXPECT_EQ(suppleRecordUploads(own.handle(), commands), SUPPLE_OK); }));
    }
    EXPECT_EQ(state().complete, 1u);
    EXPECT_EQ(pool.run(rows(1))[0].group, 0u);
}

/// Pieces of a character: a few a face, most of which have their shares in common.
TEST(QueryPieces, AreFew) {
    for (const auto& [scheme, mostPieces, mostBytes] :
         {std::tuple(SUPPLE_SCHEME_PM, 3u, 1000u), std::tuple(SUPPLE_SCHEME_CATMULL_CLARK, 5u, 1300u),
          std::tuple(SUPPLE_SCHEME_CAGE, 1u, 120u)}) {
        const Surfaces surfaces = surfacesOf(readCharacter(kPipQuads), scheme);
        ASSERT_NE(surfaces, nullptr);
        const auto table = runtime::pieceTable(*surfaces, 1u << 24u);
        ASSERT_TRUE(table.ok());
        const size_t faces = surfaces->cage().faceCount(), bytes = 4 * table->words.size();
        std::printf("scheme %u: %u pieces of %zu faces, %zu bytes\n", scheme, table->pieceCount, faces, bytes);
        EXPECT_LE(table->pieceCount, mostPieces * faces);
        EXPECT_LE(bytes, mostBytes * faces);
        const auto refused = runtime::pieceTable(*surfaces, 1000);
        ASSERT_FALSE(refused.ok());
        EXPECT_EQ(refused.error().code, ErrorCode::limit);
    }
}

} // namespace
} // namespace supple::test
