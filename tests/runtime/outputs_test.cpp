// What supple.h says of all outputs, whatever the scheme and tessellation: how they are aligned, which way round
// triangles go, and what memory callbacks are told.
#include "tests/support/lod_surface.h"
#include "tests/support/side_by_side.h"
#include "tests/support/test_view.h"
#include "tools/common/procedural.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>
#include <set>

namespace supple::test {
namespace {

/// A scheme, and whether a view draws it.
struct OutputCase {
    SuppleScheme scheme = SUPPLE_SCHEME_PM;
    bool viewed = false;
    uint32_t flags = 0; ///< of the group
};
constexpr OutputCase kOutputCases[] = {
    {SUPPLE_SCHEME_PREP},
    {SUPPLE_SCHEME_PREP, false, SUPPLE_GROUP_INDEXED_MESH},
    {SUPPLE_SCHEME_PREP, true},
    {SUPPLE_SCHEME_PM},
    {SUPPLE_SCHEME_PM, false, SUPPLE_GROUP_INDEXED_MESH},
    {SUPPLE_SCHEME_PM, true},
    {SUPPLE_SCHEME_FRAGMENTS},
    {SUPPLE_SCHEME_FRAGMENTS, true},
    {SUPPLE_SCHEME_LOOP},
    {SUPPLE_SCHEME_LOOP, true},
    {SUPPLE_SCHEME_BLEND},
    {SUPPLE_SCHEME_BLEND, true},
    {SUPPLE_SCHEME_CATMULL_CLARK},
    {SUPPLE_SCHEME_CATMULL_CLARK, false, SUPPLE_GROUP_INDEXED_MESH},
    {SUPPLE_SCHEME_CATMULL_CLARK, true},
    {SUPPLE_SCHEME_POLYGONS},
    {SUPPLE_SCHEME_POLYGONS, true},
};
std::string nameOfCase(const OutputCase& c) {
    return "scheme " + std::to_string(c.scheme) + (c.viewed ? " in a view" : "") +
           (c.flags == SUPPLE_GROUP_INDEXED_MESH ? " as a mesh" : "");
}

cage::Character spheres() {
    return sideBySide(cage::makeCubeSphere(3), "sphere", 2);
}

class Outputs : public CrowdContexts {
protected:
    /// `desc` gets what follows from the case.
    static SuppleGroupDesc descOf(const OutputCase& c, const TestView& view, SuppleGroupDesc desc) {
        desc.scheme = c.scheme;
        desc.flags |= c.flags;
        desc.rate = 4;
        if (c.viewed) {
            desc.view = view.handle();
        } else {
            desc.vertexFormat = SUPPLE_VERTEX_24;
        }
        return desc;
    }
};

void expectAligned(const char* name, const SuppleBufferRange& range, std::initializer_list<uint32_t> strides,
                   VkDeviceSize alignment = 256) {
    if (range.buffer == VK_NULL_HANDLE) {
        return;
    }
    EXPECT_EQ(range.offset % alignment, 0u) << name << " at " << range.offset;
    EXPECT_GT(range.size, 0u) << name;
    EXPECT_TRUE(std::ranges::find(strides, range.stride) != strides.end()) << name << ": stride " << range.stride;
    EXPECT_EQ(range.size % range.stride, 0u) << name << ": " << range.size << " bytes, stride " << range.stride;
}

void expectAligned(SuppleContext context, SuppleGroup group) {
    const SuppleGroupInfo info = outputOf(context, group).info;
    for (uint32_t surface = 0; surface < info.surfaceCount; ++surface) {
        host::GroupOutput out;
        ASSERT_EQ(host::getGroupOutput(context, group, out, surface), SUPPLE_OK);
        expectAligned("deformedCage", out.info.deformedCage, {16});
        if (out.info.poses.buffer != VK_NULL_HANDLE) {
            EXPECT_EQ(out.info.poses.stride % 16, 0u);
            expectAligned("poses", out.info.poses, {out.info.poses.stride});
        }
        expectAligned("instances", out.info.instances, {4});
        expectAligned("patchCoefficients", out.surface.patchCoefficients, {16});
        expectAligned("vertices", out.streams.vertices, {out.streams.vertexFormat == SUPPLE_VERTEX_24 ? 24u : 16u});
        expectAligned("previousPositions", out.streams.previousPositions, {12});
        expectAligned("attributes", out.streams.attributes, {16});
        expectAligned("uvs1", out.streams.uvs1, {8});
        expectAligned("faceUvs", out.streams.faceUvs, {8});
        expectAligned("indices", out.indices(), {2, 4});
        expectAligned("indirect", out.indirect(), {sizeof(VkDrawIndexedIndirectCommand)}, 4);
        expectAligned("buckets", out.levels.buckets, {16});
        expectAligned("patches", out.levels.patches, {64});
        expectAligned("bounds", out.bounds, {32});
        for (uint32_t r = 0; r < out.grid.rateCount; ++r) {
            expectAligned("instances of a rate", out.grid.rates[r].instances, {4});
        }
    }
}

TEST_F(Outputs, AreAlignedAsTheHeaderSays) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE}) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        const SuppleAsset asset = own.createAsset(tubeFile(), "tube"), pair = own.createAsset(spheres());
        for (const OutputCase& c : kOutputCases) {
            SCOPED_TRACE(nameOfCase(c));
            TestView view(own, 1u << 18, SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_UVS1);
            SuppleGroupDesc desc{};
            desc.asset = asset;
            desc.capacity = 7; // odd numbers, so that what follows lies where it may
            desc.flags = c.viewed ? 0 : uint32_t{SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES};
            // The second group's outputs do not begin where the view's buffers do.
            const Crowd first(own, descOf(c, view, desc)), second(own, descOf(c, view, desc));
            ASSERT_TRUE(first.valid() && second.valid());
            expectAligned(own.handle(), first.group());
            expectAligned(own.handle(), second.group());
        }
        // Several surfaces, one of them of rates in a view; and what is not drawn.
        TestView view(own, 1u << 18);
        const SuppleScheme schemes[] = {SUPPLE_SCHEME_LOOP, SUPPLE_SCHEME_PM};
        SuppleGroupDesc desc{};
        desc.asset = pair;
        desc.capacity = 5;
        desc.partSchemes = schemes;
        desc.partSchemeCount = 2;
        const Crowd alone(own, desc);
        desc.view = view.handle();
        const Crowd seen(own, desc);
        ASSERT_TRUE(alone.valid() && seen.valid());
        EXPECT_EQ(seen.output().info.surfaceCount, 2u);
        expectAligned(own.handle(), alone.group());
        expectAligned(own.handle(), seen.group());
        desc = {};
        desc.asset = asset;
        desc.capacity = 3;
        desc.flags = SUPPLE_GROUP_PATCHES;
        desc.skinning = SUPPLE_SKINNING_DUAL_QUATERNION;
        const Crowd patches(own, desc);
        ASSERT_TRUE(patches.valid());
        expectAligned(own.handle(), patches.group());
        expectAligned("deformedCage", patches.output().info.deformedCage, {16});
    }
}

