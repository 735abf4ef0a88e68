// What Wren does.
#pragma once

#include "clips.h"

namespace supple::creature::wren {

std::vector<Clip> makeClips(const Skeleton& skeleton);

} // namespace supple::creature::wren
