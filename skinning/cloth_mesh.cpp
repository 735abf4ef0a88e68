#include "skinning/cloth_mesh.h"

#include <algorithm>
#include <map>
#include <set>

namespace supple::skinning {
namespace {

using cage::kNone;
using Pair = ClothPairs::Pair;

Pair pairOf(uint32_t a, uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

/// What lies around a vertex of a mesh.
struct Around {
    std::set<uint32_t> neighbours;
    std::vector<Pair> corners; ///< of each face, the two neighbours there
    bool quads = true;         ///< all of its faces are
};

std::vector<Around> aroundVertices(const ClothMesh& mesh) {
    std::vector<Around> around(mesh.vertices.size());
    for (size_t f = 0; f < mesh.faceCount(); ++f) {
        const uint32_t first = mesh.faceStarts[f], sides = mesh.faceStarts[f + 1] - first;
        for (uint32_t k = 0; k < sides; ++k) {
            const uint32_t last = mesh.faceVertices[first + (k + sides - 1) % sides];
            const uint32_t next = mesh.faceVertices[first + (k + 1) % sides];
            Around& own = around[mesh.faceVertices[first + k]];
            own.neighbours.insert({last, next});
            own.corners.push_back(pairOf(last, next));
            own.quads = own.quads && sides == 4;
        }
    }
    return around;
}

/// The ends of lines of quads that run through a vertex: neighbours that no face of it has both of.
void addLines(const Around& own, std::set<Pair>& bends) {
    const bool inner = own.corners.size() == 4 && own.neighbours.size() == 4;
    const bool border = own.corners.size() == 2 && own.neighbours.size() == 3;
    if (!own.quads || !(inner || border)) {
        return;
    }
    for (const uint32_t a : own.neighbours) {
        for (const uint32_t b : own.neighbours) {
            if (a < b && std::count(own.corners.begin(), own.corners.end(), Pair{a, b}) == 0) {
                bends.insert({a, b});
            }
        }
    }
}

/// The vertices opposite to edges of two triangles.
void addHinges(const ClothMesh& mesh, std::set<Pair>& bends) {
    std::map<Pair, std::vector<uint32_t>> opposite;
    for (size_t f = 0; f < mesh.faceCount(); ++f) {
        const uint32_t first = mesh.faceStarts[f];
        for (uint32_t k = 0; mesh.faceStarts[f + 1] - first == 3 && k < 3; ++k) {
            opposite[pairOf(mesh.faceVertices[first + k], mesh.faceVertices[first + (k + 1) % 3])].push_back(
                mesh.faceVertices[first + (k + 2) % 3]);
        }
    }
    for (const auto& [edge, others] : opposite) {
        if (others.size() == 2 && others[0] != others[1]) {
            bends.insert(pairOf(others[0], others[1]));
        }
    }
}

} // namespace

std::vector<ClothMesh> clothMeshes(const cage::Character& character) {
    const cage::Cage& cage = character.cage;
    const std::vector<cage::PaintedWeight>& weights = character.weights.cloths;
    std::vector<ClothMesh> meshes(character.cloths.size());
    std::vector<std::vector<uint32_t>> faces(meshes.size()); // of each cloth
    for (uint32_t f = 0; !weights.empty() && f < cage.faceCount(); ++f) {
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            const uint32_t cloth = weights[cage.faceVertices[c]].index;
            if (cloth != kNone && (faces[cloth].empty() || faces[cloth].back() != f)) {
                faces[cloth].push_back(f);
            }
        }
    }
    std::vector<uint32_t> places(cage.vertexCount(), kNone);
    for (uint32_t k = 0; k < meshes.size(); ++k) {
        ClothMesh& mesh = meshes[k];
        for (const uint32_t f : faces[k]) {
            mesh.vertices.insert(mesh.vertices.end(), cage.faceVertices.begin() + cage.faceStarts[f],
                                 cage.faceVertices.begin() + cage.faceStarts[f + 1]);
        }
        std::sort(mesh.vertices.begin(), mesh.vertices.end());
        mesh.vertices.erase(std::unique(mesh.vertices.begin(), mesh.vertices.end()), mesh.vertices.end());
        const auto free = std::stable_partition(mesh.vertices.begin(), mesh.vertices.end(),
                                                [&](uint32_t v) { return weights[v].index != k; });
        mesh.hangingCount = static_cast<uint32_t>(free - mesh.vertices.begin());
        for (uint32_t i = 0; i < mesh.vertices.size(); ++i) {
            places[mesh.vertices[i]] = i;
        }
        mesh.faceStarts.push_back(0);
        for (const uint32_t f : faces[k]) {
            for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
                mesh.faceVertices.push_back(places[cage.faceVertices[c]]);
            }
            mesh.faceStarts.push_back(static_cast<uint32_t>(mesh.faceVertices.size()));
        }
    }
    return meshes;
}

ClothPairs clothPairs(const ClothMesh& mesh) {
    std::set<Pair> edges, diagonals, bends;
    for (size_t f = 0; f < mesh.faceCount(); ++f) {
        const uint32_t first = mesh.faceStarts[f], sides = mesh.faceStarts[f + 1] - first;
        for (uint32_t k = 0; k < sides; ++k) {
            const auto other = [&](uint32_t n) { return mesh.faceVertices[first + (k + n) % sides]; };
            edges.insert(pairOf(other(0), other(1)));
            if (sides > 3) {
                diagonals.insert(pairOf(other(0), other(2)));
            }
        }
    }
    for (const Around& own : aroundVertices(mesh)) {
        addLines(own, bends);
    }
    addHinges(mesh, bends);
    ClothPairs pairs;
    std::set<Pair> known;
    const auto take = [&](const std::set<Pair>& from, std::vector<Pair>& into) {
        for (const Pair& pair : from) {
            if (pair[0] != pair[1] && pair[1] >= mesh.hangingCount && known.insert(pair).second) {
                into.push_back(pair);
            }
        }
    };
    take(edges, pairs.edges);
    take(diagonals, pairs.diagonals);
    take(bends, pairs.bends);
    return pairs;
}

} // namespace supple::skinning
