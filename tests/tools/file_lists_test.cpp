// What the viewer's browser lists: folders, character files, the files that were opened last.
#include "tools/supple/file_browser.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace supple::tools {
namespace {

namespace fs = std::filesystem;

class FileListsTest : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) / ("supple_file_lists_" + std::to_string(getpid()));
        fs::create_directories(folder_ / "sub");
        fs::create_directories(folder_ / ".hidden");
        for (const char* name : {"b.GLB", "a.gltf", "c.obj", "e.vrm", "notes.txt", ".d.glb"})
            std::ofstream(folder_ / name) << "x";
        fs::create_symlink(folder_ / "nowhere.glb", folder_ / "dangling.glb");
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path folder_;
};

TEST_F(FileListsTest, AFolderShowsFoldersAndCharacters) {
    const Folder folder = readFolder(folder_);
    EXPECT_EQ(folder.fault, "");
    EXPECT_EQ(folder.folders, std::vector<std::string>{"sub"});
    EXPECT_EQ(folder.files, (std::vector<std::string>{"a.gltf", "b.GLB", "c.obj", "e.vrm"}));
    const Folder gone = readFolder(folder_ / "gone");
    EXPECT_TRUE(gone.files.empty());
    EXPECT_NE(gone.fault.find("gone: No such file"), std::string::npos) << gone.fault;
}

TEST_F(FileListsTest, TheLatestFileComesFirstAndGoneOnesAreLeftOut) {
    const fs::path list = folder_ / "state" / "recent";
    EXPECT_TRUE(readRecentFiles(list).empty());
    const std::string a = (folder_ / "a.gltf").string(), b = (folder_ / "b.GLB").string();
    rememberFile(list, a);
    rememberFile(list, b);
    EXPECT_EQ(readRecentFiles(list), (std::vector<std::string>{b, a}));
    rememberFile(list, (folder_ / "sub" / ".." / "a.gltf").string());
    EXPECT_EQ(readRecentFiles(list), (std::vector<std::string>{a, b})) << "the same file, once";
    fs::remove(a);
    EXPECT_EQ(readRecentFiles(list), std::vector<std::string>{b});
    rememberFile({}, b); // no place for a list: nothing happens
    for (int i = 0; i < 30; ++i) {
        const fs::path file = folder_ / (std::to_string(i) + ".obj");
        std::ofstream(file) << "x";
        rememberFile(list, file.string());
    }
    EXPECT_EQ(readRecentFiles(list).size(), 12u);
    EXPECT_EQ(readRecentFiles(list).front(), (folder_ / "29.obj").string());
}

} // namespace
} // namespace supple::tools
