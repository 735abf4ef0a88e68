#include "tests/support/crowd.h"

#include "tools/common/cage_arrays.h"
#include "tools/gltf/writer.h"

#include <cstring>
#include <fstream>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <iterator>

namespace supple::test {

Commands::Commands(host::Device& device) : device_(device) {
    VkCommandBufferAllocateInfo allocateInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocateInfo.commandPool = device.commandPool();
    allocateInfo.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocateInfo.commandBufferCount = 1;
    EXPECT_EQ(vkAllocateCommandBuffers(device.handle(), &allocateInfo, &buffer_), VK_SUCCESS);
    const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    EXPECT_EQ(vkCreateFence(device.handle(), &fenceInfo, nullptr, &fence_), VK_SUCCESS);
}

Commands::~Commands() {
    wait();
    vkDestroyFence(device_.handle(), fence_, nullptr);
    vkFreeCommandBuffers(device_.handle(), device_.commandPool(), 1, &buffer_);
}

void Commands::record(const std::function<void(VkCommandBuffer)>& body) {
    VkCommandBufferBeginInfo beginInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    beginInfo.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    ASSERT_EQ(vkBeginCommandBuffer(buffer_, &beginInfo), VK_SUCCESS);
    body(buffer_);
    ASSERT_EQ(vkEndCommandBuffer(buffer_), VK_SUCCESS);
}

void Commands::submit() {
    VkCommandBufferSubmitInfo commandInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    commandInfo.commandBuffer = buffer_;
    VkSubmitInfo2 submitInfo{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    submitInfo.commandBufferInfoCount = 1;
    submitInfo.pCommandBufferInfos = &commandInfo;
    ASSERT_EQ(vkQueueSubmit2(device_.queue(), 1, &submitInfo, fence_), VK_SUCCESS);
    submitted_ = true;
}

void Commands::wait() {
    if (submitted_) {
        EXPECT_EQ(vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, UINT64_MAX), VK_SUCCESS);
        EXPECT_EQ(vkResetFences(device_.handle(), 1, &fence_), VK_SUCCESS);
        submitted_ = false;
    }
}

CrowdContext::CrowdContext(host::Device& device, SuppleMapping mapping, uint32_t framesInFlight, uint32_t flags)
    : LoggedContext(device, [&](SuppleContextDesc& desc) {
          desc.mapping = mapping;
          desc.framesInFlight = framesInFlight;
          desc.flags |= flags;
      }) {
    EXPECT_EQ(result(), SUPPLE_OK);
}

int CrowdContext::takeError() {
    int last = 0;
    for (const LogLine& line : takeLines()) {
        last = line.severity == SUPPLE_SEVERITY_ERROR ? static_cast<int>(line.message) : last;
    }
    return last;
}

SuppleAsset CrowdContext::asset(const std::string& path) {
    SuppleAsset& own = assets_[path];
    if (own.id == 0) {
        std::ifstream file(path, std::ios::binary);
        const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        own = createAsset(std::as_bytes(std::span(bytes)), path.c_str());
    }
    return own;
}

SuppleAsset CrowdContext::createAsset(const cage::Cage& cage) {
    const host::CageArrays arrays(cage);
    SuppleAssetDesc desc{};
    desc.structSize = sizeof(desc);
    desc.name = "test cage";
    desc.cage = &arrays.desc;
    SuppleAsset asset{};
    EXPECT_EQ(suppleCreateAsset(handle(), &desc, &asset), SUPPLE_OK);
    return asset;
}

SuppleAsset CrowdContext::createAsset(const cage::Character& character) {
    const Result<cage::GlbFile> glb = cage::writeGlb(character);
    EXPECT_TRUE(glb.ok()) << glb.error().message;
    return glb ? createAsset(glb->bytes, character.name.c_str()) : SuppleAsset{};
}

namespace {

SuppleAssetDesc describe(std::span<const std::byte> glb, const char* name) {
    SuppleAssetDesc desc{};
    desc.structSize = sizeof(desc);
    desc.name = name;
    desc.bytes = glb.data();
    desc.byteCount = glb.size();
    return desc;
}

} // namespace

SuppleAsset CrowdContext::createAsset(std::span<const std::byte> glb, const char* name) {
    const SuppleAssetDesc desc = describe(glb, name);
    SuppleAsset asset{};
    EXPECT_EQ(suppleCreateAsset(handle(), &desc, &asset), SUPPLE_OK);
    return asset;
}

SuppleResult CrowdContext::reloadAsset(SuppleAsset asset, const cage::Character& character) {
    const Result<cage::GlbFile> glb = cage::writeGlb(character);
    EXPECT_TRUE(glb.ok()) << glb.error().message;
    const SuppleAssetDesc desc = describe(glb->bytes, character.name.c_str());
    return suppleReloadAsset(handle(), asset, &desc);
}

SuppleResult CrowdContext::record(VkCommandBuffer commands, std::span<const SuppleGroup> groups) {
    SuppleRecordDesc desc{};
    desc.structSize = sizeof(desc);
    desc.groups = groups.data();
    desc.groupCount = static_cast<uint32_t>(groups.size());
    desc.time = time_;
    desc.before = {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                   VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT};
    desc.after = {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT};
    return suppleRecord(handle(), commands, &desc);
}

void CrowdContext::run(std::span<const SuppleGroup> groups, const std::function<void(VkCommandBuffer)>& first) {
    beginFrame();
    const Status submitted = device().submitAndWait([&](VkCommandBuffer commands) {
        if (first) {
            first(commands);
        }
        EXPECT_EQ(record(commands, groups), SUPPLE_OK);
    });
    ASSERT_TRUE(submitted.ok()) << submitted.error().message;
}

uint64_t CrowdContext::uploadedFor(SuppleGroup group) {
    evaluate({&group, 1}, SUPPLE_RECORD_TIMINGS);
    beginFrame(); // the one before is complete
    std::array<SuppleTiming, 16> timings{};
    auto count = static_cast<uint32_t>(timings.size());
    EXPECT_EQ(suppleGetTimings(handle(), sizeof(SuppleTiming), timings.data(), &count), SUPPLE_OK);
    uint64_t bytes = 0;
    for (uint32_t t = 0; t < count; ++t) {
        // If nothing is uploaded, the frame has no entry at all.
        const bool counts = timings[t].frame + 1 == frame && timings[t].pass == SUPPLE_PASS_UPLOAD;
        bytes += counts ? timings[t].bytes : 0;
    }
    return bytes;
}

void CrowdContext::cancel(std::span<const SuppleGroup> groups) {
    beginFrame();
    Commands dropped(device());
    dropped.record([&](VkCommandBuffer commands) { EXPECT_EQ(record(commands, groups), SUPPLE_OK); });
    EXPECT_EQ(suppleCancelFrame(handle()), SUPPLE_OK);
}

std::map<SuppleMapping, std::unique_ptr<CrowdContext>>& CrowdContexts::contexts() {
    static std::map<SuppleMapping, std::unique_ptr<CrowdContext>> own;
    return own;
}

CrowdContext& CrowdContexts::context(SuppleMapping mapping) {
    std::unique_ptr<CrowdContext>& own = contexts()[mapping];
    if (own == nullptr) {
        own = std::make_unique<CrowdContext>(*testDevice(), mapping);
    }
    return *own;
}

size_t differences(const PositionBits& a, const PositionBits& b) {
    if (a.size() != b.size()) {
        return std::max(a.size(), b.size());
    }
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        count += a[i] != b[i] ? 1 : 0;
    }
    return count;
}

