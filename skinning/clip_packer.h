// Makes packed clips (skinning/packed_clip.h): as small as their error allows.
#pragma once

#include "cage/character.h"

#include <string>
#include <vector>

namespace supple::skinning {

/// Packs the clips of a character: their channels become those of the packed clips, and Clip::packed has the words.
/// After it, a vertex is at most `error` extents away from where the clip had it, and so are three points around each
/// joint (skinning/pose_distance.h). Clip::packed.error is the largest distance that was found, on all frames and in
/// their middles. What morph weights move counts as in the rest pose. Character::clipRoot becomes the root of the clips
/// as they were.
///
/// Some things stay as they are: STEP and CUBICSPLINE channels, channels of nodes that move no joint, turns of more
/// than 120 degrees a frame, and numbers beyond what 20 bits reach; all morph weights of a clip if one of their
/// channels does; clips that are packed already, and clips that would not become smaller. Returns why other clips were
/// left out, one line each: they take more than 4,096 frames, more than 400,000 poses of nodes, or come after so much
/// work that it takes about ten minutes.
///
/// The encoder gives each property a budget, in units of distance: first the same, the largest for which the whole clip
/// keeps within the error, found by bisection; then more where what follows is off by less. Morph weights have half of
/// what is the same for all. A property that can be left at rest, or constant, for half of the budget, is. Else 0.4 of
/// it go to frames that are skipped, as many as possible, by dynamic programming, and 0.6 to the step of the lattice.
///
/// If `coarseError` is larger than `error`, clips get coarse twins within that: but for clips whose twin would take as
/// much as the segments that it stands in for, or would not move at all.
[[nodiscard]] std::vector<std::string> packClips(cage::Character& character, double error, double coarseError = 0.0);

} // namespace supple::skinning
