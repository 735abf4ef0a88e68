// The cage as P_m sees it: fans, alphas, facet classes, splits, refusals.
#include "tests/support/meshes.h"
#include "tests/support/pm_surface.h"
#include "tests/support/pm_zoo.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace supple::surface::pm {
namespace {

using test::Faces;
using test::makeCage;
using test::PmCage;
using test::pmMesh;
using test::pmZoo;

std::string refusalOf(const cage::Cage& cage) {
    const Result<Mesh> mesh = buildMesh(cage);
    if (mesh.ok()) {
        return "accepted";
    }
    EXPECT_EQ(mesh.error().code, ErrorCode::asset);
    return mesh.error().message;
}

std::map<PatchClass, uint32_t> countClasses(const Mesh& mesh) {
    std::map<PatchClass, uint32_t> counts;
    for (const PatchClass c : mesh.classes) {
        ++counts[c];
    }
    return counts;
}

TEST(PmMesh, alphaOfSharpness) {
    EXPECT_EQ(alphaOfSharpness(0.0), kSmoothAlpha);
    EXPECT_DOUBLE_EQ(alphaOfSharpness(1.0), 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(alphaOfSharpness(3.5), 2.0 / 3.0 / std::pow(2.0, 3.5));
    EXPECT_EQ(alphaOfSharpness(std::numeric_limits<double>::infinity()), kLeastAlpha);
    EXPECT_EQ(static_cast<float>(alphaOfSharpness(-0.5849625f)), 1.0f);
    EXPECT_EQ(alphaOfSharpness(-2.0), 1.0);
}

/// Everything mesh.h promises of slots, fans and corners, against the topology.
void checkSectors(const Mesh& mesh) {
    const cage::Topology& t = mesh.topology;
    const uint32_t cornerCount = mesh.cage.cornerCount();
    ASSERT_EQ(mesh.corners.size(), cornerCount);
    ASSERT_EQ(mesh.slotAlphas.size(), mesh.slotSpokes.size());
    uint32_t slots = 0;
    uint32_t facets = 0;
    for (size_t s = 0; s < mesh.fans.size(); ++s) {
        const Fan& fan = mesh.fans[s];
        EXPECT_EQ(fan.firstSlot, slots);
        EXPECT_TRUE(s == 0 || mesh.fans[s - 1].vertex <= fan.vertex);
        slots += fan.edges();
        facets += fan.facets;
        uint32_t cuts = 0;
        bool creased = false;
        for (uint32_t j = 0; j < fan.edges(); ++j) {
            const uint32_t spoke = mesh.slotSpokes[fan.firstSlot + j];
            EXPECT_GE(spoke, t.spokeStarts[fan.vertex]);
            EXPECT_LT(spoke, t.spokeStarts[fan.vertex + 1]);
            const bool cut = mesh.features.hard(cage::spokeEdge(mesh.cage, t, spoke));
            cuts += cut ? 1 : 0;
            const bool end = !fan.closed() && (j == 0 || j == fan.facets);
            EXPECT_TRUE(fan.closed() || cut == end);
            creased = creased || mesh.slotAlphas[fan.firstSlot + j] != kSmoothAlpha;
            EXPECT_TRUE(!end || mesh.slotAlphas[fan.firstSlot + j] == kSmoothAlpha);
        }
        EXPECT_EQ(creased, fan.creased);
        EXPECT_TRUE(!fan.closed() || cuts < 2);
        EXPECT_EQ(fan.pinned, fan.closed() && mesh.features.vertexSharpness[fan.vertex] >= cage::kHardSharpness);
    }
    EXPECT_EQ(slots, mesh.slotSpokes.size());
    EXPECT_EQ(facets, cornerCount);
    for (uint32_t c = 0; c < cornerCount; ++c) {
        const FacetCorner& corner = mesh.corners[c];
        const Fan& fan = mesh.fans[corner.fan];
        const uint32_t facet = t.cornerFaces[c];
        const uint32_t back = cage::previousCorner(mesh.cage, facet, c);
        EXPECT_EQ(fan.vertex, mesh.cage.faceVertices[c]);
        EXPECT_GE(corner.slot, fan.firstSlot);
        EXPECT_LT(corner.slot, fan.firstSlot + fan.facets);
        EXPECT_EQ(mesh.slotSpokes[corner.slot], t.cornerSpokes[c]);
        EXPECT_EQ(mesh.slotSpokes[corner.slotBack], t.cornerSpokesBack[c]);
        const auto facetAt = [&](uint32_t slot) { return t.cornerFaces[t.sectorCorners[mesh.slotSpokes[slot]]]; };
        // Across an edge lies the facet of the twin, in the same fan unless the edge ends it.
        const bool ends = !fan.closed() && mesh.features.hard(t.cornerEdges[c]);
        const bool endsBack = !fan.closed() && mesh.features.hard(t.cornerEdges[back]);
        EXPECT_EQ(corner.across == cage::kNone, ends);
        EXPECT_EQ(corner.acrossBack == cage::kNone, endsBack);
        EXPECT_TRUE(ends || facetAt(corner.across) == t.cornerFaces[t.twins[c]]);
        EXPECT_TRUE(endsBack || facetAt(corner.acrossBack) == t.cornerFaces[t.twins[back]]);
    }
}

TEST(PmMesh, sectorsOfTheZoo) {
    std::set<FanKind> kinds;
    bool pinned = false;
    bool creased = false;
    for (const PmCage& entry : pmZoo()) {
        SCOPED_TRACE(entry.name);
        const Mesh mesh = pmMesh(entry.cage);
        checkSectors(mesh);
        for (const Fan& fan : mesh.fans) {
            kinds.insert(fan.kind);
            pinned = pinned || fan.pinned;
            creased = creased || fan.creased;
        }
    }
    EXPECT_EQ(kinds.size(), 4u);
    EXPECT_TRUE(pinned);
    EXPECT_TRUE(creased);
}

TEST(PmMesh, kindsOfSectors) {
    // Vertex 4 of a 2 x 2 grid has four facets; edges from it go to 1, 3, 5, 7.
    using Kinds = std::multiset<std::pair<FanKind, uint32_t>>;
    const auto kindsAt4 = [](const std::vector<uint32_t>& hardTo, bool sharp) {
        cage::Cage cage = test::grid(2, 2);
        for (const uint32_t to : hardTo) {
            cage.creases.push_back({4, to, 12.0f});
        }
        if (sharp) {
            cage.sharpVertices.push_back({4, cage::kHardSharpness});
        }
        const Mesh mesh = pmMesh(cage);
        Kinds kinds;
        for (const Fan& fan : mesh.fans) {
            if (fan.vertex == 4) {
                EXPECT_EQ(fan.angle().part, 1u);
                kinds.insert({fan.kind, fan.angle().whole});
            }
        }
        return kinds;
    };
    EXPECT_EQ(kindsAt4({}, false), (Kinds{{FanKind::interior, 4}}));
    EXPECT_EQ(kindsAt4({}, true), (Kinds{{FanKind::interior, 4}}));
    EXPECT_EQ(kindsAt4({1}, false), (Kinds{{FanKind::interior, 4}}));
    EXPECT_EQ(kindsAt4({1, 7}, false), (Kinds{{FanKind::crease, 4}, {FanKind::crease, 4}}));
    EXPECT_EQ(kindsAt4({1, 3}, false), (Kinds{{FanKind::crease, 2}, {FanKind::crease, 6}}));
    EXPECT_EQ(kindsAt4({1, 7}, true), (Kinds{{FanKind::straight, 4}, {FanKind::straight, 4}}));
    // Between edges at a right angle a flag makes corners, of one facet and of three quarters of a turn.
    EXPECT_EQ(kindsAt4({1, 3}, true), (Kinds{{FanKind::corner, 4}, {FanKind::corner, 4}}));
    EXPECT_EQ(kindsAt4({1, 3, 5}, false), (Kinds{{FanKind::corner, 4}, {FanKind::corner, 4}, {FanKind::straight, 4}}));
    EXPECT_EQ(kindsAt4({1, 3, 5, 7}, false),
              (Kinds{{FanKind::corner, 4}, {FanKind::corner, 4}, {FanKind::corner, 4}, {FanKind::corner, 4}}));
}

TEST(PmMesh, alphas) {
    cage::Cage cage = test::torus(6, 5);
    cage.creases = {{0, 5, 1.0f}, {5, 10, 9.5f}, {10, 15, 10.0f}};
    cage.creaseScalars = {{0, 1, 0.25f}, {5, 0, 0.5f}, {0, 4, static_cast<float>(kSmoothAlpha)}, {10, 15, 0.125f}};
    const Mesh mesh = pmMesh(cage);
    const auto alpha = [&](uint32_t vertex, uint32_t toward) {
        for (uint32_t slot = 0; slot < mesh.slotSpokes.size(); ++slot) {
            const uint32_t spoke = mesh.slotSpokes[slot];
            if (mesh.topology.spokeVertices[spoke] == toward && spoke >= mesh.topology.spokeStarts[vertex] &&
                spoke < mesh.topology.spokeStarts[vertex + 1]) {
                return mesh.slotAlphas[slot];
            }
        }
        return -1.0;
    };
    EXPECT_EQ(alpha(0, 5), alphaOfSharpness(1.0));
    EXPECT_EQ(alpha(5, 0), 0.5); // given
    EXPECT_EQ(alpha(0, 1), 0.25);
    EXPECT_EQ(alpha(1, 0), kSmoothAlpha); // the other end has its own
    EXPECT_EQ(alpha(0, 4), kSmoothAlpha); // 2/3 as a float is smooth
    EXPECT_EQ(alpha(5, 10), alphaOfSharpness(9.5));
    EXPECT_EQ(alpha(15, 10), kSmoothAlpha); // a dart's tip
    EXPECT_EQ(alpha(10, 15), 0.125);        // the other, where a scalar is given
}

TEST(PmMesh, creaseSets) {
    cage::Cage cage = test::torus(6, 5);
    cage.creaseSets = {"a", "b"};
    cage.creases = {{0, 5, 0.0f, 0}, {5, 10, 10.0f, 0}, {10, 15, 10.0f, cage::kNone}, {15, 20, 2.0f, 1}};
    cage.creaseScalars = {{0, 5, 0.0f}};
    const Mesh mesh = pmMesh(cage);
    EXPECT_EQ(mesh.notes,
              (std::vector<std::string>{"crease set \"a\": 1 edge is hard or a boundary: edge (5, 10), which "
                                        "no instance can change"}));
    std::map<uint32_t, uint32_t> variable; // vertex -> how many of its slots are in a set
    for (const Fan& fan : mesh.fans) {
        uint32_t slots = 0;
        for (uint32_t j = 0; j < fan.edges(); ++j) {
            slots += mesh.slotSets[fan.firstSlot + j] != cage::kNone ? 1 : 0;
        }
        EXPECT_EQ(fan.variable, slots > 0);
        variable[fan.vertex] += slots;
    }
    EXPECT_EQ(variable[0], 1u);
    EXPECT_EQ(variable[5], 1u);
    EXPECT_EQ(variable[10], 0u) << "hard edges are none of the set";
    EXPECT_EQ(variable[20], 1u);
    const auto given = std::count(mesh.slotGivens.begin(), mesh.slotGivens.end(), uint8_t{1});
    EXPECT_EQ(given, 1);
    EXPECT_EQ(*std::min_element(mesh.slotAlphas.begin(), mesh.slotAlphas.end()), kLeastAlpha) << "of 0";
}

TEST(PmMesh, classes) {
    using Classes = std::map<PatchClass, uint32_t>;
    EXPECT_EQ(countClasses(pmMesh(test::torus(6, 5))), (Classes{{PatchClass::regular, 30}}));
    EXPECT_EQ(countClasses(pmMesh(test::cube())), (Classes{{PatchClass::p4, 6}}));
    EXPECT_EQ(countClasses(pmMesh(test::prism(5))), (Classes{{PatchClass::p4, 5}, {PatchClass::p5, 2}}));
    EXPECT_EQ(countClasses(pmMesh(test::cappedCylinder(7, 3))),
              (Classes{{PatchClass::regular, 14}, {PatchClass::polar, 14}}));
    // Both apexes of a bipyramid; in the octahedron all six vertices could be apexes, so none is.
    EXPECT_EQ(countClasses(pmMesh(test::cappedCylinder(5, 1))), (Classes{{PatchClass::polar, 10}}));
    EXPECT_EQ(countClasses(pmMesh(test::cappedCylinder(4, 1))), (Classes{{PatchClass::p3, 8}}));
    // Valence 5 at the rim.
    EXPECT_EQ(countClasses(pmMesh(test::gyroBipyramid(6))), (Classes{{PatchClass::p3, 24}}));
    // Boundary corners and crease vertices of two facets count as valence 4.
    EXPECT_EQ(countClasses(pmMesh(test::grid(1, 1))), (Classes{{PatchClass::regular, 1}}));
    EXPECT_EQ(countClasses(pmMesh(test::grid(3, 2))), (Classes{{PatchClass::regular, 6}}));
}

TEST(PmMesh, polarFansAndCreases) {
    const cage::Cage plain = test::cappedCylinder(6, 3);
    const uint32_t top = 19;
    const uint32_t rim = 12; // the first of the six vertices round the top
    const auto polarFacets = [](const cage::Cage& cage) {
        const Mesh mesh = pmMesh(cage);
        uint32_t polar = 0;
        for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
            if (mesh.classes[f] == PatchClass::polar) {
                ++polar;
                EXPECT_EQ(mesh.cage.faceVertices[mesh.corner(f, 2)] / 2, 9u); // an apex, 18 or 19, is the last corner
            }
        }
        return polar;
    };
    EXPECT_EQ(polarFacets(plain), 12u);
    EXPECT_EQ(polarFacets(test::rotatedFaces(plain)), 12u);
    cage::Cage soft = plain;
    soft.creases.push_back({top, rim, 5.0f});
    EXPECT_EQ(polarFacets(soft), 12u);
    cage::Cage hard = plain;
    hard.creases.push_back({top, rim, cage::kHardSharpness});
    EXPECT_EQ(polarFacets(hard), 6u);
    cage::Cage ring = plain; // two facets inside at every rim vertex
    for (uint32_t i = 0; i < 6; ++i) {
        ring.creases.push_back({rim + i, rim + (i + 1) % 6, cage::kHardSharpness});
    }
    EXPECT_EQ(polarFacets(ring), 12u);
    ring.sharpVertices.push_back({rim, cage::kHardSharpness}); // now a corner of valence 8
    EXPECT_EQ(polarFacets(ring), 6u);
}

TEST(PmMesh, notesWhatItCannotUse) {
    cage::Cage cage = test::cube();
    cage.creases.push_back({0, 7, 3.0f});
    const Mesh mesh = pmMesh(cage);
    EXPECT_EQ(mesh.notes, mesh.features.unused);
    EXPECT_EQ(mesh.notes, std::vector<std::string>{"crease (0, 7): the cage has no such edge"});
}

TEST(PmMesh, splits) {
    const std::map<uint32_t, std::vector<uint32_t>> expected = {
        {6, {4, 4}}, {7, {4, 5}}, {8, {4, 4, 4}}, {9, {4, 4, 5}}, {12, {4, 4, 4, 4, 4}}};
    for (const auto& [n, parts] : expected) {
        const cage::Cage given = test::perturbed(test::prism(n), 0.02f, n);
        const Mesh mesh = pmMesh(given);
        EXPECT_EQ(mesh.cage.positions, given.positions);
        EXPECT_EQ(mesh.notes, std::vector<std::string>{"2 faces have more than 5 sides, the first is face " +
                                                       std::to_string(n) + "; split into quads and pentagons"});
        for (const uint32_t face : {n, n + 1}) {
            std::vector<uint32_t> sides;
            std::set<uint32_t> vertices;
            for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
                if (mesh.sourceFaces[f] == face) {
                    sides.push_back(mesh.cage.sides(f));
                    vertices.insert(&mesh.cage.faceVertices[mesh.cage.faceStarts[f]],
                                    &mesh.cage.faceVertices[mesh.cage.faceStarts[f]] + mesh.cage.sides(f));
                }
            }
            EXPECT_EQ(sides, parts);
            EXPECT_EQ(vertices.size(), n);
        }
    }
}

