// What a group's passes are recorded with, besides the tables.
#pragma once

#include "gpu/device.h"
#include "surface/scheme.h"

#include <cstdint>
#include <vector>

namespace supple::surface {

/// Instances that one descriptor set reaches.
struct Window {
    VkDescriptorSet set = VK_NULL_HANDLE;
    uint32_t firstInstance = 0; ///< in the list of instances (shaders/shared/instances.h)
    uint32_t instanceCount = 0; ///< or shared::kCountOnDevice and where it stands: then
    /// three words each: the groups to dispatch for every entry of Tables::constructions, for edges' and for patches'
    /// levels.
    VkBuffer arguments = VK_NULL_HANDLE;
    VkDeviceSize firstArgument = 0;
    bool today = false; ///< previous positions: the set binds today's coefficients in the place of the cage
};

/// What a dispatch takes an instance: lanes or workgroups, and how many of them a workgroup takes.
struct DispatchSize {
    uint32_t elements = 0;
    uint32_t perGroup = 1;
};

/// The same for a view's patches.
struct LodWindow {
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkBuffer view = VK_NULL_HANDLE; ///< shaders/shared/lod.h
    uint32_t firstSlot = 0;
    uint32_t firstDispatch = 0; ///< of the view: one a patch range
};

/// What a group evaluates, the same for all its windows.
struct Evaluation {
    uint32_t rate = 8;
    uint32_t cageStride = 0;          ///< cage vertices an instance in the deformed cage
    uint32_t verticesPerInstance = 0; ///< at least vertexCount(): the stride between instances
    uint32_t attributeOutputs = shared::kOutputUvs1 | shared::kOutputFaceUvs; ///< where the tables have them
    std::vector<uint32_t> firstVertices; ///< per patch range: where its vertices begin in an instance
    uint32_t firstEdgeVertex = 0;        ///< shared samples: those of edges, then those at corners
    uint32_t firstCornerVertex = 0;

    /// Lays out the ranges of `tables` one after the other from `first` on; returns where they end.
    uint64_t layOut(const Tables& tables, uint64_t first = 0);
};

} // namespace supple::surface
