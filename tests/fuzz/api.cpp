// Calls of the public API in any order, most of them right: the input chooses which, of what and when, whether groups
// have threads of their own in a frame, and whether the device is lost on the way. Every call comes back with a result
// that it may have, and what is destroyed leaves no memory on the device.
#include "host/context.h"
#include "host/device.h"
#include "tests/fault/vulkan_faults.h"
#include "tests/fuzz/kept_pipelines.h"
#include "tests/fuzz/target.h"
#include "tests/support/recorder.h"
#include "tests/support/rigged_tube.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace supple::fuzz {
namespace {

constexpr const char* kCube = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
                              "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\nf 2 3 7 6\n";

constexpr uint32_t kTubeJoints = 3;

/// A tube with a chain of joints, which a clip moves.
const std::vector<std::byte>& tube() {
    static const std::vector<std::byte> bytes = [] {
        cage::Character made = test::riggedTube({.segments = 4, .sides = 4, .joints = kTubeJoints, .morphTargets = 2});
        made.clips.push_back(test::clipOf(
            {test::channel(1, cage::ChannelPath::translation, {0, 1, 2}, {0, 0, 0, -1, 0.5f, 0, -2, 0, 0})}));
        Result<cage::GlbFile> file = cage::writeGlb(made);
        demand(file.ok(), "no tube");
        return std::move(file->bytes);
    }();
    return bytes;
}

struct EndDevice {
    void operator()(host::Device* device) const {
        destroyKeptPipelines(device->handle());
        delete device;
    }
};

host::Device& device() {
    static const std::unique_ptr<host::Device, EndDevice> made = [] {
        test::setVulkanBelow(&keepingGetInstanceProcAddr);
        host::DeviceOptions options;
        options.suppleGetInstanceProcAddr = &test::faultyGetInstanceProcAddr;
        Result<std::unique_ptr<host::Device>> result = host::Device::create(options);
        demand(result.ok(), "no device");
        return std::unique_ptr<host::Device, EndDevice>(result->release());
    }();
    return *made;
}

/// The input as a row of choices; when it has ended, zeros.
class Choices {
public:
    Choices(const uint8_t* data, size_t size) : data_(data), left_(size) {}
    [[nodiscard]] bool any() const { return left_ > 0; }
    uint32_t below(uint32_t count) {
        if (left_ == 0) {
            return 0;
        }
        --left_;
        return *data_++ % count;
    }
    template <class T>
    T& of(std::vector<T>& values) {
        return values[below(static_cast<uint32_t>(values.size()))];
    }
    /// The next `count` choices, for somebody else.
    Choices take(size_t count) {
        const size_t taken = std::min(count, left_);
        const Choices theirs(data_, taken);
        data_ += taken;
        left_ -= taken;
        return theirs;
    }

private:
    const uint8_t* data_;
    size_t left_;
};

class Driver {
public:
    Driver(const uint8_t* data, size_t size) : choose_(data, size) {
        SuppleContextDesc desc = host::contextDesc(device());
        desc.framesInFlight = 1 + choose_.below(SUPPLE_MAX_FRAMES_IN_FLIGHT);
        if (choose_.below(2) == 1) {
            desc.flags |= SUPPLE_CONTEXT_ASYNC_COMPUTE;
            desc.drawQueueFamily = desc.queueFamily;
        }
        desc.mapping = static_cast<SuppleMapping>(choose_.below(3));
        framesInFlight_ = desc.framesInFlight;
        demand(suppleCreateContext(&desc, &context_) == SUPPLE_OK, "no context");
    }
    Driver(const Driver&) = delete;
    Driver& operator=(const Driver&) = delete;
    ~Driver() {
        test::liftVulkanFailure();
        suppleDestroyContext(context_);
    }

    void run() {
        const uint64_t before = memory();
        createAsset();
        for (uint32_t step = 0; step < 96 && choose_.any(); ++step) {
            act();
        }
        for (const Group& group : groups_) {
            check(suppleDestroyGroup(context_, group.handle));
        }
        for (const SuppleAsset asset : assets_) {
            check(suppleDestroyAsset(context_, asset));
        }
        if (suppleBeginFrame(context_, frame_ + 1, frame_) == SUPPLE_OK) { // else the device is lost
            demand(memory() <= before, "something is left on the device");
        }
    }

private:
    /// A group and those that follow it are one family: one thread at a time may use them.
    struct Group {
        SuppleGroup handle;
        uint32_t family;
    };
    struct Instance {
        SuppleInstance handle;
        uint32_t family;
    };
    /// What a thread works on.
    struct Family {
        Choices choose;
        std::vector<SuppleGroup> groups;
        std::vector<SuppleInstance> instances, created;
    };

