#include "surface/lod/grid.h"

#include "tests/support/lod_levels.h"

#include <cmath>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <set>
#include <string>

namespace supple::surface::lod {
namespace {

constexpr Form kForms[] = {Form::quad, Form::triangleRings, Form::quadRings, Form::pentagonRings};

std::string trace(Form form, uint32_t capacity) {
    return "form " + std::to_string(static_cast<uint32_t>(form)) + ", capacity " + std::to_string(capacity);
}

/// Triangles of the first patch of a draw.
std::vector<std::array<uint32_t, 3>> trianglesOf(Form form, uint32_t capacity) {
    const std::vector<uint16_t> indices = gridIndices(form, capacity);
    std::vector<std::array<uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < indices.size() / patchesPerDraw(form, capacity); i += 3) {
        triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    }
    return triangles;
}

/// Levels of a patch: of its sides; inside along u and v (quads) or one (rings: u).
struct Levels {
    std::vector<float> edges;
    float u = 1.0f;
    float v = 1.0f;
};

Levels randomLevels(std::mt19937& random, Form form, float highest) {
    Levels levels;
    for (uint32_t side = 0; side < sides(form); ++side) {
        levels.edges.push_back(randomLevel(random, highest));
    }
    const bool own = random() % 2 == 0;
    const float ownU = own ? randomLevel(random, highest) : 1.0f;
    const float ownV = own ? randomLevel(random, highest) : 1.0f;
    if (form == Form::quad) {
        const QuadLevels quad =
            quadLevels({levels.edges[0], levels.edges[1], levels.edges[2], levels.edges[3]}, ownU, ownV);
        levels.u = quad.u;
        levels.v = quad.v;
    } else {
        levels.u = std::max(*std::max_element(levels.edges.begin(), levels.edges.end()), ownU);
    }
    return levels;
}

glm::dvec2 cornerPlace(Form form, uint32_t corner) {
    if (form == Form::quad) {
        return {corner == 1 || corner == 2 ? 1.0 : 0.0, corner >= 2 ? 1.0 : 0.0};
    }
    const double angle = 2.0 * std::numbers::pi * (corner % sides(form)) / sides(form);
    return {std::cos(angle), std::sin(angle)};
}

/// Where a sample lies in the unit square or a regular polygon about the origin.
glm::dvec2 place(Form form, uint32_t capacity, uint32_t sample, const Levels& levels) {
    const GridSample at = gridSample(form, capacity, sample);
    if (form == Form::quad) {
        const QuadLevels quad{{levels.edges[0], levels.edges[1], levels.edges[2], levels.edges[3]}, levels.u, levels.v};
        const auto [u, v] = quadParameters(capacity, at.k, at.ring, quad);
        return {u.t, v.t};
    }
    const LevelPair along = levelPair(at.ring == 0 ? levels.edges[at.side] : levels.u);
    const Parameter t = parameter(capacity, at.k, along);
    const float depth = at.ring == 0 ? 0.0f : parameter(capacity, at.ring, levelPair(levels.u)).t;
    return double(t.s - depth) * cornerPlace(form, at.side) + double(t.t - depth) * cornerPlace(form, at.side + 1);
}

std::vector<glm::dvec2> places(Form form, uint32_t capacity, const Levels& levels) {
    std::vector<glm::dvec2> result;
    for (uint32_t sample = 0; sample < sampleCount(form, capacity); ++sample) {
        result.push_back(place(form, capacity, sample, levels));
    }
    return result;
}

double doubleArea(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double doubleArea(Form form) {
    const uint32_t m = sides(form);
    return form == Form::quad ? 2.0 : m * std::sin(2.0 * std::numbers::pi / m);
}

using Point = std::pair<double, double>;
/// Triangles by the places of their corners, the smallest first, without those of two corners.
std::multiset<std::array<Point, 3>> drawn(Form form, uint32_t capacity, const Levels& levels) {
    const std::vector<glm::dvec2> at = places(form, capacity, levels);
    std::multiset<std::array<Point, 3>> result;
    for (const auto& triangle : trianglesOf(form, capacity)) {
        std::array<Point, 3> corners;
        for (uint32_t c = 0; c < 3; ++c) {
            corners[c] = {at[triangle[c]].x + 0.0, at[triangle[c]].y + 0.0}; // one kind of zero
        }
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) {
            std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
            result.insert(corners);
        }
    }
    return result;
}

TEST(LodGrid, samplesAreNumberedOnce) {
    for (const Form form : kForms) {
        for (const uint32_t capacity : kCapacities) {
            SCOPED_TRACE(trace(form, capacity));
            std::set<std::array<uint32_t, 3>> seen;
            for (uint32_t sample = 0; sample < sampleCount(form, capacity); ++sample) {
                const GridSample at = gridSample(form, capacity, sample);
                EXPECT_TRUE(seen.insert({at.ring, at.side, at.k}).second);
                if (form == Form::quad) {
                    EXPECT_TRUE(at.side == 0 && at.ring <= capacity && at.k <= capacity);
                } else {
                    EXPECT_TRUE(at.side < sides(form) && 2 * at.ring < capacity);
                    EXPECT_TRUE(at.k >= at.ring && at.k < capacity - at.ring);
                }
            }
        }
    }
}

TEST(LodGrid, trianglesMakeOneDisc) {
    for (const Form form : kForms) {
        for (const uint32_t capacity : kCapacities) {
            SCOPED_TRACE(trace(form, capacity));
            const auto triangles = trianglesOf(form, capacity);
            const uint32_t m = sides(form);
            EXPECT_EQ(triangles.size(), m * (capacity * capacity - 1) / 2 + m - 2);
            EXPECT_EQ(sampleCount(form, capacity), m * (capacity + 1) * (capacity + 1) / 4);
            std::set<uint32_t> used;
            std::set<std::pair<uint32_t, uint32_t>> directed;
            for (const auto& triangle : triangles) {
                for (uint32_t c = 0; c < 3; ++c) {
                    used.insert(triangle[c]);
                    EXPECT_TRUE(directed.insert({triangle[c], triangle[(c + 1) % 3]}).second);
                }
            }
            EXPECT_EQ(used.size(), sampleCount(form, capacity));
            EXPECT_EQ(*used.rbegin() + 1, sampleCount(form, capacity));
            std::set<std::pair<uint32_t, uint32_t>> border;
            for (const auto& [from, to] : directed) {
                if (directed.count({to, from}) == 0) {
                    border.insert({from, to});
                }
            }
            std::set<std::pair<uint32_t, uint32_t>> expected;
            for (uint32_t side = 0; side < m; ++side) {
                for (uint32_t k = 0; k < capacity; ++k) {
                    expected.insert({edgeSample(form, capacity, side, k), edgeSample(form, capacity, side, k + 1)});
                }
            }
            EXPECT_EQ(expected.size(), std::size_t{m} * capacity);
            EXPECT_EQ(border, expected);
        }
    }
}

TEST(LodGrid, diagonalsPointFromTheNearestCornerInwards) {
    for (const Form form : kForms) {
        for (const uint32_t capacity : kCapacities) {
            SCOPED_TRACE(trace(form, capacity));
            std::set<std::pair<uint32_t, uint32_t>> joined;
            for (const auto& triangle : trianglesOf(form, capacity)) {
                for (uint32_t c = 0; c < 3; ++c) {
                    joined.insert({triangle[c], triangle[(c + 1) % 3]});
                    joined.insert({triangle[(c + 1) % 3], triangle[c]});
                }
            }
            std::map<std::array<uint32_t, 3>, uint32_t> samples;
            for (uint32_t sample = 0; sample < sampleCount(form, capacity); ++sample) {
                const GridSample at = gridSample(form, capacity, sample);
                samples[{at.ring, at.side, at.k}] = sample;
            }
            const uint32_t h = (capacity - 1) / 2;
            const uint32_t sidesHere = form == Form::quad ? 1 : sides(form);
            for (uint32_t ring = 0; ring < (form == Form::quad ? capacity : h); ++ring) {
                for (uint32_t side = 0; side < sidesHere; ++side) {
                    // Cells of a ring's side that lie off the rays and off the middle, where both are as near.
                    const uint32_t first = form == Form::quad ? 0 : ring + 1;
                    for (uint32_t k = first; k + first < capacity; ++k) {
                        if (k == h || (form == Form::quad && ring == h)) {
                            continue;
                        }
                        const auto sample = [&](uint32_t r, uint32_t at) {
                            const auto found = samples.find({r, side, at});
                            return found != samples.end() ? found->second : samples.at({r, (side + 1) % sidesHere, r});
                        };
                        const bool forwards = form == Form::quad ? (k < h) == (ring < h) : k < h;
                        EXPECT_EQ(joined.count({sample(ring, k), sample(ring + 1, k + 1)}), forwards ? 1U : 0U);
                        EXPECT_EQ(joined.count({sample(ring, k + 1), sample(ring + 1, k)}), forwards ? 0U : 1U);
                    }
                }
            }
        }
    }
}

TEST(LodGrid, fourRingsHaveAsManyTrianglesAsTheQuad) {
    for (const uint32_t capacity : kCapacities) {
        EXPECT_EQ(trianglesOf(Form::quadRings, capacity).size(), trianglesOf(Form::quad, capacity).size());
        EXPECT_EQ(trianglesOf(Form::quad, capacity).size(), 2 * std::size_t{capacity} * capacity);
        EXPECT_EQ(sampleCount(Form::quadRings, capacity), sampleCount(Form::quad, capacity));
    }
}

TEST(LodGrid, sidesLieWhereTheirLevelsPutThem) {
    std::mt19937 random(5);
    for (const Form form : kForms) {
        for (const uint32_t capacity : {1U, 3U, 7U, 11U}) {
            SCOPED_TRACE(trace(form, capacity));
            const Levels levels = randomLevels(random, form, static_cast<float>(capacity));
            for (uint32_t side = 0; side < sides(form); ++side) {
                for (uint32_t k = 0; k <= capacity; ++k) {
                    const double t = parameter(capacity, k, levelPair(levels.edges[side])).t;
                    const glm::dvec2 expected =
                        (1.0 - t) * cornerPlace(form, side) + t * cornerPlace(form, (side + 1) % sides(form));
                    const glm::dvec2 found = place(form, capacity, edgeSample(form, capacity, side, k), levels);
                    EXPECT_LT(glm::distance(found, expected), 2e-7) << "side " << side << ", sample " << k;
                }
            }
        }
    }
}

TEST(LodGrid, noTriangleTurnsOverAndNothingIsLeftOut) {
    std::mt19937 random(2);
    for (const Form form : kForms) {
        // Quads are exact: products of differences of monotone numbers. Rings carry the rounding of their weights.
        const double tolerance = form == Form::quad ? 0.0 : 1.5e-7;
        double worst = 0.0;
        double uncovered = 0.0;
        for (const uint32_t capacity : kCapacities) {
            for (uint32_t n = 0; n < (capacity > 15 ? 10U : 60U); ++n) {
                const Levels levels = randomLevels(random, form, static_cast<float>(capacity));
                const std::vector<glm::dvec2> at = places(form, capacity, levels);
                double sum = 0.0;
                for (const auto& triangle : trianglesOf(form, capacity)) {
                    const double area = doubleArea(at[triangle[0]], at[triangle[1]], at[triangle[2]]);
                    worst = std::min(worst, area);
                    sum += area;
                }
                uncovered = std::max(uncovered, std::abs(sum - doubleArea(form)));
            }
        }
        EXPECT_GE(worst, -tolerance) << trace(form, 0);
        EXPECT_LE(uncovered, form == Form::quad ? 1e-12 : 1e-6) << trace(form, 0);
    }
}

TEST(LodGrid, capacityDoesNotShow) {
    std::mt19937 random(3);
    for (const Form form : kForms) {
        for (uint32_t c = 0; c + 1 < kCapacities.size(); ++c) {
            for (uint32_t n = 0; n < 25; ++n) {
                const Levels levels = randomLevels(random, form, static_cast<float>(kCapacities[c]));
                const auto expected = drawn(form, kCapacities[c], levels);
                ASSERT_FALSE(expected.empty());
                const uint32_t larger = c + 1 + static_cast<uint32_t>(random() % (kCapacities.size() - 1 - c));
                ASSERT_TRUE(drawn(form, kCapacities[larger], levels) == expected)
                    << trace(form, kCapacities[c]) << ", drawn at " << kCapacities[larger];
                if (kCapacities[c] > 15 && n >= 3) {
                    break;
                }
            }
        }
    }
}

TEST(LodGrid, theInsideKeepsItsDistanceFromTheBorder) {
    // A row on the border curve but with other samples would stand on the surface as fins.
    std::mt19937 random(4);
    for (uint32_t n = 0; n < 200; ++n) {
        const Levels levels = randomLevels(random, Form::quad, 7.0f);
        if (std::max(levels.u, levels.v) < 3.0f) {
            continue;
        }
        for (uint32_t k = 1; k < 7; ++k) {
            EXPECT_GT(place(Form::quad, 7, 8 + k, levels).y, 0.9 / 7.0);
            EXPECT_GT(place(Form::quad, 7, 8 * k + 1, levels).x, 0.9 / 7.0);
        }
    }
}

TEST(LodGrid, smallGridsShareADraw) {
    for (const Form form : kForms) {
        for (const uint32_t capacity : kCapacities) {
            SCOPED_TRACE(trace(form, capacity));
            const uint32_t patches = patchesPerDraw(form, capacity);
            const uint32_t samples = sampleCount(form, capacity);
            EXPECT_TRUE(patches == 1 || (patches * samples <= 64 && (patches + 1) * samples > 64));
            const std::vector<uint16_t> indices = gridIndices(form, capacity);
            const std::size_t each = indices.size() / patches;
            for (std::size_t i = each; i < indices.size(); ++i) {
                ASSERT_EQ(indices[i], indices[i - each] + samples);
            }
        }
    }
    EXPECT_EQ(patchesPerDraw(Form::quad, 1), 16U);
    EXPECT_EQ(patchesPerDraw(Form::quad, 3), 4U);
}

} // namespace
} // namespace supple::surface::lod
