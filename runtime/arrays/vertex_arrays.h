// Influences and displacements of vertices out of a host's arrays. Private to runtime/arrays/.
#pragma once

#include "cage/split/vertex_morphs.h"
#include "cage/vertex_weights.h"
#include "runtime/arrays/faults.h"
#include "supple/supple.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace supple::runtime {

/// Whether nothing is wrong with the influences.
[[nodiscard]] bool checkInfluences(const SuppleInfluences& from, uint32_t vertexCount, size_t jointCount,
                                   Faults& faults);
/// Appends those of some vertices, which have been checked.
void appendInfluences(const SuppleInfluences& from, std::span<const uint32_t> vertices, size_t jointCount,
                      cage::VertexWeights& weights);
/// A fault if a part without a skin has influences.
void refuseInfluences(const SuppleInfluences& from, Faults& faults);

/// The displacements by one target that are not zero, by vertex.
[[nodiscard]] std::vector<std::pair<uint32_t, cage::split::MorphDelta>>
readDisplacements(const SuppleDisplacements& from, uint32_t target, uint32_t vertexCount, Faults& faults);

} // namespace supple::runtime
