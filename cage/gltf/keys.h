// Keys of a file that make no sense: left out, so that the rest of their channel is read. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/leniency.h"

#include <cstddef>
#include <string>

namespace supple::cage::gltf {

/// Leaves out the keys whose times go back, and those with a time or a value that is no number. Keys at the time of the
/// key before them make a jump: they are moved behind it by the least that a float can be. The channel has as many
/// values as its times need. `input` and `output` are what messages call these; `elementWidth`: numbers of an element
/// of the output.
void mendKeys(const std::string& input, const std::string& output, size_t elementWidth, Leniency& leniency,
              Channel& channel);

} // namespace supple::cage::gltf
