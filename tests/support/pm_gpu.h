// P_m groups on the device by the facets of their mesh, and the bits that neighboring patches share.
#pragma once

#include "surface/pm/mesh.h"
#include "tests/support/gpu_comparison.h"

#include <cstdint>
#include <vector>

namespace supple::test {

[[nodiscard]] GpuOptions pmOptions(SuppleMapping mapping, uint32_t rate);

/// Which patch is which facet. Fails the test where the device's patches are not the mesh's facets without its holes,
/// class by class. Group and mesh must outlive it.
class PmPatches {
public:
    PmPatches(const GpuSurface& gpu, const surface::pm::Mesh& mesh);

    [[nodiscard]] uint32_t facet(uint32_t patch) const { return facets_[patch]; }
    /// cage::kNone for holes.
    [[nodiscard]] uint32_t patch(uint32_t facet) const { return patches_[facet]; }

    /// Sample k of the half-edge that starts at a corner of the mesh.
    [[nodiscard]] const GpuSurface::Vertex& onEdge(uint32_t instance, uint32_t corner, uint32_t k) const;
    /// Whether an edge has a patch on both sides.
    [[nodiscard]] bool shared(const cage::Topology::Edge& edge) const;
    /// The border samples of an edge that two patches share.
    [[nodiscard]] ComparedBits sharedBits(uint32_t instance, const cage::Topology::Edge& edge) const;

private:
    const GpuSurface& gpu_;
    const surface::pm::Mesh& mesh_;
    std::vector<uint32_t> facets_;  ///< per patch
    std::vector<uint32_t> patches_; ///< per facet
};

} // namespace supple::test
