// One name in the path of a file that an asset names: a folder or the file itself.
#pragma once

#include <string>
#include <string_view>

namespace supple::cage {

/// Why such a name is refused; empty: it is not. What Windows takes for a device, a drive, a stream or another file's
/// name is refused on every system, as an asset that is read on one should be read on all. Source: Microsoft, "Naming
/// Files, Paths, and Namespaces".
[[nodiscard]] std::string whyRefusedName(std::string_view name);

} // namespace supple::cage