TEST(PmMesh, splitsAlongTheShortestDiagonals) {
    // A hexagon stretched along x: of its three zig-zag diagonals the one across is shortest.
    cage::Cage cage = test::prism(6);
    for (glm::vec3& p : cage.positions) {
        p.x *= 3.0f;
    }
    cage.positions[1].x = cage.positions[5].x = 0.5f; // vertices 1 and 5, 2 and 4 face each other; 1-4, 2-5, 0-3 cross
    const Mesh mesh = pmMesh(cage);
    const auto length = [&](uint32_t a, uint32_t b) { return glm::distance(cage.positions[a], cage.positions[b]); };
    double shortest = std::min({length(0, 3), length(1, 4), length(2, 5)});
    uint32_t found = 0;
    for (const auto& [a, b] : {std::pair{0u, 3u}, {1u, 4u}, {2u, 5u}}) {
        if (cage::findEdge(mesh.cage, mesh.topology, a, b) != cage::kNone) {
            ++found;
            EXPECT_EQ(length(a, b), shortest);
        }
    }
    EXPECT_EQ(found, 1u);
    // The same choice in other units, also where regular faces leave it to rounding.
    for (const uint32_t n : {6u, 7u, 8u, 11u}) {
        const cage::Cage regular = test::prism(n);
        for (const float scale : {0.001f, 0.37f, 100.0f}) {
            cage::Cage scaled = regular;
            for (glm::vec3& p : scaled.positions) {
                p *= scale;
            }
            EXPECT_EQ(pmMesh(scaled).cage.faceVertices, pmMesh(regular).cage.faceVertices) << n;
        }
    }
}

