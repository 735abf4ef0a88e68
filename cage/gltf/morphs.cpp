#include "cage/gltf/morphs.h"

#include "cage/gltf/accessors.h"
#include "cage/gltf/triangles.h"
#include "cage/limits.h"
#include "cage/refusal.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace supple::cage::gltf {
namespace {

// Accessors may be shared, and need no bytes where they are sparse, so a small file can ask for many.
constexpr uint64_t kMaxMorphElements = 1u << 26;

} // namespace

std::vector<int> findMorphTargets(const file::Primitive& primitive) {
    std::vector<int> accessors;
    for (const auto& target : primitive.targets) {
        const auto position = target.find("POSITION");
        accessors.push_back(position == target.end() ? -1 : position->second);
    }
    return accessors;
}

void MorphReader::append(const Document& document, const std::vector<int>& targets, size_t count,
                         const std::string& element, VertexMorphs& morphs) {
    if (morphs.empty()) {
        targetCount_ = targets.size();
    } else if (targets.size() != targetCount_) {
        refuse(element, counted(targets.size(), "morph target", "morph targets") + ", but primitives before it have " +
                            std::to_string(targetCount_));
    }

    for (const int target : targets) {
        elementsRead_ += target < 0 ? 0 : count;
    }
    if (elementsRead_ > kMaxMorphElements) {
        refuse(element, "the morph targets hold more than " + std::to_string(kMaxMorphElements) + " displacements",
               ErrorCode::limit);
    }

    const uint32_t allowed = isUsed(document, "KHR_mesh_quantization") ? kFloat | kQuantizedSigned : kFloat;
    // Target by target as the file has them, then by vertex.
    std::vector<std::pair<uint32_t, MorphDelta>> read;
    for (size_t t = 0; t < targets.size(); ++t) {
        if (targets[t] < 0) {
            continue;
        }
        const std::string name = element + " " + at("target", t) + " POSITION";
        checkVertexCount(document, targets[t], count, name);
        const auto values = readFloats(document, targets[t], file::kVec3, allowed, name);
        for (uint32_t v = 0; v < count; ++v) {
            const glm::vec3 delta(values[3 * size_t{v}], values[3 * size_t{v} + 1], values[3 * size_t{v} + 2]);
            if (const char* fault = faultOfCoordinates(&values[3 * size_t{v}], 3)) {
                refuse(item(name, v), fault);
            }
            if (delta != glm::vec3(0.0f)) {
                read.push_back({v, {static_cast<uint32_t>(t), delta}});
            }
        }
    }
    morphs.append(count, read);
}

size_t targetCountOf(const Document& document, uint32_t meshNode) {
    const auto& primitives = document.model.meshes[static_cast<size_t>(document.model.nodes[meshNode].mesh)].primitives;
    for (const file::Primitive& primitive : primitives) {
        if (hasTriangles(primitive.mode)) {
            return primitive.targets.size();
        }
    }
    return 0;
}

/// A target's name is a courtesy to people: one that is no string is reported, not refused.
std::vector<std::string> readTargetNames(const Json& mesh, const std::string& element, MemoryBudget& memory,
                                         Warnings& warnings) {
    const Json* extras = member(mesh, "extras");
    const Json* names = extras != nullptr && extras->isObject() ? member(*extras, "targetNames") : nullptr;
    if (names == nullptr) {
        return {};
    }
    const std::string place = element + " extras targetNames";
    if (!names->isArray()) {
        warn(warnings, place, "not an array; ignored");
        return {};
    }
    uint64_t bytes = 0;
    for (const Json& name : *names) {
        bytes += sizeof(MorphTarget) + 2 * name.string().size();
    }
    memory.take(2 * bytes, place); // nodes may share a mesh
    std::vector<std::string> read(names->size());
    for (size_t i = 0; i < names->size(); ++i) {
        if ((*names)[i].isString()) {
            read[i] = (*names)[i].string();
        } else {
            warn(warnings, item(place, i), "not a string; ignored");
        }
    }
    return read;
}

Morphs readMorphs(const Document& document, uint32_t meshNode, size_t targetCount, Warnings& warnings) {
    const auto& node = document.model.nodes[meshNode];
    const auto meshIndex = static_cast<size_t>(node.mesh);
    Morphs morphs;
    document.memory->take(targetCount, 4 * sizeof(MorphTarget), at("mesh", meshIndex));
    morphs.targets.resize(targetCount);
    morphs.weights.assign(targetCount, 0.0f);

    const auto& meshWeights = document.model.meshes[meshIndex].weights;
    const bool ofNode = !node.weights.empty();
    for (const bool isNode : {false, true}) {
        const auto& weights = isNode ? node.weights : meshWeights;
        const std::string element = isNode ? at("node", meshNode) : at("mesh", meshIndex);
        if (weights.empty() || weights.size() == targetCount) {
            continue;
        }
        const std::string reason = counted(weights.size(), "weight", "weights") + " for " +
                                   counted(targetCount, "morph target", "morph targets");
        if (targetCount > 0) {
            refuse(element + " weights", reason);
        }
        warn(warnings, element + " weights", reason + "; ignored");
    }
    if (targetCount == 0) {
        return morphs;
    }
    const auto& weights = ofNode ? node.weights : meshWeights;
    for (size_t i = 0; i < weights.size(); ++i) {
        morphs.weights[i] = static_cast<float>(weights[i]);
    }
    const std::string element = at("mesh", meshIndex);
    const std::vector<std::string> names =
        readTargetNames(document.meshes[meshIndex], element, *document.memory, warnings);
    if (!names.empty() && names.size() != targetCount) {
        warn(warnings, element + " extras targetNames",
             counted(names.size(), "name", "names") + " for " + counted(targetCount, "morph target", "morph targets"));
    }
    for (size_t i = 0; i < std::min(names.size(), targetCount); ++i) {
        morphs.targets[i].name = names[i];
    }
    return morphs;
}

} // namespace supple::cage::gltf
