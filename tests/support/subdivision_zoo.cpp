#include "tests/support/subdivision_zoo.h"

#include "tests/support/meshes.h"

#include <algorithm>
#include <numbers>
#include <random>
#include <set>
#include <utility>

namespace supple::test {
namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;

cage::Cage tetrahedron() {
    return makeCage({{1.0f, 1.0f, 1.0f}, {1.0f, -1.0f, -1.0f}, {-1.0f, 1.0f, -1.0f}, {-1.0f, -1.0f, 1.0f}},
                    {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
}

cage::Cage jittered(const cage::Cage& cage, uint32_t seed) {
    return perturbed(cage, static_cast<float>(0.03 * extent(doublePositions(cage))), seed);
}

std::vector<SubdivisionCage> bases() {
    std::vector<SubdivisionCage> all{{"cube", cube()},
                                     {"tetrahedron", tetrahedron()},
                                     {"icosahedron", gyroBipyramid(5)},
                                     {"icosahedron, quartered", quartered(gyroBipyramid(5))},
                                     {"dodecahedron", dodecahedron()},
                                     {"torus", torus(6, 5)},
                                     {"grid", grid(4, 3)},
                                     {"one quad", grid(1, 1)},
                                     {"one triangle", inTriangles(withoutFaces(tetrahedron(), {1, 2, 3}))},
                                     {"jack", jack()},
                                     {"open jack", withoutFaces(jack(), {0, 13})},
                                     {"cylinder of 12", cappedCylinder(12, 3)}};
    for (const uint32_t k : {3u, 5u, 6u, 7u, 8u}) {
        const std::string valence = std::to_string(k);
        all.push_back({"disk of valence " + valence, fan(k, 2, kWholeTurn, true)});
        all.push_back({"fan of " + valence, fan(k, 2, 0.8 * kWholeTurn, false)});
        all.push_back({"triangles of valence " + valence, quartered(gyroBipyramid(k))});
        all.push_back({"open triangles of valence " + valence, withoutFaces(gyroBipyramid(k), {0})});
        all.push_back({"mixed, valence " + valence, fanOverQuads(k)});
    }
    for (SubdivisionCage& entry : all) {
        entry.cage = rotatedFaces(entry.cage);
    }
    return all;
}

/// Every kind of crease by itself.
std::vector<SubdivisionCage> creased() {
    const auto with = [](cage::Cage cage, std::vector<cage::Crease> creases, std::vector<cage::SharpVertex> sharp) {
        cage.creases = std::move(creases);
        cage.sharpVertices = std::move(sharp);
        return jittered(cage, 5);
    };
    constexpr float kHard = cage::kHardSharpness;
    // Vertices of the grid: 5 y + x.
    const cage::Cage flat = grid(4, 4);
    const auto line = [](float s) {
        return std::vector<cage::Crease>{{10, 11, s}, {11, 12, s}, {12, 13, s}, {13, 14, s}};
    };
    std::vector<SubdivisionCage> all;
    for (const float s : {0.4f, 1.0f, 1.5f, 2.4f, 3.7f, kHard}) {
        all.push_back({"grid with a crease of " + std::to_string(s), with(flat, line(s), {})});
    }
    for (const float s : {0.6f, 1.2f, 3.3f, kHard}) {
        all.push_back({"dart of " + std::to_string(s), with(flat, {{10, 11, s}, {11, 12, s}}, {})});
        all.push_back({"corner of three creases of " + std::to_string(s),
                       with(flat, {{12, 11, s}, {12, 13, s}, {12, 17, s}}, {})});
        all.push_back({"sharp vertex of " + std::to_string(s), with(flat, {}, {{12, s}})});
        all.push_back({"dart at a sharp vertex of " + std::to_string(s), with(flat, {{11, 12, kHard}}, {{12, s}})});
    }
    all.push_back({"creases of different sharpness",
                   with(flat, {{10, 11, 1.7f}, {11, 12, 0.3f}, {12, 13, 2.2f}, {12, 17, kHard}, {7, 12, 0.9f}}, {})});
    all.push_back({"crease into a boundary", with(flat, {{2, 7, kHard}, {7, 12, 1.3f}}, {{2, 1.5f}})});
    return all;
}

} // namespace

cage::Cage withRandomSharpness(cage::Cage cage, uint32_t seed) {
    std::mt19937 random(seed);
    const auto draw = [&](float below) { return below * static_cast<float>(random() / 4294967296.0); };
    const auto sharpness = [&] {
        const float kind = draw(3.0f);
        return kind < 1.0f ? draw(1.0f) : kind < 2.0f ? draw(4.0f) : cage::kHardSharpness;
    };
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (const std::vector<uint32_t>& p : facesOf(cage)) {
        for (size_t i = 0; i < p.size(); ++i) {
            const uint32_t a = p[i], b = p[(i + 1) % p.size()];
            edges.insert({std::min(a, b), std::max(a, b)});
        }
    }
    for (const auto& [a, b] : edges) {
        if (draw(3.0f) < 1.0f) {
            cage.creases.push_back({a, b, sharpness()});
        }
    }
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        if (draw(10.0f) < 1.0f) {
            cage.sharpVertices.push_back({v, sharpness()});
        }
    }
    return cage;
}

cage::Cage inTriangles(const cage::Cage& cage) {
    Faces triangles;
    std::vector<uint32_t> holes;
    const Faces polygons = facesOf(cage);
    for (uint32_t f = 0; f < polygons.size(); ++f) {
        const std::vector<uint32_t>& p = polygons[f];
        for (size_t k = 1; k + 1 < p.size(); ++k) {
            if (std::binary_search(cage.holes.begin(), cage.holes.end(), f)) {
                holes.push_back(static_cast<uint32_t>(triangles.size()));
            }
            triangles.push_back({p[0], p[k], p[k + 1]});
        }
    }
    cage::Cage result = makeCage(cage.positions, triangles);
    result.creases = cage.creases;
    result.sharpVertices = cage.sharpVertices;
    result.holes = std::move(holes);
    return result;
}

const std::vector<SubdivisionCage>& subdivisionZoo() {
    static const std::vector<SubdivisionCage> kAll = [] {
        std::vector<SubdivisionCage> all;
        uint32_t seed = 0;
        for (const SubdivisionCage& base : bases()) {
            const cage::Cage moved = jittered(base.cage, ++seed);
            all.push_back(base);
            all.push_back({base.name + ", moved", moved});
            for (uint32_t k = 0; k < 3; ++k) {
                all.push_back({base.name + ", sharpness at random", withRandomSharpness(moved, seed + 100 * k)});
            }
        }
        const std::vector<SubdivisionCage> named = creased();
        all.insert(all.end(), named.begin(), named.end());
        return all;
    }();
    return kAll;
}

} // namespace supple::test
