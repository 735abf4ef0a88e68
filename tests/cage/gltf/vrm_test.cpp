// Expressions and spring bones of VRM files.
#include "cage/expressions.h"
#include "tests/cage/gltf/reading.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;

/// Two meshes of a triangle with two and three morph targets, at the nodes 1 and 2; node 3 is below node 2, and node 4
/// below node 3.
GltfBuilder twoFaces(const std::string& extensions) {
    GltfBuilder b;
    std::string meshes;
    for (const int targets : {2, 3}) {
        const std::string positions = std::to_string(b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0}));
        std::string list;
        for (int t = 0; t < targets; ++t) {
            list += std::string(t > 0 ? "," : "") + R"({"POSITION":)" +
                    std::to_string(b.addFloats("VEC3", {0, 0, 1.0f + static_cast<float>(t), 0, 0, 0, 0, 0, 0})) + "}";
        }
        meshes += std::string(targets == 3 ? "," : "") + R"({"primitives":[{"attributes":{"POSITION":)" + positions +
                  R"(},"targets":[)" + list + "]}]" + (targets == 3 ? R"(,"weights":[0,0.25,0]})" : "}");
    }
    b.meshes = "[" + meshes + "]";
    b.nodes = R"([{"children":[1,2]},{"mesh":0},{"mesh":1,"translation":[5,0,0],"children":[3]},{"children":[4]},{}])";
    b.more = R"(,"extensions":{)" + extensions + "}";
    return b;
}

TEST(GltfVrm, ExpressionsOfVrm1) {
    const Character c = readWell(twoFaces(R"("VRMC_vrm":{"expressions":{"preset":{
        "blink":{"isBinary":true,"morphTargetBinds":[{"node":2,"index":2,"weight":1}]},
        "happy":{"overrideBlink":"block","overrideMouth":"blend","morphTargetBinds":[{"node":2,"index":0,"weight":0.5},{"node":1,"index":1,"weight":0.75}]},
        "aa":{"morphTargetBinds":[{"node":1,"index":0,"weight":1}]}},
        "custom":{"wink":{"morphTargetBinds":[],"materialColorBinds":[{}]},"happy":{}}}})"));
    ASSERT_EQ(c.expressions.size(), 5u);
    const Expression& happy = c.expressions[0];
    EXPECT_EQ(happy.name, "happy");
    EXPECT_EQ(happy.targets, (std::vector<uint32_t>{1, 2})) << "parts one after the other";
    EXPECT_EQ(happy.weights, (std::vector<float>{0.75f, 0.5f}));
    EXPECT_EQ(c.expressions[1].name, "aa");
    EXPECT_EQ(c.expressions[2].name, "blink");
    EXPECT_TRUE(c.expressions[2].isBinary);
    EXPECT_EQ(c.expressions[3].name, "happy_2") << "the name is taken";
    EXPECT_EQ(c.expressions[4].name, "wink");
    EXPECT_EQ(c.warnings, Strings{"VRM: 1 expression changes materials, which is not read"});
    const auto isCalled = [&](const char* name) {
        return std::count_if(c.expressions.begin(), c.expressions.end(),
                             [&](const Expression& expression) { return expression.name == name; });
    };
    EXPECT_EQ(isCalled("wink"), 1);
    EXPECT_EQ(isCalled("sad"), 0);

    // Targets 0 and 1 are the first part's; the file gives 3 a weight.
    using Weights = std::vector<float>;
    EXPECT_EQ(expressionWeights(c, Weights{0, 0, 0, 0, 0}), (Weights{0, 0, 0, 0.25f, 0}));
    EXPECT_EQ(expressionWeights(c, Weights{0, 0, 0.6f, 0, 0}), (Weights{0, 0, 0, 0.25f, 1})) << "binary";
    EXPECT_EQ(expressionWeights(c, Weights{0, 0, 0.5f, 0, 0}), (Weights{0, 0, 0, 0.25f, 0}));
    EXPECT_EQ(expressionWeights(c, Weights{0.5f, 1, 1, 0, 0}), (Weights{0.5f, 0.375f, 0.25f, 0.25f, 0}))
        << "holds the mouth back by half, and the eyes open";
    EXPECT_EQ(expressionWeights(c, Weights{7, -1, 0, 0, 0}), (Weights{0, 0.75f, 0.5f, 0.25f, 0})) << "0 to 1";
}

