#include "cage/gltf/document.h"

#include "cage/gltf/container.h"
#include "cage/gltf/json.h"
#include "cage/gltf/look_extensions.h"
#include "cage/gltf/meshopt.h"
#include "cage/gltf/resources.h"
#include "cage/gltf/structure.h"
#include "cage/gltf/texture.h"
#include "cage/refusal.h"

#include <algorithm>
#include <fstream> // tinygltf.h leaves it out with TINYGLTF_NO_FS, but uses it
#include <limits>

// A second look at the header: tinygltf.h only declared.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>

namespace supple::cage::gltf {
namespace {

/// Removes extras, and all of extensions but their names: nobody asks the model for them, and tinygltf would keep them
/// as Values, which take far more memory than the text. Recursion is bounded by kMaxJsonDepth.
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

size_t countOf(const json& object, const char* key) {
    const json* list = member(object, key);
    return list == nullptr ? 0 : list->size();
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
        complete = model.meshes[i].primitives.size() == countOf(root["meshes"][i], "primitives");
    }
    for (size_t i = 0; complete && i < model.animations.size(); ++i) {
        const json& animation = root["animations"][i];
        complete = model.animations[i].channels.size() == countOf(animation, "channels") &&
                   model.animations[i].samplers.size() == countOf(animation, "samplers");
    }
    return complete;
}

/// Makes the model of a checked document, and leaves in `root` what it is made of.
///
/// This is the one place where JSON is parsed a second time, because tinygltf reads text alone: it takes no parsed
/// document, gives none out, and its functions for single tables (ParseMesh() and others) are private to its header and
/// change from version to version. The checks cannot wait for it either: tinygltf drops what it cannot parse, narrows
/// integers silently, and does not bound memory. So the checked document is written out again, without all that the
/// model is not asked for, and tinygltf parses that.
supple_tinygltf::Model toModel(json& root) {
    for (const char* key : {"buffers", "images", "samplers", "textures", "materials", "cameras", "extensions"}) {
        root.erase(key);
    }
    if (const auto accessors = root.find("accessors"); accessors != root.end()) {
        for (json& accessor : *accessors) {
            accessor.erase("min");
            accessor.erase("max");
        }
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

bool isUsed(const Document& document, const char* extension) {
    const auto& used = document.model.extensionsUsed;
    return std::find(used.begin(), used.end(), extension) != used.end() || isRequired(document, extension);
}

bool isRequired(const Document& document, const char* extension) {
    const auto& required = document.model.extensionsRequired;
    return std::find(required.begin(), required.end(), extension) != required.end();
}

Document loadDocument(std::span<const std::byte> bytes, const FileReader& readFile, Content content) {
    const Container container = openContainer(bytes);
    json root = parseJson(container.text);
    checkHeader(root);

    Document document;
    loadBuffers(table(root, "buffers"), findPlaceholders(root), container, readFile, document);
    decodeMeshopt(root, document);
    checkStructure(root, document.buffers);
    if (content == Content::all) {
        loadImages(table(root, "images"), table(root, "bufferViews"), readFile, document);
        document.textures = readTextures(root, document.warnings);
        nameUnreadLook(root, document.warnings);
        document.materials = table(root, "materials");
    }
    document.meshes = table(root, "meshes");
    for (const json& animation : table(root, "animations")) {
        const json* extras = member(animation, "extras");
        document.animationExtras.push_back(extras != nullptr ? *extras : json());
    }
    document.model = toModel(root);
    return document;
}

} // namespace supple::cage::gltf
