#include "host/attachments.h"

#include "host/texture.h"
#include "host/vk_struct.h"

#include <algorithm>
#include <utility>

namespace supple::host {

namespace {

/// One texel.
Picture pictureOf(uint8_t r, uint8_t g, uint8_t b) {
    return {1, 1, {r, g, b, 255}};
}

std::vector<shared::AttachmentVertex> verticesOf(const Decal& decal) {
    std::vector<shared::AttachmentVertex> vertices;
    for (const Decal::Place& place : decal.places)
        vertices.push_back({{place.u, place.v, place.opacity, place.sag}, {}, {}});
    return vertices;
}

} // namespace

Result<std::unique_ptr<Attachments>> Attachments::create(Device& device, const AttachmentPipelines& pipelines,
                                                         const FigureGroup& group) {
    std::unique_ptr<Attachments> made(new Attachments(device, pipelines, group));
    if (const Status status = made->createPool(); !status)
        return status.error();
    return made;
}

Attachments::~Attachments() {
    for (const Entry& entry : all_) {
        if (group_.handle().id != 0) // else they are gone with it
            suppleDestroyPointSet(group_.figure().context().handle(), entry.points);
    }
    vkDestroyDescriptorPool(device_.handle(), pool_, nullptr);
    vkDestroySampler(device_.handle(), sampler_, nullptr);
}

Status Attachments::createPool() {
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 3 * kMost},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2 * kMost}};
    auto info = vkStruct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    info.maxSets = kMost;
    info.poolSizeCount = static_cast<uint32_t>(std::size(sizes));
    info.pPoolSizes = sizes;
    if (const VkResult result = vkCreateDescriptorPool(device_.handle(), &info, nullptr, &pool_); result != VK_SUCCESS)
        return vulkanError(result, "vkCreateDescriptorPool");
    auto sampler = vkStruct<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    sampler.magFilter = sampler.minFilter = VK_FILTER_LINEAR;
    sampler.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    sampler.maxLod = VK_LOD_CLAMP_NONE;
    sampler.addressModeU = sampler.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    const VkResult result = vkCreateSampler(device_.handle(), &sampler, nullptr, &sampler_);
    return result == VK_SUCCESS ? success() : Status(vulkanError(result, "vkCreateSampler"));
}

Status Attachments::addProp(const SuppleSurfacePoint& at, std::span<const shared::AttachmentVertex> vertices,
                            float scale) {
    Entry entry;
    entry.push.pointCount = 1;
    entry.push.scale = scale;
    entry.indexCount = static_cast<uint32_t>(vertices.size());
    return add(std::move(entry), {&at, 1}, {}, vertices, {pictureOf(255, 255, 255), {}, 0.5f});
}

