// The contract with the host: what crosses per frame, barriers, failures that leave everything usable, refusals.
#include "cage/gltf/reader.h"
#include "skinning/pose.h"
#include "tests/cage/gltf/builder.h"
#include "tests/support/gpu_surface.h"
#include "tests/support/logged_context.h"
#include "tests/support/meshes.h"
#include "tests/support/sample_assets.h"
#include "tests/support/wrapped_vulkan.h"
#include "tools/common/cage_arrays.h"
#include "tools/common/procedural.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>
#include <set>

namespace supple::test {
namespace {

/// A device of its own whose Supple calls go through the wrapped table, validation on.
std::unique_ptr<host::Device> wrappedDevice(bool validation = true) {
    host::DeviceOptions options;
    options.validation = validation;
    options.suppleGetInstanceProcAddr = &wrappedGetInstanceProcAddr;
    Result<std::unique_ptr<host::Device>> device = host::Device::create(options);
    if (!device) {
        ADD_FAILURE() << device.error().message;
        return nullptr;
    }
    return std::move(*device);
}

struct Character {
    SuppleAsset asset{};
    SuppleGroup group{};
    std::vector<SuppleInstance> instances;
    SuppleResult result = SUPPLE_OK;
};
/// A group of `instances` of a cube sphere, or the first error.
Character makeCharacter(SuppleContext context, uint32_t instances = 1, SuppleScheme scheme = SUPPLE_SCHEME_AUTO) {
    const cage::Cage cage = cage::makeCubeSphere(4);
    const host::CageArrays arrays(cage);
    SuppleAssetDesc assetDesc{};
    assetDesc.structSize = sizeof(assetDesc);
    assetDesc.name = "sphere";
    assetDesc.cage = &arrays.desc;
    Character c;
    c.result = suppleCreateAsset(context, &assetDesc, &c.asset);
    if (c.result != SUPPLE_OK) {
        return c;
    }
    SuppleGroupDesc groupDesc{};
    groupDesc.structSize = sizeof(groupDesc);
    groupDesc.asset = c.asset;
    groupDesc.capacity = instances;
    groupDesc.scheme = scheme;
    groupDesc.rate = 3;
    groupDesc.flags = SUPPLE_GROUP_PATCHES | SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_WINDOWS;
    c.result = suppleCreateGroup(context, &groupDesc, &c.group);
    c.instances.resize(c.result == SUPPLE_OK ? instances : 0);
    for (SuppleInstance& instance : c.instances) {
        EXPECT_EQ(suppleCreateInstance(context, c.group, &instance), SUPPLE_OK);
    }
    return c;
}

TEST(Contract, OnlyPosesCrossPerFrame) {
    wrappedVulkan();
    const std::unique_ptr<host::Device> device = wrappedDevice();
    ASSERT_NE(device, nullptr);
    constexpr uint32_t kInstances = 5;
    {
        GpuOptions options;
        options.instanceCount = kInstances;
        Result<std::unique_ptr<host::Context>> context = host::Context::create(*device);
        ASSERT_TRUE(context.ok()) << context.error().message;
        std::vector<std::byte> bytes;
        {
            std::FILE* file = std::fopen(kPipQuads.c_str(), "rb");
            ASSERT_NE(file, nullptr);
            std::byte buffer[4096];
            for (size_t n = 0; (n = std::fread(buffer, 1, sizeof(buffer), file)) > 0;) {
                bytes.insert(bytes.end(), buffer, buffer + n);
            }
            std::fclose(file);
        }
        SuppleAssetDesc assetDesc{};
        assetDesc.structSize = sizeof(assetDesc);
        assetDesc.bytes = bytes.data();
        assetDesc.byteCount = bytes.size();
        SuppleAsset asset{};
        ASSERT_EQ(suppleCreateAsset((*context)->handle(), &assetDesc, &asset), SUPPLE_OK);
        SuppleAssetInfo info{};
        info.structSize = sizeof(info);
        ASSERT_EQ(suppleGetAssetInfo((*context)->handle(), asset, &info), SUPPLE_OK);
        SuppleGroupDesc groupDesc{};
        groupDesc.structSize = sizeof(groupDesc);
        groupDesc.asset = asset;
        groupDesc.capacity = kInstances;
        SuppleGroup group{};
        ASSERT_EQ(suppleCreateGroup((*context)->handle(), &groupDesc, &group), SUPPLE_OK);
        std::vector<SuppleInstance> instances;
        ASSERT_TRUE((*context)->createInstances(group, kInstances, instances).ok());
        host::GroupOutput output{};
        ASSERT_EQ(host::getGroupOutput((*context)->handle(), group, output), SUPPLE_OK);
        ASSERT_TRUE((*context)->evaluate({&group, 1}).ok()); // the first frame uploads the static tables

        const uint64_t paletteBytes = uint64_t{kInstances} * info.jointCount * 48;
        for (uint32_t frame = 0; frame < 10; ++frame) {
            WrappedVulkan& counts = wrappedVulkan();
            for (uint32_t i = 0; i < kInstances; ++i) {
                ASSERT_EQ(suppleSetClipPose((*context)->handle(), instances[i], 1, 0.1 * frame + 0.3 * i), SUPPLE_OK);
            }
            ASSERT_TRUE((*context)->evaluate({&group, 1}, frame % 2 == 0 ? SUPPLE_RECORD_TIMINGS : 0).ok());
            EXPECT_EQ(counts.maps, 0u);
            EXPECT_EQ(counts.flushes, 0u);
            EXPECT_EQ(counts.updates, 0u);
            EXPECT_EQ(counts.invalidates, 0u);
            EXPECT_EQ(counts.fills, 0u);
            EXPECT_EQ(counts.allocations, 0u);
            EXPECT_EQ(counts.buffers, 0u);
            // In the second frame the instances have come to have a past; then the lists stand.
            const bool listed = frame == 0;
            EXPECT_EQ(counts.copies, listed ? 4u : 1u) << "poses; the two lists of instances, draws";
            EXPECT_EQ(counts.copiedBytes,
                      paletteBytes +
                          (listed ? uint64_t{kInstances} * 8 + uint64_t{output.grid.drawRangeCount} * 20 : uint64_t{0}))
                << "joint palettes, who is drawn, and nothing else";
        }
        std::printf("%llu bytes cross per frame: %u instances x %u joints x 48\n",
                    static_cast<unsigned long long>(paletteBytes), kInstances, info.jointCount);
    }
    EXPECT_EQ(device->validation()->messageCount(), 0u);
}

TEST(Contract, AMissingBarrierIsSeenByTheValidationLayer) {
    // Barriers of a frame in order: entry, uploads, deform, vertex, points of level 1, chains, exit. Those between
    // passes must each matter.
    for (const int64_t dropped : {1, 2, 3, 4, 5}) {
        wrappedVulkan();
        const std::unique_ptr<host::Device> device = wrappedDevice();
        ASSERT_NE(device, nullptr);
        {
            host::ContextOptions options;
            // In the other mapping a kernel reads and writes the pool through one binding, and the layer misses what it
            // reads.
            options.mapping = SUPPLE_MAPPING_NARROW;
            Result<std::unique_ptr<host::Context>> context = host::Context::create(*device, options);
            ASSERT_TRUE(context.ok());
            Character c = makeCharacter((*context)->handle());
            ASSERT_EQ(c.result, SUPPLE_OK);
            ASSERT_TRUE((*context)->evaluate({&c.group, 1}).ok());
            ASSERT_EQ(device->validation()->messageCount(), 0u);
            WrappedVulkan& wrapped = wrappedVulkan();
            wrapped.dropBarrier = dropped;
            ASSERT_TRUE((*context)->evaluate({&c.group, 1}).ok());
            EXPECT_EQ(wrapped.barriers, 7u) << "the frame has other barriers now: look at the indices above";
        }
        EXPECT_GT(device->validation()->messageCount(), 0u) << "barrier " << dropped;
    }
}

TEST(Contract, OutOfMemoryLeavesTheContextUsable) {
    for (const bool hostMemory : {false, true}) {
        wrappedVulkan();
        std::unique_ptr<host::Device> device = wrappedDevice();
        ASSERT_NE(device, nullptr);
        const auto validation = device->validation();
        uint32_t failures = 0;
        {
            LoggedContext context(*device);
            ASSERT_EQ(context.result(), SUPPLE_OK);
            for (int64_t n = 0;; ++n) {
                WrappedVulkan& wrapped = wrappedVulkan();
                (hostMemory ? wrapped.failBuffer : wrapped.failAllocation) = n;
                Character c = makeCharacter(context.handle(), 2);
                if (c.result == SUPPLE_OK) {
                    break;
                }
                ++failures;
                EXPECT_EQ(c.result, hostMemory ? SUPPLE_ERROR_HOST_MEMORY : SUPPLE_ERROR_DEVICE_MEMORY)
                    << "failure " << n;
                if (c.asset.id != 0) {
                    EXPECT_EQ(suppleDestroyAsset(context.handle(), c.asset), SUPPLE_OK);
                }
                ASSERT_LT(n, 100);
            }
            wrappedVulkan();
            Character c = makeCharacter(context.handle(), 2);
            ASSERT_EQ(c.result, SUPPLE_OK);
            context.evaluate({&c.group, 1});
        }
        EXPECT_GT(failures, 4u);
        device = nullptr; // only now is a leak spoken of
        EXPECT_EQ(validation->messageCount(), 0u) << "something leaked";
    }
}

TEST(Contract, AnOldDeviceIsNamed) {
    WrappedVulkan& wrapped = wrappedVulkan();
    const std::unique_ptr<host::Device> device = wrappedDevice(false);
    ASSERT_NE(device, nullptr);
    wrapped.apiVersion = VK_API_VERSION_1_0;
    SuppleRequirements requirements{};
    requirements.structSize = sizeof(requirements);
    EXPECT_EQ(suppleQueryRequirements(device->instance(), device->physicalDevice(), &wrappedGetInstanceProcAddr,
                                      &requirements),
              SUPPLE_ERROR_UNSUPPORTED);
    EXPECT_STREQ(requirements.reason, "Vulkan 1.1 (it offers 1.0)");
    const Result<std::unique_ptr<host::Context>> context = host::Context::create(*device);
    ASSERT_FALSE(context.ok());
    EXPECT_NE(context.error().message.find("Vulkan 1.1 (it offers 1.0)"), std::string::npos) << context.error().message;
}

TEST(Contract, InstancesHaveTheirOwnPoseAndTransform) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    GpuOptions options;
    options.instanceCount = 3;
    options.rate = 2;
    GpuSurface three(*device, kPipQuads, options);
    options.instanceCount = 1;
    GpuSurface alone(*device, kPipQuads, options);
    ASSERT_TRUE(three.valid() && alone.valid());
    const glm::mat4 transform =
        glm::rotate(glm::translate(glm::mat4(1.0f), {3.0f, 0.5f, -2.0f}), 0.7f, {0.0f, 1.0f, 0.0f});
    SuppleContext context = three.context().handle();
    ASSERT_EQ(suppleSetClipPose(context, three.instance(0), 0, 0.4), SUPPLE_OK);
    ASSERT_EQ(suppleSetClipPose(context, three.instance(1), 1, 0.9), SUPPLE_OK);
    ASSERT_EQ(suppleSetClipPose(context, three.instance(2), 1, 0.9), SUPPLE_OK);
    ASSERT_EQ(suppleSetTransform(context, three.instance(2), glm::value_ptr(transform)), SUPPLE_OK);
    three.evaluate();
    ASSERT_EQ(suppleSetClipPose(context, alone.instance(0), 1, 0.9), SUPPLE_OK);
    alone.evaluate();
    double moved = 0.0, turned = 0.0;
    for (uint32_t p = 0; p < three.output().surface.patchCount; ++p) {
        for (uint32_t s = 0; s < three.sampleCount(p); ++s) {
            const GpuSurface::Vertex &a = alone.vertex(0, p, s), &b = three.vertex(1, p, s), &c = three.vertex(2, p, s);
            ASSERT_EQ(std::memcmp(&a, &b, sizeof(a)), 0) << "an instance's bits depend on its neighbours";
            moved =
                std::max<double>(moved, glm::length(glm::vec3(transform * glm::vec4(b.position, 1.0f)) - c.position));
            turned = std::max<double>(turned, glm::length(glm::mat3(transform) * b.normal - c.normal));
        }
    }
    EXPECT_LT(moved, 1e-5);
    EXPECT_LT(turned, 1e-3);
}

TEST(Contract, MatrixPosesEqualClipPoses) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    const Result<cage::Character> character = cage::readGltfFile(kPipQuads);
    ASSERT_TRUE(character.ok());
    std::vector<glm::mat4> nodes(character->skeleton.nodes.size()), joints;
    skinning::sampleClip(character->skeleton, character->clips[2], 1.1, nodes);
    skinning::globalTransforms(character->skeleton, nodes, nodes);
    for (const uint32_t node : character->skin.joints) {
        joints.push_back(nodes[node]);
    }
    GpuOptions options;
    options.instanceCount = 2;
    options.rate = 1;
    GpuSurface gpu(*device, kPipQuads, options);
    ASSERT_TRUE(gpu.valid());
    SuppleContext context = gpu.context().handle();
    ASSERT_EQ(suppleSetClipPose(context, gpu.instance(0), 2, 1.1), SUPPLE_OK);
    ASSERT_EQ(
        suppleSetMatrixPose(context, gpu.instance(1), glm::value_ptr(joints[0]), static_cast<uint32_t>(joints.size())),
        SUPPLE_OK);
    gpu.evaluate();
    double worst = 0.0;
    for (uint32_t v = 0; v < gpu.output().info.cageVertexCount; ++v) {
        worst = std::max<double>(worst, glm::length(gpu.deformed(0, v) - gpu.deformed(1, v)));
    }
    EXPECT_LT(worst, 1e-6);
}

