#include "surface/table_writer.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <tuple>

namespace supple::surface {

bool Tables::has(Stage stage) const {
    return std::any_of(constructions.begin(), constructions.end(),
                       [&](const Construction& c) { return c.stage == stage && c.section.count > 0; });
}

void sortPatches(std::vector<DraftPatch>& patches) {
    const auto before = [](const DraftPatch& a, const DraftPatch& b) {
        return std::tuple(a.info.patchClass, a.material, a.facet) < std::tuple(b.info.patchClass, b.material, b.facet);
    };
    if (!std::is_sorted(patches.begin(), patches.end(), before)) { // which they mostly are
        std::sort(patches.begin(), patches.end(), before);
    }
}

void finishTables(const cage::Cage& cage, const std::vector<DraftPatch>& patches, TableWriter& writer, Tables& tables) {
    tables.uvSets = cage.cornerUvs1.empty() ? 1 : 2;
    tables.faceUvs = !cage.cornerFaceUvs.empty();
    const auto putUv = [&](const std::vector<glm::vec2>& uvs, uint32_t corner) {
        const glm::vec2 uv = uvs.empty() ? glm::vec2(0.0f) : uvs[corner];
        writer.put({std::bit_cast<uint32_t>(uv.x), std::bit_cast<uint32_t>(uv.y)});
    };
    writer.reserve(size_t{tables.uvSets == 2 || tables.faceUvs ? 8u : 4u} * cage.cornerCount() +
                   4 * tables.ranges.size());
    for (PatchRange& range : tables.ranges) {
        range.attributes = writer.element();
        for (uint32_t p = range.firstPatch; p < range.firstPatch + range.section.count; ++p) {
            for (uint32_t i = 0; i < patches[p].info.cornerCount; ++i) {
                const uint32_t corner = patches[p].cageCorners[i];
                const glm::vec4 color = cage.cornerColors.empty() ? glm::vec4(1.0f) : cage.cornerColors[corner];
                const auto unorm16 = [&](int channel) {
                    return static_cast<uint32_t>(std::clamp(color[channel], 0.0f, 1.0f) * 65535.0f + 0.5f);
                };
                putUv(cage.cornerUvs, corner);
                writer.put({unorm16(0) | unorm16(1) << 16, unorm16(2) | unorm16(3) << 16});
                if (tables.uvSets == 2 || tables.faceUvs) {
                    putUv(cage.cornerUvs1, corner);
                    putUv(cage.cornerFaceUvs, corner);
                }
            }
        }
    }
    (void)writer.element();

    tables.patches.reserve(patches.size());
    for (const DraftPatch& patch : patches) {
        const Domain domain = domainOf(patch.info.patchClass);
        const auto index = static_cast<uint32_t>(tables.patches.size());
        if (tables.drawRanges.empty() || tables.drawRanges.back().material != patch.material ||
            tables.drawRanges.back().domain != domain) {
            tables.drawRanges.push_back({domain, index, 0, patch.material});
        }
        ++tables.drawRanges.back().patchCount;
        tables.patches.push_back(patch.info);
        tables.patches.back().material = patch.material;
    }
}

} // namespace supple::surface
