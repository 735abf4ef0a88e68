#include "cpu/limit_weights.h"

#include "surface/chains/arrangement.h"
#include "surface/subdivision/pattern.h"
#include "surface/subdivision_rules.h"

#include <span>

namespace supple::cpu {
namespace {

using namespace surface::subdivision;

Fan fanOf(const LimitShape& shape, const Fragment& fragment) {
    return {shape.mesh().subdivision, fragment.sectors, fragment.open};
}

/// A step of refinement backwards (FragmentNet::refine): each refined point gives its weights to what it is made of.
class StepBack {
public:
    /// `level`: of the refined points.
    StepBack(const LimitShape& shape, const Fragment& fragment, uint32_t level)
        : fan_(fanOf(shape, fragment)), pattern_(shape.patternOf(fan_)),
          quads_(fan_.subdivision == surface::Subdivision::catmullClark),
          centreSharpness_(surface::softened(fragment.centreSharpness, level - 2)) {
        for (uint32_t spoke = 0; spoke < fragment.spokes(); ++spoke) {
            spokes_.push_back(surface::softened(shape.mesh().spokeSharpness[fragment.firstSpoke + spoke], level - 2));
        }
    }

    [[nodiscard]] NetWeights before(const NetWeights& refined, uint32_t points) {
        before_.assign(points, glm::dvec3(0.0));
        for (size_t i = 0; i < refined.size(); ++i) {
            if (refined[i] == glm::dvec3(0.0)) {
                continue;
            }
            const Row& row = pattern_.rows[i];
            weight_ = refined[i];
            const float sharpness = row.spoke == kNoSpoke ? 0.0f : spokes_[row.spoke];
            switch (row.rule) {
            case Rule::vertex:
                addVertex(row, sharpness);
                break;
            case Rule::edge:
                addEdge(row, sharpness);
                break;
            case Rule::face:
                add(std::span(row.sources).first(4), 0.25);
                break;
            case Rule::centre:
                addCentre();
                break;
            }
        }
        return std::move(before_);
    }

private:
    void add(uint32_t point, double share) { before_[point] += share * weight_; }
    void add(std::span<const uint32_t> points, double share) {
        for (const uint32_t point : points) {
            add(point, share);
        }
    }
    void addEdge(const Row& row, float sharpness) {
        const double crease = std::min(static_cast<double>(sharpness), 1.0), smooth = 1.0 - crease;
        const std::span<const uint32_t> sources(row.sources);
        add(sources.first(2), smooth * (quads_ ? 6.0 / 16.0 : 3.0 / 8.0) + crease * 0.5);
        if (smooth > 0.0) {
            add(sources.subspan(2, quads_ ? 4 : 2), smooth / (quads_ ? 16.0 : 8.0));
        }
    }
    void addVertex(const Row& row, float sharpness) {
        const double crease = std::min(static_cast<double>(sharpness), 1.0), smooth = 1.0 - crease;
        const uint32_t centre = row.sources[0];
        const Neighbours& n = pattern_.neighbours[centre];
        const std::array<uint32_t, 2> axis =
            quads_ ? std::array{n[0], n[4]} : std::array{row.sources[1], row.sources[2]};
        add(centre, smooth * (quads_ ? 36.0 / 64.0 : 10.0 / 16.0) + crease * 0.75);
        add(axis, smooth * (quads_ ? 6.0 / 64.0 : 1.0 / 16.0) + crease * 0.125);
        if (smooth > 0.0 && quads_) {
            add(std::array{n[2], n[6]}, smooth * 6.0 / 64.0);
            add(std::array{n[1], n[3], n[5], n[7]}, smooth / 64.0);
        } else if (smooth > 0.0) {
            add(std::span(row.sources).subspan(3, 4), smooth / 16.0);
        }
    }
    void addCentre() {
        const surface::CentreStep step = surface::centreStep(spokes_, centreSharpness_);
        const auto spokePoint = [&](uint32_t spoke) { return 1 + (quads_ ? 2 : 1) * spoke; };
        double rest = 1.0;
        const auto give = [&](uint32_t point, double share) {
            add(point, share);
            rest -= share;
        };
        if (step.smooth > 0.0) {
            const surface::CentreWeights weights = surface::refineWeights(fan_.subdivision, fan_.sectors);
            for (uint32_t k = 0; k < fan_.sectors; ++k) {
                give(spokePoint(k), step.smooth * weights.spoke);
                if (quads_) {
                    give(spokePoint(k) + 1, step.smooth * weights.face);
                }
            }
        }
        if (step.crease > 0.0) {
            give(spokePoint(step.first), 0.125 * step.crease);
            give(spokePoint(step.second), 0.125 * step.crease);
        }
        add(0, rest);
    }

