// The cage as the subdivision sees it: the isolated level, fragments, what is split, said and refused. And the
// tables that fragments are refined by.
#include "surface/subdivision/masks.h"
#include "tests/support/meshes.h"
#include "tests/support/subdivision_surface.h"
#include "tests/support/subdivision_zoo.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace supple::surface::subdivision {
namespace {

using test::subdivisionMesh;

constexpr Subdivision kBoth[] = {Subdivision::catmullClark, Subdivision::loop};
using Strings = std::vector<std::string>;

std::string refusal(const cage::Cage& cage, Subdivision subdivision) {
    const Result<Mesh> mesh = buildMesh(cage, subdivision);
    return mesh.ok() ? "" : mesh.error().message;
}

TEST(SubdivisionMesh, refusesWhatTopologyRefuses) {
    const std::vector<glm::vec3> points(8, glm::vec3(0.0f));
    for (const Subdivision subdivision : kBoth) {
        EXPECT_EQ(refusal(test::makeCage({points.begin(), points.begin() + 5}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}),
                          subdivision),
                  "edge (0, 1): three faces meet here: 0, 1, 2");
        EXPECT_EQ(refusal(test::makeCage({points.begin(), points.begin() + 4}, {{0, 1, 2}, {0, 1, 3}}), subdivision),
                  "edge (0, 1): flipped orientation: faces 0 and 1 run along it in the same direction");
        // A triangle and a quad round vertex 0.
        EXPECT_EQ(refusal(test::makeCage({points.begin(), points.begin() + 4}, {{0, 1, 2}, {0, 2, 3, 1}}), subdivision),
                  "vertex 0: interior valence 2, between faces 0 and 1");
        EXPECT_EQ(refusal(test::makeCage({points.begin(), points.begin() + 5}, {{0, 1, 2}, {0, 3, 4}}), subdivision),
                  "vertex 0: several separate fans of faces meet here (two faces, one in the first fan)");
    }
}

TEST(SubdivisionMesh, roundCornersAreAsSharpAsTheCageSays) {
    cage::Cage sheet = test::grid(2, 2);
    for (const Subdivision subdivision : kBoth) {
        Strings notes;
        Result<RefinedMesh> mesh = beginSteps(sheet, subdivision, notes);
        ASSERT_TRUE(mesh.ok());
        EXPECT_EQ(mesh->vertexSharpness[2], kInfiniteSharpness) << "a corner of one face or two";
    }
    sheet.roundCorners = {0, 2, 6, 8};
    sheet.sharpVertices = {{6, 2.0f}, {8, cage::kHardSharpness}};
    Strings notes;
    Result<RefinedMesh> mesh = beginSteps(sheet, Subdivision::catmullClark, notes);
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(mesh->vertexSharpness[0], 0.0f);
    EXPECT_EQ(mesh->vertexSharpness[6], 2.0f);
    EXPECT_EQ(mesh->vertexSharpness[8], kInfiniteSharpness);
    EXPECT_EQ(notes, Strings());
}

TEST(SubdivisionMesh, stepsToTheIsolatedLevel) {
    EXPECT_EQ(subdivisionMesh(test::cube(), Subdivision::catmullClark).isolationSteps, 1u);
    EXPECT_EQ(subdivisionMesh(test::dodecahedron(), Subdivision::catmullClark).isolationSteps, 2u);
    EXPECT_EQ(subdivisionMesh(test::prism(5), Subdivision::catmullClark).isolationSteps, 2u);
    EXPECT_EQ(subdivisionMesh(test::prism(5), Subdivision::loop).isolationSteps, 1u);
}

