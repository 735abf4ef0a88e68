// Draws a figure's group: its surface in one of several views, or its deformed cage, in the studio's light.
#pragma once

#include "host/attachments.h"
#include "host/camera.h"
#include "host/draw_pipelines.h"
#include "host/draw_target.h"
#include "host/figure.h"
#include "host/ray_scene.h"
#include "host/studio.h"

#include <memory>
#include <optional>
#include <vector>

namespace supple::host {

/// What the renderer does with a group's outputs: SuppleRecordDesc::after, and ::before of the next frame.
inline constexpr SuppleSyncScope kRendererReads = {
    VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
    VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT};

struct RendererOptions {
    VkFormat colorFormat = kPictureFormat;
    StudioQuality quality;
    uint32_t framesInFlight = 1; ///< pictures that may be pending at once
    /// What the light sees, as rays find it: soft shadows, corners that are dark. Null: as shadow maps have it. The
    /// scene must hold what is drawn, and outlive the renderer; the cage is lit by shadow maps all the same.
    const RayScene* rays = nullptr;
};

/// The descriptor sets of one group and its figure's materials. Like the group it may go only when no pending frame
/// uses it.
class FigureBinding {
public:
    FigureBinding() = default;
    FigureBinding(FigureBinding&& other) noexcept { *this = std::move(other); }
    FigureBinding& operator=(FigureBinding&& other) noexcept;
    ~FigureBinding();

private:
    friend class SurfaceRenderer;
    VkDevice device_ = VK_NULL_HANDLE;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    std::vector<VkDescriptorSet> surfaces_;  ///< as FigureGroup::surfaces()
    std::vector<VkDescriptorSet> materials_; ///< as FigureMaterials::infos()
    Buffer uniforms_;                        ///< of all materials
    std::vector<VkSampler> samplers_;
};

struct Scene {
    const FigureGroup* group = nullptr; ///< none: an empty studio
    const FigureBinding* binding = nullptr;
    const Attachments* attachments = nullptr; ///< of the group; drawn on its shaded surface
    Camera camera;
    Bounds bounds;                     ///< of the figure over all the time it is shown
    std::optional<float> ground;       ///< height of the floor
    std::optional<glm::vec3> backdrop; ///< one color, linear, instead of the studio's walls
    float lightYaw = 0.0f;             ///< the studio is set up for a viewer who stands here (Camera::yaw)
    uint32_t view = 0;                 ///< shared::kView...
    bool cageFaces = false;            ///< the cage instead of the surface
    bool cageEdges = false;
    /// The cage beside the surface: both as they stand in the right part of the picture, of which this is the left end
    /// (a fraction of the width). They are moved into its halves.
    std::optional<float> split;
    /// Instead of the renderer's: no more lights, no larger maps, the same samples.
    std::optional<StudioQuality> quality;
    uint32_t pass = 0;        ///< of StudioQuality::passes
    bool coarse = false;      ///< the surface on the grid of its shadows
    float pixelScale = 1.0f;  ///< line widths are multiplied by it
    float lightTubes = 10.0f; ///< of the zebra, from one pole to the other
};

class SurfaceRenderer {
public:
    [[nodiscard]] static Result<std::unique_ptr<SurfaceRenderer>> create(Device& device,
                                                                         const RendererOptions& options = {});
    ~SurfaceRenderer();
    SurfaceRenderer(const SurfaceRenderer&) = delete;
    SurfaceRenderer& operator=(const SurfaceRenderer&) = delete;

    [[nodiscard]] Result<FigureBinding> bind(const FigureGroup& group);

    /// For Attachments of what this renderer draws.
    [[nodiscard]] Result<std::unique_ptr<Attachments>> createAttachments(const FigureGroup& group);

    [[nodiscard]] const StudioQuality& quality() const { return quality_; }

    /// What the targets of this renderer must have.
    [[nodiscard]] VkSampleCountFlagBits samples() const { return pictureSamples(device_, quality_.multisample); }
    /// Makes the pipelines of a scene that there are none of yet: before its first picture in this view.
    [[nodiscard]] Status prepare(const Scene& scene);
    /// Records the whole picture of a prepared scene, outside of rendering. `slot` (below framesInFlight) must not be
    /// in use by a pending picture; the target is left in TRANSFER_SRC_OPTIMAL, visible to copies.
    void record(VkCommandBuffer commands, uint32_t slot, const DrawTarget& target, const Scene& scene);

private:
    struct Slot {
        Buffer uniforms;
        VkDescriptorSet set = VK_NULL_HANDLE;
    };

