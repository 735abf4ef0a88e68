#include "surface/prep/smooth_uvs.h"

#include "surface/valence.h"

#include <map>
#include <tuple>
#include <utility>

namespace supple::surface::prep {
namespace {

using cage::kNone;
using cage::UvChannel;

/// What a tangent inside a run at a seam is scaled by, against the mean of its face coefficients: as long as those of a
/// whole fan. `n`: the effective valence of the surface's vertex.
double seamTangent(uint32_t n, const Options& options) {
    const double c = turn(1, n).first, rho = subdominant(n), w = 16.0 * rho - 4.0, face = 1.0 / (4.0 * rho - 1.0);
    // K_n: e1 of a closed fan has the weight K_n w of the first spoke.
    const ValenceClass whole = makeValenceClass(n, false, options);
    const double length = whole.e1Edge[0] / w;
    return length * n / 2.0 * (w + 2.0 * (1.0 + c) * face) / ((1.0 + c) * (2.0 + face) / 9.0);
}

} // namespace

/// Makes what corners have, run by run.
class UvConstruction::Fans {
public:
    Fans(const cage::Topology& topology, const Options& options, const UvChannel& channel, std::vector<CornerUvs>& out)
        : topology_(topology), options_(options), channel_(channel), out_(out) {}

    void add(uint32_t vertex) {
        const cage::Topology& own = channel_.topology;
        const uint32_t base = own.spokeStarts[vertex];
        closed_ = own.boundary[vertex] == 0;
        corners_.assign(own.sectorCorners.begin() + base, own.sectorCorners.begin() + base + own.sectorCount(vertex));
        p_ = channel_.values[vertex];
        spokes_.clear();
        diagonals_.clear();
        for (uint32_t k = 0; k < own.spokeCount(vertex); ++k) {
            spokes_.push_back(channel_.values[own.spokeVertices[base + k]] - p_);
        }
        for (const uint32_t corner : corners_) {
            diagonals_.push_back(channel_.values[channel_.cage.faceVertices[after(corner, 2)]] - p_);
        }
        makeFan(channel_.rules[vertex], topology_.effectiveValence(channel_.vertices[vertex]));
        store();
    }

private:
    static uint32_t after(uint32_t corner, uint32_t steps) { return (corner & ~3u) | ((corner + steps) & 3u); }
    [[nodiscard]] uint32_t faces() const { return static_cast<uint32_t>(corners_.size()); }

    [[nodiscard]] const ValenceClass& classOf(bool smoothCorner) {
        const auto [known, isNew] = classes_.try_emplace({faces(), closed_, smoothCorner});
        if (isNew) {
            Options options = options_;
            options.cornerRule = smoothCorner ? CornerRule::smooth : options.cornerRule;
            known->second = makeValenceClass(faces(), !closed_, options);
        }
        return known->second;
    }

    [[nodiscard]] glm::dvec2 sum(const std::vector<double>& edge, const std::vector<double>& face) const {
        glm::dvec2 total(0.0);
        for (size_t k = 0; k < edge.size(); ++k) {
            total += edge[k] * spokes_[k];
        }
        for (size_t k = 0; k < face.size(); ++k) {
            total += face[k] * diagonals_[k];
        }
        return total;
    }

    /// All relative to the vertex.
    void makeFan(UvChannel::Rule rule, uint32_t valence) {
        const bool match = rule == UvChannel::Rule::match, corner = rule == UvChannel::Rule::corner;
        const ValenceClass& weights = classOf(!match);
        faceCoefficients_.clear();
        for (uint32_t k = 0; k < faces(); ++k) {
            const uint32_t next = (k + 1) % static_cast<uint32_t>(spokes_.size());
            faceCoefficients_.push_back((2.0 * (spokes_[k] + spokes_[next]) + diagonals_[k]) / 9.0);
        }
        limit_ = corner ? glm::dvec2(0.0) : sum(weights.limitEdge, weights.limitFace);
        const glm::dvec2 e1 = sum(weights.e1Edge, weights.e1Face), e2 = sum(weights.e2Edge, weights.e2Face);
        tangents_.clear();
        for (size_t k = 0; k < spokes_.size(); ++k) {
            tangents_.push_back(limit_ + e1 * weights.cosines[k] + e2 * weights.sines[k]);
        }
        if (closed_) {
            return;
        }
        tangents_.front() = spokes_.front() / 3.0;
        tangents_.back() = spokes_.back() / 3.0;
        if (match || (2 * faces() == valence && !corner)) {
            return;
        }
        for (uint32_t k = 1; k < faces(); ++k) {
            const glm::dvec2 e = (faceCoefficients_[k] + faceCoefficients_[k - 1]) / 2.0;
            tangents_[k] = limit_ + seamTangent(valence, options_) * (e - limit_);
        }
    }