/// Faces, stencils and fragments of the whole zoo fit together.
TEST(SubdivisionMesh, parts) {
    for (const test::SubdivisionCage& entry : test::subdivisionZoo()) {
        for (const Subdivision subdivision : kBoth) {
            SCOPED_TRACE(entry.name);
            const Mesh mesh = subdivisionMesh(entry.cage, subdivision);
            const bool quads = subdivision == Subdivision::catmullClark;
            ASSERT_TRUE(cage::buildTopology(mesh.cage).ok());
            ASSERT_EQ(mesh.stencils.size(), mesh.isolationSteps);
            ASSERT_EQ(mesh.stencils.back().rows(), mesh.cage.vertexCount());
            uint32_t before = entry.cage.vertexCount();
            for (const Stencils& stencils : mesh.stencils) {
                for (uint32_t row = 0; row < stencils.rows(); ++row) {
                    const uint32_t begin = stencils.starts[row], end = stencils.starts[row + 1];
                    ASSERT_LT(begin, end);
                    double sum = 0.0;
                    std::set<uint32_t> once;
                    for (uint32_t i = begin; i < end; ++i) {
                        sum += stencils.weights[i];
                        ASSERT_LT(stencils.vertices[i], before);
                        ASSERT_TRUE(once.insert(stencils.vertices[i]).second);
                    }
                    EXPECT_NEAR(sum, 1.0, 1e-14);
                }
                before = stencils.rows();
            }
            ASSERT_EQ(mesh.sourceFaces.size(), mesh.cage.faceCount());
            ASSERT_EQ(mesh.hostVertices, entry.cage.vertexCount());
            std::set<uint32_t> faces;
            uint32_t net = 0, sectors = 0, spokes = 0;
            for (const Fragment& fragment : mesh.fragments) {
                ASSERT_EQ(fragment.firstNet, net);
                ASSERT_EQ(fragment.firstSector, sectors);
                ASSERT_EQ(fragment.firstSpoke, spokes);
                const bool facet = fragment.kind == FragmentKind::facet;
                net += facet ? facetPointCount(1) : pointCount({subdivision, fragment.sectors, fragment.open}, 2);
                sectors += fragment.sectors;
                spokes += fragment.spokes();
                for (uint32_t h = 0; h < fragment.sectors; ++h) {
                    const uint32_t face = mesh.sectorFaces[fragment.firstSector + h];
                    faces.insert(face);
                    const uint32_t* const corners = mesh.cage.faceVertices.data() + mesh.cage.faceStarts[face];
                    const uint32_t* const points = mesh.net.data() + fragment.firstNet;
                    const Fan fan{subdivision, fragment.sectors, fragment.open};
                    const auto at = [&](int32_t a, int32_t b) {
                        return points[facet ? facetPointIndex(1, a, b) : pointIndex(fan, h, a, b)];
                    };
                    EXPECT_EQ(corners[0], at(0, 0));
                    EXPECT_EQ(corners[1], at(1, 0));
                    EXPECT_EQ(corners[2], quads ? at(1, 1) : at(0, 1));
                    EXPECT_EQ(corners[mesh.cage.sides(face) - 1], at(0, 1));
                }
            }
            EXPECT_EQ(net, mesh.net.size());
            EXPECT_EQ(sectors, mesh.sectorFaces.size());
            EXPECT_EQ(spokes, mesh.spokeSharpness.size());
            EXPECT_EQ(faces.size(), mesh.cage.faceCount()); // each in one sector
            EXPECT_EQ(sectors, mesh.cage.faceCount());
        }
    }
}

/// The fragment of a vertex: they come in vertex order.
const Fragment& fragmentOf(const Mesh& mesh, uint32_t vertex) {
    return mesh.fragments[vertex];
}

std::multiset<float> spokesOf(const Mesh& mesh, uint32_t vertex) {
    const Fragment& fragment = fragmentOf(mesh, vertex);
    const auto first = mesh.spokeSharpness.begin() + fragment.firstSpoke;
    return {first, first + fragment.spokes()};
}

TEST(SubdivisionMesh, sharpness) {
    cage::Cage cage = test::grid(2, 2); // vertex 4 is inside
    cage.creases = {{4, 1, 0.5f}, {4, 3, 1.75f}, {4, 5, 3.0f}, {4, 7, 10.0f}};
    cage.sharpVertices = {{4, 2.5f}, {1, 12.0f}};
    const Mesh quads = subdivisionMesh(cage, Subdivision::catmullClark);
    EXPECT_EQ(spokesOf(quads, 4), (std::multiset<float>{0.0f, 0.75f, 2.0f, kInfiniteSharpness}));
    EXPECT_EQ(fragmentOf(quads, 4).centreSharpness, 1.5f);
    EXPECT_EQ(fragmentOf(quads, 1).centreSharpness, kInfiniteSharpness);
    EXPECT_EQ(fragmentOf(quads, 3).centreSharpness, 0.0f);
    // A boundary's edges, and its vertices with one face alone.
    EXPECT_EQ(fragmentOf(quads, 0).centreSharpness, kInfiniteSharpness);
    EXPECT_EQ(spokesOf(quads, 0), (std::multiset<float>{kInfiniteSharpness, kInfiniteSharpness}));
    EXPECT_TRUE(fragmentOf(quads, 0).open);
    EXPECT_FALSE(fragmentOf(quads, 4).open);

    // Two steps where a face is no quad.
    cage::Cage mixed = test::withCutQuads(test::grid(2, 2), 1.0, 1);
    mixed.creases = cage.creases;
    mixed.sharpVertices = cage.sharpVertices;
    const Mesh twice = subdivisionMesh(mixed, Subdivision::catmullClark);
    EXPECT_EQ(spokesOf(twice, 4), (std::multiset<float>{0.0f, 0.0f, 0.0f, 0.0f, 1.0f, kInfiniteSharpness}));
    EXPECT_EQ(fragmentOf(twice, 4).centreSharpness, 0.5f);
    EXPECT_EQ(fragmentOf(twice, 0).centreSharpness, 0.0f); // has two triangles now
    EXPECT_EQ(fragmentOf(twice, 2).centreSharpness, kInfiniteSharpness);
}

