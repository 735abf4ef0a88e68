// Memory by purpose: to the byte what the callbacks gave, whoever holds it; and budgets, which lose nothing.
#include "tests/support/test_view.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

/// Counts what it gives.
class CountedMemory {
public:
    explicit CountedMemory(const host::Device& device) : device_(device.handle()) {
        vkGetPhysicalDeviceMemoryProperties(device.physicalDevice(), &properties_);
        callbacks.user = this;
        callbacks.allocate = [](const VkMemoryRequirements* requirements, VkMemoryPropertyFlags required,
                                VkMemoryPropertyFlags preferred, const char*, SuppleMemory* out, void* user) {
            return static_cast<CountedMemory*>(user)->allocate(*requirements, required, preferred, *out);
        };
        callbacks.free = [](const SuppleMemory* memory, void* user) {
            auto& own = *static_cast<CountedMemory*>(user);
            const Live live = own.live_.at(memory->memory);
            own.live_.erase(memory->memory);
            (live.visible ? own.hostVisible : own.deviceLocal) -= live.bytes;
            vkFreeMemory(own.device_, memory->memory, nullptr);
        };
    }

    SuppleMemoryCallbacks callbacks{};
    VkDeviceSize deviceLocal = 0, hostVisible = 0;
    [[nodiscard]] uint32_t count() const { return static_cast<uint32_t>(live_.size()); }

private:
    struct Live {
        VkDeviceSize bytes = 0;
        bool visible = false;
    };
    VkResult allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags required,
                      VkMemoryPropertyFlags preferred, SuppleMemory& out) {
        const auto find = [&](VkMemoryPropertyFlags wanted) {
            uint32_t type = 0;
            while (type < properties_.memoryTypeCount &&
                   ((requirements.memoryTypeBits >> type & 1u) == 0 ||
                    (properties_.memoryTypes[type].propertyFlags & wanted) != wanted)) {
                ++type;
            }
            return type;
        };
        VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, requirements.size, 0};
        info.memoryTypeIndex = find(required | preferred);
        if (info.memoryTypeIndex == properties_.memoryTypeCount) {
            info.memoryTypeIndex = find(required);
        }
        const VkResult result = vkAllocateMemory(device_, &info, nullptr, &out.memory);
        if (result != VK_SUCCESS) {
            return result;
        }
        const bool visible = (required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
        if (visible) {
            EXPECT_EQ(vkMapMemory(device_, out.memory, 0, VK_WHOLE_SIZE, 0, &out.mapped), VK_SUCCESS);
        }
        (visible ? hostVisible : deviceLocal) += requirements.size;
        live_[out.memory] = {requirements.size, visible};
        return VK_SUCCESS;
    }

    VkDevice device_;
    VkPhysicalDeviceMemoryProperties properties_{};
    std::map<VkDeviceMemory, Live> live_;
};

VkDeviceSize total(const SuppleMemoryUse& use) {
    return use.deviceLocal + use.hostVisible;
}

template <class Get, class... Handle>
SuppleMemoryUse useOf(Get get, SuppleContext context, Handle... handle) {
    SuppleMemoryUse use{};
    use.structSize = sizeof use;
    EXPECT_EQ(get(context, handle..., &use), SUPPLE_OK);
    EXPECT_EQ(use.deviceLocal, use.tables + use.poses + use.cages + use.coefficients + use.vertices + use.streams +
                                   use.lists + use.scratch + use.spare);
    EXPECT_EQ(use.hostVisible, use.staging + use.readback + use.spareVisible);
    return use;
}

class MemoryUse : public testing::Test {
protected:
    void SetUp() override {
        device = testDevice();
        ASSERT_NE(device, nullptr);
        memory = std::make_unique<CountedMemory>(*device);
        makeContext(0);
    }
    void makeContext(VkDeviceSize blockSize) {
        context = nullptr;
        context = std::make_unique<LoggedContext>(*device, [&](SuppleContextDesc& desc) {
            desc.memory = &memory->callbacks;
            desc.memoryBlockSize = blockSize;
        });
        ASSERT_EQ(context->result(), SUPPLE_OK);
    }
    void TearDown() override {
        context = nullptr;
        EXPECT_EQ(memory->count(), 0u);
    }
    /// The context's, which is what the callbacks have given.
    SuppleMemoryUse use() {
        const SuppleMemoryUse all = useOf(suppleGetContextMemory, context->handle());
        EXPECT_EQ(all.deviceLocal, memory->deviceLocal);
        EXPECT_EQ(all.hostVisible, memory->hostVisible);
        EXPECT_EQ(all.allocationCount, memory->count());
        return all;
    }
    SuppleView createView() {
        SuppleViewDesc desc{};
        desc.structSize = sizeof desc;
        desc.flags = SUPPLE_VIEW_MOTION | SUPPLE_VIEW_CULL;
        desc.maxVertices = 20000;
        SuppleView view{};
        EXPECT_EQ(suppleCreateView(context->handle(), &desc, &view), SUPPLE_OK);
        SuppleCameraDesc camera{};
        camera.structSize = sizeof camera;
        camera.pixelsPerUnit = 800.0f;
        camera.position[1] = -5.0f;
        EXPECT_EQ(suppleSetCamera(context->handle(), view, &camera), SUPPLE_OK);
        return view;
    }

