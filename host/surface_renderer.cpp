#include "host/surface_renderer.h"

#include "host/environment.h"
#include "host/material_uniforms.h"
#include "host/vk_struct.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <supple/supple.hpp>
#include <utility>

namespace supple::host {

namespace {

constexpr uint32_t kFigureBuffers = 13; ///< of set 1
constexpr VkFormat kShadowFormat = VK_FORMAT_D32_SFLOAT;

/// The cage's lines over shaded faces, and over the smooth surface.
constexpr glm::vec4 kCageEdgeColor(0.010f, 0.014f, 0.022f, 0.85f);
constexpr glm::vec4 kOverlayEdgeColor(0.95f, 0.42f, 0.06f, 0.9f);

/// From here on a CPU device looks the light up once a vertex: it shades blocks of pixels, however small the triangle.
constexpr uint32_t kVertexLitRate = 4;

/// Below so many directions the steps of single shadow maps show.
constexpr uint32_t kFewLights = 12;

/// A part of the device's maps serves shadow maps of fewer texels: their lower left corner.
glm::mat4 cornerOfMap(uint32_t texels, uint32_t mapTexels) {
    const float share = static_cast<float>(texels) / static_cast<float>(mapTexels);
    glm::mat4 corner(1.0f);
    corner[0][0] = corner[1][1] = share;
    corner[3][0] = corner[3][1] = share - 1.0f;
    return corner;
}

void bindGridIndices(VkCommandBuffer commands, const GroupOutput& output) {
    const SuppleBufferRange& indices = output.indices();
    vkCmdBindIndexBuffer(commands, indices.buffer, indices.offset,
                         indices.stride == 4 ? VK_INDEX_TYPE_UINT32 : VK_INDEX_TYPE_UINT16);
}

/// Draw `index` of the surface.
void drawFine(VkCommandBuffer commands, const FigureSurface& surface, size_t index) {
    const SuppleBufferRange& indirect = surface.output.indirect();
    vkCmdDrawIndexedIndirect(commands, indirect.buffer, indirect.offset + VkDeviceSize{index} * indirect.stride, 1,
                             indirect.stride);
}

/// The same on the grid of the surface's shadows. Groups with levels have none: the device alone knows what is drawn.
void drawCoarse(VkCommandBuffer commands, const Scene& scene, const FigureSurface& surface, size_t index) {
    if (scene.group->hasLevels()) {
        bindGridIndices(commands, surface.output);
        drawFine(commands, surface, index);
        return;
    }
    const SuppleDrawRange& range = surface.output.grid.drawRanges[index];
    const uint32_t patches = range.patchCount * scene.group->visibleCount();
    if (range.domain != SUPPLE_DOMAIN_MESH) {
        const FigureSurface::CoarseGrid& grid = surface.coarseGrids[range.domain];
        vkCmdBindIndexBuffer(commands, surface.coarseIndices.handle(), 0, VK_INDEX_TYPE_UINT16);
        vkCmdDrawIndexed(commands, grid.indexCount, patches, grid.firstIndex, 0, 0);
    } else {
        bindGridIndices(commands, surface.output);
        vkCmdDrawIndexed(commands, range.indexCount, patches, range.firstIndex, 0, 0);
    }
}

/// Light falls through some of it.
bool isTrimmed(const SuppleMaterialInfo& material) {
    return material.trimDomain != SUPPLE_TRIM_NONE || material.alphaMode != SUPPLE_ALPHA_OPAQUE;
}

/// The cage has the holes of masks, not those of a trim of its own.
bool isMasked(const SuppleMaterialInfo& material) {
    return (materialFlags(material, defaultMaterialLayers(), false) & shared::kMaterialTrimAlpha) != 0;
}

bool isGlass(const FigureMaterials& materials, uint32_t material) {
    return host::isGlass(materials.of(material), materials.layersOf(material));
}
/// Most of the light goes through all of it.
bool castsNoShadow(const FigureMaterials& materials, uint32_t material) {
    return isGlass(materials, material) && materials.layersOf(material).transmissionFactor >= 0.5f &&
           materials.layersOf(material).transmission.image == SUPPLE_NO_IMAGE;
}

uint32_t flagsOf(const Scene& scene, uint32_t material) {
    const Figure& figure = scene.group->figure();
    return materialFlags(figure.materials().of(material), figure.materials().layersOf(material),
                         !figure.cage().uvSets[1].empty());
}

DrawPipelines::Faces shadowFaces(const Scene& scene, uint32_t material) {
    return {.cage = scene.cageFaces, .shadow = true, .material = flagsOf(scene, material)};
}

/// The scheme polygons has no grids to draw the lines of; the edges of the cage are its lines.
bool isWireOfMesh(const Scene& scene, uint32_t part) {
    return scene.view == shared::kViewWire && scene.group->isMeshPart(part);
}

/// Only where a material is looked at as it is: other views show all sides, and what lies behind.
bool isBlended(const Scene& scene, uint32_t material) {
    const FigureMaterials& materials = scene.group->figure().materials();
    return scene.view == shared::kViewShaded &&
           (materials.of(material).alphaMode == SUPPLE_ALPHA_BLEND || isGlass(materials, material));
}
/// What blends, and is solid somewhere.
bool maybeSolid(const FigureMaterials& materials, uint32_t material) {
    const SuppleMaterialInfo& info = materials.of(material);
    return isGlass(materials, material) ? materials.layersOf(material).transmission.image != SUPPLE_NO_IMAGE
                                        : info.baseColorFactor[3] >= shared::kSolidAlpha;
}
/// The draws that make a material blend, in their order; none if it does not.
std::span<const Blend> blendsOf(const Scene& scene, uint32_t material) {
    static constexpr Blend kGlass[] = {Blend::multiply, Blend::add}, kOver[] = {Blend::over};
    if (!isBlended(scene, material))
        return {};
    return isGlass(scene.group->figure().materials(), material) ? std::span<const Blend>(kGlass) : kOver;
}
/// On the surface as it is, and nowhere else.
bool showsAttachments(const Scene& scene) {
    return scene.attachments != nullptr && scene.view == shared::kViewShaded && !scene.cageFaces;
}
/// The fewest along an edge of the cage; at levels 0.
uint32_t segmentsOf(const Scene& scene) {
    uint32_t fewest = UINT32_MAX;
    for (const FigureSurface& surface : scene.group->surfaces())
        fewest = std::min(fewest, scene.coarse ? surface.coarseEdgeRate : surface.edgeRate);
    return scene.group->hasLevels() ? 0 : fewest;
}
/// Which side is not drawn, where winding tells the sides apart.
VkCullModeFlags culled(const Scene& scene, uint32_t material) {
    return scene.view == shared::kViewShaded && scene.group->figure().materials().isOneSided(material)
               ? VK_CULL_MODE_BACK_BIT
               : VK_CULL_MODE_NONE;
}

/// What tells the shader to leave out what is culled.
uint32_t sideFlags(VkCullModeFlags cull) {
    return cull == VK_CULL_MODE_BACK_BIT ? shared::kDrawFrontSide
                                         : (cull == VK_CULL_MODE_FRONT_BIT ? shared::kDrawBackSide : 0u);
}

/// A pose may mirror a limb of a part of the scheme polygons. Its vertices belong to no patch that would tell, as those
/// of other schemes do: there the shader knows of whole parts alone.
bool mirrorsWithinParts(const Scene& scene, uint32_t part) {
    return scene.group->figure().cage().mayMirror && !scene.cageFaces && part != kManyParts &&
           scene.group->isMeshPart(part);
}

/// The viewport of the whole picture, with y up. `shift` moves the picture to the right, in pixels.
VkViewport pictureViewport(VkExtent2D extent, float shift) {
    const auto height = static_cast<float>(extent.height);
    return {shift, height, static_cast<float>(extent.width), -height, 0.0f, 1.0f};
}

/// Nothing is culled at first: the shader tells the sides apart.
void beginDrawing(VkCommandBuffer commands, const VkViewport& viewport, const VkRect2D& scissor) {
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scissor);
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
}

VkRenderingAttachmentInfo attachment(VkImageView view, VkImageLayout layout) {
    auto info = vkStruct<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
    info.imageView = view;
    info.imageLayout = layout;
    info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    return info;
}

VkSamplerAddressMode addressMode(SuppleWrap wrap) {
    switch (wrap) {
    case SUPPLE_WRAP_CLAMP:
        return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    case SUPPLE_WRAP_MIRROR:
        return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    default:
        return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    }
}

/// Anisotropic where the file leaves it to the host.
VkSamplerCreateInfo samplerInfo(const SuppleTextureInfo& texture, const Device& device) {
    const auto isOneOf = [&](std::initializer_list<SuppleFilter> filters) {
        return std::find(filters.begin(), filters.end(), texture.minFilter) != filters.end();
    };
    auto info = vkStruct<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    info.magFilter = texture.magFilter == SUPPLE_FILTER_NEAREST ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
    info.minFilter =
        isOneOf({SUPPLE_FILTER_NEAREST, SUPPLE_FILTER_NEAREST_MIPMAP_NEAREST, SUPPLE_FILTER_NEAREST_MIPMAP_LINEAR})
            ? VK_FILTER_NEAREST
            : VK_FILTER_LINEAR;
    info.mipmapMode = isOneOf({SUPPLE_FILTER_NEAREST_MIPMAP_NEAREST, SUPPLE_FILTER_LINEAR_MIPMAP_NEAREST})
                          ? VK_SAMPLER_MIPMAP_MODE_NEAREST
                          : VK_SAMPLER_MIPMAP_MODE_LINEAR;
    // The fixed level that Vulkan's reference gives for OpenGL's filters without mip levels.
    info.maxLod = isOneOf({SUPPLE_FILTER_NEAREST, SUPPLE_FILTER_LINEAR}) ? 0.25f : VK_LOD_CLAMP_NONE;
    info.anisotropyEnable =
        device.hasAnisotropy() && info.minFilter == VK_FILTER_LINEAR && info.magFilter == VK_FILTER_LINEAR ? VK_TRUE
                                                                                                           : VK_FALSE;
    info.maxAnisotropy = std::min(8.0f, device.properties().limits.maxSamplerAnisotropy);
    info.addressModeU = addressMode(texture.wrap[0]);
    info.addressModeV = addressMode(texture.wrap[1]);
    return info;
}

VkWriteDescriptorSet descriptorWrite(VkDescriptorSet set, uint32_t slot, VkDescriptorType type) {
    auto write = vkStruct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstSet = set;
    write.dstBinding = slot;
    write.descriptorCount = 1;
    write.descriptorType = type;
    return write;
}

} // namespace