    [[nodiscard]] uint64_t memory() const {
        SuppleMemoryUse use{};
        use.structSize = sizeof(use);
        check(suppleGetContextMemory(context_, &use));
        return use.deviceLocal + use.hostVisible;
    }

    void check(SuppleResult result) const {
        demand(result != SUPPLE_ERROR_VULKAN && (mayBeLost_ || result != SUPPLE_ERROR_DEVICE_LOST) &&
                   result != SUPPLE_ERROR_HOST_MEMORY && result != SUPPLE_ERROR_DEVICE_MEMORY,
               suppleResultString(result));
    }

    void createAsset() {
        SuppleAssetDesc desc{};
        desc.structSize = sizeof(desc);
        if (choose_.below(2) == 1) {
            desc.name = "tube";
            desc.bytes = tube().data();
            desc.byteCount = tube().size();
        } else {
            desc.name = "cube.obj";
            desc.bytes = kCube;
            desc.byteCount = std::char_traits<char>::length(kCube);
        }
        SuppleAsset asset{};
        check(suppleCreateAsset(context_, &desc, &asset));
        if (asset.id != 0) {
            assets_.push_back(asset);
        }
        if (choose_.below(4) == 1) {
            check(suppleReloadAsset(context_, choose_.of(assets_), &desc));
        }
    }

    void createGroup() {
        static constexpr SuppleScheme kSchemes[] = {
            SUPPLE_SCHEME_AUTO,  SUPPLE_SCHEME_PREP,     SUPPLE_SCHEME_PM,        SUPPLE_SCHEME_CATMULL_CLARK,
            SUPPLE_SCHEME_BLEND, SUPPLE_SCHEME_POLYGONS, SUPPLE_SCHEME_FRAGMENTS, SUPPLE_SCHEME_CAGE};
        SuppleGroupDesc desc{};
        desc.structSize = sizeof(desc);
        desc.asset = choose_.of(assets_);
        desc.capacity = 1 + choose_.below(3);
        desc.scheme = kSchemes[choose_.below(8)];
        desc.rate = choose_.below(5);
        desc.flags = choose_.below(64);
        desc.poseSource = static_cast<SupplePoseSource>(choose_.below(4));
        if (desc.poseSource == SUPPLE_POSES_PLAYBACK) {
            desc.flags |= choose_.below(32) * SUPPLE_GROUP_MODIFIERS; // transitions, update rates, springs, jiggle
        }
        desc.skinning = static_cast<SuppleSkinning>(choose_.below(6));
        uint32_t family = families_;
        if (!groups_.empty() && choose_.below(8) == 1) {
            const Group& followed = choose_.of(groups_);
            desc.instancesOf = followed.handle;
            desc.capacity = 0;
            family = followed.family;
        }
        SuppleGroup group{};
        check(suppleCreateGroup(context_, &desc, &group));
        if (group.id != 0) {
            groups_.push_back({group, family});
            families_ = std::max(families_, family + 1);
        }
    }

    void frame() {
        ++frame_;
        const uint64_t behind = 1 + choose_.below(framesInFlight_);
        check(suppleBeginFrame(context_, frame_, std::max(completed_, frame_ - std::min(frame_, behind))));
        completed_ = std::max(completed_, frame_ - std::min(frame_, behind));
        switch (choose_.below(8)) {
        case 1:
            check(suppleCancelFrame(context_));
            break;
        case 2:
            recordOnThreads();
            break;
        default:
            recordAlone();
            break;
        }
    }

    void record(VkCommandBuffer commands, std::span<const SuppleGroup> groups, Choices& choose) {
        SuppleRecordDesc desc{};
        desc.structSize = sizeof(desc);
        desc.groups = groups.data();
        desc.groupCount = static_cast<uint32_t>(groups.size());
        desc.flags = choose.below(2) == 1 ? SUPPLE_RECORD_TIMINGS : 0;
        desc.before = desc.after = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                    VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
        check(suppleRecord(context_, commands, &desc));
    }

