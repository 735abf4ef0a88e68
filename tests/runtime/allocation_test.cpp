// Memory: recording takes none, on no account; what is taken at other times is given back, to whom it came from.
#include "gpu/functions.h"
#include "tests/support/allocation_count.h"
#include "tests/support/gpu_surface.h"
#include "tests/support/logged_context.h"

#include <bit>
#include <cstdlib>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <supple/supple_recording.h>

namespace supple::test {
namespace {

// A function table whose functions are the driver's with the count of allocations paused.
gpu::Functions real;
template <auto Member, class F>
struct Paused;
template <auto Member, class R, class... A>
struct Paused<Member, R(VKAPI_PTR*)(A...)> {
    static VKAPI_ATTR R VKAPI_CALL call(A... arguments) {
        const AllocationPause pause;
        return (real.*Member)(arguments...);
    }
};
template <auto Member, class F>
PFN_vkVoidFunction paused(F& slot, PFN_vkVoidFunction function) {
    slot = reinterpret_cast<F>(function);
    return reinterpret_cast<PFN_vkVoidFunction>(&Paused<Member, F>::call);
}
PFN_vkVoidFunction wrap(const char* name, PFN_vkVoidFunction function) {
#define WRAP(own)                                                                                                      \
    if (std::strcmp(name, "vk" #own) == 0) {                                                                           \
        return paused<&gpu::Functions::own>(real.own, function);                                                       \
    }
    SUPPLE_DEVICE_FUNCTIONS(WRAP)
    SUPPLE_DEBUG_FUNCTIONS(WRAP)
#undef WRAP
    return function;
}
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL pausedDeviceProcAddr(VkDevice device, const char* name) {
    return wrap(name, real.GetDeviceProcAddr(device, name));
}
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL pausedInstanceProcAddr(VkInstance instance, const char* name) {
    const PFN_vkVoidFunction function = vkGetInstanceProcAddr(instance, name);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
        real.GetDeviceProcAddr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(function);
        return reinterpret_cast<PFN_vkVoidFunction>(&pausedDeviceProcAddr);
    }
    return wrap(name, function);
}

bool powerOfTwo(uint64_t x) {
    return x != 0 && (x & (x - 1)) == 0;
}

/// VkAllocationCallbacks that keep a book.
class HostAllocator {
public:
    HostAllocator() {
        callbacks_.pUserData = this;
        callbacks_.pfnAllocation = [](void* user, size_t size, size_t alignment, VkSystemAllocationScope) {
            return static_cast<HostAllocator*>(user)->allocate(size, alignment);
        };
        callbacks_.pfnReallocation = [](void* user, void* original, size_t size, size_t alignment,
                                        VkSystemAllocationScope) {
            return static_cast<HostAllocator*>(user)->reallocate(original, size, alignment);
        };
        callbacks_.pfnFree = [](void* user, void* memory) { static_cast<HostAllocator*>(user)->free(memory); };
    }
    HostAllocator(const HostAllocator&) = delete;
    HostAllocator& operator=(const HostAllocator&) = delete;
    ~HostAllocator() { EXPECT_TRUE(live_.empty()) << live_.size() << " allocations have no free"; }

    [[nodiscard]] const VkAllocationCallbacks* callbacks() const { return &callbacks_; }
    [[nodiscard]] uint64_t calls() const { return calls_; }
    [[nodiscard]] size_t live() const { return live_.size(); }

private:
    void* allocate(size_t size, size_t alignment) {
        const AllocationPause pause;
        ++calls_;
        EXPECT_TRUE(powerOfTwo(alignment)) << alignment;
        const size_t a = std::max(alignment, sizeof(void*));
        void* memory = size == 0 ? nullptr : std::aligned_alloc(a, (size + a - 1) / a * a);
        if (memory != nullptr) {
            live_[memory] = size;
        }
        return memory;
    }
    void* reallocate(void* original, size_t size, size_t alignment) {
        void* memory = allocate(size, alignment);
        if (original != nullptr && (memory != nullptr || size == 0)) {
            const auto known = live_.find(original);
            EXPECT_NE(known, live_.end()) << "not from here";
            if (memory != nullptr && known != live_.end()) {
                std::memcpy(memory, original, std::min(size, known->second));
            }
            free(original);
        }
        return memory;
    }
    void free(void* memory) {
        const AllocationPause pause;
        ++calls_;
        if (memory != nullptr) {
            EXPECT_EQ(live_.erase(memory), 1u) << "not from here, or freed twice";
            std::free(memory);
        }
    }

