// What builds the tables of each scheme, and checks those of files: Scheme::build and Scheme::check in the folder of
// the scheme. surface/schemes.cpp has the rows. `edges` is where a builder puts which sides of its patches are one
// edge; null: nobody asks. Schemes without levels and without patches in an indexed mesh leave it empty.
#pragma once

#include "base/result.h"
#include "surface/patch_edges.h"
#include "surface/recipe.h"
#include "surface/scheme.h"
#include "surface/table_check.h"

namespace supple::surface {

namespace prep {
/// Refuses a cage with faces other than quads: "face 12 has 5 sides: p-rep takes quads only". The cage may have
/// boundaries. Creases are ignored. O(faces).
[[nodiscard]] Result<Tables> build(const Recipe& recipe, const cage::Cage& cage, PatchEdges* edges = nullptr);
void check(TableCheck& check);
} // namespace prep

namespace pm {
/// Refuses a cage with too many classes of edges, with ErrorCode::limit. O(corners).
[[nodiscard]] Result<Tables> build(const Recipe& recipe, const cage::Cage& cage, PatchEdges* edges = nullptr);
/// See Scheme::boundsMargin.
[[nodiscard]] float boundsMargin(const cage::Cage& cage);
void check(TableCheck& check);
} // namespace pm

namespace fragments {
/// Fragments of Catmull-Clark. Refuses a vertex with so many edges that 16 bits do not number the points of its
/// fragment: "vertex 7 has 260 faces: ...".
[[nodiscard]] Result<Tables> build(const Recipe& recipe, const cage::Cage& cage, PatchEdges* edges = nullptr);
void check(TableCheck& check);
} // namespace fragments

namespace catmull_clark {
/// Catmull-Clark by patches of one quad each. Refuses a vertex with more faces than 16 bits number the points of its
/// chain: "vertex 7 has 6000 faces: ..". O(corners + classes of vertices).
[[nodiscard]] Result<Tables> build(const Recipe& recipe, const cage::Cage& cage, PatchEdges* edges = nullptr);
void check(TableCheck& check);
} // namespace catmull_clark

namespace chains {
/// Whether tables of Catmull-Clark or Loop for two rates along a patch edge make the same coefficients: their chains
/// have as many levels.
[[nodiscard]] bool haveSameChains(uint32_t rate, uint32_t other);
} // namespace chains

namespace loop {
/// Loop by patches of one triangle each. Refuses semi-sharp creases, and what catmull_clark::build() does.
[[nodiscard]] Result<Tables> build(const Recipe& recipe, const cage::Cage& cage, PatchEdges* edges = nullptr);
void check(TableCheck& check);
} // namespace loop

namespace blend {
/// O(corners + classes rate^2).
[[nodiscard]] Result<Tables> build(const Recipe& recipe, const cage::Cage& cage, PatchEdges* edges = nullptr);
/// See Scheme::boundsMargin.
[[nodiscard]] float boundsMargin(const cage::Cage& cage);
void check(TableCheck& check);
} // namespace blend

namespace polygons {
/// Takes any cage, manifold or not. Refuses one that is too large for 32-bit indices, with ErrorCode::limit.
/// O(corners log corners).
[[nodiscard]] Result<Tables> build(const Recipe& recipe, const cage::Cage& cage, PatchEdges* edges = nullptr);
void check(TableCheck& check);
} // namespace polygons

} // namespace supple::surface
