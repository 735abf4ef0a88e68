// Every function of the public headers with every kind of wrong argument: the result, the one line that says why, and
// that nothing else has happened: what the call was to fill is as it was, and the next frame has the bits it had.
#include "runtime/sized.h"
#include "tests/support/gpu_surface.h"
#include "tests/support/logged_context.h"
#include "tests/support/not_finite.h"
#if defined(SUPPLE_WITH_CPU)
#include "supple/supple_cpu.h"
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <deque>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <regex>
#include <set>

namespace supple::test {
namespace {

constexpr float kIdentity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
constexpr int kSilent = 0; ///< in place of a SuppleMessage
constexpr uint32_t kClips = 1, kJoints = 3, kTargets = 4, kMaterials = 1, kImages = 1;

/// Where in the course of frames a call is made.
enum class Phase { fresh, begun, recorded, cancelled };

class World {
public:
    explicit World(host::Device& device)
        : device(device), own(device,
                              [&](SuppleContextDesc& desc) {
                                  describe(desc);
                                  desc.flags |= SUPPLE_CONTEXT_ASYNC_COMPUTE;
                                  desc.drawQueueFamily = desc.queueFamily;
                              }),
          foreign(device, [&](SuppleContextDesc& desc) {
              describe(desc);
              desc.drawQueueFamily = 1000; // without the flag it means nothing
          }) {
        for (LoggedContext* context : {&own, &foreign}) {
            EXPECT_EQ(context->result(), SUPPLE_OK);
            Things& t = context == &own ? mine : theirs;
            EXPECT_EQ(createTube(context->handle(), t.asset), SUPPLE_OK);
            t.main = createGroup(context->handle(), t.asset,
                                 {.flags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_PATCHES, .capacity = 2});
            t.subdivision = createGroup(context->handle(), t.asset, {.scheme = SUPPLE_SCHEME_FRAGMENTS});
            EXPECT_EQ(suppleSetClipPose(context->handle(), t.main.instances[0], 0, 0.7), SUPPLE_OK);
            EXPECT_EQ(suppleSetClipPose(context->handle(), t.subdivision.instances[0], 0, 0.3), SUPPLE_OK);
        }
        // What is set where a call is valid; never recorded.
        spare = createGroup(handle(), mine.asset, {.scheme = SUPPLE_SCHEME_CAGE});
        buffered =
            createGroup(handle(), mine.asset, {.scheme = SUPPLE_SCHEME_CAGE, .poseSource = SUPPLE_POSES_CAGE_BUFFER});
        played = createGroup(handle(), mine.asset, {.scheme = SUPPLE_SCHEME_CAGE, .poseSource = SUPPLE_POSES_PLAYBACK});
        modified = createGroup(handle(), mine.asset,
                               {.flags = SUPPLE_GROUP_MODIFIERS | SUPPLE_GROUP_TRANSITIONS | SUPPLE_GROUP_UPDATE_RATES,
                                .scheme = SUPPLE_SCHEME_CAGE,
                                .poseSource = SUPPLE_POSES_PLAYBACK});
        bounded = createGroup(handle(), mine.asset, {.flags = SUPPLE_GROUP_BOUNDS, .scheme = SUPPLE_SCHEME_CAGE});
        const SuppleViewDesc viewAsked = viewDesc();
        for (SuppleView* made : {&view, &blindView, &staleView}) {
            EXPECT_EQ(suppleCreateView(handle(), &viewAsked, made), SUPPLE_OK);
        }
        SuppleViewDesc cullingAsked = viewDesc();
        cullingAsked.flags = SUPPLE_VIEW_CULL | SUPPLE_VIEW_OCCLUSION | SUPPLE_VIEW_BACK_FACES;
        EXPECT_EQ(suppleCreateView(handle(), &cullingAsked, &cullingView), SUPPLE_OK);
        EXPECT_EQ(suppleCreateView(foreign.handle(), &viewAsked, &foreignView), SUPPLE_OK);
        EXPECT_EQ(suppleDestroyView(handle(), staleView), SUPPLE_OK);
        seen = createGroup(handle(), mine.asset, {.scheme = SUPPLE_SCHEME_PM, .view = blindView});
        // And what is gone.
        EXPECT_EQ(createTube(handle(), staleAsset), SUPPLE_OK);
        SmallGroup gone = createGroup(handle(), mine.asset, {.scheme = SUPPLE_SCHEME_CAGE});
        EXPECT_EQ(gone.result, SUPPLE_OK);
        staleGroup = gone.group;
        instanceOfStaleGroup = gone.instances[0];
        EXPECT_EQ(suppleDestroyAsset(handle(), staleAsset), SUPPLE_OK);
        EXPECT_EQ(suppleDestroyGroup(handle(), staleGroup), SUPPLE_OK);
        staleInstance = spare.instances[0];
        EXPECT_EQ(suppleDestroyInstance(handle(), staleInstance), SUPPLE_OK);
        EXPECT_EQ(suppleCreateInstance(handle(), spare.group, &spare.instances[0]), SUPPLE_OK);
        lines.clear();
    }
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    [[nodiscard]] SuppleContext handle() const { return own.handle(); }
    [[nodiscard]] SuppleInstance instance() const { return mine.main.instances[0]; }
    void describe(SuppleContextDesc& desc) {
        desc.logUser = this;
        desc.log = [](SuppleSeverity severity, SuppleMessage message, const char* text, void* user) {
            static_cast<World*>(user)->lines.push_back({severity, message, text});
        };
    }

    /// Memory that a call which fails leaves as it is: structSize, then 0xA5. `tail` more bytes stand behind the
    /// struct.
    template <class T>
    T* watched(uint32_t structSize, size_t tail = 0) {
        std::vector<std::byte>& bytes = keep(sizeof(T) + tail);
        std::memcpy(bytes.data(), &structSize, sizeof(structSize));
        snapshots.push_back({&bytes, bytes, false});
        return reinterpret_cast<T*>(bytes.data());
    }
    /// As that, without structSize; `handle`: may be zero as well.
    template <class T>
    T* plain(size_t count = 1, bool handle = false) {
        std::vector<std::byte>& bytes = keep(sizeof(T) * count); // NOLINT(bugprone-sizeof-expression): or a handle
        snapshots.push_back({&bytes, bytes, handle});
        return reinterpret_cast<T*>(bytes.data());
    }
    template <class T>
    T* newHandle() {
        return plain<T>(1, true);
    }
    uint32_t* number(uint32_t value) {
        auto* const n = plain<uint32_t>();
        *n = value;
        snapshots.back().before.assign(snapshots.back().now->begin(), snapshots.back().now->end());
        return n;
    }
    /// A description as a later version of the header would have it: `fill` in what this library does not know.
    template <class T>
    const T* grown(const T& desc, int fill) {
        std::vector<std::byte>& bytes = keep(sizeof(T) + 24);
        T copy = desc;
        copy.structSize = sizeof(T) + 24;
        std::memcpy(bytes.data(), &copy, sizeof(copy));
        std::memset(bytes.data() + sizeof(T), 0, 24);
        bytes.back() = static_cast<std::byte>(fill);
        return reinterpret_cast<const T*>(bytes.data());
    }
    template <class T>
    const T* kept(const T& value) {
        std::vector<std::byte>& bytes = keep(sizeof(T));
        std::memcpy(bytes.data(), &value, sizeof(value));
        return reinterpret_cast<const T*>(bytes.data());
    }
    void forget() {
        snapshots.clear();
        memory.clear();
        lines.clear();
    }

    [[nodiscard]] SuppleContextDesc contextDesc() {
        SuppleContextDesc desc = host::contextDesc(device);
        describe(desc);
        return desc;
    }
    [[nodiscard]] static SuppleAssetDesc assetDesc() { return tubeDesc(); }
    [[nodiscard]] SuppleGroupDesc groupDesc() const {
        SuppleGroupDesc desc{};
        desc.structSize = sizeof(desc);
        desc.asset = mine.asset;
        desc.capacity = 1;
        desc.rate = 2;
        desc.scheme = SUPPLE_SCHEME_CAGE;
        return desc;
    }
    /// Kept for the call.
    [[nodiscard]] SupplePoseDesc poseDesc(const std::function<void(SuppleClipLayer&)>& spoil = {}) {
        SuppleClipLayer layers[2]{};
        layers[0].weight = layers[1].weight = 1.0f;
        layers[1].time = 0.4;
        if (spoil) {
            spoil(layers[1]);
        }
        SupplePoseDesc desc{};
        desc.structSize = sizeof(desc);
        desc.layers = kept(layers)[0];
        desc.layerCount = 2;
        return desc;
    }
    /// Kept for the call.
    [[nodiscard]] SuppleModifiersDesc modifiersDesc(const std::function<void(SuppleModifier&)>& spoil = {}) {
        SuppleModifier modifiers[2]{};
        modifiers[0].rotation[3] = modifiers[1].rotation[3] = 1.0f;
        modifiers[0].weight = modifiers[1].weight = 1.0f;
        modifiers[1].joint = 1;
        if (spoil) {
            spoil(modifiers[1]);
        }
        SuppleModifiersDesc desc{};
        desc.structSize = sizeof(desc);
        desc.modifiers = kept(modifiers)[0];
        desc.modifierCount = 2;
        return desc;
    }
    [[nodiscard]] static SuppleJointMatricesDesc matricesDesc() {
        static const float matrices[32] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                                           1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1};
        static const uint32_t joints[2] = {1, 0};
        SuppleJointMatricesDesc desc{};
        desc.structSize = sizeof(desc);
        desc.jointCount = 2;
        desc.jointMatrices = matrices;
        desc.joints = joints;
        return desc;
    }
    [[nodiscard]] static SuppleModifierTarget modifierTarget() {
        SuppleModifierTarget target{};
        target.structSize = sizeof(target);
        target.weight = 0.5f;
        target.rotation[0] = 2.0f;
        return target;
    }
    [[nodiscard]] SupplePlaybackDesc playbackDesc(const std::function<void(SupplePlaybackLayer&)>& spoil = {}) {
        SupplePlaybackLayer layers[2]{};
        layers[0].weight = layers[1].weight = 1.0f;
        layers[1].offset = 0.4;
        if (spoil) {
            spoil(layers[1]);
        }
        SupplePlaybackDesc desc{};
        desc.structSize = sizeof(desc);
        desc.layers = kept(layers)[0];
        desc.layerCount = 2;
        return desc;
    }
    [[nodiscard]] SuppleMaskDesc maskDesc() {
        static const float values[] = {0.5f, 0.5f, 0.5f, 0.5f};
        SuppleMaskDesc desc{};
        desc.structSize = sizeof(desc);
        desc.mask = 2;
        desc.jointMask = desc.morphMask = values;
        desc.jointMaskCount = kJoints;
        desc.morphMaskCount = kTargets;
        return desc;
    }
    [[nodiscard]] static SuppleViewDesc viewDesc() {
        SuppleViewDesc desc{};
        desc.structSize = sizeof(desc);
        desc.maxVertices = 4096;
        return desc;
    }
    [[nodiscard]] static SuppleCameraDesc cameraDesc() {
        SuppleCameraDesc desc{};
        desc.structSize = sizeof(desc);
        desc.pixelsPerUnit = 800.0f;
        return desc;
    }
    /// Of a view that no frame records: the image view is only kept.
    [[nodiscard]] static SuppleDepthPyramidDesc pyramidDesc() {
        SuppleDepthPyramidDesc desc{};
        desc.structSize = sizeof(desc);
        desc.imageView = std::bit_cast<VkImageView>(uintptr_t{8});
        desc.layout = VK_IMAGE_LAYOUT_GENERAL;
        desc.width = 640;
        desc.height = 360;
        desc.mipLevels = 10;
        desc.viewProjection[0] = 1.0f;
        return desc;
    }
    [[nodiscard]] SuppleRecordDesc recordDesc() {
        SuppleRecordDesc desc{};
        desc.structSize = sizeof(desc);
        desc.groups = frameGroups();
        desc.groupCount = 2;
        desc.before = kAnyUse;
        desc.after = kAnyUse;
        return desc;
    }
    const SuppleGroup* frameGroups() {
        groups_[0] = mine.main.group;
        groups_[1] = mine.subdivision.group;
        return groups_;
    }

    host::Device& device;
    std::vector<LogLine> lines;
    LoggedContext own, foreign;
    struct Things {
        SuppleAsset asset{};
        SmallGroup main, subdivision;
    } mine, theirs;
    SmallGroup spare, buffered, played, modified, seen, bounded;
    SuppleView view{}, cullingView{}, blindView{}, staleView{}, foreignView{}; ///< the blind one gets no camera
    SuppleAsset staleAsset{};
    SuppleGroup staleGroup{};
    SuppleInstance staleInstance{}, instanceOfStaleGroup{};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    bool recorded = false; ///< by the call

    struct Snapshot {
        std::vector<std::byte>* now;
        std::vector<std::byte> before;
        bool handle;
    };
    std::vector<Snapshot> snapshots;

private:
    std::vector<std::byte>& keep(size_t size) { return memory.emplace_back(size, std::byte{0xA5}); }

    std::deque<std::vector<std::byte>> memory;
    SuppleGroup groups_[2]{};
};

struct Row {
    std::string function, what;
    SuppleResult result;
    int message;
    std::function<SuppleResult(World&)> call;
    Phase phase = Phase::begun;
};

class Rows {
public:
    std::vector<Row> rows;

    void add(const char* function, const std::string& what, SuppleResult result, int message,
             std::function<SuppleResult(World&)> call, Phase phase = Phase::begun) {
        rows.push_back({function, what, result, message, std::move(call), phase});
    }
    void refuse(const char* function, const std::string& what, int message, std::function<SuppleResult(World&)> call,
                Phase phase = Phase::begun) {
        add(function, what, SUPPLE_ERROR_ARGUMENT, message, std::move(call), phase);
    }
    void accept(const char* function, const std::string& what, std::function<SuppleResult(World&)> call,
                Phase phase = Phase::begun) {
        add(function, what, SUPPLE_OK, kSilent, std::move(call), phase);
    }

    /// A description that is read: null, too small, larger with and without what is unknown.
    template <class T, class Make, class Call>
    void description(const char* function, const std::string& name, Make make, Call call, bool nullIsRefused = true) {
        using Pointer = const T*;
        if (nullIsRefused) {
            refuse(function, name + " null", SUPPLE_MESSAGE_NULL_POINTER,
                   [=](World& w) { return call(w, Pointer{nullptr}); });
        }
        for (const size_t size : {size_t{0}, size_t{4}, runtime::kFirstSize<T> - 1}) {
            refuse(function, name + "->structSize " + std::to_string(size), SUPPLE_MESSAGE_STRUCT_SIZE, [=](World& w) {
                T desc = make(w);
                desc.structSize = static_cast<uint32_t>(size);
                return call(w, Pointer{w.kept(desc)});
            });
        }
        refuse(function, name + " of a later version, with something in it", SUPPLE_MESSAGE_STRUCT_SIZE,
               [=](World& w) { return call(w, w.grown(make(w), 1)); });
        accept(function, name + " of a later version", [=](World& w) { return call(w, w.grown(make(w), 0)); });
    }
    /// A struct that is written.
    template <class T, class Call>
    void output(const char* function, Call call, SuppleResult good = SUPPLE_OK, bool logs = true) {
        const int null = logs ? int{SUPPLE_MESSAGE_NULL_POINTER} : kSilent;
        const int size = logs ? int{SUPPLE_MESSAGE_STRUCT_SIZE} : kSilent;
        refuse(function, "out null", null, [=](World& w) { return call(w, static_cast<T*>(nullptr)); });
        for (const size_t small : {size_t{0}, size_t{4}, runtime::kFirstSize<T> - 1}) {
            refuse(function, "out->structSize " + std::to_string(small), size, [=](World& w) {
                T* const out = w.template watched<T>(static_cast<uint32_t>(small));
                if (!logs) {
                    w.snapshots.clear(); // what has no log writes its reason
                }
                return call(w, out);
            });
        }
        add(function, "out", good, kSilent, [=](World& w) { return call(w, w.template watched<T>(sizeof(T))); });
        add(function, "out of a later version", good, kSilent, [=](World& w) {
            T* const out = w.template watched<T>(sizeof(T) + 16, 24);
            const SuppleResult result = call(w, out);
            const auto* bytes = reinterpret_cast<const unsigned char*>(out);
            EXPECT_EQ(out->structSize, sizeof(T) + 16);
            for (size_t i = 0; i < 24; ++i) {
                EXPECT_EQ(bytes[sizeof(T) + i], i < 16 ? 0u : 0xA5u) << i;
            }
            return result;
        });
    }
    template <class Call>
    void nullContext(const char* function, Call call) {
        refuse(function, "null context", kSilent, [=](World& w) { return call(w, SuppleContext{nullptr}); });
    }
    template <class Call>
    void assets(const char* function, Call call) {
        nullContext(function, [=](World& w, SuppleContext c) { return call(w, c, w.mine.asset); });
        const auto stale = [&](const char* what, auto get) {
            refuse(function, what, SUPPLE_MESSAGE_STALE_HANDLE, [=](World& w) { return call(w, w.handle(), get(w)); });
        };
        stale("zero asset", [](World&) { return SuppleAsset{0}; });
        stale("stale asset", [](World& w) { return w.staleAsset; });
        stale("foreign asset", [](World& w) { return w.theirs.asset; });
        stale("group for asset", [](World& w) { return SuppleAsset{w.mine.main.group.id}; });
        stale("no asset at all", [](World&) { return SuppleAsset{~0ull}; });
    }
    template <class Call>
    void groups(const char* function, Call call, bool context = true, Phase phase = Phase::begun) {
        if (context) {
            nullContext(function, [=](World& w, SuppleContext c) { return call(w, c, w.mine.main.group); });
        }
        const auto stale = [&](const char* what, auto get) {
            refuse(
                function, what, SUPPLE_MESSAGE_STALE_HANDLE, [=](World& w) { return call(w, w.handle(), get(w)); },
                phase);
        };
        stale("zero group", [](World&) { return SuppleGroup{0}; });
        stale("stale group", [](World& w) { return w.staleGroup; });
        stale("foreign group", [](World& w) { return w.theirs.main.group; });
        stale("asset for group", [](World& w) { return SuppleGroup{w.mine.asset.id}; });
        stale("no group at all", [](World&) { return SuppleGroup{~0ull}; });
    }
    template <class Call>
    void instancesRefused(const char* function, Call call) {
        nullContext(function, [=](World& w, SuppleContext c) { return call(w, c, w.instance()); });
        const auto stale = [&](const char* what, auto get) {
            refuse(function, what, SUPPLE_MESSAGE_STALE_HANDLE, [=](World& w) { return call(w, w.handle(), get(w)); });
        };
        stale("zero instance", [](World&) { return SuppleInstance{}; });
        stale("stale instance", [](World& w) { return w.staleInstance; });
        stale("instance of a stale group", [](World& w) { return w.instanceOfStaleGroup; });
        stale("foreign instance", [](World& w) { return w.theirs.main.instances[0]; });
        stale("foreign instance in a group of one's own", [](World& w) {
            return SuppleInstance{w.mine.main.group, 0, w.theirs.main.instances[0].generation ^ 0x5A5A5A5Au};
        });
        stale("another group's instance", [](World& w) {
            return SuppleInstance{w.mine.main.group, 0, w.spare.instances[0].generation};
        });
        stale("slot beyond the capacity", [](World& w) {
            return SuppleInstance{w.mine.main.group, 2, w.instance().generation};
        });
        stale("no slot at all", [](World& w) {
            return SuppleInstance{w.mine.main.group, ~0u, w.instance().generation};
        });
        stale("generation 0", [](World& w) { return SuppleInstance{w.mine.main.group, 0, 0}; });
    }
    /// `valid`: whose instance takes the call.
    template <class Call>
    void instances(const char* function, Call call, bool poses, SmallGroup World::*valid = &World::spare) {
        instancesRefused(function, call);
        accept(function, "valid", [=](World& w) { return call(w, w.handle(), (w.*valid).instances[0]); });
        if (poses) {
            refuse(function, "the host's buffer poses the group", SUPPLE_MESSAGE_CONFLICT,
                   [=](World& w) { return call(w, w.handle(), w.buffered.instances[0]); });
        }
    }
};

void withoutContext(Rows& r) {
    r.accept("suppleGetVersion", "", [](World&) {
        EXPECT_EQ(suppleGetVersion(), uint32_t{SUPPLE_VERSION});
        return SUPPLE_OK;
    });
    r.accept("suppleResultString", "", [](World&) {
        EXPECT_STREQ(suppleResultString(SUPPLE_ERROR_DEVICE_LOST), "SUPPLE_ERROR_DEVICE_LOST");
        EXPECT_STREQ(suppleResultString(static_cast<SuppleResult>(77)), "unknown SuppleResult");
        return SUPPLE_OK;
    });
    r.accept("suppleGetRecordScopes", "null", [](World&) { return suppleGetRecordScopes(nullptr, nullptr); });
    r.accept("suppleGetRecordScopes", "valid", [](World&) {
        SuppleSyncScope first{}, last{};
        const SuppleResult result = suppleGetRecordScopes(&first, &last);
        EXPECT_NE(first.stages, 0u);
        EXPECT_NE(last.access, 0u);
        return result;
    });

    constexpr const char* kQuery = "suppleQueryRequirements";
    const auto query = [](World& w, SuppleRequirements* out) {
        return suppleQueryRequirements(w.device.instance(), w.device.physicalDevice(), vkGetInstanceProcAddr, out);
    };
    r.output<SuppleRequirements>(kQuery, query, SUPPLE_OK, false);
    const auto null = [&](const char* what, auto call) {
        r.refuse(kQuery, what, kSilent, [=](World& w) {
            SuppleRequirements out{};
            out.structSize = sizeof(out);
            const SuppleResult result = call(w, &out);
            EXPECT_STREQ(out.reason, "instance, physicalDevice or getInstanceProcAddr is null");
            return result;
        });
    };
    null("null instance", [](World& w, SuppleRequirements* out) {
        return suppleQueryRequirements(VK_NULL_HANDLE, w.device.physicalDevice(), vkGetInstanceProcAddr, out);
    });
    null("null physical device", [](World& w, SuppleRequirements* out) {
        return suppleQueryRequirements(w.device.instance(), VK_NULL_HANDLE, vkGetInstanceProcAddr, out);
    });
    null("null getInstanceProcAddr", [](World& w, SuppleRequirements* out) {
        return suppleQueryRequirements(w.device.instance(), w.device.physicalDevice(), nullptr, out);
    });
}

void preparing(Rows& r) {
    constexpr const char* kPrepare = "supplePrepare";
    r.accept("suppleDestroyPrepared", "null", [](World&) {
        suppleDestroyPrepared(nullptr);
        return SUPPLE_OK;
    });
    static const SuppleAssetDesc kAsset = World::assetDesc();
    static const SuppleGroupDesc kPlan = [] {
        SuppleGroupDesc desc{};
        desc.structSize = sizeof(desc);
        desc.rate = 2;
        return desc;
    }();
    static const SupplePlannedGroup kPlanned{&kPlan, 0, 0};
    const auto good = [](World&) {
        SupplePrepareDesc desc{};
        desc.structSize = sizeof(desc);
        desc.asset = &kAsset;
        desc.groups = &kPlanned;
        desc.groupCount = 1;
        return desc;
    };
    const auto prepare = [](World& w, const SupplePrepareDesc* desc) {
        SupplePrepared* const out = w.newHandle<SupplePrepared>();
        const SuppleResult result = supplePrepare(desc, out);
        EXPECT_EQ(*out != nullptr, result == SUPPLE_OK);
        suppleDestroyPrepared(*out);
        return result;
    };
    r.accept(kPrepare, "valid", [=](World& w) {
        const SupplePrepareDesc desc = good(w);
        return prepare(w, &desc);
    });
    r.refuse(kPrepare, "desc null", kSilent, [=](World& w) { return prepare(w, nullptr); });
    r.refuse(kPrepare, "out null", kSilent, [=](World& w) {
        const SupplePrepareDesc desc = good(w);
        return supplePrepare(&desc, nullptr);
    });
    r.refuse(kPrepare, "desc of a later version, with something in it", kSilent,
             [=](World& w) { return prepare(w, w.grown(good(w), 1)); });
    constexpr const char* kSave = "suppleSavePrepared";
    const auto save = [=](World& w, bool prepared, size_t room, bool counted) {
        const SupplePrepareDesc desc = good(w);
        SupplePrepared made = nullptr;
        EXPECT_EQ(supplePrepare(&desc, &made), SUPPLE_OK);
        size_t size = room;
        const SuppleResult result =
            suppleSavePrepared(prepared ? made : nullptr, "supple cook", room > 0 ? w.plain<uint8_t>(room) : nullptr,
                               counted ? &size : nullptr);
        suppleDestroyPrepared(made);
        return result;
    };
    r.accept(kSave, "the size alone", [=](World& w) { return save(w, true, 0, true); });
    r.accept(kSave, "valid", [=](World& w) { return save(w, true, size_t{1} << 20, true); });
    r.refuse(kSave, "too little room", kSilent, [=](World& w) { return save(w, true, 64, true); });
    r.refuse(kSave, "prepared null", kSilent, [=](World& w) { return save(w, false, 64, true); });
    r.refuse(kSave, "byteCount null", kSilent, [=](World& w) { return save(w, true, 64, false); });
    for (const size_t size : {size_t{0}, size_t{4}, sizeof(SupplePrepareDesc) - 1}) {
        r.refuse(kPrepare, "desc->structSize " + std::to_string(size), kSilent, [=](World& w) {
            SupplePrepareDesc desc = good(w);
            desc.structSize = static_cast<uint32_t>(size);
            return prepare(w, &desc);
        });
    }
}

#if defined(SUPPLE_WITH_CPU)
/// The tube's surface on the CPU, built in its rest pose.
struct CpuSurfaces {
    explicit CpuSurfaces(World& w, bool built = true) {
        const SuppleAssetDesc asset = World::assetDesc();
        SupplePrepareDesc prepare{};
        prepare.structSize = sizeof(prepare);
        prepare.asset = &asset;
        EXPECT_EQ(supplePrepare(&prepare, &prepared), SUPPLE_OK);
        const SuppleGroupDesc planned = groupDesc();
        const SuppleCpuGroupDesc desc = groupOf(w, &planned);
        EXPECT_EQ(suppleCpuCreateGroup(&desc, &group), SUPPLE_OK);
        EXPECT_EQ(suppleCpuCreatePose(group, &pose), SUPPLE_OK);
        SuppleCpuGroupInfo info{};
        info.structSize = sizeof(info);
        EXPECT_EQ(suppleCpuGetGroupInfo(group, &info), SUPPLE_OK);
        for (uint32_t v = 0; v < info.cageVertexCount; ++v) {
            cage.push_back({static_cast<float>(v % 7), static_cast<float>(v % 5), static_cast<float>(v % 3)});
        }
        if (built) {
            EXPECT_EQ(build(cage.size()), SUPPLE_OK);
        }
        grid.structSize = sizeof(grid);
        EXPECT_EQ(suppleCpuGetGridInfo(group, 0, 2, &grid), SUPPLE_OK);
    }
    ~CpuSurfaces() {
        suppleCpuDestroyPose(pose);
        suppleCpuDestroyGroup(group);
        suppleDestroyPrepared(prepared);
    }
    CpuSurfaces(const CpuSurfaces&) = delete;
    CpuSurfaces& operator=(const CpuSurfaces&) = delete;

