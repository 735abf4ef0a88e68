// What the checks of tables share (surface/table_check.h). checkTables() makes the checks of the first part for every
// scheme, then Scheme::check, which may rely on them: behind them ranges of patches follow each other, have all
// patches, and their records are in the tables. The second part is for the checks of schemes.
#pragma once

#include "shaders/shared/surface.h"
#include "surface/table_check.h"

#include <algorithm>
#include <initializer_list>
#include <span>

namespace supple::surface {

// For every scheme.

/// What the library itself reads: enumerators, patches, ranges of patches and of draws, the layout of the pool, and
/// what must be as the recipe says.
void checkMembers(TableCheck& check);
/// That the header says what the members say, which have been checked.
void checkHeader(TableCheck& check);
/// Records of regular, perturbed and polar patches: indices of the pool, and of polar ones the weights of their apex.
void checkBicubicPatches(TableCheck& check);
/// Numbers of corner attributes, and that these and the smooth texture coordinates are in the tables. Leaves of texture
/// coordinates (Tables::uvLeaves) are the scheme's own business: they begin at PatchRange::smoothUvs.
void checkCornerAttributes(TableCheck& check);
/// MeshTables, and the records of edges. The record of a patch that an edge names is one of a class that has such
/// edges.
void checkIndexedMesh(TableCheck& check);
// lod::checkLevels(), of surface/lod/table_check.h, likewise.

// For the checks of schemes.

/// Whether all patches are of these classes.
bool checkClasses(TableCheck& check, std::initializer_list<PatchClass> classes);

/// Kernels of a scheme that run in a stage.
struct StageKernels {
    Stage stage = Stage::vertex;
    std::span<const KindOfKernel> kernels;
};
/// Whether all constructions run the scheme's own kernels in their stages.
bool checkKernels(TableCheck& check, std::initializer_list<StageKernels> kernels);

/// The index of a spoke's next one, as kernels compute it: it may wrap.
[[nodiscard]] inline uint32_t nextSpoke(uint32_t spokeWord) {
    using namespace shared; // the macro's constants
    return SUPPLE_NEXT_SPOKE(spokeWord);
}
/// Whether the pool has the limit point of a patch's corner, and the tangents and face coefficients of its spoke and of
/// the next one (SUPPLE_SPOKE).
bool checkPatchCorner(TableCheck& check, uint32_t point, uint32_t spokeWord);

/// Whether kernels may write so many coefficients of an instance. What tells the last level of its chains
/// (LodTables::depth) they may not touch: chains are followed as far as it says.
[[nodiscard]] inline bool checkTarget(TableCheck& check, uint64_t first, uint64_t count = 1) {
    const uint64_t depth = check.tables().lod.depth;
    return check.pool(first, count) && check.require(depth == 0 || depth < first || depth - first >= count,
                                                     "written where the last level of chains stands");
}

/// The largest of the first `count` numbers of 16 bits, two a word.
[[nodiscard]] inline uint32_t largestHalf(const uint32_t* words, uint32_t count) {
    uint32_t low = 0, high = 0;
    for (uint32_t k = 0; k < count / 2; ++k) {
        low = std::max(low, words[k] & 0xFFFFu);
        high = std::max(high, words[k] >> 16);
    }
    if (count % 2 != 0) {
        low = std::max(low, words[count / 2] & 0xFFFFu);
    }
    return std::max(low, high);
}

/// Follows the rows of a construction by stencils (surface/stencil_table.h) as shaders/subdivision/isolate.comp does:
/// the vertices and weights that they name, and the coefficients that they write. `vertices`: so many there are to
/// read, those before Construction::from counted.
[[nodiscard]] bool checkStencils(TableCheck& check, const Construction& construction, uint64_t vertices);

/// The range whose records include one that begins at an element; null if none does.
[[nodiscard]] const PatchRange* rangeOfRecord(const Tables& tables, uint64_t element);

/// Fans of p-rep, P_m and the plain vertices of Catmull-Clark. They have slots, one per spoke: a word of the ring, a
/// tangent and a face coefficient. Slots follow each other in the order in which constructions take the fans, so that
/// no two fans write the same.
class FanSlots {
public:
    /// Checks the words of the ring. Their corners are below `vertices`, which also have limit points.
    FanSlots(TableCheck& check, uint64_t vertices);
    /// Closed fans of four spokes (kRegularFan), of which nothing but the ring is in the tables.
    bool takeRegular(uint32_t count);
    /// A fan whose first slot a record names.
    bool take(uint32_t slot, uint64_t spokes);
    /// Whether the fans have all slots.
    bool done();
    [[nodiscard]] uint64_t count() const { return count_; }

private:
    TableCheck& check_;
    uint64_t count_ = 0, next_ = 0;
};
/// How many spokes the fan has whose weights writeFanWeights() wrote with one of the `openFlags` if it is open;
/// `alwaysOpen`: without any. 0 if the weights are not in the tables, which is a fault.
uint64_t checkFanWeights(TableCheck& check, uint32_t element, uint32_t openFlag, bool alwaysOpen = false);

} // namespace supple::surface
