#include "tools/bench/workbench.h"

#include "runtime/context.h"
#include "runtime/cpu_group.h"
#include "runtime/playback_desc.h"
#include "runtime/points/find_points.h"
#include "runtime/prepare.h"
#include "tools/common/inside_output.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace supple::bench {

namespace {

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkAccessFlags2 kRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
constexpr VkAccessFlags2 kWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
constexpr float kCameraDistance = 4.0f, kPixelsPerUnit = 1000.0f;
constexpr float kEyeDistance = 1000.0f; ///< of a camera that looks ahead or away

void computeBarrier(VkCommandBuffer commands) {
    host::memoryBarrier(commands, {kCompute, kWrite}, {kCompute, kRead | kWrite});
}

/// For each window of instances come `of` dispatches: lets one of them through.
class OneOfDispatches final : public gpu::Dispatches {
public:
    OneOfDispatches(const gpu::Device& device, VkCommandBuffer commands, size_t which, size_t of)
        : Dispatches(device, commands), single_(device, commands), which_(which), of_(of) {}
    void dispatch(const gpu::Kernel& kernel, const gpu::BoundSet& bound, std::span<const std::byte> push,
                  uint64_t groups) override {
        if (count_++ % of_ == which_) {
            single_.dispatch(kernel, bound, push, groups);
        }
    }
    void dispatchIndirect(const gpu::Kernel& kernel, const gpu::BoundSet& bound, std::span<const std::byte> push,
                          VkBuffer arguments, VkDeviceSize offset) override {
        if (count_++ % of_ == which_) {
            single_.dispatchIndirect(kernel, bound, push, arguments, offset);
        }
    }
    void flush() override {}

private:
    gpu::SingleDispatches single_;
    size_t which_, of_, count_ = 0;
};

SuppleCameraDesc benchCamera() {
    SuppleCameraDesc camera{};
    camera.structSize = sizeof camera;
    camera.position[2] = kCameraDistance;
    camera.pixelsPerUnit = kPixelsPerUnit;
    return camera;
}

} // namespace

struct Workbench::Inside {
    std::unique_ptr<runtime::Context> context;
    uint64_t frame = 0;

    [[nodiscard]] runtime::Group& group(SuppleGroup id) const { return *context->groups.find(id.id); }
    /// From far away towards the origin (1) or away from it (-1).
    void look(SuppleView view, float ahead) const;
};

Workbench::Workbench() : inside_(std::make_unique<Inside>()) {}
Workbench::~Workbench() = default;

Result<std::unique_ptr<Workbench>> Workbench::create(const SuppleContextDesc& desc) {
    Result<std::unique_ptr<runtime::Context>> context = runtime::Context::create(desc);
    if (!context) {
        return context.error();
    }
    std::unique_ptr<Workbench> bench(new Workbench);
    bench->inside_->context = std::move(*context);
    return bench;
}

Result<SuppleAsset> Workbench::createAsset(cage::Character character) {
    Result<uint64_t> asset = inside_->context->createAsset(std::move(character), 0);
    if (!asset) {
        return asset.error();
    }
    return SuppleAsset{*asset};
}

std::shared_ptr<const runtime::Prepared> Workbench::prepare(cage::Character character,
                                                            const SuppleGroupDesc& desc) const {
    const std::shared_ptr<runtime::Prepared> prepared = runtime::Prepared::of(std::move(character));
    const bool wide = inside_->context->isWide();
    return runtime::prepareFor(*prepared, {desc, std::nullopt}, wide) ? prepared : nullptr;
}

Result<std::function<void()>> Workbench::cpuGrid(cage::Character character, SuppleScheme scheme, uint32_t rate) {
    struct Grid {
        explicit Grid(std::shared_ptr<const runtime::CpuGroup> group) : pose(std::move(group)) {}
        runtime::CpuPose pose;
        std::vector<float> positions, normals;
    };
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.scheme = scheme;
    const std::vector<glm::vec3> cage = character.cage.positions;
    const auto group = runtime::CpuGroup::create(runtime::Prepared::of(std::move(character)), desc);
    if (!group) {
        return group.error();
    }
    const auto grid = std::make_shared<Grid>(*group);
    const uint64_t vertices = runtime::CpuGroup::vertexCount((*group)->parts().front(), rate);
    grid->positions.resize(3 * vertices);
    grid->normals.resize(3 * vertices);
    if (const Status built = grid->pose.build(reinterpret_cast<const std::byte*>(cage.data()), sizeof(cage[0]), {});
        !built) {
        return built.error();
    }
    return std::function<void()>([grid, rate] {
        // It can only run out of memory, and the grid has its own.
        (void)grid->pose.evaluateGrid(0, rate, grid->positions.data(), grid->normals.data(), {}).ok();
    });
}

