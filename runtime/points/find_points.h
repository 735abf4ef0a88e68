// Points of a group's surfaces by where they are: nearest to places, at texture coordinates, on rays, spread by area.
// On the CPU.
#pragma once

#include "base/result.h"
#include "supple/supple.h"

#include <memory>
#include <span>

namespace supple::runtime {

class CpuGroup;
class PointFinder;

/// How many points a query is answered by.
[[nodiscard]] inline uint64_t pointsOf(const SupplePointQuery& query) {
    return uint64_t{query.count} * (query.pointsEach > 1 ? query.pointsEach : 1);
}

/// Fills out with pointsOf(query) points. `query`: checked but for what only the character says. Refuses a cage that
/// has not the character's vertices, and texture coordinates that it lacks. `kept`: null, or what the last call for the
/// group has left there, for searches in the bind pose.
[[nodiscard]] Status findPoints(const std::shared_ptr<const CpuGroup>& group, std::shared_ptr<PointFinder>& kept,
                                const SupplePointQuery& query, std::span<SuppleSurfacePoint> out);

} // namespace supple::runtime
