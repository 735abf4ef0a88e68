// Surfaces whose patches are polynomials, one for each patch of the tables.
#pragma once

#include "cpu/patch_set.h"
#include "cpu/surface.h"
#include "surface/refinement.h"

#include <memory>
#include <vector>

namespace supple::cpu {

/// Each vertex as itself.
[[nodiscard]] std::vector<Form> vertexForms(uint32_t count);
/// The points of stencils.
[[nodiscard]] std::vector<Form> formsOf(const surface::Stencils& stencils);

class PatchSurface : public Surface {
public:
    [[nodiscard]] std::unique_ptr<Pose> newPose() const override;
    [[nodiscard]] Place placeOfSample(uint32_t patch, uint32_t rate, uint32_t sample, double inside) const override;
    void weigh(const Place& place, PointWeights& out) const override { set_.weigh(place, out); }

protected:
    explicit PatchSurface(Patches patches) : Surface(patches) {}
    [[nodiscard]] FastGrid fastGrid(const Pose& pose, uint32_t begin, uint32_t end, uint32_t rate,
                                    const GridOutput& out) const override;

    PatchSet set_; ///< in the order of the patches
};

} // namespace supple::cpu
