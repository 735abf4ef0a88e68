#include "surface/chains/triangles.h"

#include <algorithm>
#include <bit>

namespace supple::surface::loop {
namespace {

constexpr uint32_t kRegularSpokes = 6, kOpposite = 3;

/// `spokes`: their sharpness. Chains alone have semi-sharp ones.
bool isPlainFan(const std::vector<float>& spokes, bool open) {
    std::vector<bool> sharp;
    for (const float spoke : spokes) {
        if (spoke > 0.0f && spoke < kInfiniteSharpness) {
            return false;
        }
        sharp.push_back(spoke > 0.0f);
    }
    const auto count = std::count(sharp.begin(), sharp.end(), true);
    if (open) {
        return sharp.size() == kRegularSpokes - 2 && count == 2;
    }
    if (sharp.size() != kRegularSpokes || (count != 0 && count != 2)) {
        return false;
    }
    const auto first = static_cast<size_t>(std::find(sharp.begin(), sharp.end(), true) - sharp.begin());
    return count == 0 || (first < kOpposite && sharp[first + kOpposite]);
}

} // namespace

Triangles::Triangles(const RefinedMesh& mesh) : mesh_(mesh) {
    const cage::Topology& topology = mesh.topology;
    std::vector<float> spokes;
    for (uint32_t v = 0; v < mesh.cage.vertexCount(); ++v) {
        spokes.clear();
        for (uint32_t s = topology.spokeStarts[v]; s < topology.spokeStarts[v + 1]; ++s) {
            spokes.push_back(mesh.edgeSharpness[cage::spokeEdge(mesh.cage, topology, s)]);
        }
        plain_.push_back(mesh.vertexSharpness[v] == 0.0f && isPlainFan(spokes, topology.boundary[v] != 0) ? 1 : 0);
    }
}

uint32_t Triangles::spokeFrom(uint32_t corner, uint32_t steps) const {
    const cage::Topology& topology = mesh_.topology;
    const uint32_t v = mesh_.cage.faceVertices[corner], first = topology.spokeStarts[v], count = topology.spokeCount(v);
    const uint32_t own = topology.cornerSpokes[corner] - first;
    if (topology.boundary[v] == 0) {
        return first + (own + steps) % count;
    }
    // Six directions: those behind the border have no spoke.
    const uint32_t at = (own + steps) % kRegularSpokes;
    return at < count ? first + at : cage::kNone;
}

CornerKind Triangles::kindOf(uint32_t corner) const {
    const uint32_t v = mesh_.cage.faceVertices[corner];
    if (!isPlain(v)) {
        return CornerKind::chain;
    }
    // The spokes on the triangle's two sides, and those opposite to them; the two others are left.
    const uint32_t beside = spokeFrom(corner, 2);
    const bool passes =
        beside != cage::kNone && mesh_.edgeSharpness[cage::spokeEdge(mesh_.cage, mesh_.topology, beside)] > 0.0f;
    return passes ? CornerKind::creased : CornerKind::plain;
}

bool Triangles::isBehindCrease(uint32_t vertex, uint32_t sector) const {
    const cage::Topology& topology = mesh_.topology;
    if (topology.boundary[vertex] != 0) {
        return false;
    }
    for (uint32_t k = 0; k < kOpposite; ++k) {
        const uint32_t edge = cage::spokeEdge(mesh_.cage, topology, topology.spokeStarts[vertex] + k);
        if (mesh_.edgeSharpness[edge] > 0.0f) {
            return sector < k || sector >= k + kOpposite;
        }
    }
    return false;
}

uint32_t Triangles::flagsOf(std::span<const uint32_t> corners) const {
    uint32_t flags = 0;
    for (uint32_t i = 0; i < 3; ++i) {
        const CornerKind kind = kindOf(corners[i]);
        flags |= isEndless(corners[i]) ? 1u << (shared::kSharpTriangleSide + i) : 0u;
        flags |= kind == CornerKind::creased ? 1u << (shared::kCreasedTriangleCorner + i) : 0u;
        flags |= kind != CornerKind::chain ? 1u << (shared::kPlainTriangleCorner + i) : 0u;
    }
    return flags;
}

std::array<uint32_t, 4> Triangles::sharpnessOf(std::span<const uint32_t> corners) const {
    std::array<uint32_t, 4> words{};
    for (uint32_t i = 0; i < 3; ++i) {
        words[i] = std::bit_cast<uint32_t>(isSemiSharp(corners[i]) ? softened(sharpness(corners[i]), 1) : 0.0f);
    }
    return words;
}

uint32_t Triangles::chainsFrom(uint32_t face, uint32_t first) const {
    uint32_t chains = 0;
    for (uint32_t i = 0; i < 3; ++i) {
        chains |= isPlain(mesh_.cage.faceVertices[cornerOf(face, first + i)]) ? 0u : 1u << i;
    }
    return chains;
}

uint8_t Triangles::firstCorner(uint32_t face) const {
    uint8_t best = 0;
    for (uint8_t first = 1; first < 3; ++first) {
        best = chainsFrom(face, first) < chainsFrom(face, best) ? first : best;
    }
    return best;
}

void Triangles::addLimit(uint32_t vertex, Stencils& rows) const {
    const cage::Topology& topology = mesh_.topology;
    std::vector<uint32_t> all, sharp;
    for (uint32_t s = topology.spokeStarts[vertex]; s < topology.spokeStarts[vertex + 1]; ++s) {
        all.push_back(topology.spokeVertices[s]);
        if (mesh_.edgeSharpness[cage::spokeEdge(mesh_.cage, topology, s)] > 0.0f) {
            sharp.push_back(topology.spokeVertices[s]);
        }
    }
    const std::vector<uint32_t>& ends = sharp.empty() ? all : sharp;
    const double share = sharp.empty() ? 1.0 / 12.0 : 1.0 / 6.0;
    rows.vertices.push_back(vertex);
    rows.weights.push_back(1.0 - share * static_cast<double>(ends.size()));
    for (const uint32_t end : ends) {
        rows.vertices.push_back(end);
        rows.weights.push_back(share);
    }
    rows.starts.push_back(static_cast<uint32_t>(rows.vertices.size()));
}

TriangleCage Triangles::cageOf(uint32_t face, uint32_t first) const {
    TriangleCage points{};
    points.fill(mesh_.cage.faceVertices[cornerOf(face, first)]);
    for (uint32_t r = 0; r < 3; ++r) {
        const uint32_t corner = cornerOf(face, first + r), last = (r + 2) % 3;
        points[r] = mesh_.cage.faceVertices[corner];
        if (!isPlain(points[r])) {
            continue;
        }
        const std::array<uint32_t, 4> places = {6 + last, 9 + last, 3 + r, 6 + r}; // counter-clockwise
        for (uint32_t k = 0; k < places.size(); ++k) {
            if (const uint32_t spoke = spokeFrom(corner, 2 + k); spoke != cage::kNone) {
                points[places[k]] = mesh_.topology.spokeVertices[spoke];
            }
        }
    }
    return points;
}

TriangleNet Triangles::netOf(uint32_t face, uint32_t first) const {
    const StepPoints points(mesh_);
    TriangleNet net{};
    net.fill(points.edgePoint(cornerOf(face, first)));
    const auto put = [&](uint32_t place, uint32_t spoke) {
        if (spoke != cage::kNone) {
            net[place] = mesh_.cage.vertexCount() + cage::spokeEdge(mesh_.cage, mesh_.topology, spoke);
        }
    };
    for (uint32_t r = 0; r < 3; ++r) {
        const uint32_t corner = cornerOf(face, first + r), twin = mesh_.topology.twins[corner];
        net[r] = points.vertexAt(corner);
        net[3 + r] = points.edgePoint(corner);
        if (twin != cage::kNone) {
            net[9 + r] = points.edgePoint(points.next(twin));
            net[12 + r] = points.edgePoint(points.previous(twin));
        }
        if (isPlain(net[r])) {
            put(15 + (r + 2) % 3, spokeFrom(corner, 3));
            put(6 + r, spokeFrom(corner, 4));
        }
    }
    return net;
}

} // namespace supple::surface::loop
