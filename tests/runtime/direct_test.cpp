// SUPPLE_GROUP_DIRECT: what shaders/supple_patch.glsl makes of patches has the bits of stored vertices, for all classes
// of patches and at any rate; pictures are the same; and the group has no memory for vertices.
#include "shaders/direct_comp.h"
#include "shaders/direct_comp_DERIVATIVES.h"
#include "shaders/direct_comp_SUPPLE_PATCH_TEXELS.h"
#include "tests/runtime/direct_groups.h"
#include "tests/support/sample_assets.h"
#include "tests/support/side_by_side.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <set>
#include <string_view>

namespace supple::test {
namespace {

struct DirectPush {
    SupplePatchRange range{};
    uint32_t verticesPerInstance = 0;
    uint32_t count = 0;
};

/// Evaluates the groups of a device by a compute shader.
class Evaluator {
public:
    Evaluator(host::Device& device, bool texels)
        : Evaluator(device, texels,
                    texels ? std::span<const uint32_t>(direct_comp_SUPPLE_PATCH_TEXELS)
                           : std::span<const uint32_t>(direct_comp)) {}
    Evaluator(host::Device& device, bool texels, std::span<const uint32_t> shader)
        : device_(device), set_(device, VK_SHADER_STAGE_COMPUTE_BIT, texels),
          layout_(
              *host::createPipelineLayout(device, {set_.layout()}, sizeof(DirectPush), VK_SHADER_STAGE_COMPUTE_BIT)),
          pipeline_(*host::createComputePipeline(device, layout_, shader)) {}

    /// Six floats a vertex, as SUPPLE_VERTEX_24 has them, of instances from a slot on: `first` as if they were a
    /// window.
    std::vector<glm::vec3> evaluate(const Crowd& crowd, uint32_t instances, uint32_t first = 0) {
        const SuppleGridOutput grid = crowd.output().grid;
        SuppleDirectOutput from = directOutput(crowd);
        EXPECT_EQ(from.rangeCount, grid.drawRangeCount);
        const VkDeviceSize skipped = VkDeviceSize{16} * first * from.ranges[0].coefficientsPerInstance;
        from.coefficients.offset += skipped;
        from.coefficients.size -= skipped;
        const std::vector<glm::vec3> none(size_t{2} * (first + instances) * grid.verticesPerInstance);
        const host::Buffer result =
            std::move(*device_.uploadBuffer(none.data(), none.size() * sizeof(glm::vec3),
                                            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT));
        set_.write(grid, from, result.handle());
        const VkDescriptorSet set = set_.set();
        EXPECT_TRUE(
            device_
                .submitAndWait([&](VkCommandBuffer commands) {
                    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
                    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set, 0, nullptr);
                    for (uint32_t r = 0; r < from.rangeCount; ++r) {
                        DirectPush push{from.ranges[r], grid.verticesPerInstance, 0};
                        push.range.firstSlot = first;
                        push.count = instances * push.range.patchCount * push.range.samplesPerPatch;
                        vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
                        vkCmdDispatch(commands, (push.count + 63) / 64, 1, 1);
                    }
                })
                .ok());
        return as<glm::vec3>(*device_.readBuffer(result.handle(), 0, none.size() * sizeof(glm::vec3)));
    }

private:
    host::Device& device_;
    DirectSet set_;
    VkPipelineLayout layout_;
    VkPipeline pipeline_;
};

class Direct : public CrowdContexts {};
class DirectBits : public CrowdContexts, public testing::WithParamInterface<SuppleMapping> {};

TEST_P(DirectBits, AreThoseOfStoredVertices) {
    const ValidationGuard guard;
    CrowdContext& own = context(GetParam());
    ASSERT_TRUE(own.valid());
    Evaluator texels(own.device(), true), buffers(own.device(), false);
    std::set<uint32_t> classes;
    uint32_t singular = 0, cornerNormals = 0;
    Compared compared;
    for (const Subject& subject : subjects()) {
        Pair pair = pairOf(own, subject);
        ASSERT_TRUE(pair.valid()) << subject.name;
        for (const uint32_t rate : {16u, 8u, 5u, 3u, 2u, 1u}) {
            pair.setRate(rate);
            pair.run();
            Compared here;
            const std::vector<glm::vec3> made = (rate == 5 ? buffers : texels).evaluate(pair.direct, 2);
            here.add(pair.stored, made, 0);
            here.add(pair.stored, made, 1);
            EXPECT_EQ(here.different, 0u) << subject.name << " at rate " << rate;
            EXPECT_LT(here.largestTurn, 0.01f) << subject.name << " at rate " << rate;
            compared.join(here);
        }
        const SuppleDirectOutput output = directOutput(pair.direct);
        const std::vector<uint32_t> words = as<uint32_t>(pair.direct.read(output.tables));
        for (const SupplePatchRange& range : std::span(output.ranges, output.rangeCount)) {
            classes.insert(range.patchClass);
            singular += singularCorners(words, range.firstRecord, range.patchClass, range.patchCount);
            cornerNormals += range.patchClass == SUPPLE_PATCH_REGULAR && range.recordElements == 3 ? 1 : 0;
        }
    }
    EXPECT_GT(singular, 0u) << "corners whose tangents are parallel";
    EXPECT_GT(cornerNormals, 0u);
    compared.expectSame("all classes");
    EXPECT_EQ(classes, (std::set<uint32_t>{SUPPLE_PATCH_REGULAR, SUPPLE_PATCH_PERTURBED, SUPPLE_PATCH_POLAR,
                                           SUPPLE_PATCH_P3, SUPPLE_PATCH_P4, SUPPLE_PATCH_P5}));
}

TEST_P(DirectBits, OfACharacterThatMovesAndOfAWindow) {
    const ValidationGuard guard;
    CrowdContext& own = context(GetParam());
    Evaluator evaluator(own.device(), false);
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_PREP}) {
        SuppleGroupDesc desc{};
        desc.asset = own.asset(kPipQuads);
        desc.capacity = 2;
        desc.scheme = scheme;
        desc.rate = 4;
        Pair pair(own, desc, 0);
        ASSERT_TRUE(pair.valid());
        pair.run();
        Compared all, window;
        const std::vector<glm::vec3> made = evaluator.evaluate(pair.direct, 2);
        all.add(pair.stored, made, 0);
        all.add(pair.stored, made, 1);
        all.expectSame("a character");
        window.add(pair.stored, evaluator.evaluate(pair.direct, 1, 1), 1);
        window.expectSame("its second instance, as a window");
    }
}

