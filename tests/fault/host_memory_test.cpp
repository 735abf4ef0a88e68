// Every allocation of every public function fails, one after the other: the call says so, changes nothing, and the
// call after it does what the first would have done.
#include "tests/cage/gltf/builder.h"
#include "tests/fault/vulkan_pause.h"
#include "tests/support/host_memory.h"
#include "tests/support/logged_context.h"

#include <array>
#include <cstring>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace supple::test {
namespace {

uint64_t memoryOf(SuppleContext context) {
    SuppleMemoryUse use{};
    use.structSize = sizeof(use);
    EXPECT_EQ(suppleGetContextMemory(context, &use), SUPPLE_OK);
    return use.deviceLocal + use.hostVisible;
}

/// Makes calls, each first with every allocation of it failing.
class Calls {
public:
    explicit Calls(Failure kind) : kind_(kind) {}

    /// The call until nothing in it failed.
    template <class Call>
    void operator()(const char* name, Call&& call, SuppleResult good = SUPPLE_OK) {
        for (uint64_t n = 0;; n += stride) {
            failHostMemory(n, kind_);
            const SuppleResult result = call();
            const bool failed = liftHostFailure();
            if (!failed) {
                ASSERT_EQ(result, good) << name;
                return;
            }
            ++positions;
            ASSERT_EQ(result, SUPPLE_ERROR_HOST_MEMORY) << name << ", allocation " << n;
        }
    }

    uint64_t positions = 0;
    uint64_t stride = 1;

private:
    Failure kind_;
};

std::vector<std::byte> externalFile() {
    GltfBuilder b = skinnedQuad();
    b.more += R"(,"images":[{"uri":"picture.png"}],"materials":[{}])";
    return toBytes(b.json("quad.bin"));
}

struct Files {
    std::vector<std::byte> binary = skinnedQuad().binary();
    int held = 0;

    [[nodiscard]] SuppleFiles callbacks() {
        SuppleFiles files{};
        files.user = this;
        files.read = [](const char* path, SuppleFileBytes* out, void* user) {
            auto& own = *static_cast<Files*>(user);
            if (std::strcmp(path, "quad.bin") != 0 && std::strcmp(path, "picture.png") != 0) {
                return 0;
            }
            ++own.held;
            out->bytes = own.binary.data();
            out->byteCount = own.binary.size();
            return 1;
        };
        files.release = [](SuppleFileBytes*, void* user) { --static_cast<Files*>(user)->held; };
        return files;
    }
};

/// A log that keeps nothing.
void quiet(SuppleContextDesc& desc) {
    desc.log = [](SuppleSeverity, SuppleMessage, const char*, void*) {};
    desc.flags |= SUPPLE_CONTEXT_ASYNC_COMPUTE;
    desc.drawQueueFamily = desc.queueFamily;
}

class World {
public:
    World(host::Device& device, Failure kind, bool faulty)
        : calls_(kind), faulty_(faulty), context_(device, quiet), device_(device) {}

    /// Every function, cold and then with frames in flight. Returns what the frames came out as.
    std::vector<std::byte> run() {
        const uint64_t before = memoryOf(handle());
        createAssets();
        createGroups();
        pose();
        ask();
        frames(0);
        change();
        pose();
        askMore();
        frames(1);
        std::vector<std::byte> bits;
        for (const SuppleGroup group : {groups_[0], groups_[1], groups_[2], groups_[3]}) {
            const std::vector<std::byte> own = surfaceBits(context_, group);
            bits.insert(bits.end(), own.begin(), own.end());
        }
        destroy();
        EXPECT_LE(memoryOf(handle()), before) << "something is left on the device";
        return bits;
    }

    [[nodiscard]] uint64_t positions() const { return calls_.positions; }

private:
    template <class Call>
    void call(const char* name, Call&& body, SuppleResult good = SUPPLE_OK) {
        if (faulty_) {
            calls_(name, body, good);
        } else {
            ASSERT_EQ(body(), good) << name;
        }
    }