TEST(PmMesh, splitsCarryAttributes) {
    cage::Cage cage = test::prism(7);
    for (uint32_t c = 0; c < cage.cornerCount(); ++c) {
        const auto id = static_cast<float>(cage.faceVertices[c]);
        cage.cornerUvs.push_back({id, 1.0f});
        cage.cornerUvs1.push_back({id, 2.0f});
        cage.cornerColors.push_back({id, 0.0f, 0.0f, 1.0f});
    }
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        cage.faceMaterials.push_back(10 + f);
    }
    cage.holes = {2, 7};
    const Mesh mesh = pmMesh(cage);
    for (uint32_t c = 0; c < mesh.cage.cornerCount(); ++c) {
        const auto id = static_cast<float>(mesh.cage.faceVertices[c]);
        EXPECT_EQ(mesh.cage.cornerUvs.at(c), glm::vec2(id, 1.0f));
        EXPECT_EQ(mesh.cage.cornerUvs1.at(c), glm::vec2(id, 2.0f));
        EXPECT_EQ(mesh.cage.cornerColors.at(c), glm::vec4(id, 0.0f, 0.0f, 1.0f));
    }
    for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
        EXPECT_EQ(mesh.cage.faceMaterials.at(f), 10 + mesh.sourceFaces[f]);
    }
    EXPECT_EQ(mesh.sourceFaces, (std::vector<uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 7, 8, 8}));
    EXPECT_EQ(mesh.cage.holes, (std::vector<uint32_t>{2, 7, 8}));
}