    explicit SurfaceRenderer(Device& device) : device_(device) {}
    [[nodiscard]] Status createShadowMaps();
    [[nodiscard]] Status createEnvironment();
    [[nodiscard]] Status createSlots(uint32_t count);
    void writeRays(VkDescriptorSet set) const;
    [[nodiscard]] Status allocateSets(FigureBinding& binding, const FigureGroup& group) const;
    void writeFigureSet(VkDescriptorSet set, const FigureGroup& group, const FigureSurface& surface) const;
    [[nodiscard]] Status writeMaterialSets(FigureBinding& binding, const Figure& figure) const;
    [[nodiscard]] Status writeMaterialUniforms(FigureBinding& binding, const Figure& figure) const;
    [[nodiscard]] Status writeLayerTextures(FigureBinding& binding, size_t material,
                                            const FigureMaterials& materials) const;
    [[nodiscard]] Status writeTexture(FigureBinding& binding, size_t material, uint32_t slot, uint32_t element,
                                      const Image& image, const SuppleTextureInfo& texture) const;
    void writeUniforms(const Slot& slot, VkExtent2D extent, const Scene& scene) const;
    void recordShadows(VkCommandBuffer commands, const Scene& scene) const;
    /// A part of the picture with a scene of its own.
    struct Pane {
        Scene scene;
        VkRect2D area{};
        float shift = 0.0f; ///< of the scene to the right, in pixels
    };
    /// One, or the two of Scene::split.
    [[nodiscard]] static std::vector<Pane> panesOf(const Scene& scene, VkExtent2D extent);
    void drawPane(VkCommandBuffer commands, const DrawTarget& target, const Pane& pane) const;
    void drawScene(VkCommandBuffer commands, const Scene& scene) const;
    /// With what all draws of the surface have in common.
    [[nodiscard]] shared::DrawPush completed(shared::DrawPush push, const FigureSurface& surface, uint32_t light) const;
    void bindSurface(VkCommandBuffer commands, const Scene& scene, size_t surface) const;
    void bindMaterial(VkCommandBuffer commands, const Scene& scene, uint32_t material) const;
    void pushConstants(VkCommandBuffer commands, const shared::DrawPush& push) const;
    void drawShadow(VkCommandBuffer commands, const Scene& scene, uint32_t light) const;
    void drawSurfaceShadow(VkCommandBuffer commands, const Scene& scene, const FigureSurface& surface,
                           uint32_t light) const;
    /// Faces of one part and material: a draw of a surface, or a range of the cage.
    struct DrawRun {
        size_t surface = 0;
        size_t range = 0;
        uint32_t part = 0;
        uint32_t material = SUPPLE_NO_MATERIAL;
    };
    [[nodiscard]] std::vector<DrawRun> runsOf(const Scene& scene) const;
    [[nodiscard]] DrawPipelines::Faces facesOf(const Scene& scene, const DrawRun& run, Blend blend) const;
    /// What the scene, of one pane, draws with.
    [[nodiscard]] std::vector<DrawPipelines::Faces> allFaces(const Scene& scene) const;
    /// Leaves the runs that blend, the farthest first.
    void keepBlended(std::vector<DrawRun>& runs, const Scene& scene) const;
    /// blend: what blends, over what is there; else what hides all behind it, also where a material that blends is
    /// solid.
    void drawFaces(VkCommandBuffer commands, const Scene& scene, const std::vector<DrawRun>& runs, bool blend) const;
    /// flags: shared::kDraw..., besides those of the surface.
    void drawRun(VkCommandBuffer commands, const Scene& scene, const DrawRun& run, VkCullModeFlags cull,
                 uint32_t flags) const;
    void drawCageShadow(VkCommandBuffer commands, const Scene& scene, uint32_t light) const;
    void drawCageEdges(VkCommandBuffer commands, const Scene& scene) const;

    Device& device_;
    StudioQuality quality_;
    const RayScene* rays_ = nullptr;
    std::unique_ptr<DrawPipelines> pipelines_;
    Image shadowMaps_;
    std::vector<VkImageView> shadowLayers_;
    Image environment_;
    float keyRadiance_ = 1.0f; ///< see StudioEnvironment
    float rimRadiance_ = 1.0f;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    std::vector<Slot> slots_;
};

} // namespace supple::host
