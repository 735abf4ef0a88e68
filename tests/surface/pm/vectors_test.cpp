// The reference against the stored vectors.
#include "tests/support/pm_surface.h"
#include "tests/support/pm_vectors.h"
#include "tests/support/vector_files.h"
#include "tests/support/worst.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

namespace supple::surface::pm {
namespace {

using test::PmSurface;
using test::PmVectors;
using test::raise;

class PmVectorFiles : public testing::TestWithParam<size_t> {
protected:
    const PmVectors& v = test::pmVectors()[GetParam()];
};

/// Where a stored fan lies in the mesh. Edge j of it is edge slot(j) here.
struct Located {
    uint32_t fan = cage::kNone;
    uint32_t shift = 0;
};

Located locate(const Mesh& mesh, const PmVectors::Fan& stored) {
    const uint32_t facet = stored.faces.front();
    for (uint32_t c = mesh.cage.faceStarts[facet]; c < mesh.cage.faceStarts[facet + 1]; ++c) {
        if (mesh.cage.faceVertices[c] == stored.vertex) {
            const uint32_t fan = mesh.corners[c].fan;
            return {fan, mesh.corners[c].slot - mesh.fans[fan].firstSlot};
        }
    }
    return {};
}

uint32_t slotOf(const Mesh& mesh, const Located& at, uint32_t j) {
    const Fan& fan = mesh.fans[at.fan];
    return fan.firstSlot + (fan.closed() ? (at.shift + j) % fan.facets : j);
}

TEST_P(PmVectorFiles, facesAndClasses) {
    const Mesh mesh = v.mesh();
    test::Faces faces;
    for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
        faces.emplace_back(mesh.cage.faceVertices.begin() + mesh.cage.faceStarts[f],
                           mesh.cage.faceVertices.begin() + mesh.cage.faceStarts[f + 1]);
    }
    EXPECT_EQ(faces, v.faces);
    EXPECT_EQ(mesh.sourceFaces, v.sourceFaces);
    std::set<uint32_t> apexes;
    ASSERT_EQ(mesh.classes.size(), v.patches.size());
    for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
        EXPECT_EQ(mesh.classes[f], v.patches[f].patchClass) << f;
        for (uint32_t i = 0; i < mesh.cage.sides(f); ++i) {
            EXPECT_EQ(mesh.cage.faceVertices[mesh.corner(f, i)], v.patches[f].corners[i]);
        }
        if (mesh.classes[f] == PatchClass::polar) {
            apexes.insert(mesh.cage.faceVertices[mesh.corner(f, 2)]);
        }
    }
    EXPECT_EQ(std::vector<uint32_t>(apexes.begin(), apexes.end()), v.apexes);
}

TEST_P(PmVectorFiles, fans) {
    const Mesh mesh = v.mesh();
    ASSERT_EQ(mesh.fans.size(), v.fans.size());
    std::set<uint32_t> met;
    for (const PmVectors::Fan& stored : v.fans) {
        const Located at = locate(mesh, stored);
        ASSERT_NE(at.fan, cage::kNone);
        met.insert(at.fan);
        const Fan& fan = mesh.fans[at.fan];
        EXPECT_EQ(fan.vertex, stored.vertex);
        EXPECT_EQ(fan.kind, stored.kind);
        EXPECT_EQ(fan.angle(), (FacetAngle{1, stored.valence}));
        ASSERT_EQ(fan.facets, stored.faces.size());
        ASSERT_EQ(fan.edges(), stored.edges.size());
        EXPECT_TRUE(fan.closed() || at.shift == 0);
        for (uint32_t j = 0; j < fan.edges(); ++j) {
            const uint32_t spoke = mesh.slotSpokes[slotOf(mesh, at, j)];
            EXPECT_EQ(mesh.topology.spokeVertices[spoke], stored.edges[j]);
            if (j < fan.facets) {
                EXPECT_EQ(mesh.topology.cornerFaces[mesh.topology.sectorCorners[spoke]], stored.faces[j]);
            }
        }
    }
    EXPECT_EQ(met.size(), v.fans.size());
}

/// Largest deviations of a surface from the vectors: lengths relative to the extent, normals absolute and in degrees.
struct Deviation {
    double limitPoints = 0.0, taus = 0.0, tangents = 0.0, faceCoefficients = 0.0;
    double coefficients = 0.0, positions = 0.0, normals = 0.0, normalDegrees = 0.0;
};

