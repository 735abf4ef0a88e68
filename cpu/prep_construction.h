// p-rep's construction for any kind of point (cpu/form.h), with the stages of the shaders. Paper: A. Myles, Y. I. Yeo,
// J. Peters, "GPU Conversion of Quad Meshes to Smooth Surfaces", SPM 2008; equation numbers are the paper's. Formulas:
// docs/prep.md, which says where we depart from the print. Arithmetic must round as written (no contraction, no
// reassociation): the bits of shared borders depend on it.
#pragma once

#include "cage/topology.h"
#include "cpu/form.h"
#include "surface/prep/weights.h"

#include <array>
#include <cassert>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace supple::surface::prep {

/// The output of the construction stages: one limit point X per vertex, one tangent TG and face coefficient FC per
/// spoke of the topology, and four edge coefficients H per edge (h20, h30, h21, h31 in the edge's own direction). H is
/// zero if the edge is not perturbed.
template <class Point>
struct PointCoefficients {
    std::vector<Point> limitPoints;
    std::vector<Point> limitNormals; ///< unit(e1 x e2), or zero if that vanishes
    std::vector<Point> tangents;
    std::vector<Point> faceCoefficients; ///< zero in a boundary fan's last slot, which has no sector
    std::vector<std::array<Point, 4>> edgeCoefficients;
};

/// One patch: the bicubic coefficients g[i + 4 j], and the sparse perturbation of degree 5. h[4 e + s] is that of face
/// edge e, with s = 0..3 for the local indices (2,0), (3,0), (2,1), (3,1).
template <class Point>
struct PointPatch {
    std::array<Point, 16> g;
    std::array<Point, 16> h;
    std::array<Point, 4> cornerNormals; ///< limit normals, for smooth corners of one face, where du x dv vanishes
    std::array<bool, 4> useCornerNormal{};
    bool perturbed = false; ///< an edge has a perturbation. Decided from the valences, never from h
};

/// A valence class with its weights rounded once to the arithmetic's type, as the GPU's weight table is. The centre's
/// weights are not among them: every sum below runs over differences from the centre.
template <class T>
struct RoundedClass {
    explicit RoundedClass(const ValenceClass& k)
        : boundary(k.boundary), sectors(k.sectors), limitEdge(rounded(k.limitEdge)), limitFace(rounded(k.limitFace)),
          e1Edge(rounded(k.e1Edge)), e1Face(rounded(k.e1Face)), e2Edge(rounded(k.e2Edge)), e2Face(rounded(k.e2Face)),
          cosines(rounded(k.cosines)), sines(rounded(k.sines)) {}

    bool boundary;
    uint32_t sectors;
    std::vector<T> limitEdge, limitFace, e1Edge, e1Face, e2Edge, e2Face, cosines, sines;

private:
    static std::vector<T> rounded(const std::vector<double>& weights) { return {weights.begin(), weights.end()}; }
};

/// The vertex stage for one vertex: `spokes` and `diagonals` are its one-ring as differences from p0. A character is
/// large beside its patches; differences keep the rounding of a float at the size of the ring, which the normals depend
/// on.
template <class Point>
void vertexStage(const RoundedClass<ScalarOf<Point>>& k, const Point& p0, std::span<const Point> spokes,
                 std::span<const Point> diagonals, uint32_t vertex, uint32_t base, PointCoefficients<Point>& out) {
    using T = ScalarOf<Point>;
    Point x(T(0));  // X - p0, eq. (2)
    Point e1(T(0)); // eq. (3)
    Point e2(T(0));
    for (size_t i = 0; i < spokes.size(); ++i) {
        x += k.limitEdge[i] * spokes[i];
        e1 += k.e1Edge[i] * spokes[i];
        e2 += k.e2Edge[i] * spokes[i];
        if (i < diagonals.size()) {
            x += k.limitFace[i] * diagonals[i];
            e1 += k.e1Face[i] * diagonals[i];
            e2 += k.e2Face[i] * diagonals[i];
        }
    }
    out.limitPoints[vertex] = p0 + x;
    out.limitNormals[vertex] = unitCross(e1, e2);
    for (size_t i = 0; i < spokes.size(); ++i) {
        const bool onBoundary = k.boundary && (i == 0 || i == k.sectors);
        // On the boundary: the inner coefficient of the boundary's cubic B-spline (or of the sharp corner's straight
        // end), (2 p0 + p_k) / 3.
        out.tangents[base + i] =
            p0 + (onBoundary ? spokes[i] * T(1.0 / 3.0) : x + (e1 * k.cosines[i] + e2 * k.sines[i]));
    }
    for (size_t i = 0; i < diagonals.size(); ++i) { // eq. (4): (4 p0 + 2 (p_k + p_k+1) + d_k) / 9
        const Point& next = spokes[(i + 1) % spokes.size()];
        out.faceCoefficients[base + i] = p0 + (T(2) * (spokes[i] + next) + diagonals[i]) * T(1.0 / 9.0);
    }
}

