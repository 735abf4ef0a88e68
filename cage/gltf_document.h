// A glTF or GLB in memory: container, JSON, buffers and images, checked before anything is built from them. Private to
// cage/.
#pragma once

#include "cage/character.h"
#include "cage/gltf_json.h"
#include "cage/gltf_reader.h"
#include "cage/tinygltf.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace supple::cage {

struct GltfDocument {
    /// Everything but buffers, images, cameras and top-level extensions, which tinygltf never sees. Every index in it
    /// is in range, every number array has its right length and finite members.
    supple_tinygltf::Model model;
    json meshes;    ///< as the file has them: with the extensions and extras that the model lacks, unchecked
    json materials; ///< likewise
    std::vector<std::span<const std::byte>> buffers; ///< exactly byteLength bytes each, or none
    std::vector<Image> images;                       ///< same indices as the file's; bytes empty where missing
    std::vector<std::string> warnings;

    std::vector<std::vector<std::byte>> owned; ///< behind the buffers that are not in the caller's bytes
};

/// Whether the file names an extension among those it uses or requires.
[[nodiscard]] bool isUsed(const GltfDocument& document, const char* extension);
/// Whether the file names an extension among those it requires.
[[nodiscard]] bool isRequired(const GltfDocument& document, const char* extension);

/// Throws Refusal. The document refers to `bytes`.
[[nodiscard]] GltfDocument loadGltfDocument(std::span<const std::byte> bytes, const FileReader& readFile);

} // namespace supple::cage
