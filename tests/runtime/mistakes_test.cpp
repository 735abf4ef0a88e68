// The mistakes of hosts, and what they are told: the table in docs/integration.md is what really happens. And a group
// that is drawn without being recorded.
#include "tests/support/crowd.h"

#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>

namespace supple::test {
namespace {

/// What the host gets: the result and, unless nothing is said, the id and the text.
struct Refusal {
    SuppleResult result = SUPPLE_OK;
    const char* message = "none"; ///< without SUPPLE_MESSAGE_
    int id = 0;
    std::string text;
};

const char* nameOfMessage(SuppleMessage message) {
    switch (message) {
    case SUPPLE_MESSAGE_NULL_POINTER:
        return "NULL_POINTER";
    case SUPPLE_MESSAGE_STRUCT_SIZE:
        return "STRUCT_SIZE";
    case SUPPLE_MESSAGE_STALE_HANDLE:
        return "STALE_HANDLE";
    case SUPPLE_MESSAGE_OUT_OF_RANGE:
        return "OUT_OF_RANGE";
    case SUPPLE_MESSAGE_NOT_FINITE:
        return "NOT_FINITE";
    case SUPPLE_MESSAGE_CONFLICT:
        return "CONFLICT";
    case SUPPLE_MESSAGE_OUT_OF_ORDER:
        return "OUT_OF_ORDER";
    case SUPPLE_MESSAGE_ASSET_REFUSED:
        return "ASSET_REFUSED";
    case SUPPLE_MESSAGE_FEATURE_DISABLED:
        return "FEATURE_DISABLED";
    case SUPPLE_MESSAGE_LIMIT:
        return "LIMIT";
    case SUPPLE_MESSAGE_NEVER_RECORDED:
        return "NEVER_RECORDED";
    default:
        ADD_FAILURE() << "give message " << message << " a name here";
        return "";
    }
}

/// A context that keeps two frames in flight, with an asset called pip, and what a mistake needs of it.
class Scene {
public:
    Scene(host::Device& device, VkCommandBuffer recording) : own(device, disableHiding), commands(recording) {
        SuppleAssetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.name = "pip";
        desc.bytes = tubeFile().data();
        desc.byteCount = tubeFile().size();
        EXPECT_EQ(suppleCreateAsset(own.handle(), &desc, &asset), SUPPLE_OK);
        cage = createGroup(own.handle(), asset, {.scheme = SUPPLE_SCHEME_CAGE});
        EXPECT_EQ(cage.result, SUPPLE_OK);
    }

    [[nodiscard]] SuppleContext context() const { return own.handle(); }
    [[nodiscard]] SuppleInstance instance() const { return cage.instances[0]; }
    [[nodiscard]] SmallGroup group(const SuppleGroupDesc& desc) const {
        SmallGroup made = createGroup(own.handle(), asset, desc);
        EXPECT_EQ(made.result, SUPPLE_OK);
        return made;
    }
    [[nodiscard]] SmallGroup groupOfView(SuppleScheme scheme = SUPPLE_SCHEME_PM) const {
        SuppleViewDesc desc{};
        desc.structSize = sizeof(desc);
        desc.maxVertices = 1u << 16;
        SuppleView view{};
        EXPECT_EQ(suppleCreateView(own.handle(), &desc, &view), SUPPLE_OK);
        return group({.scheme = scheme, .view = view});
    }
    [[nodiscard]] SuppleResult createPoints(SuppleGroup group, std::span<const SuppleSurfacePoint> points,
                                            SupplePointSet& out) const {
        SupplePointSetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.group = group;
        desc.points = points.data();
        desc.pointCount = static_cast<uint32_t>(points.size());
        return suppleCreatePointSet(context(), &desc, &out);
    }
    [[nodiscard]] SuppleResult begin(uint64_t frame, uint64_t completed) const {
        return suppleBeginFrame(own.handle(), frame, completed);
    }
    /// For calls that lead to the mistake.
    void good(SuppleResult result) const { EXPECT_EQ(result, SUPPLE_OK); }
    [[nodiscard]] SuppleResult record(SuppleGroup group) const { return own.record(commands, {&group, 1}); }
    /// Asks the group for something that it does not know until now.
    template <class T>
    [[nodiscard]] static T asking() {
        T out{};
        out.structSize = sizeof(out);
        return out;
    }

