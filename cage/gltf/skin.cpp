#include "cage/gltf/skin.h"

#include "cage/entry_faults.h"
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

/// Numbers of joints. Some writers have them as floats, or larger than they need be.
std::vector<uint32_t> readJoints(const Document& document, int accessor, const std::string& name) {
    const int type = document.model.accessors[static_cast<size_t>(accessor)].componentType;
    if (type == file::kUnsignedInt) {
        document.leniency->mend(name, "UNSIGNED_INT components are not allowed here", "read all the same");
        return readIntegers(document, accessor, file::kVec4, kU32, name);
    }
    if (type != file::kFloat) {
        return readIntegers(document, accessor, file::kVec4, kU8 | kU16, name);
    }
    document.leniency->mend(name, "FLOAT components are not allowed here", "read as whole numbers");
    const std::vector<float> values = readFloats(document, accessor, file::kVec4, kFloat, name);
    std::vector<uint32_t> joints;
    joints.reserve(values.size());
    for (size_t i = 0; i < values.size(); ++i) {
        // Written so that a NaN is refused too.
        if (!(values[i] >= 0.0f && values[i] <= 65535.0f) || std::floor(values[i]) != values[i]) {
            refuse(item(name, i / 4), "not the number of a joint");
        }
        joints.push_back(static_cast<uint32_t>(values[i]));
    }
    return joints;
}

