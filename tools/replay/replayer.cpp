#include "tools/replay/replayer.h"

#include "base/utf8_path.h"
#include "runtime/cooked/file.h"
#include "runtime/recording/recorder.h"

#include <algorithm>
#include <filesystem>
#include <supple/supple.h>
#include <variant>

namespace supple::tools {

namespace calls = runtime::calls;
using runtime::RecordingEvent;

namespace {

/// What compute shaders and copies of one frame do comes before those of the next: the replay waits for each.
constexpr SuppleSyncScope kNoUse{0, 0};

/// The cooked file of a character alone.
Result<std::vector<std::byte>> cookedCharacter(const std::string& name, std::span<const std::byte> bytes) {
    std::string told = name + ": out of memory";
    SuppleAssetDesc asset{};
    asset.structSize = sizeof asset;
    asset.name = name.c_str();
    asset.bytes = bytes.data();
    asset.byteCount = bytes.size();
    const std::string folder = utf8Text(utf8Path(name).parent_path());
    asset.baseDirectory = folder.empty() ? "." : folder.c_str();
    SupplePrepareDesc desc{};
    desc.structSize = sizeof desc;
    desc.asset = &asset;
    desc.log = [](SuppleSeverity severity, SuppleMessage, const char* text, void* user) {
        if (severity == SUPPLE_SEVERITY_ERROR) {
            *static_cast<std::string*>(user) = text;
        }
    };
    desc.logUser = &told;
    SupplePrepared prepared = nullptr;
    if (supplePrepare(&desc, &prepared) != SUPPLE_OK) {
        return Error{ErrorCode::asset, told};
    }
    size_t count = 0;
    SuppleResult saved = suppleSavePrepared(prepared, nullptr, nullptr, &count);
    std::vector<std::byte> cooked(count);
    saved = saved == SUPPLE_OK ? suppleSavePrepared(prepared, nullptr, cooked.data(), &count) : saved;
    suppleDestroyPrepared(prepared);
    if (saved != SUPPLE_OK) {
        return Error{ErrorCode::hostMemory, told};
    }
    const Result<std::shared_ptr<runtime::Prepared>> whole = runtime::readCooked(cooked, name);
    return whole ? Result<std::vector<std::byte>>(runtime::writeCookedCharacter(**whole)) : whole.error();
}

} // namespace

/// Makes one call. The name of a call in an error is that of its function.
class Replayer::Calls {
public:
    explicit Calls(Replayer& replayer) : r_(replayer), context_(replayer.context_->handle()) {}