Result<SuppleAsset> Workbench::createAsset(std::shared_ptr<const runtime::Prepared> prepared) {
    const Result<uint64_t> asset = inside_->context->createAsset(std::move(prepared), 0);
    if (!asset) {
        return asset.error();
    }
    return SuppleAsset{*asset};
}

Status Workbench::scatterPoints(SuppleGroup group, uint32_t count) {
    runtime::Group& own = inside_->group(group);
    const auto surfaces = runtime::Context::surfacesOf(own);
    if (!surfaces) {
        return surfaces.error();
    }
    SupplePointQuery query{};
    query.structSize = sizeof query;
    query.kind = SUPPLE_FIND_SCATTER;
    query.count = count;
    std::vector<SuppleSurfacePoint> points(count);
    if (const Status found = runtime::findPoints(*surfaces, own.points().finder(), query, points); !found) {
        return found;
    }
    SupplePointSetDesc desc{};
    desc.structSize = sizeof desc;
    desc.group = group;
    desc.points = points.data();
    desc.pointCount = count;
    const Result<uint64_t> set = inside_->context->createPointSet(desc);
    return set ? success() : Status(set.error());
}

Result<SuppleQueryPool> Workbench::createQueryPool(SuppleGroup group, uint32_t rayCount) {
    SuppleQueryPoolDesc desc{};
    desc.structSize = sizeof desc;
    desc.groups = &group;
    desc.groupCount = 1;
    desc.rayCount = rayCount;
    const Result<uint64_t> pool = inside_->context->createQueryPool(desc);
    return pool ? Result<SuppleQueryPool>(SuppleQueryPool{*pool}) : pool.error();
}

Status Workbench::recordQueries(SuppleQueryPool pool, VkCommandBuffer commands, std::span<const SuppleRay> rays) {
    SuppleQueryDesc desc{};
    desc.structSize = sizeof desc;
    desc.hostRays = rays.data();
    desc.rayCount = static_cast<uint32_t>(rays.size());
    return inside_->context->recordQueries(commands, *inside_->context->queryPools.at(pool.id), desc);
}

Status Workbench::findRays(SuppleGroup group, std::span<const glm::vec3> cage, std::span<const float> rays) const {
    runtime::Group& own = inside_->group(group);
    const auto surfaces = runtime::Context::surfacesOf(own);
    if (!surfaces) {
        return surfaces.error();
    }
    SupplePointQuery query{};
    query.structSize = sizeof query;
    query.kind = SUPPLE_FIND_RAY;
    query.count = static_cast<uint32_t>(rays.size() / 6);
    query.values = rays.data();
    query.cage = &cage[0].x;
    query.cageVertexCount = static_cast<uint32_t>(cage.size());
    std::vector<SuppleSurfacePoint> points(query.count);
    return runtime::findPoints(*surfaces, own.points().finder(), query, points);
}

Result<SuppleGroup> Workbench::createGroup(SuppleGroupDesc desc, uint32_t updateInterval) {
    desc.structSize = sizeof desc;
    desc.capacity = std::max(desc.capacity, 1u);
    if (desc.view.id == 0) { // nothing is drawn, so that it need not be bound as a whole
        desc.flags |= SUPPLE_GROUP_WINDOWS;
    }
    Result<uint64_t> id = inside_->context->createGroup(desc);
    if (!id) {
        return id.error();
    }
    runtime::Group& group = inside_->group({*id});
    for (uint32_t i = 0; i < desc.capacity; ++i) { // slots come in order
        (void)group.slots().create();
        group.poses().reset(i);
    }
    runtime::Playback* const played = group.poses().playback();
    const std::vector<cage::Clip>& clips = group.asset().character.clips;
    for (uint32_t i = 0; played != nullptr && !clips.empty() && i < desc.capacity; ++i) {
        SupplePlaybackLayer layer{};
        layer.flags = SUPPLE_LAYER_LOOP;
        layer.weight = layer.speed = 1.0f;
        layer.offset = clips.front().duration * phaseOf(i);
        SupplePlaybackDesc playback{};
        playback.structSize = sizeof playback;
        playback.layers = &layer;
        playback.layerCount = 1;
        runtime::PlaybackLayers layers;
        played->set(i, runtime::playbackOf(group.asset(), playback, layers), {}, updateInterval);
    }
    return SuppleGroup{*id};
}

