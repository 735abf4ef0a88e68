// Crease sets under P_m: an instance that gives a set a sharpness has the surface of a file that gives it, in every
// class of patch; previous positions, capacities, reloads and frames that are cancelled; who is refused.
#include "tests/support/crowd.h"
#include "tests/support/drawn_patches.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_gpu.h"
#include "tests/support/side_by_side.h"
#include "tests/support/test_view.h"
#include "tests/support/wrapped_vulkan.h"

#include <gtest/gtest.h>
#include <limits>

namespace supple::test {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr uint32_t kColumns = 6, kRows = 5; ///< of the torus

/// Two loops that do not touch. `first`: the sharpness of the set "first" in the file.
cage::Cage twoLoops(float first, float second) {
    cage::Cage cage = torus(kColumns, kRows);
    cage.creaseSets = {"first", "second"};
    for (uint32_t i = 0; i < kColumns; ++i) {
        const uint32_t a = i * kRows, b = (i + 1) % kColumns * kRows;
        cage.creases.push_back({a, b, first, 0});
        cage.creases.push_back({a + 2, b + 2, second, 1});
    }
    return cage;
}

/// Every edge in one set.
cage::Cage allInOneSet(cage::Cage cage, float sharpness) {
    cage.creaseSets = {"all"};
    cage.creases.clear();
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    for (const cage::Topology::Edge& edge : topology->edges) {
        const uint32_t next = cage::nextCorner(cage, topology->cornerFaces[edge.corner], edge.corner);
        cage.creases.push_back({cage.faceVertices[edge.corner], cage.faceVertices[next], sharpness, 0});
    }
    return cage;
}

cage::Cage withoutSets(cage::Cage cage) {
    cage.creaseSets.clear();
    for (cage::Crease& crease : cage.creases) {
        crease.set = cage::kNone;
    }
    return cage;
}

float farthest(const PositionBits& a, const PositionBits& b) {
    const std::vector<glm::vec3> x = asPositions(a), y = asPositions(b);
    EXPECT_EQ(x.size(), y.size());
    float distance = 0.0f;
    for (size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
        distance = std::max(distance, glm::distance(x[i], y[i]));
    }
    return distance;
}

class CreaseSets : public CrowdContexts {
protected:
    [[nodiscard]] static SuppleGroupDesc desc(SuppleAsset asset, uint32_t capacity, uint32_t flags = 0) {
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.capacity = capacity;
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.rate = 3;
        desc.flags = flags;
        return desc;
    }
    static void set(Crowd& crowd, SuppleInstance instance, uint32_t set, float sharpness) {
        EXPECT_EQ(suppleSetSharpness(crowd.context().handle(), instance, set, sharpness), SUPPLE_OK);
    }
    /// The surface of a cage as it is.
    static PositionBits surfaceOf(CrowdContext& context, const cage::Cage& cage, uint32_t flags = 0) {
        Crowd crowd(context, desc(context.createAsset(withoutSets(cage)), 1, flags));
        EXPECT_TRUE(crowd.valid());
        (void)crowd.spawn();
        crowd.run();
        return crowd.positions(0);
    }
};

TEST_F(CreaseSets, GiveTheSurfaceOfAFileWithThatSharpness) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        for (const uint32_t flags : {0u, uint32_t{SUPPLE_GROUP_INDEXED_MESH}}) {
            if (flags != 0 && mapping != SUPPLE_MAPPING_NARROW) {
                continue;
            }
            Crowd crowd(own, desc(own.createAsset(twoLoops(0.0f, 4.0f)), 4, flags));
            ASSERT_TRUE(crowd.valid());
            const SuppleInstance a = crowd.spawn(), b = crowd.spawn(), c = crowd.spawn(), d = crowd.spawn();
            set(crowd, a, 0, 2.0f);
            set(crowd, b, 0, 1.25f);
            set(crowd, b, 1, 0.5f);
            set(crowd, d, 1, 3.0f);
            set(crowd, d, 1, SUPPLE_FILE_SHARPNESS);
            crowd.run();
            EXPECT_EQ(differences(crowd.positions(a.slot), surfaceOf(own, twoLoops(2.0f, 4.0f), flags)), 0u);
            EXPECT_EQ(differences(crowd.positions(b.slot), surfaceOf(own, twoLoops(1.25f, 0.5f), flags)), 0u);
            // Without a crease other kernels make the smooth fans of the file.
            EXPECT_LE(farthest(crowd.positions(c.slot), surfaceOf(own, twoLoops(0.0f, 4.0f), flags)), 1e-6f);
            EXPECT_EQ(differences(crowd.positions(c.slot), crowd.positions(d.slot)), 0u);
            EXPECT_GT(farthest(crowd.positions(a.slot), crowd.positions(b.slot)), 0.01f);
        }
    }
}

