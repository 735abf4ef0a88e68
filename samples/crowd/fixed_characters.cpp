// Characters that all have one rate: from stored vertices, or evaluated while they are drawn (SUPPLE_GROUP_DIRECT).
#include "characters.h"
#include "host/must.h"
#include "host/rendering.h"
#include "shaders/character_frag.h"
#include "shaders/fixed_mesh.h"
#include "shaders/fixed_mesh_SUPPLE_PATCH_TEXELS.h"
#include "shaders/fixed_vert.h"
#include "shaders/fixed_vert_DIRECT.h"
#include "shaders/fixed_vert_DIRECT_SUPPLE_PATCH_TEXELS.h"
#include "shaders/supple_patch_layout.h"
#include "shaders/supple_patch_tiles.h"

#include <algorithm>
#include <bit>

namespace crowd {

namespace {

/// A SupplePatchRange, or a SuppleRange and nothing behind it.
using RangeWords = std::array<uint32_t, sizeof(SupplePatchRange) / sizeof(uint32_t)>;
/// fixed.vert, fixed.mesh
struct FixedPush {
    RangeWords range;
    uint32_t sun;
    uint32_t commandWord;  ///< mesh shaders: where the draw's command stands
    uint32_t firstVisible; ///< the first instance of the call
};

class FixedCharacters final : public Characters {
public:
    FixedCharacters(Device& device, const Crowd& crowd, VkDescriptorSetLayout scene);
    void addToGraph(Graph&, Resource) const override {}
    [[nodiscard]] std::vector<Use> uses(Resource buffers) const override {
        Scope drawn = kDrawn;
        drawn.access |= VK_ACCESS_2_SHADER_SAMPLED_READ_BIT; // texels
        if (drawMeshTasks_ != nullptr)
            drawn.stages |= VK_PIPELINE_STAGE_2_MESH_SHADER_BIT_EXT;
        return {reads(buffers, drawn)};
    }
    void draw(VkCommandBuffer commands, VkDescriptorSet scene, bool sun, bool paint) const override;

private:
    [[nodiscard]] std::vector<Write> writesOf(Device& device, const Kind& kind, uint32_t window) const;
    void createPipelines(Device& device);
    void drawTiles(VkCommandBuffer commands, FixedPush push, const SupplePatchRange& range, uint32_t instances) const;
    [[nodiscard]] RangeWords rangeOf(const Kind& kind, uint32_t range, uint32_t window) const;

