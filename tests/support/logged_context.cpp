#include "tests/support/logged_context.h"

#include "tests/support/tube_file.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>

namespace supple::test {

LoggedContext::LoggedContext(host::Device& device, const std::function<void(SuppleContextDesc&)>& adjust)
    : device_(device) {
    SuppleContextDesc desc = host::contextDesc(device);
    desc.log = log;
    desc.logUser = this;
    if (std::getenv("SUPPLE_TEST_SHARED_DISPATCHES") != nullptr) { // any suite can be run with them
        desc.flags |= SUPPLE_CONTEXT_SHARED_DISPATCHES;
    }
    if (adjust) {
        adjust(desc);
    }
    result_ = suppleCreateContext(&desc, &context_);
}

LoggedContext::~LoggedContext() {
    suppleDestroyContext(context_);
}

std::vector<LogLine> LoggedContext::takeLines() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(lines_, {});
}

uint32_t LoggedContext::takeCount(SuppleMessage message) {
    const std::vector<LogLine> lines = takeLines();
    return static_cast<uint32_t>(
        std::ranges::count_if(lines, [&](const LogLine& line) { return line.message == message; }));
}

void LoggedContext::beginFrame() {
    ++frame;
    ASSERT_EQ(suppleBeginFrame(context_, frame, frame - 1), SUPPLE_OK);
}

SuppleResult LoggedContext::record(VkCommandBuffer commands, std::span<const SuppleGroup> groups,
                                   uint32_t flags) const {
    SuppleRecordDesc desc{};
    desc.structSize = sizeof(desc);
    desc.flags = flags;
    desc.groups = groups.data();
    desc.groupCount = static_cast<uint32_t>(groups.size());
    desc.before = kAnyUse;
    desc.after = kAnyUse;
    return suppleRecord(context_, commands, &desc);
}

void LoggedContext::evaluate(std::span<const SuppleGroup> groups, uint32_t flags) {
    beginFrame();
    ASSERT_TRUE(
        device_.submitAndWait([&](VkCommandBuffer commands) { EXPECT_EQ(record(commands, groups, flags), SUPPLE_OK); })
            .ok());
}

void LoggedContext::log(SuppleSeverity severity, SuppleMessage message, const char* text, void* user) {
    auto& own = *static_cast<LoggedContext*>(user);
    const std::scoped_lock lock(own.mutex_);
    own.lines_.push_back({severity, message, text});
}

std::unique_ptr<host::Device> deviceThrough(PFN_vkGetInstanceProcAddr functions, bool validation) {
    host::DeviceOptions options;
    options.validation = validation;
    options.suppleGetInstanceProcAddr = functions;
    Result<std::unique_ptr<host::Device>> device = host::Device::create(options);
    if (!device) {
        ADD_FAILURE() << device.error().message;
        return nullptr;
    }
    return std::move(*device);
}

const std::vector<std::byte>& tubeFile() {
    static const std::vector<std::byte> bytes = tubeFileOf(6, 6);
    return bytes;
}

SuppleAssetDesc tubeDesc(const char* name) {
    SuppleAssetDesc desc{};
    desc.structSize = sizeof(desc);
    desc.name = name;
    desc.bytes = tubeFile().data();
    desc.byteCount = tubeFile().size();
    return desc;
}

SuppleResult createTube(SuppleContext context, SuppleAsset& asset) {
    const SuppleAssetDesc desc = tubeDesc();
    return suppleCreateAsset(context, &desc, &asset);
}

SmallGroup createGroup(SuppleContext context, SuppleAsset asset, SuppleGroupDesc desc) {
    desc.structSize = sizeof(desc);
    desc.asset = asset;
    desc.rate = desc.rate == 0 ? 2 : desc.rate;
    desc.capacity = std::max(desc.capacity, 1u);
    SmallGroup made;
    made.result = suppleCreateGroup(context, &desc, &made.group);
    if (made.result == SUPPLE_OK) {
        made.instances.resize(desc.capacity);
        for (SuppleInstance& instance : made.instances) {
            EXPECT_EQ(suppleCreateInstance(context, made.group, &instance), SUPPLE_OK);
        }
    }
    return made;
}

host::GroupOutput outputOf(SuppleContext context, SuppleGroup group) {
    host::GroupOutput output{};
    EXPECT_EQ(host::getGroupOutput(context, group, output), SUPPLE_OK);
    return output;
}

std::vector<std::byte> surfaceBits(const LoggedContext& context, SuppleGroup group) {
    const host::GroupOutput output = outputOf(context.handle(), group);
    std::vector<std::byte> bits;
    const auto append = [&](const SuppleBufferRange& view, uint32_t count, uint32_t stride) {
        if (view.buffer == VK_NULL_HANDLE) {
            return;
        }
        const Result<std::vector<std::byte>> bytes = context.device().readBuffer(view);
        ASSERT_TRUE(bytes.ok());
        for (uint32_t slot = 0; slot < output.info.capacity; ++slot) {
            const auto first = bytes->begin() + static_cast<ptrdiff_t>(size_t{slot} * stride * view.stride);
            bits.insert(bits.end(), first, first + static_cast<ptrdiff_t>(size_t{count} * view.stride));
        }
    };
    append(output.info.deformedCage, output.info.cageVertexCount, output.info.cageVerticesPerInstance);
    append(output.streams.vertices, output.grid.vertexCount, output.grid.verticesPerInstance);
    return bits;
}

} // namespace supple::test