void Workbench::setTime(SuppleGroup group, double seconds) {
    inside_->group(group).poses().playback()->setTime(seconds);
}

double Workbench::phaseOf(uint32_t instance) {
    constexpr double kGolden = 0.6180339887498949;
    return std::fmod(instance * kGolden, 1.0);
}

Result<SuppleView> Workbench::createView(SuppleViewDesc desc) {
    desc.structSize = sizeof desc;
    Result<uint64_t> id = inside_->context->createView(desc);
    if (!id) {
        return id.error();
    }
    inside_->context->views.find(*id)->setCamera(benchCamera());
    return SuppleView{*id};
}

void Workbench::Inside::look(SuppleView view, float ahead) const {
    SuppleCameraDesc camera = benchCamera();
    const glm::vec3 eye(0.0f, 0.0f, kEyeDistance);
    const glm::mat4 seen = glm::perspectiveRH_ZO(1.0f, 1.0f, 0.1f, 1e4f) *
                           glm::lookAtRH(eye, (1.0f - ahead) * eye, glm::vec3(0.0f, 1.0f, 0.0f));
    std::copy_n(&seen[0][0], 16, camera.viewProjection);
    context->views.find(view.id)->setCamera(camera);
}

void Workbench::lookAway(SuppleView view) {
    inside_->look(view, -1.0f);
}

void Workbench::lookAhead(SuppleView view) {
    inside_->look(view, 1.0f);
}

void Workbench::moveBehind(SuppleGroup group, uint32_t slot) {
    moveTo(group, slot, glm::dvec3(0.0, 0.0, 2.0 * kEyeDistance));
}

void Workbench::moveTo(SuppleGroup group, uint32_t slot, const glm::dvec3& position) {
    inside_->group(group).poses().setPosition(slot, position);
}

void Workbench::destroy(SuppleAsset asset) {
    inside_->context->assets.remove(asset.id);
}

void Workbench::destroy(SuppleGroup group) {
    inside_->context->destroyGroup(group.id);
}

void Workbench::destroy(SuppleView view) {
    inside_->context->destroyView(view.id);
}

void Workbench::destroy(SuppleQueryPool pool) {
    inside_->context->destroyQueryPool(pool.id);
}

Status Workbench::setUploadBudget(uint64_t bytes) {
    return inside_->context->setUploadBudget(bytes);
}

bool Workbench::isThere(SuppleGroup group) const {
    return inside_->context->uploadState(inside_->group(group)).complete != 0;
}

