// P_m against what it must reproduce: B-splines, p-rep's regular patches, polyhedra; and what creases promise.
#include "tests/support/meshes.h"
#include "tests/support/pm_surface.h"
#include "tests/support/pm_vectors.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/worst.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>

namespace supple::surface::pm {
namespace {

using test::PmCage;
using test::PmSurface;
using test::pmZoo;
using test::raise;

/// Bezier coefficients [i + 4 j] of the bicubic B-spline patch with control points [x + 4 y].
std::array<glm::dvec3, 16> bezierOfBSpline(const std::array<glm::dvec3, 16>& control) {
    constexpr double kRows[4][4] = {
        {1. / 6, 4. / 6, 1. / 6, 0}, {0, 4. / 6, 2. / 6, 0}, {0, 2. / 6, 4. / 6, 0}, {0, 1. / 6, 4. / 6, 1. / 6}};
    std::array<glm::dvec3, 16> result{};
    for (size_t j = 0; j < 4; ++j) {
        for (size_t i = 0; i < 4; ++i) {
            for (size_t y = 0; y < 4; ++y) {
                for (size_t x = 0; x < 4; ++x) {
                    result[i + 4 * j] += kRows[i][x] * kRows[j][y] * control[x + 4 * y];
                }
            }
        }
    }
    return result;
}

double distance(const Patch<double>& patch, const std::array<glm::dvec3, 16>& bezier) {
    double worst = 0.0;
    for (size_t k = 0; k < 16; ++k) {
        raise(worst, glm::distance(patch.c[k], bezier[k]));
    }
    return worst;
}

TEST(PmReference, torusIsTheBSpline) {
    constexpr int kAround = 7, kAcross = 5;
    const cage::Cage cage = test::perturbed(test::torus(kAround, kAcross), 0.2f, 1);
    const std::vector<glm::dvec3> positions = test::doublePositions(cage);
    const PmSurface<double> surface(test::pmMesh(cage), positions);
    double worst = 0.0;
    for (int i = 0; i < kAround; ++i) {
        for (int j = 0; j < kAcross; ++j) {
            std::array<glm::dvec3, 16> control;
            for (int y = 0; y < 4; ++y) {
                for (int x = 0; x < 4; ++x) {
                    control[x + 4 * y] =
                        positions[(i + x - 1 + kAround) % kAround * kAcross + (j + y - 1 + kAcross) % kAcross];
                }
            }
            const auto facet = static_cast<uint32_t>(i * kAcross + j);
            ASSERT_EQ(surface.patches[facet].patchClass, PatchClass::regular);
            raise(worst, distance(surface.patches[facet], bezierOfBSpline(control)));
        }
    }
    EXPECT_LE(worst / test::extent(positions), 1e-15);
}

TEST(PmReference, openGridIsTheBSplineOfTheMirroredGrid) {
    // One row of control points beyond the boundary, 2 p - q: the boundary is then the B-spline of its own polygon, and
    // the corners are interpolated.
    constexpr int kColumns = 4, kRows = 3;
    const cage::Cage cage = test::perturbed(test::grid(kColumns, kRows), 0.2f, 2);
    const std::vector<glm::dvec3> positions = test::doublePositions(cage);
    const auto row = [&](int x, int y) {
        const auto at = [&](int column) { return positions[y * (kColumns + 1) + column]; };
        return x < 0 ? 2.0 * at(0) - at(1) : x > kColumns ? 2.0 * at(kColumns) - at(kColumns - 1) : at(x);
    };
    const auto control = [&](int x, int y) {
        return y < 0 ? 2.0 * row(x, 0) - row(x, 1) : y > kRows ? 2.0 * row(x, kRows) - row(x, kRows - 1) : row(x, y);
    };
    const PmSurface<double> surface(test::pmMesh(cage), positions);
    double worst = 0.0;
    for (int y = 0; y < kRows; ++y) {
        for (int x = 0; x < kColumns; ++x) {
            std::array<glm::dvec3, 16> window;
            for (int k = 0; k < 16; ++k) {
                window[k] = control(x - 1 + k % 4, y - 1 + k / 4);
            }
            const auto facet = static_cast<uint32_t>(y * kColumns + x);
            ASSERT_EQ(surface.patches[facet].patchClass, PatchClass::regular);
            raise(worst, distance(surface.patches[facet], bezierOfBSpline(window)));
        }
    }
    EXPECT_LE(worst / test::extent(positions), 1e-15);
}

TEST(PmReference, ordinaryFacetsArePRepsRegularPatches) {
    double worst = 0.0;
    uint32_t compared = 0;
    for (const cage::Cage& cage :
         {test::perturbed(test::torus(6, 5), 0.2f, 1), test::perturbed(test::grid(4, 3), 0.2f, 2),
          test::withoutFaces(test::perturbed(test::grid(6, 6), 0.2f, 3), {14, 15, 20, 21}),
          test::perturbed(test::fan(5, 3, 6.28, true), 0.05f, 4)}) {
        const std::vector<glm::dvec3> positions = test::doublePositions(cage);
        const PmSurface<double> pm(test::pmMesh(cage), positions);
        const test::PrepSurface<double> prep(cage, positions);
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            if (pm.patches[f].patchClass == PatchClass::regular && !prep.patches[f].perturbed) {
                raise(worst, distance(pm.patches[f], prep.patches[f].g) / test::extent(positions));
                ++compared;
            }
        }
    }
    std::printf("%u ordinary facets against p-rep: max %.1e of the extent\n", compared, worst);
    EXPECT_GT(compared, 80u);
    EXPECT_LE(worst, 1e-15);
}

/// How far a surface lies from the polyhedron of its cage, whose facets must be planar.
struct OffPolyhedron {
    double planes = 0.0; ///< coefficients from their facet's plane
    double edges = 0.0;  ///< border samples from their edge
};

OffPolyhedron offPolyhedron(const cage::Cage& cage, double alpha) {
    const std::vector<glm::dvec3> positions = test::doublePositions(cage);
    Mesh mesh = test::pmMesh(cage);
    test::setAlphas(mesh, [alpha](uint32_t, uint32_t, double) { return alpha; });
    const PmSurface<double> surface(std::move(mesh), positions);
    OffPolyhedron off;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        const uint32_t* const v = &cage.faceVertices[cage.faceStarts[f]];
        const glm::dvec3 origin = positions[v[0]];
        const glm::dvec3 normal = glm::normalize(glm::cross(positions[v[1]] - origin, positions[v[2]] - origin));
        for (uint32_t k = 0; k < surface.patches[f].count; ++k) {
            raise(off.planes, std::abs(glm::dot(surface.patches[f].c[k] - origin, normal)));
        }
        const uint32_t sides = cage.sides(f);
        for (uint32_t i = 0; i < sides; ++i) {
            const glm::dvec3 a = positions[v[i]];
            const glm::dvec3 along = glm::normalize(positions[v[(i + 1) % sides]] - a);
            for (uint32_t k = 0; k <= 4; ++k) {
                const glm::dvec3 p = surface.onEdge(cage.faceStarts[f] + i, k, 4).position;
                raise(off.edges, glm::length(glm::cross(p - a, along)));
            }
        }
    }
    return off;
}

