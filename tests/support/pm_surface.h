// A whole P_m surface on the CPU, with walks over its shared borders.
#pragma once

#include "tests/support/prep_surface.h"
#include "tools/reference/pm.h"

#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace supple::test {

/// The mesh of a cage that must be accepted.
inline surface::pm::Mesh pmMesh(const cage::Cage& cage) {
    Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(cage);
    if (!mesh.ok()) {
        ADD_FAILURE() << mesh.error().message;
        return {};
    }
    return std::move(*mesh);
}

/// Gives every edge end inside a sector a new alpha, from its vertex, the far vertex and the alpha it has.
inline void setAlphas(surface::pm::Mesh& mesh, const std::function<double(uint32_t, uint32_t, double)>& alpha) {
    for (surface::pm::Sector& sector : mesh.sectors) {
        sector.creased = false;
        for (uint32_t j = sector.closed() ? 0 : 1; j < sector.facets; ++j) {
            const uint32_t slot = sector.firstSlot + j;
            double& a = mesh.slotAlphas[slot];
            a = alpha(sector.vertex, mesh.topology.spokeVertices[mesh.slotSpokes[slot]], a);
            sector.creased = sector.creased || a != surface::pm::kSmoothAlpha;
        }
    }
}

template <class T>
struct PmSurface {
    using Vec = glm::vec<3, T>;

    PmSurface(surface::pm::Mesh source, const std::vector<Vec>& positions) : mesh(std::move(source)) {
        coefficients = surface::pm::construct<T>(mesh, positions);
        for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
            patches.push_back(surface::pm::gatherPatch<T>(mesh, coefficients, f));
        }
    }

    [[nodiscard]] surface::pm::Sample<T> at(uint32_t facet, uint32_t rate, uint32_t sample) const {
        const surface::pm::FacetClass facetClass = mesh.classes[facet];
        return surface::pm::evaluate<T>(patches[facet], surface::pm::domainPoint<T>(facetClass, rate, sample));
    }

    /// The patch edge of a half-edge.
    [[nodiscard]] uint32_t patchEdge(uint32_t corner) const {
        const uint32_t facet = mesh.topology.cornerFaces[corner];
        const uint32_t sides = mesh.cage.sides(facet);
        return (corner - mesh.cage.faceStarts[facet] + sides - mesh.firstCorners[facet]) % sides;
    }

    /// Sample k of `rate` on a half-edge, counted from its corner.
    [[nodiscard]] surface::pm::Sample<T> onEdge(uint32_t corner, uint32_t k, uint32_t rate) const {
        const uint32_t facet = mesh.topology.cornerFaces[corner];
        const surface::Domain domain = surface::pm::domainOf(mesh.classes[facet]);
        return at(facet, rate, surface::edgeSample(domain, rate, patchEdge(corner), k));
    }

    surface::pm::Mesh mesh;
    surface::pm::Coefficients<T> coefficients;
    std::vector<surface::pm::Patch<T>> patches;
};

} // namespace supple::test
