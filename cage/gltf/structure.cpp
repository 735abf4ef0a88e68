#include "cage/gltf/structure.h"

#include "cage/gltf/draco.h"
#include "cage/gltf/look_extensions.h"
#include "cage/gltf/model.h"
#include "cage/gltf/node_extensions.h"
#include "cage/gltf/vrm.h"
#include "cage/message.h"
#include "cage/refusal.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace supple::cage::gltf {
namespace {

void checkAsset(const Json& root) {
    const Json* asset = objectMember(root, "asset", "JSON");
    if (asset == nullptr) {
        refuse("asset", "missing: not a glTF 2.0 file");
    }
    const std::string version = stringMember(*asset, "version", "asset");
    if (version != "2" && !version.starts_with("2.")) {
        refuse("asset version", quoted(version) + ", only 2.x is supported");
    }
    const std::string minVersion = stringMember(*asset, "minVersion", "asset");
    if (!minVersion.empty() && minVersion != "2.0") {
        refuse("asset minVersion", quoted(minVersion) + ", only 2.0 is supported");
    }
}

/// Extensions a file may require, besides kLookExtensions and kVrmExtensions. (Of the two that allow restart values,
/// lines and strips alone make use.)
constexpr std::array<std::string_view, 14> kUnderstood{
    "SUPPLE_mesh_cage",
    "SUPPLE_deformers",
    "EXT_mesh_polygon",
    "FB_ngon_encoding",
    "EXT_mesh_primitive_edge_visibility",
    "EXT_mesh_manifold",
    "KHR_mesh_quantization",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
    "KHR_mesh_primitive_restart",
    "EXT_mesh_primitive_restart",
    kNodeVisibility,
    "KHR_animation_pointer",
    kDraco,
};

void checkExtensions(const Json& root) {
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        const Json* names = arrayMember(root, key, "");
        if (names == nullptr) {
            continue;
        }
        for (const Json& name : *names) {
            if (!name.isString()) {
                refuse(key, "not all strings");
            }
        }
    }
    const Json* required = member(root, "extensionsRequired");
    if (required == nullptr) {
        return;
    }
    for (const Json& entry : *required) {
        const std::string name = entry.string();
        if (std::find(kUnderstood.begin(), kUnderstood.end(), name) != kUnderstood.end() ||
            std::find(kLookExtensions.begin(), kLookExtensions.end(), name) != kLookExtensions.end() ||
            std::find(kVrmExtensions.begin(), kVrmExtensions.end(), name) != kVrmExtensions.end()) {
            continue;
        }
        refuse("extensionsRequired", name + " is not supported");
    }
}

/// Child lists make the node tree; it must be a forest before anybody walks it. Recursion-free.
void checkNodeTree(const Json& nodes, const Broken& broken, Leniency& leniency) {
    const size_t count = nodes.size();
    std::vector<size_t> parents(count, count);
    for (size_t parent = 0; parent < count; ++parent) {
        const Json* children = member(nodes[parent], "children");
        if (children == nullptr) {
            continue;
        }
        const auto add = [&](size_t child) {
            if (child == parent) {
                refuse(at("node", child), "is its own child");
            }
            if (parents[child] == parent) {
                leniency.mend(at("node", child), "listed twice by its parent, node " + std::to_string(parent),
                              "once is enough");
                return;
            }
            if (parents[child] != count) {
                refuse(at("node", child),
                       "has two parents, nodes " + std::to_string(parents[child]) + " and " + std::to_string(parent));
            }
            parents[child] = parent;
        };
        for (const Json& entry : *children) {
            if (!broken.contains(*children) && !broken.contains(entry)) {
                leniency.gather([&] { add(entry.index()); });
            }
        }
    }
    // With one parent at most, following parents either ends at a root or runs round a cycle.
    enum : uint8_t { unseen, onPath, done };
    std::vector<uint8_t> state(count, unseen);
    std::vector<size_t> path;
    for (size_t start = 0; start < count; ++start) {
        path.clear();
        size_t node = start;
        while (node != count && state[node] == unseen) {
            state[node] = onPath;
            path.push_back(node);
            node = parents[node];
        }
        if (node != count && state[node] == onPath) {
            leniency.gather([&] { refuse(at("node", node), "is its own ancestor"); });
        }
        for (const size_t passed : path) {
            state[passed] = done;
        }
    }
}

class StructureCheck {
public:
    StructureCheck(const Json& root, Leniency& leniency)
        : leniency_(leniency), accessors_(table(root, "accessors")), materials_(table(root, "materials")),
          meshes_(table(root, "meshes")), nodes_(table(root, "nodes")), skins_(table(root, "skins")),
          views_(table(root, "bufferViews")), scenes_(table(root, "scenes")),
          bufferCount_(table(root, "buffers").size()) {}

