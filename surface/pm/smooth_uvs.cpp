#include "surface/pm/smooth_uvs.h"

#include "surface/pm/weights.h"
#include "surface/valence.h"

#include <algorithm>
#include <cmath>

namespace supple::surface::pm {
namespace {

using cage::kNone;
using cage::UvChannel;

/// The subdominant eigenvalue from the cosine of a facet's angle.
double eigenvalueOf(const FacetAngle& angle) {
    if (angle.part == 1) {
        return subdominant(angle.whole);
    }
    const double c = turn(angle.part, angle.whole).first;
    return (c + 5.0 + std::sqrt((c + 9.0) * (c + 1.0))) / 16.0;
}

} // namespace

/// Finds the fans of the channel and makes what their corners have.
class UvConstruction::Fans {
public:
    Fans(const Mesh& mesh, const UvChannel& channel, std::vector<CornerUvs>& out)
        : mesh_(mesh), channel_(channel), out_(out) {}

    /// The fans at a vertex of the channel: between hard edges.
    void add(uint32_t vertex) {
        const cage::Topology& topology = channel_.topology;
        const uint32_t base = topology.spokeStarts[vertex], facets = topology.sectorCount(vertex);
        const bool open = topology.boundary[vertex] != 0;
        rule_ = channel_.rules[vertex];
        std::vector<uint32_t> hard;
        for (uint32_t k = open ? 1 : 0; k < facets; ++k) {
            if (mesh_.features.hard(mesh_.topology.cornerEdges[topology.sectorCorners[base + k]])) {
                hard.push_back(k);
            }
        }
        const auto addRun = [&](uint32_t first, uint32_t count, bool closed) {
            facets_.clear();
            for (uint32_t k = 0; k < count; ++k) {
                facets_.push_back(topology.sectorCorners[base + (first + k) % facets]);
            }
            closed_ = closed;
            addFan();
        };
        if (!open && hard.size() < 2) {
            addRun(0, facets, true);
            return;
        }
        if (open) {
            hard.insert(hard.begin(), 0);
        }
        for (size_t i = 0; i < hard.size(); ++i) {
            const uint32_t end = i + 1 < hard.size() ? hard[i + 1] : open ? facets : hard[0] + facets;
            addRun(hard[i], end - hard[i], false);
        }
    }

private:
    [[nodiscard]] uint32_t q() const { return static_cast<uint32_t>(facets_.size()); }
    [[nodiscard]] uint32_t edges() const { return closed_ ? q() : q() + 1; }
    [[nodiscard]] uint32_t next(uint32_t corner) const {
        return cage::nextCorner(mesh_.cage, mesh_.topology.cornerFaces[corner], corner);
    }
    [[nodiscard]] uint32_t previous(uint32_t corner) const {
        return cage::previousCorner(mesh_.cage, mesh_.topology.cornerFaces[corner], corner);
    }
    [[nodiscard]] glm::dvec2 value(uint32_t corner) const {
        return channel_.values[channel_.cage.faceVertices[corner]];
    }
    /// The far end of edge j, relative to the vertex.
    [[nodiscard]] glm::dvec2 spoke(uint32_t j) const {
        return value(j < q() ? next(facets_[j]) : previous(facets_.back())) - p_;
    }
    [[nodiscard]] uint32_t surfaceSlot(uint32_t j) const {
        return j < q() ? mesh_.corners[facets_[j]].slot : mesh_.corners[facets_.back()].slotBack;
    }
    [[nodiscard]] bool isEnd(uint32_t j) const { return !closed_ && (j == 0 || j == q()); }

    void addFan() {
        surface_ = &mesh_.fans[mesh_.corners[facets_[0]].fan];
        p_ = value(facets_[0]);
        const bool whole = surface_->facets == q() && surface_->closed() == closed_ &&
                           (closed_ || mesh_.corners[facets_[0]].slot == surface_->firstSlot);
        const bool corner = surface_->kind == FanKind::corner || surface_->kind == FanKind::straight;
        own_ = whole && (rule_ == UvChannel::Rule::match || (rule_ == UvChannel::Rule::corner) == corner);
        if (own_ && closed_) { // from the surface's first edge on
            while (mesh_.corners[facets_[0]].slot != surface_->firstSlot) {
                std::rotate(facets_.begin(), facets_.begin() + 1, facets_.end());
            }
        }
        makeFaces();
        t_.assign(edges(), glm::dvec2(0.0));
        if (closed_) {
            closedTangents();
        } else if (own_) {
            ownTangents();
        } else {
            openTangents();
        }
        store();
    }

