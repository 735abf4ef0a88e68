// Large worlds: coordinates that begin near the camera (suppleSetOrigin, suppleSetPosition).
#include "tests/support/crowd.h"
#include "tests/support/drawn_patches.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/sample_assets.h"
#include "tests/support/test_view.h"
#include "tools/common/procedural.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

const std::string kWalker = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb";

class Origin : public CrowdContexts {
protected:
    static void setOrigin(CrowdContext& own, const glm::dvec3& origin) {
        EXPECT_EQ(suppleSetOrigin(own.handle(), glm::value_ptr(origin)), SUPPLE_OK);
    }
    static void setPosition(CrowdContext& own, SuppleInstance instance, const glm::dvec3& position) {
        EXPECT_EQ(suppleSetPosition(own.handle(), instance, glm::value_ptr(position)), SUPPLE_OK);
    }
    void TearDown() override {
        for (const SuppleMapping mapping : kMappings) {
            setOrigin(context(mapping), glm::dvec3(0.0));
        }
    }
};

struct Walked {
    std::vector<glm::vec3> positions, normals;
};

/// Surface vertices of slot 0, in 24 bytes.
Walked walkedOf(const Crowd& crowd) {
    const host::GroupOutput output = crowd.output();
    const std::vector<glm::vec3> all = as<glm::vec3>(crowd.slotBytes(output.streams.vertices, 0));
    Walked walked;
    for (uint32_t v = 0; v < output.grid.vertexCount; ++v) {
        walked.positions.push_back(all[2 * v]);
        walked.normals.push_back(all[2 * v + 1]);
    }
    return walked;
}

struct Apart {
    double distance = 0.0; ///< the greatest, as a part of the extent
    double angle = 0.0;    ///< the greatest between normals, in degrees
    double steep = 0.0;    ///< the share of samples with more than 0.05 degrees
};
Apart apart(const Walked& a, const Walked& b) {
    glm::vec3 low = a.positions[0], high = low;
    double distance = 0.0, angle = 0.0;
    size_t steep = 0;
    for (size_t i = 0; i < a.positions.size(); ++i) {
        low = glm::min(low, a.positions[i]);
        high = glm::max(high, a.positions[i]);
        distance = std::max(distance, glm::length(glm::dvec3(a.positions[i]) - glm::dvec3(b.positions[i])));
        const glm::dvec3 n = glm::normalize(glm::dvec3(a.normals[i])), m = glm::normalize(glm::dvec3(b.normals[i]));
        const double between = glm::degrees(std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m)));
        angle = std::max(angle, between);
        steep += between > 0.05 ? 1 : 0;
    }
    return {distance / glm::length(glm::dvec3(high - low)), angle,
            static_cast<double>(steep) / static_cast<double>(a.positions.size())};
}

