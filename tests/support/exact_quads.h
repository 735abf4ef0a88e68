// The quads that exact Catmull-Clark patches are made of, and what is known of their corners.
#pragma once

#include "surface/chains/corners.h"
#include "surface/scheme.h"
#include "surface/subdivision/mesh.h"
#include "tests/support/chain_depth.h"
#include "tests/support/gpu_comparison.h"

#include <algorithm>
#include <utility>

namespace supple::test {

/// The cage must be accepted.
struct ExactQuads {
    explicit ExactQuads(const cage::Cage& cage) : isolation(isolationOf(cage)), corners(isolation.parent) {}

    [[nodiscard]] uint32_t vertex(uint32_t face, uint32_t corner) const {
        return isolation.parent.cage.faceVertices[isolation.parent.cage.faceStarts[face] + corner];
    }
    [[nodiscard]] surface::PatchClass classOf(uint32_t face) const {
        using surface::chains::VertexKind;
        const surface::RefinedMesh& mesh = isolation.parent;
        bool plain = true, chains = false, sharp = false;
        for (uint32_t i = 0; i < 4; ++i) {
            plain = plain && corners.kind(vertex(face, i)) == VertexKind::plain;
            chains = chains || corners.kind(vertex(face, i)) == VertexKind::chain;
            sharp = sharp || mesh.edgeSharpness[mesh.topology.cornerEdges[mesh.cage.faceStarts[face] + i]] > 1.0f;
        }
        if (plain) {
            return surface::PatchClass::regular;
        }
        return !chains ? surface::PatchClass::creased
               : sharp ? surface::PatchClass::irregularSharp
                       : surface::PatchClass::irregular;
    }
    /// `patches`: of a group.
    template <class Patches>
    [[nodiscard]] PatchFaces patches(const Patches& patches) const {
        PatchFaces found = patchFaces(
            isolation.parent, patches, [&](uint32_t face) { return classOf(face); },
            [&](uint32_t face) { return corners.chainsOf(face); });
        for (uint32_t f = 0; f < isolation.parent.cage.faceCount(); ++f) {
            found.firstCorners.push_back(corners.firstCorner(f));
        }
        return found;
    }
    /// Parameters of a patch as those of its face.
    [[nodiscard]] static glm::dvec2 inFace(double u, double v, uint32_t firstCorner) {
        const glm::dvec2 turned[] = {{u, v}, {1.0 - v, u}, {1.0 - u, 1.0 - v}, {v, 1.0 - u}};
        return turned[firstCorner];
    }
    /// Where a view takes a sample of a patch, if chains go up to level `depth`.
    [[nodiscard]] ConePlace<glm::dvec2> atLevels(uint32_t face, glm::dvec2 uv, uint32_t depth) const {
        const double nearest = std::exp2(-static_cast<double>(depth));
        const bool right = uv.x > 0.5, up = uv.y > 0.5;
        const uint32_t corner = up ? (right ? 2 : 3) : right ? 1 : 0;
        const auto outwards = [&](glm::dvec2 from) {
            return glm::dvec2(right ? 1.0 - from.x : from.x, up ? 1.0 - from.y : from.y);
        };
        const glm::dvec2 from = outwards(uv);
        const double far = std::max(from.x, from.y);
        if (far == 0.0 || far >= nearest ||
            corners.kind(vertex(face, (corner + corners.firstCorner(face)) % 4)) !=
                surface::chains::VertexKind::chain) {
            return {uv};
        }
        return {outwards(from * (nearest / far)), outwards({0.0, 0.0}), far / nearest};
    }
    /// A rate along a cage edge for this rate along a quad's.
    [[nodiscard]] uint32_t rateFor(uint32_t rate) const { return rate << (isolation.mesh.isolationSteps - 1); }

    surface::subdivision::Isolation isolation;
    surface::chains::Corners corners;

private:
    static surface::subdivision::Isolation isolationOf(const cage::Cage& cage) {
        Result<surface::subdivision::Isolation> isolation =
            surface::subdivision::isolateCage(cage, surface::subdivision::Subdivision::catmullClark);
        EXPECT_TRUE(isolation.ok());
        return std::move(*isolation);
    }
};

/// Corners of patches as vertices of the quads: a group tells those of its cage.
inline void nameCorners(const ExactQuads& quads, std::vector<surface::PatchInfo>& patches) {
    const PatchFaces found = quads.patches(patches);
    ASSERT_EQ(found.faces.size(), patches.size());
    for (size_t p = 0; p < patches.size(); ++p) {
        const uint32_t face = found.faces[p];
        for (uint32_t i = 0; i < 4; ++i) {
            patches[p].corners[i] = quads.vertex(face, (i + found.firstCorners[face]) % 4);
        }
    }
}

/// The quads in the faces of their cage, as OpenSubdiv names these: those of the cage, or after a step one for each
/// corner of a face.
class QuadsOfFaces {
public:
    QuadsOfFaces(const cage::Cage& cage, const ExactQuads& quads)
        : cage_(cage), stepped_(quads.isolation.mesh.isolationSteps > 1) {
        for (uint32_t face = 0; face < cage.faceCount(); ++face) {
            for (uint32_t part = 0; part < (stepped_ ? cage.sides(face) : 1); ++part) {
                quads_.push_back({face, part, {}});
            }
        }
    }
    /// A quad is one part. Another face has a part at each corner.
    struct Place {
        uint32_t face = 0, part = 0;
        glm::dvec2 uv{0.0};
    };
    [[nodiscard]] Place at(uint32_t quad, glm::dvec2 uv) const {
        Place place = quads_[quad];
        place.uv = uv;
        if (stepped_ && cage_.sides(place.face) == 4) {
            place.uv = ExactQuads::inFace(0.5 * uv.x, 0.5 * uv.y, place.part);
            place.part = 0;
        }
        return place;
    }

private:
    const cage::Cage& cage_;
    bool stepped_;
    std::vector<Place> quads_;
};

} // namespace supple::test
