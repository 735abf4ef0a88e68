// Points of faces: they lie where the grid has them, and derivatives are those of the surface.
#include "cage/topology.h"
#include "runtime/arrays/character_arrays.h"
#include "runtime/cpu_group.h"
#include "runtime/points/point_stencils.h"
#include "shaders/shared/points.h"
#include "surface/grid.h"
#include "surface/patch_class.h"
#include "tests/support/cpu_group.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/prep_surface.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/worst.h"
#include "tools/common/procedural.h"
#include "tools/reference/pm.h"
#include "tools/reference/prep.h"

#include <bit>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <tuple>

namespace supple::test {
namespace {

struct SchemeCage {
    const char* name;
    SuppleScheme scheme;
    cage::Cage cage;
    SuppleFragmentRules rules = SUPPLE_RULES_CATMULL_CLARK;
};

/// Some faces lie alone between the two halves of a crease.
cage::Cage withEndlessCreases(cage::Cage cage, uint32_t seed) {
    cage = withRandomSharpness(std::move(cage), seed);
    for (auto& crease : cage.creases) {
        crease.sharpness = cage::kHardSharpness;
    }
    return cage;
}

/// Triangles, quads and pentagons; all quads; all triangles.
std::vector<SchemeCage> schemeCages() {
    const cage::Cage quads = perturbed(biped(), 0.05f, 6);
    const cage::Cage mixed = perturbed(fanOverPentagons(6), 0.03f, 2);
    const cage::Cage triangles = perturbed(quartered(gyroBipyramid(5)), 0.02f, 3);
    return {{"p-rep", SUPPLE_SCHEME_PREP, quads},
            {"P_m", SUPPLE_SCHEME_PM, quads},
            {"P_m, mixed faces", SUPPLE_SCHEME_PM, mixed},
            {"P_m, polar", SUPPLE_SCHEME_PM, perturbed(cappedCylinder(7, 4), 0.02f, 5)},
            {"P_m, creases", SUPPLE_SCHEME_PM, withEndlessCreases(quads, 4)},
            {"P_m, large faces", SUPPLE_SCHEME_PM, perturbed(prism(11), 0.02f, 3)},
            {"Catmull-Clark", SUPPLE_SCHEME_CATMULL_CLARK, quads},
            {"Catmull-Clark, mixed faces", SUPPLE_SCHEME_CATMULL_CLARK, mixed},
            {"Catmull-Clark, creases", SUPPLE_SCHEME_CATMULL_CLARK, withRandomSharpness(quads, 4)},
            {"Loop", SUPPLE_SCHEME_LOOP, triangles},
            {"Loop, mixed faces", SUPPLE_SCHEME_LOOP, mixed},
            {"Loop, large faces", SUPPLE_SCHEME_LOOP, perturbed(prism(9), 0.02f, 3)},
            {"Loop, creases", SUPPLE_SCHEME_LOOP, withRandomSharpness(triangles, 4)},
            {"blend", SUPPLE_SCHEME_BLEND, quads},
            {"blend, mixed faces", SUPPLE_SCHEME_BLEND, mixed},
            {"polygons", SUPPLE_SCHEME_POLYGONS, mixed},
            {"fragments", SUPPLE_SCHEME_FRAGMENTS, mixed},
            {"fragments by Loop's rules", SUPPLE_SCHEME_FRAGMENTS, triangles, SUPPLE_RULES_LOOP}};
}

CpuOptions optionsOf(const SchemeCage& entry) {
    CpuOptions options;
    options.scheme = entry.scheme;
    options.rules = entry.rules;
    return options;
}

/// Anywhere in a face but within a margin of its border, so that steps stay in it.
SuppleSurfacePoint innerPoint(const cage::Cage& cage, uint32_t face, std::mt19937& random) {
    constexpr float kMargin = 1.0f / 64.0f;
    const uint32_t sides = cage.sides(face);
    float a = static_cast<float>(random() % 1000) / 1000.0f, b = static_cast<float>(random() % 1000) / 1000.0f;
    if (sides != 4 && a + b > 1.0f) {
        a = 1.0f - a;
        b = 1.0f - b;
    }
    const float room = 1.0f - (sides == 4 ? 2.0f : 3.0f) * kMargin;
    return {face, sides > 4 ? static_cast<uint32_t>(random() % sides) : 0, kMargin + room * a, kMargin + room * b};
}

glm::dvec3 asVector(const float* v) {
    return {v[0], v[1], v[2]};
}

/// What the table of a point set (shaders/shared/points.h) makes of a cage.
struct WeighedPoint {
    glm::dvec3 position{0.0}, a{0.0}, b{0.0};
    size_t count = 0; ///< of weights
};
WeighedPoint weighed(const std::vector<uint32_t>& table, size_t point, const std::vector<glm::vec3>& cage) {
    const auto element = [&](size_t at) { return std::span(table).subspan(4 * at, 4); };
    const auto header = element(point / shared::kPointBlock);
    WeighedPoint out;
    out.count = header[1];
    size_t at = header[0] + point % shared::kPointBlock;
    const glm::dvec3 first(cage[element(at)[0]]);
    for (uint32_t i = 1; i < header[1]; ++i) {
        at += header[2];
        const auto weight = element(at);
        const glm::dvec3 offset = glm::dvec3(cage[weight[0]]) - first;
        const auto share = [&](size_t of) { return static_cast<double>(std::bit_cast<float>(weight[of])); };
        out.position += share(1) * offset;
        out.a += share(2) * offset;
        out.b += share(3) * offset;
    }
    out.position += first;
    return out;
}

/// Differences over such a step: the error is of its square, and of float's rounding over it.
constexpr float kStep = 1.0f / 256.0f;

struct Differences {
    double first = 0.0, second = 0.0;
};

Differences differencesAt(const CpuGroup& group, const SuppleSurfacePoint& point, double size) {
    std::vector<SuppleSurfacePoint> points{point};
    const float steps[5][2] = {{kStep, 0.0f}, {-kStep, 0.0f}, {0.0f, kStep}, {0.0f, -kStep}, {0.0f, 0.0f}};
    for (const auto& step : steps) {
        points.push_back({point.face, point.side, point.a + step[0], point.b + step[1]});
    }
    const std::vector<SuppleSurfaceJet> jets = group.at(points);
    const double width = 2.0 * kStep;
    const auto slope = [&](const float* ahead, const float* behind) {
        return (asVector(ahead) - asVector(behind)) / width;
    };
    Differences worst;
    const SuppleSurfaceJet& own = jets[0];
    // First derivatives against positions, second ones against first ones.
    raise(worst.first, glm::length(slope(jets[1].position, jets[2].position) - asVector(own.du)) / size);
    raise(worst.first, glm::length(slope(jets[3].position, jets[4].position) - asVector(own.dv)) / size);
    raise(worst.second, glm::length(slope(jets[1].du, jets[2].du) - asVector(own.duu)) / size);
    raise(worst.second, glm::length(slope(jets[1].dv, jets[2].dv) - asVector(own.duv)) / size);
    raise(worst.second, glm::length(slope(jets[3].du, jets[4].du) - asVector(own.duv)) / size);
    raise(worst.second, glm::length(slope(jets[3].dv, jets[4].dv) - asVector(own.dvv)) / size);
    return worst;
}

TEST(CpuPoints, DerivativesAreThoseOfTheSurface) {
    for (const SchemeCage& entry : schemeCages()) {
        CpuGroup group(entry.cage, optionsOf(entry));
        ASSERT_TRUE(group.valid()) << entry.name;
        ASSERT_EQ(group.build(entry.cage.positions), SUPPLE_OK);
        const double size = extent(doublePositions(entry.cage));
        std::mt19937 random(1);
        std::vector<double> first, second;
        for (uint32_t face = 0; face < entry.cage.faceCount(); ++face) {
            for (int k = 0; k < 4; ++k) {
                const Differences d = differencesAt(group, innerPoint(entry.cage, face, random), size);
                first.push_back(d.first);
                second.push_back(d.second);
            }
        }
        // A few differences reach over a border where second derivatives jump: all but these are close.
        std::sort(first.begin(), first.end());
        std::sort(second.begin(), second.end());
        const size_t most = first.size() * 9 / 10;
        std::printf("%-28s du, dv %.1e, second %.1e of the extent; all: %.1e, %.1e\n", entry.name, first[most],
                    second[most], first.back(), second.back());
        EXPECT_LE(first[most], 2e-4) << entry.name;
        EXPECT_LE(second[most], 2e-2) << entry.name;
        EXPECT_LE(first.back(), 1e-2) << entry.name;
    }
}

/// Points as the device has them: the weights of a point set, of any cage.
TEST(CpuPoints, WeightsGiveTheSurface) {
    std::vector<SchemeCage> entries = schemeCages();
    entries.push_back({"cage", SUPPLE_SCHEME_CAGE, entries[1].cage});
    entries.push_back({"cage, mixed faces", SUPPLE_SCHEME_CAGE, entries[2].cage});
    for (const SchemeCage& entry : entries) {
        const host::CageArrays arrays(entry.cage);
        Result<cage::Character> character = runtime::characterFromArrays(arrays.desc, "test cage");
        ASSERT_TRUE(character.ok());
        SuppleGroupDesc desc{};
        desc.structSize = sizeof(desc);
        desc.scheme = entry.scheme;
        const SuppleFragmentsOptions fragments{sizeof(fragments), entry.rules};
        desc.fragments = &fragments;
        const auto surfaces = runtime::surfacesOf(runtime::Prepared::of(std::move(*character)), desc);
        ASSERT_TRUE(surfaces.ok()) << entry.name << ": " << surfaces.error().message;
        std::vector<SuppleSurfacePoint> points;
        std::mt19937 random(5);
        for (uint32_t face = 0; face < entry.cage.faceCount(); ++face) {
            points.push_back(innerPoint(entry.cage, face, random));
            points.push_back({face, 0, 0.0f, 0.0f});
            points.push_back({face, entry.cage.sides(face) > 4 ? 2u : 0u, 1.0f, 0.0f});
        }
        const Result<std::vector<uint32_t>> table = runtime::pointTable(**surfaces, points, {}, false);
        ASSERT_TRUE(table.ok()) << entry.name;
        runtime::CpuPose pose(*surfaces);
        const auto jetsOf = [&](const std::vector<glm::vec3>& cage) {
            std::vector<SuppleSurfaceJet> jets(points.size());
            EXPECT_TRUE(pose.build(reinterpret_cast<const std::byte*>(cage.data()), sizeof(glm::vec3), {}));
            EXPECT_TRUE(pose.evaluate(points, jets.data(), {}));
            return jets;
        };
        const std::vector<SuppleSurfaceJet> bind = jetsOf(entry.cage.positions);
        const std::vector<glm::vec3> moved = perturbed(entry.cage, 0.3f, 9).positions;
        const std::vector<SuppleSurfaceJet> jets = jetsOf(moved);
        const double size = extent(doublePositions(entry.cage));
        double position = 0.0, tangent = 0.0, normal = 0.0, inner = 0.0;
        size_t longest = 0;
        for (size_t k = 0; k < points.size(); ++k) {
            const WeighedPoint own = weighed(*table, k, moved);
            const glm::dvec3 du0 = asVector(bind[k].du), n0 = glm::cross(du0, asVector(bind[k].dv));
            const glm::dvec3 du = asVector(jets[k].du) / glm::length(du0);
            const glm::dvec3 n = glm::cross(asVector(jets[k].du), asVector(jets[k].dv)) / glm::length(n0);
            raise(position, glm::distance(own.position, asVector(jets[k].position)) / size);
            raise(tangent, glm::distance(own.a, du) / glm::length(du));
            raise(normal, glm::distance(glm::cross(own.a, own.b), n) / glm::length(n));
            if (k % 3 == 0) { // no corner
                raise(inner, std::max(glm::distance(own.a, du) / glm::length(du),
                                      glm::distance(glm::cross(own.a, own.b), n) / glm::length(n)));
            }
            longest = std::max(longest, own.count);
        }
        std::printf(
            "%-28s position %.1e of the extent, tangent %.1e, normal %.1e, off corners %.1e; most vertices %zu\n",
            entry.name, position, tangent, normal, inner, longest);
        EXPECT_LE(position, 1e-6) << entry.name;
        EXPECT_LE(tangent, 2e-5) << entry.name;
        EXPECT_LE(normal, 2e-3) << entry.name;
        EXPECT_LE(inner, 2e-5) << entry.name;
    }
}

/// The surfaces of a cage, for tables.
std::shared_ptr<const runtime::CpuGroup> surfacesOfCage(const cage::Cage& cage, SuppleScheme scheme) {
    const host::CageArrays arrays(cage);
    Result<cage::Character> character = runtime::characterFromArrays(arrays.desc, "test cage");
    EXPECT_TRUE(character.ok());
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.scheme = scheme;
    const auto made = runtime::surfacesOf(runtime::Prepared::of(std::move(*character)), desc);
    EXPECT_TRUE(made.ok()) << (made ? "" : made.error().message);
    return made ? *made : nullptr;
}

/// Points beside a vertex of many faces hang on all of them. Their weights take time in proportion, at any distance.
TEST(CpuPoints, AVertexOfManyFacesTakesNoSquareOfTheirNumber) {
    constexpr uint32_t kValence = 400;
    const cage::Cage cage = gyroBipyramid(kValence);
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_LOOP}) {
        const auto surfaces = surfacesOfCage(cage, scheme);
        ASSERT_NE(surfaces, nullptr);
        std::vector<SuppleSurfacePoint> points;
        for (uint32_t k = 0; k < 100; ++k) {
            const float off = std::exp2(-static_cast<float>(k % 32));
            const uint32_t face = k % cage.faceCount();
            points.push_back({face, 0, 0.3f * off, 0.2f * off});
            points.push_back({face, 0, 1.0f - 0.3f * off, 0.2f * off});
            points.push_back({face, 0, 0.3f * off, 1.0f - 0.5f * off});
        }
        const auto start = std::chrono::steady_clock::now();
        const Result<std::vector<uint32_t>> table = runtime::pointTable(*surfaces, points, {}, true);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        ASSERT_TRUE(table.ok());
        runtime::CpuPose pose(surfaces);
        const std::vector<glm::vec3> moved = perturbed(cage, 0.3f, 9).positions;
        std::vector<SuppleSurfaceJet> jets(points.size());
        ASSERT_TRUE(pose.build(reinterpret_cast<const std::byte*>(moved.data()), sizeof(glm::vec3), {}));
        ASSERT_TRUE(pose.evaluate(points, jets.data(), {}));
        double position = 0.0, slope = 0.0;
        size_t longest = 0;
        for (size_t k = 0; k < points.size(); ++k) {
            const WeighedPoint own = weighed(*table, k, moved);
            raise(position, glm::distance(own.position, asVector(jets[k].position)));
            raise(slope, glm::distance(own.a, asVector(jets[k].du)) / glm::length(asVector(jets[k].du)));
            longest = std::max(longest, own.count);
        }
        std::printf("scheme %u: %.2f ms a point; position %.1e, du %.1e; most vertices %zu\n", scheme,
                    1e3 * took.count() / static_cast<double>(points.size()), position, slope, longest);
        EXPECT_GE(longest, kValence);
        EXPECT_LE(position, 2e-6);
        EXPECT_LE(slope, 1e-4);
        EXPECT_LT(took.count(), 20.0) << "a square of the faces takes minutes";
    }
}

