// Stages between deform and the surfaces (runtime/stages/cage_stages.h): a stage of the test's, with state for each
// instance, stands in the table of a context. What it gets, and what surfaces are made of then.
#include "runtime/api/entry.h"
#include "runtime/instance_state.h"
#include "runtime/stages/deform.h"
#include "runtime/stages/gather.h"
#include "shaders/low_pass_comp.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/side_by_side.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

using runtime::CageBuffers;
using runtime::CageFrame;
using runtime::CageKernels;
using runtime::CageStage;
using runtime::CageStageDesc;
using runtime::CageStageRow;

/// What the stage was told, newest last. Rows are functions: they have no other place for it.
struct Told {
    std::vector<double> seconds;
    std::vector<std::vector<uint32_t>> newSlots;
    uint32_t stages = 0; ///< alive
};
Told& told() {
    static Told own;
    return own;
}

struct LowPassPush {
    uint32_t vertexCount = 0, firstEntry = 0, instanceCount = 0, stride = 0, ahead = 0;
    float blend = 0.0f;
};

struct LowPassKernels final : CageKernels {
    gpu::ComputeLayout layout;
    gpu::Kernel kernel;
};

/// Vertices reach the deformed cage in a second: at half a second they are half way.
template <bool apart>
class LowPass final : public CageStage {
public:
    LowPass(const CageStageDesc& desc, const LowPassKernels& kernels) : desc_(desc), kernels_(&kernels) {
        ++told().stages;
    }
    ~LowPass() override { --told().stages; }
    [[nodiscard]] bool writesApart() const override { return apart; }
    [[nodiscard]] Status createSets(const CageBuffers& buffers) override {
        EXPECT_EQ(buffers.from == buffers.to, !apart);
        EXPECT_EQ(buffers.listing->windows().count(), 1u);
        stride_ = buffers.stride;
        const uint32_t capacity = desc_.instances->capacity();
        Status status = state_.create(*desc_.device, capacity, VkDeviceSize{stride_} * 16, "low pass");
        addMember(state_);
        Result<gpu::DescriptorPoolHandle> pool =
            gpu::createDescriptorPool(*desc_.device, kernels_->layout, 1, "low pass");
        if (!status || !pool) {
            return status ? pool.error() : status;
        }
        pool_ = std::move(*pool);
        const Result<VkDescriptorSet> set = gpu::allocateSet(*desc_.device, kernels_->layout, pool_.get(), "low pass");
        if (!set) {
            return set.error();
        }
        set_ = *set;
        const auto whole = [](uint32_t binding, VkBuffer buffer) {
            return gpu::BoundResource{binding, {buffer, 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE};
        };
        const gpu::BoundResource resources[] = {whole(0, buffers.listing->buffer().buffer()), whole(1, buffers.from),
                                                whole(2, buffers.to), whole(3, state_.buffer())};
        gpu::writeSet(*desc_.device, kernels_->layout, set_, resources);
        return status;
    }
    [[nodiscard]] bool keepsInstances() const override { return true; }
    void takeOver(CageStage& other, uint32_t count, const runtime::AssetMatch&) override {
        state_.takeOver(static_cast<LowPass&>(other).state_, count);
    }
    [[nodiscard]] gpu::MemoryUse memoryUse() const override { return state_.memoryUse(); }
    void recordWarmUp(VkCommandBuffer commandBuffer) const override {
        gpu::computeBarrier(*desc_.device, commandBuffer);
        recordPush(commandBuffer, {});
    }
    VkDeviceSize recordUpload(const CageFrame& frame) override {
        told().seconds.push_back(frame.seconds);
        told().newSlots.emplace_back(frame.newSlots.begin(), frame.newSlots.end());
        return state_.recordUpload(frame.dispatches.commandBuffer(), frame.number, frame.newSlots);
    }
    runtime::PassCost record(const CageFrame& frame) override {
        LowPassPush push;
        push.vertexCount = desc_.asset->character.cage.vertexCount();
        push.firstEntry = frame.windows.firstEntry(0);
        push.instanceCount = frame.windows.listed[0].count;
        push.stride = stride_;
        push.ahead = apart ? 1 : 0;
        push.blend = static_cast<float>(std::min(frame.seconds, 1.0));
        recordPush(frame.dispatches.commandBuffer(), push);
        return {push.vertexCount * push.instanceCount, 16ull * push.vertexCount * push.instanceCount};
    }

private:
    void recordPush(VkCommandBuffer commandBuffer, const LowPassPush& push) const {
        gpu::bind(*desc_.device, commandBuffer, kernels_->kernel, set_, push);
        gpu::dispatchLinear(*desc_.device, commandBuffer, (push.vertexCount * push.instanceCount + 63) / 64);
    }

    CageStageDesc desc_;
    const LowPassKernels* kernels_;
    uint32_t stride_ = 0;
    runtime::InstanceState state_;
    gpu::DescriptorPoolHandle pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

Result<std::unique_ptr<CageKernels>> makeLowPassKernels(const gpu::Device& device, gpu::Pipelines& pipelines) {
    auto kernels = std::make_unique<LowPassKernels>();
    const gpu::Binding bindings[] = {gpu::storage(0), gpu::storage(1), gpu::storage(2), gpu::storage(3)};
    Result<gpu::ComputeLayout> layout = gpu::ComputeLayout::create(device, bindings, sizeof(LowPassPush), "low pass");
    if (!layout) {
        return layout.error();
    }
    kernels->layout = std::move(*layout);
    const Result<gpu::Kernel> kernel = pipelines.get(kernels->layout, {low_pass_comp, low_pass_comp}, {}, "low pass");
    if (!kernel) {
        return kernel.error();
    }
    kernels->kernel = *kernel;
    return std::unique_ptr<CageKernels>(std::move(kernels));
}

template <bool apart>
Result<std::unique_ptr<CageStage>> makeLowPass(const CageStageDesc& desc, CageKernels& kernels) {
    return std::unique_ptr<CageStage>(std::make_unique<LowPass<apart>>(desc, static_cast<LowPassKernels&>(kernels)));
}

template <bool apart>
constexpr CageStageRow kLowPassRow{SUPPLE_PASS_DEFORM, false, [](const CageStageDesc& desc) { return desc.deforms; },
                                   makeLowPassKernels, makeLowPass<apart>};
constexpr CageStageRow kInPlace[] = {runtime::kDeformRow, kLowPassRow<false>, runtime::kGatherRow};
constexpr CageStageRow kApart[] = {runtime::kDeformRow, kLowPassRow<true>, runtime::kGatherRow};
constexpr CageStageRow kBoth[] = {runtime::kDeformRow, kLowPassRow<true>, kLowPassRow<false>, kLowPassRow<true>,
                                  runtime::kGatherRow};

constexpr SuppleScheme kTwoSchemes[] = {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_LOOP};

cage::Character twoBipeds() {
    return sideBySide(biped(), "biped", 2);
}

/// A context with the rows, and a group in it that has two surfaces.
class Staged {
public:
    Staged(SuppleMapping mapping, std::span<const CageStageRow> rows, uint32_t capacity = 4)
        : context(*testDevice(), mapping) {
        told().seconds.clear();
        told().newSlots.clear();
        SuppleContextDesc desc = host::contextDesc(*testDevice());
        desc.mapping = mapping;
        Result<std::unique_ptr<runtime::Context>> own =
            runtime::Context::create(desc, surface::Shaders::embedded(), rows);
        EXPECT_TRUE(own.ok());
        context.handle()->context = std::move(*own);
        asset = context.createAsset(twoBipeds());
        SuppleGroupDesc group{};
        group.asset = asset;
        group.capacity = capacity;
        group.rate = 2;
        group.vertexFormat = SUPPLE_VERTEX_24;
        group.partSchemes = kTwoSchemes;
        group.partSchemeCount = 2;
        crowd = std::make_unique<Crowd>(context, group);
    }

    void place(SuppleInstance instance, float x) const {
        crowd->pose(instance, SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), {x, 0, 0}));
    }
    /// A frame at a time; false: it is cancelled.
    void run(double time, bool submitted = true) {
        context.beginFrame();
        SuppleRecordDesc desc{};
        desc.structSize = sizeof(desc);
        const SuppleGroup group = crowd->group();
        desc.groups = &group;
        desc.groupCount = 1;
        desc.before = desc.after = kAnyUse;
        desc.time = time;
        const auto record = [&](VkCommandBuffer commands) {
            EXPECT_EQ(suppleRecord(context.handle(), commands, &desc), SUPPLE_OK);
        };
        if (submitted) {
            EXPECT_TRUE(context.device().submitAndWait(record).ok());
            return;
        }
        Commands dropped(context.device());
        dropped.record(record);
        EXPECT_EQ(suppleCancelFrame(context.handle()), SUPPLE_OK);
    }
    [[nodiscard]] std::vector<glm::vec3> cage(SuppleInstance instance) const {
        const host::GroupOutput output = crowd->output();
        const auto elements = as<glm::vec4>(crowd->slotBytes(output.info.deformedCage, instance.slot));
        std::vector<glm::vec3> positions;
        for (uint32_t v = 0; v < output.info.cageVertexCount; ++v) {
            positions.emplace_back(elements[v]);
        }
        return positions;
    }
    /// How far the cage's first vertex stands from where the instance's bind pose at 0 has it.
    [[nodiscard]] float at(SuppleInstance instance) const { return cage(instance)[0].x - rest; }
    /// The surface vertices of both surfaces of an instance.
    [[nodiscard]] std::vector<std::byte> surfaces(SuppleInstance instance) const {
        std::vector<std::byte> bytes;
        for (const uint32_t surface : {0u, 1u}) {
            const host::GroupOutput output = crowd->output(surface);
            std::vector<std::byte> own = crowd->slotBytes(output.streams.vertices, instance.slot);
            own.resize(size_t{output.grid.vertexCount} * output.streams.vertices.stride);
            bytes.insert(bytes.end(), own.begin(), own.end());
        }
        return bytes;
    }

