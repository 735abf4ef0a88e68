#include "tests/fault/every_call.h"

#include "tests/cage/gltf/builder.h"
#include "tests/support/logged_context.h"
#include "tests/support/tube_file.h"
#if defined(SUPPLE_WITH_CPU)
#include "supple/supple_cpu.h"
#endif

#include <array>
#include <cstring>
#include <gtest/gtest.h>
#include <string>

namespace supple::test {

void Calls::make(const char* name, const std::function<SuppleResult()>& call, SuppleResult good) {
    for (uint64_t n = 0;; n += stride_) {
        fault_.arm(n);
        const SuppleResult result = call();
        if (!fault_.lift()) {
            ASSERT_EQ(result, good) << name;
            return;
        }
        ++positions_;
        ASSERT_EQ(result, fault_.result) << name << ", position " << n;
    }
}

void makeOnce(const char* name, const std::function<SuppleResult()>& call, SuppleResult good) {
    ASSERT_EQ(call(), good) << name;
}

void quiet(SuppleContextDesc& desc) {
    desc.log = [](SuppleSeverity, SuppleMessage, const char*, void*) {};
    desc.flags |= SUPPLE_CONTEXT_ASYNC_COMPUTE;
    desc.drawQueueFamily = desc.queueFamily;
}

uint64_t deviceMemoryOf(SuppleContext context) {
    SuppleMemoryUse use{};
    use.structSize = sizeof(use);
    EXPECT_EQ(suppleGetContextMemory(context, &use), SUPPLE_OK);
    return use.deviceLocal + use.hostVisible;
}

namespace {

/// Six faces: calls are made once for each of their allocations, and pieces of surfaces take thousands of them.
SuppleAssetDesc smallTube(const char* name) {
    static const std::vector<std::byte> file = tubeFileOf(2, 3);
    SuppleAssetDesc desc = tubeDesc(name);
    desc.bytes = file.data();
    desc.byteCount = file.size();
    return desc;
}

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

class EveryCall {
public:
    EveryCall(host::Device& device, const MakeCall& make, const Adjust& adjust, bool recorded)
        : make_(make), context_(device, adjust), device_(device), isRecorded_(recorded) {}

