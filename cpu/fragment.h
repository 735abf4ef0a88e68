// A fragment of the subdivision on the CPU, on the level it has come to. Arithmetic rounds as written: every operand is
// added to its mirror image before anything is scaled, so that all fragments which have a point get the same bits. The
// sums are those of docs/subdivision.md.
#pragma once

#include "cpu/stencils.h"
#include "surface/subdivision/masks.h"
#include "surface/subdivision/mesh.h"
#include "surface/subdivision/pattern.h"

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

namespace supple::surface::subdivision {

template <class T>
struct Sample {
    glm::vec<3, T> refined;  ///< the point on the last level, before the limit
    glm::vec<3, T> position; ///< the limit point
    glm::vec<3, T> normal;   ///< outwards, of unit length, or zero if there is none. At a crease: of the sector's side
};

template <class T>
using Vec3 = glm::vec<3, T>;

template <class T>
[[nodiscard]] Vec3<T> unitOrZero(const Vec3<T>& v) {
    const T length = std::sqrt((v.x * v.x + v.y * v.y) + v.z * v.z);
    return length > T(0) ? v / length : Vec3<T>(T(0));
}

/// The vertices of the isolated level: one applyStencils() per step.
template <class T>
[[nodiscard]] std::vector<Vec3<T>> isolate(const Mesh& mesh, std::span<const Vec3<T>> positions) {
    std::vector<Vec3<T>> points(positions.begin(), positions.end());
    for (const Stencils& step : mesh.stencils) {
        points = applyStencils<T>(step, std::span<const Vec3<T>>(points));
    }
    return points;
}

/// Which side of its axis a sector lies on; at a crease the two have normals of their own.
enum class Side : uint8_t { left, right };

/// The rules away from centres.
template <class T>
class Rules {
public:
    using Vec = Vec3<T>;

    Rules(Subdivision subdivision, const std::vector<Vec>& points)
        : quads_(subdivision == Subdivision::catmullClark), p_(points) {}

    [[nodiscard]] Vec face(const Row& row) const {
        return ((at(row, 0) + at(row, 1)) + (at(row, 2) + at(row, 3))) * T(0.25);
    }

    [[nodiscard]] Vec edge(const Row& row, float sharpness) const {
        const Vec ends = at(row, 0) + at(row, 1);
        return blended(
            sharpness,
            [&] {
                return quads_ ? (T(6) * ends + ((at(row, 2) + at(row, 3)) + (at(row, 4) + at(row, 5)))) * T(1.0 / 16.0)
                              : (T(3) * ends + (at(row, 2) + at(row, 3))) * T(1.0 / 8.0);
            },
            [&] { return ends * T(0.5); });
    }

    [[nodiscard]] Vec vertex(const Row& row, const Pattern& pattern, float sharpness) const {
        const Vec c = at(row, 0);
        const Neighbours& n = pattern.neighbours[row.sources[0]];
        const Vec axis = quads_ ? p_[n[0]] + p_[n[4]] : at(row, 1) + at(row, 2);
        return blended(
            sharpness,
            [&] {
                if (quads_) {
                    return (T(36) * c + (T(6) * quadEdges(n) + quadDiagonals(n))) * T(1.0 / 64.0);
                }
                const Vec sides = (at(row, 3) + at(row, 4)) + (at(row, 5) + at(row, 6));
                return (T(10) * c + (sides + axis)) * T(1.0 / 16.0);
            },
            [&] { return T(0.75) * c + axis * T(0.125); });
    }

