#include "tools/bench/plain_cages.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <vector>

namespace supple::bench {

cage::Cage quadTorus(uint32_t around, uint32_t across) {
    constexpr float kTube = 0.45f;
    cage::Cage cage;
    cage.faceStarts.push_back(0);
    for (uint32_t i = 0; i < around; ++i) {
        const float a = glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(around);
        for (uint32_t j = 0; j < across; ++j) {
            const float b = glm::two_pi<float>() * static_cast<float>(j) / static_cast<float>(across);
            const float radius = 1.0f + kTube * std::cos(b);
            cage.positions.emplace_back(radius * std::cos(a), kTube * std::sin(b), radius * std::sin(a));
            const auto vertex = [&](uint32_t di, uint32_t dj) {
                return (i + di) % around * across + (j + dj) % across;
            };
            cage.faceVertices.insert(cage.faceVertices.end(), {vertex(0, 0), vertex(0, 1), vertex(1, 1), vertex(1, 0)});
            cage.faceStarts.push_back(cage.faceStarts.back() + 4);
        }
    }
    return cage;
}

cage::Cage triangulated(const cage::Cage& quads) {
    cage::Cage cage;
    cage.positions = quads.positions;
    cage.faceStarts.push_back(0);
    for (uint32_t f = 0; f < quads.faceCount(); ++f) {
        const uint32_t* v = &quads.faceVertices[quads.faceStarts[f]];
        for (const uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) {
            cage.faceVertices.push_back(v[corner]);
        }
        cage.faceStarts.push_back(cage.faceStarts.back() + 3);
        cage.faceStarts.push_back(cage.faceStarts.back() + 3);
    }
    return cage;
}

cage::Cage dodecahedron() {
    // Each vertex of a cube's edges and faces: corners (+-1, +-1, +-1), and (0, +-1/g, +-g) by turns.
    const double g = 0.5 * (1.0 + std::sqrt(5.0)), h = 1.0 / g;
    cage::Cage cage;
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            for (const double z : {-1.0, 1.0})
                cage.positions.emplace_back(x, y, z);
            cage.positions.emplace_back(0.0, x * h, y * g);
            cage.positions.emplace_back(x * h, y * g, 0.0);
            cage.positions.emplace_back(y * g, 0.0, x * h);
        }
    }
    cage.faceStarts.push_back(0);
    // A face lies towards (0, +-g, +-1) by turns; its corners are the five vertices furthest that way, round it.
    for (uint32_t turn = 0; turn < 3; ++turn) {
        for (uint32_t side = 0; side < 4; ++side) {
            const double a = side & 1u ? g : -g, b = side & 2u ? 1.0 : -1.0;
            const glm::dvec3 outwards = glm::normalize(turn == 0   ? glm::dvec3(0.0, a, b)
                                                       : turn == 1 ? glm::dvec3(a, b, 0.0)
                                                                   : glm::dvec3(b, 0.0, a));
            std::vector<uint32_t> order(cage.positions.size());
            for (uint32_t v = 0; v < order.size(); ++v)
                order[v] = v;
            const auto along = [&](uint32_t v) { return glm::dot(glm::dvec3(cage.positions[v]), outwards); };
            std::sort(order.begin(), order.end(), [&](uint32_t p, uint32_t q) { return along(p) > along(q); });
            order.resize(5);
            const glm::dvec3 x = glm::normalize(glm::dvec3(cage.positions[order[0]]) - along(order[0]) * outwards);
            const glm::dvec3 y = glm::cross(outwards, x);
            const auto angle = [&](uint32_t v) {
                return std::atan2(glm::dot(glm::dvec3(cage.positions[v]), y),
                                  glm::dot(glm::dvec3(cage.positions[v]), x));
            };
            std::sort(order.begin(), order.end(), [&](uint32_t p, uint32_t q) { return angle(p) < angle(q); });
            cage.faceVertices.insert(cage.faceVertices.end(), order.begin(), order.end());
            cage.faceStarts.push_back(static_cast<uint32_t>(cage.faceVertices.size()));
        }
    }
    for (uint32_t v = 0; v < cage.vertexCount(); ++v)
        cage.sourceVertices.push_back(v);
    return cage;
}

} // namespace supple::bench
