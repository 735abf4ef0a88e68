// The blending surface on the CPU, in float or double, with the sums of docs/blend.md in their order: for tests and
// comparisons, not part of the runtime. In float it gives the device's bits.
#pragma once

#include "surface/blend/chart_point.h"
#include "surface/blend/mesh.h"
#include "surface/blend/weights.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::surface::blend {

/// Of one chart: c_ab at 3 a + b.
template <class T>
using ChartCoefficients = std::array<glm::vec<3, T>, kCoefficients>;

/// Of all charts, from positions of Mesh::cage's vertices (the host's, put through Mesh::stencils).
template <class T>
[[nodiscard]] std::vector<ChartCoefficients<T>> construct(const Mesh& mesh, std::span<const glm::vec<3, T>> positions);

template <class T>
struct Sample {
    using Vec = glm::vec<3, T>;
    Vec position;
    Vec du, dv; ///< along the face's first edge, and across it
    Vec normal; ///< outwards, of unit length; zero where even the face has none
};

/// Samples of the faces at one rate, and at any parameters. Keeps references to the mesh and the coefficients.
template <class T>
class Evaluator {
public:
    using Vec = glm::vec<3, T>;

    Evaluator(const Mesh& mesh, std::span<const ChartCoefficients<T>> coefficients, uint32_t rate);

    /// At u = i / rate, v = j / rate, in grid order of the quad domain.
    [[nodiscard]] Sample<T> at(uint32_t face, uint32_t i, uint32_t j) const;

    using Pair = glm::vec<2, T>;
    /// At (u, 1 - u) and (v, 1 - v), as level of detail has them: whatever the rate.
    [[nodiscard]] Sample<T> at(uint32_t face, const Pair& u, const Pair& v) const;

private:
    struct Table {
        std::vector<Pair> directions;
        std::vector<T> radii;
        std::vector<Pair> points, slopes;
        std::vector<Pair> creasePoints, creaseSlopesX, creaseSlopesY; ///< empty where no chart needs them
    };
    /// Of a local geometry: its offset from c_00, and derivatives by the corner's coordinates.
    struct Local {
        Vec offset, dx, dy;
    };
    struct Blend {
        Vec position, du, dv;
    };
    /// A sample as a corner sees it: its place in the chart, and eta and its slope at x and y.
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
    [[nodiscard]] Vec vertex(uint32_t corner) const;
    [[nodiscard]] bool isTiny(uint32_t face, const Vec& normal) const;
    [[nodiscard]] Vec normal(uint32_t face, uint32_t i, uint32_t j, const Blend& at) const;
    [[nodiscard]] Vec unitNormal(uint32_t face, Vec n) const;

    const Mesh& mesh_;
    std::span<const ChartCoefficients<T>> coefficients_;
    uint32_t rate_;
    std::vector<T> parameters_;          ///< per coordinate: t
    std::vector<Pair> weights_;          ///< eta(t), eta'(t)
    std::vector<Table> tables_;          ///< one a k
    std::vector<uint32_t> tableOfClass_; ///< per chart class, into tables_
};

} // namespace supple::surface::blend
