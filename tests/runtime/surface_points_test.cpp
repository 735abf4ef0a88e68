// Points of surfaces on the device: where they are, how they are turned, where they were; groups that are made anew.
#include "tests/support/bent_tube.h"
#include "tests/support/cpu_group.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/recordings.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/test_view.h"
#include "tests/support/worst.h"
#include "tests/support/wrapped_vulkan.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <random>
#include <supple/supple.hpp>

namespace supple::test {
namespace {

/// Anywhere in all faces, on edges and corners too.
std::vector<SuppleSurfacePoint> pointsOf(const cage::Cage& cage, uint32_t perFace) {
    std::mt19937 random(7);
    const auto number = [&] { return static_cast<float>(random() % 9) / 8.0f; };
    std::vector<SuppleSurfacePoint> points;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        for (uint32_t k = 0; k < perFace; ++k) {
            SuppleSurfacePoint point{face, 0, number(), number()};
            if (cage.sides(face) != 4 && point.a + point.b > 1.0f) {
                point.a = 1.0f - point.a;
                point.b = 1.0f - point.b;
            }
            point.side = cage.sides(face) > 4 ? static_cast<uint32_t>(random() % cage.sides(face)) : 0;
            points.push_back(point);
        }
    }
    return points;
}

/// What a frame of 48 bytes or 64 says.
struct PointOnDevice {
    glm::vec3 tangent, bitangent, normal, position, previous{0.0f};
    float area = 0.0f;
};

class PointSetOf {
public:
    PointSetOf(const Crowd& crowd, const std::vector<SuppleSurfacePoint>& points, SupplePointFormat format,
               const std::vector<glm::vec3>& tangents = {})
        : crowd_(crowd) {
        SupplePointSetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.group = crowd.group();
        desc.points = points.data();
        desc.pointCount = static_cast<uint32_t>(points.size());
        desc.tangents = tangents.empty() ? nullptr : &tangents[0].x;
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
    [[nodiscard]] std::vector<std::byte> bytes(uint32_t slot) const {
        const SupplePointOutput own = output();
        const std::vector<std::byte> all = crowd_.read(own.frames);
        const size_t size = size_t{own.pointCount} * own.frames.stride;
        return {all.begin() + static_cast<ptrdiff_t>(slot * size),
                all.begin() + static_cast<ptrdiff_t>((slot + 1) * size)};
    }
    [[nodiscard]] std::vector<PointOnDevice> read(uint32_t slot) const {
        const std::vector<glm::vec4> rows = as<glm::vec4>(bytes(slot));
        const size_t stride = output().frames.stride / 16;
        std::vector<PointOnDevice> points;
        for (size_t r = 0; r + stride <= rows.size(); r += stride) {
            PointOnDevice p;
            for (int axis = 0; axis < 3; ++axis) {
                const glm::vec4& row = rows[r + static_cast<size_t>(axis)];
                p.tangent[axis] = row.x, p.bitangent[axis] = row.y, p.normal[axis] = row.z, p.position[axis] = row.w;
            }
            if (stride == 4) {
                p.previous = glm::vec3(rows[r + 3]);
                p.area = rows[r + 3].w;
            }
            points.push_back(p);
        }
        return points;
    }

private:
    const Crowd& crowd_;
    SupplePointSet set_{};
};

SuppleGroupDesc groupOf(SuppleAsset asset, SuppleScheme scheme, uint32_t capacity = 3) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = capacity;
    desc.scheme = scheme;
    desc.rate = 3;
    return desc;
}

glm::mat4 placeOf(uint32_t slot, uint32_t frame = 0) {
    const auto s = static_cast<float>(slot), f = static_cast<float>(frame);
    return glm::rotate(glm::translate(glm::mat4(1.0f), {3.0f * s + 0.2f * f, -s, 0.5f}), 0.4f * s + 0.1f * f,
                       glm::vec3(0.3f, 1.0f, 0.2f));
}

/// The deformed cage of a slot, as the device left it.
std::vector<glm::vec3> cageOf(const Crowd& crowd, uint32_t slot, uint32_t vertices) {
    const std::vector<glm::vec4> all = as<glm::vec4>(crowd.slotBytes(crowd.output().info.deformedCage, slot));
    std::vector<glm::vec3> cage;
    for (uint32_t v = 0; v < vertices; ++v) {
        cage.emplace_back(all[v]);
    }
    return cage;
}

glm::dvec3 vectorOf(const float* v) {
    return {v[0], v[1], v[2]};
}

class SurfacePoints : public CrowdContexts {};

constexpr SuppleScheme kPointSchemes[] = {SUPPLE_SCHEME_PREP,     SUPPLE_SCHEME_PM,   SUPPLE_SCHEME_CATMULL_CLARK,
                                          SUPPLE_SCHEME_BLEND,    SUPPLE_SCHEME_LOOP, SUPPLE_SCHEME_POLYGONS,
                                          SUPPLE_SCHEME_FRAGMENTS};

/// Against the evaluators on the CPU, of the cage as the device has deformed it.
TEST_F(SurfacePoints, LieOnTheSurfaceAndTurnWithIt) {
    const cage::Character tube = bentTube();
    const std::vector<SuppleSurfacePoint> all = pointsOf(tube.cage, 3);
    for (const SuppleScheme scheme : kPointSchemes) {
        std::vector<SuppleSurfacePoint> points;
        std::copy_if(all.begin(), all.end(), std::back_inserter(points), [&](const SuppleSurfacePoint& p) {
            return scheme != SUPPLE_SCHEME_POLYGONS || (p.a != p.b && p.a + p.b != 1.0f); // not on a diagonal
        });
        CpuOptions options;
        options.scheme = scheme;
        CpuGroup surface(tube.cage, options);
        ASSERT_TRUE(surface.valid());
        ASSERT_EQ(surface.build(tube.cage.positions), SUPPLE_OK);
        const std::vector<SuppleSurfaceJet> bind = surface.at(points);
        for (const SuppleMapping mapping : kMappings) {
            SCOPED_TRACE(mappingName(mapping) + ", scheme " + std::to_string(scheme));
            CrowdContext& own = context(mapping);
            Crowd crowd(own, groupOf(own.createAsset(tube), scheme));
            ASSERT_TRUE(crowd.valid());
            const PointSetOf set(crowd, points, SUPPLE_POINT_FRAME_64),
                derivatives(crowd, points, SUPPLE_POINT_DERIVATIVES_32);
            for (uint32_t slot = 0; slot < 3; ++slot) {
                crowd.pose(crowd.spawn(), 0, 0.4 * slot, placeOf(slot));
            }
            crowd.run();
            double position = 0.0, normal = 0.0, tangent = 0.0, area = 0.0;
            for (uint32_t slot = 0; slot < 3; ++slot) {
                const auto vertices = static_cast<uint32_t>(tube.cage.positions.size());
                ASSERT_EQ(surface.build(cageOf(crowd, slot, vertices)), SUPPLE_OK);
                const std::vector<SuppleSurfaceJet> jets = surface.at(points);
                const std::vector<PointOnDevice> read = set.read(slot);
                const std::vector<glm::vec4> slopes = as<glm::vec4>(derivatives.bytes(slot));
                ASSERT_EQ(read.size(), points.size());
                ASSERT_EQ(slopes.size(), 2 * points.size());
                for (size_t k = 0; k < points.size(); ++k) {
                    const glm::dvec3 du = vectorOf(jets[k].du), dv = vectorOf(jets[k].dv);
                    const glm::dvec3 du0 = vectorOf(bind[k].du), dv0 = vectorOf(bind[k].dv);
                    const glm::dvec3 n = glm::normalize(glm::cross(du, dv)), n0 = glm::cross(du0, dv0);
                    raise(tangent, glm::distance(glm::dvec3(slopes[2 * k]), du) / glm::length(du));
                    raise(tangent, glm::distance(glm::dvec3(slopes[2 * k + 1]), dv) / glm::length(dv));
                    raise(position, glm::distance(glm::dvec3(read[k].position), vectorOf(jets[k].position)) / 8.0);
                    raise(normal, glm::distance(glm::dvec3(read[k].normal), n));
                    raise(area, std::abs(read[k].area / (glm::length(glm::cross(du, dv)) / glm::length(n0)) - 1.0));
                    // t0 = du0 / |du0| and b0 = n0 x t0, carried along.
                    const glm::dvec3 t0 = glm::normalize(du0), b0 = glm::cross(glm::normalize(n0), t0);
                    const double shear = glm::dot(dv0, t0), across = glm::dot(dv0, b0);
                    const glm::dvec3 a = du / glm::length(du0), b = (dv - shear * a) / across;
                    raise(tangent, glm::distance(glm::dvec3(read[k].tangent), glm::normalize(a + glm::cross(b, n))));
                    EXPECT_EQ(read[k].previous, read[k].position) << "new points have no past";
                }
            }
            std::printf("scheme %u %-7s position %.1e of the extent, normal %.1e, tangent %.1e, area %.1e\n", scheme,
                        mappingName(mapping).c_str(), position, normal, tangent, area);
            EXPECT_LE(position, 1e-6);
            EXPECT_LE(normal, 2e-5);
            EXPECT_LE(tangent, 2e-5);
            EXPECT_LE(area, 5e-5);
        }
    }
}

/// Of each surface vertex of a group of quads, in their order: where on the cage it is.
std::vector<SuppleSurfacePoint> pointsOfVertices(const Crowd& crowd, const cage::Cage& cage) {
    const SuppleGridOutput& grid = crowd.output().grid;
    uint32_t count = crowd.output().surface.patchCount;
    std::vector<SupplePatchInfo> patches(count);
    EXPECT_EQ(suppleGetPatches(crowd.context().handle(), crowd.group(), 0, patches.data(), &count), SUPPLE_OK);
    std::vector<SuppleSurfacePoint> points;
    const auto step = 1.0f / static_cast<float>(grid.rate);
    const glm::vec2 places[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}; // of corners
    for (const SupplePatchInfo& patch : patches) {
        EXPECT_EQ(patch.cornerCount, 4u);
        const auto placeOfCorner = [&](uint32_t corner) {
            const auto first = cage.faceVertices.begin() + cage.faceStarts[patch.face];
            return places[(std::find(first, first + 4, patch.corners[corner]) - first) % 4];
        };
        const glm::vec2 from = placeOfCorner(0), u = placeOfCorner(1) - from, v = placeOfCorner(3) - from;
        for (uint32_t j = 0; j <= grid.rate; ++j) {
            for (uint32_t i = 0; i <= grid.rate; ++i) {
                const glm::vec2 at = from + step * (static_cast<float>(i) * u + static_cast<float>(j) * v);
                points.push_back({patch.face, 0, at.x, at.y});
            }
        }
    }
    return points;
}

/// Points that are put where the vertices of the surface are lie there.
TEST_F(SurfacePoints, LieOnDrawnVertices) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    cage::Character ball;
    ball.cage = perturbed(cage::makeCubeSphere(2), 0.05f, 3); // eight of its vertices have three faces
    for (const cage::Character& character : {bentTube(), ball}) {
        const cage::Cage& cage = character.cage;
        const std::vector<glm::dvec3> rest(cage.positions.begin(), cage.positions.end());
        for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK}) {
            const SuppleAsset asset = character.clips.empty() ? own.createAsset(cage) : own.createAsset(character);
            SuppleGroupDesc desc = groupOf(asset, scheme, 1);
            desc.rate = 4;
            Crowd crowd(own, desc);
            ASSERT_TRUE(crowd.valid());
            const PointSetOf set(crowd, pointsOfVertices(crowd, cage), SUPPLE_POINT_FRAME_48);
            const SuppleInstance instance = crowd.spawn();
            if (crowd.clipCount() > 0) {
                crowd.pose(instance, 0, 0.7, placeOf(1));
            }
            crowd.run();
            const std::vector<glm::vec3> vertices = asPositions(crowd.positions(0));
            const std::vector<PointOnDevice> points = set.read(0);
            ASSERT_EQ(vertices.size(), size_t{cage.faceCount()} * 25);
            ASSERT_EQ(points.size(), vertices.size());
            double worst = 0.0;
            for (size_t k = 0; k < points.size(); ++k) {
                raise(worst, glm::distance(glm::dvec3(points[k].position), glm::dvec3(vertices[k])) / extent(rest));
            }
            std::printf("scheme %u: %zu points within %.1e of the extent\n", scheme, points.size(), worst);
            EXPECT_LE(worst, 1e-6);
        }
    }
}

