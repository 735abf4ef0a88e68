#include "skinning/layers.h"

#include "skinning/rotation.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <string>

namespace supple::skinning {
namespace {

double clipTime(const Layer& layer, double time) {
    return layer.loop ? loopTime(time, layer.clip->duration).time : time;
}

void sampleLayer(const cage::Character& character, const Layer& layer, double time, const RootSelection& root,
                 Pose& pose) {
    sampleClip(character, *layer.clip, clipTime(layer, time), pose);
    removeRootMotion(character, *layer.clip, root, pose);
}

double morphWeight(const Layer& layer, size_t target) {
    if (layer.morphMask.empty()) {
        return layer.jointMask.empty() ? layer.weight : 0.0;
    }
    return layer.weight * static_cast<double>(layer.morphMask[target]);
}

double mixed(double a, double b, double t) {
    return t == 1.0 ? b : a + (b - a) * t;
}

void blend(const Transform& sample, double weight, Transform& to) {
    if (weight == 1.0) {
        to = sample;
        return;
    }
    to.translation += (sample.translation - to.translation) * weight;
    to.rotation = slerp(unit(to.rotation), unit(sample.rotation), weight);
    to.scale += (sample.scale - to.scale) * weight;
}

void add(const Transform& sample, const Transform& reference, double weight, Transform& to) {
    to.translation += (sample.translation - reference.translation) * weight;
    if (sample.rotation != reference.rotation) {
        const glm::dquat difference = glm::conjugate(unit(reference.rotation)) * unit(sample.rotation);
        to.rotation = unit(to.rotation) * slerp({1.0, 0.0, 0.0, 0.0}, difference, weight);
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (reference.scale[axis] != 0.0) { // of nothing, no factor makes something
            to.scale[axis] *= 1.0 + weight * (sample.scale[axis] / reference.scale[axis] - 1.0);
        }
    }
}

} // namespace

double layerWeight(const Rig& rig, const Layer& layer, uint32_t node) {
    const uint32_t joint = rig.maskJoints[node];
    return layer.jointMask.empty() || joint == cage::kNone ? layer.weight
                                                           : layer.weight * static_cast<double>(layer.jointMask[joint]);
}

namespace {

std::string lettersOf(const std::string& name) {
    std::string letters;
    std::copy_if(name.begin(), name.end(), std::back_inserter(letters),
                 [](char c) { return std::isdigit(static_cast<unsigned char>(c)) == 0; });
    return letters;
}

std::vector<uint32_t> boneStarts(const cage::Character& character, const Rig& rig) {
    const std::vector<uint32_t>& joints = character.skin.joints;
    std::vector<std::string> letters;
    for (const uint32_t node : joints) {
        letters.push_back(lettersOf(character.skeleton.nodes[node].name));
    }
    std::vector<uint32_t> starts(joints.size());
    for (const uint32_t node : character.skeleton.parentsFirst) {
        const uint32_t joint = rig.maskJoints[node];
        if (joint == cage::kNone || joints[joint] != node) {
            continue;
        }
        const uint32_t parent = rig.jointParents[joint];
        const bool goesOn = parent != cage::kNone && !letters[joint].empty() && letters[parent] == letters[joint];
        starts[joint] = goesOn ? starts[parent] : joint;
    }
    return starts;
}

} // namespace

Rig makeRig(const cage::Character& character) {
    const cage::Skeleton& skeleton = character.skeleton;
    Rig rig;
    rig.maskJoints.assign(skeleton.nodes.size(), cage::kNone);
    for (uint32_t j = 0; j < character.skin.joints.size(); ++j) {
        rig.maskJoints[character.skin.joints[j]] = j;
    }
    // Below a joint counts the joint above.
    std::vector<uint32_t> above(skeleton.nodes.size(), cage::kNone);
    for (const uint32_t node : skeleton.parentsFirst) {
        const uint32_t parent = skeleton.nodes[node].parent;
        above[node] = parent == cage::kNone ? cage::kNone : rig.maskJoints[parent];
        if (rig.maskJoints[node] == cage::kNone) {
            rig.maskJoints[node] = above[node];
        }
    }
    for (const uint32_t joint : character.skin.joints) {
        rig.jointParents.push_back(above[joint]);
    }
    // Above all joints counts the first one below.
    for (size_t i = skeleton.parentsFirst.size(); i-- > 0;) {
        const uint32_t node = skeleton.parentsFirst[i], parent = skeleton.nodes[node].parent;
        if (parent != cage::kNone && above[node] == cage::kNone) {
            rig.maskJoints[parent] = std::min(rig.maskJoints[parent], rig.maskJoints[node]);
        }
    }
    rig.boneStarts = boneStarts(character, rig);
    rig.root = findRoot(character);
    return rig;
}

PoseMemory::PoseMemory(const cage::Character& character) : nodes(character.skeleton.nodes.size()) {
    for (Pose* own : {&pose, &scratch.sample, &scratch.reference}) {
        restPose(character, *own);
    }
}

void applyLayer(const cage::Character& character, const Rig& rig, const Layer& layer, const RootSelection& root,
                LayerScratch& scratch, Pose& pose) {
    if (layer.weight == 0.0) {
        return;
    }
    Pose &sample = scratch.sample, &reference = scratch.reference;
    sampleLayer(character, layer, layer.time, root, sample);
    const bool additive = layer.mode == LayerMode::additive;
    if (additive) {
        sampleLayer(character, layer, layer.referenceTime, root, reference);
    }
    for (uint32_t node = 0; node < pose.locals.size(); ++node) {
        const double weight = layerWeight(rig, layer, node);
        if (weight == 0.0) {
            continue;
        }
        if (additive) {
            add(sample.locals[node], reference.locals[node], weight, pose.locals[node]);
        } else {
            blend(sample.locals[node], weight, pose.locals[node]);
        }
    }
    for (size_t target = 0; target < pose.morphWeights.size(); ++target) {
        const double weight = morphWeight(layer, target);
        double& to = pose.morphWeights[target];
        to = additive ? to + (sample.morphWeights[target] - reference.morphWeights[target]) * weight
                      : mixed(to, sample.morphWeights[target], weight);
    }
}

RootMotion layerRootMotion(const cage::Character& character, const Rig& rig, const Layer& layer,
                           const RootSelection& root, const RootMotion& before) {
    const double weight = root.node == cage::kNone ? 0.0 : layerWeight(rig, layer, root.node);
    if (weight == 0.0) {
        return before;
    }
    const RootMotion motion =
        rootMotionBetween(character, *layer.clip, root, layer.previousTime, layer.time, layer.loop);
    if (layer.mode == LayerMode::additive) {
        return {before.translation + motion.translation * weight, before.yaw + motion.yaw * weight};
    }
    return {{mixed(before.translation.x, motion.translation.x, weight),
             mixed(before.translation.y, motion.translation.y, weight),
             mixed(before.translation.z, motion.translation.z, weight)},
            mixed(before.yaw, motion.yaw, weight)};
}

void fillJointMask(const Rig& rig, uint32_t joint, float value, std::span<float> mask) {
    for (uint32_t j = 0; j < mask.size(); ++j) {
        uint32_t above = j;
        while (above != joint && above != cage::kNone) {
            above = rig.jointParents[above];
        }
        if (above == joint) {
            mask[j] = value;
        }
    }
}

} // namespace supple::skinning
