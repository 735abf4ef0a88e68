// Tables of many recipes, for the tests of what checks those of files.
#pragma once

#include "cage/character.h"
#include "surface/recipe.h"
#include "surface/scheme.h"
#include "surface/table_check.h"

#include <string>
#include <vector>

namespace supple::test {

/// The cage with two UV sets, the second with a seam, and with colors, two materials and two parts.
[[nodiscard]] cage::Cage withAttributes(cage::Cage cage);

/// Recipes of a scheme: with and without attributes, tangents, frames of normal maps, levels of detail, an indexed mesh
/// and smooth texture coordinates, at rates, in both mappings.
[[nodiscard]] std::vector<surface::Recipe> recipesOf(surface::SchemeId scheme);
/// "P_m, lod, tangents": what tells the recipes of recipesOf() apart.
[[nodiscard]] std::string nameOf(const surface::Recipe& recipe);

/// What tables of a cage of withAttributes() were made of.
[[nodiscard]] surface::TableSource sourceOf(const surface::Recipe& recipe, const cage::Cage& cage);

} // namespace supple::test
