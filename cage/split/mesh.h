// A mesh with split vertices, as files and vertex buffers have it: vertices, triangles, attributes; nothing welded. The
// readers of glTF and of the host's arrays make it.
#pragma once

#include "cage/character.h"
#include "cage/entry_faults.h"
#include "cage/polygons.h"
#include "cage/split/vertex_morphs.h"
#include "cage/vertex_weights.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace supple::cage::split {

/// What a primitive says of its polygons.
struct PolygonData {
    PolygonSource source = PolygonSource::triangles; ///< the first that the primitive has
    Polygons polygons;           ///< of cageExtension and meshPolygon; nothing else is needed of these
    std::vector<uint32_t> holes; ///< rising faces of `polygons`
    std::vector<uint8_t> hidden; ///< of hiddenEdges: per triangle and edge v0v1, v1v2, v2v0, 1 where it is hidden
};

/// Creases or corners as a primitive lists them: two vertices or one, and a sharpness, each.
struct SharpList {
    std::string element;            ///< of the vertices
    std::vector<uint32_t> vertices; ///< cage numbers where the mesh has them, else the primitive's vertices
    std::vector<float> sharpnesses;
};

/// Some of a primitive's creases under a name.
struct CreaseSet {
    std::string name;
    std::vector<uint32_t> creases; ///< places in the primitive's list
};

/// One primitive.
struct Primitive {
    std::string element;
    uint32_t number = 0; ///< within the file's mesh
    int material = -1;
    PolygonData faces;        ///< vertices counted as in `triangles`
    uint32_t firstVertex = 0; ///< of its own among all vertices of the mesh
    uint32_t vertexCount = 0;
    std::vector<uint32_t> triangles; ///< three vertices each, counted over all primitives
    std::vector<float> uvs;          ///< two per vertex, or empty
    std::vector<float> uvs1;         ///< two per vertex, or empty
    std::vector<float> colors;       ///< four per vertex, or empty
    std::vector<glm::vec3> normals;  ///< one per vertex, or empty; zero: none
    std::vector<glm::vec4> tangents; ///< one per vertex, or empty; zero: none
    std::vector<uint32_t> trimTiles; ///< per vertex: kNone for no tile; or empty
    std::optional<SharpList> creases, corners;
    std::vector<CreaseSet> creaseSets; ///< a crease is in one at most
    std::optional<SharpList> scalars;  ///< vertex and the other end of the edge; alphas instead of sharpnesses
    bool roundCorners = false;         ///< vertices that have one face round the boundary off
    std::optional<UvMode> uvMode;
    std::optional<MadeFor> madeFor;
};

/// Creases or corners that a mesh lists beside its primitives, by vertices of the mesh: nothing in them is an error.
struct LooseSharpList {
    struct Entry {
        size_t index = 0; ///< in the list
        uint32_t vertices[2] = {0, 0};
        float sharpness = 0.0f;
    };
    size_t vertexCount = 1; ///< of an entry: 2 for creases
    std::vector<Entry> entries;
    EntryFaults faults; ///< of the entries that are left out already
};

/// Primitives over the same data share their vertices.
struct Mesh {
    std::string element;
    std::optional<uint32_t> number; ///< of a glTF file: its triangles are remembered
    std::vector<glm::vec3> positions;
    float gridStep = 0.0f; ///< of the coarsest grid that positions were rounded to; 0: none
    VertexWeights weights;
    VertexMorphs morphs;
    std::vector<Jiggle> jiggles;
    std::vector<Cloth> cloths;         ///< with colliders by the numbers of the file
    SkinWeights painted;               ///< per vertex; without influences
    std::vector<uint32_t> cageNumbers; ///< per vertex, where the source numbers cage vertices; else empty
    WeldSource numberSource = WeldSource::cageExtension; ///< of cageNumbers
    /// Vertices that are one, where the source lists these pairs and no cage numbers (WeldSource::meshManifold).
    std::optional<std::vector<std::pair<uint32_t, uint32_t>>> merges;
    std::vector<Primitive> primitives; ///< at least one
    std::optional<LooseSharpList> creases, corners;
    std::optional<SkinningMode> skinning;
    std::optional<Smoothing> smoothing;
};

} // namespace supple::cage::split
