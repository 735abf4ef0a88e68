// Weights and tables of the blending surface, in double: from a chart's class and the rate alone. Formulas:
// docs/blend.md.
#pragma once

#include "surface/blend/mesh.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace supple::surface::blend {

/// c_ab, the coefficient of U^a V^b, a and b from 0 to 2, stands at 3 a + b.
inline constexpr uint32_t kCoefficients = 9;

/// c = (v in row 0, else 0) + sum of weight(row, i) * (ring point i - v): constrained least squares, multiplied out.
/// Row 0 is zero but for curves. Rows 5 and 8 (U V^2, U^2 V^2) are zero but for closed charts of four sectors.
struct FitMatrix {
    uint32_t ringPoints = 0;
    std::vector<double> weights; ///< kCoefficients rows of ringPoints

    [[nodiscard]] double weight(uint32_t row, uint32_t ringPoint) const {
        return weights[row * ringPoints + ringPoint];
    }
};
[[nodiscard]] FitMatrix makeFitMatrix(const ChartClass& chartClass);

/// The coordinates of samples, along either axis of a face: i / rate for i = 0..rate, and then half a step inside
/// either border, where normals are taken that the border itself has not.
[[nodiscard]] constexpr uint32_t coordinateCount(uint32_t rate) {
    return rate + 3;
}
[[nodiscard]] constexpr uint32_t firstHalfStep(uint32_t rate) {
    return rate + 1;
}
[[nodiscard]] constexpr uint32_t lastHalfStep(uint32_t rate) {
    return rate + 2;
}
/// The coordinate 1 - t of t.
[[nodiscard]] constexpr uint32_t mirrored(uint32_t rate, uint32_t coordinate) {
    return coordinate <= rate ? rate - coordinate : 2 * rate + 3 - coordinate;
}
/// t as a fraction.
struct Coordinate {
    uint32_t numerator = 0, denominator = 1;
};
[[nodiscard]] Coordinate coordinateAt(uint32_t rate, uint32_t coordinate);

/// e^(2 pi i h / k), h = 0..k, exact at quarter turns; the last is the first.
[[nodiscard]] std::vector<glm::dvec2> chartDirections(uint32_t turns);

/// Where the samples of a sector lie in a chart, for all charts of the same k. Sector h is sector 0 turned by
/// directions[h], as complex numbers. Samples (i, j) at j * coordinateCount + i, z = x + iy of coordinates i and j.
struct ChartTable {
    uint32_t turns = 4; ///< k
    uint32_t rate = 1;
    std::vector<glm::dvec2> directions; ///< chartDirections()
    std::vector<double> radii;          ///< per coordinate t: t^(4/k)
    std::vector<glm::dvec2> points;     ///< zeta = z^(4/k)
    std::vector<glm::dvec2> slopes;     ///< d zeta / dz; 0 at z = 0, where there may be none
};
[[nodiscard]] ChartTable makeChartTable(uint32_t turns, uint32_t rate);

/// The parameter T along a crease likewise: the real part of these, turned. Of the same k = 2 q as the chart.
struct CreaseTable {
    std::vector<glm::dvec2> points;           ///< |z| e^(4 i arg z / k)
    std::vector<glm::dvec2> slopesX, slopesY; ///< d/dx and d/dy of that; at z = 0 those along the first spoke
};
[[nodiscard]] CreaseTable makeCreaseTable(uint32_t turns, uint32_t rate);

} // namespace supple::surface::blend