/// Triangles that a group draws, and the normals at their corners.
struct Wound {
    std::vector<glm::vec3> positions, normals; ///< three a triangle
};

Wound ofGrids(const Crowd& crowd) {
    const host::GroupOutput out = crowd.output();
    const SuppleGridOutput& grid = out.grid;
    struct Vertex {
        glm::vec3 position, normal;
    };
    const auto vertices = as<Vertex>(crowd.read(out.streams.vertices));
    const std::vector<std::byte> indexBytes = crowd.read(grid.indices);
    const auto narrow = as<uint16_t>(indexBytes);
    const auto wide = as<uint32_t>(indexBytes);
    const auto draws = crowd.draws();
    Wound wound;
    for (uint32_t r = 0; r < grid.rateCount; ++r) {
        const SuppleRate& rate = grid.rates[r];
        const auto slots = as<uint32_t>(crowd.read(rate.instances));
        for (uint32_t d = rate.firstDrawRange; d < rate.firstDrawRange + rate.drawRangeCount; ++d) {
            const SuppleDrawRange& range = grid.drawRanges[d];
            const VkDrawIndexedIndirectCommand& draw = draws[d];
            for (uint32_t i = draw.firstInstance; i < draw.firstInstance + draw.instanceCount; ++i) {
                const uint32_t first = slots[i / range.patchCount] * grid.verticesPerInstance + range.firstVertex +
                                       i % range.patchCount * range.samplesPerPatch;
                for (uint32_t k = draw.firstIndex; k < draw.firstIndex + draw.indexCount; ++k) {
                    const Vertex& vertex = vertices[first + (grid.indices.stride == 2 ? narrow[k] : wide[k])];
                    wound.positions.push_back(vertex.position);
                    wound.normals.push_back(vertex.normal);
                }
            }
        }
    }
    return wound;
}

