// Scenes that show whether materials are drawn as a file describes them. Tests measure them, and people look at them:
// supple_material_scenes FOLDER writes them all.
#pragma once

#include "host/picture.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace supple::test {

/// A part: a grid of quads with whatever attributes are not empty.
struct SceneMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<glm::vec2> uvs1;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec4> colors;
    std::vector<std::array<uint32_t, 4>> quads;
    size_t material = 0;
};

/// Texture i is image i, with sampler i if there is one. An empty picture becomes bytes that are none.
struct SceneFile {
    std::vector<SceneMesh> meshes;
    std::vector<std::string> materials; ///< JSON
    std::vector<host::Picture> images;
    std::vector<std::string> samplers; ///< JSON
    std::vector<std::string> webps;    ///< bytes: texture i has them as EXT_texture_webp, behind its image
    std::vector<std::string> ktx2s;    ///< as KHR_texture_basisu
};

/// A square of `cells` cells a side, facing +Z, the whole of a picture on it.
[[nodiscard]] SceneMesh squareMesh(glm::vec3 center, float half, uint32_t cells, size_t material);
/// A cube blown up to a ball, each of its six sides with the whole of a picture on it.
[[nodiscard]] SceneMesh ballMesh(glm::vec3 center, float radius, uint32_t cells, size_t material);

/// Columns of the scene of bumps.
enum BumpColumn : uint32_t { kShapedBump, kMappedBump, kMirroredBump, kBumpColumns };
constexpr uint32_t kBumpRows = 4; ///< texture coordinates turned by a right angle more in each
constexpr float kBumpRadius = 0.40f;

/// Bumps on tiles of side 1 about (column, -row, 0), in the manner of Khronos' NormalTangentMirrorTest: one that is
/// there, one that a normal map makes, and one that it makes on mirrored texture coordinates. All look alike if the map
/// is read right. `tangents`: with TANGENT in the file.
[[nodiscard]] SceneFile bumpScene(bool tangents);

/// Balls from smooth to rough, of plastic and metals; below them one each that glows, is unlit, masked, blended,
/// mapped.
[[nodiscard]] SceneFile ballScene();

/// Balls with a coat, with sheen, of glass, and of dielectrics that mirror more and less, row by row, before a
/// checkerboard.
[[nodiscard]] SceneFile layerScene();

/// Writes a .gltf that holds everything. False if it cannot.
[[nodiscard]] bool writeScene(const SceneFile& scene, const std::string& path);

} // namespace supple::test
