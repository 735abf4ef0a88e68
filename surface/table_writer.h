// Writes the tables of a scheme word by word, and the parts that all schemes have. Private to surface/.
#pragma once

#include "surface/patch_edges.h"
#include "surface/recipe.h"
#include "surface/scheme.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <initializer_list>
#include <span>

namespace supple::surface {

/// A weight, which was computed in double, as the device reads it.
[[nodiscard]] inline uint32_t floatBits(double value) {
    return std::bit_cast<uint32_t>(static_cast<float>(value));
}

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
    /// The word that comes next.
    [[nodiscard]] uint32_t word() const { return static_cast<uint32_t>(words_.size()); }
    /// Makes room for so many more words.
    void reserve(size_t words) {
        if (words_.size() + words > words_.capacity()) {
            words_.reserve(std::max(words_.size() + words, 2 * words_.capacity()));
        }
    }
    void put(std::initializer_list<uint32_t> values) { words_.insert(words_.end(), values); }
    void put(std::span<const uint32_t> values) { words_.insert(words_.end(), values.begin(), values.end()); }
    /// Numbers of 16 bits, two a word, the first in the low half. An even number of them.
    void putHalves(std::span<const uint32_t> values) {
        for (size_t i = 0; i < values.size(); i += 2) {
            words_.push_back(values[i] | values[i + 1] << 16);
        }
    }
    void putFloats(std::initializer_list<double> values) {
        for (const double value : values) {
            words_.push_back(floatBits(value));
        }
    }

private:
    std::vector<uint32_t>& words_;
};

/// Coefficients per instance such that every instance starts on 256 bytes.
[[nodiscard]] constexpr uint32_t poolStrideFor(uint32_t coefficients) {
    return (coefficients + shared::kPoolUnit - 1) / shared::kPoolUnit * shared::kPoolUnit;
}

/// A patch that is not in the tables yet, and which corners of the cage are its corners.
struct DraftPatch {
    PatchInfo info;
    uint32_t facet = 0;                            ///< face of the cage that the scheme works on
    std::array<uint32_t, kMaxSides> cageCorners{}; ///< corners of that cage
    uint32_t kind = 0;                             ///< patches of a class that evaluate alike lie side by side
};

/// What patches are made of: the faces of a cage that are no holes.
struct DraftFaces {
    const cage::Cage& cage;
    uint32_t hostVertices = 0;               ///< vertices of the cage that are the host's come first
    std::span<const uint32_t> sourceFaces{}; ///< per face: the host's; empty: all are the host's
    std::span<const uint8_t> firstCorners{}; ///< per face: the corner that is corner 0 of its patch; empty: 0
};
/// The patches in device order: by class, then material, part, kind and facet. `classOf` may set the kind.
[[nodiscard]] std::vector<DraftPatch> draftPatches(const DraftFaces& faces,
                                                   const std::function<PatchClass(DraftPatch&)>& classOf);

/// Counts a patch, whose record comes next, among those of its class. `patch`: its index in device order.
void countPatch(PatchClass patchClass, uint32_t patch, TableWriter& writer, Tables& tables);
/// Counts a vertex, whose record comes next, among those of its kernel in the vertex pass.
void countVertex(const KindOfKernel& kernel, uint32_t coefficients, TableWriter& writer, Tables& tables);

/// What a corner has besides its position, as the tables hold it (shaders/shared/surface.h): the first four words, and
/// eight if there is a second UV set or a face UV.
using CornerWords = std::array<uint32_t, 8>;
[[nodiscard]] CornerWords cornerWords(const cage::Cage& cage, uint32_t corner);
/// Notes in `tables` what corners of the cage have. Returns how many of their words are written: whole elements.
uint32_t noteAttributes(const cage::Cage& cage, Tables& tables);

/// Lists the patches and what is drawn. `patches` are in device order.
void listPatches(const std::vector<DraftPatch>& patches, Tables& tables);
/// Writes what every scheme's tables end with: corner attributes, draw ranges and the list of patches. `patches` are in
/// device order, and tables.ranges has their classes; this fills in PatchRange::attributes. `edges`, unless it is null,
/// is told what corners have.
void finishTables(const Recipe& recipe, const cage::Cage& cage, const std::vector<DraftPatch>& patches,
                  TableWriter& writer, Tables& tables, PatchEdges* edges);

} // namespace supple::surface
