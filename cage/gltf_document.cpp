#include "cage/gltf_document.h"

#include "cage/gltf_container.h"
#include "cage/gltf_json.h"
#include "cage/gltf_meshopt.h"
#include "cage/gltf_refusal.h"
#include "cage/gltf_resources.h"
#include "cage/gltf_structure.h"

#include <algorithm>
#include <fstream> // tinygltf.h leaves it out with TINYGLTF_NO_FS, but uses it
#include <limits>

#define TINYGLTF_IMPLEMENTATION
// A second look at the header: tinygltf.h only declared. The checks before it exist because tinygltf drops what it
// cannot parse, narrows integers silently and indexes buffers unchecked; it is handed only JSON that passed them.
#include <tiny_gltf.h>

namespace supple::cage {
namespace {

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
            for (auto& extension : part) {
                extension = json::object();
            }
        }
    } else if (value.is_array()) {
        for (json& part : value) {
            stripUnread(part);
        }
    }
}

/// tinygltf drops what it cannot parse; after the checks nothing should have been.
bool isComplete(const supple_tinygltf::Model& model, const json& root) {
    bool complete = model.accessors.size() == table(root, "accessors").size() &&
                    model.bufferViews.size() == table(root, "bufferViews").size() &&
                    model.nodes.size() == table(root, "nodes").size() &&
                    model.skins.size() == table(root, "skins").size() &&
                    model.meshes.size() == table(root, "meshes").size() &&
                    model.animations.size() == table(root, "animations").size();
    for (size_t i = 0; complete && i < model.meshes.size(); ++i) {
        complete = model.meshes[i].primitives.size() == root["meshes"][i].at("primitives").size();
    }
    for (size_t i = 0; complete && i < model.animations.size(); ++i) {
        const json& animation = root["animations"][i];
        complete = model.animations[i].channels.size() == animation.value("channels", json::array()).size() &&
                   model.animations[i].samplers.size() == animation.value("samplers", json::array()).size();
    }
    return complete;
}

/// Leaves in `root` what the model is made of.
supple_tinygltf::Model toModel(json& root) {
    for (const char* key : {"buffers", "images", "cameras", "extensions"}) {
        root.erase(key);
    }
    stripUnread(root);
    const std::string text = root.dump();
    if (text.size() > std::numeric_limits<unsigned int>::max()) {
        refuse("JSON", "larger than 4 GiB", ErrorCode::limit);
    }

    supple_tinygltf::Model model;
    supple_tinygltf::TinyGLTF parser;
    std::string error;
    std::string warning;
    const bool parsed =
        parser.LoadASCIIFromString(&model, &error, &warning, text.c_str(), static_cast<unsigned int>(text.size()), "");
    if (!parsed || !isComplete(model, root)) {
        refuse("JSON", error.empty() ? "not understood" : error.substr(0, 200));
    }
    return model;
}

} // namespace

bool isUsed(const GltfDocument& document, const char* extension) {
    const auto& used = document.model.extensionsUsed;
    return std::find(used.begin(), used.end(), extension) != used.end() || isRequired(document, extension);
}

bool isRequired(const GltfDocument& document, const char* extension) {
    const auto& required = document.model.extensionsRequired;
    return std::find(required.begin(), required.end(), extension) != required.end();
}

GltfDocument loadGltfDocument(std::span<const std::byte> bytes, const FileReader& readFile) {
    const GltfContainer container = openContainer(bytes);
    json root = parseJson(container.text);
    checkHeader(root);

    GltfDocument document;
    loadBuffers(table(root, "buffers"), findPlaceholders(root), container, readFile, document);
    decodeMeshopt(root, document);
    checkStructure(root, document.buffers);
    loadImages(table(root, "images"), table(root, "bufferViews"), readFile, document);
    document.meshes = table(root, "meshes");
    document.materials = table(root, "materials");
    document.model = toModel(root);
    return document;
}

} // namespace supple::cage