    Broken check(const Json& root, std::span<const std::span<const std::byte>> buffers,
                 const std::vector<int>& decodedInto) && {
        for (size_t i = 0; i < views_.size(); ++i) {
            if (decodedInto[i] == kNotDecoded) {
                broken_.add(views_[i]);
                continue;
            }
            orBroken(views_[i], [&] { checkBufferView(views_[i], at("bufferView", i), buffers, decodedInto[i]); });
        }
        for (size_t i = 0; i < accessors_.size(); ++i) {
            orBroken(accessors_[i], [&] { checkAccessor(accessors_[i], at("accessor", i)); });
        }
        for (size_t i = 0; i < nodes_.size(); ++i) {
            leniency_.gather([&] { checkNode(nodes_[i], at("node", i)); });
        }
        for (size_t i = 0; i < scenes_.size(); ++i) {
            checkIndices(scenes_[i], "nodes", at("scene", i), "node", nodes_.size());
        }
        checkMember(root, "scene", [&] { checkIndexMember(root, "scene", "JSON", "scene", scenes_.size()); });
        for (size_t i = 0; i < skins_.size(); ++i) {
            orBroken(skins_[i], [&] { checkSkin(skins_[i], at("skin", i)); });
        }
        for (size_t i = 0; i < meshes_.size(); ++i) {
            orBroken(meshes_[i], [&] { checkMesh(meshes_[i], at("mesh", i)); });
        }
        const Json animations = table(root, "animations");
        for (size_t i = 0; i < animations.size(); ++i) {
            orBroken(animations[i], [&] { checkAnimation(animations[i], at("animation", i)); });
        }
        leniency_.raise();
        checkNodeTree(nodes_, broken_, leniency_);
        leniency_.raise();
        return std::move(broken_);
    }

private:
    /// Calls check(); if it refuses, the value counts as not there.
    template <class Check>
    void orBroken(const Json& value, Check&& check) {
        if (!leniency_.leaveOut(check)) {
            broken_.add(value);
        }
    }
    /// The same for a member, if it is there.
    template <class Check>
    void checkMember(const Json& object, const char* key, Check&& check) {
        if (const Json* value = member(object, key)) {
            orBroken(*value, check);
        } else {
            check();
        }
    }
    /// Each of an array's indices counts for itself.
    void checkIndices(const Json& object, const char* key, const std::string& element, const char* what, size_t count) {
        checkMember(object, key, [&] { (void)arrayMember(object, key, element); });
        const Json* values = member(object, key);
        for (size_t i = 0; values != nullptr && i < values->size(); ++i) {
            const Json& value = (*values)[i];
            orBroken(value, [&] { checkIndex(value, item(element + " " + key, i), what, count); });
        }
    }
    void checkName(const Json& object, const std::string& element) {
        checkMember(object, "name", [&] { checkString(object, "name", element); });
    }

    void checkBufferView(const Json& view, const std::string& element,
                         std::span<const std::span<const std::byte>> buffers, int decodedInto);
    void checkAccessor(const Json& accessor, const std::string& element);
    void checkSparse(const Json& accessor, const std::string& element);
    void checkTargets(const Json& primitive, const std::string& element);
    void checkPrimitive(const Json& primitive, const std::string& element);
    void checkMesh(const Json& mesh, const std::string& element);
    void checkNode(const Json& node, const std::string& element);
    void checkSkin(const Json& skin, const std::string& element);
    void checkSampler(const Json& sampler, const std::string& element);
    void checkChannel(const Json& channel, const std::string& element, size_t samplerCount);
    void checkAnimation(const Json& animation, const std::string& element);

    Leniency& leniency_;
    const Json accessors_, materials_, meshes_, nodes_, skins_, views_, scenes_;
    const size_t bufferCount_; ///< of the file's own: no view names one that another view was decoded into
    Broken broken_;
};

/// `decodedInto`: the buffer that takes the place of what the view names, or -1.
void StructureCheck::checkBufferView(const Json& view, const std::string& element,
                                     std::span<const std::span<const std::byte>> buffers, int decodedInto) {
    checkIndexMember(view, "buffer", element, "buffer", bufferCount_, true);
    const bool decoded = decodedInto >= 0;
    const size_t available = buffers[decoded ? static_cast<size_t>(decodedInto) : view.at("buffer").index()].size();
    const uint64_t offset = decoded ? 0 : unsignedMember(view, "byteOffset", element, 0);
    const uint64_t length = unsignedMember(view, "byteLength", element, std::nullopt);
    if (length == 0) {
        refuse(element + " byteLength", "zero");
    }
    if (offset > available || length > available - offset) {
        const std::string reason = "bytes " + std::to_string(offset) + " + " + std::to_string(length) +
                                   " are out of range: the buffer has " + std::to_string(available);
        if (offset >= available) {
            refuse(element, reason);
        }
        leniency_.mend(element, reason, "it ends there"); // an accessor beyond them has a fault of its own
    }
    const Json* stride = member(view, "byteStride");
    if (stride != nullptr) {
        const uint64_t value = toUnsigned(*stride, element + " byteStride");
        if (value < 4 || value > 252 || value % 4 != 0) {
            refuse(element + " byteStride", std::to_string(value) + " is not a multiple of 4 in 4..252");
        }
    }
    checkName(view, element);
}

