#include "host/ray_scene.h"
#include "host/vk_struct.h"

#include <algorithm>
#include <utility>

namespace supple::host {

namespace {

constexpr VkPipelineStageFlags2 kBuild = VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR;
constexpr VkAccessFlags2 kRead = VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR;
constexpr VkAccessFlags2 kWrite = VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR;
constexpr VkDeviceSize kStructureAlignment = 256; // of its place in a buffer
constexpr uint32_t kAllRays = 0xFF;

VkDeviceSize aligned(VkDeviceSize value, VkDeviceSize alignment) {
    return (value + alignment - 1) / alignment * alignment;
}

VkDeviceSize scratchAlignment(const Device& device) {
    auto own = vkStruct<VkPhysicalDeviceAccelerationStructurePropertiesKHR>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR);
    auto all = vkStruct<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &own);
    vkGetPhysicalDeviceProperties2(device.physicalDevice(), &all);
    return std::max<VkDeviceSize>(own.minAccelerationStructureScratchOffsetAlignment, 1);
}

VkAccelerationStructureBuildGeometryInfoKHR infoOf(VkAccelerationStructureTypeKHR type,
                                                   VkBuildAccelerationStructureFlagsKHR flags) {
    auto info = vkStruct<VkAccelerationStructureBuildGeometryInfoKHR>(
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR);
    info.type = type;
    info.flags = flags;
    return info;
}

VkAccelerationStructureGeometryKHR triangles(const SuppleRayGeometry& from, bool isOpaque) {
    auto geometry = vkStruct<VkAccelerationStructureGeometryKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR);
    geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
    geometry.flags = isOpaque ? VK_GEOMETRY_OPAQUE_BIT_KHR : 0;
    auto& own = geometry.geometry.triangles;
    own = vkStruct<VkAccelerationStructureGeometryTrianglesDataKHR>(
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR);
    own.vertexFormat = from.format;
    own.vertexStride = from.vertexStride;
    own.maxVertex = from.maxVertex;
    own.indexType = VK_INDEX_TYPE_UINT32;
    own.indexData.deviceAddress = from.indices;
    return geometry;
}

VkAccelerationStructureInstanceKHR instanceOf(VkDeviceAddress structure, uint32_t customIndex) {
    VkAccelerationStructureInstanceKHR instance{};
    for (int i = 0; i < 3; ++i)
        instance.transform.matrix[i][i] = 1.0f; // vertices have the instance's transform in them
    instance.instanceCustomIndex = customIndex;
    instance.mask = kAllRays;
    instance.accelerationStructureReference = structure;
    return instance;
}

template <class Function>
Function functionOf(VkDevice device, const char* name) {
    return reinterpret_cast<Function>(vkGetDeviceProcAddr(device, name));
}

} // namespace

RayFunctions::RayFunctions(VkDevice device)
    : create(functionOf<PFN_vkCreateAccelerationStructureKHR>(device, "vkCreateAccelerationStructureKHR")),
      destroy(functionOf<PFN_vkDestroyAccelerationStructureKHR>(device, "vkDestroyAccelerationStructureKHR")),
      buildSizes(
          functionOf<PFN_vkGetAccelerationStructureBuildSizesKHR>(device, "vkGetAccelerationStructureBuildSizesKHR")),
      address(functionOf<PFN_vkGetAccelerationStructureDeviceAddressKHR>(device,
                                                                         "vkGetAccelerationStructureDeviceAddressKHR")),
      build(functionOf<PFN_vkCmdBuildAccelerationStructuresKHR>(device, "vkCmdBuildAccelerationStructuresKHR")) {}

