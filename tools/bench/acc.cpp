#include "tools/bench/acc.h"

#include <cmath>
#include <numbers>

namespace supple::bench {
namespace {

/// What a vertex gives to the patches round it, by spoke and by sector.
struct AccVertex {
    double cosine = 0.0;
    glm::dvec3 limit{0.0};
    std::vector<glm::dvec3> edges, inner, tangents;
};

AccVertex accVertex(const cage::Cage& cage, const cage::Topology& topology, uint32_t vertex) {
    const uint32_t first = topology.spokeStarts[vertex], n = topology.spokeCount(vertex);
    const glm::dvec3 p(cage.positions[vertex]);
    std::vector<glm::dvec3> e, d; // far ends of spokes, far corners of sectors
    for (uint32_t k = 0; k < n; ++k) {
        e.emplace_back(cage.positions[topology.spokeVertices[first + k]]);
        const uint32_t corner = topology.sectorCorners[first + k], face = topology.cornerFaces[corner];
        const uint32_t start = cage.faceStarts[face];
        d.emplace_back(cage.positions[cage.faceVertices[start + (corner - start + 2) % 4]]);
    }
    AccVertex result;
    const double count = n, turn = 2.0 * std::numbers::pi / count;
    result.cosine = n == 4 ? 0.0 : std::cos(turn);
    const double root = std::sqrt(4.0 + std::pow(std::cos(0.5 * turn), 2));
    const double alpha = (1.0 + std::cos(0.5 * turn) / root) / count, beta = 1.0 / (count * root);
    for (uint32_t k = 0; k < n; ++k) {
        const uint32_t next = (k + 1) % n, before = (k + n - 1) % n;
        result.limit += (4.0 * e[k] + d[k]) / (count * (count + 5.0));
        result.edges.push_back((2.0 * count * p + 4.0 * e[k] + 2.0 * (e[before] + e[next]) + (d[before] + d[k])) /
                               (2.0 * count + 10.0));
        result.inner.push_back((count * p + 2.0 * (e[k] + e[next]) + d[k]) / (count + 5.0));
        glm::dvec3 tangent(0.0);
        for (uint32_t i = 0; i < n; ++i) {
            const double away = static_cast<double>(i) - static_cast<double>(k);
            tangent += alpha * std::cos(turn * away) * (e[i] - p) + beta * std::cos(turn * (away + 0.5)) * (d[i] - p);
        }
        result.tangents.push_back(tangent);
    }
    result.limit += count / (count + 5.0) * p;
    return result;
}

/// A place (a, b) of a corner's own frame, a along its edge, in the patch's numbering of this degree in u and in v.
size_t placeOf(uint32_t corner, uint32_t a, uint32_t b, uint32_t degreeU, uint32_t degreeV) {
    const uint32_t i = corner == 0 ? a : corner == 1 ? degreeU - b : corner == 2 ? degreeU - a : b;
    const uint32_t j = corner == 0 ? b : corner == 1 ? a : corner == 2 ? degreeV - b : degreeV - a;
    return i + (degreeU + 1) * j;
}

/// The tangents along an edge and across it, into the patch.
struct AccEdge {
    std::array<glm::dvec3, 3> along;
    std::array<glm::dvec3, 4> across;
};

/// From the patch's corner e to the next. `across` is what makes the fields of both sides agree: with f linear from 2
/// c0 to -2 c1, across + across of the other side = f * along.
AccEdge accEdge(const AccPatch& patch, uint32_t e, const AccVertex& from, const AccVertex& to, uint32_t fromSpoke,
                uint32_t fromBack, uint32_t toSpoke, uint32_t toBack) {
    const auto b = [&](uint32_t x, uint32_t y) { return patch.b[placeOf(e, x, y, 3, 3)]; };
    AccEdge edge;
    edge.along = {from.tangents[fromSpoke], 3.0 * (b(2, 0) - b(1, 0)), -to.tangents[toBack]};
    edge.across = {from.tangents[fromBack],
                   (2.0 * from.cosine * edge.along[1] - to.cosine * edge.along[0]) / 3.0 + 3.0 * (b(1, 1) - b(1, 0)),
                   (from.cosine * edge.along[2] - 2.0 * to.cosine * edge.along[1]) / 3.0 + 3.0 * (b(2, 1) - b(2, 0)),
                   to.tangents[toSpoke]};
    return edge;
}

/// Fields of tangents along u run the other way on edge 2, and so on.
void storeEdge(AccPatch& patch, uint32_t e, const AccEdge& edge) {
    const bool alongU = e % 2 == 0;
    const double alongSign = e < 2 ? 1.0 : -1.0, acrossSign = e == 0 || e == 3 ? 1.0 : -1.0;
    std::array<glm::dvec3, 12>& own = alongU ? patch.u : patch.v;
    std::array<glm::dvec3, 12>& other = alongU ? patch.v : patch.u;
    for (uint32_t i = 0; i < 3; ++i)
        own[placeOf(e, i, 0, alongU ? 2 : 3, alongU ? 3 : 2)] = alongSign * edge.along[i];
    for (uint32_t i = 0; i < 4; ++i)
        other[placeOf(e, i, 0, alongU ? 3 : 2, alongU ? 2 : 3)] = acrossSign * edge.across[i];
}

/// Bernstein weights of degree 2 or 3.
std::array<double, 4> bernstein(uint32_t degree, double t) {
    const double s = 1.0 - t;
    return degree == 2 ? std::array<double, 4>{s * s, 2.0 * s * t, t * t, 0.0}
                       : std::array<double, 4>{s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t};
}

template <size_t N>
glm::dvec3 tensor(const std::array<glm::dvec3, N>& c, uint32_t degreeU, uint32_t degreeV, double u, double v) {
    const std::array<double, 4> wu = bernstein(degreeU, u), wv = bernstein(degreeV, v);
    glm::dvec3 sum(0.0);
    for (uint32_t j = 0; j <= degreeV; ++j) {
        for (uint32_t i = 0; i <= degreeU; ++i)
            sum += wu[i] * wv[j] * c[i + (degreeU + 1) * j];
    }
    return sum;
}

} // namespace

Result<std::vector<AccPatch>> makeAcc(const cage::Cage& cage) {
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    if (!topology)
        return topology.error();
    std::vector<AccVertex> vertices;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        if (cage.sides(f) != 4)
            return Error{ErrorCode::asset, "ACC takes quads alone"};
    }
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        if (topology->boundary[v] != 0)
            return Error{ErrorCode::asset, "ACC is measured on closed cages alone"};
        vertices.push_back(accVertex(cage, *topology, v));
    }
    std::vector<AccPatch> patches;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        AccPatch& patch = patches.emplace_back();
        const auto vertexOf = [&](uint32_t corner) -> const AccVertex& {
            return vertices[cage.faceVertices[cage.faceStarts[f] + corner % 4]];
        };
        const auto slot = [&](const std::vector<uint32_t>& slots, uint32_t corner) {
            const uint32_t c = cage.faceStarts[f] + corner % 4;
            return slots[c] - topology->spokeStarts[cage.faceVertices[c]];
        };
        for (uint32_t c = 0; c < 4; ++c) {
            const uint32_t spoke = slot(topology->cornerSpokes, c), back = slot(topology->cornerSpokesBack, c);
            patch.b[placeOf(c, 0, 0, 3, 3)] = vertexOf(c).limit;
            patch.b[placeOf(c, 1, 0, 3, 3)] = vertexOf(c).edges[spoke];
            patch.b[placeOf(c, 0, 1, 3, 3)] = vertexOf(c).edges[back];
            patch.b[placeOf(c, 1, 1, 3, 3)] = vertexOf(c).inner[spoke];
        }
        for (uint32_t i = 1; i < 3; ++i) {
            patch.u[1 + 3 * i] = 3.0 * (patch.b[2 + 4 * i] - patch.b[1 + 4 * i]);
            patch.v[i + 4] = 3.0 * (patch.b[i + 8] - patch.b[i + 4]);
        }
        for (uint32_t e = 0; e < 4; ++e)
            storeEdge(patch, e,
                      accEdge(patch, e, vertexOf(e), vertexOf(e + 1), slot(topology->cornerSpokes, e),
                              slot(topology->cornerSpokesBack, e), slot(topology->cornerSpokes, e + 1),
                              slot(topology->cornerSpokesBack, e + 1)));
    }
    return patches;
}

AccSample evaluateAcc(const AccPatch& patch, double u, double v) {
    return {tensor(patch.b, 3, 3, u, v), tensor(patch.u, 2, 3, u, v), tensor(patch.v, 3, 2, u, v)};
}

} // namespace supple::bench