void checkComponentType(const Json& object, const std::string& element, bool indicesOnly) {
    const uint64_t type = unsignedMember(object, "componentType", element, std::nullopt);
    const bool isIndex = type == 5121 || type == 5123 || type == 5125;
    if (!isIndex && (indicesOnly || (type != 5120 && type != 5122 && type != 5126))) {
        refuse(element + " componentType", std::to_string(type) + " is not allowed");
    }
}

void StructureCheck::checkSparse(const Json& accessor, const std::string& element) {
    const Json* sparse = objectMember(accessor, "sparse", element);
    if (sparse == nullptr) {
        return;
    }
    const std::string place = element + " sparse";
    const uint64_t count = unsignedMember(*sparse, "count", place, std::nullopt);
    const std::string most = std::to_string(accessor.at("count").unsignedInteger());
    if (count == 0) {
        leniency_.mend(place + " count", "0 is not in 1.." + most, "nothing is replaced");
        broken_.add(*sparse);
        return;
    }
    if (count > accessor.at("count").unsignedInteger()) {
        refuse(place + " count", std::to_string(count) + " is not in 1.." + most);
    }
    for (const char* part : {"indices", "values"}) {
        const Json* object = objectMember(*sparse, part, place);
        const std::string partPlace = place + " " + part;
        if (object == nullptr) {
            refuse(partPlace, "missing");
        }
        checkIndexMember(*object, "bufferView", partPlace, "bufferView", views_.size(), true);
        unsignedMember(*object, "byteOffset", partPlace, 0);
    }
    checkComponentType(sparse->at("indices"), place + " indices", true);
}

void StructureCheck::checkAccessor(const Json& accessor, const std::string& element) {
    checkIndexMember(accessor, "bufferView", element, "bufferView", views_.size());
    unsignedMember(accessor, "byteOffset", element, 0);
    checkComponentType(accessor, element, false);
    if (unsignedMember(accessor, "count", element, std::nullopt) == 0) {
        refuse(element + " count", "zero");
    }
    const std::string type = stringMember(accessor, "type", element);
    if (std::find(std::begin(file::kTypeNames), std::end(file::kTypeNames), type) == std::end(file::kTypeNames)) {
        refuse(element + " type", quoted(type) + " is not allowed");
    }
    const Json* normalized = member(accessor, "normalized");
    if (normalized != nullptr && !normalized->isBoolean()) {
        refuse(element + " normalized", "not a boolean");
    }
    checkSparse(accessor, element);
}

void StructureCheck::checkTargets(const Json& primitive, const std::string& element) {
    const Json* targets = arrayMember(primitive, "targets", element);
    for (size_t i = 0; targets != nullptr && i < targets->size(); ++i) {
        const std::string place = element + " " + at("target", i);
        if (!(*targets)[i].isObject()) {
            refuse(place, "not an object");
        }
        for (const auto& [name, value] : (*targets)[i].members()) {
            const std::string whole = within(place, std::string(name));
            const Json& accessor = value;
            orBroken(value, [&] { checkIndex(accessor, whole, "accessor", accessors_.size()); });
        }
    }
}

void StructureCheck::checkPrimitive(const Json& primitive, const std::string& element) {
    if (!primitive.isObject()) {
        refuse(element, "not an object");
    }
    const Json* attributes = objectMember(primitive, "attributes", element);
    if (attributes == nullptr) {
        refuse(element, "no attributes");
    }
    for (const JsonMember& attribute : attributes->members()) {
        const std::string place = within(element, std::string(attribute.name));
        const auto check = [&] { checkIndex(attribute.value, place, "accessor", accessors_.size()); };
        attribute.name == "POSITION" ? check() : orBroken(attribute.value, check);
    }
    checkIndexMember(primitive, "indices", element, "accessor", accessors_.size());
    const Json* indices = member(primitive, "indices");
    if (indices != nullptr && !broken_.contains(accessors_[indices->index()]) &&
        member(accessors_[indices->index()], "bufferView") == nullptr && !hasExtension(primitive, kDraco)) {
        refuse(element + " indices", at("accessor", indices->index()) + " has no bufferView");
    }
    checkMember(primitive, "material",
                [&] { checkIndexMember(primitive, "material", element, "material", materials_.size()); });
    if (unsignedMember(primitive, "mode", element, 4) > 6) {
        refuse(element + " mode", "not in 0..6");
    }
    objectMember(primitive, "extensions", element);
    checkTargets(primitive, element);
}