TEST(GltfVrm, ExpressionsOfVrm0HaveTheNamesOf1) {
    const Character c = readWell(twoFaces(R"("VRM":{"blendShapeMaster":{"blendShapeGroups":[
        {"name":"Joy","presetName":"joy","binds":[{"mesh":1,"index":1,"weight":50}]},
        {"name":"Blink_L","presetName":"blink_l","isBinary":true,"binds":[{"mesh":0,"index":0,"weight":100}]},
        {"name":"Nod","presetName":"unknown","binds":[{"mesh":0,"index":9,"weight":100},{"mesh":0,"index":1}]},
        {"binds":[]}]}})"));
    ASSERT_EQ(c.expressions.size(), 3u);
    EXPECT_EQ(c.expressions[0].name, "happy");
    EXPECT_EQ(c.expressions[0].targets, (std::vector<uint32_t>{3}));
    EXPECT_EQ(c.expressions[0].weights, (std::vector<float>{0.5f}));
    EXPECT_EQ(c.expressions[1].name, "blinkLeft");
    EXPECT_EQ(c.expressions[1].kind, ExpressionKind::blink);
    EXPECT_EQ(c.expressions[2].name, "Nod");
    EXPECT_TRUE(c.expressions[2].targets.empty());
    EXPECT_EQ(c.warnings,
              (Strings{"VRM expression \"Nod\" binds[0]: no part has that morph target; left out, as are 1 more",
                       "VRM blendShapeGroups[3]: it has no name; left out"}));
}

TEST(GltfVrm, SpringBonesOfVrm1) {
    const Character c = readWell(twoFaces(R"("VRMC_springBone":{
        "colliders":[{"node":9,"shape":{"sphere":{}}},{"node":1,"shape":{"capsule":{"offset":[1,2,3],"radius":0.5,"tail":[4,5,6]}}}],
        "colliderGroups":[{"colliders":[0,1]}],
        "springs":[{"name":"ear","center":0,"joints":[{"node":3,"stiffness":2,"gravityPower":0.1,"gravityDir":[0,0,-1],"dragForce":0.4,"hitRadius":0.02},{"node":4}],"colliderGroups":[0]},
                   {"joints":[{"node":9}]},{"name":"none"}]})"));
    const SpringBones& bones = c.springBones;
    ASSERT_EQ(bones.springs.size(), 1u);
    EXPECT_EQ(bones.springs[0].name, "ear");
    EXPECT_EQ(bones.springs[0].center, 0u);
    ASSERT_EQ(bones.springs[0].joints.size(), 2u);
    const SpringJoint& joint = bones.springs[0].joints[0];
    EXPECT_EQ(joint.node, 3u);
    EXPECT_EQ(joint.stiffness, 2.0f);
    EXPECT_EQ(joint.gravityPower, 0.1f);
    EXPECT_EQ(joint.gravityDirection, glm::vec3(0, 0, -1));
    EXPECT_EQ(joint.drag, 0.4f);
    EXPECT_EQ(joint.hitRadius, 0.02f);
    EXPECT_EQ(bones.springs[0].joints[1].stiffness, 1.0f) << "VRM's own numbers";
    ASSERT_EQ(bones.colliders.size(), 1u);
    EXPECT_FALSE(bones.springs[0].isTree);
    EXPECT_EQ(bones.colliders[0].shape, ColliderShape::capsule);
    EXPECT_FALSE(bones.colliders[0].inside);
    EXPECT_EQ(bones.colliders[0].offset, glm::vec3(1, 2, 3));
    EXPECT_EQ(bones.colliders[0].tail, glm::vec3(4, 5, 6));
    EXPECT_EQ(bones.colliders[0].radius, 0.5f);
    EXPECT_EQ(bones.colliderGroups, (std::vector<std::vector<uint32_t>>{{0}})) << "numbers follow what is left out";
    EXPECT_EQ(c.warnings, (Strings{"VRM colliders[0]: node is out of range; left out",
                                   "VRM springs[1]: node is out of range; left out, as are 1 more"}));
}

