// Views whose levels and capacities are as chance would have them.
#pragma once

#include "runtime/context.h"
#include "tests/support/lod_surface.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace supple::test {

/// A context and a view whose passes are replaced: those of capacities, and of edges' levels unless they are to keep
/// their own. Failures are recorded in the test; check valid().
class RandomLevels {
public:
    enum class Edges { random, own };
    struct Options {
        SuppleMapping mapping = SUPPLE_MAPPING_NARROW;
        Edges edges = Edges::random;
        SuppleVertexFormat vertexFormat = SUPPLE_VERTEX_24;
        bool tangents = false;
        /// Records say capacities that their patches do not have. Those of their buckets and draws are right.
        bool wrongCapacities = false;
    };
    explicit RandomLevels(const Options& options);
    explicit RandomLevels(SuppleMapping mapping, Edges edges = Edges::random) : RandomLevels(Options{mapping, edges}) {}

    [[nodiscard]] bool valid() const { return context_ != nullptr; }

    /// What random levels of edges there are: from 1 to 63; to 4; below 1.
    enum class Range { all, low, least };
    void setRange(Range range);

    struct Drawn {
        LodSurface surface;
        std::vector<surface::PatchInfo> patches; ///< in device order
    };
    /// One instance in its bind pose; nothing where the scheme refuses the cage or has no levels for it. `desc`: scheme
    /// and what belongs to it. `vertexBudget`: scales levels down, unless 0.
    [[nodiscard]] std::optional<Drawn> draw(cage::Character character, SuppleGroupDesc desc, uint32_t vertexBudget = 0);

private:
    Edges edges_;
    std::unique_ptr<runtime::Context> context_;
    uint64_t view_ = 0, frame_ = 0;
    SuppleCameraDesc camera_{};
};

} // namespace supple::test