    LoggedContext own;
    VkCommandBuffer commands;
    SuppleAsset asset{};
    SmallGroup cage;

private:
    /// As a host that enabled no feature of its own. (The device has it, so nothing is undefined.)
    static void disableHiding(SuppleContextDesc& desc) {
        static VkPhysicalDeviceFeatures2 features;
        features = {VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, const_cast<void*>(desc.enabledFeatures), {}};
        desc.enabledFeatures = &features;
    }
};

struct Mistake {
    const char* what;
    std::function<SuppleResult(Scene&)> make;
};

/// Mistakes that only the answer of suppleQueryRequirements or suppleCreateContext tells.
struct EarlyMistake {
    const char* what;
    std::function<Refusal(host::Device&)> make;
};

Refusal askRequirements(host::Device& device, uint32_t structSize, uint32_t instanceVersion) {
    SuppleRequirements needs{};
    needs.structSize = structSize;
    needs.instanceVersion = instanceVersion;
    const SuppleResult result =
        suppleQueryRequirements(device.instance(), device.physicalDevice(), device.getInstanceProcAddr(), &needs);
    return {result, "`reason`", 0, needs.reason};
}

Refusal makeContext(host::Device& device, const std::function<void(SuppleContextDesc&)>& spoil) {
    LoggedContext context(device, spoil);
    const std::vector<LogLine> lines = context.takeLines();
    EXPECT_EQ(lines.size(), 1u);
    return lines.empty() ? Refusal{}
                         : Refusal{context.result(), nameOfMessage(lines[0].message), lines[0].message, lines[0].text};
}

std::vector<EarlyMistake> earlyMistakes() {
    return {
        {"the VkInstance is of Vulkan 1.0, and `instanceVersion` says so",
         [](host::Device& d) { return askRequirements(d, sizeof(SuppleRequirements), VK_API_VERSION_1_0); }},
        {"`structSize` of `SuppleRequirements` is not set", [](host::Device& d) { return askRequirements(d, 0, 0); }},
        {"`structSize` of `SuppleContextDesc` is not set",
         [](host::Device& d) { return makeContext(d, [](SuppleContextDesc& desc) { desc.structSize = 0; }); }},
        {"the device was created without a feature that a flag needs",
         [](host::Device& d) {
             return makeContext(d, [](SuppleContextDesc& desc) {
                 static VkPhysicalDeviceVulkan12Features none{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
                 desc.enabledFeatures = &none;
                 desc.mapping = SUPPLE_MAPPING_WIDE;
                 desc.flags = SUPPLE_CONTEXT_SHARED_DISPATCHES;
             });
         }},
        {"the memory callbacks lack `free`",
         [](host::Device& d) {
             return makeContext(d, [](SuppleContextDesc& desc) {
                 static const SuppleMemoryCallbacks half{[](const VkMemoryRequirements*, VkMemoryPropertyFlags,
                                                            VkMemoryPropertyFlags, const char*, SuppleMemory*,
                                                            void*) { return VK_ERROR_OUT_OF_DEVICE_MEMORY; },
                                                         nullptr, nullptr};
                 desc.memory = &half;
             });
         }},
    };
}

void addDescriptions(std::vector<Mistake>& rows) {
    rows.push_back({"`structSize` of a description is not set", [](Scene& s) {
                        const SuppleGroupDesc desc{};
                        SuppleGroup group{};
                        return suppleCreateGroup(s.context(), &desc, &group);
                    }});
    rows.push_back({"`structSize` of a struct that Supple fills is not set", [](Scene& s) {
                        SuppleGroupInfo out{};
                        return suppleGetGroupInfo(s.context(), s.cage.group, &out);
                    }});
    rows.push_back(
        {"a pointer is null", [](Scene& s) { return suppleCreateInstance(s.context(), s.cage.group, nullptr); }});
    rows.push_back({"the file is no glTF", [](Scene& s) {
                        const char text[] = "not a file";
                        auto desc = Scene::asking<SuppleAssetDesc>();
                        desc.name = "hero.glb";
                        desc.bytes = text;
                        desc.byteCount = sizeof(text);
                        SuppleAsset asset{};
                        return suppleCreateAsset(s.context(), &desc, &asset);
                    }});
    rows.push_back({"a group without room", [](Scene& s) {
                        auto desc = Scene::asking<SuppleGroupDesc>();
                        desc.asset = s.asset;
                        SuppleGroup group{};
                        return suppleCreateGroup(s.context(), &desc, &group);
                    }});
    rows.push_back({"a group of a view with flags that are the view's", [](Scene& s) {
                        auto desc = Scene::asking<SuppleGroupDesc>();
                        desc.asset = s.asset;
                        desc.capacity = 1;
                        desc.view = {1};
                        desc.flags = SUPPLE_GROUP_MOTION;
                        SuppleGroup group{};
                        return suppleCreateGroup(s.context(), &desc, &group);
                    }});
}

void addInstances(std::vector<Mistake>& rows) {
    rows.push_back({"one instance more than the group has room for", [](Scene& s) {
                        SuppleInstance instance{};
                        return suppleCreateInstance(s.context(), s.cage.group, &instance);
                    }});
    rows.push_back({"an instance that is destroyed", [](Scene& s) {
                        s.good(suppleDestroyInstance(s.context(), s.instance()));
                        return suppleTeleport(s.context(), s.instance());
                    }});
    rows.push_back(
        {"a clip that the asset lacks", [](Scene& s) { return suppleSetClipPose(s.context(), s.instance(), 7, 0.0); }});
    rows.push_back({"joint matrices of another skeleton", [](Scene& s) {
                        const std::vector<float> matrices(16 * 99);
                        return suppleSetMatrixPose(s.context(), s.instance(), matrices.data(), 99);
                    }});
    rows.push_back({"a pose for a group that plays on the device", [](Scene& s) {
                        const SmallGroup players =
                            s.group({.scheme = SUPPLE_SCHEME_CAGE, .poseSource = SUPPLE_POSES_PLAYBACK});
                        return suppleSetClipPose(s.context(), players.instances[0], 0, 0.0);
                    }});
#if defined(SUPPLE_WITH_CPU)
    rows.push_back({"a point on a face that the cage lacks", [](Scene& s) {
                        const SuppleSurfacePoint points[] = {{0, 0, 0.5f, 0.5f}, {999, 0, 0.5f, 0.5f}};
                        SupplePointSet set{};
                        return s.createPoints(s.cage.group, points, set);
                    }});
    rows.push_back({"a point set of a group that is destroyed", [](Scene& s) {
                        const SmallGroup group = s.group({.scheme = SUPPLE_SCHEME_CAGE});
                        const SuppleSurfacePoint points[] = {{0, 0, 0.5f, 0.5f}};
                        SupplePointSet set{};
                        s.good(s.createPoints(group.group, points, set));
                        s.good(suppleDestroyGroup(s.context(), group.group));
                        auto output = Scene::asking<SupplePointOutput>();
                        return suppleGetPointOutput(s.context(), set, &output);
                    }});
#endif
    rows.push_back({"a row-major transform", [](Scene& s) {
                        const float rows4[16] = {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
                        return suppleSetTransform(s.context(), s.instance(), rows4);
                    }});
    rows.push_back({"a transform with a NaN", [](Scene& s) {
                        float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
                        matrix[12] = std::numeric_limits<float>::quiet_NaN();
                        return suppleSetTransform(s.context(), s.instance(), matrix);
                    }});
    rows.push_back({"a part is hidden on a device without `drawIndirectFirstInstance`", [](Scene& s) {
                        const SmallGroup drawn = s.group({.scheme = SUPPLE_SCHEME_POLYGONS});
                        return suppleSetPartVisible(s.context(), drawn.instances[0], 0, 0);
                    }});
    rows.push_back({"a priority for an instance of no view",
                    [](Scene& s) { return suppleSetPriority(s.context(), s.instance(), 1); }});
}

void addFrames(std::vector<Mistake>& rows) {
    rows.push_back({"`suppleRecord` without a frame", [](Scene& s) { return s.record(s.cage.group); }});
    rows.push_back({"a frame number that does not rise", [](Scene& s) {
                        s.good(s.begin(5, 4));
                        return s.begin(5, 4);
                    }});
    rows.push_back({"`completedFrame` is the frame that begins", [](Scene& s) { return s.begin(5, 5); }});
    rows.push_back({"`completedFrame` falls", [](Scene& s) {
                        s.good(s.begin(5, 4));
                        return s.begin(6, 3);
                    }});
    rows.push_back({"one frame in flight too many", [](Scene& s) {
                        s.good(s.begin(1, 0));
                        s.good(s.begin(2, 0));
                        return s.begin(3, 0);
                    }});
    rows.push_back({"far too many frames in flight", [](Scene& s) {
                        s.good(s.begin(1, 0));
                        return s.begin(9, 1);
                    }});
    rows.push_back({"`suppleRecord` in a frame that `suppleBeginFrame` refused", [](Scene& s) {
                        s.good(s.begin(1, 0));
                        s.good(s.record(s.cage.group));
                        s.good(s.begin(2, 0));
                        EXPECT_EQ(s.begin(3, 0), SUPPLE_ERROR_ARGUMENT);
                        s.own.takeLines();
                        return s.record(s.cage.group);
                    }});
    rows.push_back({"the same of `suppleRecordUploads`", [](Scene& s) {
                        EXPECT_EQ(s.begin(3, 0), SUPPLE_ERROR_ARGUMENT);
                        s.own.takeLines();
                        return suppleRecordUploads(s.context(), s.commands);
                    }});
    rows.push_back({"`suppleRecord` after `suppleCancelFrame`", [](Scene& s) {
                        s.good(s.begin(1, 0));
                        s.good(suppleCancelFrame(s.context()));
                        return s.record(s.cage.group);
                    }});
    rows.push_back({"a group is recorded twice in a frame", [](Scene& s) {
                        s.good(s.begin(1, 0));
                        s.good(s.record(s.cage.group));
                        return s.record(s.cage.group);
                    }});
    rows.push_back({"a group is listed twice", [](Scene& s) {
                        s.good(s.begin(1, 0));
                        const SuppleGroup groups[] = {s.cage.group, s.cage.group};
                        return s.own.record(s.commands, groups);
                    }});
    rows.push_back({"a destroyed group is recorded", [](Scene& s) {
                        s.good(s.begin(1, 0));
                        s.good(suppleDestroyGroup(s.context(), s.cage.group));
                        return s.record(s.cage.group);
                    }});
    rows.push_back({"a group is recorded whose view has no camera", [](Scene& s) {
                        const SmallGroup seen = s.groupOfView();
                        s.good(s.begin(1, 0));
                        return s.record(seen.group);
                    }});
    rows.push_back({"acquire barriers of a context with one queue family", [](Scene& s) {
                        uint32_t count = 0;
                        return suppleGetAcquireBarriers(s.context(), &s.cage.group, 1, kAnyUse, nullptr, &count);
                    }});
}

void addOutputs(std::vector<Mistake>& rows) {
    rows.push_back({"surface vertices of a group of `SUPPLE_SCHEME_CAGE`", [](Scene& s) {
                        auto out = Scene::asking<SuppleVertexStreams>();
                        return suppleGetVertexStreams(s.context(), s.cage.group, 0, &out);
                    }});
    rows.push_back({"`suppleGetGridOutput` of a group with levels", [](Scene& s) {
                        auto out = Scene::asking<SuppleGridOutput>();
                        return suppleGetGridOutput(s.context(), s.groupOfView().group, 0, &out);
                    }});
    rows.push_back({"`suppleGetLevelOutput` of a group without levels", [](Scene& s) {
                        auto out = Scene::asking<SuppleLevelOutput>();
                        return suppleGetLevelOutput(s.context(), s.cage.group, 0, &out);
                    }});
    rows.push_back(
        {"a group with `SUPPLE_GROUP_RAY_TRACING` in a context without `SUPPLE_CONTEXT_RAY_TRACING`",
         [](Scene& s) { return createGroup(s.context(), s.asset, {.flags = SUPPLE_GROUP_RAY_TRACING}).result; }});
    rows.push_back({"`suppleGetRayGeometry` of a group without `SUPPLE_GROUP_RAY_TRACING`", [](Scene& s) {
                        auto out = Scene::asking<SuppleRayGeometry>();
                        return suppleGetRayGeometry(s.context(), s.cage.group, 0, &out);
                    }});
    rows.push_back({"`suppleGetDirectOutput` of a group without `SUPPLE_GROUP_DIRECT`", [](Scene& s) {
                        auto out = Scene::asking<SuppleDirectOutput>();
                        return suppleGetDirectOutput(s.context(), s.cage.group, 0, &out);
                    }});
    rows.push_back({"a group of Catmull-Clark with `SUPPLE_GROUP_DIRECT`", [](Scene& s) {
                        return createGroup(s.context(), s.asset,
                                           {.flags = SUPPLE_GROUP_DIRECT, .scheme = SUPPLE_SCHEME_CATMULL_CLARK})
                            .result;
                    }});
    rows.push_back({"`SUPPLE_GROUP_DIRECT` with `SUPPLE_GROUP_MOTION`", [](Scene& s) {
                        return createGroup(
                                   s.context(), s.asset,
                                   {.flags = SUPPLE_GROUP_DIRECT | SUPPLE_GROUP_MOTION, .scheme = SUPPLE_SCHEME_PM})
                            .result;
                    }});
    rows.push_back({"a surface that the group lacks", [](Scene& s) {
                        auto out = Scene::asking<SuppleSurfaceInfo>();
                        return suppleGetSurfaceInfo(s.context(), s.cage.group, 1, &out);
                    }});
    rows.push_back({"another rate for an indexed mesh", [](Scene& s) {
                        const SmallGroup mesh =
                            s.group({.flags = SUPPLE_GROUP_INDEXED_MESH, .scheme = SUPPLE_SCHEME_PREP});
                        return suppleSetRate(s.context(), mesh.group, 1);
                    }});
    rows.push_back({"timings before a timed frame is complete", [](Scene& s) {
                        uint32_t count = 0;
                        return suppleGetTimings(s.context(), sizeof(SuppleTiming), nullptr, &count);
                    }});
    rows.push_back({"a group is drawn, but never recorded", [](Scene& s) {
                        auto out = Scene::asking<SuppleGridOutput>();
                        const SmallGroup drawn = s.group({.scheme = SUPPLE_SCHEME_POLYGONS});
                        s.good(suppleGetGridOutput(s.context(), drawn.group, 0, &out));
                        for (int frame = 0; frame < 8; ++frame) {
                            s.own.evaluate({&s.cage.group, 1});
                        }
                        return s.begin(9, 8);
                    }});
}

/// What concerns several groups, or a group that is made anew.
void addShared(std::vector<Mistake>& rows) {
    rows.push_back({"a recording begins late, without `SUPPLE_CONTEXT_RECORDABLE`", [](Scene& s) {
                        auto desc = Scene::asking<SuppleRecordingDesc>();
                        desc.write = [](const void*, size_t, void*) { return 1; };
                        return suppleStartRecording(s.context(), &desc);
                    }});
    static const auto follower = [](Scene& s, uint32_t capacity, SuppleGroup& group) {
        auto desc = Scene::asking<SuppleGroupDesc>();
        desc.asset = s.asset;
        desc.scheme = SUPPLE_SCHEME_POLYGONS;
        desc.capacity = capacity;
        desc.instancesOf = s.cage.group;
        return suppleCreateGroup(s.context(), &desc, &group);
    };
    rows.push_back({"a capacity for a group that follows another one", [](Scene& s) {
                        SuppleGroup group{};
                        return follower(s, 4, group);
                    }});
    rows.push_back({"an instance is created in a group that follows another one", [](Scene& s) {
                        SuppleGroup group{};
                        s.good(follower(s, 0, group));
                        SuppleInstance instance{};
                        return suppleCreateInstance(s.context(), group, &instance);
                    }});
    rows.push_back({"the wind of a group that follows another one", [](Scene& s) {
                        SuppleGroup group{};
                        s.good(follower(s, 0, group));
                        const float wind[3] = {};
                        return suppleSetWind(s.context(), group, wind);
                    }});
    rows.push_back({"a group is recorded without the group that it follows", [](Scene& s) {
                        SuppleGroup group{};
                        s.good(follower(s, 0, group));
                        s.good(s.begin(1, 0));
                        return s.record(group);
                    }});
    rows.push_back({"the capacity shrinks below an instance's slot", [](Scene& s) {
                        const SmallGroup two = s.group({.capacity = 2, .scheme = SUPPLE_SCHEME_CAGE});
                        return suppleSetCapacity(s.context(), two.group, 1);
                    }});
    rows.push_back({"boxes of a group without `SUPPLE_GROUP_BOUNDS`", [](Scene& s) {
                        SuppleBounds box{};
                        uint64_t frame = 0;
                        return suppleReadInstanceBounds(s.context(), s.instance(), &box, &frame);
                    }});
    rows.push_back({"`suppleRecordWarmUp` without a frame",
                    [](Scene& s) { return suppleRecordWarmUp(s.context(), s.commands, &s.cage.group, 1); }});
}

/// A row of the table.
std::string rowOf(const char* what, const Refusal& told) {
    std::string row = std::string("| ") + what + " | `" + suppleResultString(told.result) + "` | ";
    row += told.id != 0 ? std::to_string(told.id) + " " + told.message : std::string(told.message);
    row += " |";
    std::istringstream lines(told.text);
    for (std::string line; std::getline(lines, line);) {
        row += " `" + line + "`";
    }
    return row + " |";
}

std::vector<std::string> documentedRows() {
    std::ifstream file(std::string(SUPPLE_SOURCE_DIR) + "/docs/integration.md");
    std::vector<std::string> rows;
    bool inside = false;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("## ")) {
            inside = line == "## Deliberate mistakes, and their answers";
        } else if (inside && line.starts_with("| ") && !line.starts_with("| the mistake |")) {
            rows.push_back(line);
        }
    }
#if !defined(SUPPLE_WITH_CPU) // no points
    std::erase_if(rows, [](const std::string& row) { return row.starts_with("| a point "); });
#endif
    return rows;
}

TEST(Mistakes, AreAnsweredAsTheDocumentSays) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    std::vector<std::string> rows;
    for (const EarlyMistake& mistake : earlyMistakes()) {
        rows.push_back(rowOf(mistake.what, mistake.make(*device)));
    }
    std::vector<Mistake> mistakes;
    addDescriptions(mistakes);
    addInstances(mistakes);
    addFrames(mistakes);
    addOutputs(mistakes);
    addShared(mistakes);
    for (const Mistake& mistake : mistakes) {
        SCOPED_TRACE(mistake.what);
        Commands commands(*device); // never submitted
        std::unique_ptr<Scene> scene;
        commands.record([&](VkCommandBuffer recording) {
            scene = std::make_unique<Scene>(*device, recording);
            scene->own.takeLines();
            Refusal told;
            told.result = mistake.make(*scene);
            const std::vector<LogLine> lines = scene->own.takeLines();
            EXPECT_LE(lines.size(), 1u) << "one clear line";
            if (!lines.empty()) {
                told.id = lines[0].message;
                told.message = nameOfMessage(lines[0].message);
                told.text = lines[0].text;
            }
            rows.push_back(rowOf(mistake.what, told));
        });
    }
    const std::vector<std::string> documented = documentedRows();
    std::string all = "docs/integration.md should have:\n";
    for (const std::string& row : rows) {
        all += row + "\n";
    }
    EXPECT_EQ(rows, documented) << all;
}

/// Frames that record `other` alone; how many warnings of groups that are never recorded come.
uint32_t warningsIn(LoggedContext& own, uint32_t frames, SuppleGroup other) {
    own.takeLines();
    for (uint32_t i = 0; i < frames; ++i) {
        own.evaluate({&other, 1});
    }
    return own.takeCount(SUPPLE_MESSAGE_NEVER_RECORDED);
}

class NeverRecorded : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_NE(testDevice(), nullptr);
        own = std::make_unique<LoggedContext>(*testDevice());
        ASSERT_EQ(createTube(own->handle(), asset), SUPPLE_OK);
        other = createGroup(own->handle(), asset, {.scheme = SUPPLE_SCHEME_CAGE}).group;
        drawn = createGroup(own->handle(), asset, {.scheme = SUPPLE_SCHEME_POLYGONS});
    }
    void ask() const { static_cast<void>(outputOf(own->handle(), drawn.group)); }

    std::unique_ptr<LoggedContext> own;
    SuppleAsset asset{};
    SuppleGroup other{};
    SmallGroup drawn;
};

