#include "tools/supple/baked_ply.h"

#include "tools/supple/command.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace supple::tools {
namespace {

template <class T>
void append(std::vector<std::byte>& bytes, const T& value) {
    const auto* const first = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof value);
}

uint8_t toByte(double value) {
    return static_cast<uint8_t>(std::lround(255.0 * value));
}

/// Of a linear value in 0..1.
double toSrgb(double value) {
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

/// What all faces and vertices have in common.
struct PlyLayout {
    uint64_t vertexCount = 0;
    uint64_t faceCount = 0;
    bool uvs = false;
    bool colors = false;
    bool manySides = false; ///< a face has more than a byte can count

    explicit PlyLayout(std::span<const BakedMesh> meshes) {
        for (const BakedMesh& mesh : meshes) {
            vertexCount += mesh.vertices.size();
            faceCount += mesh.faces.faceCount();
            uvs = uvs || mesh.uvs[0];
            colors = colors || mesh.colors;
            for (size_t face = 0; face < mesh.faces.faceCount(); ++face) {
                manySides = manySides || mesh.faces.starts[face + 1] - mesh.faces.starts[face] > 255;
            }
        }
    }
};

/// "comment part 0 Hat: faces 0 to 119", line by line.
std::string partComments(std::span<const BakedMesh> meshes, const cage::Character& character) {
    std::string text;
    uint64_t face = 0;
    for (size_t m = 0; m < meshes.size();) {
        const uint32_t part = meshes[m].part;
        const uint64_t first = face;
        for (; m < meshes.size() && meshes[m].part == part; ++m) {
            face += meshes[m].faces.faceCount();
        }
        const std::string& name = character.parts[part].name;
        text += "comment part " + std::to_string(part) + (name.empty() ? "" : " " + printable(name)) + ": faces " +
                std::to_string(first) + " to " + std::to_string(face - 1) + "\n";
    }
    return text;
}

std::string plyHeader(const PlyLayout& layout, std::span<const BakedMesh> meshes, const cage::Character& character) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment supple bake\n" + partComments(meshes, character) +
                       "element vertex " + std::to_string(layout.vertexCount) + "\n";
    const auto property = [&](const char* type, std::initializer_list<const char*> names) {
        for (const char* name : names) {
            text += std::string("property ") + type + " " + name + "\n";
        }
    };
    property("float", {"x", "y", "z", "nx", "ny", "nz"});
    property("float", layout.uvs ? std::initializer_list<const char*>{"s", "t"} : std::initializer_list<const char*>{});
    if (layout.colors) {
        property("uchar", {"red", "green", "blue", "alpha"});
    }
    text += "element face " + std::to_string(layout.faceCount) + "\n";
    property(layout.manySides ? "list int int" : "list uchar int", {"vertex_indices"});
    return text + "end_header\n";
}

void appendVertex(std::vector<std::byte>& bytes, const PlyLayout& layout, const BakedVertex& vertex) {
    append(bytes, vertex.position);
    append(bytes, vertex.normal);
    if (layout.uvs) {
        append(bytes, glm::vec2(vertex.uvs[0].x, 1.0f - vertex.uvs[0].y)); // glTF's run down the picture
    }
    if (layout.colors) {
        const std::array<uint16_t, 4> color = bakedColor(vertex);
        for (size_t channel = 0; channel < 4; ++channel) {
            const double value = color[channel] / 65535.0;
            append(bytes, toByte(channel < 3 ? toSrgb(value) : value));
        }
    }
}

} // namespace

Result<std::vector<std::byte>> plyOf(std::span<const BakedMesh> meshes, const cage::Character& character) {
    const PlyLayout layout(meshes);
    if (layout.faceCount == 0) {
        return Error{ErrorCode::asset, character.name + ": PLY: there are no faces to write"};
    }
    if (layout.vertexCount > static_cast<uint64_t>(std::numeric_limits<int32_t>::max())) {
        return Error{ErrorCode::limit, character.name + ": PLY: more than 2,147,483,647 vertices"};
    }
    std::vector<std::byte> bytes;
    for (const char letter : plyHeader(layout, meshes, character)) {
        bytes.push_back(static_cast<std::byte>(letter));
    }
    for (const BakedMesh& mesh : meshes) {
        for (const BakedVertex& vertex : mesh.vertices) {
            appendVertex(bytes, layout, vertex);
        }
    }
    uint32_t first = 0;
    for (const BakedMesh& mesh : meshes) {
        for (size_t face = 0; face < mesh.faces.faceCount(); ++face) {
            const uint32_t begin = mesh.faces.starts[face], end = mesh.faces.starts[face + 1];
            layout.manySides ? append(bytes, end - begin) : append(bytes, static_cast<uint8_t>(end - begin));
            for (uint32_t corner = begin; corner < end; ++corner) {
                append(bytes, first + mesh.faces.vertices[corner]);
            }
        }
        first += static_cast<uint32_t>(mesh.vertices.size());
    }
    return bytes;
}

} // namespace supple::tools