    Status operator()(const calls::CreateAsset& call) {
        return r_.load(call.hash, call.clipPoolBytes, [&](const SuppleAssetDesc& desc) {
            SuppleAsset made{};
            const Status status = check(suppleCreateAsset(context_, &desc, &made));
            r_.assets_[call.asset.id] = {made, desc.name};
            return status;
        });
    }
    Status operator()(const calls::ReloadAsset& call) {
        return r_.load(call.hash, call.clipPoolBytes, [&](const SuppleAssetDesc& desc) {
            return check(suppleReloadAsset(context_, r_.own(call.asset), &desc));
        });
    }
    Status operator()(const calls::RequestClip& call) {
        return check(suppleRequestClip(context_, r_.own(call.asset), call.clip, &call.request));
    }
    Status operator()(const calls::DestroyAsset& call) {
        return check(suppleDestroyAsset(context_, r_.own(call.asset)));
    }
    Status operator()(const calls::CreateView& call) {
        return check(suppleCreateView(context_, &call.desc, &r_.views_[call.view.id].own));
    }
    Status operator()(const calls::DestroyView& call) { return check(suppleDestroyView(context_, r_.own(call.view))); }
    Status operator()(const calls::CreateGroup& call) {
        SuppleGroupDesc desc = call.desc;
        desc.flags &= ~uint32_t{SUPPLE_GROUP_RAY_TRACING}; // no bits of the surface depend on it
        desc.asset = r_.own(call.desc.asset);
        desc.view = r_.own(call.desc.view);
        desc.instancesOf = r_.own(call.desc.instancesOf);
        Group& group = r_.groups_[call.group.id];
        const Status status = check(suppleCreateGroup(context_, &desc, &group.own));
        group.number = r_.groupCount_++;
        const auto asset = r_.assets_.find(call.desc.asset.id);
        group.name = asset != r_.assets_.end() ? asset->second.second : "";
        group.view = call.desc.view.id;
        const auto leader = r_.groups_.find(call.desc.instancesOf.id);
        group.isFilledByHost = desc.poseSource == SUPPLE_POSES_PALETTE_BUFFER ||
                               desc.poseSource == SUPPLE_POSES_CAGE_BUFFER ||
                               (leader != r_.groups_.end() && leader->second.isFilledByHost);
        r_.recordedGroups_[group.own.id] = call.group;
        if (group.isFilledByHost) {
            r_.lack(r_.nameOf(call.group) + ": its poses are in a buffer that the host has filled");
            r_.views_[group.view].lacksSomething = true; // its vertices take of the budget
        }
        return status;
    }
    Status operator()(const calls::DestroyGroup& call) {
        return r_.knows(call.group) ? check(suppleDestroyGroup(context_, r_.own(call.group))) : success();
    }
    Status operator()(const calls::CreatePointSet& call) {
        if (!r_.knows(call.desc.group)) {
            return success();
        }
        SupplePointSetDesc desc = call.desc;
        desc.group = r_.own(call.desc.group);
        return check(suppleCreatePointSet(context_, &desc, &r_.pointSets_[call.set.id]));
    }
    Status operator()(const calls::DestroyPointSet& call) {
        const auto set = r_.pointSets_.find(call.set.id);
        return set != r_.pointSets_.end() || r_.knows(call.group)
                   ? check(suppleDestroyPointSet(context_, set != r_.pointSets_.end() ? set->second : SupplePointSet{}))
                   : success();
    }
    Status operator()(const calls::CreateQueryPool& call) {
        SuppleQueryPoolDesc desc = call.desc;
        const std::vector<SuppleGroup> groups = r_.own(std::span(call.desc.groups, call.desc.groupCount));
        desc.groups = groups.data();
        desc.groupCount = static_cast<uint32_t>(groups.size());
        return groups.empty() ? success()
                              : check(suppleCreateQueryPool(context_, &desc, &r_.queryPools_[call.pool.id]));
    }
    // Pools of groups that the recording lacks were not made.
    Status operator()(const calls::DestroyQueryPool& call) {
        const auto pool = r_.queryPools_.find(call.pool.id);
        return pool != r_.queryPools_.end() ? check(suppleDestroyQueryPool(context_, pool->second)) : success();
    }
    Status operator()(const calls::RecordQueries& call) {
        const auto pool = r_.queryPools_.find(call.pool.id);
        SuppleQueryDesc desc = call.desc;
        const std::vector<SuppleGroup> groups = r_.own(std::span(call.desc.groups, call.desc.groupCount));
        if (pool == r_.queryPools_.end() || (desc.groups != nullptr && groups.empty())) {
            return success();
        }
        desc.groups = groups.empty() ? nullptr : groups.data();
        desc.groupCount = static_cast<uint32_t>(groups.size());
        return withCommands(
            [&](VkCommandBuffer commands) { return suppleRecordQueries(context_, commands, pool->second, &desc); });
    }
    Status operator()(const calls::SetCapacity& call) {
        return check(suppleSetCapacity(context_, r_.own(call.group), call.capacity));
    }
    Status operator()(const calls::SetRate& call) {
        return r_.knows(call.group) ? check(suppleSetRate(context_, r_.own(call.group), call.rate)) : success();
    }
    Status operator()(const calls::CreateInstance& call) {
        SuppleInstance made{};
        const Status status = check(suppleCreateInstance(context_, r_.own(call.instance.group), &made));
        r_.instances_[keyOf(call.instance)] = made;
        return status;
    }
    Status operator()(const calls::DestroyInstance& call) {
        const Status status = check(suppleDestroyInstance(context_, r_.own(call.instance)));
        r_.instances_.erase(keyOf(call.instance));
        return status;
    }
    Status operator()(const calls::SetVisible& call) {
        return check(suppleSetVisible(context_, r_.own(call.instance), call.visible));
    }
    Status operator()(const calls::SetPartVisible& call) {
        return check(suppleSetPartVisible(context_, r_.own(call.instance), call.part, call.visible));
    }
    Status operator()(const calls::Teleport& call) { return check(suppleTeleport(context_, r_.own(call.instance))); }
    Status operator()(const calls::SetTransform& call) {
        return check(suppleSetTransform(context_, r_.own(call.instance), call.transform));
    }
    Status operator()(const calls::SetPosition& call) {
        return check(suppleSetPosition(context_, r_.own(call.instance), call.position));
    }
    Status operator()(const calls::SetUserData& call) {
        return check(suppleSetUserData(context_, r_.own(call.instance), call.data));
    }
    Status operator()(const calls::SetSharpness& call) {
        // A recording that began late may lack the group that has drawn it with P_m.
        if (suppleSetSharpness(context_, r_.own(call.instance), call.set, call.sharpness) != SUPPLE_OK) {
            r_.lack(r_.nameOf(call.instance.group) + ": the sharpness of a crease set is left out");
        }
        return success();
    }
    Status operator()(const calls::SetPriority& call) {
        return check(suppleSetPriority(context_, r_.own(call.instance), call.priority));
    }
    Status operator()(const calls::SetClipPose& call) {
        return check(suppleSetClipPose(context_, r_.own(call.instance), call.clip, call.time));
    }
    Status operator()(const calls::SetMatrixPose& call) {
        return check(suppleSetMatrixPose(context_, r_.own(call.instance), call.matrices, call.numberCount / 16));
    }
    Status operator()(const calls::SetMorphWeights& call) {
        return check(suppleSetMorphWeights(context_, r_.own(call.instance), call.weights, call.weightCount));
    }
    Status operator()(const calls::SetJointMatrices& call) {
        return check(suppleSetJointMatrices(context_, r_.own(call.instance), &call.desc));
    }
    Status operator()(const calls::SetPose& call) {
        return check(suppleSetPose(context_, r_.own(call.instance), &call.pose));
    }
    Status operator()(const calls::SetPlayback& call) {
        return check(suppleSetPlayback(context_, r_.own(call.instance), &call.playback));
    }
    Status operator()(const calls::SetTime& call) {
        return check(suppleSetTime(context_, r_.own(call.group), call.seconds));
    }
    Status operator()(const calls::SetWind& call) {
        return check(suppleSetWind(context_, r_.own(call.group), call.wind));
    }
    Status operator()(const calls::SetMask& call) {
        return check(suppleSetMask(context_, r_.own(call.group), &call.mask));
    }
    Status operator()(const calls::SetModifiers& call) {
        return check(suppleSetModifiers(context_, r_.own(call.instance), &call.modifiers));
    }
    Status operator()(const calls::SetModifierTarget& call) {
        return check(suppleSetModifierTarget(context_, r_.own(call.instance), call.index, &call.target));
    }
    Status operator()(const calls::SetCamera& call) {
        return check(suppleSetCamera(context_, r_.own(call.view), &call.camera));
    }
    Status operator()(const calls::SetDepthPyramid& call) {
        if (call.isThere == 1) {
            r_.lack("depth pyramids: surfaces of views that had one are not compared");
        }
        View& view = r_.views_[call.view.id];
        view.lacksSomething = view.lacksSomething || call.isThere == 1;
        return success();
    }
    Status operator()(const calls::SetOrigin& call) { return check(suppleSetOrigin(context_, call.origin)); }
    Status operator()(const calls::SetUploadBudget& call) {
        return check(suppleSetUploadBudget(context_, call.bytesPerFrame));
    }
    Status operator()(const calls::BeginFrame& call) {
        const Status ran = r_.run();
        const Status status = ran ? check(suppleBeginFrame(context_, call.frame, call.completedFrame)) : ran;
        r_.frame_ = call.frame;
        return status;
    }
    Status operator()(const calls::CancelFrame&) {
        r_.dropCommands();
        return check(suppleCancelFrame(context_));
    }
    Status operator()(const calls::RecordUploads&) {
        return withCommands([&](VkCommandBuffer commands) { return suppleRecordUploads(context_, commands); });
    }
    Status operator()(const calls::RecordWarmUp& call) {
        const std::vector<SuppleGroup> groups = r_.own(std::span(call.groups, call.groupCount));
        return withCommands([&](VkCommandBuffer commands) {
            return suppleRecordWarmUp(context_, commands, groups.data(), static_cast<uint32_t>(groups.size()));
        });
    }
    Status operator()(const calls::Record& call) {
        const std::vector<SuppleGroup> groups = r_.own(std::span(call.groups, call.groupCount));
        SuppleRecordDesc desc{};
        desc.structSize = sizeof desc;
        desc.groups = groups.data();
        desc.groupCount = static_cast<uint32_t>(groups.size());
        desc.before = kNoUse;
        desc.after = kNoUse;
        desc.time = call.time;
        return withCommands([&](VkCommandBuffer commands) { return suppleRecord(context_, commands, &desc); });
    }

private:
    [[nodiscard]] Status check(SuppleResult result) { return r_.context_->check(result, "the call"); }
    template <class Record>
    Status withCommands(Record&& record) {
        const Result<VkCommandBuffer> commands = r_.commands();
        return commands ? check(record(*commands)) : commands.error();
    }

