// Poses that move vertices beyond SUPPLE_MAX_COORDINATE, up to what is not finite: the other instances do not see it,
// and the next pose brings the surface back.
#include "tests/support/logged_context.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/skinnings.h"
#include "tools/gltf/writer.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace supple::test {
namespace {

constexpr uint32_t kBend = 0, kFar = 1, kEndless = 2; ///< the clips

/// A chain of joints, which clips make larger one after the other: a billion times, or by what is a billion in all.
std::vector<std::byte> scaledTube() {
    constexpr uint32_t kJoints = 5;
    cage::Character tube = riggedTube({.segments = 6, .sides = 6, .joints = kJoints});
    const auto scaled = [](float by) {
        std::vector<cage::Channel> channels;
        for (uint32_t joint = 0; joint < kJoints; ++joint) {
            channels.push_back(channel(1 + joint, cage::ChannelPath::scale, {0, 1}, {1, 1, 1, by, by, by}));
        }
        return clipOf(std::move(channels));
    };
    tube.clips = {clipOf({channel(2, cage::ChannelPath::translation, {0, 1}, {0, 0, 0, 1, 1, 0})}), scaled(1e4f),
                  scaled(1e9f)};
    const Result<cage::GlbFile> file = cage::writeGlb(tube);
    EXPECT_TRUE(file.ok());
    return file.ok() ? file->bytes : std::vector<std::byte>();
}

class AbsurdPoses : public testing::Test {
protected:
    void SetUp() override {
        device_ = deviceThrough(nullptr);
        ASSERT_NE(device_, nullptr);
        validation_ = device_->validation();
        context_ = std::make_unique<LoggedContext>(*device_);
        const std::vector<std::byte> bytes = scaledTube();
        SuppleAssetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.name = "tube";
        desc.bytes = bytes.data();
        desc.byteCount = bytes.size();
        ASSERT_EQ(suppleCreateAsset(handle(), &desc, &asset_), SUPPLE_OK);
    }
    void TearDown() override {
        context_ = nullptr;
        device_ = nullptr;
        EXPECT_EQ(validation_->messageCount(), 0u);
    }

    [[nodiscard]] SuppleContext handle() const { return context_->handle(); }

    /// A frame with the first instance in kBend and the second in that clip, both halfway.
    void frame(const SmallGroup& group, uint32_t clip) {
        ASSERT_EQ(suppleSetClipPose(handle(), group.instances[0], kBend, 0.5), SUPPLE_OK);
        ASSERT_EQ(suppleSetClipPose(handle(), group.instances[1], clip, 0.5), SUPPLE_OK);
        context_->evaluate({&group.group, 1});
    }

    /// The deformed cage and the surface of one of two instances.
    [[nodiscard]] std::vector<std::byte> bitsOf(const SmallGroup& group, uint32_t slot) const {
        const host::GroupOutput output = outputOf(handle(), group.group);
        const size_t cage = size_t{output.info.cageVertexCount} * output.info.deformedCage.stride;
        const size_t surface = size_t{output.grid.vertexCount} * output.streams.vertices.stride;
        const std::vector<std::byte> all = surfaceBits(*context_, group.group);
        EXPECT_EQ(all.size(), 2 * (cage + surface));
        const auto cageAt = all.begin() + static_cast<ptrdiff_t>(slot * cage);
        const auto surfaceAt = all.begin() + static_cast<ptrdiff_t>(2 * cage + slot * surface);
        std::vector<std::byte> bits(cageAt, cageAt + static_cast<ptrdiff_t>(cage));
        bits.insert(bits.end(), surfaceAt, surfaceAt + static_cast<ptrdiff_t>(surface));
        return bits;
    }

