// Acceleration structures over groups with SUPPLE_GROUP_RAY_TRACING: one for each instance, from Supple's own buffers,
// and one over all of them. Copy these two files and ray_plan into an engine, or read them as an example
// (docs/ray_tracing.md).
//
// All memory is allocated when a group is added: recording allocates nothing on the device. Like all that frames use,
// what is made here may go only when no frame that uses it is pending.
#pragma once

#include "host/context.h"
#include "host/ray_plan.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace supple::host {

/// The functions of VK_KHR_acceleration_structure, which loaders do not export.
struct RayFunctions {
    explicit RayFunctions(VkDevice device);
    PFN_vkCreateAccelerationStructureKHR create;
    PFN_vkDestroyAccelerationStructureKHR destroy;
    PFN_vkGetAccelerationStructureBuildSizesKHR buildSizes;
    PFN_vkGetAccelerationStructureDeviceAddressKHR address;
    PFN_vkCmdBuildAccelerationStructuresKHR build;
};

/// A piece of a buffer that is one structure. Moves; frees it when it goes, but not the buffer.
class RayStructure {
public:
    [[nodiscard]] static Result<RayStructure> create(const Device& device, const RayFunctions& functions,
                                                     VkAccelerationStructureTypeKHR type, const Buffer& buffer,
                                                     VkDeviceSize offset, VkDeviceSize size);
    RayStructure() = default;
    RayStructure(RayStructure&& other) noexcept { *this = std::move(other); }
    RayStructure& operator=(RayStructure&& other) noexcept;
    ~RayStructure() { reset(); }

    [[nodiscard]] VkAccelerationStructureKHR handle() const { return structure_; }
    [[nodiscard]] VkDeviceAddress address() const { return address_; }

private:
    void reset();
    VkDevice device_ = VK_NULL_HANDLE;
    PFN_vkDestroyAccelerationStructureKHR destroy_ = nullptr;
    VkAccelerationStructureKHR structure_ = VK_NULL_HANDLE;
    VkDeviceAddress address_ = 0;
};

struct RayGroupOptions {
    RayPlanOptions plan;
    uint32_t firstCustomIndex = 0; ///< instanceCustomIndex of slot 0; slot s has s more
    /// Whether rays need not ask if they have hit a material (SUPPLE_NO_MATERIAL too). Null: all are opaque.
    std::function<bool(uint32_t material)> isOpaque;
};

/// The structures of a group's instances: one a slot. Its geometries are the ranges of SuppleRayGeometry, those of all
/// surfaces one after the other.
class RayGroup {
public:
    /// `group` has SUPPLE_GROUP_RAY_TRACING. If its capacity changes or its asset is reloaded, create this anew.
    [[nodiscard]] static Result<std::unique_ptr<RayGroup>> create(Context& context, SuppleGroup group,
                                                                  const RayGroupOptions& options = {});

    /// Records builds and updates of this frame, behind its suppleRecord, which names kBuildUse in `after`.
    void record(VkCommandBuffer commands, std::span<const TracedInstance> instances);
    /// What a structure over all has of the group, after the last record(). Valid until the next one.
    [[nodiscard]] std::span<const VkAccelerationStructureInstanceKHR> instances() const { return instances_; }
    [[nodiscard]] const RayPlan& plan() const { return plan_; }

private:
    RayGroup(const Device& device, uint32_t capacity, const RayPlanOptions& options)
        : functions_(device.handle()), plan_(capacity, options) {}
    [[nodiscard]] Status readSurfaces(Context& context, SuppleGroup group, uint32_t surfaces,
                                      const RayGroupOptions& options);
    [[nodiscard]] Status createStructures(Device& device, uint32_t capacity, uint32_t mostPerFrame);
    [[nodiscard]] VkAccelerationStructureBuildGeometryInfoKHR buildInfo(const RayPlan::Task& task, size_t slice);

    struct Geometry {
        VkDeviceAddress vertices = 0; ///< of slot 0
        VkDeviceSize instanceStride = 0;
        VkAccelerationStructureGeometryKHR description{};
        VkAccelerationStructureBuildRangeInfoKHR range{};
        uint32_t part = 0;
    };
    RayFunctions functions_;
    RayPlan plan_;
    uint32_t firstCustomIndex_ = 0;
    std::vector<Geometry> geometries_;
    Buffer storage_, scratch_;
    VkDeviceAddress firstSlice_ = 0;
    VkDeviceSize sliceBytes_ = 0;
    std::vector<RayStructure> structures_; ///< by slot
    std::vector<VkAccelerationStructureInstanceKHR> instances_;
    // What record() hands to Vulkan: an entry for each structure that it works on. In descriptions_ and ranges_ each
    // structure has one for each of its geometries.
    std::vector<VkAccelerationStructureBuildGeometryInfoKHR> builds_;
    std::vector<VkAccelerationStructureGeometryKHR> descriptions_;
    std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges_;
    std::vector<const VkAccelerationStructureBuildRangeInfoKHR*> rangesOf_;
};

/// What suppleRecord is told for builds: as `after`, and as a part of `before`.
inline constexpr SuppleSyncScope kBuildUse{VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR,
                                           VK_ACCESS_2_SHADER_READ_BIT};

/// The structure over all instances that rays are cast into.
class RayScene {
public:
    /// `capacity`: instances of all groups. `tracedBy`: the stages that cast rays.
    [[nodiscard]] static Result<std::unique_ptr<RayScene>>
    create(Device& device, uint32_t capacity, uint32_t framesInFlight, VkPipelineStageFlags2 tracedBy);

    /// What a frame traces of a group.
    struct Part {
        RayGroup* group = nullptr;
        std::span<const TracedInstance> instances;
    };
    /// Records all structures of a frame. Earlier frames' rays, on the same queue, are waited for, and the rays of
    /// `tracedBy` that follow wait for this. Instances beyond the capacity are left out.
    void record(VkCommandBuffer commands, std::span<const Part> parts);
    [[nodiscard]] VkAccelerationStructureKHR handle() const { return structure_.handle(); }

private:
    explicit RayScene(const Device& device) : functions_(device.handle()) {}
    [[nodiscard]] VkAccelerationStructureBuildGeometryInfoKHR
    buildInfo(VkAccelerationStructureGeometryKHR& geometry) const;

    RayFunctions functions_;
    VkPipelineStageFlags2 tracedBy_ = 0;
    uint32_t capacity_ = 0, framesInFlight_ = 1, frame_ = 0;
    Buffer instances_; ///< mapped: a run a frame in flight
    Buffer storage_, scratch_;
    VkDeviceAddress scratchAddress_ = 0;
    RayStructure structure_;
};

} // namespace supple::host
