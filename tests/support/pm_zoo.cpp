#include "tests/support/pm_zoo.h"

#include "tests/support/chess_pieces.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <random>
#include <set>
#include <tuple>
#include <utility>

namespace supple::test {
namespace {

/// Uniform draws that are the same everywhere: the standard's distributions are not specified bit for bit.
class Draws {
public:
    explicit Draws(uint32_t seed) : engine_(seed) {}
    uint32_t below(size_t count) { return static_cast<uint32_t>(engine_() % count); }
    double between(double low, double high) { return low + (high - low) * engine_() / 4294967295.0; }

private:
    std::mt19937 engine_;
};

std::vector<std::pair<uint32_t, uint32_t>> halfEdges(const cage::Cage& cage) {
    std::vector<std::pair<uint32_t, uint32_t>> all;
    for (const std::vector<uint32_t>& p : facesOf(cage)) {
        for (size_t i = 0; i < p.size(); ++i) {
            all.emplace_back(p[i], p[(i + 1) % p.size()]);
        }
    }
    return all;
}

cage::Cage jitteredPm(const cage::Cage& cage, uint32_t seed) {
    return perturbed(cage, static_cast<float>(0.02 * extent(doublePositions(cage))), seed);
}

cage::Cage withRandomAlphas(cage::Cage cage, uint32_t seed) {
    Draws draws(seed);
    std::set<std::pair<uint32_t, uint32_t>> ends;
    for (const auto& [a, b] : halfEdges(cage)) {
        ends.insert({a, b});
        ends.insert({b, a});
    }
    for (const auto& [vertex, toward] : ends) {
        cage.creaseScalars.push_back({vertex, toward, static_cast<float>(draws.between(0.05, 0.95))});
    }
    return cage;
}

void addSharpVertices(cage::Cage& cage, Draws& draws) {
    for (uint32_t k = 0; k <= cage.vertexCount() / 8; ++k) {
        cage.sharpVertices.push_back({draws.below(cage.vertexCount()), cage::kHardSharpness});
    }
}

/// Without one to three faces that leave a manifold with no stray vertices: faces that share no vertex.
cage::Cage opened(const cage::Cage& cage, uint32_t seed) {
    Draws draws(seed);
    const Faces polygons = facesOf(cage);
    std::set<uint32_t> touched;
    std::vector<uint32_t> dropped;
    for (uint32_t k = draws.below(3); k < 3; ++k) {
        const uint32_t f = draws.below(polygons.size());
        if (std::none_of(polygons[f].begin(), polygons[f].end(), [&](uint32_t v) { return touched.contains(v); })) {
            touched.insert(polygons[f].begin(), polygons[f].end());
            dropped.push_back(f);
        }
    }
    cage::Cage open = withRandomAlphas(withoutFaces(cage, dropped), seed);
    addSharpVertices(open, draws);
    return open;
}

/// The outer edges of the fan round `apex` hard.
cage::Cage withHardRing(cage::Cage cage, uint32_t apex) {
    for (const std::vector<uint32_t>& p : facesOf(cage)) {
        const auto at = std::find(p.begin(), p.end(), apex);
        if (at != p.end()) {
            const auto i = static_cast<size_t>(at - p.begin());
            cage.creases.push_back({p[(i + 1) % 3], p[(i + 2) % 3], cage::kHardSharpness});
        }
    }
    return cage;
}

/// Hard creases along random walks, soft ones elsewhere.
cage::Cage creased(cage::Cage cage, uint32_t seed) {
    Draws draws(seed);
    const std::vector<std::pair<uint32_t, uint32_t>> edges = halfEdges(cage);
    for (uint32_t walk = 0; walk < 2; ++walk) {
        uint32_t at = edges[draws.below(edges.size())].first;
        for (uint32_t step = 0; step < 5; ++step) {
            std::vector<uint32_t> next;
            for (const auto& [a, b] : edges) {
                if (a == at) {
                    next.push_back(b);
                }
            }
            const uint32_t to = next[draws.below(next.size())];
            cage.creases.push_back({at, to, cage::kHardSharpness});
            at = to;
        }
    }
    for (const auto& [a, b] : edges) {
        if (draws.below(4) == 0) {
            cage.creases.push_back({a, b, static_cast<float>(draws.between(0.0, 4.0))});
        }
    }
    addSharpVertices(cage, draws);
    return cage;
}

std::vector<std::pair<std::string, cage::Cage>> pmBases() {
    std::vector<std::pair<std::string, cage::Cage>> all{{"cube", cube()}, {"torus", torus(8, 6)}};
    for (const uint32_t n : {3u, 5u, 6u, 7u, 8u, 9u}) {
        all.emplace_back("prism " + std::to_string(n), prism(n));
    }
    for (uint32_t n = 3; n <= 10; ++n) {
        all.emplace_back("trapezohedron " + std::to_string(n), trapezohedron(n));
        all.emplace_back("triangles, valence " + std::to_string(n), gyroBipyramid(n));
    }
    for (const uint32_t n : {3u, 4u, 6u, 12u}) {
        all.emplace_back("bipyramid " + std::to_string(n), cappedCylinder(n, 1));
        all.emplace_back("capped cylinder " + std::to_string(n), cappedCylinder(n, 4));
        all.emplace_back("fan over pentagons " + std::to_string(n), fanOverPentagons(n));
    }
    for (uint32_t n = 3; n <= 6; ++n) {
        all.emplace_back("fan over quads " + std::to_string(n), fanOverQuads(n));
        all.emplace_back("fan over triangles " + std::to_string(n), fanOverTriangles(n));
    }
    for (uint32_t seed = 1; seed <= 4; ++seed) {
        all.emplace_back("merged triangles " + std::to_string(seed),
                         withMergedFaces(quartered(gyroBipyramid(7)), 400, seed));
    }
    for (uint32_t seed = 1; seed <= 6; ++seed) {
        const cage::Cage tube = cappedCylinder(9, 6);
        all.emplace_back("mixed cylinder " + std::to_string(seed),
                         withMergedFaces(withCutQuads(tube, 0.2, seed), 20 * seed, seed));
    }
    return all;
}

} // namespace

const char* pmVariantName(PmVariant variant) {
    constexpr const char* kNames[kPmVariants] = {"plain", "jittered", "alphas", "open", "creased"};
    return kNames[static_cast<size_t>(variant)];
}

const std::vector<PmCage>& pmZoo() {
    static const std::vector<PmCage> kAll = [] {
        std::vector<PmCage> all;
        uint32_t seed = 0;
        for (const auto& [name, base] : pmBases()) {
            ++seed;
            const cage::Cage moved = jitteredPm(base, seed);
            all.push_back({name, PmVariant::plain, base});
            all.push_back({name, PmVariant::jittered, moved});
            all.push_back({name, PmVariant::alphas, withRandomAlphas(moved, seed)});
            for (uint32_t k = 0; k < 3; ++k) {
                all.push_back({name, PmVariant::open, opened(moved, seed + 100 * k)});
                all.push_back({name, PmVariant::creased, creased(moved, seed + 100 * k)});
            }
        }
        // Fans that random creases and holes would hardly spare.
        for (uint32_t n = 3; n <= 6; ++n) {
            for (const auto& [name, base, apex] : {std::tuple{"bipyramid ", cappedCylinder(n, 1), n},
                                                   {"capped cylinder ", cappedCylinder(n, 4), 4 * n},
                                                   {"fan over quads ", fanOverQuads(n), 2 * n},
                                                   {"fan over triangles ", fanOverTriangles(n), 0u},
                                                   {"fan over pentagons ", fanOverPentagons(n), 0u}}) {
                all.push_back({name + std::to_string(n) + ", hard ring", PmVariant::creased,
                               withHardRing(jitteredPm(base, n), apex)});
            }
            const cage::Cage open = withoutFaces(fanOverTriangles(n), {0});
            all.push_back({"fan over triangles " + std::to_string(n) + ", open", PmVariant::open,
                           withRandomAlphas(jitteredPm(open, n), n)});
        }
        // Corners with inner edges, wide and straight, and rims.
        for (const ChessPiece& piece : chessPieces()) {
            if (piece.columns == 8) {
                all.push_back({piece.name, PmVariant::creased, piece.cage});
                all.push_back({piece.name + ", jittered", PmVariant::creased, jitteredPm(piece.cage, ++seed)});
            }
        }
        return all;
    }();
    return kAll;
}

} // namespace supple::test
