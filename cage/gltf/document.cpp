#include "cage/gltf/document.h"

#include "cage/gltf/container.h"
#include "cage/gltf/look_extensions.h"
#include "cage/gltf/meshopt.h"
#include "cage/gltf/resources.h"
#include "cage/gltf/structure.h"
#include "cage/gltf/texture.h"

#include <algorithm>

namespace supple::cage::gltf {

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
    Document document;
    document.json = parseJson(container.text);
    const Json& root = document.json.root();
    checkHeader(root);
    loadBuffers(table(root, "buffers"), findPlaceholders(root), container, readFile, document);
    decodeMeshopt(root, document);
    checkStructure(root, document.buffers, document.decodedInto);
    document.model = file::toModel(root, document.decodedInto);
    if (content == Content::all) {
        loadImages(table(root, "images"), readFile, document);
        document.textures = readTextures(root, document.warnings);
        nameUnreadLook(root, document.warnings);
        document.materials = table(root, "materials");
    }
    document.meshes = table(root, "meshes");
    return document;
}

} // namespace supple::cage::gltf
