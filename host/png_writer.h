// A PNG that is written as its rows are made.
#pragma once

#include "host/picture.h"

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace supple::host {

/// The file is a whole PNG of all rows so far after every append(), and memory holds none of them but the last.
class PngWriter {
public:
    /// Rows of `width` pixels. The file is made by the first append().
    PngWriter(std::string path, uint32_t width) : path_(std::move(path)), width_(width) {}

    /// Adds the rows of a picture of the same width below those that there are; alpha is left out.
    [[nodiscard]] Status append(const Picture& rows);

private:
    struct FileCloser {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    [[nodiscard]] Status write(const std::vector<uint8_t>& bytes, long place);

    std::string path_;
    uint32_t width_;
    uint32_t height_ = 0;
    std::unique_ptr<std::FILE, FileCloser> file_;
    long end_ = 0;                 ///< where the next rows go, over the chunks that end the file
    uint32_t adler_ = 1;           ///< of all rows, with their filters
    std::vector<uint8_t> lastRow_; ///< RGB
};

} // namespace supple::host