    Fan fan_;
    const Pattern& pattern_;
    bool quads_;
    float centreSharpness_;
    std::vector<float> spokes_;
    glm::dvec3 weight_{0.0}; ///< of the point in hand
    NetWeights before_;
};

/// Weights of derivatives sum to 0. The centre's make up for the others', so that what rounding has left of the large
/// ones on deep levels does not stay.
void balance(NetWeights& weights) {
    glm::dvec3 sum(0.0);
    for (size_t i = 1; i < weights.size(); ++i) {
        sum += weights[i];
    }
    weights[0].y = -sum.y;
    weights[0].z = -sum.z;
}

/// Weights of a fragment's points on the isolated level become those of the cage's vertices.
PointWeights throughSteps(const Mesh& mesh, const Fragment& fragment, const NetWeights& weights) {
    PointWeights out;
    for (size_t i = 0; i < weights.size(); ++i) {
        if (weights[i] != glm::dvec3(0.0)) {
            out.append({mesh.net[fragment.firstNet + i], weights[i].x, weights[i].y, weights[i].z});
        }
    }
    out.merge();
    for (size_t step = mesh.stencils.size(); step-- > 0;) {
        out = throughStencils(out, mesh.stencils[step]);
    }
    return out;
}

} // namespace

PointWeights throughStencils(const PointWeights& weights, const surface::Stencils& stencils) {
    PointWeights before;
    for (const VertexWeight& entry : weights.entries()) {
        for (uint32_t i = stencils.starts[entry.vertex]; i < stencils.starts[entry.vertex + 1]; ++i) {
            VertexWeight own = stencils.weights[i] * entry;
            own.vertex = stencils.vertices[i];
            before.append(own);
        }
    }
    before.merge();
    return before;
}

uint32_t pointsOf(const LimitShape& shape, const SectorLevel& at) {
    const Fragment& fragment = shape.mesh().fragments[at.sector.fragment];
    return fragment.kind == FragmentKind::facet ? facetPointCount(1) : pointCount(fanOf(shape, fragment), 3);
}

PointWeights throughLevels(const LimitShape& shape, const SectorLevel& at, NetWeights weights) {
    const Fragment& fragment = shape.mesh().fragments[at.sector.fragment];
    const Fan fan = fanOf(shape, fragment);
    for (uint32_t level = at.level; level >= 2; --level) {
        balance(weights);
        weights = StepBack(shape, fragment, level).before(weights, pointCount(fan, level == 2 ? 2 : 3));
    }
    balance(weights);
    return throughSteps(shape.mesh(), fragment, weights);
}

PointWeights weighCentre(const LimitShape& shape, const SectorLevel& at) {
    const Mesh& mesh = shape.mesh();
    const Fragment& fragment = mesh.fragments[at.sector.fragment];
    const auto spokes = mesh.spokeSharpness.begin() + fragment.firstSpoke;
    const CentreMask mask =
        surface::chains::limitOf(
            {fanOf(shape, fragment), {spokes, spokes + fragment.spokes()}, fragment.centreSharpness})
            .position;
    NetWeights weights(std::max<size_t>(mask.size(), 1), glm::dvec3(0.0));
    weights[0].x = 1.0;
    for (size_t i = 1; i < mask.size(); ++i) {
        weights[i].x = mask[i];
        weights[0].x -= mask[i];
    }
    return throughSteps(mesh, fragment, weights);
}

} // namespace supple::cpu
