// Faces that are made of a cage's faces: cutting those that a scheme has no patch for, and what every new face keeps.
#pragma once

#include "base/result.h"
#include "cage/topology.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace supple::surface {

/// How a face is cut. Corners are counted from a start corner of the face.
struct FaceCut {
    std::vector<std::vector<uint32_t>> parts;
    std::vector<std::array<uint32_t, 2>> diagonals;
};

/// Which faces a scheme cuts, and how.
struct SplitRule {
    uint32_t mostSides = 3; ///< of a face that stays whole
    FaceCut (*cut)(uint32_t sides) = nullptr;
    uint32_t startCorners = 0; ///< so many of a face's corners are tried
    /// A start corner is possible if none of its diagonals is an edge already. The possible one with the shortest
    /// diagonals in the rest pose is taken, the first one if several are equal; or simply the first one.
    bool shortest = false;
    const char* parts = ""; ///< for messages: "quads"
};

/// A cage with the vertices of the given one. Its faces have the order of those they came from, and their corner
/// attributes, materials and holes.
struct SplitCage {
    cage::Cage cage;
    cage::Topology topology;
    std::vector<uint32_t> sourceFaces; ///< per face: the given face it came from
    std::vector<std::string> notes;    ///< "2 faces have more than 5 sides, the first is face 12; split into quads"
};

/// Refuses what cage::buildTopology refuses, and a face without a possible start corner. Without a rule every face
/// stays whole.
[[nodiscard]] Result<SplitCage> splitFaces(const cage::Cage& cage, const SplitRule* rule = nullptr);

/// Calls `copy` with every attribute that corners carry.
template <class Copy>
void forEachCornerAttribute(const cage::Cage& from, cage::Cage& to, Copy&& copy) {
    copy(from.cornerUvs, to.cornerUvs);
    copy(from.cornerUvs1, to.cornerUvs1);
    copy(from.cornerColors, to.cornerColors);
    copy(from.cornerFaceUvs, to.cornerFaceUvs);
}

/// Ends a face of `to`, whose corners were added before. It is part of face `face` of `from`.
void closeFace(cage::Cage& to, const cage::Cage& from, uint32_t face);

} // namespace supple::surface
