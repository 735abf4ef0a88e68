#include "cage/gltf_cage.h"

#include "cage/gltf_creases.h"
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

/// Vertices in one place that something keeps apart.
struct Cracks {
    size_t count = 0;
    uint32_t first[2] = {0, 0};

    void add(uint32_t a, uint32_t b) {
        if (count++ == 0) {
            first[0] = std::min(a, b);
            first[1] = std::max(a, b);
        }
    }
    void report(const std::string& what, const std::string& element, Warnings& warnings) const {
        if (count > 0) {
            warn(warnings, element,
                 counted(count, "vertex agrees", "vertices agree") + " with another in position but not in " + what +
                     " (first: vertices " + std::to_string(first[0]) + " and " + std::to_string(first[1]) +
                     "); kept apart");
        }
    }
};

/// Numbers the sets of vertices with equal position, skin and morphs; warns where only the position is equal.
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
    const auto compareMorphs = [&](uint32_t a, uint32_t b) {
        const auto x = mesh.morphs.of(a);
        const auto y = mesh.morphs.of(b);
        if (x.size() != y.size()) {
            return x.size() < y.size() ? -1 : 1;
        }
        for (size_t i = 0; i < x.size(); ++i) {
            if (x[i].target != y[i].target) {
                return x[i].target < y[i].target ? -1 : 1;
            }
            for (int k = 0; k < 3; ++k) {
                if (x[i].delta[k] != y[i].delta[k]) {
                    return x[i].delta[k] < y[i].delta[k] ? -1 : 1;
                }
            }
        }
        return 0;
    };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        int by = comparePositions(a, b);
        by = by != 0 ? by : compareSkins(a, b);
        by = by != 0 ? by : compareMorphs(a, b);
        return by != 0 ? by < 0 : a < b;
    });
    std::vector<uint32_t> sets(mesh.positions.size(), 0);
    uint32_t set = 0;
    Cracks skinCracks;
    Cracks morphCracks;
    for (size_t i = 0; i < order.size(); ++i) {
        if (i > 0) {
            const uint32_t a = order[i - 1];
            const uint32_t b = order[i];
            const bool samePosition = comparePositions(a, b) == 0;
            const bool sameSkin = samePosition && compareSkins(a, b) == 0;
            const bool same = sameSkin && compareMorphs(a, b) == 0;
            set += same ? 0 : 1;
            if (samePosition && !same) {
                (sameSkin ? morphCracks : skinCracks).add(a, b);
            }
        }
        sets[order[i]] = set;
    }
    skinCracks.report("skin", mesh.element, warnings);
    morphCracks.report("morph targets", mesh.element, warnings);
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
               same(part.uvs1, 2, a - part.firstVertex, b - part.firstVertex) &&
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
    if (any(&MeshPart::uvs1)) {
        cage.cornerUvs1.assign(faces.polygons.vertices.size(), glm::vec2(0.0f));
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
            if (!part.uvs1.empty()) {
                cage.cornerUvs1[c] = {part.uvs1[2 * v], part.uvs1[2 * v + 1]};
            }
            if (!part.colors.empty()) {
                cage.cornerColors[c] = {part.colors[4 * v], part.colors[4 * v + 1], part.colors[4 * v + 2],
                                        part.colors[4 * v + 3]};
            }
        }
    }
}

/// Returns the cage vertex of each of the mesh's vertices, kNone for those without a face.
std::vector<uint32_t> fillCage(const GltfMesh& mesh, const Faces& faces, const Welding& welding, Character& out) {
    Cage& cage = out.cage;
    std::vector<uint8_t> used(mesh.positions.size(), 0);
    for (const uint32_t v : faces.polygons.vertices) {
        used[v] = 1;
    }
    // A root is the smallest vertex of its set, but may itself have lost its faces to degenerate triangles.
    std::vector<uint32_t> ofRoot(mesh.positions.size(), kNone);
    uint32_t usedCount = 0;
    for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
        if (used[v] == 0) {
            continue;
        }
        ++usedCount;
        uint32_t& index = ofRoot[welding.roots[v]];
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
        cage.faceVertices.push_back(ofRoot[welding.roots[v]]);
    }
    for (const size_t part : faces.parts) {
        cage.faceMaterials.push_back(mesh.parts[part].material < 0 ? kNone
                                                                   : static_cast<uint32_t>(mesh.parts[part].material));
    }
    fillCorners(mesh, faces, cage);

    out.weights.starts.push_back(0);
    for (uint32_t i = 0; i < cage.vertexCount(); ++i) {
        const auto own = mesh.weights.of(cage.sourceVertices[i]);
        out.weights.influences.insert(out.weights.influences.end(), own.begin(), own.end());
        out.weights.starts.push_back(static_cast<uint32_t>(out.weights.influences.size()));
        for (const MorphDelta& displacement : mesh.morphs.of(cage.sourceVertices[i])) {
            MorphTarget& target = out.morphs.targets[displacement.target];
            target.vertices.push_back(i);
            target.deltas.push_back(displacement.delta);
        }
    }

    std::vector<uint32_t> cageVertices(mesh.positions.size());
    for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
        cageVertices[v] = ofRoot[welding.roots[v]];
    }
    return cageVertices;
}

} // namespace

void buildCage(const GltfDocument& document, const GltfMesh& mesh, const GltfOptions& options, Character& out) {
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
    readCreases(document, mesh, fillCage(mesh, faces, welding, out), out.cage, out.warnings);
}

} // namespace supple::cage
