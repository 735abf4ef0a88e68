#include "surface/table_writer.h"

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <tuple>
#include <unordered_map>

namespace supple::surface {

namespace {

/// What a corner has, as the tables hold it.
using CornerWords = std::array<uint32_t, 8>;

struct HashOfWords {
    size_t operator()(const CornerWords& words) const {
        uint64_t hash = 0;
        for (const uint32_t word : words) {
            hash = (std::rotl(hash, 25) ^ word) * 0x9E3779B97F4A7C15u;
        }
        return static_cast<size_t>(hash ^ hash >> 32);
    }
};

void writeAttributes(const cage::Cage& cage, const std::vector<DraftPatch>& patches, TableWriter& writer,
                     Tables& tables) {
    tables.uvSets = cage.cornerUvs1.empty() ? 1 : 2;
    tables.faceUvs = !cage.cornerFaceUvs.empty();
    const bool more = tables.uvSets == 2 || tables.faceUvs;
    const auto attributesOf = [&](uint32_t corner) {
        const auto uvOf = [&](const std::vector<glm::vec2>& uvs) {
            return uvs.empty() ? glm::vec2(0.0f) : uvs[corner];
        };
        const glm::vec4 color = cage.cornerColors.empty() ? glm::vec4(1.0f) : cage.cornerColors[corner];
        const auto unorm16 = [&](int channel) {
            return static_cast<uint32_t>(std::clamp(color[channel], 0.0f, 1.0f) * 65535.0f + 0.5f);
        };
        const glm::vec2 uv = uvOf(cage.cornerUvs), uv1 = uvOf(cage.cornerUvs1), faceUv = uvOf(cage.cornerFaceUvs);
        const auto bits = [](float value) { return std::bit_cast<uint32_t>(value); };
        return CornerWords{bits(uv.x),
                           bits(uv.y),
                           unorm16(0) | unorm16(1) << 16,
                           unorm16(2) | unorm16(3) << 16,
                           bits(uv1.x),
                           bits(uv1.y),
                           bits(faceUv.x),
                           bits(faceUv.y)};
    };
    tables.attributes = writer.element();
    std::unordered_map<CornerWords, uint32_t, HashOfWords> known;
    std::vector<uint32_t> numbers; // patch by patch
    known.reserve(cage.vertexCount());
    numbers.reserve(cage.cornerCount());
    for (const DraftPatch& patch : patches) {
        for (uint32_t i = 0; i < patch.info.cornerCount; ++i) {
            const CornerWords words = attributesOf(patch.cageCorners[i]);
            const auto [found, isNew] = known.try_emplace(words, static_cast<uint32_t>(known.size()));
            numbers.push_back(found->second);
            for (size_t w = 0; isNew && w < (more ? 8 : 4); ++w) {
                writer.put({words[w]});
            }
        }
    }
    tables.attributeHalves = known.size() <= 1u << 16;
    size_t next = 0;
    for (PatchRange& range : tables.ranges) {
        range.attributes = 4 * writer.element();
        size_t end = next;
        for (uint32_t p = range.firstPatch; p < range.firstPatch + range.section.count; ++p) {
            end += patches[p].info.cornerCount;
        }
        for (; next < end; ++next) {
            const bool pair = tables.attributeHalves && next + 1 < end;
            writer.put({pair ? numbers[next] | numbers[next + 1] << 16 : numbers[next]});
            next += pair ? 1 : 0;
        }
    }
    (void)writer.element();
}

} // namespace

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
    writeAttributes(cage, patches, writer, tables);
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