    static SuppleGroupDesc groupDesc() {
        SuppleGroupDesc desc{};
        desc.structSize = sizeof(desc);
        desc.scheme = SUPPLE_SCHEME_PM;
        return desc;
    }
    [[nodiscard]] SuppleCpuGroupDesc groupOf(World& w, const SuppleGroupDesc* planned) const {
        SuppleCpuGroupDesc desc{};
        desc.structSize = sizeof(desc);
        desc.prepared = prepared;
        desc.group = planned;
        desc.logUser = &w;
        desc.log = [](SuppleSeverity severity, SuppleMessage message, const char* text, void* user) {
            static_cast<World*>(user)->lines.push_back({severity, message, text});
        };
        return desc;
    }
    [[nodiscard]] SuppleResult build(size_t count) const {
        return suppleCpuBuildPose(pose, &cage[0][0], sizeof(cage[0]), static_cast<uint32_t>(count), nullptr);
    }

    SupplePrepared prepared = nullptr;
    SuppleCpuGroup group = nullptr;
    SuppleCpuPose pose = nullptr;
    SuppleCpuGridInfo grid{};
    std::vector<std::array<float, 3>> cage;
};

void cpuGroups(Rows& r) {
    constexpr const char* kCreate = "suppleCpuCreateGroup";
    const auto create = [](World& w, const std::function<void(SuppleCpuGroupDesc&)>& spoil) {
        const CpuSurfaces own(w);
        const SuppleGroupDesc planned = CpuSurfaces::groupDesc();
        SuppleCpuGroupDesc desc = own.groupOf(w, &planned);
        spoil(desc);
        auto* const out = w.newHandle<SuppleCpuGroup>();
        const SuppleResult result = suppleCpuCreateGroup(&desc, out);
        EXPECT_EQ(*out != nullptr, result == SUPPLE_OK);
        suppleCpuDestroyGroup(*out);
        return result;
    };
    r.accept(kCreate, "valid", [=](World& w) { return create(w, [](SuppleCpuGroupDesc&) {}); });
    r.refuse(kCreate, "desc null", kSilent,
             [](World& w) { return suppleCpuCreateGroup(nullptr, w.newHandle<SuppleCpuGroup>()); });
    r.refuse(kCreate, "prepared null", SUPPLE_MESSAGE_NULL_POINTER,
             [=](World& w) { return create(w, [](SuppleCpuGroupDesc& desc) { desc.prepared = nullptr; }); });
    r.refuse(kCreate, "group null", SUPPLE_MESSAGE_NULL_POINTER,
             [=](World& w) { return create(w, [](SuppleCpuGroupDesc& desc) { desc.group = nullptr; }); });
    r.refuse(kCreate, "reserved", SUPPLE_MESSAGE_OUT_OF_RANGE,
             [=](World& w) { return create(w, [](SuppleCpuGroupDesc& desc) { desc.reserved = 1; }); });
    r.accept("suppleCpuDestroyGroup", "null", [](World&) {
        suppleCpuDestroyGroup(nullptr);
        return SUPPLE_OK;
    });
    r.output<SuppleCpuGroupInfo>("suppleCpuGetGroupInfo", [](World& w, SuppleCpuGroupInfo* out) {
        return suppleCpuGetGroupInfo(CpuSurfaces(w).group, out);
    });
    r.refuse("suppleCpuGetGroupInfo", "group null", kSilent, [](World& w) {
        return suppleCpuGetGroupInfo(nullptr, w.watched<SuppleCpuGroupInfo>(sizeof(SuppleCpuGroupInfo)));
    });
    constexpr const char* kPatches = "suppleCpuGetPatches";
    r.refuse(kPatches, "no such surface", SUPPLE_MESSAGE_OUT_OF_RANGE, [](World& w) {
        return suppleCpuGetPatches(CpuSurfaces(w).group, 1, w.plain<SupplePatchInfo>(2), w.number(2));
    });
    r.refuse(kPatches, "count null", SUPPLE_MESSAGE_NULL_POINTER, [](World& w) {
        return suppleCpuGetPatches(CpuSurfaces(w).group, 0, w.plain<SupplePatchInfo>(2), nullptr);
    });
    r.accept(kPatches, "valid", [](World& w) {
        uint32_t count = 0;
        return suppleCpuGetPatches(CpuSurfaces(w).group, 0, nullptr, &count);
    });
    constexpr const char* kInfo = "suppleCpuGetGridInfo";
    r.output<SuppleCpuGridInfo>(
        kInfo, [](World& w, SuppleCpuGridInfo* out) { return suppleCpuGetGridInfo(CpuSurfaces(w).group, 0, 2, out); });
    r.refuse(kInfo, "rate 0", SUPPLE_MESSAGE_OUT_OF_RANGE, [](World& w) {
        return suppleCpuGetGridInfo(CpuSurfaces(w).group, 0, 0,
                                    w.watched<SuppleCpuGridInfo>(sizeof(SuppleCpuGridInfo)));
    });
    constexpr const char* kIndices = "suppleCpuGetGridIndices";
    r.refuse(kIndices, "another count", SUPPLE_MESSAGE_OUT_OF_RANGE,
             [](World& w) { return suppleCpuGetGridIndices(CpuSurfaces(w).group, 0, 2, w.plain<uint32_t>(3), 3); });
    r.refuse(kIndices, "out null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleCpuGetGridIndices(CpuSurfaces(w).group, 0, 2, nullptr, 3); });
    r.accept(kIndices, "valid", [](World& w) {
        const CpuSurfaces own(w);
        std::vector<uint32_t> indices(own.grid.indexCount);
        return suppleCpuGetGridIndices(own.group, 0, 2, indices.data(), own.grid.indexCount);
    });
}

void cpuPoses(Rows& r) {
    constexpr const char* kCreate = "suppleCpuCreatePose";
    r.refuse(kCreate, "group null", kSilent,
             [](World& w) { return suppleCpuCreatePose(nullptr, w.newHandle<SuppleCpuPose>()); });
    r.refuse(kCreate, "out null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleCpuCreatePose(CpuSurfaces(w).group, nullptr); });
    r.accept("suppleCpuDestroyPose", "null", [](World&) {
        suppleCpuDestroyPose(nullptr);
        return SUPPLE_OK;
    });
    constexpr const char* kBuild = "suppleCpuBuildPose";
    r.refuse(kBuild, "another number of vertices", SUPPLE_MESSAGE_OUT_OF_RANGE,
             [](World& w) { return CpuSurfaces(w).build(3); });
    r.refuse(kBuild, "cage null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleCpuBuildPose(CpuSurfaces(w).pose, nullptr, 12, 0, nullptr); });
    constexpr const char* kPoints = "suppleCpuEvaluatePoints";
    static const SuppleSurfacePoint kPoint{0, 0, 0.5f, 0.25f};
    r.refuse(kPoints, "points null", SUPPLE_MESSAGE_NULL_POINTER, [](World& w) {
        return suppleCpuEvaluatePoints(CpuSurfaces(w).pose, nullptr, 1, w.plain<SuppleSurfaceJet>(1), nullptr);
    });
    r.refuse(kPoints, "not built", SUPPLE_MESSAGE_OUT_OF_ORDER, [](World& w) {
        return suppleCpuEvaluatePoints(CpuSurfaces(w, false).pose, &kPoint, 1, w.plain<SuppleSurfaceJet>(1), nullptr);
    });
    r.accept(kPoints, "valid", [](World& w) {
        SuppleSurfaceJet jet{};
        return suppleCpuEvaluatePoints(CpuSurfaces(w).pose, &kPoint, 1, &jet, nullptr);
    });
    constexpr const char* kGrid = "suppleCpuEvaluateGrid";
    r.refuse(kGrid, "another number of vertices", SUPPLE_MESSAGE_OUT_OF_RANGE, [](World& w) {
        return suppleCpuEvaluateGrid(CpuSurfaces(w).pose, 0, 2, w.plain<float>(3), nullptr, 1, nullptr);
    });
    r.accept(kGrid, "valid", [](World& w) {
        const CpuSurfaces own(w);
        std::vector<float> positions(size_t{3} * own.grid.vertexCount);
        return suppleCpuEvaluateGrid(own.pose, 0, 2, positions.data(), nullptr, own.grid.vertexCount, nullptr);
    });
}
#endif

void contexts(Rows& r) {
    constexpr const char* kCreate = "suppleCreateContext";
    r.accept("suppleDestroyContext", "null context", [](World&) {
        suppleDestroyContext(nullptr);
        return SUPPLE_OK;
    });
    constexpr const char* kMapping = "suppleGetMapping";
    r.nullContext(kMapping, [](World& w, SuppleContext c) { return suppleGetMapping(c, w.plain<SuppleMapping>(1)); });
    r.refuse(kMapping, "out null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleGetMapping(w.handle(), nullptr); });
    r.accept(kMapping, "valid", [](World& w) {
        auto* const mapping = w.plain<SuppleMapping>(1);
        const SuppleResult result = suppleGetMapping(w.handle(), mapping);
        EXPECT_NE(*mapping, SUPPLE_MAPPING_AUTO);
        return result;
    });
    const auto create = [](World& w, const SuppleContextDesc* desc) {
        SuppleContext* const out = w.newHandle<SuppleContext>();
        const SuppleResult result = suppleCreateContext(desc, out);
        if (result == SUPPLE_OK) {
            suppleDestroyContext(*out);
        } else {
            EXPECT_EQ(*out, nullptr);
        }
        return result;
    };
    r.refuse(kCreate, "desc null", kSilent, [=](World& w) { return create(w, nullptr); });
    for (const size_t size : {size_t{0}, size_t{4}, runtime::kFirstSize<SuppleContextDesc> - 1}) {
        const int message = size == 0 ? int{SUPPLE_MESSAGE_STRUCT_SIZE} : kSilent;
        r.refuse(kCreate, "desc->structSize " + std::to_string(size), message, [=](World& w) {
            SuppleContextDesc desc = w.contextDesc();
            desc.structSize = static_cast<uint32_t>(size);
            return create(w, &desc);
        });
    }
    r.refuse(kCreate, "desc of a later version, with something in it", SUPPLE_MESSAGE_STRUCT_SIZE,
             [=](World& w) { return create(w, w.grown(w.contextDesc(), 1)); });
    r.accept(kCreate, "desc of a later version", [=](World& w) { return create(w, w.grown(w.contextDesc(), 0)); });
    r.refuse(kCreate, "out null", SUPPLE_MESSAGE_NULL_POINTER, [](World& w) {
        const SuppleContextDesc desc = w.contextDesc();
        return suppleCreateContext(&desc, nullptr);
    });
    const auto spoiled = [&](const char* what, SuppleResult result, int message, auto spoil) {
        r.add(kCreate, what, result, message, [=](World& w) {
            SuppleContextDesc desc = w.contextDesc();
            spoil(desc);
            return create(w, &desc);
        });
    };
    const auto null = [&](const char* what, auto spoil) {
        spoiled(what, SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_NULL_POINTER, spoil);
    };
    const auto range = [&](const char* what, auto spoil) {
        spoiled(what, SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_OUT_OF_RANGE, spoil);
    };
    using Desc = SuppleContextDesc;
    null("instance null", [](Desc& d) { d.instance = VK_NULL_HANDLE; });
    null("physicalDevice null", [](Desc& d) { d.physicalDevice = VK_NULL_HANDLE; });
    null("device null", [](Desc& d) { d.device = VK_NULL_HANDLE; });
    null("getInstanceProcAddr null", [](Desc& d) { d.getInstanceProcAddr = nullptr; });
    static const SuppleMemoryCallbacks kNoFree{[](const VkMemoryRequirements*, VkMemoryPropertyFlags,
                                                  VkMemoryPropertyFlags, const char*, SuppleMemory*,
                                                  void*) { return VK_ERROR_OUT_OF_DEVICE_MEMORY; },
                                               nullptr, nullptr};
    static const SuppleMemoryCallbacks kNoAllocate{nullptr, [](const SuppleMemory*, void*) {}, nullptr};
    null("memory->free null", [](Desc& d) { d.memory = &kNoFree; });
    null("memory->allocate null", [](Desc& d) { d.memory = &kNoAllocate; });
    range("framesInFlight 5", [](Desc& d) { d.framesInFlight = SUPPLE_MAX_FRAMES_IN_FLIGHT + 1; });
    range("mapping 3", [](Desc& d) { d.mapping = static_cast<SuppleMapping>(3); });
    range("mapping -1", [](Desc& d) { d.mapping = static_cast<SuppleMapping>(-1); });
    range("flags", [](Desc& d) { d.flags |= 64; });
    range("queueFamily", [](Desc& d) { d.queueFamily = 1000; });
    range("drawQueueFamily", [](Desc& d) {
        d.flags |= SUPPLE_CONTEXT_ASYNC_COMPUTE;
        d.drawQueueFamily = 1000;
    });
    static const VkPhysicalDeviceFeatures2 kNoFeatures{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, nullptr, {}};
    spoiled("no features enabled", SUPPLE_ERROR_UNSUPPORTED, SUPPLE_MESSAGE_FEATURE_DISABLED, [](Desc& d) {
        d.enabledFeatures = &kNoFeatures;
        d.mapping = SUPPLE_MAPPING_WIDE;
        d.flags |= SUPPLE_CONTEXT_SHARED_DISPATCHES;
    });
}

/// A character as arrays: one rigid quad with a clip that moves its node.
struct WalkedCharacter {
    SuppleNodeDesc node{sizeof(SuppleNodeDesc), SUPPLE_NO_NODE, "root"};
    SuppleCageDesc cage{};
    SupplePartDesc part{};
    SuppleChannelDesc channel{};
    SuppleClipDesc clip{};
    SuppleCharacterDesc desc{};

    WalkedCharacter() {
        static const float kPositions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, kTimes[] = {0, 1};
        static const uint32_t kCount = 4, kIndices[] = {0, 1, 2, 3};
        cage.structSize = sizeof(cage);
        cage.vertexCount = 4;
        cage.faceCount = 1;
        cage.positions = kPositions;
        cage.faceVertexCounts = &kCount;
        cage.faceVertexIndices = kIndices;
        part.structSize = sizeof(part);
        part.cage = &cage;
        channel.structSize = sizeof(channel);
        channel.keyCount = 2;
        channel.valueCount = 6;
        channel.times = kTimes;
        channel.values = kPositions;
        clip.structSize = sizeof(clip);
        clip.channelCount = 1;
        clip.channels = &channel;
        desc.structSize = sizeof(desc);
        desc.nodeCount = desc.partCount = desc.clipCount = 1;
        desc.nodes = &node;
        desc.parts = &part;
        desc.clips = &clip;
    }
    WalkedCharacter(const WalkedCharacter&) = delete;
    WalkedCharacter& operator=(const WalkedCharacter&) = delete;
};

template <class Create>
void createCharacter(Rows& r, const Create& create) {
    constexpr const char* kCreate = "suppleCreateAsset";
    const auto createOf = [create](World& w, const SuppleCharacterDesc* character) {
        SuppleAssetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.character = character;
        return create(w, &desc);
    };
    static const WalkedCharacter kSound;
    r.description<SuppleCharacterDesc>(
        kCreate, "character", [](World&) { return kSound.desc; }, createOf, false);
    const auto character = [&](const char* what, SuppleResult result, int message, auto spoil) {
        r.add(kCreate, std::string("character: ") + what, result, message, [=](World& w) {
            WalkedCharacter spoiled;
            spoil(spoiled);
            return createOf(w, &spoiled.desc);
        });
    };
    const auto null = [&](const char* what, auto spoil) {
        character(what, SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_NULL_POINTER, spoil);
    };
    const auto size = [&](const char* what, auto spoil) {
        character(what, SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_STRUCT_SIZE, spoil);
    };
    const auto malformed = [&](const char* what, auto spoil) {
        character(what, SUPPLE_ERROR_ASSET, SUPPLE_MESSAGE_ASSET_REFUSED, spoil);
    };
    using Character = WalkedCharacter;
    null("nodes null", [](Character& c) { c.desc.nodes = nullptr; });
    null("parts null", [](Character& c) { c.desc.parts = nullptr; });
    null("clips null", [](Character& c) { c.desc.clips = nullptr; });
    null("materials null", [](Character& c) { c.desc.materialCount = 1; });
    null("images null", [](Character& c) { c.desc.imageCount = 1; });
    null("positions null", [](Character& c) { c.cage.positions = nullptr; });
    null("targets null", [](Character& c) { c.part.targetCount = 1; });
    null("channels null", [](Character& c) { c.clip.channels = nullptr; });
    null("times null", [](Character& c) { c.channel.times = nullptr; });
    null("markers null", [](Character& c) { c.clip.markerCount = 1; });
    size("a node's size", [](Character& c) { c.node.structSize = 0; });
    size("a part's size", [](Character& c) { c.part.structSize = 4; });
    size("a cage's size", [](Character& c) { c.cage.structSize = 4; });
    size("a clip's size", [](Character& c) { c.clip.structSize = 1u << 20; });
    size("a channel's size", [](Character& c) { c.channel.structSize = 0; });
    malformed("no parts", [](Character& c) { c.desc.partCount = 0; });
    malformed("neither cage nor primitives", [](Character& c) { c.part.cage = nullptr; });
    malformed("no such parent", [](Character& c) { c.node.parent = 1; });
    malformed("its own parent", [](Character& c) { c.node.parent = 0; });
    malformed("no such node", [](Character& c) { c.part.node = 1; });
    malformed("no such channel node", [](Character& c) { c.channel.node = 1; });
    malformed("too few values", [](Character& c) { c.channel.valueCount = 5; });
    character("no such path", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_OUT_OF_RANGE,
              [](Character& c) { c.channel.path = static_cast<SuppleChannelPath>(9); });
}

void createAsset(Rows& r) {
    constexpr const char* kCreate = "suppleCreateAsset";
    const auto create = [](World& w, const SuppleAssetDesc* desc) {
        SuppleAsset* const out = w.newHandle<SuppleAsset>();
        const SuppleResult result = suppleCreateAsset(w.handle(), desc, out);
        if (result == SUPPLE_OK) {
            EXPECT_EQ(suppleDestroyAsset(w.handle(), *out), SUPPLE_OK);
        } else {
            EXPECT_EQ(out->id, 0u);
        }
        return result;
    };
    r.nullContext(kCreate, [](World& w, SuppleContext c) {
        const SuppleAssetDesc desc = World::assetDesc();
        return suppleCreateAsset(c, &desc, w.newHandle<SuppleAsset>());
    });
    r.refuse(kCreate, "out null", SUPPLE_MESSAGE_NULL_POINTER, [](World& w) {
        const SuppleAssetDesc desc = World::assetDesc();
        return suppleCreateAsset(w.handle(), &desc, nullptr);
    });
    r.description<SuppleAssetDesc>(
        kCreate, "desc", [](World&) { return World::assetDesc(); }, create);
    constexpr const char* kReload = "suppleReloadAsset";
    r.assets(kReload, [](World&, SuppleContext c, SuppleAsset a) {
        const SuppleAssetDesc desc = World::assetDesc();
        return suppleReloadAsset(c, a, &desc);
    });
    r.description<SuppleAssetDesc>(
        kReload, "desc", [](World&) { return World::assetDesc(); },
        [](World& w, const SuppleAssetDesc* desc) {
            SuppleAsset own{};
            EXPECT_EQ(createTube(w.handle(), own), SUPPLE_OK);
            const SuppleResult result = suppleReloadAsset(w.handle(), own, desc);
            EXPECT_EQ(suppleDestroyAsset(w.handle(), own), SUPPLE_OK);
            return result;
        });
    const auto spoiled = [&](const char* what, SuppleResult result, int message, auto spoil) {
        r.add(kCreate, what, result, message, [=](World& w) {
            SuppleAssetDesc desc = World::assetDesc();
            spoil(desc);
            return create(w, &desc);
        });
    };
    using Desc = SuppleAssetDesc;
    static const SuppleFiles kNoRead{};
    static const SuppleCageDesc kNoCage{};
    static const SuppleCharacterDesc kNoCharacter{};
    spoiled("neither bytes nor cage", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT,
            [](Desc& d) { d.bytes = nullptr; });
    spoiled("bytes and prepared", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT,
            [](Desc& d) { d.prepared = reinterpret_cast<SupplePrepared>(&d); });
    spoiled("bytes and cage", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT, [](Desc& d) { d.cage = &kNoCage; });
    spoiled("bytes and character", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT,
            [](Desc& d) { d.character = &kNoCharacter; });
    spoiled("cage and character", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT, [](Desc& d) {
        d.bytes = nullptr;
        d.cage = &kNoCage;
        d.character = &kNoCharacter;
    });
    spoiled("flags", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_OUT_OF_RANGE, [](Desc& d) { d.flags = 128; });
    spoiled("pairs and none", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT,
            [](Desc& d) { d.flags = SUPPLE_ASSET_PAIR_QUADS | SUPPLE_ASSET_KEEP_TRIANGLES; });
    spoiled("all creases and none", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT,
            [](Desc& d) { d.flags = SUPPLE_ASSET_CREASES_FROM_NORMALS | SUPPLE_ASSET_SMOOTH; });
    spoiled("files->read null", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_NULL_POINTER,
            [](Desc& d) { d.files = &kNoRead; });
    static const SuppleClipFile kNoBytes{};
    static const uint8_t kOne[] = {'{'};
    static const SuppleClipFile kBroken{"clips.glb", kOne, 1, nullptr, nullptr};
    static const SuppleClipFile kNoReader{"clips.glb", kOne, 1, nullptr, &kNoRead};
    const auto clipFile = [&](const char* what, SuppleResult result, int message, const SuppleClipFile* file) {
        spoiled(what, result, message, [file](Desc& d) {
            d.clipFiles = file;
            d.clipFileCount = 1;
        });
    };
    clipFile("clipFiles null", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_NULL_POINTER, nullptr);
    clipFile("clipFiles: bytes null", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_NULL_POINTER, &kNoBytes);
    clipFile("clipFiles: files->read null", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_NULL_POINTER, &kNoReader);
    clipFile("clipFiles: malformed", SUPPLE_ERROR_ASSET, SUPPLE_MESSAGE_ASSET_REFUSED, &kBroken);
    spoiled("clipFiles and cage", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT, [](Desc& d) {
        d.bytes = nullptr;
        d.cage = &kNoCage;
        d.clipFiles = &kBroken;
        d.clipFileCount = 1;
    });
    spoiled("retargeting", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_OUT_OF_RANGE,
            [](Desc& d) { d.retargeting = static_cast<SuppleRetargeting>(4); });
    static const SuppleJointPair kNoSuchRole{"tail", "a", "b"}, kNoFrom{nullptr, nullptr, "b"},
        kNoTo{nullptr, "a", nullptr}, kNeither{"hips", nullptr, nullptr};
    const auto pair = [&](const char* what, int message, const SuppleJointPair* pairs) {
        spoiled(what, SUPPLE_ERROR_ARGUMENT, message, [pairs](Desc& d) {
            d.jointPairs = pairs;
            d.jointPairCount = 1;
        });
    };
    pair("jointPairs null", SUPPLE_MESSAGE_NULL_POINTER, nullptr);
    pair("jointPairs: no such role", SUPPLE_MESSAGE_CONFLICT, &kNoSuchRole);
    pair("jointPairs: from null", SUPPLE_MESSAGE_NULL_POINTER, &kNoFrom);
    pair("jointPairs: to null", SUPPLE_MESSAGE_NULL_POINTER, &kNoTo);
    pair("jointPairs: neither", SUPPLE_MESSAGE_NULL_POINTER, &kNeither);
    spoiled("no bytes", SUPPLE_ERROR_ASSET, SUPPLE_MESSAGE_ASSET_REFUSED, [](Desc& d) { d.byteCount = 0; });
    spoiled("half the file", SUPPLE_ERROR_ASSET, SUPPLE_MESSAGE_ASSET_REFUSED, [](Desc& d) { d.byteCount /= 2; });

    // A cage as arrays: two quads that share an edge.
    static const float kPositions[] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
    static const float kNanPositions[] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, kNan, 0, 2, 1, 0};
    static const float kInfinitePositions[] = {0, 0, 0, 1, kInfinity, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
    static const uint32_t kCounts[] = {4, 4}, kIndices[] = {0, 1, 4, 3, 1, 2, 5, 4}, kFar[] = {0, 1, 4, 3, 1, 2, 6, 4};
    static const uint32_t kTwoSided[] = {2, 2}, kTiles[] = {0, SUPPLE_MAX_TRIM_TILES}, kHoles[] = {2};
    static const SuppleCreaseScalar kScalar{1, 4, kNan};
    const auto cageDesc = [](World&) {
        SuppleCageDesc desc{};
        desc.structSize = sizeof(desc);
        desc.vertexCount = 6;
        desc.faceCount = 2;
        desc.positions = kPositions;
        desc.faceVertexCounts = kCounts;
        desc.faceVertexIndices = kIndices;
        return desc;
    };
    const auto createCage = [create](World& w, const SuppleCageDesc* cage) {
        SuppleAssetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.cage = cage;
        return create(w, &desc);
    };
    r.description<SuppleCageDesc>(kCreate, "cage", cageDesc, createCage, false);
    const auto cage = [&](const char* what, SuppleResult result, int message, auto spoil) {
        r.add(kCreate, std::string("cage: ") + what, result, message, [=](World& w) {
            SuppleCageDesc desc = cageDesc(w);
            spoil(desc);
            return createCage(w, &desc);
        });
    };
    const auto null = [&](const char* what, auto spoil) {
        cage(what, SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_NULL_POINTER, spoil);
    };
    const auto malformed = [&](const char* what, auto spoil) {
        cage(what, SUPPLE_ERROR_ASSET, SUPPLE_MESSAGE_ASSET_REFUSED, spoil);
    };
    using Cage = SuppleCageDesc;
    null("positions null", [](Cage& d) { d.positions = nullptr; });
    null("faceVertexCounts null", [](Cage& d) { d.faceVertexCounts = nullptr; });
    null("faceVertexIndices null", [](Cage& d) { d.faceVertexIndices = nullptr; });
    null("creases null", [](Cage& d) { d.creaseCount = 1; });
    null("creaseSharpnesses null", [](Cage& d) {
        d.creaseCount = 1;
        d.creaseVertices = kIndices;
    });
    null("corners null", [](Cage& d) { d.cornerCount = 1; });
    null("creaseScalars null", [](Cage& d) { d.creaseScalarCount = 1; });
    null("creaseSetNames null", [](Cage& d) { d.creaseSetCount = 1; });
    null("holes null", [](Cage& d) { d.holeCount = 1; });
    malformed("no vertices", [](Cage& d) { d.vertexCount = 0; });
    malformed("no faces", [](Cage& d) { d.faceCount = 0; });
    malformed("NaN position", [](Cage& d) { d.positions = kNanPositions; });
    malformed("infinite position", [](Cage& d) { d.positions = kInfinitePositions; });
    malformed("vertex index", [](Cage& d) { d.faceVertexIndices = kFar; });
    malformed("faces of two sides alone", [](Cage& d) { d.faceVertexCounts = kTwoSided; });
    malformed("trim tile", [](Cage& d) { d.faceTrimTiles = kTiles; });
    malformed("hole", [](Cage& d) {
        d.holeCount = 1;
        d.holes = kHoles;
    });
    malformed("NaN crease scalar", [](Cage& d) {
        d.creaseScalarCount = 1;
        d.creaseScalars = &kScalar;
    });
    static const char* const kNameless[] = {""};
    static const uint32_t kOutOfSet[] = {1}, kEdge[] = {1, 4};
    static const float kSharpness[] = {2.0f};
    malformed("crease set without a name", [](Cage& d) {
        d.creaseSetCount = 1;
        d.creaseSetNames = kNameless;
    });
    malformed("no such crease set", [](Cage& d) {
        d.creaseCount = 1;
        d.creaseVertices = kEdge;
        d.creaseSharpnesses = kSharpness;
        d.creaseSets = kOutOfSet;
    });
    createCharacter(r, create);
}

void creaseSets(Rows& r) {
    constexpr const char* kSets = "suppleGetCreaseSets";
    r.assets(kSets, [](World& w, SuppleContext c, SuppleAsset a) {
        return suppleGetCreaseSets(c, a, w.plain<const char*>(), w.number(1));
    });
    r.refuse(kSets, "count null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleGetCreaseSets(w.handle(), w.mine.asset, w.plain<const char*>(), nullptr); });
    constexpr const char* kVariants = "suppleGetMaterialVariants";
    r.assets(kVariants, [](World& w, SuppleContext c, SuppleAsset a) {
        return suppleGetMaterialVariants(c, a, w.plain<const char*>(), w.number(1));
    });
    r.refuse(kVariants, "count null", SUPPLE_MESSAGE_NULL_POINTER, [](World& w) {
        return suppleGetMaterialVariants(w.handle(), w.mine.asset, w.plain<const char*>(), nullptr);
    });
    constexpr const char* kClip = "suppleGetClipSharpness";
    const auto clip = [](World& w, SuppleAsset asset, uint32_t number) {
        return suppleGetClipSharpness(w.handle(), asset, number, 0, 0.0, w.plain<float>());
    };
    r.assets(kClip, [](World& w, SuppleContext c, SuppleAsset a) {
        return suppleGetClipSharpness(c, a, 0, 0, 0.0, w.plain<float>());
    });
    r.refuse(kClip, "out null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleGetClipSharpness(w.handle(), w.mine.asset, 0, 0, 0.0, nullptr); });
    r.refuse(kClip, "no such clip", SUPPLE_MESSAGE_OUT_OF_RANGE,
             [=](World& w) { return clip(w, w.mine.asset, kClips); });
    r.refuse(kClip, "no such crease set", SUPPLE_MESSAGE_OUT_OF_RANGE,
             [=](World& w) { return clip(w, w.mine.asset, 0); });
}

void streaming(Rows& r) {
    constexpr const char* kRequest = "suppleRequestClip";
    r.assets(kRequest, [](World&, SuppleContext c, SuppleAsset a) { return suppleRequestClip(c, a, 0, nullptr); });
    r.description<SuppleClipRequest>(
        kRequest, "request", [](World&) { return SuppleClipRequest{sizeof(SuppleClipRequest)}; },
        [](World& w, const SuppleClipRequest* request) {
            return suppleRequestClip(w.handle(), w.mine.asset, 0, request);
        },
        false);
    r.refuse(kRequest, "no such clip", SUPPLE_MESSAGE_OUT_OF_RANGE,
             [](World& w) { return suppleRequestClip(w.handle(), w.mine.asset, kClips, nullptr); });
    const auto wrong = [&](const char* what, int message, const std::function<void(SuppleClipRequest&)>& spoil) {
        r.refuse(kRequest, what, message, [=](World& w) {
            SuppleClipRequest request{sizeof(SuppleClipRequest)};
            spoil(request);
            return suppleRequestClip(w.handle(), w.mine.asset, 0, &request);
        });
    };
    wrong("use", SUPPLE_MESSAGE_OUT_OF_RANGE, [](SuppleClipRequest& d) { d.use = SUPPLE_CLIP_USE_MAX_ENUM; });
    wrong("begin negative", SUPPLE_MESSAGE_OUT_OF_RANGE, [](SuppleClipRequest& d) { d.begin = -1.0; });
    wrong("end before begin", SUPPLE_MESSAGE_OUT_OF_RANGE, [](SuppleClipRequest& d) {
        d.begin = 0.5;
        d.end = 0.25;
    });
    wrong("end infinite", SUPPLE_MESSAGE_NOT_FINITE,
          [](SuppleClipRequest& d) { d.end = std::numeric_limits<double>::infinity(); });
}

void markers(Rows& r) {
    constexpr const char* kAll = "suppleGetClipMarkers";
    constexpr const char* kBetween = "suppleGetClipMarkersBetween";
    const auto between = [](World& w, SuppleAsset asset, uint32_t clip, double from, double to, uint32_t flags) {
        return suppleGetClipMarkersBetween(w.handle(), asset, clip, from, to, flags, w.plain<SuppleClipMarker>(),
                                           w.number(1));
    };
    r.assets(kAll, [](World& w, SuppleContext c, SuppleAsset a) {
        return suppleGetClipMarkers(c, a, 0, w.plain<SuppleClipMarker>(), w.number(1));
    });
    constexpr const char* kContacts = "suppleGetClipContacts";
    r.assets(kContacts, [](World& w, SuppleContext c, SuppleAsset a) {
        return suppleGetClipContacts(c, a, 0, w.plain<SuppleClipContact>(), w.number(1));
    });
    r.refuse(kContacts, "count null", SUPPLE_MESSAGE_NULL_POINTER, [](World& w) {
        return suppleGetClipContacts(w.handle(), w.mine.asset, 0, w.plain<SuppleClipContact>(), nullptr);
    });
    r.assets(kBetween, [](World& w, SuppleContext c, SuppleAsset a) {
        return suppleGetClipMarkersBetween(c, a, 0, 0.0, 1.0, 0, w.plain<SuppleClipMarker>(), w.number(1));
    });
    r.refuse(kAll, "count null", SUPPLE_MESSAGE_NULL_POINTER, [](World& w) {
        return suppleGetClipMarkers(w.handle(), w.mine.asset, 0, w.plain<SuppleClipMarker>(), nullptr);
    });
    r.refuse(kBetween, "count null", SUPPLE_MESSAGE_NULL_POINTER, [](World& w) {
        return suppleGetClipMarkersBetween(w.handle(), w.mine.asset, 0, 0.0, 1.0, 0, w.plain<SuppleClipMarker>(),
                                           nullptr);
    });
    for (const uint32_t clip : {kClips, SUPPLE_BIND_POSE, SUPPLE_REST_POSE}) {
        r.refuse(kAll, "clip " + std::to_string(clip), SUPPLE_MESSAGE_OUT_OF_RANGE, [=](World& w) {
            return suppleGetClipMarkers(w.handle(), w.mine.asset, clip, w.plain<SuppleClipMarker>(), w.number(1));
        });
        r.refuse(kContacts, "clip " + std::to_string(clip), SUPPLE_MESSAGE_OUT_OF_RANGE, [=](World& w) {
            return suppleGetClipContacts(w.handle(), w.mine.asset, clip, w.plain<SuppleClipContact>(), w.number(1));
        });
        r.refuse(kBetween, "clip " + std::to_string(clip), SUPPLE_MESSAGE_OUT_OF_RANGE,
                 [=](World& w) { return between(w, w.mine.asset, clip, 0.0, 1.0, 0); });
    }
    r.refuse(kBetween, "unknown flags", SUPPLE_MESSAGE_OUT_OF_RANGE,
             [=](World& w) { return between(w, w.mine.asset, 0, 0.0, 1.0, 4); });
    for (const double time : {static_cast<double>(kNan), static_cast<double>(kInfinity)}) {
        r.refuse(kBetween, "from " + std::to_string(time), SUPPLE_MESSAGE_NOT_FINITE,
                 [=](World& w) { return between(w, w.mine.asset, 0, time, 1.0, 0); });
        r.refuse(kBetween, "to " + std::to_string(time), SUPPLE_MESSAGE_NOT_FINITE,
                 [=](World& w) { return between(w, w.mine.asset, 0, 0.0, time, 0); });
    }
    r.refuse(kBetween, "from too early", SUPPLE_MESSAGE_OUT_OF_RANGE,
             [=](World& w) { return between(w, w.mine.asset, 0, -1.1e9, 1.0, 0); });
    r.refuse(kBetween, "to too late", SUPPLE_MESSAGE_OUT_OF_RANGE,
             [=](World& w) { return between(w, w.mine.asset, 0, 0.0, 1.1e9, 0); });
    r.accept(kBetween, "no markers", [=](World& w) { return between(w, w.mine.asset, 0, 0.0, 1e9, 3); });
}

void assetGetters(Rows& r) {
    r.assets("suppleDestroyAsset", [](World&, SuppleContext c, SuppleAsset a) { return suppleDestroyAsset(c, a); });
    const auto info = [](World& w, SuppleContext c, SuppleAsset a) {
        return suppleGetAssetInfo(c, a, w.watched<SuppleAssetInfo>(sizeof(SuppleAssetInfo)));
    };
    r.assets("suppleGetAssetInfo", info);
    r.output<SuppleAssetInfo>("suppleGetAssetInfo", [](World& w, SuppleAssetInfo* out) {
        return suppleGetAssetInfo(w.handle(), w.mine.asset, out);
    });
    const auto part = [&]<class T>(const char* function, uint32_t count,
                                   SuppleResult (*get)(SuppleContext, SuppleAsset, uint32_t, T*)) {
        r.assets(function, [=](World& w, SuppleContext c, SuppleAsset a) {
            return get(c, a, 0, w.template watched<T>(sizeof(T)));
        });
        r.output<T>(function, [=](World& w, T* out) { return get(w.handle(), w.mine.asset, 0, out); });
        for (const uint32_t index : {count, ~0u, SUPPLE_BIND_POSE, SUPPLE_REST_POSE}) {
            r.refuse(function, "index " + std::to_string(index), SUPPLE_MESSAGE_OUT_OF_RANGE,
                     [=](World& w) { return get(w.handle(), w.mine.asset, index, w.template watched<T>(sizeof(T))); });
        }
    };
    part("suppleGetPartInfo", 1, &suppleGetPartInfo);
    part("suppleGetClipInfo", kClips, &suppleGetClipInfo);
    part("suppleGetJointInfo", kJoints, &suppleGetJointInfo);
    part("suppleGetMorphTargetInfo", kTargets, &suppleGetMorphTargetInfo);
    part("suppleGetMaterialInfo", kMaterials, &suppleGetMaterialInfo);
    part("suppleGetMaterialLayers", kMaterials, &suppleGetMaterialLayers);
    part("suppleGetImageInfo", kImages, &suppleGetImageInfo);

    constexpr const char* kClipBounds = "suppleGetClipBounds";
    r.assets(kClipBounds, [](World& w, SuppleContext c, SuppleAsset a) {
        return suppleGetClipBounds(c, a, 0, w.plain<SuppleBounds>());
    });
    r.refuse(kClipBounds, "out null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleGetClipBounds(w.handle(), w.mine.asset, 0, nullptr); });
    for (const uint32_t clip : {kClips, 0xFFFFFFFDu}) {
        r.refuse(kClipBounds, "clip " + std::to_string(clip), SUPPLE_MESSAGE_OUT_OF_RANGE, [=](World& w) {
            return suppleGetClipBounds(w.handle(), w.mine.asset, clip, w.plain<SuppleBounds>());
        });
    }
    for (const uint32_t clip : {0u, SUPPLE_BIND_POSE, SUPPLE_REST_POSE}) {
        r.accept(kClipBounds, "clip " + std::to_string(clip), [=](World& w) {
            return suppleGetClipBounds(w.handle(), w.mine.asset, clip, w.plain<SuppleBounds>());
        });
    }
    streaming(r);
    markers(r);
    creaseSets(r);

    // The asset has no expressions.
    constexpr const char *kExpression = "suppleGetExpressionInfo", *kFill = "suppleFillExpressionWeights";
    r.assets(kExpression, [](World& w, SuppleContext c, SuppleAsset a) {
        return suppleGetExpressionInfo(c, a, 0, w.watched<SuppleExpressionInfo>(sizeof(SuppleExpressionInfo)));
    });
    for (const uint32_t index : {0u, ~0u}) {
        r.refuse(kExpression, "index " + std::to_string(index), SUPPLE_MESSAGE_OUT_OF_RANGE, [=](World& w) {
            return suppleGetExpressionInfo(w.handle(), w.mine.asset, index,
                                           w.watched<SuppleExpressionInfo>(sizeof(SuppleExpressionInfo)));
        });
    }
    r.assets(kFill, [](World& w, SuppleContext c, SuppleAsset a) {
        return suppleFillExpressionWeights(c, a, nullptr, 0, w.plain<float>(kTargets), kTargets);
    });
    r.accept(kFill, "valid", [](World& w) {
        return suppleFillExpressionWeights(w.handle(), w.mine.asset, nullptr, 0, w.plain<float>(kTargets), kTargets);
    });
    r.refuse(kFill, "out null", SUPPLE_MESSAGE_NULL_POINTER, [](World& w) {
        return suppleFillExpressionWeights(w.handle(), w.mine.asset, nullptr, 0, nullptr, kTargets);
    });
    for (const auto& [expressions, targets] : {std::pair{1u, kTargets}, {0u, kTargets - 1}, {0u, kTargets + 1}}) {
        r.refuse(kFill, "counts " + std::to_string(expressions) + ", " + std::to_string(targets),
                 SUPPLE_MESSAGE_OUT_OF_RANGE, [expressions = expressions, targets = targets](World& w) {
                     static const float kOne = 1.0f;
                     return suppleFillExpressionWeights(w.handle(), w.mine.asset, &kOne, expressions,
                                                        w.plain<float>(kTargets + 1), targets);
                 });
    }

    constexpr const char* kMask = "suppleFillJointMask";
    r.assets(kMask, [](World& w, SuppleContext c, SuppleAsset a) {
        return suppleFillJointMask(c, a, 0, 0.5f, w.plain<float>(kJoints), kJoints);
    });
    r.accept(kMask, "valid", [](World& w) {
        return suppleFillJointMask(w.handle(), w.mine.asset, kJoints - 1, 1.0f, w.plain<float>(kJoints), kJoints);
    });
    r.refuse(kMask, "mask null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleFillJointMask(w.handle(), w.mine.asset, 0, 0.5f, nullptr, kJoints); });
    const auto mask = [&](const char* what, uint32_t joint, float value, uint32_t count) {
        r.refuse(kMask, what, SUPPLE_MESSAGE_OUT_OF_RANGE, [=](World& w) {
            return suppleFillJointMask(w.handle(), w.mine.asset, joint, value, w.plain<float>(kJoints), count);
        });
    };
    mask("joint", kJoints, 0.5f, kJoints);
    mask("no joint", SUPPLE_NO_JOINT, 0.5f, kJoints);
    mask("count too small", 0, 0.5f, kJoints - 1);
    mask("count too large", 0, 0.5f, kJoints + 1);
    mask("count 0", 0, 0.5f, 0);
    mask("value NaN", 0, kNan, kJoints);
    mask("value infinite", 0, kInfinity, kJoints);
    mask("value below", 0, -0.01f, kJoints);
    mask("value above", 0, 1.01f, kJoints);
}

void views(Rows& r) {
    constexpr const char *kCreate = "suppleCreateView", *kDestroy = "suppleDestroyView", *kCamera = "suppleSetCamera",
                         *kPyramid = "suppleSetDepthPyramid", *kStatistics = "suppleGetViewStatistics",
                         *kPriority = "suppleSetPriority";
    constexpr int kRange = SUPPLE_MESSAGE_OUT_OF_RANGE, kFinite = SUPPLE_MESSAGE_NOT_FINITE;
    const auto create = [](World& w, const SuppleViewDesc* desc) {
        SuppleView* const out = w.newHandle<SuppleView>();
        const SuppleResult result = suppleCreateView(w.handle(), desc, out);
        if (result == SUPPLE_OK) {
            EXPECT_EQ(suppleDestroyView(w.handle(), *out), SUPPLE_OK);
        } else {
            EXPECT_EQ(out->id, 0u);
        }
        return result;
    };
    r.nullContext(kCreate, [](World& w, SuppleContext c) {
        const SuppleViewDesc desc = World::viewDesc();
        return suppleCreateView(c, &desc, w.newHandle<SuppleView>());
    });
    r.refuse(kCreate, "out null", SUPPLE_MESSAGE_NULL_POINTER, [](World& w) {
        const SuppleViewDesc desc = World::viewDesc();
        return suppleCreateView(w.handle(), &desc, nullptr);
    });
    r.description<SuppleViewDesc>(
        kCreate, "desc", [](World&) { return World::viewDesc(); }, create);
    const auto spoiled = [&](const char* what, SuppleResult result, int message, auto spoil) {
        r.add(kCreate, what, result, message, [=](World& w) {
            SuppleViewDesc desc = World::viewDesc();
            spoil(desc);
            return create(w, &desc);
        });
    };
    using Desc = SuppleViewDesc;
    constexpr SuppleResult kBad = SUPPLE_ERROR_ARGUMENT;
    spoiled("flags", kBad, kRange, [](Desc& d) { d.flags = 256; });
    spoiled("OCCLUSION without CULL", kBad, SUPPLE_MESSAGE_CONFLICT, [](Desc& d) { d.flags = SUPPLE_VIEW_OCCLUSION; });
    spoiled("UVS1 alone", kBad, SUPPLE_MESSAGE_CONFLICT, [](Desc& d) { d.flags = SUPPLE_VIEW_UVS1; });
    spoiled("TANGENTS alone", kBad, SUPPLE_MESSAGE_CONFLICT, [](Desc& d) { d.flags = SUPPLE_VIEW_TANGENTS; });
    spoiled("too few vertices", kBad, kRange, [](Desc& d) { d.maxVertices = 1023; });
    spoiled("vertexFormat", kBad, kRange, [](Desc& d) { d.vertexFormat = SUPPLE_VERTEX_12; });
    spoiled("too many runs", kBad, kRange, [](Desc& d) { d.maxRuns = SUPPLE_MAX_VIEW_RUNS + 1; });
    spoiled("too few coefficients", kBad, kRange, [](Desc& d) { d.coefficientBytes = 255; });
    spoiled("more coefficients than can be bound", SUPPLE_ERROR_LIMIT, SUPPLE_MESSAGE_LIMIT,
            [](Desc& d) { d.coefficientBytes = uint64_t{1} << 40; });
    spoiled("less memory than that takes", SUPPLE_ERROR_LIMIT, SUPPLE_MESSAGE_LIMIT,
            [](Desc& d) { d.memoryBytes = 4096; });
    spoiled("elasticity", kBad, kRange, [](Desc& d) { d.elasticities[1] = 1.5f; });
    spoiled("elasticity NaN", kBad, kRange, [](Desc& d) { d.elasticities[3] = kNan; });
    spoiled("more than the budget counts", SUPPLE_ERROR_LIMIT, SUPPLE_MESSAGE_LIMIT,
            [](Desc& d) { d.maxVertices = 0xF0000000u; });
    spoiled("all flags", SUPPLE_OK, kSilent, [](Desc& d) { d.flags = 255; });

    const auto handles = [&](const char* function, auto call) {
        r.nullContext(function, [=](World& w, SuppleContext c) { return call(w, c, w.view); });
        const auto stale = [&](const char* what, auto get) {
            r.refuse(function, what, SUPPLE_MESSAGE_STALE_HANDLE,
                     [=](World& w) { return call(w, w.handle(), get(w)); });
        };
        stale("zero view", [](World&) { return SuppleView{0}; });
        stale("stale view", [](World& w) { return w.staleView; });
        stale("foreign view", [](World& w) { return w.foreignView; });
        stale("group for view", [](World& w) { return SuppleView{w.mine.main.group.id}; });
    };
    handles(kDestroy, [](World&, SuppleContext c, SuppleView v) { return suppleDestroyView(c, v); });
    handles(kCamera, [](World&, SuppleContext c, SuppleView v) {
        const SuppleCameraDesc camera = World::cameraDesc();
        return suppleSetCamera(c, v, &camera);
    });
    const auto set = [](World& w, const SuppleCameraDesc* camera) {
        return suppleSetCamera(w.handle(), w.view, camera);
    };
    r.description<SuppleCameraDesc>(
        kCamera, "camera", [](World&) { return World::cameraDesc(); }, set);
    const auto wrong = [&](const char* what, int message, auto spoil) {
        r.refuse(kCamera, what, message, [=](World& w) {
            SuppleCameraDesc camera = World::cameraDesc();
            spoil(camera);
            return set(w, &camera);
        });
    };
    using Camera = SuppleCameraDesc;
    wrong("flags", kRange, [](Camera& c) { c.flags = 2; });
    wrong("position NaN", kFinite, [](Camera& c) { c.position[1] = kNan; });
    wrong("viewProjection infinite", kFinite, [](Camera& c) { c.viewProjection[5] = kInfinity; });
    wrong("smallestRadius NaN", kFinite, [](Camera& c) { c.smallestRadius = kNan; });
    wrong("pixelsPerUnit 0", kRange, [](Camera& c) { c.pixelsPerUnit = 0.0f; });
    wrong("chordError negative", kRange, [](Camera& c) { c.chordError = -1.0f; });
    wrong("farthest negative", kRange, [](Camera& c) { c.farthest = -1.0f; });

    wrong("direction NaN", kFinite, [](Camera& c) { c.direction[2] = kNan; });
    const auto orthographic = [](World& w, SuppleView v, float z) {
        SuppleCameraDesc camera = World::cameraDesc();
        camera.flags = SUPPLE_CAMERA_ORTHOGRAPHIC;
        camera.direction[2] = z;
        return suppleSetCamera(w.handle(), v, &camera);
    };
    r.refuse(kCamera, "BACK_FACES, orthographic, no direction", kRange,
             [=](World& w) { return orthographic(w, w.cullingView, 0.0f); });
    r.accept(kCamera, "BACK_FACES, orthographic", [=](World& w) { return orthographic(w, w.cullingView, -1.0f); });
    r.accept(kCamera, "orthographic, no direction", [=](World& w) { return orthographic(w, w.view, 0.0f); });

    handles(kPyramid, [](World&, SuppleContext c, SuppleView v) {
        const SuppleDepthPyramidDesc pyramid = World::pyramidDesc();
        return suppleSetDepthPyramid(c, v, &pyramid);
    });
    const auto setPyramid = [](World& w, const SuppleDepthPyramidDesc* pyramid) {
        return suppleSetDepthPyramid(w.handle(), w.cullingView, pyramid);
    };
    r.description<SuppleDepthPyramidDesc>(
        kPyramid, "pyramid", [](World&) { return World::pyramidDesc(); }, setPyramid, false);
    r.accept(kPyramid, "null", [=](World& w) { return setPyramid(w, nullptr); });
    r.refuse(kPyramid, "a view without OCCLUSION", SUPPLE_MESSAGE_CONFLICT, [](World& w) {
        const SuppleDepthPyramidDesc pyramid = World::pyramidDesc();
        return suppleSetDepthPyramid(w.handle(), w.view, &pyramid);
    });
    using Pyramid = SuppleDepthPyramidDesc;
    const auto pyramid = [&](const char* what, SuppleResult result, int message, auto spoil) {
        r.add(kPyramid, what, result, message, [=](World& w) {
            SuppleDepthPyramidDesc desc = World::pyramidDesc();
            spoil(desc);
            return setPyramid(w, &desc);
        });
    };
    pyramid("flags", kBad, kRange, [](Pyramid& p) { p.flags = 2; });
    pyramid("REVERSED", SUPPLE_OK, kSilent, [](Pyramid& p) { p.flags = SUPPLE_DEPTH_REVERSED; });
    pyramid("imageView null", kBad, SUPPLE_MESSAGE_NULL_POINTER, [](Pyramid& p) { p.imageView = VK_NULL_HANDLE; });
    pyramid("layout", kBad, kRange, [](Pyramid& p) { p.layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL; });
    pyramid("READ_ONLY_OPTIMAL", SUPPLE_OK, kSilent, [](Pyramid& p) { p.layout = VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL; });
    pyramid("width 0", kBad, kRange, [](Pyramid& p) { p.width = 0; });
    pyramid("height beyond the device's images", kBad, kRange, [](Pyramid& p) { p.height = 0x80000000u; });
    pyramid("no level", kBad, kRange, [](Pyramid& p) { p.mipLevels = 0; });
    pyramid("one level", SUPPLE_OK, kSilent, [](Pyramid& p) { p.mipLevels = 1; });
    pyramid("more levels than there can be", kBad, kRange, [](Pyramid& p) { p.mipLevels = 11; });
    pyramid("viewProjection NaN", kBad, kFinite, [](Pyramid& p) { p.viewProjection[9] = kNan; });

    handles(kStatistics, [](World& w, SuppleContext c, SuppleView v) {
        return suppleGetViewStatistics(c, v, w.watched<SuppleViewStatistics>(sizeof(SuppleViewStatistics)));
    });
    r.output<SuppleViewStatistics>(
        kStatistics,
        [](World& w, SuppleViewStatistics* out) { return suppleGetViewStatistics(w.handle(), w.view, out); },
        SUPPLE_NOT_READY);
    constexpr const char* kMemory = "suppleGetViewMemory";
    handles(kMemory, [](World& w, SuppleContext c, SuppleView v) {
        return suppleGetViewMemory(c, v, w.watched<SuppleMemoryUse>(sizeof(SuppleMemoryUse)));
    });
    r.output<SuppleMemoryUse>(
        kMemory, [](World& w, SuppleMemoryUse* out) { return suppleGetViewMemory(w.handle(), w.view, out); });

    r.instances(
        kPriority, [](World&, SuppleContext c, SuppleInstance i) { return suppleSetPriority(c, i, 1); }, false,
        &World::seen);
    r.accept(kPriority, "highest", [](World& w) { return suppleSetPriority(w.handle(), w.seen.instances[0], 3); });
    r.refuse(kPriority, "beyond", kRange,
             [](World& w) { return suppleSetPriority(w.handle(), w.seen.instances[0], SUPPLE_PRIORITY_COUNT); });
    r.refuse(kPriority, "of a group without a view", SUPPLE_MESSAGE_CONFLICT,
             [](World& w) { return suppleSetPriority(w.handle(), w.instance(), 1); });
    // Groups of views.
    const auto group = [&](const char* what, SuppleResult result, int message, auto spoil) {
        r.add("suppleCreateGroup", what, result, message, [=](World& w) {
            SuppleGroupDesc desc = w.groupDesc();
            desc.scheme = SUPPLE_SCHEME_PM;
            desc.view = w.view;
            spoil(w, desc);
            SuppleGroup* const out = w.newHandle<SuppleGroup>();
            const SuppleResult given = suppleCreateGroup(w.handle(), &desc, out);
            if (given == SUPPLE_OK) {
                EXPECT_EQ(suppleDestroyGroup(w.handle(), *out), SUPPLE_OK);
            }
            return given;
        });
    };
    group("of a view", SUPPLE_OK, kSilent, [](World&, SuppleGroupDesc&) {});
    group("of a stale view", kBad, SUPPLE_MESSAGE_STALE_HANDLE,
          [](World& w, SuppleGroupDesc& d) { d.view = w.staleView; });
    group("of a foreign view", kBad, SUPPLE_MESSAGE_STALE_HANDLE,
          [](World& w, SuppleGroupDesc& d) { d.view = w.foreignView; });
    group("of a view, with flags", kBad, SUPPLE_MESSAGE_CONFLICT,
          [](World&, SuppleGroupDesc& d) { d.flags = SUPPLE_GROUP_MOTION; });
    group("of a view, at rates", SUPPLE_OK, kSilent,
          [](World&, SuppleGroupDesc& d) { d.scheme = SUPPLE_SCHEME_FRAGMENTS; });
    group("of a view, the cage alone", kBad, SUPPLE_MESSAGE_CONFLICT,
          [](World&, SuppleGroupDesc& d) { d.scheme = SUPPLE_SCHEME_CAGE; });
    group("of a view, with shared samples", kBad, SUPPLE_MESSAGE_CONFLICT,
          [](World&, SuppleGroupDesc& d) { d.flags = SUPPLE_GROUP_INDEXED_MESH; });
    r.refuse("suppleSetRate", "of a group of a view", SUPPLE_MESSAGE_CONFLICT,
             [](World& w) { return suppleSetRate(w.handle(), w.seen.group, 1); });
    r.refuse("suppleRecord", "a view without a camera", SUPPLE_MESSAGE_OUT_OF_ORDER, [](World& w) {
        SuppleRecordDesc desc = w.recordDesc();
        desc.groups = &w.seen.group;
        desc.groupCount = 1;
        w.recorded = false;
        return suppleRecord(w.handle(), w.commands, &desc);
    });
}

void groups(Rows& r) {
    constexpr const char* kCreate = "suppleCreateGroup";
    const auto create = [](World& w, const SuppleGroupDesc* desc) {
        SuppleGroup* const out = w.newHandle<SuppleGroup>();
        const SuppleResult result = suppleCreateGroup(w.handle(), desc, out);
        if (result == SUPPLE_OK) {
            EXPECT_EQ(suppleDestroyGroup(w.handle(), *out), SUPPLE_OK);
        } else {
            EXPECT_EQ(out->id, 0u);
        }
        return result;
    };
    r.assets(kCreate, [](World& w, SuppleContext c, SuppleAsset a) {
        SuppleGroupDesc desc = w.groupDesc();
        desc.asset = a;
        return suppleCreateGroup(c, &desc, w.newHandle<SuppleGroup>());
    });
    r.refuse(kCreate, "out null", SUPPLE_MESSAGE_NULL_POINTER, [](World& w) {
        const SuppleGroupDesc desc = w.groupDesc();
        return suppleCreateGroup(w.handle(), &desc, nullptr);
    });
    r.description<SuppleGroupDesc>(
        kCreate, "desc", [](World& w) { return w.groupDesc(); }, create);
    const auto spoiled = [&](const std::string& what, SuppleResult result, int message, auto spoil) {
        r.add(kCreate, what, result, message, [=](World& w) {
            SuppleGroupDesc desc = w.groupDesc();
            spoil(desc);
            return create(w, &desc);
        });
    };
    const auto range = [&](const std::string& what, auto spoil) {
        spoiled(what, SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_OUT_OF_RANGE, spoil);
    };
    using Desc = SuppleGroupDesc;
    range("capacity 0", [](Desc& d) { d.capacity = 0; });
    range("rate 65", [](Desc& d) { d.rate = SUPPLE_MAX_RATE + 1; });
    range("flags", [](Desc& d) { d.flags = 16; });
    const auto blend = [&](const std::string& what, SuppleResult result, int message, SuppleBlendOptions options) {
        r.add(kCreate, what, result, message, [=](World& w) {
            SuppleGroupDesc desc = w.groupDesc();
            desc.blend = &options;
            return create(w, &desc);
        });
    };
    const auto prep = [&](const std::string& what, SupplePrepOptions options) {
        r.add(kCreate, what, SUPPLE_ERROR_ARGUMENT,
              options.structSize < sizeof(options) ? SUPPLE_MESSAGE_STRUCT_SIZE : SUPPLE_MESSAGE_OUT_OF_RANGE,
              [=](World& w) {
                  SuppleGroupDesc desc = w.groupDesc();
                  desc.prep = &options;
                  return create(w, &desc);
              });
    };
    constexpr uint32_t kBlendSize = sizeof(SuppleBlendOptions), kPrepSize = sizeof(SupplePrepOptions);
    blend("sharpThreshold negative", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_OUT_OF_RANGE,
          {kBlendSize, SUPPLE_CREASES_CUT, -1.0f});
    blend("sharpThreshold NaN", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_NOT_FINITE,
          {kBlendSize, SUPPLE_CREASES_CUT, kNan});
    blend("blend, structSize 0", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_STRUCT_SIZE, {});
    prep("prep, structSize 0", {});
    const auto fragments = [&](const std::string& what, int message, SuppleFragmentsOptions options) {
        r.add(kCreate, what, SUPPLE_ERROR_ARGUMENT, message, [=](World& w) {
            SuppleGroupDesc desc = w.groupDesc();
            desc.fragments = &options;
            return create(w, &desc);
        });
    };
    fragments("fragments, structSize 0", SUPPLE_MESSAGE_STRUCT_SIZE, {});
    fragments("rules 2", SUPPLE_MESSAGE_OUT_OF_RANGE,
              {sizeof(SuppleFragmentsOptions), static_cast<SuppleFragmentRules>(2)});
    for (const int value : {8, 99, 101, -1}) {
        range("scheme " + std::to_string(value), [=](Desc& d) { d.scheme = static_cast<SuppleScheme>(value); });
    }
    for (const int value : {3, -1}) {
        const std::string n = " " + std::to_string(value);
        range("vertexFormat" + n, [=](Desc& d) { d.vertexFormat = static_cast<SuppleVertexFormat>(value); });
        prep("tangentMode" + n, {kPrepSize, static_cast<SuppleTangentMode>(value), SUPPLE_CORNERS_SHARP});
        prep("cornerRule" + n, {kPrepSize, SUPPLE_TANGENTS_DEFAULT, static_cast<SuppleCornerRule>(value)});
        blend("creaseMode" + n, SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_OUT_OF_RANGE,
              {kBlendSize, static_cast<SuppleCreaseMode>(value), 0.0f});
    }
    for (const int value : {7, -1}) {
        range("uvInterpolation " + std::to_string(value),
              [=](Desc& d) { d.uvInterpolation = static_cast<SuppleUvInterpolation>(value); });
    }
    for (const int value : {6, -1}) {
        range("skinning " + std::to_string(value), [=](Desc& d) { d.skinning = static_cast<SuppleSkinning>(value); });
    }
    for (const int value : {4, -1}) {
        range("poseSource " + std::to_string(value),
              [=](Desc& d) { d.poseSource = static_cast<SupplePoseSource>(value); });
    }
    spoiled("palette buffer of dual quaternions", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT, [](Desc& d) {
        d.poseSource = SUPPLE_POSES_PALETTE_BUFFER;
        d.skinning = SUPPLE_SKINNING_DUAL_QUATERNION;
    });
    spoiled("patches of a scheme without", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT, [](Desc& d) {
        d.scheme = SUPPLE_SCHEME_FRAGMENTS;
        d.flags = SUPPLE_GROUP_PATCHES;
    });
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_FRAGMENTS, SUPPLE_SCHEME_BLEND, SUPPLE_SCHEME_CAGE}) {
        spoiled("shared samples of scheme " + std::to_string(scheme), SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT,
                [=](Desc& d) {
                    d.scheme = scheme;
                    d.flags = SUPPLE_GROUP_INDEXED_MESH;
                });
    }
    static const SuppleScheme kPartSchemes[] = {SUPPLE_SCHEME_LOOP, SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CAGE,
                                                static_cast<SuppleScheme>(8)};
    const auto partSchemes = [&](const std::string& what, SuppleResult result, int message, uint32_t first,
                                 uint32_t count, SuppleScheme scheme = SUPPLE_SCHEME_PM) {
        spoiled("schemes of parts: " + what, result, message, [=](Desc& d) {
            d.scheme = scheme;
            d.partSchemes = kPartSchemes + first;
            d.partSchemeCount = count;
        });
    };
    partSchemes("one for each part", SUPPLE_OK, kSilent, 0, 1);
    partSchemes("more than parts", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_OUT_OF_RANGE, 0, 2);
    partSchemes("cage", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_OUT_OF_RANGE, 2, 1);
    partSchemes("no such", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_OUT_OF_RANGE, 3, 1);
    partSchemes("of a cage", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT, 0, 1, SUPPLE_SCHEME_CAGE);
    spoiled("schemes of parts: null", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_NULL_POINTER,
            [](Desc& d) { d.partSchemeCount = 1; });
    spoiled("too many vertices", SUPPLE_ERROR_LIMIT, SUPPLE_MESSAGE_LIMIT, [](Desc& d) {
        d.scheme = SUPPLE_SCHEME_PM;
        d.rate = 64;
        d.capacity = 0x7FFFFFFF;
    });

    r.groups("suppleDestroyGroup", [](World&, SuppleContext c, SuppleGroup g) { return suppleDestroyGroup(c, g); });
    r.groups("suppleSetRate", [](World&, SuppleContext c, SuppleGroup g) { return suppleSetRate(c, g, 1); });
    for (const uint32_t rate : {0u, 3u, 65u, ~0u}) {
        r.refuse("suppleSetRate", "rate " + std::to_string(rate), SUPPLE_MESSAGE_OUT_OF_RANGE,
                 [=](World& w) { return suppleSetRate(w.handle(), w.mine.main.group, rate); });
    }
    constexpr const char* kWind = "suppleSetWind";
    static constexpr float kBreeze[3] = {1.0f, 0.0f, -SUPPLE_MAX_WIND}, kNoWind[3] = {0.0f, kNan, 0.0f},
                           kGale[3] = {0.0f, 0.0f, 1.1f * SUPPLE_MAX_WIND};
    r.groups(kWind, [](World&, SuppleContext c, SuppleGroup g) { return suppleSetWind(c, g, kBreeze); });
    r.refuse(kWind, "null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleSetWind(w.handle(), w.mine.main.group, nullptr); });
    r.refuse(kWind, "NaN", SUPPLE_MESSAGE_NOT_FINITE,
             [](World& w) { return suppleSetWind(w.handle(), w.mine.main.group, kNoWind); });
    r.refuse(kWind, "too strong", SUPPLE_MESSAGE_OUT_OF_RANGE,
             [](World& w) { return suppleSetWind(w.handle(), w.mine.main.group, kGale); });
    constexpr const char* kCapacity = "suppleSetCapacity";
    r.groups(kCapacity, [](World&, SuppleContext c, SuppleGroup g) { return suppleSetCapacity(c, g, 4); });
    r.refuse(kCapacity, "0", SUPPLE_MESSAGE_OUT_OF_RANGE,
             [](World& w) { return suppleSetCapacity(w.handle(), w.mine.main.group, 0); });
    r.accept(kCapacity, "as it is", [](World& w) {
        SuppleGroupInfo info = {};
        info.structSize = sizeof info;
        EXPECT_EQ(suppleGetGroupInfo(w.handle(), w.spare.group, &info), SUPPLE_OK);
        return suppleSetCapacity(w.handle(), w.spare.group, info.capacity);
    });
    r.accept("suppleSetRate", "as it is", [](World& w) { return suppleSetRate(w.handle(), w.mine.main.group, 2); });
    r.add("suppleSetRate", "of a scheme of one rate", SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT,
          [](World& w) { return suppleSetRate(w.handle(), w.mine.subdivision.group, 64); });
    r.groups("suppleGetGroupInfo", [](World& w, SuppleContext c, SuppleGroup g) {
        return suppleGetGroupInfo(c, g, w.watched<SuppleGroupInfo>(sizeof(SuppleGroupInfo)));
    });
    r.output<SuppleGroupInfo>("suppleGetGroupInfo", [](World& w, SuppleGroupInfo* out) {
        return suppleGetGroupInfo(w.handle(), w.mine.main.group, out);
    });
    const auto output = [&]<class T>(const char* function,
                                     SuppleResult (*get)(SuppleContext, SuppleGroup, uint32_t, T*)) {
        r.groups(function, [=](World& w, SuppleContext c, SuppleGroup g) {
            return get(c, g, 0, w.template watched<T>(sizeof(T)));
        });
        const auto from = [](World& w) {
            return std::is_same_v<T, SuppleLevelOutput> ? w.seen.group : w.mine.main.group;
        };
        r.output<T>(function, [=](World& w, T* out) { return get(w.handle(), from(w), 0, out); });
        for (const uint32_t surface : {1u, ~0u}) {
            r.refuse(function, "surface " + std::to_string(surface), SUPPLE_MESSAGE_OUT_OF_RANGE,
                     [=](World& w) { return get(w.handle(), from(w), surface, w.template watched<T>(sizeof(T))); });
        }
    };
    const auto conflict = [&]<class T>(const char* function,
                                       SuppleResult (*get)(SuppleContext, SuppleGroup, uint32_t, T*), const char* what,
                                       SmallGroup World::*of) {
        r.refuse(function, what, SUPPLE_MESSAGE_CONFLICT,
                 [=](World& w) { return get(w.handle(), (w.*of).group, 0, w.template watched<T>(sizeof(T))); });
    };
    output("suppleGetSurfaceInfo", suppleGetSurfaceInfo);
    output("suppleGetVertexStreams", suppleGetVertexStreams);
    output("suppleGetGridOutput", suppleGetGridOutput);
    output("suppleGetLevelOutput", suppleGetLevelOutput);
    conflict("suppleGetVertexStreams", suppleGetVertexStreams, "of a cage", &World::spare);
    conflict("suppleGetGridOutput", suppleGetGridOutput, "of a cage", &World::spare);
    conflict("suppleGetGridOutput", suppleGetGridOutput, "of levels", &World::seen);
    conflict("suppleGetLevelOutput", suppleGetLevelOutput, "of a cage", &World::spare);
    // tests/runtime/ray_queries_test.cpp asks a group that has them.
    constexpr const char* kRays = "suppleGetRayGeometry";
    r.groups(kRays, [](World& w, SuppleContext c, SuppleGroup g) {
        return suppleGetRayGeometry(c, g, 0, w.watched<SuppleRayGeometry>(sizeof(SuppleRayGeometry)));
    });
    r.refuse(kRays, "surface 1", SUPPLE_MESSAGE_OUT_OF_RANGE, [](World& w) {
        return suppleGetRayGeometry(w.handle(), w.mine.main.group, 1,
                                    w.watched<SuppleRayGeometry>(sizeof(SuppleRayGeometry)));
    });
    conflict(kRays, suppleGetRayGeometry, "of a cage", &World::spare);
    conflict(kRays, suppleGetRayGeometry, "of levels", &World::seen);
    // tests/runtime/direct_test.cpp asks a group that has it.
    constexpr const char* kDirect = "suppleGetDirectOutput";
    r.groups(kDirect, [](World& w, SuppleContext c, SuppleGroup g) {
        return suppleGetDirectOutput(c, g, 0, w.watched<SuppleDirectOutput>(sizeof(SuppleDirectOutput)));
    });
    r.refuse(kDirect, "surface 1", SUPPLE_MESSAGE_OUT_OF_RANGE, [](World& w) {
        return suppleGetDirectOutput(w.handle(), w.mine.main.group, 1,
                                     w.watched<SuppleDirectOutput>(sizeof(SuppleDirectOutput)));
    });
    conflict(kDirect, suppleGetDirectOutput, "of a cage", &World::spare);
    conflict(kDirect, suppleGetDirectOutput, "of levels", &World::seen);
    constexpr const char* kBounds = "suppleGetInstanceBounds";
    r.groups(kBounds, [](World& w, SuppleContext c, SuppleGroup g) {
        return suppleGetInstanceBounds(c, g, w.plain<SuppleBufferRange>());
    });
    r.refuse(kBounds, "out null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleGetInstanceBounds(w.handle(), w.seen.group, nullptr); });
    r.refuse(kBounds, "without a view or BOUNDS", SUPPLE_MESSAGE_CONFLICT,
             [](World& w) { return suppleGetInstanceBounds(w.handle(), w.spare.group, w.plain<SuppleBufferRange>()); });
    r.accept(kBounds, "of a view",
             [](World& w) { return suppleGetInstanceBounds(w.handle(), w.seen.group, w.plain<SuppleBufferRange>()); });
    constexpr const char* kClipBounds = "suppleGetGroupClipBounds";
    r.groups(kClipBounds, [](World& w, SuppleContext c, SuppleGroup g) {
        return suppleGetGroupClipBounds(c, g, 0, w.plain<SuppleBounds>());
    });
    r.refuse(kClipBounds, "out null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleGetGroupClipBounds(w.handle(), w.mine.main.group, 0, nullptr); });
    r.refuse(kClipBounds, "no such clip", SUPPLE_MESSAGE_OUT_OF_RANGE, [](World& w) {
        return suppleGetGroupClipBounds(w.handle(), w.mine.main.group, kClips, w.plain<SuppleBounds>());
    });
    r.refuse(kClipBounds, "the host deforms", SUPPLE_MESSAGE_CONFLICT, [](World& w) {
        return suppleGetGroupClipBounds(w.handle(), w.buffered.group, 0, w.plain<SuppleBounds>());
    });
    r.accept(kClipBounds, "rest pose", [](World& w) {
        return suppleGetGroupClipBounds(w.handle(), w.mine.main.group, SUPPLE_REST_POSE, w.plain<SuppleBounds>());
    });
    constexpr const char* kPatches = "suppleGetPatches";
    r.groups(kPatches, [](World& w, SuppleContext c, SuppleGroup g) {
        return suppleGetPatches(c, g, 0, w.plain<SupplePatchInfo>(2), w.number(2));
    });
    r.refuse(kPatches, "surface 1", SUPPLE_MESSAGE_OUT_OF_RANGE, [](World& w) {
        return suppleGetPatches(w.handle(), w.mine.main.group, 1, w.plain<SupplePatchInfo>(2), w.number(2));
    });
    r.refuse(kPatches, "count null", SUPPLE_MESSAGE_NULL_POINTER, [](World& w) {
        return suppleGetPatches(w.handle(), w.mine.main.group, 0, w.plain<SupplePatchInfo>(2), nullptr);
    });
    r.accept(kPatches, "count alone",
             [](World& w) { return suppleGetPatches(w.handle(), w.mine.main.group, 0, nullptr, w.number(0)); });
    r.add(kPatches, "short array", SUPPLE_INCOMPLETE, kSilent, [](World& w) {
        auto* const patches = w.plain<SupplePatchInfo>(3);
        uint32_t count = 2;
        const SuppleResult result = suppleGetPatches(w.handle(), w.mine.main.group, 0, patches, &count);
        EXPECT_GT(count, 2u);
        EXPECT_EQ(patches[2].face, 0xA5A5A5A5u);
        return result;
    });
}

void instances(Rows& r) {
    constexpr const char* kCreate = "suppleCreateInstance";
    r.groups(kCreate, [](World& w, SuppleContext c, SuppleGroup g) {
        return suppleCreateInstance(c, g, w.newHandle<SuppleInstance>());
    });
    r.refuse(kCreate, "out null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleCreateInstance(w.handle(), w.mine.main.group, nullptr); });
    r.add(kCreate, "the group is full", SUPPLE_ERROR_LIMIT, SUPPLE_MESSAGE_LIMIT,
          [](World& w) { return suppleCreateInstance(w.handle(), w.mine.main.group, w.newHandle<SuppleInstance>()); });
    r.instances(
        "suppleDestroyInstance",
        [](World& w, SuppleContext c, SuppleInstance i) {
            const SuppleResult result = suppleDestroyInstance(c, i);
            if (result == SUPPLE_OK) {
                EXPECT_EQ(suppleCreateInstance(c, w.spare.group, &w.spare.instances[0]), SUPPLE_OK);
            }
            return result;
        },
        false);
    r.instances(
        "suppleSetVisible", [](World&, SuppleContext c, SuppleInstance i) { return suppleSetVisible(c, i, 0); }, false);
    for (const uint32_t visible : {2u, ~0u}) {
        r.refuse("suppleSetVisible", "visible " + std::to_string(visible), SUPPLE_MESSAGE_OUT_OF_RANGE,
                 [=](World& w) { return suppleSetVisible(w.handle(), w.instance(), visible); });
    }
    r.instances(
        "suppleSetPartVisible",
        [](World&, SuppleContext c, SuppleInstance i) { return suppleSetPartVisible(c, i, 0, 0); }, false);
    for (const auto& [part, visible] : {std::pair{1u, 0u}, {~0u, 1u}, {0u, 2u}, {0u, ~0u}}) {
        r.refuse("suppleSetPartVisible", "part " + std::to_string(part) + ", visible " + std::to_string(visible),
                 SUPPLE_MESSAGE_OUT_OF_RANGE, [part = part, visible = visible](World& w) {
                     return suppleSetPartVisible(w.handle(), w.instance(), part, visible);
                 });
    }
    r.instances(
        "suppleTeleport", [](World&, SuppleContext c, SuppleInstance i) { return suppleTeleport(c, i); }, false);

    constexpr const char* kClip = "suppleSetClipPose";
    r.instances(
        kClip, [](World&, SuppleContext c, SuppleInstance i) { return suppleSetClipPose(c, i, 0, 0.1); }, true);
    for (const uint32_t clip : {kClips, 0xFFFFFFFDu}) {
        r.refuse(kClip, "clip " + std::to_string(clip), SUPPLE_MESSAGE_OUT_OF_RANGE,
                 [=](World& w) { return suppleSetClipPose(w.handle(), w.instance(), clip, 0.0); });
    }
    for (const double time : {double{kNan}, double{kInfinity}, -double{kInfinity}}) {
        r.refuse(kClip, "time " + std::to_string(time), SUPPLE_MESSAGE_NOT_FINITE,
                 [=](World& w) { return suppleSetClipPose(w.handle(), w.instance(), 0, time); });
    }
    constexpr const char* kMorph = "suppleSetMorphWeights";
    static const float kWeights[kTargets + 1] = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f};
    r.instances(
        kMorph,
        [](World&, SuppleContext c, SuppleInstance i) { return suppleSetMorphWeights(c, i, kWeights, kTargets); },
        true);
    for (const uint32_t count : {0u, kTargets - 1, kTargets + 1}) {
        r.refuse(kMorph, "count " + std::to_string(count), SUPPLE_MESSAGE_OUT_OF_RANGE,
                 [=](World& w) { return suppleSetMorphWeights(w.handle(), w.instance(), kWeights, count); });
    }
    for (const float weight : {kNan, kInfinity}) {
        r.refuse(kMorph, "weight " + std::to_string(weight), SUPPLE_MESSAGE_NOT_FINITE, [=](World& w) {
            const float weights[kTargets] = {0, 0, 0, weight};
            return suppleSetMorphWeights(w.handle(), w.instance(), weights, kTargets);
        });
    }
    r.accept(kMorph, "null", [](World& w) { return suppleSetMorphWeights(w.handle(), w.instance(), nullptr, 77); });

    constexpr const char* kMatrix = "suppleSetMatrixPose";
    static const std::vector<float> kMatrices = [] {
        std::vector<float> matrices;
        for (uint32_t j = 0; j <= kJoints; ++j) {
            matrices.insert(matrices.end(), std::begin(kIdentity), std::end(kIdentity));
        }
        return matrices;
    }();
    r.instances(
        kMatrix,
        [](World&, SuppleContext c, SuppleInstance i) { return suppleSetMatrixPose(c, i, kMatrices.data(), kJoints); },
        true);
    r.refuse(kMatrix, "null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleSetMatrixPose(w.handle(), w.instance(), nullptr, kJoints); });
    for (const uint32_t count : {0u, kJoints - 1, kJoints + 1}) {
        r.refuse(kMatrix, "count " + std::to_string(count), SUPPLE_MESSAGE_OUT_OF_RANGE,
                 [=](World& w) { return suppleSetMatrixPose(w.handle(), w.instance(), kMatrices.data(), count); });
    }
    for (const float value : {kNan, -kInfinity}) {
        r.refuse(kMatrix, "value " + std::to_string(value), SUPPLE_MESSAGE_NOT_FINITE, [=](World& w) {
            std::vector<float> matrices = kMatrices;
            matrices[16 * kJoints - 1] = value;
            return suppleSetMatrixPose(w.handle(), w.instance(), matrices.data(), kJoints);
        });
    }
    constexpr const char* kTransform = "suppleSetTransform";
    r.instances(
        kTransform, [](World&, SuppleContext c, SuppleInstance i) { return suppleSetTransform(c, i, kIdentity); },
        true);
    r.refuse(kTransform, "null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleSetTransform(w.handle(), w.instance(), nullptr); });
    const auto transform = [&](const std::string& what, int at, float value, int message) {
        r.refuse(kTransform, what, message, [=](World& w) {
            float matrix[16];
            std::copy_n(kIdentity, 16, matrix);
            matrix[at] = value;
            return suppleSetTransform(w.handle(), w.instance(), matrix);
        });
    };
    for (const int at : {0, 13, 15}) {
        transform("NaN at " + std::to_string(at), at, kNan, SUPPLE_MESSAGE_NOT_FINITE);
        transform("infinity at " + std::to_string(at), at, kInfinity, SUPPLE_MESSAGE_NOT_FINITE);
    }
    for (const int at : {3, 7, 11, 15}) {
        transform("last row at " + std::to_string(at), at, 0.5f, SUPPLE_MESSAGE_OUT_OF_RANGE);
    }
    constexpr const char* kPosition = "suppleSetPosition";
    static const double kHome[3] = {0, 0, 0}, kNowhere[3] = {0, NAN, 0};
    r.instances(
        kPosition, [](World&, SuppleContext c, SuppleInstance i) { return suppleSetPosition(c, i, kHome); }, true);
    r.refuse(kPosition, "null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleSetPosition(w.handle(), w.instance(), nullptr); });
    r.refuse(kPosition, "NaN", SUPPLE_MESSAGE_NOT_FINITE,
             [](World& w) { return suppleSetPosition(w.handle(), w.instance(), kNowhere); });
    constexpr const char* kUserData = "suppleSetUserData";
    r.instances(
        kUserData, [](World&, SuppleContext c, SuppleInstance i) { return suppleSetUserData(c, i, kIdentity); }, false);
    r.refuse(kUserData, "null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleSetUserData(w.handle(), w.spare.instances[0], nullptr); });
    constexpr const char* kSharp = "suppleSetSharpness";
    r.instancesRefused(kSharp,
                       [](World&, SuppleContext c, SuppleInstance i) { return suppleSetSharpness(c, i, 0, 1.0f); });
    r.refuse(kSharp, "no such crease set", SUPPLE_MESSAGE_OUT_OF_RANGE,
             [](World& w) { return suppleSetSharpness(w.handle(), w.spare.instances[0], 0, 1.0f); });
    constexpr const char* kRead = "suppleReadInstanceBounds";
    const auto read = [](World& w, SuppleContext c, SuppleInstance i) {
        return suppleReadInstanceBounds(c, i, w.plain<SuppleBounds>(), w.plain<uint64_t>());
    };
    r.instancesRefused(kRead, read);
    r.refuse(kRead, "without BOUNDS", SUPPLE_MESSAGE_CONFLICT,
             [=](World& w) { return read(w, w.handle(), w.spare.instances[0]); });
    r.refuse(kRead, "out null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleReadInstanceBounds(w.handle(), w.bounded.instances[0], nullptr, nullptr); });
    r.add(kRead, "never recorded", SUPPLE_NOT_READY, kSilent,
          [=](World& w) { return read(w, w.handle(), w.bounded.instances[0]); });
    constexpr const char* kSocket = "suppleGetJointTransform";
    r.instances(
        kSocket,
        [](World& w, SuppleContext c, SuppleInstance i) {
            return suppleGetJointTransform(c, i, 0, w.plain<float>(16));
        },
        true);
    r.refuse(kSocket, "out null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleGetJointTransform(w.handle(), w.instance(), 0, nullptr); });
    for (const uint32_t joint : {kJoints, SUPPLE_NO_JOINT}) {
        r.refuse(kSocket, "joint " + std::to_string(joint), SUPPLE_MESSAGE_OUT_OF_RANGE, [=](World& w) {
            return suppleGetJointTransform(w.handle(), w.instance(), joint, w.plain<float>(16));
        });
    }
    for (const Phase phase : {Phase::fresh, Phase::recorded, Phase::cancelled}) {
        for (SmallGroup World::*const group : {&World::spare, &World::played}) {
            r.accept(
                kSocket, "in phase " + std::to_string(static_cast<int>(phase)),
                [=](World& w) {
                    float transform[16];
                    return suppleGetJointTransform(w.handle(), (w.*group).instances[0], kJoints - 1, transform);
                },
                phase);
        }
    }
}

void poses(Rows& r) {
    constexpr const char* kSet = "suppleSetPose";
    constexpr const char* kMotion = "suppleGetRootMotion";
    r.instances(
        kSet,
        [](World& w, SuppleContext c, SuppleInstance i) {
            const SupplePoseDesc desc = w.poseDesc();
            return suppleSetPose(c, i, &desc);
        },
        true);
    r.assets(kMotion, [](World& w, SuppleContext c, SuppleAsset a) {
        const SupplePoseDesc desc = w.poseDesc();
        return suppleGetRootMotion(c, a, &desc, w.watched<SuppleRootMotion>(sizeof(SuppleRootMotion)));
    });
    r.output<SuppleRootMotion>(kMotion, [](World& w, SuppleRootMotion* out) {
        const SupplePoseDesc desc = w.poseDesc();
        return suppleGetRootMotion(w.handle(), w.mine.asset, &desc, out);
    });
    const auto make = [](World& w) { return w.poseDesc(); };
    // A wrong pose goes to an instance that is looked at, a good one elsewhere.
    r.description<SupplePoseDesc>(kSet, "pose", make, [](World& w, const SupplePoseDesc* pose) {
        return suppleSetPose(w.handle(), w.spare.instances[0], pose);
    });
    const auto motion = [](World& w, const SupplePoseDesc* pose) {
        return suppleGetRootMotion(w.handle(), w.mine.asset, pose,
                                   w.watched<SuppleRootMotion>(sizeof(SuppleRootMotion)));
    };
    r.description<SupplePoseDesc>(kMotion, "pose", make, motion);
    const auto pose = [&](const char* what, int message, const std::function<void(SupplePoseDesc&)>& spoil,
                          const std::function<void(SuppleClipLayer&)>& spoilLayer = {}) {
        const auto spoiled = [=](World& w) {
            SupplePoseDesc desc = w.poseDesc(spoilLayer);
            if (spoil) {
                spoil(desc);
            }
            return desc;
        };
        r.refuse(kSet, what, message, [=](World& w) {
            const SupplePoseDesc desc = spoiled(w);
            return suppleSetPose(w.handle(), w.instance(), &desc);
        });
        r.refuse(kMotion, what, message, [=](World& w) {
            const SupplePoseDesc desc = spoiled(w);
            return motion(w, &desc);
        });
    };
    using Desc = SupplePoseDesc;
    using Layer = SuppleClipLayer;
    constexpr int kRange = SUPPLE_MESSAGE_OUT_OF_RANGE, kFinite = SUPPLE_MESSAGE_NOT_FINITE;
    pose("layers null", SUPPLE_MESSAGE_NULL_POINTER, [](Desc& d) { d.layers = nullptr; });
    pose("flags", kRange, [](Desc& d) { d.flags = 2; });
    pose("rootMotion", kRange, [](Desc& d) { d.rootMotion = 8; });
    pose("rootJoint", kRange, [](Desc& d) {
        d.flags = SUPPLE_POSE_ROOT_JOINT;
        d.rootJoint = kJoints;
    });
    const auto layer = [&](const char* what, int message, const std::function<void(Layer&)>& spoil) {
        pose(what, message, {}, spoil);
    };
    static const float kOutside[] = {0.5f, 0.5f, 1.5f, 0.5f, 0.5f}, kNans[] = {0.5f, 0.5f, kNan, 0.5f, 0.5f},
                       kHalf[] = {0.5f, 0.5f, 0.5f, 0.5f, 0.5f};
    layer("clip", kRange, [](Layer& l) { l.clip = kClips; });
    layer("rest pose for a clip", kRange, [](Layer& l) { l.clip = SUPPLE_REST_POSE; });
    layer("mode 2", kRange, [](Layer& l) { l.mode = static_cast<SuppleLayerMode>(2); });
    layer("mode -1", kRange, [](Layer& l) { l.mode = static_cast<SuppleLayerMode>(-1); });
    layer("layer flags", kRange, [](Layer& l) { l.flags = 2; });
    layer("time", kFinite, [](Layer& l) { l.time = double{kNan}; });
    layer("previousTime", kFinite, [](Layer& l) { l.previousTime = double{kInfinity}; });
    layer("referenceTime", kFinite, [](Layer& l) { l.referenceTime = -double{kInfinity}; });
    layer("weight NaN", kFinite, [](Layer& l) { l.weight = kNan; });
    layer("weight infinite", kFinite, [](Layer& l) {
        l.mode = SUPPLE_LAYER_ADDITIVE;
        l.weight = kInfinity;
    });
    layer("weight above", kRange, [](Layer& l) { l.weight = 1.01f; });
    layer("weight below", kRange, [](Layer& l) { l.weight = -0.01f; });
    const auto mask = [&](const std::string& what, const float* values, bool joints, uint32_t count) {
        layer(what.c_str(), kRange, [=](Layer& l) {
            (joints ? l.jointMask : l.morphMask) = values;
            (joints ? l.jointMaskCount : l.morphMaskCount) = count;
        });
    };
    for (const bool joints : {true, false}) {
        const std::string name = joints ? "jointMask" : "morphMask";
        const uint32_t count = joints ? kJoints : kTargets;
        mask(name + " null", nullptr, joints, count);
        mask(name + " too short", kHalf, joints, count - 1);
        mask(name + " too long", kHalf, joints, count + 1);
        mask(name + " outside", kOutside, joints, count);
        mask(name + " NaN", kNans, joints, count);
    }
}

void modifiers(Rows& r) {
    constexpr const char *kSet = "suppleSetModifiers", *kTarget = "suppleSetModifierTarget";
    constexpr int kRange = SUPPLE_MESSAGE_OUT_OF_RANGE, kFinite = SUPPLE_MESSAGE_NOT_FINITE,
                  kNull = SUPPLE_MESSAGE_NULL_POINTER, kConflict = SUPPLE_MESSAGE_CONFLICT;
    r.instances(
        kSet,
        [](World& w, SuppleContext c, SuppleInstance i) {
            const SuppleModifiersDesc desc = w.modifiersDesc();
            return suppleSetModifiers(c, i, &desc);
        },
        false, &World::modified);
    r.description<SuppleModifiersDesc>(
        kSet, "modifiers", [](World& w) { return w.modifiersDesc(); },
        [](World& w, const SuppleModifiersDesc* desc) {
            return suppleSetModifiers(w.handle(), w.modified.instances[0], desc);
        });
    for (SmallGroup World::*const other : {&World::spare, &World::buffered, &World::played}) {
        r.refuse(kSet, "another group", kConflict, [=](World& w) {
            const SuppleModifiersDesc desc = w.modifiersDesc();
            return suppleSetModifiers(w.handle(), (w.*other).instances[0], &desc);
        });
    }
    const auto spoiled = [&](const char* what, int message, const std::function<void(SuppleModifiersDesc&)>& spoil,
                             const std::function<void(SuppleModifier&)>& spoilOne = {}) {
        r.refuse(kSet, what, message, [=](World& w) {
            SuppleModifiersDesc desc = w.modifiersDesc(spoilOne);
            if (spoil) {
                spoil(desc);
            }
            return suppleSetModifiers(w.handle(), w.modified.instances[0], &desc);
        });
    };
    spoiled("modifiers null", kNull, [](SuppleModifiersDesc& d) { d.modifiers = nullptr; });
    spoiled("too many", kRange, [](SuppleModifiersDesc& d) { d.modifierCount = SUPPLE_MAX_MODIFIERS + 1; });
    using One = SuppleModifier;
    const auto one = [&](const char* what, int message, const std::function<void(One&)>& spoil) {
        spoiled(what, message, {}, spoil);
    };
    one("kind 5", kRange, [](One& m) { m.kind = static_cast<SuppleModifierKind>(5); });
    one("kind -1", kRange, [](One& m) { m.kind = static_cast<SuppleModifierKind>(-1); });
    one("flags", kRange, [](One& m) { m.flags = 16; });
    one("flags of another kind", kRange, [](One& m) { m.flags = SUPPLE_MODIFIER_POLE; });
    one("joint", kRange, [](One& m) { m.joint = kJoints; });
    one("a limb that leaves the skeleton", kRange, [](One& m) { m.kind = SUPPLE_MODIFIER_TWO_BONE; });
    one("a chain that leaves the skeleton", kRange, [](One& m) {
        m.kind = SUPPLE_MODIFIER_AIM;
        m.chainLength = 3;
    });
    one("a chain that is too long", kRange, [](One& m) {
        m.kind = SUPPLE_MODIFIER_AIM;
        m.chainLength = SUPPLE_MAX_AIM_JOINTS + 1;
    });
    one("a rotation of zeros", kRange, [](One& m) { m.rotation[3] = 0.0f; });
    one("rotation NaN", kFinite, [](One& m) { m.rotation[1] = kNan; });
    one("target infinite", kFinite, [](One& m) { m.target[2] = double{kInfinity}; });
    one("pole NaN", kFinite, [](One& m) { m.pole[0] = double{kNan}; });
    one("axis infinite", kFinite, [](One& m) { m.axis[0] = kInfinity; });
    one("offset NaN", kFinite, [](One& m) { m.offset[0] = kNan; });
    for (float One::*const part : {&One::weight, &One::fadeWeight, &One::share, &One::poleWeight}) {
        one("a part NaN", kFinite, [=](One& m) { m.*part = kNan; });
        one("a part above", kRange, [=](One& m) { m.*part = 1.01f; });
        one("a part below", kRange, [=](One& m) { m.*part = -0.01f; });
    }
    one("fadeDuration negative", kRange, [](One& m) { m.fadeDuration = -1.0f; });
    one("limit negative", kRange, [](One& m) { m.limit = -0.1f; });
    one("soft below", kRange, [](One& m) { m.soft = 0.4f; });
    one("soft above", kRange, [](One& m) { m.soft = 1.0f; });
    one("fadeStart too far", kRange, [](One& m) { m.fadeStart = 1.001 * SUPPLE_MAX_TIME; });

    constexpr const char* kMatrices = "suppleSetJointMatrices";
    r.instances(
        kMatrices,
        [](World&, SuppleContext c, SuppleInstance i) {
            const SuppleJointMatricesDesc desc = World::matricesDesc();
            return suppleSetJointMatrices(c, i, &desc);
        },
        true);
    r.description<SuppleJointMatricesDesc>(
        kMatrices, "matrices", [](World&) { return World::matricesDesc(); },
        [](World& w, const SuppleJointMatricesDesc* desc) {
            return suppleSetJointMatrices(w.handle(), w.spare.instances[0], desc);
        });
    const auto matrices = [&](const char* what, int message,
                              const std::function<void(SuppleJointMatricesDesc&)>& change) {
        r.refuse(kMatrices, what, message, [=](World& w) {
            SuppleJointMatricesDesc desc = World::matricesDesc();
            change(desc);
            return suppleSetJointMatrices(w.handle(), w.spare.instances[0], &desc);
        });
    };
    using Matrices = SuppleJointMatricesDesc;
    matrices("matrices null", kNull, [](Matrices& d) { d.jointMatrices = nullptr; });
    matrices("not all joints", kRange, [](Matrices& d) { d.joints = nullptr; });
    matrices("too many joints", kRange, [](Matrices& d) { d.jointCount = kJoints + 1; });
    static constexpr uint32_t kTwice[] = {1, 1}, kBeyond[] = {0, kJoints};
    matrices("a joint twice", kRange, [](Matrices& d) { d.joints = kTwice; });
    matrices("no such joint", kRange, [](Matrices& d) { d.joints = kBeyond; });
    matrices("a count of weights without weights", kRange, [](Matrices& d) { d.morphTargetCount = 1; });
    static const std::vector<float> kNanMatrices(32, kNan);
    matrices("NaN", kFinite, [](Matrices& d) { d.jointMatrices = kNanMatrices.data(); });

    const auto target = [](World& w, uint32_t index, const SuppleModifierTarget* to) {
        const SuppleModifiersDesc desc = w.modifiersDesc();
        const SuppleResult set = suppleSetModifiers(w.handle(), w.modified.instances[0], &desc);
        return set != SUPPLE_OK ? set : suppleSetModifierTarget(w.handle(), w.modified.instances[0], index, to);
    };
    r.instances(
        kTarget,
        [=](World& w, SuppleContext c, SuppleInstance i) {
            const SuppleModifierTarget to = World::modifierTarget();
            const SuppleModifiersDesc desc = w.modifiersDesc();
            const SuppleResult set = suppleSetModifiers(w.handle(), w.modified.instances[0], &desc);
            return set != SUPPLE_OK ? set : suppleSetModifierTarget(c, i, 1, &to);
        },
        false, &World::modified);
    r.description<SuppleModifierTarget>(
        kTarget, "target", [](World&) { return World::modifierTarget(); },
        [=](World& w, const SuppleModifierTarget* to) { return target(w, 0, to); });
    const auto spoil = [&](const char* what, int message, uint32_t index,
                           const std::function<void(SuppleModifierTarget&)>& change) {
        r.refuse(kTarget, what, message, [=](World& w) {
            SuppleModifierTarget to = World::modifierTarget();
            change(to);
            return target(w, index, &to);
        });
    };
    spoil("no such modifier", kRange, 2, [](SuppleModifierTarget&) {});
    spoil("weight NaN", kFinite, 0, [](SuppleModifierTarget& t) { t.weight = kNan; });
    spoil("weight above", kRange, 0, [](SuppleModifierTarget& t) { t.weight = 1.5f; });
    spoil("target NaN", kFinite, 0, [](SuppleModifierTarget& t) { t.target[0] = double{kNan}; });
    spoil("pole infinite", kFinite, 0, [](SuppleModifierTarget& t) { t.pole[2] = double{kInfinity}; });
    spoil("a rotation of zeros", kRange, 0, [](SuppleModifierTarget& t) { t.rotation[0] = 0.0f; });
}

void playback(Rows& r) {
    constexpr const char* kSet = "suppleSetPlayback";
    constexpr const char* kTime = "suppleSetTime";
    constexpr const char* kMask = "suppleSetMask";
    constexpr int kRange = SUPPLE_MESSAGE_OUT_OF_RANGE, kFinite = SUPPLE_MESSAGE_NOT_FINITE,
                  kNull = SUPPLE_MESSAGE_NULL_POINTER, kConflict = SUPPLE_MESSAGE_CONFLICT;
    r.instances(
        kSet,
        [](World& w, SuppleContext c, SuppleInstance i) {
            const SupplePlaybackDesc desc = w.playbackDesc();
            return suppleSetPlayback(c, i, &desc);
        },
        false, &World::played);
    const auto set = [](World& w, const SupplePlaybackDesc* desc) {
        return suppleSetPlayback(w.handle(), w.played.instances[0], desc);
    };
    r.description<SupplePlaybackDesc>(
        kSet, "playback", [](World& w) { return w.playbackDesc(); }, set);
    for (SmallGroup World::*const other : {&World::spare, &World::buffered}) {
        r.refuse(kSet, "poses from elsewhere", kConflict, [=](World& w) {
            const SupplePlaybackDesc desc = w.playbackDesc();
            return suppleSetPlayback(w.handle(), (w.*other).instances[0], &desc);
        });
    }
    using Desc = SupplePlaybackDesc;
    using Layer = SupplePlaybackLayer;
    const auto spoiled = [&](const char* what, int message, const std::function<void(Desc&)>& spoil,
                             const std::function<void(Layer&)>& spoilLayer = {}) {
        r.refuse(kSet, what, message, [=](World& w) {
            Desc desc = w.playbackDesc(spoilLayer);
            if (spoil) {
                spoil(desc);
            }
            return set(w, &desc);
        });
    };
    spoiled("layers null", kNull, [](Desc& d) { d.layers = nullptr; });
    spoiled("too many layers", kRange, [](Desc& d) { d.layerCount = SUPPLE_MAX_PLAYBACK_LAYERS + 1; });
    spoiled("flags", kRange, [](Desc& d) { d.flags = 16; });
    spoiled("rootMotion", kRange, [](Desc& d) { d.rootMotion = 8; });
    spoiled("rootJoint", kRange, [](Desc& d) {
        d.flags = SUPPLE_PLAYBACK_ROOT_JOINT;
        d.rootJoint = kJoints;
    });
    spoiled("travel by nothing", kConflict, [](Desc& d) { d.flags = SUPPLE_PLAYBACK_TRAVEL; });
    spoiled("a transition without room for it", kConflict, [](Desc& d) { d.transition = 0.3; });
    spoiled("transition NaN", kFinite, [](Desc& d) { d.transition = double{kNan}; });
    spoiled("transition negative", kRange, [](Desc& d) { d.transition = -0.1; });
    spoiled("transition too long", kRange, [](Desc& d) { d.transition = 1.001 * SUPPLE_MAX_TIME; });
    spoiled("kind of transition 2", kRange, [](Desc& d) { d.transitionKind = static_cast<SuppleTransitionKind>(2); });
    spoiled("from modified without a transition", kConflict, [](Desc& d) { d.flags = SUPPLE_PLAYBACK_FROM_MODIFIED; });
    const auto transits = [&](uint32_t flags) {
        return [flags](World& w) {
            Desc desc = w.playbackDesc();
            desc.flags = flags;
            desc.transition = 0.3;
            return suppleSetPlayback(w.handle(), w.modified.instances[0], &desc);
        };
    };
    spoiled("updateInterval 3", kRange, [](Desc& d) { d.updateInterval = 3; });
    spoiled("updateInterval 16", kRange, [](Desc& d) { d.updateInterval = 16; });
    spoiled("an updateInterval without room for it", kConflict, [](Desc& d) { d.updateInterval = 2; });
    r.accept(kSet, "an updateInterval", [](World& w) {
        Desc desc = w.playbackDesc();
        desc.updateInterval = 8;
        return suppleSetPlayback(w.handle(), w.modified.instances[0], &desc);
    });
    r.accept(kSet, "a transition", transits(SUPPLE_PLAYBACK_FROM_MODIFIED));
    r.refuse(kSet, "a transition that keeps another", kConflict, transits(SUPPLE_PLAYBACK_KEEP_TRANSITION));
    const auto layer = [&](const char* what, int message, const std::function<void(Layer&)>& spoil) {
        spoiled(what, message, {}, spoil);
    };
    layer("clip", kRange, [](Layer& l) { l.clip = kClips; });
    layer("bind pose for a clip", kRange, [](Layer& l) { l.clip = SUPPLE_BIND_POSE; });
    layer("mode 2", kRange, [](Layer& l) { l.mode = static_cast<SuppleLayerMode>(2); });
    layer("mode -1", kRange, [](Layer& l) { l.mode = static_cast<SuppleLayerMode>(-1); });
    layer("layer flags", kRange, [](Layer& l) { l.flags = 2; });
    layer("mask never set", kRange, [](Layer& l) { l.mask = 1; });
    layer("mask", kRange, [](Layer& l) { l.mask = SUPPLE_MAX_MASKS + 1; });
    layer("weight NaN", kFinite, [](Layer& l) { l.weight = kNan; });
    layer("fadeWeight infinite", kFinite, [](Layer& l) {
        l.mode = SUPPLE_LAYER_ADDITIVE;
        l.fadeWeight = kInfinity;
    });
    layer("weight above", kRange, [](Layer& l) { l.weight = 1.01f; });
    layer("fadeWeight below", kRange, [](Layer& l) { l.fadeWeight = -0.01f; });
    layer("speed NaN", kFinite, [](Layer& l) { l.speed = kNan; });
    layer("speed above", kRange, [](Layer& l) { l.speed = 1000.1f; });
    layer("speed below", kRange, [](Layer& l) { l.speed = -1000.1f; });
    layer("fadeDuration infinite", kFinite, [](Layer& l) { l.fadeDuration = kInfinity; });
    layer("fadeDuration negative", kRange, [](Layer& l) { l.fadeDuration = -1.0f; });
    for (double Layer::*const time : {&Layer::startTime, &Layer::offset, &Layer::fadeStart, &Layer::referenceTime}) {
        layer("a time NaN", kFinite, [=](Layer& l) { l.*time = double{kNan}; });
        layer("a time infinite", kFinite, [=](Layer& l) { l.*time = -double{kInfinity}; });
        layer("a time too far", kRange, [=](Layer& l) { l.*time = 1.001 * SUPPLE_MAX_TIME; });
    }

    r.groups(kTime, [](World&, SuppleContext c, SuppleGroup g) { return suppleSetTime(c, g, 1.0); });
    r.accept(kTime, "valid", [](World& w) { return suppleSetTime(w.handle(), w.played.group, -SUPPLE_MAX_TIME); });
    const auto time = [&](const char* what, int message, double value) {
        r.refuse(kTime, what, message, [=](World& w) { return suppleSetTime(w.handle(), w.played.group, value); });
    };
    time("NaN", kFinite, double{kNan});
    time("infinite", kFinite, double{kInfinity});
    time("too far", kRange, 1.001 * SUPPLE_MAX_TIME);
    time("too far back", kRange, -1.001 * SUPPLE_MAX_TIME);
    r.refuse(kTime, "poses from elsewhere", kConflict,
             [](World& w) { return suppleSetTime(w.handle(), w.spare.group, 1.0); });

    r.groups(kMask, [](World& w, SuppleContext c, SuppleGroup g) {
        const SuppleMaskDesc desc = w.maskDesc();
        return suppleSetMask(c, g, &desc);
    });
    const auto mask = [](World& w, const SuppleMaskDesc* desc) {
        return suppleSetMask(w.handle(), w.played.group, desc);
    };
    r.description<SuppleMaskDesc>(
        kMask, "mask", [](World& w) { return w.maskDesc(); }, mask);
    r.refuse(kMask, "poses from elsewhere", kConflict, [](World& w) {
        const SuppleMaskDesc desc = w.maskDesc();
        return suppleSetMask(w.handle(), w.buffered.group, &desc);
    });
    const auto wrong = [&](const char* what, int message, const std::function<void(SuppleMaskDesc&)>& spoil) {
        r.refuse(kMask, what, message, [=](World& w) {
            SuppleMaskDesc desc = w.maskDesc();
            spoil(desc);
            return mask(w, &desc);
        });
    };
    static const float kOutside[] = {0.5f, 0.5f, 1.5f, 0.5f}, kNans[] = {0.5f, kNan, 0.5f, 0.5f};
    wrong("number 0", kRange, [](SuppleMaskDesc& d) { d.mask = 0; });
    wrong("number", kRange, [](SuppleMaskDesc& d) { d.mask = SUPPLE_MAX_MASKS + 1; });
    wrong("both null", kNull, [](SuppleMaskDesc& d) {
        d.jointMask = d.morphMask = nullptr;
        d.jointMaskCount = d.morphMaskCount = 0;
    });
    wrong("jointMask null with a count", kRange, [](SuppleMaskDesc& d) { d.jointMask = nullptr; });
    wrong("morphMask null with a count", kRange, [](SuppleMaskDesc& d) { d.morphMask = nullptr; });
    wrong("jointMask too short", kRange, [](SuppleMaskDesc& d) { d.jointMaskCount = kJoints - 1; });
    wrong("morphMask too long", kRange, [](SuppleMaskDesc& d) { d.morphMaskCount = kTargets + 1; });
    wrong("jointMask outside", kRange, [](SuppleMaskDesc& d) { d.jointMask = kOutside; });
    wrong("morphMask NaN", kRange, [](SuppleMaskDesc& d) { d.morphMask = kNans; });
}

void frames(Rows& r) {
    constexpr const char* kBegin = "suppleBeginFrame";
    constexpr int kOrder = SUPPLE_MESSAGE_OUT_OF_ORDER, kRange = SUPPLE_MESSAGE_OUT_OF_RANGE;
    r.nullContext(kBegin, [](World& w, SuppleContext c) { return suppleBeginFrame(c, w.own.frame + 1, w.own.frame); });
    const auto begin = [&](const char* what, int message, Phase phase, auto frame, auto completed) {
        r.refuse(
            kBegin, what, message,
            [=](World& w) { return suppleBeginFrame(w.handle(), frame(w.own.frame), completed(w.own.frame)); }, phase);
    };
    const auto next = [](uint64_t f) { return f + 1; };
    const auto same = [](uint64_t f) { return f; };
    const auto zero = [](uint64_t) { return uint64_t{0}; };
    begin("frame 0", kOrder, Phase::fresh, zero, zero);
    for (const Phase phase : {Phase::begun, Phase::recorded, Phase::cancelled}) {
        begin("the same frame", kOrder, phase, same, [](uint64_t f) { return f - 1; });
        begin(
            "an earlier frame", kOrder, phase, [](uint64_t f) { return f - 1; }, [](uint64_t f) { return f - 2; });
        begin("completed itself", kRange, phase, next, next);
        begin("completed later", kRange, phase, next, [](uint64_t f) { return f + 2; });
        begin("completed last of all", kRange, phase, next, [](uint64_t) { return ~0ull; });
        begin("too many in flight", kRange, phase, next, [](uint64_t f) { return f - 2; });
        begin(
            "too far ahead", kRange, phase, [](uint64_t f) { return f + 3; }, same);
    }

    constexpr const char* kOrigin = "suppleSetOrigin";
    static const double kHome[3] = {0, 0, 0}, kNowhere[3] = {0, NAN, 0};
    r.nullContext(kOrigin, [](World&, SuppleContext c) { return suppleSetOrigin(c, kHome); });
    r.refuse(kOrigin, "null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleSetOrigin(w.handle(), nullptr); });
    r.refuse(kOrigin, "NaN", SUPPLE_MESSAGE_NOT_FINITE, [](World& w) { return suppleSetOrigin(w.handle(), kNowhere); });
    r.accept(kOrigin, "as it is", [](World& w) { return suppleSetOrigin(w.handle(), kHome); });

    constexpr const char* kCancel = "suppleCancelFrame";
    r.nullContext(kCancel, [](World&, SuppleContext c) { return suppleCancelFrame(c); });
    for (const Phase phase : {Phase::fresh, Phase::cancelled}) {
        r.refuse(
            kCancel, "no frame", kOrder, [](World& w) { return suppleCancelFrame(w.handle()); }, phase);
    }

    constexpr const char* kUploads = "suppleRecordUploads";
    r.nullContext(kUploads, [](World& w, SuppleContext c) { return suppleRecordUploads(c, w.commands); });
    r.refuse(kUploads, "commandBuffer null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleRecordUploads(w.handle(), VK_NULL_HANDLE); });
    for (const Phase phase : {Phase::fresh, Phase::cancelled}) {
        r.refuse(
            kUploads, "no frame", kOrder, [](World& w) { return suppleRecordUploads(w.handle(), w.commands); }, phase);
    }
    for (const Phase phase : {Phase::begun, Phase::recorded}) {
        r.accept(
            kUploads, "valid", [](World& w) { return suppleRecordUploads(w.handle(), w.commands); }, phase);
    }

    constexpr const char* kWarmUp = "suppleRecordWarmUp";
    r.refuse(kWarmUp, "commandBuffer null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleRecordWarmUp(w.handle(), VK_NULL_HANDLE, &w.mine.main.group, 1); });
    r.refuse(kWarmUp, "groups null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleRecordWarmUp(w.handle(), w.commands, nullptr, 1); });
    for (const Phase phase : {Phase::fresh, Phase::cancelled}) {
        r.refuse(
            kWarmUp, "no frame", kOrder,
            [](World& w) { return suppleRecordWarmUp(w.handle(), w.commands, &w.mine.main.group, 1); }, phase);
    }
    r.groups(kWarmUp, [](World& w, SuppleContext c, SuppleGroup g) {
        const SuppleGroup second[2] = {w.mine.main.group, g};
        return suppleRecordWarmUp(c, w.commands, *w.kept(second), 2);
    });
    for (const Phase phase : {Phase::begun, Phase::recorded}) {
        r.accept(
            kWarmUp, "valid",
            [](World& w) { return suppleRecordWarmUp(w.handle(), w.commands, &w.mine.main.group, 1); }, phase);
    }

    constexpr const char* kRecord = "suppleRecord";
    const auto record = [](World& w, const SuppleRecordDesc* desc) {
        const SuppleResult result = suppleRecord(w.handle(), w.commands, desc);
        w.recorded = result == SUPPLE_OK;
        return result;
    };
    r.nullContext(kRecord, [](World& w, SuppleContext c) {
        const SuppleRecordDesc desc = w.recordDesc();
        return suppleRecord(c, w.commands, &desc);
    });
    r.refuse(kRecord, "commandBuffer null", SUPPLE_MESSAGE_NULL_POINTER, [](World& w) {
        const SuppleRecordDesc desc = w.recordDesc();
        return suppleRecord(w.handle(), VK_NULL_HANDLE, &desc);
    });
    r.description<SuppleRecordDesc>(
        kRecord, "desc", [](World& w) { return w.recordDesc(); }, record);
    const auto spoiled = [&](const char* what, int message, Phase phase,
                             const std::function<void(World&, SuppleRecordDesc&)>& spoil) {
        r.refuse(
            kRecord, what, message,
            [=](World& w) {
                SuppleRecordDesc desc = w.recordDesc();
                if (spoil) {
                    spoil(w, desc);
                }
                return record(w, &desc);
            },
            phase);
    };
    spoiled("groups null", SUPPLE_MESSAGE_NULL_POINTER, Phase::begun,
            [](World&, SuppleRecordDesc& d) { d.groups = nullptr; });
    spoiled("flags", kRange, Phase::begun, [](World&, SuppleRecordDesc& d) { d.flags = 4; });
    spoiled("a group twice", SUPPLE_MESSAGE_CONFLICT, Phase::begun, [](World& w, SuppleRecordDesc& d) {
        const SuppleGroup twice[2] = {w.mine.main.group, w.mine.main.group};
        d.groups = *w.kept(twice);
    });
    spoiled("no frame", kOrder, Phase::fresh, {});
    spoiled("a cancelled frame", kOrder, Phase::cancelled, {});
    spoiled("twice in a frame", kOrder, Phase::recorded, {});
    spoiled("one of two twice in a frame", kOrder, Phase::recorded, [](World& w, SuppleRecordDesc& d) {
        const SuppleGroup some[2] = {w.spare.group, w.mine.main.group};
        d.groups = *w.kept(some);
    });
    r.groups(
        kRecord,
        [=](World& w, SuppleContext, SuppleGroup g) {
            SuppleRecordDesc desc = w.recordDesc();
            const SuppleGroup second[2] = {w.mine.main.group, g}; // nothing of the first is recorded either
            desc.groups = *w.kept(second);
            return record(w, &desc);
        },
        false);

    constexpr const char* kAcquire = "suppleGetAcquireBarriers";
    const auto acquire = [](World& w, SuppleContext c, const SuppleGroup* groups, uint32_t count) {
        return suppleGetAcquireBarriers(c, groups, count, kAnyUse, w.plain<VkBufferMemoryBarrier2>(20), w.number(20));
    };
    r.nullContext(kAcquire, [=](World& w, SuppleContext c) { return acquire(w, c, w.frameGroups(), 2); });
    r.refuse(
        kAcquire, "count null", SUPPLE_MESSAGE_NULL_POINTER,
        [](World& w) {
            return suppleGetAcquireBarriers(w.handle(), w.frameGroups(), 2, kAnyUse,
                                            w.plain<VkBufferMemoryBarrier2>(20), nullptr);
        },
        Phase::recorded);
    r.refuse(
        kAcquire, "groups null", SUPPLE_MESSAGE_NULL_POINTER,
        [=](World& w) { return acquire(w, w.handle(), nullptr, 2); }, Phase::recorded);
    for (const Phase phase : {Phase::fresh, Phase::begun, Phase::cancelled}) {
        r.refuse(
            kAcquire, "not recorded", kOrder, [=](World& w) { return acquire(w, w.handle(), w.frameGroups(), 2); },
            phase);
    }
    r.refuse(
        kAcquire, "one of two not recorded", kOrder,
        [=](World& w) {
            const SuppleGroup some[2] = {w.mine.main.group, w.spare.group};
            return acquire(w, w.handle(), some, 2);
        },
        Phase::recorded);
    r.refuse(kAcquire, "without the flag", SUPPLE_MESSAGE_CONFLICT,
             [=](World& w) { return acquire(w, w.foreign.handle(), &w.theirs.main.group, 1); });
    r.groups(
        kAcquire,
        [=](World& w, SuppleContext c, SuppleGroup g) {
            const SuppleGroup second[2] = {w.mine.main.group, g};
            return acquire(w, c, second, 2);
        },
        false, Phase::recorded);
    r.add(
        kAcquire, "short array", SUPPLE_INCOMPLETE, kSilent,
        [](World& w) {
            return suppleGetAcquireBarriers(w.handle(), w.frameGroups(), 2, kAnyUse, w.plain<VkBufferMemoryBarrier2>(1),
                                            w.number(1));
        },
        Phase::recorded);
    r.accept(
        kAcquire, "count alone",
        [](World& w) {
            return suppleGetAcquireBarriers(w.handle(), w.frameGroups(), 2, kAnyUse, nullptr, w.number(0));
        },
        Phase::recorded);
}

void measurements(Rows& r) {
    constexpr const char* kTimings = "suppleGetTimings";
    r.nullContext(kTimings, [](World& w, SuppleContext c) {
        return suppleGetTimings(c, sizeof(SuppleTiming), w.plain<SuppleTiming>(2), w.number(2));
    });
    r.refuse(kTimings, "count null", SUPPLE_MESSAGE_NULL_POINTER, [](World& w) {
        return suppleGetTimings(w.handle(), sizeof(SuppleTiming), w.plain<SuppleTiming>(2), nullptr);
    });
    for (const Phase phase : {Phase::fresh, Phase::begun}) {
        r.add(
            kTimings, "nothing timed", SUPPLE_NOT_READY, kSilent,
            [](World& w) {
                uint32_t count = 2;
                auto* const out = w.plain<SuppleTiming>(2);
                const SuppleResult result = suppleGetTimings(w.handle(), sizeof(SuppleTiming), out, &count);
                EXPECT_EQ(count, 0u);
                EXPECT_EQ(out->group.id, 0xA5A5A5A5A5A5A5A5ull);
                return result;
            },
            phase);
    }
    for (const size_t size : {size_t{0}, sizeof(SuppleTiming) - 8, sizeof(SuppleTiming) + 4, size_t{1} << 20}) {
        r.refuse(kTimings, "timingSize " + std::to_string(size), SUPPLE_MESSAGE_STRUCT_SIZE, [=](World& w) {
            return suppleGetTimings(w.handle(), static_cast<uint32_t>(size), w.plain<SuppleTiming>(2), w.number(2));
        });
    }
    r.accept("suppleGetPassName", "", [](World&) {
        EXPECT_STREQ(suppleGetPassName(SUPPLE_PASS_UPLOAD), "upload");
        EXPECT_STREQ(suppleGetPassName(SUPPLE_PASS_MOTION), "motion");
        EXPECT_STREQ(suppleGetPassName(SUPPLE_PASS_MAX_ENUM), "unknown SupplePass");
        return SUPPLE_OK;
    });
    constexpr const char* kOrigin = "suppleGetTimingOrigin";
    r.nullContext(kOrigin, [](World& w, SuppleContext c) { return suppleGetTimingOrigin(c, w.plain<uint64_t>(1)); });
    r.refuse(kOrigin, "ticks null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleGetTimingOrigin(w.handle(), nullptr); });
    r.add(kOrigin, "nothing timed", SUPPLE_NOT_READY, kSilent, [](World& w) {
        auto* const ticks = w.plain<uint64_t>(1);
        const SuppleResult result = suppleGetTimingOrigin(w.handle(), ticks);
        EXPECT_EQ(*ticks, 0u);
        return result;
    });
    constexpr const char* kSet = "suppleSetBudget";
    constexpr const char* kGet = "suppleGetBudget";
    r.nullContext(kSet, [](World&, SuppleContext c) { return suppleSetBudget(c, SUPPLE_PASS_DEFORM, 1.0); });
    for (const double value : {double{kNan}, double{kInfinity}, -double{kInfinity}}) {
        r.refuse(kSet, "nanoseconds " + std::to_string(value), SUPPLE_MESSAGE_NOT_FINITE,
                 [=](World& w) { return suppleSetBudget(w.handle(), SUPPLE_PASS_DEFORM, value); });
    }
    r.refuse(kSet, "nanoseconds negative", SUPPLE_MESSAGE_OUT_OF_RANGE,
             [](World& w) { return suppleSetBudget(w.handle(), SUPPLE_PASS_DEFORM, -1.0); });
    for (const SupplePass pass : {SUPPLE_PASS_SHORTFALL, SUPPLE_PASS_MAX_ENUM}) {
        r.refuse(kSet, "pass " + std::to_string(pass), SUPPLE_MESSAGE_OUT_OF_RANGE,
                 [=](World& w) { return suppleSetBudget(w.handle(), pass, 1.0); });
        r.refuse(kGet, "pass " + std::to_string(pass), SUPPLE_MESSAGE_OUT_OF_RANGE, [=](World& w) {
            return suppleGetBudget(w.handle(), pass, w.watched<SuppleBudget>(sizeof(SuppleBudget)));
        });
    }
    r.accept(kSet, "valid, and taken away", [](World& w) {
        EXPECT_EQ(suppleSetBudget(w.handle(), SUPPLE_PASS_ALL, 1e9), SUPPLE_OK);
        SuppleBudget* const out = w.watched<SuppleBudget>(sizeof(SuppleBudget));
        EXPECT_EQ(suppleGetBudget(w.handle(), SUPPLE_PASS_ALL, out), SUPPLE_OK);
        EXPECT_EQ(out->limit, 1e9);
        return suppleSetBudget(w.handle(), SUPPLE_PASS_ALL, 0.0);
    });
    r.nullContext(kGet, [](World& w, SuppleContext c) {
        return suppleGetBudget(c, SUPPLE_PASS_DEFORM, w.watched<SuppleBudget>(sizeof(SuppleBudget)));
    });
    r.output<SuppleBudget>(
        kGet, [](World& w, SuppleBudget* out) { return suppleGetBudget(w.handle(), SUPPLE_PASS_DEFORM, out); },
        SUPPLE_NOT_READY);
}

void memoryUses(Rows& r) {
    constexpr const char *kContext = "suppleGetContextMemory", *kAsset = "suppleGetAssetMemory",
                         *kGroup = "suppleGetGroupMemory", *kBudget = "suppleSetMemoryBudget";
    const auto out = [](World& w) { return w.watched<SuppleMemoryUse>(sizeof(SuppleMemoryUse)); };
    r.nullContext(kContext, [=](World& w, SuppleContext c) { return suppleGetContextMemory(c, out(w)); });
    r.output<SuppleMemoryUse>(kContext,
                              [](World& w, SuppleMemoryUse* use) { return suppleGetContextMemory(w.handle(), use); });
    r.assets(kAsset, [=](World& w, SuppleContext c, SuppleAsset a) { return suppleGetAssetMemory(c, a, out(w)); });
    r.output<SuppleMemoryUse>(
        kAsset, [](World& w, SuppleMemoryUse* use) { return suppleGetAssetMemory(w.handle(), w.mine.asset, use); });
    r.groups(kGroup, [=](World& w, SuppleContext c, SuppleGroup g) { return suppleGetGroupMemory(c, g, out(w)); });
    r.output<SuppleMemoryUse>(kGroup, [](World& w, SuppleMemoryUse* use) {
        return suppleGetGroupMemory(w.handle(), w.mine.main.group, use);
    });
    r.nullContext(kBudget, [](World&, SuppleContext c) { return suppleSetMemoryBudget(c, 1, nullptr, nullptr); });
    r.accept(kBudget, "valid, and taken away", [](World& w) {
        EXPECT_EQ(suppleSetMemoryBudget(w.handle(), 1, nullptr, nullptr), SUPPLE_OK);
        return suppleSetMemoryBudget(w.handle(), 0, nullptr, nullptr);
    });
}

void uploads(Rows& r) {
    constexpr const char *kContext = "suppleGetUploadState", *kAsset = "suppleGetAssetUploadState",
                         *kGroup = "suppleGetGroupUploadState", *kBudget = "suppleSetUploadBudget";
    const auto out = [](World& w) { return w.watched<SuppleUploadState>(sizeof(SuppleUploadState)); };
    r.nullContext(kContext, [=](World& w, SuppleContext c) { return suppleGetUploadState(c, out(w)); });
    r.output<SuppleUploadState>(
        kContext, [](World& w, SuppleUploadState* state) { return suppleGetUploadState(w.handle(), state); });
    r.assets(kAsset, [=](World& w, SuppleContext c, SuppleAsset a) { return suppleGetAssetUploadState(c, a, out(w)); });
    r.output<SuppleUploadState>(kAsset, [](World& w, SuppleUploadState* state) {
        return suppleGetAssetUploadState(w.handle(), w.mine.asset, state);
    });
    r.groups(kGroup, [=](World& w, SuppleContext c, SuppleGroup g) { return suppleGetGroupUploadState(c, g, out(w)); });
    r.output<SuppleUploadState>(kGroup, [](World& w, SuppleUploadState* state) {
        return suppleGetGroupUploadState(w.handle(), w.mine.main.group, state);
    });
    r.nullContext(kBudget, [](World&, SuppleContext c) { return suppleSetUploadBudget(c, 1); });
    r.add(kBudget, "more than any memory has", SUPPLE_ERROR_LIMIT, SUPPLE_MESSAGE_LIMIT,
          [](World& w) { return suppleSetUploadBudget(w.handle(), UINT64_MAX); });
    r.accept(kBudget, "valid, and taken away", [](World& w) {
        EXPECT_EQ(suppleSetUploadBudget(w.handle(), 4096), SUPPLE_OK);
        return suppleSetUploadBudget(w.handle(), 0);
    });
}

void recordings(Rows& r) {
    constexpr const char *kStart = "suppleStartRecording", *kStop = "suppleStopRecording";
    const auto made = [](World&) {
        SuppleRecordingDesc desc{};
        desc.structSize = sizeof(desc);
        desc.write = [](const void*, size_t, void*) { return 1; };
        return desc;
    };
    // The context has assets: whatever is right otherwise comes too late.
    r.nullContext(kStart, [=](World& w, SuppleContext c) {
        const SuppleRecordingDesc desc = made(w);
        return suppleStartRecording(c, &desc);
    });
    r.refuse(kStart, "null", SUPPLE_MESSAGE_NULL_POINTER,
             [](World& w) { return suppleStartRecording(w.handle(), nullptr); });
    r.refuse(kStart, "structSize 0", SUPPLE_MESSAGE_STRUCT_SIZE, [=](World& w) {
        SuppleRecordingDesc desc = made(w);
        desc.structSize = 0;
        return suppleStartRecording(w.handle(), &desc);
    });
    r.refuse(kStart, "unknown flags", SUPPLE_MESSAGE_OUT_OF_RANGE, [=](World& w) {
        SuppleRecordingDesc desc = made(w);
        desc.flags = 4;
        return suppleStartRecording(w.handle(), &desc);
    });
    r.refuse(kStart, "write null", SUPPLE_MESSAGE_NULL_POINTER, [=](World& w) {
        SuppleRecordingDesc desc = made(w);
        desc.write = nullptr;
        return suppleStartRecording(w.handle(), &desc);
    });
    r.refuse(kStart, "too late", SUPPLE_MESSAGE_OUT_OF_ORDER, [=](World& w) {
        const SuppleRecordingDesc desc = made(w);
        return suppleStartRecording(w.handle(), &desc);
    });
    r.nullContext(kStop, [](World&, SuppleContext c) { return suppleStopRecording(c); });
    r.refuse(kStop, "not begun", SUPPLE_MESSAGE_OUT_OF_ORDER, [](World& w) { return suppleStopRecording(w.handle()); });
}

void pipelines(Rows& r) {
    constexpr const char* kMake = "suppleMakePipelines";
    const auto make = [](SuppleContext c, bool prepared, const SupplePlannedGroup* groups, uint32_t count) {
        const SuppleAssetDesc asset = World::assetDesc();
        SupplePrepareDesc desc{};
        desc.structSize = sizeof(desc);
        desc.asset = &asset;
        SupplePrepared made = nullptr;
        EXPECT_EQ(supplePrepare(&desc, &made), SUPPLE_OK);
        const SuppleResult result = suppleMakePipelines(c, prepared ? made : nullptr, groups, count);
        suppleDestroyPrepared(made);
        return result;
    };
    const auto planned = [](World& w, uint32_t structSize, uint32_t viewFlags) {
        SuppleGroupDesc group{};
        group.structSize = structSize;
        group.scheme = SUPPLE_SCHEME_PM;
        return w.kept(SupplePlannedGroup{w.kept(group), 0, viewFlags});
    };
    constexpr uint32_t kSize = sizeof(SuppleGroupDesc);
    r.nullContext(kMake, [=](World& w, SuppleContext c) { return make(c, true, planned(w, kSize, 0), 1); });
    r.refuse(kMake, "prepared null", SUPPLE_MESSAGE_NULL_POINTER,
             [=](World& w) { return make(w.handle(), false, planned(w, kSize, 0), 1); });
    r.refuse(kMake, "groups null", SUPPLE_MESSAGE_NULL_POINTER,
             [=](World& w) { return make(w.handle(), true, nullptr, 1); });
    r.refuse(kMake, "groups[0].desc->structSize 0", SUPPLE_MESSAGE_STRUCT_SIZE,
             [=](World& w) { return make(w.handle(), true, planned(w, 0, 0), 1); });
    r.refuse(kMake, "viewFlags without a view", SUPPLE_MESSAGE_CONFLICT,
             [=](World& w) { return make(w.handle(), true, planned(w, kSize, 1), 1); });
    r.accept(kMake, "no groups", [=](World& w) { return make(w.handle(), true, nullptr, 0); });
    r.accept(kMake, "valid", [=](World& w) { return make(w.handle(), true, planned(w, kSize, 0), 1); });
}

void points(Rows& r) {
    constexpr const char *kCreate = "suppleCreatePointSet", *kDestroy = "suppleDestroyPointSet",
                         *kOutput = "suppleGetPointOutput";
    constexpr int kRange = SUPPLE_MESSAGE_OUT_OF_RANGE;
    using Desc = SupplePointSetDesc;
    static constexpr SuppleSurfacePoint kPoints[] = {{0, 0, 0.5f, 0.25f}, {1, 0, 0.0f, 1.0f}};
    static constexpr float kTangents[] = {1, 0, 0, 0, 1, 0}, kBadTangents[] = {1, 0, 0, 0, kNan, 0};
    static constexpr SuppleSurfacePoint kOutside[] = {{0, 0, 1.5f, 0.25f}, {0, 0, 0.0f, 0.0f}};
    static constexpr SuppleSurfacePoint kNoFace[] = {{0, 0, 0.5f, 0.25f}, {1u << 20, 0, 0.0f, 0.0f}};
    const auto desc = [](World& w) {
        Desc made{};
        made.structSize = sizeof(made);
        made.group = w.spare.group;
        made.points = kPoints;
        made.tangents = kTangents;
        made.pointCount = 2;
        return made;
    };
    const auto create = [](World& w, const Desc* given) {
        SupplePointSet* const out = w.newHandle<SupplePointSet>();
        const SuppleResult result = suppleCreatePointSet(w.handle(), given, out);
        if (result == SUPPLE_OK) {
            EXPECT_EQ(suppleDestroyPointSet(w.handle(), *out), SUPPLE_OK);
        } else {
            EXPECT_EQ(out->id, 0u);
        }
        return result;
    };
    r.nullContext(kCreate, [=](World& w, SuppleContext c) {
        const Desc given = desc(w);
        return suppleCreatePointSet(c, &given, w.newHandle<SupplePointSet>());
    });
    r.refuse(kCreate, "out null", SUPPLE_MESSAGE_NULL_POINTER, [=](World& w) {
        const Desc given = desc(w);
        return suppleCreatePointSet(w.handle(), &given, nullptr);
    });
    const auto spoiled = [&](const char* what, int message, auto spoil) {
        r.refuse(kCreate, what, message, [=](World& w) {
            Desc given = desc(w);
            spoil(w, given);
            return create(w, &given);
        });
    };
    spoiled("points null", SUPPLE_MESSAGE_NULL_POINTER, [](World&, Desc& d) { d.points = nullptr; });
    spoiled("no points", kRange, [](World&, Desc& d) { d.pointCount = 0; });
    spoiled("flags", kRange, [](World&, Desc& d) { d.flags = 2; });
    spoiled("derivatives on vertices", SUPPLE_MESSAGE_CONFLICT, [](World&, Desc& d) {
        d.flags = SUPPLE_POINT_SET_ON_VERTICES;
        d.format = SUPPLE_POINT_DERIVATIVES_32;
    });
    spoiled("format", kRange, [](World&, Desc& d) { d.format = static_cast<SupplePointFormat>(4); });
    spoiled("tangents NaN", SUPPLE_MESSAGE_NOT_FINITE, [](World&, Desc& d) { d.tangents = kBadTangents; });
    spoiled("stale group", SUPPLE_MESSAGE_STALE_HANDLE, [](World& w, Desc& d) { d.group = w.staleGroup; });
    spoiled("foreign group", SUPPLE_MESSAGE_STALE_HANDLE, [](World& w, Desc& d) { d.group = w.theirs.main.group; });
#if defined(SUPPLE_WITH_CPU)
    r.description<Desc>(kCreate, "desc", desc, create);
    spoiled("outside of the face", kRange, [](World&, Desc& d) { d.points = kOutside; });
    spoiled("no such face", kRange, [](World&, Desc& d) { d.points = kNoFace; });
    spoiled("on vertices, of a group that has none", SUPPLE_MESSAGE_CONFLICT,
            [](World&, Desc& d) { d.flags = SUPPLE_POINT_SET_ON_VERTICES; });
#endif
    r.nullContext(kDestroy, [](World&, SuppleContext c) { return suppleDestroyPointSet(c, {}); });
    r.nullContext(kOutput, [](World& w, SuppleContext c) {
        return suppleGetPointOutput(c, {}, w.watched<SupplePointOutput>(sizeof(SupplePointOutput)));
    });
    constexpr const char* kFind = "suppleFindPoints";
    using Query = SupplePointQuery;
    static constexpr float kPlaces[] = {0, 0, 0, 1, 2, 3}, kBadPlaces[] = {0, 0, 0, 1, kNan, 3},
                           kRays[] = {0, 0, 5, 0, 0, -1, 0, 9, 0, 1, 0, 0},
                           kStandingRays[] = {0, 0, 5, 0, 0, -1, 0, 9, 0, 0, 0, 0};
    static constexpr SuppleGltfPoint kTriangles[] = {{0, 0, 0, 0.5f, 0.25f}, {0, 0, 1u << 30, 0.0f, 0.0f}};
    const auto query = [](World&) {
        Query made{};
        made.structSize = sizeof(made);
        made.count = 2;
        made.values = kPlaces;
        return made;
    };
    const auto find = [](World& w, const Query* given) {
        return suppleFindPoints(w.handle(), w.spare.group, given, w.plain<SuppleSurfacePoint>(2));
    };
    r.groups(kFind, [=](World& w, SuppleContext c, SuppleGroup group) {
        const Query given = query(w);
        return suppleFindPoints(c, group, &given, w.plain<SuppleSurfacePoint>(2));
    });
    r.refuse(kFind, "out null", SUPPLE_MESSAGE_NULL_POINTER, [=](World& w) {
        const Query given = query(w);
        return suppleFindPoints(w.handle(), w.spare.group, &given, nullptr);
    });
    const auto askedOtherwise = [&](const char* what, int message, auto spoil) {
        r.refuse(kFind, what, message, [=](World& w) {
            Query given = query(w);
            spoil(given);
            return find(w, &given);
        });
    };
    askedOtherwise("values null", SUPPLE_MESSAGE_NULL_POINTER, [](Query& q) { q.values = nullptr; });
    askedOtherwise("values NaN", SUPPLE_MESSAGE_NOT_FINITE, [](Query& q) { q.values = kBadPlaces; });
    askedOtherwise("kind", kRange, [](Query& q) { q.kind = static_cast<SupplePointQueryKind>(6); });
    askedOtherwise("a seed for NEAREST", kRange, [](Query& q) { q.seed = 1; });
    askedOtherwise("a UV set for NEAREST", kRange, [](Query& q) { q.uvSet = 1; });
    askedOtherwise("several points for NEAREST", kRange, [](Query& q) { q.pointsEach = 2; });
    askedOtherwise("reserved", kRange, [](Query& q) { q.reserved = 1; });
    askedOtherwise("more points than are numbered", kRange, [](Query& q) {
        q.kind = SUPPLE_FIND_UV;
        q.pointsEach = UINT32_MAX;
    });
    askedOtherwise("a ray without a direction", kRange, [](Query& q) {
        q.kind = SUPPLE_FIND_RAY;
        q.values = kStandingRays;
    });
    askedOtherwise("triangles for NEAREST", SUPPLE_MESSAGE_NULL_POINTER, [](Query& q) { q.gltf = kTriangles; });
    askedOtherwise("no triangles for GLTF", SUPPLE_MESSAGE_NULL_POINTER, [](Query& q) {
        q.kind = SUPPLE_FIND_GLTF;
        q.values = nullptr;
    });
    askedOtherwise("no jets for GIVEN", SUPPLE_MESSAGE_NULL_POINTER, [](Query& q) {
        q.kind = SUPPLE_FIND_GIVEN;
        q.values = nullptr;
    });
    askedOtherwise("a cage of no vertices", SUPPLE_MESSAGE_NULL_POINTER, [](Query& q) { q.cage = kPlaces; });
#if defined(SUPPLE_WITH_CPU)
    r.description<Query>(kFind, "query", query, find);
    askedOtherwise("another cage", kRange, [](Query& q) {
        q.cage = kPlaces;
        q.cageVertexCount = 2;
    });
    r.accept(kFind, "RAY", [=](World& w) {
        Query given = query(w);
        given.kind = SUPPLE_FIND_RAY;
        given.values = kRays;
        given.jets = w.plain<SuppleSurfaceJet>(2);
        return find(w, &given);
    });
    r.accept(kFind, "GIVEN", [=](World& w) {
        Query given = query(w);
        given.kind = SUPPLE_FIND_GIVEN;
        given.values = nullptr;
        given.jets = w.plain<SuppleSurfaceJet>(2);
        SuppleSurfacePoint points[2]{};
        return suppleFindPoints(w.handle(), w.spare.group, &given, points);
    });
    askedOtherwise("a triangle that there is not", kRange, [](Query& q) {
        q.kind = SUPPLE_FIND_GLTF;
        q.values = nullptr;
        q.gltf = kTriangles;
    });
    r.accept(kFind, "SCATTER", [=](World& w) {
        Query given = query(w);
        given.kind = SUPPLE_FIND_SCATTER;
        given.values = nullptr;
        given.seed = 7;
        return find(w, &given);
    });
#endif
    for (const uint64_t id : {uint64_t{0}, ~uint64_t{0}}) {
        r.refuse(kDestroy, "no set", SUPPLE_MESSAGE_STALE_HANDLE,
                 [=](World& w) { return suppleDestroyPointSet(w.handle(), {id}); });
        r.refuse(kOutput, "no set", SUPPLE_MESSAGE_STALE_HANDLE, [=](World& w) {
            return suppleGetPointOutput(w.handle(), {id}, w.watched<SupplePointOutput>(sizeof(SupplePointOutput)));
        });
    }
#if defined(SUPPLE_WITH_CPU)
    r.output<SupplePointOutput>(kOutput, [=](World& w, SupplePointOutput* out) {
        const Desc given = desc(w);
        SupplePointSet set{};
        EXPECT_EQ(suppleCreatePointSet(w.handle(), &given, &set), SUPPLE_OK);
        const SuppleResult result = suppleGetPointOutput(w.handle(), set, out);
        EXPECT_EQ(suppleDestroyPointSet(w.handle(), set), SUPPLE_OK);
        return result;
    });
#else
    r.add(kCreate, "a library without surfaces on the CPU", SUPPLE_ERROR_UNSUPPORTED, SUPPLE_MESSAGE_DEVICE_UNSUITED,
          [=](World& w) {
              const Desc given = desc(w);
              return create(w, &given);
          });
#endif
}

void queries(Rows& r) {
    constexpr const char *kCreate = "suppleCreateQueryPool", *kDestroy = "suppleDestroyQueryPool",
                         *kOutput = "suppleGetQueryOutput", *kRecord = "suppleRecordQueries", *kRead = "suppleReadHits";
    constexpr int kRange = SUPPLE_MESSAGE_OUT_OF_RANGE, kNull = SUPPLE_MESSAGE_NULL_POINTER;
    using Desc = SuppleQueryPoolDesc;
    const auto desc = [](World& w) {
        Desc made{};
        made.structSize = sizeof(made);
        made.flags = SUPPLE_QUERY_POOL_NEAREST;
        made.groups = &w.mine.main.group;
        made.groupCount = 1;
        made.rayCount = 4;
        return made;
    };
    const auto create = [](World& w, const Desc* given) {
        SuppleQueryPool* const out = w.newHandle<SuppleQueryPool>();
        const SuppleResult result = suppleCreateQueryPool(w.handle(), given, out);
        if (result == SUPPLE_OK) {
            EXPECT_EQ(suppleDestroyQueryPool(w.handle(), *out), SUPPLE_OK);
        } else {
            EXPECT_EQ(out->id, 0u);
        }
        return result;
    };
    r.nullContext(kCreate, [=](World& w, SuppleContext c) {
        const Desc given = desc(w);
        return suppleCreateQueryPool(c, &given, w.newHandle<SuppleQueryPool>());
    });
    r.refuse(kCreate, "out null", kNull, [=](World& w) {
        const Desc given = desc(w);
        return suppleCreateQueryPool(w.handle(), &given, nullptr);
    });
    const auto spoiled = [&](const char* what, int message, auto spoil) {
        r.refuse(kCreate, what, message, [=](World& w) {
            Desc given = desc(w);
            spoil(w, given);
            return create(w, &given);
        });
    };
    spoiled("flags", kRange, [](World&, Desc& d) { d.flags = 2; });
    spoiled("groups null", kNull, [](World&, Desc& d) { d.groups = nullptr; });
    spoiled("no groups", kNull, [](World&, Desc& d) { d.groupCount = 0; });
    spoiled("no rays", kRange, [](World&, Desc& d) { d.rayCount = 0; });
    spoiled("too many rays", kRange, [](World&, Desc& d) { d.rayCount = SUPPLE_MAX_QUERY_RAYS + 1; });
    spoiled("stale group", SUPPLE_MESSAGE_STALE_HANDLE, [](World& w, Desc& d) { d.groups = &w.staleGroup; });
    spoiled("foreign group", SUPPLE_MESSAGE_STALE_HANDLE, [](World& w, Desc& d) { d.groups = &w.theirs.main.group; });
    spoiled("a group twice", SUPPLE_MESSAGE_CONFLICT, [](World& w, Desc& d) {
        const SuppleGroup twice[2] = {w.mine.main.group, w.mine.main.group};
        d.groups = *w.kept(twice);
        d.groupCount = 2;
    });
    r.nullContext(kDestroy, [](World&, SuppleContext c) { return suppleDestroyQueryPool(c, {}); });
    r.nullContext(kOutput, [](World& w, SuppleContext c) {
        return suppleGetQueryOutput(c, {}, w.watched<SuppleQueryOutput>(sizeof(SuppleQueryOutput)));
    });
    r.nullContext(
        kRead, [](World& w, SuppleContext c) { return suppleReadHits(c, {}, nullptr, w.plain<uint32_t>(1), nullptr); });
    static constexpr SuppleRay kRays[] = {{{0, 0, 5}, 0, {0, 0, -1}, 100}, {{0, 9, 0}, 0, {kNan, 0, 0}, 1}};
    using Batch = SuppleQueryDesc;
    const auto batch = [] {
        Batch made{};
        made.structSize = sizeof(made);
        made.flags = SUPPLE_QUERY_READ_BACK;
        made.hostRays = kRays;
        made.rayCount = 2;
        return made;
    };
    r.nullContext(kRecord, [=](World& w, SuppleContext c) {
        const Batch given = batch();
        return suppleRecordQueries(c, w.commands, {}, &given);
    });
    for (const uint64_t id : {uint64_t{0}, ~uint64_t{0}}) {
        constexpr int kStale = SUPPLE_MESSAGE_STALE_HANDLE;
        r.refuse(kDestroy, "no pool", kStale, [=](World& w) { return suppleDestroyQueryPool(w.handle(), {id}); });
        r.refuse(kOutput, "no pool", kStale, [=](World& w) {
            return suppleGetQueryOutput(w.handle(), {id}, w.watched<SuppleQueryOutput>(sizeof(SuppleQueryOutput)));
        });
        r.refuse(kRead, "no pool", kStale,
                 [=](World& w) { return suppleReadHits(w.handle(), {id}, nullptr, w.plain<uint32_t>(1), nullptr); });
        r.refuse(kRecord, "no pool", kStale, [=](World& w) {
            const Batch given = batch();
            return suppleRecordQueries(w.handle(), w.commands, {id}, &given);
        });
    }
#if defined(SUPPLE_WITH_CPU)
    r.description<Desc>(kCreate, "desc", desc, create);
    /// A call with a pool.
    const auto with = [=](World& w, auto&& call) {
        const Desc given = desc(w);
        SuppleQueryPool pool{};
        EXPECT_EQ(suppleCreateQueryPool(w.handle(), &given, &pool), SUPPLE_OK);
        const SuppleResult result = call(pool);
        EXPECT_EQ(suppleDestroyQueryPool(w.handle(), pool), SUPPLE_OK);
        return result;
    };
    r.output<SuppleQueryOutput>(kOutput, [=](World& w, SuppleQueryOutput* out) {
        return with(w, [&](SuppleQueryPool pool) { return suppleGetQueryOutput(w.handle(), pool, out); });
    });
    r.refuse(kRead, "count null", kNull, [=](World& w) {
        return with(w,
                    [&](SuppleQueryPool pool) { return suppleReadHits(w.handle(), pool, nullptr, nullptr, nullptr); });
    });
    r.add(kRead, "no frame", SUPPLE_NOT_READY, kSilent, [=](World& w) {
        return with(w, [&](SuppleQueryPool pool) {
            return suppleReadHits(w.handle(), pool, nullptr, w.plain<uint32_t>(1), nullptr);
        });
    });
    const auto record = [=](World& w, const Batch* given) {
        return with(w, [&](SuppleQueryPool pool) { return suppleRecordQueries(w.handle(), w.commands, pool, given); });
    };
    const auto spoiledBatch = [&](const char* what, int message, auto spoil) {
        r.refuse(
            kRecord, what, message,
            [=](World& w) {
                Batch given = batch();
                spoil(w, given);
                return record(w, &given);
            },
            Phase::recorded);
    };
    spoiledBatch("flags", kRange, [](World&, Batch& d) { d.flags = 2; });
    spoiledBatch("groups without a count", kNull, [](World& w, Batch& d) { d.groups = &w.mine.main.group; });
    spoiledBatch("a count without groups", kNull, [](World&, Batch& d) { d.groupCount = 1; });
    spoiledBatch("a group that the pool lacks", SUPPLE_MESSAGE_STALE_HANDLE, [](World& w, Batch& d) {
        d.groups = &w.spare.group;
        d.groupCount = 1;
    });
    spoiledBatch("too many rays", kRange, [](World&, Batch& d) { d.rayCount = 5; });
    const auto bufferOf = [](World& w) {
        SuppleGroupInfo info{};
        info.structSize = sizeof(info);
        EXPECT_EQ(suppleGetGroupInfo(w.handle(), w.mine.main.group, &info), SUPPLE_OK);
        return info.deformedCage;
    };
    spoiledBatch("two kinds of rays", kNull, [=](World& w, Batch& d) { d.rays = bufferOf(w); });
    spoiledBatch("two kinds of triangles", kNull, [=](World& w, Batch& d) {
        d.hostTriangles = w.plain<SuppleTriangleHit>(2);
        d.triangles = bufferOf(w);
    });
    spoiledBatch("triangles beyond their range", kRange, [=](World& w, Batch& d) {
        d.triangles = bufferOf(w);
        d.triangles.size = 63;
    });
    spoiledBatch("no rays", kNull, [](World&, Batch& d) { d.hostRays = nullptr; });
    static constexpr SupplePlace kNearPlaces[] = {{{0, 0, 5}, 100}, {{0, kNan, 0}, 1}};
    spoiledBatch("rays and places", kNull, [](World&, Batch& d) { d.hostPlaces = kNearPlaces; });
    spoiledBatch("two kinds of places", kNull, [=](World& w, Batch& d) {
        d.hostRays = nullptr;
        d.hostPlaces = kNearPlaces;
        d.places = bufferOf(w);
    });
    spoiledBatch("places with triangles", SUPPLE_MESSAGE_CONFLICT, [=](World& w, Batch& d) {
        d.hostRays = nullptr;
        d.hostPlaces = kNearPlaces;
        d.hostTriangles = w.plain<SuppleTriangleHit>(2);
    });
    spoiledBatch("places beyond their range", kRange, [=](World& w, Batch& d) {
        d.hostRays = nullptr;
        d.places = bufferOf(w);
        d.places.size = 31;
    });
    const auto nearest = [=] {
        Batch made = batch();
        made.hostRays = nullptr;
        made.hostPlaces = kNearPlaces;
        return made;
    };
    r.refuse(
        kRecord, "places in a pool for rays", SUPPLE_MESSAGE_CONFLICT,
        [=](World& w) {
            Desc ofRays = desc(w);
            ofRays.flags = 0;
            SuppleQueryPool pool{};
            EXPECT_EQ(suppleCreateQueryPool(w.handle(), &ofRays, &pool), SUPPLE_OK);
            const SuppleResult result = suppleRecordQueries(w.handle(), w.commands, pool, w.kept(nearest()));
            EXPECT_EQ(suppleDestroyQueryPool(w.handle(), pool), SUPPLE_OK);
            return result;
        },
        Phase::recorded);
    r.accept(
        kRecord, "places", [=](World& w) { return record(w, w.kept(nearest())); }, Phase::recorded);
    r.refuse(
        kRecord, "commandBuffer null", kNull,
        [=](World& w) {
            const Batch given = batch();
            return with(
                w, [&](SuppleQueryPool pool) { return suppleRecordQueries(w.handle(), VK_NULL_HANDLE, pool, &given); });
        },
        Phase::recorded);
    r.refuse(
        kRecord, "desc null", kNull, [=](World& w) { return record(w, nullptr); }, Phase::recorded);
    r.refuse(
        kRecord, "desc->structSize 0", SUPPLE_MESSAGE_STRUCT_SIZE, [=](World& w) { return record(w, w.kept(Batch{})); },
        Phase::recorded);
    for (const Phase phase : {Phase::fresh, Phase::begun, Phase::cancelled}) {
        r.refuse(
            kRecord, "no suppleRecord in the frame", SUPPLE_MESSAGE_OUT_OF_ORDER,
            [=](World& w) { return record(w, w.kept(batch())); }, phase);
    }
    r.accept(
        kRecord, "valid", [=](World& w) { return record(w, w.kept(batch())); }, Phase::recorded);
    r.refuse(
        kRecord, "twice", SUPPLE_MESSAGE_OUT_OF_ORDER,
        [=](World& w) {
            return with(w, [&](SuppleQueryPool pool) {
                EXPECT_EQ(suppleRecordQueries(w.handle(), w.commands, pool, w.kept(batch())), SUPPLE_OK);
                return suppleRecordQueries(w.handle(), w.commands, pool, w.kept(batch()));
            });
        },
        Phase::recorded);
#endif
}

std::vector<Row> allRows() {
    Rows r;
    withoutContext(r);
    preparing(r);
#if defined(SUPPLE_WITH_CPU)
    cpuGroups(r);
    cpuPoses(r);
#endif
    uploads(r);
    recordings(r);
    pipelines(r);
    contexts(r);
    createAsset(r);
    assetGetters(r);
    views(r);
    groups(r);
    instances(r);
    poses(r);
    playback(r);
    modifiers(r);
    frames(r);
    measurements(r);
    memoryUses(r);
    points(r);
    queries(r);
    return std::move(r.rows);
}

/// Makes the call and looks at what it should have left alone.
void walk(World& w, const Row& row) {
    const testing::ScopedTrace trace(__FILE__, __LINE__, row.function + ": " + row.what);
    w.forget();
    w.recorded = false;
    const SuppleResult result = row.call(w);
    EXPECT_EQ(result, row.result) << suppleResultString(result);
    std::vector<LogLine> errors;
    for (const LogLine& line : w.lines) {
        if (line.severity == SUPPLE_SEVERITY_ERROR) {
            errors.push_back(line);
        }
    }
    EXPECT_EQ(errors.size(), row.message == kSilent ? 0u : 1u);
    for (const LogLine& line : errors) {
        EXPECT_EQ(int{line.message}, row.message) << line.text;
        EXPECT_FALSE(line.text.empty());
        EXPECT_EQ(line.text.find('\n'), std::string::npos) << line.text;
    }
    for (const World::Snapshot& snapshot : w.snapshots) {
        const bool zero =
            snapshot.handle && std::ranges::all_of(*snapshot.now, [](std::byte b) { return b == std::byte{0}; });
        EXPECT_TRUE(result >= 0 || zero || *snapshot.now == snapshot.before) << "something was written";
    }
}

/// A frame with the call somewhere in it; the surface that it gives.
std::vector<std::byte> frameWith(World& w, const Row* row) {
    const auto record = [&] {
        const SuppleRecordDesc desc = w.recordDesc();
        EXPECT_EQ(suppleRecord(w.handle(), w.commands, &desc), SUPPLE_OK);
    };
    const auto submit = [&](const std::function<void()>& body) {
        EXPECT_TRUE(w.device
                        .submitAndWait([&](VkCommandBuffer commands) {
                            w.commands = commands;
                            body();
                        })
                        .ok());
    };
    w.own.beginFrame();
    if (row != nullptr && row->phase == Phase::cancelled) {
        // Thrown away: its command buffer is not submitted.
        VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        info.commandPool = w.device.commandPool();
        info.commandBufferCount = 1;
        EXPECT_EQ(vkAllocateCommandBuffers(w.device.handle(), &info, &w.commands), VK_SUCCESS);
        const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, 0, nullptr};
        EXPECT_EQ(vkBeginCommandBuffer(w.commands, &begin), VK_SUCCESS);
        record();
        EXPECT_EQ(suppleCancelFrame(w.handle()), SUPPLE_OK);
        walk(w, *row);
        vkFreeCommandBuffers(w.device.handle(), w.device.commandPool(), 1, &w.commands);
        w.own.beginFrame();
        submit(record);
    } else {
        submit([&] {
            // When suppleBeginFrame refuses a frame, nothing can be recorded until it takes one.
            const bool refusesFrame = row != nullptr && row->function == "suppleBeginFrame" && row->result < 0;
            const bool first = row != nullptr && (row->phase == Phase::recorded || refusesFrame);
            if (first) {
                record();
            }
            w.recorded = first;
            if (row != nullptr) {
                walk(w, *row);
            }
            if (!first && !w.recorded) {
                record();
            }
        });
    }
    std::vector<std::byte> bits = surfaceBits(w.own, w.mine.main.group);
    const std::vector<std::byte> more = surfaceBits(w.own, w.mine.subdivision.group);
    bits.insert(bits.end(), more.begin(), more.end());
    return bits;
}

TEST(ApiWalk, EveryFunctionRefusesWhatIsWrongAndNothingElseHappens) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    const std::vector<Row> rows = allRows();
    World w(*device);
    ASSERT_FALSE(testing::Test::HasFailure());
    EXPECT_TRUE(device
                    ->submitAndWait([&](VkCommandBuffer commands) {
                        w.commands = commands;
                        for (const Row& row : rows) {
                            if (row.phase == Phase::fresh) {
                                walk(w, row);
                            }
                        }
                    })
                    .ok());
    // As another context has it, of which nothing wrong was asked.
    const SuppleGroup theirs[] = {w.theirs.main.group, w.theirs.subdivision.group};
    w.foreign.evaluate(theirs);
    std::vector<std::byte> wanted = surfaceBits(w.foreign, theirs[0]);
    const std::vector<std::byte> more = surfaceBits(w.foreign, theirs[1]);
    wanted.insert(wanted.end(), more.begin(), more.end());
    ASSERT_TRUE(frameWith(w, nullptr) == wanted);
    w.own.beginFrame(); // three frames exist for those that are counted backwards
    for (const Row& row : rows) {
        if (row.phase != Phase::fresh) {
            EXPECT_TRUE(frameWith(w, &row) == wanted) << row.function << ": " << row.what << ": the surface changed";
        }
    }
    std::printf("%zu calls\n", rows.size());
}

TEST(ApiWalk, LeavesNoFunctionOfTheHeaderOut) {
    std::string header;
    std::vector<const char*> names{"supple.h",           "supple_view.h",      "supple_playback.h", "supple_prepare.h",
                                   "supple_character.h", "supple_recording.h", "supple_points.h",   "supple_queries.h",
                                   "supple_rays.h",      "supple_direct.h"};
#if defined(SUPPLE_WITH_CPU)
    names.push_back("supple_cpu.h");
#endif
    for (const char* name : names) {
        std::ifstream file(std::string(SUPPLE_SOURCE_DIR) + "/runtime/include/supple/" + name);
        ASSERT_TRUE(file.good()) << name;
        header.append(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    const std::regex declaration(R"(\nSUPPLE_API [^;(]*?(supple[A-Z]\w*)\(([^)]*)\);)");
    std::set<std::string> declared, walked, contextual, nulled;
    for (std::sregex_iterator i(header.begin(), header.end(), declaration), end; i != end; ++i) {
        declared.insert((*i)[1]);
        if ((*i)[2].str().starts_with("SuppleContext context")) {
            contextual.insert((*i)[1]);
        }
    }
    // None of them in another form.
    const std::regex any(R"(\nSUPPLE_API )");
    EXPECT_EQ(declared.size(), static_cast<size_t>(std::distance(
                                   std::sregex_iterator(header.begin(), header.end(), any), std::sregex_iterator())));
    for (const Row& row : allRows()) {
        walked.insert(row.function);
        if (row.what == "null context") {
            nulled.insert(row.function);
        }
    }
    EXPECT_GT(declared.size(), 35u);
    EXPECT_EQ(walked, declared);
    EXPECT_EQ(nulled, contextual);
}

} // namespace
} // namespace supple::test
