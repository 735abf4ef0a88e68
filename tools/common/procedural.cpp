#include "tools/common/procedural.h"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_map>

namespace supple::cage {
namespace {

constexpr uint32_t kMaxSide = 9000; // keeps every corner index within 32 bits

void addQuad(Cage& cage, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    for (const uint32_t v : {a, b, c, d}) {
        cage.faceVertices.push_back(v);
    }
    cage.faceStarts.push_back(static_cast<uint32_t>(cage.faceVertices.size()));
}

void numberSources(Cage& cage) {
    cage.sourceVertices.resize(cage.positions.size());
    std::iota(cage.sourceVertices.begin(), cage.sourceVertices.end(), 0u);
}

} // namespace

Cage makeCubeSphere(uint32_t quadsPerSide) {
    Cage cage;
    const uint32_t n = quadsPerSide;
    if (n < 1 || n > kMaxSide) {
        return cage;
    }
    cage.faceStarts.push_back(0);
    std::unordered_map<uint64_t, uint32_t> vertices; // lattice point of the cube -> cage vertex
    const auto vertex = [&](const std::array<uint32_t, 3>& p) {
        const uint64_t key = (uint64_t{p[0]} * (n + 1) + p[1]) * (n + 1) + p[2];
        const auto [entry, isNew] = vertices.try_emplace(key, cage.vertexCount());
        if (isNew) {
            glm::dvec3 q;
            for (int i = 0; i < 3; ++i) {
                // The tangent spreads the quads evenly over the sphere.
                const double t = (2.0 * p[i] - n) / n;
                q[i] = std::tan(t * std::numbers::pi / 4.0);
            }
            cage.positions.push_back(glm::vec3(glm::normalize(q)));
        }
        return entry->second;
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (const uint32_t side : {0u, n}) {
            // (axis, first, second) is right-handed on the far side; the near side runs the other way round.
            const int first = side == n ? (axis + 1) % 3 : (axis + 2) % 3;
            const int second = side == n ? (axis + 2) % 3 : (axis + 1) % 3;
            for (uint32_t j = 0; j < n; ++j) {
                for (uint32_t i = 0; i < n; ++i) {
                    const auto corner = [&](uint32_t x, uint32_t y) {
                        std::array<uint32_t, 3> p{};
                        p[axis] = side;
                        p[first] = x;
                        p[second] = y;
                        return vertex(p);
                    };
                    const uint32_t a = corner(i, j);
                    const uint32_t b = corner(i + 1, j);
                    const uint32_t c = corner(i + 1, j + 1);
                    const uint32_t d = corner(i, j + 1);
                    addQuad(cage, a, b, c, d);
                }
            }
        }
    }
    numberSources(cage);
    return cage;
}

Cage makeSplitTorus(uint32_t around, uint32_t across) {
    Cage cage;
    if (around < 3 || around > kMaxSide || across < 3 || across > kMaxSide) {
        return cage;
    }
    cage.faceStarts.push_back(0);
    constexpr double kRing = 1.0;
    constexpr double kTube = 0.45;
    const auto place = [&](double x, double y) {
        const double a = 2.0 * std::numbers::pi * x / around;
        const double b = 2.0 * std::numbers::pi * y / across;
        const double reach = kRing + kTube * std::cos(b);
        cage.positions.push_back(glm::vec3(reach * std::sin(a), kTube * std::sin(b), reach * std::cos(a)));
    };
    // Six vertices a lattice point (i, j): itself, the midpoints towards (i+1, j), (i, j+1) and (i+1, j+1), and the
    // centres of the two triangles of the lattice square up and right of it.
    enum Kind : uint32_t { kPoint, kAlong, kUp, kDiagonal, kLowerCentre, kUpperCentre, kKinds };
    for (uint32_t i = 0; i < around; ++i) {
        for (uint32_t j = 0; j < across; ++j) {
            place(i, j);
            place(i + 0.5, j);
            place(i, j + 0.5);
            place(i + 0.5, j + 0.5);
            place(i + 2.0 / 3.0, j + 1.0 / 3.0);
            place(i + 1.0 / 3.0, j + 2.0 / 3.0);
        }
    }
    const auto vertex = [&](uint32_t i, uint32_t j, Kind kind) {
        return ((i % around) * across + j % across) * kKinds + kind;
    };
    const auto addTriangle = [&](std::array<uint32_t, 3> points, std::array<uint32_t, 3> midpoints, uint32_t centre) {
        for (size_t k = 0; k < 3; ++k) {
            addQuad(cage, points[k], midpoints[k], centre, midpoints[(k + 2) % 3]);
        }
    };
    for (uint32_t i = 0; i < around; ++i) {
        for (uint32_t j = 0; j < across; ++j) {
            const uint32_t origin = vertex(i, j, kPoint);
            const uint32_t opposite = vertex(i + 1, j + 1, kPoint);
            const uint32_t diagonal = vertex(i, j, kDiagonal);
            addTriangle({origin, vertex(i + 1, j, kPoint), opposite},
                        {vertex(i, j, kAlong), vertex(i + 1, j, kUp), diagonal}, vertex(i, j, kLowerCentre));
            addTriangle({origin, opposite, vertex(i, j + 1, kPoint)},
                        {diagonal, vertex(i, j + 1, kAlong), vertex(i, j, kUp)}, vertex(i, j, kUpperCentre));
        }
    }
    numberSources(cage);
    return cage;
}

} // namespace supple::cage