/// What has no bound is refused by name, before it is made.
TEST(CpuPoints, TooManyWeightsAreRefused) {
    const auto expectRefused = [](const Result<std::vector<uint32_t>>& table, const std::string& reason) {
        ASSERT_FALSE(table.ok());
        EXPECT_EQ(table.error().code, ErrorCode::limit);
        EXPECT_NE(table.error().message.find(reason), std::string::npos) << table.error().message;
    };
    const auto poles = surfacesOfCage(gyroBipyramid(5000), SUPPLE_SCHEME_CATMULL_CLARK);
    const SuppleSurfacePoint atPole{0, 0, 0.001f, 0.001f};
    std::vector<SuppleSurfacePoint> points{{0, 0, 0.3f, 0.3f}, atPole};
    for (const auto& [a, b] : {std::pair(0.001f, 0.001f), std::pair(0.998f, 0.001f), std::pair(0.001f, 0.998f)}) {
        points.push_back({0, 0, a, b});
    }
    expectRefused(runtime::pointTable(*poles, points, {}, false), ", face 0: it hangs on ");
    const auto small = surfacesOfCage(fanOverPentagons(6), SUPPLE_SCHEME_CATMULL_CLARK);
    const std::vector<SuppleSurfacePoint> many(1000, {0, 0, 0.3f, 0.3f});
    expectRefused(runtime::pointTable(*small, many, {}, false, 2000), "the weights of the first ");
}

