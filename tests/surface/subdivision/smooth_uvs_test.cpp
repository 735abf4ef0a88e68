// Smooth texture coordinates of Catmull-Clark and Loop, in all modes, against stored limits.
#include "surface/fragments/smooth_uvs.h"
#include "tests/support/json_vectors.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace supple::surface::subdivision {

using fragments::limitUvs, fragments::UvSample;
namespace {

using cage::UvMode;
using nlohmann::json;

json fvarVectors() {
    for (const std::filesystem::path& path : test::vectorFiles("uvs")) {
        if (path.stem() == "attributes_fvar") {
            return test::parseFile(path);
        }
    }
    return {};
}

/// The cage of the vectors: random seams, creases, a semi-sharp vertex.
RefinedMesh cageOf(const json& vectors) {
    const std::vector<glm::dvec3> positions = test::jsonVectors(vectors.at("vertices"));
    cage::Cage cage = test::makeCage({positions.begin(), positions.end()}, vectors.at("faces").get<test::Faces>());
    for (const json& face : vectors.at("uv")) {
        for (const json& uv : face) {
            cage.cornerUvs.emplace_back(uv.at(0).get<float>(), uv.at(1).get<float>());
        }
    }
    for (const json& crease : vectors.at("creases")) {
        cage.creases.push_back({crease.at(0), crease.at(1), crease.at(2)});
    }
    for (const json& corner : vectors.at("corners")) {
        cage.sharpVertices.push_back({corner.at(0), corner.at(1)});
    }
    std::vector<std::string> notes;
    Result<RefinedMesh> mesh = beginRefinement(cage, nullptr, notes);
    EXPECT_TRUE(mesh);
    return std::move(*mesh);
}

class SmoothUvModes : public testing::TestWithParam<UvMode> {};

TEST_P(SmoothUvModes, HaveTheLimitsOfTheVectors) {
    const json vectors = fvarVectors();
    const RefinedMesh mesh = cageOf(vectors);
    const UvMode mode = GetParam();
    const uint32_t level = vectors.at("level");
    const Result<std::vector<UvSample>> samples =
        limitUvs(mesh, mesh.cage.cornerUvs, {Subdivision::catmullClark, 1, level - 1, mode, false});
    ASSERT_TRUE(samples) << samples.error().message;
    const json& expected = vectors.at("modes").at(cage::uvModeName(mode));
    const uint32_t half = 1u << (level - 1), perFace = (half + 1) * (half + 1);
    double worst = 0.0;
    size_t found = 0;
    for (size_t i = 0; i < expected.size(); ++i) {
        const json& at = vectors.at("at").at(i);
        const uint32_t face = at.at(0);
        // By quarters of the face, each a face of the isolated mesh that begins at its corner.
        const int x = static_cast<int>(std::lround(at.at(1).get<double>() * 2 * half));
        const int y = static_cast<int>(std::lround(at.at(2).get<double>() * 2 * half));
        const int n = static_cast<int>(2 * half);
        const std::array<glm::ivec2, 4> local{{{x, y}, {y, n - x}, {n - x, n - y}, {n - y, x}}};
        for (uint32_t c = 0; c < 4; ++c) {
            if (local[c].x > static_cast<int>(half) || local[c].y > static_cast<int>(half)) {
                continue;
            }
            const UvSample& sample =
                (*samples)[size_t{perFace} * (4 * face + c) + static_cast<uint32_t>(local[c].y) * (half + 1) +
                           static_cast<uint32_t>(local[c].x)];
            worst =
                std::max(worst, glm::distance(sample.value, glm::dvec2(expected.at(i).at(0), expected.at(i).at(1))));
            ++found;
        }
    }
    std::printf("%s: %zu samples, at most %.2e off\n", cage::uvModeName(mode), found, worst);
    EXPECT_GE(found, expected.size());
    EXPECT_LE(worst, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(All, SmoothUvModes,
                         testing::Values(UvMode::none, UvMode::cornersOnly, UvMode::cornersPlus1, UvMode::cornersPlus2,
                                         UvMode::boundaries));

/// A flat cage whose texture coordinates are an affine image of its positions: all limits are the same image of the
/// surface, slopes are constant.
TEST(SmoothUvs, OfAnAffineMapAreThatMap) {
    for (const Subdivision subdivision : {Subdivision::catmullClark, Subdivision::loop}) {
        cage::Cage cage;
        cage.faceStarts.push_back(0);
        const uint32_t n = 4;
        for (uint32_t j = 0; j <= n; ++j) {
            for (uint32_t i = 0; i <= n; ++i) {
                cage.positions.emplace_back(i, j, 0.0f);
            }
        }
        const auto add = [&](std::initializer_list<uint32_t> vertices) {
            cage.faceVertices.insert(cage.faceVertices.end(), vertices);
            cage.faceStarts.push_back(static_cast<uint32_t>(cage.faceVertices.size()));
        };
        for (uint32_t j = 0; j < n; ++j) {
            for (uint32_t i = 0; i < n; ++i) {
                const uint32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
                if (subdivision == Subdivision::catmullClark) {
                    add({a, b, c, d});
                } else {
                    add({a, b, d});
                    add({b, c, d});
                }
            }
        }
        for (const uint32_t v : cage.faceVertices) {
            const glm::vec3 p = cage.positions[v];
            cage.cornerUvs.emplace_back(0.25f * p.x + 0.5f * p.y, 0.125f * p.x - 0.25f * p.y);
        }
        std::vector<std::string> notes;
        const Result<RefinedMesh> mesh = beginRefinement(cage, nullptr, notes);
        ASSERT_TRUE(mesh);
        const Result<std::vector<UvSample>> samples =
            limitUvs(*mesh, cage.cornerUvs, {subdivision, 1, 2, UvMode::cornersPlus1, true});
        ASSERT_TRUE(samples);
        // A face of the isolated mesh inside, away from borders: the first of the children of face (1, 1).
        const uint32_t face = subdivision == Subdivision::catmullClark ? 4 * (n + 1) : 4 * 2 * (n + 1);
        const uint32_t perFace = subdivision == Subdivision::catmullClark ? 25 : 15;
        const glm::dvec2 along = glm::dvec2(0.25, 0.125) / 8.0, across = glm::dvec2(0.5, -0.25) / 8.0;
        const glm::dvec2 origin(0.75, -0.125);
        uint32_t index = face * perFace;
        for (uint32_t j = 0; j <= 4; ++j) {
            for (uint32_t i = 0; i <= (subdivision == Subdivision::loop ? 4 - j : 4); ++i, ++index) {
                const UvSample& sample = (*samples)[index];
                const double x = i, y = j;
                EXPECT_LT(glm::distance(sample.value, origin + x * along + y * across), 1e-12);
                EXPECT_LT(glm::distance(sample.u, along), 1e-12);
                EXPECT_LT(glm::distance(sample.v, across), 1e-12);
            }
        }
    }
}

} // namespace
} // namespace supple::surface::subdivision
