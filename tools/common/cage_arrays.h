// A cage::Cage in the shape the public interface takes.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <string>
#include <supple/supple.h>
#include <vector>

namespace supple::host {

/// `desc` points into the cage and into this object; both must outlive its use.
struct CageArrays {
    explicit CageArrays(const cage::Cage& cage) {
        for (uint32_t f = 0; f < cage.faceCount(); ++f) {
            faceVertexCounts.push_back(cage.sides(f));
        }
        desc.structSize = sizeof(desc);
        desc.vertexCount = cage.vertexCount();
        desc.faceCount = cage.faceCount();
        desc.positions = &cage.positions[0].x;
        desc.faceVertexCounts = faceVertexCounts.data();
        desc.faceVertexIndices = cage.faceVertices.data();
        desc.cornerUvs = cage.cornerUvs.empty() ? nullptr : &cage.cornerUvs[0].x;
        desc.cornerUvs1 = cage.cornerUvs1.empty() ? nullptr : &cage.cornerUvs1[0].x;
        for (const cage::Crease& crease : cage.creases) {
            creaseVertices.insert(creaseVertices.end(), {crease.a, crease.b});
            creaseSharpnesses.push_back(crease.sharpness);
            creaseSets.push_back(crease.set);
        }
        for (const std::string& name : cage.creaseSets) {
            creaseSetNames.push_back(name.c_str());
        }
        desc.creaseSetCount = static_cast<uint32_t>(creaseSetNames.size());
        desc.creaseSetNames = creaseSetNames.data();
        desc.creaseSets = creaseSets.data();
        desc.creaseCount = static_cast<uint32_t>(creaseSharpnesses.size());
        desc.creaseVertices = creaseVertices.data();
        desc.creaseSharpnesses = creaseSharpnesses.data();
        for (const cage::SharpVertex& corner : cage.sharpVertices) {
            cornerVertices.push_back(corner.vertex);
            cornerSharpnesses.push_back(corner.sharpness);
        }
        desc.cornerCount = static_cast<uint32_t>(cornerVertices.size());
        desc.cornerVertices = cornerVertices.data();
        desc.cornerSharpnesses = cornerSharpnesses.data();
        for (const cage::CreaseScalar& scalar : cage.creaseScalars) {
            creaseScalars.push_back({scalar.vertex, scalar.toward, scalar.alpha});
        }
        desc.creaseScalarCount = static_cast<uint32_t>(creaseScalars.size());
        desc.creaseScalars = creaseScalars.data();
        desc.holeCount = static_cast<uint32_t>(cage.holes.size());
        desc.holes = cage.holes.data();
        desc.faceTrimTiles = cage.faceTrimTiles.empty() ? nullptr : cage.faceTrimTiles.data();
    }
    CageArrays(const CageArrays&) = delete;
    CageArrays& operator=(const CageArrays&) = delete;

    std::vector<uint32_t> faceVertexCounts, creaseVertices, creaseSets, cornerVertices;
    std::vector<const char*> creaseSetNames;
    std::vector<float> creaseSharpnesses, cornerSharpnesses;
    std::vector<SuppleCreaseScalar> creaseScalars;
    SuppleCageDesc desc{};
};

} // namespace supple::host