Result<RayStructure> RayStructure::create(const Device& device, const RayFunctions& functions,
                                          VkAccelerationStructureTypeKHR type, const Buffer& buffer,
                                          VkDeviceSize offset, VkDeviceSize size) {
    auto info =
        vkStruct<VkAccelerationStructureCreateInfoKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR);
    info.buffer = buffer.handle();
    info.offset = offset;
    info.size = size;
    info.type = type;
    RayStructure made;
    if (const VkResult result = functions.create(device.handle(), &info, nullptr, &made.structure_);
        result != VK_SUCCESS)
        return vulkanError(result, "vkCreateAccelerationStructureKHR");
    made.device_ = device.handle();
    made.destroy_ = functions.destroy;
    auto which = vkStruct<VkAccelerationStructureDeviceAddressInfoKHR>(
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR);
    which.accelerationStructure = made.structure_;
    made.address_ = functions.address(device.handle(), &which);
    return made;
}

RayStructure& RayStructure::operator=(RayStructure&& other) noexcept {
    if (this != &other) {
        reset();
        device_ = std::exchange(other.device_, VK_NULL_HANDLE);
        destroy_ = other.destroy_;
        structure_ = std::exchange(other.structure_, VK_NULL_HANDLE);
        address_ = std::exchange(other.address_, 0);
    }
    return *this;
}

void RayStructure::reset() {
    if (device_ != VK_NULL_HANDLE)
        destroy_(device_, structure_, nullptr);
    device_ = VK_NULL_HANDLE;
}

Result<std::unique_ptr<RayGroup>> RayGroup::create(Context& context, SuppleGroup group,
                                                   const RayGroupOptions& options) {
    SuppleGroupInfo info{};
    info.structSize = sizeof info;
    if (const Status status = context.check(suppleGetGroupInfo(context.handle(), group, &info), "suppleGetGroupInfo");
        !status)
        return status.error();
    RayGroupOptions own = options;
    own.plan.mostPerFrame = std::clamp(own.plan.mostPerFrame, 1u, info.capacity);
    std::unique_ptr<RayGroup> made(new RayGroup(context.device(), info.capacity, own.plan));
    made->firstCustomIndex_ = own.firstCustomIndex;
    Status status = made->readSurfaces(context, group, info.surfaceCount, own);
    status = status ? made->createStructures(context.device(), info.capacity, own.plan.mostPerFrame) : status;
    if (!status)
        return status.error();
    return made;
}

Status RayGroup::readSurfaces(Context& context, SuppleGroup group, uint32_t surfaces, const RayGroupOptions& options) {
    for (uint32_t surface = 0; surface < surfaces; ++surface) {
        SuppleRayGeometry from{};
        from.structSize = sizeof from;
        Status status =
            context.check(suppleGetRayGeometry(context.handle(), group, surface, &from), "suppleGetRayGeometry");
        if (!status)
            return status;
        for (uint32_t i = 0; i < from.rangeCount; ++i) {
            const SuppleRayRange& range = from.ranges[i];
            Geometry& geometry = geometries_.emplace_back();
            geometry.vertices = from.vertices;
            geometry.instanceStride = from.instanceStride;
            geometry.description = triangles(from, !options.isOpaque || options.isOpaque(range.material));
            // firstVertex stays 0: addresses move instead.
            geometry.range = {range.triangleCount, range.firstIndex * static_cast<uint32_t>(sizeof(uint32_t)), 0, 0};
            geometry.part = range.part;
        }
    }
    return success();
}

