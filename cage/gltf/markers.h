// Named times of clips: extras.markers of an animation. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/json.h"
#include "cage/message.h"

#include <string>
#include <vector>

namespace supple::cage::gltf {

/// The markers that the extras of an animation list, by rising time; equal times keep their order. `first`: the time of
/// the file at which the clip begins. Entries that are malformed or lie outside the clip are left out, with one
/// warning.
[[nodiscard]] std::vector<Marker> readMarkers(const Json& extras, const std::string& element, double first,
                                              double duration, Warnings& warnings);

} // namespace supple::cage::gltf
