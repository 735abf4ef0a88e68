// A cage::Cage in the shape the public interface takes.
#pragma once

#include "cage/character.h"

#include <cstdint>
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
    }
    CageArrays(const CageArrays&) = delete;
    CageArrays& operator=(const CageArrays&) = delete;

    std::vector<uint32_t> faceVertexCounts;
    SuppleCageDesc desc{};
};

} // namespace supple::host