    /// Limit position and normal of a point on the last level.
    [[nodiscard]] Sample<T> limit(uint32_t index, const Neighbours& n, float sharpness, Side side) const {
        const Vec c = p_[index];
        const Vec axis = p_[n[0]] + p_[n[quads_ ? 4 : 3]];
        Sample<T> sample;
        sample.refined = c;
        if (sharpness > 0.0f) {
            const Vec along = p_[n[0]] - p_[n[quads_ ? 4 : 3]];
            sample.position = (T(4) * c + axis) * T(1.0 / 6.0);
            sample.normal = side == Side::left ? glm::cross(along, acrossCrease(c, axis, n, Side::left))
                                               : glm::cross(acrossCrease(c, axis, n, Side::right), along);
        } else if (quads_) {
            const Vec along = (T(4) * p_[n[0]] + (p_[n[1]] + p_[n[7]])) - (T(4) * p_[n[4]] + (p_[n[3]] + p_[n[5]]));
            const Vec across = (T(4) * p_[n[2]] + (p_[n[1]] + p_[n[3]])) - (T(4) * p_[n[6]] + (p_[n[5]] + p_[n[7]]));
            sample.position = (T(16) * c + (T(4) * quadEdges(n) + quadDiagonals(n))) * T(1.0 / 36.0);
            sample.normal = glm::cross(along, across);
        } else {
            const Vec left = p_[n[1]] + p_[n[2]];
            const Vec right = p_[n[4]] + p_[n[5]];
            const Vec along = T(2) * (p_[n[0]] - p_[n[3]]) + ((p_[n[1]] - p_[n[2]]) + (p_[n[5]] - p_[n[4]]));
            sample.position = (T(6) * c + ((left + right) + axis)) * T(1.0 / 12.0);
            sample.normal = glm::cross(along, left - right);
        }
        sample.normal = unitOrZero(sample.normal);
        return sample;
    }

private:
    [[nodiscard]] const Vec& at(const Row& row, uint32_t source) const { return p_[row.sources[source]]; }

    template <class Smooth, class Crease>
    [[nodiscard]] static Vec blended(float sharpness, Smooth&& smoothPoint, Crease&& creasePoint) {
        if (sharpness >= 1.0f) {
            return creasePoint();
        }
        const Vec smooth = smoothPoint();
        return sharpness > 0.0f ? smooth + T(sharpness) * (creasePoint() - smooth) : smooth;
    }

    [[nodiscard]] Vec quadEdges(const Neighbours& n) const { return (p_[n[0]] + p_[n[4]]) + (p_[n[2]] + p_[n[6]]); }
    [[nodiscard]] Vec quadDiagonals(const Neighbours& n) const { return (p_[n[1]] + p_[n[5]]) + (p_[n[3]] + p_[n[7]]); }

    [[nodiscard]] Vec acrossCrease(const Vec& c, const Vec& axis, const Neighbours& n, Side side) const {
        const bool left = side == Side::left;
        if (quads_) {
            const Vec diagonals = left ? p_[n[1]] + p_[n[3]] : p_[n[7]] + p_[n[5]];
            return T(4) * (p_[n[left ? 2 : 6]] - c) + (diagonals - axis);
        }
        const Vec side2 = left ? p_[n[1]] + p_[n[2]] : p_[n[4]] + p_[n[5]];
        return T(2) * (side2 - c) - axis;
    }

    bool quads_;
    const std::vector<Vec>& p_;
};

/// The points of one fragment, and the sharpness that is left.
template <class T>
class FragmentNet {
public:
    using Vec = Vec3<T>;

    FragmentNet(const Mesh& mesh, std::span<const Vec> isolated) : mesh_(mesh), isolated_(isolated) {}

    [[nodiscard]] Fan fanOf(const Fragment& fragment) const {
        return {mesh_.subdivision, fragment.sectors, fragment.open};
    }
    [[nodiscard]] const std::vector<Vec>& points() const { return points_; }
    /// What recentre() has taken from them, in all.
    [[nodiscard]] const Vec& origin() const { return origin_; }

    /// Begins with a fragment on the isolated level.
    void load(const Fragment& fragment) {
        const uint32_t count =
            fragment.kind == FragmentKind::facet ? facetPointCount(1) : pointCount(fanOf(fragment), 2);
        points_.clear();
        origin_ = Vec(T(0));
        for (uint32_t i = 0; i < count; ++i) {
            points_.push_back(isolated_[mesh_.net[fragment.firstNet + i]]);
        }
        const auto first = mesh_.spokeSharpness.begin() + fragment.firstSpoke;
        spokes_.assign(first, first + fragment.spokes());
        centreSharpness_ = fragment.centreSharpness;
    }

    /// The points become differences from the first. Rings shrink from level to level: so their rounding does too.
    void recentre() {
        const Vec centre = points_[0];
        for (Vec& point : points_) {
            point -= centre;
        }
        origin_ += centre;
    }

    [[nodiscard]] float sharpnessOf(uint32_t spoke) const { return spoke == kNoSpoke ? 0.0f : spokes_[spoke]; }

