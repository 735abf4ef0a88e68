#include "runtime/prepared.h"

#include "skinning/clip_packer.h"

#include <algorithm>
#include <iterator>

namespace supple::runtime {

namespace {

PartSummary summaryOf(const cage::Character& character, size_t part) {
    const cage::Cage& cage = character.cage;
    const uint32_t begin = character.parts[part].firstFace, end = cage::endFace(character, part);
    PartSummary summary;
    for (uint32_t f = begin; f < end; ++f) {
        summary.materials.push_back(cage.faceMaterials.empty() ? cage::kNone : cage.faceMaterials[f]);
    }
    std::sort(summary.materials.begin(), summary.materials.end());
    summary.materials.erase(std::unique(summary.materials.begin(), summary.materials.end()), summary.materials.end());
    summary.low = summary.high = cage.positions[cage.faceVertices[cage.faceStarts[begin]]];
    for (uint32_t c = cage.faceStarts[begin]; c < cage.faceStarts[end]; ++c) {
        summary.low = glm::min(summary.low, cage.positions[cage.faceVertices[c]]);
        summary.high = glm::max(summary.high, cage.positions[cage.faceVertices[c]]);
    }
    if (character.parts[part].rigid) {
        const uint32_t vertex = cage.faceVertices[cage.faceStarts[begin]];
        summary.joint = character.weights.influences[character.weights.starts[vertex]].joint;
    }
    return summary;
}

/// Faces and corners of a piece's patches become those of the whole cage.
void nameInWhole(const cage::CagePiece& piece, std::vector<surface::PatchInfo>& patches) {
    for (surface::PatchInfo& patch : patches) {
        patch.face = piece.faces[patch.face];
        for (uint32_t& corner : patch.corners) {
            corner = corner == cage::kNone ? corner : piece.vertices[corner];
        }
    }
}

/// How much more curves bend in places than their cage says, by surface::Borders: found by
/// LodCrowds.OneLevelAnInstance. Those of the blending surface interpolate the cage; those of exact quads bend more
/// at irregular vertices.
constexpr float kUneven[] = {1.0f, 1.5f, 1.0f, 1.0f, 1.0f, 2.0f};
static_assert(std::size(kUneven) == static_cast<size_t>(surface::Borders::charts) + 1);

} // namespace

std::shared_ptr<Prepared> Prepared::of(cage::Character character) {
    auto prepared = std::make_shared<Prepared>();
    prepared->character = std::move(character);
    prepared->choices = surface::chooseSchemes(prepared->character);
    prepared->follow();
    return prepared;
}

void Prepared::follow() {
    deform = skinning::buildDeformTable(character, {});
    rig = skinning::makeRig(character);
    for (size_t part = 0; part < character.parts.size(); ++part) {
        parts.push_back(summaryOf(character, part));
    }
    jointFrames = skinning::jointFrames(character);
}

void Prepared::packClips(double error, double coarseError) {
    for (std::string& warning : skinning::packClips(character, error, coarseError)) {
        character.warnings.push_back(std::move(warning));
    }
    if (clips) {
        clips = skinning::buildClipTable(character);
    }
}

std::shared_ptr<const PreparedPiece> Prepared::pieceOf(const std::vector<uint32_t>& wanted) const {
    const auto known =
        std::find_if(pieces.begin(), pieces.end(), [&](const auto& piece) { return piece->parts == wanted; });
    if (known != pieces.end()) {
        return *known;
    }
    std::vector<uint32_t> faces;
    for (const uint32_t part : wanted) {
        for (uint32_t f = character.parts[part].firstFace; f < cage::endFace(character, part); ++f) {
            faces.push_back(f);
        }
    }
    return std::make_shared<PreparedPiece>(PreparedPiece{wanted, cage::takeFaces(character.cage, faces)});
}

std::shared_ptr<const PreparedTables> Prepared::find(const surface::Recipe& recipe, const PreparedPiece* piece) const {
    const auto known = std::find_if(tables.begin(), tables.end(), [&](const auto& own) {
        return own->recipe == recipe && own->piece.get() == piece;
    });
    return known != tables.end() ? *known : nullptr;
}

std::shared_ptr<const PreparedTables> Prepared::findServing(const surface::Recipe& recipe,
                                                            const PreparedPiece* piece) const {
    std::shared_ptr<const PreparedTables> best;
    for (const auto& own : tables) {
        if (own->piece.get() == piece && surface::serves(own->recipe, own->tables, recipe) &&
            (best == nullptr || own->recipe.rate < best->recipe.rate)) {
            best = own;
        }
    }
    return best;
}

Result<std::shared_ptr<PreparedTables>> Prepared::build(const surface::Recipe& recipe,
                                                        const std::shared_ptr<const PreparedPiece>& piece) const {
    Result<surface::Tables> built = surface::buildTables(recipe, cageOf(piece.get()));
    if (!built) {
        return Error{built.error().code, character.name + ": " + built.error().message};
    }
    if (piece != nullptr) {
        nameInWhole(piece->of, built->patches);
    }
    return std::make_shared<PreparedTables>(PreparedTables{recipe, piece, std::move(*built)});
}

surface::lod::InstanceMeasure Prepared::measureOf(const PreparedTables& of) const {
    const auto known =
        std::find_if(measures.begin(), measures.end(), [&](const Measure& measure) { return measure.tables == &of; });
    if (known != measures.end()) {
        return known->measure;
    }
    const cage::Cage& cage = cageOf(of.piece.get());
    if (!of.recipe.lod) { // rates count along edges of the cage
        return surface::lod::measureInstance(cage, 0, 1.0f, &character.cage);
    }
    return surface::lod::measureInstance(cage, of.tables.isolationSteps,
                                         kUneven[static_cast<size_t>(of.tables.lod.borders)], &character.cage);
}

} // namespace supple::runtime