    ValidationGuard guard;
    host::Device* device = nullptr;
    std::unique_ptr<CountedMemory> memory;
    std::unique_ptr<LoggedContext> context;
};

TEST_F(MemoryUse, IsWhatTheCallbacksGaveToTheByte) {
    SuppleAsset tube{};
    ASSERT_EQ(createTube(context->handle(), tube), SUPPLE_OK);
    (void)use();
    const SuppleView view = createView();
    (void)use();
    std::vector<SuppleGroup> groups;
    const auto add = [&](SuppleGroupDesc desc) {
        desc.capacity = 3;
        const SmallGroup made = createGroup(context->handle(), tube, desc);
        ASSERT_EQ(made.result, SUPPLE_OK);
        groups.push_back(made.group);
        (void)use();
    };
    constexpr uint32_t kFlags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES;
    add({.flags = kFlags | SUPPLE_GROUP_PATCHES, .scheme = SUPPLE_SCHEME_PM, .poseSource = SUPPLE_POSES_PLAYBACK});
    add({.flags = kFlags, .scheme = SUPPLE_SCHEME_FRAGMENTS});
    add({.scheme = SUPPLE_SCHEME_CAGE});
    add({.scheme = SUPPLE_SCHEME_PM, .view = view});
    add({.scheme = SUPPLE_SCHEME_FRAGMENTS, .view = view});
    const SuppleMemoryUse before = use();
    context->evaluate(groups, SUPPLE_RECORD_TIMINGS);
    context->beginFrame();
    const SuppleMemoryUse after = use();
    EXPECT_LT(after.staging, before.staging) << "what static tables were staged in";
    EXPECT_EQ(after.deviceLocal, before.deviceLocal);

    // The parts make the whole, but for what is the context's own.
    const auto sum = [&] {
        VkDeviceSize bytes = total(useOf(suppleGetAssetMemory, context->handle(), tube)) +
                             total(useOf(suppleGetViewMemory, context->handle(), view));
        for (const SuppleGroup& group : groups) {
            bytes += total(useOf(suppleGetGroupMemory, context->handle(), group));
        }
        return bytes;
    };
    const VkDeviceSize own = total(after) - sum();
    EXPECT_GT(own, 0u);
    EXPECT_LT(own, total(after) / 4);

    // What is destroyed counts until the frames that may use it are complete.
    const VkDeviceSize ofFirst = total(useOf(suppleGetGroupMemory, context->handle(), groups[0]));
    ASSERT_TRUE(device->submitAndWait(
        [&](VkCommandBuffer commands) { EXPECT_EQ(context->record(commands, groups), SUPPLE_OK); }));
    ASSERT_EQ(suppleDestroyGroup(context->handle(), groups[0]), SUPPLE_OK);
    groups.erase(groups.begin());
    EXPECT_EQ(total(use()), own + sum() + ofFirst);
    context->beginFrame();
    EXPECT_EQ(total(use()), own + sum());

    for (const SuppleGroup& group : groups) {
        ASSERT_EQ(suppleDestroyGroup(context->handle(), group), SUPPLE_OK);
    }
    ASSERT_EQ(suppleDestroyAsset(context->handle(), tube), SUPPLE_OK);
    ASSERT_EQ(suppleDestroyView(context->handle(), view), SUPPLE_OK);
    context->beginFrame();
    context->beginFrame();
    EXPECT_EQ(total(use()), own);
}

