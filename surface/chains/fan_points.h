// Points of level 1 that closed fans of four faces make. Private to chains/.
#pragma once

#include "surface/chains/corners.h"
#include "surface/chains/needed_rows.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::surface::chains {

/// A fan loads all that the points of level 1 at its vertex, on its edges and in its faces are made of. So closed runs
/// (Corners::runs()) make those that are needed, beside coefficients of their own. A point that several could make is
/// that of the corner which comes first, so that its bits do not depend on how vertices are numbered.
class FanPoints {
public:
    /// `isNeeded`: by point of level 1, as refine() numbers them: whether a fan is to make it, if one can.
    FanPoints(const RefinedMesh& mesh, const Corners& corners, std::span<const uint8_t> isNeeded);

    /// A group is what a run makes.
    [[nodiscard]] const RowGroups& groups() const { return groups_; }
    /// cage::kNone: it makes none.
    [[nodiscard]] uint32_t groupOfRun(uint32_t run) const { return groupOfRun_[run]; }
    /// Which points, as records have it (shaders/shared/chains.h).
    [[nodiscard]] uint32_t bitsOf(uint32_t group) const { return bits_[group]; }

private:
    void add(const FanRun& run, std::span<const uint8_t> isNeeded);
    [[nodiscard]] bool makesEdge(uint32_t vertex, uint32_t corner) const;
    [[nodiscard]] bool makesFace(uint32_t vertex, uint32_t face) const;

    const RefinedMesh& mesh_;
    const Corners& corners_;
    StepPoints points_;
    std::vector<uint8_t> isClosed_; ///< by vertex: it has a closed run
    RowGroups groups_;
    std::vector<uint32_t> groupOfRun_, bits_;
};

} // namespace supple::surface::chains