    void recordAlone() {
        std::vector<SuppleGroup> groups;
        for (const Group& group : groups_) {
            groups.push_back(group.handle);
        }
        const Status submitted = device().submitAndWait([&](VkCommandBuffer commands) {
            if (choose_.below(3) == 1) {
                check(suppleRecordUploads(context_, commands));
            }
            record(commands, groups, choose_);
        });
        demand(submitted.ok(), "a frame cannot be submitted");
    }

    /// Every family changes its instances and records its groups on a thread of its own.
    void recordOnThreads() {
        std::map<uint32_t, Family> families;
        for (const Group& group : groups_) {
            const auto [family, isNew] = families.try_emplace(group.family, Family{Choices(nullptr, 0), {}, {}, {}});
            if (isNew) {
                family->second.choose = choose_.take(16);
            }
            family->second.groups.push_back(group.handle);
        }
        for (const Instance& instance : instances_) {
            if (const auto family = families.find(instance.family); family != families.end()) {
                family->second.instances.push_back(instance.handle);
            }
        }
        std::vector<std::unique_ptr<test::Recorder>> recorders;
        recorders.push_back(std::make_unique<test::Recorder>(device()));
        check(suppleRecordUploads(context_, recorders[0]->begin()));
        recorders[0]->end();
        {
            std::vector<std::jthread> threads;
            for (auto& [number, family] : families) {
                recorders.push_back(std::make_unique<test::Recorder>(device()));
                threads.emplace_back([this, &mine = family, &recorder = *recorders.back()] { work(mine, recorder); });
            }
        }
        for (const auto& [number, family] : families) {
            for (const SuppleInstance instance : family.created) {
                instances_.push_back({instance, number});
            }
        }
        submit(recorders);
    }

    /// On a thread of its own.
    void work(Family& family, test::Recorder& recorder) {
        for (uint32_t step = 0; step < 4; ++step) {
            if (family.instances.empty() || family.choose.below(4) == 1) {
                family.created.push_back(createInstance(family.choose.of(family.groups)));
                family.instances.push_back(family.created.back());
            } else {
                actOnInstance(family.choose, family.choose.of(family.instances));
            }
        }
        record(recorder.begin(), family.groups, family.choose);
        recorder.end();
    }

    static void submit(const std::vector<std::unique_ptr<test::Recorder>>& recorders) {
        std::vector<VkCommandBuffer> commands;
        for (const std::unique_ptr<test::Recorder>& recorder : recorders) {
            commands.push_back(recorder->handle());
        }
        VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
        submit.commandBufferCount = static_cast<uint32_t>(commands.size());
        submit.pCommandBuffers = commands.data();
        demand(vkQueueSubmit(device().queue(), 1, &submit, VK_NULL_HANDLE) == VK_SUCCESS &&
                   vkQueueWaitIdle(device().queue()) == VK_SUCCESS,
               "a frame of several threads cannot be submitted");
    }

    SuppleInstance createInstance(SuppleGroup group) {
        SuppleInstance instance{};
        check(suppleCreateInstance(context_, group, &instance));
        return instance;
    }

    void actOnInstance(Choices& choose, SuppleInstance instance) {
        float pose[16];
        const float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        switch (choose.below(11)) {
        case 0:
            check(suppleSetClipPose(context_, instance, choose.below(2) == 1 ? SUPPLE_BIND_POSE : 0, 0.5));
            break;
        case 8:
            play(choose, instance);
            break;
        case 10:
            modify(choose, instance);
            break;
        case 9: {
            const float weights[] = {0.5f, 1.0f};
            check(suppleSetMorphWeights(context_, instance, weights, 2));
            break;
        }
        case 1:
            check(suppleSetTransform(context_, instance, matrix));
            break;
        case 2:
            check(suppleSetVisible(context_, instance, choose.below(2)));
            break;
        case 3:
            check(suppleSetPartVisible(context_, instance, 0, choose.below(2)));
            break;
        case 4:
            check(suppleTeleport(context_, instance));
            check(suppleGetJointTransform(context_, instance, choose.below(kTubeJoints), pose));
            break;
        case 5:
            check(suppleSetMatrixPose(context_, instance, matrix, 1));
            break;
        case 6:
            check(suppleSetUserData(context_, instance, matrix));
            check(suppleSetSharpness(context_, instance, choose.below(2), matrix[0]));
            break;
        default:
            check(suppleDestroyInstance(context_, instance)); // its handle stays: others meet a stale one
            break;
        }
    }

