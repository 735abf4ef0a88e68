// The file is a whole picture of all rows so far, whatever they hold.
#include "host/png_writer.h"

#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <random>
#include <unistd.h>

namespace supple::host {
namespace {

class PngWriterTest : public testing::Test {
protected:
    void TearDown() override { std::remove(path_.c_str()); }
    std::string path_ =
        (std::filesystem::temp_directory_path() / ("supple_png_" + std::to_string(getpid()) + ".png")).string();
};

TEST_F(PngWriterTest, IsAWholePictureAfterEveryAppend) {
    std::mt19937 random(5);
    for (const uint32_t width : {1u, 7u, 300u}) {
        PngWriter writer(path_, width);
        Picture whole{width, 0, {}};
        // Noise, one color, long repeats, gradients; bands of one row, of many and of none.
        for (const uint32_t rows : {1u, 130u, 2u, 0u, 3u, 65u}) {
            Picture band = Picture::blank(width, rows);
            for (uint32_t y = 0; y < rows; ++y) {
                for (uint32_t x = 0; x < width; ++x) {
                    uint8_t* pixel = band.pixel(x, y);
                    for (int c = 0; c < 3; ++c) {
                        const uint32_t value = rows == 2     ? random()
                                               : rows == 3   ? 200u
                                               : rows == 130 ? y / 11 * 40 + x % 13
                                                             : x + 2 * y + 30 * static_cast<uint32_t>(c);
                        pixel[c] = static_cast<uint8_t>(value);
                    }
                }
            }
            ASSERT_TRUE(writer.append(band).ok());
            whole.height += rows;
            whole.rgba.insert(whole.rgba.end(), band.rgba.begin(), band.rgba.end());
            const Result<Picture> read = readPng(path_);
            ASSERT_TRUE(read.ok()) << read.error().message;
            EXPECT_EQ(read->width, width);
            EXPECT_EQ(read->height, whole.height);
            EXPECT_TRUE(read->rgba == whole.rgba) << width << " x " << whole.height;
        }
    }
}

TEST_F(PngWriterTest, CompressesWhatRepeats) {
    Picture flat = Picture::blank(2000, 1000);
    PngWriter writer(path_, 2000);
    ASSERT_TRUE(writer.append(flat).ok());
    EXPECT_LT(std::filesystem::file_size(path_), 100'000u) << "of 6,000,000";
}

TEST_F(PngWriterTest, SaysWhatItCannotWrite) {
    PngWriter nowhere("/nowhere/a.png", 4);
    const Status status = nowhere.append(Picture::blank(4, 1));
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().message, "/nowhere/a.png: No such file or directory");
    PngWriter narrow(path_, 3);
    EXPECT_FALSE(narrow.append(Picture::blank(4, 1)).ok());
}

} // namespace
} // namespace supple::host
