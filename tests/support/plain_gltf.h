// The first mesh of a GLB, read a second time without the library: vertices and triangles as the file has them.
#pragma once

#include "cage/character.h"
#include "skinning/pose.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace supple::test {

struct PlainMesh {
    struct Vertex {
        glm::dvec3 position{0.0};
        glm::dvec3 normal{0.0}; ///< zero if the primitive has none
        std::vector<std::pair<uint32_t, double>> influences;
        std::vector<glm::dvec3> morphs; ///< one per target
    };
    std::vector<Vertex> vertices; ///< primitive after primitive
    std::vector<std::array<uint32_t, 3>> triangles;

    /// Plain morphing and linear skinning of a vertex; its normal by the inverse transpose, of unit length.
    struct Posed {
        glm::dvec3 position, normal;
    };
    [[nodiscard]] Posed pose(uint32_t vertex, const std::vector<double>& morphWeights,
                             const std::vector<skinning::Affine>& palette) const;
};

/// The meshes of the character's parts. Nothing if the file is no GLB with one buffer and plain accessors.
[[nodiscard]] std::optional<PlainMesh> readPlainMesh(const std::string& path, const cage::Character& character);

} // namespace supple::test