TEST(Contract, DestroyedGroupsLiveUntilTheirFrameIsComplete) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    Result<std::unique_ptr<host::Context>> created = host::Context::create(*device);
    ASSERT_TRUE(created.ok());
    SuppleContext context = (*created)->handle();
    Character a = makeCharacter(context), b = makeCharacter(context);
    ASSERT_EQ(a.result, SUPPLE_OK);
    ASSERT_EQ(b.result, SUPPLE_OK);
    const auto record = [&](VkCommandBuffer commands, SuppleGroup group) {
        SuppleRecordDesc desc{};
        desc.structSize = sizeof(desc);
        desc.groups = &group;
        desc.groupCount = 1;
        return suppleRecord(context, commands, &desc);
    };
    // Destroyed between recording and submission: the command buffer must stay valid.
    ASSERT_EQ(suppleBeginFrame(context, 1, 0), SUPPLE_OK);
    ASSERT_TRUE(device
                    ->submitAndWait([&](VkCommandBuffer commands) {
                        EXPECT_EQ(record(commands, a.group), SUPPLE_OK);
                        EXPECT_EQ(suppleDestroyGroup(context, a.group), SUPPLE_OK);
                        EXPECT_EQ(suppleDestroyAsset(context, a.asset), SUPPLE_OK);
                    })
                    .ok());
    EXPECT_EQ(suppleDestroyGroup(context, a.group), SUPPLE_ERROR_ARGUMENT) << "the handle is dead at once";
    ASSERT_EQ(suppleBeginFrame(context, 2, 1), SUPPLE_OK);
    Character c = makeCharacter(context); // may reuse the slot: the generation differs
    ASSERT_EQ(c.result, SUPPLE_OK);
    EXPECT_NE(c.group.id, a.group.id);
    ASSERT_TRUE(device
                    ->submitAndWait([&](VkCommandBuffer commands) {
                        EXPECT_EQ(record(commands, a.group), SUPPLE_ERROR_ARGUMENT);
                        EXPECT_EQ(record(commands, c.group), SUPPLE_OK);
                        EXPECT_EQ(record(commands, c.group), SUPPLE_ERROR_ARGUMENT) << "twice in a frame";
                    })
                    .ok());
}

