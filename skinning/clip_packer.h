// Makes packed clips (skinning/packed_clip.h): no larger than their error allows.
#pragma once

#include "cage/character.h"

namespace supple::skinning {

/// Packs the clips of a character: their channels become those of the packed clips, and Clip::packed has the words.
/// `error`: how far any vertex of the cage may then be from where the clip has it, at any time, as a part of the
/// extent; the same holds of three points around each joint, in a distance of 0.015 of the extent, so that sockets and
/// joints that move no vertex count too. Clip::packed.error is what was reached: it is measured between all frames and
/// in their middles.
///
/// Morph weights keep their floats, at fewer keys. STEP and CUBICSPLINE channels and channels of nodes that move no
/// joint stay as they are. So do clips that would not become smaller, that are packed already, that take more than 4,096
/// frames, or whose numbers leave what 20 bits reach; and all that come after ten million properties of frames, which
/// take about two minutes.
///
/// A property may move what it moves by some way: the largest for which the whole clip keeps within the error, found by
/// bisection. Up to half of it a property is left at rest, or constant. Else 0.4 of it go into knots that are left out,
/// the fewest, by dynamic programming; and 0.6 into the step of the lattice.
void packClips(cage::Character& character, double error);

} // namespace supple::skinning
