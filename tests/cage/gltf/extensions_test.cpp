// Extensions that people's files have: nodes that are hidden, what VRM files add, channels by pointer.
#include "tests/cage/gltf/reading.h"

#include <gtest/gtest.h>

namespace supple::cage {
namespace {

using namespace test;

std::string visible(const std::string& value) {
    return R"("extensions":{"KHR_node_visibility":{)" + value + "}}";
}
const std::string kHidden = visible(R"("visible":false)");

/// A triangle at each of the nodes.
GltfBuilder trianglesAt(const std::string& nodes, const std::string& more = "") {
    GltfBuilder b;
    b.addFloats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0}}]}])";
    b.nodes = nodes;
    b.more = more;
    return b;
}

Strings partNames(const Character& c) {
    Strings names;
    for (const Part& part : c.parts) {
        names.push_back(part.name);
    }
    return names;
}

TEST(GltfVisibility, HiddenNodesAreNotDrawn) {
    const std::string nodes = R"([{"name":"a","mesh":0},{"name":"b","mesh":0,"translation":[9,0,0],)" + kHidden +
                              R"(},{"name":"c","mesh":0,"translation":[18,0,0],)" + visible("") + "}]";
    for (const std::string key : {"extensionsUsed", "extensionsRequired"}) {
        const Character c = readWell(trianglesAt(nodes, ",\"" + key + R"(":["KHR_node_visibility"])"), kStrict);
        EXPECT_EQ(partNames(c), (Strings{"a", "c"}));
        EXPECT_EQ(c.cage.faceCount(), 2u);
        EXPECT_EQ(c.skeleton.nodes.size(), 3u);
        EXPECT_EQ(c.warnings, (Strings{"node 1: hidden by KHR_node_visibility; left out"}));
    }
}

/// The node that hides what is below it may have no mesh, and what is below it may say that it is visible.
TEST(GltfVisibility, HidesAllThatIsBelow) {
    const Character c = readWell(trianglesAt(R"([{"name":"a","mesh":0},{"name":"b","mesh":0,"extensions":)"
                                             R"({"KHR_node_visibility":{"visible":true}}},{"children":[1,3],)" +
                                             kHidden + R"(},{"children":[4]},{"name":"c","mesh":0,)" + kHidden + "}]"));
    EXPECT_EQ(partNames(c), (Strings{"a"}));
    EXPECT_EQ(c.warnings, (Strings{"node 1: hidden by KHR_node_visibility of node 2; left out",
                                   "node 4: hidden by KHR_node_visibility of node 2; left out"}));
}

TEST(GltfVisibility, NothingIsLeft) {
    const GltfBuilder b = trianglesAt(R"([{"children":[1,2],)" + kHidden + R"(},{"mesh":0},{"mesh":0}])");
    const std::string message =
        "t.glb: nodes: all that have meshes are hidden by KHR_node_visibility, the first is node 1";
    EXPECT_EQ(messageOf(b), message);
    EXPECT_EQ(saidOf(b.glb()), "refused: " + message);
}

TEST(GltfVisibility, WhatIsWrongHidesNothing) {
    const std::string fault = "node 0 KHR_node_visibility";
    const GltfBuilder number = trianglesAt(R"([{"mesh":0,)" + visible(R"("visible":0)") + "}]");
    EXPECT_EQ(saidOf(number.glb()), fault + " visible: not a boolean; left out");
    EXPECT_EQ(messageOf(number), "t.glb: " + fault + " visible: not a boolean");
    const GltfBuilder list = trianglesAt(R"([{"mesh":0,"extensions":{"KHR_node_visibility":[false]}}])");
    EXPECT_EQ(saidOf(list.glb()), fault + ": not an object; left out");
}

/// One line for each extension of nodes with meshes that may change what is seen; lights are not among them.
TEST(GltfVisibility, UnreadExtensionsOfNodesAreNamed) {
    const std::string light = R"("KHR_lights_punctual":{"light":0})";
    const std::string copies = R"("EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}})";
    const GltfBuilder b = trianglesAt(R"([{"mesh":0,"extensions":{)" + light + R"(}},{"mesh":0,"extensions":{)" +
                                      copies + R"(}},{"mesh":0,"extensions":{)" + copies +
                                      R"(,"MSFT_lod":{"ids":[3]}}},{"extensions":{"MSFT_lod":{}}}])");
    EXPECT_EQ(saidOf(b.glb()), "node 1: EXT_mesh_gpu_instancing is not read, here and in 1 other place; the mesh is "
                               "drawn once\nnode 2: MSFT_lod is not read");
}