    CrowdContext context;
    SuppleAsset asset{};
    std::unique_ptr<Crowd> crowd;
    float rest = twoBipeds().cage.positions[0].x;
};

class CageStages : public CrowdContexts {};

using Slots = std::vector<uint32_t>;

TEST_F(CageStages, StandBetweenDeformAndTheSurfaces) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        Staged plain(mapping, runtime::cageStageRows()), staged(mapping, kInPlace);
        ASSERT_TRUE(plain.crowd->valid() && staged.crowd->valid());
        const SuppleInstance a = plain.crowd->spawn(), b = staged.crowd->spawn();
        plain.place(a, 1.0f);
        staged.place(b, 1.0f);
        plain.run(0.0);
        staged.run(0.0);
        EXPECT_EQ(plain.cage(a), staged.cage(b));
        EXPECT_TRUE(plain.surfaces(a) == staged.surfaces(b)) << "a new instance follows nothing";
        // No time passes, so the cage stands still, and so do the surfaces of it.
        staged.place(b, 3.0f);
        staged.run(0.0);
        EXPECT_EQ(plain.cage(a), staged.cage(b));
        EXPECT_TRUE(plain.surfaces(a) == staged.surfaces(b));
        // Half a second leads half of the way.
        staged.run(0.5);
        plain.place(a, 2.0f);
        plain.run(0.0);
        EXPECT_NEAR(staged.at(b), 2.0f, 1e-5f);
        EXPECT_FALSE(plain.surfaces(a).empty());
        EXPECT_EQ(plain.surfaces(a).size(), staged.surfaces(b).size());
    }
}