/// The nearest rotation, as the device makes it of A and B.
glm::dmat3 frameOf(const WeighedPoint& point) {
    const glm::dvec3 n = glm::normalize(glm::cross(point.a, point.b));
    const glm::dvec3 t = glm::normalize(point.a + glm::cross(point.b, n));
    return {t, glm::cross(n, t), n};
}

/// The faces at a smooth vertex have their own derivatives there, which vanish or grow without bound if it is not
/// regular. The frames agree, in a pose that bends and shears.
TEST(CpuPoints, FacesAgreeOnTheFrameOfAVertex) {
    const cage::Cage cage = perturbed(biped(), 0.05f, 6);
    const host::CageArrays arrays(cage);
    Result<cage::Character> character = runtime::characterFromArrays(arrays.desc, "test cage");
    ASSERT_TRUE(character.ok());
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
    const auto surfaces = runtime::surfacesOf(runtime::Prepared::of(std::move(*character)), desc);
    ASSERT_TRUE(surfaces.ok());
    std::vector<glm::vec3> bent;
    for (const glm::vec3& p : cage.positions) {
        const float angle = 0.4f * p.y;
        bent.emplace_back(std::cos(angle) * p.x - std::sin(angle) * p.z + 0.5f * p.y, 1.2f * p.y,
                          std::sin(angle) * p.x + std::cos(angle) * p.z);
    }
    std::vector<SuppleSurfacePoint> points;
    std::vector<float> tangents;
    std::map<uint32_t, std::vector<size_t>> atVertex;
    constexpr float kCorners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        ASSERT_EQ(cage.sides(face), 4u);
        for (uint32_t k = 0; k < 4; ++k) {
            atVertex[cage.faceVertices[cage.faceStarts[face] + k]].push_back(points.size());
            points.push_back({face, 0, kCorners[k][0], kCorners[k][1]});
            tangents.insert(tangents.end(), {0.3f, 1.0f, -0.2f});
        }
    }
    const Result<std::vector<uint32_t>> table = runtime::pointTable(**surfaces, points, tangents, false);
    ASSERT_TRUE(table.ok());
    double rest = 0.0, posed = 0.0;
    size_t irregular = 0;
    for (const auto& [vertex, own] : atVertex) {
        irregular += own.size() != 4 ? 1 : 0;
        for (const size_t point : own) {
            const auto angle = [&](const std::vector<glm::vec3>& of) {
                const glm::dmat3 turn =
                    glm::transpose(frameOf(weighed(*table, own[0], of))) * frameOf(weighed(*table, point, of));
                return glm::degrees(glm::length(turn[0] - glm::dvec3(1, 0, 0)) +
                                    glm::length(turn[1] - glm::dvec3(0, 1, 0)));
            };
            raise(rest, angle(cage.positions));
            raise(posed, angle(bent));
        }
    }
    std::printf("%zu vertices, %zu irregular: %.1e degrees in the bind pose, %.1e bent\n", atVertex.size(), irregular,
                rest, posed);
    EXPECT_GT(irregular, 5u);
    EXPECT_LE(rest, 0.03);
    EXPECT_LE(posed, 0.03);
}

