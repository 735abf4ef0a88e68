// The subdivision on the CPU, in float or double. Sums have the order of docs/subdivision.md, so that float gives the
// bits of the device. For tests and comparisons.
#pragma once

#include "cpu/fragment.h"
#include "surface/subdivision/mesh.h"

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::surface::subdivision {

/// The samples of one face of the isolated level, in the grid order of its domain at rate 2^steps. The domain is a quad
/// (Catmull-Clark) or a triangle (Loop). Its corner 0 is the one that Mesh::sectorFaces describes.
template <class T>
struct SectorGrid {
    uint32_t face = 0; ///< of Mesh::cage
    std::vector<Sample<T>> samples;
};

/// All sectors, fragment after fragment, refined `steps` times (0..6) beyond the isolated level.
template <class T>
[[nodiscard]] std::vector<SectorGrid<T>> evaluate(const Mesh& mesh, std::span<const glm::vec<3, T>> isolated,
                                                  uint32_t steps);

/// The same, but one sector at a time in one buffer. For results that would not fit into memory.
template <class T>
void forEachSector(const Mesh& mesh, std::span<const glm::vec<3, T>> isolated, uint32_t steps,
                   const std::function<void(const SectorGrid<T>&)>& visit);

} // namespace supple::surface::subdivision
