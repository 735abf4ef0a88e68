#include "cage/gltf_cage.h"

#include "cage/gltf_refusal.h"
#include "cage/polygons.h"
#include "cage/weld.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace supple::cage {
namespace {

/// Numbers the sets of vertices with equal position and skin; warns where only the position is equal.
std::vector<uint32_t> candidateSets(const GltfMesh& mesh, const std::vector<uint8_t>& used, Warnings& warnings) {
    std::vector<uint32_t> order;
    for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (used[v] != 0) {
            order.push_back(v);
        }
    }
    const auto comparePositions = [&](uint32_t a, uint32_t b) {
        // Finite floats: comparing values is comparing bits, but for -0 = 0.
        for (int k = 0; k < 3; ++k) {
            if (mesh.positions[a][k] != mesh.positions[b][k]) {
                return mesh.positions[a][k] < mesh.positions[b][k] ? -1 : 1;
            }
        }
        return 0;
    };
    const auto compareSkins = [&](uint32_t a, uint32_t b) {
        const auto x = mesh.weights.of(a);
        const auto y = mesh.weights.of(b);
        if (x.size() != y.size()) {
            return x.size() < y.size() ? -1 : 1;
        }
        for (size_t i = 0; i < x.size(); ++i) {
            if (x[i].joint != y[i].joint) {
                return x[i].joint < y[i].joint ? -1 : 1;
            }
            if (x[i].weight != y[i].weight) {
                return x[i].weight < y[i].weight ? -1 : 1;
            }
        }
        return 0;
    };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        const int byPosition = comparePositions(a, b);
        const int byBoth = byPosition != 0 ? byPosition : compareSkins(a, b);
        return byBoth != 0 ? byBoth < 0 : a < b;
    });
    std::vector<uint32_t> sets(mesh.positions.size(), 0);
    uint32_t set = 0;
    size_t cracks = 0;
    uint32_t crack[2] = {0, 0};
    for (size_t i = 0; i < order.size(); ++i) {
        if (i > 0) {
            const bool samePosition = comparePositions(order[i - 1], order[i]) == 0;
            const bool sameSkin = samePosition && compareSkins(order[i - 1], order[i]) == 0;
            if (!sameSkin) {
                ++set;
            }
            if (samePosition && !sameSkin && cracks++ == 0) {
                crack[0] = std::min(order[i - 1], order[i]);
                crack[1] = std::max(order[i - 1], order[i]);
            }
        }
        sets[order[i]] = set;
    }
    if (cracks > 0) {
        warn(warnings, mesh.element,
             counted(cracks, "vertex agrees", "vertices agree") +
                 " with another in position but not in skin (first: vertices " + std::to_string(crack[0]) + " and " +
                 std::to_string(crack[1]) + "); kept apart");
    }
    return sets;
}

Polygons recoverPolygons(const GltfMesh& mesh, const MeshPart& part, std::span<const uint32_t> welded, bool pairQuads) {
    if (part.ngonEncoded) {
        return decodeNgons(part.triangles, welded);
    }
    if (!pairQuads) {
        return keepTriangles(part.triangles, welded);
    }
    const auto same = [](const std::vector<float>& values, size_t width, size_t a, size_t b) {
        for (size_t k = 0; k < width && !values.empty(); ++k) {
            if (values[width * a + k] != values[width * b + k]) {
                return false;
            }
        }
        return true;
    };
    const auto sameCorner = [&](uint32_t a, uint32_t b) {
        return same(part.uvs, 2, a - part.firstVertex, b - part.firstVertex) &&
               same(part.colors, 4, a - part.firstVertex, b - part.firstVertex);
    };
    const auto normal = [&](const uint32_t* t) {
        const glm::dvec3 a(mesh.positions[t[0]]);
        return glm::cross(glm::dvec3(mesh.positions[t[1]]) - a, glm::dvec3(mesh.positions[t[2]]) - a);
    };
    const auto normalsAgree = [&](const uint32_t* a, const uint32_t* b) {
        return glm::dot(normal(a), normal(b)) > 0.0;
    };
    return pairTriangles(part.triangles, welded, sameCorner, normalsAgree);
}

/// The polygons of all parts, and the part each is of.
struct Faces {
    Polygons polygons;
    std::vector<size_t> parts;
};

Faces recoverFaces(const GltfMesh& mesh, const Welding& welding, bool pairQuads, Warnings& warnings) {
    Faces faces;
    for (size_t p = 0; p < mesh.parts.size(); ++p) {
        const MeshPart& part = mesh.parts[p];
        const Polygons own = recoverPolygons(mesh, part, welding.roots, pairQuads);
        if (own.degenerateTriangles > 0) {
            warn(warnings, part.element,
                 counted(own.degenerateTriangles, "triangle", "triangles") + " with a repeated vertex left out");
        }
        if (own.recutRuns > 0) {
            warn(warnings, part.element,
                 "FB_ngon_encoding: " + counted(own.recutRuns, "polygon closes", "polygons close") +
                     " on itself; cut into quads and triangles again");
        }
        for (size_t f = 0; f < own.faceCount(); ++f) {
            faces.polygons.vertices.insert(faces.polygons.vertices.end(), own.vertices.begin() + own.starts[f],
                                           own.vertices.begin() + own.starts[f + 1]);
            faces.polygons.close();
            faces.parts.push_back(p);
        }
    }
    return faces;
}

