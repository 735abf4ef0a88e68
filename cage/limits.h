// How much is built from a file.
#pragma once

#include <cstdint>

namespace supple::cage {

/// Accessors may be shared and nodes may share a mesh, so a small file can ask for much. All parts together are
/// bounded.
inline constexpr uint64_t kMaxVertices = 1u << 24;
inline constexpr uint64_t kMaxCorners = 3u << 24;

} // namespace supple::cage