    void store() {
        for (uint32_t k = 0; k < faces(); ++k) {
            const size_t next = (k + 1) % spokes_.size();
            out_[corners_[k]] = {p_ + limit_, p_ + faceCoefficients_[k], p_ + tangents_[k], p_ + tangents_[next]};
        }
    }

    const cage::Topology& topology_;
    const Options& options_;
    const UvChannel& channel_;
    std::vector<CornerUvs>& out_;
    std::map<std::tuple<uint32_t, bool, bool>, ValenceClass> classes_;
    // The fan at work:
    bool closed_ = true;
    std::vector<uint32_t> corners_;
    glm::dvec2 p_{0.0}, limit_{0.0};
    std::vector<glm::dvec2> spokes_, diagonals_, faceCoefficients_, tangents_;
};

Result<UvChannel> buildUvChannel(const cage::Cage& cage, const cage::Topology& topology, const Options& options,
                                 const std::vector<glm::vec2>& uvs, cage::UvMode mode) {
    std::vector<float> edges, vertices;
    for (const cage::Topology::Edge& edge : topology.edges) {
        edges.push_back(edge.twin == kNone ? cage::kHardSharpness : 0.0f);
    }
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        const bool sharp =
            options.cornerRule == CornerRule::sharp && topology.boundary[v] != 0 && topology.sectorCount(v) == 1;
        vertices.push_back(sharp ? cage::kHardSharpness : 0.0f);
    }
    return cage::buildUvChannel(cage, topology, {edges, vertices}, uvs, mode);
}

UvConstruction::UvConstruction(const cage::Cage& cage, const cage::Topology& topology, const Options& options,
                               const UvChannel& channel)
    : cage_(cage), topology_(topology) {
    corners_.resize(cage.cornerCount());
    Fans fans(topology, options, channel, corners_);
    for (uint32_t v = 0; v < channel.values.size(); ++v) {
        fans.add(v);
    }
    perturb(channel);
}

void UvConstruction::perturb(const UvChannel& channel) {
    std::map<std::pair<double, double>, EdgeWeights> known;
    perturbed_.resize(topology_.edges.size());
    for (uint32_t e = 0; e < topology_.edges.size(); ++e) {
        if (channel.cutEdges[e] != 0 || !isPerturbed(cage_, topology_, e)) {
            continue;
        }
        // Faces left and right of A -> B.
        const auto [f, o] = topology_.edges[e];
        const auto c = [&](uint32_t corner) {
            return turn(1, topology_.effectiveValence(cage_.faceVertices[corner])).first;
        };
        const auto [weights, isNew] = known.try_emplace({c(f), c(o)});
        if (isNew) {
            weights->second = makeEdgeWeights(c(f), c(o));
        }
        const auto next = [&](uint32_t corner) {
            return cage::nextCorner(cage_, topology_.cornerFaces[corner], corner);
        };
        const CornerUvs &a = corners_[f], &b = corners_[o];
        const std::array<glm::dvec2, 6> vectors{
            a.v, a.t0, b.t0, b.v, a.f + corners_[next(o)].f, corners_[next(f)].f + b.f};
        for (size_t h = 0; h < 4; ++h) {
            for (size_t i = 0; i < 6; ++i) {
                perturbed_[e][h] += weights->second[h][i] * vectors[i];
            }
        }
    }
}

UvPatch UvConstruction::patch(uint32_t face) const {
    const uint32_t first = cage_.faceStarts[face];
    const CornerUvs* q = &corners_[first];
    UvPatch patch;
    patch.c = {q[0].v,  q[0].t0, q[1].t1, q[1].v,  q[0].t1, q[0].f,  q[1].f,  q[1].t0,
               q[3].t0, q[3].f,  q[2].f,  q[2].t1, q[3].v,  q[3].t1, q[2].t0, q[2].v};
    for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t edge = topology_.cornerEdges[first + i];
        const bool own = topology_.edges[edge].corner == first + i;
        for (uint32_t h = 0; h < 4; ++h) {
            patch.c[16 + 4 * i + h] = perturbed_[edge][own ? h : h ^ 1u];
        }
    }
    return patch;
}

} // namespace supple::surface::prep
