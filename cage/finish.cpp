#include "cage/finish.h"

#include "cage/message.h"
#include "cage/normal_creases.h"
#include "cage/refusal.h"
#include "cage/repair.h"
#include "cage/sew.h"

#include <utility>

namespace supple::cage {

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
    reportDamages(character, options.strict);
    character.warnings = readableLines(character.warnings);
}

} // namespace supple::cage
