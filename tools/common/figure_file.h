// A character file opened for drawing.
#pragma once

#include "host/figure.h"
#include "tools/common/character_file.h"

namespace supple::host {

/// The context must outlive the figure.
[[nodiscard]] Result<std::unique_ptr<Figure>> openFigure(Context& context, const std::string& path,
                                                         const ReadFlags& flags = {});

} // namespace supple::host
