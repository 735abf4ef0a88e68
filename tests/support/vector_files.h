// The files of stored vectors by name: what tests are called after them must not have to read them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace supple::test {

/// The .json files in a folder of tests/data, by name.
inline std::vector<std::filesystem::path> vectorFiles(const std::string& folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(SUPPLE_TEST_DATA "/" + folder)) {
        if (entry.path().extension() == ".json") {
            paths.push_back(entry.path());
        }
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

} // namespace supple::test
