// Polygon recovery: the faces an artist drew, from the triangles a glTF file holds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace supple::cage {

/// Faces as packed corner lists: corners of face f are vertices[starts[f]] .. vertices[starts[f + 1] - 1].
struct Polygons {
    std::vector<uint32_t> starts{0};
    std::vector<uint32_t> vertices;
    /// One per face, or empty: the corner of a quad that the second of its two triangles alone has; 0: not known.
    std::vector<uint8_t> ears;
    uint32_t degenerateTriangles = 0; ///< dropped: two corners are one welded vertex
    uint32_t brokenRegions = 0;       ///< of hidden edges, left in triangles: no simple polygons
    uint32_t recutRuns = 0;           ///< runs of FB_ngon_encoding that closed on themselves and were cut again

    [[nodiscard]] size_t faceCount() const { return starts.size() - 1; }
    void close() { starts.push_back(static_cast<uint32_t>(vertices.size())); }
};

// `triangles` holds three glTF vertices each; `welded` maps a glTF vertex to its cage vertex. Faces come out in glTF
// vertices, so that every corner keeps its attributes. Triangles with a repeated welded vertex are dropped.

/// Every triangle a face.
[[nodiscard]] Polygons keepTriangles(std::span<const uint32_t> triangles, std::span<const uint32_t> welded);

/// FB_ngon_encoding (draft, KhronosGroup/glTF PR 1620): a polygon is a run of triangles with one first index, of which
/// the next polygon has another. Beyond the draft, because exporters get it wrong: a run also ends where a triangle's
/// second vertex is not its predecessor's third and at degenerate triangles; and a run whose polygon would repeat a
/// welded vertex is no polygon: the whole run is cut again, into quads of two triangles each where these are simple,
/// else into triangles.
[[nodiscard]] Polygons decodeNgons(std::span<const uint32_t> triangles, std::span<const uint32_t> welded);

/// Merges triangles across hidden edges: `hidden` holds three flags a triangle, of its edges v0v1, v1v2 and v2v0, and
/// an edge goes where it is hidden on both sides and no third triangle has it. What is merged must be a polygon: one
/// boundary that passes no vertex twice, and no vertex within; its corners are those of the triangles on the boundary.
[[nodiscard]] Polygons mergeAcrossHiddenEdges(std::span<const uint32_t> triangles, std::span<const uint32_t> welded,
                                              std::span<const uint8_t> hidden);

} // namespace supple::cage
