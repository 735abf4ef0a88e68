// Patch records: how large they are, and the words that name spokes.
#pragma once

#include "base/result.h"
#include "surface/scheme.h"

#include <cstddef>
#include <cstdint>

namespace supple::surface {

/// The word of a patch record that names a corner's spoke and the next one around the vertex (SUPPLE_SPOKE).
[[nodiscard]] uint32_t spokeWord(uint32_t spoke, uint32_t next);
/// Finds out whether the words of patch records have enough bits for all spokes of a cage.
class SpokeLimits {
public:
    void add(uint32_t vertex, uint32_t spokes);
    /// Refuses with the number of a vertex that has too many.
    [[nodiscard]] Status check() const;

private:
    size_t count_ = 0;
    uint32_t vertex_ = 0, most_ = 0; ///< the vertex with the most spokes
};

/// Table elements of a patch record.
[[nodiscard]] uint32_t recordElements(const Tables& tables, PatchClass patchClass);

} // namespace supple::surface
