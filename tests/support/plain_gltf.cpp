#include "tests/support/plain_gltf.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace supple::test {
namespace {

using nlohmann::json;

struct File {
    json root;
    std::vector<char> bin;

    /// All elements of an accessor as doubles; empty if it is not plain.
    [[nodiscard]] std::vector<double> read(size_t index) const {
        const json& accessor = root["accessors"][index];
        if (accessor.contains("sparse") || !accessor.contains("bufferView")) {
            return {};
        }
        const json& view = root["bufferViews"][accessor["bufferView"].get<size_t>()];
        if (view.contains("extensions")) {
            return {};
        }
        const int component = accessor["componentType"];
        const size_t size = component <= 5121 ? 1 : component <= 5123 ? 2 : 4;
        const std::string type = accessor["type"];
        const size_t width = type == "SCALAR" ? 1 : static_cast<size_t>(type.back() - '0');
        const size_t stride = view.value("byteStride", size * width);
        const bool normalized = accessor.value("normalized", false);
        std::vector<double> values;
        for (size_t i = 0; i < accessor["count"].get<size_t>(); ++i) {
            for (size_t k = 0; k < width; ++k) {
                values.push_back(value(bin.data() + view.value("byteOffset", size_t{0}) +
                                           accessor.value("byteOffset", size_t{0}) + i * stride + k * size,
                                       component, normalized));
            }
        }
        return values;
    }

private:
    template <class T>
    static double as(const char* at, double largest) {
        T number;
        std::memcpy(&number, at, sizeof(number));
        return std::max(static_cast<double>(number) / largest, largest == 1.0 ? -1e300 : -1.0);
    }
    static double value(const char* at, int component, bool normalized) {
        switch (component) {
        case 5120:
            return as<int8_t>(at, normalized ? 127.0 : 1.0);
        case 5121:
            return as<uint8_t>(at, normalized ? 255.0 : 1.0);
        case 5122:
            return as<int16_t>(at, normalized ? 32767.0 : 1.0);
        case 5123:
            return as<uint16_t>(at, normalized ? 65535.0 : 1.0);
        case 5125:
            return as<uint32_t>(at, 1.0);
        default:
            return as<float>(at, 1.0);
        }
    }
};

std::optional<File> openGlb(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    const auto word = [&](size_t at) {
        uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, sizeof(value));
        return value;
    };
    if (bytes.size() < 28 || word(0) != 0x46546C67u) {
        return std::nullopt;
    }
    File file;
    const size_t jsonSize = word(12), bin = 20 + jsonSize;
    file.root = json::parse(bytes.begin() + 20, bytes.begin() + static_cast<ptrdiff_t>(bin));
    if (bytes.size() < bin + 8) {
        return std::nullopt;
    }
    file.bin.assign(bytes.begin() + static_cast<ptrdiff_t>(bin + 8), bytes.end());
    return file;
}

void normalize(std::vector<std::pair<uint32_t, double>>& influences) {
    double sum = 0.0;
    for (const auto& [joint, weight] : influences) {
        sum += weight;
    }
    for (auto& [joint, weight] : influences) {
        weight /= sum;
    }
}

/// False if an accessor is not plain.
bool readPrimitive(const File& file, const json& primitive, PlainMesh& mesh) {
    const json& attributes = primitive["attributes"];
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    const auto vec3 = [](const std::vector<double>& values, size_t i) {
        return glm::dvec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    };
    const std::vector<double> positions = file.read(attributes["POSITION"]);
    const std::vector<double> normals =
        attributes.contains("NORMAL") ? file.read(attributes["NORMAL"]) : std::vector<double>(positions.size(), 0.0);
    if (positions.empty() || normals.size() != positions.size()) {
        return false;
    }
    for (size_t v = 0; v < positions.size() / 3; ++v) {
        mesh.vertices.push_back({vec3(positions, v), vec3(normals, v), {}, {}});
    }
    for (int set = 0; attributes.contains("JOINTS_" + std::to_string(set)); ++set) {
        const std::vector<double> joints = file.read(attributes["JOINTS_" + std::to_string(set)]);
        const std::vector<double> weights = file.read(attributes["WEIGHTS_" + std::to_string(set)]);
        for (size_t i = 0; i < weights.size(); ++i) {
            if (weights[i] > 0.0) {
                mesh.vertices[first + i / 4].influences.emplace_back(static_cast<uint32_t>(joints[i]), weights[i]);
            }
        }
    }
    for (size_t v = first; v < mesh.vertices.size(); ++v) {
        auto& influences = mesh.vertices[v].influences;
        if (influences.empty()) {
            influences.emplace_back(0u, 1.0);
        }
        normalize(influences);
    }
    for (const json& target : primitive.value("targets", json::array())) {
        const std::vector<double> deltas =
            target.contains("POSITION") ? file.read(target["POSITION"]) : std::vector<double>(positions.size(), 0.0);
        if (deltas.size() != positions.size()) {
            return false;
        }
        for (size_t v = 0; v < positions.size() / 3; ++v) {
            mesh.vertices[first + v].morphs.push_back(vec3(deltas, v));
        }
    }
    std::vector<double> indices;
    if (primitive.contains("indices")) {
        indices = file.read(primitive["indices"]);
    } else {
        for (size_t v = 0; v < positions.size() / 3; ++v) {
            indices.push_back(static_cast<double>(v));
        }
    }
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const auto at = [&](size_t k) { return first + static_cast<uint32_t>(indices[i + k]); };
        mesh.triangles.push_back({at(0), at(1), at(2)});
    }
    return !indices.empty();
}

