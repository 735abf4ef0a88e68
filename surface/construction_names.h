// What debuggers call the kernels of construction.
#pragma once

#include "surface/scheme.h"

namespace supple::surface {

/// "supple P_m vertex, creased"
[[nodiscard]] const char* constructionName(const KindOfKernel& kernel);

} // namespace supple::surface
