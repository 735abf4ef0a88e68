// Meshes as Draco encodes them, decoded by its library within bounds. Private to cage/gltf/.
#pragma once

#include "cage/memory_budget.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// What is wanted of each vertex, in the form that its accessor says.
struct DracoAttribute {
    std::string name;
    uint32_t id = 0; ///< Draco's own, unique within a mesh
    int componentType = 0;
    size_t components = 0;
};

struct DracoMesh {
    std::vector<uint32_t> indices; ///< three a triangle, each below vertexCount
    size_t vertexCount = 0;
    bool keepsOrder = false;                        ///< vertices and triangles are in the order that they were given in
    std::vector<std::vector<std::byte>> attributes; ///< as wanted, packed
};

/// Whether this build can decode: otherwise decodeDracoMesh() is not there to be called.
[[nodiscard]] bool canDecodeDraco();

/// What Draco's header counts is compared with `memory` before room is made for it. The arrays that are returned are
/// taken from it; what the decoder needs besides is gone by then. Throws Refusal, with `element`.
[[nodiscard]] DracoMesh decodeDracoMesh(std::span<const std::byte> bytes, std::span<const DracoAttribute> wanted,
                                        MemoryBudget& memory, const std::string& element);

} // namespace supple::cage::gltf
