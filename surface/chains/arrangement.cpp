#include "surface/chains/arrangement.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace supple::surface::chains {
namespace {

using subdivision::CentreLimit;
using subdivision::CentreMask;
using subdivision::CentreRun;
using subdivision::Fan;

/// At the tip of a dart, and in three and more sectors on one side of a crease, the masks of one level are not the
/// limit's. The error shrinks with every step, by a half or faster.
constexpr uint32_t kStepsToTheLimit = 60;

/// A step of subdivision on ring 1, applied to weights: those of the ring after it become those of the ring before.
class RingStep {
public:
    RingStep(const Arrangement& at, uint32_t level)
        : fan_(at.fan), quads_(fan_.subdivision == Subdivision::catmullClark), spokes_(softened(at.spokes, level)),
          vertex_(softened(at.vertex, level)) {}

    [[nodiscard]] CentreMask before(const CentreMask& after) const {
        CentreMask mask(after.size(), 0.0);
        addCentre(after[0], mask);
        for (uint32_t k = 0; k < spokes_.size(); ++k) {
            addSpoke(k, after[spoke(k)], mask);
        }
        for (uint32_t h = 0; quads_ && h < fan_.sectors; ++h) {
            const double w = after[face(h)] / 4.0;
            mask[0] += w;
            mask[spoke(h)] += w;
            mask[spoke(h + 1)] += w;
            mask[face(h)] += w;
        }
        return mask;
    }

private:
    [[nodiscard]] uint32_t spoke(uint32_t k) const {
        return 1 + (quads_ ? 2 : 1) * (k % static_cast<uint32_t>(spokes_.size()));
    }
    [[nodiscard]] uint32_t face(uint32_t h) const { return 2 + 2 * (h % fan_.sectors); }

    void addCentre(double w, CentreMask& mask) const {
        const CentreStep step = centreStep(spokes_, vertex_);
        mask[0] += w * (step.corner + 0.75 * step.crease);
        if (step.crease > 0.0) {
            mask[spoke(step.first)] += w * step.crease / 8.0;
            mask[spoke(step.second)] += w * step.crease / 8.0;
        }
        if (step.smooth > 0.0) {
            const CentreWeights weights = refineWeights(fan_.subdivision, fan_.sectors);
            mask[0] += w * step.smooth * weights.centre;
            for (uint32_t h = 0; h < fan_.sectors; ++h) {
                mask[spoke(h)] += w * step.smooth * weights.spoke;
                if (quads_) {
                    mask[face(h)] += w * step.smooth * weights.face;
                }
            }
        }
    }

    void addSpoke(uint32_t k, double w, CentreMask& mask) const {
        const double sharp = std::min(1.0, static_cast<double>(spokes_[k])), smooth = 1.0 - sharp;
        mask[0] += w * (sharp / 2.0 + smooth * 3.0 / 8.0);
        mask[spoke(k)] += w * (sharp / 2.0 + smooth * 3.0 / 8.0);
        if (smooth == 0.0) {
            return; // an open fan's ends are sharp
        }
        const uint32_t last = (k + fan_.sectors - 1) % fan_.sectors;
        for (const uint32_t point : {spoke(k + 1), spoke(last)}) {
            mask[point] += w * smooth / (quads_ ? 16.0 : 8.0);
        }
        for (const uint32_t h : {k, last}) {
            if (quads_) {
                mask[face(h)] += w * smooth / 16.0;
            }
        }
    }

    const Fan& fan_;
    bool quads_;
    std::vector<float> spokes_;
    float vertex_;
};

/// The steps after which nothing semi-sharp is left.
uint32_t semiSharpSteps(const Arrangement& at) {
    float longest = at.vertex < kInfiniteSharpness ? at.vertex : 0.0f;
    for (const float sharpness : at.spokes) {
        longest = std::max(longest, sharpness < kInfiniteSharpness ? sharpness : 0.0f);
    }
    return static_cast<uint32_t>(std::ceil(longest));
}

/// Whether the masks are the limit's on the level after so many steps, when nothing is semi-sharp.
bool hasMasks(const Arrangement& at, uint32_t steps) {
    const std::vector<float> spokes = softened(at.spokes, steps);
    const float vertex = softened(at.vertex, steps);
    const auto sharp = std::count_if(spokes.begin(), spokes.end(), [](float s) { return s > 0.0f; });
    if (sharp == 1 && vertex == 0.0f) { // the tip of a dart
        return false;
    }
    const CentreLimit limit = subdivision::centreLimit(at.fan, spokes, vertex);
    return std::all_of(limit.runs.begin(), limit.runs.end(), [&](const CentreRun& run) {
        return run.corner || run.sectors < 3 || (run.sectors == at.fan.sectors && !at.fan.open);
    });
}

double product(const CentreMask& a, const CentreMask& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Only the direction of the cross products of tangents counts. Two tangents may come ever nearer to the one that
/// shrinks least. So the second loses what it has of the first. The weights of a tangent sum to zero: a rounding error
/// in the sum would not shrink with every step, as they do.
void normalize(std::vector<CentreMask>& tangents) {
    const auto scale = [](CentreMask& mask, double length) {
        for (double& weight : mask) {
            weight /= length > 0.0 ? length : 1.0;
        }
    };
    for (CentreMask& mask : tangents) {
        mask[0] = -std::accumulate(mask.begin() + 1, mask.end(), 0.0);
    }
    CentreMask& first = tangents[0];
    const double length = std::sqrt(product(first, first));
    if (tangents.size() > 2) { // their lengths count
        for (CentreMask& mask : tangents) {
            scale(mask, length);
        }
        return;
    }
    scale(first, length);
    CentreMask& second = tangents[1];
    const double along = product(first, second);
    for (size_t i = 0; i < second.size(); ++i) {
        second[i] -= along * first[i];
    }
    scale(second, std::sqrt(product(second, second)));
}

LimitRun runOf(const Fan& fan, const CentreRun& centre) {
    LimitRun run{centre.firstSector, centre.sectors, {centre.first, centre.second}};
    if (!centre.corner) {
        return run;
    }
    const uint32_t spokes = fan.sectors + (fan.open ? 1 : 0);
    run.tangents.assign(centre.sectors + 1, CentreMask(subdivision::pointCount(fan, 1), 0.0));
    for (uint32_t k = 0; k <= centre.sectors; ++k) {
        const uint32_t stride = fan.subdivision == Subdivision::catmullClark ? 2 : 1;
        run.tangents[k][1 + stride * ((centre.firstSector + k) % spokes)] = 1.0;
        run.tangents[k][0] = -1.0;
    }
    return run;
}

} // namespace

Limit limitOf(const Arrangement& at) {
    const uint32_t semiSharp = semiSharpSteps(at), steps = semiSharp + (hasMasks(at, semiSharp) ? 0 : kStepsToTheLimit);
    const CentreLimit last = subdivision::centreLimit(at.fan, softened(at.spokes, steps), softened(at.vertex, steps));
    Limit limit{last.position, {}};
    for (const CentreRun& run : last.runs) {
        limit.runs.push_back(runOf(at.fan, run));
    }
    for (uint32_t level = steps; level-- > 0;) {
        const RingStep step(at, level);
        limit.position = step.before(limit.position);
        for (LimitRun& run : limit.runs) {
            for (CentreMask& mask : run.tangents) {
                mask = step.before(mask);
            }
            normalize(run.tangents);
        }
    }
    return limit;
}

} // namespace supple::surface::chains
