// Morph targets of a glTF file. Private to cage/gltf/. All of these throw Refusal.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// Per morph target the accessor of its displacements, -1 where it moves no positions.
[[nodiscard]] std::vector<int> findMorphTargets(const file::Primitive& primitive);

/// One vertex's displacement in one target.
struct MorphDelta {
    uint32_t target = 0;
    glm::vec3 delta{0.0f};

    bool operator==(const MorphDelta&) const = default;
};

/// The displacements of vertices that are appended one after the other: by target, those of zero dropped.
class VertexMorphs {
public:
    /// Vertices whose displacements are in `targets`, of findMorphTargets(). All have the same number of targets.
    void append(const Document& document, const std::vector<int>& targets, size_t count, const std::string& element);

    [[nodiscard]] std::span<const MorphDelta> of(uint32_t vertex) const;
    [[nodiscard]] size_t targetCount() const { return targetCount_; }

private:
    std::vector<uint32_t> starts_{0};
    std::vector<MorphDelta> deltas_;
    size_t targetCount_ = 0;
    uint64_t elementsRead_ = 0;
};

/// Names of a mesh's morph targets, mesh.extras.targetNames: empty where the file has no string.
[[nodiscard]] std::vector<std::string> readTargetNames(const Json& mesh, const std::string& element,
                                                       MemoryBudget& memory, Warnings& warnings);

/// Names and weights of the mesh's targets; their displacements are for who has the cage's vertices.
[[nodiscard]] Morphs readMorphs(const Document& document, uint32_t meshNode, size_t targetCount, Warnings& warnings);

} // namespace supple::cage::gltf
