// What sits on the surface of a figure's group: props, which a point carries, and decals. They move with every instance
// of the group, with all schemes, at every rate and level of detail.
#pragma once

#include "host/decal.h"
#include "host/device.h"
#include "host/figure.h"
#include "host/picture.h"
#include "host/pipelines.h"
#include "host/shaders/draw.h"

#include <deque>
#include <memory>
#include <span>
#include <vector>

namespace supple::host {

/// How attachments are drawn. The pipelines live as long as the device.
struct AttachmentPipelines {
    VkDescriptorSetLayout set = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline prop = VK_NULL_HANDLE;
    VkPipeline propShadow = VK_NULL_HANDLE;
    VkPipeline decal = VK_NULL_HANDLE;
};

/// What a decal looks like.
struct DecalLook {
    Picture color;   ///< sRGB with alpha
    Picture normals; ///< a tangent space normal map, +Y up; empty: flat
    float roughness = 0.5f;
};

class Attachments {
public:
    static constexpr uint32_t kMost = 64; ///< of a group

    /// The group must outlive them. They may go only when no pending frame uses them.
    [[nodiscard]] static Result<std::unique_ptr<Attachments>>
    create(Device& device, const AttachmentPipelines& pipelines, const FigureGroup& group);
    ~Attachments();
    Attachments(const Attachments&) = delete;
    Attachments& operator=(const Attachments&) = delete;

    /// A prop stands on a point: its z is outwards there. `vertices`: triangles; `scale` multiplies their positions.
    [[nodiscard]] Status addProp(const SuppleSurfacePoint& at, std::span<const shared::AttachmentVertex> vertices,
                                 float scale);
    [[nodiscard]] Status addDecal(const DecalDesc& desc, const DecalLook& look);

    [[nodiscard]] size_t count() const { return all_.size(); }
    /// What the decals cover.
    [[nodiscard]] const std::deque<Decal>& decals() const { return decals_; }

    /// Behind the opaque surface. The frame's set is bound, set 1 is another one afterwards. `segments`: those of the
    /// drawn surface along an edge of the cage; 0: levels of detail, which lie within a pixel.
    void draw(VkCommandBuffer commands, uint32_t segments) const;
    /// Into the shadow map of a light.
    void drawShadow(VkCommandBuffer commands, uint32_t light) const;

private:
    struct Entry {
        SupplePointSet points{};
        const Decal* decal = nullptr; ///< null: a prop
        Buffer vertices;
        Buffer indices; ///< of a decal
        uint32_t indexCount = 0;
        Image color, normals;
        VkDescriptorSet set = VK_NULL_HANDLE;
        shared::AttachmentPush push{};
    };

    Attachments(Device& device, const AttachmentPipelines& pipelines, const FigureGroup& group)
        : device_(device), pipelines_(pipelines), group_(group) {}
    [[nodiscard]] Status createPool();
    [[nodiscard]] Status add(Entry entry, std::span<const SuppleSurfacePoint> points,
                             std::span<const glm::vec3> tangents, std::span<const shared::AttachmentVertex> vertices,
                             const DecalLook& look);
    [[nodiscard]] Status write(Entry& entry, const SupplePointOutput& output) const;
    void drawEntry(VkCommandBuffer commands, const Entry& entry, const shared::AttachmentPush& push) const;

    Device& device_;
    const AttachmentPipelines& pipelines_;
    const FigureGroup& group_;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkSampler sampler_ = VK_NULL_HANDLE;
    std::vector<Entry> all_;
    std::deque<Decal> decals_; ///< which do not move
};

} // namespace supple::host
