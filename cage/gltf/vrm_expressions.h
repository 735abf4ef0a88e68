// The expressions of VRM files. Private to cage/gltf/.
#pragma once

#include "cage/expressions.h"
#include "cage/gltf/document.h"

#include <span>
#include <vector>

namespace supple::cage::gltf {

/// More morph targets than this, over all expressions, are not read.
inline constexpr size_t kMostExpressionBinds = size_t{1} << 20;

/// Those of VRM 1.0 (VRMC_vrm) or, where there are none, of 0.x (blendShapeMaster), whose presets have their names of
/// 1.0 then. `targetCounts`: by node, the morph targets of the part that it carries. Entries that make no sense are
/// left out, with a warning for each list.
[[nodiscard]] std::vector<UnplacedExpression> readExpressions(const Document& document,
                                                              std::span<const size_t> targetCounts, Warnings& warnings);

} // namespace supple::cage::gltf
