// Cages that schemes are judged on: the configurations of P_m's supplement round one vertex, and models of the same
// make as those that the papers measured.
#pragma once

#include "cage/character.h"

#include <cstdint>
#include <vector>

namespace supple::cage {

enum class GalleryShape : uint8_t { elliptic, saddle };

/// An open cage of quads, three rings round a vertex of this valence (3 or more), on z = -(x^2 + y^2) / 8 or on
/// z = (x^2 - y^2) / 8.
[[nodiscard]] Cage makeValenceCage(uint32_t valence, GalleryShape shape);
/// A polar one: a fan of so many triangles (3 or more), and two rings of as many quads.
[[nodiscard]] Cage makePolarCage(uint32_t valence, GalleryShape shape);

struct GalleryCage {
    const char* name = "";
    Cage cage;
};
/// Valences 3 and 5, polar 6 and 12, each elliptic and as a saddle.
[[nodiscard]] std::vector<GalleryCage> galleryCages();
/// All of them in one cage, in two rows.
[[nodiscard]] Cage makeGallery();

/// A block with three holes through it: 68 quads, valences 3, 4 and 5.
[[nodiscard]] Cage makeTripleDonut();
/// A shaft of several radii with eight keys on it: 1106 quads, nine tenths of them regular.
[[nodiscard]] Cage makeShaft();
/// A squat body with four bent legs, two eyes and a mouth: 1292 quads.
[[nodiscard]] Cage makeFrog();
/// So many copies of a cage side by side along x, as one cage.
[[nodiscard]] Cage makeRow(const Cage& cage, uint32_t count);

} // namespace supple::cage