    [[nodiscard]] double alpha(uint32_t j) const { return isEnd(j) ? kSmoothAlpha : mesh_.slotAlphas[surfaceSlot(j)]; }

    /// (14) and the rim, e_j of the edges inside. All relative to the vertex.
    void makeFaces() {
        f_.clear();
        for (uint32_t j = 0; j < q(); ++j) {
            const uint32_t after = closed_ ? (j + 1) % q() : j + 1;
            const double a = alpha(j), b = alpha(after);
            const glm::dvec2 x = spoke(j), y = spoke(after);
            const double rim = own_ || !(isEnd(j) || isEnd(after)) ? mesh_.slotRims[surfaceSlot(j)] : 0.0;
            f_.push_back(((1.0 - a) * b * x + a * (1.0 - b) * y) / 2.0 + a * b * ((x + y) + farMean(facets_[j])) / 4.0 +
                         rim * (x + y));
        }
        e_.assign(edges(), glm::dvec2(0.0));
        for (uint32_t j = closed_ ? 0 : 1; j < q(); ++j) {
            e_[j] = (f_[j] + f_[j > 0 ? j - 1 : q() - 1]) / 2.0;
        }
    }

    /// Q_j.
    [[nodiscard]] glm::dvec2 farMean(uint32_t corner) const {
        const uint32_t a = next(corner), far = next(a), sides = mesh_.cage.sides(mesh_.topology.cornerFaces[corner]);
        return (sides == 3   ? (value(a) + value(far)) / 2.0
                : sides == 4 ? value(far)
                             : (value(far) + value(next(far))) / 2.0) -
               p_;
    }

    void closedTangents() {
        const FanScales scales = fanScales(FanKind::interior, q());
        v_ = glm::dvec2(0.0);
        glm::dvec2 tau1(0.0), tau2(0.0);
        for (uint32_t j = 0; j < q(); ++j) {
            const auto [cosine, sine] = turn(j, q());
            v_ += f_[j];
            tau1 += cosine * e_[j];
            tau2 += sine * e_[j];
        }
        v_ *= scales.limit;
        for (uint32_t j = 0; j < q(); ++j) {
            const auto [cosine, sine] = turn(j, q());
            t_[j] = v_ + scales.tangent * (cosine * tau1 + sine * tau2);
        }
        if (surface_->pinned) {
            for (uint32_t j = 0; j < q(); ++j) {
                t_[j] -= v_;
                f_[j] -= v_;
            }
            for (glm::dvec2& e : e_) {
                e -= v_;
            }
            v_ = glm::dvec2(0.0);
        }
    }

    /// At an end of the surface's own fan.
    [[nodiscard]] glm::dvec2 endTangent(uint32_t j) const {
        const FanEnd& end = surface_->ends[j == 0 ? 0 : 1];
        if (end.partner == kNone) {
            return end.own * spoke(j);
        }
        // The far end of the curve's other edge: this run's other end, or a fan's of the same vertex of the channel.
        const uint32_t partner = mesh_.slotSpokes[end.partner], other = j == 0 ? q() : 0;
        if (mesh_.slotSpokes[surfaceSlot(other)] == partner) {
            return end.own * spoke(j) - end.other * spoke(other);
        }
        uint32_t corner = mesh_.topology.sectorCorners[partner];
        if (corner != kNone && channel_.cage.faceVertices[corner] == channel_.cage.faceVertices[facets_[0]]) {
            return end.own * spoke(j) - end.other * (value(next(corner)) - p_);
        }
        corner = partner > 0 ? mesh_.topology.sectorCorners[partner - 1] : kNone; // a boundary's last spoke
        if (corner != kNone && channel_.cage.faceVertices[corner] == channel_.cage.faceVertices[facets_[0]]) {
            return end.own * spoke(j) - end.other * (value(previous(corner)) - p_);
        }
        return spoke(j) / 3.0;
    }

    /// As the surface's own open fan.
    void ownTangents() {
        glm::dvec2 tau1 = endTangent(0), tau2 = endTangent(q());
        const glm::dvec2 last = tau2;
        v_ = glm::dvec2(0.0);
        if (surface_->kind != FanKind::corner) {
            v_ = (spoke(0) + spoke(q())) / 6.0;
            tau1 = (spoke(0) - spoke(q())) / 6.0;
            tau2 = crossTangent();
            if (surface_->kind == FanKind::straight) {
                v_ = glm::dvec2(0.0);
                tau1 = endTangent(0);
            }
        }
        for (uint32_t j = 1; j < q(); ++j) {
            const auto [first, second] = tangentTurn(*surface_, j);
            t_[j] = v_ + first * tau1 + second * tau2;
        }
        t_[0] = endTangent(0);
        t_[q()] = last;
    }