/// The seven vertices of a torus in which every two are joined, with the six triangles round vertex 6 made one hexagon:
/// each of its diagonals is an edge elsewhere.
Faces crowdedHexagon() {
    std::map<uint32_t, uint32_t> after; // round the hexagon
    Faces polygons;
    for (uint32_t i = 0; i < 7; ++i) {
        for (const Faces::value_type& t :
             {Faces::value_type{i, (i + 1) % 7, (i + 3) % 7}, Faces::value_type{i, (i + 3) % 7, (i + 2) % 7}}) {
            const auto at = std::find(t.begin(), t.end(), 6u);
            if (at == t.end()) {
                polygons.push_back(t);
            } else {
                const auto k = static_cast<size_t>(at - t.begin());
                after[t[(k + 1) % 3]] = t[(k + 2) % 3];
            }
        }
    }
    std::vector<uint32_t> hexagon{0};
    while (hexagon.size() < 6) {
        hexagon.push_back(after.at(hexagon.back()));
    }
    polygons.push_back(hexagon);
    return polygons;
}

std::vector<glm::vec3> sixPoints() {
    const cage::Cage scattered = test::perturbed(makeCage(std::vector<glm::vec3>(6), {}), 1.0f, 1);
    return scattered.positions;
}

TEST(PmMesh, refusesAFaceWithoutAFreeSplit) {
    EXPECT_EQ(refusalOf(makeCage(sixPoints(), crowdedHexagon())),
              "face 8 has 6 sides: every way to split it into quads and pentagons needs a diagonal that is already an "
              "edge of the "
              "cage");
}

