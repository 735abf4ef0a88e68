#include "tests/support/posed_group.h"

#include "tools/common/inside_output.h"

#include <cstring>
#include <gtest/gtest.h>

namespace supple::test {

PosedContext::PosedContext(host::Device& device, SuppleMapping mapping) : device(device) {
    SuppleContextDesc desc = host::contextDesc(device);
    desc.mapping = mapping;
    Result<std::unique_ptr<runtime::Context>> created = runtime::Context::create(desc);
    EXPECT_TRUE(created.ok()) << created.error().message;
    context = created ? std::move(*created) : nullptr;
}

PosedGroup::PosedGroup(PosedContext& context, cage::Character character, const PosedOptions& options)
    : shared_(context) {
    create(std::move(character), options);
}

PosedGroup::~PosedGroup() {
    group_ = nullptr;
    if (handle_.id != 0) {
        EXPECT_TRUE(shared_.context->destroyGroup(handle_.id));
    }
    if (assetId_ != 0) {
        EXPECT_NE(shared_.context->assets.remove(assetId_), nullptr);
    }
}

void PosedGroup::create(cage::Character character, const PosedOptions& options) {
    ASSERT_NE(shared_.context, nullptr);
    const Result<uint64_t> asset = shared_.context->createAsset(std::move(character), 0);
    ASSERT_TRUE(asset.ok()) << asset.error().message;
    assetId_ = *asset;
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.asset = {assetId_};
    desc.capacity = options.instanceCount;
    desc.scheme = SUPPLE_SCHEME_CAGE;
    desc.skinning = options.skinning;
    const Result<uint64_t> group = shared_.context->createGroup(desc);
    ASSERT_TRUE(group.ok()) << group.error().message;
    handle_ = {*group};
    group_ = shared_.context->groups.find(*group);
    for (uint32_t i = 0; i < options.instanceCount; ++i) {
        ASSERT_TRUE(group_->slots().create().has_value());
    }
}

void PosedGroup::deform() {
    ASSERT_TRUE(valid());
    SuppleRecordDesc record{};
    record.structSize = sizeof(record);
    record.groups = &handle_;
    record.groupCount = 1;
    record.after = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
    ++shared_.frame;
    ASSERT_TRUE(shared_.context->beginFrame(shared_.frame, shared_.frame - 1).ok());
    const Status submitted = shared_.device.submitAndWait(
        [&](VkCommandBuffer commands) { EXPECT_TRUE(shared_.context->record(commands, record).ok()); });
    ASSERT_TRUE(submitted.ok()) << submitted.error().message;
    const host::GroupOutput output = tools::insideOutput(*group_);
    const Result<std::vector<std::byte>> bytes = shared_.device.readBuffer(output.info.deformedCage);
    ASSERT_TRUE(bytes.ok());
    cages_.assign(output.info.capacity, std::vector<glm::vec3>(output.info.cageVertexCount));
    sides_.assign(output.info.capacity, std::vector<float>(output.info.cageVertexCount));
    for (uint32_t i = 0; i < output.info.capacity; ++i) {
        for (uint32_t v = 0; v < output.info.cageVertexCount; ++v) {
            const std::byte* const vertex = bytes->data() + 16 * (size_t{i} * output.info.cageVerticesPerInstance + v);
            std::memcpy(&cages_[i][v], vertex, 12);
            std::memcpy(&sides_[i][v], vertex + 12, 4);
        }
    }
}

} // namespace supple::test
