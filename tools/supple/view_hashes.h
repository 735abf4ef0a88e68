// What a view drew last, as text by which two builds are compared (tools/same_bits.py).
#pragma once

#include "host/context.h"

#include <span>
#include <string>

namespace supple::tools {

/// A line for each patch, or for each instance where instances have rates: which one it is, and hashes of its levels
/// and of its surface vertices. The lines are sorted, because the device may put a patch elsewhere in each run. Waits
/// for the device.
[[nodiscard]] Result<std::string> hashView(host::Context& context, std::span<const SuppleGroup> groups);

} // namespace supple::tools