TEST_F(CageStages, MayReadOtherVertices) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        SCOPED_TRACE(mappingName(mapping));
        Staged one(mapping, kApart), three(mapping, kBoth);
        ASSERT_TRUE(one.crowd->valid() && three.crowd->valid());
        const SuppleInstance a = one.crowd->spawn(), b = three.crowd->spawn();
        one.run(0.0);
        three.run(0.0);
        const std::vector<glm::vec3> rest = twoBipeds().cage.positions;
        const std::vector<glm::vec3> by1 = one.cage(a), by2 = three.cage(b);
        ASSERT_EQ(by1.size(), rest.size());
        for (size_t v = 0; v < rest.size(); ++v) {
            EXPECT_LT(glm::distance(by1[v], rest[(v + 1) % rest.size()]), 1e-5f) << v;
            EXPECT_LT(glm::distance(by2[v], rest[(v + 2) % rest.size()]), 1e-5f) << v;
        }
    }
}

TEST_F(CageStages, AreToldOfTimeAndOfNewInstances) {
    const ValidationGuard guard;
    Staged staged(SUPPLE_MAPPING_AUTO, kInPlace);
    ASSERT_TRUE(staged.crowd->valid());
    Crowd& crowd = *staged.crowd;
    const SuppleInstance a = crowd.spawn(), b = crowd.spawn();
    SuppleInstance c = crowd.spawn();
    const auto run = [&](double time) {
        staged.run(time);
        return std::pair(told().seconds.back(), told().newSlots.back());
    };
    const double late = 1e6; // nothing is lost of a small step
    EXPECT_EQ(run(late), std::pair(0.0, Slots{0, 1, 2})) << "there was no frame before";
    EXPECT_EQ(run(late + 1.0 / 1024), std::pair(1.0 / 1024, Slots{}));
    EXPECT_EQ(run(late), std::pair(0.0, Slots{})) << "time goes back";
    EXPECT_EQ(run(late + 2), std::pair(2.0, Slots{}));
    crowd.teleport(b);
    EXPECT_EQ(run(late + 3), std::pair(1.0, Slots{1}));
    crowd.setVisible(a, false);
    EXPECT_EQ(run(late + 3), std::pair(0.0, Slots{}));
    crowd.setVisible(a, true);
    crowd.destroy(c);
    c = crowd.spawn();
    EXPECT_EQ(run(late + 3), std::pair(0.0, Slots{0, 2}));
    // A cancelled frame: everything is new, and no time has passed since nothing.
    staged.run(late + 4, false);
    EXPECT_EQ(told().seconds.back(), 1.0);
    EXPECT_EQ(run(late + 5), std::pair(0.0, Slots{0, 1, 2}));
    EXPECT_EQ(run(late + 6), std::pair(1.0, Slots{}));
}

