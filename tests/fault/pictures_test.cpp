// Pictures that nobody vetted.
#include "host/picture.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <span>
#include <string>
#include <vector>

namespace supple::test {
namespace {

std::vector<std::byte> bytesOf(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

std::string refusalOf(const std::string& bytes) {
    const Result<host::Picture> picture = host::decodePicture(bytesOf(bytes), "p");
    return picture ? "decoded" : picture.error().message;
}

std::string big(uint32_t value) {
    return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
            static_cast<char>(value)};
}

uint32_t crcOf(const std::string& text) {
    uint32_t crc = 0xFFFFFFFFu;
    for (const char c : text) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) {
            crc = crc >> 1 ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
        }
    }
    return ~crc;
}

std::string pngOf(uint32_t width, uint32_t height) {
    const std::string header = "IHDR" + big(width) + big(height) + std::string("\x08\x06\x00\x00\x00", 5);
    return "\x89PNG\r\n\x1A\n" + big(13) + header + big(crcOf(header)) + big(0) + "IDAT" + big(crcOf("IDAT"));
}

TEST(Pictures, AHuffmanTableOfTooManyCodesIsRefused) {
    // 16 lengths of 255 codes each: stb_image 2.27 writes them all into a table of 256.
    const std::string table = std::string("\x00", 1) + std::string(16, '\xFF') + std::string(4080, '\x01');
    const std::string length = {static_cast<char>((table.size() + 2) >> 8), static_cast<char>(table.size() + 2)};
    const std::string refusal = refusalOf("\xFF\xD8\xFF\xC4" + length + table + std::string(64, '\0'));
    EXPECT_EQ(refusal, "p: Bogus Huffman table definition");
}

TEST(Pictures, AreasBeyondTheLimitAreRefusedByTheirHeader) {
    EXPECT_EQ(refusalOf(pngOf(16384, 16384)), "p: more than 67108864 pixels");
    EXPECT_EQ(refusalOf(pngOf(1u << 26, 2)), "p: more than 67108864 pixels");
    EXPECT_EQ(refusalOf(pngOf(0, 0)).substr(0, 3), "p: ");
    const std::string frame("\xFF\xD8\xFF\xC0\x00\x11\x08\xFF\xFF\xFF\xFF\x03\x01\x11\x00\x02\x11\x01\x03\x11\x01", 21);
    const std::string scan("\xFF\xDA\x00\x0C\x03\x01\x00\x02\x11\x03\x11\x00\x3F\x00", 14);
    EXPECT_EQ(refusalOf(frame + scan + std::string(64, '\0')).substr(0, 3), "p: ");
}

TEST(Pictures, WhatIsCutOffOrNoPictureIsRefused) {
    EXPECT_EQ(refusalOf(pngOf(4, 4)), "p: truncated");
    EXPECT_EQ(refusalOf("GIF89a"), "p: not a PNG, JPEG, WebP or KTX2");
    EXPECT_EQ(refusalOf(""), "p: not a PNG, JPEG, WebP or KTX2");
    EXPECT_NE(refusalOf("\xFF\xD8\xFF"), "decoded");
}

/// Two pixels, lossless: red, and half covered blue.
const std::string kTwoPixels("RIFF\x20\x00\x00\x00WEBPVP8L\x14\x00\x00\x00\x2F\x01\x00\x00\x10\x0F\x30\x40\xFB\x3F\xFF"
                             "\x0F\xFC\x0F\x2D\x54\x20\xA2\xFF\x01",
                             40);

TEST(Pictures, WebP) {
    const Result<host::Picture> picture = host::decodePicture(bytesOf(kTwoPixels), "p");
    if (!picture && picture.error().message.find("built without libwebp") != std::string::npos) {
        GTEST_SKIP() << "left out: built without libwebp";
    }
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    EXPECT_EQ(picture->width, 2u);
    EXPECT_EQ(picture->height, 1u);
    EXPECT_EQ(picture->rgba, (std::vector<uint8_t>{255, 0, 0, 255, 0, 64, 255, 128}));
    EXPECT_EQ(refusalOf(kTwoPixels.substr(0, 30)), "p: damaged");
    EXPECT_EQ(refusalOf(kTwoPixels.substr(0, 12)), "p: damaged");
    std::string large = kTwoPixels; // 14 bits each, less one
    large.replace(21, 4, "\xFF\xFF\xFF\x1F");
    EXPECT_EQ(refusalOf(large), "p: more than 67108864 pixels");
    // An extended header whose flags say that it moves.
    const std::string moving("RIFF\x16\x00\x00\x00WEBPVP8X\x0A\x00\x00\x00\x02\x00\x00\x00\x01\x00\x00\x00\x00\x00",
                             30);
    EXPECT_EQ(refusalOf(moving), "p: an animated WebP");
}