/// Two faces at an edge name its points differently: the surface has one position there.
TEST(CpuPoints, FacesAgreeOnTheirEdges) {
    for (const SchemeCage& entry : schemeCages()) {
        CpuGroup group(entry.cage, optionsOf(entry));
        ASSERT_TRUE(group.valid()) << entry.name;
        ASSERT_EQ(group.build(entry.cage.positions), SUPPLE_OK);
        const Result<cage::Topology> topology = cage::buildTopology(entry.cage);
        ASSERT_TRUE(topology.ok());
        // At t of the edge behind a corner.
        const auto onEdge = [&](uint32_t corner, float t) {
            const uint32_t face = topology->cornerFaces[corner], side = corner - entry.cage.faceStarts[face];
            const uint32_t sides = entry.cage.sides(face);
            if (sides > 4) {
                return SuppleSurfacePoint{face, side, t, 0.0f};
            }
            const float quads[4][2] = {{t, 0.0f}, {1.0f, t}, {1.0f - t, 1.0f}, {0.0f, 1.0f - t}};
            const float triangles[3][2] = {{t, 0.0f}, {1.0f - t, t}, {0.0f, 1.0f - t}};
            const float* at = sides == 4 ? quads[side] : triangles[side];
            return SuppleSurfacePoint{face, 0, at[0], at[1]};
        };
        std::vector<SuppleSurfacePoint> left, right;
        for (const cage::Topology::Edge& edge : topology->edges) {
            for (const float t : {0.0f, 0.25f, 0.375f, 0.5f, 1.0f}) {
                if (edge.twin != cage::kNone) {
                    left.push_back(onEdge(edge.corner, t));
                    right.push_back(onEdge(edge.twin, 1.0f - t));
                }
            }
        }
        const std::vector<SuppleSurfaceJet> a = group.at(left), b = group.at(right);
        double worst = 0.0;
        for (size_t i = 0; i < a.size(); ++i) {
            raise(worst, glm::distance(asVector(a[i].position), asVector(b[i].position)));
        }
        EXPECT_LE(worst / extent(doublePositions(entry.cage)), 5e-7) << entry.name;
    }
}

