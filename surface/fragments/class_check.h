// Checks a class of fragments in the tables (surface/table_check.h). Private to subdivision/.
#pragma once

#include "surface/table_check.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::surface::fragments {

/// How much of the tables the check has followed. Classes have few tables in common, so that no file can make it, or a
/// kernel, go through a long one for every class.
class Followed {
public:
    explicit Followed(TableCheck& check) : check_(check) {}
    /// Whether elements are there, and there were not too many before.
    bool elements(uint64_t first, uint64_t count);
    bool words(uint64_t first, uint64_t count);

private:
    bool add(uint64_t elements);

    TableCheck& check_;
    uint64_t elements_ = 0;
};

/// Which points of the scratch buffer are taken. Classes have them one after the other.
class ScratchRuns {
public:
    explicit ScratchRuns(TableCheck& check) : check_(check) {}
    bool take(uint32_t run, uint64_t points);
    [[nodiscard]] uint64_t end() const { return next_; }

private:
    TableCheck& check_;
    uint64_t next_ = 0;
};

/// A class, from its header on. What blocks name beside that is checked when they are.
class ClassCheck {
public:
    ClassCheck(TableCheck& check, Followed& followed, uint32_t header);

    /// Follows the header, all rows, and what fragments have.
    bool run(ScratchRuns& runs);

    // Behind run():
    [[nodiscard]] uint32_t header() const { return header_; }
    [[nodiscard]] uint32_t fragments() const { return fragments_; }
    [[nodiscard]] uint32_t net() const { return net_; }
    [[nodiscard]] uint32_t patches() const { return patches_; }
    [[nodiscard]] const Section& limitRows() const { return limitRows_; }
    /// Points that a workgroup holds at a time.
    [[nodiscard]] uint32_t sharedPoints() const;
    struct Level {
        uint32_t rows = 0, neighbours = 0, points = 0, run = 0;
    };
    [[nodiscard]] const Level& level(uint32_t step) const { return levels_[step]; }

    /// The cells that make points of a step, of those before.
    bool followCells(const Section& cells, uint32_t step);
    /// The words of a list of rows of a step.
    bool followList(uint32_t firstWord, uint32_t count, uint32_t step);
    bool followStrips(const Section& strips);

private:
    bool readHeader();
    bool findShape();
    bool followRows(uint32_t step);
    bool followRow(std::span<const uint32_t> row, uint32_t step);
    bool followLimitRows();
    bool followFragments();
    bool followMasks();
    bool followCentreSteps();
    /// Whether numbers of 16 bits, two a word, are points of a step.
    bool points(std::span<const uint32_t> halves, uint32_t count, uint32_t step);
    bool isPoint(uint64_t point, uint32_t step);
    [[nodiscard]] uint32_t last() const { return static_cast<uint32_t>(levels_.size()) - 1; }

    TableCheck& check_;
    Followed& followed_;
    const Fragments& all_;
    uint32_t header_; ///< element
    uint32_t fragments_ = 0, sectors_ = 0, spokes_ = 0;
    bool sharp_ = false, open_ = false;
    uint32_t net_ = 0, sharpness_ = 0, patches_ = 0, masks_ = 0, centreSteps_ = 0;
    Section limitRows_;
    std::vector<Level> levels_; ///< 0..steps
};

} // namespace supple::surface::fragments