std::vector<glm::vec3> asPositions(const PositionBits& bits) {
    std::vector<glm::vec3> positions(bits.size());
    for (size_t i = 0; i < bits.size(); ++i) {
        std::memcpy(&positions[i], bits[i].data(), sizeof(positions[i]));
    }
    return positions;
}

Crowd::Crowd(CrowdContext& context, SuppleGroupDesc desc) : context_(context) {
    desc.structSize = sizeof(desc);
    EXPECT_EQ(suppleCreateGroup(context.handle(), &desc, &group_), SUPPLE_OK);
    SuppleAssetInfo info{};
    info.structSize = sizeof(info);
    EXPECT_EQ(suppleGetAssetInfo(context.handle(), desc.asset, &info), SUPPLE_OK);
    clipCount_ = info.clipCount;
}

Crowd::~Crowd() {
    end();
}

void Crowd::end() {
    if (valid()) {
        EXPECT_EQ(suppleDestroyGroup(context_.handle(), group_), SUPPLE_OK);
    }
    group_ = {};
}

host::GroupOutput Crowd::output(uint32_t surface) const {
    host::GroupOutput output{};
    EXPECT_EQ(host::getGroupOutput(context_.handle(), group_, output, surface), SUPPLE_OK);
    return output;
}

SuppleInstance Crowd::spawn() {
    SuppleInstance instance{};
    EXPECT_EQ(suppleCreateInstance(context_.handle(), group_, &instance), SUPPLE_OK);
    return instance;
}

