#include "cage/gltf_document.h"

#include "cage/gltf_refusal.h"
#include "cage/gltf_uri.h"

#include <array>
#include <cmath>
#include <cstring>
#include <fstream> // tinygltf.h leaves it out with TINYGLTF_NO_FS, but uses it
#include <limits>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>
#define TINYGLTF_IMPLEMENTATION
// A second look at the header: tinygltf.h only declared. The checks below exist because tinygltf drops what it cannot
// parse, narrows integers silently and indexes buffers unchecked; it is handed only JSON that passed them.
#include <tiny_gltf.h>

namespace supple::cage {
namespace {

using nlohmann::json;

constexpr uint32_t kGlbMagic = 0x46546C67u;
constexpr uint32_t kGlbJson = 0x4E4F534Au;
constexpr uint32_t kGlbBinary = 0x004E4942u;

uint32_t readU32(std::span<const std::byte> bytes, size_t offset) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i)
        value |= static_cast<uint32_t>(bytes[offset + i]) << (8 * i);
    return value;
}

std::string at(const char* what, size_t index) {
    return std::string(what) + " " + std::to_string(index);
}

std::string within(const std::string& element, const std::string& part) {
    return element + " " + part;
}

std::string listed(const std::string& text) {
    return "\"" + text + "\"";
}

struct Container {
    std::string_view text;
    std::span<const std::byte> binary;
    bool isBinary = false;
};

Container openContainer(std::span<const std::byte> bytes) {
    const auto textOf = [&](size_t offset, size_t length) {
        return std::string_view(reinterpret_cast<const char*>(bytes.data()) + offset, length);
    };
    Container container;
    if (bytes.empty())
        refuse("file", "empty");
    if (bytes.size() < 4 || readU32(bytes, 0) != kGlbMagic) {
        container.text = textOf(0, bytes.size());
        size_t first = container.text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
        first = container.text.find_first_not_of(" \t\r\n", first);
        if (first == std::string_view::npos || container.text[first] != '{')
            refuse("file", "neither GLB nor glTF JSON: no 'glTF' magic and no '{' at its start");
        return container;
    }

    container.isBinary = true;
    if (bytes.size() < 12)
        refuse("GLB header", "truncated: " + std::to_string(bytes.size()) + " of 12 bytes");
    const uint32_t version = readU32(bytes, 4);
    if (version != 2)
        refuse("GLB header", "version " + std::to_string(version) + ", only 2 is supported");
    const uint32_t length = readU32(bytes, 8);
    if (length > bytes.size())
        refuse("GLB header", "truncated: " + std::to_string(length) + " bytes announced, " +
                                 std::to_string(bytes.size()) + " present");
    bool seenJson = false;
    bool seenBinary = false;
    size_t offset = 12;
    for (size_t chunk = 0; offset < length; ++chunk) {
        if (length - offset < 8)
            refuse(at("GLB chunk", chunk), "truncated header");
        const uint32_t chunkLength = readU32(bytes, offset);
        const uint32_t chunkType = readU32(bytes, offset + 4);
        offset += 8;
        if (chunkLength > length - offset)
            refuse(at("GLB chunk", chunk), "truncated: " + std::to_string(chunkLength) + " bytes announced, " +
                                               std::to_string(length - offset) + " present");
        if (chunk == 0 && chunkType != kGlbJson)
            refuse("GLB chunk 0", "not the JSON chunk");
        if (chunkType == kGlbJson && !seenJson) {
            seenJson = true;
            container.text = textOf(offset, chunkLength);
            // The padding is spaces, but some writers put zeros.
            container.text = container.text.substr(0, container.text.find_last_not_of('\0') + 1);
        } else if (chunkType == kGlbBinary && !seenBinary) {
            seenBinary = true;
            container.binary = bytes.subspan(offset, chunkLength);
        }
        // Chunks start on multiples of four; the last one may lack its padding.
        offset = std::min<size_t>(offset + (static_cast<size_t>(chunkLength) + 3) / 4 * 4, length);
    }
    if (!seenJson)
        refuse("GLB", "no JSON chunk");
    return container;
}

