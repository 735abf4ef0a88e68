// Loop on the CPU, drawn by triangles or by fragments.
#include "cpu/cut_faces.h"
#include "cpu/fragment_limits.h"
#include "cpu/grid_places.h"
#include "cpu/held.h"
#include "cpu/limit_weights.h"
#include "cpu/loop.h"
#include "cpu/patch_faces.h"
#include "cpu/patch_place.h"
#include "cpu/surface.h"

#include <algorithm>
#include <array>

namespace supple::cpu {
namespace {

using surface::subdivision::Isolation;
using surface::subdivision::LimitShape;

/// A triangle's child in the patch's parameters: three in its corners, and the middle, turned by a half.
Turned childTriangle(uint32_t child) {
    if (child == 3) {
        // Its corners 0, 1 and 2 have the weights (1/2, 1/2, 0), (0, 1/2, 1/2) and (1/2, 0, 1/2).
        return {{0.5, 0.0}, {0.0, -0.5}, {0.5, 0.5}};
    }
    // A corner keeps all of its own weight, and gives the others half of theirs.
    const Turned whole = turnedTriangle(child);
    return {whole.origin, 0.5 * whole.x, 0.5 * whole.y};
}

class LoopSurface final : public Surface {
public:
    LoopSurface(const cage::Cage& cage, Isolation isolation, Patches patches)
        : Surface(patches), isolation_(std::move(isolation)), shape_(isolation_.mesh),
          triangles_(cage.faceCount(), cage::kNone), cut_(cage), holes_(cage.faceCount(), false) {
        for (uint32_t f = 0; f < isolation_.mesh.fragments.size(); ++f) {
            shape_.keep(f);
        }
        const std::vector<uint32_t>& sources = isolation_.parent.sourceFaces;
        const cage::Cage& triangles = isolation_.parent.cage;
        for (uint32_t t = 0; t < triangles.faceCount(); ++t) {
            const uint32_t face = sources.empty() ? t : sources[t];
            if (cage.sides(face) == 3) {
                triangles_[face] = t;
            } else {
                cut_.add(cage, face, t, std::span(triangles.faceVertices).subspan(triangles.faceStarts[t], 3));
            }
        }
        for (const uint32_t face : cage.holes) {
            holes_[face] = true;
        }
    }

    Status findPatches(const cage::Cage& cage, bool fragments) {
        if (fragments) {
            for (const uint32_t face : drawnFaces(isolation_.mesh.cage)) {
                places_.add({face / 4, childTriangle(face % 4)});
            }
            return success();
        }
        return places_.find(isolation_.parent.cage, isolation_.parent.sourceFaces, cage.vertexCount(), patches(),
                            turnedTriangle);
    }

    [[nodiscard]] std::unique_ptr<Pose> newPose() const override;
    [[nodiscard]] FoundPlace findPlace(const FacePoint& point) const override {
        FoundPlace found;
        if (holes_[point.face]) {
            found.fault = kHole;
            return found;
        }
        if (cut_.has(point.face)) {
            found.place = cut_.find(point);
        } else {
            found.place.piece = triangles_[point.face];
            found.place.x = point.a;
            found.place.y = point.b;
        }
        holdOffCorner(found);
        return found;
    }
    [[nodiscard]] Place placeOfSample(uint32_t patch, uint32_t rate, uint32_t sample, double inside) const override {
        return places_.ofSample(patch, surface::Domain::triangle, rate, sample, inside);
    }

    void weigh(const Place& place, PointWeights& out) const override {
        weighLimit<surface::loop::LimitSurface>(shape_, place, out);
    }

    [[nodiscard]] const LimitShape& shape() const { return shape_; }

private:
    /// Derivatives have no limit at a corner that is not regular.
    void holdOffCorner(FoundPlace& found) const {
        const std::array<double, 3> weights{1.0 - found.place.x - found.place.y, found.place.x, found.place.y};
        const auto corner = static_cast<uint32_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
        const LimitShape::Sector& sector = shape_.sectors()[4 * size_t{found.place.piece} + corner];
        if (!shape_.isUniform(sector.fragment)) {
            holdOff(found, kTriangleCorners[corner], kTriangleMiddle,
                    shape_.isFlatCorner(sector) ? kBesideSlowCorner : kBesideCorner);
        }
    }

    Isolation isolation_;
    LimitShape shape_;
    std::vector<uint32_t> triangles_; ///< by face of the cage; cage::kNone: cut into several
    CutFaces cut_;
    std::vector<bool> holes_;
    PatchPlaces places_;
};

class PosedLoop final : public Pose {
public:
    explicit PosedLoop(const LoopSurface& surface) : limit_(surface.shape()) {}

    Status build(std::span<const glm::vec3> cage, const RunJobs& runJobs) override {
        return limit_.build(cage, runJobs);
    }
    void evaluate(std::span<const Place> places, std::span<SurfaceJet> out) const override {
        const surface::loop::LimitSurface limit(limit_);
        for (size_t p = 0; p < places.size(); ++p) {
            out[p] = limit.at(places[p].piece, places[p].x, places[p].y).jet();
            turn(places[p], out[p]);
        }
    }
    [[nodiscard]] glm::dvec3 limitNormal(const Place& place) const override {
        return surface::loop::LimitSurface(limit_).at(place.piece, place.x, place.y).normal;
    }

private:
    surface::subdivision::LimitPose limit_;
};

std::unique_ptr<Pose> LoopSurface::newPose() const {
    return std::make_unique<PosedLoop>(*this);
}

} // namespace

Built loopSurface(const surface::Recipe& recipe, const cage::Cage& cage, Patches patches) {
    Result<Isolation> isolation = surface::subdivision::isolateCage(cage, surface::subdivision::Subdivision::loop);
    if (!isolation) {
        return isolation.error();
    }
    const bool fragments = recipe.scheme == surface::SchemeId::loopFragments;
    if (const Status fits = fragments ? checkFragments(isolation->mesh) : success(); !fits) {
        return fits.error();
    }
    auto made = std::make_unique<LoopSurface>(cage, std::move(*isolation), patches);
    if (const Status found = made->findPatches(cage, fragments); !found) {
        return found.error();
    }
    return std::unique_ptr<const Surface>(std::move(made));
}

} // namespace supple::cpu