FigureBinding& FigureBinding::operator=(FigureBinding&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(pool_, other.pool_);
    std::swap(surfaces_, other.surfaces_);
    std::swap(materials_, other.materials_);
    std::swap(uniforms_, other.uniforms_);
    std::swap(samplers_, other.samplers_);
    return *this;
}

FigureBinding::~FigureBinding() {
    if (device_ == VK_NULL_HANDLE)
        return;
    vkDestroyDescriptorPool(device_, pool_, nullptr);
    for (const VkSampler sampler : samplers_)
        vkDestroySampler(device_, sampler, nullptr);
}

Result<std::unique_ptr<SurfaceRenderer>> SurfaceRenderer::create(Device& device, const RendererOptions& options) {
    std::unique_ptr<SurfaceRenderer> renderer(new SurfaceRenderer(device));
    renderer->quality_ = options.quality;
    renderer->rays_ = options.rays;
    Result<std::unique_ptr<DrawPipelines>> pipelines = DrawPipelines::create(
        device, {options.colorFormat, kDepthFormat, kShadowFormat, renderer->samples(), options.rays != nullptr});
    if (!pipelines)
        return pipelines.error();
    renderer->pipelines_ = std::move(*pipelines);
    if (const Status status = renderer->createShadowMaps(); !status)
        return status.error();
    if (const Status status = renderer->createEnvironment(); !status)
        return status.error();
    if (const Status status = renderer->createSlots(options.framesInFlight); !status)
        return status.error();
    return renderer;
}