/// Many characters share few allocations, and what they leave goes back.
TEST_F(MemoryUse, SixtyCharactersTakeFewBlocks) {
    makeContext(VkDeviceSize{256} << 20);
    const SuppleView view = createView();
    std::vector<SuppleAsset> tubes(60);
    std::vector<SuppleGroup> groups;
    for (size_t i = 0; i < tubes.size(); ++i) {
        ASSERT_EQ(createTube(context->handle(), tubes[i]), SUPPLE_OK);
        SuppleGroupDesc desc{.capacity = 40, .scheme = SUPPLE_SCHEME_PM, .poseSource = SUPPLE_POSES_PLAYBACK};
        if (i % 2 == 0) {
            desc.view = view;
        }
        const SmallGroup made = createGroup(context->handle(), tubes[i], desc);
        ASSERT_EQ(made.result, SUPPLE_OK);
        groups.push_back(made.group);
    }
    context->evaluate(groups);
    context->beginFrame();
    const SuppleMemoryUse full = use();
    EXPECT_LE(full.allocationCount, 12u);
    EXPECT_LT(full.spare, full.deviceLocal * 2 / 3);
    VkDeviceSize held = 0;
    for (size_t i = 0; i < groups.size(); ++i) {
        const SuppleMemoryUse own = useOf(suppleGetGroupMemory, context->handle(), groups[i]);
        EXPECT_EQ(own.allocationCount, 0u);
        EXPECT_EQ(own.spare + own.spareVisible, 0u);
        held += total(own) + total(useOf(suppleGetAssetMemory, context->handle(), tubes[i]));
    }
    held += total(useOf(suppleGetViewMemory, context->handle(), view));
    EXPECT_LE(held, total(full) - full.spare - full.spareVisible);
    for (size_t i = 0; i < groups.size(); ++i) {
        ASSERT_EQ(suppleDestroyGroup(context->handle(), groups[i]), SUPPLE_OK);
        ASSERT_EQ(suppleDestroyAsset(context->handle(), tubes[i]), SUPPLE_OK);
    }
    ASSERT_EQ(suppleDestroyView(context->handle(), view), SUPPLE_OK);
    context->beginFrame();
    context->beginFrame();
    const SuppleMemoryUse empty = use();
    EXPECT_LT(total(empty), total(full));
    EXPECT_LE(empty.allocationCount, 3u);
}

/// A block is never what exceeds a budget.
TEST_F(MemoryUse, NoBlockExceedsABudget) {
    makeContext(VkDeviceSize{256} << 20);
    const VkDeviceSize before = total(use());
    SuppleAsset tube{};
    ASSERT_EQ(suppleSetMemoryBudget(context->handle(), before + (VkDeviceSize{2} << 20), nullptr, nullptr), SUPPLE_OK);
    ASSERT_EQ(createTube(context->handle(), tube), SUPPLE_OK);
    std::vector<SuppleGroup> groups;
    SuppleResult result = SUPPLE_OK;
    while (result == SUPPLE_OK && groups.size() < 1000) {
        const SmallGroup made = createGroup(context->handle(), tube, {.capacity = 40, .scheme = SUPPLE_SCHEME_PM});
        result = made.result;
        groups.push_back(made.group);
        EXPECT_LE(total(use()), before + (VkDeviceSize{2} << 20));
    }
    EXPECT_EQ(result, SUPPLE_ERROR_DEVICE_MEMORY);
    EXPECT_EQ(context->takeCount(SUPPLE_MESSAGE_DEVICE_MEMORY), 1u);
}

/// A frame that does not record a group may draw it.
TEST_F(MemoryUse, OfAGroupStaysUntilItsLastDrawsAreComplete) {
    SuppleAsset tube{};
    ASSERT_EQ(createTube(context->handle(), tube), SUPPLE_OK);
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.asset = tube;
    desc.capacity = 1;
    SuppleGroup group{};
    ASSERT_EQ(suppleCreateGroup(context->handle(), &desc, &group), SUPPLE_OK);
    ASSERT_EQ(suppleBeginFrame(context->handle(), 101, 100), SUPPLE_OK);
    ASSERT_TRUE(device->submitAndWait([&](VkCommandBuffer commands) {
        EXPECT_EQ(context->record(commands, {&group, 1}), SUPPLE_OK);
    }));
    ASSERT_EQ(suppleBeginFrame(context->handle(), 102, 101), SUPPLE_OK); // draws it, and does not record it
    const VkDeviceSize before = total(use());
    ASSERT_EQ(suppleDestroyGroup(context->handle(), group), SUPPLE_OK);
    ASSERT_EQ(suppleBeginFrame(context->handle(), 103, 101), SUPPLE_OK);
    EXPECT_EQ(total(use()), before);
    ASSERT_EQ(suppleBeginFrame(context->handle(), 104, 102), SUPPLE_OK);
    EXPECT_LT(total(use()), before);
}

