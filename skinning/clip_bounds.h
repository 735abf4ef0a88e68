// Boxes that hold a character's cage at every time of a clip.
#pragma once

#include "cage/character.h"
#include "skinning/box.h"
#include "skinning/skinning_mode.h"

namespace supple::skinning {

/// What a box is to hold.
struct ClipBoundsDesc {
    Skinning skinning;
    /// How far a surface may lie outside the box that its cage has at a time, as a part of that box's size.
    double margin = 0.0;
    /// Intervals with larger errors are halved, as a part of the character's extent. Whatever it is, the box holds.
    double tolerance = 0.005;
};

/// Holds every vertex of the cage, of all parts, at every time from 0 to the clip's duration, as the device computes
/// them; of `clip` null in the rest pose. Everything if the clip leaves what doubles hold. Between two times t0 and t1
/// without a key in between, everything that moves is compared with its chord, which goes straight from its value at t0
/// to that at t1, both at the same share s of the time. How far a thing can be from its chord follows from its parts:
///
///   - a driver:   its weights are anywhere between the ends of its clamp.
///   - a channel:  STEP and LINEAR vectors are their chords. A spline's second derivative in s is linear, so its norm M
///     is largest at an end, and the spline is within M / 8 of the chord.
///   - a rotation: a slerp by an angle a is within a^2 / 8 of its chord, as matrices. For splines see rotationError().
///   - a product:  if A and B are within e and f of their chords, AB is within |dA| |dB| / 4 + |A| f + e |B| + e f of
///     its own: (1-s) A0 B0 + s A1 B1 differs from the product of the chords by s (1-s) dA dB. d is the difference of
///     the ends, and norms are the larger of those at the ends: on a chord they are not larger.
///   - a skinned vertex: a mean of products, with constant weights: within the mean of their errors. Dual quaternions
///     and centers of rotation add what they may differ from linear skinning, see dualQuaternionError(), centerError().
///     Delta mush is such a mean, of places of its own, and a vector of bounded length: see smoothedLength().
///
/// So the box of both ends, larger by the error, holds the vertex between them. Errors shrink with the square of the
/// time between t0 and t1, which is halved until they are a small part of the character's extent.
[[nodiscard]] Box clipBounds(const cage::Character& character, const cage::Clip* clip, const ClipBoundsDesc& desc);

/// The cage's own positions, which are the bind pose.
[[nodiscard]] Box bindBounds(const cage::Character& character, const ClipBoundsDesc& desc);

} // namespace supple::skinning
