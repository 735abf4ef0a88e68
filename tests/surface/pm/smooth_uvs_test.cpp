// Smooth texture coordinates of P_m against stored coefficients, and what its patches have in common at their edges.
#include "surface/pm/smooth_uvs.h"
#include "tests/support/json_vectors.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>

namespace supple::surface::pm {
namespace {

using nlohmann::json;

json frameVectors() {
    return test::parseFile(SUPPLE_TEST_DATA "/uvs/attributes_frames.json");
}

cage::Cage frameCage(const json& vectors) {
    const std::vector<glm::dvec3> positions = test::jsonVectors(vectors.at("vertices"));
    cage::Cage cage = test::makeCage({positions.begin(), positions.end()}, vectors.at("faces").get<test::Faces>());
    for (const json& face : vectors.at("uv")) {
        for (const json& uv : face) {
            cage.cornerUvs.emplace_back(uv.at(0).get<float>(), uv.at(1).get<float>());
        }
    }
    return cage;
}

/// The construction of a cage's first UV set.
struct Made {
    explicit Made(const cage::Cage& cage, cage::UvMode mode = cage::UvMode::cornersPlus1)
        : mesh(std::move(*buildMesh(cage))),
          channel(std::move(*cage::buildUvChannel(mesh.cage, mesh.topology,
                                                  {mesh.features.edgeSharpness, mesh.features.vertexSharpness},
                                                  mesh.cage.cornerUvs, mode))),
          uvs(mesh, channel) {}
    Mesh mesh;
    cage::UvChannel channel;
    UvConstruction uvs;
};

TEST(PmSmoothUvs, HaveTheCoefficientsOfTheVectors) {
    const json vectors = frameVectors();
    const Made made(frameCage(vectors));
    double worst = 0.0;
    size_t compared = 0;
    for (const json& stored : vectors.at("patches")) {
        const auto corners = stored.at("corners").get<std::vector<uint32_t>>();
        uint32_t facet = 0;
        while (facet < made.mesh.cage.faceCount() &&
               !(made.mesh.cage.sides(facet) == corners.size() &&
                 std::is_permutation(corners.begin(), corners.end(),
                                     made.mesh.cage.faceVertices.begin() + made.mesh.cage.faceStarts[facet]))) {
            ++facet;
        }
        ASSERT_LT(facet, made.mesh.cage.faceCount());
        ASSERT_EQ(made.mesh.cage.faceVertices[made.mesh.corner(facet, 0)], corners[0]);
        const UvPatch patch = made.uvs.patch(facet);
        const json& coefficients = stored.at("coefficients");
        for (size_t i = 0; i < coefficients.size(); ++i) {
            worst = std::max(worst,
                             glm::distance(patch.c[i], glm::dvec2(coefficients.at(i).at(0), coefficients.at(i).at(1))));
            ++compared;
        }
    }
    std::printf("%zu coefficients, at most %.2e off\n", compared, worst);
    EXPECT_GT(compared, 300u);
    EXPECT_LE(worst, 1e-6);
}

} // namespace
} // namespace supple::surface::pm
