// GLB and PLY files read without Supple's readers: what supple bake has written, as another program sees it.
#pragma once

#include "tests/tools/command_runner.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace supple::test {

/// Takes values from the front of bytes.
class ByteReader {
public:
    explicit ByteReader(const std::string& bytes, size_t at = 0) : bytes_(bytes), at_(at) {}
    template <class T>
    T take() {
        T value{};
        EXPECT_LE(at_ + sizeof value, bytes_.size());
        if (at_ + sizeof value <= bytes_.size()) {
            std::memcpy(&value, bytes_.data() + at_, sizeof value);
        }
        at_ += sizeof value;
        return value;
    }
    [[nodiscard]] bool atEnd() const { return at_ == bytes_.size(); }

private:
    const std::string& bytes_;
    size_t at_;
};

/// All properties of a vertex have four bytes, but for colors of one byte.
struct Ply {
    std::vector<std::string> comments;
    std::vector<std::string> properties; ///< of a vertex: "float x"
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> uvs;
    std::vector<std::array<uint8_t, 4>> colors;
    std::vector<std::vector<uint32_t>> faces;
};

inline Ply readPly(const std::filesystem::path& path) {
    Ply ply;
    const std::string bytes = readText(path);
    const std::string end = "end_header\n";
    const size_t headerEnd = bytes.find(end);
    EXPECT_NE(headerEnd, std::string::npos) << path;
    std::istringstream header(bytes.substr(0, headerEnd));
    std::vector<std::string> lines;
    for (std::string line; std::getline(header, line);) {
        lines.push_back(line);
    }
    EXPECT_EQ(lines.at(0), "ply");
    EXPECT_EQ(lines.at(1), "format binary_little_endian 1.0");
    size_t vertexCount = 0, faceCount = 0;
    std::string list;
    for (const std::string& line : lines) {
        if (line.starts_with("comment ")) {
            ply.comments.push_back(line.substr(8));
        } else if (line.starts_with("element vertex ")) {
            vertexCount = std::stoul(line.substr(15));
        } else if (line.starts_with("element face ")) {
            faceCount = std::stoul(line.substr(13));
        } else if (line.starts_with("property list ")) {
            list = line.substr(14);
        } else if (line.starts_with("property ")) {
            ply.properties.push_back(line.substr(9));
        }
    }
    EXPECT_TRUE(list == "uchar int vertex_indices" || list == "int int vertex_indices") << list;
    const auto has = [&](const char* name) {
        return std::find(ply.properties.begin(), ply.properties.end(), name) != ply.properties.end();
    };
    ByteReader reader(bytes, headerEnd + end.size());
    for (size_t v = 0; v < vertexCount; ++v) {
        ply.positions.push_back(reader.take<glm::vec3>());
        ply.normals.push_back(reader.take<glm::vec3>());
        if (has("float s")) {
            ply.uvs.push_back(reader.take<glm::vec2>());
        }
        if (has("uchar red")) {
            ply.colors.push_back(reader.take<std::array<uint8_t, 4>>());
        }
    }
    for (size_t f = 0; f < faceCount && !testing::Test::HasFailure(); ++f) {
        const size_t sides = list[0] == 'u' ? reader.take<uint8_t>() : reader.take<uint32_t>();
        ply.faces.emplace_back();
        for (size_t k = 0; k < sides; ++k) {
            ply.faces.back().push_back(reader.take<uint32_t>());
            EXPECT_LT(ply.faces.back().back(), vertexCount);
        }
    }
    EXPECT_TRUE(reader.atEnd());
    return ply;
}

/// A GLB taken apart.
struct Glb {
    nlohmann::json root;
    std::string binary;

    explicit Glb(const std::filesystem::path& path) {
        const std::string bytes = readText(path);
        ByteReader reader(bytes);
        EXPECT_EQ(reader.take<uint32_t>(), 0x46546C67u) << path;
        EXPECT_EQ(reader.take<uint32_t>(), 2u);
        EXPECT_EQ(reader.take<uint32_t>(), bytes.size());
        const auto length = reader.take<uint32_t>();
        root = nlohmann::json::parse(bytes.substr(20, length));
        binary = bytes.substr(20 + length + 8);
    }
    void write(const std::filesystem::path& path) const {
        std::string text = root.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string bytes;
        const auto word = [&](size_t value) {
            const auto word32 = static_cast<uint32_t>(value);
            bytes.append(reinterpret_cast<const char*>(&word32), sizeof word32);
        };
        word(0x46546C67u);
        word(2);
        word(28 + text.size() + binary.size());
        word(text.size());
        word(0x4E4F534Au);
        bytes += text;
        word(binary.size());
        word(0x004E4942u);
        writeText(path, bytes + binary);
    }

    [[nodiscard]] const nlohmann::json& accessor(const nlohmann::json& index) const {
        return root["accessors"][index.get<size_t>()];
    }
    [[nodiscard]] std::string viewBytes(const nlohmann::json& index) const {
        const nlohmann::json& view = root["bufferViews"][index.get<size_t>()];
        return binary.substr(view.value("byteOffset", size_t{0}), view["byteLength"].get<size_t>());
    }
    /// Elements of an accessor that has its bufferView to itself.
    template <class T>
    [[nodiscard]] std::vector<T> values(const nlohmann::json& index) const {
        const std::string bytes = viewBytes(accessor(index)["bufferView"]);
        std::vector<T> list(accessor(index)["count"].get<size_t>());
        EXPECT_EQ(bytes.size(), list.size() * sizeof(T));
        std::memcpy(list.data(), bytes.data(), std::min(bytes.size(), list.size() * sizeof(T)));
        return list;
    }
    [[nodiscard]] std::vector<uint32_t> indices(const nlohmann::json& primitive) const {
        const nlohmann::json& index = primitive["indices"];
        if (accessor(index)["componentType"] == 5125) {
            return values<uint32_t>(index);
        }
        EXPECT_EQ(accessor(index)["componentType"], 5123);
        const std::vector<uint16_t> list = values<uint16_t>(index);
        return {list.begin(), list.end()};
    }
};

} // namespace supple::test
