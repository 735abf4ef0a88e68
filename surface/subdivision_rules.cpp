#include "surface/subdivision_rules.h"

#include "surface/valence.h"

#include <algorithm>

namespace supple::surface {
namespace {

/// The share of the parent's rule where the child's is another: the mean sharpness of what ceases to be sharp. In
/// float, as OpenSubdiv has it.
float parentShare(std::span<const float> spokes, float vertex) {
    float sum = 0.0f;
    uint32_t count = 0;
    const auto add = [&](float sharpness) {
        if (sharpness > 0.0f && softened(sharpness, 1) <= 0.0f) {
            sum += sharpness;
            ++count;
        }
    };
    add(vertex);
    for (const float sharpness : spokes) {
        add(sharpness);
    }
    return count == 0 ? 0.0f : std::min(1.0f, sum / static_cast<float>(count));
}

/// Loop's weight of a neighbour.
double loopWeight(uint32_t valence) {
    const double b = 0.375 + 0.25 * cosineOfHalfTurns(2, valence);
    return (0.625 - b * b) / valence;
}

} // namespace

float softened(float sharpness, uint32_t steps) {
    if (sharpness >= kInfiniteSharpness) {
        return sharpness;
    }
    return std::max(0.0f, sharpness - static_cast<float>(steps));
}

std::vector<float> softened(std::span<const float> sharpness, uint32_t steps) {
    std::vector<float> left(sharpness.begin(), sharpness.end());
    for (float& value : left) {
        value = softened(value, steps);
    }
    return left;
}

VertexRule vertexRule(std::span<const float> spokeSharpness, float vertexSharpness) {
    VertexRule result;
    uint32_t sharp = 0;
    for (uint32_t k = 0; k < spokeSharpness.size(); ++k) {
        if (spokeSharpness[k] > 0.0f) {
            (sharp == 0 ? result.first : result.second) = k;
            ++sharp;
        }
    }
    // One sharp spoke is a dart's tip: smooth.
    result.rule = vertexSharpness > 0.0f || sharp > 2 ? CentreRule::corner
                  : sharp == 2                        ? CentreRule::crease
                                                      : CentreRule::smooth;
    return result;
}

CentreWeights refineWeights(Subdivision subdivision, uint32_t valence) {
    const double k = valence;
    if (subdivision == Subdivision::loop) {
        const double w = loopWeight(valence);
        return {1.0 - k * w, w, 0.0};
    }
    return {(k - 1.75) / k, 1.5 / (k * k), 0.25 / (k * k)};
}

CentreStep centreStep(std::span<const float> spokeSharpness, float vertexSharpness) {
    const VertexRule parent = vertexRule(spokeSharpness, vertexSharpness);
    const VertexRule child = vertexRule(softened(spokeSharpness, 1), softened(vertexSharpness, 1));
    CentreStep step;
    step.smooth = 0.0;
    const auto add = [&](const VertexRule& rule, double share) {
        switch (rule.rule) {
        case CentreRule::smooth:
            step.smooth += share;
            break;
        case CentreRule::crease:
            step.crease += share;
            step.first = rule.first;
            step.second = rule.second;
            break;
        case CentreRule::corner:
            step.corner += share;
            break;
        }
    };
    if (parent.rule == child.rule || parent.rule == CentreRule::smooth) {
        add(parent, 1.0);
    } else {
        const double share = parentShare(spokeSharpness, vertexSharpness);
        add(parent, share);
        add(child, 1.0 - share);
    }
    return step;
}

} // namespace supple::surface