/// Frames are orthonormal, and both mappings have the same bits in every format.
TEST_F(SurfacePoints, HaveTheSameBitsInBothMappings) {
    const cage::Character tube = bentTube();
    const std::vector<SuppleSurfacePoint> points = pointsOf(tube.cage, 4);
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_CAGE}) {
        for (const SupplePointFormat format :
             {SUPPLE_POINT_FRAME_48, SUPPLE_POINT_FRAME_64, SUPPLE_POINT_VERTEX_16, SUPPLE_POINT_DERIVATIVES_32}) {
            std::vector<std::byte> bits[2];
            for (size_t m = 0; m < 2; ++m) {
                CrowdContext& own = context(kMappings[m]);
                Crowd crowd(own, groupOf(own.createAsset(tube), scheme));
                const PointSetOf set(crowd, points, format), frames(crowd, points, SUPPLE_POINT_FRAME_48);
                crowd.pose(crowd.spawn(), 0, 0.7, placeOf(1));
                crowd.run();
                bits[m] = set.bytes(0);
                for (const PointOnDevice& p : frames.read(0)) {
                    const glm::dmat3 frame(p.tangent, p.bitangent, p.normal);
                    const glm::dmat3 product = glm::transpose(frame) * frame;
                    for (int i = 0; i < 3; ++i) {
                        for (int j = 0; j < 3; ++j) {
                            EXPECT_NEAR(product[i][j], i == j ? 1.0 : 0.0, 5e-7);
                        }
                    }
                }
                if (format == SUPPLE_POINT_VERTEX_16) {
                    const std::vector<glm::vec4> vertices = as<glm::vec4>(bits[m]);
                    const std::vector<PointOnDevice> read = frames.read(0);
                    ASSERT_EQ(vertices.size(), read.size());
                    for (size_t k = 0; k < read.size(); ++k) {
                        EXPECT_EQ(glm::vec3(vertices[k]), read[k].position);
                        const glm::vec3 normal = decodeOctahedral(std::bit_cast<uint32_t>(vertices[k].w));
                        EXPECT_LE(glm::distance(normal, read[k].normal), 1e-4f) << "two numbers of 16 bits";
                    }
                }
            }
            EXPECT_TRUE(bits[0] == bits[1]) << "scheme " << scheme << ", format " << format;
        }
    }
}