    VkAllocationCallbacks callbacks_{};
    std::map<void*, size_t> live_;
    uint64_t calls_ = 0;
};

/// SuppleMemoryCallbacks that hand out pieces of big blocks, at odd multiples of their alignment.
class BlockMemory {
public:
    explicit BlockMemory(const host::Device& device) : device_(device.handle()) {
        vkGetPhysicalDeviceMemoryProperties(device.physicalDevice(), &properties_);
        callbacks_.user = this;
        callbacks_.allocate = [](const VkMemoryRequirements* requirements, VkMemoryPropertyFlags required,
                                 VkMemoryPropertyFlags preferred, const char* name, SuppleMemory* out, void* user) {
            return static_cast<BlockMemory*>(user)->allocate(*requirements, required, preferred, name, *out);
        };
        callbacks_.free = [](const SuppleMemory* memory, void* user) {
            static_cast<BlockMemory*>(user)->free(*memory);
        };
    }
    BlockMemory(const BlockMemory&) = delete;
    BlockMemory& operator=(const BlockMemory&) = delete;
    ~BlockMemory() {
        EXPECT_TRUE(live_.empty()) << live_.size() << " pieces have no free";
        for (const Block& block : blocks_) {
            vkFreeMemory(device_, block.memory, nullptr);
        }
    }

    [[nodiscard]] const SuppleMemoryCallbacks* callbacks() const { return &callbacks_; }
    [[nodiscard]] uint64_t calls() const { return calls_; }
    [[nodiscard]] size_t live() const { return live_.size(); }

    int64_t failAt = -1;     ///< index of the allocation that fails
    int64_t unmappedAt = -1; ///< index, among those for visible memory, of the one that is not mapped
    uint64_t allocations = 0, visible = 0;
    VkResult failure = VK_ERROR_OUT_OF_DEVICE_MEMORY;

private:
    struct Block {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        uint32_t type = 0;
        VkDeviceSize size = 0, used = 0;
        std::byte* mapped = nullptr;
    };

    [[nodiscard]] uint32_t findType(uint32_t bits, VkMemoryPropertyFlags wanted) const {
        for (uint32_t i = 0; i < properties_.memoryTypeCount; ++i) {
            if ((bits >> i & 1u) != 0 && (properties_.memoryTypes[i].propertyFlags & wanted) == wanted) {
                return i;
            }
        }
        return UINT32_MAX;
    }