/// A character walks away; wherever it is, it is what it was at the origin.
TEST_F(Origin, CharactersDoNotShakeFarAway) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        for (const SuppleScheme scheme :
             {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_FRAGMENTS, SUPPLE_SCHEME_POLYGONS}) {
            for (const SupplePoseSource source : {SUPPLE_POSES_SET, SUPPLE_POSES_PLAYBACK}) {
                SuppleGroupDesc desc{};
                desc.asset = own.asset(kWalker);
                desc.capacity = 1;
                desc.scheme = scheme;
                desc.rate = mapping == SUPPLE_MAPPING_WIDE ? 2 : 4;
                desc.vertexFormat = SUPPLE_VERTEX_24;
                desc.poseSource = source;
                Crowd crowd(own, desc);
                ASSERT_TRUE(crowd.valid());
                const SuppleInstance walker = crowd.spawn();
                if (source == SUPPLE_POSES_SET) {
                    EXPECT_EQ(suppleSetClipPose(own.handle(), walker, 0, 0.3), SUPPLE_OK);
                } else {
                    SupplePlaybackLayer layer{};
                    layer.weight = layer.speed = 1.0f;
                    SupplePlaybackDesc playback{};
                    playback.structSize = sizeof playback;
                    playback.layers = &layer;
                    playback.layerCount = 1;
                    EXPECT_EQ(suppleSetPlayback(own.handle(), walker, &playback), SUPPLE_OK);
                    EXPECT_EQ(suppleSetTime(own.handle(), crowd.group(), 0.3), SUPPLE_OK);
                }
                setOrigin(own, glm::dvec3(0.0));
                crowd.run();
                const Walked home = walkedOf(crowd);
                Apart most;
                for (double away = 0.5; away < 2e5; away *= 3.7) {
                    const glm::dvec3 position(away, 0.3 * away, -0.7 * away), camera(position + glm::dvec3(0, 1.0, 3));
                    setPosition(own, walker, position);
                    setOrigin(own, glm::round(camera)); // as an engine whose cells are a unit wide
                    crowd.run();
                    Walked there = walkedOf(crowd);
                    const glm::vec3 moved(position - glm::round(camera));
                    for (glm::vec3& p : there.positions) {
                        p -= moved;
                    }
                    const Apart now = apart(home, there);
                    most = {std::max(most.distance, now.distance), std::max(most.angle, now.angle),
                            std::max(most.steep, now.steep)};
                    float joint[16];
                    ASSERT_EQ(suppleGetJointTransform(own.handle(), walker, 0, joint), SUPPLE_OK);
                    EXPECT_LT(glm::length(glm::vec3(joint[12], joint[13], joint[14]) - moved), 10.0f);
                }
                std::printf("%s scheme %d source %d: %.2e of the extent, %.4f degrees, %.5f %% above 0.05\n",
                            mappingName(mapping).c_str(), static_cast<int>(scheme), static_cast<int>(source),
                            most.distance, most.angle, 100.0 * most.steep);
                EXPECT_LT(most.distance, 1e-5);
                // At four of its 63,500 samples the derivatives of the limit are within 0.2 degrees of one line.
                const bool limit = scheme == SUPPLE_SCHEME_CATMULL_CLARK || scheme == SUPPLE_SCHEME_FRAGMENTS;
                EXPECT_LT(most.angle, limit ? 0.3 : 0.05);
                EXPECT_LT(most.steep, limit ? 1e-4 : 1e-9);
            }
        }
    }
}

struct OriginCase {
    const char* name;
    SuppleScheme scheme;
    uint32_t flags;
    bool viewed;
};
constexpr OriginCase kOriginCases[] = {
    {"P_m", SUPPLE_SCHEME_PM, 0, false},
    {"p-rep", SUPPLE_SCHEME_PREP, 0, false},
    {"blend", SUPPLE_SCHEME_BLEND, 0, false},
    {"Catmull-Clark", SUPPLE_SCHEME_CATMULL_CLARK, 0, false},
    {"fragments", SUPPLE_SCHEME_FRAGMENTS, 0, false},
    {"polygons", SUPPLE_SCHEME_POLYGONS, 0, false},
    {"indexed mesh", SUPPLE_SCHEME_PM, SUPPLE_GROUP_INDEXED_MESH, false},
    {"P_m in a view", SUPPLE_SCHEME_PM, 0, true},
    {"Catmull-Clark in a view", SUPPLE_SCHEME_CATMULL_CLARK, 0, true},
    {"fragments in a view", SUPPLE_SCHEME_FRAGMENTS, 0, true},
    {"polygons in a view", SUPPLE_SCHEME_POLYGONS, 0, true},
};

/// Positions and previous positions that are drawn of a slot, vertex by vertex.
struct Moved {
    std::vector<glm::vec3> now, before;
};
Moved movedOf(const Crowd& crowd, uint32_t slot) {
    Moved moved;
    const uint32_t stride = crowd.output().streams.vertices.stride / 4;
    const uint32_t words = stride + 3 + (crowd.output().hasLevels() ? 1 : 0);
    for (const auto& [key, corners] : drawnPatches(crowd)) {
        for (size_t c = 0; key.slot == slot && c + words <= corners.size(); c += words) {
            glm::vec3 p, q;
            std::memcpy(&p, &corners[c], sizeof p);
            std::memcpy(&q, &corners[c + stride], sizeof q);
            moved.now.push_back(p);
            moved.before.push_back(q);
        }
    }
    return moved;
}

