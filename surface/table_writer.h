// Writing the tables of a scheme, word by word, and the parts of them all schemes share. Private to surface/.
#pragma once

#include "surface/scheme.h"

#include <algorithm>
#include <bit>
#include <initializer_list>

namespace supple::surface {

/// Appends table sections and keeps them on element boundaries.
class TableWriter {
public:
    explicit TableWriter(std::vector<uint32_t>& words) : words_(words) {}
    /// Fills up to an element boundary and returns the element there.
    uint32_t element() {
        while (words_.size() % 4 != 0) {
            words_.push_back(0);
        }
        return static_cast<uint32_t>(words_.size() / 4);
    }
    /// Room for so many words more.
    void reserve(size_t words) {
        if (words_.size() + words > words_.capacity()) {
            words_.reserve(std::max(words_.size() + words, 2 * words_.capacity()));
        }
    }
    void put(std::initializer_list<uint32_t> values) { words_.insert(words_.end(), values); }

private:
    std::vector<uint32_t>& words_;
};

/// A weight computed in double, as the device reads it.
[[nodiscard]] inline uint32_t floatBits(double value) {
    return std::bit_cast<uint32_t>(static_cast<float>(value));
}

/// A patch on its way into the tables: what the device order depends on, and which corners of the cage are its corners.
struct DraftPatch {
    PatchInfo info;
    uint32_t facet = 0; ///< of the cage the scheme works on
    uint32_t material = cage::kNone;
    std::array<uint32_t, kMaxSides> cageCorners{}; ///< of that cage
};

/// The faces of a refined cage as patches, but for their classes: all that are no holes, in their order.
/// `mesh`: has `cage`, `sourceFaces`, `holes` and `cornerSources`, as surface::Level and its schemes say.
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

/// Corner attributes, draw ranges and patch list of patches in device order. tables.ranges must have been filled with
/// the patches' classes; their `attributes` are set here.
void finishTables(const cage::Cage& cage, const std::vector<DraftPatch>& patches, TableWriter& writer, Tables& tables);

} // namespace supple::surface