TEST(Contract, WrongCallsAreRefusedAndChangeNothing) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    Result<std::unique_ptr<host::Context>> created = host::Context::create(*device);
    ASSERT_TRUE(created.ok());
    SuppleContext context = (*created)->handle();
    Character c = makeCharacter(context);
    ASSERT_EQ(c.result, SUPPLE_OK);
    const float nan[16] = {std::nanf("")};
    EXPECT_EQ(suppleCreateContext(nullptr, nullptr), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleCreateAsset(nullptr, nullptr, nullptr), SUPPLE_ERROR_ARGUMENT);
    SuppleAsset asset{};
    EXPECT_EQ(suppleCreateAsset(context, nullptr, &asset), SUPPLE_ERROR_ARGUMENT);
    SuppleGroup group{};
    SuppleGroupDesc groupDesc{};
    groupDesc.structSize = sizeof(groupDesc);
    groupDesc.asset = c.asset;
    groupDesc.capacity = 0;
    EXPECT_EQ(suppleCreateGroup(context, &groupDesc, &group), SUPPLE_ERROR_ARGUMENT);
    groupDesc.capacity = 1;
    groupDesc.rate = 65;
    EXPECT_EQ(suppleCreateGroup(context, &groupDesc, &group), SUPPLE_ERROR_ARGUMENT);
    groupDesc.rate = 64;
    groupDesc.capacity = 0x7FFFFFFF;
    EXPECT_EQ(suppleCreateGroup(context, &groupDesc, &group), SUPPLE_ERROR_LIMIT);
    groupDesc.capacity = 1;
    groupDesc.scheme = SUPPLE_SCHEME_FRAGMENTS;
    groupDesc.flags = SUPPLE_GROUP_PATCHES;
    EXPECT_EQ(suppleCreateGroup(context, &groupDesc, &group), SUPPLE_ERROR_ARGUMENT) << "it has no coefficients";
    groupDesc.flags = 0;
    for (const int scheme : {8, 99, 101, -1}) {
        groupDesc.scheme = static_cast<SuppleScheme>(scheme);
        EXPECT_EQ(suppleCreateGroup(context, &groupDesc, &group), SUPPLE_ERROR_ARGUMENT) << scheme;
    }
    groupDesc.scheme = SUPPLE_SCHEME_BLEND;
    SuppleBlendOptions blend{sizeof(blend), SUPPLE_CREASES_CUT, -1.0f};
    groupDesc.blend = &blend;
    EXPECT_EQ(suppleCreateGroup(context, &groupDesc, &group), SUPPLE_ERROR_ARGUMENT);
    blend.sharpThreshold = 0.0f;
    blend.creaseMode = static_cast<SuppleCreaseMode>(2);
    EXPECT_EQ(suppleCreateGroup(context, &groupDesc, &group), SUPPLE_ERROR_ARGUMENT);
    blend.creaseMode = SUPPLE_CREASES_CUT;
    blend.structSize = 4;
    EXPECT_EQ(suppleCreateGroup(context, &groupDesc, &group), SUPPLE_ERROR_ARGUMENT);
    groupDesc.blend = nullptr;
    groupDesc.scheme = SUPPLE_SCHEME_AUTO;
    groupDesc.structSize = 4;
    EXPECT_EQ(suppleCreateGroup(context, &groupDesc, &group), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleSetClipPose(context, {c.group, 1, c.instances[0].generation}, SUPPLE_BIND_POSE, 0.0),
              SUPPLE_ERROR_ARGUMENT)
        << "no such slot";
    EXPECT_EQ(suppleSetClipPose(context, c.instances[0], 0, 0.0), SUPPLE_ERROR_ARGUMENT) << "it has no clips";
    EXPECT_EQ(suppleSetTransform(context, c.instances[0], nan), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleSetMatrixPose(context, c.instances[0], nan, 1), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleSetMatrixPose(context, c.instances[0], nullptr, 1), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleRecord(context, VK_NULL_HANDLE, nullptr), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleBeginFrame(context, 0, 0), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleBeginFrame(context, 5, 0), SUPPLE_ERROR_ARGUMENT) << "more in flight than the context keeps";
    EXPECT_EQ(suppleBeginFrame(context, 5, 5), SUPPLE_ERROR_ARGUMENT);
    host::GroupOutput output{};
    EXPECT_EQ(suppleGetGroupInfo(context, c.group, &output.info), SUPPLE_ERROR_ARGUMENT) << "structSize is 0";
    EXPECT_EQ(host::getGroupOutput(context, {12345}, output), SUPPLE_ERROR_ARGUMENT);
    uint32_t count = 0;
    EXPECT_EQ(suppleGetTimings(context, sizeof(SuppleTiming), nullptr, &count), SUPPLE_NOT_READY);
    EXPECT_TRUE((*created)->evaluate({&c.group, 1}).ok()) << "and it still works";
}