/// Where points were: of instances that are new, teleported, hidden and shown again, and of an origin that moves.
TEST_F(SurfacePoints, KnowWhereTheyWere) {
    const cage::Character tube = bentTube();
    const std::vector<SuppleSurfacePoint> points = pointsOf(tube.cage, 1);
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        CrowdContext& own = context(mapping);
        Crowd crowd(own, groupOf(own.createAsset(tube), SUPPLE_SCHEME_PM));
        const PointSetOf set(crowd, points, SUPPLE_POINT_FRAME_64);
        std::vector<SuppleInstance> instances{crowd.spawn(), crowd.spawn()};
        std::vector<std::vector<PointOnDevice>> before;
        const auto frame = [&](uint32_t number, bool firstHasPast, bool secondHasPast, const glm::vec3& step = {}) {
            SCOPED_TRACE("frame " + std::to_string(number));
            for (uint32_t slot = 0; slot < 2; ++slot) {
                crowd.pose(instances[slot], 0, 0.1 * number, placeOf(slot, number));
            }
            crowd.run();
            std::vector<std::vector<PointOnDevice>> now{set.read(0), set.read(1)};
            for (uint32_t slot = 0; slot < 2; ++slot) {
                const bool past = slot == 0 ? firstHasPast : secondHasPast;
                for (size_t k = 0; k < points.size(); ++k) {
                    const glm::vec3 expected = past ? before[slot][k].position - step : now[slot][k].position;
                    EXPECT_EQ(now[slot][k].previous, expected) << "slot " << slot;
                }
            }
            before = std::move(now);
        };
        frame(0, false, false);
        frame(1, true, true);
        crowd.teleport(instances[1]);
        frame(2, true, false);
        frame(3, true, true);
        own.cancel(crowd.group()); // a frame that never runs
        frame(4, false, false);
        frame(5, true, true);
        const double origin[3] = {0.5, -2.0, 1.0};
        ASSERT_EQ(suppleSetOrigin(own.handle(), origin), SUPPLE_OK);
        frame(6, true, true, {0.5f, -2.0f, 1.0f});
        const double back[3] = {0.0, 0.0, 0.0};
        ASSERT_EQ(suppleSetOrigin(own.handle(), back), SUPPLE_OK);
        frame(7, true, true, {-0.5f, 2.0f, -1.0f});
        // A hidden instance keeps what it had, and comes back without a past.
        crowd.setVisible(instances[1], false);
        crowd.run();
        EXPECT_EQ(set.read(1)[0].position, before[1][0].position);
        before[0] = set.read(0);
        crowd.setVisible(instances[1], true);
        frame(8, true, false);
    }
}