TEST_F(NeverRecorded, GivesOneWarningAGroup) {
    ask();
    EXPECT_EQ(warningsIn(*own, 8, other), 0u) << "the eighth frame has not ended";
    own->beginFrame();
    const std::vector<LogLine> lines = own->takeLines();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].severity, SUPPLE_SEVERITY_WARNING);
    EXPECT_EQ(lines[0].text.find("tube: "), 0u) << lines[0].text;
    EXPECT_EQ(warningsIn(*own, 20, other), 0u);
    const SmallGroup more = createGroup(own->handle(), asset, {.scheme = SUPPLE_SCHEME_POLYGONS});
    static_cast<void>(outputOf(own->handle(), more.group));
    EXPECT_EQ(warningsIn(*own, 20, other), 1u) << "of the other group";
}

TEST_F(NeverRecorded, DoesNotWarnOfWhatIsHeldReady) {
    EXPECT_EQ(warningsIn(*own, 20, other), 0u) << "nobody asked for outputs";
    ask();
    ASSERT_EQ(suppleSetVisible(own->handle(), drawn.instances[0], 0), SUPPLE_OK);
    EXPECT_EQ(warningsIn(*own, 20, other), 0u) << "its instance is hidden";
    ASSERT_EQ(suppleDestroyInstance(own->handle(), drawn.instances[0]), SUPPLE_OK);
    EXPECT_EQ(warningsIn(*own, 20, other), 0u) << "it has no instance";
    ASSERT_EQ(suppleCreateInstance(own->handle(), drawn.group, &drawn.instances[0]), SUPPLE_OK);
    for (int i = 0; i < 20; ++i) {
        own->evaluate({});
    }
    EXPECT_EQ(own->takeCount(SUPPLE_MESSAGE_NEVER_RECORDED), 0u) << "nothing at all is recorded yet";
    EXPECT_EQ(warningsIn(*own, 5, other), 0u);
    own->evaluate({&drawn.group, 1});
    EXPECT_EQ(warningsIn(*own, 20, other), 0u) << "it was recorded once";
}

} // namespace
} // namespace supple::test