TEST(SubdivisionMesh, loopSplitsFaces) {
    const Mesh mesh = subdivisionMesh(test::prism(5), Subdivision::loop);
    EXPECT_EQ(mesh.cage.faceCount(), 4 * (5 * 2 + 2 * 3));
    EXPECT_EQ(mesh.notes, Strings{"7 faces have more than 3 sides, the first is face 0; split into triangles"});
    EXPECT_EQ(mesh.sourceFaces.front(), 0u);
    EXPECT_EQ(mesh.sourceFaces.back(), 6u);
    for (const test::SubdivisionCage& entry : test::subdivisionZoo()) {
        SCOPED_TRACE(entry.name);
        EXPECT_EQ(test::facesOf(test::trianglesOf(subdivisionMesh(entry.cage, Subdivision::loop), entry.cage)),
                  test::facesOf(test::inTriangles(entry.cage)));
    }
    const Mesh many = subdivisionMesh(test::torus(8, 8), Subdivision::loop);
    EXPECT_EQ(many.notes, Strings{"64 faces have more than 3 sides, the first is face 0; split into triangles"});
    EXPECT_TRUE(subdivisionMesh(test::gyroBipyramid(5), Subdivision::loop).notes.empty());
}

TEST(SubdivisionMesh, loopAvoidsDiagonalsThatAreEdges) {
    // A tetrahedron's face 0 1 2 with a corner 4 in the edge (2, 0): of its diagonals (0, 2) and (1, 4) the first is an
    // edge of the triangle behind.
    const std::vector<glm::vec3> points{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {0, 1, 0}};
    const test::Faces polygons{{0, 1, 2, 4}, {0, 3, 1}, {1, 3, 2}, {0, 4, 2}, {0, 2, 3}};
    const Mesh mesh = subdivisionMesh(test::withoutFaces(test::makeCage(points, polygons), {3}), Subdivision::loop);
    EXPECT_EQ(mesh.notes, Strings{"1 face has more than 3 sides: face 0; split into triangles"});

    // Moebius' torus, of whose seven vertices each two share an edge, with four triangles in zig-zag made a hexagon:
    // the three diagonals that are no edges leave from no one corner.
    const std::vector<std::vector<uint32_t>> merged{{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}};
    test::Faces torus{{0, 1, 3, 5, 4, 2}};
    for (uint32_t i = 0; i < 7; ++i) {
        for (const std::vector<uint32_t>& triangle :
             {std::vector<uint32_t>{i, (i + 1) % 7, (i + 3) % 7}, std::vector<uint32_t>{i, (i + 3) % 7, (i + 2) % 7}}) {
            if (std::find(merged.begin(), merged.end(), triangle) == merged.end()) {
                torus.push_back(triangle);
            }
        }
    }
    const cage::Cage cage = test::makeCage(std::vector<glm::vec3>(7, glm::vec3(0.0f)), torus);
    EXPECT_EQ(refusal(cage, Subdivision::catmullClark), "");
    EXPECT_EQ(refusal(cage, Subdivision::loop),
              "face 0 has 6 sides: every way to split it into triangles needs a diagonal that is already an "
              "edge of the cage");
}

TEST(SubdivisionMesh, notes) {
    cage::Cage cage = test::cube();
    cage.creases = {{0, 7, 2.0f}};
    cage.sharpVertices = {{8, 1.0f}};
    cage.creaseScalars = {{0, 1, 0.5f}};
    const Mesh mesh = subdivisionMesh(cage, Subdivision::catmullClark);
    EXPECT_EQ(mesh.notes,
              (Strings{"crease (0, 7): the cage has no such edge", "sharp vertex 8: the cage has only 8 vertices",
                       "1 crease scalars: not used, they are for P_m alone"}));
}

