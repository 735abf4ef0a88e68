// A character file opened for drawing.
#pragma once

#include "host/figure.h"

namespace supple::host {

/// The context must outlive the figure.
[[nodiscard]] Result<std::unique_ptr<Figure>> openFigure(Context& context, const std::string& path,
                                                         bool pairQuads = false);

} // namespace supple::host