TEST(PmMesh, takesTheOneFreeSplit) {
    // Two triangles that share a diagonal of the hexagon become a quad: then that diagonal is free, and no other.
    const Faces crowded = crowdedHexagon();
    const std::vector<uint32_t>& hexagon = crowded.back();
    for (uint32_t d = 0; d < 3; ++d) {
        const uint32_t a = hexagon[d];
        const uint32_t b = hexagon[d + 3];
        Faces polygons;
        std::vector<uint32_t> quad{a, cage::kNone, b, cage::kNone};
        for (const std::vector<uint32_t>& p : crowded) {
            std::vector<uint32_t> t = p;
            const auto at = std::find(t.begin(), t.end(), a);
            if (t.size() != 3 || at == t.end() || std::find(t.begin(), t.end(), b) == t.end()) {
                polygons.push_back(p);
                continue;
            }
            std::rotate(t.begin(), at, t.end());
            (t[2] == b ? quad[1] : quad[3]) = t[2] == b ? t[1] : t[2]; // a, y, b or a, b, x
        }
        polygons.push_back(quad);
        const Mesh mesh = pmMesh(makeCage(sixPoints(), polygons));
        const cage::Topology& t = mesh.topology;
        const uint32_t edge = cage::findEdge(mesh.cage, t, a, b);
        ASSERT_NE(edge, cage::kNone);
        EXPECT_EQ(mesh.sourceFaces[t.cornerFaces[t.edges[edge].corner]], 6u);
        EXPECT_EQ(mesh.sourceFaces[t.cornerFaces[t.edges[edge].twin]], 6u);
    }
}

