// The header of a block of tables (shaders/shared/table_header.h).
#pragma once

#include "surface/scheme.h"

#include <array>

namespace supple::surface {

/// What the members of the tables say, as the device reads it.
[[nodiscard]] std::array<uint32_t, shared::kTableHeaderWords> headerOf(const Tables& tables);
/// Writes it to where the words begin. The tables are complete.
void writeHeader(Tables& tables);

/// Levels of detail: where the words of depths begin in an instance's scratch. Before them stand a float an edge and
/// the words of patches.
[[nodiscard]] uint32_t depthWords(const LodTables& tables);
/// Elements of an instance's scratch, which levels of detail and fragments have. A multiple of 256 bytes.
[[nodiscard]] uint32_t scratchStride(const Tables& tables);

} // namespace supple::surface
