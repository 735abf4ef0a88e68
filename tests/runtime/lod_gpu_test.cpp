// Level of detail on every character: what two patches share is the same, bit for bit, however far apart their levels
// and capacities are. Cameras stand in and round the character, so that levels run from 1 to 63 over one surface.
#include "cage/gltf_reader.h"
#include "runtime/context.h"
#include "surface/lod/grid.h"
#include "surface/schemes.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/lod_surface.h"
#include "tests/support/shared_assets.h"
#include "tests/support/spirv_precise.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>

namespace supple::test {
namespace {

using surface::lod::Form;

/// The sides of a view's patches of one instance, by the cage's edges.
struct Borders {
    size_t edges = 0;     ///< between two patches
    size_t samples = 0;   ///< of those, on one side
    size_t different = 0; ///< that the other side has in other bits
    size_t lengths = 0;   ///< edges whose sides have not as many samples
    size_t open = 0;      ///< segments of sides that have no other side
};

/// Samples along a patch's side, without repeats.
std::vector<std::array<uint32_t, 3>> side(const LodSurface& surface, const LodSurface::Patch& patch, uint32_t index) {
    std::vector<std::array<uint32_t, 3>> samples;
    for (uint32_t k = 0; k <= patch.capacity; ++k) {
        const uint32_t at = surface::lod::edgeSample(static_cast<Form>(patch.grid), patch.capacity, index, k);
        const std::array<uint32_t, 3>& bits = surface.positions[patch.firstVertex + at];
        if (samples.empty() || samples.back() != bits) {
            samples.push_back(bits);
        }
    }
    return samples;
}

Borders bordersOf(const LodSurface& surface, const std::vector<SupplePatchInfo>& patches) {
    using Samples = std::vector<std::array<uint32_t, 3>>;
    std::map<std::pair<uint32_t, uint32_t>, std::vector<Samples>>
        sides; // by cage vertices, and unknown ones not at all
    Borders result;
    for (const LodSurface::Patch& patch : surface.patches) {
        const SupplePatchInfo& info = patches[patch.patch];
        for (uint32_t e = 0; e < info.cornerCount; ++e) {
            // A polar patch's third corner is the side at which its quad ends in a point.
            const uint32_t gridSide = info.patchClass == SUPPLE_PATCH_POLAR && e == 2 ? 3 : e;
            const uint32_t from = info.corners[e], to = info.corners[(e + 1) % info.cornerCount];
            if (from != SUPPLE_NO_VERTEX && to != SUPPLE_NO_VERTEX) {
                sides[{from, to}].push_back(side(surface, patch, gridSide));
            }
        }
    }
    for (const auto& [ends, own] : sides) {
        const auto other = sides.find({ends.second, ends.first});
        if (other == sides.end()) {
            for (const Samples& samples : own) {
                result.open += samples.size() - 1;
            }
            continue;
        }
        if (ends.first > ends.second || own.size() != 1 || other->second.size() != 1) {
            continue;
        }
        Samples back = other->second.front();
        std::reverse(back.begin(), back.end());
        ++result.edges;
        result.samples += own.front().size();
        if (back.size() != own.front().size()) {
            ++result.lengths;
            continue;
        }
        for (size_t k = 0; k < back.size(); ++k) {
            result.different += back[k] != own.front()[k] ? 1 : 0;
        }
    }
    return result;
}

class LodCharacters : public CrowdContexts, public testing::WithParamInterface<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, LodCharacters, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

TEST_P(LodCharacters, neighboursAgreeBitForBit) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM}) {
        uint32_t characters = 0;
        size_t edges = 0, samples = 0, triangles = 0, scaledFrames = 0;
        std::set<uint32_t> capacities;
        for (const std::string& path : allCharacters()) {
            const std::string name = std::filesystem::path(path).filename().string();
            const Result<cage::Character> character = cage::readGltfFile(path);
            ASSERT_TRUE(character.ok());
            const auto id = static_cast<surface::SchemeId>(scheme);
            if (const auto tables = surface::buildTables({.scheme = id}, character->cage); !tables.ok()) {
                std::printf("left out: %s: %s\n", name.c_str(), tables.error().message.c_str());
                continue;
            }
            SuppleViewDesc viewDesc{};
            viewDesc.structSize = sizeof(viewDesc);
            viewDesc.maxVertices = 2'000'000;
            viewDesc.vertexFormat = SUPPLE_VERTEX_24;
            SuppleView view{};
            ASSERT_EQ(suppleCreateView(context.handle(), &viewDesc, &view), SUPPLE_OK);
            {
                SuppleGroupDesc desc{};
                desc.asset = context.asset(path);
                desc.capacity = 1;
                desc.scheme = scheme;
                desc.view = view;
                Crowd crowd(context, desc);
                ASSERT_TRUE(crowd.valid()) << name;
                const SuppleInstance instance = crowd.spawn();
                std::vector<SupplePatchInfo> patches(crowd.output().patchCount);
                auto count = static_cast<uint32_t>(patches.size());
                ASSERT_EQ(suppleGetPatches(context.handle(), crowd.group(), patches.data(), &count), SUPPLE_OK);
                ++characters;
                glm::vec3 low(1e30f), high(-1e30f);
                for (const glm::vec3& p : character->cage.positions) {
                    low = glm::min(low, p);
                    high = glm::max(high, p);
                }
                const float size = glm::length(high - low);
                for (uint32_t frame = 0; frame < 4; ++frame) {
                    if (crowd.clipCount() > 0) {
                        crowd.pose(instance, frame % crowd.clipCount(), unit(random), glm::mat4(1.0f));
                    }
                    // Inside the box twice, then round it; one frame that its budget scales down.
                    const glm::vec3 inside = low + (high - low) * glm::vec3(unit(random), unit(random), unit(random));
                    const glm::vec3 from = frame < 2 ? inside : inside + size * (frame == 2 ? 0.3f : 2.0f);
                    SuppleCameraDesc camera{};
                    camera.structSize = sizeof(camera);
                    camera.pixelsPerUnit = 869.0f;
                    camera.nearest = 0.01f * size;
                    camera.smallestEdge = frame == 1 ? 1.0f : 3.0f;
                    camera.edgeLength = frame == 3 ? 5.0f : 0.0f;
                    camera.vertexBudget = frame == 1 ? 20 * count : 0;
                    std::copy_n(&from.x, 3, camera.position);
                    ASSERT_EQ(suppleSetCamera(context.handle(), view, &camera), SUPPLE_OK);
                    context.run(crowd.group());
                    const LodSurface surface = readLodSurface(crowd);
                    const Sides sides = matchSides(surface);
                    const Borders borders = bordersOf(surface, patches);
                    SCOPED_TRACE(name + ", scheme " + std::to_string(scheme) + ", frame " + std::to_string(frame));
                    SuppleViewStatistics statistics{};
                    statistics.structSize = sizeof(statistics);
                    if (suppleGetViewStatistics(context.handle(), view, &statistics) == SUPPLE_OK) {
                        scaledFrames += statistics.levelScales[0] < 1.0f ? 1 : 0;
                        EXPECT_EQ(statistics.shortfall, 0u);
                    }
                    EXPECT_EQ(surface.patches.size(), patches.size());
                    EXPECT_EQ(borders.different, 0u) << "of " << borders.samples;
                    EXPECT_EQ(borders.lengths, 0u) << "of " << borders.edges;
                    EXPECT_EQ(sides.looseEnds, 0u);
                    if (borders.open == 0 && sides.unmatched != 0) {
                        std::printf("%s: %zu sides without another\n", name.c_str(), sides.unmatched);
                    }
                    EXPECT_LE(sides.unmatched, borders.open);
                    edges += borders.edges;
                    samples += borders.samples;
                    triangles += sides.triangles;
                    for (const LodSurface::Patch& patch : surface.patches) {
                        capacities.insert(patch.capacity);
                    }
                }
            }
            EXPECT_EQ(suppleDestroyView(context.handle(), view), SUPPLE_OK);
        }
        std::printf(
            "scheme %d: %u characters, %zu shared edges, %zu samples, %zu triangles, %zu capacities, %zu frames "
            "scaled down\n",
            scheme, characters, edges, samples, triangles, capacities.size(), scaledFrames);
        EXPECT_GT(edges, 0u);
        // All of them with the shared characters.
        EXPECT_GE(capacities.size(), 6u);
        EXPECT_GT(scaledFrames, 0u);
    }
}

