// Weights and tables of the blending surface, in double. They depend on the class of a chart and on the rate alone.
// Formulas: docs/blend.md.
#pragma once

#include "surface/blend/mesh.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace supple::surface::blend {

/// The coefficient c_ab of U^a V^b, with a and b from 0 to 2, has the index 3 a + b.
inline constexpr uint32_t kCoefficients = 9;

/// The matrix of the constrained least-squares fit. With v the vertex, coefficient `row` is the sum of weight(row, i) *
/// (ring point i - v), plus v in row 0. Only curves have weights in row 0. Only closed charts of four sectors have
/// weights in rows 5 and 8 (U V^2, U^2 V^2).
struct FitMatrix {
    uint32_t ringPoints = 0;
    std::vector<double> weights; ///< kCoefficients rows of ringPoints weights

    [[nodiscard]] double weight(uint32_t row, uint32_t ringPoint) const {
        return weights[row * ringPoints + ringPoint];
    }
};
[[nodiscard]] FitMatrix makeFitMatrix(const ChartClass& chartClass);

/// The coordinates of samples along an axis of a face: i / rate for i = 0..rate, then two coordinates half a step
/// inside the borders. The latter give the normals of borders that have none themselves.
[[nodiscard]] constexpr uint32_t coordinateCount(uint32_t rate) {
    return rate + 3;
}
[[nodiscard]] constexpr uint32_t firstHalfStep(uint32_t rate) {
    return rate + 1;
}
[[nodiscard]] constexpr uint32_t lastHalfStep(uint32_t rate) {
    return rate + 2;
}
/// The index of the coordinate 1 - t.
[[nodiscard]] constexpr uint32_t mirrored(uint32_t rate, uint32_t coordinate) {
    return coordinate <= rate ? rate - coordinate : 2 * rate + 3 - coordinate;
}
/// t as a fraction.
struct Coordinate {
    uint32_t numerator = 0, denominator = 1;
    [[nodiscard]] double value() const { return static_cast<double>(numerator) / denominator; }
};
[[nodiscard]] Coordinate coordinateAt(uint32_t rate, uint32_t coordinate);

/// e^(2 pi i h / k) for h = 0..k, exact at quarter turns. The last entry equals the first.
[[nodiscard]] std::vector<glm::dvec2> chartDirections(uint32_t turns);

/// Where the samples of sector 0 lie in a chart, for all charts with the same k. For sector h they are multiplied by
/// directions[h] as complex numbers. Sample (i, j) has the index j * coordinateCount + i; its z = x + iy has the
/// coordinates i and j.
struct ChartTable {
    uint32_t turns = 4; ///< k
    uint32_t rate = 1;
    std::vector<glm::dvec2> directions; ///< chartDirections()
    std::vector<double> radii;          ///< per coordinate t: t^(4/k)
    std::vector<glm::dvec2> points;     ///< zeta = z^(4/k)
    std::vector<glm::dvec2> slopes;     ///< d zeta / dz; 0 at z = 0, where it may not exist
};
[[nodiscard]] ChartTable makeChartTable(uint32_t turns, uint32_t rate);

/// The same for the parameter T along a crease. T is the real part of the turned numbers. k = 2 q is that of the chart.
struct CreaseTable {
    std::vector<glm::dvec2> points;           ///< |z| e^(4 i arg z / k)
    std::vector<glm::dvec2> slopesX, slopesY; ///< its derivatives by x and y; at z = 0 those along the first spoke
};
[[nodiscard]] CreaseTable makeCreaseTable(uint32_t turns, uint32_t rate);

} // namespace supple::surface::blend