/// p-rep against the formulas in double.
TEST(CpuPoints, PRepHasTheReferencesJets) {
    const cage::Cage cage = perturbed(cage::makeSplitTorus(6, 5), 0.02f, 2);
    CpuOptions options;
    options.scheme = SUPPLE_SCHEME_PREP;
    CpuGroup group(cage, options);
    ASSERT_EQ(group.build(cage.positions), SUPPLE_OK);
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    const std::vector<glm::dvec3> positions = doublePositions(cage);
    const auto coefficients = surface::prep::construct<double>(cage, *topology, positions);
    const double size = extent(positions);
    double position = 0.0, first = 0.0, second = 0.0;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const auto patch = surface::prep::gatherPatch<double>(cage, *topology, coefficients, face);
        for (const auto& [u, v] : {std::pair(0.0f, 0.0f), std::pair(0.3f, 0.8f), std::pair(0.9f, 0.2f)}) {
            const surface::SurfaceJet exact = surface::prep::evaluateJet(patch, u, v);
            const SuppleSurfaceJet jet = group.at({{face, 0, u, v}})[0];
            raise(position, glm::distance(asVector(jet.position), exact.position) / size);
            raise(first, glm::distance(asVector(jet.du), exact.du) / size);
            raise(first, glm::distance(asVector(jet.dv), exact.dv) / size);
            raise(second, glm::distance(asVector(jet.duu), exact.duu) / size);
            raise(second, glm::distance(asVector(jet.duv), exact.duv) / size);
            raise(second, glm::distance(asVector(jet.dvv), exact.dvv) / size);
        }
    }
    std::printf("p-rep: positions %.1e, first %.1e, second %.1e of the extent\n", position, first, second);
    EXPECT_LE(position, 3e-7);
    EXPECT_LE(first, 2e-6);
    EXPECT_LE(second, 2e-5);
}

