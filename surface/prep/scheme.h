// p-rep as a scheme: which cages it takes, and the static tables it makes of one.
#pragma once

#include "base/result.h"
#include "cage/topology.h"
#include "surface/prep/weights.h"

#include <array>
#include <cstdint>
#include <vector>

namespace supple::surface::prep {

/// p-rep takes cages of quads, closed or with boundaries; `topology` has already passed cage::buildTopology. Otherwise
/// the reason: "face 12 has 5 sides: p-rep takes quads only".
[[nodiscard]] Status accepts(const cage::Cage& cage, const cage::Topology& topology);

/// Whether an edge carries a perturbation: an interior edge with an irregular end.
[[nodiscard]] bool isPerturbed(const cage::Cage& cage, const cage::Topology& topology, uint32_t edge);

enum class PatchClass : uint32_t { regular = 0, perturbed = 1 };

/// One patch in device order: u runs from corner 0 to corner 1, v from corner 0 to corner 3.
struct PatchInfo {
    uint32_t face = 0;
    PatchClass patchClass = PatchClass::regular;
    std::array<uint32_t, 4> corners{};
};

/// Consecutive patches of one material.
struct DrawRange {
    uint32_t firstPatch = 0;
    uint32_t patchCount = 0;
    uint32_t material = cage::kNone;
};

/// A run of records in the tables.
struct Section {
    uint32_t table = 0; ///< first element (four words)
    uint32_t count = 0; ///< records
};

/// What depends on connectivity alone: the tables of shaders/shared/prep.h, and where everything lies in them. Patches
/// are ordered by class (regular first), then by material, then by face.
struct Tables {
    std::vector<uint32_t> words; ///< a multiple of four
    Section regularVertices, otherVertices, edges, regularPatches, perturbedPatches;
    uint32_t ring = 0;          ///< first word of the ring
    uint32_t attributes = 0;    ///< first element of the corner attributes
    uint32_t poolStride = 0;    ///< coefficients an instance, padded so that instances start on 256 bytes
    uint32_t tangents = 0;      ///< first TG in the pool
    uint32_t faces = 0;         ///< first FC in the pool
    bool cornerNormals = false; ///< some corner needs its stored normal (CornerRule::smooth)
    std::vector<PatchInfo> patches;
    std::vector<DrawRange> drawRanges;
};

/// `cage` must be accepted. O(faces).
[[nodiscard]] Tables buildTables(const cage::Cage& cage, const cage::Topology& topology, const Options& options);

} // namespace supple::surface::prep
