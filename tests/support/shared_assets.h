// Assets that lie beside the checkout on some machines. Where they are absent a test says how many cases it left out.
#pragma once

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace supple::test {

/// The folder of the shared assets, "/" at its end, whether it is there or not.
inline std::string sharedFolder() {
    return std::string(SUPPLE_SHARED_DIR) + "/assets/";
}

/// The paths below the shared folder that exist; prints how many of `names` were left out otherwise.
inline std::vector<std::string> sharedAssets(const std::vector<std::string>& names) {
    std::vector<std::string> present;
    for (const std::string& name : names) {
        const std::string path = sharedFolder() + name;
        if (std::filesystem::exists(path)) {
            present.push_back(path);
        }
    }
    if (present.size() < names.size()) {
        std::printf("%zu shared-asset cases left out: not in %s\n", names.size() - present.size(),
                    sharedFolder().c_str());
    }
    return present;
}

/// The characters all of whose faces are quads, and the demo character, which is always there.
inline std::vector<std::string> allQuadCharacters() {
    std::vector<std::string> paths = sharedAssets(
        {"characters/man_casual_quads.glb", "characters/mh_female1605.glb", "characters/mh_female1605_morph.glb",
         "characters/mh_body_13k_infl8.glb", "characters/mh_proxy741.glb", "characters/pawn_creased.glb"});
    paths.insert(paths.begin(), std::string(SUPPLE_SAMPLE_ASSETS) + "/pip_quads.glb");
    return paths;
}

/// Every file in and below a folder whose name ends as one of `endings` says (".glb"), sorted; none where the folder is
/// absent.
inline std::vector<std::string> filesBelow(const std::filesystem::path& folder,
                                           const std::vector<std::string>& endings) {
    std::vector<std::string> paths;
    std::error_code absent;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, absent)) {
        if (std::find(endings.begin(), endings.end(), entry.path().extension().string()) != endings.end()) {
            paths.push_back(entry.path().string());
        }
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

/// The shared characters and the repository's own, which are always there.
inline std::vector<std::string> allCharacters() {
    const std::string folder = sharedFolder() + "characters";
    std::vector<std::string> paths = filesBelow(folder, {".glb"});
    if (paths.empty()) {
        std::printf("all shared characters left out: %s is not present\n", folder.c_str());
    }
    const std::vector<std::string> own = filesBelow(SUPPLE_SAMPLE_ASSETS, {".glb"});
    paths.insert(paths.begin(), own.begin(), own.end());
    return paths;
}

inline bool isOwnCharacter(const std::string& path) {
    return path.starts_with(SUPPLE_SAMPLE_ASSETS);
}

/// The repository's own, and every `step`th of the shared characters, from one on: for tests that take long with each.
inline std::vector<std::string> sampledCharacters(size_t step, size_t first = 0) {
    std::vector<std::string> sampled;
    size_t shared = 0;
    for (const std::string& path : allCharacters()) {
        if (isOwnCharacter(path) || shared++ % step == first % step) {
            sampled.push_back(path);
        }
    }
    return sampled;
}

} // namespace supple::test
