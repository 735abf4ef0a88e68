#include "cage/split/cage.h"

#include "cage/corner_normals.h"
#include "cage/polygons.h"
#include "cage/refusal.h"
#include "cage/split/creases.h"
#include "cage/split/weld_mesh.h"
#include "cage/triangle_pairs.h"
#include "cage/triangulation.h"

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace supple::cage::split {
namespace {

/// What a primitive's edges are sewn along: its own polygons where it lists them, else its triangles.
void addSewingFaces(const Primitive& primitive, Polygons& faces) {
    const auto add = [&](std::span<const uint32_t> vertices) {
        faces.vertices.insert(faces.vertices.end(), vertices.begin(), vertices.end());
        faces.close();
    };
    const Polygons& own = primitive.faces.polygons;
    for (size_t f = 0; f < own.faceCount(); ++f) {
        add(std::span(own.vertices).subspan(own.starts[f], own.starts[f + 1] - own.starts[f]));
    }
    for (size_t t = 0; own.faceCount() == 0 && t < primitive.triangles.size(); t += 3) {
        add(std::span(primitive.triangles).subspan(t, 3));
    }
}

/// From this squareness on, per two triangles, a mesh is taken for one that was drawn in quads. Measured: meshes drawn
/// in quads alone have 0.72 to 0.97, with triangles among them 0.57 to 0.8. Decimated to a half they have 0.48 to 0.64
/// (one, whose even quads were left whole, 0.67), to a fifth 0.29 to 0.63. Fox.glb has 0.50, an icosphere 0.53;
/// equilateral triangles have 0.67 at most, if all of them pair.
constexpr double kCleanSquareness = 0.65;

/// A quad has one normal where its triangles had two: without being asked, no normal may turn by more than 0.03
/// degrees.
constexpr float kSameNormal = 5e-4f;

bool hasPlainTriangles(const Primitive& primitive) {
    return primitive.faces.source == PolygonSource::triangles;
}

PairedTriangles pairPrimitive(const Mesh& mesh, const Primitive& primitive, std::span<const uint32_t> welded,
                              PairShape shape, std::vector<uint32_t>& spare) {
    const auto same = [](const auto& values, size_t width, size_t a, size_t b) {
        for (size_t k = 0; k < width && !values.empty(); ++k) {
            if (values[width * a + k] != values[width * b + k]) {
                return false;
            }
        }
        return true;
    };
    const auto sameNormal = [&](size_t a, size_t b) {
        if (primitive.normals.empty() || shape != PairShape::clean) {
            return primitive.normals.empty() || normalsAgree(primitive.normals[a], primitive.normals[b]);
        }
        return glm::length(primitive.normals[a] - primitive.normals[b]) <= kSameNormal;
    };
    const auto sameCorner = [&](uint32_t first, uint32_t second) {
        const size_t a = first - primitive.firstVertex;
        const size_t b = second - primitive.firstVertex;
        return same(primitive.uvs, 2, a, b) && same(primitive.uvs1, 2, a, b) && same(primitive.colors, 4, a, b) &&
               same(primitive.trimTiles, 1, a, b) && sameNormal(a, b);
    };
    return pairTriangles(primitive.triangles, welded, mesh.positions, sameCorner, shape, spare);
}

/// The paired triangles of each primitive that has nothing else; empty if they are not to be paired.
std::vector<PairedTriangles> pairMesh(const Mesh& mesh, std::span<const uint32_t> welded, Pairing pairing) {
    if (pairing == Pairing::never || std::none_of(mesh.primitives.begin(), mesh.primitives.end(), hasPlainTriangles)) {
        return {};
    }
    std::vector<uint32_t> all;
    for (const Primitive& primitive : mesh.primitives) {
        all.insert(all.end(), primitive.triangles.begin(), primitive.triangles.end());
    }
    std::vector<uint32_t> spare = spareEdges(all, welded);
    std::vector<PairedTriangles> paired(mesh.primitives.size());
    size_t triangles = 0;
    size_t quads = 0;
    double squareness = 0.0;
    for (size_t p = 0; p < mesh.primitives.size(); ++p) {
        if (hasPlainTriangles(mesh.primitives[p])) {
            const PairShape shape = pairing == Pairing::always ? PairShape::unfolded : PairShape::clean;
            paired[p] = pairPrimitive(mesh, mesh.primitives[p], welded, shape, spare);
            triangles += paired[p].polygons.faceCount() + paired[p].quads;
            quads += paired[p].quads;
            squareness += paired[p].squareness;
        }
    }
    if (pairing == Pairing::always) {
        return paired;
    }
    if (quads == 0 || 2.0 * squareness < kCleanSquareness * static_cast<double>(triangles)) {
        return {};
    }
    return paired;
}

Polygons recoverPolygons(const Primitive& primitive, std::span<const uint32_t> welded) {
    switch (primitive.faces.source) {
    case PolygonSource::cageExtension:
    case PolygonSource::meshPolygon:
        return primitive.faces.polygons;
    case PolygonSource::ngonEncoding:
        return decodeNgons(primitive.triangles, welded);
    case PolygonSource::hiddenEdges:
        return mergeAcrossHiddenEdges(primitive.triangles, welded, primitive.faces.hidden);
    default:
        return keepTriangles(primitive.triangles, welded);
    }
}

/// The polygons of all primitives, and the primitive each is of.
struct Faces {
    Polygons polygons;
    std::vector<size_t> primitives;
    std::vector<uint32_t> holes;
    PolygonSource source = PolygonSource::triangles; ///< one primitive with polygons of its own names the source of all
};

Faces recoverFaces(const Mesh& mesh, const Welding& welding, Pairing pairing, Warnings& warnings,
                   std::vector<Damage>& damages) {
    std::vector<PairedTriangles> paired = pairMesh(mesh, welding.roots, pairing);
    Faces faces;
    for (size_t p = 0; p < mesh.primitives.size(); ++p) {
        const Primitive& primitive = mesh.primitives[p];
        const bool isPaired = !paired.empty() && hasPlainTriangles(primitive);
        const Polygons own = isPaired ? std::move(paired[p].polygons) : recoverPolygons(primitive, welding.roots);
        faces.source = std::min(faces.source, isPaired ? PolygonSource::pairedTriangles : primitive.faces.source);
        if (own.degenerateTriangles > 0) {
            damages.push_back({primitive.element + ": " + counted(own.degenerateTriangles, "triangle", "triangles") +
                                   " with a repeated vertex",
                               "left out"});
        }
        if (own.recutRuns > 0) {
            warn(warnings, primitive.element,
                 "FB_ngon_encoding: " + counted(own.recutRuns, "polygon closes", "polygons close") +
                     " on itself; cut into quads and triangles again");
        }
        if (own.brokenRegions > 0) {
            warn(warnings, primitive.element,
                 "EXT_mesh_primitive_edge_visibility: " +
                     counted(own.brokenRegions, "region of hidden edges is", "regions of hidden edges are") +
                     " no simple polygon; left in triangles");
        }
        for (const uint32_t hole : primitive.faces.holes) {
            faces.holes.push_back(static_cast<uint32_t>(faces.primitives.size()) + hole);
        }
        for (size_t f = 0; f < own.faceCount(); ++f) {
            faces.polygons.vertices.insert(faces.polygons.vertices.end(), own.vertices.begin() + own.starts[f],
                                           own.vertices.begin() + own.starts[f + 1]);
            faces.polygons.close();
            faces.polygons.ears.push_back(own.ears.empty() ? uint8_t{0} : own.ears[f]);
            faces.primitives.push_back(p);
        }
    }
    return faces;
}

/// UVs and colors; primitives without them count as 0 and white where others have them.
void fillCorners(const Mesh& mesh, const Faces& faces, Cage& cage) {
    const auto any = [&](auto member) {
        return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                           [&](const Primitive& primitive) { return !(primitive.*member).empty(); });
    };
    if (any(&Primitive::uvs)) {
        cage.cornerUvs.assign(faces.polygons.vertices.size(), glm::vec2(0.0f));
    }
    if (any(&Primitive::uvs1)) {
        cage.cornerUvs1.assign(faces.polygons.vertices.size(), glm::vec2(0.0f));
    }
    if (any(&Primitive::colors)) {
        cage.cornerColors.assign(faces.polygons.vertices.size(), glm::vec4(1.0f));
    }
    for (size_t f = 0; f < faces.primitives.size(); ++f) {
        const Primitive& primitive = mesh.primitives[faces.primitives[f]];
        for (uint32_t c = faces.polygons.starts[f]; c < faces.polygons.starts[f + 1]; ++c) {
            const size_t v = faces.polygons.vertices[c] - primitive.firstVertex;
            if (!primitive.uvs.empty()) {
                cage.cornerUvs[c] = {primitive.uvs[2 * v], primitive.uvs[2 * v + 1]};
            }
            if (!primitive.uvs1.empty()) {
                cage.cornerUvs1[c] = {primitive.uvs1[2 * v], primitive.uvs1[2 * v + 1]};
            }
            if (!primitive.colors.empty()) {
                cage.cornerColors[c] = {primitive.colors[4 * v], primitive.colors[4 * v + 1],
                                        primitive.colors[4 * v + 2], primitive.colors[4 * v + 3]};
            }
        }
    }
}

/// What the primitives have per vertex, per corner of the cage; `none` where a primitive does not have it.
template <class Vec>
std::vector<Vec> perCorner(const Mesh& mesh, const Faces& faces, std::vector<Vec> Primitive::*values, const Vec& none) {
    std::vector<Vec> corners(faces.polygons.vertices.size(), none);
    for (size_t f = 0; f < faces.primitives.size(); ++f) {
        const Primitive& primitive = mesh.primitives[faces.primitives[f]];
        const std::vector<Vec>& own = primitive.*values;
        for (uint32_t c = faces.polygons.starts[f]; c < faces.polygons.starts[f + 1] && !own.empty(); ++c) {
            corners[c] = own[faces.polygons.vertices[c] - primitive.firstVertex];
        }
    }
    return corners;
}

/// A primitive without normals has none of its own, and is flat as glTF says, unless it lists polygons and no primitive
/// has normals: then what smooths a cage smooths it.
void fillShading(const Mesh& mesh, const Faces& faces, Cage& cage) {
    const auto all = [&](auto test) { return std::all_of(mesh.primitives.begin(), mesh.primitives.end(), test); };
    const bool polygonsAlone = all([](const Primitive& primitive) {
        return primitive.normals.empty() && primitive.faces.polygons.faceCount() > 0;
    });
    if (!polygonsAlone) {
        cage.cornerNormals = perCorner(mesh, faces, &Primitive::normals, glm::vec3(0.0f));
    }
    if (!all([](const Primitive& primitive) { return primitive.tangents.empty(); })) {
        cage.cornerTangents = perCorner(mesh, faces, &Primitive::tangents, glm::vec4(0.0f));
    }
}

/// How the file's triangles cut faces of more than three sides. Where they do not fit the face, ears are clipped. Where
/// the file lists polygons, its triangles are for other viewers: fans, often, which fold over concave faces.
void fillTriangles(const Mesh& mesh, const Faces& faces, const Welding& welding, Cage& cage) {
    if (cage.cornerCount() == 3 * cage.faceCount()) {
        return;
    }
    std::vector<uint32_t> triangles;
    std::vector<glm::vec3> corners;
    std::optional<FileTriangles> known;
    for (size_t f = 0; f < faces.primitives.size(); ++f) {
        const Primitive& primitive = mesh.primitives[faces.primitives[f]];
        if (f == 0 || faces.primitives[f] != faces.primitives[f - 1]) {
            known.emplace(primitive.triangles, welding.roots);
        }
        const uint32_t start = faces.polygons.starts[f];
        const auto polygon = std::span(faces.polygons.vertices).subspan(start, faces.polygons.starts[f + 1] - start);
        corners.clear();
        for (const uint32_t v : polygon) {
            corners.push_back(mesh.positions[v]);
        }
        const size_t first = triangles.size();
        if (const uint32_t ear = faces.polygons.ears[f]; ear != 0) {
            const uint32_t next = (ear + 1) % 4, opposite = (ear + 2) % 4;
            triangles.insert(triangles.end(), {ear - 1, next, opposite, ear - 1, ear, next});
        }
        const bool fits = triangles.size() == first && polygon.size() > 3 && known->cut(polygon, triangles);
        if (fits && primitive.faces.polygons.faceCount() > 0 &&
            foldsOver(corners, std::span(triangles).subspan(first))) {
            triangles.resize(first);
        }
        if (triangles.size() == first) {
            clipEars(corners, triangles);
        }
        for (size_t i = first; i < triangles.size(); ++i) {
            triangles[i] += start;
        }
    }
    cage.faceTriangles = std::move(triangles);
}

/// Finds the faces that have a primitive's triangles.
class TriangleFinder {
public:
    TriangleFinder(const Faces& faces, size_t primitive, const Welding& welding) : welding_(welding) {
        const auto [first, end] = std::equal_range(faces.primitives.begin(), faces.primitives.end(), primitive);
        const auto numberOf = [&](auto place) { return static_cast<uint32_t>(place - faces.primitives.begin()); };
        for (uint32_t f = numberOf(first); f < numberOf(end); ++f) {
            for (uint32_t c = faces.polygons.starts[f]; c < faces.polygons.starts[f + 1]; ++c) {
                corners_.push_back({welding.roots[faces.polygons.vertices[c]], f, c});
            }
        }
        std::sort(corners_.begin(), corners_.end());
    }

    /// The triangle's corners on the first face that has all three, one behind the other.
    [[nodiscard]] std::array<uint32_t, 3> find(std::span<const uint32_t, 3> triangle) const {
        size_t rarest = 0;
        std::array<std::span<const Corner>, 3> at;
        for (size_t k = 0; k < 3; ++k) {
            at[k] = cornersAt(welding_.roots[triangle[k]]);
            rarest = at[k].size() < at[rarest].size() ? k : rarest;
        }
        for (const Corner& corner : at[rarest].first(std::min(at[rarest].size(), kMostFaces))) {
            std::array<uint32_t, 3> found{};
            found[rarest] = corner.corner;
            found[(rarest + 1) % 3] = cornerOf(corner.face, welding_.roots[triangle[(rarest + 1) % 3]]);
            found[(rarest + 2) % 3] = cornerOf(corner.face, welding_.roots[triangle[(rarest + 2) % 3]]);
            if (isTurnedAlike(found)) {
                return found;
            }
        }
        return {kNone, kNone, kNone};
    }

private:
    /// Whether all corners of a triangle are of more faces than these: then it may not be found. So the work is bound.
    static constexpr size_t kMostFaces = 64;
    struct Corner {
        uint32_t root = 0, face = 0, corner = 0;
        auto operator<=>(const Corner&) const = default; // NOLINT(modernize-use-nullptr): clang-tidy 14 sees a 0 here
    };
    [[nodiscard]] std::span<const Corner> cornersAt(uint32_t root) const {
        const auto first = std::lower_bound(corners_.begin(), corners_.end(), Corner{root, 0, 0});
        const auto end = std::lower_bound(first, corners_.end(), Corner{root + 1, 0, 0});
        return {first, end};
    }
    [[nodiscard]] uint32_t cornerOf(uint32_t face, uint32_t root) const {
        const std::span<const Corner> at = cornersAt(root);
        const auto found = std::lower_bound(at.begin(), at.end(), Corner{root, face, 0});
        return found != at.end() && found->face == face ? found->corner : kNone;
    }
    [[nodiscard]] static bool isTurnedAlike(const std::array<uint32_t, 3>& c) {
        const int rises = (c[0] < c[1] ? 1 : 0) + (c[1] < c[2] ? 1 : 0) + (c[2] < c[0] ? 1 : 0);
        return c[0] != kNone && c[1] != kNone && c[2] != kNone && rises == 2;
    }

    const Welding& welding_;
    std::vector<Corner> corners_;
};

/// Where the triangles of a file lie in the cage's faces.
void fillSourceTriangles(const Mesh& mesh, const Faces& faces, const Welding& welding, Cage& cage) {
    for (size_t p = 0; p < mesh.primitives.size() && mesh.number; ++p) {
        const Primitive& primitive = mesh.primitives[p];
        cage.sourcePrimitives.push_back(
            {*mesh.number, primitive.number, static_cast<uint32_t>(cage.sourceTriangles.size() / 3)});
        const TriangleFinder finder(faces, p, welding);
        for (size_t i = 0; i + 2 < primitive.triangles.size(); i += 3) {
            const auto found = finder.find(std::span<const uint32_t, 3>(&primitive.triangles[i], 3));
            cage.sourceTriangles.insert(cage.sourceTriangles.end(), found.begin(), found.end());
        }
    }
}

/// A face's corners name one tile.
void fillTrimTiles(const Mesh& mesh, const Faces& faces, Cage& cage) {
    if (std::all_of(mesh.primitives.begin(), mesh.primitives.end(),
                    [](const Primitive& p) { return p.trimTiles.empty(); })) {
        return;
    }
    cage.faceTrimTiles.assign(faces.primitives.size(), kNone);
    for (size_t f = 0; f < faces.primitives.size(); ++f) {
        const Primitive& primitive = mesh.primitives[faces.primitives[f]];
        if (primitive.trimTiles.empty()) {
            continue;
        }
        const auto tileAt = [&](uint32_t corner) {
            return primitive.trimTiles[faces.polygons.vertices[corner] - primitive.firstVertex];
        };
        const uint32_t first = faces.polygons.starts[f];
        for (uint32_t c = first + 1; c < faces.polygons.starts[f + 1]; ++c) {
            if (tileAt(c) != tileAt(first)) {
                const auto name = [](uint32_t tile) { return tile == kNone ? "-1" : std::to_string(tile); };
                refuse(primitive.element + " _TRIM_TILE", "the vertices of face " + std::to_string(f) + " name tiles " +
                                                              name(tileAt(first)) + " and " + name(tileAt(c)));
            }
        }
        cage.faceTrimTiles[f] = tileAt(first);
    }
}

/// The skin and the displacements of the cage's vertices.
void fillMotion(const Mesh& mesh, PartCage& out) {
    out.weights.starts.push_back(0);
    for (uint32_t i = 0; i < out.cage.vertexCount(); ++i) {
        const auto own = mesh.weights.of(out.cage.sourceVertices[i]);
        out.weights.influences.insert(out.weights.influences.end(), own.begin(), own.end());
        out.weights.starts.push_back(static_cast<uint32_t>(out.weights.influences.size()));
        for (const MorphDelta& displacement : mesh.morphs.of(out.cage.sourceVertices[i])) {
            MorphTarget& target = out.morphs.targets[displacement.target];
            target.vertices.push_back(i);
            target.deltas.push_back(displacement.delta);
        }
        appendPainted(mesh.painted, out.cage.sourceVertices[i], out.weights);
    }
    out.jiggles = mesh.jiggles;
    out.cloths = mesh.cloths;
}

/// Returns the cage vertex of each of the mesh's vertices, kNone for those without a face.
std::vector<uint32_t> fillCage(const Mesh& mesh, const Faces& faces, const Welding& welding, Leniency& leniency,
                               PartCage& out) {
    Cage& cage = out.cage;
    std::vector<uint8_t> used(mesh.positions.size(), 0);
    for (const uint32_t v : faces.polygons.vertices) {
        used[v] = 1;
    }
    // A root is the smallest vertex of its set, but may itself have lost its faces to degenerate triangles.
    std::vector<uint32_t> ofRoot(mesh.positions.size(), kNone);
    uint32_t usedCount = 0;
    for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
        usedCount += used[v];
        if (used[v] != 0 && ofRoot[welding.roots[v]] == kNone) {
            ofRoot[welding.roots[v]] = v;
            cage.sourceVertices.push_back(v);
        }
    }
    // The file's own numbers keep their order.
    if (!mesh.cageNumbers.empty()) {
        std::sort(cage.sourceVertices.begin(), cage.sourceVertices.end(),
                  [&](uint32_t a, uint32_t b) { return mesh.cageNumbers[a] < mesh.cageNumbers[b]; });
    }
    for (const uint32_t v : cage.sourceVertices) {
        ofRoot[welding.roots[v]] = cage.vertexCount();
        cage.positions.push_back(mesh.positions[v]);
    }
    out.seamVertexCount = usedCount - cage.vertexCount();

    cage.faceStarts = faces.polygons.starts;
    cage.faceVertices.reserve(faces.polygons.vertices.size());
    for (const uint32_t v : faces.polygons.vertices) {
        cage.faceVertices.push_back(ofRoot[welding.roots[v]]);
    }
    for (const size_t primitive : faces.primitives) {
        cage.faceMaterials.push_back(mesh.primitives[primitive].material < 0
                                         ? kNone
                                         : static_cast<uint32_t>(mesh.primitives[primitive].material));
    }
    cage.holes = faces.holes;
    fillCorners(mesh, faces, cage);
    fillShading(mesh, faces, cage);
    fillTriangles(mesh, faces, welding, cage);
    fillSourceTriangles(mesh, faces, welding, cage);
    leniency.gather([&] { fillTrimTiles(mesh, faces, cage); });

    fillMotion(mesh, out);

    std::vector<uint32_t> cageVertices(mesh.positions.size());
    for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
        cageVertices[v] = ofRoot[welding.roots[v]];
    }
    return cageVertices;
}

