#include "cloth.h"

#include "host/must.h"

#include "shaders/cloth_comp.h"

#include <cstring>

namespace cloth {

namespace {

constexpr uint32_t kSteps = 10; // a frame

/// The shader's Push.
struct SimulationPush {
    uint32_t columns;
    uint32_t rows;
    uint32_t steps;
    uint32_t begin;
    float seconds;
    float step;
    float spacing;
    uint32_t cageVerticesPerInstance;
};

/// The grid as arrays. The positions are those of the cage at rest; every frame has others.
supple::Asset createGrid(const supple::Context& context) {
    std::vector<float> positions;
    std::vector<float> uvs; // a vertex
    for (uint32_t j = 0; j < kRows; ++j) {
        for (uint32_t i = 0; i < kColumns; ++i) {
            positions.insert(positions.end(),
                             {kSpacing * static_cast<float>(i), -kSpacing * static_cast<float>(j), 0.0f});
            uvs.insert(uvs.end(), {static_cast<float>(i) / (kColumns - 1), static_cast<float>(j) / (kRows - 1)});
        }
    }
    std::vector<uint32_t> indices;
    std::vector<float> cornerUvs;
    for (uint32_t j = 0; j + 1 < kRows; ++j) {
        for (uint32_t i = 0; i + 1 < kColumns; ++i) {
            const uint32_t first = j * kColumns + i;
            for (const uint32_t vertex : {first, first + kColumns, first + kColumns + 1, first + 1}) {
                indices.push_back(vertex);
                cornerUvs.insert(cornerUvs.end(), {uvs[2 * vertex], uvs[2 * vertex + 1]});
            }
        }
    }
    const std::vector<uint32_t> counts(indices.size() / 4, 4);
    // Else the surface would round the corners of the sheet off.
    const uint32_t corners[] = {0, kColumns - 1, (kRows - 1) * kColumns, kRows * kColumns - 1};
    const float sharpnesses[] = {10.0f, 10.0f, 10.0f, 10.0f};

    auto cage = supple::sized<SuppleCageDesc>();
    cage.vertexCount = kColumns * kRows;
    cage.faceCount = static_cast<uint32_t>(counts.size());
    cage.positions = positions.data();
    cage.faceVertexCounts = counts.data();
    cage.faceVertexIndices = indices.data();
    cage.cornerUvs = cornerUvs.data();
    cage.cornerCount = 4;
    cage.cornerVertices = corners;
    cage.cornerSharpnesses = sharpnesses;
    auto desc = supple::sized<SuppleAssetDesc>();
    desc.name = "sheet";
    desc.cage = &cage;
    supple::Asset asset;
    must(supple::Asset::create(context, desc, asset), "suppleCreateAsset");
    return asset;
}

} // namespace

Cloth::Cloth(Device& device, uint32_t rate, const std::string& record) {
    createSupple(device, rate, record);
    createSimulation(device);
}

void Cloth::createSupple(Device& device, uint32_t rate, const std::string& record) {
    context_ = mustCreateContext(device, record);
    asset_ = createGrid(context_);

    auto groupDesc = supple::sized<SuppleGroupDesc>();
    groupDesc.flags = SUPPLE_GROUP_ATTRIBUTES; // UVs
    groupDesc.asset = asset_.handle();
    groupDesc.capacity = static_cast<uint32_t>(sheets_.size());
    groupDesc.rate = rate;
    groupDesc.poseSource = SUPPLE_POSES_CAGE_BUFFER; // the cage's vertices are the host's
    must(supple::Group::create(context_, groupDesc, group_), "suppleCreateGroup");
    for (supple::Instance& sheet : sheets_)
        must(supple::Instance::create(group_, sheet), "suppleCreateInstance");
    must(group_.info(info_), "suppleGetGroupInfo");
    must(group_.surfaceInfo(surface_), "suppleGetSurfaceInfo");
    must(group_.vertexStreams(streams_), "suppleGetVertexStreams");
    must(group_.gridOutput(grid_), "suppleGetGridOutput");
}

void Cloth::createSimulation(Device& device) {
    // A flag on a pole, and a heavier banner under a crossbar, which has a little less room than the cloth is wide.
    const Sheet sheets[] = {{{-2.9f, 3.75f, 0.0f, 1.0f},
                             {1.0f, 0.0f, 0.0f, 1.0f},
                             {0.0f, -1.0f, 0.0f, 0.0f},
                             {sheets_[0].handle().slot, 0, 0, 0}},
                            {{0.95f, 3.568f, 0.40f, 0.93f},
                             {0.0f, -1.0f, 0.0f, 0.16f},
                             {0.90f, 0.0f, -0.436f, 0.0f},
                             {sheets_[1].handle().slot, 0, 0, 0}}};
    sheetBuffer_ = must(device.createBuffer(sizeof sheets, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::upload));
    std::memcpy(sheetBuffer_.mapped(), sheets, sizeof sheets);
    constexpr VkDeviceSize kPointBytes = 2 * sizeof(glm::vec4);
    pointBuffer_ = must(device.createBuffer(sheets_.size() * kColumns * kRows * kPointBytes,
                                            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::device));

    constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    constexpr VkShaderStageFlags kCompute = VK_SHADER_STAGE_COMPUTE_BIT;
    const VkDescriptorSetLayout setLayout =
        must(createSetLayout(device, {{0, kStorage, kCompute}, {1, kStorage, kCompute}, {2, kStorage, kCompute}}));
    layout_ = must(createPipelineLayout(device, {setLayout}, sizeof(SimulationPush), kCompute));
    pipeline_ = must(createComputePipeline(device, layout_, cloth_comp));
    DescriptorPool pool = must(DescriptorPool::create(device, 1));
    set_ = must(pool.allocate(setLayout));
    pool.write(set_,
               {storageBuffer(0, sheetBuffer_.handle(), 0, sheetBuffer_.size()),
                storageBuffer(1, pointBuffer_.handle(), 0, pointBuffer_.size()), storageBuffer(2, info_.deformedCage)});
}

void Cloth::beginFrame(uint64_t frame, uint64_t completed) const {
    must(context_.beginFrame(frame, completed), "suppleBeginFrame");
}

void Cloth::simulate(VkCommandBuffer commands, double seconds) {
    // What Supple recorded last frame reads the cage in compute shaders, and the last simulation wrote the points.
    const VkMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                   .srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                   .srcAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                   .dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                   .dstAccessMask =
                                       VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(commands, &dependency);
    const SimulationPush push{kColumns,
                              kRows,
                              kSteps,
                              begun_ ? 0u : 1u,
                              static_cast<float>(seconds),
                              1.0f / 60.0f / kSteps,
                              kSpacing,
                              info_.cageVerticesPerInstance};
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
    vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof push, &push);
    vkCmdDispatch(commands, static_cast<uint32_t>(sheets_.size()), 1, 1);
    begun_ = true;
}

void Cloth::record(VkCommandBuffer commands, double seconds) {
    simulate(commands, seconds);
    constexpr SuppleSyncScope kDraws{VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT |
                                         VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT,
                                     VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT |
                                         VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
    // Before Supple's passes: the last frame's draws, and our writes into the cage. After them: this frame's draws.
    const SuppleSyncScope before{kDraws.stages | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                 kDraws.access | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
    const SuppleGroup groups[] = {group_.handle()};
    must(context_.record(commands, groups, before, kDraws), "suppleRecord");
}

} // namespace cloth
