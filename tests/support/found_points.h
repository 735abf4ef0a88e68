// Points that searches find on the surfaces of a cage or a character, without a context.
#pragma once

#include "runtime/arrays/character_arrays.h"
#include "runtime/cpu_group.h"
#include "runtime/points/find_points.h"
#include "runtime/points/point_stencils.h"
#include "tools/common/cage_arrays.h"

#include <gtest/gtest.h>
#include <memory>
#include <utility>
#include <vector>

namespace supple::test {

using Surfaces = std::shared_ptr<const runtime::CpuGroup>;

inline Surfaces surfacesOf(cage::Character character, SuppleScheme scheme) {
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.scheme = scheme;
    auto made = runtime::surfacesOf(runtime::Prepared::of(std::move(character)), desc);
    EXPECT_TRUE(made.ok()) << (made ? "" : made.error().message);
    return made ? *made : nullptr;
}
inline Surfaces surfacesOf(const cage::Cage& cage, SuppleScheme scheme) {
    const host::CageArrays arrays(cage);
    Result<cage::Character> character = runtime::characterFromArrays(arrays.desc, "test cage");
    EXPECT_TRUE(character.ok());
    return surfacesOf(std::move(*character), scheme);
}

inline SupplePointQuery queryOf(SupplePointQueryKind kind, size_t count, const float* values = nullptr) {
    SupplePointQuery query{};
    query.structSize = sizeof(query);
    query.kind = kind;
    query.count = static_cast<uint32_t>(count);
    query.values = values;
    return query;
}

inline std::vector<SuppleSurfacePoint> found(const Surfaces& surfaces, const SupplePointQuery& query) {
    std::vector<SuppleSurfacePoint> points(runtime::pointsOf(query));
    std::shared_ptr<runtime::PointFinder> kept;
    const Status status = runtime::findPoints(surfaces, kept, query, points);
    EXPECT_TRUE(status) << (status ? "" : status.error().message);
    return points;
}

struct At {
    std::vector<glm::vec3> positions, normals;
};
inline At at(const Surfaces& surfaces, const std::vector<SuppleSurfacePoint>& points) {
    runtime::CpuPose pose(surfaces);
    std::vector<SuppleSurfaceJet> jets(points.size());
    EXPECT_TRUE(pose.build(reinterpret_cast<const std::byte*>(surfaces->cage().positions.data()), 12, {}));
    EXPECT_TRUE(pose.evaluate(points, jets.data(), {}));
    At result;
    for (const SuppleSurfaceJet& jet : jets) {
        result.positions.emplace_back(jet.position[0], jet.position[1], jet.position[2]);
        result.normals.push_back(glm::normalize(
            glm::cross(glm::vec3(jet.du[0], jet.du[1], jet.du[2]), glm::vec3(jet.dv[0], jet.dv[1], jet.dv[2]))));
    }
    return result;
}

} // namespace supple::test
