// An OBJ as supple bake writes it, read without Supple's reader.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

namespace supple::test {

struct Obj {
    std::vector<glm::vec3> v, vn;
    std::vector<glm::vec2> vt;
    std::vector<std::vector<uint32_t>> faces; ///< vertices, from 0
    std::vector<std::string> groups;
    std::vector<size_t> groupVertices, groupFaces; ///< how many came before each group
    std::vector<std::string> vLines;
};

inline Obj readObj(const std::filesystem::path& path) {
    Obj obj;
    std::ifstream stream(path);
    for (std::string line; std::getline(stream, line);) {
        std::istringstream words(line);
        std::string keyword;
        words >> keyword;
        glm::vec3 value{};
        if (keyword == "v") {
            words >> value.x >> value.y >> value.z;
            obj.v.push_back(value);
            obj.vLines.push_back(line);
        } else if (keyword == "vn") {
            words >> value.x >> value.y >> value.z;
            obj.vn.push_back(value);
        } else if (keyword == "vt") {
            words >> value.x >> value.y;
            obj.vt.emplace_back(value.x, value.y);
        } else if (keyword == "g") {
            obj.groups.emplace_back();
            words >> obj.groups.back();
            obj.groupVertices.push_back(obj.v.size());
            obj.groupFaces.push_back(obj.faces.size());
        } else if (keyword == "f") {
            obj.faces.emplace_back();
            for (std::string corner; words >> corner;) {
                obj.faces.back().push_back(static_cast<uint32_t>(std::stoul(corner)) - 1);
            }
        } else {
            EXPECT_EQ(keyword, "#") << line;
        }
        EXPECT_FALSE(words.bad()) << line;
    }
    return obj;
}

} // namespace supple::test
