// The bytes a glTF file refers to: buffers, which it cannot do without, and images, which it can. Private to
// cage/gltf/.
#pragma once

#include "cage/gltf/container.h"
#include "cage/gltf/document.h"
#include "cage/gltf/json.h"
#include "cage/gltf/reader.h"

#include <cstdint>
#include <span>

namespace supple::cage::gltf {

/// Fills document.buffers and what is behind them, empty where `placeholder` is 1. Throws Refusal.
void loadBuffers(const Json& buffers, std::span<const uint8_t> placeholder, const Container& container,
                 const FileReader& readFile, Document& document);

/// Fills document.images, with a warning for those that cannot be read. The views have passed checkStructure().
void loadImages(const Json& images, const FileReader& readFile, Document& document);

} // namespace supple::cage::gltf
