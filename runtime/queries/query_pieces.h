// The pieces of a group's surfaces that queries on the device look at (shaders/shared/queries.h).
#pragma once

#include "base/result.h"

#include <cstdint>
#include <vector>

namespace supple::runtime {

class CpuGroup;

/// The pieces of a face of the cage.
struct FacePieces {
    uint32_t first = 0, count = 0;
};
struct PieceTable {
    std::vector<uint32_t> words;
    std::vector<FacePieces> ofFaces;
    uint32_t pieceCount = 0;
    float reach = 0.0f; ///< the largest of a piece
};
/// `mostElements`: of 16 bytes, that the table may have.
[[nodiscard]] Result<PieceTable> pieceTable(const CpuGroup& group, uint64_t mostElements);

} // namespace supple::runtime