    const Crowd& crowd_;
    bool direct_ = false, texels_ = false;
    PFN_vkCmdDrawMeshTasksEXT drawMeshTasks_ = nullptr; ///< if a mesh shader draws
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline sunPipeline_ = VK_NULL_HANDLE, picturePipeline_ = VK_NULL_HANDLE;
    std::array<std::vector<VkDescriptorSet>, kKinds> sets_; ///< by window
};

/// What a window has of a buffer that has so much for each slot.
SuppleBufferRange ofWindow(const Kind& kind, SuppleBufferRange range, VkDeviceSize bytesOfSlot, uint32_t window) {
    const uint32_t first = window * kind.info.windowSize;
    range.offset += first * bytesOfSlot;
    range.size = std::min(kind.info.windowSize, kind.info.capacity - first) * bytesOfSlot;
    return range;
}

std::vector<Write> FixedCharacters::writesOf(Device& device, const Kind& kind, uint32_t window) const {
    std::vector<Write> writes{storageBuffer(0, kind.info.instances), storageBuffer(3, kind.streams.attributes),
                              storageBuffer(8, kind.info.userData)};
    if (!direct_) {
        const VkDeviceSize bytes = VkDeviceSize{kind.grid.verticesPerInstance} * kind.streams.vertices.stride;
        writes.push_back(storageBuffer(1, ofWindow(kind, kind.streams.vertices, bytes, window)));
        return writes;
    }
    const VkDeviceSize bytes = VkDeviceSize{16} * kind.direct.ranges[0].coefficientsPerInstance;
    const SuppleBufferRange coefficients = ofWindow(kind, kind.direct.coefficients, bytes, window);
    if (texels_) {
        writes.push_back(texels(6, must(createTexels(device, kind.direct.tables, VK_FORMAT_R32G32B32A32_UINT))));
        writes.push_back(texels(7, must(createTexels(device, coefficients, VK_FORMAT_R32G32B32A32_SFLOAT))));
    } else {
        writes.push_back(storageBuffer(6, kind.direct.tables));
        writes.push_back(storageBuffer(7, coefficients));
    }
    if (drawMeshTasks_ != nullptr)
        writes.push_back(storageBuffer(9, kind.grid.indirect.buffer, 0, VK_WHOLE_SIZE));
    return writes;
}

FixedCharacters::FixedCharacters(Device& device, const Crowd& crowd, VkDescriptorSetLayout scene)
    : crowd_(crowd), direct_(crowd.isDirect()), texels_(device.isCpu()), drawMeshTasks_(device.drawMeshTasks()) {
    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    const VkDescriptorType patches = texels_ ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER : kStorage;
    const VkShaderStageFlags stage =
        drawMeshTasks_ != nullptr ? VK_SHADER_STAGE_MESH_BIT_EXT : VK_SHADER_STAGE_VERTEX_BIT;
    // The bindings of shaders/supple_surface.glsl, supple_patch.glsl and supple_patch_tiles.glsl.
    std::vector<Binding> bindings{{0, kStorage, stage}, {3, kStorage, stage}, {8, kStorage, stage}};
    if (direct_) {
        bindings.insert(bindings.end(), {{6, patches, stage}, {7, patches, stage}});
    } else {
        bindings.push_back({1, kStorage, stage});
    }
    if (drawMeshTasks_ != nullptr)
        bindings.push_back({9, kStorage, stage});
    const VkDescriptorSetLayout setLayout = must(createSetLayout(device, bindings));
    layout_ = must(createPipelineLayout(device, {scene, setLayout}, sizeof(FixedPush), stage));
    uint32_t windows = 0;
    for (const Kind& kind : crowd.kinds())
        windows += kind.info.windowCount;
    DescriptorPool pool = must(DescriptorPool::create(device, 2 * windows)); // room for eight storage buffers each
    for (size_t k = 0; k < kKinds; ++k) {
        if (direct_ && crowd.kinds()[k].direct.layout != SUPPLE_PATCH_LAYOUT)
            fail("the shaders were compiled for another layout of patches than the library has");
        for (uint32_t w = 0; w < crowd.kinds()[k].info.windowCount; ++w) {
            sets_[k].push_back(must(pool.allocate(setLayout)));
            pool.write(sets_[k].back(), writesOf(device, crowd.kinds()[k], w));
        }
    }
    createPipelines(device);
}

void FixedCharacters::createPipelines(Device& device) {
    GraphicsDesc sun{.layout = layout_, .depth = kDepthFormat, .depthBias = 1.0f, .depthBiasSlope = 1.5f};
    if (drawMeshTasks_ != nullptr)
        sun.meshShader = texels_ ? std::span<const uint32_t>(fixed_mesh_SUPPLE_PATCH_TEXELS) : fixed_mesh;
    else if (direct_)
        sun.vertexShader =
            texels_ ? std::span<const uint32_t>(fixed_vert_DIRECT_SUPPLE_PATCH_TEXELS) : fixed_vert_DIRECT;
    else
        sun.vertexShader = fixed_vert;
    sunPipeline_ = must(createGraphicsPipeline(device, sun));
    picturePipeline_ = must(createGraphicsPipeline(device, {.layout = layout_,
                                                            .vertexShader = sun.vertexShader,
                                                            .meshShader = sun.meshShader,
                                                            .fragmentShader = character_frag,
                                                            .colors = {kColorFormat},
                                                            .depth = kDepthFormat}));
}

RangeWords FixedCharacters::rangeOf(const Kind& kind, uint32_t range, uint32_t window) const {
    const uint32_t firstSlot = window * kind.info.windowSize;
    if (direct_) {
        SupplePatchRange patches = kind.direct.ranges[range];
        patches.firstSlot = firstSlot;
        return std::bit_cast<RangeWords>(patches);
    }
    const SuppleDrawRange& draw = kind.grid.drawRanges[range];
    return {draw.patchCount, draw.firstVertex, draw.samplesPerPatch, kind.grid.verticesPerInstance, firstSlot};
}

/// As many calls as it takes: a device need not take more workgroups by one.
void FixedCharacters::drawTiles(VkCommandBuffer commands, FixedPush push, const SupplePatchRange& range,
                                uint32_t instances) const {
    constexpr uint32_t kMostWorkgroups = 1u << 22, kMostAlong = 65535; // VK_EXT_mesh_shader: limits are at least these
    const uint32_t tiles = SUPPLE_PATCH_TILES(range.patchClass, range.rate);
    if (range.patchCount > kMostAlong)
        fail("a mesh shader draws at most 65535 patches of a class");
    const uint32_t perCall = std::min(kMostAlong, std::max(kMostWorkgroups / (tiles * range.patchCount), 1u));
    for (; push.firstVisible < instances; push.firstVisible += perCall) {
        vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_MESH_BIT_EXT, 0, sizeof push, &push);
        drawMeshTasks_(commands, tiles, range.patchCount, std::min(perCall, instances - push.firstVisible));
    }
}

void FixedCharacters::draw(VkCommandBuffer commands, VkDescriptorSet scene, bool sun, bool) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, sun ? sunPipeline_ : picturePipeline_);
    for (size_t k = 0; k < kKinds; ++k) {
        const Kind& kind = crowd_.kinds()[k];
        const SuppleGridOutput& grid = kind.grid;
        vkCmdBindIndexBuffer(commands, grid.indices.buffer, grid.indices.offset, VK_INDEX_TYPE_UINT16);
        for (uint32_t w = 0; w < kind.info.windowCount; ++w) {
            const VkDescriptorSet sets[] = {scene, sets_[k][w]};
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 2, sets, 0, nullptr);
            for (uint32_t r = 0; r < grid.drawRangeCount; ++r) {
                const VkDeviceSize command =
                    grid.indirect.offset + (VkDeviceSize{w} * grid.drawRangeCount + r) * grid.indirect.stride;
                const FixedPush push{rangeOf(kind, r, w), sun ? 1u : 0u, static_cast<uint32_t>(command / 4), 0};
                if (drawMeshTasks_ != nullptr) {
                    drawTiles(commands, push, kind.direct.ranges[r],
                              std::min(kind.info.windowSize, kind.info.capacity - w * kind.info.windowSize));
                    continue;
                }
                vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, &push);
                vkCmdDrawIndexedIndirect(commands, grid.indirect.buffer, command, 1, 0);
            }
        }
    }
}

} // namespace

std::unique_ptr<Characters> makeFixedCharacters(Device& device, const Crowd& crowd, VkDescriptorSetLayout scene) {
    return std::make_unique<FixedCharacters>(device, crowd, scene);
}

} // namespace crowd
