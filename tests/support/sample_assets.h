// Files of samples/assets that many tests read.
#pragma once

#include <string>

namespace supple::test {

inline const std::string kPip = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb";
inline const std::string kWren = std::string(SUPPLE_SAMPLE_ASSETS) + "/wren.glb";
inline const std::string kPipQuads = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip_quads.glb";

} // namespace supple::test
