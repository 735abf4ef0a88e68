// What pose drivers add to morph weights, on the CPU, by the device's own source (shaders/pose/drivers.h): the same
// bits.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace supple::skinning {

/// `words`: a table in which the section of drivers begins at element `drivers` (skinning/driver_table.h). `rotations`:
/// of the nodes that drivers look at, by their number: local, (x, y, z, w), of any length. Adds to `weights`, those of
/// all morph targets, four an element.
void addDriven(std::span<const uint32_t> words, uint32_t drivers, std::span<const glm::vec4> rotations,
               std::span<glm::vec4> weights);

} // namespace supple::skinning
