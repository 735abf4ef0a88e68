// The reference against the stored vectors.
#include "tests/support/meshes.h"
#include "tests/support/prep_surface.h"
#include "tests/support/prep_vectors.h"
#include "tests/support/vector_files.h"
#include "tests/support/worst.h"

#include <cstdio>

namespace supple::surface::prep {
namespace {

using test::PrepSurface;
using test::PrepVectors;

class PrepVectorFiles : public testing::TestWithParam<size_t> {};

/// Largest deviations of a surface from the vectors: lengths relative to the extent, normals absolute and in degrees.
struct Deviation {
    double limitPoints = 0.0, limitNormals = 0.0, g = 0.0, h = 0.0, positions = 0.0, normals = 0.0, normalDegrees = 0.0;
};

template <class T>
Deviation deviation(const PrepVectors& v, const PrepSurface<T>& surface) {
    Deviation d;
    const double extent = test::extent(v.positions);
    using test::raise;
    for (uint32_t i = 0; i < v.cage.vertexCount(); ++i) {
        const glm::dvec3 point(surface.coefficients.limitPoints[i]);
        const glm::dvec3 normal(surface.coefficients.limitNormals[i]);
        raise(d.limitPoints, glm::distance(point, v.limitPoints[i]) / extent);
        raise(d.limitNormals, glm::distance(normal, v.limitNormals[i]));
    }
    for (uint32_t f = 0; f < v.cage.faceCount(); ++f) {
        for (size_t i = 0; i < 16; ++i) {
            raise(d.g, glm::distance(glm::dvec3(surface.patches[f].g[i]), v.faces[f].g[i]) / extent);
            raise(d.h, glm::distance(glm::dvec3(surface.patches[f].h[i]), v.faces[f].h[i]) / extent);
        }
        for (uint32_t i = 0; i < 25; ++i) {
            const Sample<T> s = surface.at(f, i % 5, i / 5, 4);
            raise(d.positions, glm::distance(glm::dvec3(s.position), v.faces[f].positions[i]) / extent);
            raise(d.normals, glm::distance(glm::dvec3(s.normal), v.faces[f].normals[i]));
            raise(d.normalDegrees, test::angleDegrees(s.normal, v.faces[f].normals[i]));
        }
    }
    return d;
}

TEST_P(PrepVectorFiles, topology) {
    const PrepVectors& v = test::prepVectors()[GetParam()];
    const Result<cage::Topology> topology = cage::buildTopology(v.cage);
    ASSERT_TRUE(topology.ok()) << topology.error().message;
    for (uint32_t i = 0; i < v.cage.vertexCount(); ++i) {
        EXPECT_EQ(topology->effectiveValence(i), v.effectiveValences[i]);
        EXPECT_EQ(topology->boundary[i] != 0, v.boundary[i]);
    }
}

TEST_P(PrepVectorFiles, inDouble) {
    const PrepVectors& v = test::prepVectors()[GetParam()];
    const Deviation d = deviation(v, PrepSurface<double>(v.cage, v.positions, v.options));
    std::printf("%-26s double: limit points %.1e, limit normals %.1e, g %.1e, h %.1e, positions %.1e, normals %.1e\n",
                v.name.c_str(), d.limitPoints, d.limitNormals, d.g, d.h, d.positions, d.normals);
    EXPECT_LE(d.limitPoints, 1e-12);
    EXPECT_LE(d.limitNormals, 5e-12);
    EXPECT_LE(d.g, 1e-12);
    EXPECT_LE(d.h, 1e-12);
    EXPECT_LE(d.positions, 1e-12);
    EXPECT_LE(d.normals, 5e-12);
}

TEST_P(PrepVectorFiles, inFloat) {
    const PrepVectors& v = test::prepVectors()[GetParam()];
    const Deviation d = deviation(v, PrepSurface<float>(v.cage, v.cage.positions, v.options));
    std::printf("%-26s float: limit points %.1e, g %.1e, h %.1e, positions %.1e, normals %.1e degrees\n",
                v.name.c_str(), d.limitPoints, d.g, d.h, d.positions, d.normalDegrees);
    EXPECT_LE(d.limitPoints, 1e-5);
    EXPECT_LE(d.g, 1e-5);
    EXPECT_LE(d.h, 1e-5);
    EXPECT_LE(d.positions, 1e-5);
    EXPECT_LE(d.normalDegrees, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Prep, PrepVectorFiles, testing::Range(size_t{0}, test::vectorFiles("prep").size()),
                         [](const auto& entry) { return test::vectorFiles("prep")[entry.param].stem().string(); });

TEST(PrepVectorData, allThere) {
    EXPECT_EQ(test::prepVectors().size(), 11u);
}

} // namespace
} // namespace supple::surface::prep