/// One part with polygons of its own names the source of all.
PolygonSource sourceOf(const std::vector<MeshPart>& parts, bool pairQuads) {
    if (std::any_of(parts.begin(), parts.end(), [](const MeshPart& part) { return part.ngonEncoded; })) {
        return PolygonSource::ngonEncoding;
    }
    return pairQuads ? PolygonSource::pairedTriangles : PolygonSource::triangles;
}

/// UVs and colours; parts without them count as 0 and white where others have them.
void fillCorners(const GltfMesh& mesh, const Faces& faces, Cage& cage) {
    const auto any = [&](auto member) {
        return std::any_of(mesh.parts.begin(), mesh.parts.end(),
                           [&](const MeshPart& part) { return !(part.*member).empty(); });
    };
    if (any(&MeshPart::uvs)) {
        cage.cornerUvs.assign(faces.polygons.vertices.size(), glm::vec2(0.0f));
    }
    if (any(&MeshPart::colors)) {
        cage.cornerColors.assign(faces.polygons.vertices.size(), glm::vec4(1.0f));
    }
    for (size_t f = 0; f < faces.parts.size(); ++f) {
        const MeshPart& part = mesh.parts[faces.parts[f]];
        for (uint32_t c = faces.polygons.starts[f]; c < faces.polygons.starts[f + 1]; ++c) {
            const size_t v = faces.polygons.vertices[c] - part.firstVertex;
            if (!part.uvs.empty()) {
                cage.cornerUvs[c] = {part.uvs[2 * v], part.uvs[2 * v + 1]};
            }
            if (!part.colors.empty()) {
                cage.cornerColors[c] = {part.colors[4 * v], part.colors[4 * v + 1], part.colors[4 * v + 2],
                                        part.colors[4 * v + 3]};
            }
        }
    }
}

void fillCage(const GltfMesh& mesh, const Faces& faces, const Welding& welding, Character& out) {
    Cage& cage = out.cage;
    std::vector<uint8_t> used(mesh.positions.size(), 0);
    for (const uint32_t v : faces.polygons.vertices) {
        used[v] = 1;
    }
    // A root is the smallest vertex of its set, but may itself have lost its faces to degenerate triangles.
    std::vector<uint32_t> cageVertex(mesh.positions.size(), kNone);
    uint32_t usedCount = 0;
    for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (used[v] == 0) {
            continue;
        }
        ++usedCount;
        uint32_t& index = cageVertex[welding.roots[v]];
        if (index != kNone) {
            continue;
        }
        index = cage.vertexCount();
        cage.positions.push_back(mesh.positions[v]);
        cage.sourceVertices.push_back(v);
    }
    out.seamVertexCount = usedCount - cage.vertexCount();

    cage.faceStarts = faces.polygons.starts;
    cage.faceVertices.reserve(faces.polygons.vertices.size());
    for (const uint32_t v : faces.polygons.vertices) {
        cage.faceVertices.push_back(cageVertex[welding.roots[v]]);
    }
    for (const size_t part : faces.parts) {
        cage.faceMaterials.push_back(mesh.parts[part].material < 0 ? kNone
                                                                   : static_cast<uint32_t>(mesh.parts[part].material));
    }
    fillCorners(mesh, faces, cage);

    out.weights.starts.push_back(0);
    for (const uint32_t v : cage.sourceVertices) {
        const auto own = mesh.weights.of(v);
        out.weights.influences.insert(out.weights.influences.end(), own.begin(), own.end());
        out.weights.starts.push_back(static_cast<uint32_t>(out.weights.influences.size()));
    }
}

} // namespace

void buildCage(const GltfMesh& mesh, const GltfOptions& options, Character& out) {
    std::vector<uint8_t> used(mesh.positions.size(), 0);
    std::vector<uint32_t> triangles;
    for (const MeshPart& part : mesh.parts) {
        for (const uint32_t v : part.triangles) {
            used[v] = 1;
        }
        triangles.insert(triangles.end(), part.triangles.begin(), part.triangles.end());
    }
    const auto unused = static_cast<size_t>(std::count(used.begin(), used.end(), uint8_t{0}));
    if (unused > 0) {
        warn(out.warnings, mesh.element, counted(unused, "vertex has", "vertices have") + " no triangle; left out");
    }

    Welding welding = weld(candidateSets(mesh, used, out.warnings), triangles);
    triangles.clear();

    const Faces faces = recoverFaces(mesh, welding, options.pairQuads, out.warnings);
    if (faces.polygons.faceCount() == 0) {
        refuse(mesh.element, "no triangle is left");
    }
    const uint32_t apart = unweldDefects(faces.polygons, welding);
    if (apart > 0) {
        warn(out.warnings, mesh.element,
             counted(apart, "welded vertex is", "welded vertices are") +
                 " taken apart again: faces do not fit together there");
    }

    out.polygonSource = sourceOf(mesh.parts, options.pairQuads);
    out.sourceVertexCount = static_cast<uint32_t>(mesh.positions.size());
    fillCage(mesh, faces, welding, out);
}

} // namespace supple::cage
