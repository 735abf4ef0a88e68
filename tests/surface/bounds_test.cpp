// How far surfaces leave the boxes of their cages. Every scheme is linear in the cage's vertices, with weights that sum
// to one: where the negative ones sum to -n, the surface stays within the box made larger by n times its size on every
// side, whatever the positions. n is found by moving one vertex at a time, on cages that have every rule and valence.
#include "surface/schemes.h"

#include "cage/gltf/reader.h"
#include "tests/support/blend_surface.h"
#include "tests/support/pm_surface.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/shared_assets.h"
#include "tests/support/subdivision_surface.h"
#include "tests/support/subdivision_zoo.h"

#include "tools/reference/fragments.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <map>

namespace supple::surface {
namespace {

using Points = std::vector<glm::dvec3>;
/// All samples of a surface over the cage's vertices.
using Evaluate = std::function<Points(const Points&)>;

constexpr uint32_t kRate = 8;

Evaluate evaluator(SchemeId scheme, const cage::Cage& cage, uint32_t rate = kRate) {
    switch (scheme) {
    case SchemeId::prep:
        return [&cage, rate](const Points& positions) {
            Points samples;
            const test::PrepSurface<double> surface(cage, positions);
            for (uint32_t f = 0; f < surface.patches.size(); ++f) {
                for (uint32_t k = 0; k < (rate + 1) * (rate + 1); ++k) {
                    samples.push_back(surface.at(f, k % (rate + 1), k / (rate + 1), rate).position);
                }
            }
            return samples;
        };
    case SchemeId::pm:
        return [mesh = test::pmMesh(cage), rate](const Points& positions) {
            Points samples;
            const test::PmSurface<double> surface(mesh, positions);
            for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
                for (uint32_t k = 0; k < sampleCount(domainOf(mesh.classes[f]), rate); ++k) {
                    samples.push_back(surface.at(f, rate, k).position);
                }
            }
            return samples;
        };
    case SchemeId::blend:
        return [mesh = test::blendMesh(cage), rate](const Points& positions) {
            Points samples;
            const test::BlendSurface<double> surface(mesh, positions);
            const blend::Evaluator<double> evaluator = surface.at(rate);
            for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
                for (uint32_t k = 0; k < (rate + 1) * (rate + 1); ++k) {
                    samples.push_back(evaluator.at(f, k % (rate + 1), k / (rate + 1)).position);
                }
            }
            return samples;
        };
    default:
        return [mesh = test::subdivisionMesh(cage, scheme == SchemeId::loop ? subdivision::Subdivision::loop
                                                                            : subdivision::Subdivision::catmullClark)](
                   const Points& positions) {
            Points samples;
            const Points isolated = subdivision::isolate<double>(mesh, positions);
            subdivision::forEachSector<double>(mesh, isolated, 2, [&](const subdivision::SectorGrid<double>& sector) {
                for (const subdivision::Sample<double>& sample : sector.samples) {
                    samples.push_back(sample.position);
                }
            });
            return samples;
        };
    }
}

/// The largest sum of negative weights of a sample, three vertices at a time.
double negativeWeights(const cage::Cage& cage, const Evaluate& evaluate, const std::string& name) {
    std::vector<double> negative, sum;
    for (uint32_t first = 0; first < cage.vertexCount(); first += 3) {
        Points positions(cage.vertexCount(), glm::dvec3(0.0));
        for (uint32_t k = 0; k < 3 && first + k < positions.size(); ++k) {
            positions[first + k][static_cast<int>(k)] = 1.0;
        }
        const Points samples = evaluate(positions);
        negative.resize(samples.size(), 0.0);
        sum.resize(samples.size(), 0.0);
        for (size_t s = 0; s < samples.size(); ++s) {
            for (int k = 0; k < 3; ++k) {
                sum[s] += samples[s][k];
                negative[s] -= std::min(samples[s][k], 0.0);
            }
        }
    }
    double worst = 0.0;
    for (size_t s = 0; s < sum.size(); ++s) {
        EXPECT_NEAR(sum[s], 1.0, 1e-9) << name;
        worst = std::max(worst, negative[s]);
    }
    return worst;
}

