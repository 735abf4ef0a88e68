// Continuity of P_m: G1 across every pair of facet classes and C1 within the patches in double, the same bits in float.
#include "tests/support/pm_surface.h"
#include "tests/support/pm_vectors.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/shared_assets.h"
#include "tests/support/worst.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace supple::surface::pm {
namespace {

using test::kPmVariants;
using test::PmCage;
using test::PmSurface;
using test::PmVariant;
using test::pmZoo;
using test::raise;

constexpr size_t kClasses = 5;
constexpr const char* kClassNames[kClasses] = {"ordinary", "polar", "P3", "P4", "P5"};

/// Pairs of facet classes in either order, 15 of them.
struct PairKey {
    size_t low = 0, high = 0;
};

/// In kClassNames: p-rep's perturbed patches stand between the first and the others.
size_t classIndex(PatchClass patchClass) {
    return patchClass == PatchClass::regular ? 0 : static_cast<size_t>(patchClass) - 1;
}

PairKey pairOf(const Mesh& mesh, const cage::Topology::Edge& edge) {
    const size_t a = classIndex(mesh.classes[mesh.topology.cornerFaces[edge.corner]]);
    const size_t b = classIndex(mesh.classes[mesh.topology.cornerFaces[edge.twin]]);
    return {std::min(a, b), std::max(a, b)};
}

template <class Entry>
using PairTable = std::array<std::array<Entry, kClasses>, kClasses>;

struct Angles {
    uint32_t edges = 0;
    double worst = 0.0;
};

TEST(PmContinuity, g1AcrossEveryPairOfClasses) {
    constexpr uint32_t kRate = 8;
    std::array<PairTable<Angles>, kPmVariants> tables{};
    for (const PmCage& entry : pmZoo()) {
        const PmSurface<double> surface(test::pmMesh(entry.cage), test::doublePositions(entry.cage));
        const Mesh& mesh = surface.mesh;
        const double extent = test::extent(test::doublePositions(entry.cage));
        for (uint32_t e = 0; e < mesh.topology.edges.size(); ++e) {
            const cage::Topology::Edge& edge = mesh.topology.edges[e];
            if (mesh.features.hard(e)) {
                continue;
            }
            const PairKey key = pairOf(mesh, edge);
            Angles& angles = tables[static_cast<size_t>(entry.variant)][key.low][key.high];
            ++angles.edges;
            for (uint32_t k = 0; k <= kRate; ++k) {
                const Sample<double> a = surface.onEdge(edge.corner, k, kRate);
                const Sample<double> b = surface.onEdge(edge.twin, kRate - k, kRate);
                EXPECT_LE(glm::distance(a.position, b.position), 1e-15 * extent) << entry.name;
                EXPECT_NEAR(glm::length(a.normal), 1.0, 1e-12) << entry.name;
                const double angle = test::angleDegrees(a.normal, b.normal);
                EXPECT_LE(angle, 1e-8) << entry.name << ", " << test::pmVariantName(entry.variant) << ", edge " << e
                                       << ", " << kClassNames[key.low] << "-" << kClassNames[key.high] << ", at " << k;
                raise(angles.worst, angle);
            }
        }
    }
    std::printf("%-18s", "edges, degrees");
    for (size_t variant = 0; variant < kPmVariants; ++variant) {
        std::printf("%16s", test::pmVariantName(static_cast<PmVariant>(variant)));
    }
    for (size_t low = 0; low < kClasses; ++low) {
        for (size_t high = low; high < kClasses; ++high) {
            std::printf("\n%-18s", (std::string(kClassNames[low]) + "-" + kClassNames[high]).c_str());
            for (const PairTable<Angles>& table : tables) {
                std::printf("%8u %.1e", table[low][high].edges, table[low][high].worst);
                EXPECT_GT(table[low][high].edges, 0u) << kClassNames[low] << "-" << kClassNames[high];
            }
        }
    }
    std::printf("\n");
}

/// C1 over the rays: the domain is the regular m-gon about its centre, so that the derivatives of sector i - 1, which
/// lies before the ray of corner i, determine those of sector i.
TEST(PmContinuity, c1WithinPatches) {
    constexpr uint32_t kSteps = 8;
    double worst = 0.0;
    uint64_t points = 0;
    for (const PmCage& entry : pmZoo()) {
        const PmSurface<double> surface(test::pmMesh(entry.cage), test::doublePositions(entry.cage));
        for (const Patch<double>& patch : surface.patches) {
            if (patch.patchClass == PatchClass::regular || patch.patchClass == PatchClass::polar) {
                continue;
            }
            const uint32_t m = patch.sides;
            const double c = m == 4 ? 0.0 : std::cos(2.0 * std::numbers::pi / m);
            const std::vector<glm::dvec3> coefficients(patch.c.begin(), patch.c.begin() + patch.count);
            const double size = test::extent(coefficients);
            for (uint32_t i = 0; i < m; ++i) {
                for (uint32_t k = 0; k <= kSteps; ++k) {
                    const double toCenter = double(k) / kSteps;
                    const double toCorner = double(kSteps - k) / kSteps;
                    const DomainPoint<double> after{{}, {}, i, {toCorner, 0.0, toCenter}};
                    const DomainPoint<double> before{{}, {}, (i + m - 1) % m, {0.0, toCorner, toCenter}};
                    const Derivatives<double> a = derivatives(patch, after);
                    const Derivatives<double> b = derivatives(patch, before);
                    raise(worst, glm::distance(a.d2, b.d2 - b.d1) / size);
                    raise(worst, glm::distance(a.d1, (1.0 - 2.0 * c) * a.d2 + b.d2) / size);
                    if (k > 0) {
                        const double gap =
                            glm::distance(evaluate(patch, after).position, evaluate(patch, before).position);
                        raise(worst, gap / size);
                    }
                    ++points;
                }
            }
        }
    }
    std::printf("%llu points on rays, largest jump of position and derivatives %.1e of the patch\n",
                static_cast<unsigned long long>(points), worst);
    EXPECT_GT(points, 0u);
    EXPECT_LE(worst, 1e-13);
}

/// Border samples that differ in any bit between the two sides of an edge, in float.
struct Bits {
    uint64_t samples = 0;
    uint64_t different = 0;
};

bool sameBits(const glm::vec3& a, const glm::vec3& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

Bits compareEdge(const PmSurface<float>& surface, const cage::Topology::Edge& edge) {
    Bits bits;
    for (const uint32_t rate : {1u, 2u, 3u, 8u, 17u}) {
        for (uint32_t k = 0; k <= rate; ++k) {
            ++bits.samples;
            bits.different += sameBits(surface.onEdge(edge.corner, k, rate).position,
                                       surface.onEdge(edge.twin, rate - k, rate).position)
                                  ? 0
                                  : 1;
        }
    }
    return bits;
}

TEST(PmContinuity, sameBitsAcrossEveryPairOfClasses) {
    PairTable<Bits> smooth{};
    PairTable<Bits> hard{};
    for (const PmCage& entry : pmZoo()) {
        const PmSurface<float> surface(test::pmMesh(entry.cage), entry.cage.positions);
        for (uint32_t e = 0; e < surface.mesh.topology.edges.size(); ++e) {
            const cage::Topology::Edge& edge = surface.mesh.topology.edges[e];
            if (edge.twin == cage::kNone) {
                continue;
            }
            const PairKey key = pairOf(surface.mesh, edge);
            const Bits bits = compareEdge(surface, edge);
            EXPECT_EQ(bits.different, 0u) << entry.name << ", " << test::pmVariantName(entry.variant) << ", edge " << e
                                          << ", " << kClassNames[key.low] << "-" << kClassNames[key.high];
            Bits& sum = (surface.mesh.features.hard(e) ? hard : smooth)[key.low][key.high];
            sum.samples += bits.samples;
        }
    }
    std::printf("shared samples compared\n");
    for (size_t low = 0; low < kClasses; ++low) {
        for (size_t high = low; high < kClasses; ++high) {
            std::printf("%-18s%8llu, over hard edges %8llu\n",
                        (std::string(kClassNames[low]) + "-" + kClassNames[high]).c_str(),
                        static_cast<unsigned long long>(smooth[low][high].samples),
                        static_cast<unsigned long long>(hard[low][high].samples));
            EXPECT_GT(smooth[low][high].samples, 0u) << kClassNames[low] << "-" << kClassNames[high];
            EXPECT_GT(hard[low][high].samples, 0u) << kClassNames[low] << "-" << kClassNames[high];
        }
    }
}

TEST(PmContinuity, sameBitsWithNegativeZeros) {
    // Flattened into x = +-0: every sum of the surface's x is of zeros, and their signs must still agree.
    std::mt19937 random(1);
    uint64_t samples = 0;
    for (const PmCage& entry : pmZoo()) {
        std::vector<glm::vec3> positions = entry.cage.positions;
        for (glm::vec3& p : positions) {
            p.x = random() % 2 == 0 ? 0.0f : -0.0f;
        }
        const PmSurface<float> surface(test::pmMesh(entry.cage), positions);
        for (const cage::Topology::Edge& edge : surface.mesh.topology.edges) {
            if (edge.twin != cage::kNone) {
                const Bits bits = compareEdge(surface, edge);
                EXPECT_EQ(bits.different, 0u) << entry.name;
                samples += bits.samples;
            }
        }
    }
    EXPECT_GT(samples, 0u);
}

TEST(PmContinuity, sameBitsAtRatesWithACommonFraction) {
    for (const test::PmVectors& v : test::pmVectors()) {
        const PmSurface<float> surface(v.mesh(), v.cage.positions);
        for (const cage::Topology::Edge& edge : surface.mesh.topology.edges) {
            for (const auto& [coarse, fine] : {std::pair{2u, 8u}, {3u, 9u}, {5u, 40u}, {7u, 63u}}) {
                for (uint32_t k = 0; k <= coarse && edge.twin != cage::kNone; ++k) {
                    const uint32_t scale = fine / coarse;
                    EXPECT_TRUE(sameBits(surface.onEdge(edge.corner, k, coarse).position,
                                         surface.onEdge(edge.twin, fine - scale * k, fine).position))
                        << v.name;
                }
            }
        }
    }
}

TEST(PmContinuity, floatNormalsAgreeAcrossEdges) {
    double worst = 0.0;
    for (const test::PmVectors& v : test::pmVectors()) {
        const PmSurface<float> surface(v.mesh(), v.cage.positions);
        for (uint32_t e = 0; e < surface.mesh.topology.edges.size(); ++e) {
            const cage::Topology::Edge& edge = surface.mesh.topology.edges[e];
            for (uint32_t k = 0; k <= 8 && !surface.mesh.features.hard(e); ++k) {
                raise(worst, test::angleDegrees(surface.onEdge(edge.corner, k, 8).normal,
                                                surface.onEdge(edge.twin, 8 - k, 8).normal));
            }
        }
    }
    std::printf("float normals across edges: max %.1e degrees\n", worst);
    EXPECT_LE(worst, 0.01);
}

/// The OBJ files of the shared assets that P_m takes; says how many files there are and which it refuses.
std::vector<std::pair<std::string, Mesh>> assetMeshes() {
    const std::vector<std::string> paths = test::filesBelow(test::sharedFolder() + "meshes", {".obj"});
    std::vector<std::pair<std::string, Mesh>> all;
    for (const std::string& path : paths) {
        const Result<cage::Character> character = test::readObjFile(path);
        if (!character.ok()) {
            ADD_FAILURE() << character.error().message;
            continue;
        }
        const std::string name = std::filesystem::path(path).filename().string();
        if (name == "catmark_val2_nonman.obj") {
            std::printf("left out: %s: two of its faces turn round on each other at an edge\n", name.c_str());
            continue;
        }
        Result<Mesh> mesh = buildMesh(character->cage);
        if (mesh.ok()) {
            all.emplace_back(name, std::move(*mesh));
        } else {
            std::printf("refused: %s: %s\n", name.c_str(), mesh.error().message.c_str());
        }
    }
    std::printf("%zu OBJ assets, %zu accepted\n", paths.size(), all.size());
    return all;
}

TEST(PmContinuity, assets) {
    const std::vector<std::pair<std::string, Mesh>> meshes = assetMeshes();
    if (meshes.empty()) {
        GTEST_SKIP() << "no OBJ assets: " << test::sharedFolder() << "meshes is not present";
    }
    constexpr uint32_t kRate = 8;
    Angles angles;
    for (const auto& [name, mesh] : meshes) {
        const PmSurface<double> exact(mesh, test::doublePositions(mesh.cage));
        const PmSurface<float> rounded(mesh, mesh.cage.positions);
        const auto liesAt0 = [&mesh = mesh](int axis) {
            return std::all_of(mesh.cage.positions.begin(), mesh.cage.positions.end(),
                               [axis](const glm::vec3& p) { return p[axis] == 0.0f; });
        };
        const bool flat = liesAt0(0) || liesAt0(1) || liesAt0(2);
        for (uint32_t e = 0; e < mesh.topology.edges.size(); ++e) {
            const cage::Topology::Edge& edge = mesh.topology.edges[e];
            if (edge.twin == cage::kNone) {
                continue;
            }
            ++angles.edges;
            for (uint32_t k = 0; k <= kRate; ++k) {
                double angle = test::angleDegrees(exact.onEdge(edge.corner, k, kRate).normal,
                                                  exact.onEdge(edge.twin, kRate - k, kRate).normal);
                if (flat) { // folded in its own plane, it has normals of both sides
                    angle = std::min(angle, 180.0 - angle);
                }
                if (!mesh.features.hard(e)) {
                    EXPECT_LE(angle, 1e-8) << name << ", edge " << e << ", at " << k;
                    raise(angles.worst, angle);
                }
                EXPECT_TRUE(sameBits(rounded.onEdge(edge.corner, k, kRate).position,
                                     rounded.onEdge(edge.twin, kRate - k, kRate).position))
                    << name << ", edge " << e << ", at " << k;
            }
        }
    }
    std::printf("%u edges, max %.1e degrees\n", angles.edges, angles.worst);
}

} // namespace
} // namespace supple::surface::pm
