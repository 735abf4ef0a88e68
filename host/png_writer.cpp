#include "host/png_writer.h"

#include "host/whole_file.h"

#include <csetjmp>
#include <cstdio>
#include <utility>

#include <png.h>

namespace supple::host {

struct PngWriter::State {
    State(std::string target, uint32_t columns, uint32_t rows)
        : path(std::move(target)), file(path), width(columns), height(rows) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() { png_destroy_write_struct(&png, &info); }

    std::string path;
    WholeFile file;
    uint32_t width, height;
    uint32_t written = 0; ///< rows
    png_structp png = nullptr;
    png_infop info = nullptr;
    char fault[128] = "";
    std::jmp_buf back; ///< where run() is

    // libpng jumps back over its own frames alone: nothing of C++ is on the stack there.
    [[noreturn]] static void fail(png_structp png, png_const_charp message) {
        auto& state = *static_cast<State*>(png_get_error_ptr(png));
        std::snprintf(state.fault, sizeof state.fault, "%s", message);
        std::longjmp(state.back, 1);
    }
    /// Runs a step of libpng; false where it, or one before it, fails.
    template <class Step>
    bool run(Step&& step) {
        if (fault[0] != '\0' || setjmp(back) != 0) {
            return false;
        }
        step();
        return true;
    }
};

namespace {

void ignore(png_structp, png_const_charp) {}

void writeBytes(png_structp png, png_bytep bytes, size_t count) {
    static_cast<WholeFile*>(png_get_io_ptr(png))->write({reinterpret_cast<const std::byte*>(bytes), count});
}

void flush(png_structp) {}

} // namespace

PngWriter::PngWriter(std::string path, uint32_t width, uint32_t height, PngAlpha alpha)
    : state_(std::make_unique<State>(std::move(path), width, height)) {
    State& state = *state_;
    state.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &state, State::fail, ignore);
    state.info = state.png != nullptr ? png_create_info_struct(state.png) : nullptr;
    if (state.info == nullptr) {
        std::snprintf(state.fault, sizeof state.fault, "libpng cannot be used");
        return;
    }
    state.run([&] {
        png_set_write_fn(state.png, &state.file, writeBytes, flush);
        png_set_user_limits(state.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        const int color = alpha == PngAlpha::kept ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB;
        png_set_IHDR(state.png, state.info, width, height, 8, color, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                     PNG_FILTER_TYPE_DEFAULT);
        png_write_info(state.png, state.info);
        if (alpha == PngAlpha::leftOut) {
            png_set_filler(state.png, 0, PNG_FILLER_AFTER);
        }
    });
}

PngWriter::~PngWriter() = default;

Error PngWriter::failure() const {
    return Error{ErrorCode::io, state_->path + ": cannot encode the picture: " + state_->fault};
}

Status PngWriter::append(const Picture& rows) {
    State& state = *state_;
    if (Status open = state.file.status(); !open) {
        return open;
    }
    if (rows.width != state.width || rows.height > state.height - state.written) {
        return Error{ErrorCode::argument, state.path + ": rows that do not belong to the picture"};
    }
    const bool done = state.run([&] {
        for (uint32_t y = 0; y < rows.height; ++y) {
            png_write_row(state.png, rows.pixel(0, y));
        }
    });
    if (!done) {
        return failure();
    }
    state.written += rows.height;
    return success();
}

Status PngWriter::close() {
    State& state = *state_;
    if (state.written != state.height) {
        return Error{ErrorCode::argument, state.path + ": rows are missing"};
    }
    if (!state.run([&] { png_write_end(state.png, nullptr); })) {
        return failure();
    }
    return state.file.close();
}

Status writePng(const Picture& picture, const std::string& path) {
    PngWriter writer(path, picture.width, picture.height, PngAlpha::kept);
    const Status status = writer.append(picture);
    return status ? writer.close() : status;
}

} // namespace supple::host