/// The vertices of one face. They lie on the border.
void addRoundCorners(Cage& cage) {
    std::vector<uint32_t> faces(cage.vertexCount(), 0);
    for (const uint32_t v : cage.faceVertices) {
        ++faces[v];
    }
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        if (faces[v] == 1) {
            cage.roundCorners.push_back(v);
        }
    }
}

} // namespace

void buildCage(const Mesh& mesh, Pairing pairing, PartCage& out, Leniency& leniency, Warnings& warnings) {
    Polygons sewn;
    for (const Primitive& primitive : mesh.primitives) {
        addSewingFaces(primitive, sewn);
    }
    std::vector<uint8_t> used(mesh.positions.size(), 0);
    for (const uint32_t v : sewn.vertices) {
        used[v] = 1;
    }
    const auto unused = static_cast<size_t>(std::count(used.begin(), used.end(), uint8_t{0}));
    if (unused > 0) {
        warn(warnings, mesh.element, counted(unused, "vertex has", "vertices have") + " no face; left out");
    }

    MeshWelding welded = weldMesh(mesh, sewn, warnings);
    Welding& welding = welded.welding;
    const Faces faces = recoverFaces(mesh, welding, pairing, warnings, out.damages);
    if (faces.polygons.faceCount() == 0) {
        return;
    }
    // What the file merges itself is the file's business.
    const uint32_t apart = welded.source == WeldSource::equality ? unweldDefects(faces.polygons, welding) : 0;
    if (apart > 0) {
        warn(warnings, mesh.element,
             counted(apart, "welded vertex is", "welded vertices are") +
                 " taken apart again: faces do not fit together there");
    }

    joinSeams(mesh, faces.polygons, welded, warnings, out.damages);

    out.part.polygonSource = faces.source;
    out.part.weldSource = welded.source;
    out.part.skinning = mesh.skinning;
    out.part.smoothing = mesh.smoothing;
    for (const Primitive& primitive : mesh.primitives) { // the first that says anything
        out.part.uvMode = out.part.uvMode ? out.part.uvMode : primitive.uvMode;
        out.part.madeFor = out.part.madeFor ? out.part.madeFor : primitive.madeFor;
    }
    out.sourceVertexCount = static_cast<uint32_t>(mesh.positions.size());
    addCreases(mesh, fillCage(mesh, faces, welding, leniency, out), out.cage, leniency, warnings);
    if (std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                    [](const Primitive& primitive) { return primitive.roundCorners; })) {
        addRoundCorners(out.cage);
    }
}

} // namespace supple::cage::split

namespace supple::cage {

void warnOfPairs(const std::vector<PartCage>& parts, Warnings& warnings) {
    size_t paired = 0;
    size_t quads = 0;
    size_t triangles = 0;
    for (const PartCage& part : parts) {
        if (part.part.polygonSource == PolygonSource::pairedTriangles) {
            ++paired;
            for (uint32_t face = 0; face < part.cage.faceCount(); ++face) {
                ++(part.cage.sides(face) == 3 ? triangles : quads);
            }
        }
    }
    if (paired > 0) {
        warn(warnings, "file",
             "triangles of " + std::to_string(paired) + " of " + counted(parts.size(), "part", "parts") +
                 " paired into " + counted(quads, "quad", "quads") + ", " + std::to_string(triangles) + " left");
    }
}

} // namespace supple::cage
