#include "tools/bench/scene_stage.h"

#include "host/context.h"
#include "tools/bench/clocks.h"
#include "tools/bench/sample_files.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace supple::bench {

namespace {

constexpr uint32_t kSceneVertices = 1u << 20;                  ///< of a view
constexpr VkDeviceSize kMemoryBlock = VkDeviceSize{256} << 20; ///< as a host of many characters asks for
constexpr float kSpacing = 2.0f;
constexpr float kFieldOfView = 1.0f, kPictureHeight = 1080.0f, kAspect = 16.0f / 9.0f;
constexpr double kFrameSeconds = 1.0 / 60.0;
/// Destroyed things are freed when the frames in flight that may use them are complete.
constexpr uint32_t kFramesUntilFreed = 3;

} // namespace

Result<std::unique_ptr<SceneStage>> SceneStage::create(host::Device& device, SuppleMapping mapping, SceneUse use) {
    std::unique_ptr<SceneStage> stage(new SceneStage(device, use));
    SuppleContextDesc desc = host::contextDesc(device);
    desc.mapping = mapping;
    desc.flags |= SUPPLE_CONTEXT_SHARED_DISPATCHES;
    desc.getInstanceProcAddr = CommandWatch::getInstanceProcAddr();
    desc.memory = &stage->memory_.callbacks();
    desc.memoryBlockSize = kMemoryBlock;
    desc.log = log;
    desc.logUser = stage.get();
    Status status = stage->check(supple::Context::create(desc, stage->context_), "suppleCreateContext");
    if (status) {
        status = stage->beginFrame();
    }
    if (!status) {
        return status.error();
    }
    return stage;
}

void SceneStage::log(SuppleSeverity severity, SuppleMessage, const char* text, void* user) {
    if (severity == SUPPLE_SEVERITY_ERROR) {
        static_cast<SceneStage*>(user)->lastError_ = text;
    }
}

Status SceneStage::check(SuppleResult result, const char* call) {
    if (result == SUPPLE_OK) {
        return success();
    }
    const std::string text = lastError_.empty() ? std::string(call) + ": " + suppleResultString(result) : lastError_;
    lastError_.clear();
    return Error{result == SUPPLE_ERROR_LIMIT ? ErrorCode::limit : ErrorCode::vulkan, text};
}

Status SceneStage::beginFrame() {
    ++frame_;
    return check(context_.beginFrame(frame_, frame_ - 1), "suppleBeginFrame");
}

Status SceneStage::build(uint32_t characters) {
    characterCount_ = characters;
    Status status = use_.inView ? createView(view_) : success();
    for (uint32_t i = 0; i < characters && status; ++i) {
        status = createCharacter(i);
    }
    return status;
}

Status SceneStage::createView(supple::View& view) {
    auto desc = supple::sized<SuppleViewDesc>();
    desc.flags = SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL;
    desc.maxVertices = kSceneVertices;
    const Status status = check(supple::View::create(context_, desc, view), "suppleCreateView");
    return status ? setCamera(view, false) : status;
}

float SceneStage::reach() const {
    return 0.5f * kSpacing * std::ceil(std::sqrt(static_cast<float>(characterCount_ * kInstances)));
}

Status SceneStage::setCamera(const supple::View& view, bool away) {
    const glm::vec3 eye(0.0f, 0.6f * reach() + 1.5f, 2.2f * reach() + 3.0f), middle(0.0f, 0.8f, 0.0f);
    const glm::vec3 target = away ? 2.0f * eye - middle : middle;
    const glm::mat4 seen = glm::perspectiveRH_ZO(kFieldOfView, kAspect, 0.1f, 1000.0f) *
                           glm::lookAtRH(eye, target, glm::vec3(0.0f, 1.0f, 0.0f));
    auto camera = supple::sized<SuppleCameraDesc>();
    std::copy_n(&eye[0], 3, camera.position);
    camera.pixelsPerUnit = 0.5f * kPictureHeight / std::tan(0.5f * kFieldOfView);
    std::copy_n(&seen[0][0], 16, camera.viewProjection);
    return check(view.setCamera(camera), "suppleSetCamera");
}