    /// tau2 of a crease, over the edges inside.
    [[nodiscard]] glm::dvec2 crossTangent() const {
        glm::dvec2 sum(0.0);
        for (uint32_t j = 1; j < q(); ++j) {
            sum += turn(j, 2 * q()).second * (e_[j] - v_);
        }
        return fanScales(FanKind::crease, q()).tangent * sum;
    }

    /// At a seam.
    void openTangents() {
        const glm::dvec2 a = spoke(0), b = spoke(q());
        const bool corner = rule_ == UvChannel::Rule::corner;
        const FacetAngle angle = surface_->angle();
        v_ = corner ? glm::dvec2(0.0) : (a + b) / 6.0;
        t_[0] = a / 3.0;
        t_[q()] = b / 3.0;
        // A run whose angle is the surface's: it halves a smooth vertex, or is one corner of two on a smooth border.
        const uint32_t whole = corner ? 4 * q() : 2 * q();
        if (angle == FacetAngle{1, whole} && !(corner && surface_->closed())) {
            const glm::dvec2 tau1 = corner ? a / 3.0 : (a - b) / 6.0, tau2 = corner ? b / 3.0 : crossTangent();
            for (uint32_t j = 1; j < q(); ++j) {
                const auto [cosine, sine] = turn(j, whole);
                t_[j] = v_ + cosine * tau1 + sine * tau2;
            }
            return;
        }
        const double lambda = eigenvalueOf(angle);
        for (uint32_t j = 1; j < q(); ++j) {
            t_[j] = v_ + (e_[j] - v_) / (2.0 * lambda);
        }
    }

    void store() {
        for (uint32_t j = 0; j < q(); ++j) {
            const uint32_t after = closed_ ? (j + 1) % q() : j + 1, before = j > 0 ? j - 1 : q() - 1;
            CornerUvs& to = out_[facets_[j]];
            to.ends0 = isEnd(j);
            to.ends1 = isEnd(after);
            to.v = p_ + v_;
            to.f = p_ + f_[j];
            to.t0 = p_ + t_[j];
            to.t1 = p_ + t_[after];
            to.e0 = to.ends0 ? to.t0 : p_ + e_[j];
            to.e1 = to.ends1 ? to.t1 : p_ + e_[after];
            to.jump0 = to.ends0 ? 2.0 * (f_[j] - t_[j]) : f_[j] - f_[before];
            to.jump1 = to.ends1 ? 2.0 * (f_[j] - t_[after]) : f_[j] - f_[after];
        }
    }

