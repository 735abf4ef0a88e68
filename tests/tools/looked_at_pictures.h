// Pictures that somebody has looked at (tests/data/pictures), and how far another picture may be from them.
#pragma once

#include "host/picture.h"

#include <string>

namespace supple::test {

/// What catches the eye if two pictures are laid on each other.
struct PictureDifference {
    double changed; ///< share of the pixels that are of another color once both pictures are blurred a little
    double mean;    ///< of all channels of all pixels, blurred, in steps of 8 bits
};

/// Compares pictures of one size. Pixels along edges differ from driver to driver, and JPEG adds noise: the blur takes
/// off both. A line that is missing, and a color that is another, stay.
[[nodiscard]] PictureDifference differenceOf(const host::Picture& a, const host::Picture& b);

[[nodiscard]] host::Picture partOf(const host::Picture& picture, uint32_t x, uint32_t y, uint32_t width,
                                   uint32_t height);

/// JPEG, read by host::decodePicture.
[[nodiscard]] Result<host::Picture> readJpeg(const std::string& path);
[[nodiscard]] Status writeJpeg(const host::Picture& picture, const std::string& path);

} // namespace supple::test
