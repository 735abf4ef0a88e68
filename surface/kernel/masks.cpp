#include "surface/kernel/masks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace supple::surface::kernel {
namespace {

/// cos(pi k / n), exact where it is 0, a half or 1: regular centres must have the regular rule's weights.
double cosine(uint32_t k, uint32_t n) {
    k %= 2 * n;
    if (k > n) {
        k = 2 * n - k;
    }
    if (2 * k > n) {
        return -cosine(n - k, n);
    }
    return k == 0 ? 1.0 : 2 * k == n ? 0.0 : 3 * k == n ? 0.5 : std::cos(std::numbers::pi * k / n);
}

/// sin(pi k / n).
double sine(uint32_t k, uint32_t n) {
    k %= 2 * n;
    if (k > n) {
        return -sine(2 * n - k, n);
    }
    if (2 * k > n) {
        k = n - k;
    }
    return k == 0 ? 0.0 : 2 * k == n ? 1.0 : 6 * k == n ? 0.5 : std::sin(std::numbers::pi * k / n);
}

enum class CentreRule : uint8_t { smooth, crease, corner };

/// The rule at a vertex, and the ends of its crease.
struct VertexRule {
    CentreRule rule = CentreRule::smooth;
    uint32_t first = 0, second = 0;
};

VertexRule ruleAt(std::span<const float> spokes, float vertex) {
    VertexRule result;
    uint32_t sharp = 0;
    for (uint32_t k = 0; k < spokes.size(); ++k) {
        if (spokes[k] > 0.0f) {
            (sharp == 0 ? result.first : result.second) = k;
            ++sharp;
        }
    }
    // One sharp spoke is a dart's tip: smooth.
    result.rule = vertex > 0.0f || sharp > 2 ? CentreRule::corner
                  : sharp == 2               ? CentreRule::crease
                                             : CentreRule::smooth;
    return result;
}

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
    const double b = 0.375 + 0.25 * cosine(2, valence);
    return (0.625 - b * b) / valence;
}

/// Ring 1 in spiral order, as masks count it.
class Ring {
public:
    explicit Ring(const Fan& fan)
        : spokes_(fan.sectors + (fan.open ? 1 : 0)), sectors_(fan.sectors),
          stride_(fan.subdivision == Subdivision::catmullClark ? 2 : 1), points_(pointCount(fan, 1)) {}

    [[nodiscard]] CentreMask mask() const { return CentreMask(points_, 0.0); }
    [[nodiscard]] uint32_t spoke(uint32_t k) const { return 1 + stride_ * (k % spokes_); }
    /// The face point of a sector; Catmull-Clark alone has them.
    [[nodiscard]] uint32_t face(uint32_t sector) const { return 2 + stride_ * (sector % sectors_); }
    [[nodiscard]] bool hasFaces() const { return stride_ == 2; }

private:
    uint32_t spokes_, sectors_, stride_, points_;
};

CentreMask smoothPosition(const Fan& fan, const Ring& ring) {
    const double k = fan.sectors;
    CentreMask mask = ring.mask();
    const double w = ring.hasFaces() ? 1.0 / (k * (k + 5.0)) : 1.0 / (k + 3.0 / (8.0 * loopWeight(fan.sectors)));
    mask[0] = ring.hasFaces() ? 1.0 - 5.0 * k * w : 1.0 - k * w;
    for (uint32_t i = 0; i < fan.sectors; ++i) {
        mask[ring.spoke(i)] = ring.hasFaces() ? 4.0 * w : w;
        if (ring.hasFaces()) {
            mask[ring.face(i)] = w;
        }
    }
    return mask;
}

/// The tangent towards spoke 0, or a quarter turn on from it.
CentreMask smoothTangent(const Fan& fan, const Ring& ring, bool quarter) {
    const uint32_t k = fan.sectors;
    const auto wave = [&](uint32_t i) { return quarter ? sine(2 * i, k) : cosine(2 * i, k); };
    CentreMask mask = ring.mask();
    const double c = cosine(2, k);
    const double lambda = (5.0 + c + cosine(1, k) * std::sqrt(2.0 * (9.0 + c))) / 16.0;
    for (uint32_t i = 0; i < k; ++i) {
        if (ring.hasFaces()) {
            mask[ring.spoke(i)] = 4.0 * wave(i);
            mask[ring.face(i)] = (wave(i) + wave(i + 1)) / (4.0 * lambda - 1.0);
        } else {
            mask[ring.spoke(i)] = wave(i);
        }
    }
    return mask;
}

