// Characters in a picture that rays alone draw. Supple evaluates their surfaces, host/ray_scene.h builds acceleration
// structures from Supple's own buffers and updates them as they move, and a compute shader casts the rays
// (shaders/trace.comp).
#include "shaders/trace.h"

#include "host/camera.h"
#include "host/group_output.h"
#include "host/must.h"
#include "host/picture.h"
#include "host/picture_options.h"
#include "host/pipelines.h"
#include "host/ray_scene.h"

#include <shaders/trace_comp.h>
#include <supple/supple.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace supple::host;
using namespace ray_query;

struct Options : PictureOptions {
    std::string character = SUPPLE_SAMPLE_ASSETS "/pip.glb";
    uint32_t samples = 16;
};

Options readOptions(int argc, char** argv) {
    Options options;
    options.rate = 3;
    options.frames = 30;
    options.size = {640, 360};
    CLI::App app("Characters in a picture that rays alone draw", "supple_ray_query");
    app.add_option("character", options.character, "a glTF file")->type_name("FILE");
    app.add_option("--samples", options.samples, "rays from the eye a pixel")
        ->check(CLI::Range(1u, 1024u))
        ->capture_default_str();
    addPictureOptions(app, options);
    app.get_option("--frames")->check(CLI::PositiveNumber);
    parse(app, argc, argv);
    return options;
}

constexpr uint32_t kCharacters = 3;

/// The group, its instances, and what rays need of it.
class Cast {
public:
    Cast(Context& context, const Options& options) : context_(context) {
        const std::vector<char> file = mustReadFile(options.character);
        auto assetDesc = supple::sized<SuppleAssetDesc>();
        assetDesc.name = options.character.c_str();
        assetDesc.bytes = file.data();
        assetDesc.byteCount = file.size();
        SuppleAsset asset{};
        must(suppleCreateAsset(context.handle(), &assetDesc, &asset), "suppleCreateAsset");
        info_ = supple::sized<SuppleAssetInfo>();
        must(suppleGetAssetInfo(context.handle(), asset, &info_), "suppleGetAssetInfo");

        auto desc = supple::sized<SuppleGroupDesc>();
        desc.asset = asset;
        desc.capacity = kCharacters;
        desc.scheme = SUPPLE_SCHEME_PM; // one surface, of any polygons
        desc.rate = options.rate;
        desc.flags = SUPPLE_GROUP_RAY_TRACING | SUPPLE_GROUP_ATTRIBUTES;
        must(suppleCreateGroup(context.handle(), &desc, &group_), "suppleCreateGroup");
        for (SuppleInstance& instance : instances_) {
            must(suppleCreateInstance(context.handle(), group_, &instance), "suppleCreateInstance");
            traced_.push_back({.slot = instance.slot});
        }
        rays_ = must(RayGroup::create(context, group_));
        geometry_ = supple::sized<SuppleRayGeometry>();
        must(suppleGetRayGeometry(context.handle(), group_, 0, &geometry_), "suppleGetRayGeometry");
        must(getGroupOutput(context.handle(), group_, output_), "suppleGetVertexStreams");
        readColors(asset);
    }

    /// They stand in a row, each at another time of the first clip.
    void pose(double seconds) {
        const float width = info_.boundsMax[0] - info_.boundsMin[0];
        for (uint32_t i = 0; i < kCharacters; ++i) {
            const float aside = static_cast<float>(i) - 0.5f * (kCharacters - 1);
            glm::mat4 place =
                glm::translate(glm::mat4(1.0f), {0.8f * width * aside, 0.0f, -0.25f * width * std::abs(aside)});
            place = glm::rotate(place, -0.45f * aside, {0.0f, 1.0f, 0.0f});
            const uint32_t clip = info_.clipCount > 0 ? i % info_.clipCount : SUPPLE_BIND_POSE;
            must(suppleSetClipPose(context_.handle(), instances_[i], clip, seconds), "suppleSetClipPose");
            must(suppleSetTransform(context_.handle(), instances_[i], glm::value_ptr(place)), "suppleSetTransform");
        }
    }

