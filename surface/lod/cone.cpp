#include "surface/lod/cone.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace supple::surface::lod {

namespace {

using Differences = std::array<glm::dvec3, 12>;

Differences alongU(const BicubicNet& g) {
    Differences result;
    for (size_t j = 0; j < 4; ++j) {
        for (size_t i = 0; i < 3; ++i) {
            result[3 * j + i] = g[4 * j + i + 1] - g[4 * j + i];
        }
    }
    return result;
}

Differences alongV(const BicubicNet& g) {
    Differences result;
    for (size_t k = 0; k < 12; ++k) {
        result[k] = g[k + 4] - g[k];
    }
    return result;
}

std::array<glm::dvec3, 144> products(const BicubicNet& g) {
    const Differences u = alongU(g), v = alongV(g);
    std::array<glm::dvec3, 144> result;
    for (size_t k = 0; k < 144; ++k) {
        result[k] = glm::cross(u[k / 12], v[k % 12]);
    }
    return result;
}

/// Round the mean direction.
NormalCone coneRound(std::span<const glm::dvec3> vectors) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& vector : vectors) {
        const double length = glm::length(vector);
        if (!(length > 0.0)) {
            return {};
        }
        sum += vector / length;
    }
    const double length = glm::length(sum);
    if (!(length > 0.0)) {
        return {};
    }
    NormalCone cone{sum / length, 1.0};
    for (const glm::dvec3& vector : vectors) {
        cone.cosine = std::min(cone.cosine, glm::dot(cone.axis, vector) / glm::length(vector));
    }
    return cone;
}

double sineOf(double cosine) {
    return std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
}

} // namespace

NormalCone coneOfProducts(const BicubicNet& g) {
    return coneRound(products(g));
}

NormalCone coneOfDifferences(const BicubicNet& g) {
    const NormalCone u = coneRound(alongU(g)), v = coneRound(alongV(g));
    const glm::dvec3 across = glm::cross(u.axis, v.axis);
    const double sine = glm::length(across); // of the angle between the axes
    if (u.cosine <= 0.0 || v.cosine <= 0.0 || sine <= 0.0) {
        return {};
    }
    // Sederberg, Meyers, "Loop detection in surface patch intersections" (1988): with a, b the cones' half-angles and w
    // the angle between their axes, sin^2 = (sin^2 a + 2 sin a sin b cos w + sin^2 b) / sin^2 w.
    const double a = sineOf(u.cosine), b = sineOf(v.cosine);
    const double squared = (a * a + 2.0 * a * b * std::abs(glm::dot(u.axis, v.axis)) + b * b) / (sine * sine);
    return {across / sine, squared < 1.0 ? std::sqrt(1.0 - squared) : -1.0};
}

bool showsItsBack(const NormalCone& cone, const BicubicNet& g, const glm::dvec3& camera) {
    if (cone.cosine <= 0.0) {
        return false;
    }
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& point : g) {
        middle += point / 16.0;
    }
    double radius = 0.0;
    for (const glm::dvec3& point : g) {
        radius = std::max(radius, glm::length(point - middle));
    }
    const glm::dvec3 away = middle - camera;
    const double distance = glm::length(away);
    if (distance <= radius) {
        return false;
    }
    // Normals are within a of the axis, points within b of `away`: a right angle stays if the axis is within 90 - a -
    // b.
    const double sineB = radius / distance;
    const double cosineOfBoth = cone.cosine * sineOf(sineB) - sineOf(cone.cosine) * sineB;
    const double sineOfBoth = sineOf(cone.cosine) * sineOf(sineB) + cone.cosine * sineB;
    return cosineOfBoth > 0.0 && glm::dot(cone.axis, away) >= distance * sineOfBoth;
}

bool netShowsItsBack(const BicubicNet& g, const glm::dvec3& camera) {
    const std::array<glm::dvec3, 144> normals = products(g);
    return std::all_of(normals.begin(), normals.end(), [&](const glm::dvec3& normal) {
        return std::all_of(g.begin(), g.end(),
                           [&](const glm::dvec3& point) { return glm::dot(normal, point - camera) >= 0.0; });
    });
}

} // namespace supple::surface::lod