/// Far from the origin nothing changes but the rounding of positions.
TEST(CpuPoints, DerivativesKeepTheirDigitsFarFromTheOrigin) {
    cage::Cage cage = perturbed(cage::makeCubeSphere(4), 0.02f, 1);
    for (glm::vec3& p : cage.positions) { // exactly representable there too
        p = glm::round(p * 256.0f) / 256.0f;
    }
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK}) {
        CpuOptions options;
        options.scheme = scheme;
        CpuGroup group(cage, options);
        std::vector<SuppleSurfacePoint> points;
        for (uint32_t face = 0; face < cage.faceCount(); ++face) {
            points.push_back({face, 0, 0.3f, 0.7f});
        }
        ASSERT_EQ(group.build(cage.positions), SUPPLE_OK);
        const std::vector<SuppleSurfaceJet> near = group.at(points);
        std::vector<glm::vec3> moved = cage.positions;
        for (glm::vec3& p : moved) {
            p += glm::vec3(4096.0f, -8192.0f, 2048.0f);
        }
        ASSERT_EQ(group.build(moved), SUPPLE_OK);
        const std::vector<SuppleSurfaceJet> far = group.at(points);
        for (size_t i = 0; i < points.size(); ++i) {
            EXPECT_LE(glm::distance(asVector(near[i].du), asVector(far[i].du)), 1e-6);
            EXPECT_LE(glm::distance(asVector(near[i].dvv), asVector(far[i].dvv)), 1e-5);
        }
    }
}

