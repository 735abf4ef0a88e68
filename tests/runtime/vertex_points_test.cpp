// Points that lie on surface vertices have their positions, to the bit (SUPPLE_POINT_SET_ON_VERTICES).
#include "tests/support/bent_tube.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/test_view.h"
#include "tests/support/worst.h"
#include "tests/support/wrapped_vulkan.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>
#include <set>
#include <string>

namespace supple::test {
namespace {

using Bits = std::array<uint32_t, 3>;

/// A set of points of a group.
class VertexPointSet {
public:
    VertexPointSet(const Crowd& crowd, const std::vector<SuppleSurfacePoint>& points, bool onVertices,
                   SupplePointFormat format = SUPPLE_POINT_FRAME_48)
        : crowd_(crowd) {
        SupplePointSetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.flags = onVertices ? SUPPLE_POINT_SET_ON_VERTICES : 0;
        desc.group = crowd.group();
        desc.points = points.data();
        desc.pointCount = static_cast<uint32_t>(points.size());
        desc.format = format;
        EXPECT_EQ(suppleCreatePointSet(crowd.context().handle(), &desc, &set_), SUPPLE_OK);
    }
    [[nodiscard]] SupplePointSet handle() const { return set_; }
    [[nodiscard]] SupplePointOutput output() const {
        SupplePointOutput output{};
        output.structSize = sizeof(output);
        EXPECT_EQ(suppleGetPointOutput(crowd_.context().handle(), set_, &output), SUPPLE_OK);
        return output;
    }
    [[nodiscard]] std::vector<std::byte> bytes() const { return crowd_.read(output().frames); }
    /// Positions of a slot; `previous`: those in the frame before.
    [[nodiscard]] PositionBits read(uint32_t slot, bool previous = false) const {
        const SupplePointOutput own = output();
        const std::vector<uint32_t> words = as<uint32_t>(bytes());
        const size_t stride = own.frames.stride / 4;
        const bool isFrame = own.format != SUPPLE_POINT_VERTEX_16;
        PositionBits positions;
        for (size_t k = 0; k < own.pointCount; ++k) {
            const uint32_t* const at = &words[(slot * own.pointCount + k) * stride];
            positions.push_back(previous  ? Bits{at[12], at[13], at[14]}
                                : isFrame ? Bits{at[3], at[7], at[11]}
                                          : Bits{at[0], at[1], at[2]});
        }
        return positions;
    }

private:
    const Crowd& crowd_;
    SupplePointSet set_{};
};

/// Points of each face, `along` steps on a side.
std::vector<SuppleSurfacePoint> latticeOf(const cage::Cage& cage, uint32_t alongQuads, uint32_t alongOthers) {
    std::vector<SuppleSurfacePoint> points;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const uint32_t sides = cage.sides(face), along = sides == 4 ? alongQuads : alongOthers;
        for (uint32_t side = 0; side < (sides > 4 ? sides : 1); ++side) {
            for (uint32_t j = 0; j <= along; ++j) {
                for (uint32_t i = 0; i <= (sides == 4 ? along : along - j); ++i) {
                    points.push_back({face, side, static_cast<float>(i) / static_cast<float>(along),
                                      static_cast<float>(j) / static_cast<float>(along)});
                }
            }
        }
    }
    return points;
}

struct VertexUse {
    const char* name;
    SuppleScheme scheme;
    uint32_t flags = 0;
    bool changesRate = true;
};
constexpr VertexUse kVertexUses[] = {{"prep", SUPPLE_SCHEME_PREP},
                                     {"pm", SUPPLE_SCHEME_PM},
                                     {"pm, a mesh", SUPPLE_SCHEME_PM, SUPPLE_GROUP_INDEXED_MESH, false},
                                     {"catmull-clark", SUPPLE_SCHEME_CATMULL_CLARK},
                                     {"loop", SUPPLE_SCHEME_LOOP},
                                     {"blend", SUPPLE_SCHEME_BLEND, 0, false},
                                     {"fragments", SUPPLE_SCHEME_FRAGMENTS, 0, false},
                                     {"polygons", SUPPLE_SCHEME_POLYGONS, 0, false}};

SuppleGroupDesc vertexGroup(SuppleAsset asset, SuppleScheme scheme, uint32_t capacity = 2) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = capacity;
    desc.scheme = scheme;
    desc.rate = 8;
    return desc;
}
glm::mat4 vertexPlace(uint32_t frame) {
    const auto f = static_cast<float>(frame);
    return glm::rotate(glm::translate(glm::mat4(1.0f), {30.0f + 0.2f * f, -1.0f, 0.5f}), 0.7f + 0.1f * f,
                       glm::vec3(0.3f, 1.0f, 0.2f));
}