    const Mesh& mesh_;
    const UvChannel& channel_;
    std::vector<CornerUvs>& out_;
    // The fan at work. All but p are relative to p.
    UvChannel::Rule rule_ = UvChannel::Rule::match;
    std::vector<uint32_t> facets_; ///< the corners of its facets, counter-clockwise
    bool closed_ = true;
    bool own_ = true; ///< it is the surface's own fan
    const Fan* surface_ = nullptr;
    glm::dvec2 p_{0.0}, v_{0.0};
    std::vector<glm::dvec2> f_, e_, t_;
};

UvConstruction::UvConstruction(const Mesh& mesh, const UvChannel& channel) : mesh_(mesh) {
    corners_.resize(mesh.cage.cornerCount());
    Fans fans(mesh, channel, corners_);
    for (uint32_t v = 0; v < channel.values.size(); ++v) {
        fans.add(v);
    }
}

UvPatch UvConstruction::patch(uint32_t facet) const {
    const uint32_t sides = mesh_.cage.sides(facet);
    std::array<CornerUvs, kMaxSides> q;
    for (uint32_t i = 0; i < sides; ++i) {
        q[i] = corners_[mesh_.corner(facet, i)];
    }
    UvPatch patch;
    if (mesh_.classes[facet] == PatchClass::polar) {
        polar(facet, q.data(), patch);
    } else if (mesh_.classes[facet] != PatchClass::regular) {
        sectors(facet, q.data(), patch);
    } else {
        const std::array<glm::dvec2, 16> net{q[0].v,  q[0].t0, q[1].t1, q[1].v,  q[0].t1, q[0].f,  q[1].f,  q[1].t0,
                                             q[3].t0, q[3].f,  q[2].f,  q[2].t1, q[3].v,  q[3].t1, q[2].t0, q[2].v};
        std::copy(net.begin(), net.end(), patch.c.begin());
    }
    return patch;
}

void UvConstruction::polar(uint32_t facet, const CornerUvs* q, UvPatch& patch) const {
    const FacetCorner& at = mesh_.corners[mesh_.corner(facet, 2)];
    const double c = turn(1, mesh_.fans[at.fan].facets).first;
    const CornerUvs& apex = q[2];
    const glm::dvec2 h02 = apex.t0, h32 = apex.t1;
    const glm::dvec2 smooth12 = (2.0 * h02 + h32 + (c - 1.0) * apex.v) / (2.0 + c); // (18)
    const glm::dvec2 smooth22 = (h02 + 2.0 * h32 + (c - 1.0) * apex.v) / (2.0 + c);
    const glm::dvec2 h12 = h02 + 1.5 * mesh_.slotAlphas[at.slot] * (smooth12 - h02); // (19)
    const glm::dvec2 h22 = h32 + 1.5 * mesh_.slotAlphas[at.slotBack] * (smooth22 - h32);
    const std::array<glm::dvec2, 13> net{q[0].v,  q[0].t0, q[1].t1, q[1].v, q[0].t1, q[0].f, q[1].f,
                                         q[1].t0, h02,     h12,     h22,    h32,     apex.v};
    std::copy(net.begin(), net.end(), patch.c.begin());
}

void UvConstruction::sectors(uint32_t facet, const CornerUvs* q, UvPatch& patch) const {
    const uint32_t m = mesh_.cage.sides(facet);
    const double mu = 1.0 - turn(1, m).first, k0 = 0.5 / mu, k1 = 1.0 - 2.0 * k0;
    const double w = m == 3 ? 2.0 : m == 4 ? 1.0 : -3.0;
    std::array<glm::dvec2, kMaxSides> b211, b121, b310, b130, b202;
    glm::dvec2 centre(0.0);
    for (uint32_t i = 0; i < m; ++i) {
        const CornerUvs &a = q[i], &b = q[(i + 1) % m];
        const uint32_t corner = mesh_.corner(facet, i);
        const FacetAngle own = mesh_.fans[mesh_.corners[corner].fan].angle();
        const FacetAngle other = mesh_.fans[mesh_.corners[mesh_.corner(facet, (i + 1) % m)].fan].angle();
        const bool cut = mesh_.features.hard(mesh_.topology.cornerEdges[corner]) || (a.ends0 && b.ends1);
        const EdgeFactors factors = makeEdgeFactors({m, {own, other}, cut, {false, false}});
        const glm::dvec2 along = b.t1 - a.t0;
        b310[i] = a.v + 0.75 * (a.t0 - a.v);
        b130[i] = b.v + 0.75 * (b.t1 - b.v);
        b211[i] =
            b310[i] + factors.along[0] * along + factors.own[0] * (a.t0 - a.v) + factors.across[0] * a.jump0; // (20)
        b121[i] = b130[i] - factors.along[1] * along + factors.own[1] * (b.t1 - b.v) + factors.across[1] * b.jump1;
        centre += w * a.v + 3.0 * (a.e0 + a.e1) + 9.0 * a.f;
    }
    const glm::dvec2 b004 = centre / (m * (15.0 + w));
    for (uint32_t i = 0; i < m; ++i) {
        const uint32_t last = (i + m - 1) % m;
        b202[i] = k1 * (k1 * q[i].v + k0 * (b310[i] + b130[last])) + k0 * (b211[i] + b121[last]); // (3)
    }
    patch.c[0] = b004;
    for (uint32_t i = 0; i < m; ++i) {
        const uint32_t n1 = (i + 1) % m, n2 = (i + 2) % m, n3 = (i + 3) % m, n4 = (i + 4) % m;
        const double d = turn(2, 5).first;
        const glm::dvec2 b112 =
            m == 3 ? 1.5 * b004 - 0.5 * b202[n2]
            : m == 4
                ? b004 + 3.0 / 16.0 * ((b211[i] + b121[i]) - (b121[n1] + b211[n3])) +
                      1.0 / 16.0 * ((b211[n1] + b121[n3]) - (b211[n2] + b121[n2]))
                : mu * (b004 + 0.2 * (b202[n3] - 4.0 * d * (b202[i] + b202[n1]) - 4.0 * d * d * (b202[n2] + b202[n4])));
        const std::array<glm::dvec2, 6> own{q[i].v, q[i].t0, q[n1].t1, b211[i], b121[i], b112};
        std::copy(own.begin(), own.end(), patch.c.begin() + 1 + 6 * i);
        const Fan& fan = mesh_.fans[mesh_.corners[mesh_.corner(facet, i)].fan];
        patch.singularCorners |= fan.angle() == FacetAngle{1, 2} ? 1u << i : 0u;
    }
}

} // namespace supple::surface::pm