INSTANTIATE_TEST_SUITE_P(Mappings, DirectBits, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& info) { return info.param == SUPPLE_MAPPING_WIDE ? "Wide" : "Narrow"; });

TEST_F(Direct, KeepsItsBitsWhenItIsMadeAnewAndWhenItFollows) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    Evaluator evaluator(own.device(), true);
    SuppleGroupDesc desc{};
    desc.asset = own.asset(kPipQuads);
    desc.capacity = 2;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.rate = 3;
    Pair pair(own, desc, 0);
    ASSERT_TRUE(pair.valid());
    ASSERT_EQ(suppleSetCapacity(own.handle(), pair.direct.group(), 5), SUPPLE_OK);
    pair.run();
    Compared anew;
    anew.add(pair.stored, evaluator.evaluate(pair.direct, 2), 1);
    anew.expectSame("another capacity");

    SuppleGroupDesc follower = desc;
    follower.capacity = 0;
    follower.instancesOf = pair.stored.group();
    follower.flags = SUPPLE_GROUP_DIRECT;
    Crowd following(own, follower);
    ASSERT_TRUE(following.valid());
    const SuppleGroup both[] = {pair.stored.group(), following.group()};
    own.run(both);
    Compared followed;
    followed.add(pair.stored, evaluator.evaluate(following, 2), 1);
    followed.expectSame("a follower");
}

/// A reload makes ranges, tables and coefficients anew: here with patches of other classes. Instances stay.
TEST_F(Direct, HasTheBitsOfAReloadedCage) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    Evaluator evaluator(own.device(), true);
    const cage::Character first = sideBySide(perturbed(jack(), 0.02f, 4), "part", 1),
                          other = sideBySide(perturbed(fanOverPentagons(5), 0.02f, 1), "part", 1);
    SuppleGroupDesc desc{};
    desc.asset = own.createAsset(first);
    desc.capacity = 2;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.rate = 3;
    Pair pair(own, desc, SUPPLE_BIND_POSE);
    ASSERT_TRUE(pair.valid());
    std::array<std::set<uint32_t>, 2> classes;
    std::array<std::vector<glm::vec3>, 3> made;
    for (size_t version = 0; version < 3; ++version) {
        if (version > 0) {
            ASSERT_EQ(own.reloadAsset(desc.asset, version == 1 ? other : first), SUPPLE_OK);
        }
        pair.run();
        made[version] = evaluator.evaluate(pair.direct, 2);
        Compared compared;
        compared.add(pair.stored, made[version], 0);
        compared.add(pair.stored, made[version], 1);
        compared.expectSame(version == 1 ? "reloaded" : "the first cage");
        const SuppleDirectOutput output = directOutput(pair.direct);
        for (const SupplePatchRange& range : std::span(output.ranges, output.rangeCount)) {
            classes[version % 2].insert(range.patchClass);
        }
    }
    EXPECT_NE(classes[0], classes[1]);
    EXPECT_EQ(made[2], made[0]) << "the first cage again";
}