    void createAssets() {
        SuppleAssetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.name = "a tube whose name is too long to lie in a string itself";
        desc.bytes = tubeFile().data();
        desc.byteCount = tubeFile().size();
        call("suppleCreateAsset, a GLB", [&] { return suppleCreateAsset(handle(), &desc, &tube_); });

        const std::vector<std::byte> external = externalFile();
        SuppleFiles files = files_.callbacks();
        SuppleClipFile clips{};
        clips.bytes = external.data();
        clips.byteCount = external.size();
        clips.files = &files;
        desc.bytes = external.data();
        desc.byteCount = external.size();
        desc.files = &files;
        desc.clipFiles = &clips;
        desc.clipFileCount = 1;
        call("suppleCreateAsset, files of the host", [&] {
            const SuppleResult result = suppleCreateAsset(handle(), &desc, &quad_);
            EXPECT_EQ(files_.held, 0);
            return result;
        });

        const std::vector<std::byte> obj = toBytes("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1 4/1\n");
        SuppleAssetDesc other{};
        other.structSize = sizeof(other);
        other.name = "square.obj";
        other.bytes = obj.data();
        other.byteCount = obj.size();
        SuppleAsset square{};
        call("suppleCreateAsset, an OBJ", [&] { return suppleCreateAsset(handle(), &other, &square); });

        const float positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
        const uint32_t counts[] = {4}, indices[] = {0, 1, 2, 3};
        SuppleCageDesc cage{};
        cage.structSize = sizeof(cage);
        cage.vertexCount = 4;
        cage.faceCount = 1;
        cage.positions = positions;
        cage.faceVertexCounts = counts;
        cage.faceVertexIndices = indices;
        other.bytes = nullptr;
        other.cage = &cage;
        call("suppleReloadAsset, arrays", [&] { return suppleReloadAsset(handle(), square, &other); });
        call("suppleDestroyAsset", [&] { return suppleDestroyAsset(handle(), square); });

        other.cage = nullptr;
        const std::vector<std::byte> wrong = toBytes(R"({"asset":{"version":"1.0"}})");
        other.bytes = wrong.data();
        other.byteCount = wrong.size();
        call(
            "suppleCreateAsset, a wrong file", [&] { return suppleCreateAsset(handle(), &other, &square); },
            SUPPLE_ERROR_ASSET);
    }

    void createGroups() {
        SuppleViewDesc viewDesc{};
        viewDesc.structSize = sizeof(viewDesc);
        viewDesc.maxVertices = 4096;
        viewDesc.flags = SUPPLE_VIEW_CULL | SUPPLE_VIEW_OCCLUSION;
        call("suppleCreateView", [&] { return suppleCreateView(handle(), &viewDesc, &view_); });
        const SuppleGroupDesc wanted[] = {
            {.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_PATCHES | SUPPLE_GROUP_BOUNDS,
             .scheme = SUPPLE_SCHEME_PM},
            {.flags = SUPPLE_GROUP_ATTRIBUTES, .scheme = SUPPLE_SCHEME_CATMULL_CLARK},
            {.scheme = SUPPLE_SCHEME_POLYGONS},
            {.scheme = SUPPLE_SCHEME_PREP, .poseSource = SUPPLE_POSES_PLAYBACK},
            {.scheme = SUPPLE_SCHEME_FRAGMENTS},
            {.scheme = SUPPLE_SCHEME_BLEND},
            {.scheme = SUPPLE_SCHEME_AUTO, .view = view_}};
        static_assert(std::size(wanted) == kGroups);
        for (size_t i = 0; i < kGroups; ++i) {
            SuppleGroupDesc desc = wanted[i];
            desc.structSize = sizeof(desc);
            desc.asset = tube_;
            desc.capacity = 2;
            desc.rate = 2;
            const std::string name = "suppleCreateGroup " + std::to_string(i);
            call(name.c_str(), [&] { return suppleCreateGroup(handle(), &desc, &groups_[i]); });
            createInstance(i);
            createInstance(i);
        }
    }

    void createInstance(size_t group) {
        SuppleInstance instance{};
        call("suppleCreateInstance", [&] { return suppleCreateInstance(handle(), groups_[group], &instance); });
        instances_[group].push_back(instance);
    }