    Replayer& r_;
    SuppleContext context_;
};

Result<std::unique_ptr<Replayer>> Replayer::create(host::Device& device, const runtime::RecordedContext& recorded,
                                                   Options options) {
    std::unique_ptr<Replayer> made(new Replayer(device, std::move(options)));
    host::ContextOptions context;
    context.mapping = made->options_.mapping != SUPPLE_MAPPING_AUTO ? made->options_.mapping
                      : recorded.mapping == SUPPLE_MAPPING_WIDE     ? SUPPLE_MAPPING_WIDE
                                                                    : SUPPLE_MAPPING_NARROW;
    context.framesInFlight = std::clamp(recorded.framesInFlight, 1u, SUPPLE_MAX_FRAMES_IN_FLIGHT);
    context.flags = recorded.contextFlags &
                    (SUPPLE_CONTEXT_SHARED_DISPATCHES | SUPPLE_CONTEXT_RECORDABLE | SUPPLE_CONTEXT_FAN_RECORDS);
    context.printWarnings = false; // they were told when it was recorded
    Result<std::unique_ptr<host::Context>> own = host::Context::create(device, context);
    if (!own) {
        return own.error();
    }
    made->context_ = std::move(*own);
    Status status =
        made->context_->check(suppleSetMemoryBudget(made->context_->handle(), made->options_.memory, nullptr, nullptr),
                              "suppleSetMemoryBudget");
    status = status ? made->startHashes() : status;
    status = status ? made->prepareCharacters() : status;
    return status ? Result<std::unique_ptr<Replayer>>(std::move(made)) : status.error();
}

Status Replayer::startHashes() {
    SuppleRecordingDesc desc{};
    desc.structSize = sizeof desc;
    desc.flags = SUPPLE_RECORDING_HASHES | SUPPLE_RECORDING_WITHOUT_ASSETS;
    desc.write = [](const void* bytes, size_t count, void* user) {
        auto& written = static_cast<Replayer*>(user)->written_;
        const auto* first = static_cast<const std::byte*>(bytes);
        written.insert(written.end(), first, first + count);
        return 1;
    };
    desc.user = this;
    return context_->check(suppleStartRecording(context_->handle(), &desc), "suppleStartRecording");
}

Status Replayer::prepareCharacters() {
    for (auto& [name, bytes] : options_.characters) {
        Result<std::vector<std::byte>> cooked = cookedCharacter(name, bytes);
        if (!cooked) {
            return cooked.error();
        }
        const calls::AssetHash hash = runtime::hashOfCharacter(*cooked);
        characters_[{hash.low, hash.high}] = {name, std::move(*cooked)};
    }
    return success();
}

Replayer::~Replayer() {
    device_.waitIdle();
    context_ = nullptr;
    vkDestroyFence(device_.handle(), fence_, nullptr);
    // The command buffer goes with the device's pool (host::Device says why).
}

Status Replayer::play(const RecordingEvent& event) {
    if (const auto* const asset = std::get_if<runtime::RecordedAsset>(&event)) {
        Character& character = characters_[{asset->hash.low, asset->hash.high}];
        if (asset->bytes != nullptr) {
            character = {asset->name, std::vector<std::byte>(asset->bytes, asset->bytes + asset->byteCount)};
        } else if (character.bytes.empty()) {
            character = ofSameName(asset->name);
        }
    }
    const auto* const call = std::get_if<runtime::Call>(&event);
    if (call == nullptr) {
        return success();
    }
    const Status status = std::visit(Calls(*this), *call);
    return status ? status
                  : Status(Error{status.error().code, "frame " + std::to_string(frame_) + ": " +
                                                          runtime::kCallNames[call->index()] + ": " +
                                                          status.error().message});
}

Replayer::Character Replayer::ofSameName(const std::string& name) {
    const auto fileName = [](const std::string& path) { return utf8Path(path).filename(); };
    const auto found = std::find_if(characters_.begin(), characters_.end(), [&](const auto& known) {
        return !known.second.bytes.empty() && fileName(known.second.name) == fileName(name);
    });
    if (found == characters_.end()) {
        return {name, {}};
    }
    lack(name + ": the file is not as it was, or is read in another way");
    return {name, found->second.bytes};
}

void Replayer::lack(const std::string& what) {
    if (std::find(lacks_.begin(), lacks_.end(), what) == lacks_.end()) {
        lacks_.push_back(what);
    }
}

bool Replayer::knows(SuppleGroup recorded) {
    const bool known = own(recorded).id != 0;
    if (!known) {
        lack("a group that was there before the recording, and followed one that was gone: it is not compared");
    }
    return known;
}

Status Replayer::finish() {
    Status status = run();
    // Another frame tells that the last one is complete.
    if (status && frame_ > 0) {
        status = context_->check(suppleBeginFrame(context_->handle(), frame_ + 1, frame_), "suppleBeginFrame");
    }
    return status;
}

std::vector<ReplayedFrame> Replayer::takeHashes() {
    std::vector<ReplayedFrame> frames;
    runtime::forEachHashes(written_, [&](const runtime::FrameHashes& hashes) {
        ReplayedFrame& frame = frames.emplace_back();
        frame.number = hashes.frame;
        frame.hashes.assign(hashes.hashes, hashes.hashes + hashes.count);
        for (runtime::StageHash& hash : frame.hashes) {
            hash.group = recordedGroups_[hash.group.id];
        }
    });
    written_.clear();
    return frames;
}

std::string Replayer::nameOf(SuppleGroup recorded) const {
    const auto found = groups_.find(recorded.id);
    return found == groups_.end() ? "an unknown group"
                                  : "group " + std::to_string(found->second.number) + " (" + found->second.name + ")";
}

bool Replayer::isComparable(const runtime::StageHash& hash) const {
    const auto group = groups_.find(hash.group.id);
    if (group == groups_.end() || group->second.isFilledByHost) {
        return false;
    }
    const auto view = group->second.view != 0 ? views_.find(group->second.view) : views_.end();
    return hash.stage != runtime::HashedStage::vertices || view == views_.end() || !view->second.lacksSomething;
}

Result<VkCommandBuffer> Replayer::commands() {
    const VkDevice device = device_.handle();
    if (commands_ == VK_NULL_HANDLE) {
        VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        info.commandPool = device_.commandPool();
        info.commandBufferCount = 1;
        const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
        if (vkAllocateCommandBuffers(device, &info, &commands_) != VK_SUCCESS ||
            vkCreateFence(device, &fence, nullptr, &fence_) != VK_SUCCESS) {
            return Error{ErrorCode::vulkan, "no command buffer"};
        }
    }
    if (!hasCommands_) {
        VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        if (vkBeginCommandBuffer(commands_, &begin) != VK_SUCCESS) {
            return Error{ErrorCode::vulkan, "no command buffer"};
        }
        hasCommands_ = true;
    }
    return commands_;
}

void Replayer::dropCommands() {
    if (hasCommands_) {
        vkEndCommandBuffer(commands_);
        vkResetCommandBuffer(commands_, 0);
        hasCommands_ = false;
    }
}

Status Replayer::run() {
    if (!hasCommands_) {
        return success();
    }
    hasCommands_ = false;
    VkResult result = vkEndCommandBuffer(commands_);
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands_;
    result = result == VK_SUCCESS ? vkQueueSubmit(device_.queue(), 1, &submit, fence_) : result;
    result = result == VK_SUCCESS ? vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, UINT64_MAX) : result;
    result = result == VK_SUCCESS ? vkResetFences(device_.handle(), 1, &fence_) : result;
    return result == VK_SUCCESS
               ? success()
               : Status(Error{result == VK_ERROR_DEVICE_LOST ? ErrorCode::deviceLost : ErrorCode::vulkan,
                              "frame " + std::to_string(frame_) + " did not run: error " + std::to_string(result)});
}

