#include "surface/subdivision/masks.h"

#include "surface/valence.h"

#include <algorithm>
#include <cmath>

namespace supple::surface::subdivision {
namespace {

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
    const double w = ring.hasFaces() ? 1.0 / (k * (k + 5.0))
                                     : 1.0 / (k + 3.0 / (8.0 * refineWeights(Subdivision::loop, fan.sectors).spoke));
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
    const auto wave = [&](uint32_t i) { return quarter ? sineOfHalfTurns(2 * i, k) : cosineOfHalfTurns(2 * i, k); };
    CentreMask mask = ring.mask();
    const double c = cosineOfHalfTurns(2, k);
    const double lambda = (5.0 + c + cosineOfHalfTurns(1, k) * std::sqrt(2.0 * (9.0 + c))) / 16.0;
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
        const double r = (cosineOfHalfTurns(1, n) + 1.0) / sineOfHalfTurns(1, n);
        centre = 4.0 * r * (cosineOfHalfTurns(1, n) - 1.0);
        begin = end = -r * (1.0 + 2.0 * cosineOfHalfTurns(1, n));
        for (uint32_t j = 0; j < n; ++j) {
            mask[ring.face(first + j)] = sineOfHalfTurns(j, n) + sineOfHalfTurns(j + 1, n);
        }
        for (uint32_t j = 1; j < n; ++j) {
            mask[ring.spoke(first + j)] = 4.0 * sineOfHalfTurns(j, n);
        }
    } else if (n == 2) {
        mask[ring.spoke(first + 1)] = 1.0;
        centre = -1.0;
    } else if (n == 3) {
        mask[ring.spoke(first + 1)] = mask[ring.spoke(first + 2)] = 2.0;
        begin = end = -1.0;
        centre = -2.0;
    } else {
        begin = end = -sineOfHalfTurns(1, n);
        for (uint32_t j = 1; j < n; ++j) {
            mask[ring.spoke(first + j)] = 2.0 * (1.0 - cosineOfHalfTurns(1, n)) * sineOfHalfTurns(j, n);
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

CentreLimit centreLimit(const Fan& fan, std::span<const float> spokeSharpness, float vertexSharpness) {
    const Ring ring(fan);
    const VertexRule at = vertexRule(spokeSharpness, vertexSharpness);
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

} // namespace supple::surface::subdivision