/// What a pose mirrors: the normal points outwards still, and the matrix is a mirror.
TEST_F(SurfacePoints, AreMirroredWithTheirInstances) {
    const cage::Character tube = bentTube();
    const std::vector<SuppleSurfacePoint> points = pointsOf(tube.cage, 1);
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    Crowd crowd(own, groupOf(own.createAsset(tube), SUPPLE_SCHEME_CATMULL_CLARK));
    const PointSetOf set(crowd, points, SUPPLE_POINT_FRAME_48);
    const glm::mat4 mirror = glm::scale(glm::mat4(1.0f), {1.0f, 1.0f, -1.0f});
    crowd.pose(crowd.spawn(), 0, 0.3, glm::mat4(1.0f));
    crowd.pose(crowd.spawn(), 0, 0.3, mirror);
    crowd.run();
    const std::vector<PointOnDevice> plain = set.read(0), mirrored = set.read(1);
    for (size_t k = 0; k < points.size(); ++k) {
        const auto expectMirrored = [&](const glm::vec3& from, const glm::vec3& to) {
            EXPECT_LE(glm::distance(glm::vec3(mirror * glm::vec4(from, 0.0f)), to), 1e-5f);
        };
        expectMirrored(plain[k].position, mirrored[k].position);
        expectMirrored(plain[k].tangent, mirrored[k].tangent);
        expectMirrored(plain[k].bitangent, mirrored[k].bitangent);
        expectMirrored(plain[k].normal, mirrored[k].normal);
    }
}

/// A tangent that the host gives is where it was put, and shear turns it by half.
TEST_F(SurfacePoints, KeepTheirTangents) {
    cage::Cage plane;
    plane.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    plane.faceStarts = {0, 4};
    plane.faceVertices = {0, 1, 2, 3};
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    SuppleGroupDesc desc = groupOf(own.createAsset(plane), SUPPLE_SCHEME_CAGE);
    desc.poseSource = SUPPLE_POSES_CAGE_BUFFER;
    Crowd crowd(own, desc);
    const PointSetOf set(crowd, {{0, 0, 0.25f, 0.5f}}, SUPPLE_POINT_FRAME_64, {{0.0f, 2.0f, 5.0f}});
    (void)crowd.spawn();
    const auto frame = [&](const std::vector<glm::vec4>& cage) {
        const SuppleBufferRange range = crowd.output().info.deformedCage;
        crowd.run([&](VkCommandBuffer commands) {
            vkCmdUpdateBuffer(commands, range.buffer, range.offset, cage.size() * sizeof(glm::vec4), cage.data());
        });
        return set.read(0)[0];
    };
    const auto expectFrame = [](const PointOnDevice& p, const glm::vec3& tangent, const glm::vec3& normal) {
        EXPECT_LE(glm::distance(p.tangent, tangent), 1e-6f);
        EXPECT_LE(glm::distance(p.normal, normal), 1e-6f);
        EXPECT_LE(glm::distance(p.bitangent, glm::cross(normal, tangent)), 1e-6f);
    };
    const PointOnDevice rest = frame({{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}});
    expectFrame(rest, {0, 1, 0}, {0, 0, 1});
    EXPECT_EQ(rest.position, glm::vec3(0.25f, 0.5f, 0.0f));
    EXPECT_NEAR(rest.area, 1.0f, 1e-6f);
    // x += y: the nearest rotation is by atan(1 / 2).
    const float angle = std::atan(0.5f);
    const PointOnDevice sheared = frame({{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 1, 0, 1}, {1, 1, 0, 1}});
    expectFrame(sheared, {std::sin(angle), std::cos(angle), 0}, {0, 0, 1});
    EXPECT_NEAR(frame({{0, 0, 0, 1}, {2, 0, 0, 1}, {2, 3, 0, 1}, {0, 3, 0, 1}}).area, 6.0f, 1e-5f);
    // What has no plane has a frame all the same.
    for (const std::vector<glm::vec4>& flat :
         {std::vector<glm::vec4>(4, glm::vec4(2, 3, 4, 1)),
          std::vector<glm::vec4>{{0, 0, 0, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}, {0, 0, 0, 1}}}) {
        const PointOnDevice p = frame(flat);
        EXPECT_NEAR(glm::length(p.tangent), 1.0f, 1e-6f);
        EXPECT_NEAR(glm::length(p.normal), 1.0f, 1e-6f);
        EXPECT_LE(glm::distance(p.bitangent, glm::cross(p.normal, p.tangent)), 1e-6f);
        EXPECT_NEAR(glm::dot(p.normal, p.tangent), 0.0f, 1e-6f);
        EXPECT_EQ(p.area, 0.0f);
    }
    // A sliver has one, however thin it is.
    for (const float width : {1e-2f, 1e-4f, 1e-5f, 1e-6f}) {
        const glm::vec3 a(1.0f, 0.7f, 0.3f), b = 1.1f * a + width * glm::vec3(-0.5f, 0.2f, 0.9f);
        const PointOnDevice p = frame({glm::vec4(0, 0, 0, 1), glm::vec4(a, 1), glm::vec4(a + b, 1), glm::vec4(b, 1)});
        EXPECT_NEAR(glm::length(p.tangent), 1.0f, 1e-6f) << width;
        EXPECT_NEAR(glm::length(p.normal), 1.0f, 1e-6f) << width;
        EXPECT_NEAR(glm::dot(p.normal, p.tangent), 0.0f, 1e-6f) << width;
        EXPECT_LE(glm::distance(p.bitangent, glm::cross(p.normal, p.tangent)), 1e-6f) << width;
    }
}