    [[nodiscard]] SuppleGroup group() const { return group_; }
    [[nodiscard]] RayScene::Part part() const { return {rays_.get(), traced_}; }
    [[nodiscard]] const SuppleAssetInfo& info() const { return info_; }
    [[nodiscard]] const GroupOutput& output() const { return output_; }
    [[nodiscard]] const SuppleRayGeometry& geometry() const { return geometry_; }
    [[nodiscard]] const std::vector<Geometry>& colors() const { return colors_; }
    [[nodiscard]] const RayGroup& rays() const { return *rays_; }

private:
    void readColors(SuppleAsset asset) {
        for (uint32_t i = 0; i < geometry_.rangeCount; ++i) {
            Geometry own{.color = vec4(1.0f), .firstIndex = geometry_.ranges[i].firstIndex};
            if (geometry_.ranges[i].material != SUPPLE_NO_MATERIAL) {
                auto material = supple::sized<SuppleMaterialInfo>();
                must(suppleGetMaterialInfo(context_.handle(), asset, geometry_.ranges[i].material, &material),
                     "suppleGetMaterialInfo");
                own.color = glm::make_vec4(material.baseColorFactor);
            }
            colors_.push_back(own);
        }
    }

    Context& context_;
    SuppleAssetInfo info_{};
    SuppleGroup group_{};
    SuppleInstance instances_[kCharacters]{};
    std::vector<TracedInstance> traced_;
    std::unique_ptr<RayGroup> rays_;
    SuppleRayGeometry geometry_{};
    GroupOutput output_;
    std::vector<Geometry> colors_;
};

/// The shader and what it binds.
class Tracer {
public:
    Tracer(Device& device, const Cast& cast, VkAccelerationStructureKHR scene, const Options& options)
        : options_(options), pool_(must(DescriptorPool::create(device, 2))) {
        constexpr VkShaderStageFlags kCompute = VK_SHADER_STAGE_COMPUTE_BIT;
        constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        const VkDescriptorSetLayout setLayout =
            must(createSetLayout(device, {{kSceneBinding, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, kCompute},
                                          {kVertexBinding, kStorage, kCompute},
                                          {kIndexBinding, kStorage, kCompute},
                                          {kAttributeBinding, kStorage, kCompute},
                                          {kGeometryBinding, kStorage, kCompute},
                                          {kPictureBinding, kStorage, kCompute}}));
        layout_ = must(createPipelineLayout(device, {setLayout}, sizeof(Push), kCompute));
        pipeline_ = must(createComputePipeline(device, layout_, trace_comp));
        geometries_ = must(device.uploadBuffer(cast.colors().data(), cast.colors().size() * sizeof(Geometry),
                                               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT));
        picture_ = must(device.createBuffer(VkDeviceSize{4} * options.size.width * options.size.height,
                                            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::readback));
        set_ = must(pool_.allocate(setLayout));
        pool_.write(set_, {accelerationStructure(kSceneBinding, scene),
                           storageBuffer(kVertexBinding, cast.output().streams.vertices),
                           storageBuffer(kIndexBinding, cast.geometry().indexBuffer),
                           storageBuffer(kAttributeBinding, cast.output().streams.attributes),
                           storageBuffer(kGeometryBinding, geometries_.handle(), 0, VK_WHOLE_SIZE),
                           storageBuffer(kPictureBinding, picture_.handle(), 0, VK_WHOLE_SIZE)});
    }