TEST(PmMesh, neighbouringSplitsKeepApart) {
    // Four paths of three edges from P = 0 to Q = 1. Two hexagons, opposite each other, both would like the diagonal
    // P Q, which is short; ladders of triangle, quad, triangle lie between them.
    std::vector<glm::vec3> positions{{0.0f, 0.0f, 0.1f}, {0.0f, 0.0f, -0.1f}};
    Faces polygons;
    const auto x = [](uint32_t i) { return 2 + 2 * (i % 4); };
    const auto y = [](uint32_t i) { return 3 + 2 * (i % 4); };
    for (uint32_t i = 0; i < 4; ++i) {
        const float angle = 1.5708f * static_cast<float>(i);
        positions.push_back({std::cos(angle), std::sin(angle), 0.5f});
        positions.push_back({std::cos(angle), std::sin(angle), -0.5f});
    }
    for (uint32_t i = 0; i < 4; ++i) {
        if (i % 2 == 0) {
            polygons.push_back({0, x(i), y(i), 1, y(i + 1), x(i + 1)});
        } else {
            polygons.push_back({0, x(i), x(i + 1)});
            polygons.push_back({x(i), y(i), y(i + 1), x(i + 1)});
            polygons.push_back({y(i), 1, y(i + 1)});
        }
    }
    const Mesh mesh = pmMesh(makeCage(positions, polygons));
    EXPECT_EQ(mesh.notes.size(), 1u);
    const uint32_t joined = cage::findEdge(mesh.cage, mesh.topology, 0, 1);
    ASSERT_NE(joined, cage::kNone);
    const uint32_t left = mesh.sourceFaces[mesh.topology.cornerFaces[mesh.topology.edges[joined].corner]];
    const uint32_t right = mesh.sourceFaces[mesh.topology.cornerFaces[mesh.topology.edges[joined].twin]];
    EXPECT_EQ(left, 0u);
    EXPECT_EQ(right, 0u);
    EXPECT_EQ(mesh.cage.faceCount(), 10u);
}

TEST(PmMesh, refusals) {
    Faces flipped = test::facesOf(test::cube());
    std::reverse(flipped[0].begin(), flipped[0].end());
    EXPECT_NE(refusalOf(makeCage(test::cube().positions, flipped)).find("flipped orientation: faces 0 and "),
              std::string::npos);
    const std::vector<glm::vec3> points(5);
    EXPECT_EQ(refusalOf(makeCage({points.begin(), points.begin() + 3}, {{0, 1, 2}, {0, 2, 1}})),
              "vertex 0: interior valence 2, between faces 0 and 1");
    EXPECT_NE(refusalOf(makeCage(points, {{0, 1, 2}, {0, 3, 4}})).find("vertex 0: several separate fans"),
              std::string::npos);
    EXPECT_EQ(refusalOf(makeCage({points.begin(), points.begin() + 3}, {{0, 1, 2, 1}})),
              "face 0: vertex 1 appears more than once");
}

TEST(PmMesh, hugeFacesAreSplitInTime) {
    const Mesh mesh = pmMesh(test::prism(20000));
    EXPECT_EQ(mesh.notes.size(), 1u);
    for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
        EXPECT_EQ(mesh.cage.sides(f), 4u);
    }
}

} // namespace
} // namespace supple::surface::pm