TEST(PmReference, alphaZeroIsThePolyhedron) {
    std::set<PatchClass> classes;
    for (const cage::Cage& cage : {test::cube(), test::prism(3), test::prism(5), test::cappedCylinder(6, 3),
                                   test::perturbed(test::gyroBipyramid(7), 0.1f, 1)}) {
        const Mesh mesh = test::pmMesh(cage);
        classes.insert(mesh.classes.begin(), mesh.classes.end());
        const OffPolyhedron zero = offPolyhedron(cage, 0.0);
        EXPECT_LE(zero.planes, 1e-14);
        EXPECT_LE(zero.edges, 1e-14);
        // And it is approached: halving alpha about halves the distance.
        const OffPolyhedron wide = offPolyhedron(cage, 0.02);
        const OffPolyhedron narrow = offPolyhedron(cage, 0.01);
        EXPECT_GT(narrow.planes, 1e-4);
        EXPECT_LE(narrow.planes, 0.55 * wide.planes);
        EXPECT_LE(narrow.edges, 0.55 * wide.edges);
    }
    EXPECT_EQ(classes.size(), 5u);
}

TEST(PmReference, affineInvariance) {
    const glm::dmat3 linear(0.9, 0.2, -0.4, 0.3, -1.1, 0.5, 0.1, 0.6, 0.8);
    const glm::dvec3 shift(0.4, -0.7, 0.2);
    double worst = 0.0;
    for (const PmCage& entry : pmZoo()) {
        const Mesh mesh = test::pmMesh(entry.cage);
        const std::vector<glm::dvec3> positions = test::doublePositions(entry.cage);
        std::vector<glm::dvec3> moved;
        for (const glm::dvec3& p : positions) {
            moved.push_back(linear * p + shift);
        }
        const PmSurface<double> before(mesh, positions);
        const PmSurface<double> after(mesh, moved);
        for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
            for (uint32_t k = 0; k < before.patches[f].count; ++k) {
                raise(worst, glm::distance(after.patches[f].c[k], linear * before.patches[f].c[k] + shift) /
                                 test::extent(moved));
            }
        }
    }
    std::printf("affine maps of cage and surface: max %.1e of the extent apart\n", worst);
    EXPECT_LE(worst, 1e-14);
}

