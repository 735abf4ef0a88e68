#include "surface/grid.h"

#include "tests/support/corner_weights.h"

#include <cmath>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <utility>

namespace supple::surface {
namespace {

constexpr Domain kDomains[] = {Domain::quad, Domain::polar, Domain::triangle, Domain::pentagon};
constexpr uint32_t kRates[] = {1, 2, 3, 5, 8, 17, 64};

std::string trace(Domain domain, uint32_t rate) {
    return "domain " + std::to_string(static_cast<uint32_t>(domain)) + ", rate " + std::to_string(rate);
}

/// Where a sample lies in the plane: a square, a disc sector that ends in one point, a triangle, a regular pentagon.
glm::dvec2 place(Domain domain, uint32_t rate, uint32_t sample) {
    const GridSample at = gridSample(domain, rate, sample);
    const double u = double(at.i) / rate;
    const double v = double(at.j) / rate;
    const auto onCircle = [](uint32_t k) {
        const double angle = 2.0 * std::numbers::pi * k / 5.0;
        return glm::dvec2(std::cos(angle), std::sin(angle));
    };
    switch (domain) {
    case Domain::polar:
        return {u * (1.0 - v), v};
    case Domain::pentagon:
        return (1.0 - u - v) * onCircle(at.sector) + u * onCircle(at.sector + 1);
    default:
        return {u, v};
    }
}

glm::dvec2 cornerPlace(Domain domain, uint32_t corner) {
    const double angle = 2.0 * std::numbers::pi * corner / 5.0;
    switch (domain) {
    case Domain::quad:
        return {corner == 1 || corner == 2 ? 1.0 : 0.0, corner >= 2 ? 1.0 : 0.0};
    case Domain::pentagon:
        return {std::cos(angle), std::sin(angle)};
    default:
        return {corner == 1 ? 1.0 : 0.0, corner == 2 ? 1.0 : 0.0};
    }
}

double area(Domain domain) {
    return domain == Domain::quad       ? 1.0
           : domain == Domain::pentagon ? 2.5 * std::sin(2.0 * std::numbers::pi / 5.0)
                                        : 0.5;
}

TEST(Grid, samplesAreNumberedWithoutGaps) {
    for (const Domain domain : kDomains) {
        for (const uint32_t rate : kRates) {
            SCOPED_TRACE(trace(domain, rate));
            std::set<std::pair<uint32_t, std::pair<uint32_t, uint32_t>>> met;
            GridSample last;
            for (uint32_t s = 0; s < sampleCount(domain, rate); ++s) {
                const GridSample at = gridSample(domain, rate, s);
                met.insert({at.sector, {at.i, at.j}});
                EXPECT_LE(at.j, rate);
                EXPECT_LE(domain == Domain::triangle || domain == Domain::pentagon ? at.i + at.j : at.i, rate);
                // By row, i fastest.
                EXPECT_TRUE(s == 0 || at.sector != last.sector || at.j > last.j ||
                            (at.j == last.j && at.i == last.i + 1));
                last = at;
            }
            EXPECT_EQ(met.size(), sampleCount(domain, rate));
        }
    }
    EXPECT_EQ(sampleCount(Domain::quad, 8), 81u);
    EXPECT_EQ(sampleCount(Domain::polar, 8), 81u);
    EXPECT_EQ(sampleCount(Domain::triangle, 8), 45u);
    EXPECT_EQ(sampleCount(Domain::pentagon, 8), 181u);
}

TEST(Grid, edgesRunFromCornerToCorner) {
    for (const Domain domain : kDomains) {
        const uint32_t corners = cornerCount(domain);
        for (const uint32_t rate : kRates) {
            SCOPED_TRACE(trace(domain, rate));
            for (uint32_t e = 0; e < corners; ++e) {
                const glm::dvec2 from = cornerPlace(domain, e);
                const glm::dvec2 to = cornerPlace(domain, (e + 1) % corners);
                for (uint32_t k = 0; k <= rate; ++k) {
                    const uint32_t sample = edgeSample(domain, rate, e, k);
                    ASSERT_LT(sample, sampleCount(domain, rate));
                    const glm::dvec2 expected = from + (to - from) * (double(k) / rate);
                    EXPECT_LE(glm::distance(place(domain, rate, sample), expected), 1e-14);
                }
            }
        }
    }
}

TEST(Grid, trianglesCoverTheDomainOnce) {
    for (const Domain domain : kDomains) {
        for (const uint32_t rate : kRates) {
            SCOPED_TRACE(trace(domain, rate));
            const std::vector<uint16_t> indices = gridIndices(domain, rate);
            ASSERT_EQ(indices.size() % 3, 0u);
            // Samples at one place count as one: the last row of a polar domain.
            std::map<std::pair<long, long>, uint32_t> places;
            const auto id = [&](uint16_t sample) {
                const glm::dvec2 p = place(domain, rate, sample) * 1e6;
                return places.try_emplace({std::lround(p.x), std::lround(p.y)}, places.size()).first->second;
            };
            std::map<std::pair<uint32_t, uint32_t>, uint32_t> halfEdges;
            double sum = 0.0;
            for (size_t t = 0; t < indices.size(); t += 3) {
                const glm::dvec2 a = place(domain, rate, indices[t]);
                const glm::dvec2 b = place(domain, rate, indices[t + 1]) - a;
                const glm::dvec2 c = place(domain, rate, indices[t + 2]) - a;
                const double twice = b.x * c.y - b.y * c.x;
                EXPECT_GT(twice, 1e-6); // counter-clockwise, none of zero area
                sum += 0.5 * twice;
                for (size_t k = 0; k < 3; ++k) {
                    ++halfEdges[{id(indices[t + k]), id(indices[t + (k + 1) % 3])}];
                }
            }
            EXPECT_NEAR(sum, area(domain), 1e-12);
            uint32_t border = 0;
            for (const auto& [ends, count] : halfEdges) {
                EXPECT_EQ(count, 1u);
                border += halfEdges.contains({ends.second, ends.first}) ? 0 : 1;
            }
            EXPECT_EQ(border, cornerCount(domain) * rate);
        }
    }
}

TEST(Grid, cornerWeights) {
    for (const Domain domain : kDomains) {
        for (const uint32_t rate : kRates) {
            SCOPED_TRACE(trace(domain, rate));
            const uint32_t corners = cornerCount(domain);
            for (uint32_t s = 0; s < sampleCount(domain, rate); ++s) {
                const std::array<float, kMaxSides> weights = test::cornerWeights(domain, rate, s);
                EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0f), 1.0f, 1e-6f);
                glm::dvec2 sum(0.0);
                for (uint32_t k = 0; k < corners; ++k) {
                    EXPECT_GE(weights[k], -1e-6f);
                    sum += double(weights[k]) * cornerPlace(domain, k);
                }
                // They reproduce the place of the sample.
                EXPECT_LE(glm::distance(sum, place(domain, rate, s)), 1e-6);
            }
            for (uint32_t e = 0; e < corners; ++e) {
                const std::array<float, kMaxSides> weights =
                    test::cornerWeights(domain, rate, edgeSample(domain, rate, e, 0));
                for (uint32_t k = 0; k < kMaxSides; ++k) {
                    EXPECT_NEAR(weights[k], k == e ? 1.0f : 0.0f, 1e-7f);
                }
            }
        }
    }
}

TEST(Grid, parameterPairs) {
    const std::vector<float> pairs = parameterPairs();
    EXPECT_EQ(SUPPLE_FIRST_PAIR(1u), 0u);
    EXPECT_EQ(pairs.size(), 2 * size_t{SUPPLE_FIRST_PAIR(kMaxRate + 1u)});
    for (uint32_t rate = 1; rate <= kMaxRate; ++rate) {
        for (uint32_t k = 0; k <= rate; ++k) {
            const size_t at = 2 * (size_t{SUPPLE_FIRST_PAIR(rate)} + k);
            EXPECT_EQ(pairs[at], static_cast<float>(double(k) / rate));
            EXPECT_EQ(pairs[at + 1], static_cast<float>(double(rate - k) / rate));
        }
    }
}

} // namespace
} // namespace supple::surface