TEST_F(MemoryUse, PurposesAreThoseOfTheBuffers) {
    SuppleAsset tube{};
    ASSERT_EQ(createTube(context->handle(), tube), SUPPLE_OK);
    SuppleGroupDesc desc{.flags = SUPPLE_GROUP_MOTION, .capacity = 8, .scheme = SUPPLE_SCHEME_PM, .rate = 8};
    const SmallGroup small = createGroup(context->handle(), tube, desc);
    ASSERT_EQ(small.result, SUPPLE_OK);
    const SuppleMemoryUse use = useOf(suppleGetGroupMemory, context->handle(), small.group);
    const host::GroupOutput output = outputOf(context->handle(), small.group);
    const auto holds = [](VkDeviceSize bytes, const SuppleBufferRange& range) {
        EXPECT_GE(bytes, range.size);
        EXPECT_LT(bytes, range.size + 4096); // alignment
    };
    holds(use.vertices, output.streams.vertices);
    holds(use.streams, output.streams.previousPositions);
    holds(use.cages, output.info.deformedCage);
    holds(use.poses, output.info.poses);
    holds(use.tables, output.grid.indices);
    EXPECT_GT(use.coefficients, 0u);
    EXPECT_GT(use.lists, 0u);
    EXPECT_GT(use.staging, 0u);
    EXPECT_EQ(use.readback, 0u);
    desc.flags = SUPPLE_GROUP_BOUNDS;
    const SmallGroup boxes = createGroup(context->handle(), tube, desc);
    ASSERT_EQ(boxes.result, SUPPLE_OK);
    EXPECT_GE(useOf(suppleGetGroupMemory, context->handle(), boxes.group).readback, desc.capacity * 32u);
    EXPECT_GT(useOf(suppleGetViewMemory, context->handle(), createView()).readback, 0u);
}

TEST_F(MemoryUse, StructsAndHandlesAreChecked) {
    SuppleMemoryUse use{};
    EXPECT_EQ(suppleGetContextMemory(context->handle(), nullptr), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleGetContextMemory(context->handle(), &use), SUPPLE_ERROR_ARGUMENT) << "structSize is 0";
    EXPECT_EQ(suppleGetContextMemory(nullptr, &use), SUPPLE_ERROR_ARGUMENT);
    use.structSize = sizeof use;
    EXPECT_EQ(suppleGetAssetMemory(context->handle(), {77}, &use), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleGetGroupMemory(context->handle(), {77}, &use), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleGetViewMemory(context->handle(), {77}, &use), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(context->takeCount(SUPPLE_MESSAGE_STALE_HANDLE), 3u);
}

/// A host that is asked.
struct Asked {
    int64_t refuse = -1; ///< which request
    std::vector<SuppleMemoryRequest> requests;
    std::vector<std::string> names;

    static uint32_t ask(const SuppleMemoryRequest* request, void* user) {
        auto& own = *static_cast<Asked*>(user);
        EXPECT_EQ(request->structSize, sizeof(SuppleMemoryRequest));
        own.requests.push_back(*request);
        own.names.emplace_back(request->name);
        return static_cast<int64_t>(own.requests.size()) - 1 == own.refuse ? 0 : 1;
    }
};

class MemoryBudget : public MemoryUse {};

TEST_F(MemoryBudget, IsAskedForWhatWouldExceedIt) {
    SuppleAsset tube{};
    Asked asked;
    const VkDeviceSize used = total(use());
    ASSERT_EQ(suppleSetMemoryBudget(context->handle(), used, Asked::ask, &asked), SUPPLE_OK);
    ASSERT_EQ(createTube(context->handle(), tube), SUPPLE_OK);
    ASSERT_EQ(asked.requests.size(), 2u) << "tables, and their staging memory";
    EXPECT_EQ(asked.requests[0].used, used);
    EXPECT_EQ(asked.requests[0].budget, used);
    EXPECT_EQ(asked.requests[0].hostVisible, 0u);
    EXPECT_EQ(asked.requests[1].hostVisible, 1u);
    EXPECT_EQ(asked.requests[1].used, used + asked.requests[0].bytes);
    EXPECT_EQ(total(use()), used + asked.requests[0].bytes + asked.requests[1].bytes);
    EXPECT_EQ(asked.names[0], "supple skin tables");

    // What fits is not asked for, to the byte; nobody to ask is a refusal.
    const VkDeviceSize size = total(use()) - used;
    ASSERT_EQ(suppleSetMemoryBudget(context->handle(), total(use()) + size, nullptr, nullptr), SUPPLE_OK);
    SuppleAsset second{}, third{};
    EXPECT_EQ(createTube(context->handle(), second), SUPPLE_OK);
    EXPECT_EQ(createTube(context->handle(), third), SUPPLE_ERROR_DEVICE_MEMORY);
    const std::vector<LogLine> lines = context->takeLines();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].message, SUPPLE_MESSAGE_DEVICE_MEMORY);
    for (const std::string& part : {std::string("tube"), std::to_string(asked.requests[0].bytes) + " bytes",
                                    "the budget of " + std::to_string(total(use())) + " bytes"}) {
        EXPECT_NE(lines[0].text.find(part), std::string::npos) << part << ": " << lines[0].text;
    }
    ASSERT_EQ(suppleSetMemoryBudget(context->handle(), 0, nullptr, nullptr), SUPPLE_OK);
    EXPECT_EQ(createTube(context->handle(), third), SUPPLE_OK) << "no budget";
}

