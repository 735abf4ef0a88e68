// What makers of characters check of clips. Functions that refuse throw Refusal (cage/refusal.h).
#pragma once

#include "cage/character.h"
#include "cage/message.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace supple::cage {

/// Refuses times that are not finite or do not rise, and a CUBICSPLINE of one key. `times`: what messages call them.
void checkTimes(const Channel& channel, const std::string& times);
/// Refuses a CUBICSPLINE of one key alone.
void checkKeyCount(const Channel& channel, const std::string& times);

/// Refuses values that are no coordinates, and key rotations of no length. Rotations become unit quaternions, but for
/// rounding and those of CUBICSPLINE. Messages name elements of `elementWidth` numbers; `values`: what they call them.
void checkValues(Channel& channel, size_t elementWidth, const std::string& values);

/// Whether a rotation (x, y, z, w) has no length, so that it says nothing.
[[nodiscard]] bool isZeroRotation(const float* rotation);

/// glTF knows no times before 0, and exporters write them. Returns the time that becomes 0.
[[nodiscard]] float beginAtFirstKey(Clip& clip, const std::string& element, Warnings& warnings);

/// The last key of any channel.
[[nodiscard]] double lastKey(const Clip& clip);

/// Why a time cannot be a marker's, or nothing: then `marker` has it, counted from `first`, the time that became 0.
[[nodiscard]] std::optional<std::string> placeMarker(double given, double first, double duration, Marker& marker);

/// By time; markers of one time in the order in which they are given.
void sortMarkers(std::vector<Marker>& markers);

} // namespace supple::cage