/// Levels of edges as chance would have them, from 1 to 63: 1, odd integers and almost 1 more often. Both sides of an
/// edge see the same, for the two ends come in as a sum.
constexpr const char* kRandomEdge = R"(
    uvec3 ends = floatBitsToUint(x0) + floatBitsToUint(x1);
    uint h = (ends.x * 0x9E3779B9u) ^ (ends.y * 0x85EBCA6Bu) ^ (ends.z * 0xC2B2AE35u);
    h = (h ^ (h >> 15u)) * 0x2C1B3C6Du;
    h = (h ^ (h >> 12u)) * 0x297A2D39u;
    h ^= h >> 15u;
    if (level > 0.0) {
        level = exp2(float(h & 0xFFFFu) / 65536.0 * 5.97);
        uint kind = (h >> 16u) & 7u;
        if (kind == 0u) level = 1.0;
        if (kind == 1u) level = 2.0 * floor(0.5 * level) + 1.0;
        if (kind == 2u) level = 1.000001;
    }
    scratchWords[levelBase(instance) + edge] = floatBitsToUint(level);)";

/// And capacities up to four octaves above what a patch needs.
constexpr const char* kRandomCapacity = R"(
    at = min(at + float((patchIndex * 2654435761u) >> 24u), 895.0);
    uint bin = uint(at), weight = uint((at - float(bin)) * float(kSplitUnit));)";