TEST(Contract, SkippedFramesCountAsInFlight) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    Result<std::unique_ptr<host::Context>> created = host::Context::create(*device);
    ASSERT_TRUE(created.ok());
    SuppleContext context = (*created)->handle();
    ASSERT_EQ(suppleBeginFrame(context, 1, 0), SUPPLE_OK);
    EXPECT_EQ(suppleBeginFrame(context, 20, 1), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleBeginFrame(context, 20, 19), SUPPLE_OK) << "the last that was skipped is complete";
}

TEST(Contract, TheCageAloneNeedsNoScheme) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    Result<std::unique_ptr<host::Context>> created = host::Context::create(*device);
    ASSERT_TRUE(created.ok());
    const cage::Cage cage = prism(5); // pentagons: p-rep refuses it
    const host::CageArrays arrays(cage);
    SuppleAssetDesc assetDesc{};
    assetDesc.structSize = sizeof(assetDesc);
    assetDesc.cage = &arrays.desc;
    SuppleAsset asset{};
    ASSERT_EQ(suppleCreateAsset((*created)->handle(), &assetDesc, &asset), SUPPLE_OK);
    SuppleGroupDesc groupDesc{};
    groupDesc.structSize = sizeof(groupDesc);
    groupDesc.flags = SUPPLE_GROUP_PATCHES | SUPPLE_GROUP_ATTRIBUTES;
    groupDesc.asset = asset;
    groupDesc.capacity = 2;
    groupDesc.scheme = SUPPLE_SCHEME_CAGE;
    SuppleGroup group{};
    ASSERT_EQ(suppleCreateGroup((*created)->handle(), &groupDesc, &group), SUPPLE_OK);
    std::vector<SuppleInstance> instances;
    ASSERT_TRUE((*created)->createInstances(group, 2, instances).ok());
    ASSERT_TRUE((*created)->evaluate({&group, 1}, SUPPLE_RECORD_TIMINGS).ok());
    host::GroupOutput output{};
    ASSERT_EQ(host::getGroupOutput((*created)->handle(), group, output), SUPPLE_OK);
    EXPECT_EQ(output.surface.patchCount, 0u);
    EXPECT_EQ(output.streams.vertices.buffer, VkBuffer{VK_NULL_HANDLE});
    const Result<std::vector<std::byte>> bytes = device->readBuffer(output.info.deformedCage);
    ASSERT_TRUE(bytes.ok());
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        EXPECT_EQ(
            std::memcmp(bytes->data() + 16 * size_t{output.info.cageVerticesPerInstance + v}, &cage.positions[v], 12),
            0);
    }
}