    /// Every function, cold and then with frames in flight. Returns what the frames came out as.
    std::vector<std::byte> run() {
        const uint64_t before = deviceMemoryOf(handle());
        record();
        createAssets();
        createGroups();
        createPoints();
        createQueries();
        prepare();
        pose();
        ask();
        frames(0);
        change();
        pose();
        askMore();
        frames(1);
        std::vector<std::byte> bits;
        if (recorded_ != SUPPLE_OK) { // the device is lost
            destroy();
            return bits;
        }
        for (const SuppleGroup group : {groups_[0], groups_[1], groups_[2], groups_[3]}) {
            const std::vector<std::byte> own = surfaceBits(context_, group);
            bits.insert(bits.end(), own.begin(), own.end());
        }
        destroy();
        EXPECT_LE(deviceMemoryOf(handle()), before) << "something is left on the device";
        return bits;
    }

private:
    void record() {
        SuppleRecordingDesc recording{};
        recording.structSize = sizeof(recording);
        recording.flags = SUPPLE_RECORDING_HASHES;
        recording.write = [](const void*, size_t, void*) { return 1; };
        SuppleResult started = SUPPLE_OK;
        call("suppleStartRecording", [&] { return started = suppleStartRecording(handle(), &recording); });
        if (!isRecorded_) {
            EXPECT_EQ(suppleStopRecording(handle()), SUPPLE_OK);
        }
        isRecorded_ = isRecorded_ && started == SUPPLE_OK; // else the device is lost
    }
    /// A character on its way through a worker, and a group of it.
    void prepare() {
        SuppleGroupDesc group{};
        group.structSize = sizeof(group);
        group.capacity = 1;
        group.rate = 2;
        group.scheme = SUPPLE_SCHEME_CATMULL_CLARK;
        const SupplePlannedGroup planned{&group, 0, 0};
        const SuppleAssetDesc read = smallTube("another tube whose name is too long to lie in a string itself");
        SupplePrepareDesc desc{};
        desc.structSize = sizeof(desc);
        desc.mapping = SUPPLE_MAPPING_NARROW;
        desc.asset = &read;
        desc.groups = &planned;
        desc.groupCount = 1;
        SupplePrepared prepared = nullptr;
        call("supplePrepare", [&] { return supplePrepare(&desc, &prepared); });
        call("suppleMakePipelines", [&] { return suppleMakePipelines(handle(), prepared, &planned, 1); });
        std::vector<std::byte> cooked(1 << 20);
        size_t size = cooked.size();
        call("suppleSavePrepared", [&] { return suppleSavePrepared(prepared, nullptr, cooked.data(), &size); });
        SuppleAssetDesc fromFile{};
        fromFile.structSize = sizeof(fromFile);
        fromFile.bytes = cooked.data();
        fromFile.byteCount = size;
        SuppleAsset loaded{};
        call("suppleCreateAsset, cooked", [&] { return suppleCreateAsset(handle(), &fromFile, &loaded); });
        call("suppleDestroyAsset, cooked", [&] { return suppleDestroyAsset(handle(), loaded); });
        SuppleAssetDesc given{};
        given.structSize = sizeof(given);
        given.prepared = prepared;
        call("suppleCreateAsset, prepared", [&] { return suppleCreateAsset(handle(), &given, &group.asset); });
        onCpu(prepared, group);
        suppleDestroyPrepared(prepared);
        SuppleGroup made{};
        call("suppleCreateGroup, prepared", [&] { return suppleCreateGroup(handle(), &group, &made); });
        call("suppleDestroyGroup, prepared", [&] { return suppleDestroyGroup(handle(), made); });
        call("suppleDestroyAsset, prepared", [&] { return suppleDestroyAsset(handle(), group.asset); });
    }

    /// Its surface without a device.
    void onCpu([[maybe_unused]] SupplePrepared prepared, [[maybe_unused]] const SuppleGroupDesc& planned) {
#if defined(SUPPLE_WITH_CPU)
        SuppleCpuGroupDesc desc{};
        desc.structSize = sizeof(desc);
        desc.prepared = prepared;
        desc.group = &planned;
        SuppleCpuGroup surfaces = nullptr;
        SuppleCpuPose posed = nullptr;
        call("suppleCpuCreateGroup", [&] { return suppleCpuCreateGroup(&desc, &surfaces); });
        call("suppleCpuCreatePose", [&] { return suppleCpuCreatePose(surfaces, &posed); });
        SuppleCpuGroupInfo info{};
        info.structSize = sizeof(info);
        call("suppleCpuGetGroupInfo", [&] { return suppleCpuGetGroupInfo(surfaces, &info); });
        std::vector<float> cage(size_t{3} * info.cageVertexCount, 1.0f);
        call("suppleCpuBuildPose",
             [&] { return suppleCpuBuildPose(posed, cage.data(), 12, info.cageVertexCount, nullptr); });
        const SuppleSurfacePoint point{0, 0, 0.5f, 0.25f};
        SuppleSurfaceJet jet{};
        call("suppleCpuEvaluatePoints", [&] { return suppleCpuEvaluatePoints(posed, &point, 1, &jet, nullptr); });
        uint32_t count = 0;
        call("suppleCpuGetPatches", [&] { return suppleCpuGetPatches(surfaces, 0, nullptr, &count); });
        SuppleCpuGridInfo grid{};
        grid.structSize = sizeof(grid);
        call("suppleCpuGetGridInfo", [&] { return suppleCpuGetGridInfo(surfaces, 0, 3, &grid); });
        std::vector<uint32_t> indices(grid.indexCount);
        call("suppleCpuGetGridIndices",
             [&] { return suppleCpuGetGridIndices(surfaces, 0, 3, indices.data(), grid.indexCount); });
        std::vector<float> positions(size_t{3} * grid.vertexCount), normals(positions.size());
        call("suppleCpuEvaluateGrid", [&] {
            return suppleCpuEvaluateGrid(posed, 0, 3, positions.data(), normals.data(), grid.vertexCount, nullptr);
        });
        suppleCpuDestroyPose(posed);
        suppleCpuDestroyGroup(surfaces);
#endif
    }

