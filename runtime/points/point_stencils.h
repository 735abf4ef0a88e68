// What points of a group's surfaces are made of: combinations of cage vertices, for the pass *points*
// (shaders/shared/points.h). They come from the surfaces on the CPU; a library without these has no points.
#pragma once

#include "base/result.h"
#include "runtime/prepared.h"
#include "supple/supple.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace supple::runtime {

class CpuGroup;

/// The surfaces of a group that has this description. They do not depend on its instances.
[[nodiscard]] Result<std::shared_ptr<const CpuGroup>> surfacesOf(std::shared_ptr<const Prepared> prepared,
                                                                 const SuppleGroupDesc& desc);

/// Vertices of a point, and elements of a table, at most: kernels go over all vertices of a point, and a point beside a
/// vertex of many faces has all of their corners.
inline constexpr uint32_t kMostPointVertices = 4096;
inline constexpr uint64_t kMostPointElements = uint64_t{1} << 25u; // 512 MiB

/// The table of a point set, four words an element. `tangents`: three floats a point in the bind pose, or empty.
/// `derivatives`: for SUPPLE_POINT_DERIVATIVES_32, which has no tangents. Refuses points that do not exist or hang on
/// too many vertices, and stops when there are more than `mostElements`.
[[nodiscard]] Result<std::vector<uint32_t>> pointTable(const CpuGroup& group,
                                                       std::span<const SuppleSurfacePoint> points,
                                                       std::span<const float> tangents, bool derivatives,
                                                       uint64_t mostElements = kMostPointElements);

} // namespace supple::runtime