    void pose() {
        for (size_t i = 0; i < kGroups; ++i) {
            for (const SuppleInstance instance : instances_[i]) {
                if (i == kPlayed) {
                    SupplePlaybackLayer layer{};
                    layer.weight = layer.speed = 1.0f;
                    SupplePlaybackDesc desc{};
                    desc.structSize = sizeof(desc);
                    desc.layers = &layer;
                    desc.layerCount = 1;
                    call("suppleSetPlayback", [&] { return suppleSetPlayback(handle(), instance, &desc); });
                } else {
                    poseWith(instance);
                }
                const double position[3] = {static_cast<double>(instance.slot), 0.0, 0.0};
                call("suppleSetPosition", [&] { return suppleSetPosition(handle(), instance, position); });
            }
        }
        call("suppleSetPriority", [&] { return suppleSetPriority(handle(), instances_[kSeen][0], 1); });
        call("suppleSetTime", [&] { return suppleSetTime(handle(), groups_[kPlayed], 0.5); });
        SuppleMaskDesc mask{};
        const float ones[] = {1.0f, 0.5f, 1.0f};
        mask.structSize = sizeof(mask);
        mask.mask = 1;
        mask.jointMask = ones;
        mask.jointMaskCount = 3;
        call("suppleSetMask", [&] { return suppleSetMask(handle(), groups_[kPlayed], &mask); });
    }

