// What a file's own words may do to a message: nothing.
#include "cage/message.h"
#include "tests/cage/gltf/reading.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace supple::test {
namespace {

TEST(Messages, NamesCannotBreakOrTurnALine) {
    EXPECT_EQ(cage::oneLine("a\nb\tc\x7F"), "a?b?c?");
    EXPECT_EQ(cage::oneLine("gpj.\xE2\x80\xAE"
                            "exe"),
              "gpj.?exe")
        << "U+202E";
    EXPECT_EQ(cage::oneLine("\xC2\x9B[31m"), "?[31m") << "a control character of two bytes";
    EXPECT_EQ(cage::oneLine("a\xE2\x80\x8B\xEF\xBB\xBF"), "a??") << "cannot be seen";
    EXPECT_EQ(cage::oneLine("\xC3\xA4\xE6\xBC\xA2\xF0\x9F\x90\x89"), "\xC3\xA4\xE6\xBC\xA2\xF0\x9F\x90\x89");
    EXPECT_EQ(cage::oneLine("\xC0\xAF\xED\xA0\x80\xF5\x80\xE2\x82"), "?????????") << "no UTF-8";
    EXPECT_EQ(cage::oneLine("a\nb", ' '), "a b");
}

TEST(Messages, LinesOfOneKindAreCounted) {
    std::vector<std::string> lines;
    for (int i = 0; i < 60000; ++i) {
        lines.push_back("image " + std::to_string(i) + " uri: \"" + std::to_string(i) +
                        ".png\": no such file; left out");
    }
    lines.insert(lines.begin() + 3, "mesh 0: 1 vertex has no face; left out");
    const std::vector<std::string> told = cage::readableLines(lines);
    ASSERT_EQ(told.size(), 2u);
    EXPECT_EQ(told[0], "image 0 uri: \"0.png\": no such file; left out (and 59999 lines like this one)");
    EXPECT_EQ(told[1], lines[3]);
    EXPECT_EQ(cage::readableLines({"a 1", "a 2"}), (std::vector<std::string>{"a 1", "a 2"}));
    std::vector<std::string> kinds;
    for (int i = 0; i < 1000; ++i) {
        kinds.push_back(std::string(static_cast<size_t>(i) + 1, 'x'));
    }
    ASSERT_EQ(cage::readableLines(kinds).size(), cage::kMostLines + 1);
    EXPECT_EQ(cage::readableLines(kinds).back(), "file: 744 more lines of warnings");
    EXPECT_EQ(cage::readableLines({std::string(100000, 'x')})[0].size(), cage::kLongestLine + 3);
}

TEST(Messages, AFileCannotFillTheLog) {
    GltfBuilder b = plainMesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
    std::string images;
    for (int i = 0; i < 1000; ++i) {
        images += (i == 0 ? R"({"uri":")" : R"(,{"uri":")") + std::to_string(i) + R"(.png"})";
    }
    b.more = R"(,"images":[)" + images + "]";
    const cage::Character character = readWell(b);
    ASSERT_EQ(character.warnings.size(), 1u);
    EXPECT_TRUE(character.warnings[0].ends_with("; left out (and 999 lines like this one)")) << character.warnings[0];
}

TEST(Messages, HostsAreAskedForPlainPaths) {
    std::vector<std::string> asked;
    cage::GltfOptions options;
    options.readFile = [&](const std::string& path) -> Result<std::vector<std::byte>> {
        asked.push_back(path);
        return Error{ErrorCode::io, "no"};
    };
    const auto warningOf = [&](const std::string& uri) {
        GltfBuilder b = plainMesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
        b.more = R"(,"images":[{"uri":")" + uri + R"("}])";
        return readWell(b, options).warnings.at(0);
    };
    for (const char* uri : {"a/b.png", "./a/b.png", "a/./b.png", "a//b.png", "a/b.png/", "%2e/a%2Fb.png"}) {
        asked.clear();
        warningOf(uri);
        EXPECT_EQ(asked, std::vector<std::string>{"a/b.png"}) << uri;
    }
    asked.clear();
    EXPECT_NE(warningOf("a%0Ab.png").find("path contains a control character"), std::string::npos);
    EXPECT_NE(warningOf("a%7fb.png").find("path contains a control character"), std::string::npos);
    EXPECT_NE(warningOf("a/%2e%2E/b.png").find("path leaves the asset's folder"), std::string::npos);
    EXPECT_NE(warningOf("./").find("empty path"), std::string::npos);
    EXPECT_NE(warningOf("a%FFb.png").find("path is not UTF-8"), std::string::npos);
    EXPECT_TRUE(asked.empty());
    warningOf("%C3%BC/\xE5\xAD\x97.png");
    EXPECT_EQ(asked, std::vector<std::string>{"\xC3\xBC/\xE5\xAD\x97.png"});
}

} // namespace
} // namespace supple::test
