// Pictures that are written band by band: what is read back, and what is refused.
#include "host/png_writer.h"

#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <random>
#include <unistd.h>

namespace supple::host {
namespace {

namespace fs = std::filesystem;

class PngWriterTest : public testing::Test {
protected:
    void TearDown() override { std::remove(path_.c_str()); }
    std::string path_ = (fs::temp_directory_path() / ("supple_png_" + std::to_string(getpid()) + ".png")).string();
};

/// Noise, one color, long repeats or gradients, by the number of rows.
Picture band(uint32_t width, uint32_t rows, std::mt19937& random) {
    Picture picture = Picture::blank(width, rows);
    for (uint32_t y = 0; y < rows; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            for (uint32_t c = 0; c < 3; ++c) {
                const uint32_t value = rows == 2     ? static_cast<uint32_t>(random())
                                       : rows == 3   ? 200u
                                       : rows == 130 ? y / 11 * 40 + x % 13
                                                     : x + 2 * y + 30 * c;
                picture.pixel(x, y)[c] = static_cast<uint8_t>(value);
            }
            picture.pixel(x, y)[3] = static_cast<uint8_t>(7 * x + y);
        }
    }
    return picture;
}

TEST_F(PngWriterTest, BandsAreOnePicture) {
    std::mt19937 random(5);
    constexpr uint32_t kBands[] = {1, 130, 2, 0, 3, 65};
    for (const PngAlpha alpha : {PngAlpha::leftOut, PngAlpha::kept}) {
        for (const uint32_t width : {1u, 7u, 300u}) {
            Picture whole{width, 0, {}};
            PngWriter writer(path_, width, 201, alpha);
            for (const uint32_t rows : kBands) {
                const Picture part = band(width, rows, random);
                ASSERT_TRUE(writer.append(part).ok());
                whole.height += rows;
                whole.rgba.insert(whole.rgba.end(), part.rgba.begin(), part.rgba.end());
            }
            ASSERT_TRUE(writer.close().ok());
            for (size_t i = 3; alpha == PngAlpha::leftOut && i < whole.rgba.size(); i += 4) {
                whole.rgba[i] = 255;
            }
            const Result<Picture> read = readPng(path_);
            ASSERT_TRUE(read.ok()) << read.error().message;
            EXPECT_EQ(read->width, width);
            EXPECT_EQ(read->height, 201u);
            EXPECT_TRUE(read->rgba == whole.rgba) << width;
        }
    }
}

TEST_F(PngWriterTest, CompressesWhatRepeats) {
    const Picture flat = Picture::blank(2000, 1000);
    ASSERT_TRUE(writePng(flat, path_).ok());
    EXPECT_LT(fs::file_size(path_), 100'000u) << "of 8,000,000";
}

TEST_F(PngWriterTest, TheFileIsThereWhenItIsClosed) {
    {
        PngWriter writer(path_, 4, 2, PngAlpha::leftOut);
        ASSERT_TRUE(writer.append(Picture::blank(4, 1)).ok());
        const Status early = writer.close();
        ASSERT_FALSE(early.ok());
        EXPECT_EQ(early.error().message, path_ + ": rows are missing");
        EXPECT_FALSE(fs::exists(path_));
    }
    EXPECT_FALSE(fs::exists(path_));
    for (const auto& entry : fs::directory_iterator(fs::temp_directory_path())) {
        EXPECT_FALSE(entry.path().string().starts_with(path_)) << entry.path();
    }
}

TEST_F(PngWriterTest, SaysWhatItCannotWrite) {
    PngWriter nowhere("/nowhere/a.png", 4, 1, PngAlpha::leftOut);
    const Status status = nowhere.append(Picture::blank(4, 1));
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().message, "/nowhere/a.png: cannot be written: No such file or directory");
    PngWriter narrow(path_, 3, 1, PngAlpha::leftOut);
    EXPECT_FALSE(narrow.append(Picture::blank(4, 1)).ok());
    PngWriter low(path_, 4, 1, PngAlpha::leftOut);
    EXPECT_FALSE(low.append(Picture::blank(4, 2)).ok());
    EXPECT_FALSE(writePng(Picture{}, path_).ok()) << "a picture without pixels";
}

} // namespace
} // namespace supple::host
