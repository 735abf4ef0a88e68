#include "cage/gltf/structure.h"

#include "cage/gltf/look_extensions.h"
#include "cage/gltf/model.h"
#include "cage/message.h"
#include "cage/refusal.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
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

/// Extensions a file may require, besides kLookExtensions. (Of the two that allow restart values, lines and strips
/// alone make use.)
constexpr std::array<std::string_view, 10> kUnderstood{
    "SUPPLE_mesh_cage",           "EXT_mesh_polygon",
    "FB_ngon_encoding",           "EXT_mesh_primitive_edge_visibility",
    "EXT_mesh_manifold",          "KHR_mesh_quantization",
    "EXT_meshopt_compression",    "KHR_meshopt_compression",
    "KHR_mesh_primitive_restart", "EXT_mesh_primitive_restart",
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
            std::find(kLookExtensions.begin(), kLookExtensions.end(), name) != kLookExtensions.end()) {
            continue;
        }
        if (name == "KHR_draco_mesh_compression") {
            refuse("extensionsRequired", name + " is not supported: it may reorder or drop polygons; export the mesh "
                                                "uncompressed");
        }
        refuse("extensionsRequired", name + " is not supported");
    }
}

/// Child lists make the node tree; it must be a forest before anybody walks it. Recursion-free.
void checkNodeTree(const Json& nodes) {
    const size_t count = nodes.size();
    std::vector<size_t> parents(count, count);
    for (size_t parent = 0; parent < count; ++parent) {
        const Json* children = member(nodes[parent], "children");
        if (children == nullptr) {
            continue;
        }
        for (const Json& entry : *children) {
            const auto child = entry.index();
            if (child == parent) {
                refuse(at("node", child), "is its own child");
            }
            if (parents[child] == parent) {
                refuse(at("node", child), "listed twice by its parent, node " + std::to_string(parent));
            }
            if (parents[child] != count) {
                refuse(at("node", child),
                       "has two parents, nodes " + std::to_string(parents[child]) + " and " + std::to_string(parent));
            }
            parents[child] = parent;
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
            refuse(at("node", node), "is its own ancestor");
        }
        for (const size_t passed : path) {
            state[passed] = done;
        }
    }
}

/// `decodedInto`: the buffer that takes the place of what the view names, or -1.
void checkBufferView(const Json& view, const std::string& element, std::span<const std::span<const std::byte>> buffers,
                     int decodedInto) {
    checkIndexMember(view, "buffer", element, "buffer", buffers.size(), true);
    const bool decoded = decodedInto >= 0;
    const size_t available = buffers[decoded ? static_cast<size_t>(decodedInto) : view.at("buffer").index()].size();
    const uint64_t offset = decoded ? 0 : unsignedMember(view, "byteOffset", element, 0);
    const uint64_t length = unsignedMember(view, "byteLength", element, std::nullopt);
    if (length == 0) {
        refuse(element + " byteLength", "zero");
    }
    if (offset > available || length > available - offset) {
        refuse(element, "bytes " + std::to_string(offset) + " + " + std::to_string(length) +
                            " are out of range: the buffer has " + std::to_string(available));
    }
    const Json* stride = member(view, "byteStride");
    if (stride != nullptr) {
        const uint64_t value = toUnsigned(*stride, element + " byteStride");
        if (value < 4 || value > 252 || value % 4 != 0) {
            refuse(element + " byteStride", std::to_string(value) + " is not a multiple of 4 in 4..252");
        }
    }
    checkString(view, "name", element);
}

void checkComponentType(const Json& object, const std::string& element, bool indicesOnly) {
    const uint64_t type = unsignedMember(object, "componentType", element, std::nullopt);
    const bool isIndex = type == 5121 || type == 5123 || type == 5125;
    if (!isIndex && (indicesOnly || (type != 5120 && type != 5122 && type != 5126))) {
        refuse(element + " componentType", std::to_string(type) + " is not allowed");
    }
}

