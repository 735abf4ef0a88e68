#include "tools/supple/view_facts.h"

#include <algorithm>

namespace supple::tools {

ViewFacts viewFactsOf(const host::FigureGroup& group, uint32_t joint) {
    constexpr float kMoves = 0.001f; // as much as a color tells
    const host::Figure& figure = group.figure();
    const host::CageMesh& cage = figure.cage();
    ViewFacts facts;
    facts.uvs = !cage.uvSets[0].empty();
    facts.secondUvs = !cage.uvSets[1].empty();
    facts.vertexColors = !cage.colors.empty();
    facts.normalMaps = figure.materials().hasNormalMaps();
    const std::vector<SuppleMaterialInfo>& materials = figure.materials().infos();
    for (size_t i = 0; i + 1 < materials.size(); ++i) { // the last one is for faces without a material
        const SuppleMaterialInfo& own = materials[i];
        facts.occlusionMaps = facts.occlusionMaps || own.occlusion.image != SUPPLE_NO_IMAGE ||
                              own.occlusion.alternateImage != SUPPLE_NO_IMAGE;
        const float largest = std::max({own.emissiveFactor[0], own.emissiveFactor[1], own.emissiveFactor[2]});
        facts.emission = facts.emission || largest * own.emissiveStrength > 0.0f;
    }
    for (const host::FigureSurface& surface : group.surfaces()) {
        facts.patchClasses |= surface.patchClasses;
    }
    if (joint < figure.jointNames().size()) {
        facts.joint = figure.jointNames()[joint];
    }
    facts.jointMoves = group.largestValue() > kMoves;
    return facts;
}

} // namespace supple::tools