struct Ends {
    size_t vertices = 0, triangles = 0;
};

/// The vertex of the part's cage that lies there, but for the rounding of the inverse bind matrix.
glm::dvec3 nearest(const cage::Character& character, const cage::Part& part, glm::dvec3 point) {
    const cage::Cage& cage = character.cage;
    const auto index = static_cast<size_t>(&part - character.parts.data());
    glm::dvec3 found = point;
    double best = 1e-10 * std::max(glm::dot(point, point), 1e-6); // squared
    for (uint32_t c = cage.faceStarts[part.firstFace]; c < cage.faceStarts[cage::endFace(character, index)]; ++c) {
        const glm::dvec3 other(cage.positions[cage.faceVertices[c]]);
        const double distance = glm::dot(other - point, other - point);
        if (distance < best) {
            best = distance;
            found = other;
        }
    }
    return found;
}

/// What was read of a part since `before`, in the terms of the character: joints of its palette, all targets before the
/// part's own. A mesh without a skin is in the space of its node, and its joint's inverse bind matrix leads there.
void bindPart(const cage::Character& character, const cage::Part& part, bool unskinned, Ends before, PlainMesh& mesh) {
    const glm::dmat4 place(glm::inverse(glm::dmat4(character.skin.inverseBinds[part.joints[0]])));
    for (size_t v = before.vertices; v < mesh.vertices.size(); ++v) {
        PlainMesh::Vertex& vertex = mesh.vertices[v];
        for (auto& [joint, weight] : vertex.influences) {
            joint = part.joints[joint];
        }
        if (unskinned) {
            vertex.position = nearest(character, part, glm::dvec3(place * glm::dvec4(vertex.position, 1.0)));
            vertex.normal = glm::transpose(glm::inverse(glm::dmat3(place))) * vertex.normal;
            for (glm::dvec3& morph : vertex.morphs) {
                morph = glm::dmat3(place) * morph;
            }
        }
        vertex.morphs.insert(vertex.morphs.begin(), part.firstTarget, glm::dvec3(0.0));
    }
    for (size_t t = before.triangles; unskinned && t < mesh.triangles.size(); ++t) {
        if (glm::determinant(glm::dmat3(place)) < 0.0) {
            std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
        }
    }
}

} // namespace

PlainMesh::Posed PlainMesh::pose(uint32_t vertex, const std::vector<double>& morphWeights,
                                 const std::vector<skinning::Affine>& palette) const {
    const Vertex& own = vertices[vertex];
    glm::dvec3 morphed = own.position;
    for (size_t t = 0; t < own.morphs.size() && t < morphWeights.size(); ++t) {
        morphed += morphWeights[t] * own.morphs[t];
    }
    glm::dmat4 matrix(0.0); // by rows
    for (const auto& [joint, weight] : own.influences) {
        for (int row = 0; row < 3; ++row) {
            matrix[row] += weight * glm::dvec4(palette[joint].rows[row]);
        }
    }
    const glm::dvec4 point(morphed, 1.0);
    const glm::dmat3 linear = glm::transpose(glm::dmat3(matrix)); // rows to columns
    const glm::dvec3 normal = glm::transpose(glm::inverse(linear)) * own.normal;
    return {{glm::dot(matrix[0], point), glm::dot(matrix[1], point), glm::dot(matrix[2], point)},
            glm::length(normal) > 0.0 ? glm::normalize(normal) : glm::dvec3(0.0)};
}

std::optional<PlainMesh> readPlainMesh(const std::string& path, const cage::Character& character) {
    const std::optional<File> file = openGlb(path);
    if (!file) {
        return std::nullopt;
    }
    PlainMesh mesh;
    for (const cage::Part& part : character.parts) {
        const json& node = file->root["nodes"][part.node];
        const Ends before{mesh.vertices.size(), mesh.triangles.size()};
        for (const json& primitive : file->root["meshes"][node["mesh"].get<size_t>()]["primitives"]) {
            const bool triangles = primitive.value("mode", 4) == 4;
            if (triangles && !readPrimitive(*file, primitive, mesh)) {
                return std::nullopt;
            }
        }
        bindPart(character, part, !node.contains("skin"), before, mesh);
    }
    return mesh;
}

} // namespace supple::test