Status Workbench::recordFrame(SuppleGroup group, VkCommandBuffer commands, uint32_t flags) {
    const uint64_t frame = ++inside_->frame;
    Status status = inside_->context->beginFrame(frame, frame - 1);
    if (!status) {
        return status;
    }
    SuppleRecordDesc desc{};
    desc.structSize = sizeof(desc);
    desc.flags = flags;
    desc.groups = &group;
    desc.groupCount = 1;
    desc.before = {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE};
    desc.after = {VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
    return inside_->context->record(commands, desc);
}

const std::vector<SuppleTiming>& Workbench::timings() const {
    return inside_->context->timings.latest();
}

uint64_t Workbench::deviceMemoryOf(SuppleGroup group) const {
    const gpu::MemoryUse use = inside_->group(group).memoryUse();
    return use.total() - use.hostVisible();
}

uint32_t Workbench::verticesOf(SuppleView view) const {
    return inside_->context->views.find(view.id)->statistics().vertexCount;
}

Status Workbench::recordWarmUp(SuppleGroup group, VkCommandBuffer commands) {
    const uint64_t frame = ++inside_->frame;
    const Status status = inside_->context->beginFrame(frame, frame - 1);
    return status ? inside_->context->recordWarmUp(commands, {&group, 1}) : status;
}

void Workbench::recordEvaluate(SuppleGroup group, VkCommandBuffer commands) const {
    const runtime::Tessellation& surface = inside_->group(group).surfaces()[0];
    gpu::SingleDispatches dispatches(inside_->context->device(), commands);
    surface.inRounds(dispatches, [&](surface::Round& round) { (void)surface.recordEvaluate(round); });
}

Workbench::ClassRange Workbench::rangeOf(SuppleGroup group, const std::string& patchClass) const {
    const std::vector<surface::PatchRange>& ranges = inside_->group(group).surfaces()[0].tables().ranges;
    const uint32_t rate = output(group).grid.rate;
    ClassRange found;
    for (size_t r = 0; r < ranges.size(); ++r) {
        if (patchClass.empty() || surface::className(ranges[r].patchClass) == patchClass) {
            found.index = r;
            found.patches += ranges[r].section.count;
            found.vertices +=
                uint64_t{ranges[r].section.count} * surface::sampleCount(surface::domainOf(ranges[r].patchClass), rate);
        }
    }
    return found;
}

void Workbench::recordEvaluate(SuppleGroup group, VkCommandBuffer commands, const ClassRange& range) const {
    const runtime::Tessellation& surface = inside_->group(group).surfaces()[0];
    OneOfDispatches dispatches(inside_->context->device(), commands, range.index, surface.tables().ranges.size());
    surface.inRounds(dispatches, [&](surface::Round& round) { (void)surface.recordEvaluate(round); });
}

void Workbench::recordSkin(SuppleGroup id, VkCommandBuffer commands) const {
    runtime::Group& group = inside_->group(id);
    using Part = runtime::Playback::Part;
    gpu::SingleDispatches dispatches(inside_->context->device(), commands);
    for (const Part part : {Part::locals, Part::roots, Part::modifiers, Part::palette}) {
        if (group.poses().has(part)) {
            group.poses().recordPart(dispatches, part, group.windows());
            computeBarrier(commands);
        }
    }
    group.stages().record(dispatches, 0); // deform
}

void Workbench::recordCompute(SuppleGroup id, VkCommandBuffer commands) const {
    const runtime::Tessellation& surface = inside_->group(id).surfaces()[0];
    recordSkin(id, commands);
    computeBarrier(commands);
    gpu::SingleDispatches dispatches(inside_->context->device(), commands);
    for (const surface::Stage stage : {surface::Stage::vertex, surface::Stage::assemble}) {
        if (surface.has(stage)) {
            surface.inRounds(dispatches, [&](surface::Round& round) { (void)surface.recordStage(round, stage); });
            computeBarrier(commands);
        }
    }
    recordEvaluate(id, commands);
}

host::GroupOutput Workbench::output(SuppleGroup group) const {
    return tools::insideOutput(inside_->group(group));
}

uint32_t Workbench::regularPatches(SuppleGroup group) const {
    uint32_t count = 0;
    for (const surface::PatchRange& range : inside_->group(group).surfaces()[0].tables().ranges) {
        if (range.patchClass == surface::PatchClass::regular && range.firstPatch == count) {
            count += range.section.count;
        }
    }
    return count;
}

std::vector<QuadPatch> Workbench::quadPatches(SuppleGroup group) const {
    std::vector<QuadPatch> patches;
    for (const surface::PatchInfo& patch : inside_->group(group).surfaces()[0].tables().patches) {
        patches.push_back({patch.face, {patch.corners[0], patch.corners[1], patch.corners[2], patch.corners[3]}});
        if (patch.cornerCount != 4 || std::find(patches.back().corners.begin(), patches.back().corners.end(),
                                                cage::kNone) != patches.back().corners.end()) {
            return {};
        }
    }
    return patches;
}

std::vector<uint32_t> Workbench::patchFaces(SuppleGroup group) const {
    std::vector<uint32_t> faces;
    for (const surface::PatchInfo& patch : inside_->group(group).surfaces()[0].tables().patches) {
        faces.push_back(patch.face);
    }
    return faces;
}

Workbench::StaticBytes Workbench::staticBytes(SuppleGroup id) const {
    const runtime::Group& group = inside_->group(id);
    StaticBytes bytes;
    bytes.deform = group.asset().skin(group.instances().skinning()).buffers.size(0);
    for (const std::shared_ptr<runtime::SchemeTables>& scheme : group.asset().schemes) {
        if (&scheme->tables() == &group.surfaces()[0].tables()) {
            bytes.tables = scheme->buffers.size(0);
        }
    }
    const host::GroupOutput out = output(id);
    bytes.indices = out.grid.indices.size; // with levels the view has them for all
    const gpu::MemoryUse use = group.memoryUse();
    bytes.group = use.total() - use.hostVisible();
    return bytes;
}

} // namespace supple::bench