/// Sets follow a group that is made anew, and go where their faces are gone.
TEST_F(SurfacePoints, FollowTheirGroup) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const cage::Character tube = bentTube();
    const std::vector<SuppleSurfacePoint> points = pointsOf(tube.cage, 1);
    const SuppleAsset asset = own.createAsset(tube);
    Crowd crowd(own, groupOf(asset, SUPPLE_SCHEME_PM, 1));
    const PointSetOf set(crowd, points, SUPPLE_POINT_FRAME_64);
    crowd.pose(crowd.spawn(), 0, 0.6, placeOf(1));
    crowd.run();
    const std::vector<std::byte> before = set.bytes(0);
    ASSERT_EQ(suppleSetCapacity(own.handle(), crowd.group(), 40), SUPPLE_OK);
    crowd.run();
    EXPECT_EQ(set.output().frames.size, VkDeviceSize{40} * points.size() * 64);
    EXPECT_TRUE(set.bytes(0) == before);
    // Vertices may move: the faces are the same.
    cage::Character wider = tube;
    for (glm::vec3& p : wider.cage.positions) {
        p.y *= 1.5f;
        p.z *= 1.5f;
    }
    ASSERT_EQ(own.reloadAsset(asset, wider), SUPPLE_OK);
    Crowd fresh(own, groupOf(own.createAsset(wider), SUPPLE_SCHEME_PM, 1));
    const PointSetOf wanted(fresh, points, SUPPLE_POINT_FRAME_64);
    fresh.pose(fresh.spawn(), 0, 0.6, placeOf(1));
    for (uint32_t frame = 0; frame < 2; ++frame) { // behind the second, both were where they are
        crowd.run();
        fresh.run();
    }
    EXPECT_FALSE(set.bytes(0) == before);
    EXPECT_TRUE(set.bytes(0) == wanted.bytes(0)) << "tangents, too, are those of the new bind pose";
    EXPECT_EQ(own.takeCount(SUPPLE_MESSAGE_POINTS_DROPPED), 0u);
    ASSERT_EQ(own.reloadAsset(asset, bentTube(9)), SUPPLE_OK);
    EXPECT_EQ(own.takeCount(SUPPLE_MESSAGE_POINTS_DROPPED), 1u);
    SupplePointOutput output{};
    output.structSize = sizeof(output);
    EXPECT_EQ(suppleGetPointOutput(own.handle(), set.handle(), &output), SUPPLE_ERROR_ARGUMENT);
    crowd.run();
    // Destroyed ones, of groups that go on and of groups that end.
    const PointSetOf gone(crowd, points, SUPPLE_POINT_VERTEX_16), left(crowd, points, SUPPLE_POINT_VERTEX_16);
    crowd.run();
    EXPECT_EQ(suppleDestroyPointSet(own.handle(), gone.handle()), SUPPLE_OK);
    EXPECT_EQ(suppleDestroyPointSet(own.handle(), gone.handle()), SUPPLE_ERROR_ARGUMENT);
    crowd.run();
    crowd.end();
    EXPECT_EQ(suppleDestroyPointSet(own.handle(), left.handle()), SUPPLE_ERROR_ARGUMENT);
    (void)own.takeLines();
}

/// A face that has become a hole has no points any more, though the faces are the same otherwise.
TEST_F(SurfacePoints, GoWhereAFaceHasBecomeAHole) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const cage::Character tube = bentTube();
    const SuppleAsset asset = own.createAsset(tube);
    Crowd crowd(own, groupOf(asset, SUPPLE_SCHEME_PM, 1));
    const PointSetOf set(crowd, pointsOf(tube.cage, 1), SUPPLE_POINT_FRAME_48);
    crowd.pose(crowd.spawn(), 0, 0.6, placeOf(1));
    crowd.run();
    cage::Character open = tube;
    open.cage.holes = {3};
    ASSERT_EQ(own.reloadAsset(asset, open), SUPPLE_OK) << "the asset is good";
    EXPECT_EQ(own.takeCount(SUPPLE_MESSAGE_POINTS_DROPPED), 1u);
    crowd.run();
    (void)own.takeLines();
}

/// Points that do not exist, by name.
TEST_F(SurfacePoints, RefuseHandlesThatNameNoPoint) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    cage::Character tube = bentTube();
    tube.cage.holes = {2};
    Crowd crowd(own, groupOf(own.createAsset(tube), SUPPLE_SCHEME_CATMULL_CLARK, 1));
    ASSERT_TRUE(crowd.valid());
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    ASSERT_EQ(tube.cage.sides(0), 4u);
    for (const SuppleSurfacePoint& bad :
         {SuppleSurfacePoint{0, 7, 0.5f, 0.5f}, SuppleSurfacePoint{0, 0xFFFFFFFFu, 0.5f, 0.5f},
          SuppleSurfacePoint{0, 0, nan, 0.5f}, SuppleSurfacePoint{0, 0, 0.5f, inf},
          SuppleSurfacePoint{0, 0, -0.1f, 0.5f}, SuppleSurfacePoint{2, 0, 0.5f, 0.5f},
          SuppleSurfacePoint{SUPPLE_NO_FACE, 0, 0.5f, 0.5f}}) {
        const SuppleSurfacePoint points[] = {{0, 0, 0.5f, 0.5f}, bad};
        SupplePointSetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.group = crowd.group();
        desc.points = points;
        desc.pointCount = 2;
        SupplePointSet set{1};
        (void)own.takeLines();
        EXPECT_EQ(suppleCreatePointSet(own.handle(), &desc, &set), SUPPLE_ERROR_ARGUMENT);
        EXPECT_EQ(set.id, 0u);
        bool named = false;
        for (const auto& line : own.takeLines()) {
            named = named || line.text.find("points[1], face " + std::to_string(bad.face)) != std::string::npos;
        }
        EXPECT_TRUE(named) << bad.face << " " << bad.side << " " << bad.a << " " << bad.b;
    }
}