TEST(Contract, ExternalFilesComeThroughTheHost) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    host::ContextOptions contextOptions;
    contextOptions.printWarnings = false;
    Result<std::unique_ptr<host::Context>> created = host::Context::create(*device, contextOptions);
    ASSERT_TRUE(created.ok());
    // A triangle whose buffer lies in the host's own file system.
    const std::string json = R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "buffers": [{"uri": "parts/my%20shape.bin", "byteLength": 36}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                       "max": [1, 1, 0]}]})";
    struct Files {
        std::vector<std::string> asked;
        std::array<float, 9> shape{0, 0, 0, 1, 0, 0, 0, 1, 0};
        size_t byteCount = sizeof(shape);
        bool present = true;
        int released = 0;
    } state;
    SuppleFiles files{};
    files.user = &state;
    files.read = [](const char* path, SuppleFileBytes* out, void* user) {
        Files& own = *static_cast<Files*>(user);
        own.asked.emplace_back(path);
        out->bytes = own.shape.data();
        out->byteCount = own.byteCount;
        out->handle = user;
        return own.present ? 1 : 0;
    };
    files.release = [](SuppleFileBytes* bytes, void*) { ++static_cast<Files*>(bytes->handle)->released; };
    SuppleAssetDesc desc{};
    desc.structSize = sizeof(desc);
    desc.name = "virtual.gltf";
    desc.bytes = json.data();
    desc.byteCount = json.size();
    desc.baseDirectory = "/";
    desc.files = &files;
    SuppleAsset asset{};
    EXPECT_EQ(suppleCreateAsset((*created)->handle(), &desc, &asset), SUPPLE_OK);
    EXPECT_EQ(state.asked, std::vector<std::string>{"parts/my shape.bin"});
    EXPECT_EQ(state.released, 1);
    const auto refusal = [&] {
        const SuppleResult result = suppleCreateAsset((*created)->handle(), &desc, &asset);
        EXPECT_EQ(result, SUPPLE_ERROR_ASSET);
        return (*created)->check(result, "create").error().message;
    };
    state.byteCount = 20;
    const std::string truncated = refusal();
    EXPECT_NE(truncated.find("virtual.gltf: mesh 0 primitive 0 POSITION: 3 elements at byte 0 are out of range: "
                             "bufferView 0 has 20 bytes"),
              std::string::npos)
        << truncated;
    EXPECT_EQ(state.released, 2);
    state.present = false;
    const std::string missing = refusal();
    EXPECT_NE(missing.find("my%20shape.bin"), std::string::npos) << missing;
    EXPECT_EQ(state.released, 2);
    files.read = nullptr;
    EXPECT_EQ(suppleCreateAsset((*created)->handle(), &desc, &asset), SUPPLE_ERROR_ARGUMENT);
}

TEST(Contract, ClipsOfOtherFiles) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    LoggedContext own(*device);
    ASSERT_EQ(own.result(), SUPPLE_OK);
    test::GltfBuilder quad = test::skinnedQuad();
    const std::vector<std::byte> character = quad.glb();
    quad.nodes = R"([{"mesh":0,"skin":0},{"name":"tip"},{"name":"extra","translation":[1,0,0]}])";
    const std::vector<std::byte> other = quad.glb();
    // The third lies in two files of the host's.
    const std::string text = test::skinnedQuad().json("motion.bin");
    struct Files {
        std::vector<std::byte> binary = test::skinnedQuad().binary();
        std::vector<std::string> asked;
    } state;
    const SuppleFiles files{[](const char* path, SuppleFileBytes* out, void* user) {
                                auto& own = *static_cast<Files*>(user);
                                own.asked.emplace_back(path);
                                *out = {own.binary.data(), own.binary.size(), nullptr};
                                return 1;
                            },
                            nullptr, &state};
    const SuppleClipFile clipFiles[] = {{"a/walk.glb", character.data(), character.size(), nullptr, nullptr},
                                        {nullptr, other.data(), other.size(), nullptr, nullptr},
                                        {"run.gltf", text.data(), text.size(), nullptr, &files}};
    SuppleAssetDesc desc{};
    desc.structSize = sizeof(desc);
    desc.name = "quad.glb";
    desc.bytes = character.data();
    desc.byteCount = character.size();
    desc.clipFiles = clipFiles;
    desc.clipFileCount = 3;
    desc.flags = SUPPLE_ASSET_KEEP_TRIANGLES; // not worth a line here
    SuppleAsset asset{};
    ASSERT_EQ(suppleCreateAsset(own.handle(), &desc, &asset), SUPPLE_OK);
    const char* const names[] = {"clip_0", "walk", "clip file 1", "run"};
    SuppleAssetInfo info{};
    info.structSize = sizeof(info);
    ASSERT_EQ(suppleGetAssetInfo(own.handle(), asset, &info), SUPPLE_OK);
    ASSERT_EQ(info.clipCount, 4u);
    for (uint32_t i = 0; i < 4; ++i) {
        SuppleClipInfo clip{};
        clip.structSize = sizeof(clip);
        ASSERT_EQ(suppleGetClipInfo(own.handle(), asset, i, &clip), SUPPLE_OK);
        EXPECT_STREQ(clip.name, names[i]);
    }
    EXPECT_EQ(state.asked, std::vector<std::string>{"motion.bin"});
    const std::vector<LogLine> lines = own.takeLines();
    ASSERT_EQ(lines.size(), 1u) << "those that match in full are not worth a line";
    EXPECT_EQ(lines[0].message, SUPPLE_MESSAGE_ASSET_WARNING);
    EXPECT_EQ(lines[0].text,
              "quad.glb: clip file 1: 1 clip; 0 of 1 node matched by name; not matched: extra; not retargeted: no "
              "left and right thigh, shin and foot below each other in its skeleton");

    // A host of the first version, whose struct ends before `scene`.
    desc.structSize = offsetof(SuppleAssetDesc, scene);
    ASSERT_EQ(suppleCreateAsset(own.handle(), &desc, &asset), SUPPLE_OK);
    ASSERT_EQ(suppleGetAssetInfo(own.handle(), asset, &info), SUPPLE_OK);
    EXPECT_EQ(info.clipCount, 1u);
}