Wound ofLevels(const Crowd& crowd) {
    const LodSurface surface = readLodSurface(crowd);
    const std::vector<glm::vec3> positions = asPositions(surface.positions);
    Wound wound;
    for (const auto& triangle : surface.triangles) {
        for (const uint32_t corner : triangle) {
            wound.positions.push_back(positions[corner]);
            wound.normals.push_back(surface.normals[corner]);
        }
    }
    return wound;
}

/// How many triangles go round the centre counter-clockwise and clockwise, and whose normals point which way.
struct Ways {
    size_t outwards = 0, inwards = 0, normalsOut = 0, normalsIn = 0;
};
Ways waysOf(const Wound& wound, glm::vec3 centre) {
    Ways ways;
    for (size_t i = 0; i + 2 < wound.positions.size(); i += 3) {
        const glm::vec3 &a = wound.positions[i], &b = wound.positions[i + 1], &c = wound.positions[i + 2];
        const glm::vec3 across = glm::cross(b - a, c - a), out = (a + b + c) / 3.0f - centre;
        if (glm::length(across) < 1e-9f) {
            continue;
        }
        ++(glm::dot(across, out) > 0.0f ? ways.outwards : ways.inwards);
        ++(glm::dot(wound.normals[i], out) > 0.0f ? ways.normalsOut : ways.normalsIn);
    }
    return ways;
}

TEST_F(Outputs, AreWoundCounterClockwiseSeenFromOutside) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    ASSERT_TRUE(own.valid());
    const SuppleAsset asset = own.createAsset(cage::makeCubeSphere(4));
    for (const OutputCase& c : kOutputCases) {
        for (const bool mirrored : {false, true}) {
            SCOPED_TRACE(nameOfCase(c) + (mirrored ? ", mirrored" : ""));
            TestView view(own, 1u << 18);
            view.look({20.0f, 10.0f, 30.0f}); // few triangles will do
            SuppleGroupDesc desc{};
            desc.asset = asset;
            desc.capacity = 2;
            Crowd crowd(own, descOf(c, view, desc));
            ASSERT_TRUE(crowd.valid());
            static_cast<void>(crowd.spawn());
            const SuppleInstance placed = crowd.spawn(); // not in the first slot
            EXPECT_EQ(suppleSetVisible(own.handle(), {placed.group, 0, placed.generation}, 0), SUPPLE_OK);
            const glm::vec3 centre(1.0f, 2.0f, -1.0f);
            crowd.pose(placed, SUPPLE_BIND_POSE, 0.0,
                       glm::scale(glm::translate(glm::mat4(1.0f), centre),
                                  mirrored ? glm::vec3(-1.0f, 1.0f, 1.0f) : glm::vec3(1.0f)));
            crowd.run();
            const Wound wound = crowd.output().hasLevels() ? ofLevels(crowd) : ofGrids(crowd);
            const Ways ways = waysOf(wound, centre);
            EXPECT_GT(mirrored ? ways.inwards : ways.outwards, 90u);
            EXPECT_EQ(mirrored ? ways.outwards : ways.inwards, 0u);
            EXPECT_EQ(mirrored ? ways.normalsOut : ways.normalsIn, 0u);
        }
    }
}

