#include "cage/weld.h"

#include "tests/cage/face_lists.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <set>

namespace supple::cage {
namespace {

using namespace test;

const MayJoin kAnyFaces = [](uint32_t, uint32_t) { return true; };

/// Triangle soup over `vertices`: every corner its own vertex, candidates by number.
struct Soup {
    Indices candidates;
    Indices triangles;
};
Soup soupOf(const Indices& shared) {
    Soup soup{shared, Indices(shared.size())};
    std::iota(soup.triangles.begin(), soup.triangles.end(), 0u);
    return soup;
}

Polygons trianglesOf(const Indices& triangles) {
    Polygons faces;
    faces.vertices = triangles;
    for (size_t end = 3; end <= triangles.size(); end += 3)
        faces.starts.push_back(static_cast<uint32_t>(end));
    return faces;
}

size_t countSets(const Indices& roots) {
    return std::set<uint32_t>(roots.begin(), roots.end()).size();
}

Polygons asFaces(const Indices& triangles, const Indices& roots) {
    return keepTriangles(triangles, roots);
}

const Indices kTetrahedronFaces = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

Indices shifted(Indices triangles, const Indices& map) {
    for (uint32_t& v : triangles)
        v = map[v];
    return triangles;
}

Indices joined(Indices a, const Indices& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST(Weld, SoupOfClosedSurface) {
    const Soup soup = soupOf(kTetrahedronFaces);
    Welding welding = weld(soup.candidates, trianglesOf(soup.triangles), kAnyFaces);
    EXPECT_EQ(countSets(welding.roots), 4u);
    for (size_t i = 0; i < soup.candidates.size(); ++i)
        for (size_t j = 0; j < soup.candidates.size(); ++j)
            EXPECT_EQ(welding.roots[i] == welding.roots[j], soup.candidates[i] == soup.candidates[j]);
    EXPECT_EQ(unweldDefects(asFaces(soup.triangles, welding.roots), welding), 0u);
}

TEST(Weld, TouchingInAVertexStaysApart) {
    // Two tetrahedra that share vertex 0 in space.
    const Soup soup = soupOf(joined(kTetrahedronFaces, shifted(kTetrahedronFaces, {0, 4, 5, 6})));
    EXPECT_EQ(countSets(weld(soup.candidates, trianglesOf(soup.triangles), kAnyFaces).roots), 8u);
}

TEST(Weld, TouchingAlongAnEdgeStaysApart) {
    // Two tetrahedra that share edge 0-1 in space: four triangles meet there.
    const Soup soup = soupOf(joined(kTetrahedronFaces, shifted(kTetrahedronFaces, {0, 1, 4, 5})));
    Welding welding = weld(soup.candidates, trianglesOf(soup.triangles), kAnyFaces);
    EXPECT_EQ(countSets(welding.roots), 8u);
    EXPECT_EQ(unweldDefects(asFaces(soup.triangles, welding.roots), welding), 0u);
}

TEST(Weld, TouchingAlongTwoEdgesStaysApart) {
    // Two square prisms side by side below a ridge 0-1-2: at vertex 1 both surfaces are cut in halves by ridge edges
    // that four triangles share; the far ends tell which halves belong together.
    //   left strip pair: (0,1) (1,2) with 3 4 5 on one flank and 6 7 8 on the other, closed at the ends by 9 and 10
    const auto roof = [](uint32_t base) {
        // ridge 0 1 2; flank a: a0 a1 a2; flank b: b0 b1 b2
        const uint32_t a0 = base, a1 = base + 1, a2 = base + 2, b0 = base + 3, b1 = base + 4, b2 = base + 5;
        return Indices{0, 1,  a1, 0, a1, a0, 1, 2,  a2, 1, a2, a1, 1, 0,  b0,
                       1, b0, b1, 2, 1,  b1, 2, b1, b2, 0, a0, b0, 2, b2, a2};
    };
    Soup soup = soupOf(joined(roof(3), roof(9)));
    EXPECT_EQ(countSets(weld(soup.candidates, trianglesOf(soup.triangles), kAnyFaces).roots), 18u)
        << "nine vertices each";
    // Whatever the numbers: the ridge's middle before its ends, and behind them.
    for (uint32_t& candidate : soup.candidates)
        candidate = candidate == 0 ? 1 : candidate == 1 ? 0 : candidate;
    EXPECT_EQ(countSets(weld(soup.candidates, trianglesOf(soup.triangles), kAnyFaces).roots), 18u);
    for (uint32_t& candidate : soup.candidates)
        candidate = candidate == 0 ? 100 : candidate;
    EXPECT_EQ(countSets(weld(soup.candidates, trianglesOf(soup.triangles), kAnyFaces).roots), 18u);
}

TEST(Weld, SharedVerticesStayShared) {
    // The file itself has the bow tie; welding neither makes nor mends it.
    const Indices triangles = {0, 1, 2, 0, 3, 4};
    Indices candidates(5);
    std::iota(candidates.begin(), candidates.end(), 0u);
    EXPECT_EQ(countSets(weld(candidates, trianglesOf(triangles), kAnyFaces).roots), 5u);
}

TEST(Weld, SeamIsSewnEdgeByEdge) {
    // Two triangles joined by a seam edge; the far corners have no partner.
    const Indices candidates = {0, 1, 2, 1, 0, 3};
    const Indices triangles = {0, 1, 2, 3, 4, 5};
    EXPECT_EQ(weld(candidates, trianglesOf(triangles), kAnyFaces).roots, (Indices{0, 1, 2, 1, 0, 5}));
    // The same two turned against each other agree in positions, not in orientation.
    const Indices flipped = {0, 1, 2, 4, 3, 5};
    EXPECT_EQ(countSets(weld(candidates, trianglesOf(flipped), kAnyFaces).roots), 6u);
}

TEST(Weld, DuplicateFacesAreNotSewn) {
    const Soup soup = soupOf({0, 1, 2, 0, 1, 2, 1, 0, 3});
    const Indices roots = weld(soup.candidates, trianglesOf(soup.triangles), kAnyFaces).roots;
    EXPECT_EQ(countSets(roots), 9u);
}

TEST(Weld, CornersOfTwoSidedSheetsAreTakenApart) {
    // A quad and its back: sewn all round, every vertex would lie between two faces only.
    const Soup soup = soupOf({0, 1, 2, 0, 2, 3, 2, 1, 0, 3, 2, 0});
    Welding welding = weld(soup.candidates, trianglesOf(soup.triangles), kAnyFaces);
    Polygons faces;
    for (const Indices& face : {Indices{0, 1, 2, 5}, Indices{6, 7, 8, 9}}) {
        faces.vertices.insert(faces.vertices.end(), face.begin(), face.end());
        faces.close();
    }
    ASSERT_EQ(soup.candidates[9], 3u);
    unweldDefects(faces, welding);
    std::set<uint32_t> roots;
    for (const uint32_t v : faces.vertices)
        roots.insert(welding.roots[v]);
    EXPECT_EQ(roots.size(), 8u);
}

TEST(Weld, OrderOfTrianglesDoesNotMatter) {
    // A closed grid of soup, shuffled: always the same number of vertices.
    Indices torus;
    const uint32_t n = 6;
    for (uint32_t i = 0; i < n; ++i) {
        for (uint32_t j = 0; j < n; ++j) {
            const uint32_t a = i * n + j, b = (i + 1) % n * n + j, c = (i + 1) % n * n + (j + 1) % n,
                           d = i * n + (j + 1) % n;
            torus.insert(torus.end(), {a, b, c, a, c, d});
        }
    }
    std::mt19937 random(3);
    for (int round = 0; round < 20; ++round) {
        std::vector<size_t> order(torus.size() / 3);
        std::iota(order.begin(), order.end(), size_t{0});
        std::shuffle(order.begin(), order.end(), random);
        Indices shuffled;
        for (const size_t t : order)
            shuffled.insert(shuffled.end(), torus.begin() + static_cast<ptrdiff_t>(3 * t),
                            torus.begin() + static_cast<ptrdiff_t>(3 * t + 3));
        const Soup soup = soupOf(shuffled);
        EXPECT_EQ(countSets(weld(soup.candidates, trianglesOf(soup.triangles), kAnyFaces).roots), n * n);
    }
}

TEST(Weld, NeverSpoilsWhatTheFileHadRight) {
    // A closed grid, cut open along random edges, whose vertices coincide at random: whatever is merged, no edge may
    // then run twice in one direction and no face repeat a vertex, for the file itself has neither.
    const uint32_t n = 8;
    std::mt19937 random(11);
    for (int round = 0; round < 300; ++round) {
        Indices triangles;
        for (uint32_t i = 0; i < n; ++i) {
            for (uint32_t j = 0; j < n; ++j) {
                const uint32_t a = i * n + j, b = (i + 1) % n * n + j, c = (i + 1) % n * n + (j + 1) % n,
                               d = i * n + (j + 1) % n;
                triangles.insert(triangles.end(), {a, b, c, a, c, d});
            }
        }
        Indices places(n * n); // the position of each vertex
        const uint32_t placeCount = n * n / (1 + static_cast<uint32_t>(random() % 8));
        for (uint32_t v = 0; v < n * n; ++v)
            places[v] = random() % 4 == 0 ? static_cast<uint32_t>(random() % placeCount) : v;
        const uint32_t splits = static_cast<uint32_t>(random() % 3);
        for (uint32_t& corner : triangles) {
            if (splits != 0 && random() % (splits == 1 ? 20 : 2) == 0) {
                places.push_back(places[corner]);
                corner = static_cast<uint32_t>(places.size()) - 1;
            }
        }
        Welding welding = weld(places, trianglesOf(triangles), kAnyFaces);
        for (uint32_t v = 0; v < places.size(); ++v)
            ASSERT_EQ(places[welding.roots[v]], places[v]);
        const Indices own = [&] {
            Indices map(places.size());
            std::iota(map.begin(), map.end(), 0u);
            return map;
        }();
        const Polygons faces = keepTriangles(triangles, own);
        unweldDefects(faces, welding);
        std::set<std::pair<uint32_t, uint32_t>> edges;
        for (size_t t = 0; t < triangles.size(); t += 3) {
            for (size_t j = 0; j < 3; ++j) {
                const uint32_t from = welding.roots[triangles[t + j]];
                const uint32_t to = welding.roots[triangles[t + (j + 1) % 3]];
                ASSERT_NE(from, to) << "round " << round;
                ASSERT_TRUE(edges.insert({from, to}).second) << "round " << round << " edge " << from << " " << to;
            }
        }
    }
}

} // namespace
} // namespace supple::cage
