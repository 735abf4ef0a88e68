#include "cage/piece.h"

#include <algorithm>
#include <set>
#include <utility>

namespace supple::cage {
namespace {

template <class T>
void takeRun(const std::vector<T>& from, size_t first, size_t count, std::vector<T>& to) {
    if (!from.empty()) {
        to.insert(to.end(), from.begin() + static_cast<ptrdiff_t>(first),
                  from.begin() + static_cast<ptrdiff_t>(first + count));
    }
}

/// The face with all that belongs to it and to its corners; vertices are still the whole cage's.
void takeFace(const Cage& from, uint32_t face, Cage& cage) {
    const uint32_t first = from.faceStarts[face], sides = from.sides(face), corners = cage.cornerCount();
    takeRun(from.faceVertices, first, sides, cage.faceVertices);
    takeRun(from.cornerUvs, first, sides, cage.cornerUvs);
    takeRun(from.cornerUvs1, first, sides, cage.cornerUvs1);
    takeRun(from.cornerColors, first, sides, cage.cornerColors);
    takeRun(from.cornerNormals, first, sides, cage.cornerNormals);
    takeRun(from.cornerTangents, first, sides, cage.cornerTangents);
    takeRun(from.faceMaterials, face, 1, cage.faceMaterials);
    takeRun(from.faceParts, face, 1, cage.faceParts);
    takeRun(from.faceTrimTiles, face, 1, cage.faceTrimTiles);
    const size_t triangles = cage.faceTriangles.size();
    takeRun(from.faceTriangles, size_t{3} * (first - 2 * face), size_t{3} * (sides - 2), cage.faceTriangles);
    for (size_t i = triangles; i < cage.faceTriangles.size(); ++i) {
        cage.faceTriangles[i] = cage.faceTriangles[i] - first + corners;
    }
    if (std::binary_search(from.holes.begin(), from.holes.end(), face)) {
        cage.holes.push_back(cage.faceCount());
    }
    cage.faceStarts.push_back(cage.cornerCount());
}

/// The creases on edges of the cage's faces, and its sharp vertices. `places`: of the vertices that were taken, or
/// kNone.
void takeFeatures(const Cage& from, std::span<const uint32_t> places, Cage& cage) {
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (uint32_t f = 0; f < cage.faceCount() && !(from.creases.empty() && from.creaseScalars.empty()); ++f) {
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            const uint32_t next = c + 1 < cage.faceStarts[f + 1] ? c + 1 : cage.faceStarts[f];
            edges.insert(std::minmax(cage.faceVertices[c], cage.faceVertices[next]));
        }
    }
    const auto isEdge = [&](uint32_t a, uint32_t b) {
        return places[a] != kNone && places[b] != kNone && edges.count(std::minmax(places[a], places[b])) != 0;
    };
    cage.creaseSets = from.creaseSets; // they keep their numbers
    for (const Crease& crease : from.creases) {
        if (isEdge(crease.a, crease.b)) {
            cage.creases.push_back({places[crease.a], places[crease.b], crease.sharpness, crease.set});
        }
    }
    for (const SharpVertex& sharp : from.sharpVertices) {
        if (places[sharp.vertex] != kNone) {
            cage.sharpVertices.push_back({places[sharp.vertex], sharp.sharpness});
        }
    }
    for (const uint32_t v : from.roundCorners) {
        if (places[v] != kNone) {
            cage.roundCorners.push_back(places[v]);
        }
    }
    for (const CreaseScalar& scalar : from.creaseScalars) {
        if (isEdge(scalar.vertex, scalar.toward)) {
            cage.creaseScalars.push_back({places[scalar.vertex], places[scalar.toward], scalar.alpha});
        }
    }
}

} // namespace

CagePiece takeFaces(const Cage& cage, std::span<const uint32_t> faces) {
    CagePiece piece;
    piece.faces.assign(faces.begin(), faces.end());
    piece.cage.faceStarts.push_back(0);
    for (const uint32_t face : faces) {
        takeFace(cage, face, piece.cage);
    }
    piece.vertices = piece.cage.faceVertices;
    std::sort(piece.vertices.begin(), piece.vertices.end());
    piece.vertices.erase(std::unique(piece.vertices.begin(), piece.vertices.end()), piece.vertices.end());
    std::vector<uint32_t> places(cage.vertexCount(), kNone);
    for (const uint32_t v : piece.vertices) {
        places[v] = piece.cage.vertexCount();
        piece.cage.positions.push_back(cage.positions[v]);
    }
    for (uint32_t& v : piece.cage.faceVertices) {
        v = places[v];
    }
    takeFeatures(cage, places, piece.cage);
    return piece;
}

} // namespace supple::cage
