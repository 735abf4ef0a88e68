// Triangles far denser than what is drawn, to tell what rays meet, and rays at them.
#pragma once

#include "runtime/points/point_domains.h"
#include "tests/support/found_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace supple::test {

struct TestRay {
    glm::vec3 origin{0.0f}, direction{0.0f};
};

/// The surface in triangles, so many along a side of each domain.
class DenseTriangles {
public:
    DenseTriangles(const Surfaces& surfaces, const std::vector<glm::vec3>& cage, uint32_t along = 32)
        : along_(along), domains_(runtime::pointDomains(*surfaces)) {
        runtime::CpuPose pose(surfaces);
        EXPECT_TRUE(pose.build(reinterpret_cast<const std::byte*>(cage.data()), sizeof(cage[0]), {}));
        glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
        for (const runtime::PointDomain& domain : domains_) {
            std::vector<SuppleSurfacePoint> points;
            for (uint32_t j = 0; j <= along_; ++j) {
                for (uint32_t i = 0; i <= along_ - (domain.isQuad ? 0 : j); ++i) {
                    points.push_back(domain.at(static_cast<double>(i) / along_, static_cast<double>(j) / along_));
                }
            }
            std::vector<SuppleSurfaceJet> jets(points.size());
            EXPECT_TRUE(pose.evaluate(points, jets.data(), {}));
            Samples own;
            for (const SuppleSurfaceJet& jet : jets) {
                own.positions.emplace_back(jet.position[0], jet.position[1], jet.position[2]);
                own.low = glm::min(own.low, own.positions.back());
                own.high = glm::max(own.high, own.positions.back());
            }
            low = glm::min(low, own.low);
            high = glm::max(high, own.high);
            samples_.push_back(std::move(own));
        }
        middle = 0.5 * (low + high);
        half = 0.5 * (high - low);
        extent = glm::distance(low, high);
    }

    [[nodiscard]] double first(const TestRay& ray) const {
        double best = std::numeric_limits<double>::infinity();
        for (size_t p = 0; p < domains_.size(); ++p) {
            const Samples& own = samples_[p];
            if (!meets(ray, own)) {
                continue;
            }
            for (uint32_t j = 0; j < along_; ++j) {
                const bool isQuad = domains_[p].isQuad;
                const uint32_t length = along_ + 1 - (isQuad ? 0 : j);
                const glm::dvec3* const row = &own.positions[isQuad ? j * length : j * (along_ + 1) - j * (j - 1) / 2];
                for (uint32_t i = 0; i + 1 < length; ++i) {
                    const glm::dvec3* const next = row + length + i;
                    best = std::min(best, meet(ray, row[i], row[i + 1], next[0]));
                    if (isQuad || i + 2 < length) {
                        best = std::min(best, meet(ray, next[1], next[0], row[i + 1]));
                    }
                }
            }
        }
        return best;
    }

    /// How far the nearest corner of a triangle is from a place.
    [[nodiscard]] double nearest(const glm::dvec3& place) const {
        double best = std::numeric_limits<double>::infinity(); // squared
        for (const Samples& own : samples_) {
            const glm::dvec3 off = glm::max(glm::max(own.low - place, place - own.high), 0.0);
            if (glm::dot(off, off) >= best) {
                continue;
            }
            for (const glm::dvec3& p : own.positions) {
                best = std::min(best, glm::dot(p - place, p - place));
            }
        }
        return std::sqrt(best);
    }

    /// t where a ray meets a triangle, or infinity.
    static double meet(const TestRay& ray, const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) {
        const glm::dvec3 d(ray.direction), e = q - p, f = r - p, h = glm::cross(d, f), s = glm::dvec3(ray.origin) - p;
        const double area = glm::dot(e, h), u = glm::dot(s, h) / area;
        const glm::dvec3 k = glm::cross(s, e);
        const double v = glm::dot(d, k) / area, t = glm::dot(f, k) / area;
        return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 ? t : std::numeric_limits<double>::infinity();
    }

    glm::dvec3 middle{0.0}, half{0.0};
    double extent = 0.0;

private:
    struct Samples {
        std::vector<glm::dvec3> positions;
        glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
    };
    static bool meets(const TestRay& ray, const Samples& own) {
        const glm::dvec3 t0 = (own.low - glm::dvec3(ray.origin)) / glm::dvec3(ray.direction),
                         t1 = (own.high - glm::dvec3(ray.origin)) / glm::dvec3(ray.direction);
        const glm::dvec3 enters = glm::min(t0, t1), leaves = glm::max(t0, t1);
        return std::max({enters.x, enters.y, enters.z, 0.0}) <= std::min({leaves.x, leaves.y, leaves.z});
    }
    uint32_t along_;
    std::vector<runtime::PointDomain> domains_;
    std::vector<Samples> samples_;
};

/// From all round the surface to points on it; a third of them to anywhere in its box, so that many graze it.
inline std::vector<TestRay> raysAt(const DenseTriangles& dense, const Surfaces& surfaces,
                                   const std::vector<glm::vec3>& cage, uint32_t count) {
    SupplePointQuery scatter = queryOf(SUPPLE_FIND_SCATTER, count);
    std::vector<SuppleSurfaceJet> on(count);
    scatter.cage = &cage[0].x;
    scatter.cageVertexCount = static_cast<uint32_t>(cage.size());
    scatter.jets = on.data();
    (void)found(surfaces, scatter);
    std::mt19937 random(5);
    const auto number = [&] { return 2.0 * static_cast<double>(random() % 65536) / 65536.0 - 1.0; };
    std::vector<TestRay> rays;
    for (uint32_t k = 0; k < count; ++k) {
        const glm::dvec3 way = glm::normalize(glm::dvec3(number(), number(), number() + 1e-3));
        const glm::dvec3 from = dense.middle + dense.extent * way;
        const glm::dvec3 to = k % 3 == 0 ? dense.middle + dense.half * glm::dvec3(number(), number(), number())
                                         : runtime::vectorAt(on[k].position);
        rays.push_back({from, glm::normalize(to - from) * (k % 2 == 0 ? 1.0 : 0.25)});
    }
    return rays;
}

} // namespace supple::test