/// From the crease into the `n` sectors that begin at spoke `first`.
CentreMask acrossCrease(const Ring& ring, uint32_t first, uint32_t n) {
    CentreMask mask = ring.mask();
    double& centre = mask[0];
    double& begin = mask[ring.spoke(first)];
    double& end = mask[ring.spoke(first + n)];
    if (n == 1) {
        begin = end = 1.0;
        centre = -2.0;
    } else if (ring.hasFaces()) {
        const double r = (cosine(1, n) + 1.0) / sine(1, n);
        centre = 4.0 * r * (cosine(1, n) - 1.0);
        begin = end = -r * (1.0 + 2.0 * cosine(1, n));
        for (uint32_t j = 0; j < n; ++j) {
            mask[ring.face(first + j)] = sine(j, n) + sine(j + 1, n);
        }
        for (uint32_t j = 1; j < n; ++j) {
            mask[ring.spoke(first + j)] = 4.0 * sine(j, n);
        }
    } else if (n == 2) {
        mask[ring.spoke(first + 1)] = 1.0;
        centre = -1.0;
    } else if (n == 3) {
        mask[ring.spoke(first + 1)] = mask[ring.spoke(first + 2)] = 2.0;
        begin = end = -1.0;
        centre = -2.0;
    } else {
        begin = end = -sine(1, n);
        for (uint32_t j = 1; j < n; ++j) {
            mask[ring.spoke(first + j)] = 2.0 * (1.0 - cosine(1, n)) * sine(j, n);
        }
    }
    return mask;
}

CentreRun creaseRun(const Ring& ring, uint32_t first, uint32_t sectors) {
    CentreRun run{first, sectors, false, ring.mask(), acrossCrease(ring, first, sectors)};
    run.first[ring.spoke(first)] += 1.0;
    run.first[ring.spoke(first + sectors)] -= 1.0;
    return run;
}

CentreLimit cornerLimit(const Fan& fan, const Ring& ring, std::span<const float> spokes) {
    CentreLimit limit;
    limit.position = ring.mask();
    limit.position[0] = 1.0;
    std::vector<uint32_t> sharp;
    for (uint32_t k = 0; k < spokes.size(); ++k) {
        if (spokes[k] > 0.0f) {
            sharp.push_back(k);
        }
    }
    if (!fan.open && sharp.size() < 2) {
        limit.runs.push_back({0, fan.sectors, true, {}, {}});
        return limit;
    }
    const size_t runs = fan.open ? sharp.size() - 1 : sharp.size();
    for (size_t i = 0; i < runs; ++i) {
        const uint32_t end = i + 1 < sharp.size() ? sharp[i + 1] : sharp[0] + fan.sectors;
        limit.runs.push_back({sharp[i], end - sharp[i], true, {}, {}});
    }
    return limit;
}

} // namespace

CentreWeights refineWeights(Subdivision subdivision, uint32_t valence) {
    const double k = valence;
    if (subdivision == Subdivision::loop) {
        const double w = loopWeight(valence);
        return {1.0 - k * w, w, 0.0};
    }
    return {(k - 1.75) / k, 1.5 / (k * k), 0.25 / (k * k)};
}

float softened(float sharpness, uint32_t steps) {
    if (sharpness >= kInfiniteSharpness) {
        return sharpness;
    }
    return std::max(0.0f, sharpness - static_cast<float>(steps));
}

CentreStep centreStep(std::span<const float> spokeSharpness, float vertexSharpness) {
    std::vector<float> childSpokes;
    childSpokes.reserve(spokeSharpness.size());
    for (const float sharpness : spokeSharpness) {
        childSpokes.push_back(softened(sharpness, 1));
    }
    const VertexRule parent = ruleAt(spokeSharpness, vertexSharpness);
    const VertexRule child = ruleAt(childSpokes, softened(vertexSharpness, 1));
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

CentreLimit centreLimit(const Fan& fan, std::span<const float> spokeSharpness, float vertexSharpness) {
    const Ring ring(fan);
    const VertexRule at = ruleAt(spokeSharpness, vertexSharpness);
    if (at.rule == CentreRule::corner) {
        return cornerLimit(fan, ring, spokeSharpness);
    }
    CentreLimit limit;
    if (at.rule == CentreRule::smooth) {
        limit.position = smoothPosition(fan, ring);
        limit.runs.push_back({0, fan.sectors, false, smoothTangent(fan, ring, false), smoothTangent(fan, ring, true)});
        return limit;
    }
    limit.position = ring.mask();
    limit.position[0] = 2.0 / 3.0;
    limit.position[ring.spoke(at.first)] = limit.position[ring.spoke(at.second)] = 1.0 / 6.0;
    limit.runs.push_back(creaseRun(ring, at.first, at.second - at.first));
    if (!fan.open) {
        limit.runs.push_back(creaseRun(ring, at.second, at.first + fan.sectors - at.second));
    }
    return limit;
}

} // namespace supple::surface::kernel