void checkNesting(std::string_view text) {
    int depth = 0;
    bool quoted = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                quoted = false;
        } else if (c == '"') {
            quoted = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kMaxJsonDepth)
                refuse("JSON", "nested deeper than " + std::to_string(kMaxJsonDepth) + " at byte " + std::to_string(i),
                       ErrorCode::limit);
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

json parseJson(std::string_view text) {
    try {
        return json::parse(text.begin(), text.end());
    } catch (const json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: ..." -> from "parse error" on
        const std::string what = error.what();
        const size_t end = what.find("] ");
        std::string reason = end == std::string::npos ? what : what.substr(end + 2);
        if (reason.size() > 200)
            reason = reason.substr(0, 200) + "...";
        refuse("JSON", reason);
    }
}

// ---- typed access ---------------------------------------------------------------------------------------------------

const json* member(const json& object, const char* key) {
    const auto it = object.find(key);
    return it == object.end() || it->is_null() ? nullptr : &*it;
}

const json* objectMember(const json& object, const char* key, const std::string& element) {
    const json* value = member(object, key);
    if (value != nullptr && !value->is_object())
        refuse(element + " " + key, "not an object");
    return value;
}

const json* arrayMember(const json& object, const char* key, const std::string& element) {
    const json* value = member(object, key);
    if (value != nullptr && !value->is_array())
        refuse(element.empty() ? key : element + " " + key, "not an array");
    return value;
}

/// A top-level array of objects, or an empty array where the file has none.
const json& table(const json& root, const char* key) {
    static const json none = json::array();
    const json* value = arrayMember(root, key, "");
    if (value == nullptr)
        return none;
    for (size_t i = 0; i < value->size(); ++i)
        if (!(*value)[i].is_object())
            refuse(at(key, i), "not an object");
    return *value;
}

uint64_t toUnsigned(const json& value, const std::string& element) {
    if (!value.is_number_integer())
        refuse(element, "not an integer");
    if (!value.is_number_unsigned())
        refuse(element, std::to_string(value.get<int64_t>()) + " is negative");
    return value.get<uint64_t>();
}

uint64_t unsignedMember(const json& object, const char* key, const std::string& element,
                        std::optional<uint64_t> fallback) {
    const json* value = member(object, key);
    if (value == nullptr) {
        if (!fallback)
            refuse(element, std::string(key) + " is missing");
        return *fallback;
    }
    return toUnsigned(*value, element + " " + key);
}

void checkIndex(const json& value, const std::string& element, const char* what, size_t count) {
    const uint64_t index = toUnsigned(value, element);
    if (index >= count)
        refuse(element, at(what, index) + " is out of range: the file has " + std::to_string(count));
}

void checkIndexMember(const json& object, const char* key, const std::string& element, const char* what, size_t count,
                      bool required = false) {
    const json* value = member(object, key);
    if (value != nullptr)
        checkIndex(*value, element + " " + key, what, count);
    else if (required)
        refuse(element, std::string(key) + " is missing");
}

void checkIndexArray(const json& object, const char* key, const std::string& element, const char* what, size_t count) {
    const json* values = arrayMember(object, key, element);
    if (values == nullptr)
        return;
    for (size_t i = 0; i < values->size(); ++i)
        checkIndex((*values)[i], element + " " + key + "[" + std::to_string(i) + "]", what, count);
}

void checkNumbers(const json& object, const char* key, const std::string& element, size_t length) {
    const json* values = arrayMember(object, key, element);
    if (values == nullptr)
        return;
    const std::string place = element + " " + key;
    if (values->size() != length)
        refuse(place, std::to_string(values->size()) + " numbers instead of " + std::to_string(length));
    for (const json& value : *values) {
        if (!value.is_number())
            refuse(place, "not all numbers");
        // Written so that a NaN fails too; float's range, because that is what becomes of it.
        if (!(std::abs(value.get<double>()) <= std::numeric_limits<float>::max()))
            refuse(place, "not finite");
    }
}

void checkString(const json& object, const char* key, const std::string& element) {
    const json* value = member(object, key);
    if (value != nullptr && !value->is_string())
        refuse(element + " " + key, "not a string");
}