/// Groups of several schemes and of parts, followers and views: each point is on the surface of its own part.
TEST_F(SurfacePoints, LieOnTheSurfaceOfAGroupThatFollows) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const cage::Character tube = bentTube();
    const SuppleAsset asset = own.createAsset(tube);
    Crowd leader(own, groupOf(asset, SUPPLE_SCHEME_PM, 2));
    SuppleGroupDesc desc = groupOf(asset, SUPPLE_SCHEME_CATMULL_CLARK, 0);
    desc.instancesOf = leader.group();
    Crowd follower(own, desc);
    ASSERT_TRUE(follower.valid());
    const std::vector<SuppleSurfacePoint> points = pointsOf(tube.cage, 1);
    const PointSetOf set(follower, points, SUPPLE_POINT_FRAME_48);
    Crowd alone(own, groupOf(asset, SUPPLE_SCHEME_CATMULL_CLARK, 2));
    const PointSetOf expected(alone, points, SUPPLE_POINT_FRAME_48);
    for (uint32_t slot = 0; slot < 2; ++slot) {
        leader.pose(leader.spawn(), 0, 0.4 * slot, placeOf(slot));
        alone.pose(alone.spawn(), 0, 0.4 * slot, placeOf(slot));
    }
    const std::vector<SuppleGroup> groups{leader.group(), follower.group(), alone.group()};
    own.run(groups);
    for (uint32_t slot = 0; slot < 2; ++slot) {
        EXPECT_TRUE(set.bytes(slot) == expected.bytes(slot));
    }
    ASSERT_EQ(suppleSetCapacity(own.handle(), leader.group(), 5), SUPPLE_OK);
    own.run(groups);
    for (uint32_t slot = 0; slot < 2; ++slot) {
        EXPECT_TRUE(set.bytes(slot) == expected.bytes(slot));
    }
}

/// Tasks of shared dispatches that stand from frame to frame know of sets that come and go.
TEST_F(SurfacePoints, HaveTheSameBitsInSharedDispatches) {
    CrowdContext plain(*testDevice(), SUPPLE_MAPPING_WIDE, 2, 0);
    CrowdContext shared(*testDevice(), SUPPLE_MAPPING_WIDE, 2, SUPPLE_CONTEXT_SHARED_DISPATCHES);
    const cage::Character tube = bentTube();
    struct Scene {
        CrowdContext& context;
        Crowd first, second;
        std::vector<SuppleInstance> instances;
        std::vector<std::unique_ptr<PointSetOf>> sets;
    };
    std::vector<std::unique_ptr<Scene>> scenes;
    for (CrowdContext* const own : {&plain, &shared}) {
        const SuppleAsset asset = own->createAsset(tube);
        scenes.push_back(std::unique_ptr<Scene>(new Scene{*own,
                                                          Crowd(*own, groupOf(asset, SUPPLE_SCHEME_PM)),
                                                          Crowd(*own, groupOf(asset, SUPPLE_SCHEME_CATMULL_CLARK)),
                                                          {},
                                                          {}}));
        Scene& scene = *scenes.back();
        for (Crowd* const crowd : {&scene.first, &scene.second}) {
            for (uint32_t slot = 0; slot < 2; ++slot) {
                scene.instances.push_back(crowd->spawn());
                crowd->pose(scene.instances.back(), 0, 0.3 * slot, placeOf(slot));
            }
        }
    }
    const auto add = [&](bool toSecond, uint32_t perFace, SupplePointFormat format) {
        for (const auto& scene : scenes) {
            scene->sets.push_back(std::make_unique<PointSetOf>(toSecond ? scene->second : scene->first,
                                                               pointsOf(tube.cage, perFace), format));
        }
    };
    const auto remove = [&](size_t set) {
        for (const auto& scene : scenes) {
            EXPECT_EQ(suppleDestroyPointSet(scene->context.handle(), scene->sets[set]->handle()), SUPPLE_OK);
            scene->sets.erase(scene->sets.begin() + static_cast<ptrdiff_t>(set));
        }
    };
    const auto setOrigin = [&](double x) {
        const double origin[3] = {x, 0.0, 0.0};
        for (const auto& scene : scenes) {
            EXPECT_EQ(suppleSetOrigin(scene->context.handle(), origin), SUPPLE_OK);
        }
    };
    const auto run = [&](const char* what) {
        for (uint32_t frame = 0; frame < 5; ++frame) { // there are as many rooms as two frames in flight need, and more
            for (const auto& scene : scenes) {
                scene->first.pose(scene->instances[0], 0, 0.1 * frame, placeOf(0, frame));
                scene->context.run(std::vector{scene->first.group(), scene->second.group()});
            }
            for (size_t set = 0; set < scenes[0]->sets.size(); ++set) {
                const auto one = plain.device().readBuffer(scenes[0]->sets[set]->output().frames),
                           other = plain.device().readBuffer(scenes[1]->sets[set]->output().frames);
                ASSERT_TRUE(one.ok() && other.ok());
                EXPECT_TRUE(*one == *other) << what << ", frame " << frame << ", set " << set;
            }
        }
    };
    run("no set");
    add(false, 1, SUPPLE_POINT_FRAME_64);
    run("a set");
    add(true, 2, SUPPLE_POINT_FRAME_48);
    run("another set");
    setOrigin(0.5);
    run("another origin");
    remove(0);
    run("the first is gone");
    add(false, 1, SUPPLE_POINT_FRAME_64);
    run("one in its place");
    remove(1);
    add(false, 1, SUPPLE_POINT_FRAME_64);
    run("another in the same frame");
    for (const auto& scene : scenes) {
        scene->context.cancel(std::vector{scene->first.group(), scene->second.group()});
    }
    run("a frame is cancelled");
    for (const auto& scene : scenes) {
        EXPECT_EQ(suppleSetCapacity(scene->context.handle(), scene->first.group(), 7), SUPPLE_OK);
    }
    run("more capacity");
}