void Crowd::destroy(SuppleInstance instance) {
    EXPECT_EQ(suppleDestroyInstance(context_.handle(), instance), SUPPLE_OK);
}

void Crowd::setVisible(SuppleInstance instance, bool visible) {
    EXPECT_EQ(suppleSetVisible(context_.handle(), instance, visible ? 1 : 0), SUPPLE_OK);
}

void Crowd::teleport(SuppleInstance instance) {
    EXPECT_EQ(suppleTeleport(context_.handle(), instance), SUPPLE_OK);
}

void Crowd::setRate(uint32_t rate) {
    EXPECT_EQ(suppleSetRate(context_.handle(), group_, rate), SUPPLE_OK);
}

void Crowd::pose(SuppleInstance instance, uint32_t clip, double time, const glm::mat4& transform) {
    EXPECT_EQ(suppleSetClipPose(context_.handle(), instance, clip, time), SUPPLE_OK);
    EXPECT_EQ(suppleSetTransform(context_.handle(), instance, glm::value_ptr(transform)), SUPPLE_OK);
}

void Crowd::run(const std::function<void(VkCommandBuffer)>& first) {
    context_.run(group_, first);
    read();
}

std::vector<std::byte> Crowd::read(const SuppleBufferRange& view) const {
    if (view.buffer == VK_NULL_HANDLE) {
        return {};
    }
    Result<std::vector<std::byte>> bytes = context_.device().readBuffer(view);
    EXPECT_TRUE(bytes.ok());
    return bytes.ok() ? std::move(*bytes) : std::vector<std::byte>(view.size);
}

void Crowd::read() {
    const host::GroupOutput now = output();
    surface_ = read(now.streams.vertices);
    previous_ = read(now.streams.previousPositions);
    surfaceStride_ = now.streams.vertices.stride;
    vertexCount_ = now.grid.vertexCount;
    verticesPerInstance_ = now.grid.verticesPerInstance;
}

PositionBits Crowd::bits(uint32_t slot, const std::vector<std::byte>& bytes, size_t stride) const {
    PositionBits result(vertexCount_);
    const size_t first = size_t{slot} * verticesPerInstance_;
    if (bytes.size() < (first + vertexCount_) * stride) {
        ADD_FAILURE() << "slot " << slot << " lies beyond the buffer";
        return result;
    }
    for (size_t v = 0; v < vertexCount_; ++v) {
        std::memcpy(&result[v], bytes.data() + (first + v) * stride, sizeof(result[v]));
    }
    return result;
}

std::vector<std::byte> Crowd::slotBytes(const SuppleBufferRange& view, uint32_t slot) const {
    const VkDeviceSize bytes = view.size / output().info.capacity;
    return read({view.buffer, view.offset + slot * bytes, bytes, view.stride});
}

std::vector<VkDrawIndexedIndirectCommand> Crowd::draws(uint32_t surface) const {
    const std::vector<std::byte> bytes = read(output(surface).indirect());
    std::vector<VkDrawIndexedIndirectCommand> commands(bytes.size() / sizeof(VkDrawIndexedIndirectCommand));
    std::memcpy(commands.data(), bytes.data(), commands.size() * sizeof(commands[0]));
    return commands;
}

std::vector<uint32_t> Crowd::listed() const {
    const host::GroupOutput now = output();
    const std::vector<std::byte> bytes = read(now.info.instances);
    const std::vector<VkDrawIndexedIndirectCommand> commands = draws();
    const std::vector<uint32_t> list = as<uint32_t>(bytes);
    std::vector<uint32_t> slots;
    // Window by window, if draws have several.
    for (uint32_t w = 0; size_t{w} * now.grid.drawRangeCount < commands.size(); ++w) {
        const VkDrawIndexedIndirectCommand& command = commands[size_t{w} * now.grid.drawRangeCount];
        const uint32_t visible = command.instanceCount / now.grid.drawRanges[0].patchCount;
        const uint32_t first = w * now.info.windowSize;
        EXPECT_LE(first + visible, list.size());
        slots.insert(slots.end(), list.begin() + first, list.begin() + first + visible);
    }
    return slots;
}

} // namespace supple::test
