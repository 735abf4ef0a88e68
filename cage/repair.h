// Repairs what no surface can be built on: a cage that buildTopology() (cage/topology.h) refuses becomes one that it
// takes. T-corners, where a surface would be torn open, are mended too. docs/gltf.md tells what is done about each kind
// of damage.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "cage/message.h"

#include <string>

namespace supple::cage {

/// Leaves a cage that buildTopology() takes, and that has no T-corners, as it is, bit by bit. In any other one
///  - vertices without a face, faces that bound nothing, and faces that are there twice are left out;
///  - faces that pass a vertex twice are cut into simple loops;
///  - vertices of neighbors that lie on a face's edge become corners of the face (cage/repair/t_corners.h);
///  - faces turned against those they are joined to are turned round;
///  - edges of three and more faces are cut into sheets and become hard creases, vertices of several fans are cut into
///    one each and become hard: so what touched goes on touching. The copies come behind all other vertices, in the
///    order of the vertices they repeat. Cage::sourceVertices says which these are;
///  - inner vertices of two faces are merged away (cage/repair/folds.h).
/// All other faces keep their order and corners; materials, tiles, holes, creases, influences and displacements follow.
/// `weights` may be empty (`starts` has no entry): nothing is bound yet.
///
/// A cage of several parts (Cage::faceParts) is repaired as a whole: what one part lacks, its neighbor may have. Each
/// place is named and counted with the part of its first face.
///
/// Adds one entry for each kind of damage and part to `damages`, which begins with the part's name ("mesh 0") and
/// counts as the part was given. Refuses a part of which no face is left. Indices must be in range.
/// O(corners log corners).
[[nodiscard]] Status repairCage(Cage& cage, SkinWeights& weights, Morphs& morphs, const CageNames& names,
                                std::vector<Damage>& damages);

/// What a maker of characters does at its end with the damage it found and repaired: a warning for each kind; or, if it
/// is `strict`, it throws a Refusal (cage/refusal.h) of all kinds.
void reportDamages(Character& character, bool strict);
/// That refusal as an error, or success if nothing was damaged.
[[nodiscard]] Status refuseDamages(const Character& character);

} // namespace supple::cage
