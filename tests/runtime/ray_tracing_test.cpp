// Ray tracing, as far as no ray is needed: positions alone, what is refused and by which name.
#include "tests/support/crowd.h"
#include "tests/support/meshes.h"
#include "tests/support/sample_assets.h"
#include "tests/support/test_view.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <string_view>

namespace supple::test {
namespace {

struct AloneCase {
    const char* name;
    SuppleScheme scheme;
    uint32_t flags;
    SuppleMapping mapping;
    bool quads = false; ///< the scheme takes nothing else
};
// The kernels are those of previous positions, which other tests run in both mappings.
constexpr AloneCase kAloneCases[] = {
    {"PrepMesh", SUPPLE_SCHEME_PREP, SUPPLE_GROUP_INDEXED_MESH, SUPPLE_MAPPING_WIDE, true},
    {"Pm", SUPPLE_SCHEME_PM, SUPPLE_GROUP_MOTION, SUPPLE_MAPPING_NARROW},
    {"PmMesh", SUPPLE_SCHEME_PM, SUPPLE_GROUP_INDEXED_MESH | SUPPLE_GROUP_MOTION, SUPPLE_MAPPING_WIDE},
    {"CatmullClark", SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_GROUP_MOTION, SUPPLE_MAPPING_WIDE},
    {"CatmullClarkMesh", SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_GROUP_INDEXED_MESH, SUPPLE_MAPPING_NARROW},
    {"Loop", SUPPLE_SCHEME_LOOP, 0, SUPPLE_MAPPING_WIDE},
    {"Blend", SUPPLE_SCHEME_BLEND, SUPPLE_GROUP_MOTION, SUPPLE_MAPPING_NARROW},
    {"Polygons", SUPPLE_SCHEME_POLYGONS, SUPPLE_GROUP_MOTION, SUPPLE_MAPPING_WIDE},
    {"Fragments", SUPPLE_SCHEME_FRAGMENTS, SUPPLE_GROUP_MOTION, SUPPLE_MAPPING_NARROW},
};

class PositionsAlone : public CrowdContexts {};
class PositionsOfSchemes : public PositionsAlone, public testing::WithParamInterface<AloneCase> {};

/// Two instances, the second one in another pose and turned.
void pose(Crowd& crowd, std::span<const SuppleInstance> instances, double time) {
    const glm::mat4 turned =
        glm::rotate(glm::translate(glm::mat4(1.0f), {3.0f, 1.0f, -2.0f}), 0.7f, {0.3f, 1.0f, 0.2f});
    crowd.pose(instances[0], 0, time, glm::mat4(1.0f));
    crowd.pose(instances[1], 0, time + 0.4, turned);
}

void expectSame(const Crowd& alone, const Crowd& vertices, bool motion) {
    EXPECT_EQ(alone.output().streams.vertices.stride, 12u);
    EXPECT_EQ(alone.output().streams.vertexFormat, SUPPLE_VERTEX_12);
    for (uint32_t slot = 0; slot < 2; ++slot) {
        const PositionBits bits = alone.positions(slot);
        EXPECT_EQ(differences(bits, vertices.positions(slot)), 0u);
        EXPECT_TRUE(std::ranges::all_of(asPositions(bits), [](const glm::vec3& p) {
            return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
        })) << "a vertex that is not finite could lose the hits of others";
        if (motion) {
            EXPECT_EQ(differences(alone.previous(slot), vertices.previous(slot)), 0u);
        }
    }
}

TEST_P(PositionsOfSchemes, AreThoseOfVerticesToTheBit) {
    const ValidationGuard guard;
    const AloneCase& c = GetParam();
    CrowdContext& own = context(c.mapping);
    SuppleGroupDesc desc{};
    desc.asset = own.asset(c.quads ? kPipQuads : kPip);
    desc.capacity = 2;
    desc.scheme = c.scheme;
    desc.rate = 4;
    desc.flags = c.flags;
    Crowd vertices(own, desc);
    desc.vertexFormat = SUPPLE_VERTEX_12;
    Crowd alone(own, desc);
    ASSERT_TRUE(vertices.valid() && alone.valid());
    const SuppleInstance ofVertices[] = {vertices.spawn(), vertices.spawn()};
    const SuppleInstance ofAlone[] = {alone.spawn(), alone.spawn()};
    for (const double time : {0.1, 0.5}) { // the second frame has a past
        pose(vertices, ofVertices, time);
        pose(alone, ofAlone, time);
        vertices.run();
        alone.run();
        expectSame(alone, vertices, (c.flags & SUPPLE_GROUP_MOTION) != 0);
    }
}

TEST_F(PositionsAlone, TakeAnotherRate) {
    CrowdContext& own = context(SUPPLE_MAPPING_WIDE);
    SuppleGroupDesc desc{};
    desc.asset = own.asset(kPip);
    desc.capacity = 2;
    desc.scheme = SUPPLE_SCHEME_PM;
    desc.rate = 4;
    Crowd vertices(own, desc);
    desc.vertexFormat = SUPPLE_VERTEX_12;
    Crowd alone(own, desc);
    for (Crowd* crowd : {&vertices, &alone}) {
        const SuppleInstance instances[] = {crowd->spawn(), crowd->spawn()};
        pose(*crowd, instances, 0.3);
        crowd->setRate(3);
        crowd->run();
    }
    expectSame(alone, vertices, false);
}

INSTANTIATE_TEST_SUITE_P(Alone, PositionsOfSchemes, testing::ValuesIn(kAloneCases),
                         [](const auto& info) { return info.param.name; });

class RayRefusals : public CrowdContexts {
protected:
    /// The result of a call, and that the last line of the log names `word`.
    static void expectRefused(LoggedContext& context, SuppleResult result, SuppleResult wanted, std::string_view word) {
        EXPECT_EQ(result, wanted);
        const std::vector<LogLine> lines = context.takeLines();
        ASSERT_FALSE(lines.empty()) << word;
        EXPECT_NE(lines.back().text.find(word), std::string::npos) << lines.back().text;
    }
};

TEST_F(RayRefusals, RequirementsNameWhatRayTracingNeeds) {
    const host::Device& device = *testDevice();
    SuppleRequirements requirements{};
    requirements.structSize = sizeof(requirements);
    requirements.contextFlags = SUPPLE_CONTEXT_RAY_TRACING;
    const SuppleResult result =
        suppleQueryRequirements(device.instance(), device.physicalDevice(), vkGetInstanceProcAddr, &requirements);
    EXPECT_EQ(requirements.features12.bufferDeviceAddress, VK_TRUE);
    EXPECT_EQ(requirements.accelerationStructure.accelerationStructure, VK_TRUE);
    EXPECT_EQ(requirements.accelerationStructure.pNext, nullptr);
    ASSERT_EQ(requirements.extensionCount, 2u);
    EXPECT_STREQ(requirements.extensions[0], VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME);
    if (result != SUPPLE_OK) {
        EXPECT_EQ(result, SUPPLE_ERROR_UNSUPPORTED);
        EXPECT_NE(std::string_view(requirements.reason).find("VK_KHR_acceleration_structure"), std::string_view::npos)
            << requirements.reason;
    }
}

TEST_F(RayRefusals, WithoutTheFlagNothingMoreIsRequired) {
    const host::Device& device = *testDevice();
    SuppleRequirements requirements{};
    requirements.structSize = sizeof(requirements);
    EXPECT_EQ(suppleQueryRequirements(device.instance(), device.physicalDevice(), vkGetInstanceProcAddr, &requirements),
              SUPPLE_OK);
    EXPECT_EQ(requirements.features12.bufferDeviceAddress, VK_FALSE);
    EXPECT_EQ(requirements.accelerationStructure.accelerationStructure, VK_FALSE);
    EXPECT_EQ(requirements.extensionCount, 0u);
    requirements.contextFlags = SUPPLE_CONTEXT_SHARED_DISPATCHES;
    EXPECT_EQ(suppleQueryRequirements(device.instance(), device.physicalDevice(), vkGetInstanceProcAddr, &requirements),
              SUPPLE_OK);
    EXPECT_EQ(requirements.features12.bufferDeviceAddress, VK_TRUE);
    EXPECT_EQ(requirements.extensionCount, 0u);
}

TEST_F(RayRefusals, AContextNamesWhatTheDeviceLacksOrHasDisabled) {
    LoggedContext context(*testDevice(), [](SuppleContextDesc& desc) { desc.flags |= SUPPLE_CONTEXT_RAY_TRACING; });
    const bool isOffered = context.result() != SUPPLE_ERROR_UNSUPPORTED;
    expectRefused(context, context.result(), isOffered ? SUPPLE_ERROR_ARGUMENT : SUPPLE_ERROR_UNSUPPORTED,
                  isOffered ? "without the feature accelerationStructure" : "VK_KHR_acceleration_structure");
    EXPECT_EQ(context.handle(), nullptr);
}

TEST_F(RayRefusals, AGroupNeedsTheContextsFlag) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.asset = own.createAsset(torus(6, 5));
    desc.capacity = 1;
    desc.flags = SUPPLE_GROUP_RAY_TRACING;
    SuppleGroup group{};
    expectRefused(own, suppleCreateGroup(own.handle(), &desc, &group), SUPPLE_ERROR_ARGUMENT,
                  "SUPPLE_CONTEXT_RAY_TRACING");
    desc.scheme = SUPPLE_SCHEME_CAGE;
    expectRefused(own, suppleCreateGroup(own.handle(), &desc, &group), SUPPLE_ERROR_ARGUMENT, "a cage");
}

TEST_F(RayRefusals, AGroupOfAViewIsNotTraced) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    const TestView view(own, 100000);
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.asset = own.createAsset(torus(6, 5));
    desc.capacity = 1;
    desc.view = view.handle();
    desc.flags = SUPPLE_GROUP_RAY_TRACING;
    SuppleGroup group{};
    expectRefused(own, suppleCreateGroup(own.handle(), &desc, &group), SUPPLE_ERROR_ARGUMENT, "a group of a view");
}

