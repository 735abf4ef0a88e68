// Meshes as they are shown, without what deforms them: a character in one pose, for other programs.
#pragma once

#include "cage/character.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace supple::cage {

/// Triangles of one material. Every list of vertices has one entry per vertex, or none if the mesh goes without.
struct StillFaces {
    uint32_t material = kNone; ///< index into Character::materials
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< of unit length
    std::vector<glm::vec4> tangents; ///< glTF's TANGENT: of unit length, w is 1 or -1
    std::vector<glm::vec2> uvs[2];
    std::vector<std::array<uint16_t, 4>> colors; ///< linear RGBA, 65535 is 1
    std::vector<uint32_t> triangles;             ///< three vertices each
};

struct StillMesh {
    std::string name;
    std::vector<StillFaces> faces; ///< at most one per material
};

} // namespace supple::cage
