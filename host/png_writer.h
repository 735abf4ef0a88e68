// A PNG that is written as its rows are made, by libpng.
#pragma once

#include "host/picture.h"

#include <cstdint>
#include <memory>
#include <string>

namespace supple::host {

enum class PngAlpha {
    leftOut, ///< three channels
    kept
};

/// Memory holds no rows but those that are being written. The file takes its place when it is closed (WholeFile).
class PngWriter {
public:
    PngWriter(std::string path, uint32_t width, uint32_t height, PngAlpha alpha);
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
    ~PngWriter(); ///< what is not closed leaves nothing behind

    /// Adds the rows of a picture of the same width below those that there are.
    [[nodiscard]] Status append(const Picture& rows);
    /// Ends the file. An error if rows are missing, or if anything went wrong on the way.
    [[nodiscard]] Status close();

private:
    struct State;
    [[nodiscard]] Error failure() const;

    std::unique_ptr<State> state_;
};

} // namespace supple::host