/// The edge A -> B: `corner` is the corner at A of the face on its left, `twin` the corner at B of the other face.
template <class Point>
void edgeStage(const cage::Cage& cage, const cage::Topology& topology, uint32_t e, const EdgeWeights& weights,
               PointCoefficients<Point>& out) {
    using T = ScalarOf<Point>;
    const auto [corner, twin] = topology.edges[e];
    const uint32_t a = cage.faceVertices[corner];
    const uint32_t b = cage.faceVertices[twin];
    const uint32_t cornerAtB = nextCorner(cage, topology.cornerFaces[corner], corner);
    const uint32_t twinAtA = nextCorner(cage, topology.cornerFaces[twin], twin);
    // All relative to A, as every row of the weights allows.
    const Point& origin = out.limitPoints[a];
    const auto faceCoefficient = [&](uint32_t c) { return out.faceCoefficients[topology.cornerSpokes[c]] - origin; };
    const Point points[5] = {out.tangents[topology.cornerSpokes[corner]] - origin,
                             out.tangents[topology.cornerSpokes[twin]] - origin, out.limitPoints[b] - origin,
                             faceCoefficient(corner) + faceCoefficient(twinAtA),
                             faceCoefficient(cornerAtB) + faceCoefficient(twin)};
    for (size_t row = 0; row < 4; ++row) {
        Point h = T(weights[row][1]) * points[0];
        for (size_t i = 1; i < 5; ++i) {
            h += T(weights[row][i + 1]) * points[i];
        }
        out.edgeCoefficients[e][row] = h;
    }
}

/// The construction: vertex stage and edge stage. `positions` has one entry per cage vertex. All faces are quads.
template <class Point>
PointCoefficients<Point> constructPoints(const cage::Cage& cage, const cage::Topology& topology,
                                         std::span<const Point> positions, const Options& options) {
    using T = ScalarOf<Point>;
    assert(positions.size() == cage.vertexCount());
    const uint32_t vertexCount = cage.vertexCount();
    PointCoefficients<Point> out;
    const Point zero(T(0));
    out.limitPoints.assign(vertexCount, zero);
    out.limitNormals.assign(vertexCount, zero);
    out.tangents.assign(topology.spokeVertices.size(), zero);
    out.faceCoefficients.assign(topology.spokeVertices.size(), zero);
    out.edgeCoefficients.assign(topology.edges.size(), {zero, zero, zero, zero});

    const auto classKey = [&](uint32_t v) { return std::pair{topology.boundary[v] != 0, topology.sectorCount(v)}; };
    std::map<std::pair<bool, uint32_t>, ValenceClass> classes;
    std::map<std::pair<bool, uint32_t>, RoundedClass<T>> rounded;
    std::vector<Point> spokes;
    std::vector<Point> diagonals;
    for (uint32_t v = 0; v < vertexCount; ++v) {
        const auto key = classKey(v);
        if (!classes.contains(key)) {
            const ValenceClass& added = classes[key] = makeValenceClass(key.second, key.first, options);
            rounded.emplace(key, added);
        }
        const uint32_t base = topology.spokeStarts[v];
        spokes.clear();
        diagonals.clear();
        for (uint32_t k = 0; k < topology.spokeCount(v); ++k) {
            spokes.push_back(positions[topology.spokeVertices[base + k]] - positions[v]);
            const uint32_t corner = topology.sectorCorners[base + k];
            if (corner != cage::kNone) {
                const uint32_t face = topology.cornerFaces[corner];
                assert(cage.sides(face) == 4);
                diagonals.push_back(
                    positions[cage.faceVertices[nextCorner(cage, face, nextCorner(cage, face, corner))]] -
                    positions[v]);
            }
        }
        vertexStage<Point>(rounded.at(key), positions[v], spokes, diagonals, v, base, out);
    }

    std::map<std::pair<double, double>, EdgeWeights> edgeWeights;
    for (uint32_t e = 0; e < topology.edges.size(); ++e) {
        if (!isPerturbed(cage, topology, e)) {
            continue;
        }
        const auto [corner, twin] = topology.edges[e];
        const std::pair ends{classes.at(classKey(cage.faceVertices[corner])).c,
                             classes.at(classKey(cage.faceVertices[twin])).c};
        if (!edgeWeights.contains(ends)) {
            edgeWeights[ends] = makeEdgeWeights(ends.first, ends.second);
        }
        edgeStage(cage, topology, e, edgeWeights[ends], out);
    }
    return out;
}

/// The patch stage, which only gathers.
template <class Point>
PointPatch<Point> gatherPoints(const cage::Cage& cage, const cage::Topology& topology,
                               const PointCoefficients<Point>& c, uint32_t face, const Options& options) {
    assert(cage.sides(face) == 4);
    PointPatch<Point> patch;
    for (uint32_t j = 0; j < 4; ++j) {
        const uint32_t corner = cage.faceStarts[face] + j;
        const uint32_t vertex = cage.faceVertices[corner];
        // Corner-local (a, b): a along edge j -> j+1, b along j -> j-1.
        const auto slot = [j](uint32_t a, uint32_t b) {
            switch (j) {
            case 0:
                return a + 4 * b;
            case 1:
                return (3 - b) + 4 * a;
            case 2:
                return (3 - a) + 4 * (3 - b);
            default:
                return b + 4 * (3 - a);
            }
        };
        patch.g[slot(0, 0)] = c.limitPoints[vertex];
        patch.g[slot(1, 0)] = c.tangents[topology.cornerSpokes[corner]];
        patch.g[slot(0, 1)] = c.tangents[topology.cornerSpokesBack[corner]];
        patch.g[slot(1, 1)] = c.faceCoefficients[topology.cornerSpokes[corner]];

        const uint32_t edge = topology.cornerEdges[corner];
        const uint32_t swap = topology.edges[edge].corner == corner ? 0 : 1; // h20 <-> h30, h21 <-> h31
        for (uint32_t s = 0; s < 4; ++s) {
            patch.h[4 * j + s] = c.edgeCoefficients[edge][s ^ swap];
        }
        patch.perturbed = patch.perturbed || isPerturbed(cage, topology, edge);
        patch.cornerNormals[j] = c.limitNormals[vertex];
        patch.useCornerNormal[j] = options.cornerRule == CornerRule::smooth && topology.boundary[vertex] != 0 &&
                                   topology.sectorCount(vertex) == 1;
    }
    return patch;
}

} // namespace supple::surface::prep