TEST(Contract, CagesAreRefusedByName) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    host::ContextOptions contextOptions;
    contextOptions.printWarnings = false;
    Result<std::unique_ptr<host::Context>> created = host::Context::create(*device, contextOptions);
    ASSERT_TRUE(created.ok());
    const auto refusal = [&](const cage::Cage& cage, SuppleScheme scheme = SUPPLE_SCHEME_AUTO) {
        const host::CageArrays arrays(cage);
        SuppleAssetDesc assetDesc{};
        assetDesc.structSize = sizeof(assetDesc);
        assetDesc.name = "shape.cage";
        assetDesc.cage = &arrays.desc;
        SuppleAsset asset{};
        SuppleResult result = suppleCreateAsset((*created)->handle(), &assetDesc, &asset);
        if (result == SUPPLE_OK) {
            SuppleGroupDesc groupDesc{};
            groupDesc.structSize = sizeof(groupDesc);
            groupDesc.asset = asset;
            groupDesc.capacity = 1;
            groupDesc.scheme = scheme;
            SuppleGroup group{};
            result = suppleCreateGroup((*created)->handle(), &groupDesc, &group);
        }
        EXPECT_EQ(result, SUPPLE_ERROR_ASSET);
        const Status status = (*created)->check(result, "create");
        return status.ok() ? std::string() : status.error().message;
    };
    cage::Cage nan = cube();
    nan.positions[3].y = std::nanf("");
    cage::Cage range = cube();
    range.faceVertices[5] = 99;
    const std::pair<const char*, std::string> cases[] = {{"pentagons for p-rep", refusal(prism(5), SUPPLE_SCHEME_PREP)},
                                                         {"NaN position", refusal(nan)},
                                                         {"index out of range", refusal(range)}};
    for (const auto& [name, message] : cases) {
        std::printf("%-22s %s\n", name, message.c_str());
    }
    EXPECT_NE(cases[0].second.find("5 sides"), std::string::npos) << cases[0].second;
    EXPECT_NE(cases[1].second.find("vertex 3"), std::string::npos) << cases[1].second;
    EXPECT_NE(cases[2].second.find("99"), std::string::npos) << cases[2].second;

    // All kinds of faults at once, one line each.
    range.positions[3].y = range.positions[5].x = std::nanf("");
    range.holes = {77};
    EXPECT_NE(refusal(range).find("shape.cage: 2 positions are not finite or beyond 1e+09, the first is vertex 3\n"
                                  "shape.cage: 1 corner names no vertex: vertex 99 of 8 in face 1\n"
                                  "shape.cage: 1 hole is no face: hole 0, face 77 of 6"),
              std::string::npos)
        << refusal(range);
}

