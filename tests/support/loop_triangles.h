// The triangles that Loop patches are made of, and what is known of their corners.
#pragma once

#include "surface/chains/triangles.h"
#include "surface/scheme.h"
#include "surface/subdivision/mesh.h"
#include "tests/support/chain_depth.h"
#include "tests/support/gpu_comparison.h"

#include <utility>

namespace supple::test {

/// The cage must be accepted.
struct LoopTriangles {
    explicit LoopTriangles(const cage::Cage& cage) : isolation(isolationOf(cage)), triangles(isolation.parent) {}

    /// `patches`: of a group.
    template <class Patches>
    [[nodiscard]] PatchFaces patches(const Patches& patches) const {
        PatchFaces found = patchFaces(
            isolation.parent, patches, [&](uint32_t face) { return classOf(face); },
            [&](uint32_t face) { return triangles.chainsOf(face); });
        for (uint32_t f = 0; f < isolation.parent.cage.faceCount(); ++f) {
            found.firstCorners.push_back(triangles.firstCorner(f));
        }
        return found;
    }
    /// Weights of a patch's corners as those of its face.
    [[nodiscard]] static glm::dvec3 inFace(const glm::dvec3& weights, uint32_t firstCorner) {
        const int first = static_cast<int>(firstCorner);
        return {weights[(3 - first) % 3], weights[(4 - first) % 3], weights[(5 - first) % 3]};
    }

    /// Where a view takes a sample of a patch, if chains go up to level `depth`.
    [[nodiscard]] ConePlace<glm::dvec3> atLevels(uint32_t face, const glm::dvec3& weights, uint32_t depth) const {
        const double nearest = std::exp2(-static_cast<double>(depth));
        for (int corner = 0; corner < 3; ++corner) {
            const surface::RefinedMesh& mesh = isolation.parent;
            const uint32_t first = mesh.cage.faceStarts[face] + static_cast<uint32_t>(corner);
            const double distance = weights[(corner + 1) % 3] + weights[(corner + 2) % 3];
            if (weights[corner] > 0.5 && distance > 0.0 && distance < nearest &&
                !triangles.isPlain(mesh.cage.faceVertices[first])) {
                glm::dvec3 rim = weights * (nearest / distance), tip(0.0);
                rim[corner] = 1.0 - nearest;
                tip[corner] = 1.0;
                return {rim, tip, distance / nearest};
            }
        }
        return {weights};
    }

    surface::subdivision::Isolation isolation;
    surface::loop::Triangles triangles;

private:
    [[nodiscard]] surface::PatchClass classOf(uint32_t face) const {
        using enum surface::PatchClass;
        const uint32_t first = isolation.parent.cage.faceStarts[face];
        const bool sharp =
            triangles.isSemiSharp(first) || triangles.isSemiSharp(first + 1) || triangles.isSemiSharp(first + 2);
        return sharp ? loopIrregularSharp : triangles.chainsOf(face) == 0 ? loopRegular : loopIrregular;
    }
    static surface::subdivision::Isolation isolationOf(const cage::Cage& cage) {
        Result<surface::subdivision::Isolation> isolation =
            surface::subdivision::isolateCage(cage, surface::subdivision::Subdivision::loop);
        EXPECT_TRUE(isolation.ok());
        return std::move(*isolation);
    }
};

} // namespace supple::test
