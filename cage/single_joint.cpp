#include "cage/single_joint.h"

#include <numeric>

namespace supple::cage {

namespace {

SkinWeights ofOneJoint(size_t vertexCount) {
    SkinWeights weights;
    weights.starts.resize(vertexCount + 1);
    std::iota(weights.starts.begin(), weights.starts.end(), 0u);
    weights.influences.assign(vertexCount, {0, 1.0f});
    return weights;
}

void addOneJoint(Character& character, const std::string& name) {
    character.skeleton.nodes.assign(1, {});
    character.skeleton.nodes[0].name = name;
    character.skeleton.parentsFirst = {0};
    character.skin.joints = {0};
    character.skin.inverseBinds = {glm::mat4(1.0f)};
}

} // namespace

void bindToOneJoint(std::span<PartCage> parts, Character& character, const std::string& nodeName) {
    addOneJoint(character, nodeName);
    for (PartCage& part : parts) {
        part.part.joints = {0};
        part.weights = ofOneJoint(part.cage.positions.size());
        if (parts.size() == 1) {
            part.part.name = part.part.name.empty() ? nodeName : part.part.name;
            continue;
        }
        part.part.node = static_cast<uint32_t>(character.skeleton.nodes.size());
        character.skeleton.parentsFirst.push_back(part.part.node);
        Node& node = character.skeleton.nodes.emplace_back();
        node.name = part.part.name;
        node.parent = 0;
    }
}

void bindToOneJoint(Character& character, const std::string& nodeName) {
    addOneJoint(character, nodeName);
    character.parts.resize(1);
    character.parts[0].name = nodeName;
    character.parts[0].rigid = true;
    character.weights = ofOneJoint(character.cage.positions.size());
}

} // namespace supple::cage
