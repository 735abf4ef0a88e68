// A glTF or GLB in memory: container, JSON, buffers and images, checked before anything is built from them. Private to
// cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/json.h"
#include "cage/gltf/model.h"
#include "cage/gltf/reader.h"
#include "cage/leniency.h"
#include "cage/memory_budget.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// What of a file is read.
enum class Content {
    all,
    motion ///< nodes and animations: no images, and materials are not looked at
};

struct Document {
    JsonTree json;          ///< owns what the others refer to
    file::Model model;      ///< all but buffers, images, textures and materials
    Json meshes, materials; ///< as the file has them: with the extensions and extras that the model lacks, unchecked
    std::vector<Texture> textures;                   ///< see readTextures()
    std::vector<std::span<const std::byte>> buffers; ///< exactly byteLength bytes each, or none
    std::vector<int> decodedInto; ///< per bufferView: the buffer behind the file's own that it is decoded into, -1, or
                                  ///< kNotDecoded
    std::vector<Image> images;    ///< same indices as the file's; bytes empty where missing
    std::vector<std::string> warnings;

    std::vector<SharedBytes> owned; ///< behind the buffers that are not in the caller's bytes
    std::unique_ptr<MemoryBudget> memory;
    std::unique_ptr<Leniency> leniency; ///< takes the faults of the file
};

/// Whether the file names an extension among those it uses or requires.
[[nodiscard]] bool isUsed(const Document& document, const char* extension);
/// Whether the file names an extension among those it requires.
[[nodiscard]] bool isRequired(const Document& document, const char* extension);

/// Throws Refusal. The document refers to `bytes`. `memoryLimit` and `strict`: as GltfOptions has them.
[[nodiscard]] Document loadDocument(std::span<const std::byte> bytes, const FileReader& readFile, uint64_t memoryLimit,
                                    bool strict, Content content = Content::all);

} // namespace supple::cage::gltf