/// Against differences of positions: along the first side of quads, and across from it inside of bicubic ones.
TEST_F(Direct, HasTheDerivativesOfItsParameters) {
    constexpr uint32_t kRate = 32, kSide = kRate + 1;
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    Evaluator positions(own.device(), false), derivatives(own.device(), false, direct_comp_DERIVATIVES);
    std::set<uint32_t> classes;
    const Subject all[] = {{"jack", SUPPLE_SCHEME_PM, perturbed(jack(), 0.02f, 4)},
                           {"jack, p-rep", SUPPLE_SCHEME_PREP, perturbed(jack(), 0.02f, 4)},
                           {"torus", SUPPLE_SCHEME_PM, perturbed(torus(8, 5), 0.02f, 5)}};
    for (const Subject& subject : all) {
        SuppleGroupDesc desc{};
        desc.asset = own.createAsset(subject.cage);
        desc.capacity = 1;
        desc.scheme = subject.scheme;
        desc.rate = kRate;
        Crowd direct(own, Pair::withFlag(desc));
        ASSERT_TRUE(direct.valid());
        direct.pose(direct.spawn(), SUPPLE_BIND_POSE, 0.0, glm::mat4(1.0f));
        own.run(direct.group());
        const std::vector<glm::vec3> p = positions.evaluate(direct, 1), d = derivatives.evaluate(direct, 1);
        const SuppleDirectOutput from = directOutput(direct);
        for (uint32_t r = 0; r < from.rangeCount; ++r) {
            classes.insert(from.ranges[r].patchClass);
            const auto at = [&](uint32_t i, uint32_t j) { return 2 * (from.ranges[r].firstVertex + j * kSide + i); };
            const auto slope = [&](size_t a, size_t b) { return 0.5f * kRate * (p[b] - p[a]); };
            for (uint32_t i = 1; i < kRate; ++i) {
                EXPECT_LT(glm::distance(d[at(i, 0)], slope(at(i - 1, 0), at(i + 1, 0))), 0.02f) << r << " " << i;
            }
            for (uint32_t j = 1; j < kRate && from.ranges[r].patchClass <= SUPPLE_PATCH_PERTURBED; ++j) {
                EXPECT_LT(glm::distance(d[at(5, j) + 1], slope(at(5, j - 1), at(5, j + 1))), 0.02f) << r << " " << j;
                EXPECT_LT(glm::distance(d[at(5, j)], slope(at(4, j), at(6, j))), 0.02f) << r << " " << j;
            }
        }
    }
    EXPECT_EQ(classes, (std::set<uint32_t>{SUPPLE_PATCH_REGULAR, SUPPLE_PATCH_PERTURBED, SUPPLE_PATCH_P4}));
}

/// A sword of polygons in the hand of a P_m character.
TEST_F(Direct, LeavesPartsOfOtherSchemesTheirVertices) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    Evaluator evaluator(own.device(), true);
    std::vector<SuppleScheme> schemes(10, SUPPLE_SCHEME_PM);
    schemes.back() = SUPPLE_SCHEME_POLYGONS;
    SuppleGroupDesc desc{};
    desc.asset = own.asset(kWren);
    desc.capacity = 2;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.rate = 2;
    desc.partSchemes = schemes.data();
    desc.partSchemeCount = static_cast<uint32_t>(schemes.size());
    Pair pair(own, desc, 0);
    ASSERT_TRUE(pair.valid());
    pair.run();
    EXPECT_EQ(pair.direct.output(0).surface.tessellation, SUPPLE_TESSELLATION_DIRECT);
    EXPECT_EQ(pair.direct.output(1).surface.tessellation, SUPPLE_TESSELLATION_INDEXED_MESH);
    Compared compared;
    compared.add(pair.stored, evaluator.evaluate(pair.direct, 2), 1);
    compared.expectSame("all but the sword");
    const auto sword = [](const Crowd& crowd) {
        const std::vector<std::byte> all = crowd.slotBytes(crowd.output(1).streams.vertices, 1);
        const uint32_t stride = crowd.output(1).streams.vertices.stride;
        std::vector<std::byte> positions;
        for (size_t v = 0; v < crowd.output(1).grid.vertexCount; ++v) {
            const auto at = all.begin() + static_cast<ptrdiff_t>(v * stride);
            positions.insert(positions.end(), at, at + 12);
        }
        return positions;
    };
    EXPECT_FALSE(sword(pair.direct).empty());
    EXPECT_EQ(sword(pair.direct), sword(pair.stored));
}