void checkSparse(const Json& accessor, const std::string& element, size_t viewCount) {
    const Json* sparse = objectMember(accessor, "sparse", element);
    if (sparse == nullptr) {
        return;
    }
    const std::string place = element + " sparse";
    const uint64_t count = unsignedMember(*sparse, "count", place, std::nullopt);
    if (count == 0 || count > accessor.at("count").unsignedInteger()) {
        refuse(place + " count",
               std::to_string(count) + " is not in 1.." + std::to_string(accessor.at("count").unsignedInteger()));
    }
    for (const char* part : {"indices", "values"}) {
        const Json* object = objectMember(*sparse, part, place);
        const std::string partPlace = place + " " + part;
        if (object == nullptr) {
            refuse(partPlace, "missing");
        }
        checkIndexMember(*object, "bufferView", partPlace, "bufferView", viewCount, true);
        unsignedMember(*object, "byteOffset", partPlace, 0);
    }
    checkComponentType(sparse->at("indices"), place + " indices", true);
}

void checkAccessor(const Json& accessor, const std::string& element, size_t viewCount) {
    checkIndexMember(accessor, "bufferView", element, "bufferView", viewCount);
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
    checkSparse(accessor, element, viewCount);
}

void checkTargets(const Json& primitive, const std::string& element, size_t accessorCount) {
    const Json* targets = arrayMember(primitive, "targets", element);
    for (size_t i = 0; targets != nullptr && i < targets->size(); ++i) {
        const std::string place = element + " " + at("target", i);
        if (!(*targets)[i].isObject()) {
            refuse(place, "not an object");
        }
        for (const auto& [name, value] : (*targets)[i].members()) {
            checkIndex(value, within(place, std::string(name)), "accessor", accessorCount);
        }
    }
}

/// What others name by number. (table() looks at all elements, so it is not called for each of them.)
struct Named {
    Json accessors, materials, meshes, nodes, skins;
};

void checkPrimitive(const Named& named, const Json& primitive, const std::string& element) {
    if (!primitive.isObject()) {
        refuse(element, "not an object");
    }
    const Json& accessors = named.accessors;
    const Json* attributes = objectMember(primitive, "attributes", element);
    if (attributes == nullptr) {
        refuse(element, "no attributes");
    }
    for (const auto& [name, value] : attributes->members()) {
        checkIndex(value, within(element, std::string(name)), "accessor", accessors.size());
    }
    checkIndexMember(primitive, "indices", element, "accessor", accessors.size());
    const Json* indices = member(primitive, "indices");
    if (indices != nullptr && member(accessors[indices->index()], "bufferView") == nullptr) {
        refuse(element + " indices", hasExtension(primitive, "KHR_draco_mesh_compression")
                                         ? "compressed with KHR_draco_mesh_compression; export the mesh uncompressed"
                                         : at("accessor", indices->index()) + " has no bufferView");
    }
    checkIndexMember(primitive, "material", element, "material", named.materials.size());
    if (unsignedMember(primitive, "mode", element, 4) > 6) {
        refuse(element + " mode", "not in 0..6");
    }
    objectMember(primitive, "extensions", element);
    checkTargets(primitive, element, accessors.size());
}

void checkMesh(const Named& named, const Json& mesh, const std::string& element, Refusals& refusals) {
    checkString(mesh, "name", element);
    checkNumbers(mesh, "weights", element, std::nullopt);
    const Json* primitives = arrayMember(mesh, "primitives", element);
    if (primitives == nullptr || primitives->empty()) {
        refuse(element, "no primitives");
    }
    for (size_t k = 0; k < primitives->size(); ++k) {
        refusals.gather([&] { checkPrimitive(named, (*primitives)[k], element + " " + at("primitive", k)); });
    }
}

void checkNode(const Named& named, const Json& node, const std::string& element) {
    checkString(node, "name", element);
    checkIndexMember(node, "mesh", element, "mesh", named.meshes.size());
    checkIndexMember(node, "skin", element, "skin", named.skins.size());
    checkIndexArray(node, "children", element, "node", named.nodes.size());
    checkNumbers(node, "matrix", element, 16);
    checkNumbers(node, "translation", element, 3);
    checkNumbers(node, "rotation", element, 4);
    checkNumbers(node, "scale", element, 3);
    checkNumbers(node, "weights", element, std::nullopt);
}

void checkSkin(const Named& named, const Json& skin, const std::string& element) {
    const size_t nodeCount = named.nodes.size();
    const Json* joints = arrayMember(skin, "joints", element);
    if (joints == nullptr || joints->empty()) {
        refuse(element, "no joints");
    }
    checkIndexArray(skin, "joints", element, "node", nodeCount);
    checkIndexMember(skin, "skeleton", element, "node", nodeCount);
    checkIndexMember(skin, "inverseBindMatrices", element, "accessor", named.accessors.size());
}

