// A part of a face as one polynomial of the cage's vertices.
#pragma once

#include "cpu/point_weights.h"
#include "runtime/cpu_group.h"
#include "runtime/queries/face_parts.h"
#include "shaders/shared/queries.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace supple::runtime {

/// What a vertex has of a part's Bezier coefficients.
struct VertexShares {
    uint32_t vertex = 0;
    std::array<double, shared::kPieceCoefficients> of{};
};
struct PieceFit {
    std::vector<VertexShares> vertices;
    /// The most that weights differ by in sum, at places between those that the polynomial goes through.
    double error = 0.0;
};

/// Numbers vertices in the order in which they come.
class VertexNumbers {
public:
    explicit VertexNumbers(size_t vertexCount) : numbers_(vertexCount, kNone) {}

    /// The vertex' number: the next one, if it comes for the first time.
    uint32_t of(uint32_t vertex) {
        if (numbers_[vertex] == kNone) {
            numbers_[vertex] = static_cast<uint32_t>(vertices_.size());
            vertices_.push_back(vertex);
        }
        return numbers_[vertex];
    }
    void clear() {
        for (const uint32_t vertex : vertices_) {
            numbers_[vertex] = kNone;
        }
        vertices_.clear();
    }

private:
    static constexpr uint32_t kNone = ~0u;

    std::vector<uint32_t> numbers_;  ///< by vertex
    std::vector<uint32_t> vertices_; ///< that have a number
};

/// Finds the polynomial that goes through 16 points of a square, or 15 of a triangle.
class PieceFitter {
public:
    explicit PieceFitter(const CpuGroup& group);
    /// The group has the part. What points of its face weigh is kept until the next face.
    [[nodiscard]] PieceFit fit(const FacePart& part);

private:
    static constexpr size_t kQuartic = 15;

    struct Weight {
        uint32_t vertex = 0;
        double share = 0.0;
    };
    /// What vertices have of a point.
    const std::vector<Weight>& weightsAt(const FacePart& part, const glm::dvec2& at);
    /// The most that the weights of a polynomial differ by in sum.
    [[nodiscard]] double errorOf(const FacePart& part, const PieceFit& fit);
    /// Values at the points become coefficients.
    [[nodiscard]] std::array<double, shared::kPieceCoefficients>
    coefficientsOf(bool isSquare, const std::array<double, shared::kPieceCoefficients>& values) const;

    const CpuGroup& group_;
    VertexNumbers numbers_;                                          ///< of the part that is looked at
    std::vector<double> differences_;                                ///< by number
    cpu::PointWeights weights_;                                      ///< of the point that is looked at
    uint32_t face_ = SUPPLE_NO_FACE;                                 ///< whose points are kept
    std::map<std::array<float, 3>, std::vector<Weight>> known_;      ///< by side and place
    std::array<std::array<double, kQuartic>, kQuartic> toQuartic_{}; ///< from values at points
};

} // namespace supple::runtime
