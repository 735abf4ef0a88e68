#include "surface/chains/uv_chain.h"

#include <algorithm>
#include <array>

namespace supple::surface::chains {
namespace {

using subdivision::Fan;

/// As shaders/chains/chain.comp.
class ChainStep {
public:
    ChainStep(const Fan& fan, const std::vector<glm::dvec2>& before) : fan_(fan), before_(before) {}

    std::vector<glm::dvec2> run(const std::vector<float>& spokes, float vertex) {
        next_.assign(pointCount(fan_, 3), glm::dvec2(0.0));
        for (uint32_t h = 0; h < spokes.size(); ++h) {
            if (fan_.subdivision == Subdivision::loop) {
                makeTriangles(h, spokes[h]);
            } else {
                makeQuads(h, spokes[h]);
            }
        }
        next_[0] = centre(centreStep(spokes, vertex));
        return std::move(next_);
    }

private:
    using Row = std::array<glm::dvec2, 3>;

    [[nodiscard]] glm::dvec2 at(uint32_t h, int32_t a, int32_t b) const {
        const uint32_t index = pointIndex(fan_, h % fan_.sectors, a, b);
        return index == subdivision::kNoPoint ? glm::dvec2(0.0) : before_[index]; // the spoke there is sharp
    }
    [[nodiscard]] static Row halved(const Row& p) {
        return {(p[0] + p[1]) * 0.5, (p[0] + p[2] + 6.0 * p[1]) * 0.125, (p[1] + p[2]) * 0.5};
    }

    void makeQuads(uint32_t h, float sharpness) {
        const bool beyond = h == fan_.sectors; // the last spoke of an open fan: from the sector before
        std::array<Row, 4> rows;               // by j of -1..2
        for (int32_t j = 0; j < 4; ++j) {
            Row p{};
            for (int32_t i = 0; i < 3; ++i) {
                // The last spoke is sharp, so only its own points count.
                p[static_cast<size_t>(i)] = !beyond ? at(h, i, j - 1) : j == 1 ? at(h - 1, 0, i) : glm::dvec2(0.0);
            }
            rows[static_cast<size_t>(j)] = halved(p);
        }
        const double crease = std::min(static_cast<double>(sharpness), 1.0);
        for (size_t i = 0; i < 3; ++i) {
            const glm::dvec2 smooth = (rows[0][i] + rows[2][i] + 6.0 * rows[1][i]) * 0.125;
            const auto far = static_cast<int32_t>(i) + 1;
            if (beyond) {
                next_[pointIndex(fan_, h - 1, 0, far)] = rows[1][i];
                continue;
            }
            next_[pointIndex(fan_, h, far, 0)] = smooth + crease * (rows[1][i] - smooth);
            const Row inside = halved({rows[1][i], rows[2][i], rows[3][i]});
            for (int32_t j = 0; j < 3; ++j) {
                next_[pointIndex(fan_, h, far, j + 1)] = inside[static_cast<size_t>(j)];
            }
        }
    }

    static glm::dvec2 onEdge(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& left, const glm::dvec2& right,
                             double crease) {
        const glm::dvec2 smooth = (3.0 * (a + b) + (left + right)) * 0.125;
        return smooth + crease * ((a + b) * 0.5 - smooth);
    }

    void makeTriangles(uint32_t h, float sharpness) {
        const bool beyond = h == fan_.sectors; // the last spoke of an open fan has no sector
        const double crease = std::min(static_cast<double>(sharpness), 1.0);
        const auto onSpoke = [&](int32_t a) { return beyond ? at(h - 1, 0, a) : at(h, a, 0); };
        const glm::dvec2 c = before_[0], near = onSpoke(1), far = onSpoke(2);
        // What lies outside of an open fan counts nothing: its borders are sharp.
        const bool first = fan_.open && h == 0;
        const uint32_t last = h == 0 ? fan_.sectors - 1 : h - 1;
        const glm::dvec2 left = beyond ? c : at(h, 0, 1), leftFar = beyond ? c : at(h, 1, 1);
        const glm::dvec2 right = first ? c : at(last, 1, 0), rightFar = first ? c : at(last, 1, 1);
        const auto put = [&](int32_t a, const glm::dvec2& value) {
            next_[beyond ? pointIndex(fan_, h - 1, 0, a) : pointIndex(fan_, h, a, 0)] = value;
        };
        put(1, onEdge(c, near, left, right, crease));
        const glm::dvec2 around = (far + c) + (leftFar + rightFar) + (left + right);
        const glm::dvec2 smooth = (10.0 * near + around) * 0.0625, line = (6.0 * near + (far + c)) * 0.125;
        put(2, smooth + crease * (line - smooth));
        put(3, onEdge(near, far, leftFar, rightFar, crease));
        if (!beyond) {
            next_[pointIndex(fan_, h, 1, 1)] = onEdge(near, left, c, leftFar, 0.0);
            next_[pointIndex(fan_, h, 2, 1)] = onEdge(near, leftFar, far, left, 0.0);
            next_[pointIndex(fan_, h, 1, 2)] = onEdge(left, leftFar, near, at(h, 0, 2), 0.0);
        }
    }

    [[nodiscard]] glm::dvec2 centre(const CentreStep& step) const {
        const CentreWeights weights = refineWeights(fan_.subdivision, fan_.sectors);
        const uint32_t each = fan_.subdivision == Subdivision::loop ? 1 : 2; // points of ring 1 a spoke
        const glm::dvec2 c = before_[0];
        glm::dvec2 spokes(0.0), faces(0.0);
        for (uint32_t h = 0; h < fan_.sectors; ++h) {
            spokes += before_[1 + each * h] - c;
            faces += each == 2 ? before_[2 + each * h] - c : glm::dvec2(0.0);
        }
        const glm::dvec2 ends = (before_[1 + each * step.first] - c) + (before_[1 + each * step.second] - c);
        return c +
               (step.smooth > 0.0 ? step.smooth * (weights.spoke * spokes + weights.face * faces) : glm::dvec2(0.0)) +
               (step.crease > 0.0 ? step.crease * 0.125 * ends : glm::dvec2(0.0));
    }

    const Fan& fan_;
    const std::vector<glm::dvec2>& before_;
    std::vector<glm::dvec2> next_;
};

} // namespace

std::vector<glm::dvec2> nextChainLevel(const Fan& fan, const std::vector<glm::dvec2>& before,
                                       const std::vector<float>& spokes, float vertex) {
    return ChainStep(fan, before).run(spokes, vertex);
}

} // namespace supple::surface::chains
