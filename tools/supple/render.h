// supple render: one picture of a character.
#pragma once

#include "tools/supple/render_options.h"

#include <string>

namespace supple::tools {

struct RenderOptions {
    std::string file;
    std::string output;            ///< .png
    std::string clip;              ///< name or index; empty is the bind pose
    double time = 0.0;             ///< seconds
    std::string size = "1280x960"; ///< WxH in pixels
    DrawOptions draw;
};

/// Draws the picture; returns the exit code and says why on stderr when it is not kExitOk.
int runRender(const RenderOptions& options);

} // namespace supple::tools
