// The context's part in recordings: when they begin and end.
#include "runtime/context.h"

namespace supple::runtime {

namespace {

RecordedContext describe(const gpu::Device& device, uint32_t flags, uint32_t framesInFlight,
                         VkPhysicalDeviceProperties2& properties) {
    device.vk.GetPhysicalDeviceProperties2(device.physicalDevice, &properties);
    RecordedContext context;
    context.libraryVersion = SUPPLE_VERSION;
    context.contextFlags = flags;
    context.mapping = device.mapping.wide ? SUPPLE_MAPPING_WIDE : SUPPLE_MAPPING_NARROW;
    context.framesInFlight = framesInFlight;
    context.vendorId = properties.properties.vendorID;
    context.deviceId = properties.properties.deviceID;
    context.driverVersion = properties.properties.driverVersion;
    context.deviceName = properties.properties.deviceName;
    return context;
}

} // namespace

Context::~Context() {
    try {
        if (recording_) {
            (void)recorder_->finish();
        }
    } catch (const std::exception&) { // the recording lacks its end
    }
}

Status Context::startRecording(const SuppleRecordingDesc& desc) {
    const auto refused = [](ErrorCode code, const char* reason) {
        return Error{code, std::string("suppleStartRecording: ") + reason};
    };
    if (recording_) {
        return refused(ErrorCode::order, "the context is being recorded already");
    }
    if (!keeps_ && (!assets.empty() || !groups.empty() || !views.empty())) {
        return refused(ErrorCode::order, keeper_ == nullptr
                                             ? "the context has assets, groups or views, and was created "
                                               "without SUPPLE_CONTEXT_RECORDABLE"
                                             : "there was no memory to keep what it was told");
    }
    if (hasRecorded()) {
        return refused(ErrorCode::order, "the open frame has recorded groups: begin another one first");
    }
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    auto recorder = std::make_unique<Recorder>(desc, describe(*device_, flags_, framesInFlight_, properties));
    const std::vector<AskedClip> asked = askedClips();
    noteState(*recorder, asked);
    if (recorder->hasHashes()) {
        if (Status made = makeHashes(); !made) {
            return made;
        }
    }
    if (const Status written = recorder->flush(); !written) {
        hashes_ = nullptr;
        return refused(written.error().code, written.error().message.c_str());
    }
    recorder_ = std::move(recorder);
    recording_ = true;
    restartStreams(asked); // a replay begins without segments
    // A replay does not know what sizes on the screen have chosen before, nor how springs have swung.
    groups.forEach([](Group& group) {
        if (Playback* const playback = group.poses().playback()) {
            playback->forgetSizes();
        }
        group.poses().settleSteps();
    });
    return success();
}

Status Context::makeHashes() {
    std::shared_ptr<StageHashes> hashes = groupsHashes_.lock();
    if (hashes == nullptr) {
        const Result<HashKernels*> kernels = kernels_->hashes();
        Status prepared = kernels ? (*kernels)->prepare() : kernels.error();
        if (!prepared) {
            return prepared;
        }
        Result<std::shared_ptr<StageHashes>> made = StageHashes::create(*device_, **kernels, framesInFlight_);
        if (!made) {
            return made.error();
        }
        groupsHashes_ = hashes = std::move(*made);
    }
    hashes->forget();
    Status made = success();
    groups.forEach([&](Group& group) { made = made ? group.createHashes(hashes) : made; });
    hashes_ = made ? hashes : nullptr;
    return made;
}

void Context::noteState(Recorder& recorder, std::span<const AskedClip> asked) const {
    if (uploads_.bounded()) {
        recorder.note(calls::SetUploadBudget{uploads_.budget()});
    }
    if (nextOrigin_ != glm::dvec3(0.0)) {
        recorder.note(calls::SetOrigin{{nextOrigin_.x, nextOrigin_.y, nextOrigin_.z}});
    }
    if (keeps_) {
        keeper_->tell(recorder);
    }
    noteClips(recorder, asked);
    if (frameOpen_) {
        recorder.note(calls::BeginFrame{frame_, completedFrame_});
    }
}

Status Context::stopRecording() {
    const bool recorded = recording_.exchange(false);
    const Status written = recorded ? recorder_->finish() : success();
    recorder_ = nullptr;
    hashes_ = nullptr;
    return recorded ? written
                    : Status(Error{ErrorCode::order, "suppleStopRecording: the context is not being recorded"});
}

void Context::noteHashes(uint64_t completedFrame) noexcept {
    if (hashes_ != nullptr) {
        whileRecording([&](Recorder& recorder) {
            hashes_->takeCompleted(completedFrame, [&](const FrameHashes& hashes) { recorder.note(hashes); });
        });
    }
}

void Context::flushRecording() noexcept {
    whileRecording([&](Recorder& recorder) {
        if (const Status written = recorder.flush(); !written) {
            endRecording(written.error().message.c_str());
        }
    });
}

void Context::endRecording(const char* reason) noexcept {
    recording_ = false;
    try {
        log(SUPPLE_SEVERITY_WARNING, SUPPLE_MESSAGE_RECORDING_ENDED, std::string("the recording has ended: ") + reason);
    } catch (const std::exception&) { // a log line would need memory
    }
}

} // namespace supple::runtime
