// The faces of a cage while it is repaired. Private to cage/repair.
#pragma once

#include "cage/character.h"
#include "cage/message.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace supple::cage::repair {

/// Corners keep the number that they had in the given cage, so that their attributes can be found at the end.
struct Draft {
    std::vector<uint32_t> starts{0}; ///< corners of face f: starts[f] .. starts[f + 1] - 1
    std::vector<uint32_t> vertices;  ///< per corner
    std::vector<uint32_t> corners;   ///< per corner: the given cage's corner that it was
    std::vector<uint32_t> faces;     ///< per face: the given cage's face that it is, or is a part of
    std::vector<uint32_t> sources;   ///< per vertex: the given cage's vertex; those behind the given ones are copies
    std::vector<Crease> creases;     ///< further ones, between given vertices
    std::vector<SharpVertex> sharpVertices; ///< further ones, given vertices

    [[nodiscard]] uint32_t faceCount() const { return static_cast<uint32_t>(faces.size()); }
    [[nodiscard]] uint32_t cornerCount() const { return static_cast<uint32_t>(corners.size()); }
    [[nodiscard]] uint32_t vertexCount() const { return static_cast<uint32_t>(sources.size()); }
    [[nodiscard]] uint32_t sides(uint32_t face) const { return starts[face + 1] - starts[face]; }
    [[nodiscard]] uint32_t next(uint32_t face, uint32_t corner) const {
        return corner + 1 == starts[face + 1] ? starts[face] : corner + 1;
    }
    [[nodiscard]] uint32_t previous(uint32_t face, uint32_t corner) const {
        return corner == starts[face] ? starts[face + 1] - 1 : corner - 1;
    }

    void addCorner(uint32_t vertex, uint32_t corner) {
        vertices.push_back(vertex);
        corners.push_back(corner);
    }
    void closeFace(uint32_t face) {
        starts.push_back(cornerCount());
        faces.push_back(face);
    }
    /// One more vertex where `vertex` is.
    uint32_t copyVertex(uint32_t vertex) {
        sources.push_back(sources[vertex]);
        return vertexCount() - 1;
    }
};

/// The face of every corner.
[[nodiscard]] std::vector<uint32_t> cornerFaces(const Draft& draft);

/// Every vertex's corners, packed by start index; those of one vertex rise.
struct VertexCorners {
    std::vector<uint32_t> starts;
    std::vector<uint32_t> corners;

    [[nodiscard]] uint32_t count(uint32_t vertex) const { return starts[vertex + 1] - starts[vertex]; }
};
[[nodiscard]] VertexCorners vertexCorners(const Draft& draft);

/// A side of a face, seen from the smaller of its two vertices. It belongs to the corner that it begins at.
struct Side {
    uint32_t low = 0;
    uint32_t high = 0;
    uint32_t corner = 0;
    uint32_t face = 0;
    bool forward = false; ///< runs from low to high

    [[nodiscard]] bool sameEdge(const Side& other) const { return low == other.low && high == other.high; }
};
/// All sides, edge by edge; those of one edge in the order of their corners.
[[nodiscard]] std::vector<Side> sortedSides(const Draft& draft);

/// Per corner: the side across its own, kNone on the boundary. No edge may have more than two sides, which run against
/// each other.
[[nodiscard]] std::vector<uint32_t> matchSides(const Draft& draft);

} // namespace supple::cage::repair
