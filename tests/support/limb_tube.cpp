#include "tests/support/limb_tube.h"

#include <algorithm>
#include <cmath>

namespace supple::test {

cage::Character limbTube(bool hard) {
    cage::Character tube;
    constexpr uint32_t kSides = 12, kRings = 33;
    tube.skin.joints = {0, 1};
    tube.skin.inverseBinds.assign(2, glm::mat4(1.0f));
    tube.weights.starts = {0};
    tube.cage.faceStarts = {0};
    for (uint32_t ring = 0; ring < kRings; ++ring) {
        const double z = -8.0 + 0.5 * ring, t = std::clamp((z + 2.0) / 4.0, 0.0, 1.0), smooth = t * t * (3.0 - 2.0 * t);
        const double share = hard ? (z > 0.0 ? 1.0 : 0.0) : smooth;
        for (uint32_t side = 0; side < kSides; ++side) {
            const double angle = 2.0 * 3.14159265358979 * side / kSides;
            tube.cage.positions.emplace_back(glm::dvec3(std::cos(angle), std::sin(angle), z));
            for (const uint32_t joint : {0u, 1u}) {
                const double weight = joint == 0 ? 1.0 - share : share;
                if (weight > 0.0) {
                    tube.weights.influences.push_back({joint, static_cast<float>(weight)});
                }
            }
            tube.weights.starts.push_back(static_cast<uint32_t>(tube.weights.influences.size()));
            if (ring + 1 < kRings) {
                const uint32_t next = (side + 1) % kSides;
                for (const uint32_t corner : {ring * kSides + side, ring * kSides + next, (ring + 1) * kSides + next,
                                              (ring + 1) * kSides + side}) {
                    tube.cage.faceVertices.push_back(corner);
                }
                tube.cage.faceStarts.push_back(static_cast<uint32_t>(tube.cage.faceVertices.size()));
            }
        }
    }
    return tube;
}

double limbTubeVolume(std::span<const glm::dvec3> points) {
    constexpr size_t kSides = 12, kRings = 33;
    double sum = 0.0;
    const auto triangle = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        sum += glm::dot(a, glm::cross(b, c)) / 6.0;
    };
    glm::dvec3 ends[2]{glm::dvec3(0.0), glm::dvec3(0.0)};
    for (size_t side = 0; side < kSides; ++side) {
        ends[0] += points[side] / 12.0;
        ends[1] += points[(kRings - 1) * kSides + side] / 12.0;
    }
    for (size_t side = 0; side < kSides; ++side) {
        const size_t next = (side + 1) % kSides, top = (kRings - 1) * kSides;
        for (size_t ring = 0; ring + 1 < kRings; ++ring) {
            const size_t a = ring * kSides + side, b = ring * kSides + next;
            triangle(points[a], points[b], points[b + kSides]);
            triangle(points[a], points[b + kSides], points[a + kSides]);
        }
        triangle(ends[0], points[next], points[side]);
        triangle(ends[1], points[top + side], points[top + next]);
    }
    return sum;
}

} // namespace supple::test