/// The border coefficients of a half-edge, from its corner.
template <class T>
std::array<glm::vec<3, T>, 4> borderOf(const PmSurface<T>& surface, uint32_t corner) {
    const Mesh& mesh = surface.mesh;
    const FacetCorner& a = mesh.corners[corner];
    const FacetCorner& b = mesh.corners[cage::nextCorner(mesh.cage, mesh.topology.cornerFaces[corner], corner)];
    const Coefficients<T>& c = surface.coefficients;
    return {c.limitPoints[a.fan], c.tangents[a.slot], c.tangents[b.slotBack], c.limitPoints[b.fan]};
}

uint32_t halfEdge(const Mesh& mesh, uint32_t from, uint32_t to) {
    const uint32_t edge = cage::findEdge(mesh.cage, mesh.topology, from, to);
    const auto [corner, twin] = mesh.topology.edges.at(edge);
    return mesh.cage.faceVertices[corner] == from ? corner : twin;
}

std::vector<uint32_t> fansAt(const Mesh& mesh, uint32_t vertex) {
    std::vector<uint32_t> found;
    for (uint32_t s = 0; s < mesh.fans.size(); ++s) {
        if (mesh.fans[s].vertex == vertex) {
            found.push_back(s);
        }
    }
    return found;
}

TEST(PmReference, hardLoopIsTheBSplineOfItsPolygon) {
    constexpr uint32_t kAround = 8, kAcross = 6;
    cage::Cage cage = test::perturbed(test::torus(kAround, kAcross), 0.2f, 1);
    for (uint32_t i = 0; i < kAround; ++i) {
        cage.creases.push_back({i * kAcross, (i + 1) % kAround * kAcross, cage::kHardSharpness});
    }
    const PmSurface<double> surface(test::pmMesh(cage), test::doublePositions(cage));
    for (uint32_t i = 0; i < kAround; ++i) {
        const auto p = [&](uint32_t step) { return glm::dvec3(cage.positions[(i + step) % kAround * kAcross]); };
        const std::array<glm::dvec3, 4> expected = {(p(0) + 4.0 * p(1) + p(2)) / 6.0, (2.0 * p(1) + p(2)) / 3.0,
                                                    (p(1) + 2.0 * p(2)) / 3.0, (p(1) + 4.0 * p(2) + p(3)) / 6.0};
        const uint32_t a = (i + 1) % kAround * kAcross;
        const uint32_t b = (i + 2) % kAround * kAcross;
        const std::array<glm::dvec3, 4> left = borderOf(surface, halfEdge(surface.mesh, a, b));
        const std::array<glm::dvec3, 4> right = borderOf(surface, halfEdge(surface.mesh, b, a));
        for (size_t k = 0; k < 4; ++k) {
            EXPECT_LE(glm::distance(left[k], expected[k]), 1e-15 * 8.0);
            EXPECT_EQ(left[k], right[3 - k]);
        }
    }
}

/// Angle between the two sides of an edge at sample k from its start, in degrees.
double angleAt(const PmSurface<double>& surface, uint32_t from, uint32_t to, uint32_t k, uint32_t rate) {
    return test::angleDegrees(surface.onEdge(halfEdge(surface.mesh, from, to), k, rate).normal,
                              surface.onEdge(halfEdge(surface.mesh, to, from), rate - k, rate).normal);
}

