#include "materials.h"

#include <bit>
#include <cmath>
#include <cstring>

namespace qt_quick {

namespace {

constexpr SuppleSyncScope kNothing{VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE};
constexpr SuppleSyncScope kCopied{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr SuppleSyncScope kCopies{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
constexpr SuppleSyncScope kSampled{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

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

VkSampler createSampler(const Gpu& gpu, const SuppleTextureInfo& info) {
    VkSamplerCreateInfo desc{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    desc.magFilter = info.magFilter == SUPPLE_FILTER_NEAREST ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
    desc.minFilter = VK_FILTER_LINEAR;
    desc.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    desc.addressModeU = addressMode(info.wrap[0]);
    desc.addressModeV = addressMode(info.wrap[1]);
    desc.maxLod = VK_LOD_CLAMP_NONE;
    VkSampler sampler = VK_NULL_HANDLE;
    must(vkCreateSampler(gpu.device, &desc, nullptr, &sampler), "vkCreateSampler");
    return sampler;
}

VkImageBlit halving(VkExtent2D extent, uint32_t level) {
    const auto at = [&](uint32_t l) {
        return VkOffset3D{std::max(static_cast<int32_t>(extent.width >> l), 1),
                          std::max(static_cast<int32_t>(extent.height >> l), 1), 1};
    };
    VkImageBlit blit{};
    blit.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level - 1, 0, 1};
    blit.srcOffsets[1] = at(level - 1);
    blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1};
    blit.dstOffsets[1] = at(level);
    return blit;
}

} // namespace

Materials::Materials(const Gpu& gpu, const supple::Asset& asset, uint32_t count) : gpu_(gpu) {
    for (uint32_t i = 0; i < count; ++i) {
        SuppleMaterialInfo info{};
        must(asset.materialInfo(i, info), "suppleGetMaterialInfo");
        all_.push_back(read(asset, info));
    }
    Material none;
    setTexture(none, QImage(), SuppleTextureInfo{});
    all_.push_back(none);
}

Material Materials::read(const supple::Asset& asset, const SuppleMaterialInfo& info) {
    Material material;
    std::copy(info.baseColorFactor, info.baseColorFactor + 4, material.factor.begin());
    material.metallic = info.metallicFactor;
    material.roughness = info.roughnessFactor;
    material.doubleSided = info.doubleSided != 0;
    const SuppleTextureInfo& texture = info.baseColor;
    QImage picture;
    if (texture.image != SUPPLE_NO_IMAGE && texture.uvSet == 0) {
        SuppleImageInfo image{};
        must(asset.imageInfo(texture.image, image), "suppleGetImageInfo");
        if (image.bytes != nullptr)
            picture = QImage::fromData(static_cast<const uchar*>(image.bytes), static_cast<int>(image.byteCount));
        const float c = std::cos(texture.rotation), s = std::sin(texture.rotation);
        material.uvRows = {c * texture.scale[0],  s * texture.scale[1], texture.offset[0], 0.0f,
                           -s * texture.scale[0], c * texture.scale[1], texture.offset[1], 0.0f};
    }
    setTexture(material, picture, texture);
    return material;
}

/// Without a picture: one white texel, so that there is one pipeline for all.
void Materials::setTexture(Material& material, const QImage& picture, const SuppleTextureInfo& info) {
    QImage rgba = picture.convertToFormat(QImage::Format_RGBA8888);
    if (rgba.isNull()) {
        rgba = QImage(1, 1, QImage::Format_RGBA8888);
        rgba.fill(Qt::white);
    }
    Upload upload;
    upload.extent = {static_cast<uint32_t>(rgba.width()), static_cast<uint32_t>(rgba.height())};
    upload.levels = std::bit_width(std::max(upload.extent.width, upload.extent.height));
    ImageShape shape{VK_FORMAT_R8G8B8A8_SRGB, upload.extent};
    shape.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    shape.levels = upload.levels;
    material.texture = createImage(gpu_, shape);
    material.sampler = createSampler(gpu_, info);
    upload.image = material.texture.image;
    const auto size = static_cast<VkDeviceSize>(rgba.sizeInBytes()); // four bytes a texel: rows have no padding
    upload.staging = createBuffer(gpu_, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true);
    void* mapped = nullptr;
    must(vkMapMemory(gpu_.device, upload.staging.memory, 0, size, 0, &mapped), "vkMapMemory");
    std::memcpy(mapped, rgba.constBits(), size);
    vkUnmapMemory(gpu_.device, upload.staging.memory);
    uploads_.push_back(upload);
}

void Materials::upload(VkCommandBuffer commands, Retired& retired, uint64_t frame) {
    for (const Upload& upload : uploads_) {
        transition(commands, upload.image, kNothing, VK_IMAGE_LAYOUT_UNDEFINED, kCopied,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        copy.imageExtent = {upload.extent.width, upload.extent.height, 1};
        vkCmdCopyBufferToImage(commands, upload.staging.buffer, upload.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                               &copy);
        for (uint32_t level = 1; level <= upload.levels; ++level) {
            const VkImageSubresourceRange done{VK_IMAGE_ASPECT_COLOR_BIT, level - 1, 1, 0, 1};
            transition(commands, upload.image, kCopied, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, kCopies,
                       VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, done);
            if (level == upload.levels)
                break;
            const VkImageBlit blit = halving(upload.extent, level);
            vkCmdBlitImage(commands, upload.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, upload.image,
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_LINEAR);
        }
        transition(commands, upload.image, kCopies, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, kSampled,
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        retired.add(frame, [gpu = gpu_, staging = upload.staging] { destroyBuffer(gpu, staging); });
    }
    uploads_.clear();
}

void Materials::destroy() {
    for (const Material& material : all_) {
        vkDestroySampler(gpu_.device, material.sampler, nullptr);
        destroyImage(gpu_, material.texture);
    }
    for (const Upload& upload : uploads_)
        destroyBuffer(gpu_, upload.staging);
}

} // namespace qt_quick
