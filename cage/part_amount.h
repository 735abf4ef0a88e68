// How much a character may hold.
#pragma once

#include "cage/parts.h"

#include <cstdint>
#include <string>

namespace supple::cage {

/// The bounds of all parts together: as kMaxVertices and kMaxCorners (cage/limits.h).
inline constexpr uint64_t kMaxParts = 1u << 14;
inline constexpr uint64_t kMaxDisplacements = 1u << 26;

/// What the parts that have been read hold so far.
class PartAmount {
public:
    /// Throws Refusal (cage/refusal.h) if it is too much; `element`: the node or part that has the mesh.
    void add(const PartCage& part, const std::string& element);

private:
    uint64_t parts_ = 0, vertices_ = 0, corners_ = 0, displacements_ = 0;
};

} // namespace supple::cage
