#include "host/context.h"

#include "host/jobs.h"

#include <cstdio>
#include <cstring>

namespace supple::host {

namespace {

ErrorCode errorCode(SuppleResult result) {
    switch (result) {
    case SUPPLE_ERROR_ASSET:
        return ErrorCode::asset;
    case SUPPLE_ERROR_UNSUPPORTED:
        return ErrorCode::unsupported;
    case SUPPLE_ERROR_LIMIT:
        return ErrorCode::limit;
    case SUPPLE_ERROR_HOST_MEMORY:
        return ErrorCode::hostMemory;
    case SUPPLE_ERROR_DEVICE_MEMORY:
        return ErrorCode::deviceMemory;
    case SUPPLE_ERROR_DEVICE_LOST:
        return ErrorCode::deviceLost;
    case SUPPLE_ERROR_VULKAN:
        return ErrorCode::vulkan;
    default:
        return ErrorCode::argument;
    }
}

} // namespace

SuppleContextDesc contextDesc(const Device& device) {
    SuppleContextDesc desc{};
    desc.structSize = sizeof desc;
    if (device.hasDebugUtils())
        desc.flags |= SUPPLE_CONTEXT_DEBUG_UTILS;
    if (device.tracesRays())
        desc.flags |= SUPPLE_CONTEXT_RAY_TRACING;
    desc.instance = device.instance();
    desc.physicalDevice = device.physicalDevice();
    desc.device = device.handle();
    desc.queueFamily = device.queueFamily();
    desc.getInstanceProcAddr = device.getInstanceProcAddr();
    desc.enabledFeatures = device.enabledFeatures();
    return desc;
}

Result<std::unique_ptr<Context>> Context::create(Device& device, const ContextOptions& options) {
    std::unique_ptr<Context> context(new Context(device));
    context->printWarnings_ = options.printWarnings;
    SuppleContextDesc desc = contextDesc(device);
    desc.framesInFlight = options.framesInFlight;
    desc.mapping = options.mapping;
    desc.flags |= options.flags;
    desc.log = log;
    desc.logUser = context.get();
    desc.runJobs = runJobs;
    if (const Status status = context->check(suppleCreateContext(&desc, &context->context_), "suppleCreateContext");
        !status)
        return status.error();
    if (!options.record.empty()) {
        Result<std::unique_ptr<Recording>> recording = Recording::start(context->context_, options.record);
        if (!recording)
            return recording.error();
        context->recording_ = std::move(*recording);
    }
    return context;
}

Context::~Context() {
    // Another frame brings the hashes of the last one.
    if (recording_ != nullptr && frame_ > 0)
        (void)suppleBeginFrame(context_, frame_ + 1, frame_);
    suppleDestroyContext(context_);
}

Status Context::check(SuppleResult result, const char* call) {
    if (result == SUPPLE_OK)
        return success();
    std::string text = std::move(lastError_);
    lastError_.clear();
    if (text.empty())
        text = std::string(call) + ": " + suppleResultString(result);
    return Error{errorCode(result), std::move(text)};
}

Status Context::createInstances(SuppleGroup group, uint32_t count, std::vector<SuppleInstance>& out) {
    out.resize(count);
    for (SuppleInstance& instance : out) {
        Status status = check(suppleCreateInstance(context_, group, &instance), "suppleCreateInstance");
        if (!status)
            return status;
    }
    return success();
}

Status Context::evaluate(std::span<const SuppleGroup> groups, uint32_t recordFlags) {
    const uint64_t frame = nextFrame();
    if (const Status status = check(suppleBeginFrame(context_, frame, frame - 1), "suppleBeginFrame"); !status)
        return status.error();
    SuppleRecordDesc desc{};
    desc.structSize = sizeof desc;
    desc.flags = recordFlags;
    desc.groups = groups.data();
    desc.groupCount = static_cast<uint32_t>(groups.size());
    desc.before = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT};
    desc.after = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT};
    Status recorded = success();
    const Status submitted = device_.submitAndWait(
        [&](VkCommandBuffer commands) { recorded = check(suppleRecord(context_, commands, &desc), "suppleRecord"); });
    return recorded ? submitted : recorded;
}

void Context::log(SuppleSeverity severity, SuppleMessage message, const char* text, void* user) {
    auto& context = *static_cast<Context*>(user);
    if (severity == SUPPLE_SEVERITY_ERROR)
        context.lastError_ = text;
    if (!context.printWarnings_)
        return;
    // What a cage's faces went through `supple inspect` lists; that a rate is not the one asked for nothing else says.
    const bool note = message == SUPPLE_MESSAGE_RATE_CHANGED;
    if ((severity == SUPPLE_SEVERITY_WARNING || note) && context.printed_.insert(text).second)
        std::fprintf(stderr, "%s: %s\n", note ? "note" : "warning", text);
}

} // namespace supple::host
