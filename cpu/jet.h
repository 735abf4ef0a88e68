// Second derivatives without formulas of their own: numbers that carry them along (automatic differentiation). For
// curvature.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace supple::surface {

/// A value at (x, y) with its first and second derivatives.
struct Jet {
    double value = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

    /// The parameters themselves.
    [[nodiscard]] static Jet first(double value) { return {value, 1.0, 0.0, 0.0, 0.0, 0.0}; }
    [[nodiscard]] static Jet second(double value) { return {value, 0.0, 1.0, 0.0, 0.0, 0.0}; }
    [[nodiscard]] static Jet constant(double value) { return {value, 0.0, 0.0, 0.0, 0.0, 0.0}; }
};

[[nodiscard]] inline Jet operator+(const Jet& a, const Jet& b) {
    return {a.value + b.value, a.x + b.x, a.y + b.y, a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
}
[[nodiscard]] inline Jet operator*(double s, const Jet& a) {
    return {s * a.value, s * a.x, s * a.y, s * a.xx, s * a.xy, s * a.yy};
}
[[nodiscard]] inline Jet operator-(const Jet& a, const Jet& b) {
    return {a.value - b.value, a.x - b.x, a.y - b.y, a.xx - b.xx, a.xy - b.xy, a.yy - b.yy};
}
[[nodiscard]] inline Jet operator+(const Jet& a, double s) {
    return {a.value + s, a.x, a.y, a.xx, a.xy, a.yy};
}
[[nodiscard]] inline Jet operator-(double s, const Jet& a) {
    return {s - a.value, -a.x, -a.y, -a.xx, -a.xy, -a.yy};
}
[[nodiscard]] inline Jet operator*(const Jet& a, const Jet& b) {
    return {a.value * b.value,
            a.x * b.value + a.value * b.x,
            a.y * b.value + a.value * b.y,
            a.xx * b.value + 2.0 * (a.x * b.x) + a.value * b.xx,
            a.xy * b.value + (a.x * b.y + a.y * b.x) + a.value * b.xy,
            a.yy * b.value + 2.0 * (a.y * b.y) + a.value * b.yy};
}
/// A function of one number, of which value, slope and second derivative at a.value are given.
[[nodiscard]] inline Jet composed(const Jet& a, double value, double slope, double bend) {
    return {value,
            slope * a.x,
            slope * a.y,
            slope * a.xx + bend * (a.x * a.x),
            slope * a.xy + bend * (a.x * a.y),
            slope * a.yy + bend * (a.y * a.y)};
}
[[nodiscard]] inline Jet cosineOf(const Jet& a) {
    return composed(a, std::cos(a.value), -std::sin(a.value), -std::cos(a.value));
}
[[nodiscard]] inline Jet sineOf(const Jet& a) {
    return composed(a, std::sin(a.value), std::cos(a.value), -std::sin(a.value));
}
/// A power of a positive number.
[[nodiscard]] inline Jet power(const Jet& a, double exponent) {
    const double value = std::pow(a.value, exponent), slope = exponent * value / a.value;
    return composed(a, value, slope, (exponent - 1.0) * slope / a.value);
}
/// The angle of (a, b), one of which is not 0.
[[nodiscard]] inline Jet angleOf(const Jet& a, const Jet& b) {
    const bool steep = std::abs(b.value) > std::abs(a.value);
    const Jet ratio = steep ? a * power(b, -1.0) : b * power(a, -1.0); // both are positive where they divide
    const double square = 1.0 + ratio.value * ratio.value, sign = steep ? -1.0 : 1.0;
    return composed(ratio, std::atan2(b.value, a.value), sign / square, -2.0 * sign * ratio.value / (square * square));
}

/// A point of a surface with all that curvature needs.
struct SurfaceJet {
    glm::dvec3 position{0.0}, du{0.0}, dv{0.0}, duu{0.0}, duv{0.0}, dvv{0.0};

    /// Adds a coefficient with its weight.
    void add(const glm::dvec3& p, const Jet& w) {
        position += w.value * p, du += w.x * p, dv += w.y * p;
        duu += w.xx * p, duv += w.xy * p, dvv += w.yy * p;
    }
};

/// Curvature of an outward surface (du x dv points outwards): positive means are those of a sphere.
struct Curvature {
    bool exists = false; ///< no: du and dv are parallel
    double mean = 0.0, gaussian = 0.0;
};
[[nodiscard]] inline Curvature curvatureOf(const SurfaceJet& s) {
    const glm::dvec3 normal = glm::cross(s.du, s.dv);
    const double e = glm::dot(s.du, s.du), f = glm::dot(s.du, s.dv), g = glm::dot(s.dv, s.dv);
    const double area = glm::dot(normal, normal); // e g - f f, without its cancellation
    if (!(area > 1e-20 * e * g)) {
        return {};
    }
    const glm::dvec3 unit = normal / std::sqrt(area);
    const double l = glm::dot(s.duu, unit), m = glm::dot(s.duv, unit), n = glm::dot(s.dvv, unit);
    return {true, -(e * n - 2.0 * f * m + g * l) / (2.0 * area), (l * n - m * m) / area};
}

} // namespace supple::surface