TEST(LodRandom, LevelsAndCapacitiesLeaveNoCracks) {
    ASSERT_NE(testDevice(), nullptr);
    host::Device& device = *testDevice();
    const ValidationGuard guard;
    surface::Shaders shaders = surface::Shaders::embedded();
    const std::vector<uint32_t> edge = compileEdited(
        "lod/edge.comp", "    scratchWords[levelBase(instance) + edge] = floatBitsToUint(level);", kRandomEdge);
    const std::vector<uint32_t> patch = compileEdited(
        "lod/patch.comp", "    uint bin = uint(at), weight = uint((at - float(bin)) * float(kSplitUnit));",
        kRandomCapacity);
    ASSERT_FALSE(edge.empty() || patch.empty());
    shaders.lod.edge = edge;
    shaders.lod.patch = patch;
    for (const SuppleMapping mapping : {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE}) {
        SuppleContextDesc contextDesc = host::contextDesc(device);
        contextDesc.mapping = mapping;
        Result<std::unique_ptr<runtime::Context>> context = runtime::Context::create(contextDesc, shaders);
        ASSERT_TRUE(context.ok());
        SuppleViewDesc viewDesc{};
        viewDesc.structSize = sizeof(viewDesc);
        viewDesc.maxVertices = 5'000'000;
        viewDesc.vertexFormat = SUPPLE_VERTEX_24;
        const Result<uint64_t> view = (*context)->createView(viewDesc);
        ASSERT_TRUE(view.ok());
        SuppleCameraDesc camera{};
        camera.pixelsPerUnit = 800.0f;
        (*context)->views.find(*view)->setCamera(camera);
        uint64_t frame = 0;
        size_t samples = 0, triangles = 0, groups = 0;
        std::set<uint32_t> capacities;
        // Both mappings have the same bits (the test above): the repository's own characters do for the second.
        const std::vector<std::string> paths =
            mapping == SUPPLE_MAPPING_NARROW ? allCharacters() : filesBelow(SUPPLE_SAMPLE_ASSETS, {".glb"});
        for (const std::string& path : paths) {
            for (const SuppleScheme scheme : {SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_PM}) {
                Result<cage::Character> character = cage::readGltfFile(path);
                ASSERT_TRUE(character.ok());
                const Result<uint64_t> asset = (*context)->createAsset(std::move(*character));
                ASSERT_TRUE(asset.ok());
                SuppleGroupDesc desc{};
                desc.structSize = sizeof(desc);
                desc.asset = {*asset};
                desc.capacity = 1;
                desc.scheme = scheme;
                desc.view = {*view};
                const Result<uint64_t> id = (*context)->createGroup(desc);
                (void)(*context)->assets.remove(*asset);
                if (!id.ok()) {
                    continue; // the test above prints which cages a scheme refuses, and why
                }
                runtime::Group& group = *(*context)->groups.find(*id);
                ASSERT_TRUE(group.slots().create().has_value());
                const SuppleGroup handle{*id};
                SuppleRecordDesc record{};
                record.structSize = sizeof(record);
                record.groups = &handle;
                record.groupCount = 1;
                record.after = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
                ++frame;
                ASSERT_TRUE((*context)->beginFrame(frame, frame - 1).ok());
                ASSERT_TRUE(device
                                .submitAndWait([&](VkCommandBuffer commands) {
                                    EXPECT_TRUE((*context)->record(commands, record).ok());
                                })
                                .ok());
                std::vector<SupplePatchInfo> patches;
                for (const surface::PatchInfo& own : group.tables().patches) {
                    SupplePatchInfo& info = patches.emplace_back();
                    info.patchClass = static_cast<SupplePatchClass>(own.patchClass);
                    info.cornerCount = own.cornerCount;
                    std::copy(own.corners.begin(), own.corners.end(), info.corners);
                }
                const LodSurface surface = readLodSurface(device, group.output());
                const Sides sides = matchSides(surface);
                const Borders borders = bordersOf(surface, patches);
                SCOPED_TRACE(path + ", scheme " + std::to_string(scheme));
                EXPECT_EQ(surface.patches.size(), patches.size());
                EXPECT_EQ(borders.different, 0u) << "of " << borders.samples;
                EXPECT_EQ(borders.lengths, 0u) << "of " << borders.edges;
                EXPECT_EQ(sides.looseEnds, 0u);
                EXPECT_LE(sides.unmatched, borders.open);
                samples += borders.samples;
                triangles += sides.triangles;
                ++groups;
                for (const LodSurface::Patch& drawn : surface.patches) {
                    capacities.insert(drawn.capacity);
                }
                EXPECT_TRUE((*context)->destroyGroup(*id));
            }
        }
        std::printf("%s: %zu characters and schemes, %zu border samples, %zu triangles, %zu capacities\n",
                    mappingName(mapping).c_str(), groups, samples, triangles, capacities.size());
        EXPECT_GE(groups, 2u);
        EXPECT_GE(capacities.size(), 8u); // the coarsest are rare: all of a patch must be at level 1
    }
}

} // namespace
} // namespace supple::test
