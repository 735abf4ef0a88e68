#include "surface/smooth_uvs.h"

#include "shaders/shared/chains.h"
#include "shaders/shared/prep.h"

#include <algorithm>

namespace supple::surface {
namespace {

/// As the device reads it: there is one zero.
uint32_t uvBits(float value) {
    return std::bit_cast<uint32_t>(value + 0.0f);
}

/// Two of them fill an element.
void putUv(const glm::vec2& value, TableWriter& writer) {
    writer.put({uvBits(value.x), uvBits(value.y)});
}

/// A corner's value, and another coefficient as offset from it. Both are rounded once, and every patch that has them
/// rounds the same numbers; so has every patch that meets them the same words, or the same sum of them.
struct Rounded {
    glm::vec2 corner, offset;
    Rounded(const glm::dvec2& v, const glm::dvec2& t) : corner(v), offset(t - v) {}
    [[nodiscard]] glm::vec2 sum() const { return corner + offset; }
};

/// The corner that a bicubic coefficient is an offset from.
uint32_t cornerOfNet(uint32_t k, bool polar) {
    return polar && k >= 8 ? 12 : (k & 12u) / 8 * 12 + (k & 3u) / 2 * 3;
}

void putNet(const UvPatch& patch, bool polar, TableWriter& writer) {
    for (uint32_t k = 0; k < (polar ? 13u : 16u); ++k) {
        const uint32_t corner = cornerOfNet(k, polar);
        putUv(k == corner ? glm::vec2(patch.c[k]) : Rounded(patch.c[corner], patch.c[k]).sum(), writer);
    }
}

/// In the order of evaluation.
void putPerturbation(const UvPatch& patch, TableWriter& writer) {
    for (uint32_t k = 0; k < 16; ++k) {
        putUv(glm::vec2(patch.c[16 + SUPPLE_PREP_FACE_EDGE(k)]), writer);
    }
}

/// The centre, then of every side what SectorSide of shaders/pm/sector.glsl has.
void putSectors(const UvPatch& patch, uint32_t sides, TableWriter& writer) {
    putUv(glm::vec2(patch.c[0]), writer);
    for (uint32_t i = 0; i < sides; ++i) {
        const glm::dvec2* own = &patch.c[1 + 6 * i];
        const glm::dvec2& v = own[0];
        const glm::dvec2& next = patch.c[1 + 6 * ((i + 1) % sides)];
        putUv(glm::vec2(v), writer);
        putUv(Rounded(v, own[1]).offset, writer);
        putUv(Rounded(next, own[2]).offset, writer);
        putUv(Rounded(v, own[3]).offset, writer);
        putUv(Rounded(next, own[4]).offset, writer);
        putUv(Rounded(patch.c[0], own[5]).offset, writer);
    }
}

void putPatch(PatchClass patchClass, const UvPatch& patch, TableWriter& writer) {
    if (rowOf(patchClass).hasSectors()) {
        putSectors(patch, cornerCount(domainOf(patchClass)), writer);
        writer.put({patch.singularCorners});
    } else {
        putNet(patch, patchClass == PatchClass::polar, writer);
        if (patchClass == PatchClass::perturbed) {
            putPerturbation(patch, writer);
        }
    }
    (void)writer.element();
}

} // namespace

uint32_t uvElements(PatchClass patchClass) {
    return (rowOf(patchClass).coefficients + 1) / 2;
}

uint32_t uvElements(const Tables& tables, PatchClass patchClass) {
    if (!tables.uvLeaves) {
        return uvElements(patchClass);
    }
    if (domainOf(patchClass) != Domain::triangle) {
        return shared::kSharpQuadElements;
    }
    return (haveSharpUvs(tables) ? shared::kSharpTriangleElements : shared::kIrregularTriangleElements) -
           shared::kTriangleCornerElement;
}

bool haveSharpUvs(const Tables& tables) {
    return tables.uvLeaves && std::any_of(tables.ranges.begin(), tables.ranges.end(), [](const PatchRange& range) {
               return range.patchClass == PatchClass::loopIrregularSharp;
           });
}

std::vector<const std::vector<glm::vec2>*> uvSetsOf(const cage::Cage& cage) {
    if (cage.cornerUvs.empty()) {
        return {};
    }
    if (cage.cornerUvs1.empty()) {
        return {&cage.cornerUvs};
    }
    return {&cage.cornerUvs, &cage.cornerUvs1};
}

Status writeSmoothUvs(const Recipe& recipe, const cage::Cage& cage, const std::vector<DraftPatch>& patches,
                      const std::function<Result<UvPatches>(const std::vector<glm::vec2>&)>& makeSet,
                      TableWriter& writer, Tables& tables) {
    if (recipe.uvMode == cage::UvMode::all || !recipe.attributes) {
        return success();
    }
    std::vector<UvPatches> sets;
    for (const std::vector<glm::vec2>* uvs : uvSetsOf(cage)) {
        Result<UvPatches> set = makeSet(*uvs);
        if (!set) {
            return set.error();
        }
        sets.push_back(std::move(*set));
    }
    if (sets.empty()) {
        return success();
    }
    tables.uvMode = recipe.uvMode;
    for (PatchRange& range : tables.ranges) {
        range.smoothUvs = writer.element();
        writer.reserve(size_t{4} * uvElements(range.patchClass) * sets.size() * range.section.count);
        for (uint32_t p = range.firstPatch; p < range.firstPatch + range.section.count; ++p) {
            for (const UvPatches& set : sets) {
                putPatch(range.patchClass, set(patches[p]), writer);
            }
        }
    }
    return success();
}

} // namespace supple::surface
