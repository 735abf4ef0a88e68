#include "skinning/joints.h"

#include <cassert>
#include <cmath>

namespace supple::skinning {
namespace {

bool isFinite(const glm::mat4& matrix) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(matrix[column][row])) {
                return false;
            }
        }
    }
    return true;
}

} // namespace

void jointTransforms(const cage::Skin& skin, std::span<const glm::mat4> globals, std::span<glm::mat4> joints) {
    assert(joints.size() == skin.joints.size());
    for (size_t j = 0; j < joints.size(); ++j) {
        joints[j] = globals[skin.joints[j]];
    }
}

JointFrames jointFrames(const cage::Character& character) {
    const cage::Skin& skin = character.skin;
    std::vector<glm::mat4> nodes(character.skeleton.nodes.size());
    restPose(character.skeleton, nodes);
    globalTransforms(character.skeleton, nodes, nodes);
    JointFrames frames;
    frames.rest.resize(skin.joints.size());
    jointTransforms(skin, nodes, frames.rest);
    for (size_t j = 0; j < skin.joints.size(); ++j) {
        // A determinant of exactly 0 divides to infinities or to no numbers.
        const glm::mat4 bind(glm::inverse(glm::dmat4(skin.inverseBinds[j])));
        const bool singular = !isFinite(bind);
        frames.bind.push_back(singular ? frames.rest[j] : bind);
        frames.bindIsSingular.push_back(singular ? 1 : 0);
    }
    return frames;
}

glm::mat4 placedJoint(const glm::dmat4& place, const glm::mat4& joint) {
    return place == glm::dmat4(1.0) ? joint : glm::mat4(place * glm::dmat4(joint));
}

} // namespace supple::skinning
