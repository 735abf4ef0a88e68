// The bytes a glTF file refers to: buffers, which it cannot do without, and images, which it can. Private to
// cage/gltf/.
#pragma once

#include "cage/gltf/container.h"
#include "cage/gltf/document.h"
#include "cage/gltf/json.h"
#include "cage/gltf/reader.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace supple::cage::gltf {

/// The files that a document names, each read once, however many buffers and images name it.
class Resources {
public:
    /// Both must outlive it. What is read counts as the document's.
    Resources(const FileReader& readFile, Document& document) : readFile_(readFile), memory_(*document.memory) {}

    struct Found {
        SharedBytes bytes;
        std::string mimeType; ///< as a data: URI says
    };
    /// A problem is told with the URI it is about; data: URIs are too long for that.
    [[nodiscard]] Result<Found> fetch(const std::string& uri);

private:
    const FileReader& readFile_;
    MemoryBudget& memory_;
    std::map<std::string, Result<SharedBytes>> read_; ///< by path
};

/// Fills document.buffers and what is behind them, empty where `placeholder` is 1. Throws Refusal.
void loadBuffers(const Json& buffers, std::span<const uint8_t> placeholder, const Container& container,
                 Resources& resources, Document& document);

/// Fills document.images, with a warning for those that cannot be read. The views have passed checkStructure().
void loadImages(const Json& images, Resources& resources, Document& document);

} // namespace supple::cage::gltf