std::string stringMember(const json& object, const char* key, const std::string& element) {
    checkString(object, key, element);
    const json* value = member(object, key);
    return value == nullptr ? std::string() : value->get<std::string>();
}

bool hasExtension(const json& object, const char* name) {
    const json* extensions = member(object, "extensions");
    return extensions != nullptr && extensions->is_object() && extensions->contains(name);
}

// ---- the file's parts -----------------------------------------------------------------------------------------------

void checkAsset(const json& root) {
    const json* asset = objectMember(root, "asset", "JSON");
    if (asset == nullptr)
        refuse("asset", "missing: not a glTF 2.0 file");
    const std::string version = stringMember(*asset, "version", "asset");
    if (version != "2" && !version.starts_with("2."))
        refuse("asset version", listed(version) + ", only 2.x is supported");
    const std::string minVersion = stringMember(*asset, "minVersion", "asset");
    if (!minVersion.empty() && minVersion != "2.0")
        refuse("asset minVersion", listed(minVersion) + ", only 2.0 is supported");
}

void checkExtensions(const json& root) {
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        const json* names = arrayMember(root, key, "");
        if (names == nullptr)
            continue;
        for (const json& name : *names)
            if (!name.is_string())
                refuse(key, "not all strings");
    }
    const json* required = member(root, "extensionsRequired");
    if (required == nullptr)
        return;
    for (const json& entry : *required) {
        const std::string name = entry.get<std::string>();
        if (name == "FB_ngon_encoding")
            continue;
        if (name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression" ||
            name == "KHR_meshopt_compression")
            refuse("extensionsRequired", name + " is not supported: it may reorder or drop polygons; export the mesh "
                                                "uncompressed");
        if (name == "KHR_mesh_quantization")
            refuse("extensionsRequired", name + " is not supported: export float positions");
        refuse("extensionsRequired", name + " is not supported");
    }
}