class VertexPoints : public CrowdContexts {
    const ValidationGuard guard_;
};

double distanceOf(const Bits& a, const Bits& b) {
    const std::vector<glm::vec3> two = asPositions({a, b});
    return glm::distance(glm::dvec3(two[0]), glm::dvec3(two[1]));
}

/// Whether points that have taken over vertices lie where they lie without, and whether all vertices have some.
void expectOnVertices(const Crowd& crowd, const VertexPointSet& set, const VertexPointSet& plain, double extent) {
    const PositionBits drawn = crowd.positions(0), points = set.read(0), stencils = plain.read(0);
    const std::set<Bits> vertices(drawn.begin(), drawn.end());
    ASSERT_EQ(points.size(), stencils.size());
    std::set<Bits> taken;
    double worst = 0.0;
    for (size_t k = 0; k < points.size(); ++k) {
        if (points[k] != stencils[k]) {
            EXPECT_TRUE(vertices.contains(points[k])) << k;
        }
        taken.insert(points[k]);
        raise(worst, distanceOf(points[k], stencils[k]) / extent);
    }
    EXPECT_LE(worst, 1e-6);
    const auto lacking =
        std::count_if(vertices.begin(), vertices.end(), [&](const Bits& v) { return !taken.contains(v); });
    EXPECT_EQ(lacking, 0) << "of " << vertices.size();
}

/// On quads, points on the grid, and those alone, have vertices.
TEST_F(VertexPoints, HaveTheBitsOfVerticesOfQuads) {
    cage::Cage ball = perturbed(cage::makeCubeSphere(2), 0.05f, 3); // eight of its vertices have three faces
    std::vector<SuppleSurfacePoint> points = latticeOf(ball, 12, 12);
    const std::vector<SuppleSurfacePoint> eighths = latticeOf(ball, 8, 8);
    points.insert(points.end(), eighths.begin(), eighths.end());
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        const SuppleAsset asset = own.createAsset(ball);
        for (const VertexUse& use : kVertexUses) {
            SuppleGroupDesc desc = vertexGroup(asset, use.scheme, 1);
            desc.flags = use.flags;
            Crowd crowd(own, desc);
            ASSERT_TRUE(crowd.valid());
            const VertexPointSet set(crowd, points, true), plain(crowd, points, false);
            (void)crowd.spawn();
            for (const uint32_t rate : use.changesRate ? std::vector<uint32_t>{8, 3, 2, 1} : std::vector<uint32_t>{8}) {
                SCOPED_TRACE(mappingName(mapping) + ", " + use.name + ", rate " + std::to_string(rate));
                if (rate != 8) {
                    crowd.setRate(rate);
                }
                crowd.run();
                const uint32_t drawn = use.scheme == SUPPLE_SCHEME_POLYGONS ? 1 : rate;
                const PositionBits vertices = crowd.positions(0), with = set.read(0), without = plain.read(0);
                const std::set<Bits> known(vertices.begin(), vertices.end());
                size_t count = 0;
                for (size_t k = 0; k < points.size(); ++k) {
                    const double u = double{points[k].a} * drawn, v = double{points[k].b} * drawn;
                    const bool isOn = std::abs(u - std::round(u)) < 1e-5 && std::abs(v - std::round(v)) < 1e-5;
                    count += isOn ? 1 : 0;
                    EXPECT_TRUE(isOn ? known.contains(with[k]) : with[k] == without[k]) << "point " << k;
                }
                EXPECT_GE(count, size_t{ball.faceCount()} * (drawn + 1) * (drawn + 1));
                expectOnVertices(crowd, set, plain, 2.0);
            }
        }
    }
}