Status Attachments::addDecal(const DecalDesc& desc, const DecalLook& look) {
    Result<Decal> decal = projectDecal(group_.figure().context().handle(), group_.handle(), desc);
    if (!decal)
        return decal.error();
    const std::vector<uint32_t> indices = decal->indices();
    Entry entry;
    entry.push.pointCount = static_cast<uint32_t>(decal->points.size());
    entry.push.roughness = look.roughness;
    entry.indexCount = static_cast<uint32_t>(indices.size());
    Result<Buffer> buffer =
        device_.uploadBuffer(indices.data(), indices.size() * sizeof(uint32_t), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    if (!buffer)
        return buffer.error();
    entry.indices = std::move(*buffer);
    entry.decal = &decals_.emplace_back(std::move(*decal));
    const Decal& own = decals_.back();
    Status added = add(std::move(entry), own.points, own.tangents, verticesOf(own), look);
    if (!added)
        decals_.pop_back();
    return added;
}

Status Attachments::add(Entry entry, std::span<const SuppleSurfacePoint> points, std::span<const glm::vec3> tangents,
                        std::span<const shared::AttachmentVertex> vertices, const DecalLook& look) {
    if (all_.size() == kMost)
        return Error{ErrorCode::limit, "a figure carries " + std::to_string(kMost) + " attachments at most"};
    Result<Buffer> buffer =
        device_.uploadBuffer(vertices.data(), vertices.size_bytes(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    Result<Image> color = uploadTexture(device_, look.color);
    Result<Image> normals =
        uploadTexture(device_, look.normals.width > 0 ? look.normals : pictureOf(128, 128, 255), TextureKind::data);
    if (!buffer || !color || !normals)
        return !buffer ? buffer.error() : !color ? color.error() : normals.error();
    entry.vertices = std::move(*buffer);
    entry.color = std::move(*color);
    entry.normals = std::move(*normals);
    Context& context = group_.figure().context();
    SupplePointSetDesc desc{};
    desc.structSize = sizeof desc;
    desc.group = group_.handle();
    desc.points = points.data();
    desc.pointCount = static_cast<uint32_t>(points.size());
    desc.tangents = tangents.empty() ? nullptr : &tangents[0].x;
    desc.format = SUPPLE_POINT_FRAME_48;
    if (Status made =
            context.check(suppleCreatePointSet(context.handle(), &desc, &entry.points), "suppleCreatePointSet");
        !made)
        return made;
    SupplePointOutput output{};
    output.structSize = sizeof output;
    Status written =
        context.check(suppleGetPointOutput(context.handle(), entry.points, &output), "suppleGetPointOutput");
    if (written)
        written = write(entry, output);
    if (written)
        all_.push_back(std::move(entry));
    else
        suppleDestroyPointSet(context.handle(), entry.points);
    return written;
}

Status Attachments::write(Entry& entry, const SupplePointOutput& output) const {
    auto info = vkStruct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    info.descriptorPool = pool_;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &pipelines_.set;
    if (const VkResult result = vkAllocateDescriptorSets(device_.handle(), &info, &entry.set); result != VK_SUCCESS)
        return vulkanError(result, "vkAllocateDescriptorSets");
    const SuppleBufferRange& slots = group_.surfaces().front().output.info.instances;
    const VkDescriptorBufferInfo buffers[] = {{output.frames.buffer, output.frames.offset, output.frames.size},
                                              {entry.vertices.handle(), 0, VK_WHOLE_SIZE},
                                              {slots.buffer, slots.offset, slots.size}};
    const VkDescriptorImageInfo images[] = {{sampler_, entry.color.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
                                            {sampler_, entry.normals.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}};
    auto writes = std::array{vkStruct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET),
                             vkStruct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET)};
    static_assert(shared::kAttachmentInstanceBinding == shared::kAttachmentFrameBinding + 2 &&
                  shared::kDecalNormalBinding == shared::kDecalColorBinding + 1);
    writes[0].dstBinding = shared::kAttachmentFrameBinding;
    writes[0].descriptorCount = 3;
    writes[0].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[0].pBufferInfo = buffers;
    writes[1].dstBinding = shared::kDecalColorBinding;
    writes[1].descriptorCount = 2;
    writes[1].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    writes[1].pImageInfo = images;
    writes[0].dstSet = writes[1].dstSet = entry.set;
    vkUpdateDescriptorSets(device_.handle(), 2, writes.data(), 0, nullptr);
    return success();
}

void Attachments::draw(VkCommandBuffer commands, uint32_t segments) const {
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
    for (const Entry& entry : all_) { // decals may lie over each other, the later ones above
        shared::AttachmentPush push = entry.push;
        push.light = shared::kNoLight;
        push.lift = entry.decal != nullptr ? entry.decal->lift(segments) : 0.0f;
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                          entry.decal != nullptr ? pipelines_.decal : pipelines_.prop);
        drawEntry(commands, entry, push);
    }
}

void Attachments::drawShadow(VkCommandBuffer commands, uint32_t light) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.propShadow);
    for (const Entry& entry : all_) {
        if (entry.decal != nullptr)
            continue;
        shared::AttachmentPush push = entry.push;
        push.light = light;
        drawEntry(commands, entry, push);
    }
}

void Attachments::drawEntry(VkCommandBuffer commands, const Entry& entry, const shared::AttachmentPush& push) const {
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.layout, 1, 1, &entry.set, 0, nullptr);
    vkCmdPushConstants(commands, pipelines_.layout, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                       sizeof push, &push);
    if (entry.decal != nullptr) {
        vkCmdBindIndexBuffer(commands, entry.indices.handle(), 0, VK_INDEX_TYPE_UINT32);
        vkCmdDrawIndexed(commands, entry.indexCount, group_.visibleCount(), 0, 0, 0);
    } else {
        vkCmdDraw(commands, entry.indexCount, group_.visibleCount(), 0, 0);
    }
}

} // namespace supple::host
