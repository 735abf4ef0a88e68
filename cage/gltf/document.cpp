#include "cage/gltf/document.h"

#include "cage/gltf/container.h"
#include "cage/gltf/draco.h"
#include "cage/gltf/look_extensions.h"
#include "cage/gltf/meshopt.h"
#include "cage/gltf/resources.h"
#include "cage/gltf/structure.h"
#include "cage/gltf/texture.h"
#include "cage/gltf/vrm.h"

#include <algorithm>
#include <cstdint>

namespace supple::cage::gltf {

namespace {

/// What one of a table becomes, in the model and in the character, with its share of what is held while they are made.
constexpr struct {
    const char* name;
    uint64_t bytes;
} kTables[] = {
    {"nodes", 4 * sizeof(file::Node)}, {"materials", 3 * sizeof(Material)}, {"textures", 2 * sizeof(Texture)},
    {"samplers", 2 * sizeof(Texture)}, {"images", 6 * sizeof(Image)},       {"meshes", 3 * sizeof(file::Mesh)},
    {"animations", 4 * sizeof(Clip)},
};

/// Elements of a few bytes become structs of hundreds.
void takeTables(const Json& root, MemoryBudget& memory) {
    for (const auto& [name, bytes] : kTables) {
        memory.take(table(root, name).size(), bytes, name);
    }
}

/// A view may say that it is longer than what is left of its buffer.
void endViewsWithBuffers(Document& document) {
    for (file::BufferView& view : document.model.bufferViews) {
        if (!view.broken) {
            view.byteLength = std::min(view.byteLength, document.buffers[view.buffer].size() - view.byteOffset);
        }
    }
}

} // namespace

bool isUsed(const Document& document, const char* extension) {
    return document.model.extensionsUsed.contains(extension) || isRequired(document, extension);
}

bool isRequired(const Document& document, const char* extension) {
    return document.model.extensionsRequired.contains(extension);
}

Document loadDocument(std::span<const std::byte> bytes, const FileReader& readFile, uint64_t memoryLimit, bool strict,
                      Content content) {
    Document document;
    document.leniency = std::make_unique<Leniency>(strict);
    const Container container = openContainer(bytes, *document.leniency);
    document.memory = std::make_unique<MemoryBudget>(memoryLimit);
    document.memory->addFile(bytes.size());
    document.json = parseJson(container.text, *document.memory);
    const Json& root = document.json.root();
    checkHeader(root);
    Resources resources(readFile, document);
    loadBuffers(table(root, "buffers"), findPlaceholders(root), container, resources, document);
    decodeMeshopt(root, document);
    const Broken broken = checkStructure(root, document.buffers, document.decodedInto, *document.leniency);
    takeTables(root, *document.memory);
    document.model = file::toModel(root, document.decodedInto, broken);
    endViewsWithBuffers(document);
    if (content == Content::all) {
        loadImages(table(root, "images"), resources, document);
        document.textures = readTextures(root, *document.leniency, document.warnings);
        nameUnreadLook(root, document.warnings);
        nameUnusedVrm(root, document.warnings);
        document.materials = table(root, "materials");
        decodeDraco(document);
    }
    document.meshes = table(root, "meshes");
    return document;
}

} // namespace supple::cage::gltf