/// Its coefficients are memory that goes while nobody is drawn (SuppleGroupDesc.keepUnseenFrames).
TEST_F(Direct, GivesItsCoefficientsBack) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    Evaluator evaluator(own.device(), false);
    SuppleGroupDesc desc{};
    desc.asset = own.asset(kPipQuads);
    desc.capacity = 2;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.rate = 2;
    desc.keepUnseenFrames = 1;
    Crowd direct(own, Pair::withFlag(desc));
    ASSERT_TRUE(direct.valid());
    const SuppleInstance instance = direct.spawn();
    direct.pose(instance, 0, 0.4, glm::mat4(1.0f));
    own.run(direct.group());
    const std::vector<glm::vec3> before = evaluator.evaluate(direct, 1);
    direct.setVisible(instance, false);
    for (uint32_t frame = 0; frame < 5; ++frame) {
        own.run(direct.group());
    }
    EXPECT_EQ(directOutput(direct).coefficients.buffer, VK_NULL_HANDLE);
    EXPECT_EQ(directOutput(direct).coefficients.size, 0u);
    EXPECT_NE(directOutput(direct).tables.buffer, VK_NULL_HANDLE);
    direct.setVisible(instance, true);
    own.run(direct.group());
    EXPECT_EQ(evaluator.evaluate(direct, 1), before);
}

SuppleMemoryUse memoryOf(const Crowd& crowd) {
    SuppleMemoryUse use{};
    use.structSize = sizeof use;
    EXPECT_EQ(suppleGetGroupMemory(crowd.context().handle(), crowd.group(), &use), SUPPLE_OK);
    return use;
}

TEST_F(Direct, HasNoMemoryForVertices) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    SuppleGroupDesc desc{};
    desc.asset = own.asset(kPipQuads);
    desc.capacity = 10;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.rate = 8;
    desc.flags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_BOUNDS | SUPPLE_GROUP_PATCHES;
    Pair pair(own, desc, 0);
    ASSERT_TRUE(pair.valid());
    pair.run();
    const SuppleMemoryUse stored = memoryOf(pair.stored), direct = memoryOf(pair.direct);
    EXPECT_GT(stored.vertices, 10'000'000u);
    EXPECT_EQ(direct.vertices, 0u);
    EXPECT_EQ(direct.coefficients, stored.coefficients);
    EXPECT_EQ(direct.streams, stored.streams);
    EXPECT_LT(direct.tables, stored.tables + 200'000u) << "records once more, and parameters";
    EXPECT_EQ(pair.direct.output().streams.vertices.buffer, VK_NULL_HANDLE);
    // Attributes, coefficients for inspection and boxes are what they are.
    EXPECT_EQ(pair.direct.read(pair.direct.output().streams.attributes),
              pair.stored.read(pair.stored.output().streams.attributes));
    const auto coefficients = [](const Crowd& crowd) {
        std::vector<std::byte> all = crowd.slotBytes(crowd.output().surface.patchCoefficients, 1);
        all.resize(size_t{16} * 16); // of the first patch, which is bicubic
        return all;
    };
    EXPECT_EQ(coefficients(pair.direct), coefficients(pair.stored));
    SuppleBufferRange boxes[2]{};
    EXPECT_EQ(suppleGetInstanceBounds(own.handle(), pair.stored.group(), &boxes[0]), SUPPLE_OK);
    EXPECT_EQ(suppleGetInstanceBounds(own.handle(), pair.direct.group(), &boxes[1]), SUPPLE_OK);
    EXPECT_EQ(pair.stored.slotBytes(boxes[0], 1), pair.direct.slotBytes(boxes[1], 1));
}

