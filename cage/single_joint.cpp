#include "cage/single_joint.h"

#include <numeric>

namespace supple::cage {

void bindToOneJoint(Character& character, const std::string& nodeName) {
    const size_t vertexCount = character.cage.positions.size();
    character.skeleton.nodes.assign(1, {});
    character.skeleton.nodes[0].name = nodeName;
    character.skeleton.parentsFirst = {0};
    character.parts.resize(1);
    character.parts[0].name = nodeName;
    character.parts[0].rigid = true;
    character.skin.joints = {0};
    character.skin.inverseBinds = {glm::mat4(1.0f)};
    character.weights.starts.resize(vertexCount + 1);
    std::iota(character.weights.starts.begin(), character.weights.starts.end(), 0u);
    character.weights.influences.assign(vertexCount, {0, 1.0f});
}

} // namespace supple::cage
