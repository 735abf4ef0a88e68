// The characters that walk in place, made to walk on.
#pragma once

#include "cage/character.h"

#include <cstddef>
#include <string>

namespace supple::test {

[[nodiscard]] size_t clipNumber(const cage::Character& character, const std::string& name);

/// The topmost node carries the character along in its clip "walk", as fast as the ground passes there, and turns by
/// `yaw` radians meanwhile. It must not move in that clip.
[[nodiscard]] cage::Character walking(cage::Character character, double yaw);

/// The same node holds it up in the clip.
void raise(const cage::Character& character, cage::Clip& clip, float height);

} // namespace supple::test