    void record(VkCommandBuffer commands, const Cast& cast) const {
        const SuppleAssetInfo& info = cast.info();
        const float height = info.boundsMax[1] - info.boundsMin[1];
        const glm::vec3 middle(0.0f, info.boundsMin[1] + 0.47f * height, 0.0f);
        const glm::vec3 eye = middle + height * glm::vec3(0.35f, 0.28f, 2.15f);
        const glm::vec3 ahead = glm::normalize(middle - eye);
        const float tangent = 0.29f,
                    aspect = static_cast<float>(options_.size.width) / static_cast<float>(options_.size.height);
        const glm::vec3 right = glm::normalize(glm::cross(ahead, {0.0f, 1.0f, 0.0f}));
        // Rays start off a surface by more than its triangles lie beside it.
        const Push push{.eye = vec4(eye, info.boundsMin[1]),
                        .right = vec4(aspect * tangent * right, 1e-3f * height),
                        .up = vec4(tangent * glm::cross(right, ahead), 0.0f),
                        .ahead = vec4(ahead, 0.0f),
                        .width = options_.size.width,
                        .height = options_.size.height,
                        .samples = options_.samples,
                        .verticesPerInstance = cast.output().grid.verticesPerInstance};
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
        vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
        vkCmdDispatch(commands, (push.width + kGroupSize - 1) / kGroupSize, (push.height + kGroupSize - 1) / kGroupSize,
                      1);
        memoryBarrier(commands, {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                      {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    }
    [[nodiscard]] Picture picture() const {
        Picture picture = Picture::blank(options_.size.width, options_.size.height);
        std::memcpy(picture.rgba.data(), picture_.mapped(), picture.rgba.size());
        return picture;
    }

private:
    const Options& options_;
    DescriptorPool pool_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    Buffer geometries_, picture_;
};

/// Evaluates, builds or updates, and in the last frame traces.
void runFrame(Context& context, Cast& cast, RayScene& scene, const Tracer* tracer) {
    const uint64_t frame = context.nextFrame();
    must(suppleBeginFrame(context.handle(), frame, frame - 1), "suppleBeginFrame");
    cast.pose(static_cast<double>(frame) / 60.0);
    must(context.device().submitAndWait([&](VkCommandBuffer commands) {
        auto record = supple::sized<SuppleRecordDesc>();
        const SuppleGroup group = cast.group();
        record.groups = &group;
        record.groupCount = 1;
        // Builds read the vertices and the indices, and so does the shader, to shade what was hit.
        record.before.stages = kBuildUse.stages | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
        record.after = {kBuildUse.stages | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                        kBuildUse.access | VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
        must(suppleRecord(context.handle(), commands, &record), "suppleRecord");
        const RayScene::Part part = cast.part();
        scene.record(commands, {&part, 1});
        if (tracer != nullptr)
            tracer->record(commands, cast);
    }));
}

std::shared_ptr<const ValidationLog> run(const Options& options) {
    const std::unique_ptr<Device> device = mustCreateDevice({.rayTracing = true});
    const std::unique_ptr<Context> context = must(Context::create(*device, {.record = options.record}));
    Cast cast(*context, options);
    const std::unique_ptr<RayScene> scene =
        must(RayScene::create(*device, kCharacters, 1, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT));
    const Tracer tracer(*device, cast, scene->handle(), options);
    uint32_t builds = 0, updates = 0;
    const auto begin = std::chrono::steady_clock::now();
    while (context->lastFrame() < options.frames) {
        const bool last = context->lastFrame() + 1 == options.frames;
        runFrame(*context, cast, *scene, last ? &tracer : nullptr);
        for (const RayPlan::Task& task : cast.rays().plan().tasks())
            ++(task.work == RayPlan::Work::build ? builds : updates);
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    device->waitIdle();
    if (!options.screenshot.empty())
        must(writePng(tracer.picture(), options.screenshot));
    std::printf("%s: %u characters of %u triangles, %u structures built and %u updated in %.1f s with the picture\n",
                device->name().c_str(), kCharacters, cast.geometry().triangleCount, builds, updates, seconds.count());
    return device->validation();
}

} // namespace

int main(int argc, char** argv) {
    mustBeSilent(*run(readOptions(argc, argv)));
    return 0;
}
