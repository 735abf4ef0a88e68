// Where a sample lies in a chart, computed from its parameters. The tables of a rate store this; here it is for any
// parameters. Float uses the device's operations (shaders/blend/blend.glsl), double those of the standard library.
#pragma once

#include "shaders/shared/elementary.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <type_traits>

namespace supple::surface::blend {

template <class T>
struct ChartPoint {
    glm::vec<2, T> zeta{};   ///< U + iV
    glm::vec<2, T> slope{};  ///< d zeta / dz
    T t = 0, tx = 0, ty = 0; ///< T and its slopes. T takes the place of U in terms without V
};

template <class T>
[[nodiscard]] glm::vec<2, T> product(const glm::vec<2, T>& a, const glm::vec<2, T>& b) {
    return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

/// The chart point of z = x + iy, with x and y from 0 to 1, in the sector between two spokes with these directions;
/// power = 4 / k. Beyond the diagonal it is computed from the next spoke backwards, so that both sectors at a spoke
/// multiply the same two numbers.
template <class T>
[[nodiscard]] ChartPoint<T> chartPoint(const glm::vec<2, T>& z, T power, bool creased, const glm::vec<2, T>& direction,
                                       const glm::vec<2, T>& next) {
    using Pair = glm::vec<2, T>;
    const bool back = z.y > z.x;
    const T high = back ? z.y : z.x, low = back ? z.x : z.y;
    const Pair toward = back ? next : direction;
    const T square = high * high + low * low;
    ChartPoint<T> at;
    if (!(high > T(0))) {
        return at;
    }
    if (power == T(1)) {
        at.zeta = product({high, back ? -low : low}, toward);
        at.slope = direction;
        at.t = at.zeta.x;
        at.tx = at.slope.x;
        at.ty = -at.slope.y;
        return at;
    }
    T length, radius;
    Pair turn;
    if constexpr (std::is_same_v<T, float>) {
        const float octaves = 0.5f * shared::log2Of(square);
        const float angle = power * shared::angleOf(low / high);
        length = low == 0.0f ? high : shared::exp2Of(octaves);
        radius = shared::exp2Of(power * octaves);
        turn = {shared::cosineOf(angle), shared::sineOf(angle)};
    } else {
        length = std::sqrt(square);
        radius = std::pow(length, power);
        const T angle = power * std::atan2(low, high);
        turn = {std::cos(angle), std::sin(angle)};
    }
    const Pair unit = product({turn.x, back ? -turn.y : turn.y}, toward);
    at.zeta = radius * unit;
    at.slope = (power / square) * product(at.zeta, {z.x, -z.y});
    if (creased) {
        const T cosine = z.x / length, sine = z.y / length;
        at.t = length * unit.x;
        at.tx = cosine * unit.x + power * (sine * unit.y);
        at.ty = sine * unit.x - power * (cosine * unit.y);
    } else {
        at.t = at.zeta.x;
        at.tx = at.slope.x;
        at.ty = -at.slope.y;
    }
    return at;
}

} // namespace supple::surface::blend