void StructureCheck::checkMesh(const Json& mesh, const std::string& element) {
    checkName(mesh, element);
    checkMember(mesh, "weights", [&] { checkNumbers(mesh, "weights", element, std::nullopt); });
    const Json* primitives = arrayMember(mesh, "primitives", element);
    if (primitives == nullptr || primitives->empty()) {
        refuse(element, "no primitives");
    }
    for (size_t k = 0; k < primitives->size(); ++k) {
        orBroken((*primitives)[k], [&] { checkPrimitive((*primitives)[k], element + " " + at("primitive", k)); });
    }
}

/// Without its mesh a node is a node still, but where it stands must be known: others stand on it.
void StructureCheck::checkNode(const Json& node, const std::string& element) {
    checkName(node, element);
    checkMember(node, "mesh", [&] { checkIndexMember(node, "mesh", element, "mesh", meshes_.size()); });
    checkMember(node, "skin", [&] { checkIndexMember(node, "skin", element, "skin", skins_.size()); });
    checkIndices(node, "children", element, "node", nodes_.size());
    checkNumbers(node, "matrix", element, 16);
    checkNumbers(node, "translation", element, 3);
    checkNumbers(node, "rotation", element, 4);
    checkNumbers(node, "scale", element, 3);
    checkMember(node, "weights", [&] { checkNumbers(node, "weights", element, std::nullopt); });
    leniency_.leaveOut([&] { checkVisibility(node, element); });
}

void StructureCheck::checkSkin(const Json& skin, const std::string& element) {
    const Json* joints = arrayMember(skin, "joints", element);
    if (joints == nullptr || joints->empty()) {
        refuse(element, "no joints");
    }
    checkIndexArray(skin, "joints", element, "node", nodes_.size());
    checkMember(skin, "skeleton", [&] { checkIndexMember(skin, "skeleton", element, "node", nodes_.size()); });
    checkIndexMember(skin, "inverseBindMatrices", element, "accessor", accessors_.size());
}

void StructureCheck::checkSampler(const Json& sampler, const std::string& element) {
    if (!sampler.isObject()) {
        refuse(element, "not an object");
    }
    checkIndexMember(sampler, "input", element, "accessor", accessors_.size(), true);
    checkIndexMember(sampler, "output", element, "accessor", accessors_.size(), true);
    const std::string interpolation = stringMember(sampler, "interpolation", element);
    if (!interpolation.empty() && interpolation != "STEP" && interpolation != "LINEAR" &&
        interpolation != "CUBICSPLINE") {
        refuse(element + " interpolation", quoted(interpolation) + " is not allowed");
    }
}

/// A channel may lack a target node: an extension may define what moves.
void StructureCheck::checkChannel(const Json& channel, const std::string& element, size_t samplerCount) {
    if (!channel.isObject()) {
        refuse(element, "not an object");
    }
    checkIndexMember(channel, "sampler", element, "sampler", samplerCount, true);
    const Json* target = objectMember(channel, "target", element);
    if (target == nullptr || member(*target, "node") == nullptr) {
        return;
    }
    checkIndexMember(*target, "node", element + " target", "node", nodes_.size(), true);
    if (stringMember(*target, "path", element).empty()) {
        refuse(element, "path is missing");
    }
}

void StructureCheck::checkAnimation(const Json& animation, const std::string& element) {
    checkName(animation, element);
    const Json* samplers = arrayMember(animation, "samplers", element);
    const size_t samplerCount = samplers == nullptr ? 0 : samplers->size();
    for (size_t k = 0; k < samplerCount; ++k) {
        orBroken((*samplers)[k], [&] { checkSampler((*samplers)[k], element + " " + at("sampler", k)); });
    }
    const Json* channels = arrayMember(animation, "channels", element);
    for (size_t k = 0; channels != nullptr && k < channels->size(); ++k) {
        orBroken((*channels)[k], [&] { checkChannel((*channels)[k], element + " " + at("channel", k), samplerCount); });
    }
}

} // namespace

void checkHeader(const Json& root) {
    checkAsset(root);
    checkExtensions(root);
}

Broken checkStructure(const Json& root, std::span<const std::span<const std::byte>> buffers,
                      const std::vector<int>& decodedInto, Leniency& leniency) {
    return StructureCheck(root, leniency).check(root, buffers, decodedInto);
}

} // namespace supple::cage::gltf
