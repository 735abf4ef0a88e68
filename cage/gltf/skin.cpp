#include "cage/gltf/skin.h"

#include "cage/gltf/accessors.h"
#include "cage/limits.h"
#include "cage/refusal.h"
#include "cage/skeleton.h"

#include <algorithm>
#include <cmath>

namespace supple::cage::gltf {
namespace {

/// A joint of a skin as a node has it: inverse binds, and places in palettes. Nodes may share a skin.
constexpr uint64_t kJointBytes = 512;

constexpr size_t kMaxSkinSets = 16; // of four influences each

/// What JOINTS_n and WEIGHTS_n hold, by n; four values a vertex.
struct SetValues {
    std::vector<std::vector<uint32_t>> joints;
    std::vector<std::vector<float>> weights;
    double rounding = 0.0; ///< half a step of the coarsest integer weights
};

SetValues readSets(const Document& document, const SkinSets& sets, size_t count, const std::string& element) {
    SetValues values;
    for (size_t n = 0; n < sets.joints.size(); ++n) {
        const std::string jointName = element + " JOINTS_" + std::to_string(n);
        const std::string weightName = element + " WEIGHTS_" + std::to_string(n);
        checkVertexCount(document, sets.joints[n], count, jointName);
        checkVertexCount(document, sets.weights[n], count, weightName);
        values.joints.push_back(readIntegers(document, sets.joints[n], file::kVec4, kU8 | kU16, jointName));
        values.weights.push_back(
            readFloats(document, sets.weights[n], file::kVec4, kFloat | kNormalizedU8 | kNormalizedU16, weightName));
        const int type = document.model.accessors[static_cast<size_t>(sets.weights[n])].componentType;
        if (type == file::kUnsignedByte) {
            values.rounding = std::max(values.rounding, 0.5 / 255.0);
        } else if (type == file::kUnsignedShort) {
            values.rounding = std::max(values.rounding, 0.5 / 65535.0);
        }
    }
    return values;
}

/// Puts the influences of a vertex that are not zero into `own`, in the file's order.
void collectInfluences(const SetValues& values, size_t vertex, size_t jointCount, const std::string& element,
                       std::vector<Influence>& own) {
    own.clear();
    for (size_t n = 0; n < values.joints.size(); ++n) {
        const auto place = [&](const char* name) { return item(element + name + std::to_string(n), vertex); };
        for (size_t k = 0; k < 4; ++k) {
            const float weight = values.weights[n][4 * vertex + k];
            const uint32_t joint = values.joints[n][4 * vertex + k];
            if (!std::isfinite(weight)) {
                refuse(place(" WEIGHTS_"), "not finite");
            }
            if (weight < 0.0f) {
                refuse(place(" WEIGHTS_"), "negative");
            }
            if (weight == 0.0f) {
                continue; // its joint means nothing
            }
            if (joint >= jointCount) {
                refuse(place(" JOINTS_"), "joint " + std::to_string(joint) + " is out of range: the skin has " +
                                              std::to_string(jointCount));
            }
            own.push_back({joint, weight});
        }
    }
}

} // namespace

Skin readSkin(const Document& document, uint32_t meshNode) {
    Skin skin;
    const int index = document.model.nodes[meshNode].skin;
    if (index < 0) {
        skin.joints = {meshNode};
        skin.inverseBinds = {glm::mat4(1.0f)};
        return skin;
    }
    const auto& from = document.model.skins[static_cast<size_t>(index)];
    document.memory->take(from.joints.size(), kJointBytes, at("skin", static_cast<size_t>(index)));
    for (const int joint : from.joints) {
        skin.joints.push_back(static_cast<uint32_t>(joint));
    }
    skin.inverseBinds.assign(skin.joints.size(), glm::mat4(1.0f));
    if (from.inverseBindMatrices < 0) {
        return skin;
    }
    const std::string element = at("skin", static_cast<size_t>(index)) + " inverseBindMatrices";
    const auto values = readFloats(document, from.inverseBindMatrices, file::kMat4, kFloat, element);
    if (values.size() / 16 < skin.joints.size()) {
        refuse(element, counted(values.size() / 16, "matrix", "matrices") + " for " +
                            counted(skin.joints.size(), "joint", "joints"));
    }
    for (size_t j = 0; j < skin.joints.size(); ++j) {
        for (size_t k = 0; k < 16; ++k) {
            if (const char* fault = faultOfCoordinate(values[16 * j + k])) {
                refuse(item(element, j), fault);
            }
            skin.inverseBinds[j][static_cast<int>(k / 4)][static_cast<int>(k % 4)] = values[16 * j + k];
        }
        makeAffine(skin.inverseBinds[j], item(element, j));
    }
    return skin;
}

SkinSets findSkinSets(const file::Primitive& primitive, const std::string& element) {
    SkinSets sets;
    for (size_t n = 0;; ++n) {
        const auto joint = primitive.attributes.find("JOINTS_" + std::to_string(n));
        const auto weight = primitive.attributes.find("WEIGHTS_" + std::to_string(n));
        const bool hasJoint = joint != primitive.attributes.end();
        const bool hasWeight = weight != primitive.attributes.end();
        if (hasJoint != hasWeight) {
            refuse(element, (hasJoint ? "JOINTS_" : "WEIGHTS_") + std::to_string(n) + " without " +
                                (hasJoint ? "WEIGHTS_" : "JOINTS_") + std::to_string(n));
        }
        if (!hasJoint) {
            break;
        }
        if (n == kMaxSkinSets) {
            refuse(element, "more than " + std::to_string(kMaxSkinSets) + " sets of joints and weights",
                   ErrorCode::limit);
        }
        sets.joints.push_back(joint->second);
        sets.weights.push_back(weight->second);
    }
    if (sets.joints.empty()) {
        refuse(element, "no JOINTS_0 and WEIGHTS_0, but its node has a skin");
    }
    for (const auto& [name, accessor] : primitive.attributes) {
        (void)accessor;
        for (const std::string prefix : {"JOINTS_", "WEIGHTS_"}) {
            if (!name.starts_with(prefix)) {
                continue;
            }
            const std::string number = name.substr(prefix.size());
            bool found = false;
            for (size_t n = 0; n < sets.joints.size() && !found; ++n) {
                found = number == std::to_string(n);
            }
            if (!found) {
                refuse(element, name + " does not continue the sets from 0");
            }
        }
    }
    return sets;
}

void appendWeights(const Document& document, const SkinSets& sets, size_t count, size_t jointCount,
                   const std::string& element, VertexWeights& weights) {
    const SetValues values = readSets(document, sets, count, element);
    std::vector<Influence> own;
    for (size_t v = 0; v < count; ++v) {
        collectInfluences(values, v, jointCount, element, own);
        const uint32_t first = values.joints[0][4 * v];
        weights.append(own, first < jointCount ? first : 0, values.rounding);
    }
}

} // namespace supple::cage::gltf