SurfaceRenderer::~SurfaceRenderer() {
    for (const VkImageView view : shadowLayers_)
        vkDestroyImageView(device_.handle(), view, nullptr);
    vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
}

Status SurfaceRenderer::createShadowMaps() {
    const uint32_t count = quality_.lightCount();
    if (count == 0 || count > shared::kMaxLights)
        return Error{ErrorCode::argument, "the studio takes 1 to " + std::to_string(shared::kMaxLights) + " lights"};
    Result<Image> maps =
        device_.createImage({.format = kShadowFormat,
                             .extent = {quality_.shadowSize, quality_.shadowSize},
                             .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                             .aspect = VK_IMAGE_ASPECT_DEPTH_BIT,
                             .layers = std::max(count, 2u)}); // two at least: the shaders read an array
    if (!maps)
        return maps.error();
    shadowMaps_ = std::move(*maps);
    for (uint32_t layer = 0; layer < count; ++layer) {
        auto info = vkStruct<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
        info.image = shadowMaps_.handle();
        info.viewType = VK_IMAGE_VIEW_TYPE_2D;
        info.format = kShadowFormat;
        info.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, layer, 1};
        VkImageView view = VK_NULL_HANDLE;
        if (const VkResult result = vkCreateImageView(device_.handle(), &info, nullptr, &view); result != VK_SUCCESS)
            return vulkanError(result, "vkCreateImageView");
        shadowLayers_.push_back(view);
    }
    return success();
}

Status SurfaceRenderer::createEnvironment() {
    const StudioEnvironment environment = studioEnvironment();
    keyRadiance_ = environment.keyRadiance;
    rimRadiance_ = environment.rimRadiance;
    Result<Image> image = uploadEnvironment(device_, environment);
    if (!image)
        return image.error();
    environment_ = std::move(*image);
    return success();
}

Status SurfaceRenderer::createSlots(uint32_t count) {
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, count},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2 * count},
                                          {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, count},
                                          {VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, count}};
    auto poolInfo = vkStruct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    poolInfo.maxSets = count;
    poolInfo.poolSizeCount = static_cast<uint32_t>(std::size(sizes)) - (rays_ != nullptr ? 0 : 1);
    poolInfo.pPoolSizes = sizes;
    if (const VkResult result = vkCreateDescriptorPool(device_.handle(), &poolInfo, nullptr, &pool_);
        result != VK_SUCCESS)
        return vulkanError(result, "vkCreateDescriptorPool");
    for (uint32_t i = 0; i < count; ++i) {
        Slot slot;
        Result<Buffer> uniforms =
            device_.createBuffer(sizeof(shared::FrameUniforms), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::upload);
        if (!uniforms)
            return uniforms.error();
        slot.uniforms = std::move(*uniforms);
        auto info = vkStruct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
        info.descriptorPool = pool_;
        info.descriptorSetCount = 1;
        info.pSetLayouts = &pipelines_->frameSet;
        if (const VkResult result = vkAllocateDescriptorSets(device_.handle(), &info, &slot.set); result != VK_SUCCESS)
            return vulkanError(result, "vkAllocateDescriptorSets");
        const VkDescriptorBufferInfo buffer{slot.uniforms.handle(), 0, VK_WHOLE_SIZE};
        const VkDescriptorImageInfo shadows{pipelines_->shadowSampler, shadowMaps_.view(),
                                            VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL};
        const VkDescriptorImageInfo environment{pipelines_->environmentSampler, environment_.view(),
                                                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        constexpr VkDescriptorType kImage = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        VkWriteDescriptorSet writes[] = {
            descriptorWrite(slot.set, shared::kFrameBinding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER),
            descriptorWrite(slot.set, shared::kShadowBinding, kImage),
            descriptorWrite(slot.set, shared::kEnvironmentBinding, kImage),
            descriptorWrite(slot.set, shared::kShadowDepthBinding, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE)};
        writes[0].pBufferInfo = &buffer;
        writes[1].pImageInfo = writes[3].pImageInfo = &shadows;
        writes[2].pImageInfo = &environment;
        vkUpdateDescriptorSets(device_.handle(), static_cast<uint32_t>(std::size(writes)), writes, 0, nullptr);
        if (rays_ != nullptr)
            writeRays(slot.set);
        slots_.push_back(std::move(slot));
    }
    return success();
}

void SurfaceRenderer::writeRays(VkDescriptorSet set) const {
    const VkAccelerationStructureKHR structure = rays_->handle();
    auto rays = vkStruct<VkWriteDescriptorSetAccelerationStructureKHR>(
        VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR);
    rays.accelerationStructureCount = 1;
    rays.pAccelerationStructures = &structure;
    VkWriteDescriptorSet write =
        descriptorWrite(set, shared::kRayBinding, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR);
    write.pNext = &rays;
    vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
}

Result<FigureBinding> SurfaceRenderer::bind(const FigureGroup& group) {
    FigureBinding binding;
    binding.device_ = device_.handle();
    if (const Status status = allocateSets(binding, group); !status)
        return status.error();
    for (size_t i = 0; i < group.surfaces().size(); ++i)
        writeFigureSet(binding.surfaces_[i], group, group.surfaces()[i]);
    if (const Status status = writeMaterialSets(binding, group.figure()); !status)
        return status.error();
    return binding;
}