    void poseWith(SuppleInstance instance) {
        const float matrices[3 * 16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0,
                                        0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        const float weights[] = {0.5f, 0.0f, 0.25f, 0.0f};
        const float data[] = {1, 2, 3, 4};
        call("suppleSetMatrixPose", [&] { return suppleSetMatrixPose(handle(), instance, matrices, 3); });
        call("suppleSetMorphWeights", [&] { return suppleSetMorphWeights(handle(), instance, weights, 4); });
        SuppleClipLayer layer{};
        layer.weight = 1.0f;
        layer.time = 0.25;
        SupplePoseDesc desc{};
        desc.structSize = sizeof(desc);
        desc.layers = &layer;
        desc.layerCount = 1;
        call("suppleSetPose", [&] { return suppleSetPose(handle(), instance, &desc); });
        call("suppleSetClipPose", [&] { return suppleSetClipPose(handle(), instance, 0, 0.75); });
        call("suppleSetUserData", [&] { return suppleSetUserData(handle(), instance, data); });
        call("suppleSetVisible", [&] { return suppleSetVisible(handle(), instance, 1); });
        call("suppleSetPartVisible", [&] { return suppleSetPartVisible(handle(), instance, 0, 1); });
        call("suppleTeleport", [&] { return suppleTeleport(handle(), instance); });
    }

    template <class T, class Get>
    void get(const char* name, Get&& body) {
        T info{};
        info.structSize = sizeof(info);
        call(name, [&] { return body(&info); });
    }

    void ask() {
        get<SuppleAssetInfo>("suppleGetAssetInfo", [&](auto* out) { return suppleGetAssetInfo(handle(), tube_, out); });
        get<SupplePartInfo>("suppleGetPartInfo", [&](auto* out) { return suppleGetPartInfo(handle(), tube_, 0, out); });
        get<SuppleClipInfo>("suppleGetClipInfo", [&](auto* out) { return suppleGetClipInfo(handle(), tube_, 0, out); });
        get<SuppleJointInfo>("suppleGetJointInfo",
                             [&](auto* out) { return suppleGetJointInfo(handle(), tube_, 0, out); });
        get<SuppleMaterialInfo>("suppleGetMaterialInfo",
                                [&](auto* out) { return suppleGetMaterialInfo(handle(), tube_, 0, out); });
        get<SuppleImageInfo>("suppleGetImageInfo",
                             [&](auto* out) { return suppleGetImageInfo(handle(), tube_, 0, out); });
        get<SuppleGroupInfo>("suppleGetGroupInfo",
                             [&](auto* out) { return suppleGetGroupInfo(handle(), groups_[0], out); });
        get<SuppleGridOutput>("suppleGetGridOutput",
                              [&](auto* out) { return suppleGetGridOutput(handle(), groups_[0], 0, out); });
        get<SuppleMemoryUse>("suppleGetGroupMemory",
                             [&](auto* out) { return suppleGetGroupMemory(handle(), groups_[0], out); });
        SuppleBounds bounds{};
        call("suppleGetClipBounds", [&] { return suppleGetClipBounds(handle(), tube_, 0, &bounds); });
        call("suppleGetGroupClipBounds", [&] { return suppleGetGroupClipBounds(handle(), groups_[0], 0, &bounds); });
        float mask[3] = {};
        call("suppleFillJointMask", [&] { return suppleFillJointMask(handle(), tube_, 0, 1.0f, mask, 3); });
        float socket[16];
        call("suppleGetJointTransform", [&] { return suppleGetJointTransform(handle(), instances_[0][0], 1, socket); });
        uint32_t count = 0;
        call("suppleGetClipMarkers", [&] { return suppleGetClipMarkers(handle(), tube_, 0, nullptr, &count); });
        call(
            "suppleGetTimings", [&] { return suppleGetTimings(handle(), nullptr, &count); }, SUPPLE_NOT_READY);
        call("suppleSetBudget", [&] { return suppleSetBudget(handle(), "evaluate", 1e9); });
        call(
            "suppleSetBudget, of no pass",
            [&] { return suppleSetBudget(handle(), "a pass of a long name, for a budget", 1e6); },
            SUPPLE_ERROR_ARGUMENT);
        call("suppleSetMemoryBudget", [&] { return suppleSetMemoryBudget(handle(), 0, nullptr, nullptr); });
        // Mistakes need memory for what is said about them.
        call(
            "suppleGetClipInfo, out of range",
            [&] {
                SuppleClipInfo info{};
                info.structSize = sizeof(info);
                return suppleGetClipInfo(handle(), tube_, 1000, &info);
            },
            SUPPLE_ERROR_ARGUMENT);
        SuppleRequirements requirements{};
        requirements.structSize = sizeof(requirements);
        call(
            "suppleQueryRequirements, of nothing",
            [&] { return suppleQueryRequirements(VK_NULL_HANDLE, VK_NULL_HANDLE, nullptr, &requirements); },
            SUPPLE_ERROR_ARGUMENT);
    }

    /// What may also answer that there is nothing yet.
    template <class Call>
    void ready(const char* name, Call&& body) {
        const SuppleResult good = body();
        EXPECT_NE(good, SUPPLE_ERROR_HOST_MEMORY) << name;
        call(name, body, good);
    }

    void askMore() {
        get<SuppleMorphTargetInfo>("suppleGetMorphTargetInfo",
                                   [&](auto* out) { return suppleGetMorphTargetInfo(handle(), tube_, 0, out); });
        get<SuppleSurfaceInfo>("suppleGetSurfaceInfo",
                               [&](auto* out) { return suppleGetSurfaceInfo(handle(), groups_[0], 0, out); });
        get<SuppleVertexStreams>("suppleGetVertexStreams",
                                 [&](auto* out) { return suppleGetVertexStreams(handle(), groups_[0], 0, out); });
        get<SuppleLevelOutput>("suppleGetLevelOutput",
                               [&](auto* out) { return suppleGetLevelOutput(handle(), groups_[kSeen], 0, out); });
        get<SuppleMemoryUse>("suppleGetAssetMemory",
                             [&](auto* out) { return suppleGetAssetMemory(handle(), tube_, out); });
        get<SuppleMemoryUse>("suppleGetViewMemory",
                             [&](auto* out) { return suppleGetViewMemory(handle(), view_, out); });
        get<SuppleMemoryUse>("suppleGetContextMemory",
                             [&](auto* out) { return suppleGetContextMemory(handle(), out); });
        get<SuppleBudget>("suppleGetBudget", [&](auto* out) { return suppleGetBudget(handle(), "evaluate", out); });
        SuppleViewStatistics statistics{};
        statistics.structSize = sizeof(statistics);
        ready("suppleGetViewStatistics", [&] { return suppleGetViewStatistics(handle(), view_, &statistics); });
        SuppleBufferRange range{};
        ready("suppleGetInstanceBounds", [&] { return suppleGetInstanceBounds(handle(), groups_[0], &range); });
        uint64_t ticks = 0;
        ready("suppleGetTimingOrigin", [&] { return suppleGetTimingOrigin(handle(), &ticks); });
        uint32_t count = 0;
        ready("suppleGetTimingSurfaces", [&] { return suppleGetTimingSurfaces(handle(), nullptr, &count); });
        ready("suppleGetPatches", [&] { return suppleGetPatches(handle(), groups_[0], 0, nullptr, &count); });
        ready("suppleGetClipMarkersBetween",
              [&] { return suppleGetClipMarkersBetween(handle(), tube_, 0, 0.0, 1.0, 0, nullptr, &count); });
        SuppleBounds bounds{};
        ready("suppleReadInstanceBounds",
              [&] { return suppleReadInstanceBounds(handle(), instances_[0][0], &bounds, &ticks); });
        const float transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        call("suppleSetTransform", [&] { return suppleSetTransform(handle(), instances_[0][0], transform); });
        const double origin[3] = {};
        call("suppleSetOrigin", [&] { return suppleSetOrigin(handle(), origin); });
        ready("suppleSetDepthPyramid", [&] { return suppleSetDepthPyramid(handle(), view_, nullptr); });
        SuppleClipLayer layer{};
        layer.weight = 1.0f;
        SupplePoseDesc pose{};
        pose.structSize = sizeof(pose);
        pose.layers = &layer;
        pose.layerCount = 1;
        SuppleRootMotion motion{};
        motion.structSize = sizeof(motion);
        ready("suppleGetRootMotion", [&] { return suppleGetRootMotion(handle(), tube_, &pose, &motion); });
    }

    void frames(size_t round) {
        for (size_t n = 0; n < 3; ++n) {
            call("suppleBeginFrame", [&] { return suppleBeginFrame(handle(), frame_ + 1, frame_); });
            ++frame_;
            SuppleCameraDesc camera{};
            camera.structSize = sizeof(camera);
            camera.pixelsPerUnit = 800.0f;
            call("suppleSetCamera", [&] { return suppleSetCamera(handle(), view_, &camera); });
            if (n == 1 && round == 0) {
                call("suppleCancelFrame", [&] { return suppleCancelFrame(handle()); });
                continue;
            }
            context_.frame = frame_;
            ASSERT_TRUE(device_.submitAndWait([&](VkCommandBuffer commands) { record(commands, round); }).ok());
        }
    }

    void record(VkCommandBuffer commands, size_t round) {
        if (round == 0) {
            call("suppleRecordUploads", [&] { return suppleRecordUploads(handle(), commands); });
        }
        const std::span<const SuppleGroup> all(groups_);
        if (round == 1) {
            call("suppleRecordWarmUp",
                 [&] { return suppleRecordWarmUp(handle(), commands, all.data(), static_cast<uint32_t>(all.size())); });
        }
        call("suppleRecord", [&] { return context_.record(commands, all, SUPPLE_RECORD_TIMINGS); });
        uint32_t count = 0;
        call("suppleGetAcquireBarriers",
             [&] { return suppleGetAcquireBarriers(handle(), all.data(), 1, kAnyUse, nullptr, &count); });
    }

    void change() {
        for (size_t i = 0; i < kGroups; ++i) {
            call("suppleSetCapacity", [&] { return suppleSetCapacity(handle(), groups_[i], 3); });
            createInstance(i);
        }
        call("suppleSetRate", [&] { return suppleSetRate(handle(), groups_[1], 1); });
        SuppleAssetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.name = "a tube whose name is too long to lie in a string itself";
        desc.bytes = tubeFile().data();
        desc.byteCount = tubeFile().size();
        call("suppleReloadAsset", [&] { return suppleReloadAsset(handle(), tube_, &desc); });
    }

    void destroy() {
        call("suppleBeginFrame", [&] { return suppleBeginFrame(handle(), frame_ + 1, frame_); });
        ++frame_;
        for (size_t i = 0; i < kGroups; ++i) {
            call("suppleDestroyInstance", [&] { return suppleDestroyInstance(handle(), instances_[i][0]); });
            call("suppleDestroyGroup", [&] { return suppleDestroyGroup(handle(), groups_[i]); });
        }
        call("suppleDestroyView", [&] { return suppleDestroyView(handle(), view_); });
        call("suppleDestroyAsset", [&] { return suppleDestroyAsset(handle(), tube_); });
        call("suppleDestroyAsset", [&] { return suppleDestroyAsset(handle(), quad_); });
        call("suppleBeginFrame", [&] { return suppleBeginFrame(handle(), frame_ + 1, frame_); });
    }

    [[nodiscard]] SuppleContext handle() const { return context_.handle(); }

    static constexpr size_t kGroups = 7, kPlayed = 3, kSeen = 6;
    Calls calls_;
    bool faulty_;
    LoggedContext context_;
    host::Device& device_;
    Files files_;
    uint64_t frame_ = 0;
    SuppleAsset tube_{}, quad_{};
    SuppleView view_{};
    std::array<SuppleGroup, kGroups> groups_{};
    std::array<std::vector<SuppleInstance>, kGroups> instances_;
};

TEST(HostMemory, EveryAllocationOfEveryFunctionMayFail) {
    const std::unique_ptr<host::Device> device = deviceThrough(&pausingGetInstanceProcAddr, false);
    ASSERT_NE(device, nullptr);
    const std::vector<std::byte> sound = World(*device, Failure::one, false).run();
    ASSERT_FALSE(sound.empty());
    for (const Failure kind : {Failure::all, Failure::one}) {
        resetHostMemory();
        uint64_t positions = 0;
        {
            World world(*device, kind, true);
            EXPECT_TRUE(world.run() == sound);
            positions = world.positions();
        }
        EXPECT_GT(positions, 1000u);
        // The driver keeps some of its own; a byte for each failure would be seen.
        const int64_t left = hostMemory().live;
        EXPECT_LT(left, static_cast<int64_t>(positions)) << "something leaked";
        std::printf("  %s: %llu allocations failed, %lld bytes left\n",
                    kind == Failure::one ? "one" : "that and all after it", static_cast<unsigned long long>(positions),
                    static_cast<long long>(left));
    }
}

TEST(HostMemory, DestroyingTakesNone) {
    const std::unique_ptr<host::Device> device = deviceThrough(&pausingGetInstanceProcAddr, false);
    ASSERT_NE(device, nullptr);
    LoggedContext context(*device, quiet);
    SuppleAsset asset{};
    ASSERT_EQ(createTube(context.handle(), asset), SUPPLE_OK);
    SuppleViewDesc viewDesc{};
    viewDesc.structSize = sizeof(viewDesc);
    viewDesc.maxVertices = 4096;
    SuppleView view{};
    ASSERT_EQ(suppleCreateView(context.handle(), &viewDesc, &view), SUPPLE_OK);
    std::vector<SmallGroup> made;
    std::vector<SuppleGroup> groups;
    for (int i = 0; i < 5; ++i) { // so that lists of any first size are full
        made.push_back(createGroup(context.handle(), asset, {.scheme = SUPPLE_SCHEME_CAGE}));
        groups.push_back(made.back().group);
    }
    context.evaluate(groups);
    const uint64_t before = memoryOf(context.handle());
    failHostMemory(0, Failure::all);
    std::array<SuppleResult, 12> results{};
    for (size_t i = 0; i < made.size(); ++i) {
        results[2 * i] = suppleDestroyInstance(context.handle(), made[i].instances[0]);
        results[2 * i + 1] = suppleDestroyGroup(context.handle(), made[i].group);
    }
    results[10] = suppleDestroyView(context.handle(), view);
    results[11] = suppleDestroyAsset(context.handle(), asset);
    EXPECT_FALSE(liftHostFailure()) << "an allocation was asked for";
    for (const SuppleResult result : results) {
        EXPECT_EQ(result, SUPPLE_OK);
    }
    // The frame that has recorded the groups may still draw them.
    EXPECT_GT(memoryOf(context.handle()), before / 2);
    const uint64_t inFlight = memoryOf(context.handle());
    context.beginFrame();
    EXPECT_LT(memoryOf(context.handle()), inFlight) << "the frame is complete";
}

TEST(HostMemory, AContextThatCannotBeMadeIsNotThere) {
    const std::unique_ptr<host::Device> device = deviceThrough(&pausingGetInstanceProcAddr, false);
    ASSERT_NE(device, nullptr);
    SuppleContextDesc desc = host::contextDesc(*device);
    quiet(desc);
    for (const Failure kind : {Failure::all, Failure::one}) {
        Calls calls(kind);
        calls.stride = 3;
        SuppleContext context = nullptr;
        calls("suppleCreateContext", [&] {
            const SuppleResult result = suppleCreateContext(&desc, &context);
            EXPECT_EQ(context != nullptr, result == SUPPLE_OK);
            return result;
        });
        suppleDestroyContext(context);
        std::printf("  suppleCreateContext: %llu allocations failed\n",
                    static_cast<unsigned long long>(calls.positions));
    }
}

} // namespace
} // namespace supple::test
