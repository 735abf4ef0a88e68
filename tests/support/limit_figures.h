// What comparisons with OpenSubdiv's limit surfaces find.
#pragma once

#include "tests/support/meshes.h"
#include "tests/support/worst.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <glm/glm.hpp>
#include <vector>

namespace supple::test {

struct LimitFigures {
    double position = 0.0, normal = 0.0; ///< the largest, as a part of the extent and in degrees
    /// The same at corners. OpenSubdiv's approximation at level 10 is 1e-5 from the limit at the tips of darts: points
    /// of ever finer levels come near ours.
    double corner = 0.0;
    uint64_t samples = 0, normals = 0, steep = 0;

    void add(const LimitFigures& other) {
        raise(position, other.position);
        raise(normal, other.normal);
        raise(corner, other.corner);
        samples += other.samples;
        normals += other.normals;
        steep += other.steep;
    }
    void print(const char* name) const {
        std::printf("%s: %llu samples, positions within %.1e of the extent, at corners %.1e; %llu of %llu normals "
                    "above 0.05 degrees, at most %.2f\n",
                    name, static_cast<unsigned long long>(samples), position, corner,
                    static_cast<unsigned long long>(steep), static_cast<unsigned long long>(normals), normal);
    }
};

/// What errors are measured by: the extent, or the largest coordinate where that is larger, since float rounds there.
inline double sizeOf(const std::vector<glm::dvec3>& positions) {
    double size = extent(positions);
    for (const glm::dvec3& p : positions) {
        size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return size;
}

} // namespace supple::test
