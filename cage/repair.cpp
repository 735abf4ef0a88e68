#include "cage/repair.h"

#include "cage/message.h"
#include "cage/repair/draft.h"
#include "cage/repair/faces.h"
#include "cage/repair/fans.h"
#include "cage/repair/folds.h"
#include "cage/repair/remap.h"
#include "cage/repair/sheets.h"
#include "cage/topology.h"

#include <new>
#include <utility>

namespace supple::cage {
namespace {

using namespace repair;

/// Vertices that no face uses, before anything is repaired.
Found looseVertices(const Cage& cage) {
    std::vector<uint8_t> used(cage.vertexCount(), 0);
    for (const uint32_t v : cage.faceVertices) {
        used[v] = 1;
    }
    Found loose;
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        if (used[v] == 0) {
            loose.add([&] { return at("vertex", v); });
        }
    }
    return loose;
}

/// Words the damage of one element.
class Reporter {
public:
    Reporter(std::string element, std::vector<Damage>& damages) : element_(std::move(element)), damages_(damages) {}

    void add(const Found& found, const char* one, const char* many, const std::string& repair) {
        if (found.count > 0) {
            damages_.push_back({element_ + ": " + found.told(one, many), repair});
        }
    }

private:
    std::string element_;
    std::vector<Damage>& damages_;
};

std::string vertexCopies(size_t count) {
    return counted(count, "vertex", "vertices") + " repeated";
}

void report(const FaceDamage& faces, const SheetDamage& sheets, const FanDamage& fans, const FoldDamage& folds,
            Reporter& reporter) {
    reporter.add(faces.empty, "face has fewer than three different vertices or bounds nothing",
                 "faces have fewer than three different vertices or bound nothing", "left out");
    reporter.add(faces.repeating, "face passes a vertex twice", "faces pass a vertex twice", "cut into simple faces");
    reporter.add(faces.duplicated, "face is there twice", "faces are there twice", "left out");
    // Copies at cut edges are told once: of the crowded ones if there are any.
    const std::string copies = ", " + vertexCopies(fans.copiesAtCuts);
    const bool crowded = sheets.crowded.count > 0;
    reporter.add(sheets.crowded, "edge has three or more faces", "edges have three or more faces",
                 "cut into sheets" + copies);
    reporter.add(sheets.turned, "face is turned against its neighbours", "faces are turned against their neighbours",
                 "turned round");
    reporter.add(sheets.unorientable, "edge joins two sides of one surface, as in a Moebius strip",
                 "edges join two sides of one surface, as in a Moebius strip",
                 "cut open" + (crowded ? std::string() : copies));
    reporter.add(fans.bowTies, "vertex has faces that are no single fan", "vertices have faces that are no single fan",
                 "one vertex for each fan");
    reporter.add(folds.folds, "inner vertex has two faces only", "inner vertices have two faces only",
                 folds.cutOpen == 0
                     ? std::string("dissolved")
                     : "dissolved or, with " + counted(folds.cutOpen, "vertex", "vertices") + " repeated, cut open");
}

Status repairDamaged(Cage& cage, SkinWeights& weights, Morphs& morphs, const std::string& element,
                     std::vector<Damage>& damages) {
    Reporter reporter(element, damages);
    reporter.add(looseVertices(cage), "vertex has no face", "vertices have no face", "left out");
    FaceDamage faces;
    Draft draft = withoutDuplicates(simpleFaces(cage, faces), faces);
    SheetDamage sheets;
    FanDamage fans;
    FoldDamage folds;
    std::vector<uint32_t> twins = joinFaces(cage, draft, sheets);
    separateFans(draft, twins, sheets.atCut, fans);
    dissolveFolds(cage, draft, std::move(twins), folds);
    report(faces, sheets, fans, folds, reporter);
    if (draft.faceCount() == 0) {
        return Error{ErrorCode::asset, element + ": no face is left: all have fewer than three different vertices or "
                                                 "bound nothing"};
    }
    const Status applied = applyDraft(draft, cage, weights, morphs);
    return applied ? success() : Error{applied.error().code, element + ": " + applied.error().message};
}

} // namespace

Status repairCage(Cage& cage, SkinWeights& weights, Morphs& morphs, const std::string& element,
                  std::vector<Damage>& damages) {
    const Result<Topology> topology = buildTopology(cage);
    if (topology.ok()) {
        return success();
    }
    if (topology.error().code != ErrorCode::asset) {
        return Error{topology.error().code, element + ": " + topology.error().message};
    }
    try {
        return repairDamaged(cage, weights, morphs, element, damages);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::hostMemory, element + ": out of memory for repairing the cage"};
    }
}

Status reportDamages(Character& character, bool strict) {
    std::string refusal;
    for (const Damage& damage : character.damages) {
        refusal += (refusal.empty() ? "" : "\n") + oneLine(character.name + ": " + damage.found);
        character.warnings.push_back(damage.found + "; " + damage.repair);
    }
    return strict && !refusal.empty() ? Status(Error{ErrorCode::asset, refusal}) : success();
}

} // namespace supple::cage
