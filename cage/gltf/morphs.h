// Morph targets of a glTF file. Private to cage/gltf/. All of these throw Refusal.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"
#include "cage/split/vertex_morphs.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// Per morph target the accessor of its displacements, -1 where it moves no positions.
[[nodiscard]] std::vector<int> findMorphTargets(const file::Primitive& primitive);

using split::MorphDelta;
using split::VertexMorphs;

/// Appends the displacements of the vertices of primitives, one after the other.
class MorphReader {
public:
    /// Vertices whose displacements are in `targets`, of findMorphTargets(). All must have the same number of targets.
    void append(const Document& document, const std::vector<int>& targets, size_t count, const std::string& element,
                VertexMorphs& morphs);

private:
    size_t targetCount_ = 0;
    uint64_t elementsRead_ = 0;
};

/// Names of a mesh's morph targets, mesh.extras.targetNames: empty where the file has no string.
[[nodiscard]] std::vector<std::string> readTargetNames(const Json& mesh, const std::string& element,
                                                       MemoryBudget& memory, Warnings& warnings);

/// How many morph targets the mesh of a node has.
[[nodiscard]] size_t targetCountOf(const Document& document, uint32_t meshNode);

/// Names and weights of the mesh's targets; their displacements are for who has the cage's vertices.
[[nodiscard]] Morphs readMorphs(const Document& document, uint32_t meshNode, size_t targetCount, Warnings& warnings);

} // namespace supple::cage::gltf
