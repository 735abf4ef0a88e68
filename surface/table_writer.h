// Writes the tables of a scheme word by word, and the parts that all schemes have. Private to surface/.
#pragma once

#include "surface/scheme.h"

#include <algorithm>
#include <bit>
#include <initializer_list>

namespace supple::surface {

/// Appends words to the tables. Sections begin on element boundaries.
class TableWriter {
public:
    explicit TableWriter(std::vector<uint32_t>& words) : words_(words) {}
    /// Fills up with zeros to the next element boundary and returns that element.
    uint32_t element() {
        while (words_.size() % 4 != 0) {
            words_.push_back(0);
        }
        return static_cast<uint32_t>(words_.size() / 4);
    }
    /// Makes room for so many more words.
    void reserve(size_t words) {
        if (words_.size() + words > words_.capacity()) {
            words_.reserve(std::max(words_.size() + words, 2 * words_.capacity()));
        }
    }
    void put(std::initializer_list<uint32_t> values) { words_.insert(words_.end(), values); }

private:
    std::vector<uint32_t>& words_;
};

/// A weight, which was computed in double, as the device reads it.
[[nodiscard]] inline uint32_t floatBits(double value) {
    return std::bit_cast<uint32_t>(static_cast<float>(value));
}

/// A patch that is not in the tables yet: what decides its place there, and which corners of the cage are its corners.
struct DraftPatch {
    PatchInfo info;
    uint32_t facet = 0; ///< face of the cage that the scheme works on
    uint32_t material = cage::kNone;
    std::array<uint32_t, kMaxSides> cageCorners{}; ///< corners of that cage
};

/// One patch, still without a class, for every face of a refined cage that is no hole. `mesh` has `cage`,
/// `sourceFaces`, `holes` and `cornerSources` (see subdivision::Mesh).
template <class Mesh>
[[nodiscard]] std::vector<DraftPatch> draftPatches(const Mesh& mesh) {
    std::vector<DraftPatch> patches;
    patches.reserve(mesh.cage.faceCount());
    for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
        if (mesh.holes[f] != 0) {
            continue;
        }
        DraftPatch& patch = patches.emplace_back();
        patch.facet = f;
        patch.material = mesh.cage.faceMaterials.empty() ? cage::kNone : mesh.cage.faceMaterials[f];
        patch.info.face = mesh.sourceFaces[f];
        patch.info.cornerCount = mesh.cage.sides(f);
        for (uint32_t i = 0; i < patch.info.cornerCount; ++i) {
            patch.cageCorners[i] = mesh.cage.faceStarts[f] + i;
            patch.info.corners[i] = mesh.cornerSources[patch.cageCorners[i]];
        }
    }
    return patches;
}

/// Puts patches into device order: by class, then material, then facet.
void sortPatches(std::vector<DraftPatch>& patches);

/// Counts a patch, whose record comes next, among those of its class. `patch`: its index in device order.
void countPatch(PatchClass patchClass, uint32_t patch, TableWriter& writer, Tables& tables);
/// Counts a vertex, whose record comes next, among those of its kernel in the vertex pass.
void countVertex(const KindOfKernel& kernel, uint32_t coefficients, TableWriter& writer, Tables& tables);

/// Writes what every scheme's tables end with: corner attributes, draw ranges and the list of patches. `patches` are in
/// device order, and tables.ranges has their classes; this fills in PatchRange::attributes.
void finishTables(const cage::Cage& cage, const std::vector<DraftPatch>& patches, TableWriter& writer, Tables& tables);

} // namespace supple::surface
