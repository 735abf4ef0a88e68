// The blending surface at any parameters, as level of detail evaluates it: against the tables of fixed rates, and the
// bits that two faces share.
#include "shaders/shared/elementary.h"
#include "tests/support/blend_borders.h"
#include "tests/support/lod_levels.h"
#include "tests/support/subdivision_zoo.h"

#include <cstdio>

namespace supple::surface::blend {
namespace {

TEST(BlendLevels, elementaryFunctionsAreExactWhereItMatters) {
    EXPECT_EQ(shared::log2Of(1.0f), 0.0f);
    EXPECT_EQ(shared::exp2Of(0.0f), 1.0f);
    EXPECT_EQ(shared::angleOf(0.0f), 0.0f);
    EXPECT_EQ(shared::sineOf(0.0f), 0.0f);
    EXPECT_EQ(shared::cosineOf(0.0f), 1.0f);
    double power = 0.0, angle = 0.0, sine = 0.0, cosine = 0.0;
    constexpr uint32_t kSteps = 200000;
    for (uint32_t n = 1; n <= kSteps; ++n) {
        const float x = static_cast<float>(n) / kSteps;
        for (const float exponent : {0.1f, 0.25f, 0.4f, 0.5f, 0.6666667f, 1.0f}) {
            const float own = shared::exp2Of(exponent * shared::log2Of(2.0f * x));
            power = std::max(power, std::abs(static_cast<double>(own) -
                                             std::pow(2.0 * static_cast<double>(x), static_cast<double>(exponent))));
        }
        angle = std::max(angle, std::abs(static_cast<double>(shared::angleOf(x)) - std::atan(static_cast<double>(x))));
        const float turn = x * static_cast<float>(0.5 * std::numbers::pi);
        sine =
            std::max(sine, std::abs(static_cast<double>(shared::sineOf(turn)) - std::sin(static_cast<double>(turn))));
        cosine = std::max(cosine,
                          std::abs(static_cast<double>(shared::cosineOf(turn)) - std::cos(static_cast<double>(turn))));
    }
    std::printf("powers within %.1e, angles %.1e, sines %.1e, cosines %.1e\n", power, angle, sine, cosine);
    EXPECT_LT(power, 3e-7);
    EXPECT_LT(angle, 1e-7);
    EXPECT_LT(sine, 2e-7);
    EXPECT_LT(cosine, 2e-7);
}

/// Cages of all kinds, with creases, in both modes.
template <class Visit>
void forEachMesh(uint32_t step, Visit&& visit) {
    for (const CreaseMode mode : test::kCreaseModes) {
        for (size_t z = 0; z < test::subdivisionZoo().size(); z += step) {
            const test::SubdivisionCage& entry = test::subdivisionZoo()[z];
            SCOPED_TRACE(entry.name);
            visit(entry.cage, test::blendMesh(entry.cage, {mode}));
        }
    }
}

TEST(BlendLevels, fixedRatesAreAmongThem) {
    double doubles = 0.0, floats = 0.0, slopes = 0.0;
    uint64_t samples = 0, turned = 0;
    forEachMesh(1, [&](const cage::Cage& cage, const Mesh& mesh) {
        const std::vector<glm::dvec3> positions = test::doublePositions(cage);
        const double size = test::extent(positions);
        const test::BlendSurface<double> exact(mesh, positions);
        const test::BlendSurface<float> rounded(mesh, cage.positions);
        for (const uint32_t rate : {1u, 3u, 7u}) {
            const Evaluator<double> table = exact.at(rate), any = exact.at(1);
            const Evaluator<float> floatTable = rounded.at(rate), floatAny = rounded.at(1);
            const auto pair = [&](uint32_t i) { return glm::dvec2(i, rate - i) / static_cast<double>(rate); };
            for (uint32_t n = 0; n < mesh.cage.faceCount() * (rate + 1) * (rate + 1); ++n, ++samples) {
                const uint32_t f = n / ((rate + 1) * (rate + 1)), i = n % (rate + 1), j = n / (rate + 1) % (rate + 1);
                const Sample<double> a = table.at(f, i, j), b = any.at(f, pair(i), pair(j));
                doubles = std::max(doubles, glm::distance(a.position, b.position) / size);
                const bool corner = (i == 0 || i == rate) && (j == 0 || j == rate);
                if (!corner) {
                    slopes = std::max(slopes, glm::distance(a.du, b.du) + glm::distance(a.dv, b.dv));
                }
                const Sample<float> c = floatTable.at(f, i, j),
                                    d = floatAny.at(f, glm::vec2(pair(i)), glm::vec2(pair(j)));
                floats = std::max(floats, static_cast<double>(glm::distance(c.position, d.position)) / size);
                EXPECT_NEAR(glm::length(d.normal), 1.0f, 1e-5f);
                turned += glm::distance(glm::dvec3(d.normal), b.normal) < 1e-3 ? 0 : 1;
            }
        }
    });
    std::printf(
        "%llu samples: double within %.1e of the extent, slopes %.1e; float %.1e, %llu normals off by 0.06 degrees\n",
        static_cast<unsigned long long>(samples), doubles, slopes, floats, static_cast<unsigned long long>(turned));
    EXPECT_LT(doubles, 1e-14);
    EXPECT_LT(slopes, 1e-12);
    EXPECT_LT(floats, 1e-6);
    EXPECT_LT(static_cast<double>(turned), 1e-3 * static_cast<double>(samples));
}

TEST(BlendLevels, sharedPointsAgree) {
    std::mt19937 random(7);
    uint64_t points = 0, differ = 0, mutated = 0;
    double far = 0.0;
    forEachMesh(1, [&](const cage::Cage& cage, const Mesh& mesh) {
        const std::vector<glm::dvec3> positions = test::doublePositions(cage);
        const test::BlendSurface<float> rounded(mesh, cage.positions);
        const test::BlendSurface<double> exact(mesh, positions);
        const Evaluator<float> evaluator = rounded.at(1);
        const Evaluator<double> reference = exact.at(1);
        const double size = test::extent(positions);
        const auto at = [&](const auto& from, uint32_t corner, auto t) {
            using Pair = decltype(t);
            const Pair zero(0, 1), one(1, 0), back(t.y, t.x);
            const std::array<Pair, 4> u{t, one, back, zero}, v{zero, t, one, back};
            return from.at(corner / 4, u[corner % 4], v[corner % 4]).position;
        };
        for (const cage::Topology::Edge& edge : mesh.topology.edges) {
            if (edge.twin == cage::kNone) {
                continue;
            }
            const lod::LevelPair level = lod::levelPair(lod::randomLevel(random, 63.0f));
            for (uint32_t k = 0; k <= 63; k += 1 + random() % 5) {
                const lod::Parameter p = lod::parameter(63, k, level);
                const glm::vec2 here(p.t, p.s), there(p.s, p.t);
                const glm::vec3 a = at(evaluator, edge.corner, here), b = at(evaluator, edge.twin, there);
                ++points;
                differ += test::sameBits(a, b) ? 0 : 1;
                // A complement that is told from the far end is another number now and then.
                const glm::vec2 wrong(p.s, 1.0f - p.s);
                mutated += test::sameBits(a, at(evaluator, edge.twin, wrong)) ? 0 : 1;
                far = std::max(far, glm::distance(glm::dvec3(a), at(reference, edge.corner, glm::dvec2(here))) / size);
            }
        }
    });
    std::printf("%llu shared points, %llu differ, within %.1e of the extent; %llu with the far end's complement\n",
                static_cast<unsigned long long>(points), static_cast<unsigned long long>(differ), far,
                static_cast<unsigned long long>(mutated));
    EXPECT_GT(points, 100000u);
    EXPECT_EQ(differ, 0u);
    EXPECT_LT(far, 1e-6);
    EXPECT_GT(mutated, 0u);
}

} // namespace
} // namespace supple::surface::blend