/// Every corner of every face.
std::vector<SuppleSurfacePoint> cornersOf(const cage::Cage& cage) {
    std::vector<SuppleSurfacePoint> points;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const uint32_t sides = cage.sides(face);
        for (uint32_t side = 0; side < (sides > 4 ? sides : 1); ++side) {
            points.push_back({face, side, 0.0f, 0.0f});
            points.push_back({face, side, 1.0f, 0.0f});
            points.push_back({face, side, 0.0f, 1.0f});
        }
        if (sides == 4) {
            points.push_back({face, 0, 1.0f, 1.0f});
        }
    }
    return points;
}

/// Beside corners that are not regular second derivatives are differences of points that lie close together.
TEST(CpuPoints, CornersKeepTheirSecondDerivativesWhereverTheCageIs) {
    cage::Cage quads = perturbed(fanOverPentagons(6), 0.03f, 2), triangles = perturbed(gyroBipyramid(5), 0.02f, 3);
    const std::tuple<SuppleScheme, cage::Cage*, SuppleFragmentRules> cases[] = {
        {SUPPLE_SCHEME_CATMULL_CLARK, &quads, SUPPLE_RULES_CATMULL_CLARK},
        {SUPPLE_SCHEME_FRAGMENTS, &quads, SUPPLE_RULES_CATMULL_CLARK},
        {SUPPLE_SCHEME_FRAGMENTS, &triangles, SUPPLE_RULES_LOOP},
        {SUPPLE_SCHEME_LOOP, &triangles, SUPPLE_RULES_LOOP}};
    for (const auto& [scheme, cage, rules] : cases) {
        for (glm::vec3& p : cage->positions) { // exactly representable far away too
            p = glm::round(p * 256.0f) / 256.0f;
        }
        CpuOptions options;
        options.scheme = scheme;
        options.rules = rules;
        CpuGroup group(*cage, options);
        ASSERT_TRUE(group.valid());
        const std::vector<SuppleSurfacePoint> points = cornersOf(*cage);
        ASSERT_EQ(group.build(cage->positions), SUPPLE_OK);
        const std::vector<SuppleSurfaceJet> near = group.at(points);
        std::vector<glm::vec3> moved = cage->positions;
        for (glm::vec3& p : moved) {
            p += glm::vec3(512.0f, -1024.0f, 256.0f);
        }
        ASSERT_EQ(group.build(moved), SUPPLE_OK);
        const std::vector<SuppleSurfaceJet> far = group.at(points);
        double worst = 0.0;
        for (size_t i = 0; i < points.size(); ++i) {
            const auto compare = [&](auto member) {
                const glm::dvec3 a = asVector(near[i].*member), b = asVector(far[i].*member);
                raise(worst, glm::distance(a, b) / std::max(1e-3, glm::length(a)));
            };
            compare(&SuppleSurfaceJet::du), compare(&SuppleSurfaceJet::dv);
            compare(&SuppleSurfaceJet::duu), compare(&SuppleSurfaceJet::duv), compare(&SuppleSurfaceJet::dvv);
        }
        std::printf("scheme %d: %.1e\n", static_cast<int>(scheme), worst);
        EXPECT_LE(worst, 1e-5) << scheme;
    }
}

