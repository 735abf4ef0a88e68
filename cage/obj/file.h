// What an OBJ file says, in its own numbers, before a cage is made of it. Private to cage/obj/.
#pragma once

#include "cage/character.h"

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace supple::cage::obj {

/// A chain of sharp edges as a tag gives it, in the file's vertices.
struct TaggedCrease {
    int64_t a = 0;
    int64_t b = 0;
    float sharpness = 0.0f;
    size_t line = 0;
};

struct TaggedCorner {
    int64_t vertex = 0;
    float sharpness = 0.0f;
    size_t line = 0;
};

struct TaggedHole {
    int64_t face = 0;
    size_t line = 0;
};

struct Corner {
    uint32_t vertex = 0;
    uint32_t uv = kNone;
    uint32_t normal = kNone;
};

/// A vertex without a color of its own.
inline constexpr glm::vec3 kNoColor{-1.0f};

struct File {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> colors; ///< linear, one per vertex or kNoColor; empty: no vertex has one
    std::vector<glm::vec2> uvs;    ///< counted downwards
    std::vector<glm::vec3> normals;
    std::vector<Corner> corners;
    std::vector<uint32_t> faceStarts{0};
    std::vector<size_t> faceLines;
    std::vector<uint8_t> faceIsWhole; ///< else it is left out
    // Per face, places in the lists of names below or kNone.
    std::vector<uint32_t> faceMaterials;
    std::vector<uint32_t> faceObjects;
    std::vector<uint32_t> faceGroups;
    std::vector<std::string> materials; ///< each once, in the order in which they are used first
    std::vector<std::string> objects;
    std::vector<std::string> groups;
    struct Library {
        std::string text; ///< behind mtllib
        size_t line = 0;
    };
    std::vector<Library> libraries; ///< each text once
    std::vector<TaggedCrease> creases;
    std::vector<TaggedCorner> sharpVertices;
    std::vector<TaggedHole> holes;

    [[nodiscard]] size_t faceCount() const { return faceLines.size(); }
};

} // namespace supple::cage::obj
