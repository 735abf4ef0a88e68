#include "surface/table_writer.h"

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <tuple>
#include <utility>

namespace supple::surface {

namespace {

/// Numbers what corners have, once for corners of a vertex that have the same.
class CornerNumbers {
public:
    CornerNumbers(const Recipe& recipe, const cage::Cage& cage)
        : recipe_(recipe), cage_(cage),
          alike_(recipe.mapFrames.empty() && cage.cornerUvs.empty() && cage.cornerUvs1.empty() &&
                 cage.cornerColors.empty() && cage.cornerFaceUvs.empty()),
          last_(alike_ ? 1 : cage.vertexCount(), cage::kNone) {}

    uint32_t of(uint32_t corner, uint32_t material) {
        uint32_t& last = last_[alike_ ? 0 : cage_.faceVertices[corner]];
        const CornerWords words = cornerWords(cage_, corner);
        const cage::MapFrame frame = cage::mapFrameOf(recipe_.mapFrames, material);
        uint32_t number = last;
        for (uint32_t tries = 0; number != cage::kNone && tries < kTries; ++tries, number = known_[number].before) {
            if (known_[number].words == words && known_[number].frame == frame) {
                return number;
            }
        }
        known_.push_back({words, frame, last});
        last = static_cast<uint32_t>(known_.size() - 1);
        return last;
    }

    [[nodiscard]] uint32_t count() const { return static_cast<uint32_t>(known_.size()); }
    /// The sign of a patch's area in the texture coordinates that tangents follow (shaders/evaluate/attributes.comp).
    /// `numbers`: of its corners.
    [[nodiscard]] int8_t handOf(std::span<const uint32_t> numbers) const {
        const glm::vec2 first = mapUv(numbers[0]);
        float area = 0.0f;
        for (size_t k = 0; k < numbers.size(); ++k) {
            const glm::vec2 p = mapUv(numbers[k]) - first, q = mapUv(numbers[(k + 1) % numbers.size()]) - first;
            area += p.x * q.y - p.y * q.x;
        }
        return static_cast<int8_t>(area > 0.0f ? 1 : area < 0.0f ? -1 : 0);
    }
    /// The first `count` words that a corner has, and the frame of its normal map.
    void put(uint32_t number, size_t count, TableWriter& writer) const {
        const Known& corner = known_[number];
        writer.put(std::span(corner.words).first(count));
        if (!recipe_.mapFrames.empty()) {
            writer.putFloats({corner.frame.down.x, corner.frame.down.y, corner.frame.hand});
            writer.put({corner.frame.uvSet});
        }
    }

private:
    static constexpr uint32_t kTries = 8; ///< a vertex of many thousand corners may not cost their square

    struct Known {
        CornerWords words;
        cage::MapFrame frame;
        uint32_t before = cage::kNone; ///< of the vertex
    };

    [[nodiscard]] glm::vec2 mapUv(uint32_t number) const {
        const auto& [words, frame, before] = known_[number];
        const size_t set = frame.uvSet == 1 && !cage_.cornerUvs1.empty() ? 4 : 0;
        const glm::vec2 uv(std::bit_cast<float>(words[set]), std::bit_cast<float>(words[set + 1]));
        return recipe_.mapFrames.empty() ? uv : frame.turn(uv);
    }

