// Numbers that no input may have.
#pragma once

#include <limits>

namespace supple::test {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

} // namespace supple::test