TEST(GltfVrm, ExtendedCollidersStandBeforeOthers) {
    const Character c = readWell(twoFaces(R"("VRMC_springBone":{"colliders":[
        {"node":1,"shape":{"sphere":{"radius":9}},"extensions":{"VRMC_springBone_extended_collider":{"shape":{"sphere":{"offset":[1,2,3],"radius":2,"inside":true}}}}},
        {"node":1,"shape":{"sphere":{}},"extensions":{"VRMC_springBone_extended_collider":{"shape":{"capsule":{"radius":1,"tail":[0,1,0]}}}}},
        {"node":1,"shape":{"sphere":{}},"extensions":{"VRMC_springBone_extended_collider":{"shape":{"plane":{"offset":[0,-1,0],"normal":[0,2,0]}}}}},
        {"node":1,"shape":{"sphere":{}},"extensions":{"VRMC_springBone_extended_collider":{"shape":{"plane":{"normal":[0,0,0]}}}}},
        {"node":1,"shape":{"plane":{}}},
        {"node":1,"shape":{"sphere":{}},"extensions":{"VRMC_springBone_extended_collider":{"shape":{"sphere":{"inside":1}}}}}]})"));
    const std::vector<SpringCollider>& colliders = c.springBones.colliders;
    ASSERT_EQ(colliders.size(), 3u);
    EXPECT_TRUE(colliders[0].inside);
    EXPECT_EQ(colliders[0].radius, 2.0f);
    EXPECT_EQ(colliders[0].offset, glm::vec3(1, 2, 3));
    EXPECT_EQ(colliders[1].shape, ColliderShape::capsule);
    EXPECT_FALSE(colliders[1].inside);
    EXPECT_EQ(colliders[2].shape, ColliderShape::plane);
    EXPECT_EQ(colliders[2].tail, glm::vec3(0, 2, 0));
    EXPECT_EQ(c.warnings, Strings{"VRM colliders[3]: its normal has no direction; left out, as are 2 more"});
}

TEST(GltfVrm, JointsOfASpringAreAChainOfItsOwn) {
    const Character c = readWell(twoFaces(R"("VRMC_springBone":{"springs":[
        {"joints":[{"node":2},{"node":4}]},{"joints":[{"node":1},{"node":3}]},{"joints":[{"node":4},{"node":3}]},{"joints":[{"node":0},{"node":2}]}]})"));
    ASSERT_EQ(c.springBones.springs.size(), 1u) << "a node may be left out";
    EXPECT_EQ(c.warnings, Strings{"VRM springs[1]: a joint is not below the one before; left out, as are 2 more"});
}

TEST(GltfVrm, SpringBonesOfVrm0HaveAllThatIsBelow) {
    const Character c = readWell(twoFaces(R"("VRM":{"secondaryAnimation":{
        "colliderGroups":[{"node":1,"colliders":[{"offset":{"x":1,"y":2,"z":3},"radius":0.25}]}],
        "boneGroups":[{"comment":"tail","stiffiness":0.5,"gravityPower":1,"gravityDir":{"x":0,"y":-2,"z":0},"dragForce":0.3,"center":-1,"hitRadius":0.1,"bones":[2,4],"colliderGroups":[0]}]}})"));
    ASSERT_EQ(c.springBones.springs.size(), 1u);
    const Spring& tail = c.springBones.springs[0];
    EXPECT_EQ(tail.name, "tail");
    EXPECT_EQ(tail.center, kNone);
    ASSERT_EQ(tail.joints.size(), 3u);
    for (uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(tail.joints[i].node, 2 + i);
        EXPECT_EQ(tail.joints[i].stiffness, 0.5f);
        EXPECT_EQ(tail.joints[i].gravityDirection, glm::vec3(0, -2, 0));
    }
    ASSERT_EQ(c.springBones.colliders.size(), 1u);
    EXPECT_EQ(c.springBones.colliders[0].offset, glm::vec3(1, 2, -3)) << "Unity's z";
    EXPECT_TRUE(tail.isTree);
    EXPECT_TRUE(c.warnings.empty()) << "node 4 moves with node 2 already";
}

} // namespace
} // namespace supple::cage