    std::unique_ptr<host::Device> device_;
    decltype(std::declval<host::Device>().validation()) validation_;
    std::unique_ptr<LoggedContext> context_;
    SuppleAsset asset_{};
};

TEST_F(AbsurdPoses, OtherInstancesDoNotSeeThem) {
    for (const SuppleScheme scheme :
         {SUPPLE_SCHEME_CAGE, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_LOOP,
          SUPPLE_SCHEME_FRAGMENTS, SUPPLE_SCHEME_BLEND, SUPPLE_SCHEME_POLYGONS}) {
        for (const SuppleSkinning skinning : kSkinnings) {
            const bool hasMotion = scheme != SUPPLE_SCHEME_CAGE;
            const SmallGroup group = createGroup(handle(), asset_,
                                                 {.flags = hasMotion ? uint32_t{SUPPLE_GROUP_MOTION} : 0u,
                                                  .capacity = 2,
                                                  .scheme = scheme,
                                                  .skinning = skinning});
            ASSERT_EQ(group.result, SUPPLE_OK) << scheme;
            frame(group, kBend);
            const std::vector<std::byte> sound = bitsOf(group, 0);
            for (const uint32_t clip : {kFar, kEndless}) {
                frame(group, clip);
                EXPECT_TRUE(bitsOf(group, 0) == sound) << scheme << ", clip " << clip;
                EXPECT_FALSE(bitsOf(group, 1) == sound) << scheme << ", clip " << clip;
                frame(group, kBend);
                EXPECT_TRUE(bitsOf(group, 1) == sound) << scheme << ", after clip " << clip;
            }
            ASSERT_EQ(suppleDestroyGroup(handle(), group.group), SUPPLE_OK);
        }
    }
}

TEST_F(AbsurdPoses, ViewsDrawWhatElseThereIs) {
    SuppleViewDesc viewDesc{};
    viewDesc.structSize = sizeof(viewDesc);
    viewDesc.maxVertices = 1u << 16;
    viewDesc.flags = SUPPLE_VIEW_CULL;
    SuppleView view{};
    ASSERT_EQ(suppleCreateView(handle(), &viewDesc, &view), SUPPLE_OK);
    const SmallGroup group = createGroup(handle(), asset_, {.capacity = 2, .rate = 16, .view = view});
    ASSERT_EQ(group.result, SUPPLE_OK);
    const auto drawn = [&](uint32_t clip) {
        EXPECT_EQ(suppleSetClipPose(handle(), group.instances[0], kBend, 0.5), SUPPLE_OK);
        EXPECT_EQ(suppleSetClipPose(handle(), group.instances[1], clip, 0.5), SUPPLE_OK);
        for (int n = 0; n < 3; ++n) { // statistics come frames later
            context_->beginFrame();
            SuppleCameraDesc camera{};
            camera.structSize = sizeof(camera);
            camera.pixelsPerUnit = 800.0f;
            camera.position[2] = 20.0f;
            EXPECT_EQ(suppleSetCamera(handle(), view, &camera), SUPPLE_OK);
            EXPECT_TRUE(device_
                            ->submitAndWait([&](VkCommandBuffer commands) {
                                EXPECT_EQ(context_->record(commands, {&group.group, 1}), SUPPLE_OK);
                            })
                            .ok());
        }
        context_->beginFrame();
        SuppleViewStatistics statistics{};
        statistics.structSize = sizeof(statistics);
        EXPECT_EQ(suppleGetViewStatistics(handle(), view, &statistics), SUPPLE_OK);
        return statistics;
    };
    const SuppleViewStatistics sound = drawn(kBend);
    for (const uint32_t clip : {kFar, kEndless}) {
        const SuppleViewStatistics absurd = drawn(clip);
        EXPECT_GT(absurd.patchCount, 0u) << clip;
        EXPECT_LE(absurd.vertexCount, viewDesc.maxVertices) << clip;
        const SuppleViewStatistics after = drawn(kBend);
        EXPECT_EQ(after.patchCount, sound.patchCount) << clip;
        EXPECT_EQ(after.vertexCount, sound.vertexCount) << clip;
    }
}

TEST_F(AbsurdPoses, BoxesTellOfThem) {
    SuppleBounds box{};
    ASSERT_EQ(suppleGetClipBounds(handle(), asset_, kBend, &box), SUPPLE_OK);
    EXPECT_LT(box.max[0], SUPPLE_MAX_COORDINATE);
    for (const uint32_t clip : {kFar, kEndless}) {
        ASSERT_EQ(suppleGetClipBounds(handle(), asset_, clip, &box), SUPPLE_OK);
        EXPECT_GT(box.max[0], SUPPLE_MAX_COORDINATE) << clip;
    }
}

} // namespace
} // namespace supple::test
