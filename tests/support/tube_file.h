// The tube of tests/support/rigged_tube.h as a file with one of everything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace supple::test {

/// A GLB of segments x sides quads: 3 joints, 4 morph targets with weights of their own, a clip, a material with an
/// image. Empty, and a failure of the test, if it could not be written.
[[nodiscard]] std::vector<std::byte> tubeFileOf(uint32_t segments, uint32_t sides);

} // namespace supple::test