SetValues readSets(const Document& document, const SkinSets& sets, size_t count, const std::string& element) {
    SetValues values;
    for (size_t n = 0; n < sets.joints.size(); ++n) {
        const std::string jointName = element + " JOINTS_" + std::to_string(n);
        const std::string weightName = element + " WEIGHTS_" + std::to_string(n);
        checkVertexCount(document, sets.joints[n], count, jointName);
        checkVertexCount(document, sets.weights[n], count, weightName);
        values.joints.push_back(readJoints(document, sets.joints[n], jointName));
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

/// What is wrong with an influence that is not zero; null: nothing.
const char* faultOfWeight(float weight) {
    return !std::isfinite(weight) ? "not finite" : weight < 0.0f ? "negative" : nullptr;
}

/// Makes the weights of influences zero that cannot be used.
void dropFaultyInfluences(const Document& document, size_t jointCount, const std::string& element, SetValues& values) {
    for (size_t n = 0; n < values.joints.size(); ++n) {
        EntryFaults weights(element + " WEIGHTS_" + std::to_string(n));
        EntryFaults joints(element + " JOINTS_" + std::to_string(n));
        for (size_t i = 0; i < values.weights[n].size(); ++i) {
            float& weight = values.weights[n][i];
            const uint32_t joint = values.joints[n][i];
            if (const char* fault = faultOfWeight(weight)) {
                weights.add(i / 4, fault);
                weight = 0.0f;
            } else if (weight > 0.0f && joint >= jointCount) {
                joints.add(i / 4, "joint " + std::to_string(joint) + " is out of range: the skin has " +
                                      std::to_string(jointCount));
                weight = 0.0f;
            }
        }
        weights.report(*document.leniency, "the influence is left out");
        joints.report(*document.leniency, "the influence is left out");
    }
}

/// Puts the influences of a vertex that are not zero into `own`, in the file's order.
void collectInfluences(const SetValues& values, size_t vertex, std::vector<Influence>& own) {
    own.clear();
    for (size_t n = 0; n < values.joints.size(); ++n) {
        for (size_t k = 0; k < 4; ++k) {
            const float weight = values.weights[n][4 * vertex + k];
            if (weight != 0.0f) { // else its joint means nothing
                own.push_back({values.joints[n][4 * vertex + k], weight});
            }
        }
    }
}

/// Inverse bind matrices that the file lacks, as if these joints were bound where they rest, in the space in which the
/// first joint is bound that has one.
void addMissingBinds(std::span<const glm::dmat4> restPlaces, size_t first, Skin& skin) {
    glm::dmat4 space(1.0); // from the mesh to the skeleton
    if (first > 0) {
        space = restPlaces[skin.joints[0]] * glm::dmat4(skin.inverseBinds[0]);
    }
    for (size_t j = first; j < skin.joints.size(); ++j) {
        const glm::dmat4& place = restPlaces[skin.joints[j]];
        if (glm::determinant(glm::dmat3(place)) == 0.0) {
            continue; // nothing is seen of what hangs on it
        }
        glm::mat4 bind(glm::inverse(place) * space);
        if (faultOfCoordinates(&bind[0][0], 16) == nullptr) {
            for (int k = 0; k < 4; ++k) {
                bind[k][3] = k < 3 ? 0.0f : 1.0f;
            }
            skin.inverseBinds[j] = bind;
        }
    }
}

} // namespace

Skin readSkin(const Document& document, std::span<const glm::dmat4> restPlaces, uint32_t meshNode) {
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
    const size_t given = std::min(values.size() / 16, skin.joints.size());
    if (given < skin.joints.size()) {
        document.leniency->mend(
            element, counted(given, "matrix", "matrices") + " for " + counted(skin.joints.size(), "joint", "joints"),
            "the others are bound where they rest");
    }
    for (size_t j = 0; j < given; ++j) {
        for (size_t k = 0; k < 16; ++k) {
            if (const char* fault = faultOfCoordinate(values[16 * j + k])) {
                refuse(item(element, j), fault);
            }
            skin.inverseBinds[j][static_cast<int>(k / 4)][static_cast<int>(k % 4)] = values[16 * j + k];
        }
        makeAffine(skin.inverseBinds[j], item(element, j), *document.leniency);
    }
    addMissingBinds(restPlaces, given, skin);
    return skin;
}

bool hasSkinSets(const file::Primitive& primitive) {
    return primitive.attributes.contains("JOINTS_0") && primitive.attributes.contains("WEIGHTS_0");
}

SkinSets findSkinSets(const Document& document, const file::Primitive& primitive, const std::string& element) {
    Leniency& leniency = *document.leniency;
    SkinSets sets;
    bool isCut = false; // half of a set is missing
    for (size_t n = 0;; ++n) {
        const auto joint = primitive.attributes.find("JOINTS_" + std::to_string(n));
        const auto weight = primitive.attributes.find("WEIGHTS_" + std::to_string(n));
        const bool hasJoint = joint != primitive.attributes.end();
        const bool hasWeight = weight != primitive.attributes.end();
        if (hasJoint != hasWeight) {
            leniency.mend(element,
                          (hasJoint ? "JOINTS_" : "WEIGHTS_") + std::to_string(n) + " without " +
                              (hasJoint ? "WEIGHTS_" : "JOINTS_") + std::to_string(n),
                          n > 0 ? "left out" : "it is not skinned, and moves with its node");
            isCut = true;
            break;
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
    if (sets.joints.empty() && !isCut) {
        leniency.mend(element, "no JOINTS_0 and WEIGHTS_0, but its node has a skin",
                      "it is not skinned, and moves with its node");
    }
    if (sets.joints.empty() || isCut) {
        return sets;
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
                leniency.mend(element, name + " does not continue the sets from 0", "left out");
            }
        }
    }
    return sets;
}

void appendWeights(const Document& document, const SkinSets& sets, size_t count, size_t jointCount,
                   const std::string& element, VertexWeights& weights) {
    SetValues values = readSets(document, sets, count, element);
    dropFaultyInfluences(document, jointCount, element, values);
    std::vector<Influence> own;
    for (size_t v = 0; v < count; ++v) {
        collectInfluences(values, v, own);
        const uint32_t first = values.joints[0][4 * v];
        weights.append(own, first < jointCount ? first : 0, values.rounding);
    }
}

} // namespace supple::cage::gltf
