// Reading stored vectors: what the files of tests/data have in common.
#pragma once

#include <algorithm>
#include <filesystem>
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

/// What `read` makes of every .json file in a folder of tests/data, by name.
template <class Read>
auto readJsonFolder(const std::string& folder, Read&& read) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(SUPPLE_TEST_DATA "/" + folder)) {
        if (entry.path().extension() == ".json") {
            paths.push_back(entry.path());
        }
    }
    std::sort(paths.begin(), paths.end());
    std::vector<decltype(read(paths.front()))> all;
    for (const auto& path : paths) {
        all.push_back(read(path));
    }
    return all;
}

} // namespace supple::test