/// All patches at a vertex have one normal there, if no crease passes.
TEST(CpuPoints, GridsHaveOneNormalAtAVertex) {
    for (const SchemeCage& entry : schemeCages()) {
        if (!entry.cage.creases.empty() || entry.scheme == SUPPLE_SCHEME_POLYGONS) {
            continue;
        }
        CpuGroup group(entry.cage, optionsOf(entry));
        ASSERT_EQ(group.build(entry.cage.positions), SUPPLE_OK);
        constexpr uint32_t kRate = 4;
        const CpuGroup::Vertices grid = group.evaluate(0, kRate);
        std::vector<glm::dvec3> normals(entry.cage.vertexCount(), glm::dvec3(0.0));
        double worst = 0.0;
        uint32_t first = 0, compared = 0;
        for (const SupplePatchInfo& patch : group.patches(0)) {
            const surface::Domain domain = surface::domainOf(static_cast<surface::PatchClass>(patch.patchClass));
            for (uint32_t k = 0; k < patch.cornerCount; ++k) {
                const bool apex = domain == surface::Domain::polar && k == 2;
                if (patch.corners[k] == SUPPLE_NO_VERTEX || apex) {
                    continue;
                }
                const glm::dvec3 own(grid.normals[first + surface::edgeSample(domain, kRate, k, 0)]);
                glm::dvec3& known = normals[patch.corners[k]];
                if (known != glm::dvec3(0.0)) {
                    raise(worst, angleDegrees(known, own));
                    ++compared;
                } else {
                    known = own;
                }
            }
            first += surface::sampleCount(domain, kRate);
        }
        std::printf("%-28s %.4f degrees, %u corners\n", entry.name, worst, compared);
        EXPECT_GT(compared, 0u) << entry.name;
        EXPECT_LE(worst, 0.05) << entry.name;
    }
}

/// Derivatives exist, are finite and span a plane at every corner of every face.
TEST(CpuPoints, CornersHaveFiniteDerivatives) {
    for (const SchemeCage& entry : schemeCages()) {
        CpuGroup group(entry.cage, optionsOf(entry));
        ASSERT_EQ(group.build(entry.cage.positions), SUPPLE_OK);
        const std::vector<SuppleSurfacePoint> points = cornersOf(entry.cage);
        const std::vector<SuppleSurfaceJet> jets = group.at(points);
        double least = 1.0;
        for (size_t i = 0; i < jets.size(); ++i) {
            const float* numbers = jets[i].position;
            for (size_t k = 0; k < sizeof(SuppleSurfaceJet) / sizeof(float); ++k) {
                ASSERT_TRUE(std::isfinite(numbers[k])) << entry.name << ": face " << points[i].face;
            }
            const glm::dvec3 du = asVector(jets[i].du), dv = asVector(jets[i].dv);
            least = std::min(least, glm::length(glm::cross(du, dv)) / (glm::length(du) * glm::length(dv)));
        }
        std::printf("%-28s least sine %.1e\n", entry.name, least);
        EXPECT_GT(least, 1e-4) << entry.name;
    }
}

/// Polygons are flat: a quad has two planes, and its own derivatives in each.
TEST(CpuPoints, PolygonsAreTheirTriangles) {
    cage::Cage cage = grid(1, 1);
    cage.positions[2].z = 1.0f; // corner 3 of the quad
    CpuOptions options;
    options.scheme = SUPPLE_SCHEME_POLYGONS;
    CpuGroup group(cage, options);
    ASSERT_TRUE(group.valid());
    ASSERT_EQ(group.build(cage.positions), SUPPLE_OK);
    const std::vector<SupplePatchInfo> triangles = group.patches(0);
    ASSERT_EQ(triangles.size(), 2u);
    const std::vector<SuppleSurfaceJet> jets = group.at({{0, 0, 0.75f, 0.25f}, {0, 0, 0.25f, 0.75f}});
    for (const SuppleSurfaceJet& jet : jets) {
        EXPECT_EQ(asVector(jet.duu), glm::dvec3(0.0));
        EXPECT_EQ(asVector(jet.duv), glm::dvec3(0.0));
        EXPECT_EQ(asVector(jet.dvv), glm::dvec3(0.0));
    }
    // Cut from corner 0 to corner 2.
    EXPECT_EQ(asVector(jets[0].position), glm::dvec3(0.75, 0.25, 0.0));
    EXPECT_EQ(asVector(jets[0].du), glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(asVector(jets[0].dv), glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(asVector(jets[1].position), glm::dvec3(0.25, 0.75, 0.5));
    EXPECT_EQ(asVector(jets[1].du), glm::dvec3(1.0, 0.0, -1.0));
    EXPECT_EQ(asVector(jets[1].dv), glm::dvec3(0.0, 1.0, 1.0));
    const CpuGroup::Vertices vertices = group.evaluate(0, 2);
    EXPECT_EQ(vertices.positions.size(), 12u);
    EXPECT_EQ(vertices.normals[0], glm::vec3(0.0f, 0.0f, 1.0f));
}

} // namespace
} // namespace supple::test