    VkResult allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags required,
                      VkMemoryPropertyFlags preferred, const char* name, SuppleMemory& out) {
        const AllocationPause pause;
        ++calls_;
        EXPECT_GT(requirements.size, 0u);
        EXPECT_TRUE(powerOfTwo(requirements.alignment));
        EXPECT_NE(requirements.memoryTypeBits, 0u);
        EXPECT_NE(name, nullptr);
        EXPECT_NE(std::string(name), "");
        if (static_cast<int64_t>(allocations++) == failAt) {
            return failure;
        }
        uint32_t type = findType(requirements.memoryTypeBits, required | preferred);
        type = type == UINT32_MAX ? findType(requirements.memoryTypeBits, required) : type;
        EXPECT_NE(type, UINT32_MAX);
        Block* block = nullptr;
        VkDeviceSize offset = 0;
        for (Block& own : blocks_) {
            // The next odd multiple of the alignment, with some bytes left between.
            VkDeviceSize multiple = (own.used + 40) / requirements.alignment + 1;
            multiple += multiple % 2 == 0 ? 1 : 0;
            if (own.type == type && multiple * requirements.alignment + requirements.size <= own.size) {
                block = &own;
                offset = multiple * requirements.alignment;
            }
        }
        if (block == nullptr) {
            Block made;
            made.type = type;
            made.size = std::max<VkDeviceSize>(VkDeviceSize{1} << 22, 2 * (requirements.size + requirements.alignment));
            const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, made.size, type};
            EXPECT_EQ(vkAllocateMemory(device_, &info, nullptr, &made.memory), VK_SUCCESS);
            if ((properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
                void* mapped = nullptr;
                EXPECT_EQ(vkMapMemory(device_, made.memory, 0, VK_WHOLE_SIZE, 0, &mapped), VK_SUCCESS);
                made.mapped = static_cast<std::byte*>(mapped);
            }
            blocks_.push_back(made);
            block = &blocks_.back();
            offset = requirements.alignment;
        }
        block->used = offset + requirements.size;
        const bool mustMap = (required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
        out.memory = block->memory;
        out.offset = offset;
        // Where it need not be mapped, what stands there is ignored.
        out.mapped = mustMap ? block->mapped + offset : std::bit_cast<std::byte*>(uintptr_t{0x10});
        out.allocation = std::bit_cast<void*>(++lastPiece_);
        if (mustMap && static_cast<int64_t>(visible++) == unmappedAt) {
            out.mapped = nullptr;
        }
        live_[out.allocation] = out;
        return VK_SUCCESS;
    }
    void free(const SuppleMemory& memory) {
        const AllocationPause pause;
        ++calls_;
        const auto known = live_.find(memory.allocation);
        if (known == live_.end()) {
            ADD_FAILURE() << "not from here, or freed twice";
            return;
        }
        EXPECT_EQ(known->second.memory, memory.memory);
        EXPECT_EQ(known->second.offset, memory.offset);
        EXPECT_EQ(known->second.mapped, memory.mapped);
        live_.erase(known);
    }

    VkDevice device_;
    VkPhysicalDeviceMemoryProperties properties_{};
    SuppleMemoryCallbacks callbacks_{};
    std::vector<Block> blocks_;
    std::map<void*, SuppleMemory> live_;
    uintptr_t lastPiece_ = 0;
    uint64_t calls_ = 0;
};

/// A thousand frames with calls of every kind, which may be recorded with their hashes.
void framesTakeNoMemory(bool recorded) {
    std::unique_ptr<host::Device> device = deviceThrough(&pausedInstanceProcAddr, false);
    ASSERT_NE(device, nullptr);
    HostAllocator allocator;
    BlockMemory memory(*device);
    struct Log {
        uint32_t budgets = 0, others = 0;
    } log;
    {
        LoggedContext context(*device, [&](SuppleContextDesc& desc) {
            desc.allocator = allocator.callbacks();
            desc.memory = memory.callbacks();
            desc.logUser = &log;
            desc.log = [](SuppleSeverity, SuppleMessage message, const char*, void* user) {
                ++(message == SUPPLE_MESSAGE_BUDGET ? static_cast<Log*>(user)->budgets
                                                    : static_cast<Log*>(user)->others);
            };
        });
        ASSERT_EQ(context.result(), SUPPLE_OK);
        const SuppleContext handle = context.handle();
        uint64_t written = 0;
        if (recorded) {
            SuppleRecordingDesc recording{};
            recording.structSize = sizeof recording;
            recording.flags = SUPPLE_RECORDING_HASHES;
            recording.write = [](const void*, size_t bytes, void* user) {
                *static_cast<uint64_t*>(user) += bytes;
                return 1;
            };
            recording.user = &written;
            ASSERT_EQ(suppleStartRecording(handle, &recording), SUPPLE_OK);
        }
        SuppleAsset asset{};
        ASSERT_EQ(createTube(handle, asset), SUPPLE_OK);
        constexpr uint32_t kCapacity = 5;
        SmallGroup groups[] = {
            createGroup(
                handle, asset,
                {.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_PATCHES | SUPPLE_GROUP_BOUNDS,
                 .capacity = kCapacity,
                 .rate = 1}),
            createGroup(handle, asset, {.capacity = kCapacity, .rate = 1, .skinning = SUPPLE_SKINNING_DUAL_QUATERNION}),
            createGroup(handle, asset,
                        {.flags = SUPPLE_GROUP_TRANSITIONS | SUPPLE_GROUP_UPDATE_RATES,
                         .capacity = kCapacity,
                         .rate = 1,
                         .poseSource = SUPPLE_POSES_PLAYBACK})};
        const SuppleGroup all[] = {groups[0].group, groups[1].group, groups[2].group};
        for (const SmallGroup& group : groups) {
            ASSERT_EQ(group.result, SUPPLE_OK);
        }
        const std::vector<float> ones(3, 1.0f);
        // Never kept, never always broken: warnings come and go.
        ASSERT_EQ(suppleSetBudget(handle, SUPPLE_PASS_ALL, 1e5), SUPPLE_OK);
        ASSERT_EQ(suppleSetBudget(handle, SUPPLE_PASS_EVALUATE, 1e-3), SUPPLE_OK);
        ASSERT_EQ(suppleSetBudget(handle, SUPPLE_PASS_DEFORM, 1e12), SUPPLE_OK);
        for (int i = 0; i < 3; ++i) { // uploads; then their staging memory goes
            context.evaluate(all, SUPPLE_RECORD_TIMINGS);
        }
        log = {};
        const uint64_t before = allocationsCounted(), allocatorBefore = allocator.calls(),
                       memoryBefore = memory.calls();
        std::vector<SuppleTiming> timings(SUPPLE_MAX_TIMINGS);
        bool good = true;
        uint64_t frame = context.frame;
        constexpr uint64_t kFrames = 1000;
        for (uint64_t n = 0; n < kFrames; ++n) {
            ++frame;
            const auto poses = [&] {
                const AllocationCount count;
                const auto ok = [&](SuppleResult result) { good = good && result == SUPPLE_OK; };
                // Every third frame the one before is still on its way.
                ok(suppleBeginFrame(handle, frame, frame - (n % 3 == 2 ? 2 : 1)));
                const auto play = [&](SuppleInstance instance, double offset) {
                    SupplePlaybackLayer layer{};
                    layer.weight = layer.speed = 1.0f;
                    layer.offset = offset;
                    layer.mask = 1;
                    SupplePlaybackDesc desc{};
                    desc.structSize = sizeof(desc);
                    desc.layers = &layer;
                    desc.layerCount = 1;
                    desc.rootMotion = SUPPLE_ROOT_MOTION_GROUND;
                    desc.flags = SUPPLE_PLAYBACK_TRAVEL;
                    desc.transition = 0.1 * static_cast<double>(n % 3);
                    desc.transitionKind = static_cast<SuppleTransitionKind>(n % 2);
                    desc.updateInterval = 1u << n % 4;
                    return suppleSetPlayback(handle, instance, &desc);
                };
                SuppleMaskDesc mask{};
                mask.structSize = sizeof(mask);
                mask.mask = 1;
                mask.jointMask = ones.data();
                mask.jointMaskCount = static_cast<uint32_t>(ones.size());
                ok(suppleSetMask(handle, groups[2].group, &mask));
                ok(suppleSetTime(handle, groups[2].group, 0.02 * static_cast<double>(n)));
                for (SmallGroup& group : groups) {
                    const bool played = &group == &groups[2];
                    for (uint32_t i = 0; i < kCapacity; ++i) {
                        const SuppleInstance instance = group.instances[i];
                        const double time = 0.01 * static_cast<double>(n + i);
                        ok(played ? play(instance, time) : suppleSetClipPose(handle, instance, 0, time));
                        const glm::mat4 transform =
                            glm::translate(glm::mat4(1.0f), glm::vec3(0.01f * static_cast<float>(n)));
                        ok(suppleSetTransform(handle, instance, glm::value_ptr(transform)));
                        float socket[16];
                        ok(suppleGetJointTransform(handle, instance, i % 3, socket));
                    }
                    ok(suppleSetVisible(handle, group.instances[n % kCapacity], n % 2));
                    ok(suppleTeleport(handle, group.instances[(n + 1) % kCapacity]));
                    ok(suppleSetPartVisible(handle, group.instances[(n + 1) % kCapacity], 0, n / 3 % 2));
                    SuppleInstance& other = group.instances[(n / 2) % kCapacity];
                    ok(suppleDestroyInstance(handle, other));
                    ok(suppleCreateInstance(handle, group.group, &other));
                }
                const float data[4] = {static_cast<float>(n), 0.0f, 0.0f, 1.0f};
                ok(suppleSetUserData(handle, groups[0].instances[n % kCapacity], data));
                uint32_t room = SUPPLE_MAX_TIMINGS;
                ok(suppleGetTimings(handle, sizeof(SuppleTiming), timings.data(), &room));
                SuppleBudget budget{};
                budget.structSize = sizeof(budget);
                ok(suppleGetBudget(handle, SUPPLE_PASS_EVALUATE, &budget));
                ok(suppleSetBudget(handle, SUPPLE_PASS_MOTION, static_cast<double>(n + 1)));
            };
            poses();
            ASSERT_TRUE(device
                            ->submitAndWait([&](VkCommandBuffer commands) {
                                const AllocationCount count;
                                const SuppleResult result =
                                    context.record(commands, all, n % 5 == 4 ? 0 : SUPPLE_RECORD_TIMINGS);
                                good = good && result == SUPPLE_OK;
                                if (n % 250 == 249) { // thrown away, and begun anew
                                    ++frame;
                                    good = good && suppleCancelFrame(handle) == SUPPLE_OK &&
                                           suppleBeginFrame(handle, frame, frame - 1) == SUPPLE_OK &&
                                           context.record(commands, all) == SUPPLE_OK;
                                }
                            })
                            .ok());
        }
        EXPECT_TRUE(good);
        EXPECT_EQ(allocationsCounted() - before, 0u);
        EXPECT_EQ(allocator.calls() - allocatorBefore, 0u);
        EXPECT_EQ(memory.calls() - memoryBefore, 0u);
        EXPECT_EQ(log.others, 0u);
        EXPECT_GT(allocator.live(), 0u);
        EXPECT_GT(memory.live(), 0u);
        EXPECT_EQ(written >= 256 * kFrames, recorded); // calls and hashes of every frame
        context.frame = frame;
    }
    EXPECT_EQ(allocator.live(), 0u);
    EXPECT_EQ(memory.live(), 0u);
}

TEST(Allocation, FramesTakeNoMemory) {
    framesTakeNoMemory(false);
}

TEST(Allocation, RecordedFramesTakeNoMemory) {
    framesTakeNoMemory(true);
}

TEST(Allocation, ObjectsAreTheHostAllocatorsAndMemoryIsOfItsBlocks) {
    std::unique_ptr<host::Device> device = deviceThrough(nullptr);
    ASSERT_NE(device, nullptr);
    const auto validation = device->validation();
    std::vector<std::byte> bits[2];
    for (const bool blocks : {false, true}) {
        HostAllocator allocator;
        BlockMemory memory(*device);
        {
            LoggedContext context(*device, [&](SuppleContextDesc& desc) {
                desc.memory = blocks ? memory.callbacks() : nullptr;
                desc.allocator = allocator.callbacks();
            });
            ASSERT_EQ(context.result(), SUPPLE_OK);
            // Twice: what a driver keeps in the pipeline cache comes from the host's allocator, too.
            size_t kept = 0;
            for (const bool again : {false, true}) {
                const size_t before = allocator.live();
                SuppleAsset asset{};
                ASSERT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
                const SmallGroup group = createGroup(
                    context.handle(), asset, {.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES, .capacity = 4});
                for (uint32_t i = 0; i < 4; ++i) {
                    ASSERT_EQ(suppleSetClipPose(context.handle(), group.instances[i], 0, 0.4 * i), SUPPLE_OK);
                }
                context.evaluate({&group.group, 1}, SUPPLE_RECORD_TIMINGS);
                context.evaluate({&group.group, 1}, SUPPLE_RECORD_TIMINGS);
                bits[blocks ? 1 : 0] = surfaceBits(context, group.group);
                EXPECT_EQ(memory.live() > 0, blocks);
                EXPECT_GT(allocator.live(), before);
                ASSERT_EQ(suppleDestroyGroup(context.handle(), group.group), SUPPLE_OK);
                ASSERT_EQ(suppleDestroyAsset(context.handle(), asset), SUPPLE_OK);
                context.beginFrame();
                if (again) {
                    EXPECT_EQ(allocator.live(), kept) << "the frame is complete: the group's objects are gone";
                }
                kept = allocator.live();
            }
            EXPECT_GT(allocator.live(), 0u);
        }
        EXPECT_EQ(allocator.live(), 0u);
        EXPECT_EQ(memory.live(), 0u);
    }
    EXPECT_FALSE(bits[0].empty());
    EXPECT_TRUE(bits[0] == bits[1]) << "pieces of the host's blocks work as memory of Supple's own";
    device = nullptr;
    EXPECT_EQ(validation->messageCount(), 0u);
}

TEST(Allocation, ACallbackThatFailsLeavesTheContextUsable) {
    std::unique_ptr<host::Device> device = deviceThrough(nullptr);
    ASSERT_NE(device, nullptr);
    const auto validation = device->validation();
    {
        // Without memory for a block, pieces have their own.
        BlockMemory memory(*device);
        memory.failAt = 0;
        LoggedContext context(*device, [&](SuppleContextDesc& desc) {
            desc.memory = memory.callbacks();
            desc.memoryBlockSize = VkDeviceSize{256} << 20;
        });
        EXPECT_EQ(context.result(), SUPPLE_OK);
        EXPECT_GT(memory.live(), 0u);
    }
    {
        BlockMemory memory(*device);
        memory.failAt = 0;
        LoggedContext context(*device, [&](SuppleContextDesc& desc) { desc.memory = memory.callbacks(); });
        EXPECT_EQ(context.result(), SUPPLE_ERROR_DEVICE_MEMORY);
        EXPECT_EQ(context.handle(), nullptr);
        EXPECT_EQ(context.takeCount(SUPPLE_MESSAGE_DEVICE_MEMORY), 1u);
        EXPECT_EQ(memory.live(), 0u);
    }
    {
        BlockMemory memory(*device);
        LoggedContext context(*device, [&](SuppleContextDesc& desc) { desc.memory = memory.callbacks(); });
        ASSERT_EQ(context.result(), SUPPLE_OK);
        const size_t live = memory.live();
        for (const bool unmapped : {false, true}) {
            const auto failAt = [&](int64_t n) {
                memory.allocations = memory.visible = 0;
                (unmapped ? memory.unmappedAt : memory.failAt) = n;
            };
            const SuppleResult wanted = unmapped ? SUPPLE_ERROR_ARGUMENT : SUPPLE_ERROR_DEVICE_MEMORY;
            const SuppleMessage message = unmapped ? SUPPLE_MESSAGE_CONFLICT : SUPPLE_MESSAGE_DEVICE_MEMORY;
            uint32_t failures = 0;
            for (int64_t n = 0;; ++n) {
                ASSERT_LT(n, 50);
                failAt(n);
                SuppleAsset asset{};
                SmallGroup group;
                SuppleResult result = createTube(context.handle(), asset);
                if (result == SUPPLE_OK) {
                    group = createGroup(context.handle(), asset, {.flags = SUPPLE_GROUP_MOTION});
                    result = group.result;
                }
                const bool failed = result != SUPPLE_OK;
                if (failed) {
                    ++failures;
                    EXPECT_EQ(result, wanted) << n;
                    EXPECT_EQ(context.takeCount(message), 1u) << n;
                    EXPECT_EQ(group.group.id, 0u);
                } else {
                    failAt(-1);
                    context.evaluate({&group.group, 1});
                    EXPECT_EQ(suppleDestroyGroup(context.handle(), group.group), SUPPLE_OK);
                }
                if (asset.id != 0) {
                    EXPECT_EQ(suppleDestroyAsset(context.handle(), asset), SUPPLE_OK);
                }
                context.beginFrame();
                EXPECT_LE(memory.live(), live) << "something leaked";
                if (!failed) {
                    break;
                }
            }
            EXPECT_GE(failures, unmapped ? 4u : 7u);
        }
    }
    device = nullptr;
    EXPECT_EQ(validation->messageCount(), 0u) << "something leaked";
}

} // namespace
} // namespace supple::test
