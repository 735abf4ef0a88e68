// The viewer's window of folders and files, and the files that were opened last.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace supple::tools {

/// Whether the viewer opens a file of this name: glTF, GLB, OBJ.
[[nodiscard]] bool isCharacterFile(const std::filesystem::path& path);

/// What the browser shows of a folder: visible folders, then the files that isCharacterFile() knows, each by name.
struct Folder {
    std::filesystem::path path;
    std::vector<std::string> folders;
    std::vector<std::string> files;
    std::string fault; ///< why it cannot be read; else empty
};
[[nodiscard]] Folder readFolder(const std::filesystem::path& path);

/// Of the user: "supple/recent" in $XDG_STATE_HOME, or in ~/.local/state; empty where neither is known.
[[nodiscard]] std::filesystem::path recentFilesPath();
/// One path a line, the latest first. Files that are gone are left out.
[[nodiscard]] std::vector<std::string> readRecentFiles(const std::filesystem::path& list);
/// Puts a file in front. A list that cannot be written stays as it is: nothing depends on it.
void rememberFile(const std::filesystem::path& list, const std::string& file);

/// The window. Builds ImGui's; the file that was chosen, if one was.
class FileBrowser {
public:
    bool open = false;
    void enter(const std::filesystem::path& folder) { folder_ = readFolder(folder); }
    [[nodiscard]] const Folder& folder() const { return folder_; }
    [[nodiscard]] std::optional<std::string> build(const std::vector<std::string>& recent);

private:
    Folder folder_;
};

} // namespace supple::tools
