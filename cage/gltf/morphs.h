// Morph targets of a glTF file. Private to cage/gltf/. All of these throw Refusal.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"
#include "cage/split/vertex_morphs.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace supple::cage::gltf {

using split::MorphDelta;
using split::VertexMorphs;

/// Vertices, counted from 0, and their displacements that are not zero, target by target.
using Displacements = std::vector<std::pair<uint32_t, MorphDelta>>;

/// Reads the displacements of the primitives of one mesh, one after the other.
class MorphReader {
public:
    /// Per morph target the accessor of its displacements, -1 where it moves no positions. If a primitive has other
    /// targets than the first one, that is a fault: it counts as not moved by the others.
    [[nodiscard]] std::vector<int> targetsOf(const Document& document, const file::Primitive& primitive,
                                             const std::string& element);
    /// The displacements that are in `targets`, of targetsOf(), of a primitive with `count` vertices.
    [[nodiscard]] Displacements read(const Document& document, const std::vector<int>& targets, size_t count,
                                     const std::string& element);

private:
    std::optional<size_t> firstCount_; ///< targets of the first primitive
    uint64_t elementsRead_ = 0;
};

struct TargetNames {
    std::string element;            ///< what has them
    std::vector<std::string> names; ///< empty where the file has no string
};
/// Names of a mesh's morph targets: targetNames of its extras, else of the extras of the first primitive that has some.
[[nodiscard]] TargetNames readTargetNames(const Json& mesh, const std::string& element, MemoryBudget& memory,
                                          Warnings& warnings);

/// How many morph targets a mesh has: as many as the primitive with most of them.
[[nodiscard]] size_t targetCountOf(const file::Mesh& mesh);

/// Names and weights of the mesh's targets; their displacements are for who has the cage's vertices.
[[nodiscard]] Morphs readMorphs(const Document& document, uint32_t meshNode, size_t targetCount, Warnings& warnings);

} // namespace supple::cage::gltf
