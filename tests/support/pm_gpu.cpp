#include "tests/support/pm_gpu.h"

#include "tools/reference/pm.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

namespace supple::test {

using surface::pm::Mesh;

GpuOptions pmOptions(SuppleMapping mapping, uint32_t rate) {
    GpuOptions options;
    options.scheme = SUPPLE_SCHEME_PM;
    options.mapping = mapping;
    options.rate = rate;
    return options;
}

PmPatches::PmPatches(const GpuSurface& gpu, const Mesh& mesh)
    : gpu_(gpu), mesh_(mesh), patches_(mesh.cage.faceCount(), cage::kNone) {
    constexpr SupplePatchClass kClasses[] = {SUPPLE_PATCH_REGULAR, SUPPLE_PATCH_POLAR, SUPPLE_PATCH_P3, SUPPLE_PATCH_P4,
                                             SUPPLE_PATCH_P5};
    // Two facets of one source face differ in their corners.
    std::map<std::vector<uint32_t>, uint32_t> facets;
    for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
        if (std::binary_search(mesh.cage.holes.begin(), mesh.cage.holes.end(), f)) {
            continue;
        }
        std::vector<uint32_t> key = {mesh.sourceFaces[f]};
        for (uint32_t i = 0; i < mesh.cage.sides(f); ++i) {
            key.push_back(mesh.cage.faceVertices[mesh.corner(f, i)]);
        }
        facets[std::move(key)] = f;
    }
    EXPECT_EQ(facets.size(), gpu.patches().size());
    SupplePatchClass last = SUPPLE_PATCH_REGULAR;
    for (const SupplePatchInfo& patch : gpu.patches()) {
        std::vector<uint32_t> key = {patch.face};
        key.insert(key.end(), patch.corners, patch.corners + patch.cornerCount);
        const auto found = facets.find(key);
        if (found == facets.end()) {
            ADD_FAILURE() << "patch " << facets_.size() << " of face " << patch.face << " is no facet of the mesh";
            facets_.push_back(0);
            continue;
        }
        EXPECT_EQ(patch.patchClass, kClasses[static_cast<size_t>(mesh.classes[found->second])]);
        EXPECT_GE(patch.patchClass, last) << "patches come class by class";
        last = patch.patchClass;
        patches_[found->second] = static_cast<uint32_t>(facets_.size());
        facets_.push_back(found->second);
    }
}

const GpuSurface::Vertex& PmPatches::onEdge(uint32_t instance, uint32_t corner, uint32_t k) const {
    const uint32_t f = mesh_.topology.cornerFaces[corner], m = mesh_.cage.sides(f);
    const uint32_t edge = (corner - mesh_.cage.faceStarts[f] + m - mesh_.firstCorners[f]) % m;
    const surface::Domain domain = surface::pm::domainOf(mesh_.classes[f]);
    return gpu_.vertex(instance, patches_[f], surface::edgeSample(domain, gpu_.output().grid.rate, edge, k));
}

bool PmPatches::shared(const cage::Topology::Edge& edge) const {
    return edge.twin != cage::kNone && patches_[mesh_.topology.cornerFaces[edge.corner]] != cage::kNone &&
           patches_[mesh_.topology.cornerFaces[edge.twin]] != cage::kNone;
}

ComparedBits PmPatches::sharedBits(uint32_t instance, const cage::Topology::Edge& edge) const {
    ComparedBits bits;
    const uint32_t rate = gpu_.output().grid.rate;
    for (uint32_t k = 0; k <= rate; ++k) {
        bits.compare(onEdge(instance, edge.corner, k).position, onEdge(instance, edge.twin, rate - k).position);
    }
    return bits;
}

} // namespace supple::test
