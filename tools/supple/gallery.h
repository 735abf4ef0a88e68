// supple gallery: configurations round one vertex, under all schemes side by side.
#pragma once

#include "tools/supple/render_options.h"

#include <string>

namespace supple::tools {

struct GalleryOptions {
    std::string output;           ///< PNG
    std::string cell = "220x180"; ///< of one picture
    std::string only;             ///< how the names of the cages begin that are drawn; empty: all
    DrawOptions draw;
};

/// A row for each of cage::galleryCages(), a column for each smooth scheme; where a scheme does not take a cage, its
/// place says so. Answers a command's exit code.
int runGallery(const GalleryOptions& options);

} // namespace supple::tools