void checkSampler(const Json& sampler, const std::string& element, size_t accessorCount) {
    if (!sampler.isObject()) {
        refuse(element, "not an object");
    }
    checkIndexMember(sampler, "input", element, "accessor", accessorCount, true);
    checkIndexMember(sampler, "output", element, "accessor", accessorCount, true);
    const std::string interpolation = stringMember(sampler, "interpolation", element);
    if (!interpolation.empty() && interpolation != "STEP" && interpolation != "LINEAR" &&
        interpolation != "CUBICSPLINE") {
        refuse(element + " interpolation", quoted(interpolation) + " is not allowed");
    }
}

/// A channel may lack a target node: an extension may define what moves.
void checkChannel(const Json& channel, const std::string& element, size_t samplerCount, size_t nodeCount) {
    if (!channel.isObject()) {
        refuse(element, "not an object");
    }
    checkIndexMember(channel, "sampler", element, "sampler", samplerCount, true);
    const Json* target = objectMember(channel, "target", element);
    if (target == nullptr || member(*target, "node") == nullptr) {
        return;
    }
    checkIndexMember(*target, "node", element + " target", "node", nodeCount, true);
    if (stringMember(*target, "path", element).empty()) {
        refuse(element, "path is missing");
    }
}

void checkAnimation(const Named& named, const Json& animation, const std::string& element, Refusals& refusals) {
    checkString(animation, "name", element);
    const Json* samplers = arrayMember(animation, "samplers", element);
    const size_t samplerCount = samplers == nullptr ? 0 : samplers->size();
    for (size_t k = 0; k < samplerCount; ++k) {
        refusals.gather(
            [&] { checkSampler((*samplers)[k], element + " " + at("sampler", k), named.accessors.size()); });
    }
    const Json* channels = arrayMember(animation, "channels", element);
    for (size_t k = 0; channels != nullptr && k < channels->size(); ++k) {
        refusals.gather(
            [&] { checkChannel((*channels)[k], element + " " + at("channel", k), samplerCount, named.nodes.size()); });
    }
}

/// Calls check(element, name) for each of a table.
template <class Check>
void checkEach(const Json& elements, const char* what, Refusals& refusals, Check&& check) {
    for (size_t i = 0; i < elements.size(); ++i) {
        refusals.gather([&] { check(elements[i], at(what, i)); });
    }
}

} // namespace

void checkHeader(const Json& root) {
    checkAsset(root);
    checkExtensions(root);
}

void checkStructure(const Json& root, std::span<const std::span<const std::byte>> buffers,
                    const std::vector<int>& decodedInto) {
    const Named named{table(root, "accessors"), table(root, "materials"), table(root, "meshes"), table(root, "nodes"),
                      table(root, "skins")};
    const Json views = table(root, "bufferViews");
    const Json scenes = table(root, "scenes");
    using Name = const std::string&;
    Refusals refusals;
    for (size_t i = 0; i < views.size(); ++i) {
        refusals.gather([&] { checkBufferView(views[i], at("bufferView", i), buffers, decodedInto[i]); });
    }
    checkEach(named.accessors, "accessor", refusals,
              [&](const Json& accessor, Name name) { checkAccessor(accessor, name, views.size()); });
    checkEach(named.nodes, "node", refusals, [&](const Json& node, Name name) { checkNode(named, node, name); });
    checkEach(scenes, "scene", refusals,
              [&](const Json& scene, Name name) { checkIndexArray(scene, "nodes", name, "node", named.nodes.size()); });
    refusals.gather([&] { checkIndexMember(root, "scene", "JSON", "scene", scenes.size()); });
    checkEach(named.skins, "skin", refusals, [&](const Json& skin, Name name) { checkSkin(named, skin, name); });
    checkEach(named.meshes, "mesh", refusals,
              [&](const Json& mesh, Name name) { checkMesh(named, mesh, name, refusals); });
    checkEach(table(root, "animations"), "animation", refusals,
              [&](const Json& animation, Name name) { checkAnimation(named, animation, name, refusals); });
    refusals.raise();
    checkNodeTree(named.nodes);
}

} // namespace supple::cage::gltf