template <class Load>
Status Replayer::load(const calls::AssetHash& hash, uint64_t clipPoolBytes, Load&& load) {
    const auto found = characters_.find({hash.low, hash.high});
    if (found == characters_.end() || found->second.bytes.empty()) {
        const std::string name = found != characters_.end() ? " of " + found->second.name : "";
        return Error{ErrorCode::asset,
                     "the recording was made without the character" + name + ": hand over its file, as it was"};
    }
    SuppleAssetDesc desc{};
    desc.structSize = sizeof desc;
    desc.name = found->second.name.c_str();
    desc.bytes = found->second.bytes.data();
    desc.byteCount = found->second.bytes.size();
    desc.clipPoolBytes = clipPoolBytes;
    return load(desc);
}

SuppleAsset Replayer::own(SuppleAsset recorded) const {
    const auto found = assets_.find(recorded.id);
    return found != assets_.end() ? found->second.first : SuppleAsset{};
}

SuppleGroup Replayer::own(SuppleGroup recorded) const {
    const auto found = groups_.find(recorded.id);
    return found != groups_.end() ? found->second.own : SuppleGroup{};
}

SuppleView Replayer::own(SuppleView recorded) const {
    const auto found = views_.find(recorded.id);
    return found != views_.end() ? found->second.own : SuppleView{};
}

SuppleInstance Replayer::own(const SuppleInstance& recorded) const {
    const auto found = instances_.find(keyOf(recorded));
    return found != instances_.end() ? found->second : SuppleInstance{};
}

std::vector<SuppleGroup> Replayer::own(std::span<const SuppleGroup> recorded) {
    std::vector<SuppleGroup> groups;
    for (const SuppleGroup& group : recorded) {
        if (knows(group)) {
            groups.push_back(own(group));
        }
    }
    return groups;
}

} // namespace supple::tools
