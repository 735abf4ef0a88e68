// A whole subdivided cage on the CPU, and which of its samples are one point.
#pragma once

#include "tests/support/meshes.h"
#include "tools/reference/fragments.h"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace supple::test {

/// The mesh of a cage that must be accepted.
inline surface::subdivision::Mesh subdivisionMesh(const cage::Cage& cage,
                                                  surface::subdivision::Subdivision subdivision) {
    Result<surface::subdivision::Mesh> mesh = surface::subdivision::buildMesh(cage, subdivision);
    if (!mesh.ok()) {
        ADD_FAILURE() << mesh.error().message;
        return {};
    }
    return std::move(*mesh);
}

/// The triangles a mesh of Loop's was refined from, with the given cage's creases, sharp vertices and holes.
inline cage::Cage trianglesOf(const surface::subdivision::Mesh& mesh, const cage::Cage& given) {
    Faces triangles;
    std::vector<uint32_t> holes;
    for (uint32_t f = 0; f < mesh.cage.faceCount(); f += 4) { // the corners' faces, then the middle
        std::vector<uint32_t>& triangle = triangles.emplace_back();
        for (uint32_t corner = 0; corner < 3; ++corner) {
            triangle.push_back(mesh.cage.faceVertices[mesh.cage.faceStarts[f + corner]]);
        }
        if (std::binary_search(mesh.cage.holes.begin(), mesh.cage.holes.end(), f)) {
            holes.push_back(f / 4);
        }
    }
    cage::Cage cage = makeCage(given.positions, triangles);
    cage.creases = given.creases;
    cage.sharpVertices = given.sharpVertices;
    cage.holes = std::move(holes);
    return cage;
}

} // namespace supple::test
