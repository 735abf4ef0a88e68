// The subdivision kernel on the CPU, in float or double, with the sums of docs/kernel.md in their order: for tests and
// comparisons, not part of the runtime. In float it gives the device's bits.
#pragma once

#include "surface/kernel/mesh.h"

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::surface::kernel {

template <class T>
struct Sample {
    glm::vec<3, T> refined;  ///< the point on the last level, before the limit
    glm::vec<3, T> position; ///< the limit point
    glm::vec<3, T> normal;   ///< outwards, of unit length (zero where there is none): the sector's own side of a crease
};

/// The samples of one face of the isolated level, in grid order of its domain at rate 2^steps: quad (Catmull-Clark) or
/// triangle (Loop), corner 0 as Mesh::sectorFaces says.
template <class T>
struct SectorGrid {
    uint32_t face = 0; ///< of Mesh::cage
    std::vector<Sample<T>> samples;
};

/// Vertices of the isolated level: at every step p_first + sum of w_i (p_i - p_first) over a row's other entries.
template <class T>
[[nodiscard]] std::vector<glm::vec<3, T>> isolate(const Mesh& mesh, std::span<const glm::vec<3, T>> positions);

/// All sectors, fragment by fragment, refined `steps` times (0..6) beyond the isolated level.
template <class T>
[[nodiscard]] std::vector<SectorGrid<T>> evaluate(const Mesh& mesh, std::span<const glm::vec<3, T>> isolated,
                                                  uint32_t steps);

/// The same, a sector at a time in one buffer: for what would not fit into memory.
template <class T>
void forEachSector(const Mesh& mesh, std::span<const glm::vec<3, T>> isolated, uint32_t steps,
                   const std::function<void(const SectorGrid<T>&)>& visit);

} // namespace supple::surface::kernel