TEST(PmReference, dartIsSmoothAtItsTip) {
    constexpr uint32_t kAcross = 6;
    cage::Cage cage = test::perturbed(test::torus(8, kAcross), 0.2f, 3);
    for (uint32_t i = 0; i < 3; ++i) {
        cage.creases.push_back({i * kAcross, (i + 1) * kAcross, cage::kHardSharpness});
    }
    const PmSurface<double> surface(test::pmMesh(cage), test::doublePositions(cage));
    const Mesh& mesh = surface.mesh;
    for (const uint32_t tip : {0u, 3 * kAcross}) {
        ASSERT_EQ(fansAt(mesh, tip).size(), 1u);
        EXPECT_EQ(mesh.fans[fansAt(mesh, tip)[0]].kind, FanKind::interior);
    }
    for (const uint32_t inner : {kAcross, 2 * kAcross}) {
        ASSERT_EQ(fansAt(mesh, inner).size(), 2u);
        EXPECT_EQ(mesh.fans[fansAt(mesh, inner)[0]].kind, FanKind::crease);
    }
    EXPECT_LE(angleAt(surface, 0, kAcross, 0, 8), 1e-8);
    EXPECT_LE(angleAt(surface, 2 * kAcross, 3 * kAcross, 8, 8), 1e-8);
    EXPECT_GT(angleAt(surface, 0, kAcross, 8, 8), 1.0);
    EXPECT_GT(angleAt(surface, kAcross, 2 * kAcross, 4, 8), 1.0);
}

TEST(PmReference, aHardEdgeAloneMakesNoCrease) {
    cage::Cage cage = test::perturbed(test::cube(), 0.1f, 4);
    cage.creases.push_back({0, 1, cage::kHardSharpness});
    const PmSurface<double> surface(test::pmMesh(cage), test::doublePositions(cage));
    for (uint32_t k = 0; k <= 8; ++k) {
        EXPECT_LE(angleAt(surface, 0, 1, k, 8), 1e-8);
    }
}

TEST(PmReference, cornersInterpolate) {
    // Three hard edges at one corner of the cube, a flagged vertex on a hard path of the torus, corners of open cages.
    cage::Cage cube = test::perturbed(test::cube(), 0.1f, 1);
    for (const uint32_t to : {1u, 2u, 4u}) {
        cube.creases.push_back({0, to, cage::kHardSharpness});
    }
    cage::Cage torus = test::perturbed(test::torus(6, 5), 0.1f, 2);
    for (uint32_t i = 0; i < 3; ++i) {
        torus.creases.push_back({i * 5, (i + 1) * 5, cage::kHardSharpness});
    }
    torus.sharpVertices.push_back({5, cage::kHardSharpness});
    torus.sharpVertices.push_back({10, cage::kHardSharpness / 2.0f}); // carried, not used
    cage::Cage grid = test::perturbed(test::grid(2, 2), 0.1f, 3);
    grid.sharpVertices.push_back({1, cage::kHardSharpness});
    struct Case {
        const cage::Cage& cage;
        uint32_t vertex;
        size_t fans;
        FanKind kind;
    };
    for (const Case& c :
         {Case{cube, 0, 3, FanKind::corner}, Case{torus, 5, 2, FanKind::straight}, Case{torus, 10, 2, FanKind::crease},
          Case{grid, 0, 1, FanKind::corner}, Case{grid, 1, 1, FanKind::straight}, Case{grid, 3, 1, FanKind::crease}}) {
        const PmSurface<float> surface(test::pmMesh(c.cage), c.cage.positions);
        const std::vector<uint32_t> fans = fansAt(surface.mesh, c.vertex);
        EXPECT_EQ(fans.size(), c.fans);
        for (const uint32_t s : fans) {
            EXPECT_EQ(surface.mesh.fans[s].kind, c.kind);
            EXPECT_EQ(surface.coefficients.limitPoints[s] == c.cage.positions[c.vertex], c.kind != FanKind::crease);
        }
    }
}

