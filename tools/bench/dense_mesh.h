// The classical way to draw a smooth character: a mesh as dense as the surface, with skin weights of its own.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "host/device.h"
#include "tools/bench/workbench.h"

#include <cstdint>
#include <vector>

namespace supple::bench {

inline constexpr size_t kDenseInfluences = 4; ///< per vertex, as game engines bound them

struct DenseMesh {
    /// Skeleton, clips and materials of the cage's character; the surface's triangles as its cage.
    cage::Character character;
    std::vector<uint32_t> surfaceVertices; ///< per vertex: the surface vertex that it was, of a group of that rate
    uint32_t normalCount = 0;              ///< distinct pairs of vertex and normal, which are vertices of a glTF file

    /// The least that the buffers of a plain glTF file take: floats, but bytes for joints and weights, sparse morph
    /// targets, no clips.
    [[nodiscard]] uint64_t fileBytes() const;
};

/// Takes the surface of the unposed cage at a rate, and makes its triangles a mesh. Samples on borders become one
/// vertex. Weights, morph targets and UVs are interpolated over the faces of the cage, bilinearly; of the weights
/// the largest remain. Only for cages whose patches are whole quads.
[[nodiscard]] Result<DenseMesh> makeDenseMesh(host::Device& device, Workbench& workbench,
                                              const cage::Character& character, SuppleScheme scheme, uint32_t rate);

} // namespace supple::bench