Status SurfaceRenderer::allocateSets(FigureBinding& binding, const FigureGroup& group) const {
    const auto materialCount = static_cast<uint32_t>(group.figure().materials().infos().size());
    const auto surfaceCount = static_cast<uint32_t>(group.surfaces().size());
    const VkDescriptorPoolSize sizes[] = {
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kFigureBuffers * surfaceCount},
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, materialCount},
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, (shared::kClearcoat + shared::kLayerTextureCount) * materialCount}};
    auto poolInfo = vkStruct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    poolInfo.maxSets = surfaceCount + materialCount;
    poolInfo.poolSizeCount = static_cast<uint32_t>(std::size(sizes));
    poolInfo.pPoolSizes = sizes;
    if (const VkResult result = vkCreateDescriptorPool(device_.handle(), &poolInfo, nullptr, &binding.pool_);
        result != VK_SUCCESS)
        return vulkanError(result, "vkCreateDescriptorPool");
    std::vector<VkDescriptorSetLayout> layouts(surfaceCount, pipelines_->figureSet);
    layouts.resize(surfaceCount + materialCount, pipelines_->materialSet);
    std::vector<VkDescriptorSet> sets(layouts.size());
    auto setInfo = vkStruct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    setInfo.descriptorPool = binding.pool_;
    setInfo.descriptorSetCount = static_cast<uint32_t>(layouts.size());
    setInfo.pSetLayouts = layouts.data();
    if (const VkResult result = vkAllocateDescriptorSets(device_.handle(), &setInfo, sets.data()); result != VK_SUCCESS)
        return vulkanError(result, "vkAllocateDescriptorSets");
    binding.surfaces_.assign(sets.begin(), sets.begin() + surfaceCount);
    binding.materials_.assign(sets.begin() + surfaceCount, sets.end());
    return success();
}

