// What is soft of a mesh of a glTF file: `jiggle` and `cloth` of SUPPLE_deformers. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/gltf/painted.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// The lists of a mesh, beside what is painted of their entries. Colliders are numbers of the file.
class SoftReader {
public:
    SoftReader() = default;
    SoftReader(const Document& document, size_t meshIndex);

    /// The accessors of a primitive that have weights, for append().
    [[nodiscard]] std::vector<int> accessorsOf(const file::Primitive& primitive) const;
    /// Appends the weights of a primitive's `count` vertices.
    void append(const Document& document, std::span<const int> accessors, size_t firstVertex, size_t count,
                const std::string& element);

    struct Lists {
        std::vector<Jiggle> jiggles;
        std::vector<Cloth> cloths;
        std::vector<PaintedWeight> jiggleWeights, clothWeights; ///< one per vertex, or none
    };
    /// What is painted of all vertices.
    [[nodiscard]] Lists finish(const Document& document) &&;

private:
    std::vector<Painted> paintedJiggles_, paintedCloths_;
    Lists read_;
};

} // namespace supple::cage::gltf