    /// The first `count` rows of a pattern, and a step less of sharpness.
    void refine(const Fan& fan, const Pattern& pattern, uint32_t count) {
        const Rules<T> rules(mesh_.subdivision, points_);
        refined_.clear();
        for (uint32_t i = 0; i < count; ++i) {
            const Row& row = pattern.rows[i];
            switch (row.rule) {
            case Rule::vertex:
                refined_.push_back(rules.vertex(row, pattern, sharpnessOf(row.spoke)));
                break;
            case Rule::edge:
                refined_.push_back(rules.edge(row, sharpnessOf(row.spoke)));
                break;
            case Rule::face:
                refined_.push_back(rules.face(row));
                break;
            case Rule::centre:
                refined_.push_back(refinedCentre(fan));
                break;
            }
        }
        points_.swap(refined_);
        for (float& sharpness : spokes_) {
            sharpness = softened(sharpness, 1);
        }
        centreSharpness_ = softened(centreSharpness_, 1);
    }

    /// The limit at the centre: a sample for each sector.
    [[nodiscard]] std::vector<Sample<T>> centre(const Fan& fan) const {
        const CentreLimit limit = centreLimit(fan, spokes_, centreSharpness_);
        std::vector<Sample<T>> centres(fan.sectors);
        for (const CentreRun& run : limit.runs) {
            const Sample<T> sample{points_[0], points_[0] + masked(limit.position), runNormal(fan, run)};
            for (uint32_t h = 0; h < run.sectors; ++h) {
                centres[(run.firstSector + h) % fan.sectors] = sample;
            }
        }
        return centres;
    }

private:
    // Points of ring 1.
    [[nodiscard]] static uint32_t spokePoint(const Fan& fan, uint32_t spoke) {
        return 1 + (fan.subdivision == Subdivision::catmullClark ? 2 : 1) * spoke;
    }

    /// Relative to the centre: differences keep the rounding at the size of the ring.
    [[nodiscard]] Vec refinedCentre(const Fan& fan) const {
        const CentreStep step = centreStep(spokes_, centreSharpness_);
        const Vec c = points_[0];
        Vec offset(T(0));
        if (step.smooth > 0.0) {
            const CentreWeights weights = refineWeights(fan.subdivision, fan.sectors);
            Vec spokes(T(0)), faces(T(0));
            for (uint32_t k = 0; k < fan.sectors; ++k) {
                spokes += points_[spokePoint(fan, k)] - c;
                if (fan.subdivision == Subdivision::catmullClark) {
                    faces += points_[spokePoint(fan, k) + 1] - c;
                }
            }
            offset += T(step.smooth) * (T(weights.spoke) * spokes + T(weights.face) * faces);
        }
        if (step.crease > 0.0) {
            const Vec ends = (points_[spokePoint(fan, step.first)] - c) + (points_[spokePoint(fan, step.second)] - c);
            offset += T(step.crease) * (T(0.125) * ends);
        }
        return c + offset;
    }

    /// A mask whose weights on ring 1 act on the differences to the centre.
    [[nodiscard]] Vec masked(const CentreMask& mask) const {
        Vec sum(T(0));
        for (uint32_t i = 1; i < mask.size(); ++i) {
            sum += T(mask[i]) * (points_[i] - points_[0]);
        }
        return sum;
    }

    [[nodiscard]] Vec runNormal(const Fan& fan, const CentreRun& run) const {
        if (!run.corner) {
            return unitOrZero(glm::cross(masked(run.first), masked(run.second)));
        }
        const uint32_t spokes = fan.sectors + (fan.open ? 1 : 0);
        const auto spoke = [&](uint32_t k) { return points_[spokePoint(fan, k % spokes)] - points_[0]; };
        Vec sum(T(0));
        for (uint32_t h = run.firstSector; h < run.firstSector + run.sectors; ++h) {
            sum += glm::cross(spoke(h), spoke(h + 1));
        }
        return unitOrZero(sum);
    }

    const Mesh& mesh_;
    std::span<const Vec> isolated_;
    std::vector<Vec> points_, refined_;
    Vec origin_{T(0)};
    std::vector<float> spokes_;
    float centreSharpness_ = 0.0f;
};

} // namespace supple::surface::subdivision