/// Rims, polar fans, triangles and pentagons, boundaries.
TEST_F(CreaseSets, ChangeEveryClassOfPatch) {
    const ValidationGuard guard;
    const std::pair<const char*, cage::Cage> cages[] = {
        {"cube", cube()}, {"capped cylinder", cappedCylinder(6, 3)}, {"pentagons", prism(5)}, {"border", grid(3, 3)}};
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        for (const auto& [name, cage] : cages) {
            Crowd crowd(own, desc(own.createAsset(allInOneSet(cage, 0.0f)), 1));
            ASSERT_TRUE(crowd.valid()) << name;
            const SuppleInstance instance = crowd.spawn();
            for (const float sharpness : {0.0f, 2.3f}) {
                set(crowd, instance, 0, sharpness);
                crowd.run();
                EXPECT_LE(farthest(crowd.positions(0), surfaceOf(own, allInOneSet(cage, sharpness))), 2e-6f)
                    << name << " " << sharpness;
            }
        }
    }
}

/// 0 is smooth, less is rounder, and infinite the polyhedron.
TEST_F(CreaseSets, GoFromRoundToThePolyhedron) {
    const ValidationGuard guard;
    host::Device* device = testDevice();
    cage::Cage cage = allInOneSet(cube(), 0.0f);
    GpuSurface gpu(*device, cage, pmOptions(SUPPLE_MAPPING_NARROW, 4));
    ASSERT_TRUE(gpu.valid());
    float last = 0.0f;
    for (const float sharpness : {SUPPLE_LEAST_SHARPNESS, 0.0f, 1.0f, 4.0f, kInfinite}) {
        ASSERT_EQ(suppleSetSharpness(gpu.context().handle(), gpu.instance(0), 0, sharpness), SUPPLE_OK);
        gpu.evaluate();
        float reach = 0.0f;
        for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
            for (uint32_t s = 0; s < gpu.sampleCount(p); ++s) {
                const GpuSurface::Vertex& vertex = gpu.vertex(0, p, s);
                reach = std::max(reach, glm::length(vertex.position));
                EXPECT_NEAR(glm::length(vertex.normal), 1.0f, 1e-3f) << sharpness;
            }
        }
        EXPECT_GT(reach, last) << sharpness;
        last = reach;
    }
    EXPECT_NEAR(last, glm::length(cage.positions[0]), 1e-3f);
    for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
        const glm::vec3 middle = gpu.vertex(0, p, 2, 2).position;
        EXPECT_NEAR(glm::dot(middle, gpu.vertex(0, p, 2, 2).normal), glm::length(middle), 1e-3f);
    }
}

TEST_F(CreaseSets, BordersAgreeBitForBit) {
    const ValidationGuard guard;
    host::Device* device = testDevice();
    for (const SuppleMapping mapping : kMappings) {
        for (const cage::Cage& given : {cappedCylinder(6, 3), prism(5), gyroBipyramid(6)}) {
            cage::Cage cage = allInOneSet(given, 0.0f);
            for (size_t i = 0; i < cage.creases.size(); i += 2) {
                cage.creases[i].set = cage::kNone;
            }
            GpuSurface gpu(*device, cage, pmOptions(mapping, 7));
            ASSERT_TRUE(gpu.valid());
            ASSERT_EQ(suppleSetSharpness(gpu.context().handle(), gpu.instance(0), 0, 1.7f), SUPPLE_OK);
            gpu.evaluate();
            const Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(cage);
            ASSERT_TRUE(mesh.ok());
            const PmPatches patches(gpu, *mesh);
            ComparedBits bits;
            for (const cage::Topology::Edge& edge : mesh->topology.edges) {
                if (patches.shared(edge)) {
                    bits.add(patches.sharedBits(0, edge));
                }
            }
            EXPECT_GT(bits.samples, 0u);
            EXPECT_EQ(bits.different, 0u);
        }
    }
}