/// Attributes of the parts of a face are what the face's own corners give there by bilinear interpolation.
TEST(SubdivisionMesh, attributes) {
    cage::Cage cage = test::withMergedFaces(test::withCutQuads(test::torus(6, 5), 0.3, 1), 20, 1);
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            // Linear in a position of the corner within its face: means of positions have means of attributes.
            const glm::vec3 p = cage.positions[cage.faceVertices[c]];
            cage.cornerUvs.emplace_back(p.x + 10.0f * f, p.y);
            cage.cornerUvs1.emplace_back(p.z, -p.x);
            cage.cornerColors.emplace_back(p, 1.0f);
        }
        cage.faceMaterials.push_back(f % 3);
    }
    cage.holes = {2, 5};
    for (const Subdivision subdivision : kBoth) {
        const Mesh mesh = subdivisionMesh(cage, subdivision);
        ASSERT_EQ(mesh.cage.cornerUvs.size(), mesh.cage.cornerCount());
        ASSERT_EQ(mesh.cage.cornerUvs1.size(), mesh.cage.cornerCount());
        ASSERT_EQ(mesh.cage.cornerColors.size(), mesh.cage.cornerCount());
        ASSERT_EQ(mesh.cage.faceMaterials.size(), mesh.cage.faceCount());
        for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
            const uint32_t source = mesh.sourceFaces[f];
            EXPECT_EQ(std::binary_search(mesh.cage.holes.begin(), mesh.cage.holes.end(), f),
                      source == 2 || source == 5);
            EXPECT_EQ(mesh.cage.faceMaterials[f], source % 3);
            glm::vec2 low(1e9f), high(-1e9f);
            for (uint32_t c = cage.faceStarts[source]; c < cage.faceStarts[source + 1]; ++c) {
                low = glm::min(low, cage.cornerUvs[c]);
                high = glm::max(high, cage.cornerUvs[c]);
            }
            for (uint32_t c = mesh.cage.faceStarts[f]; c < mesh.cage.faceStarts[f + 1]; ++c) {
                const glm::vec4 color = mesh.cage.cornerColors[c];
                EXPECT_NEAR(mesh.cage.cornerUvs[c].x, color.x + 10.0f * static_cast<float>(source), 1e-4f);
                EXPECT_NEAR(mesh.cage.cornerUvs[c].y, color.y, 1e-5f);
                EXPECT_NEAR(mesh.cage.cornerUvs1[c].x, color.z, 1e-5f);
                EXPECT_NEAR(color.w, 1.0f, 1e-6f);
                EXPECT_TRUE(glm::all(glm::greaterThanEqual(mesh.cage.cornerUvs[c], low - 1e-4f)));
                EXPECT_TRUE(glm::all(glm::lessThanEqual(mesh.cage.cornerUvs[c], high + 1e-4f)));
                // A vertex of the host's has its own corner's values.
                const uint32_t vertex = mesh.cage.faceVertices[c];
                EXPECT_EQ(mesh.hostVertices, cage.vertexCount());
                if (vertex < mesh.hostVertices) {
                    EXPECT_EQ(glm::vec3(color), cage.positions[vertex]);
                }
            }
        }
    }
    // A quad in four: corner, middles of the edges, middle of the face.
    cage::Cage quad = test::grid(1, 1);
    quad.cornerUvs = {{0.0f, 0.0f}, {1.0f, 0.0f}, {3.0f, 4.0f}, {0.0f, 2.0f}};
    const Mesh mesh = subdivisionMesh(quad, Subdivision::catmullClark);
    const std::vector<glm::vec2> second(mesh.cage.cornerUvs.begin() + 4, mesh.cage.cornerUvs.begin() + 8);
    EXPECT_EQ(second, (std::vector<glm::vec2>{{1.0f, 0.0f}, {2.0f, 2.0f}, {1.0f, 1.5f}, {0.5f, 0.0f}}));
}

/// Sizes that other programs computed, too.
TEST(SubdivisionPatterns, sizes) {
    const auto closed = [](Subdivision subdivision, uint32_t sectors, uint32_t radius) {
        return pointCount({subdivision, sectors, false}, radius);
    };
    EXPECT_EQ(closed(Subdivision::catmullClark, 4, 3), 49u);
    EXPECT_EQ(closed(Subdivision::catmullClark, 6, 17), 1837u);
    EXPECT_EQ(closed(Subdivision::catmullClark, 8, 33), 8977u);
    EXPECT_EQ(closed(Subdivision::loop, 6, 33), 3367u);
    EXPECT_EQ(closed(Subdivision::loop, 8, 9), 361u);
    EXPECT_EQ(pointCount({Subdivision::catmullClark, 2, true}, 2), 1u + 12u + 2u);
    const uint32_t facets[] = {12, 18, 33, 75, 207, 663};
    for (uint32_t step = 0; step < 6; ++step) {
        EXPECT_EQ(facetPointCount(1u << step), facets[step]);
    }
}