/// Points anywhere on the characters of the samples, in a pose: every frame is three unit vectors at right angles.
TEST_F(SurfacePoints, HaveFramesOnEveryCharacter) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    for (const char* const file : {"pip.glb", "pip_quads.glb", "wren.glb", "helmet.glb"}) {
        const SuppleAsset asset = own.asset(std::string(SUPPLE_SAMPLE_ASSETS) + "/" + file);
        for (const SuppleScheme scheme : {SUPPLE_SCHEME_AUTO, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_LOOP}) {
            Crowd crowd(own, groupOf(asset, scheme, 1));
            ASSERT_TRUE(crowd.valid()) << file;
            std::vector<SuppleSurfacePoint> points(1000);
            SupplePointQuery query{};
            query.structSize = sizeof(query);
            query.kind = SUPPLE_FIND_SCATTER;
            query.count = static_cast<uint32_t>(points.size());
            query.seed = 3;
            ASSERT_EQ(suppleFindPoints(own.handle(), crowd.group(), &query, points.data()), SUPPLE_OK);
            for (size_t k = 0; k < points.size(); k += 3) { // on borders and corners too
                points[k].a = std::round(points[k].a);
                points[k].b = 0.0f;
            }
            const PointSetOf set(crowd, points, SUPPLE_POINT_FRAME_48);
            const SuppleInstance instance = crowd.spawn();
            crowd.run();
            const std::vector<std::byte> atRest = set.bytes(0);
            if (crowd.clipCount() > 0) {
                crowd.pose(instance, 0, 0.4, placeOf(1));
            } else { // a prop
                const glm::mat4 place = placeOf(1);
                EXPECT_EQ(suppleSetTransform(own.handle(), instance, glm::value_ptr(place)), SUPPLE_OK);
            }
            crowd.run();
            EXPECT_FALSE(set.bytes(0) == atRest);
            double worst = 0.0;
            const std::vector<PointOnDevice> posed = set.read(0);
            EXPECT_EQ(posed.size(), points.size());
            for (const PointOnDevice& p : posed) {
                const glm::dmat3 frame(p.tangent, p.bitangent, p.normal);
                const glm::dmat3 product = glm::transpose(frame) * frame - glm::dmat3(1.0);
                for (int column = 0; column < 3; ++column) {
                    raise(worst, glm::length(product[column]));
                }
            }
            std::printf("%-14s scheme %u: %.1e\n", file, scheme, worst);
            EXPECT_LE(worst, 1e-6) << file << ", scheme " << scheme;
            (void)own.takeLines();
        }
    }
}

/// What searches refuse, and a search for nothing.
TEST_F(SurfacePoints, AreFoundForGroups) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const cage::Character tube = bentTube();
    Crowd crowd(own, groupOf(own.createAsset(tube), SUPPLE_SCHEME_PM, 1));
    SupplePointQuery query{};
    query.structSize = sizeof(query);
    query.kind = SUPPLE_FIND_NEAREST;
    EXPECT_EQ(suppleFindPoints(own.handle(), crowd.group(), &query, nullptr), SUPPLE_OK) << "none are asked for";
    const float place[3] = {1.0f, 2.0f, 0.5f};
    query.count = 1;
    query.values = place;
    EXPECT_EQ(suppleFindPoints(own.handle(), crowd.group(), &query, nullptr), SUPPLE_ERROR_ARGUMENT);
    SuppleSurfacePoint point{};
    EXPECT_EQ(suppleFindPoints(own.handle(), crowd.group(), &query, &point), SUPPLE_OK);
    query.kind = SUPPLE_FIND_UV;
    query.cage = &tube.cage.positions[0].x;
    query.cageVertexCount = static_cast<uint32_t>(tube.cage.positions.size());
    EXPECT_EQ(suppleFindPoints(own.handle(), crowd.group(), &query, &point), SUPPLE_ERROR_ARGUMENT);
    (void)own.takeLines();
}

/// Memory is asked for and given back.
TEST_F(SurfacePoints, CountInTheMemoryOfTheirGroup) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const cage::Character tube = bentTube();
    Crowd crowd(own, groupOf(own.createAsset(tube), SUPPLE_SCHEME_PM, 10));
    const auto streams = [&] {
        auto use = sized<SuppleMemoryUse>();
        EXPECT_EQ(suppleGetGroupMemory(own.handle(), crowd.group(), &use), SUPPLE_OK);
        return use.streams;
    };
    const VkDeviceSize before = streams();
    const PointSetOf set(crowd, pointsOf(tube.cage, 2), SUPPLE_POINT_FRAME_64);
    EXPECT_GE(streams(), before + VkDeviceSize{10} * set.output().pointCount * (64 + 16));
    EXPECT_EQ(suppleDestroyPointSet(own.handle(), set.handle()), SUPPLE_OK);
    EXPECT_EQ(streams(), before);
}

/// Frames go on while a set is uploaded, and leave it out: it has zeros until then.
TEST_F(SurfacePoints, DoNotKeepTheirGroupWaiting) {
    CrowdContext own(*testDevice());
    const cage::Character tube = bentTube();
    Crowd crowd(own, groupOf(own.createAsset(tube), SUPPLE_SCHEME_PM, 1));
    crowd.pose(crowd.spawn(), 0, 0.5, placeOf(0));
    crowd.run();
    const PositionBits drawn = crowd.positions(0);
    ASSERT_EQ(suppleSetUploadBudget(own.handle(), 4096), SUPPLE_OK);
    const PointSetOf set(crowd, pointsOf(tube.cage, 4), SUPPLE_POINT_FRAME_48);
    uint32_t frames = 0;
    for (bool there = false; !there; ++frames) {
        ASSERT_LT(frames, 200u);
        crowd.run();
        EXPECT_EQ(differences(crowd.positions(0), drawn), 0u) << "the group is drawn";
        there = set.read(0)[0].tangent != glm::vec3(0.0f);
        auto state = sized<SuppleUploadState>();
        ASSERT_EQ(suppleGetGroupUploadState(own.handle(), crowd.group(), &state), SUPPLE_OK);
        EXPECT_EQ(there, state.complete == 1);
    }
    EXPECT_GT(frames, 3u);
}