TEST_F(CreaseSets, MoveFromFrameToFrame) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    Crowd crowd(own, desc(own.createAsset(twoLoops(0.0f, 0.0f)), 3, SUPPLE_GROUP_MOTION));
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance still = crowd.spawn(), moved = crowd.spawn();
    crowd.run();
    PositionBits before = crowd.positions(moved.slot);
    for (const float sharpness : {0.5f, 3.0f, kInfinite}) {
        set(crowd, moved, 1, sharpness);
        crowd.run();
        EXPECT_EQ(differences(crowd.previous(moved.slot), before), 0u);
        EXPECT_NE(differences(crowd.positions(moved.slot), before), 0u);
        EXPECT_EQ(differences(crowd.previous(still.slot), crowd.positions(still.slot)), 0u);
        before = crowd.positions(moved.slot);
    }
    // A sharpness that stays is not uploaded again.
    crowd.run();
    const uint64_t usual = own.uploadedFor(crowd.group());
    set(crowd, moved, 1, kInfinite);
    EXPECT_EQ(own.uploadedFor(crowd.group()), usual);
    set(crowd, moved, 1, 0.0f);
    EXPECT_EQ(own.uploadedFor(crowd.group()), usual + 256);
}

TEST_F(CreaseSets, StayUntilTheInstanceIsGone) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const SuppleAsset asset = own.createAsset(twoLoops(0.0f, 0.0f));
    Crowd crowd(own, desc(asset, 2));
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance plain = crowd.spawn(), sharp = crowd.spawn();
    set(crowd, sharp, 0, 2.0f);
    set(crowd, sharp, 1, 5.0f);
    own.cancel(crowd.group()); // what it has uploaded is repeated
    crowd.run();
    const PositionBits first = crowd.positions(sharp.slot), smooth = crowd.positions(plain.slot);
    EXPECT_EQ(differences(first, surfaceOf(own, twoLoops(2.0f, 5.0f))), 0u);
    ASSERT_EQ(suppleSetCapacity(own.handle(), crowd.group(), 5), SUPPLE_OK);
    crowd.run();
    EXPECT_EQ(differences(crowd.positions(sharp.slot), first), 0u);
    crowd.destroy(sharp);
    const SuppleInstance next = crowd.spawn();
    ASSERT_EQ(next.slot, sharp.slot);
    crowd.run();
    EXPECT_EQ(differences(crowd.positions(next.slot), smooth), 0u);
}

TEST_F(CreaseSets, AReloadFindsThemByName) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    cage::Cage cage = twoLoops(0.0f, 0.0f);
    const SuppleAsset asset = own.createAsset(sideBySide(cage, "loops", 1));
    Crowd crowd(own, desc(asset, 1));
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance instance = crowd.spawn();
    set(crowd, instance, 0, 2.0f);
    set(crowd, instance, 1, 5.0f);
    crowd.run();
    const PositionBits first = crowd.positions(0);
    cage.creaseSets = {"second", "first"};
    for (cage::Crease& crease : cage.creases) {
        crease.set = 1 - crease.set;
    }
    ASSERT_EQ(own.reloadAsset(asset, sideBySide(cage, "loops", 1)), SUPPLE_OK);
    crowd.run();
    EXPECT_EQ(differences(crowd.positions(0), first), 0u);
    const char* names[4] = {};
    uint32_t count = 4;
    ASSERT_EQ(suppleGetCreaseSets(own.handle(), asset, names, &count), SUPPLE_OK);
    ASSERT_EQ(count, 2u);
    EXPECT_STREQ(names[1], "first");
    count = 1;
    EXPECT_EQ(suppleGetCreaseSets(own.handle(), asset, names, &count), SUPPLE_INCOMPLETE);
    EXPECT_EQ(count, 2u);
}

/// A device that binds few bytes at a time has the instances in several windows.
TEST_F(CreaseSets, ReachEveryWindow) {
    WrappedVulkan& wrapped = wrappedVulkan();
    for (const SuppleMapping mapping : kMappings) {
        const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
        ASSERT_NE(device, nullptr);
        const PositionBits expected = surfaceOf(context(mapping), twoLoops(2.0f, 5.0f));
        wrapped.maxStorageBufferRange = 1u << 18;
        {
            CrowdContext small(*device, mapping);
            ASSERT_TRUE(small.valid());
            constexpr uint32_t kCapacity = 50;
            Crowd crowd(small, desc(small.createAsset(twoLoops(0.0f, 0.0f)), kCapacity, SUPPLE_GROUP_WINDOWS));
            ASSERT_TRUE(crowd.valid());
            EXPECT_GT(crowd.output().info.windowCount, 1u);
            for (uint32_t i = 0; i < kCapacity; ++i) {
                const SuppleInstance instance = crowd.spawn();
                set(crowd, instance, 0, i % 7 == 6 ? 2.0f : 0.0f);
                set(crowd, instance, 1, i % 7 == 6 ? 5.0f : 0.0f);
            }
            crowd.run();
            for (uint32_t i = 0; i < kCapacity; ++i) {
                EXPECT_EQ(differences(crowd.positions(i), expected) == 0, i % 7 == 6) << i;
            }
        }
        EXPECT_EQ(device->validation()->messageCount(), 0u);
        wrapped.maxStorageBufferRange = 0;
    }
}