/// How far samples lie outside the box of the cage, in parts of its size along that axis.
double outside(const Points& positions, const Points& samples) {
    glm::dvec3 low(HUGE_VAL), high(-HUGE_VAL);
    for (const glm::dvec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    double worst = 0.0;
    for (const glm::dvec3& p : samples) {
        const glm::dvec3 beyond = glm::max(low - p, p - high);
        for (int axis = 0; axis < 3; ++axis) {
            if (high[axis] > low[axis]) {
                worst = std::max(worst, beyond[axis] / (high[axis] - low[axis]));
            }
        }
    }
    return worst;
}

std::vector<std::pair<std::string, cage::Cage>> zoo(SchemeId scheme) {
    std::vector<std::pair<std::string, cage::Cage>> cages;
    const auto add = [&](const std::string& name, cage::Cage cage) {
        if (cage.vertexCount() <= 120) {
            cages.emplace_back(name, std::move(cage));
        }
    };
    for (uint32_t n = 3; n <= 16; ++n) {
        add("trapezohedron " + std::to_string(n), test::trapezohedron(n));
        add("open fan " + std::to_string(n), test::fan(n, 2, 5.0, false));
    }
    for (const uint32_t n : {24U, 40U, 59U}) {
        add("trapezohedron " + std::to_string(n), test::trapezohedron(n));
        add("open fan " + std::to_string(n), test::fan(n, 1, 5.0, false));
    }
    add("cube", test::cube());
    add("grid", test::grid(4, 4));
    add("jack", test::jack());
    add("biped", test::biped());
    add("torus", test::torus(6, 5));
    if (scheme == SchemeId::pm) {
        for (const test::PmCage& c : test::pmZoo()) {
            add(c.name + ", " + test::pmVariantName(c.variant), c.cage);
        }
    } else if (scheme != SchemeId::prep) {
        for (const test::SubdivisionCage& c : test::subdivisionZoo()) {
            add(c.name, c.cage);
        }
    }
    return cages;
}

class BoundsMargin : public testing::TestWithParam<SchemeId> {};
INSTANTIATE_TEST_SUITE_P(Schemes, BoundsMargin,
                         testing::Values(SchemeId::prep, SchemeId::pm, SchemeId::fragments, SchemeId::loop,
                                         SchemeId::blend));

TEST_P(BoundsMargin, holdsWhateverThePositions) {
    std::map<float, std::pair<double, std::string>> worst; // by margin
    for (const auto& [name, cage] : zoo(GetParam())) {
        const double n = negativeWeights(cage, evaluator(GetParam(), cage), name);
        auto& [most, where] = worst[schemeOf(GetParam()).boundsMargin(cage)];
        if (where.empty() || n > most) {
            most = n;
            where = name;
        }
    }
    EXPECT_EQ(worst.size(), GetParam() == SchemeId::blend || GetParam() == SchemeId::pm ? 2U : 1U);
    for (const auto& [margin, most] : worst) {
        std::printf("%s: negative weights sum to %.4f (%s), margin %.3f\n", schemeOf(GetParam()).name, most.first,
                    most.second.c_str(), static_cast<double>(margin));
        EXPECT_LT(most.first, margin) << most.second;
    }
}

TEST_P(BoundsMargin, isNotReachedByCharacters) {
    uint32_t tested = 0;
    double largest = 0.0;
    for (const std::string& path : test::allCharacters()) {
        const Result<cage::Character> character = cage::readGltfFile(path);
        ASSERT_TRUE(character.ok()) << character.error().message;
        if ((GetParam() == SchemeId::prep && !test::allQuads(character->cage)) ||
            !buildTables({.scheme = GetParam(), .rate = schemeOf(GetParam()).rates == RateRule::any ? 0u : 4u},
                         character->cage)
                 .ok()) {
            continue; // the scheme does not take it
        }
        const Points positions = test::doublePositions(character->cage);
        const double n = outside(positions, evaluator(GetParam(), character->cage, 4)(positions));
        EXPECT_LT(n, schemeOf(GetParam()).boundsMargin(character->cage)) << path;
        largest = std::max(largest, n);
        ++tested;
    }
    std::printf("%s: outside the box by %.5f of its size at most, %u characters\n", schemeOf(GetParam()).name, largest,
                tested);
    EXPECT_GT(tested, 0u);
}

} // namespace
} // namespace supple::surface
