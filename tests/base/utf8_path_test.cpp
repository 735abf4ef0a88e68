#include "base/utf8_path.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

namespace supple {
namespace {

TEST(Utf8Path, NamesComeOutAsTheyWentIn) {
    for (const char* name : {"", "a.glb", "H\xC3\xA9l\xC3\xA8ne \xE5\xAD\x97 \xF0\x9F\x98\x80.glb", "a/../b"}) {
        EXPECT_EQ(utf8Text(utf8Path(name)), name);
    }
    EXPECT_EQ(utf8Text(utf8Path("\xC3\xBC/\xE5\xAD\x97.tar.gz").stem()), "\xE5\xAD\x97.tar");
}

TEST(Utf8Path, NamesTheFile) {
    const std::string name = "supple_utf8_\xC3\xBC\xE5\xAD\x97.txt";
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / utf8Path(name);
    std::ofstream(path, std::ios::binary) << "text";
    size_t found = 0;
    for (const auto& entry : std::filesystem::directory_iterator(testing::TempDir()))
        found += utf8Text(entry.path().filename()) == name ? 1 : 0;
    EXPECT_EQ(found, 1u);
    EXPECT_TRUE(std::filesystem::remove(path));
}

} // namespace
} // namespace supple
