// PNG and JPEG into pictures, by libpng and libjpeg. The bytes may be anybody's: the header is believed only as far as
// its area, and nothing of C++ is on the stack where these jump over it.
#include "host/ktx2_decoder.h"
#include "host/picture.h"
#include "host/webp_decoder.h"

#include <csetjmp>
#include <cstdio>
#include <cstring>

#include <jerror.h>
#include <jpeglib.h>
#include <png.h>

namespace supple::host {
namespace {

constexpr uint64_t kMaxPixels = uint64_t{1} << 26;
/// A progressive JPEG may have thousands of scans of a large picture, each a few bytes.
constexpr int kMostScans = 100;

/// What the libraries' callbacks share with their caller.
struct Decoding {
    const uint8_t* data = nullptr;
    size_t size = 0;
    size_t read = 0;
    uint32_t width = 0, height = 0;
    char fault[JMSG_LENGTH_MAX] = "";
    std::jmp_buf back;
};

bool fits(Decoding& decoding, uint32_t width, uint32_t height) {
    decoding.width = width;
    decoding.height = height;
    const bool small = width > 0 && height > 0 && uint64_t{width} * height <= kMaxPixels;
    if (!small) {
        std::snprintf(decoding.fault, sizeof decoding.fault, "more than %llu pixels",
                      static_cast<unsigned long long>(kMaxPixels));
    }
    return small;
}

[[noreturn]] void failPng(png_structp png, png_const_charp message) {
    auto& decoding = *static_cast<Decoding*>(png_get_error_ptr(png));
    std::snprintf(decoding.fault, sizeof decoding.fault, "%s", message);
    std::longjmp(decoding.back, 1);
}

void ignorePng(png_structp, png_const_charp) {}

void readPngBytes(png_structp png, png_bytep out, size_t count) {
    auto& decoding = *static_cast<Decoding*>(png_get_io_ptr(png));
    if (count > decoding.size - decoding.read) {
        png_error(png, "truncated");
    }
    std::memcpy(out, decoding.data + decoding.read, count);
    decoding.read += count;
}

/// The header, and what becomes RGBA of 8 bits. glTF ignores gamma and color profiles.
bool beginPng(png_structp png, png_infop info, Decoding& decoding) {
    png_read_info(png, info);
    if (!fits(decoding, png_get_image_width(png, info), png_get_image_height(png, info))) {
        return false;
    }
    png_set_expand(png);
    png_set_strip_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xFF, PNG_FILLER_AFTER);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    return png_get_rowbytes(png, info) == size_t{decoding.width} * 4;
}

/// Calls body(png, info); false where it, or libpng, fails.
template <class Body>
bool withPng(Decoding& decoding, Body&& body) {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &decoding, failPng, ignorePng);
    png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
    bool done = false;
    if (info != nullptr && setjmp(decoding.back) == 0) {
        png_set_read_fn(png, &decoding, readPngBytes);
        png_set_user_limits(png, 1u << 26, 1u << 26);
        png_set_chunk_malloc_max(png, 1u << 24);
        done = beginPng(png, info, decoding) && body(png);
    }
    png_destroy_read_struct(&png, &info, nullptr);
    return done;
}

bool sizePng(Decoding& decoding) {
    return withPng(decoding, [](png_structp) { return true; });
}

/// `rows`: one pointer for each.
bool decodePng(Decoding& decoding, uint8_t** rows) {
    decoding.read = 0;
    return withPng(decoding, [&](png_structp png) {
        png_read_image(png, rows);
        return true;
    });
}

[[noreturn]] void failJpeg(j_common_ptr jpeg) {
    auto& decoding = *static_cast<Decoding*>(jpeg->client_data);
    jpeg->err->format_message(jpeg, decoding.fault);
    std::longjmp(decoding.back, 1);
}

void noteJpeg(j_common_ptr jpeg, int level) {
    if (level < 0 && jpeg->err->msg_code == JWRN_JPEG_EOF) {
        failJpeg(jpeg);
    }
}

void countScans(j_common_ptr jpeg) {
    auto& decoding = *static_cast<Decoding*>(jpeg->client_data);
    if (jpeg->is_decompressor && reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > kMostScans) {
        std::snprintf(decoding.fault, sizeof decoding.fault, "more than %d scans", kMostScans);
        std::longjmp(decoding.back, 1);
    }
}

/// Calls body(jpeg) behind the header; false where it, or libjpeg, fails.
template <class Body>
bool withJpeg(Decoding& decoding, Body&& body) {
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    jpeg.err = jpeg_std_error(&errors);
    errors.error_exit = failJpeg;
    errors.emit_message = noteJpeg;
    jpeg.client_data = &decoding;
    bool done = false;
    if (setjmp(decoding.back) == 0) {
        jpeg_create_decompress(&jpeg);
        progress.progress_monitor = countScans;
        jpeg.progress = &progress;
        jpeg_mem_src(&jpeg, decoding.data, static_cast<unsigned long>(decoding.size));
        jpeg_read_header(&jpeg, TRUE);
        done = fits(decoding, jpeg.image_width, jpeg.image_height) && body(jpeg);
    }
    jpeg_destroy_decompress(&jpeg);
    return done;
}

bool sizeJpeg(Decoding& decoding) {
    return withJpeg(decoding, [](jpeg_decompress_struct&) { return true; });
}

bool decodeJpeg(Decoding& decoding, uint8_t** rows) {
    return withJpeg(decoding, [&](jpeg_decompress_struct& jpeg) {
        jpeg.out_color_space = JCS_EXT_RGBA;
        jpeg_start_decompress(&jpeg);
        while (jpeg.output_scanline < jpeg.output_height) {
            jpeg_read_scanlines(&jpeg, rows + jpeg.output_scanline, 1);
        }
        return true;
    });
}

} // namespace

Result<Picture> decodePicture(std::span<const std::byte> bytes, const std::string& name) {
    if (isWebp(bytes)) {
        return decodeWebp(bytes, kMaxPixels, name);
    }
    if (isKtx2(bytes)) {
        return decodeKtx2(bytes, kMaxPixels, name);
    }
    Decoding decoding;
    decoding.data = reinterpret_cast<const uint8_t*>(bytes.data());
    decoding.size = bytes.size();
    const bool isPng = bytes.size() >= 8 && png_sig_cmp(decoding.data, 0, 8) == 0;
    const bool isJpeg = bytes.size() >= 3 && std::memcmp(decoding.data, "\xFF\xD8\xFF", 3) == 0;
    if (!isPng && !isJpeg) {
        return Error{ErrorCode::asset, name + ": not a PNG, JPEG, WebP or KTX2"};
    }
    const auto failed = [&] {
        return Error{ErrorCode::asset, name + ": " + (decoding.fault[0] != '\0' ? decoding.fault : "damaged")};
    };
    if (!(isPng ? sizePng(decoding) : sizeJpeg(decoding))) {
        return failed();
    }
    Picture picture = Picture::blank(decoding.width, decoding.height);
    std::vector<uint8_t*> rows(picture.height);
    for (uint32_t y = 0; y < picture.height; ++y) {
        rows[y] = picture.pixel(0, y);
    }
    if (!(isPng ? decodePng(decoding, rows.data()) : decodeJpeg(decoding, rows.data()))) {
        return failed();
    }
    return picture;
}

} // namespace supple::host
