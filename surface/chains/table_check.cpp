// Checks the tables of the exact schemes (surface/table_check.h).
#include "shaders/shared/subdivision.h"
#include "surface/build.h"
#include "surface/chains/chain_check.h"
#include "surface/chains/chain_tables.h"
#include "surface/chains/kernels.h"
#include "surface/chains/leaf_check.h"
#include "surface/stencil_table.h"
#include "surface/table_check_common.h"

#include <array>
#include <bit>
#include <span>

namespace supple::surface {
namespace chains {
namespace {

bool checkOwnKernels(TableCheck& check, Subdivision subdivision) {
    using namespace shared;
    const bool quads = subdivision == Subdivision::catmullClark;
    const std::array chains = {chainKernel(subdivision, kMakesLimits, Stage::assemble),
                               chainKernel(subdivision, kMakesFirstLevel, Stage::assemble),
                               chainKernel(subdivision, kMakesLevel, Stage::assemble),
                               chainKernel(subdivision, kMakesChains, Stage::assemble)};
    const std::array deeper = {chainKernel(subdivision, kMakesLevel, Stage::deepen)};
    const std::array ofCage = {stencilKernel(false, kHalfWords), stencilKernel(false, kWholeWords),
                               plainVertexKernel(kPointsFan, false), plainVertexKernel(kRegularFan, false),
                               plainVertexKernel(kFewFan, false)};
    const std::array inPool = {stencilKernel(true, kHalfWords), stencilKernel(true, kWholeWords),
                               plainVertexKernel(kPointsFan, true), plainVertexKernel(kRegularFan, true),
                               plainVertexKernel(kFewFan, true)};
    return checkKernels(check, {{Stage::vertex, std::span(ofCage).first(quads ? 5 : 2)},
                                {Stage::assemble, std::span(inPool).first(quads ? 5 : 0)},
                                {Stage::assemble, chains},
                                {Stage::deepen, deeper}});
}

bool isPlain(const Construction& construction) {
    return construction.kernel.kernel == Kernel::chainsVertex ||
           construction.kernel.kernel == Kernel::chainsVertexMeshInPool;
}

/// The checks of both schemes, and what they know of each other.
class ExactCheck {
public:
    ExactCheck(TableCheck& check, Subdivision subdivision)
        : check_(check), tables_(check.tables()), subdivision_(subdivision),
          lastLevel_(lastChainLevel(check.tables().rate)), steps_(check.tables().isolationSteps == 1) {}

    void run() {
        (void)(checkMembers() && checkOwnKernels(check_, subdivision_) && checkPlain() && checkStencilRows() &&
               checkChains() && checkLeaves());
    }

private:
    bool checkMembers() {
        using enum PatchClass;
        const bool fits = subdivision_ == Subdivision::loop
                              ? checkClasses(check_, {loopRegular, loopIrregular, loopIrregularSharp})
                              : checkClasses(check_, {regular, irregular, irregularSharp, creased});
        check_.begin("tables");
        // A step, three kinds of plain vertices, other points of level 1, limits, whole chains, then levels.
        const uint64_t most = uint64_t{8} + lastLevel_;
        if (!check_.within(0, tables_.constructions.size(), most, "constructions")) {
            return false;
        }
        // Kernels look for the length of a chain even where there is none.
        return fits && check_.elements(0, shared::kNetListElements) && checkMesh();
    }

    /// Where the vertices are that plain vertices and points of level 1 are made of: the cage, or behind a step the
    /// pool.
    bool checkMesh() {
        if (!steps_) {
            vertices_ = check_.source().vertices;
            return check_.require(tables_.meshVertices == 0, "vertices of a step in the pool");
        }
        const auto& first = tables_.constructions;
        if (!check_.require(!first.empty() && first[0].kernel.kernel == Kernel::subdivisionIsolate &&
                                first[0].to == tables_.meshVertices,
                            "no step makes the vertices in the pool")) {
            return false;
        }
        vertices_ = first[0].coefficients;
        return check_.pool(tables_.meshVertices, vertices_);
    }

    /// Whether constructions work on the vertices that there are.
    bool isOfMesh(const Construction& construction, Kernel inPool) {
        return check_.require((construction.kernel.kernel == inPool) == steps_, "not of the mesh of the patches");
    }

