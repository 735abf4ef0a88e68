// Roles of joints, by the names that rigs of many makers give them.
#include "skinning/roles.h"

#include "cage/skeleton.h"

#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

namespace supple::skinning {
namespace {

using Names = std::vector<std::pair<std::string, std::string>>; ///< node, its parent

cage::Skeleton skeletonOf(const Names& names) {
    cage::Skeleton skeleton;
    std::map<std::string, uint32_t> numbers;
    for (const auto& [name, parent] : names) {
        cage::Node node;
        node.name = name;
        node.parent = parent.empty() ? cage::kNone : numbers.at(parent);
        numbers[name] = static_cast<uint32_t>(skeleton.nodes.size());
        skeleton.nodes.push_back(node);
    }
    cage::orderParentsFirst(skeleton);
    return skeleton;
}

Roles noRoles() {
    Roles roles{};
    roles.fill(cage::kNone);
    return roles;
}

/// "hips=pelvis thigh.l=upleg ...", in the order of roles.
std::string told(const cage::Skeleton& skeleton, const Roles& roles) {
    std::string text;
    for (Role role = 0; role < kRoles; ++role) {
        if (roles[role] != cage::kNone) {
            text += (text.empty() ? "" : " ") + nameOfRole(role) + "=" + skeleton.nodes[roles[role]].name;
        }
    }
    return text;
}

std::string rolesIn(const Names& names) {
    const cage::Skeleton skeleton = skeletonOf(names);
    return told(skeleton, findRoles(skeleton, noRoles()));
}

TEST(Roles, AreFoundInRigsOfManyMakers) {
    EXPECT_EQ(rolesIn({{"mixamorig:Hips", ""},
                       {"mixamorig:Spine", "mixamorig:Hips"},
                       {"mixamorig:Neck", "mixamorig:Spine"},
                       {"mixamorig:Head", "mixamorig:Neck"},
                       {"mixamorig:LeftShoulder", "mixamorig:Spine"},
                       {"mixamorig:LeftArm", "mixamorig:LeftShoulder"},
                       {"mixamorig:LeftForeArm", "mixamorig:LeftArm"},
                       {"mixamorig:LeftHand", "mixamorig:LeftForeArm"},
                       {"mixamorig:LeftHandThumb1", "mixamorig:LeftHand"},
                       {"mixamorig:LeftUpLeg", "mixamorig:Hips"},
                       {"mixamorig:LeftLeg", "mixamorig:LeftUpLeg"},
                       {"mixamorig:LeftFoot", "mixamorig:LeftLeg"},
                       {"mixamorig:LeftToeBase", "mixamorig:LeftFoot"},
                       {"mixamorig:RightUpLeg", "mixamorig:Hips"},
                       {"mixamorig:RightLeg", "mixamorig:RightUpLeg"},
                       {"mixamorig:RightFoot", "mixamorig:RightLeg"}}),
              "hips=mixamorig:Hips neck=mixamorig:Neck head=mixamorig:Head thigh.l=mixamorig:LeftUpLeg "
              "shin.l=mixamorig:LeftLeg foot.l=mixamorig:LeftFoot toes.l=mixamorig:LeftToeBase "
              "clavicle.l=mixamorig:LeftShoulder upperarm.l=mixamorig:LeftArm lowerarm.l=mixamorig:LeftForeArm "
              "hand.l=mixamorig:LeftHand thigh.r=mixamorig:RightUpLeg shin.r=mixamorig:RightLeg "
              "foot.r=mixamorig:RightFoot");
    EXPECT_EQ(rolesIn({{"root", ""},
                       {"ik_foot_root", "root"},
                       {"ik_foot_l", "ik_foot_root"},
                       {"pelvis", "root"},
                       {"thigh_l", "pelvis"},
                       {"thigh_twist_01_l", "thigh_l"},
                       {"calf_l", "thigh_l"},
                       {"foot_l", "calf_l"},
                       {"ball_l", "foot_l"},
                       {"thigh_r", "pelvis"},
                       {"calf_r", "thigh_r"},
                       {"foot_r", "calf_r"}}),
              "hips=pelvis thigh.l=thigh_l shin.l=calf_l foot.l=foot_l toes.l=ball_l thigh.r=thigh_r shin.r=calf_r "
              "foot.r=foot_r")
        << "targets of IK have no role";
    EXPECT_EQ(rolesIn({{"Bip01 Pelvis", ""},
                       {"Bip01 L Thigh", "Bip01 Pelvis"},
                       {"Bip01 L Calf", "Bip01 L Thigh"},
                       {"Bip01 L Foot", "Bip01 L Calf"},
                       {"Bip01 R Thigh", "Bip01 Pelvis"},
                       {"Bip01 R Calf", "Bip01 R Thigh"},
                       {"Bip01 R Foot", "Bip01 R Calf"}}),
              "hips=Bip01 Pelvis thigh.l=Bip01 L Thigh shin.l=Bip01 L Calf foot.l=Bip01 L Foot thigh.r=Bip01 R Thigh "
              "shin.r=Bip01 R Calf foot.r=Bip01 R Foot");
    EXPECT_EQ(rolesIn({{"J_Bip_C_Hips", ""},
                       {"J_Bip_L_UpperLeg", "J_Bip_C_Hips"},
                       {"J_Bip_L_LowerLeg", "J_Bip_L_UpperLeg"},
                       {"J_Bip_L_Foot", "J_Bip_L_LowerLeg"},
                       {"J_Bip_R_UpperLeg", "J_Bip_C_Hips"},
                       {"J_Bip_R_LowerLeg", "J_Bip_R_UpperLeg"},
                       {"J_Bip_R_Foot", "J_Bip_R_LowerLeg"}}),
              "hips=J_Bip_C_Hips thigh.l=J_Bip_L_UpperLeg shin.l=J_Bip_L_LowerLeg foot.l=J_Bip_L_Foot "
              "thigh.r=J_Bip_R_UpperLeg shin.r=J_Bip_R_LowerLeg foot.r=J_Bip_R_Foot");
    EXPECT_EQ(rolesIn({{"hip", ""},
                       {"pelvis", "hip"},
                       {"lThighBend", "pelvis"},
                       {"lThighTwist", "lThighBend"},
                       {"lShin", "lThighTwist"},
                       {"lFoot", "lShin"},
                       {"rThighBend", "pelvis"},
                       {"rThighTwist", "rThighBend"},
                       {"rShin", "rThighTwist"},
                       {"rFoot", "rShin"},
                       {"abdomenLower", "hip"},
                       {"neckLower", "abdomenLower"},
                       {"head", "neckLower"},
                       {"lCollar", "abdomenLower"},
                       {"lShldrBend", "lCollar"},
                       {"lForearmBend", "lShldrBend"},
                       {"lHand", "lForearmBend"}}),
              "hips=pelvis thigh.l=lThighBend shin.l=lShin foot.l=lFoot clavicle.l=lCollar upperarm.l=lShldrBend "
              "lowerarm.l=lForearmBend hand.l=lHand thigh.r=rThighBend shin.r=rShin foot.r=rFoot")
        << "all in one place: a hip that is no higher than the feet is not taken";
    EXPECT_EQ(rolesIn({{"mixamorigHips", ""},
                       {"mixamorigLeftUpLeg", "mixamorigHips"},
                       {"mixamorigLeftLeg", "mixamorigLeftUpLeg"},
                       {"mixamorigLeftFoot", "mixamorigLeftLeg"},
                       {"mixamorigRightUpLeg", "mixamorigHips"},
                       {"mixamorigRightLeg", "mixamorigRightUpLeg"},
                       {"mixamorigRightFoot", "mixamorigRightLeg"}}),
              "hips=mixamorigHips thigh.l=mixamorigLeftUpLeg shin.l=mixamorigLeftLeg foot.l=mixamorigLeftFoot "
              "thigh.r=mixamorigRightUpLeg shin.r=mixamorigRightLeg foot.r=mixamorigRightFoot");
}

TEST(Roles, HipsAreAboveTheSpineToo) {
    cage::Skeleton skeleton = skeletonOf({{"root", ""},
                                          {"hip", "root"},
                                          {"pelvis", "hip"},
                                          {"thigh.L", "pelvis"},
                                          {"shin.L", "thigh.L"},
                                          {"foot.L", "shin.L"},
                                          {"thigh.R", "pelvis"},
                                          {"shin.R", "thigh.R"},
                                          {"foot.R", "shin.R"},
                                          {"waist", "hip"},
                                          {"neck", "waist"},
                                          {"head", "neck"}});
    skeleton.nodes[1].translation.y = 1.0f;                                     // hip
    skeleton.nodes[4].translation.y = skeleton.nodes[7].translation.y = -0.45f; // shins
    skeleton.nodes[5].translation.y = skeleton.nodes[8].translation.y = -0.45f; // feet
    const std::string legs = " thigh.l=thigh.L shin.l=shin.L foot.l=foot.L thigh.r=thigh.R shin.r=shin.R foot.r=foot.R";
    EXPECT_EQ(told(skeleton, findRoles(skeleton, noRoles())), "hips=hip neck=neck head=head" + legs);
    skeleton.nodes[9].parent = 0; // the spine hangs on the root
    skeleton.parentsFirst.clear();
    cage::orderParentsFirst(skeleton);
    EXPECT_EQ(told(skeleton, findRoles(skeleton, noRoles())), "hips=pelvis" + legs)
        << "a root on the ground is no hips";
}

TEST(Roles, AreLegsWithKneesThatMayBeCalledLegs) {
    EXPECT_EQ(rolesIn({{"base", ""},
                       {"leg.L", "base"},
                       {"knee.L", "leg.L"},
                       {"ankle.L", "knee.L"},
                       {"leg.R", "base"},
                       {"knee.R", "leg.R"},
                       {"ankle.R", "knee.R"}}),
              "hips=base thigh.l=leg.L shin.l=knee.L foot.l=ankle.L thigh.r=leg.R shin.r=knee.R foot.r=ankle.R")
        << "the hips are what is above both";
    EXPECT_EQ(rolesIn({{"root", ""}, {"foot.L", "root"}, {"thigh.L", "root"}, {"shin.L", "thigh.L"}}), "")
        << "a foot that is not below its shin is no leg's (an IK rig)";
    EXPECT_EQ(rolesIn({{"left arm rest", ""}, {"", ""}, {"l", ""}, {"L", ""}, {"::", ""}, {"right", ""}}), "");
}

TEST(Roles, WhatAUserSaysGoesFirst) {
    const cage::Skeleton skeleton = skeletonOf({{"root", ""},
                                                {"Bone", "root"},
                                                {"Bone.001", "Bone"},
                                                {"Bone.002", "Bone.001"},
                                                {"thigh.R", "root"},
                                                {"shin.R", "thigh.R"},
                                                {"foot.R", "shin.R"}});
    EXPECT_FALSE(hasLegs(findRoles(skeleton, noRoles())));
    Roles given = noRoles();
    given[roleOf(BodyPart::thigh, kLeft)] = 1;
    given[roleOf(BodyPart::shin, kLeft)] = 2;
    given[roleOf(BodyPart::foot, kLeft)] = 3;
    const Roles found = findRoles(skeleton, given);
    EXPECT_TRUE(hasLegs(found));
    EXPECT_EQ(told(skeleton, found),
              "hips=root thigh.l=Bone shin.l=Bone.001 foot.l=Bone.002 thigh.r=thigh.R shin.r=shin.R foot.r=foot.R");
    given[roleOf(BodyPart::shin, kLeft)] = 3; // above the foot it is not
    EXPECT_FALSE(hasLegs(findRoles(skeleton, given)));
}

TEST(Roles, HaveNames) {
    for (Role role = 0; role < kRoles; ++role) {
        EXPECT_EQ(roleNamed(nameOfRole(role)), std::optional(role));
    }
    EXPECT_EQ(nameOfRole(roleOf(BodyPart::lowerArm, kRight)), "lowerarm.r");
    EXPECT_FALSE(roleNamed("thigh") || roleNamed("tail") || roleNamed(""));
}

} // namespace
} // namespace supple::skinning