    const Recipe& recipe_;
    const cage::Cage& cage_;
    bool alike_;                 ///< corners have nothing
    std::vector<uint32_t> last_; ///< by vertex
    std::vector<Known> known_;
};

/// By patch (PatchEdges::hands). `numbers`: by corner, patch by patch.
std::vector<int8_t> handsOf(const CornerNumbers& known, const std::vector<DraftPatch>& patches,
                            std::span<const uint32_t> numbers) {
    std::vector<int8_t> hands;
    hands.reserve(patches.size());
    size_t next = 0;
    for (const DraftPatch& patch : patches) {
        hands.push_back(known.handOf(numbers.subspan(next, patch.info.cornerCount)));
        next += patch.info.cornerCount;
    }
    return hands;
}

void writeAttributes(const Recipe& recipe, const cage::Cage& cage, const std::vector<DraftPatch>& patches,
                     TableWriter& writer, Tables& tables, PatchEdges* edges) {
    const size_t elementWords = noteAttributes(cage, tables);
    tables.mapFrames = !recipe.mapFrames.empty();
    CornerNumbers known(recipe, cage);
    std::vector<uint32_t> numbers; // patch by patch
    numbers.reserve(cage.cornerCount());
    for (const DraftPatch& patch : patches) {
        for (uint32_t i = 0; i < patch.info.cornerCount; ++i) {
            numbers.push_back(known.of(patch.cageCorners[i], patch.info.material));
        }
    }
    tables.attributes = writer.element();
    writer.reserve(size_t{4} * tables.cornerElements() * known.count() + numbers.size());
    for (uint32_t number = 0; number < known.count(); ++number) {
        known.put(number, elementWords, writer);
    }
    tables.attributeHalves = known.count() <= 1u << 16;
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
    if (edges != nullptr) {
        edges->hands = recipe.tangents ? handsOf(known, patches, numbers) : std::vector<int8_t>();
        edges->attributes = std::move(numbers);
    }
}

} // namespace

CornerWords cornerWords(const cage::Cage& cage, uint32_t corner) {
    const auto uvOf = [&](const std::vector<glm::vec2>& uvs) { return uvs.empty() ? glm::vec2(0.0f) : uvs[corner]; };
    const glm::vec4 color = cage.cornerColors.empty() ? glm::vec4(1.0f) : cage.cornerColors[corner];
    const auto unorm16 = [&](int channel) {
        return static_cast<uint32_t>(std::clamp(color[channel], 0.0f, 1.0f) * 65535.0f + 0.5f);
    };
    const glm::vec2 uv = uvOf(cage.cornerUvs), uv1 = uvOf(cage.cornerUvs1), faceUv = uvOf(cage.cornerFaceUvs);
    const auto bits = [](float value) { return std::bit_cast<uint32_t>(value); };
    const uint32_t redGreen = unorm16(0) | unorm16(1) << 16, blueAlpha = unorm16(2) | unorm16(3) << 16;
    return {bits(uv.x), bits(uv.y), redGreen, blueAlpha, bits(uv1.x), bits(uv1.y), bits(faceUv.x), bits(faceUv.y)};
}

uint32_t noteAttributes(const cage::Cage& cage, Tables& tables) {
    tables.colors = std::any_of(cage.cornerColors.begin(), cage.cornerColors.end(),
                                [](const glm::vec4& color) { return color != glm::vec4(1.0f); });
    tables.uvSets = cage.cornerUvs1.empty() ? 1 : 2;
    tables.faceUvs = !cage.cornerFaceUvs.empty();
    return tables.uvSets == 2 || tables.faceUvs ? 8 : 4;
}

bool Tables::hasTangents() const {
    return triangles.indices.empty() ? !ranges.empty() && (!hasIndexedMesh() || mesh.tangents)
                                     : triangles.directions != 0;
}

const PatchRange& Tables::rangeOf(uint32_t patch) const {
    return *std::find_if(ranges.begin(), ranges.end(),
                         [&](const PatchRange& range) { return patch < range.firstPatch + range.section.count; });
}

bool Tables::has(Stage stage) const {
    return std::any_of(constructions.begin(), constructions.end(),
                       [&](const Construction& c) { return c.stage == stage && c.section.count > 0; });
}

std::vector<DraftPatch> draftPatches(const DraftFaces& faces, const std::function<PatchClass(DraftPatch&)>& classOf) {
    const cage::Cage& cage = faces.cage;
    std::vector<DraftPatch> patches;
    patches.reserve(cage.faceCount());
    auto hole = cage.holes.begin();
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        if (hole != cage.holes.end() && *hole == f) {
            ++hole;
            continue;
        }
        DraftPatch& patch = patches.emplace_back();
        patch.facet = f;
        patch.info.face = faces.sourceFaces.empty() ? f : faces.sourceFaces[f];
        patch.info.part = cage.faceParts.empty() ? 0 : cage.faceParts[f];
        patch.info.material = cage.faceMaterials.empty() ? cage::kNone : cage.faceMaterials[f];
        patch.info.cornerCount = cage.sides(f);
        const uint32_t first = faces.firstCorners.empty() ? 0 : faces.firstCorners[f];
        for (uint32_t i = 0; i < patch.info.cornerCount; ++i) {
            const uint32_t corner = cage.faceStarts[f] + (first + i) % patch.info.cornerCount;
            const uint32_t vertex = cage.faceVertices[corner];
            patch.cageCorners[i] = corner;
            patch.info.corners[i] = vertex < faces.hostVertices ? vertex : cage::kNone;
        }
        patch.info.patchClass = classOf(patch);
    }
    const auto before = [](const DraftPatch& a, const DraftPatch& b) {
        return std::tuple(a.info.patchClass, a.info.material, a.info.part, a.kind, a.facet) <
               std::tuple(b.info.patchClass, b.info.material, b.info.part, b.kind, b.facet);
    };
    if (!std::is_sorted(patches.begin(), patches.end(), before)) { // which they mostly are
        std::sort(patches.begin(), patches.end(), before);
    }
    return patches;
}

void countPatch(PatchClass patchClass, uint32_t patch, TableWriter& writer, Tables& tables) {
    if (tables.ranges.empty() || tables.ranges.back().patchClass != patchClass) {
        tables.ranges.push_back({patchClass, {writer.element(), 0}, patch, 0});
    }
    ++tables.ranges.back().section.count;
}

void countVertex(const KindOfKernel& kernel, uint32_t coefficients, TableWriter& writer, Tables& tables) {
    if (tables.constructions.empty() || !(tables.constructions.back().kernel == kernel)) {
        tables.constructions.push_back({Stage::vertex, kernel, {writer.element(), 0}, 0});
    }
    ++tables.constructions.back().section.count;
    tables.constructions.back().coefficients += coefficients;
}

void listPatches(const std::vector<DraftPatch>& patches, Tables& tables) {
    tables.patches.reserve(patches.size());
    for (const DraftPatch& patch : patches) {
        const Domain domain = domainOf(patch.info.patchClass);
        const auto index = static_cast<uint32_t>(tables.patches.size());
        if (tables.drawRanges.empty() || tables.drawRanges.back().part != patch.info.part ||
            tables.drawRanges.back().material != patch.info.material || tables.drawRanges.back().domain != domain) {
            tables.drawRanges.push_back({domain, index, 0, patch.info.part, patch.info.material});
        }
        ++tables.drawRanges.back().patchCount;
        tables.patches.push_back(patch.info);
    }
}

void finishTables(const Recipe& recipe, const cage::Cage& cage, const std::vector<DraftPatch>& patches,
                  TableWriter& writer, Tables& tables, PatchEdges* edges) {
    writeAttributes(recipe, cage, patches, writer, tables, edges);
    listPatches(patches, tables);
}

} // namespace supple::surface