/// One instance stands still in the world while the origin moves; another one is new with every frame.
TEST_F(Origin, PreviousPositionsFollowIt) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        for (const OriginCase& c : kOriginCases) {
            SCOPED_TRACE(mappingName(mapping) + " " + c.name);
            TestView view(own, 200000, SUPPLE_VIEW_MOTION);
            SuppleGroupDesc desc{};
            desc.asset = own.createAsset(cage::makeCubeSphere(2));
            desc.capacity = 2;
            desc.scheme = c.scheme;
            desc.rate = 4;
            desc.flags = c.viewed ? 0 : SUPPLE_GROUP_MOTION | c.flags;
            desc.view = c.viewed ? view.handle() : SuppleView{};
            Crowd crowd(own, desc);
            ASSERT_TRUE(crowd.valid());
            const SuppleInstance still = crowd.spawn(), young = crowd.spawn();
            const glm::dvec3 place(1000.25, -3.0, 512.5);
            for (uint32_t frame = 0; frame < 4; ++frame) {
                const glm::dvec3 origin = place + glm::dvec3(0.5 * frame, 1.0, -0.25 * (frame * frame));
                setOrigin(own, origin);
                setPosition(own, still, place);
                setPosition(own, young, place + glm::dvec3(3, 0, 0));
                crowd.teleport(young);
                view.look(glm::vec3(place - origin) + glm::vec3(0, 0, 6));
                crowd.run();
                const Moved stood = movedOf(crowd, still.slot), came = movedOf(crowd, young.slot);
                ASSERT_FALSE(stood.now.empty());
                ASSERT_FALSE(came.now.empty());
                EXPECT_EQ(std::memcmp(came.now.data(), came.before.data(), came.now.size() * sizeof(glm::vec3)), 0)
                    << "new instances do not move";
                float worst = 0.0f;
                for (size_t i = 0; i < stood.now.size(); ++i) {
                    worst = std::max(worst, glm::length(stood.now[i] - stood.before[i]));
                }
                EXPECT_LT(worst, 1e-5f) << "frame " << frame << ": it moves with the origin";
            }
        }
    }
}

TEST_F(Origin, PlacesTheSlotsInUseAnew) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    SuppleGroupDesc desc{};
    desc.asset = own.asset(kWalker);
    desc.scheme = SUPPLE_SCHEME_CAGE;
    desc.poseSource = SUPPLE_POSES_PLAYBACK;
    uint64_t uploaded[2] = {};
    for (const bool large : {false, true}) {
        desc.capacity = large ? 60 : 2;
        Crowd crowd(own, desc);
        ASSERT_TRUE(crowd.valid());
        (void)crowd.spawn();
        (void)crowd.spawn();
        EXPECT_EQ(suppleSetTime(own.handle(), crowd.group(), 0.5), SUPPLE_OK);
        crowd.run();
        crowd.run(); // what was new is listed anew
        EXPECT_EQ(own.uploadedFor(crowd.group()), 0u);
        setOrigin(own, {large ? 3.0 : 2.0, 0, 0});
        uploaded[large ? 1 : 0] = own.uploadedFor(crowd.group());
    }
    EXPECT_GT(uploaded[0], 0u);
    EXPECT_EQ(uploaded[1], uploaded[0]) << "and of a large capacity no more";
}

TEST_F(Origin, IsOneInAllOfAFrame) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_NARROW);
    ASSERT_TRUE(own.valid());
    SuppleGroupDesc desc{};
    desc.asset = own.createAsset(cage::makeCubeSphere(2));
    desc.capacity = 1;
    desc.rate = 2;
    Crowd crowds[] = {{own, desc}, {own, desc}};
    ASSERT_TRUE(crowds[0].valid() && crowds[1].valid());
    const SuppleInstance instance = crowds[0].spawn();
    (void)crowds[1].spawn();
    (void)own.takeLines();
    const double endless[3] = {0, NAN, 0};
    EXPECT_EQ(suppleSetOrigin(own.handle(), endless), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleSetOrigin(own.handle(), nullptr), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleSetPosition(own.handle(), instance, endless), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleSetPosition(own.handle(), instance, nullptr), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(own.takeLines().size(), 4u);

    Commands commands(own.device());
    own.beginFrame();
    setOrigin(own, {7, 0, 0});
    commands.record([&](VkCommandBuffer buffer) {
        const SuppleGroup groups[] = {crowds[0].group(), crowds[1].group()};
        EXPECT_EQ(own.CrowdContext::record(buffer, {&groups[0], 1}), SUPPLE_OK);
        setOrigin(own, {9, 0, 0}); // of the next frame
        EXPECT_EQ(own.CrowdContext::record(buffer, {&groups[1], 1}), SUPPLE_OK);
    });
    commands.submit();
    commands.wait();
    for (Crowd& crowd : crowds) {
        crowd.read();
    }
    EXPECT_EQ(differences(crowds[0].positions(0), crowds[1].positions(0)), 0u);
    const float before = asPositions(crowds[0].positions(0))[0].x;
    crowds[0].run();
    EXPECT_FLOAT_EQ(asPositions(crowds[0].positions(0))[0].x, before - 2.0f);
}

} // namespace
} // namespace supple::test