TEST_F(CageStages, StateIsOfTheInstanceNotOfTheSlot) {
    const ValidationGuard guard;
    Staged staged(SUPPLE_MAPPING_AUTO, kInPlace);
    ASSERT_TRUE(staged.crowd->valid());
    Crowd& crowd = *staged.crowd;
    const SuppleInstance a = crowd.spawn(), b = crowd.spawn();
    staged.run(0.0);
    staged.place(a, 4.0f);
    staged.place(b, 4.0f);
    staged.run(0.0);
    EXPECT_EQ(staged.at(a), 0.0f);
    crowd.teleport(b);
    staged.run(0.0);
    EXPECT_EQ(staged.at(a), 0.0f);
    EXPECT_NEAR(staged.at(b), 4.0f, 1e-5f) << "it has jumped";
    crowd.destroy(a);
    const SuppleInstance c = crowd.spawn();
    ASSERT_EQ(c.slot, a.slot);
    staged.place(c, 2.0f);
    staged.run(0.0);
    EXPECT_NEAR(staged.at(c), 2.0f, 1e-5f) << "the one before it has left nothing";
}

TEST_F(CageStages, StateMovesWithTheCapacity) {
    const ValidationGuard guard;
    Staged staged(SUPPLE_MAPPING_AUTO, kInPlace);
    ASSERT_TRUE(staged.crowd->valid());
    Crowd& crowd = *staged.crowd;
    std::vector<SuppleInstance> all;
    for (uint32_t i = 0; i < 4; ++i) {
        all.push_back(crowd.spawn());
    }
    staged.run(0.0);
    for (const SuppleInstance& instance : all) {
        staged.place(instance, 8.0f);
    }
    EXPECT_EQ(told().stages, 1u);
    // Twice without a frame between, and one that jumps meanwhile.
    ASSERT_EQ(suppleSetCapacity(staged.context.handle(), crowd.group(), 6), SUPPLE_OK);
    crowd.teleport(all[2]);
    ASSERT_EQ(suppleSetCapacity(staged.context.handle(), crowd.group(), 9), SUPPLE_OK);
    const SuppleInstance fresh = crowd.spawn();
    staged.place(fresh, 1.0f);
    staged.run(0.25);
    EXPECT_EQ(told().newSlots.back(), (Slots{2, fresh.slot}));
    EXPECT_EQ(told().seconds.back(), 0.25);
    EXPECT_NEAR(staged.at(all[0]), 2.0f, 1e-5f);
    EXPECT_NEAR(staged.at(all[3]), 2.0f, 1e-5f);
    EXPECT_NEAR(staged.at(all[2]), 8.0f, 1e-5f);
    EXPECT_NEAR(staged.at(fresh), 1.0f, 1e-5f);
    // Fewer again, when those behind are gone; the old groups go when their frames are complete.
    crowd.destroy(fresh);
    crowd.destroy(all[3]);
    ASSERT_EQ(suppleSetCapacity(staged.context.handle(), crowd.group(), 3), SUPPLE_OK);
    staged.run(0.75);
    EXPECT_EQ(told().newSlots.back(), Slots{});
    EXPECT_NEAR(staged.at(all[0]), 5.0f, 1e-5f);
    EXPECT_NEAR(staged.at(all[2]), 8.0f, 1e-5f);
    staged.run(0.75);
    EXPECT_EQ(told().stages, 1u);
    EXPECT_NEAR(staged.at(all[0]), 5.0f, 1e-5f);
}