template <class T>
Deviation deviation(const PmVectors& v, const PmSurface<T>& surface) {
    const Mesh& mesh = surface.mesh;
    const Coefficients<T>& c = surface.coefficients;
    const double extent = test::extent(v.positions);
    const auto apart = [extent](const glm::vec<3, T>& a, const glm::dvec3& b) {
        return glm::distance(glm::dvec3(a), b) / extent;
    };
    Deviation d;
    for (const PmVectors::Fan& stored : v.fans) {
        const Located at = locate(mesh, stored);
        raise(d.limitPoints, apart(c.limitPoints[at.fan], stored.v));
        for (uint32_t j = 0; j < stored.t.size(); ++j) {
            raise(d.tangents, apart(c.tangents[slotOf(mesh, at, j)], stored.t[j]));
        }
        for (uint32_t j = 0; j < stored.f.size(); ++j) {
            raise(d.faceCoefficients, apart(c.faceCoefficients[slotOf(mesh, at, j)], stored.f[j]));
        }
        // tau1 points to the first edge: ours, turned to theirs.
        const double angle = 2.0 * std::numbers::pi * at.shift / stored.valence;
        const glm::dvec3 tau1(c.tau1[at.fan]);
        const glm::dvec3 tau2(c.tau2[at.fan]);
        raise(d.taus, apart(std::cos(angle) * tau1 + std::sin(angle) * tau2, stored.tau1));
        raise(d.taus, apart(std::cos(angle) * tau2 - std::sin(angle) * tau1, stored.tau2));
    }
    for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
        const Patch<T>& patch = surface.patches[f];
        EXPECT_EQ(patch.count, v.patches[f].coefficients.size());
        for (uint32_t i = 0; i < patch.count; ++i) {
            raise(d.coefficients, apart(patch.c[i], v.patches[f].coefficients[i]));
        }
        for (const PmVectors::Sample& stored : v.patches[f].samples) {
            DomainPoint<T> at;
            const std::vector<double>& p = stored.at;
            if (p.size() == 2) {
                at.u = {T(p[0]), T(1.0 - p[0])};
                at.v = {T(p[1]), T(1.0 - p[1])};
            } else {
                at.sector = static_cast<uint32_t>(p[0]);
                at.weights = {T(1.0 - p[1] - p[2]), T(p[1]), T(p[2])};
            }
            const Sample<T> sample = evaluate<T>(patch, at);
            raise(d.positions, apart(sample.position, stored.position));
            raise(d.normals, glm::distance(glm::dvec3(sample.normal), stored.normal));
            raise(d.normalDegrees, test::angleDegrees(sample.normal, stored.normal));
        }
    }
    return d;
}

TEST_P(PmVectorFiles, inDouble) {
    const Deviation d = deviation(v, PmSurface<double>(v.mesh(), v.positions));
    std::printf("%-20s double: v %.1e, tau %.1e, t %.1e, f %.1e, coefficients %.1e, positions %.1e, normals %.1e\n",
                v.name.c_str(), d.limitPoints, d.taus, d.tangents, d.faceCoefficients, d.coefficients, d.positions,
                d.normals);
    EXPECT_LE(d.limitPoints, 1e-12);
    EXPECT_LE(d.taus, 1e-12);
    EXPECT_LE(d.tangents, 1e-12);
    EXPECT_LE(d.faceCoefficients, 1e-12);
    EXPECT_LE(d.coefficients, 1e-12);
    EXPECT_LE(d.positions, 1e-12);
    EXPECT_LE(d.normals, 1e-12);
}

TEST_P(PmVectorFiles, inFloat) {
    const Deviation d = deviation(v, PmSurface<float>(v.mesh(), v.cage.positions));
    std::printf("%-20s float: v %.1e, t %.1e, f %.1e, coefficients %.1e, positions %.1e, normals %.1e degrees\n",
                v.name.c_str(), d.limitPoints, d.tangents, d.faceCoefficients, d.coefficients, d.positions,
                d.normalDegrees);
    EXPECT_LE(d.limitPoints, 1e-6);
    EXPECT_LE(d.tangents, 1e-6);
    EXPECT_LE(d.faceCoefficients, 1e-6);
    EXPECT_LE(d.coefficients, 1e-6);
    EXPECT_LE(d.positions, 1e-6);
    EXPECT_LE(d.normalDegrees, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Pm, PmVectorFiles, testing::Range(size_t{0}, test::vectorFiles("pm").size()),
                         [](const auto& entry) { return test::vectorFiles("pm")[entry.param].stem().string(); });

TEST(PmVectorData, allThere) {
    EXPECT_EQ(test::pmVectors().size(), 12u);
}

} // namespace
} // namespace supple::surface::pm