struct Ktx2File {
    std::string name;
    bool hasAlpha;
    int tolerance; ///< ETC1S has five bits a channel, and steps of brightness
};
const Ktx2File kKtx2Files[] = {{"etc1s", false, 3},
                               {"etc1s_alpha", true, 3},
                               {"uastc_alpha", true, 0},
                               {"uastc_zstd", false, 0},
                               {"uastc_zstd_alpha", true, 0}};

std::string ktx2Bytes(const std::string& name) {
    std::ifstream file(SUPPLE_TEST_DATA "/ktx2/" + name + ".ktx2", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class Ktx2 : public testing::Test {
protected:
    void SetUp() override {
        if (refusalOf(ktx2Bytes("etc1s")).find("built without Basis Universal") != std::string::npos) {
            GTEST_SKIP() << "left out: built without Basis Universal";
        }
    }
    static std::string withWord(std::string bytes, size_t place, uint32_t word) {
        for (size_t i = 0; i < 4; ++i) {
            bytes[place + i] = static_cast<char>(word >> (8 * i));
        }
        return bytes;
    }
};

TEST_F(Ktx2, EveryKindHasItsColors) {
    // Quadrants of 4 x 4 pixels; those without alpha are opaque.
    const uint8_t quadrants[2][2][4] = {{{255, 0, 0, 255}, {0, 255, 0, 255}}, {{0, 0, 255, 255}, {132, 66, 33, 128}}};
    for (const Ktx2File& file : kKtx2Files) {
        SCOPED_TRACE(file.name);
        const Result<host::Picture> picture = host::decodePicture(bytesOf(ktx2Bytes(file.name)), "p");
        ASSERT_TRUE(picture.ok()) << picture.error().message;
        ASSERT_EQ(picture->width, 8u);
        ASSERT_EQ(picture->height, 8u);
        for (uint32_t i = 0; i < 64; ++i) {
            const uint32_t x = i % 8, y = i / 8;
            for (int channel = 0; channel < 4; ++channel) {
                const int wanted = channel == 3 && !file.hasAlpha ? 255 : quadrants[y / 4][x / 4][channel];
                EXPECT_NEAR(picture->pixel(x, y)[channel], wanted, file.tolerance) << x << " " << y << " " << channel;
            }
        }
    }
}

TEST_F(Ktx2, HeadersAreNotBelieved) {
    const std::string etc1s = ktx2Bytes("etc1s"), uastc = ktx2Bytes("uastc_alpha"), zstd = ktx2Bytes("uastc_zstd");
    EXPECT_EQ(refusalOf(withWord(etc1s, 20, 1u << 26)), "p: more than 67108864 pixels");
    EXPECT_EQ(refusalOf(withWord(uastc, 20, 1u << 26)), "p: damaged") << "fewer blocks than that";
    EXPECT_EQ(refusalOf(withWord(zstd, 96, 80)), "p: damaged") << "uncompressed: other than its blocks take";
    EXPECT_EQ(refusalOf(withWord(uastc, 80, 0xBF)), "p: damaged") << "blocks beside words";
    EXPECT_EQ(refusalOf(withWord(etc1s, 20, 0)), "p: damaged");
    EXPECT_EQ(refusalOf(withWord(etc1s, 32, 2)), "p: a KTX2 of more than one picture");
    EXPECT_EQ(refusalOf(withWord(etc1s, 36, 6)), "p: a KTX2 of more than one picture");
    EXPECT_EQ(refusalOf(withWord(uastc, 12, 37)), "p: a KTX2 that is neither ETC1S nor UASTC");
    EXPECT_EQ(refusalOf(withWord(uastc, 44, 3)), "p: a KTX2 that is neither ETC1S nor UASTC");
    EXPECT_EQ(refusalOf(withWord(etc1s, 40, 17)), "p: damaged") << "levels";
    // Offsets so large that one and a length are small again.
    EXPECT_EQ(refusalOf(withWord(etc1s, 48, 0xFFFFFFF0)), "p: damaged");
    for (const size_t place : {64, 80}) { // what all levels have in common; the first level
        EXPECT_EQ(refusalOf(withWord(withWord(etc1s, place, 0xFFFFFFF0), place + 4, 0xFFFFFFFF)), "p: damaged");
    }
}

TEST_F(Ktx2, WhatIsCutOffOrSpoiledIsDecodedOrRefused) {
    for (const Ktx2File& file : kKtx2Files) {
        const std::string bytes = ktx2Bytes(file.name);
        for (size_t size = 12; size < bytes.size(); ++size) {
            EXPECT_EQ(refusalOf(bytes.substr(0, size)), "p: damaged") << file.name << " " << size;
        }
        for (size_t i = 12; i < bytes.size(); ++i) {
            for (const char spoiled : {'\0', '\x55', '\xFF'}) {
                if (i >= 20 && i < 28 && spoiled != '\0') {
                    continue; // a picture of that size
                }
                std::string other = bytes;
                other[i] = spoiled;
                const std::string said = refusalOf(other);
                EXPECT_TRUE(said == "decoded" || said.starts_with("p: ")) << said;
            }
        }
    }
}

} // namespace
} // namespace supple::test