TEST_F(RayRefusals, PositionsAloneHaveNoTangents) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.asset = own.asset(kPipQuads);
    desc.capacity = 1;
    desc.vertexFormat = SUPPLE_VERTEX_12;
    desc.flags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS;
    SuppleGroup group{};
    expectRefused(own, suppleCreateGroup(own.handle(), &desc, &group), SUPPLE_ERROR_ARGUMENT, "SUPPLE_VERTEX_12");
    SuppleViewDesc viewDesc{};
    viewDesc.structSize = sizeof(viewDesc);
    viewDesc.maxVertices = 100000;
    viewDesc.vertexFormat = SUPPLE_VERTEX_12;
    SuppleView view{};
    expectRefused(own, suppleCreateView(own.handle(), &viewDesc, &view), SUPPLE_ERROR_ARGUMENT, "vertexFormat");
}

TEST_F(RayRefusals, AGroupWithoutTheFlagHasNoRayGeometry) {
    CrowdContext& own = context(SUPPLE_MAPPING_AUTO);
    SuppleGroupDesc desc{};
    desc.asset = own.createAsset(torus(6, 5));
    desc.capacity = 1;
    desc.rate = 2;
    Crowd crowd(own, desc);
    SuppleRayGeometry geometry{};
    geometry.structSize = sizeof(geometry);
    expectRefused(own, suppleGetRayGeometry(own.handle(), crowd.group(), 0, &geometry), SUPPLE_ERROR_ARGUMENT,
                  "SUPPLE_GROUP_RAY_TRACING");
    expectRefused(own, suppleGetRayGeometry(own.handle(), crowd.group(), 1, &geometry), SUPPLE_ERROR_ARGUMENT,
                  "surface 1 of 1");
}

} // namespace
} // namespace supple::test
