// A part of a face as one polynomial of the cage's vertices.
#pragma once

#include "runtime/cpu_group.h"
#include "runtime/queries/face_parts.h"
#include "shaders/shared/queries.h"

#include <array>
#include <cstdint>
#include <vector>

namespace supple::runtime {

/// What a vertex has of a part's Bezier coefficients.
struct VertexShares {
    uint32_t vertex = 0;
    std::array<double, shared::kPieceCoefficients> of{};
};
struct PieceFit {
    std::vector<VertexShares> vertices;
    double error =
        0.0; ///< the most that weights differ by in sum, at places between those that the polynomial goes through
};

/// Finds the polynomial that goes through 16 points of a square, or 15 of a triangle.
class PieceFitter {
public:
    explicit PieceFitter(const CpuGroup& group);
    /// The group has the part.
    [[nodiscard]] PieceFit fit(const FacePart& part) const;

private:
    static constexpr size_t kQuartic = 15;

    /// Adds what each vertex has of a point, as number `column`.
    void weigh(const FacePart& part, const glm::dvec2& at, size_t column, std::vector<VertexShares>& out) const;
    /// Values at the points become coefficients.
    [[nodiscard]] std::array<double, shared::kPieceCoefficients>
    coefficientsOf(bool isSquare, const std::array<double, shared::kPieceCoefficients>& values) const;

    const CpuGroup& group_;
    std::array<std::array<double, kQuartic>, kQuartic> toQuartic_{}; ///< from values at points
};

} // namespace supple::runtime
