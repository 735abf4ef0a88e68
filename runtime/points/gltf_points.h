// Points of a glTF file's triangles, as points of the cage's faces.
#pragma once

#include "base/result.h"
#include "supple/supple.h"

#include <span>

namespace supple::runtime {

class CpuGroup;

/// Fills out, as long as `points`. Points of triangles that no face has get SUPPLE_NO_FACE. Refuses triangles that the
/// file does not have, and names the first such point.
[[nodiscard]] Status findGltfPoints(const CpuGroup& group, std::span<const SuppleGltfPoint> points,
                                    std::span<SuppleSurfacePoint> out);

} // namespace supple::runtime
