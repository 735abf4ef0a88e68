// Faces and corners as lists that tests can write and compare.
#pragma once

#include "cage/polygons.h"
#include "tests/support/meshes.h"

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <numeric>
#include <vector>

namespace supple::test {

using Indices = std::vector<uint32_t>;

/// 0, 1 .. count - 1
inline Indices identity(size_t count) {
    Indices map(count);
    std::iota(map.begin(), map.end(), 0u);
    return map;
}

inline Faces facesOf(const cage::Polygons& polygons) {
    Faces faces;
    for (size_t f = 0; f < polygons.faceCount(); ++f) {
        faces.emplace_back(polygons.vertices.begin() + polygons.starts[f],
                           polygons.vertices.begin() + polygons.starts[f + 1]);
    }
    return faces;
}

inline std::vector<glm::vec3> cornerPositions(const cage::Cage& cage) {
    std::vector<glm::vec3> positions;
    for (const uint32_t v : cage.faceVertices) {
        positions.push_back(cage.positions[v]);
    }
    return positions;
}

} // namespace supple::test