Status SceneStage::createCharacter(uint32_t number) {
    // The same file under another name is another asset: Supple compares no bytes.
    const SampleFile& file = sampleFiles()[number % sampleFiles().size()];
    const std::string name = std::string(file.name) + " " + std::to_string(number);
    Character& character = characters_.emplace_back();
    auto assetDesc = supple::sized<SuppleAssetDesc>();
    assetDesc.name = name.c_str();
    assetDesc.bytes = file.bytes.data();
    assetDesc.byteCount = file.bytes.size();
    Status status = check(supple::Asset::create(context_, assetDesc, character.asset), "suppleCreateAsset");
    SuppleClipInfo clip{};
    status = status ? check(character.asset.clipInfo(0, clip), "suppleGetClipInfo") : status;
    character.duration = clip.duration;
    auto desc = supple::sized<SuppleGroupDesc>();
    desc.asset = character.asset.handle();
    desc.capacity = kInstances;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.poseSource = use_.played ? SUPPLE_POSES_PLAYBACK : SUPPLE_POSES_SET;
    if (use_.inView) {
        desc.view = view_.handle();
    } else {
        desc.rate = kRate;
        desc.flags = SUPPLE_GROUP_ATTRIBUTES;
    }
    status = status ? check(supple::Group::create(context_, desc, character.group), "suppleCreateGroup") : status;
    for (uint32_t i = 0; i < kInstances && status; ++i) {
        status = createInstance(character, number * kInstances + i);
    }
    if (status) {
        recorded_.push_back(character.group.handle());
    }
    return status;
}

Status SceneStage::createInstance(Character& character, uint32_t place) {
    supple::Instance& instance = character.instances.emplace_back();
    Status status = check(supple::Instance::create(character.group, instance), "suppleCreateInstance");
    const auto side = static_cast<uint32_t>(2.0f * reach() / kSpacing);
    const auto at = [&](uint32_t cell) { return kSpacing * (static_cast<float>(cell) + 0.5f) - reach(); };
    const glm::mat4 transform = glm::translate(glm::mat4(1.0f), glm::vec3(at(place % side), 0.0f, at(place / side)));
    status = status
                 ? check(instance.setTransform(supple::MatrixSpan<const float>(&transform[0][0])), "suppleSetTransform")
                 : status;
    if (status && use_.played) {
        SupplePlaybackLayer layer{};
        layer.flags = SUPPLE_LAYER_LOOP;
        layer.weight = layer.speed = 1.0f;
        layer.offset = character.duration / kInstances * (place % kInstances);
        status = check(instance.setPlayback(supple::Span<const SupplePlaybackLayer>(&layer, 1)), "suppleSetPlayback");
    }
    return status;
}

Status SceneStage::addView() {
    FurtherView& further = further_.emplace_back();
    Status status = createView(further.view);
    for (size_t i = 0; i < characters_.size() && status; ++i) {
        auto desc = supple::sized<SuppleGroupDesc>();
        desc.asset = characters_[i].asset.handle();
        desc.scheme = SUPPLE_SCHEME_PM;
        desc.view = further.view.handle();
        desc.instancesOf = characters_[i].group.handle();
        status = check(supple::Group::create(context_, desc, further.groups.emplace_back()), "suppleCreateGroup");
        if (status) {
            recorded_.push_back(further.groups.back().handle());
        }
    }
    return status;
}

Status SceneStage::lookAway() {
    Status status = setCamera(view_, true);
    for (size_t i = 0; i < further_.size() && status; ++i) {
        status = setCamera(further_[i].view, true);
    }
    return status;
}

Status SceneStage::clear() {
    recorded_.clear();
    further_.clear();
    characters_.clear();
    view_ = {};
    Status status = success();
    for (uint32_t i = 0; i < kFramesUntilFreed && status; ++i) {
        const Result<SceneFrame> empty = frame();
        status = empty ? success() : Status(empty.error());
    }
    return status;
}