/// Every row and neighbour names points of the right level; indices are the same on all levels and used once.
TEST(SubdivisionPatterns, rowsStayWithinTheirLevel) {
    for (const Subdivision subdivision : kBoth) {
        for (uint32_t sectors = 1; sectors <= 9; ++sectors) {
            for (const bool open : {false, true}) {
                if (!open && sectors < 3) {
                    continue;
                }
                const Fan fan{subdivision, sectors, open};
                SCOPED_TRACE((open ? "open " : "closed ") + std::to_string(sectors));
                const Pattern pattern = fanPattern(fan, 3);
                ASSERT_EQ(pattern.rows.size(), pointCount(fan, 9));
                ASSERT_EQ(pattern.neighbours.size(), pointCount(fan, 8));
                ASSERT_EQ(pattern.spokes.size(), pointCount(fan, 8));
                for (uint32_t j = 1; j <= 3; ++j) {
                    const Pattern shorter = fanPattern(fan, j);
                    for (uint32_t i = 0; i < shorter.rows.size(); ++i) {
                        ASSERT_EQ(shorter.rows[i].sources, pattern.rows[i].sources);
                        for (const uint32_t source : shorter.rows[i].sources) {
                            ASSERT_LT(source, pointCount(fan, (1u << (j - 1)) + 1));
                        }
                    }
                    for (uint32_t i = 0; i < shorter.neighbours.size(); ++i) {
                        ASSERT_EQ(shorter.neighbours[i], pattern.neighbours[i]);
                        for (const uint32_t neighbour : shorter.neighbours[i]) {
                            ASSERT_LT(neighbour, pointCount(fan, (1u << j) + 1));
                        }
                    }
                }
                for (uint32_t k = 0; k < sectors; ++k) {
                    const uint32_t next = open ? k + 1 : (k + 1) % sectors;
                    EXPECT_EQ(pattern.spokes[pointIndex(fan, k, 3, 0)], k);
                    EXPECT_EQ(pattern.spokes[pointIndex(fan, k, 0, 3)], next);
                    EXPECT_EQ(pattern.spokes[pointIndex(fan, k, 2, 1)], kNoSpoke);
                }
                EXPECT_EQ(pointIndex(fan, 0, 2, -1) == kNoPoint, open);
                EXPECT_EQ(pointIndex(fan, sectors - 1, -1, 2) == kNoPoint, open);
            }
        }
    }
    for (uint32_t step = 1; step <= 4; ++step) {
        const Pattern pattern = facetPattern(step);
        ASSERT_EQ(pattern.rows.size(), facetPointCount(1u << step));
        for (const Row& row : pattern.rows) {
            for (const uint32_t source : row.sources) {
                EXPECT_LT(source, facetPointCount(1u << (step - 1)));
            }
        }
        for (const Neighbours& neighbours : pattern.neighbours) {
            for (const uint32_t neighbour : neighbours) {
                EXPECT_LT(neighbour, facetPointCount(1u << step));
            }
        }
    }
}

TEST(SubdivisionMasks, regularCentres) {
    const CentreWeights quads = refineWeights(Subdivision::catmullClark, 4);
    EXPECT_EQ(quads.centre, 36.0 / 64.0);
    EXPECT_EQ(quads.spoke, 6.0 / 64.0);
    EXPECT_EQ(quads.face, 1.0 / 64.0);
    const CentreWeights triangles = refineWeights(Subdivision::loop, 6);
    EXPECT_EQ(triangles.centre, 10.0 / 16.0);
    EXPECT_EQ(triangles.spoke, 1.0 / 16.0);
    EXPECT_EQ(refineWeights(Subdivision::loop, 3).spoke, 3.0 / 16.0);
    const std::vector<float> smooth(4, 0.0f);
    const CentreLimit limit = centreLimit({Subdivision::catmullClark, 4, false}, smooth, 0.0f);
    EXPECT_NEAR(limit.position[0], 16.0 / 36.0, 1e-15);
    EXPECT_NEAR(limit.position[1], 4.0 / 36.0, 1e-15);
    EXPECT_NEAR(limit.position[2], 1.0 / 36.0, 1e-15);
}

