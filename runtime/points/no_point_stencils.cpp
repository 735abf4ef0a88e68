// For a library that is built with SUPPLE_WITH_CPU=OFF.
#include "runtime/points/find_points.h"
#include "runtime/points/point_stencils.h"
#include "runtime/points/vertex_points.h"

namespace supple::runtime {

// NOLINTNEXTLINE(performance-unnecessary-value-param): as it is where there are surfaces
Result<std::shared_ptr<const CpuGroup>> surfacesOf(std::shared_ptr<const Prepared> /*prepared*/,
                                                   const SuppleGroupDesc& /*desc*/) {
    return Error{ErrorCode::disabled, "the library was built with SUPPLE_WITH_CPU=OFF: it has no surface points"};
}

Result<std::vector<uint32_t>> pointTable(const CpuGroup& /*group*/, std::span<const SuppleSurfacePoint> /*points*/,
                                         std::span<const float> /*tangents*/, bool /*derivatives*/,
                                         uint64_t /*mostElements*/) {
    return Error{ErrorCode::disabled, "the library has no surface points"}; // without surfaces it is not asked
}

Result<VertexPoints> vertexPoints(const CpuGroup& /*group*/, const Surfaces& /*surfaces*/,
                                  std::span<const SuppleSurfacePoint> /*points*/) {
    return Error{ErrorCode::disabled, "the library has no surface points"};
}

Status findPoints(const std::shared_ptr<const CpuGroup>& /*group*/, std::shared_ptr<PointFinder>& /*kept*/,
                  const SupplePointQuery& /*query*/, std::span<SuppleSurfacePoint> /*out*/) {
    return Error{ErrorCode::disabled, "the library has no surface points"};
}

} // namespace supple::runtime
