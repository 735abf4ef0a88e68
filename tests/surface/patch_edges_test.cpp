// What schemes say of the edges of their patches fits together, and is what the records of these patches say.
#include "surface/patch_edges.h"

#include "shaders/shared/pm.h"
#include "surface/patch_records.h"
#include "surface/schemes.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/subdivision_zoo.h"

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>
#include <map>

namespace supple::surface {
namespace {

constexpr SchemeId kWithEdges[] = {SchemeId::prep, SchemeId::pm, SchemeId::catmullClark, SchemeId::loop,
                                   SchemeId::blend};

struct Built {
    Tables tables;
    PatchEdges edges;
};

/// Calls `visit` with all schemes and cages.
template <class Visit>
void forAllEdges(Visit&& visit) {
    std::vector<test::NamedCage> cages{
        {"grid", test::grid(4, 3)}, {"torus", test::torus(6, 5)}, {"polar", test::cappedCylinder(7, 3)}};
    for (const test::PmCage& own : test::pmZoo()) {
        cages.push_back({own.name.c_str(), own.cage});
    }
    for (const test::SubdivisionCage& own : test::subdivisionZoo()) {
        cages.push_back({own.name.c_str(), own.cage});
    }
    for (const SchemeId scheme : kWithEdges) {
        for (const test::NamedCage& own : cages) {
            Built built;
            const Recipe recipe{.scheme = scheme, .rate = 0, .lod = true};
            Result<Tables> tables = schemeOf(scheme).build(recipe, own.cage, &built.edges);
            if (tables) {
                SCOPED_TRACE(std::string(schemeOf(scheme).name) + ", " + own.name);
                built.tables = std::move(*tables);
                visit(built);
            }
        }
    }
}

CubicIndices backwards(const CubicIndices& curve) {
    return {curve[3], curve[2], curve[1], curve[0]};
}

/// A side, and the number of the corner where it ends.
struct Found {
    const PatchSide* side = nullptr;
    uint32_t end = 0;
};

std::map<uint32_t, std::vector<Found>> byEdge(const Built& built) {
    std::map<uint32_t, std::vector<Found>> found;
    for (uint32_t patch = 0; patch < built.tables.patches.size(); ++patch) {
        const std::span<const PatchSide> sides = built.edges.sidesOf(patch);
        for (size_t i = 0; i < sides.size(); ++i) {
            if (!sides[i].isPoint) {
                found[sides[i].edge].push_back({&sides[i], sides[(i + 1) % sides.size()].corner});
            }
        }
    }
    return found;
}

void expectOneEdge(const Found& a, const Found& b) {
    ASSERT_EQ(a.side->borders, b.side->borders);
    ASSERT_EQ(a.side->creased, b.side->creased);
    if (a.side->borders == Borders::cubics) {
        ASSERT_EQ(a.side->curve, backwards(b.side->curve));
    }
    if (a.side->borders == Borders::charts) {
        ASSERT_EQ(a.side->curve, b.side->across);
        ASSERT_EQ(b.side->curve, a.side->across);
    } else if (!a.side->creased) {
        ASSERT_EQ(a.side->corner, b.end);
        ASSERT_EQ(b.side->corner, a.end);
    }
}

TEST(PatchEdges, BothSidesOfAnEdgeSayTheSame) {
    std::map<Borders, size_t> kinds;
    size_t creased = 0, single = 0;
    forAllEdges([&](const Built& built) {
        for (const auto& [edge, sides] : byEdge(built)) {
            ASSERT_LT(edge, built.edges.edgeBound());
            ASSERT_LE(sides.size(), 2u);
            if (sides.size() == 1) {
                ++single;
                continue;
            }
            ASSERT_NO_FATAL_FAILURE(expectOneEdge(sides[0], sides[1]));
            creased += sides[0].side->creased ? 1 : 0;
            ++kinds[sides[0].side->borders];
        }
    });
    EXPECT_EQ(kinds.size(), 6u) << "of all kinds";
    EXPECT_GT(creased, 0u);
    EXPECT_GT(single, 0u);
}

TEST(PatchEdges, EveryEdgeOfASmoothClosedCageHasTwoSides) {
    for (const SchemeId scheme : {SchemeId::prep, SchemeId::pm, SchemeId::catmullClark, SchemeId::blend}) {
        const cage::Cage cage = test::torus(6, 5);
        Built built;
        Result<Tables> tables = schemeOf(scheme).build({.scheme = scheme, .rate = 0, .lod = true}, cage, &built.edges);
        ASSERT_TRUE(tables.ok());
        built.tables = std::move(*tables);
        const auto edges = byEdge(built);
        EXPECT_EQ(edges.size(), 2 * cage.faceCount());
        EXPECT_TRUE(std::ranges::all_of(edges, [](const auto& edge) { return edge.second.size() == 2; }));
    }
}

/// The border of a bicubic patch, as kernels read it from the record.
CubicIndices recordedCurve(const Tables& tables, const uint32_t* record, uint32_t side, bool polar) {
    using namespace shared;
    CubicIndices curve{};
    for (uint32_t k = 0; k < 4; ++k) {
        const uint32_t i[4] = {k, 3, 3 - k, 0}, j[4] = {0, k, 3, 3 - k}, at = 4 * j[side] + i[side];
        const uint32_t corner = polar ? SUPPLE_POLAR_NET_CORNER(at) : SUPPLE_NET_CORNER(at);
        const uint32_t kind = polar ? SUPPLE_POLAR_NET_KIND(at) : SUPPLE_NET_KIND(at);
        const uint32_t point = record[corner], spoke = record[4 + corner];
        curve[k] = kind == shared::kNetPoint     ? point
                   : kind == shared::kNetTangent ? tables.tangents + SUPPLE_SPOKE(spoke)
                                                 : tables.tangents + SUPPLE_NEXT_SPOKE(spoke);
        EXPECT_NE(kind, shared::kNetFace);
    }
    return curve;
}

/// The border of a patch of sectors.
CubicIndices recordedSector(const Tables& tables, const uint32_t* record, uint32_t side, uint32_t sides) {
    using namespace shared;
    const uint32_t next = (side + 1) % sides;
    return {SUPPLE_POINT(record[SUPPLE_PM_POINT_WORD(side)]),
            tables.tangents + SUPPLE_SPOKE(record[SUPPLE_PM_SPOKE_WORD(side)]),
            tables.tangents + SUPPLE_NEXT_SPOKE(record[SUPPLE_PM_SPOKE_WORD(next)]),
            SUPPLE_POINT(record[SUPPLE_PM_POINT_WORD(next)])};
}

TEST(PatchEdges, CurvesAreThoseOfTheRecords) {
    std::map<PatchClass, size_t> compared;
    forAllEdges([&](const Built& built) {
        for (uint32_t p = 0; p < built.tables.patches.size(); ++p) {
            const PatchRange& range = built.tables.rangeOf(p);
            const uint32_t element =
                range.section.table + (p - range.firstPatch) * recordElements(built.tables, range.patchClass);
            const uint32_t* record = &built.tables.words[size_t{4} * element];
            const std::span<const PatchSide> sides = built.edges.sidesOf(p);
            const bool polar = range.patchClass == PatchClass::polar;
            ASSERT_EQ(sides.size(), polar ? 4 : cornerCount(domainOf(range.patchClass)));
            for (uint32_t i = 0; i < sides.size() && rowOf(range.patchClass).borders != Borders::charts; ++i) {
                if (sides[i].borders == Borders::cubics) {
                    const auto m = static_cast<uint32_t>(sides.size());
                    ASSERT_EQ(sides[i].curve, rowOf(range.patchClass).hasSectors()
                                                  ? recordedSector(built.tables, record, i, m)
                                                  : recordedCurve(built.tables, record, i, polar));
                    ++compared[range.patchClass];
                }
            }
        }
    });
    for (const auto& [patchClass, count] : compared) {
        std::printf("%s: %zu sides\n", className(patchClass), count);
    }
    EXPECT_GE(compared.size(), 8u) << "regular, perturbed, polar, p3, p4, p5, and irregular quads with cubic sides";
}

} // namespace
} // namespace supple::surface
