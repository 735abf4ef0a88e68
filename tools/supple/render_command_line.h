// The command line of supple render, or of supple animate, that makes a picture.
#pragma once

#include "tools/supple/animate.h"
#include "tools/supple/render.h"

#include <string>

namespace supple::tools {

/// For a POSIX shell. What the options leave at its default is left out.
[[nodiscard]] std::string commandLine(const RenderOptions& options);
[[nodiscard]] std::string commandLine(const AnimateOptions& options);

} // namespace supple::tools
