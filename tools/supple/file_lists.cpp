#include "tools/supple/file_browser.h"

#include "base/utf8_path.h"
#include "host/operating_system.h"
#include "host/whole_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>

namespace supple::tools {

namespace {

namespace fs = std::filesystem;
constexpr size_t kRecentFiles = 12;

} // namespace

bool isCharacterFile(const fs::path& path) {
    std::string extension = utf8Text(path.extension());
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".glb" || extension == ".gltf" || extension == ".vrm" || extension == ".obj";
}

Folder readFolder(const fs::path& path) {
    std::error_code fault;
    Folder folder{fs::weakly_canonical(path, fault), {}, {}, {}};
    if (fault)
        folder.path = path;
    fs::directory_iterator entry(path, fault);
    for (; !fault && entry != fs::directory_iterator(); entry.increment(fault)) {
        const std::string name = utf8Text(entry->path().filename());
        std::error_code unknown; // a link that leads nowhere is neither
        if (name.starts_with('.'))
            continue;
        if (entry->is_directory(unknown))
            folder.folders.push_back(name);
        else if (isCharacterFile(entry->path()) && entry->is_regular_file(unknown))
            folder.files.push_back(name);
    }
    if (fault)
        folder.fault = utf8Text(folder.path) + ": " + fault.message();
    std::sort(folder.folders.begin(), folder.folders.end());
    std::sort(folder.files.begin(), folder.files.end());
    return folder;
}

fs::path recentFilesPath() {
    const fs::path state = host::stateFolder();
    return state.empty() ? fs::path() : state / "supple" / "recent";
}

std::vector<std::string> readRecentFiles(const fs::path& list) {
    std::vector<std::string> files;
    std::ifstream in(list);
    for (std::string line; files.size() < kRecentFiles && std::getline(in, line);) {
        std::error_code unknown;
        if (fs::is_regular_file(utf8Path(line), unknown))
            files.push_back(line);
    }
    return files;
}

void rememberFile(const fs::path& list, const std::string& file) {
    if (list.empty())
        return;
    std::error_code fault;
    const std::string path = utf8Text(fs::absolute(utf8Path(file), fault).lexically_normal());
    if (fault || path.find('\n') != std::string::npos)
        return;
    std::vector<std::string> files = readRecentFiles(list);
    std::erase(files, path);
    files.insert(files.begin(), path);
    fs::create_directories(list.parent_path(), fault);
    std::string lines;
    for (size_t i = 0; i < std::min(files.size(), kRecentFiles); ++i)
        lines += files[i] + '\n';
    // Nothing depends on the list: if it cannot be written, the old one stays.
    [[maybe_unused]] const Status written = host::writeWhole(utf8Text(list), std::as_bytes(std::span(lines)));
}

} // namespace supple::tools