/// Triangles, pentagons and hexagons, which schemes cut in their own ways.
TEST_F(VertexPoints, HaveTheBitsOfVerticesOfAllPatches) {
    const cage::Cage cages[] = {bentTube().cage, dodecahedron(), prism(6)};
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        for (const cage::Cage& cage : cages) {
            const std::vector<SuppleSurfacePoint> points = latticeOf(cage, 8, 24);
            const SuppleAsset asset = own.createAsset(cage);
            for (const VertexUse& use : {kVertexUses[1], kVertexUses[2], kVertexUses[3]}) {
                SuppleGroupDesc desc = vertexGroup(asset, use.scheme, 1);
                desc.flags = use.flags;
                Crowd crowd(own, desc);
                ASSERT_TRUE(crowd.valid());
                const VertexPointSet set(crowd, points, true), plain(crowd, points, false);
                (void)crowd.spawn();
                for (const uint32_t rate : use.changesRate ? std::vector<uint32_t>{8, 2} : std::vector<uint32_t>{8}) {
                    SCOPED_TRACE(mappingName(mapping) + ", " + use.name + ", rate " + std::to_string(rate) + ", " +
                                 std::to_string(cage.faceCount()) + " faces");
                    if (rate != 8) {
                        crowd.setRate(rate);
                    }
                    crowd.run();
                    expectOnVertices(crowd, set, plain, 4.0);
                }
            }
        }
    }
}

/// All formats; where points were; another capacity, another version of the asset.
TEST_F(VertexPoints, FollowTheirGroup) {
    const cage::Character tube = bentTube();
    const std::vector<SuppleSurfacePoint> points = latticeOf(tube.cage, 4, 4);
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        const SuppleAsset asset = own.createAsset(tube);
        Crowd crowd(own, vertexGroup(asset, SUPPLE_SCHEME_PM));
        const VertexPointSet frames(crowd, points, true, SUPPLE_POINT_FRAME_64),
            small(crowd, points, true, SUPPLE_POINT_VERTEX_16), plain(crowd, points, false, SUPPLE_POINT_FRAME_64);
        const SuppleInstance instances[] = {crowd.spawn(), crowd.spawn()};
        PositionBits before;
        const auto expectFrame = [&](uint32_t frame, bool hasPast) {
            SCOPED_TRACE("frame " + std::to_string(frame));
            crowd.setVisible(instances[0], frame % 3 != 0);
            crowd.pose(instances[0], 0, 0.2, glm::mat4(1.0f));
            crowd.pose(instances[1], 0, 0.1 * frame, vertexPlace(frame));
            crowd.run();
            const PositionBits now = frames.read(1), drawn = crowd.positions(1), stencils = plain.read(1);
            EXPECT_EQ(differences(now, small.read(1)), 0u);
            EXPECT_EQ(differences(frames.read(1, true), hasPast ? before : now), 0u);
            const std::set<Bits> vertices(drawn.begin(), drawn.end());
            for (size_t k = 0; k < now.size(); ++k) {
                EXPECT_TRUE(vertices.contains(now[k])) << k;
                EXPECT_LE(distanceOf(now[k], stencils[k]), 3e-5) << "far from the origin";
            }
            before = now;
        };
        expectFrame(0, false);
        expectFrame(1, true);
        crowd.setRate(4);
        expectFrame(2, true);
        crowd.teleport(instances[1]);
        expectFrame(3, false);
        ASSERT_EQ(suppleSetCapacity(own.handle(), crowd.group(), 9), SUPPLE_OK);
        expectFrame(4, false);
        expectFrame(5, true);
        cage::Character wider = tube;
        for (glm::vec3& p : wider.cage.positions) {
            p.y *= 1.5f;
        }
        ASSERT_EQ(own.reloadAsset(asset, wider), SUPPLE_OK);
        expectFrame(6, false);
    }
}

