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

/// Two nodes with a triangle each, whose meshes say how they are skinned.
GltfBuilder skinnedBy(const std::string& first, const std::string& second) {
    GltfBuilder b = trianglesAt(R"([{"name":"a","mesh":0},{"name":"b","mesh":1,"translation":[9,0,0]}])",
                                R"(,"extensionsUsed":["SUPPLE_deformers"])");
    const auto mesh = [](const std::string& value) {
        return R"({"extensions":{"SUPPLE_deformers":)" + value + R"(},"primitives":[{"attributes":{"POSITION":0}}]})";
    };
    b.meshes = "[" + mesh(first) + "," + mesh(second) + "]";
    return b;
}

TEST(GltfDeformers, MeshesNameTheirSkinning) {
    for (const SkinningMode mode : {SkinningMode::linear, SkinningMode::dualQuaternion, SkinningMode::centersOfRotation,
                                    SkinningMode::deltaMush, SkinningMode::deltaMushLight}) {
        const std::string named = R"({"skinning":")" + std::string(skinningModeName(mode)) + R"("})";
        const Character c = readWell(skinnedBy(named, "{}"), kStrict);
        EXPECT_EQ(c.parts[0].skinning, mode);
        EXPECT_EQ(c.parts[1].skinning, std::nullopt);
        EXPECT_EQ(c.warnings, Strings());
    }
    const GltfBuilder both = skinnedBy(R"({"skinning":"centersOfRotation"})", R"({"skinning":"linear"})");
    EXPECT_EQ(saidOf(both.glb()), "part \"b\": its skinning is \"linear\"; part \"a\" comes first, so that all are "
                                  "skinned by \"centersOfRotation\"");
}

TEST(GltfDeformers, OtherNamesAreToldApart) {
    const std::string place = "mesh 0 SUPPLE_deformers skinning: ";
    const GltfBuilder other = skinnedBy(R"({"skinning":"centres"})", "{}");
    EXPECT_EQ(saidOf(other.glb()), place + "\"centres\" is not allowed; left out");
    EXPECT_EQ(messageOf(other), "t.glb: " + place + "\"centres\" is not allowed");
    EXPECT_EQ(messageOf(skinnedBy(R"({"skinning":3})", "{}")), "t.glb: " + place + "not a string");
}

TEST(GltfDeformers, MeshesSayHowTheyAreSmoothed) {
    const Character c = readWell(skinnedBy(R"({"smoothing":{"lambda":2.5,"iterations":8}})", R"({"smoothing":{}})"));
    EXPECT_EQ(c.parts[0].smoothing, (Smoothing{2.5f, 8}));
    EXPECT_EQ(c.parts[1].smoothing, Smoothing());
    EXPECT_EQ(c.warnings,
              (Strings{"part \"b\": its smoothing is not that of part \"a\", which comes first and holds for "
                       "all"}));
    EXPECT_TRUE(c.weights.mushMask.empty());

    const std::string place = "t.glb: mesh 0 SUPPLE_deformers smoothing";
    const auto faultOf = [](const std::string& smoothing) {
        return messageOf(skinnedBy("{\"smoothing\":" + smoothing + "}", "{}"));
    };
    EXPECT_EQ(faultOf("3"), "t.glb: mesh 0 SUPPLE_deformers smoothing: not an object");
    EXPECT_EQ(faultOf(R"({"iterations":33})"), place + " iterations: 33: not from 1 to 32");
    EXPECT_EQ(faultOf(R"({"iterations":0})"), place + " iterations: 0: not from 1 to 32");
    EXPECT_EQ(faultOf(R"({"lambda":11})"), place + " lambda: not a number from 0.01 to 10");
    EXPECT_EQ(faultOf(R"({"mask":"MUSH"})"),
              place + " mask: \"MUSH\" is no name of an application's attribute: it has no _");
    EXPECT_EQ(faultOf(R"({"mask":"_MUSH"})"), place + " mask: no primitive has \"_MUSH\"");
}

/// Of the first mesh alone: the other part is smoothed wholly.
TEST(GltfDeformers, MasksAreRead) {
    GltfBuilder b = skinnedBy("{}", "{}");
    b.addFloats("SCALAR", {0, 0.25f, 0.5f});
    b.addFloats("SCALAR", {0, 1.5f, 1});
    const auto meshes = [](const char* accessor) {
        return std::string(R"([{"extensions":{"SUPPLE_deformers":{"smoothing":{"mask":"_M"}}},"primitives":)") +
               R"([{"attributes":{"POSITION":0,"_M":)" + accessor +
               R"(}}]},{"primitives":[{"attributes":{"POSITION":0}}]}])";
    };
    b.meshes = meshes("1");
    const Character c = readWell(b, kStrict);
    ASSERT_EQ(c.weights.mushMask.size(), c.cage.vertexCount());
    for (uint32_t v = 0; v < c.cage.vertexCount(); ++v) {
        const glm::vec3& p = c.cage.positions[v];
        const bool first = p.x < 5.0f;
        EXPECT_EQ(c.weights.mushMask[v], first ? 0.25f * p.x + 0.5f * p.y : 1.0f) << v;
    }
    EXPECT_EQ(c.parts[0].smoothing, Smoothing());
    b.meshes = meshes("2");
    EXPECT_EQ(messageOf(b), "t.glb: mesh 0 primitive 0 _M[1]: not from 0 to 1");
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
              "VRM: first-person flags and toon materials are not used");
    EXPECT_EQ(said(R"("VRMC_vrm":{"expressions":{},"lookAt":{}},"VRMC_springBone":{"springs":[]})",
                   R"(,"extensions":{"VRMC_node_constraint":{}})"),
              "VRM: gaze and node constraints are not used");
    EXPECT_EQ(said(R"("VRMC_vrm":{"humanoid":{}})"), "");
    EXPECT_EQ(said(R"("VRMC_vrm":7,"VRM":[])"), "");
    EXPECT_EQ(
        saidOf(trianglesAt(R"([{"mesh":0}])", R"(,"materials":[{"extensions":{"VRMC_materials_mtoon":{}}}])" + required)
                   .glb()),
        "material 0: VRMC_materials_mtoon is not read; the material is shown as its base");
}

