// Checks what the tables of the exact schemes have of vertices that are not plain (shaders/shared/chains.h). Private to
// chains/.
#pragma once

#include "surface/chains/check_bounds.h"
#include "surface/subdivision/pattern.h"

namespace supple::surface::chains {

/// Follows the records as shaders/chains/chain.comp does.
class ChainCheck {
public:
    /// `lastLevel`: of chains.
    ChainCheck(TableCheck& check, Subdivision subdivision, uint32_t lastLevel)
        : check_(check), subdivision_(subdivision), lastLevel_(lastLevel), arrangements_(check.tables()) {}

    /// The records of vertices. Once, before takeBlocks().
    [[nodiscard]] bool takeVertices(const Section& section);
    /// Blocks of whole chains, or of one level. `makes`: the kind of the kernel (shared::kMakesChains).
    [[nodiscard]] bool takeBlocks(const Section& section, uint32_t makes);

private:
    /// The fan at an element, whose words are checked. Null: a fault.
    struct CheckedFan {
        subdivision::Fan fan;
        uint32_t points = 0; ///< of a level of a chain
        [[nodiscard]] uint64_t spokes() const { return uint64_t{fan.sectors} + (fan.open ? 1 : 0); }
    };
    [[nodiscard]] bool readFan(uint64_t element, CheckedFan& fan);
    [[nodiscard]] bool takeVertex(uint64_t element);
    [[nodiscard]] bool checkNet(uint64_t word, uint64_t first, uint32_t points);
    [[nodiscard]] bool checkArrangement(uint64_t element, uint32_t ringPoints);
    [[nodiscard]] bool checkRuns(uint64_t element, uint64_t spokes);
    [[nodiscard]] bool checkSteps(uint64_t element, uint64_t spokes);
    [[nodiscard]] bool takeBlock(std::span<const uint32_t> block, uint32_t makes);
    [[nodiscard]] bool follows(uint64_t vertex, uint64_t count, uint32_t item, bool whole);
    [[nodiscard]] bool checkWholeChains(std::span<const uint32_t> block, const CheckedFan& fan);
    [[nodiscard]] bool checkLevel(std::span<const uint32_t> block, const CheckedFan& fan, uint32_t makes);

    TableCheck& check_;
    Subdivision subdivision_;
    uint32_t lastLevel_;
    SeenElements arrangements_;
    uint64_t netWords_ = 0; ///< of all vertices so far
    Section vertices_;
    /// By vertex: the first of those before it that have the same fan and chains, as it has; or that it has none.
    std::vector<uint32_t> firstAlike_;
    /// The last block: its first vertex, how many it has, and the first item that it leaves to the next.
    struct BlockPlace {
        uint64_t vertex = 0, count = 0, nextItem = 0;
    };
    BlockPlace last_;
};

} // namespace supple::surface::chains