/// Positions are affine combinations, tangents differences; the runs cover every sector once.
TEST(SubdivisionMasks, sums) {
    for (const Subdivision subdivision : kBoth) {
        for (uint32_t sectors = 1; sectors <= 12; ++sectors) {
            for (const bool open : {false, true}) {
                if (!open && sectors < 3) {
                    continue;
                }
                const Fan fan{subdivision, sectors, open};
                const uint32_t spokes = sectors + (open ? 1 : 0);
                for (uint32_t kind = 0; kind < 4; ++kind) { // by sharp spokes: as few as there may be, then more
                    std::vector<float> sharpness(spokes, 0.0f);
                    if (open) {
                        sharpness.front() = sharpness.back() = kInfiniteSharpness;
                    }
                    for (uint32_t k = 0; k < kind; ++k) {
                        sharpness[(k * 5 + 1) % spokes] = 0.5f;
                    }
                    const CentreLimit limit = centreLimit(fan, sharpness, kind == 3 ? 0.25f : 0.0f);
                    ASSERT_EQ(limit.position.size(), pointCount(fan, 1));
                    EXPECT_NEAR(std::accumulate(limit.position.begin(), limit.position.end(), 0.0), 1.0, 1e-14);
                    std::vector<uint32_t> covered(sectors, 0);
                    for (const CentreRun& run : limit.runs) {
                        for (uint32_t h = 0; h < run.sectors; ++h) {
                            ++covered[(run.firstSector + h) % sectors];
                        }
                        for (const CentreMask* mask : {&run.first, &run.second}) {
                            EXPECT_EQ(mask->size(), run.corner ? 0 : pointCount(fan, 1));
                            EXPECT_NEAR(std::accumulate(mask->begin(), mask->end(), 0.0), 0.0, 1e-13);
                        }
                    }
                    EXPECT_EQ(covered, std::vector<uint32_t>(sectors, 1));
                }
            }
        }
    }
}

TEST(SubdivisionMasks, steps) {
    EXPECT_EQ(softened(0.25f, 0), 0.25f);
    EXPECT_EQ(softened(2.25f, 1), 1.25f);
    EXPECT_EQ(softened(2.25f, 5), 0.0f);
    EXPECT_EQ(softened(kInfiniteSharpness, 6), kInfiniteSharpness);

    const auto expectStep = [](const CentreStep& step, double smooth, double crease, double corner) {
        EXPECT_NEAR(step.smooth, smooth, 1e-7);
        EXPECT_NEAR(step.crease, crease, 1e-7);
        EXPECT_NEAR(step.corner, corner, 1e-7);
    };
    const auto step = [](const std::vector<float>& spokes, float vertex) { return centreStep(spokes, vertex); };
    expectStep(step({0, 0, 0, 0}, 0.0f), 1.0, 0.0, 0.0);
    expectStep(step({0, 7, 0, 0}, 0.0f), 1.0, 0.0, 0.0); // a dart
    expectStep(step({0, 2, 0, 2}, 0.0f), 0.0, 1.0, 0.0);
    expectStep(step({0, 0.25f, 0, 0.25f}, 0.0f), 0.75, 0.25, 0.0);
    expectStep(step({0, 0.25f, 0, 0.75f}, 0.0f), 0.5, 0.5, 0.0);
    expectStep(step({0, 0.25f, 0, 3}, 0.0f), 0.75, 0.25, 0.0);    // becomes a dart
    expectStep(step({0.5f, 3, 0, 3}, 0.0f), 0.0, 0.5, 0.5);       // becomes a crease
    expectStep(step({0.5f, 3, 0.3f, 0.1f}, 0.0f), 0.7, 0.0, 0.3); // becomes a dart
    expectStep(step({3, 3, 3, 0}, 0.0f), 0.0, 0.0, 1.0);
    expectStep(step({0, 0, 0, 0}, 0.4f), 0.6, 0.0, 0.4);
    expectStep(step({0, 3, 0, 3}, 0.4f), 0.0, 0.6, 0.4);
    expectStep(step({0, 0, 0, 0}, 1.4f), 0.0, 0.0, 1.0);
    const CentreStep crease = step({0, 3, 0, 0, 3}, 0.0f);
    EXPECT_EQ(crease.first, 1u);
    EXPECT_EQ(crease.second, 4u);
}

} // namespace
} // namespace supple::surface::subdivision
