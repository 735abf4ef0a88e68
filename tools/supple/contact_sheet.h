// A sheet of pictures: a row a clip, a column a time; the deformed cage beside the surface made from it.
#pragma once

#include "tools/supple/render_options.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::tools {

struct ContactSheetOptions {
    std::string file;
    std::string output; ///< .png
    /// Names or indices, or lists of them with commas; empty takes all (the bind pose when there is none).
    std::vector<std::string> clips;
    uint32_t columns = 4;         ///< times a clip, evenly spread over it
    std::string cell = "320x320"; ///< WxH of one picture; a column holds two, cage and surface
    bool labels = true;
    bool progress = true; ///< one line a row on stdout
    DrawOptions draw;
};

/// Draws the sheet, and writes it row by row: what is there is a whole picture at any time. Returns the exit code and
/// says why on stderr when it is not kExitOk.
int runContactSheet(const ContactSheetOptions& options);

} // namespace supple::tools
