// Where the blending surface meets itself: positions, derivatives and normals on both sides of edges, by the kinds of
// their ends; and what it reproduces.
#include "tests/support/blend_surface.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/subdivision_zoo.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <utility>

namespace supple::surface::blend {
namespace {

using test::BlendSurface;

double degrees(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / std::numbers::pi;
}

/// Into the face, across its edge `side`.
glm::dvec3 inwards(const Sample<double>& at, uint32_t side) {
    return side == 0 ? at.dv : side == 1 ? -at.du : side == 2 ? -at.dv : at.du;
}

/// Whether the surface is to be C1 across the edge.
bool isSmooth(const Mesh& mesh, uint32_t edge) {
    const cage::Topology::Edge& e = mesh.topology.edges[edge];
    return e.twin != cage::kNone && mesh.edgeSharp[edge] == 0 && !flatAcross(mesh, e.corner);
}

std::vector<std::pair<std::string, cage::Cage>> zoo() {
    std::vector<std::pair<std::string, cage::Cage>> all;
    for (const test::SubdivisionCage& entry : test::subdivisionZoo()) {
        all.emplace_back(entry.name, entry.cage);
    }
    for (const test::PmCage& entry : test::pmZoo()) {
        all.emplace_back(entry.name, entry.cage);
    }
    return all;
}

struct Worst {
    uint64_t samples = 0;
    double gap = 0.0;      ///< of positions, by the extent
    double mismatch = 0.0; ///< of the derivatives across the edge, by their length
    double angle = 0.0;    ///< of the normals in degrees, where there are normals
};
using WorstByKinds = std::map<std::pair<ChartKind, ChartKind>, Worst>;

void compareSides(const Mesh& mesh, const std::vector<glm::dvec3>& positions, WorstByKinds& smooth, Worst& others) {
    constexpr uint32_t kRate = 8;
    const BlendSurface<double> surface(mesh, positions);
    const Evaluator<double> evaluator = surface.at(kRate);
    const double extent = test::extent(positions);
    for (uint32_t e = 0; e < mesh.topology.edges.size(); ++e) {
        const auto [corner, twin] = mesh.topology.edges[e];
        if (twin == cage::kNone) {
            continue;
        }
        auto [first, second] = test::endKinds(mesh, corner);
        const bool isC1 = isSmooth(mesh, e);
        Worst& worst = isC1 ? smooth[{std::min(first, second), std::max(first, second)}] : others;
        for (uint32_t k = 1; k < kRate; ++k) {
            const auto [i, j] = test::onEdge(corner, k, kRate);
            const auto [iTwin, jTwin] = test::onEdge(twin, kRate - k, kRate);
            const Sample<double> a = evaluator.at(corner / 4, i, j), b = evaluator.at(twin / 4, iTwin, jTwin);
            ++worst.samples;
            worst.gap = std::max(worst.gap, glm::distance(a.position, b.position) / extent);
            const glm::dvec3 across = inwards(a, corner % 4), back = inwards(b, twin % 4);
            const double lengths = glm::length(across) + glm::length(back) + 1e-6 * extent;
            worst.mismatch = std::max(worst.mismatch, glm::length(across + back) / lengths);
            // Where the cage has folded onto itself the cross product may be rounding alone.
            if (glm::length(glm::cross(a.du, a.dv)) > 1e-4 * glm::length(a.du) * glm::length(a.dv)) {
                worst.angle = std::max(worst.angle, degrees(a.normal, b.normal));
            }
        }
    }
}

TEST(BlendContinuity, sidesOfEdges) {
    for (const CreaseMode mode : test::kCreaseModes) {
        WorstByKinds smooth;
        Worst others;
        for (const auto& [name, cage] : zoo()) {
            compareSides(test::blendMesh(cage, {mode}), test::doublePositions(cage), smooth, others);
        }
        std::printf("%s\n", mode == CreaseMode::cut ? "cut" : "curve");
        for (const auto& [kinds, worst] : smooth) {
            std::printf("  %-8s - %-8s %7llu samples, gap %.1e, derivative %.1e, normals %.1e degrees\n",
                        test::kindName(kinds.first), test::kindName(kinds.second),
                        static_cast<unsigned long long>(worst.samples), worst.gap, worst.mismatch, worst.angle);
            EXPECT_LT(worst.gap, 1e-14);
            EXPECT_LT(worst.mismatch, 1e-10);
            EXPECT_LT(worst.angle, 1e-8);
        }
        std::printf("  sharp edges         %7llu samples, gap %.1e\n", static_cast<unsigned long long>(others.samples),
                    others.gap);
        EXPECT_LT(others.gap, 1e-14);
        EXPECT_EQ(smooth.size(), 9u); // all pairs of four kinds but two points, between which the surface lies still
    }
}

TEST(BlendContinuity, verticesAreInterpolated) {
    for (const CreaseMode mode : test::kCreaseModes) {
        for (const auto& [name, cage] : zoo()) {
            const Mesh mesh = test::blendMesh(cage, {mode});
            const BlendSurface<double> surface(mesh, test::doublePositions(cage));
            const std::vector<glm::dvec3> vertices =
                applyStencils<double>(mesh.stencils, std::span<const glm::dvec3>(test::doublePositions(cage)));
            const Evaluator<double> evaluator = surface.at(2);
            for (uint32_t c = 0; c < mesh.cage.cornerCount(); ++c) {
                const auto [i, j] = test::onEdge(c, 0, 2);
                const Chart& chart = mesh.charts[mesh.corners[c].chart];
                glm::dvec3 expected = vertices[chart.vertex];
                if (mesh.classOf(mesh.corners[c].chart).kind == ChartKind::curve) {
                    const glm::dvec3 a = vertices[mesh.ring[chart.firstRing]];
                    const glm::dvec3 b = vertices[mesh.ring[chart.firstRing + 1]];
                    expected = (a + 2.0 * expected + b) / 4.0;
                    EXPECT_LT(glm::distance(evaluator.at(c / 4, i, j).position, expected), 1e-14) << name;
                } else {
                    EXPECT_EQ(evaluator.at(c / 4, i, j).position, expected) << name << " corner " << c;
                }
            }
        }
    }
}

/// Normals near a vertex come closer to the vertex's own, in every face of its chart.
TEST(BlendContinuity, tangentPlanesAtVertices) {
    std::map<std::pair<ChartKind, uint32_t>, std::array<double, 3>> angles; // by k
    constexpr std::array<uint32_t, 3> kRates{4, 16, 64};
    const auto visit = [&](const cage::Cage& cage) {
        const Mesh mesh = test::blendMesh(cage);
        const BlendSurface<double> surface(mesh, test::doublePositions(cage));
        for (uint32_t n = 0; n < kRates.size(); ++n) {
            const uint32_t rate = kRates[n];
            const Evaluator<double> evaluator = surface.at(rate);
            for (uint32_t c = 0; c < mesh.cage.cornerCount(); ++c) {
                const ChartClass& chartClass = mesh.classOf(mesh.corners[c].chart);
                if (chartClass.kind == ChartKind::point) {
                    continue;
                }
                const auto [i, j] = test::onEdge(c, 0, rate);
                const glm::dvec3 own = evaluator.at(c / 4, i, j).normal;
                double& worst = angles[{chartClass.kind, chartClass.turns()}][n];
                for (const uint32_t near : {i == 0 ? 1 : rate - 1, i}) {
                    const uint32_t nearJ = j == 0 ? 1 : rate - 1;
                    worst = std::max(worst, degrees(own, evaluator.at(c / 4, near, nearJ).normal));
                }
            }
        }
    };
    for (const test::SubdivisionCage& entry : test::subdivisionZoo()) {
        const bool closed = cage::buildTopology(entry.cage)->edges.size() * 2 == entry.cage.cornerCount();
        if (closed && entry.name.find("moved") != std::string::npos) {
            visit(entry.cage);
        }
    }
    // Fans of boundary vertices over half a turn, which half a plane suits; over far more they all but fold.
    for (const uint32_t sectors : {1u, 2u, 3u, 4u, 5u, 6u, 8u}) {
        const double angle = sectors == 1 ? 0.5 * std::numbers::pi : std::numbers::pi;
        visit(test::perturbed(test::fan(sectors, 2, angle, false), 0.05f, sectors));
    }
    for (const uint32_t k : {3u, 4u, 5u, 6u, 8u}) { // creases straight through a vertex
        cage::Cage cage = test::perturbed(test::fan(k, 2, 2.0 * std::numbers::pi, true), 0.05f, k);
        const Mesh plain = test::blendMesh(cage);
        const uint32_t base = plain.topology.spokeStarts[0];
        cage.creases = {{0, plain.topology.spokeVertices[base], 1.0f},
                        {0, plain.topology.spokeVertices[base + k / 2], 1.0f}};
        visit(cage);
    }
    for (const auto& [key, worst] : angles) {
        std::printf("  %-8s k %2u: %6.2f %6.2f %6.2f degrees at 1/4, 1/16, 1/64\n", test::kindName(key.first),
                    key.second, worst[0], worst[1], worst[2]);
        EXPECT_LT(worst[2], 0.8 * worst[1] + 1e-6);
    }
}

/// The blend's weights add up to 1, and those of their derivatives to nothing.
TEST(BlendContinuity, aSinglePointStaysOne) {
    for (cage::Cage cage : {test::jack(), test::grid(3, 2), test::cappedCylinder(7, 3)}) {
        for (glm::vec3& p : cage.positions) {
            p = {0.3f, -7.0f, 2.0f};
        }
        const Mesh mesh = test::blendMesh(cage);
        const BlendSurface<double> surface(mesh, test::doublePositions(cage));
        const Evaluator<double> evaluator = surface.at(7);
        for (uint32_t s = 0; s < 64 * mesh.cage.faceCount(); ++s) {
            const Sample<double> sample = evaluator.at(s / 64, s % 8, s / 8 % 8);
            EXPECT_LT(glm::distance(sample.position, glm::dvec3(cage.positions[0])), 1e-14);
            EXPECT_EQ(sample.du, glm::dvec3(0.0));
            EXPECT_EQ(sample.dv, glm::dvec3(0.0));
            EXPECT_EQ(sample.normal, glm::dvec3(0.0));
        }
    }
}

TEST(BlendContinuity, allSharpIsThePolyhedron) {
    constexpr uint32_t kRate = 6;
    const auto eta = [](double t) { return (2.0 * t - 3.0) * t * t + 1.0; };
    for (const CreaseMode mode : test::kCreaseModes) {
        for (cage::Cage cage : {test::jack(), test::perturbed(test::cube(), 0.3f, 4), test::trapezohedron(7)}) {
            const cage::Topology topology = *cage::buildTopology(cage);
            for (const cage::Topology::Edge& edge : topology.edges) {
                const uint32_t next = cage::nextCorner(cage, topology.cornerFaces[edge.corner], edge.corner);
                cage.creases.push_back({cage.faceVertices[edge.corner], cage.faceVertices[next], 1.0f});
            }
            const Mesh mesh = test::blendMesh(cage, {mode});
            const std::vector<glm::dvec3> p = test::doublePositions(cage);
            const BlendSurface<double> surface(mesh, p);
            const Evaluator<double> evaluator = surface.at(kRate);
            for (uint32_t f = 0; f < cage.faceCount(); ++f) {
                const uint32_t* const v = cage.faceVertices.data() + cage.faceStarts[f];
                for (uint32_t s = 0; s < (kRate + 1) * (kRate + 1); ++s) {
                    const uint32_t i = s % (kRate + 1), j = s / (kRate + 1);
                    const double a = eta(static_cast<double>(i) / kRate), b = eta(static_cast<double>(j) / kRate);
                    const glm::dvec3 expected =
                        b * (a * p[v[0]] + (1.0 - a) * p[v[1]]) + (1.0 - b) * (a * p[v[3]] + (1.0 - a) * p[v[2]]);
                    EXPECT_LT(glm::distance(evaluator.at(f, i, j).position, expected), 1e-14);
                }
            }
        }
    }
}

TEST(BlendContinuity, affineMapsCommute) {
    const glm::dmat3 linear(0.7, 0.2, -0.4, 1.1, -0.3, 0.5, 0.2, 0.9, 1.3);
    const glm::dvec3 shift(3.0, -5.0, 2.0);
    double worst = 0.0;
    for (const CreaseMode mode : test::kCreaseModes) {
        for (const auto& [name, cage] : zoo()) {
            const Mesh mesh = test::blendMesh(cage, {mode});
            std::vector<glm::dvec3> positions = test::doublePositions(cage);
            const BlendSurface<double> surface(mesh, positions);
            for (glm::dvec3& p : positions) {
                p = linear * p + shift;
            }
            const BlendSurface<double> mapped(mesh, positions);
            const Evaluator<double> from = surface.at(3), to = mapped.at(3);
            for (uint32_t s = 0; s < 16 * mesh.cage.faceCount(); ++s) {
                const glm::dvec3 p = from.at(s / 16, s % 4, s / 4 % 4).position;
                const glm::dvec3 q = to.at(s / 16, s % 4, s / 4 % 4).position;
                worst = std::max(worst, glm::distance(linear * p + shift, q) / test::extent(positions));
            }
        }
    }
    std::printf("  affine maps: %.1e of the extent\n", worst);
    EXPECT_LT(worst, 1e-13);
}

/// A plane of squares is itself in its own parameters; so is a crease straight through it.
TEST(BlendContinuity, regularPlanesKeepTheirParameters) {
    constexpr uint32_t kRate = 5;
    for (const CreaseMode mode : test::kCreaseModes) {
        for (const bool creased : {false, true}) {
            cage::Cage cage = test::grid(4, 4);
            if (creased) {
                cage.creases = {{10, 11, 1.0f}, {11, 12, 1.0f}, {12, 13, 1.0f}, {13, 14, 1.0f}};
            }
            const Mesh mesh = test::blendMesh(cage, {mode});
            const BlendSurface<double> surface(mesh, test::doublePositions(cage));
            const Evaluator<double> evaluator = surface.at(kRate);
            for (uint32_t f = 0; f < 16; ++f) {
                const glm::dvec3 corner(cage.positions[cage.faceVertices[cage.faceStarts[f]]]);
                for (uint32_t s = 0; s < (kRate + 1) * (kRate + 1); ++s) {
                    const uint32_t i = s % (kRate + 1), j = s / (kRate + 1);
                    const Sample<double> sample = evaluator.at(f, i, j);
                    const glm::dvec3 expected = corner + glm::dvec3(i, j, 0) / double{kRate};
                    // Curves and points are not planes; along the crease between its ends they are exact.
                    const bool onCrease = f >= 5 && f <= 6 && j == kRate;
                    if (!creased || (mode == CreaseMode::cut && f % 4 != 0 && f % 4 != 3) || onCrease) {
                        EXPECT_LT(glm::distance(sample.position, expected), 1e-14) << f << ' ' << i << ' ' << j;
                    }
                    EXPECT_NEAR(sample.normal.z, 1.0, 1e-12);
                }
            }
        }
    }
}

/// Moving an inner vertex leaves the boundary where it is.
TEST(BlendContinuity, boundariesAreOfBoundaryVertices) {
    constexpr uint32_t kRate = 9;
    const cage::Cage cage = test::perturbed(test::grid(4, 3), 0.3f, 9);
    const Mesh mesh = test::blendMesh(cage);
    std::vector<glm::dvec3> positions = test::doublePositions(cage);
    const BlendSurface<double> surface(mesh, positions);
    for (uint32_t v = 0; v < positions.size(); ++v) {
        if (mesh.topology.boundary[v] == 0) {
            positions[v] += glm::dvec3(0.2, -0.3, 5.0);
        }
    }
    const BlendSurface<double> moved(mesh, positions);
    const Evaluator<double> before = surface.at(kRate), after = moved.at(kRate);
    for (uint32_t c = 0; c < mesh.cage.cornerCount(); ++c) {
        for (uint32_t k = 0; mesh.topology.twins[c] == cage::kNone && k <= kRate; ++k) {
            const auto [i, j] = test::onEdge(c, k, kRate);
            EXPECT_EQ(before.at(c / 4, i, j).position, after.at(c / 4, i, j).position);
        }
    }
}

} // namespace
} // namespace supple::surface::blend