    void call(const char* name, const std::function<SuppleResult()>& body, SuppleResult good = SUPPLE_OK) {
        make_(name, body, good);
    }

    void createAssets() {
        SuppleAssetDesc desc = smallTube("a tube whose name is too long to lie in a string itself");
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
        SuppleNodeDesc node{};
        node.structSize = sizeof(node);
        node.parent = SUPPLE_NO_NODE;
        node.name = "a node with a name that is long enough to need memory of its own";
        SupplePartDesc part{};
        part.structSize = sizeof(part);
        part.cage = &cage;
        const float times[] = {0.0f, 1.0f}, values[] = {0, 0, 0, 0, 1, 0};
        SuppleChannelDesc channel{};
        channel.structSize = sizeof(channel);
        channel.keyCount = 2;
        channel.valueCount = 6;
        channel.times = times;
        channel.values = values;
        SuppleClipDesc clip{};
        clip.structSize = sizeof(clip);
        clip.channelCount = 1;
        clip.channels = &channel;
        SuppleCharacterDesc character{};
        character.structSize = sizeof(character);
        character.nodeCount = character.partCount = character.clipCount = 1;
        character.nodes = &node;
        character.parts = &part;
        character.clips = &clip;
        other.cage = nullptr;
        other.character = &character;
        call("suppleReloadAsset, a character of arrays", [&] { return suppleReloadAsset(handle(), square, &other); });
        call("suppleDestroyAsset", [&] { return suppleDestroyAsset(handle(), square); });

        other.character = nullptr;
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
        viewDesc.coefficientBytes = 1 << 20;
        call("suppleCreateView", [&] { return suppleCreateView(handle(), &viewDesc, &view_); });
        const SuppleGroupDesc wanted[] = {
            {.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_PATCHES | SUPPLE_GROUP_BOUNDS,
             .scheme = SUPPLE_SCHEME_PM},
            {.flags = SUPPLE_GROUP_ATTRIBUTES, .scheme = SUPPLE_SCHEME_CATMULL_CLARK},
            {.scheme = SUPPLE_SCHEME_POLYGONS},
            {.flags = SUPPLE_GROUP_MODIFIERS | SUPPLE_GROUP_TRANSITIONS | SUPPLE_GROUP_UPDATE_RATES,
             .scheme = SUPPLE_SCHEME_PREP,
             .poseSource = SUPPLE_POSES_PLAYBACK},
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

    /// Of two groups, whose frames then have them; the first set is left to them.
    void createPoints() {
#if defined(SUPPLE_WITH_CPU)
        const SuppleSurfacePoint points[] = {{0, 0, 0.5f, 0.25f}, {1, 0, 0.0f, 1.0f}};
        const float tangents[] = {1, 0, 0, 0, 1, 0};
        SupplePointSetDesc desc{};
        desc.structSize = sizeof(desc);
        desc.points = points;
        desc.tangents = tangents;
        desc.pointCount = 2;
        desc.format = SUPPLE_POINT_FRAME_64;
        SupplePointSet set{};
        desc.group = groups_[0];
        call("suppleCreatePointSet", [&] { return suppleCreatePointSet(handle(), &desc, &set); });
        get<SupplePointOutput>("suppleGetPointOutput",
                               [&](auto* out) { return suppleGetPointOutput(handle(), set, out); });
        const float place[] = {0.5f, 1.0f, 0.25f};
        SupplePointQuery query{};
        query.structSize = sizeof(query);
        query.count = 1;
        query.values = place;
        SuppleSurfacePoint nearest{};
        call("suppleFindPoints", [&] { return suppleFindPoints(handle(), groups_[0], &query, &nearest); });
        const float ray[] = {0.5f, 1.0f, 9.0f, 0.0f, 0.0f, -1.0f};
        SuppleSurfaceJet jet{};
        query.kind = SUPPLE_FIND_RAY;
        query.values = ray;
        query.jets = &jet;
        call("suppleFindPoints", [&] { return suppleFindPoints(handle(), groups_[0], &query, &nearest); });
        query.kind = SUPPLE_FIND_GIVEN;
        query.values = nullptr;
        call("suppleFindPoints", [&] { return suppleFindPoints(handle(), groups_[0], &query, &nearest); });
        desc.group = groups_[1];
        call("suppleCreatePointSet", [&] { return suppleCreatePointSet(handle(), &desc, &set); });
        desc.group = groups_[0];
        desc.flags = SUPPLE_POINT_SET_ON_VERTICES;
        SupplePointSet onVertices{};
        call("suppleCreatePointSet", [&] { return suppleCreatePointSet(handle(), &desc, &onVertices); });
        call("suppleDestroyPointSet", [&] { return suppleDestroyPointSet(handle(), set); });
#endif
    }

    /// A pool has two groups, one of them in a view.
    void createQueries() {
#if defined(SUPPLE_WITH_CPU)
        const SuppleGroup groups[] = {groups_[0], groups_[kGroups - 1]};
        SuppleQueryPoolDesc desc{};
        desc.structSize = sizeof(desc);
        desc.groups = groups;
        desc.groupCount = 2;
        desc.rayCount = 2;
        desc.flags = SUPPLE_QUERY_POOL_NEAREST;
        call("suppleCreateQueryPool", [&] { return suppleCreateQueryPool(handle(), &desc, &queries_); });
        call("suppleCreateQueryPool", [&] { return suppleCreateQueryPool(handle(), &desc, &nearest_); });
        get<SuppleQueryOutput>("suppleGetQueryOutput",
                               [&](auto* out) { return suppleGetQueryOutput(handle(), queries_, out); });
        SuppleQueryPool other{};
        call("suppleCreateQueryPool", [&] { return suppleCreateQueryPool(handle(), &desc, &other); });
        call("suppleDestroyQueryPool", [&] { return suppleDestroyQueryPool(handle(), other); });
#endif
    }
    void recordQueries(VkCommandBuffer commands) {
#if defined(SUPPLE_WITH_CPU)
        const SuppleRay rays[] = {{{0.5f, 1.0f, 9.0f}, 0.0f, {0.0f, 0.0f, -1.0f}, 100.0f}, {}};
        SuppleQueryDesc desc{};
        desc.structSize = sizeof(desc);
        desc.flags = SUPPLE_QUERY_READ_BACK;
        desc.hostRays = rays;
        desc.rayCount = 2;
        desc.before = desc.after = kAnyUse;
        call("suppleRecordQueries", [&] { return suppleRecordQueries(handle(), commands, queries_, &desc); });
        const SupplePlace places[] = {{{0.5f, 1.0f, 9.0f}, 100.0f}, {}};
        desc.hostRays = nullptr;
        desc.hostPlaces = places;
        call("suppleRecordQueries", [&] { return suppleRecordQueries(handle(), commands, nearest_, &desc); });
        SuppleHit hits[2];
        uint32_t count = 2;
        const SuppleResult read = suppleReadHits(handle(), queries_, hits, &count, nullptr);
        EXPECT_TRUE(read == SUPPLE_OK || read == SUPPLE_NOT_READY);
#else
        (void)commands;
#endif
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
                    desc.transition = 0.3;
                    call("suppleSetPlayback", [&] { return suppleSetPlayback(handle(), instance, &desc); });
                    modify(instance);
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

    void modify(SuppleInstance instance) {
        SuppleModifier modifier{};
        modifier.kind = SUPPLE_MODIFIER_TWO_BONE;
        modifier.joint = 2;
        modifier.weight = 1.0f;
        SuppleModifiersDesc desc{};
        desc.structSize = sizeof(desc);
        desc.modifiers = &modifier;
        desc.modifierCount = 1;
        call("suppleSetModifiers", [&] { return suppleSetModifiers(handle(), instance, &desc); });
        SuppleModifierTarget target{};
        target.structSize = sizeof(target);
        target.target[1] = 0.5;
        call("suppleSetModifierTarget", [&] { return suppleSetModifierTarget(handle(), instance, 0, &target); });
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
        SuppleJointMatricesDesc some{};
        const uint32_t second = 1;
        some.structSize = sizeof(some);
        some.jointCount = 1;
        some.jointMatrices = matrices;
        some.joints = &second;
        call("suppleSetJointMatrices", [&] { return suppleSetJointMatrices(handle(), instance, &some); });
        call("suppleSetPose", [&] { return suppleSetPose(handle(), instance, &desc); });
        call("suppleSetClipPose", [&] { return suppleSetClipPose(handle(), instance, 0, 0.75); });
        call("suppleSetUserData", [&] { return suppleSetUserData(handle(), instance, data); });
        call(
            "suppleSetSharpness", [&] { return suppleSetSharpness(handle(), instance, 0, 1.0f); },
            SUPPLE_ERROR_ARGUMENT);
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
        call("suppleRequestClip", [&] { return suppleRequestClip(handle(), tube_, 0, nullptr); });
        get<SuppleClipInfo>("suppleGetClipInfo", [&](auto* out) { return suppleGetClipInfo(handle(), tube_, 0, out); });
        get<SuppleJointInfo>("suppleGetJointInfo",
                             [&](auto* out) { return suppleGetJointInfo(handle(), tube_, 0, out); });
        get<SuppleMaterialInfo>("suppleGetMaterialInfo",
                                [&](auto* out) { return suppleGetMaterialInfo(handle(), tube_, 0, out); });
        get<SuppleMaterialLayers>("suppleGetMaterialLayers",
                                  [&](auto* out) { return suppleGetMaterialLayers(handle(), tube_, 0, out); });
        call("suppleGetMaterialVariants", [&] {
            uint32_t count = 0;
            return suppleGetMaterialVariants(handle(), tube_, nullptr, &count);
        });
        get<SuppleImageInfo>("suppleGetImageInfo",
                             [&](auto* out) { return suppleGetImageInfo(handle(), tube_, 0, out); });
        get<SuppleGroupInfo>("suppleGetGroupInfo",
                             [&](auto* out) { return suppleGetGroupInfo(handle(), groups_[0], out); });
        get<SuppleGridOutput>("suppleGetGridOutput",
                              [&](auto* out) { return suppleGetGridOutput(handle(), groups_[0], 0, out); });
        get<SuppleUploadState>("suppleGetGroupUploadState",
                               [&](auto* out) { return suppleGetGroupUploadState(handle(), groups_[0], out); });
        get<SuppleMemoryUse>("suppleGetGroupMemory",
                             [&](auto* out) { return suppleGetGroupMemory(handle(), groups_[0], out); });
        SuppleBounds bounds{};
        call("suppleGetClipBounds", [&] { return suppleGetClipBounds(handle(), tube_, 0, &bounds); });
        call("suppleGetGroupClipBounds", [&] { return suppleGetGroupClipBounds(handle(), groups_[0], 0, &bounds); });
        float mask[3] = {};
        call("suppleFillJointMask", [&] { return suppleFillJointMask(handle(), tube_, 0, 1.0f, mask, 3); });
        SuppleExpressionInfo expression{};
        expression.structSize = sizeof expression;
        call(
            "suppleGetExpressionInfo, of none",
            [&] { return suppleGetExpressionInfo(handle(), tube_, 0, &expression); }, SUPPLE_ERROR_ARGUMENT);
        SuppleAssetInfo asset{};
        asset.structSize = sizeof asset;
        call("suppleGetAssetInfo, for its targets", [&] { return suppleGetAssetInfo(handle(), tube_, &asset); });
        std::vector<float> weights(asset.morphTargetCount);
        call("suppleFillExpressionWeights", [&] {
            return suppleFillExpressionWeights(handle(), tube_, nullptr, 0, weights.data(), asset.morphTargetCount);
        });
        float socket[16];
        call("suppleGetJointTransform", [&] { return suppleGetJointTransform(handle(), instances_[0][0], 1, socket); });
        uint32_t count = 0;
        call("suppleGetCreaseSets", [&] { return suppleGetCreaseSets(handle(), tube_, nullptr, &count); });
        float sharpness = 0.0f;
        call(
            "suppleGetClipSharpness", [&] { return suppleGetClipSharpness(handle(), tube_, 0, 0, 0.0, &sharpness); },
            SUPPLE_ERROR_ARGUMENT);
        call("suppleGetClipContacts", [&] { return suppleGetClipContacts(handle(), tube_, 0, nullptr, &count); });
        call("suppleGetClipMarkers", [&] { return suppleGetClipMarkers(handle(), tube_, 0, nullptr, &count); });
        call(
            "suppleGetTimings", [&] { return suppleGetTimings(handle(), sizeof(SuppleTiming), nullptr, &count); },
            SUPPLE_NOT_READY);
        call("suppleSetBudget", [&] { return suppleSetBudget(handle(), SUPPLE_PASS_EVALUATE, 1e9); });
        call(
            "suppleSetBudget, of no pass", [&] { return suppleSetBudget(handle(), SUPPLE_PASS_MAX_ENUM, 1e6); },
            SUPPLE_ERROR_ARGUMENT);
        call("suppleSetUploadBudget", [&] { return suppleSetUploadBudget(handle(), 1u << 20); });
        call("suppleSetUploadBudget, taken away", [&] { return suppleSetUploadBudget(handle(), 0); });
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
        SuppleRayGeometry geometry{};
        geometry.structSize = sizeof(geometry);
        call(
            "suppleGetRayGeometry, of a group that is not traced",
            [&] { return suppleGetRayGeometry(handle(), groups_[0], 0, &geometry); }, SUPPLE_ERROR_ARGUMENT);
        SuppleDirectOutput direct{};
        direct.structSize = sizeof(direct);
        call(
            "suppleGetDirectOutput, of a group that stores its vertices",
            [&] { return suppleGetDirectOutput(handle(), groups_[0], 0, &direct); }, SUPPLE_ERROR_ARGUMENT);
        get<SuppleLevelOutput>("suppleGetLevelOutput",
                               [&](auto* out) { return suppleGetLevelOutput(handle(), groups_[kSeen], 0, out); });
        get<SuppleMemoryUse>("suppleGetAssetMemory",
                             [&](auto* out) { return suppleGetAssetMemory(handle(), tube_, out); });
        get<SuppleMemoryUse>("suppleGetViewMemory",
                             [&](auto* out) { return suppleGetViewMemory(handle(), view_, out); });
        get<SuppleMemoryUse>("suppleGetContextMemory",
                             [&](auto* out) { return suppleGetContextMemory(handle(), out); });
        get<SuppleUploadState>("suppleGetAssetUploadState",
                               [&](auto* out) { return suppleGetAssetUploadState(handle(), tube_, out); });
        get<SuppleUploadState>("suppleGetUploadState", [&](auto* out) { return suppleGetUploadState(handle(), out); });
        get<SuppleBudget>("suppleGetBudget",
                          [&](auto* out) { return suppleGetBudget(handle(), SUPPLE_PASS_EVALUATE, out); });
        SuppleViewStatistics statistics{};
        statistics.structSize = sizeof(statistics);
        ready("suppleGetViewStatistics", [&] { return suppleGetViewStatistics(handle(), view_, &statistics); });
        SuppleBufferRange range{};
        ready("suppleGetInstanceBounds", [&] { return suppleGetInstanceBounds(handle(), groups_[0], &range); });
        SuppleMapping mapping = SUPPLE_MAPPING_AUTO;
        call("suppleGetMapping", [&] { return suppleGetMapping(handle(), &mapping); });
        uint64_t ticks = 0;
        ready("suppleGetTimingOrigin", [&] { return suppleGetTimingOrigin(handle(), &ticks); });
        uint32_t count = 0;
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
        call("suppleRecord", [&] { return recorded_ = context_.record(commands, all, SUPPLE_RECORD_TIMINGS); });
        if (recorded_ == SUPPLE_OK) {
            recordQueries(commands);
        }
        uint32_t count = 0;
        call("suppleGetAcquireBarriers",
             [&] { return suppleGetAcquireBarriers(handle(), all.data(), 1, kAnyUse, nullptr, &count); });
    }

    void change() {
        for (size_t i = 0; i < kGroups; ++i) {
            call("suppleSetCapacity", [&] { return suppleSetCapacity(handle(), groups_[i], 3); });
            createInstance(i);
        }
        const float wind[3] = {1.0f, 0.0f, 2.0f};
        call("suppleSetWind", [&] { return suppleSetWind(handle(), groups_[1], wind); });
        call("suppleSetRate", [&] { return suppleSetRate(handle(), groups_[1], 1); });
        const SuppleAssetDesc desc = smallTube("a tube whose name is too long to lie in a string itself");
        call("suppleReloadAsset", [&] { return suppleReloadAsset(handle(), tube_, &desc); });
    }

    void destroy() {
        if (isRecorded_) {
            EXPECT_EQ(suppleStopRecording(handle()), SUPPLE_OK);
        }
        call("suppleBeginFrame", [&] { return suppleBeginFrame(handle(), frame_ + 1, frame_); });
        ++frame_;
#if defined(SUPPLE_WITH_CPU)
        call("suppleDestroyQueryPool", [&] { return suppleDestroyQueryPool(handle(), queries_); });
        call("suppleDestroyQueryPool", [&] { return suppleDestroyQueryPool(handle(), nearest_); });
#endif
        for (size_t i = 0; i < kGroups; ++i) {
            call("suppleDestroyInstance", [&] { return suppleDestroyInstance(handle(), instances_[i][0]); });
            call("suppleDestroyGroup", [&] { return suppleDestroyGroup(handle(), groups_[i]); });
        }
        call("suppleDestroyView", [&] { return suppleDestroyView(handle(), view_); });
        call("suppleDestroyAsset", [&] { return suppleDestroyAsset(handle(), tube_); });
        call("suppleDestroyAsset", [&] { return suppleDestroyAsset(handle(), quad_); });
        call("suppleBeginFrame", [&] { return suppleBeginFrame(handle(), frame_ + 1, frame_); });
    }

    [[nodiscard]] SuppleContext handle() const {
        return context_.handle();
    }

    static constexpr size_t kGroups = 7, kPlayed = 3, kSeen = 6;
    const MakeCall& make_;
    LoggedContext context_;
    host::Device& device_;
    bool isRecorded_;
    Files files_;
    uint64_t frame_ = 0;
    SuppleResult recorded_ = SUPPLE_OK; ///< what the last suppleRecord returned
    SuppleAsset tube_{}, quad_{};
    SuppleView view_{};
#if defined(SUPPLE_WITH_CPU)
    SuppleQueryPool queries_{}, nearest_{};
#endif
    std::array<SuppleGroup, kGroups> groups_{};
    std::array<std::vector<SuppleInstance>, kGroups> instances_;
};

} // namespace

std::vector<std::byte> makeEveryCall(host::Device& device, const MakeCall& make, const Adjust& adjust, bool recorded) {
    return EveryCall(device, make, adjust, recorded).run();
}

} // namespace supple::test
