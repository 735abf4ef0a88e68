#include "tests/tools/looked_at_pictures.h"

#include "host/whole_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio> // jpeglib.h needs it
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

#include <jpeglib.h>

namespace supple::test {

namespace {

constexpr int kQuality = 82;
/// Steps of 8 bits of one channel from which on a blurred pixel is seen to have changed.
constexpr float kSeen = 20.0f;

/// Three channels, blurred by the binomial kernel of five by five.
std::vector<float> blurred(const host::Picture& picture) {
    constexpr std::array<float, 5> kKernel = {1.0f / 16, 4.0f / 16, 6.0f / 16, 4.0f / 16, 1.0f / 16};
    const auto width = static_cast<int>(picture.width);
    const auto height = static_cast<int>(picture.height);
    std::vector<float> rows(size_t{picture.width} * picture.height * 3);
    std::vector<float> all(rows.size());
    const auto at = [&](int x, int y, int channel) { return (static_cast<size_t>(y) * width + x) * 3 + channel; };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int k = 0; k < 5; ++k) {
                const auto from = static_cast<uint32_t>(std::clamp(x + k - 2, 0, width - 1));
                for (int channel = 0; channel < 3; ++channel)
                    rows[at(x, y, channel)] +=
                        kKernel[k] * static_cast<float>(picture.pixel(from, static_cast<uint32_t>(y))[channel]);
            }
        }
    }
    for (int y = 0; y < height; ++y) {
        for (int k = 0; k < 5; ++k) {
            const int from = std::clamp(y + k - 2, 0, height - 1);
            for (int i = 0; i < width * 3; ++i)
                all[at(0, y, 0) + i] += kKernel[k] * rows[at(0, from, 0) + i];
        }
    }
    return all;
}

} // namespace

PictureDifference differenceOf(const host::Picture& a, const host::Picture& b) {
    const std::vector<float> first = blurred(a);
    const std::vector<float> second = blurred(b);
    double sum = 0.0;
    size_t changed = 0;
    for (size_t i = 0; i < first.size(); i += 3) {
        float most = 0.0f;
        for (size_t channel = 0; channel < 3; ++channel) {
            const float apart = std::abs(first[i + channel] - second[i + channel]);
            sum += apart;
            most = std::max(most, apart);
        }
        changed += most > kSeen ? 1 : 0;
    }
    const auto values = static_cast<double>(first.size());
    return {.changed = static_cast<double>(changed) * 3.0 / values, .mean = sum / values};
}

host::Picture partOf(const host::Picture& picture, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    host::Picture part = host::Picture::blank(width, height);
    for (uint32_t row = 0; row < height; ++row)
        std::copy_n(picture.pixel(x, y + row), size_t{width} * 4, part.pixel(0, row));
    return part;
}

Result<host::Picture> readJpeg(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    return host::decodePicture(std::as_bytes(std::span(text)), path);
}

Status writeJpeg(const host::Picture& picture, const std::string& path) {
    jpeg_error_mgr errors{};
    jpeg_compress_struct writer{};
    writer.err = jpeg_std_error(&errors); // ends the program if memory runs out
    jpeg_create_compress(&writer);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&writer, &bytes, &size);
    writer.image_width = picture.width;
    writer.image_height = picture.height;
    writer.input_components = 3;
    writer.in_color_space = JCS_RGB;
    jpeg_set_defaults(&writer);
    jpeg_set_quality(&writer, kQuality, TRUE);
    writer.optimize_coding = TRUE;
    writer.comp_info[0].h_samp_factor = writer.comp_info[0].v_samp_factor = 1; // thin lines keep their colors
    jpeg_start_compress(&writer, TRUE);
    std::vector<JSAMPLE> row(size_t{picture.width} * 3);
    for (uint32_t y = 0; y < picture.height; ++y) {
        for (uint32_t x = 0; x < picture.width; ++x)
            std::copy_n(picture.pixel(x, y), 3, &row[size_t{x} * 3]);
        JSAMPROW rows[] = {row.data()};
        jpeg_write_scanlines(&writer, rows, 1);
    }
    jpeg_finish_compress(&writer);
    const Status written = host::writeWhole(path, std::as_bytes(std::span(bytes, size)));
    jpeg_destroy_compress(&writer);
    std::free(bytes);
    return written;
}

} // namespace supple::test
