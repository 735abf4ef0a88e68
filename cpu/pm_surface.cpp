// P_m on the CPU.
#include "cpu/affine.h"
#include "cpu/cut_faces.h"
#include "cpu/held.h"
#include "cpu/patch_faces.h"
#include "cpu/patch_surface.h"
#include "cpu/pm_construction.h"
#include "cpu/surface.h"

#include <algorithm>
#include <array>

namespace supple::cpu {
namespace {

/// A polar patch over a triangle: corner `first` is its corner 0, and the apex the one before that. `reach`: the weight
/// of the other two corners together is at least this.
Place polarPlace(const FacePoint& point, uint32_t first, double reach) {
    const std::array<Affine, 3> weights{(kOne - kFirst) - kSecond, kFirst, kSecond};
    const Affine &one = weights[first % 3], &other = weights[(first + 1) % 3], &apex = weights[(first + 2) % 3];
    const double rest = one.at(point.a, point.b) + other.at(point.a, point.b), outer = std::max(rest, reach);
    Place place;
    place.x = rest > 0.0 ? std::clamp(other.at(point.a, point.b) / rest, 0.0, 1.0) : 0.5;
    place.y = 1.0 - outer;
    if (outer > 0.0) { // x (1 - y) is the weight of the other corner
        place.xSlope = (other.slope + place.x * apex.slope) / outer;
        const glm::dvec2 x = place.xSlope, y = apex.slope;
        place.xBend = glm::dvec3(2.0 * x.x * y.x, x.x * y.y + x.y * y.x, 2.0 * x.y * y.y) / outer;
    }
    place.ySlope = apex.slope;
    return place;
}

class PmSurface final : public PatchSurface {
public:
    PmSurface(const cage::Cage& cage, Patches patches) : PatchSurface(patches), faces_(cage.faceCount()), cut_(cage) {}

    static Built create(const cage::Cage& cage, Patches patches) {
        const Result<surface::pm::Mesh> mesh = surface::pm::buildMesh(cage);
        if (!mesh) {
            return mesh.error();
        }
        FaceFinder finder;
        for (uint32_t f = 0; f < mesh->cage.faceCount(); ++f) {
            std::vector<uint32_t> corners;
            for (uint32_t i = 0; i < mesh->cage.sides(f); ++i) {
                corners.push_back(mesh->cage.faceVertices[mesh->corner(f, i)]);
            }
            finder.add(mesh->sourceFaces[f], std::move(corners));
        }
        const Result<std::vector<PatchFace>> facets = finder.find(patches);
        if (!facets) {
            return facets.error();
        }
        auto made = std::make_unique<PmSurface>(cage, patches);
        const std::vector<Form> vertices = vertexForms(cage.vertexCount());
        const auto coefficients = surface::pm::constructPoints<Form>(*mesh, vertices);
        for (uint32_t p = 0; p < patches.size(); ++p) {
            const uint32_t facet = (*facets)[p].face;
            made->add(surface::pm::gatherPoints<Form>(*mesh, coefficients, facet));
            if (const uint32_t face = patches[p].face; cage.sides(face) > surface::kMaxSides) {
                made->cut_.add(cage, face, p, std::span(patches[p].corners).first(patches[p].cornerCount));
            } else {
                made->faces_[face] = {p + 1, mesh->firstCorners[facet]};
            }
        }
        made->set_.finish();
        return std::unique_ptr<const Surface>(std::move(made));
    }

    [[nodiscard]] FoundPlace findPlace(const FacePoint& point) const override {
        const FaceOf& face = faces_[point.face];
        FoundPlace found;
        if (cut_.has(point.face)) {
            found.place = cut_.find(point);
            holdOffCorners(found);
            return found;
        }
        if (face.patch == 0) {
            found.fault = kHole;
            return found;
        }
        const uint32_t patch = face.patch - 1;
        if (isPolar(patch)) {
            found.place = polarPlace(point, face.firstCorner, 0.0);
            // It ends in a point, where its u means nothing.
            found.held = 1.0 - found.place.y < kBesideSlowCorner;
            found.beside = found.held ? polarPlace(point, face.firstCorner, kBesideSlowCorner) : Place{};
            found.place.piece = found.beside.piece = patch;
            return found;
        }
        found.place.piece = patch;
        found.place.sector = point.side;
        found.place.x = point.a;
        found.place.y = point.b;
        holdOffCorners(found);
        return found;
    }

protected:
    [[nodiscard]] bool hasFlatPlaces(uint32_t patch) const override {
        const auto& flat = flatCorners_[patch];
        return isPolar(patch) || std::find(flat.begin(), flat.end(), true) != flat.end();
    }
    [[nodiscard]] bool isFlat(const Place& place) const override {
        if (isPolar(place.piece)) {
            return place.y == 1.0; // the apex
        }
        FoundPlace found;
        found.place = place;
        holdOffCorners(found);
        return found.held;
    }

private:
    /// What a face became.
    struct FaceOf {
        uint32_t patch = 0; ///< 1 more than its number; 0: a hole
        uint8_t firstCorner = 0;
    };

    [[nodiscard]] bool isPolar(uint32_t patch) const { return patches()[patch].patchClass == PatchClass::polar; }
    /// Of a patch alone between the two halves of a crease: there du and dv are parallel.
    void holdOffCorners(FoundPlace& found) const {
        const uint32_t sides = patches()[found.place.piece].cornerCount;
        for (uint32_t i = 0; i < sides; ++i) {
            if (!flatCorners_[found.place.piece][i] || found.held) {
                continue;
            }
            const uint32_t inSector = (i + sides - found.place.sector) % sides; // a sector has two corners
            if (sides == 4) {
                holdOff(found, kQuadCorners[i], kQuadMiddle, kBesideSlowCorner);
            } else if (sides == 3) {
                holdOff(found, kTriangleCorners[i], kTriangleMiddle, kBesideSlowCorner);
            } else if (inSector < 2) {
                holdOff(found, kTriangleCorners[inSector], kTriangleMiddle, kBesideSlowCorner);
            }
        }
    }

    void add(const surface::pm::PointPatch<Form>& patch) {
        const std::span<const Form> all(patch.c.data(), patch.count);
        flatCorners_.push_back(patch.singularCorner);
        if (patch.patchClass == PatchClass::regular) {
            set_.addTensor(all);
        } else if (patch.patchClass == PatchClass::polar) {
            std::vector<Form> net(all.begin(), all.end());
            net.resize(16, patch.c[12]);
            set_.addPolar(net);
        } else {
            set_.addSectors(patch.patchClass, all);
        }
    }

    std::vector<FaceOf> faces_;
    CutFaces cut_;
    std::vector<std::array<bool, surface::kMaxSides>> flatCorners_; ///< by patch
};

} // namespace

Built pmSurface(const cage::Cage& cage, Patches patches) {
    return PmSurface::create(cage, patches);
}

} // namespace supple::cpu