    bool checkPlain() {
        if (subdivision_ == Subdivision::loop) {
            return true;
        }
        // What kernels write for all of them: first limit points, then tangents, then face coefficients.
        const uint64_t slots = tables_.faces - uint64_t{tables_.tangents};
        if (!check_.require(tables_.tangents <= tables_.faces, "face coefficients before tangents") ||
            !checkTarget(check_, 0, tables_.faces + slots)) {
            return false;
        }
        FanSlots fans(check_, vertices_);
        if (check_.failed()) {
            return false;
        }
        for (const Construction& construction : tables_.constructions) {
            if (isPlain(construction) && !takePlain(construction, fans)) {
                return false;
            }
        }
        return fans.done();
    }

    bool takePlain(const Construction& construction, FanSlots& fans) {
        check_.begin("plain vertices");
        if (!isOfMesh(construction, Kernel::chainsVertexMeshInPool)) {
            return false;
        }
        const uint64_t count = construction.section.count;
        if (construction.kernel.kind == shared::kRegularFan) {
            return check_.require(construction.from <= fans.count() / 4, "regular ones behind all slots") &&
                   fans.take(4 * construction.from, 4 * count);
        }
        if (construction.kernel.kind == shared::kPointsFan) {
            return fans.takeRegular(construction.section.count) && checkFanPoints(construction.section);
        }
        constexpr uint64_t kWords = 3;
        const uint64_t first = uint64_t{4} * construction.section.table;
        if (!check_.words(first, kWords * count)) {
            return false;
        }
        for (uint64_t word = first; word < first + kWords * count; word += kWords) {
            const uint64_t spokes = checkFanWeights(check_, check_.word(word + 1), 0, true);
            if (spokes == 0 || !check_.within(0, spokes, shared::kFewSpokes, "spokes") ||
                !fans.take(check_.word(word), spokes) || !checkTarget(check_, check_.word(word + 2))) {
                return false;
            }
        }
        return true;
    }

    /// What fans with points write besides.
    bool checkFanPoints(const Section& section) {
        const uint64_t first = uint64_t{4} * section.table, end = first + uint64_t{2} * section.count;
        if (!check_.words(first, end - first)) {
            return false;
        }
        for (uint64_t word = first; word < end; word += 2) {
            const uint32_t made = check_.word(word + 1);
            if (!check_.require(made < 1u << shared::kFanPoints, "points that fans do not have") ||
                !checkTarget(check_, check_.word(word), static_cast<uint32_t>(std::popcount(made)))) {
                return false;
            }
        }
        return true;
    }

    bool checkStencilRows() {
        for (const Construction& construction : tables_.constructions) {
            if (!isByStencils(construction)) {
                continue;
            }
            check_.begin("stencils");
            const bool inPool = construction.kernel.kernel == Kernel::subdivisionIsolateMeshInPool;
            const uint64_t vertices =
                inPool ? uint64_t{tables_.meshVertices} + vertices_ : uint64_t{check_.source().vertices};
            if (!check_.require(!inPool || steps_, "of vertices that are not in the pool") ||
                !checkStencils(check_, construction, vertices)) {
                return false;
            }
        }
        return true;
    }

    /// Vertices first: blocks name them.
    bool checkChains() {
        ChainCheck chains(check_, subdivision_, lastLevel_);
        const auto makes = [&](const Construction& c) { return !isByStencils(c) && !isPlain(c); };
        for (const Construction& construction : tables_.constructions) {
            if (makes(construction) && construction.kernel.kind == shared::kMakesLimits &&
                !chains.takeVertices(construction.section)) {
                return false;
            }
        }
        for (const Construction& construction : tables_.constructions) {
            if (makes(construction) && construction.kernel.kind != shared::kMakesLimits &&
                !chains.takeBlocks(construction.section, construction.kernel.kind)) {
                return false;
            }
        }
        return true;
    }

    bool checkLeaves() {
        LeafCheck leaves(check_, subdivision_, lastLevel_);
        return leaves.takePatches() && leaves.takeSmoothUvs();
    }

    TableCheck& check_;
    const Tables& tables_;
    Subdivision subdivision_;
    uint32_t lastLevel_; ///< of chains
    bool steps_;         ///< patches are made of what a step makes of the cage
    uint64_t vertices_ = 0;
};

} // namespace
} // namespace chains

namespace catmull_clark {

void check(TableCheck& check) {
    chains::ExactCheck(check, Subdivision::catmullClark).run();
}

} // namespace catmull_clark

namespace loop {

void check(TableCheck& check) {
    chains::ExactCheck(check, Subdivision::loop).run();
}

} // namespace loop
} // namespace supple::surface