    void modify(Choices& choose, SuppleInstance instance) {
        SuppleModifier modifiers[2]{};
        for (SuppleModifier& modifier : modifiers) {
            modifier.kind = static_cast<SuppleModifierKind>(choose.below(5));
            modifier.flags = 1u << choose.below(4);
            modifier.joint = choose.below(kTubeJoints);
            modifier.weight = 0.5f;
            modifier.target[choose.below(3)] = choose.below(4);
            modifier.rotation[3] = 1.0f;
        }
        SuppleModifiersDesc desc{};
        desc.structSize = sizeof(desc);
        desc.modifiers = modifiers;
        desc.modifierCount = choose.below(3);
        check(suppleSetModifiers(context_, instance, &desc));
        SuppleModifierTarget target{};
        target.structSize = sizeof(target);
        target.target[1] = choose.below(4);
        target.rotation[3] = 1.0f;
        check(suppleSetModifierTarget(context_, instance, 0, &target));
    }

    void play(Choices& choose, SuppleInstance instance) {
        SupplePlaybackLayer layers[2]{};
        for (SupplePlaybackLayer& layer : layers) {
            layer.weight = layer.speed = 1.0f;
            layer.offset = choose.below(4);
        }
        SupplePlaybackDesc desc{};
        desc.structSize = sizeof(desc);
        desc.layers = layers;
        desc.layerCount = 1 + choose.below(2);
        desc.transition = 0.1 * choose.below(3);
        desc.transitionKind = static_cast<SuppleTransitionKind>(choose.below(2));
        desc.flags = choose.below(4) * SUPPLE_PLAYBACK_KEEP_TRANSITION; // and from what is modified
        desc.updateInterval = 1u << choose.below(5) >> 1u;
        check(suppleSetPlayback(context_, instance, &desc));
    }

    void act() {
        if (choose_.below(128) == 1) {
            mayBeLost_ = true;
            test::failVulkan(choose_.below(64), VK_ERROR_DEVICE_LOST);
        }
        switch (choose_.below(10)) {
        case 0:
            createAsset();
            break;
        case 1:
            createGroup();
            break;
        case 2:
            if (!groups_.empty()) {
                const Group& group = choose_.of(groups_);
                instances_.push_back({createInstance(group.handle), group.family});
            }
            break;
        case 3:
            if (!groups_.empty()) {
                check(suppleSetCapacity(context_, choose_.of(groups_).handle, 1 + choose_.below(4)));
            }
            break;
        case 4:
            if (!groups_.empty()) {
                check(suppleSetRate(context_, choose_.of(groups_).handle, 1 + choose_.below(4)));
            }
            break;
        case 5:
            if (!groups_.empty() && choose_.below(3) == 1) {
                Group& group = choose_.of(groups_);
                check(suppleDestroyGroup(context_, group.handle));
                std::swap(group, groups_.back());
                groups_.pop_back();
            }
            break;
        case 6:
        case 7:
            frame();
            break;
        case 8:
            if (!groups_.empty()) {
                const SuppleGroup group = choose_.of(groups_).handle;
                check(suppleSetTime(context_, group, choose_.below(8)));
                const float wind[3] = {static_cast<float>(choose_.below(8)), 0.0f, 1.0f};
                check(suppleSetWind(context_, group, wind));
            }
            [[fallthrough]];
        default:
            if (!instances_.empty()) {
                actOnInstance(choose_, choose_.of(instances_).handle);
            }
            break;
        }
    }

    Choices choose_;
    SuppleContext context_ = nullptr;
    uint32_t framesInFlight_ = 1;
    uint64_t frame_ = 0, completed_ = 0;
    bool mayBeLost_ = false;
    std::vector<SuppleAsset> assets_;
    uint32_t families_ = 0;
    std::vector<Group> groups_;
    std::vector<Instance> instances_;
};

} // namespace
} // namespace supple::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    supple::fuzz::Driver(data, size).run();
    return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
    return supple::fuzz::mutateWith(supple::fuzz::mutateBytes, data, size, most, seed);
}