/// A device that binds few bytes at a time, groups that share dispatches, and groups that give back their memory.
TEST_F(VertexPoints, HaveTheSameBitsHoweverTheGroupIsKept) {
    const cage::Character tube = bentTube();
    const std::vector<SuppleSurfacePoint> points = latticeOf(tube.cage, 2, 2);
    WrappedVulkan& wrapped = wrappedVulkan();
    const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
    ASSERT_NE(device, nullptr);
    constexpr uint32_t kInstances = 12;
    struct Kept {
        SuppleMapping mapping;
        uint32_t flags = 0;
        VkDeviceSize most = 0;
        uint64_t unseenFrames = 0;
    };
    std::vector<std::byte> bits;
    for (const Kept& kept :
         {Kept{SUPPLE_MAPPING_NARROW}, Kept{SUPPLE_MAPPING_WIDE, 0, 1u << 17},
          Kept{SUPPLE_MAPPING_WIDE, SUPPLE_CONTEXT_SHARED_DISPATCHES}, Kept{SUPPLE_MAPPING_NARROW, 0, 0, 2}}) {
        wrapped.maxStorageBufferRange = kept.most;
        CrowdContext own(*device, kept.mapping, 2, kept.flags);
        SuppleGroupDesc desc = vertexGroup(own.createAsset(tube), SUPPLE_SCHEME_PM, kInstances);
        desc.rate = 4;
        desc.flags = kept.most > 0 ? SUPPLE_GROUP_WINDOWS : 0;
        desc.keepUnseenFrames = kept.unseenFrames;
        Crowd crowd(own, desc);
        ASSERT_TRUE(crowd.valid());
        EXPECT_EQ(crowd.output().info.windowCount > 1, kept.most > 0);
        const VertexPointSet set(crowd, points, true, SUPPLE_POINT_FRAME_64);
        std::vector<SuppleInstance> instances;
        for (uint32_t frame = 0; frame < 8; ++frame) {
            for (uint32_t slot = 0; slot < kInstances; ++slot) {
                if (frame == 0) {
                    instances.push_back(crowd.spawn());
                }
                const bool isGone = frame > 0 && frame < 6; // so long that memory goes
                crowd.setVisible(instances[slot], !isGone && (slot + frame) % 4 != 0);
                crowd.pose(instances[slot], 0, 0.01 * slot, vertexPlace(slot + frame));
            }
            own.run(crowd.group());
            if (frame == 5) {
                EXPECT_EQ(crowd.output().info.surfacesGivenBack, kept.unseenFrames > 0 ? 1u : 0u);
            }
        }
        const auto read = device->readBuffer(set.output().frames);
        ASSERT_TRUE(read.ok());
        EXPECT_TRUE(bits.empty() || bits == *read)
            << mappingName(kept.mapping) << ", flags " << kept.flags << ", " << kept.most;
        bits = *read;
    }
    EXPECT_EQ(device->validation()->messageCount(), 0u);
    wrapped.maxStorageBufferRange = 0;
}

TEST_F(VertexPoints, NeedVerticesAtARate) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const SuppleAsset asset = own.createAsset(bentTube());
    const SuppleSurfacePoint point{0, 0, 0.5f, 0.25f};
    SupplePointSetDesc desc{};
    desc.structSize = sizeof(desc);
    desc.flags = SUPPLE_POINT_SET_ON_VERTICES;
    desc.points = &point;
    desc.pointCount = 1;
    const auto expectRefused = [&](const SuppleGroupDesc& group, const char* reason) {
        Crowd crowd(own, group);
        ASSERT_TRUE(crowd.valid());
        desc.group = crowd.group();
        SupplePointSet set{};
        EXPECT_EQ(suppleCreatePointSet(own.handle(), &desc, &set), SUPPLE_ERROR_ARGUMENT);
        EXPECT_EQ(set.id, 0u);
        const std::vector<LogLine> lines = own.takeLines();
        EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [&](const LogLine& line) {
            return line.text.find(reason) != std::string::npos;
        })) << reason;
    };
    expectRefused(vertexGroup(asset, SUPPLE_SCHEME_CAGE), "needs surface vertices at a rate");
    SuppleGroupDesc direct = vertexGroup(asset, SUPPLE_SCHEME_PM);
    direct.flags = SUPPLE_GROUP_DIRECT;
    expectRefused(direct, "needs surface vertices at a rate");
    TestView view(own, 100000, 0);
    SuppleGroupDesc inView = vertexGroup(asset, SUPPLE_SCHEME_POLYGONS);
    inView.view = view.handle();
    expectRefused(inView, "a group of a view");
    desc.format = SUPPLE_POINT_DERIVATIVES_32;
    expectRefused(vertexGroup(asset, SUPPLE_SCHEME_PM), "has no positions");
}

} // namespace
} // namespace supple::test
