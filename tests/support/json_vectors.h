// Reading stored vectors: what the files of tests/data have in common.
#pragma once

#include "tests/support/vector_files.h"

#include <fstream>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace supple::test {

inline glm::dvec3 jsonVector(const nlohmann::json& j) {
    return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

inline std::vector<glm::dvec3> jsonVectors(const nlohmann::json& j) {
    std::vector<glm::dvec3> result;
    for (const nlohmann::json& v : j) {
        result.push_back(jsonVector(v));
    }
    return result;
}

inline nlohmann::json parseFile(const std::filesystem::path& path) {
    std::ifstream file(path);
    return nlohmann::json::parse(file);
}

/// What `read` makes of every .json file in a folder of tests/data, and of its name.
template <class Read>
auto readJsonFolder(const std::string& folder, Read&& read) {
    std::vector<decltype(read(nlohmann::json(), std::string()))> all;
    for (const std::filesystem::path& path : vectorFiles(folder)) {
        all.push_back(read(parseFile(path), path.stem().string()));
    }
    return all;
}

} // namespace supple::test