TEST(Contract, DamagedArraysAreRepairedOrRefused) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    host::ContextOptions contextOptions;
    contextOptions.printWarnings = false;
    Result<std::unique_ptr<host::Context>> created = host::Context::create(*device, contextOptions);
    ASSERT_TRUE(created.ok());
    const SuppleContext context = (*created)->handle();
    // A cube with a flipped face, a fin on one of its edges, and a vertex without a face.
    cage::Cage damaged = cube();
    std::swap(damaged.faceVertices[1], damaged.faceVertices[3]);
    damaged.positions.insert(damaged.positions.end(), {{5, 5, 5}, {0, 0, 9}});
    damaged.faceVertices.insert(damaged.faceVertices.end(), {damaged.faceVertices[8], damaged.faceVertices[9], 9});
    damaged.faceStarts.push_back(damaged.cornerCount());
    const host::CageArrays arrays(damaged);
    SuppleAssetDesc desc{};
    desc.structSize = sizeof(desc);
    desc.name = "shape.cage";
    desc.cage = &arrays.desc;
    desc.flags = SUPPLE_ASSET_STRICT;
    SuppleAsset asset{};
    EXPECT_EQ(suppleCreateAsset(context, &desc, &asset), SUPPLE_ERROR_ASSET);
    const Status status = (*created)->check(SUPPLE_ERROR_ASSET, "create");
    for (const char* kind : {"shape.cage: cage: 1 vertex has no face: vertex 8\n",
                             "shape.cage: cage: 1 edge has three or more faces: edge ",
                             "\nshape.cage: cage: 1 face is "
                             "turned against its neighbours: "
                             "face 0"}) {
        EXPECT_NE(status.error().message.find(kind), std::string::npos) << status.error().message;
    }

    desc.flags = 0;
    ASSERT_EQ(suppleCreateAsset(context, &desc, &asset), SUPPLE_OK);
    SuppleAssetInfo info{};
    info.structSize = sizeof(info);
    ASSERT_EQ(suppleGetAssetInfo(context, asset, &info), SUPPLE_OK);
    EXPECT_EQ(info.faceCount, 7u);
    ASSERT_EQ(info.cageVertexCount, 11u) << "without vertex 8, with two copies";
    for (uint32_t v = 0; v < 9; ++v) {
        EXPECT_EQ(info.sourceVertices[v], v < 8 ? v : 9u);
    }
    EXPECT_LT(info.sourceVertices[9], info.sourceVertices[10]);
    EXPECT_EQ(std::set<uint32_t>({info.sourceVertices[9], info.sourceVertices[10]}),
              std::set<uint32_t>({damaged.faceVertices[8], damaged.faceVertices[9]}));
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_FRAGMENTS, SUPPLE_SCHEME_LOOP,
                                      SUPPLE_SCHEME_BLEND, SUPPLE_SCHEME_CATMULL_CLARK}) {
        SuppleGroupDesc groupDesc{};
        groupDesc.structSize = sizeof(groupDesc);
        groupDesc.asset = asset;
        groupDesc.capacity = 1;
        groupDesc.scheme = scheme;
        SuppleGroup group{};
        EXPECT_EQ(suppleCreateGroup(context, &groupDesc, &group), SUPPLE_OK) << scheme;
    }
}

TEST(Contract, LargeGroupsAreWindowsOfInstances) {
    // A device whose storage buffers end after a few instances: the same bits must come out of many windows as of one.
    constexpr uint32_t kInstances = 37;
    for (const SuppleMapping mapping : {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE}) {
        std::vector<std::byte> results[2];
        for (const bool small : {false, true}) {
            WrappedVulkan& wrapped = wrappedVulkan();
            const std::unique_ptr<host::Device> device = wrappedDevice();
            ASSERT_NE(device, nullptr);
            wrapped.maxStorageBufferRange = small ? 1u << 16 : 0;
            {
                host::ContextOptions contextOptions;
                contextOptions.mapping = mapping;
                Result<std::unique_ptr<host::Context>> context = host::Context::create(*device, contextOptions);
                ASSERT_TRUE(context.ok()) << context.error().message;
                Character c = makeCharacter((*context)->handle(), kInstances);
                ASSERT_EQ(c.result, SUPPLE_OK);
                for (uint32_t i = 0; i < kInstances; ++i) {
                    const glm::mat4 transform =
                        glm::translate(glm::mat4(1.0f), {0.1f * static_cast<float>(i), 0.0f, 0.0f});
                    ASSERT_EQ(suppleSetTransform((*context)->handle(), c.instances[i], glm::value_ptr(transform)),
                              SUPPLE_OK);
                }
                ASSERT_TRUE((*context)->evaluate({&c.group, 1}).ok());
                host::GroupOutput output{};
                ASSERT_EQ(host::getGroupOutput((*context)->handle(), c.group, output), SUPPLE_OK);
                EXPECT_GT(output.streams.vertices.size, 4u << 16) << "too small to need windows";
                Result<std::vector<std::byte>> bytes = device->readBuffer(output.streams.vertices);
                ASSERT_TRUE(bytes.ok());
                // Padding between instances is never written.
                const size_t used = size_t{output.grid.vertexCount} * 16;
                for (uint32_t i = 0; i < kInstances; ++i) {
                    const std::byte* first = bytes->data() + size_t{i} * output.grid.verticesPerInstance * 16;
                    results[small ? 1 : 0].insert(results[small ? 1 : 0].end(), first, first + used);
                }
            }
            EXPECT_EQ(device->validation()->messageCount(), 0u);
        }
        EXPECT_TRUE(results[0] == results[1]) << "mapping " << mapping;
    }
}

