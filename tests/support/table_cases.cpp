#include "tests/support/table_cases.h"

#include "surface/schemes.h"

namespace supple::test {

namespace {

constexpr uint32_t kParts = 2, kMaterials = 2;

using surface::Recipe;

/// Each of the recipes twice: as it is and after `change`.
template <class Change>
std::vector<Recipe> both(std::vector<Recipe> recipes, Change&& change) {
    const size_t count = recipes.size();
    for (size_t i = 0; i < count; ++i) {
        Recipe other = recipes[i];
        change(other);
        recipes.push_back(other);
    }
    return recipes;
}

} // namespace

cage::Cage withAttributes(cage::Cage cage) {
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        for (uint32_t corner = cage.faceStarts[face]; corner < cage.faceStarts[face + 1]; ++corner) {
            const glm::vec3& p = cage.positions[cage.faceVertices[corner]];
            cage.cornerUvs.emplace_back(p.x + 0.3f * p.z, p.y - 0.2f * p.z);
            cage.cornerUvs1.emplace_back(p.y + (face % 2 == 0 ? 5.0f : 0.0f), p.x);
            cage.cornerColors.emplace_back(0.5f, 0.25f, 1.0f, 1.0f);
        }
        cage.faceMaterials.push_back(face % kMaterials);
        cage.faceParts.push_back(2 * face < cage.faceCount() ? 0 : kParts - 1);
    }
    return cage;
}

std::vector<Recipe> recipesOf(surface::SchemeId id) {
    const surface::Scheme& scheme = surface::schemeOf(id);
    std::vector<Recipe> recipes(1);
    recipes.front().scheme = id;
    for (const cage::UvMode mode : {cage::UvMode::none, cage::UvMode::cornersPlus1}) {
        if (scheme.interpolates(mode)) {
            recipes.push_back(recipes.front());
            recipes.back().uvMode = mode;
        }
    }
    recipes.push_back(recipes.front());
    recipes.back().attributes = false;
    recipes = both(std::move(recipes), [](Recipe& recipe) {
        recipe.tangents = true;
        if (recipe.attributes) {
            recipe.mapFrames = {cage::MapFrame{}, cage::MapFrame{1, {1.0f, 0.0f}, -1.0f}};
        }
    });
    if (scheme.hasIndexedMesh) {
        recipes = both(std::move(recipes), [](Recipe& recipe) { recipe.indexedMesh = true; });
    }
    if (scheme.hasLevels) {
        recipes = both(std::move(recipes), [](Recipe& recipe) { recipe.lod = true; });
    }
    if (scheme.rates == surface::RateRule::upTo) {
        recipes = both(std::move(recipes), [](Recipe& recipe) { recipe.wide = true; });
    }
    if (id == surface::SchemeId::prep) {
        recipes = both(std::move(recipes),
                       [](Recipe& recipe) { recipe.prep.cornerRule = surface::prep::CornerRule::smooth; });
    }
    for (size_t i = 0; i < recipes.size(); ++i) {
        const uint32_t asked = i % 2 == 0 ? 8 : 5;
        recipes[i].rate = scheme.tableRate(asked, recipes[i].lod);
    }
    return recipes;
}

std::string nameOf(const Recipe& recipe) {
    std::string name = surface::schemeOf(recipe.scheme).name;
    name += recipe.attributes ? std::string(", UVs: ") + cage::uvModeName(recipe.uvMode) : ", no attributes";
    name += recipe.tangents ? ", tangents" : "";
    name += recipe.indexedMesh ? ", indexed mesh" : "";
    name += recipe.lod ? ", levels" : "";
    name += recipe.wide ? ", wide" : "";
    name += recipe.prep.cornerRule == surface::prep::CornerRule::smooth ? ", smooth corners" : "";
    return name + ", rate " + std::to_string(recipe.rate);
}

surface::TableSource sourceOf(const Recipe& recipe, const cage::Cage& cage) {
    return {recipe, cage.vertexCount(), cage.faceCount(), kParts, kMaterials};
}

} // namespace supple::test
