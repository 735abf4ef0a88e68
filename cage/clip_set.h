// Clips of another file than the character's: matched to its nodes and morph targets by name.
#pragma once

#include "cage/character.h"
#include "cage/parts.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace supple::cage {

/// Numbers in the clips of one file, at most.
inline constexpr uint64_t kMaxClipFloats = 1u << 26;

/// What a file of clips holds beside meshes: a skeleton and the clips that move it.
struct ClipSet {
    std::string name; ///< of the file; begins every message about it
    Skeleton skeleton;
    std::vector<uint32_t> meshes;                      ///< by node, or kNone
    std::vector<std::vector<std::string>> targetNames; ///< by mesh: of its morph targets, or empty
    std::vector<Clip> clips;                           ///< channels of weights are as wide as the file has them
    std::vector<std::string> warnings;                 ///< without the name
    std::string whyNotFitted;                          ///< if somebody has tried (skinning/retarget.h), and could not
    bool isFitted = false; ///< the skeleton is the character's own: nodes have the same numbers
};

/// The name of a file without folder and ending.
[[nodiscard]] std::string stemOf(const std::string& file);

/// Appends the clips to the character's. `parts` are those that it is about to be joined from.
///
/// A channel moves the node of the same name. If several nodes of one skeleton have that name, the names of all nodes
/// above them tell them apart; where these are equal too, or agree with no node's, the first of each skeleton in
/// Skeleton::parentsFirst are matched. Weights move the targets of the part that the node carries: by name if both
/// sides have names, else all of them if there are as many. Targets without a match keep the weights they have at rest.
/// Channels without a match are left out. One warning a set says what was not matched, and where the bones of the two
/// skeletons differ in length by more than 1 %; there is none if everything matches. Nothing is retargeted here: a set
/// that was (skinning/retarget.h) is fitted, and its nodes are the character's.
///
/// A clip without a match stays, without channels. A clip whose name is taken gets "@" and the file's name behind it,
/// and if that is taken too, a number. A node with a matrix that a clip moves becomes one with translation, rotation
/// and scale, if its matrix is made of these. Throws Refusal if the clips would hold too many numbers.
void takeClips(ClipSet set, std::span<const PartCage> parts, Character& character);

} // namespace supple::cage