/// A device that binds few bytes at a time.
TEST_F(SurfacePoints, AreCutIntoWhatADeviceBinds) {
    const cage::Character tube = bentTube();
    const std::vector<SuppleSurfacePoint> points = pointsOf(tube.cage, 2);
    WrappedVulkan& wrapped = wrappedVulkan();
    const std::unique_ptr<host::Device> device = deviceThrough(&wrappedGetInstanceProcAddr);
    ASSERT_NE(device, nullptr);
    constexpr uint32_t kInstances = 150;
    for (const SuppleMapping mapping : kMappings) {
        std::vector<std::byte> bits[2];
        for (const bool isSmall : {false, true}) {
            wrapped.maxStorageBufferRange = isSmall ? 1u << 16 : 0; // of cages, too
            CrowdContext own(*device, mapping);
            Crowd crowd(own, groupOf(own.createAsset(tube), SUPPLE_SCHEME_CAGE, kInstances));
            ASSERT_TRUE(crowd.valid());
            EXPECT_EQ(crowd.output().info.windowCount > 1, isSmall);
            const PointSetOf set(crowd, points, SUPPLE_POINT_FRAME_64);
            std::vector<SuppleInstance> instances;
            for (uint32_t frame = 0; frame < 3; ++frame) {
                for (uint32_t slot = 0; slot < kInstances; ++slot) {
                    if (frame == 0) {
                        instances.push_back(crowd.spawn());
                    }
                    crowd.setVisible(instances[slot], (slot + frame) % 4 != 0);
                    crowd.pose(instances[slot], 0, 0.01 * slot, placeOf(slot, frame));
                }
                crowd.run();
            }
            bits[isSmall ? 1 : 0] = crowd.read(set.output().frames);
            if (isSmall) { // not even one instance
                SupplePointSetDesc desc{};
                desc.structSize = sizeof(desc);
                desc.group = crowd.group();
                const std::vector<SuppleSurfacePoint> many(1400, points[0]);
                desc.points = many.data();
                desc.pointCount = static_cast<uint32_t>(many.size());
                SupplePointSet none{};
                EXPECT_EQ(suppleCreatePointSet(own.handle(), &desc, &none), SUPPLE_ERROR_LIMIT);
                EXPECT_EQ(none.id, 0u);
            }
        }
        EXPECT_TRUE(bits[0] == bits[1]) << mappingName(mapping);
    }
    EXPECT_EQ(device->validation()->messageCount(), 0u);
    wrapped.maxStorageBufferRange = 0;
}

/// In a view that culls: those out of sight keep their frames, unless the group poses them all the same.
TEST_F(SurfacePoints, AreThereInViews) {
    const cage::Character tube = bentTube();
    const std::vector<SuppleSurfacePoint> points = pointsOf(tube.cage, 1);
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    for (const bool posesUnseen : {false, true}) {
        TestView view(own, 100000, SUPPLE_VIEW_CULL);
        const glm::mat4 seen =
            glm::perspectiveRH_ZO(0.9f, 1.0f, 0.1f, 200.0f) *
            glm::lookAt(glm::vec3(4.0f, 0.0f, 20.0f), glm::vec3(4.0f, 0.0f, 0.0f), glm::vec3(0.0f, 1.0f, 0.0f));
        std::memcpy(view.camera.viewProjection, &seen, sizeof(seen));
        view.look({4.0f, 0.0f, 20.0f});
        SuppleGroupDesc desc = groupOf(own.createAsset(tube), SUPPLE_SCHEME_PM);
        desc.view = view.handle();
        desc.flags = posesUnseen ? SUPPLE_GROUP_POSE_UNSEEN : 0;
        Crowd crowd(own, desc);
        const PointSetOf set(crowd, points, SUPPLE_POINT_FRAME_48);
        crowd.pose(crowd.spawn(), 0, 0.5, glm::mat4(1.0f));
        crowd.pose(crowd.spawn(), 0, 0.5, glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, 500.0f})); // behind the camera
        crowd.run();
        EXPECT_NEAR(glm::length(set.read(0)[0].tangent), 1.0f, 1e-6f);
        EXPECT_NEAR(glm::length(set.read(1)[0].tangent), posesUnseen ? 1.0f : 0.0f, 1e-6f);
    }
}

/// The calls are in a recording, and one that begins late makes the sets that there are.
TEST_F(SurfacePoints, AreRecorded) {
    const cage::Character tube = bentTube();
    const std::vector<SuppleSurfacePoint> points = pointsOf(tube.cage, 1);
    for (const bool isLate : {false, true}) {
        CrowdContext own(*testDevice(), SUPPLE_MAPPING_AUTO, 2, isLate ? SUPPLE_CONTEXT_RECORDABLE : 0);
        Recorded recorded;
        if (!isLate) {
            ASSERT_EQ(recorded.start(own.handle()), SUPPLE_OK);
        }
        Crowd crowd(own, groupOf(own.createAsset(tube), SUPPLE_SCHEME_PM));
        const PointSetOf kept(crowd, points, SUPPLE_POINT_FRAME_64, std::vector<glm::vec3>(points.size(), {1, 0, 0}));
        const PointSetOf gone(crowd, points, SUPPLE_POINT_VERTEX_16);
        crowd.pose(crowd.spawn(), 0, 0.5, placeOf(0));
        crowd.run();
        ASSERT_EQ(suppleDestroyPointSet(own.handle(), gone.handle()), SUPPLE_OK);
        if (isLate) {
            own.beginFrame(); // one that has recorded nothing
            ASSERT_EQ(recorded.start(own.handle()), SUPPLE_OK);
        }
        crowd.run();
        crowd.run();
        own.beginFrame(); // the last one is complete
        const ReadRecording told = expectReplayed(own.handle(), recorded, 6);
        EXPECT_EQ(told.calls.contains(runtime::kCallNumber<runtime::calls::CreatePointSet>), true);
        EXPECT_EQ(told.calls.contains(runtime::kCallNumber<runtime::calls::DestroyPointSet>), !isLate);
    }
}

} // namespace
} // namespace supple::test
