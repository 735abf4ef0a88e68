#include "cage/repair.h"

#include "cage/message.h"
#include "cage/refusal.h"
#include "cage/repair/draft.h"
#include "cage/repair/faces.h"
#include "cage/repair/fans.h"
#include "cage/repair/folds.h"
#include "cage/repair/found.h"
#include "cage/repair/remap.h"
#include "cage/repair/sheets.h"
#include "cage/repair/t_corners.h"
#include "cage/topology.h"

#include <algorithm>
#include <new>
#include <utility>

namespace supple::cage {
namespace {

using namespace repair;

/// Vertices that no face uses, before anything is repaired: a host's, which has one part.
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

/// All that was found in a cage.
struct CageDamage {
    Found loose;
    FaceDamage faces;
    TCornerDamage tCorners;
    SheetDamage sheets;
    FanDamage fans;
    FoldDamage folds;
};

/// Words the damage of one part. What is told already, of another node with the same mesh, is not told again.
class Reporter {
public:
    Reporter(std::string element, std::vector<Damage>& damages) : element_(std::move(element)), damages_(damages) {}

    void add(const Found& found, const char* one, const char* many, const std::string& repair) {
        if (found.count == 0) {
            return;
        }
        const std::string told = element_ + ": " + found.told(one, many);
        if (std::none_of(damages_.begin(), damages_.end(),
                         [&](const Damage& damage) { return damage.found == told; })) {
            damages_.push_back({told, repair});
        }
    }

private:
    std::string element_;
    std::vector<Damage>& damages_;
};

std::string vertexCopies(size_t count) {
    return counted(count, "vertex", "vertices") + " repeated";
}

std::string foldRepairs(const FoldDamage& folds, size_t part) {
    const size_t cutOpen = folds.cutOpen.at(part);
    std::string told = folds.dissolved.at(part) > 0 ? "dissolved" : "";
    if (folds.kept.at(part) > 0) {
        told += std::string(told.empty() ? "" : " or ") + "kept, and a face cut by an edge to it";
    }
    if (cutOpen > 0) {
        told += (told.empty() ? "" : " or ") + ("cut open, " + vertexCopies(cutOpen));
    }
    return told;
}

/// "made five-sided facets"
std::string facetsMade(const std::vector<uint32_t>& sides) {
    if (sides.empty()) {
        return {};
    }
    static const char* const kWords[] = {"four", "five", "six", "seven", "eight"};
    const auto [least, most] = std::minmax_element(sides.begin(), sides.end());
    const std::string facets = sides.size() == 1 ? " facet" : " facets";
    if (*least == *most && *least >= 4 && *least - 4 < std::size(kWords)) {
        return std::string("made ") + (sides.size() == 1 ? "a " : "") + kWords[*least - 4] + "-sided" + facets;
    }
    const std::string range = *least == *most ? "" : std::to_string(*least) + " to ";
    return "made" + facets + " of " + range + std::to_string(*most) + " sides";
}

void report(const CageDamage& damage, size_t part, Reporter reporter) {
    const auto& [loose, faces, tCorners, sheets, fans, folds] = damage;
    reporter.add(part == 0 ? loose : Found(), "vertex has no face", "vertices have no face", "left out");
    reporter.add(faces.empty.of(part), "face has fewer than three different vertices or bounds nothing",
                 "faces have fewer than three different vertices or bound nothing", "left out");
    reporter.add(faces.repeating.of(part), "face passes a vertex twice", "faces pass a vertex twice",
                 "cut into simple faces");
    reporter.add(faces.ringed.of(part), "face goes round a hole over a bridge", "faces go round holes over bridges",
                 "cut into quads and triangles round " + std::string(faces.ringed.of(part).count > 1 ? "them" : "it"));
    reporter.add(faces.duplicated.of(part), "face is there twice", "faces are there twice", "left out");
    reporter.add(tCorners.corners.of(part), "T-corner", "T-corners", facetsMade(tCorners.sides.at(part)));
    // Copies at cut edges are told once: of the crowded ones if there are any.
    const std::string copies = ", " + vertexCopies(fans.copiesAtCuts.at(part));
    const bool crowded = sheets.crowded.of(part).count > 0;
    reporter.add(sheets.crowded.of(part), "edge has three or more faces", "edges have three or more faces",
                 "cut into sheets" + copies);
    reporter.add(sheets.turned.of(part), "face is turned against its neighbours",
                 "faces are turned against their neighbours", "turned round");
    reporter.add(sheets.unorientable.of(part), "edge joins two sides of one surface, as in a Moebius strip",
                 "edges join two sides of one surface, as in a Moebius strip",
                 "cut open" + (crowded ? std::string() : copies));
    reporter.add(fans.bowTies.of(part), "vertex has faces that are no single fan",
                 "vertices have faces that are no single fan", "one vertex for each fan");
    reporter.add(folds.folds.of(part), "inner vertex has two faces only", "inner vertices have two faces only",
                 foldRepairs(folds, part));
}

/// Every part needs a face.
Status checkParts(const Cage& cage, const Draft& draft, const CageNames& names) {
    std::vector<uint8_t> has(names.parts.size(), 0);
    for (const uint32_t face : draft.faces) {
        has[cage.faceParts.empty() ? 0 : cage.faceParts[face]] = 1;
    }
    for (size_t part = 0; part < has.size(); ++part) {
        if (has[part] == 0) {
            return Error{ErrorCode::asset, names.parts[part] + ": no face is left: all have fewer than three different "
                                                               "vertices or bound nothing"};
        }
    }
    return success();
}

/// Takes the names as a copy: a cage whose T-corners are mended has further corners.
Status repairDamaged(Cage& cage, SkinWeights& weights, Morphs& morphs, CageNames names, std::vector<Damage>& damages) {
    const Places places(cage, names);
    CageDamage damage;
    damage.loose = looseVertices(cage);
    Draft draft = withoutDuplicates(simpleFaces(cage, places, damage.faces), places, damage.faces);
    mendTCorners(cage, names, places, draft, damage.tCorners);
    std::vector<uint32_t> twins = joinFaces(cage, draft, places, damage.sheets);
    separateFans(draft, twins, damage.sheets.atCut, places, damage.fans);
    dissolveFolds(cage, draft, std::move(twins), places, damage.folds);
    for (size_t part = 0; part < names.parts.size(); ++part) {
        report(damage, part, Reporter(names.parts[part], damages));
    }
    if (Status status = checkParts(cage, draft, names); !status) {
        return status;
    }
    return applyDraft(draft, cage, weights, morphs);
}

bool hasTCorners(const Cage& cage, const Topology& topology) {
    const std::vector<Side> open = openSides(cage, topology);
    return !open.empty() && !findTCorners(cage.positions, {cage.faceStarts, cage.faceVertices}, open).empty();
}

} // namespace

Status repairCage(Cage& cage, SkinWeights& weights, Morphs& morphs, const CageNames& names,
                  std::vector<Damage>& damages) {
    const std::string element = names.parts.size() == 1 ? names.parts[0] + ": " : std::string("file: ");
    const Result<Topology> topology = buildTopology(cage);
    if (!topology && topology.error().code != ErrorCode::asset) {
        return Error{topology.error().code, element + topology.error().message};
    }
    try {
        if (topology && !hasTCorners(cage, *topology)) {
            return success();
        }
        const Status repaired = repairDamaged(cage, weights, morphs, names, damages);
        const bool named = repaired || repaired.error().code == ErrorCode::asset;
        return named ? repaired : Error{repaired.error().code, element + repaired.error().message};
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::hostMemory, element + "out of memory for repairing the cage"};
    }
}

namespace {

Refusal refusalOfDamages(const Character& character) {
    Refusal refusal{ErrorCode::asset, {}};
    for (const Damage& damage : character.damages) {
        refusal.faults.push_back(damage.found);
    }
    return refusal;
}

} // namespace

void reportDamages(Character& character, bool strict) {
    for (const Damage& damage : character.damages) {
        character.warnings.push_back(damage.found + "; " + damage.repair);
    }
    if (strict && !character.damages.empty()) {
        throw refusalOfDamages(character);
    }
}

Status refuseDamages(const Character& character) {
    return character.damages.empty() ? success() : Status(asError(refusalOfDamages(character), character.name));
}

} // namespace supple::cage