std::string pointerTo(const std::string& pointer) {
    return R"("target":{"path":"pointer","extensions":{"KHR_animation_pointer":{"pointer":")" + pointer + "\"}}}";
}

/// skinnedQuad() with the target of its channel of rotation replaced.
GltfBuilder quadPointing(const std::string& target, const std::string& more = "") {
    GltfBuilder b = skinnedQuad();
    b.more = replaced(b.more, R"("target":{"node":2,"path":"rotation"})", target) + more;
    return b;
}

TEST(GltfPointer, MovesNodesAsOtherChannelsDo) {
    const Clip wanted = readWell(skinnedQuad()).clips[0];
    GltfBuilder b = quadPointing(pointerTo("/nodes/2/rotation"), R"(,"extensionsRequired":["KHR_animation_pointer"])");
    b.more = replaced(b.more, R"("target":{"node":2,"path":"translation"})", pointerTo("/nodes/2/translation"));
    const Character c = readWell(b, kStrict);
    EXPECT_EQ(c.warnings, Strings());
    ASSERT_EQ(c.clips[0].channels.size(), 2u);
    EXPECT_EQ(c.clips[0].duration, 2.0);
    for (size_t k = 0; k < 2; ++k) {
        const Channel& channel = c.clips[0].channels[k];
        EXPECT_EQ(channel.node, 2u);
        EXPECT_EQ(channel.path, wanted.channels[k].path);
        EXPECT_EQ(channel.times, wanted.channels[k].times);
        EXPECT_EQ(channel.values, wanted.channels[k].values);
    }
    b.more = replaced(b.more, "/nodes/2/translation", "/nodes/1/scale");
    const Character scaled = readWell(b);
    EXPECT_EQ(scaled.clips[0].channels[1].node, 1u);
    EXPECT_EQ(scaled.clips[0].channels[1].path, ChannelPath::scale);
}

TEST(GltfPointer, MovesWeights) {
    GltfBuilder b = withTargets("", "");
    b.addFloats("SCALAR", {0, 1});              // 1
    b.addFloats("SCALAR", {0, 0.5f, 1, 0.25f}); // 2
    b.more = R"(,"animations":[{"samplers":[{"input":1,"output":2}],"channels":[{"sampler":0,)" +
             pointerTo("/nodes/0/weights") + "}]}]";
    const Character c = readWell(b, kStrict);
    ASSERT_EQ(c.clips[0].channels.size(), 1u);
    EXPECT_EQ(c.clips[0].channels[0].path, ChannelPath::weights);
    EXPECT_EQ(c.clips[0].channels[0].values, (std::vector<float>{0, 0.5f, 1, 0.25f}));
}

TEST(GltfPointer, ATargetTwiceIsOne) {
    EXPECT_EQ(saidOf(quadPointing(pointerTo("/nodes/2/translation")).glb()),
              "animation 0 channel 0 output: VEC4 instead of VEC3; left out");
    GltfBuilder b = quadPointing(pointerTo("/nodes/2/translation"));
    b.more = replaced(b.more, R"("output":6)", R"("output":7)");
    EXPECT_EQ(saidOf(b.glb()), "animation 0 channel 1: a second channel for translation of node 2; left out");
}

TEST(GltfPointer, WhatElseMovesIsNamedByItsKind) {
    const auto said = [](const std::string& target) {
        const GltfBuilder b = quadPointing(target);
        EXPECT_EQ(readWell(b).clips[0].channels.size(), 1u);
        return saidOf(b.glb());
    };
    const auto ignored = [](const std::string& what) { return "animation 0: 1 channel of " + what + " ignored"; };
    const std::string to = "KHR_animation_pointer to ";
    EXPECT_EQ(said(pointerTo("/nodes/2/extensions/KHR_node_visibility/visible")),
              ignored(to + "\"/nodes/*/extensions/KHR_node_visibility/visible\""));
    EXPECT_EQ(said(pointerTo("/materials/0/emissiveFactor")), ignored(to + "\"/materials/*/emissiveFactor\""));
    EXPECT_EQ(said(pointerTo("/nodes/2/weights/1")), ignored(to + "\"/nodes/*/weights/*\""));
    EXPECT_EQ(said(pointerTo("/nodes/-1/scale")), ignored(to + "\"/nodes/-1/scale\""));
    EXPECT_EQ(said(pointerTo("/nodes//scale")), ignored(to + "\"/nodes//scale\""));
    EXPECT_EQ(said(pointerTo("/nodes/2")), ignored(to + "\"/nodes/*\""));
    EXPECT_EQ(said(R"("target":{"path":"pointer"})"), ignored("no node"));
    EXPECT_EQ(said(R"("target":{"path":"pointer","extensions":{"KHR_animation_pointer":{"pointer":[7]}}})"),
              ignored("no node"));
    EXPECT_EQ(said(pointerTo("/nodes/3/rotation")),
              "animation 0 channel 0 pointer: node 3 is out of range: the file has 3; left out");
    EXPECT_EQ(said(pointerTo("/nodes/18446744073709551618/rotation")),
              "animation 0 channel 0 pointer: node 18446744073709551618 is out of range: the file has 3; left out");
}

} // namespace
} // namespace supple::cage