/// A triangle with two morph targets.
GltfBuilder withTargets(const std::string& meshMore, const std::string& primitiveMore) {
    GltfBuilder b = trianglesAt(R"([{"mesh":0}])");
    b.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":0},{"POSITION":0}])" +
               primitiveMore + "}]" + meshMore + "}]";
    return b;
}
std::string targetNames(const std::string& names) {
    return R"(,"extras":{"targetNames":)" + names + "}";
}

TEST(GltfVrm, NamesOfTargetsInAPrimitive) {
    const auto namesOf = [](const GltfBuilder& b, const Strings& warnings) {
        const Character c = readWell(b);
        EXPECT_EQ(c.warnings, warnings);
        Strings names;
        for (const MorphTarget& target : c.morphs.targets) {
            names.push_back(target.name);
        }
        return names;
    };
    EXPECT_EQ(namesOf(withTargets("", targetNames(R"(["A","Blink"])")), {}), (Strings{"A", "Blink"}));
    EXPECT_EQ(namesOf(withTargets(targetNames(R"(["x","y"])"), targetNames(R"(["A","Blink"])")), {}),
              (Strings{"x", "y"}));
    const std::string element = "mesh 0 primitive 0 extras targetNames";
    EXPECT_EQ(namesOf(withTargets("", targetNames(R"(["A"])")), {element + ": 1 name for 2 morph targets"}),
              (Strings{"A", ""}));
    EXPECT_EQ(namesOf(withTargets("", targetNames(R"([7,"B"])")), {element + "[0]: not a string; ignored"}),
              (Strings{"", "B"}));
    EXPECT_EQ(namesOf(withTargets("", targetNames("7")), {element + ": not an array; ignored"}), (Strings{"", ""}));
    EXPECT_EQ(namesOf(withTargets("", R"(,"extras":7)"), {}), (Strings{"", ""}));
}

TEST(GltfVrm, WhatIsNotUsedIsSaidInOneLine) {
    const std::string required =
        R"(,"extensionsRequired":["VRM","VRMC_vrm","VRMC_materials_mtoon","VRMC_springBone","VRMC_node_constraint"])";
    const auto said = [&](const std::string& extensions, const std::string& more = "") {
        return saidOf(
            trianglesAt(R"([{"mesh":0)" + more + "}]", R"(,"extensions":{)" + extensions + "}" + required).glb());
    };
    EXPECT_EQ(said(R"("VRM":{"blendShapeMaster":{},"secondaryAnimation":{},"firstPerson":{},"materialProperties":[]})"),
              "VRM: expressions, spring bones, first-person flags and toon materials are not used");
    EXPECT_EQ(said(R"("VRMC_vrm":{"expressions":{},"lookAt":{}},"VRMC_springBone":{})",
                   R"(,"extensions":{"VRMC_node_constraint":{}})"),
              "VRM: expressions, spring bones, gaze and node constraints are not used");
    EXPECT_EQ(said(R"("VRMC_vrm":{"humanoid":{}})"), "");
    EXPECT_EQ(said(R"("VRMC_vrm":7,"VRM":[])"), "");
    EXPECT_EQ(
        saidOf(trianglesAt(R"([{"mesh":0}])", R"(,"materials":[{"extensions":{"VRMC_materials_mtoon":{}}}])" + required)
                   .glb()),
        "material 0: VRMC_materials_mtoon is not read; the material is shown as its base");
}

} // namespace
} // namespace supple::cage