/// In a vertex shader: the same positions make the same picture, to the last pixel. Some instances hide a part.
TEST_F(Direct, DrawsThePictureOfStoredVertices) {
    const ValidationGuard guard;
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    SuppleGroupDesc desc{};
    desc.asset = own.asset(std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb"); // three materials
    desc.capacity = 3;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.rate = 5;
    Crowd stored(own, desc), direct(own, Pair::withFlag(desc));
    ASSERT_TRUE(stored.valid() && direct.valid());
    for (Crowd* crowd : {&stored, &direct}) {
        for (uint32_t i = 0; i < desc.capacity; ++i) {
            const SuppleInstance instance = crowd->spawn();
            crowd->pose(instance, SUPPLE_BIND_POSE, 0.0,
                        glm::translate(glm::mat4(1.0f), {0.8f * static_cast<float>(i) - 0.8f, 0.0f, 0.0f}));
            EXPECT_EQ(suppleSetPartVisible(own.handle(), instance, 0, i == 1 ? 0 : 1), SUPPLE_OK);
        }
        own.run(crowd->group());
    }
    DirectPictures drawing(own.device());
    const host::Picture wanted = drawing.stored(stored);
    EXPECT_NE(wanted.rgba, Canvas::blank().rgba);
    EXPECT_EQ(drawing.direct(direct, true).rgba, wanted.rgba);
    EXPECT_EQ(drawing.direct(direct, false).rgba, wanted.rgba);
}

class DirectRefusals : public CrowdContexts {
protected:
    void expectRefused(SuppleGroupDesc desc, SuppleResult wanted, std::string_view word) {
        CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
        desc.structSize = sizeof desc;
        desc.asset = own.asset(kPipQuads);
        desc.capacity = 1;
        desc.rate = 4;
        desc.flags |= SUPPLE_GROUP_DIRECT;
        SuppleGroup group{};
        EXPECT_EQ(suppleCreateGroup(own.handle(), &desc, &group), wanted) << word;
        const std::vector<LogLine> lines = own.takeLines();
        ASSERT_FALSE(lines.empty()) << word;
        EXPECT_NE(lines.back().text.find(word), std::string::npos) << lines.back().text;
    }
};

TEST_F(DirectRefusals, NameWhatCannotBe) {
    expectRefused({.scheme = SUPPLE_SCHEME_CATMULL_CLARK}, SUPPLE_ERROR_ARGUMENT, "those of Catmull-Clark cannot");
    expectRefused({.scheme = SUPPLE_SCHEME_LOOP}, SUPPLE_ERROR_ARGUMENT, "those of Loop cannot");
    expectRefused({.scheme = SUPPLE_SCHEME_BLEND}, SUPPLE_ERROR_ARGUMENT, "those of blend cannot");
    expectRefused({.scheme = SUPPLE_SCHEME_POLYGONS}, SUPPLE_ERROR_ARGUMENT, "those of polygons cannot");
    expectRefused({.scheme = SUPPLE_SCHEME_FRAGMENTS}, SUPPLE_ERROR_ARGUMENT, "those of fragments cannot");
    expectRefused({.scheme = SUPPLE_SCHEME_CAGE}, SUPPLE_ERROR_ARGUMENT, "a cage has no patches");
    for (const uint32_t flag : {uint32_t{SUPPLE_GROUP_MOTION}, uint32_t{SUPPLE_GROUP_INDEXED_MESH},
                                uint32_t{SUPPLE_GROUP_TANGENTS | SUPPLE_GROUP_ATTRIBUTES}}) {
        expectRefused({.flags = flag, .scheme = SUPPLE_SCHEME_PM}, SUPPLE_ERROR_ARGUMENT,
                      "SUPPLE_GROUP_DIRECT goes with");
    }
}

TEST_F(DirectRefusals, NameAGroupThatStoresItsVertices) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    SuppleGroupDesc desc{};
    desc.asset = own.asset(kPipQuads);
    desc.capacity = 1;
    desc.scheme = SUPPLE_SCHEME_PM;
    Crowd stored(own, desc);
    SuppleDirectOutput out{};
    out.structSize = sizeof out;
    EXPECT_EQ(suppleGetDirectOutput(own.handle(), stored.group(), 0, &out), SUPPLE_ERROR_ARGUMENT);
    EXPECT_NE(own.takeLines().back().text.find("SUPPLE_GROUP_DIRECT"), std::string::npos);
}

} // namespace
} // namespace supple::test