TEST_F(CageStages, StateMovesWithAReloadedAssetIfItFits) {
    const ValidationGuard guard;
    Staged staged(SUPPLE_MAPPING_AUTO, kInPlace);
    ASSERT_TRUE(staged.crowd->valid());
    const SuppleInstance a = staged.crowd->spawn();
    staged.run(0.0);
    staged.place(a, 8.0f);
    ASSERT_EQ(staged.context.reloadAsset(staged.asset, twoBipeds()), SUPPLE_OK);
    staged.run(0.5);
    EXPECT_EQ(told().newSlots.back(), Slots{});
    EXPECT_NEAR(staged.at(a), 4.0f, 1e-5f);
    // A cage of another size: the stage has taken nothing over, so it begins anew.
    ASSERT_EQ(staged.context.reloadAsset(staged.asset, sideBySide(biped(), "biped", 4)), SUPPLE_OK);
    staged.run(0.5);
    EXPECT_NEAR(staged.at(a), 8.0f, 1e-5f);
}

TEST_F(CageStages, ACancelledMoveBeginsAnew) {
    const ValidationGuard guard;
    Staged staged(SUPPLE_MAPPING_AUTO, kInPlace);
    ASSERT_TRUE(staged.crowd->valid());
    const SuppleInstance a = staged.crowd->spawn();
    staged.run(0.0);
    staged.place(a, 8.0f);
    ASSERT_EQ(suppleSetCapacity(staged.context.handle(), staged.crowd->group(), 7), SUPPLE_OK);
    staged.run(0.5, false);
    staged.run(0.5);
    EXPECT_EQ(told().newSlots.back(), Slots{0});
    EXPECT_NEAR(staged.at(a), 8.0f, 1e-5f);
    staged.place(a, 0.0f);
    staged.run(1.0);
    EXPECT_NEAR(staged.at(a), 4.0f, 1e-5f);
}

TEST_F(CageStages, CountInMemoryTimingsAndWarmUp) {
    const ValidationGuard guard;
    Staged plain(SUPPLE_MAPPING_AUTO, runtime::cageStageRows()), staged(SUPPLE_MAPPING_AUTO, kApart);
    ASSERT_TRUE(plain.crowd->valid() && staged.crowd->valid());
    const auto cages = [](const Staged& of) {
        SuppleMemoryUse use{};
        use.structSize = sizeof(use);
        EXPECT_EQ(suppleGetGroupMemory(of.context.handle(), of.crowd->group(), &use), SUPPLE_OK);
        return use.cages;
    };
    const host::GroupOutput output = staged.crowd->output();
    // The state, and the cages between deform and the stage.
    EXPECT_GE(cages(staged), cages(plain) + 2 * output.info.deformedCage.size);
    (void)staged.crowd->spawn();
    const SuppleGroup group = staged.crowd->group();
    staged.context.beginFrame();
    EXPECT_TRUE(staged.context.device()
                    .submitAndWait([&](VkCommandBuffer commands) {
                        EXPECT_EQ(suppleRecordWarmUp(staged.context.handle(), commands, &group, 1), SUPPLE_OK);
                    })
                    .ok());
    staged.context.evaluate({&group, 1}, SUPPLE_RECORD_TIMINGS);
    staged.context.beginFrame();
    uint32_t deforms = 0;
    for (const SuppleTiming& timing : staged.context.handle()->context->timings.latest()) {
        deforms += timing.pass == SUPPLE_PASS_DEFORM ? 1 : 0;
    }
    EXPECT_EQ(deforms, 4u) << "deform, the stage, and gather for either surface";
}

TEST_F(CageStages, TimeIsChecked) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    SuppleRecordDesc desc{};
    desc.structSize = sizeof(desc);
    own.beginFrame();
    EXPECT_TRUE(own.device()
                    .submitAndWait([&](VkCommandBuffer commands) {
                        desc.time = std::numeric_limits<double>::quiet_NaN();
                        EXPECT_EQ(suppleRecord(own.handle(), commands, &desc), SUPPLE_ERROR_ARGUMENT);
                        EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_NOT_FINITE);
                        desc.time = 2.0 * SUPPLE_MAX_TIME;
                        EXPECT_EQ(suppleRecord(own.handle(), commands, &desc), SUPPLE_ERROR_ARGUMENT);
                        EXPECT_EQ(own.takeError(), SUPPLE_MESSAGE_OUT_OF_RANGE);
                        desc.time = -SUPPLE_MAX_TIME;
                        EXPECT_EQ(suppleRecord(own.handle(), commands, &desc), SUPPLE_OK);
                    })
                    .ok());
}

} // namespace
} // namespace supple::test
