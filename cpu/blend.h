// The blending surface on the CPU, in float or double. Sums have the order of docs/blend.md, so that float gives the
// bits of the device.
#pragma once

#include "cpu/chart_point.h"
#include "cpu/jet.h"
#include "cpu/point_weights.h"
#include "surface/blend/mesh.h"
#include "surface/blend/weights.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::surface::blend {

/// The coefficients of one chart: c_ab at 3 a + b.
template <class T>
using ChartCoefficients = std::array<glm::vec<3, T>, kCoefficients>;

/// The coefficients of a chart. `matrices`: by class. `positions`: as below.
template <class T>
[[nodiscard]] ChartCoefficients<T> coefficientsOf(const Mesh& mesh, std::span<const FitMatrix> matrices, uint32_t chart,
                                                  std::span<const glm::vec<3, T>> positions);

/// The coefficients of all charts. `positions`: of the vertices of Mesh::cage, which Mesh::stencils make of the host's.
template <class T>
[[nodiscard]] std::vector<ChartCoefficients<T>> construct(const Mesh& mesh, std::span<const glm::vec<3, T>> positions);

template <class T>
struct Sample {
    using Vec = glm::vec<3, T>;
    Vec position;
    Vec du, dv; ///< along the face's first edge, and across it
    Vec normal; ///< outwards, of unit length; zero if even the face has none
};

/// Evaluates faces at one rate or at any parameters. Mesh and coefficients must outlive it.
template <class T>
class Evaluator {
public:
    using Vec = glm::vec<3, T>;

    Evaluator(const Mesh& mesh, std::span<const ChartCoefficients<T>> coefficients, uint32_t rate);

    /// At u = i / rate, v = j / rate, in grid order of the quad domain.
    [[nodiscard]] Sample<T> at(uint32_t face, uint32_t i, uint32_t j) const;

    using Pair = glm::vec<2, T>;
    /// At (u, 1 - u) and (v, 1 - v), for level of detail. The rate plays no part.
    [[nodiscard]] Sample<T> at(uint32_t face, const Pair& u, const Pair& v) const;

private:
    struct Table {
        std::vector<Pair> directions;
        std::vector<T> radii;
        std::vector<Pair> points, slopes;
        std::vector<Pair> creasePoints, creaseSlopesX, creaseSlopesY; ///< empty if no chart needs them
    };
    /// A point of a chart's local surface: its offset from c_00, and the derivatives by the coordinates of the corner.
    struct Local {
        Vec offset, dx, dy;
    };
    struct Blend {
        Vec position, du, dv;
    };
    /// A sample in the coordinates of a corner: its place in the chart, and eta and its slope at x and at y.
    struct View {
        ChartPoint<T> point;
        Pair x, y;
    };
    using Views = std::array<View, 4>;

    [[nodiscard]] Views views(uint32_t face, uint32_t i, uint32_t j) const;
    [[nodiscard]] Views views(uint32_t face, const Pair& u, const Pair& v) const;
    [[nodiscard]] ChartPoint<T> tablePoint(uint32_t corner, uint32_t x, uint32_t y) const;
    [[nodiscard]] Local local(uint32_t corner, const ChartPoint<T>& at) const;
    [[nodiscard]] Blend blend(uint32_t face, const Views& views) const;
    /// A parameter with 1 - t, eta of both, and eta'(t).
    struct Along {
        T t = 0, back = 0, eta = 0, etaBack = 0, slope = 0;
    };
    /// Inside a regular face, by rows: as blend(), in another order of sums.
    [[nodiscard]] bool isRegular(uint32_t face) const;
    [[nodiscard]] Blend regular(uint32_t face, const Along& u, const Along& v) const;
    [[nodiscard]] Vec vertex(uint32_t corner) const;
    [[nodiscard]] bool isTiny(uint32_t face, const Vec& normal) const;
    [[nodiscard]] Vec normal(uint32_t face, uint32_t i, uint32_t j, const Blend& at) const;
    [[nodiscard]] Vec unitNormal(uint32_t face, Vec n) const;

    const Mesh& mesh_;
    std::span<const ChartCoefficients<T>> coefficients_;
    uint32_t rate_;
    std::vector<T> parameters_;          ///< per coordinate: t
    std::vector<Pair> weights_;          ///< eta(t), eta'(t)
    std::vector<Table> tables_;          ///< one per k
    std::vector<uint32_t> tableOfClass_; ///< per chart class, into tables_
};

/// With second derivatives, in (u, v) of a face. At a corner there are none but of interior charts with k = 4: then
/// the result is not finite.
[[nodiscard]] SurfaceJet evaluateJet(const Mesh& mesh, std::span<const ChartCoefficients<double>> coefficients,
                                     uint32_t face, double u, double v);

/// The same point as weights of the vertices of Mesh::cage. `matrices`: by class.
void weighJet(const Mesh& mesh, std::span<const FitMatrix> matrices, uint32_t face, double u, double v,
              cpu::PointWeights& out);
/// Adds a coefficient of a chart with its weight.
void weighCoefficient(const Mesh& mesh, std::span<const FitMatrix> matrices, uint32_t chart, uint32_t coefficient,
                      const cpu::VertexWeight& weight, cpu::PointWeights& out);

} // namespace supple::surface::blend