/// Child lists make the node tree; it must be a forest before anybody walks it. Recursion-free.
void checkNodeTree(const json& nodes) {
    const size_t count = nodes.size();
    std::vector<size_t> parents(count, count);
    for (size_t parent = 0; parent < count; ++parent) {
        const json* children = member(nodes[parent], "children");
        if (children == nullptr)
            continue;
        for (const json& entry : *children) {
            const auto child = entry.get<size_t>();
            if (child == parent)
                refuse(at("node", child), "is its own child");
            if (parents[child] == parent)
                refuse(at("node", child), "listed twice by its parent, node " + std::to_string(parent));
            if (parents[child] != count)
                refuse(at("node", child),
                       "has two parents, nodes " + std::to_string(parents[child]) + " and " + std::to_string(parent));
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
        if (node != count && state[node] == onPath)
            refuse(at("node", node), "is its own ancestor");
        for (const size_t passed : path)
            state[passed] = done;
    }
}

void checkBufferViews(const json& views, std::span<const std::span<const std::byte>> buffers) {
    for (size_t i = 0; i < views.size(); ++i) {
        const std::string element = at("bufferView", i);
        checkIndexMember(views[i], "buffer", element, "buffer", buffers.size(), true);
        const size_t available = buffers[views[i].at("buffer").get<size_t>()].size();
        const uint64_t offset = unsignedMember(views[i], "byteOffset", element, 0);
        const uint64_t length = unsignedMember(views[i], "byteLength", element, std::nullopt);
        if (length == 0)
            refuse(element + " byteLength", "zero");
        if (offset > available || length > available - offset)
            refuse(element, "bytes " + std::to_string(offset) + " + " + std::to_string(length) +
                                " are out of range: the buffer has " + std::to_string(available));
        const json* stride = member(views[i], "byteStride");
        if (stride != nullptr) {
            const uint64_t value = toUnsigned(*stride, element + " byteStride");
            if (value < 4 || value > 252 || value % 4 != 0)
                refuse(element + " byteStride", std::to_string(value) + " is not a multiple of 4 in 4..252");
        }
        checkString(views[i], "name", element);
    }
}

void checkComponentType(const json& object, const std::string& element, bool indicesOnly) {
    const uint64_t type = unsignedMember(object, "componentType", element, std::nullopt);
    const bool isIndex = type == 5121 || type == 5123 || type == 5125;
    if (!isIndex && (indicesOnly || (type != 5120 && type != 5122 && type != 5126)))
        refuse(element + " componentType", std::to_string(type) + " is not allowed");
}

void checkAccessors(const json& accessors, size_t viewCount) {
    constexpr std::array<const char*, 7> types{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    for (size_t i = 0; i < accessors.size(); ++i) {
        const std::string element = at("accessor", i);
        const json& accessor = accessors[i];
        checkIndexMember(accessor, "bufferView", element, "bufferView", viewCount);
        unsignedMember(accessor, "byteOffset", element, 0);
        checkComponentType(accessor, element, false);
        if (unsignedMember(accessor, "count", element, std::nullopt) == 0)
            refuse(element + " count", "zero");
        const std::string type = stringMember(accessor, "type", element);
        if (std::none_of(types.begin(), types.end(), [&](const char* known) { return type == known; }))
            refuse(element + " type", listed(type) + " is not allowed");
        const json* normalized = member(accessor, "normalized");
        if (normalized != nullptr && !normalized->is_boolean())
            refuse(element + " normalized", "not a boolean");
        const json* sparse = objectMember(accessor, "sparse", element);
        if (sparse == nullptr)
            continue;
        const std::string place = element + " sparse";
        const uint64_t count = unsignedMember(*sparse, "count", place, std::nullopt);
        if (count == 0 || count > accessor.at("count").get<uint64_t>())
            refuse(place + " count",
                   std::to_string(count) + " is not in 1.." + std::to_string(accessor.at("count").get<uint64_t>()));
        for (const char* part : {"indices", "values"}) {
            const json* object = objectMember(*sparse, part, place);
            const std::string partPlace = place + " " + part;
            if (object == nullptr)
                refuse(partPlace, "missing");
            checkIndexMember(*object, "bufferView", partPlace, "bufferView", viewCount, true);
            // tinygltf keeps sparse offsets as int.
            if (unsignedMember(*object, "byteOffset", partPlace, 0) > std::numeric_limits<int>::max())
                refuse(partPlace + " byteOffset", "out of range");
        }
        if (count > static_cast<uint64_t>(std::numeric_limits<int>::max()))
            refuse(place + " count", "out of range");
        checkComponentType(sparse->at("indices"), place + " indices", true);
    }
}

void checkMeshes(const json& root) {
    const json& meshes = table(root, "meshes");
    const json& accessors = table(root, "accessors");
    const size_t accessorCount = accessors.size();
    const size_t materialCount = table(root, "materials").size();
    for (size_t i = 0; i < meshes.size(); ++i) {
        checkString(meshes[i], "name", at("mesh", i));
        const json* primitives = arrayMember(meshes[i], "primitives", at("mesh", i));
        if (primitives == nullptr || primitives->empty())
            refuse(at("mesh", i), "no primitives");
        for (size_t k = 0; k < primitives->size(); ++k) {
            const json& primitive = (*primitives)[k];
            const std::string element = at("mesh", i) + " " + at("primitive", k);
            if (!primitive.is_object())
                refuse(element, "not an object");
            const json* attributes = objectMember(primitive, "attributes", element);
            if (attributes == nullptr)
                refuse(element, "no attributes");
            for (const auto& [name, value] : attributes->items())
                checkIndex(value, within(element, name), "accessor", accessorCount);
            checkIndexMember(primitive, "indices", element, "accessor", accessorCount);
            const json* indices = member(primitive, "indices");
            if (indices != nullptr && member(accessors[indices->get<size_t>()], "bufferView") == nullptr)
                refuse(element + " indices", hasExtension(primitive, "KHR_draco_mesh_compression")
                                                 ? "compressed with KHR_draco_mesh_compression; export the mesh "
                                                   "uncompressed"
                                                 : at("accessor", indices->get<size_t>()) + " has no bufferView");
            checkIndexMember(primitive, "material", element, "material", materialCount);
            if (unsignedMember(primitive, "mode", element, 4) > 6)
                refuse(element + " mode", "not in 0..6");
            objectMember(primitive, "extensions", element);
        }
    }
}

void checkNodes(const json& root) {
    const json& nodes = table(root, "nodes");
    const json& skins = table(root, "skins");
    const size_t meshCount = table(root, "meshes").size();
    const size_t accessorCount = table(root, "accessors").size();
    for (size_t i = 0; i < nodes.size(); ++i) {
        const std::string element = at("node", i);
        checkString(nodes[i], "name", element);
        checkIndexMember(nodes[i], "mesh", element, "mesh", meshCount);
        checkIndexMember(nodes[i], "skin", element, "skin", skins.size());
        checkIndexArray(nodes[i], "children", element, "node", nodes.size());
        checkNumbers(nodes[i], "matrix", element, 16);
        checkNumbers(nodes[i], "translation", element, 3);
        checkNumbers(nodes[i], "rotation", element, 4);
        checkNumbers(nodes[i], "scale", element, 3);
    }
    checkNodeTree(nodes);

    const json& scenes = table(root, "scenes");
    for (size_t i = 0; i < scenes.size(); ++i)
        checkIndexArray(scenes[i], "nodes", at("scene", i), "node", nodes.size());
    checkIndexMember(root, "scene", "JSON", "scene", scenes.size());

    for (size_t i = 0; i < skins.size(); ++i) {
        const std::string element = at("skin", i);
        const json* joints = arrayMember(skins[i], "joints", element);
        if (joints == nullptr || joints->empty())
            refuse(element, "no joints");
        checkIndexArray(skins[i], "joints", element, "node", nodes.size());
        checkIndexMember(skins[i], "skeleton", element, "node", nodes.size());
        checkIndexMember(skins[i], "inverseBindMatrices", element, "accessor", accessorCount);
    }
}

/// A channel without a target node (an extension may define its target) would be dropped by tinygltf and shift the
/// numbers of those after it; it is given a path of its own, which the reader reports and ignores.
void checkAnimations(json& root) {
    const size_t accessorCount = table(root, "accessors").size();
    const size_t nodeCount = table(root, "nodes").size();
    const size_t count = table(root, "animations").size();
    for (size_t i = 0; i < count; ++i) {
        const std::string element = at("animation", i);
        json& animation = root["animations"][i];
        checkString(animation, "name", element);
        const json* samplers = arrayMember(animation, "samplers", element);
        const size_t samplerCount = samplers == nullptr ? 0 : samplers->size();
        for (size_t k = 0; k < samplerCount; ++k) {
            const std::string place = element + " " + at("sampler", k);
            const json& sampler = (*samplers)[k];
            if (!sampler.is_object())
                refuse(place, "not an object");
            checkIndexMember(sampler, "input", place, "accessor", accessorCount, true);
            checkIndexMember(sampler, "output", place, "accessor", accessorCount, true);
            const std::string interpolation = stringMember(sampler, "interpolation", place);
            if (!interpolation.empty() && interpolation != "STEP" && interpolation != "LINEAR" &&
                interpolation != "CUBICSPLINE")
                refuse(place + " interpolation", listed(interpolation) + " is not allowed");
        }
        const json* channels = arrayMember(animation, "channels", element);
        for (size_t k = 0; channels != nullptr && k < channels->size(); ++k) {
            const std::string place = element + " " + at("channel", k);
            json& channel = animation["channels"][k];
            if (!channel.is_object())
                refuse(place, "not an object");
            checkIndexMember(channel, "sampler", place, "sampler", samplerCount, true);
            const json* target = objectMember(channel, "target", place);
            if (target == nullptr || member(*target, "node") == nullptr) {
                channel["target"] = {{"node", 0}, {"path", "pointer"}};
                continue;
            }
            checkIndexMember(*target, "node", place + " target", "node", nodeCount, true);
            if (stringMember(*target, "path", place).empty())
                refuse(place, "path is missing");
        }
    }
}

void checkMaterials(const json& root) {
    const json& materials = table(root, "materials");
    const json& textures = table(root, "textures");
    const json& samplers = table(root, "samplers");
    const size_t imageCount = table(root, "images").size();
    for (size_t i = 0; i < materials.size(); ++i) {
        const std::string element = at("material", i);
        checkString(materials[i], "name", element);
        checkString(materials[i], "alphaMode", element);
        checkNumbers(materials[i], "emissiveFactor", element, 3);
        const json* cutoff = member(materials[i], "alphaCutoff");
        if (cutoff != nullptr &&
            (!cutoff->is_number() || !(std::abs(cutoff->get<double>()) <= std::numeric_limits<float>::max())))
            refuse(element + " alphaCutoff", "not a finite number");
        const json* pbr = objectMember(materials[i], "pbrMetallicRoughness", element);
        if (pbr == nullptr)
            continue;
        checkNumbers(*pbr, "baseColorFactor", element, 4);
        if (const json* texture = objectMember(*pbr, "baseColorTexture", element))
            checkIndexMember(*texture, "index", element + " baseColorTexture", "texture", textures.size(), true);
    }
    for (size_t i = 0; i < textures.size(); ++i) {
        checkIndexMember(textures[i], "source", at("texture", i), "image", imageCount);
        checkIndexMember(textures[i], "sampler", at("texture", i), "sampler", samplers.size());
    }
    for (size_t i = 0; i < samplers.size(); ++i)
        for (const char* key : {"wrapS", "wrapT"})
            unsignedMember(samplers[i], key, at("sampler", i), 10497);
}

void loadBuffers(const json& buffers, const Container& container, const std::string& baseDirectory,
                 GltfDocument& document) {
    document.owned.resize(buffers.size());
    for (size_t i = 0; i < buffers.size(); ++i) {
        const std::string element = at("buffer", i);
        const uint64_t length = unsignedMember(buffers[i], "byteLength", element, std::nullopt);
        if (length == 0)
            refuse(element + " byteLength", "zero");
        std::span<const std::byte> bytes;
        const json* uri = member(buffers[i], "uri");
        if (uri == nullptr) {
            if (hasExtension(buffers[i], "EXT_meshopt_compression") ||
                hasExtension(buffers[i], "KHR_meshopt_compression"))
                refuse(element, "is meshopt-compressed; export the mesh uncompressed");
            if (i != 0 || !container.isBinary)
                refuse(element, "no uri");
            if (container.binary.empty())
                refuse(element, "the GLB has no binary chunk or an empty one");
            bytes = container.binary;
        } else {
            const std::string text = stringMember(buffers[i], "uri", element);
            UriBytes read = isDataUri(text) ? decodeDataUri(text) : readBelow(baseDirectory, text);
            if (!read.problem.empty()) {
                const std::string shown = isDataUri(text) ? "" : listed(text.substr(0, 100)) + ": ";
                refuse(element + " uri", shown + read.problem, read.readable ? ErrorCode::asset : ErrorCode::io);
            }
            document.owned[i] = std::move(read.bytes);
            bytes = document.owned[i];
        }
        if (bytes.size() < length)
            refuse(element, "truncated: byteLength is " + std::to_string(length) + ", " + std::to_string(bytes.size()) +
                                " bytes present");
        document.buffers.push_back(bytes.first(static_cast<size_t>(length)));
    }
}

/// A character without its texture is still a character: whatever is wrong with an image is a warning.
void loadImages(const json& images, const json& views, const std::string& baseDirectory, GltfDocument& document) {
    for (size_t i = 0; i < images.size(); ++i) {
        const std::string element = at("image", i);
        Image image;
        image.name = stringMember(images[i], "name", element);
        image.mimeType = stringMember(images[i], "mimeType", element);
        if (member(images[i], "bufferView") != nullptr) {
            checkIndexMember(images[i], "bufferView", element, "bufferView", views.size());
            const json& view = views[images[i].at("bufferView").get<size_t>()];
            const size_t offset = unsignedMember(view, "byteOffset", element, 0);
            const auto bytes =
                document.buffers[view.at("buffer").get<size_t>()].subspan(offset, view.at("byteLength").get<size_t>());
            image.bytes.assign(bytes.begin(), bytes.end());
        } else {
            const std::string uri = stringMember(images[i], "uri", element);
            UriBytes read = isDataUri(uri) ? decodeDataUri(uri) : readBelow(baseDirectory, uri);
            if (!read.problem.empty()) {
                std::string warning = within(element, "uri: ");
                if (!isDataUri(uri))
                    warning += listed(uri.substr(0, 100)) + ": ";
                document.warnings.push_back(warning += read.problem + "; left out");
            } else {
                image.bytes = std::move(read.bytes);
                if (image.mimeType.empty())
                    image.mimeType = read.mimeType;
                if (image.name.empty() && !isDataUri(uri))
                    image.name = uri;
            }
        }
        if (image.mimeType.empty() && image.bytes.size() >= 4) {
            const uint32_t magic = readU32(image.bytes, 0);
            if (magic == 0x474E5089u)
                image.mimeType = "image/png";
            else if ((magic & 0xFFFFFFu) == 0xFFD8FFu)
                image.mimeType = "image/jpeg";
        }
        document.images.push_back(std::move(image));
    }
}

/// What nobody reads is not copied into tinygltf's Values, which take far more memory than the text: extras go, of
/// extensions only the names stay. Recursion is bounded by kMaxJsonDepth.
void stripUnread(json& value) {
    if (value.is_object()) {
        value.erase("extras");
        for (auto& [key, part] : value.items()) {
            if (key != "extensions" || !part.is_object()) {
                stripUnread(part);
                continue;
            }
            for (auto& extension : part)
                extension = json::object();
        }
    } else if (value.is_array()) {
        for (json& part : value)
            stripUnread(part);
    }
}

} // namespace

GltfDocument loadGltfDocument(std::span<const std::byte> bytes, const std::string& baseDirectory) {
    const Container container = openContainer(bytes);
    checkNesting(container.text);
    json root = parseJson(container.text);
    if (!root.is_object())
        refuse("JSON", "not an object");
    checkAsset(root);
    checkExtensions(root);

    GltfDocument document;
    loadBuffers(table(root, "buffers"), container, baseDirectory, document);
    checkBufferViews(table(root, "bufferViews"), document.buffers);
    checkAccessors(table(root, "accessors"), table(root, "bufferViews").size());
    checkNodes(root);
    checkMeshes(root);
    checkAnimations(root);
    checkMaterials(root);
    loadImages(table(root, "images"), table(root, "bufferViews"), baseDirectory, document);

    for (const char* key : {"buffers", "images", "cameras", "extensions"})
        root.erase(key);
    stripUnread(root);
    const std::string text = root.dump();
    if (text.size() > std::numeric_limits<unsigned int>::max())
        refuse("JSON", "larger than 4 GiB", ErrorCode::limit);

    supple_tinygltf::TinyGLTF parser;
    std::string error;
    std::string warning;
    if (!parser.LoadASCIIFromString(&document.model, &error, &warning, text.c_str(),
                                    static_cast<unsigned int>(text.size()), ""))
        refuse("JSON", error.empty() ? "not understood" : error.substr(0, 200));
    // tinygltf drops what it cannot parse; after the checks nothing should have been.
    bool complete = document.model.accessors.size() == table(root, "accessors").size() &&
                    document.model.bufferViews.size() == table(root, "bufferViews").size() &&
                    document.model.nodes.size() == table(root, "nodes").size() &&
                    document.model.skins.size() == table(root, "skins").size() &&
                    document.model.meshes.size() == table(root, "meshes").size() &&
                    document.model.animations.size() == table(root, "animations").size();
    for (size_t i = 0; complete && i < document.model.meshes.size(); ++i)
        complete = document.model.meshes[i].primitives.size() == root["meshes"][i].at("primitives").size();
    for (size_t i = 0; complete && i < document.model.animations.size(); ++i) {
        const auto& animation = root["animations"][i];
        complete = document.model.animations[i].channels.size() == animation.value("channels", json::array()).size() &&
                   document.model.animations[i].samplers.size() == animation.value("samplers", json::array()).size();
    }
    if (!complete)
        refuse("JSON", error.empty() ? "not understood" : error.substr(0, 200));
    return document;
}

} // namespace supple::cage
