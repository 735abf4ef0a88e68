#include "cage/finish.h"

#include "cage/message.h"
#include "cage/normal_creases.h"
#include "cage/refusal.h"
#include "cage/repair.h"
#include "cage/sew.h"

#include <utility>

namespace supple::cage {

namespace {

/// A cage is smoothed as a whole: as the first part says that says something.
void reportSmoothings(Character& character) {
    const Part* first = nullptr;
    for (const Part& part : character.parts) {
        first = first == nullptr && part.smoothing ? &part : first;
        if (part.smoothing && part.smoothing != first->smoothing) {
            warn(character.warnings, "part " + quoted(part.name),
                 "its smoothing is not that of part " + quoted(first->name) + ", which comes first and holds for all");
        }
    }
}

/// A group has one way of skinning: the first that is named.
void reportSkinnings(Character& character) {
    const Part* first = nullptr;
    for (const Part& part : character.parts) {
        first = first == nullptr && part.skinning ? &part : first;
        if (part.skinning && part.skinning != first->skinning) {
            warn(character.warnings, "part " + quoted(part.name),
                 "its skinning is " + quoted(skinningModeName(*part.skinning)) + "; part " + quoted(first->name) +
                     " comes first, so that all are skinned by " + quoted(skinningModeName(*first->skinning)));
        }
    }
}

} // namespace

void finishCharacter(std::vector<PartCage> parts, const FinishOptions& options, Character& character) {
    std::vector<float> gridSteps;
    for (const PartCage& part : parts) {
        gridSteps.push_back(part.gridStep);
    }
    const CageNames names = joinParts(std::move(parts), character);
    if (options.sewParts) {
        sewParts(character, gridSteps);
    }
    if (const Status repaired =
            repairCage(character.cage, character.weights, character.morphs, names, character.damages);
        !repaired) {
        throw Refusal{repaired.error().code, {repaired.error().message}};
    }
    findFirstFaces(character);
    if (options.normalCreases == NormalCreases::all) {
        creaseSplitNormals(character.cage);
    } else if (options.normalCreases == NormalCreases::wherePartly) {
        creasePartlySplitNormals(character);
    }
    reportSkinnings(character);
    reportSmoothings(character);
    reportDamages(character, options.strict);
    character.warnings = readableLines(character.warnings);
}

} // namespace supple::cage