void SurfaceRenderer::writeFigureSet(VkDescriptorSet set, const FigureGroup& group,
                                     const FigureSurface& surface) const {
    const Figure& figure = group.figure();
    const GroupOutput& output = surface.output;
    const auto viewInfo = [](const SuppleBufferRange& view) {
        return VkDescriptorBufferInfo{view.buffer, view.offset, view.size};
    };
    const auto wholeInfo = [](const Buffer& buffer) {
        return VkDescriptorBufferInfo{buffer.handle(), 0, VK_WHOLE_SIZE};
    };
    // What the group is without the shaders do not look at; something valid has to be bound all the same.
    const auto orCage = [&](const SuppleBufferRange& view) {
        return viewInfo(view.buffer != VK_NULL_HANDLE ? view : output.info.deformedCage);
    };
    const std::pair<uint32_t, VkDescriptorBufferInfo> buffers[kFigureBuffers] = {
        {shared::kSurfaceVertexBinding, orCage(output.streams.vertices)},
        {shared::kSurfaceAttributeBinding, orCage(output.streams.attributes)},
        {shared::kSurfaceUv1Binding, orCage(output.streams.uvs1)},
        {shared::kSurfaceFaceUvBinding, orCage(output.streams.faceUvs)},
        {shared::kInstancesBinding, viewInfo(output.info.instances)},
        {shared::kPatchBinding, wholeInfo(surface.patches)},
        {shared::kDeformedCageBinding, viewInfo(output.info.deformedCage)},
        {shared::kCageCornerBinding, wholeInfo(figure.cageCorners())},
        {shared::kCageEdgeBinding, wholeInfo(figure.cageEdges())},
        {shared::kSurfaceTangentBinding, orCage(output.streams.tangents)},
        {shared::kLevelBucketBinding, orCage(output.levels.buckets)},
        {shared::kLevelPatchBinding, orCage(output.levels.patches)},
        {shared::kSurfaceValueBinding,
         surface.values.handle() != VK_NULL_HANDLE ? wholeInfo(surface.values) : viewInfo(output.info.deformedCage)},
    };
    for (const auto& [slot, info] : buffers) {
        VkWriteDescriptorSet write = descriptorWrite(set, slot, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
        write.pBufferInfo = &info;
        vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
    }
}

Status SurfaceRenderer::writeMaterialSets(FigureBinding& binding, const Figure& figure) const {
    if (const Status status = writeMaterialUniforms(binding, figure); !status)
        return status.error();
    const FigureMaterials& materials = figure.materials();
    for (size_t i = 0; i < binding.materials_.size(); ++i) {
        const auto textures = texturesOf(materials.infos()[i], materials.layersAt(i));
        for (uint32_t which = 0; which < shared::kClearcoat; ++which) {
            if (const Status status = writeTexture(binding, i, shared::kFirstTextureBinding + which, 0,
                                                   materials.texture(i, which), *textures[which]);
                !status)
                return status.error();
        }
        if (const Status status = writeLayerTextures(binding, i, materials); !status)
            return status.error();
    }
    return success();
}

Status SurfaceRenderer::writeMaterialUniforms(FigureBinding& binding, const Figure& figure) const {
    const VkDeviceSize alignment = device_.properties().limits.minUniformBufferOffsetAlignment;
    constexpr VkDeviceSize kSize = sizeof(shared::MaterialUniforms);
    const VkDeviceSize stride = (kSize + alignment - 1) / alignment * alignment;
    Result<Buffer> uniforms = device_.createBuffer(stride * binding.materials_.size(),
                                                   VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, MemoryKind::upload);
    if (!uniforms)
        return uniforms.error();
    binding.uniforms_ = std::move(*uniforms);
    const bool uv1 = !figure.cage().uvSets[1].empty();
    for (size_t i = 0; i < binding.materials_.size(); ++i) {
        const shared::MaterialUniforms values =
            materialUniforms(figure.materials().infos()[i], figure.materials().layersAt(i), uv1);
        std::memcpy(static_cast<std::byte*>(binding.uniforms_.mapped()) + stride * i, &values, kSize);
        const VkDescriptorBufferInfo described{binding.uniforms_.handle(), stride * i, kSize};
        VkWriteDescriptorSet write =
            descriptorWrite(binding.materials_[i], shared::kMaterialBinding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
        write.pBufferInfo = &described;
        vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
    }
    return success();
}

Status SurfaceRenderer::writeLayerTextures(FigureBinding& binding, size_t material,
                                           const FigureMaterials& materials) const {
    const SuppleMaterialInfo& info = materials.infos()[material];
    const SuppleMaterialLayers& layers = materials.layersAt(material);
    const auto textures = texturesOf(info, layers);
    const LayerSlots slots = layerSlots(info, layers);
    std::array<uint32_t, shared::kLayerTextureCount> shown{}; // where nothing is looked up, something must be bound
    for (uint32_t which = shared::kClearcoat; which < shared::kTextureCount; ++which) {
        if (const uint32_t slot = layerSlotOf(slots, which); slot != shared::kNoLayerSlot)
            shown[slot] = which;
    }
    for (uint32_t slot = 0; slot < shown.size(); ++slot) {
        if (const Status status = writeTexture(binding, material, shared::kLayerTextureBinding, slot,
                                               materials.texture(material, shown[slot]), *textures[shown[slot]]);
            !status)
            return status.error();
    }
    return success();
}

Status SurfaceRenderer::writeTexture(FigureBinding& binding, size_t material, uint32_t slot, uint32_t element,
                                     const Image& image, const SuppleTextureInfo& texture) const {
    const VkSamplerCreateInfo info = samplerInfo(texture, device_);
    VkSampler sampler = VK_NULL_HANDLE;
    if (const VkResult result = vkCreateSampler(device_.handle(), &info, nullptr, &sampler); result != VK_SUCCESS)
        return vulkanError(result, "vkCreateSampler");
    binding.samplers_.push_back(sampler);
    const VkDescriptorImageInfo described{sampler, image.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet write =
        descriptorWrite(binding.materials_[material], slot, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    write.dstArrayElement = element;
    write.pImageInfo = &described;
    vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
    return success();
}

Result<std::unique_ptr<Attachments>> SurfaceRenderer::createAttachments(const FigureGroup& group) {
    const Result<const AttachmentPipelines*> pipelines = pipelines_->attachments();
    return pipelines ? Attachments::create(device_, **pipelines, group)
                     : Result<std::unique_ptr<Attachments>>(pipelines.error());
}

DrawPipelines::Faces SurfaceRenderer::facesOf(const Scene& scene, const DrawRun& run, Blend blend) const {
    const bool isFlat = scene.view >= shared::kViewTangents;
    const FigureMaterials& materials = scene.group->figure().materials();
    const bool hasMaps = materials.hasMaps(run.material);
    const uint32_t edgeRate = scene.group->surfaces()[run.surface].edgeRate;
    return {.cage = scene.cageFaces,
            .material = flagsOf(scene, run.material),
            .layerSlots = layerSlots(materials.of(run.material), materials.layersOf(run.material)),
            .view = scene.view,
            .vertexLit =
                !scene.cageFaces && !isFlat && device_.isCpu() && rays_ == nullptr && edgeRate >= kVertexLitRate,
            .maps = isFlat || (scene.view == shared::kViewShaded && hasMaps),
            .blend = blend};
}

Status SurfaceRenderer::prepare(const Scene& scene) {
    for (const Pane& pane : panesOf(scene, {})) {
        for (const DrawPipelines::Faces& faces : allFaces(pane.scene)) {
            if (const Status status = pipelines_->prepare(faces); !status)
                return status.error();
        }
    }
    return success();
}

std::vector<DrawPipelines::Faces> SurfaceRenderer::allFaces(const Scene& scene) const {
    std::vector<DrawPipelines::Faces> all;
    if (scene.group == nullptr)
        return all;
    for (const DrawRun& run : runsOf(scene)) {
        const SuppleMaterialInfo& material = scene.group->figure().materials().of(run.material);
        all.push_back(facesOf(scene, run, Blend::none));
        for (const Blend blend : blendsOf(scene, run.material))
            all.push_back(facesOf(scene, run, blend));
        if (scene.cageFaces ? isMasked(material) : isTrimmed(material))
            all.push_back(shadowFaces(scene, run.material));
    }
    return all;
}

void SurfaceRenderer::record(VkCommandBuffer commands, uint32_t slot, const DrawTarget& target, const Scene& scene) {
    writeUniforms(slots_[slot], target.extent(), scene);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_->layout, 0, 1, &slots_[slot].set, 0,
                            nullptr);
    constexpr SuppleSyncScope kColor{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                     VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
    constexpr SuppleSyncScope kDepth{
        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
        VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
    constexpr SuppleSyncScope kCopy{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
    const ImageUse colorUse{VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, kColor};
    // The last picture may still be in the copy that fetches it, and its depth in use.
    imageBarrier(commands, target.color(), {VK_IMAGE_LAYOUT_UNDEFINED, kCopy}, colorUse);
    imageBarrier(commands, target.depth(), {VK_IMAGE_LAYOUT_UNDEFINED, kDepth},
                 {VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kDepth});
    if (target.samples() != VK_SAMPLE_COUNT_1_BIT)
        imageBarrier(commands, target.multisampled(), {VK_IMAGE_LAYOUT_UNDEFINED, kColor}, colorUse);
    // Panes share the shadow maps and the images that they draw into.
    for (const Pane& pane : panesOf(scene, target.extent())) {
        recordShadows(commands, pane.scene);
        drawPane(commands, target, pane);
        memoryBarrier(commands, kColor, kColor);
        memoryBarrier(commands, kDepth, kDepth);
    }
    imageBarrier(commands, target.color(), colorUse, {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, kCopy});
}

std::vector<SurfaceRenderer::Pane> SurfaceRenderer::panesOf(const Scene& scene, VkExtent2D extent) {
    if (!scene.split)
        return {{scene, {{0, 0}, extent}, 0.0f}};
    const auto width = static_cast<float>(extent.width);
    const auto middle = static_cast<uint32_t>(0.5f * (1.0f + *scene.split) * width);
    const float shift = 0.25f * (1.0f - *scene.split) * width;
    Pane cage{scene, {{0, 0}, {middle, extent.height}}, -shift};
    cage.scene.cageFaces = cage.scene.cageEdges = true;
    Pane surface{scene, {{static_cast<int32_t>(middle), 0}, {extent.width - middle, extent.height}}, shift};
    return {cage, surface};
}

void SurfaceRenderer::writeUniforms(const Slot& slot, VkExtent2D extent, const Scene& scene) const {
    const StudioQuality quality = scene.quality.value_or(quality_);
    const float aspect = static_cast<float>(extent.width) / static_cast<float>(extent.height);
    const glm::vec3 center = scene.bounds.center();
    const float radius = scene.bounds.radius() * 1.02f;
    const auto width = static_cast<float>(extent.width);
    const auto height = static_cast<float>(extent.height);
    shared::FrameUniforms frame{};
    frame.view = scene.camera.view();
    const float reach = radius + glm::length(scene.camera.target - center);
    glm::mat4 projection = scene.camera.projection(aspect, reach);
    const glm::vec2 jitter = studioJitter(quality, scene.pass) * 2.0f / glm::vec2(width, height);
    projection[2][0] += jitter.x; // times -w: a shift of the whole picture
    projection[2][1] += jitter.y;
    frame.viewProjection = projection * frame.view;
    const glm::vec3 eye = scene.camera.eye();
    frame.eye = glm::vec4(eye, scene.lightTubes);
    frame.target = glm::vec4(center, radius);
    const bool groundSeen = scene.ground.has_value() && eye.y > *scene.ground;
    frame.ground = glm::vec4(scene.ground.value_or(0.0f), groundSeen ? 1.0f : 0.0f, 0.0f, 0.0f);
    frame.viewport = glm::vec4(width, height, 1.0f / width, 1.0f / height);
    frame.bounce = glm::vec4(0.20f, 0.19f, 0.18f, 0.0f);
    frame.lightCount = quality.lightCount();
    // The other views paint every figure in the same colors.
    frame.exposure = scene.view == shared::kViewShaded && scene.group != nullptr
                         ? studioExposure(scene.group->figure().averageAlbedo())
                         : studioExposure(0.4f);
    frame.shadowTexel = 2.0f * radius / static_cast<float>(quality.shadowSize);
    frame.pixelScale = scene.pixelScale;
    frame.shadowWorld = 0.5f * frame.shadowTexel * static_cast<float>(quality_.shadowSize);
    frame.shadowDepth = kShadowDepth * radius;
    frame.pass = quality.passes > 1 ? scene.pass + 1 : 0;
    if (quality.lightCount() * quality.passes < kFewLights)
        frame.softShadows = 0.8f / static_cast<float>(quality_.shadowSize);
    const StudioMiddle middle = studioMiddle(scene.lightYaw);
    frame.keyDirection = glm::vec4(middle.keyDirection, 0.0f);
    frame.keyColor = glm::vec4(middle.keyColor, 0.0f);
    frame.rimDirection = glm::vec4(middle.rimDirection, 0.0f);
    frame.rimColor = glm::vec4(middle.rimColor, 0.0f);
    frame.environment = glm::vec4(std::sin(scene.lightYaw), std::cos(scene.lightYaw), keyRadiance_, rimRadiance_);
    if (scene.backdrop)
        frame.backdrop = glm::vec4(*scene.backdrop, 1.0f);
    if (quality.sky == 0)
        frame.openSky = glm::vec4(studioOpenSky(), 1.0f);
    const std::vector<shared::Light> lights = studioLights(quality, scene.pass, scene.lightYaw, center, radius);
    std::copy(lights.begin(), lights.end(), frame.lights);
    for (uint32_t i = 0; i < quality.lightCount(); ++i)
        frame.lights[i].shadow = cornerOfMap(quality.shadowSize, quality_.shadowSize) * frame.lights[i].shadow;
    std::memcpy(slot.uniforms.mapped(), &frame, sizeof frame);
}

void SurfaceRenderer::recordShadows(VkCommandBuffer commands, const Scene& scene) const {
    constexpr VkPipelineStageFlags2 kDepthStages =
        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
    const ImageUse drawn{
        VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
        {kDepthStages, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT}};
    const SuppleSyncScope read{VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                               VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
    imageBarrier(commands, shadowMaps_, {VK_IMAGE_LAYOUT_UNDEFINED, read}, drawn);
    const VkExtent2D extent{quality_.shadowSize, quality_.shadowSize};
    const uint32_t lights = scene.quality.value_or(quality_).lightCount();
    for (uint32_t light = 0; light < lights; ++light) {
        VkRenderingAttachmentInfo depth = attachment(shadowLayers_[light], VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
        depth.clearValue.depthStencil = {1.0f, 0};
        auto info = vkStruct<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
        info.renderArea = {{0, 0}, extent};
        info.layerCount = 1;
        info.pDepthAttachment = &depth;
        vkCmdBeginRendering(commands, &info);
        const auto side = static_cast<float>(quality_.shadowSize);
        beginDrawing(commands, {0.0f, 0.0f, side, side, 0.0f, 1.0f}, info.renderArea);
        if (scene.group != nullptr && (rays_ == nullptr || scene.cageFaces))
            drawShadow(commands, scene, light);
        vkCmdEndRendering(commands);
    }
    imageBarrier(commands, shadowMaps_, drawn, {VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL, read});
}

void SurfaceRenderer::drawShadow(VkCommandBuffer commands, const Scene& scene, uint32_t light) const {
    bindSurface(commands, scene, 0);
    if (scene.cageFaces)
        drawCageShadow(commands, scene, light);
    for (size_t i = 0; !scene.cageFaces && i < scene.group->surfaces().size(); ++i) {
        bindSurface(commands, scene, i);
        drawSurfaceShadow(commands, scene, scene.group->surfaces()[i], light);
    }
    if (showsAttachments(scene))
        scene.attachments->drawShadow(commands, light);
}

void SurfaceRenderer::drawPane(VkCommandBuffer commands, const DrawTarget& target, const Pane& pane) const {
    const bool multisampled = target.samples() != VK_SAMPLE_COUNT_1_BIT;
    const Image& drawn = multisampled ? target.multisampled() : target.color();
    VkRenderingAttachmentInfo color = attachment(drawn.view(), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    if (multisampled) {
        color.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
        color.resolveImageView = target.color().view();
        color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    }
    color.clearValue.color = {{0.0f, 0.0f, 0.0f, 1.0f}};
    VkRenderingAttachmentInfo depth = attachment(target.depth().view(), VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.clearValue.depthStencil = {1.0f, 0};
    auto info = vkStruct<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
    info.renderArea = pane.area;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &color;
    info.pDepthAttachment = &depth;
    vkCmdBeginRendering(commands, &info);
    beginDrawing(commands, pictureViewport(target.extent(), pane.shift), pane.area);
    drawScene(commands, pane.scene);
    vkCmdEndRendering(commands);
}

void SurfaceRenderer::drawScene(VkCommandBuffer commands, const Scene& scene) const {
    std::vector<DrawRun> runs;
    if (scene.group != nullptr) {
        runs = runsOf(scene);
        drawFaces(commands, scene, runs, false);
        if (showsAttachments(scene)) {
            scene.attachments->draw(commands, segmentsOf(scene));
            bindSurface(commands, scene, 0);
        }
    }
    if (scene.ground.has_value() && scene.camera.eye().y > *scene.ground) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_->ground);
        vkCmdDraw(commands, 4, 1, 0, 0);
    }
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_->backdrop);
    vkCmdDraw(commands, 3, 1, 0, 0);
    if (scene.group != nullptr) {
        keepBlended(runs, scene);
        drawFaces(commands, scene, runs, true);
        drawCageEdges(commands, scene);
    }
}

shared::DrawPush SurfaceRenderer::completed(shared::DrawPush push, const FigureSurface& surface, uint32_t light) const {
    const GroupOutput& output = surface.output;
    push.cageVerticesPerInstance = output.info.cageVerticesPerInstance;
    push.light = light;
    if (output.streams.vertexFormat == SUPPLE_VERTEX_24)
        push.flags |= shared::kDrawVertex24;
    if (output.streams.attributes.buffer != VK_NULL_HANDLE)
        push.flags |= shared::kDrawAttributes;
    if (output.streams.tangents.buffer != VK_NULL_HANDLE)
        push.flags |= shared::kDrawTangents;
    if (samples() != VK_SAMPLE_COUNT_1_BIT)
        push.flags |= shared::kDrawCoverage;
    return push;
}

void SurfaceRenderer::bindSurface(VkCommandBuffer commands, const Scene& scene, size_t surface) const {
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_->layout, 1, 1,
                            &scene.binding->surfaces_[surface], 0, nullptr);
}

void SurfaceRenderer::bindMaterial(VkCommandBuffer commands, const Scene& scene, uint32_t material) const {
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_->layout, 2, 1,
                            &scene.binding->materials_[scene.group->figure().materials().indexOf(material)], 0,
                            nullptr);
}

void SurfaceRenderer::pushConstants(VkCommandBuffer commands, const shared::DrawPush& push) const {
    vkCmdPushConstants(commands, pipelines_->layout, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                       sizeof push, &push);
}

void SurfaceRenderer::drawSurfaceShadow(VkCommandBuffer commands, const Scene& scene, const FigureSurface& surface,
                                        uint32_t light) const {
    const FigureMaterials& materials = scene.group->figure().materials();
    VkPipeline bound = VK_NULL_HANDLE;
    for (size_t i = 0; i < surface.draws.size(); ++i) {
        const SurfaceDraw& draw = surface.draws[i];
        if (!scene.group->isPartVisible(draw.part) || castsNoShadow(materials, draw.material))
            continue;
        const bool trimmed = isTrimmed(materials.of(draw.material));
        const VkPipeline wanted =
            trimmed ? (*pipelines_)[shadowFaces(scene, draw.material)] : pipelines_->surfaceShadow;
        if (bound != wanted)
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, wanted);
        bound = wanted;
        if (trimmed)
            bindMaterial(commands, scene, draw.material);
        pushConstants(commands, completed(draw.push, surface, light));
        drawCoarse(commands, scene, surface, i);
    }
}

std::vector<SurfaceRenderer::DrawRun> SurfaceRenderer::runsOf(const Scene& scene) const {
    std::vector<DrawRun> runs;
    const std::vector<FigureSurface>& surfaces = scene.group->surfaces();
    for (size_t s = 0; !scene.cageFaces && s < surfaces.size(); ++s) {
        for (size_t i = 0; i < surfaces[s].draws.size(); ++i)
            runs.push_back({s, i, surfaces[s].draws[i].part, surfaces[s].draws[i].material});
    }
    const std::vector<Figure::CageRange>& ranges = scene.group->figure().cageRanges();
    for (size_t i = 0; scene.cageFaces && i < ranges.size(); ++i)
        runs.push_back({0, i, ranges[i].part, ranges[i].material});
    return runs;
}

void SurfaceRenderer::keepBlended(std::vector<DrawRun>& runs, const Scene& scene) const {
    const Figure& figure = scene.group->figure();
    std::erase_if(runs, [&](const DrawRun& run) { return !isBlended(scene, run.material); });
    const glm::vec3 eye = scene.camera.eye();
    const glm::vec3 ahead = scene.camera.target - eye;
    const auto distance = [&](const DrawRun& run) {
        return glm::dot(figure.centerOf(run.part, run.material) - eye, ahead);
    };
    std::stable_sort(runs.begin(), runs.end(),
                     [&](const DrawRun& a, const DrawRun& b) { return distance(a) > distance(b); });
}

void SurfaceRenderer::drawFaces(VkCommandBuffer commands, const Scene& scene, const std::vector<DrawRun>& runs,
                                bool blend) const {
    const FigureMaterials& materials = scene.group->figure().materials();
    VkPipeline bound = VK_NULL_HANDLE;
    const FigureSurface* surface = nullptr;
    for (const DrawRun& run : runs) {
        const bool blended = isBlended(scene, run.material);
        if (blend ? !blended : blended && !maybeSolid(materials, run.material))
            continue;
        const FigureSurface& own = scene.group->surfaces()[run.surface];
        if (surface != &own) {
            bindSurface(commands, scene, run.surface);
            if (!scene.cageFaces)
                bindGridIndices(commands, own.output);
        }
        surface = &own;
        bindMaterial(commands, scene, run.material);
        const auto draw = [&](Blend how, VkCullModeFlags cull, uint32_t flags) {
            const VkPipeline wanted = (*pipelines_)[facesOf(scene, run, how)];
            if (bound != wanted)
                vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, wanted);
            bound = wanted;
            drawRun(commands, scene, run, cull, flags);
        };
        const bool bothSides = !blend && mirrorsWithinParts(scene, run.part);
        const VkCullModeFlags cull = bothSides ? VkCullModeFlags{VK_CULL_MODE_NONE} : culled(scene, run.material);
        if (!blend) {
            draw(Blend::none, cull, (blended ? shared::kDrawSolid : 0) | (bothSides ? shared::kDrawBothSides : 0));
            continue;
        }
        // What blends shows its far side through its near side.
        for (const VkCullModeFlagBits side : {VK_CULL_MODE_FRONT_BIT, VK_CULL_MODE_BACK_BIT}) {
            if (side == VK_CULL_MODE_FRONT_BIT && cull != VK_CULL_MODE_NONE)
                continue;
            for (const Blend how : blendsOf(scene, run.material))
                draw(how, side, 0);
        }
    }
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
}

void SurfaceRenderer::drawRun(VkCommandBuffer commands, const Scene& scene, const DrawRun& run, VkCullModeFlags cull,
                              uint32_t flags) const {
    const FigureSurface& surface = scene.group->surfaces()[run.surface];
    const bool byShader = scene.group->figure().cage().mayMirror;
    vkCmdSetCullMode(commands, byShader ? VkCullModeFlags{VK_CULL_MODE_NONE} : cull);
    if (!scene.group->isPartVisible(run.part))
        return;
    shared::DrawPush push = completed(scene.cageFaces ? shared::DrawPush{} : surface.draws[run.range].push, surface, 0);
    push.flags |= flags | (byShader ? shared::kDrawMayMirror | sideFlags(cull) : 0u);
    if (scene.cageFaces) {
        const Figure::CageRange& range = scene.group->figure().cageRanges()[run.range];
        push.primitive = range.firstCorner;
        pushConstants(commands, push);
        vkCmdDraw(commands, range.cornerCount, scene.group->visibleCount(), 0, 0);
        return;
    }
    pushConstants(commands, push);
    if (scene.coarse)
        drawCoarse(commands, scene, surface, run.range);
    else
        drawFine(commands, surface, run.range);
}

void SurfaceRenderer::drawCageShadow(VkCommandBuffer commands, const Scene& scene, uint32_t light) const {
    const FigureMaterials& materials = scene.group->figure().materials();
    shared::DrawPush push = completed({}, scene.group->surfaces().front(), light);
    for (const Figure::CageRange& range : scene.group->figure().cageRanges()) {
        if (!scene.group->isPartVisible(range.part) || castsNoShadow(materials, range.material))
            continue;
        const bool mask = isMasked(materials.of(range.material));
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                          mask ? (*pipelines_)[shadowFaces(scene, range.material)] : pipelines_->cageShadow);
        if (mask)
            bindMaterial(commands, scene, range.material);
        push.primitive = range.firstCorner;
        pushConstants(commands, push);
        vkCmdDraw(commands, range.cornerCount, scene.group->visibleCount(), 0, 0);
    }
}

void SurfaceRenderer::drawCageEdges(VkCommandBuffer commands, const Scene& scene) const {
    shared::DrawPush push = completed({}, scene.group->surfaces().front(), 0);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_->cageEdge);
    for (const Figure::EdgeRange& range : scene.group->figure().cageEdgeRanges()) {
        const bool wire = isWireOfMesh(scene, range.part);
        if (!scene.group->isPartVisible(range.part) || !(scene.cageEdges || wire))
            continue;
        push.lineColor = scene.cageFaces || wire ? kCageEdgeColor : kOverlayEdgeColor;
        push.primitive = range.firstEdge;
        pushConstants(commands, push);
        vkCmdDraw(commands, 6 * range.edgeCount, scene.group->visibleCount(), 0, 0);
    }
}

} // namespace supple::host
