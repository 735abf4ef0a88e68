#include "cage/gltf/morphs.h"

#include "cage/gltf/accessors.h"
#include "cage/gltf/triangles.h"
#include "cage/limits.h"
#include "cage/refusal.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace supple::cage::gltf {
namespace {

// Accessors may be shared, and need no bytes where they are sparse, so a small file can ask for many.
constexpr uint64_t kMaxMorphElements = 1u << 26;

/// Puts the displacements of one target behind those of the targets before it.
void readTarget(const Document& document, int accessor, uint32_t target, size_t count, const std::string& name,
                Displacements& read) {
    checkVertexCount(document, accessor, count, name);
    const auto values = readFloats(document, accessor, file::kVec3, kFloat, name, kQuantizedSigned);
    const size_t before = read.size();
    for (uint32_t v = 0; v < count; ++v) {
        const glm::vec3 delta(values[3 * size_t{v}], values[3 * size_t{v} + 1], values[3 * size_t{v} + 2]);
        if (const char* fault = faultOfCoordinates(&values[3 * size_t{v}], 3)) {
            read.resize(before);
            refuse(item(name, v), fault);
        }
        if (delta != glm::vec3(0.0f)) {
            read.push_back({v, {target, delta}});
        }
    }
}

/// Null where a mesh or a primitive has none.
const Json* targetNamesOf(const Json& named) {
    const Json* extras = member(named, "extras");
    return extras == nullptr ? nullptr : member(*extras, "targetNames");
}

} // namespace

std::vector<int> MorphReader::targetsOf(const Document& document, const file::Primitive& primitive,
                                        const std::string& element) {
    const size_t own = primitive.targets.size();
    if (!firstCount_) {
        firstCount_ = own;
    }
    if (own != *firstCount_) {
        document.leniency->mend(element,
                                counted(own, "morph target", "morph targets") + ", but primitives before it have " +
                                    std::to_string(*firstCount_),
                                "it is moved by its own alone");
    }
    std::vector<int> accessors;
    for (const auto& target : primitive.targets) {
        const auto position = target.find("POSITION");
        accessors.push_back(position == target.end() ? -1 : position->second);
    }
    return accessors;
}

Displacements MorphReader::read(const Document& document, const std::vector<int>& targets, size_t count,
                                const std::string& element) {
    for (const int target : targets) {
        elementsRead_ += target < 0 ? 0 : count;
    }
    if (elementsRead_ > kMaxMorphElements) {
        refuse(element, "the morph targets hold more than " + std::to_string(kMaxMorphElements) + " displacements",
               ErrorCode::limit);
    }
    // Target by target as the file has them, then by vertex.
    Displacements read;
    for (uint32_t t = 0; t < targets.size(); ++t) {
        if (targets[t] >= 0) {
            document.leniency->leaveOut([&] {
                readTarget(document, targets[t], t, count, element + " " + at("target", t) + " POSITION", read);
            });
        }
    }
    return read;
}

size_t targetCountOf(const file::Mesh& mesh) {
    size_t count = 0;
    for (const file::Primitive& primitive : mesh.primitives) {
        if (isDrawn(primitive)) {
            count = std::max(count, primitive.targets.size());
        }
    }
    return count;
}

/// A target's name is a courtesy to people: one that is no string is reported, not refused.
TargetNames readTargetNames(const Json& mesh, const std::string& element, MemoryBudget& memory, Warnings& warnings) {
    const Json* names = targetNamesOf(mesh);
    const std::span<const Json> primitives = mesh.at("primitives").items();
    size_t searched = 0;
    while (names == nullptr && searched < primitives.size()) { // as files of VRM 0.x have them
        names = targetNamesOf(primitives[searched++]);
    }
    if (names == nullptr) {
        return {};
    }
    const std::string place =
        (searched == 0 ? element : element + " " + at("primitive", searched - 1)) + " extras targetNames";
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
    return {place, std::move(read)};
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
            document.leniency->mend(element + " weights", reason, "as far as they go");
        } else {
            warn(warnings, element + " weights", reason + "; ignored");
        }
    }
    if (targetCount == 0) {
        return morphs;
    }
    const auto& weights = ofNode ? node.weights : meshWeights;
    for (size_t i = 0; i < std::min(weights.size(), targetCount); ++i) {
        morphs.weights[i] = static_cast<float>(weights[i]);
    }
    const std::string element = at("mesh", meshIndex);
    const auto [place, names] = readTargetNames(document.meshes[meshIndex], element, *document.memory, warnings);
    if (!names.empty() && names.size() != targetCount) {
        warn(warnings, place,
             counted(names.size(), "name", "names") + " for " + counted(targetCount, "morph target", "morph targets"));
    }
    for (size_t i = 0; i < std::min(names.size(), targetCount); ++i) {
        morphs.targets[i].name = names[i];
    }
    return morphs;
}

} // namespace supple::cage::gltf
