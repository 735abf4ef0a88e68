// A whole blending surface on the CPU, with walks over its shared edges.
#pragma once

#include "cpu/blend.h"
#include "cpu/stencils.h"
#include "surface/grid.h"
#include "surface/scheme.h"
#include "tests/support/meshes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace supple::test {

/// The mesh of a cage that must be accepted.
inline surface::blend::Mesh blendMesh(const cage::Cage& cage, const surface::blend::Options& options = {}) {
    Result<surface::blend::Mesh> mesh = surface::blend::buildMesh(cage, options);
    if (!mesh.ok()) {
        ADD_FAILURE() << mesh.error().message;
        return {};
    }
    return std::move(*mesh);
}

inline constexpr std::array kCreaseModes{surface::blend::CreaseMode::cut, surface::blend::CreaseMode::curve};

inline const char* kindName(surface::blend::ChartKind kind) {
    constexpr std::array kNames{"interior", "boundary", "cut", "curve", "point"};
    return kNames[static_cast<size_t>(kind)];
}

template <class T>
struct BlendSurface {
    using Vec = glm::vec<3, T>;

    /// From positions of the host's cage.
    BlendSurface(const surface::blend::Mesh& source, const std::vector<Vec>& positions)
        : mesh(source), coefficients(surface::blend::construct<T>(
                            mesh, surface::applyStencils<T>(mesh.stencils, std::span(positions)))) {}

    [[nodiscard]] surface::blend::Evaluator<T> at(uint32_t rate) const { return {mesh, coefficients, rate}; }

    const surface::blend::Mesh& mesh;
    std::vector<surface::blend::ChartCoefficients<T>> coefficients;
};

/// Whether a face is drawn as PatchClass::blendSharp.
inline bool isSharpPatch(const surface::blend::Mesh& mesh, uint32_t face) {
    for (uint32_t c = 4 * face; c < 4 * face + 4; ++c) {
        const surface::blend::ChartClass& chartClass = mesh.classOf(mesh.corners[c].chart);
        if (chartClass.creased() || chartClass.kind == surface::blend::ChartKind::point ||
            surface::blend::flatAcross(mesh, c)) {
            return true;
        }
    }
    return false;
}

/// The class that a face is drawn as.
inline surface::PatchClass blendClass(const surface::blend::Mesh& mesh, uint32_t face) {
    if (isSharpPatch(mesh, face)) {
        return surface::PatchClass::blendSharp;
    }
    for (uint32_t c = 4 * face; c < 4 * face + 4; ++c) {
        if (mesh.classOf(mesh.corners[c].chart).turns() != 4) {
            return surface::PatchClass::blend;
        }
    }
    return surface::PatchClass::blendRegular;
}

/// The faces that are drawn, in the order of their patches: by class, then material, then face.
inline std::vector<uint32_t> facesOfPatches(const surface::blend::Mesh& mesh) {
    std::vector<uint32_t> faces;
    for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
        if (!std::binary_search(mesh.cage.holes.begin(), mesh.cage.holes.end(), f)) {
            faces.push_back(f);
        }
    }
    const auto key = [&](uint32_t f) {
        return std::pair(blendClass(mesh, f),
                         mesh.cage.faceMaterials.empty() ? cage::kNone : mesh.cage.faceMaterials[f]);
    };
    std::stable_sort(faces.begin(), faces.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    return faces;
}

/// Tells the corners of patches by the mesh's own cage, which may be a refined one.
inline void nameCorners(const surface::blend::Mesh& mesh, std::vector<surface::PatchInfo>& patches) {
    const std::vector<uint32_t> faces = facesOfPatches(mesh);
    ASSERT_EQ(faces.size(), patches.size());
    for (size_t p = 0; p < patches.size(); ++p) {
        EXPECT_EQ(patches[p].face, mesh.sourceFaces[faces[p]]);
        std::copy_n(&mesh.cage.faceVertices[4 * faces[p]], 4, patches[p].corners.begin());
    }
}

/// Sample k of `rate` on a half-edge, counted from its corner.
inline std::pair<uint32_t, uint32_t> onEdge(uint32_t corner, uint32_t k, uint32_t rate) {
    const uint32_t sample = surface::edgeSample(surface::Domain::quad, rate, corner & 3u, k);
    return {sample % (rate + 1), sample / (rate + 1)};
}

/// The kind of chart on either end of a half-edge.
inline std::pair<surface::blend::ChartKind, surface::blend::ChartKind> endKinds(const surface::blend::Mesh& mesh,
                                                                                uint32_t corner) {
    const uint32_t next = cage::nextCorner(mesh.cage, mesh.topology.cornerFaces[corner], corner);
    return {mesh.classOf(mesh.corners[corner].chart).kind, mesh.classOf(mesh.corners[next].chart).kind};
}

} // namespace supple::test
