// P_m on the CPU.
#include "cpu/patch_faces.h"
#include "cpu/patch_surface.h"
#include "cpu/pm_construction.h"
#include "cpu/surface.h"

#include <algorithm>
#include <array>

namespace supple::cpu {
namespace {

/// A polar patch ends in a point, where its u means nothing: so far from it derivatives are taken.
constexpr double kApex = 1.0 / 1024.0;

/// The weights of a triangle's corners as functions of those of corners 1 and 2.
struct CornerWeight {
    double value = 0.0;
    glm::dvec2 slope{0.0};
};

/// A polar patch over a triangle: corner `first` is its corner 0, and the apex the one before that. `reach`: the weight
/// of the other two corners together is at least this.
Place polarPlace(const FacePoint& point, uint32_t first, double reach) {
    const std::array<CornerWeight, 3> weights{
        {{1.0 - point.a - point.b, {-1.0, -1.0}}, {point.a, {1.0, 0.0}}, {point.b, {0.0, 1.0}}}};
    const CornerWeight &one = weights[first % 3], &other = weights[(first + 1) % 3], &apex = weights[(first + 2) % 3];
    const double rest = one.value + other.value, outer = std::max(rest, reach);
    Place place;
    place.x = rest > 0.0 ? std::clamp(other.value / rest, 0.0, 1.0) : 0.5;
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
    PmSurface(const cage::Cage& cage, Patches patches) : PatchSurface(patches), faces_(cage.faceCount()) {}

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
            FaceOf& face = made->faces_[patches[p].face];
            face.split = cage.sides(patches[p].face) > surface::kMaxSides;
            face.patch = p + 1;
            face.firstCorner = mesh->firstCorners[facet];
        }
        made->set_.finish();
        return std::unique_ptr<const Surface>(std::move(made));
    }

    [[nodiscard]] FoundPlace findPlace(const FacePoint& point) const override {
        const FaceOf& face = faces_[point.face];
        FoundPlace found;
        if (face.patch == 0 || face.split) {
            found.fault = face.split ? "P_m splits the face" : kHole;
            return found;
        }
        const uint32_t patch = face.patch - 1;
        if (patches()[patch].patchClass == PatchClass::polar) {
            found.place = polarPlace(point, face.firstCorner, 0.0);
            found.held = 1.0 - found.place.y < kApex;
            found.beside = found.held ? polarPlace(point, face.firstCorner, kApex) : Place{};
        } else {
            found.place.sector = point.side;
            found.place.x = point.a;
            found.place.y = point.b;
        }
        found.place.piece = found.beside.piece = patch;
        return found;
    }

private:
    /// What a face became.
    struct FaceOf {
        uint32_t patch = 0; ///< 1 more than its number; 0: a hole
        uint8_t firstCorner = 0;
        bool split = false;
    };

    void add(const surface::pm::PointPatch<Form>& patch) {
        const std::span<const Form> all(patch.c.data(), patch.count);
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
};

} // namespace

Built pmSurface(const cage::Cage& cage, Patches patches) {
    return PmSurface::create(cage, patches);
}

} // namespace supple::cpu