Status SceneStage::pose() {
    time_ += kFrameSeconds;
    Status status = success();
    for (const Character& character : characters_) {
        if (use_.played) {
            status = status ? check(character.group.setTime(time_), "suppleSetTime") : status;
            continue;
        }
        for (size_t i = 0; i < character.instances.size() && status; ++i) {
            const double time = std::fmod(time_ + character.duration / kInstances * static_cast<double>(i),
                                          std::max(character.duration, kFrameSeconds));
            status = check(character.instances[i].setClipPose(0, time), "suppleSetClipPose");
        }
    }
    return status;
}

Result<SceneFrame> SceneStage::frame(uint32_t recordFlags) {
    constexpr SuppleSyncScope kUse{VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
    SceneFrame result;
    const double begin = processSeconds();
    Status status = pose();
    const double posed = processSeconds();
    Status recorded = success();
    if (status) {
        status = device_.submitAndWait([&](VkCommandBuffer commands) {
            (void)watch_.take();
            const double before = processSeconds();
            recorded = check(context_.record(commands, recorded_, kUse, kUse, recordFlags), "suppleRecord");
            result.recordMicroseconds = 1e6 * (processSeconds() - before);
            result.commands = watch_.take();
        });
    }
    result.setMicroseconds = 1e6 * (posed - begin);
    status = status && recorded ? beginFrame() : status ? recorded : status;
    if (!status) {
        return status.error();
    }
    return result;
}

Result<double> SceneStage::recordBehindWork(size_t bytes) {
    work_.resize(bytes / sizeof(uint64_t));
    Status status = pose();
    for (uint64_t& word : work_) {
        word += frame_;
    }
    auto info = VkCommandBufferAllocateInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    info.commandPool = device_.commandPool();
    info.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    VkResult made = vkAllocateCommandBuffers(device_.handle(), &info, &commands);
    made = made == VK_SUCCESS ? vkBeginCommandBuffer(commands, &begin) : made;
    status = status && made != VK_SUCCESS ? Status(host::vulkanError(made, "a command buffer")) : status;
    constexpr SuppleSyncScope kUse{VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
    const double before = processSeconds();
    status = status ? check(context_.record(commands, recorded_, kUse, kUse, 0), "suppleRecord") : status;
    const double seconds = processSeconds() - before;
    vkFreeCommandBuffers(device_.handle(), device_.commandPool(), 1, &commands);
    status = status ? beginFrame() : status;
    return status ? Result<double>(1e6 * seconds) : status.error();
}

Result<std::vector<SuppleTiming>> SceneStage::timings() {
    std::vector<SuppleTiming> all;
    const Status status = check(context_.timings(all), "suppleGetTimings");
    return status ? Result<std::vector<SuppleTiming>>(std::move(all)) : status.error();
}

bool SceneStage::isOfFurtherView(const SuppleTiming& timing) const {
    return std::any_of(further_.begin(), further_.end(), [&](const FurtherView& view) {
        return std::any_of(view.groups.begin(), view.groups.end(),
                           [&](const supple::Group& group) { return group.handle().id == timing.group.id; });
    });
}

Result<uint64_t> SceneStage::vertices() {
    uint64_t sum = 0;
    if (!use_.inView) {
        for (const Character& character : characters_) {
            SuppleGridOutput grid{};
            if (const Status status = check(character.group.gridOutput(grid), "suppleGetGridOutput"); !status) {
                return status.error();
            }
            sum += uint64_t{grid.vertexCount} * kInstances;
        }
        return sum;
    }
    std::vector<const supple::View*> views{&view_};
    for (const FurtherView& further : further_) {
        views.push_back(&further.view);
    }
    for (const supple::View* const view : views) {
        SuppleViewStatistics drawn{};
        if (const Status status = check(view->statistics(drawn), "suppleGetViewStatistics"); !status) {
            return status.error();
        }
        sum += drawn.vertexCount;
    }
    return sum;
}

Result<SuppleMemoryUse> SceneStage::memory() {
    SuppleMemoryUse use{};
    const Status status = check(context_.memory(use), "suppleGetContextMemory");
    return status ? Result<SuppleMemoryUse>(use) : status.error();
}

} // namespace supple::bench
