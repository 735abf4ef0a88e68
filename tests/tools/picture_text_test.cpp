// Labels of pictures: names in files are in any language, and some are no text at all.
#include "host/fallback_fonts.h"
#include "host/picture.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace supple::host {
namespace {

Picture drawn(const std::string& text) {
    Picture picture = Picture::blank(120, 20);
    picture.drawText(4, 4, text, 1, {255, 255, 255});
    return picture;
}

TEST(PictureText, HasQuestionMarksForWhatNoFontHas) {
    EXPECT_EQ(drawn("a\xF4\x8F\xBF\xBD"
                    "b")
                  .rgba,
              drawn("a?b").rgba); // U+10FFFD, of a private plane
    EXPECT_EQ(drawn("\x7F\x01\n").rgba, drawn("???").rgba);
    EXPECT_NE(drawn("a?b").rgba, drawn("ab").rgba);
}

TEST(PictureText, EndsAtThePicturesBorder) {
    Picture picture = Picture::blank(7, 5);
    picture.drawText(3, 2, "long names \xD0\xB6", 3, {255, 255, 255});
    picture.drawText(90, 90, "long names \xD0\xB6", 3, {255, 255, 255});
    EXPECT_GT(std::count(picture.rgba.begin(), picture.rgba.end(), 255), 7 * 5); // more than alpha
}

TEST(PictureText, TakesLettersFromTheSystemsFonts) {
    const std::string name = "\xD0\xB6\xD1\x83\xD0\xBA"; // three Cyrillic letters
    const std::vector<FallbackFont> fonts = fallbackFonts(charactersBeyondAscii(name));
    if (fonts.empty())
        GTEST_SKIP() << "no font of the system has Cyrillic letters";
    EXPECT_NE(drawn(name).rgba, drawn("???").rgba);
    EXPECT_NE(drawn(name).rgba, drawn("").rgba);
    // What follows stands behind them.
    const Picture both = drawn(name + "x");
    const Picture alone = drawn(name);
    size_t first = 120;
    for (size_t pixel = 0; pixel < both.rgba.size() / 4; ++pixel) {
        if (both.rgba[4 * pixel] != alone.rgba[4 * pixel])
            first = std::min(first, pixel % 120);
    }
    EXPECT_GT(first, 4u + 12u);
    EXPECT_LT(first, 4u + 36u);
}

TEST(PictureText, LooksForEachCharacterOnce) {
    EXPECT_EQ(charactersBeyondAscii("z\xD0\xB6"
                                    "a\xC3\xBC\xD0\xB6"),
              (std::u32string{0xFC, 0x436}));
    EXPECT_EQ(charactersBeyondAscii("\xFF"), (std::u32string{0xFFFD}));
    std::u32string found;
    for (const FallbackFont& font : fallbackFonts({0xFC, 0x436, 0x10FFFD}))
        found += font.characters;
    std::sort(found.begin(), found.end());
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
    EXPECT_EQ(std::count(found.begin(), found.end(), char32_t{0x10FFFD}), 0);
}

} // namespace
} // namespace supple::host