TEST_F(CreaseSets, ShowAtTheLevelsOfAView) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const auto drawn = [&](const cage::Cage& cage, float first, float second) {
        TestView view(own, 50000);
        view.look({0.0f, 2.0f, 6.0f});
        SuppleGroupDesc of = desc(own.createAsset(cage), 1);
        of.view = view.handle();
        of.rate = 0;
        Crowd crowd(own, of);
        EXPECT_TRUE(crowd.valid());
        const SuppleInstance instance = crowd.spawn();
        if (!cage.creaseSets.empty()) {
            set(crowd, instance, 0, first);
            set(crowd, instance, 1, second);
        }
        crowd.run();
        return drawnPatches(crowd);
    };
    const DrawnPatches changed = drawn(twoLoops(0.0f, 0.0f), 2.0f, 5.0f);
    EXPECT_EQ(changed.size(), size_t{kColumns * kRows});
    EXPECT_TRUE(changed == drawn(withoutSets(twoLoops(2.0f, 5.0f)), 0.0f, 0.0f));
    EXPECT_FALSE(changed == drawn(withoutSets(twoLoops(0.0f, 0.0f)), 0.0f, 0.0f));
}

TEST_F(CreaseSets, FollowTheCurvesOfClips) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    cage::Character character = sideBySide(twoLoops(1.0f, 1.0f), "loops", 1);
    cage::Channel sway;
    sway.times = {0.0f, 2.0f};
    sway.values = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    cage::Channel keys;
    keys.path = cage::ChannelPath::weights;
    keys.times = {0.0f, 2.0f};
    keys.values = {0.5f, 4.5f};
    character.clips = {{"frown", 2.0, {sway}, {}, {{"second", keys}}}};
    const SuppleAsset asset = own.createAsset(character);
    const auto at = [&](uint32_t set, double time) {
        float sharpness = 99.0f;
        EXPECT_EQ(suppleGetClipSharpness(own.handle(), asset, 0, set, time, &sharpness), SUPPLE_OK);
        return sharpness;
    };
    EXPECT_EQ(at(0, 1.0), SUPPLE_FILE_SHARPNESS);
    EXPECT_EQ(at(1, -1.0), 0.5f);
    EXPECT_EQ(at(1, 1.0), 2.5f);
    EXPECT_EQ(at(1, 9.0), 4.5f);
    Crowd crowd(own, desc(asset, 1));
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance instance = crowd.spawn();
    set(crowd, instance, 0, at(0, 1.0));
    set(crowd, instance, 1, at(1, 1.0));
    crowd.run();
    EXPECT_EQ(differences(crowd.positions(0), surfaceOf(own, twoLoops(1.0f, 2.5f))), 0u);
}

TEST_F(CreaseSets, AreRefusedByName) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const SuppleAsset asset = own.createAsset(twoLoops(1.0f, 2.0f));
    Crowd crowd(own, desc(asset, 1));
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance instance = crowd.spawn();
    const auto refusal = [&](SuppleInstance of, uint32_t set, float sharpness) {
        EXPECT_EQ(suppleSetSharpness(own.handle(), of, set, sharpness), SUPPLE_ERROR_ARGUMENT);
        return own.takeError();
    };
    EXPECT_EQ(refusal(instance, 2, 1.0f), SUPPLE_MESSAGE_OUT_OF_RANGE);
    EXPECT_EQ(refusal(instance, 0, -0.6f), SUPPLE_MESSAGE_OUT_OF_RANGE);
    EXPECT_EQ(refusal(instance, 0, std::numeric_limits<float>::quiet_NaN()), SUPPLE_MESSAGE_NOT_FINITE);
    SuppleGroupDesc other = desc(asset, 1);
    other.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
    Crowd smooth(own, other);
    ASSERT_TRUE(smooth.valid());
    const SuppleInstance there = smooth.spawn();
    EXPECT_EQ(refusal(there, 0, 1.0f), SUPPLE_MESSAGE_CONFLICT);
}

} // namespace
} // namespace supple::test