TEST(PmReference, pinnedVerticesInterpolateAndStaySmooth) {
    uint32_t pinned = 0;
    for (const PmCage& entry : pmZoo()) {
        const PmSurface<float> surface(test::pmMesh(entry.cage), entry.cage.positions);
        const Mesh& mesh = surface.mesh;
        for (uint32_t c = 0; c < mesh.cage.cornerCount(); ++c) {
            const Fan& fan = mesh.fans[mesh.corners[c].fan];
            if (fan.pinned) {
                EXPECT_TRUE(fan.closed());
                EXPECT_EQ(surface.onEdge(c, 0, 8).position, mesh.cage.positions[fan.vertex]) << entry.name;
                ++pinned;
            }
        }
    }
    EXPECT_GT(pinned, 0u); // that they are smooth, the continuity tests see

    // Pinning moves what belongs to the vertex, and nothing else.
    const cage::Cage plain = test::perturbed(test::trapezohedron(5), 0.05f, 1);
    cage::Cage sharp = plain;
    sharp.sharpVertices.push_back({0, cage::kHardSharpness});
    const std::vector<glm::dvec3> positions = test::doublePositions(plain);
    const PmSurface<double> before(test::pmMesh(plain), positions);
    const PmSurface<double> after(test::pmMesh(sharp), positions);
    const glm::dvec3 moved = positions[0] - before.coefficients.limitPoints[0];
    EXPECT_GT(glm::length(moved), 0.01);
    for (uint32_t s = 0; s < before.mesh.slotSpokes.size(); ++s) {
        const glm::dvec3 expected = s < before.mesh.fans[0].facets ? moved : glm::dvec3(0.0);
        const Coefficients<double>& b = before.coefficients;
        const Coefficients<double>& a = after.coefficients;
        EXPECT_LE(glm::distance(a.tangents[s] - b.tangents[s], expected), 1e-15);
        EXPECT_LE(glm::distance(a.faceCoefficients[s] - b.faceCoefficients[s], expected), 1e-15);
    }
}

TEST(PmReference, singleFacetCreaseSectorsHaveNormals) {
    // The rim of the cube's lid: in the lid's corners both derivatives run along the crease.
    cage::Cage cage = test::perturbed(test::cube(), 0.1f, 1);
    for (const auto& [a, b] : {std::pair{4u, 5u}, {5u, 7u}, {7u, 6u}, {6u, 4u}}) {
        cage.creases.push_back({a, b, cage::kHardSharpness});
    }
    const std::vector<glm::dvec3> positions = test::doublePositions(cage);
    const PmSurface<double> surface(test::pmMesh(cage), positions);
    const PmSurface<float> rounded(test::pmMesh(cage), cage.positions);
    constexpr uint32_t kLid = 1;
    const Patch<double>& patch = surface.patches[kLid];
    for (uint32_t i = 0; i < 4; ++i) {
        EXPECT_TRUE(patch.singularCorner[i]);
        const Sample<double> sample = surface.onEdge(cage.faceStarts[kLid] + i, 0, 8);
        EXPECT_NEAR(glm::length(sample.normal), 1.0, 1e-12);
        // The normal of nearby points, from either side.
        for (const uint32_t sector : {i, (i + 3) % 4}) {
            const double along = sector == i ? 1e-6 : 1.0 - 2e-6;
            const DomainPoint<double> near{{}, {}, sector, {1.0 - along - 1e-6, along, 1e-6}};
            EXPECT_LE(test::angleDegrees(evaluate(patch, near).normal, sample.normal), 0.5);
        }
        const Sample<float> inFloat = rounded.onEdge(cage.faceStarts[kLid] + i, 0, 8);
        EXPECT_LE(test::angleDegrees(inFloat.normal, sample.normal), 0.1);
    }
}

TEST(PmReference, oneFacetAlone) {
    // All its corners are interpolated, its borders straight, and it is flat.
    for (const uint32_t sides : {3u, 4u, 5u}) {
        const cage::Cage solid = test::prism(sides);
        test::Faces lid(1);
        for (uint32_t i = 0; i < sides; ++i) {
            lid[0].push_back(i);
        }
        const cage::Cage cage = test::makeCage({solid.positions.begin(), solid.positions.begin() + sides}, lid);
        const PmSurface<double> surface(test::pmMesh(cage), test::doublePositions(cage));
        const Domain domain = domainOf(surface.mesh.classes[0]);
        for (uint32_t s = 0; s < sampleCount(domain, 8); ++s) {
            const Sample<double> sample = surface.at(0, 8, s);
            EXPECT_LE(glm::distance(sample.normal, glm::dvec3(0.0, 0.0, 1.0)), 1e-12) << sides;
            EXPECT_NEAR(sample.position.z, cage.positions[0].z, 1e-15);
        }
        for (uint32_t i = 0; i < sides; ++i) {
            const glm::dvec3 a(cage.positions[i]);
            const glm::dvec3 b(cage.positions[(i + 1) % sides]);
            EXPECT_EQ(surface.onEdge(i, 0, 4).position, a);
            EXPECT_LE(glm::distance(surface.onEdge(i, 1, 4).position, 0.75 * a + 0.25 * b), 1e-15);
        }
    }
}

} // namespace
} // namespace supple::surface::pm
