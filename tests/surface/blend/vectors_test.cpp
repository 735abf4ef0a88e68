// The reference against the stored vectors.
#include "tests/support/blend_surface.h"
#include "tests/support/blend_vectors.h"
#include "tests/support/vector_files.h"

#include <algorithm>
#include <cstdio>

namespace supple::surface::blend {
namespace {

using test::BlendSurface;
using test::BlendVectors;

class BlendVectorFiles : public testing::TestWithParam<size_t> {
protected:
    const BlendVectors& v = test::blendVectors()[GetParam()];
    const Mesh mesh = test::blendMesh(v.cage, v.options);
    const BlendSurface<double> surface{mesh, v.positions};
};

double furthest(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z});
}

TEST_P(BlendVectorFiles, kindsOfVertices) {
    for (uint32_t i = 0; i < v.vertices.size(); ++i) {
        const ChartClass& first = mesh.classOf(mesh.chartStarts[i]);
        const std::string expected = v.vertices[i].type == "patch"
                                         ? mesh.topology.boundary[i] != 0 ? "boundary" : "interior"
                                         : v.vertices[i].type;
        EXPECT_EQ(test::kindName(first.kind), expected) << "vertex " << i;
    }
}

TEST_P(BlendVectorFiles, coefficients) {
    uint32_t compared = 0;
    double worst = 0.0;
    for (uint32_t i = 0; i < v.vertices.size(); ++i) {
        const BlendVectors::Vertex& stored = v.vertices[i];
        const uint32_t start = mesh.topology.sectorCorners[mesh.topology.spokeStarts[i]];
        if (start != 4 * stored.firstFace + stored.firstCorner) {
            continue; // the same surface in turned charts
        }
        ++compared;
        const uint32_t first = mesh.chartStarts[i];
        if (stored.type == "curve") {
            const std::vector<glm::dvec3>& q = stored.coefficients[0];
            const ChartCoefficients<double>& c = surface.coefficients[first];
            worst = std::max({worst, furthest(c[0] + c[3] + c[6], q[0]), furthest(c[0] - c[6], q[1]),
                              furthest(c[0] - c[3] + c[6], q[2])});
            continue;
        }
        for (uint32_t side = 0; side < stored.coefficients.size(); ++side) {
            for (uint32_t k = 0; k < kCoefficients; ++k) {
                worst = std::max(worst, furthest(surface.coefficients[first + side][k], stored.coefficients[side][k]));
            }
        }
    }
    EXPECT_GT(compared, v.vertices.size() / 2);
    EXPECT_LT(worst, 1e-12);
}

/// Stored normals of degenerate samples were taken at 1/32 from the border, half a step of rate 16.
TEST_P(BlendVectorFiles, points) {
    const uint32_t stride = 16 / v.grid;
    const Evaluator<double> evaluator = surface.at(16);
    double positions = 0.0, normals = 0.0;
    ASSERT_EQ(v.points.size(), mesh.cage.faceCount());
    for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
        for (uint32_t j = 0; j <= v.grid; ++j) {
            for (uint32_t i = 0; i <= v.grid; ++i) {
                const Sample<double> sample = evaluator.at(f, stride * i, stride * j);
                const uint32_t index = j * (v.grid + 1) + i;
                positions = std::max(positions, furthest(sample.position, v.points[f][index]));
                normals = std::max(normals, furthest(sample.normal, v.normals[f][index]));
            }
        }
    }
    std::printf("%-16s positions %.1e normals %.1e\n", v.name.c_str(), positions, normals);
    EXPECT_LT(positions, 1e-12);
    EXPECT_LT(normals, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Blend, BlendVectorFiles, testing::Range(size_t{0}, test::vectorFiles("blend").size()),
                         [](const auto& i) { return test::vectorFiles("blend")[i.param].stem().string(); });

} // namespace
} // namespace supple::surface::blend
