// supple view: characters in a window, playing.
#pragma once

#include "tools/supple/render_options.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::tools {

struct ViewOptions {
    std::vector<std::string> files; ///< one is shown at a time
    std::string clip;               ///< name or index to begin with; empty takes the first clip
    std::string size = "1280x800";  ///< WxH of the window
    uint32_t frames = 0;            ///< close after so many frames; 0 stays open
    std::string look = "auto";      ///< auto | fast | studio: see view_look.h
    std::string screenshot;         ///< .png of the last frame, window and all; needs frames
    DrawOptions draw;
};

/// Runs until the window is closed; returns the exit code and says why on stderr when it is not kExitOk. A file that is
/// refused does not keep the others from being shown.
int runView(const ViewOptions& options);

} // namespace supple::tools
