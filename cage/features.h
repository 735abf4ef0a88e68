// Creases, sharp vertices and crease scalars of a cage, laid on its topology: what every surface scheme asks.
#pragma once

#include "cage/topology.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::cage {

struct Features {
    std::vector<float> edgeSharpness;   ///< per edge of the topology; boundary edges have kHardSharpness
    std::vector<uint32_t> edgeSets;     ///< per edge: its crease set, kNone where it is in none; empty if none is
    std::vector<float> vertexSharpness; ///< per vertex
    std::vector<float> spokeAlphas;     ///< per spoke slot: the cage's crease scalar there, -1 where it gives none
    /// What names no edge or vertex of the cage, or no scalar, one line for each kind; the rest is used.
    std::vector<std::string> unused;

    [[nodiscard]] bool hard(uint32_t edge) const { return edgeSharpness[edge] >= kHardSharpness; }
};

/// Of several creases on one edge, or sharp vertices at one vertex, the sharpest counts; of several scalars at one end
/// of an edge the last. Negative or NaN sharpness counts as 0. A scalar outside 0..1 is not used.
/// O(corners), and for each crease the smaller valence of its ends.
[[nodiscard]] Features buildFeatures(const Cage& cage, const Topology& topology);

/// For the notes of schemes other than P_m: crease scalars, which they do not use, and crease sets, which instances
/// cannot change there.
[[nodiscard]] std::vector<std::string> notesOnAlphas(const Cage& cage);

/// For the notes of schemes that make corners of Cage::roundCorners; empty if there are none.
[[nodiscard]] std::string sharpRoundCorners(const Cage& cage);

} // namespace supple::cage
