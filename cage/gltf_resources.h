// The bytes a glTF file refers to: buffers, which it cannot do without, and images, which it can. Private to cage/.
#pragma once

#include "cage/gltf_container.h"
#include "cage/gltf_document.h"
#include "cage/gltf_json.h"
#include "cage/gltf_reader.h"

#include <cstdint>
#include <span>

namespace supple::cage {

/// Fills document.buffers and what is behind them, empty where `placeholder` is 1. Throws Refusal.
void loadBuffers(const json& buffers, std::span<const uint8_t> placeholder, const GltfContainer& container,
                 const FileReader& readFile, GltfDocument& document);

/// Fills document.images, with a warning for those that cannot be read. The views have passed checkStructure().
void loadImages(const json& images, const json& views, const FileReader& readFile, GltfDocument& document);

} // namespace supple::cage