TEST_F(MemoryBudget, ARefusalLosesNothing) {
    SuppleAsset tube{};
    ASSERT_EQ(createTube(context->handle(), tube), SUPPLE_OK);
    const SmallGroup bystander = createGroup(context->handle(), tube, {.scheme = SUPPLE_SCHEME_PM});
    ASSERT_EQ(bystander.result, SUPPLE_OK);
    const SuppleView view = createView();
    context->evaluate({&bystander.group, 1});
    const std::vector<std::byte> bits = surfaceBits(*context, bystander.group);
    // The same is made again and again, refused at each of its allocations in turn, until nothing is left to refuse.
    const auto everywhere = [&](const char* what, const std::function<SuppleResult()>& make) {
        Asked asked;
        for (asked.refuse = 0;; ++asked.refuse) {
            ASSERT_LT(asked.refuse, 50);
            asked.requests.clear();
            ASSERT_EQ(suppleSetMemoryBudget(context->handle(), 1, Asked::ask, &asked), SUPPLE_OK);
            const SuppleMemoryUse before = use();
            const SuppleResult result = make();
            if (result == SUPPLE_OK) {
                break;
            }
            EXPECT_EQ(result, SUPPLE_ERROR_DEVICE_MEMORY) << what << " at " << asked.refuse;
            EXPECT_EQ(context->takeCount(SUPPLE_MESSAGE_DEVICE_MEMORY), 1u);
            const SuppleMemoryUse after = use();
            // Tables that were made for a group stay with the asset: the next attempt finds them.
            EXPECT_EQ(after.deviceLocal - after.tables, before.deviceLocal - before.tables) << what;
            context->evaluate({&bystander.group, 1});
            EXPECT_TRUE(surfaceBits(*context, bystander.group) == bits);
        }
        EXPECT_GE(asked.refuse, 2) << what;
        EXPECT_EQ(context->takeLines().size(), 0u);
    };
    const auto groupOf = [&](SuppleGroupDesc desc) {
        return [this, desc, tube]() mutable {
            SuppleGroup group{};
            desc.structSize = sizeof desc;
            desc.asset = tube;
            desc.capacity = 2;
            const SuppleResult result = suppleCreateGroup(context->handle(), &desc, &group);
            return result == SUPPLE_OK ? suppleDestroyGroup(context->handle(), group) : result;
        };
    };
    everywhere("asset", [&] {
        SuppleAsset asset{};
        const SuppleResult result = createTube(context->handle(), asset);
        return result == SUPPLE_OK ? suppleDestroyAsset(context->handle(), asset) : result;
    });
    everywhere("group", groupOf({.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES,
                                 .scheme = SUPPLE_SCHEME_PREP,
                                 .poseSource = SUPPLE_POSES_PLAYBACK}));
    everywhere("group in a view", groupOf({.scheme = SUPPLE_SCHEME_FRAGMENTS, .view = view}));
    everywhere("view", [&] {
        SuppleViewDesc desc{};
        desc.structSize = sizeof desc;
        desc.maxVertices = 2000;
        SuppleView made{};
        const SuppleResult result = suppleCreateView(context->handle(), &desc, &made);
        return result == SUPPLE_OK ? suppleDestroyView(context->handle(), made) : result;
    });
}

} // namespace
} // namespace supple::test