TEST(Contract, FramesInFlightKeepTheirOwnPoses) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    Result<std::unique_ptr<host::Context>> created = host::Context::create(*device);
    ASSERT_TRUE(created.ok());
    SuppleContext context = (*created)->handle();
    Character c = makeCharacter(context);
    ASSERT_EQ(c.result, SUPPLE_OK);
    host::GroupOutput output{};
    ASSERT_EQ(host::getGroupOutput(context, c.group, output), SUPPLE_OK);
    Result<host::Buffer> copies[2] = {
        device->createBuffer(output.info.deformedCage.size,
                             VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                             host::MemoryKind::device),
        device->createBuffer(output.info.deformedCage.size,
                             VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                             host::MemoryKind::device)};
    ASSERT_TRUE(copies[0].ok() && copies[1].ok());
    const SuppleSyncScope copy{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
    // Both frames are recorded before either runs.
    ASSERT_TRUE(
        device
            ->submitAndWait([&](VkCommandBuffer commands) {
                for (uint64_t frame = 1; frame <= 2; ++frame) {
                    EXPECT_EQ(suppleBeginFrame(context, frame, 0), SUPPLE_OK);
                    const glm::mat4 transform =
                        glm::translate(glm::mat4(1.0f), {static_cast<float>(10 * frame), 0.0f, 0.0f});
                    EXPECT_EQ(suppleSetTransform(context, c.instances[0], glm::value_ptr(transform)), SUPPLE_OK);
                    SuppleRecordDesc desc{};
                    desc.structSize = sizeof(desc);
                    desc.groups = &c.group;
                    desc.groupCount = 1;
                    desc.before = copy;
                    desc.after = copy;
                    EXPECT_EQ(suppleRecord(context, commands, &desc), SUPPLE_OK);
                    const VkBufferCopy region{0, 0, output.info.deformedCage.size};
                    vkCmdCopyBuffer(commands, output.info.deformedCage.buffer, copies[frame - 1]->handle(), 1, &region);
                }
            })
            .ok());
    for (uint32_t frame = 1; frame <= 2; ++frame) {
        const Result<std::vector<std::byte>> bytes =
            device->readBuffer(copies[frame - 1]->handle(), 0, output.info.deformedCage.size);
        ASSERT_TRUE(bytes.ok());
        float sum = 0.0f;
        for (uint32_t v = 0; v < output.info.cageVertexCount; ++v) {
            float x = 0.0f;
            std::memcpy(&x, bytes->data() + 16 * size_t{v}, 4);
            sum += x;
        }
        EXPECT_NEAR(sum / static_cast<float>(output.info.cageVertexCount), 10.0f * static_cast<float>(frame), 1e-3f);
    }
}

TEST(Contract, HandlesOfAnotherContextOrKindAreRefused) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    host::ContextOptions quiet;
    quiet.printWarnings = false;
    Result<std::unique_ptr<host::Context>> a = host::Context::create(*device, quiet),
                                           b = host::Context::create(*device, quiet);
    ASSERT_TRUE(a.ok() && b.ok());
    Character c = makeCharacter((*a)->handle()), d = makeCharacter((*b)->handle());
    ASSERT_EQ(c.result, SUPPLE_OK);
    ASSERT_EQ(d.result, SUPPLE_OK);
    EXPECT_EQ(suppleDestroyGroup((*b)->handle(), c.group), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleDestroyAsset((*b)->handle(), c.asset), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleDestroyGroup((*a)->handle(), SuppleGroup{c.asset.id}), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleDestroyGroup((*a)->handle(), c.group), SUPPLE_OK);
}

TEST(Contract, MappingsSkinAndEvaluateManyInstancesAlike) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    GpuOptions options;
    options.instanceCount = 3;
    options.rate = 3;
    options.mapping = SUPPLE_MAPPING_NARROW;
    GpuSurface narrow(*device, kPipQuads, options);
    options.mapping = SUPPLE_MAPPING_WIDE;
    GpuSurface wide(*device, kPipQuads, options);
    ASSERT_TRUE(narrow.valid() && wide.valid());
    for (uint32_t i = 0; i < 3; ++i) {
        ASSERT_EQ(suppleSetClipPose(narrow.context().handle(), narrow.instance(i), i, 0.7), SUPPLE_OK);
        ASSERT_EQ(suppleSetClipPose(wide.context().handle(), wide.instance(i), i, 0.7), SUPPLE_OK);
    }
    narrow.evaluate();
    wide.evaluate();
    uint64_t different = 0;
    for (uint32_t i = 0; i < 3; ++i) {
        for (uint32_t v = 0; v < narrow.output().info.cageVertexCount; ++v) {
            const glm::vec3 a = narrow.deformed(i, v), b = wide.deformed(i, v);
            different += std::memcmp(&a, &b, sizeof(a)) != 0 ? 1 : 0;
        }
        for (uint32_t p = 0; p < narrow.output().surface.patchCount; ++p) {
            for (uint32_t s = 0; s < narrow.sampleCount(p); ++s) {
                different += std::memcmp(&narrow.vertex(i, p, s).position, &wide.vertex(i, p, s).position, 12) != 0;
            }
        }
    }
    EXPECT_EQ(different, 0u);
}

TEST(Contract, TimingsNameEveryPassAndNeverBlock) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    const ValidationGuard guard;
    Result<std::unique_ptr<host::Context>> created = host::Context::create(*device);
    ASSERT_TRUE(created.ok());
    Character c = makeCharacter((*created)->handle(), 1, SUPPLE_SCHEME_PM); // it has coefficients
    ASSERT_EQ(c.result, SUPPLE_OK);
    for (int frame = 0; frame < 3; ++frame) {
        // A rate that stays costs nothing: the attributes are written in the first frame alone.
        ASSERT_EQ(suppleSetRate((*created)->handle(), c.group, 3), SUPPLE_OK);
        ASSERT_TRUE((*created)->evaluate({&c.group, 1}, SUPPLE_RECORD_TIMINGS).ok());
    }
    uint32_t count = 0;
    ASSERT_EQ(suppleGetTimings((*created)->handle(), sizeof(SuppleTiming), nullptr, &count), SUPPLE_OK);
    std::vector<SuppleTiming> timings(count);
    ASSERT_EQ(suppleGetTimings((*created)->handle(), sizeof(SuppleTiming), timings.data(), &count), SUPPLE_OK);
    std::vector<std::string> passes;
    double end = 0.0;
    for (const SuppleTiming& t : timings) {
        passes.emplace_back(suppleGetPassName(t.pass));
        EXPECT_GE(t.gpuEnd, t.gpuBegin);
        EXPECT_GE(t.gpuBegin, end) << "passes follow each other";
        end = t.gpuEnd;
        EXPECT_GT(t.bytes, 0u);
    }
    EXPECT_EQ(passes, (std::vector<std::string>{"upload", "deform", "vertex", "assemble", "patch", "evaluate"}));
}

} // namespace
} // namespace supple::test