/// Memory callbacks that note the names.
class NamedMemory {
public:
    explicit NamedMemory(const host::Device& device) : device_(device) {
        vkGetPhysicalDeviceMemoryProperties(device.physicalDevice(), &properties_);
        callbacks.user = this;
        callbacks.allocate = [](const VkMemoryRequirements* requirements, VkMemoryPropertyFlags required,
                                VkMemoryPropertyFlags, const char* name, SuppleMemory* out, void* user) {
            return static_cast<NamedMemory*>(user)->allocate(*requirements, required, name, *out);
        };
        callbacks.free = [](const SuppleMemory* memory, void* user) {
            vkFreeMemory(static_cast<NamedMemory*>(user)->device_.handle(), memory->memory, nullptr);
        };
    }

    SuppleMemoryCallbacks callbacks{};
    std::set<std::string> names, visibleNames;

private:
    VkResult allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags required, const char* name,
                      SuppleMemory& out) {
        const bool visible = (required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
        (visible ? visibleNames : names).insert(name);
        uint32_t type = 0;
        while ((requirements.memoryTypeBits >> type & 1u) == 0 ||
               (properties_.memoryTypes[type].propertyFlags & required) != required) {
            ++type;
        }
        const VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO, nullptr,
                                              VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT, 0};
        const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &flags, requirements.size, type};
        const VkResult result = vkAllocateMemory(device_.handle(), &info, nullptr, &out.memory);
        return result == VK_SUCCESS && visible
                   ? vkMapMemory(device_.handle(), out.memory, 0, VK_WHOLE_SIZE, 0, &out.mapped)
                   : result;
    }

    const host::Device& device_;
    VkPhysicalDeviceMemoryProperties properties_{};
};