Status RayGroup::createStructures(Device& device, uint32_t capacity, uint32_t mostPerFrame) {
    const size_t count = geometries_.size();
    builds_.reserve(mostPerFrame);
    descriptions_.resize(mostPerFrame * count);
    ranges_.resize(mostPerFrame * count);
    rangesOf_.resize(mostPerFrame);
    instances_.reserve(capacity);

    // The most that a structure can have: all parts are shown.
    std::vector<uint32_t> triangleCounts;
    for (size_t g = 0; g < count; ++g) {
        descriptions_[g] = geometries_[g].description;
        triangleCounts.push_back(geometries_[g].range.primitiveCount);
    }
    auto sizes = vkStruct<VkAccelerationStructureBuildSizesInfoKHR>(
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR);
    const VkAccelerationStructureBuildGeometryInfoKHR info = buildInfo({0, RayPlan::Work::build}, 0);
    functions_.buildSizes(device.handle(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info,
                          triangleCounts.data(), &sizes);

    const VkDeviceSize each = aligned(sizes.accelerationStructureSize, kStructureAlignment);
    Result<Buffer> storage = device.createBuffer(each * capacity,
                                                 VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR |
                                                     VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                                                 MemoryKind::device);
    if (!storage)
        return storage.error();
    storage_ = std::move(*storage);
    const VkDeviceSize alignment = scratchAlignment(device);
    sliceBytes_ = aligned(std::max(sizes.buildScratchSize, sizes.updateScratchSize), alignment);
    Result<Buffer> scratch = device.createBuffer(
        sliceBytes_ * mostPerFrame + alignment,
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT, MemoryKind::device);
    if (!scratch)
        return scratch.error();
    scratch_ = std::move(*scratch);
    firstSlice_ = aligned(scratch_.address(), alignment);
    for (uint32_t slot = 0; slot < capacity; ++slot) {
        Result<RayStructure> structure =
            RayStructure::create(device, functions_, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, storage_,
                                 slot * each, sizes.accelerationStructureSize);
        if (!structure)
            return structure.error();
        structures_.push_back(std::move(*structure));
    }
    return success();
}

VkAccelerationStructureBuildGeometryInfoKHR RayGroup::buildInfo(const RayPlan::Task& task, size_t slice) {
    auto info = infoOf(VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR,
                       VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_BUILD_BIT_KHR |
                           VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_UPDATE_BIT_KHR);
    info.geometryCount = static_cast<uint32_t>(geometries_.size());
    info.pGeometries = descriptions_.data() + slice * geometries_.size();
    info.scratchData.deviceAddress = firstSlice_ + slice * sliceBytes_;
    if (task.slot < structures_.size()) // not yet when sizes are asked for
        info.dstAccelerationStructure = structures_[task.slot].handle();
    if (task.work == RayPlan::Work::update) {
        info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_UPDATE_KHR;
        info.srcAccelerationStructure = info.dstAccelerationStructure;
    }
    return info;
}

void RayGroup::record(VkCommandBuffer commands, std::span<const TracedInstance> instances) {
    plan_.plan(instances);
    builds_.clear();
    const size_t count = geometries_.size();
    for (const RayPlan::Task& task : plan_.tasks()) {
        const size_t slice = builds_.size();
        const std::span<const uint32_t> hidden = plan_.hiddenParts(task.slot);
        for (size_t g = 0; g < count; ++g) {
            const Geometry& geometry = geometries_[g];
            const size_t place = slice * count + g;
            descriptions_[place] = geometry.description;
            descriptions_[place].geometry.triangles.vertexData.deviceAddress =
                geometry.vertices + task.slot * geometry.instanceStride;
            ranges_[place] = geometry.range;
            if (std::ranges::binary_search(hidden, geometry.part))
                ranges_[place].primitiveCount = 0; // the others keep their numbers
        }
        rangesOf_[slice] = ranges_.data() + slice * count;
        builds_.push_back(buildInfo(task, slice));
    }
    if (!builds_.empty())
        functions_.build(commands, static_cast<uint32_t>(builds_.size()), builds_.data(), rangesOf_.data());
    instances_.clear();
    for (const uint32_t slot : plan_.traced())
        instances_.push_back(instanceOf(structures_[slot].address(), firstCustomIndex_ + slot));
}

Result<std::unique_ptr<RayScene>> RayScene::create(Device& device, uint32_t capacity, uint32_t framesInFlight,
                                                   VkPipelineStageFlags2 tracedBy) {
    std::unique_ptr<RayScene> made(new RayScene(device));
    made->capacity_ = capacity;
    made->framesInFlight_ = framesInFlight;
    made->tracedBy_ = tracedBy;
    Result<Buffer> instances =
        device.createBuffer(VkDeviceSize{framesInFlight} * capacity * sizeof(VkAccelerationStructureInstanceKHR),
                            VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR |
                                VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                            MemoryKind::upload);
    if (!instances)
        return instances.error();
    made->instances_ = std::move(*instances);

    VkAccelerationStructureGeometryKHR geometry{};
    const VkAccelerationStructureBuildGeometryInfoKHR info = made->buildInfo(geometry);
    auto sizes = vkStruct<VkAccelerationStructureBuildSizesInfoKHR>(
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR);
    made->functions_.buildSizes(device.handle(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, &capacity,
                                &sizes);
    Result<Buffer> storage = device.createBuffer(sizes.accelerationStructureSize,
                                                 VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR |
                                                     VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                                                 MemoryKind::device);
    if (!storage)
        return storage.error();
    made->storage_ = std::move(*storage);
    const VkDeviceSize alignment = scratchAlignment(device);
    Result<Buffer> scratch = device.createBuffer(
        sizes.buildScratchSize + alignment,
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT, MemoryKind::device);
    if (!scratch)
        return scratch.error();
    made->scratch_ = std::move(*scratch);
    made->scratchAddress_ = aligned(made->scratch_.address(), alignment);
    Result<RayStructure> structure =
        RayStructure::create(device, made->functions_, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, made->storage_, 0,
                             sizes.accelerationStructureSize);
    if (!structure)
        return structure.error();
    made->structure_ = std::move(*structure);
    return made;
}

VkAccelerationStructureBuildGeometryInfoKHR RayScene::buildInfo(VkAccelerationStructureGeometryKHR& geometry) const {
    geometry = vkStruct<VkAccelerationStructureGeometryKHR>(VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR);
    geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
    geometry.geometry.instances = vkStruct<VkAccelerationStructureGeometryInstancesDataKHR>(
        VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR);
    geometry.geometry.instances.data.deviceAddress =
        instances_.address() + VkDeviceSize{frame_} * capacity_ * sizeof(VkAccelerationStructureInstanceKHR);
    auto info =
        infoOf(VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR);
    info.geometryCount = 1;
    info.pGeometries = &geometry;
    info.dstAccelerationStructure = structure_.handle();
    info.scratchData.deviceAddress = scratchAddress_;
    return info;
}

void RayScene::record(VkCommandBuffer commands, std::span<const Part> parts) {
    frame_ = (frame_ + 1) % framesInFlight_;
    // Earlier frames trace and build what this one writes, with the same scratch memory.
    memoryBarrier(commands, {kBuild | tracedBy_, kWrite}, {kBuild, kRead | kWrite});
    auto* listed = static_cast<VkAccelerationStructureInstanceKHR*>(instances_.mapped()) + size_t{frame_} * capacity_;
    uint32_t count = 0;
    for (const Part& part : parts) {
        part.group->record(commands, part.instances);
        const auto own = part.group->instances();
        const auto room = std::min(static_cast<uint32_t>(own.size()), capacity_ - count);
        std::copy_n(own.begin(), room, listed + count);
        count += room;
    }
    memoryBarrier(commands, {kBuild, kWrite}, {kBuild, kRead | kWrite});
    VkAccelerationStructureGeometryKHR geometry{};
    const VkAccelerationStructureBuildGeometryInfoKHR info = buildInfo(geometry);
    const VkAccelerationStructureBuildRangeInfoKHR range{count, 0, 0, 0};
    const VkAccelerationStructureBuildRangeInfoKHR* ranges = &range;
    functions_.build(commands, 1, &info, &ranges);
    memoryBarrier(commands, {kBuild, kWrite}, {tracedBy_, kRead});
}

} // namespace supple::host