/// The names that the comment of SuppleMemoryCallbacks.allocate lists.
std::set<std::string> documentedNames() {
    std::ifstream file(std::string(SUPPLE_SOURCE_DIR) + "/runtime/include/supple/supple.h");
    std::string header((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    header = std::regex_replace(header, std::regex("\\n *\\*? *"), " ");
    const size_t first = header.find("name is for the host's statistics"), last = header.find("VkResult (*allocate)");
    const std::string comment = header.substr(first, last - first);
    const std::regex quoted("\"([^\"]*)\"");
    std::set<std::string> names;
    for (std::sregex_iterator i(comment.begin(), comment.end(), quoted), end; i != end; ++i) {
        names.insert((*i)[1]);
    }
    return names;
}

TEST(OutputNames, OfMemoryAreThoseThatTheHeaderLists) {
    host::Device* device = testDevice();
    ASSERT_NE(device, nullptr);
    NamedMemory memory(*device);
    {
        LoggedContext own(*device, [&](SuppleContextDesc& desc) { desc.memory = &memory.callbacks; });
        ASSERT_EQ(own.result(), SUPPLE_OK);
        SuppleAsset asset{}, pair{};
        ASSERT_EQ(createTube(own.handle(), asset), SUPPLE_OK);
        const Result<cage::GlbFile> file = cage::writeGlb(spheres());
        ASSERT_TRUE(file.ok());
        SuppleAssetDesc assetDesc{};
        assetDesc.structSize = sizeof(assetDesc);
        assetDesc.bytes = file->bytes.data();
        assetDesc.byteCount = file->bytes.size();
        ASSERT_EQ(suppleCreateAsset(own.handle(), &assetDesc, &pair), SUPPLE_OK);
        SuppleViewDesc viewDesc{};
        viewDesc.structSize = sizeof(viewDesc);
        viewDesc.flags = SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_CULL | SUPPLE_VIEW_OCCLUSION;
        viewDesc.maxVertices = 1u << 16;
        SuppleView view{};
        ASSERT_EQ(suppleCreateView(own.handle(), &viewDesc, &view), SUPPLE_OK);
        const SuppleScheme schemes[] = {SUPPLE_SCHEME_LOOP, SUPPLE_SCHEME_PM};
        const std::vector<SuppleGroupDesc> descs = {
            {.asset = asset, .scheme = SUPPLE_SCHEME_CAGE},
            {.asset = asset, .scheme = SUPPLE_SCHEME_CAGE, .poseSource = SUPPLE_POSES_CAGE_BUFFER},
            {.asset = asset, .poseSource = SUPPLE_POSES_PLAYBACK},
            {.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS | SUPPLE_GROUP_PATCHES |
                      SUPPLE_GROUP_BOUNDS,
             .asset = asset,
             .scheme = SUPPLE_SCHEME_PM},
            {.flags = SUPPLE_GROUP_INDEXED_MESH, .asset = asset, .scheme = SUPPLE_SCHEME_PM},
            {.asset = pair, .partSchemes = schemes, .partSchemeCount = 2},
            {.asset = pair, .view = view, .partSchemes = schemes, .partSchemeCount = 2},
            {.asset = asset, .poseSource = SUPPLE_POSES_PLAYBACK, .view = view},
            {.asset = asset, .scheme = SUPPLE_SCHEME_POLYGONS},
        };
        for (const SuppleGroupDesc& desc : descs) {
            EXPECT_EQ(createGroup(own.handle(), desc.asset, desc).result, SUPPLE_OK);
        }
    }
    NamedMemory blocks(*device);
    {
        LoggedContext own(*device, [&](SuppleContextDesc& desc) {
            desc.memory = &blocks.callbacks;
            desc.memoryBlockSize = 16u << 20;
        });
        SuppleAsset asset{};
        ASSERT_EQ(createTube(own.handle(), asset), SUPPLE_OK);
    }
    NamedMemory hashed(*device);
    {
        LoggedContext own(*device, [&](SuppleContextDesc& desc) { desc.memory = &hashed.callbacks; });
        SuppleRecordingDesc recording{};
        recording.structSize = sizeof recording;
        recording.flags = SUPPLE_RECORDING_HASHES;
        recording.write = [](const void*, size_t, void*) { return 1; };
        ASSERT_EQ(suppleStartRecording(own.handle(), &recording), SUPPLE_OK);
    }
    NamedMemory shared(*device);
    {
        LoggedContext own(*device, [&](SuppleContextDesc& desc) {
            desc.memory = &shared.callbacks;
            desc.mapping = SUPPLE_MAPPING_WIDE;
            desc.flags |= SUPPLE_CONTEXT_SHARED_DISPATCHES;
        });
        SuppleAsset asset{};
        ASSERT_EQ(createTube(own.handle(), asset), SUPPLE_OK);
        EXPECT_EQ(createGroup(own.handle(), asset).result, SUPPLE_OK);
    }
    std::set<std::string> all = memory.names;
    all.insert(memory.visibleNames.begin(), memory.visibleNames.end());
    all.insert(blocks.names.begin(), blocks.names.end());
    all.insert(hashed.names.begin(), hashed.names.end());
    all.insert(hashed.visibleNames.begin(), hashed.visibleNames.end());
    all.insert(shared.names.begin(), shared.names.end());
    all.insert(shared.visibleNames.begin(), shared.visibleNames.end());
    EXPECT_EQ(all, documentedNames());
    EXPECT_FALSE(memory.names.contains("supple block"));
    std::set<std::string> twice;
    std::ranges::set_intersection(memory.names, memory.visibleNames, std::inserter(twice, twice.end()));
    EXPECT_EQ(twice, (std::set<std::string>{"supple parameter pairs", "supple skin tables",
                                            "supple vertices of a piece", "supple surface tables", "supple clip tables",
                                            "supple grid indices", "supple view, grid indices"}))
        << "uploaded once";
}

} // namespace
} // namespace supple::test
