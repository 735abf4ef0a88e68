// Catmull-Clark on the CPU, drawn by faces or by fragments. Quads that are regular all round are bicubic patches; the
// rest of the limit is evaluated from nets of points, in double.
#include "cpu/catmull_clark.h"
#include "cpu/fragment_limits.h"
#include "cpu/grid_places.h"
#include "cpu/held.h"
#include "cpu/limit_weights.h"
#include "cpu/patch_faces.h"
#include "cpu/patch_place.h"
#include "cpu/patch_surface.h"
#include "cpu/quad_faces.h"
#include "cpu/surface.h"
#include "cpu/uniform_net.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace supple::cpu {
namespace {

using surface::subdivision::Isolation;
using surface::subdivision::LimitShape;

/// Vertices without a crease where four quads meet: there the surface is a uniform B-spline.
std::vector<bool> regularVertices(const surface::RefinedMesh& mesh) {
    const cage::Topology& topology = mesh.topology;
    std::vector<bool> regular(mesh.cage.vertexCount());
    for (uint32_t v = 0; v < mesh.cage.vertexCount(); ++v) {
        regular[v] = topology.boundary[v] == 0 && topology.sectorCount(v) == 4 && mesh.vertexSharpness[v] == 0.0f;
    }
    for (size_t e = 0; e < topology.edges.size(); ++e) {
        if (mesh.edgeSharpness[e] > 0.0f) {
            const auto [corner, twin] = topology.edges[e];
            regular[mesh.cage.faceVertices[corner]] = false;
            regular[mesh.cage.faceVertices[cage::nextCorner(mesh.cage, topology.cornerFaces[corner], corner)]] = false;
        }
    }
    return regular;
}

class CatmullClarkSurface final : public Surface {
public:
    CatmullClarkSurface(const cage::Cage& cage, Isolation isolation, Patches patches)
        : Surface(patches), isolation_(std::move(isolation)), shape_(isolation_.mesh),
          faces_(cage, isolation_.mesh.isolationSteps > 1) {
        addPatches(cage.vertexCount());
    }

    Status findPatches(const cage::Cage& cage, bool fragments) {
        if (fragments) {
            for (const uint32_t face : drawnFaces(isolation_.mesh.cage)) {
                Turned turned = turnedQuad(face % 4);
                turned.x *= 0.5;
                turned.y *= 0.5;
                places_.add({face / 4, turned});
            }
            return success();
        }
        return places_.find(isolation_.parent.cage, isolation_.parent.sourceFaces, cage.vertexCount(), patches(),
                            turnedQuad);
    }

    [[nodiscard]] std::unique_ptr<Pose> newPose() const override;
    [[nodiscard]] FoundPlace findPlace(const FacePoint& point) const override {
        FoundPlace found = faces_.find(point);
        if (found.fault != nullptr) {
            return found;
        }
        holdOffCorner(found);
        return found;
    }
    [[nodiscard]] Place placeOfSample(uint32_t patch, uint32_t rate, uint32_t sample, double inside) const override {
        return places_.ofSample(patch, surface::Domain::quad, rate, sample, inside);
    }

    void weigh(const Place& place, PointWeights& out) const override {
        if (const uint32_t patch = patchOf(place.piece); patch != cage::kNone) {
            Place regular = place;
            regular.piece = patch;
            regular_.weigh(regular, out);
        } else {
            weighLimit<surface::catmull_clark::LimitSurface>(shape_, place, out);
        }
    }

    [[nodiscard]] const LimitShape& shape() const { return shape_; }
    [[nodiscard]] const PatchSet& regular() const { return regular_; }
    /// The patch of a quad, or cage::kNone.
    [[nodiscard]] uint32_t patchOf(uint32_t quad) const { return patchOfQuad_[quad]; }

protected:
    [[nodiscard]] FastGrid fastGrid(const Pose& pose, uint32_t begin, uint32_t end, uint32_t rate,
                                    const GridOutput& out) const override;

private:
    void addPatches(uint32_t cageVertices);
    /// Derivatives have no limit at a corner that is not regular.
    void holdOffCorner(FoundPlace& found) const;

    Isolation isolation_;
    LimitShape shape_;
    QuadFaces faces_;
    PatchSet regular_;
    std::vector<uint32_t> patchOfQuad_;
    PatchPlaces places_;
};

class PosedCatmullClark final : public Pose {
public:
    explicit PosedCatmullClark(const CatmullClarkSurface& surface)
        : surface_(surface), patches_(surface.regular().newPose()), limit_(surface.shape()) {}

    Status build(std::span<const glm::vec3> cage, const RunJobs& runJobs) override {
        if (Status made = surface_.regular().build(cage, runJobs, patches_); !made) {
            return made;
        }
        return limit_.build(cage, runJobs);
    }
    void evaluate(std::span<const Place> places, std::span<SurfaceJet> out) const override {
        std::vector<Place> regular;
        std::vector<size_t> numbers;
        const surface::catmull_clark::LimitSurface limit(limit_);
        for (size_t p = 0; p < places.size(); ++p) {
            if (const uint32_t patch = surface_.patchOf(places[p].piece); patch != cage::kNone) {
                regular.push_back(places[p]);
                regular.back().piece = patch;
                numbers.push_back(p);
            } else {
                out[p] = limit.at(places[p].piece, places[p].x, places[p].y).jet();
                turn(places[p], out[p]);
            }
        }
        std::vector<SurfaceJet> jets(regular.size());
        surface_.regular().evaluate(regular, patches_, jets);
        for (size_t k = 0; k < jets.size(); ++k) {
            out[numbers[k]] = jets[k];
        }
    }
    [[nodiscard]] glm::dvec3 limitNormal(const Place& place) const override {
        return surface::catmull_clark::LimitSurface(limit_).at(place.piece, place.x, place.y).normal;
    }
    [[nodiscard]] const PatchPose& patches() const { return patches_; }

private:
    const CatmullClarkSurface& surface_;
    PatchPose patches_;
    surface::subdivision::LimitPose limit_;
};

void CatmullClarkSurface::addPatches(uint32_t cageVertices) {
    const surface::RefinedMesh& parent = isolation_.parent;
    const cage::Cage& mesh = parent.cage;
    const std::vector<bool> regular = regularVertices(parent);
    const std::vector<Form> vertices =
        isolation_.mesh.isolationSteps > 1 ? formsOf(isolation_.mesh.stencils[0]) : vertexForms(cageVertices);
    patchOfQuad_.assign(mesh.faceCount(), cage::kNone);
    for (uint32_t quad = 0; quad < mesh.faceCount(); ++quad) {
        const auto corner = [&](uint32_t i) { return mesh.faceVertices[mesh.faceStarts[quad] + i]; };
        if (regular[corner(0)] && regular[corner(1)] && regular[corner(2)] && regular[corner(3)]) {
            patchOfQuad_[quad] = regular_.addTensor(uniformNet(mesh, parent.topology, vertices, quad));
            continue;
        }
        for (uint32_t i = 0; i < 4; ++i) {
            shape_.keep(shape_.sectors()[4 * size_t{quad} + i].fragment);
        }
    }
    regular_.finish();
}

void CatmullClarkSurface::holdOffCorner(FoundPlace& found) const {
    const uint32_t corner = nearestQuadCorner(found.place);
    const LimitShape::Sector& sector = shape_.sectors()[4 * size_t{found.place.piece} + corner];
    if (patchOfQuad_[found.place.piece] == cage::kNone && !shape_.isUniform(sector.fragment)) {
        holdOff(found, kQuadCorners[corner], kQuadMiddle,
                shape_.isFlatCorner(sector) ? kBesideSlowCorner : kBesideCorner);
    }
}

std::unique_ptr<Pose> CatmullClarkSurface::newPose() const {
    return std::make_unique<PosedCatmullClark>(*this);
}

Surface::FastGrid CatmullClarkSurface::fastGrid(const Pose& pose, uint32_t begin, uint32_t end, uint32_t rate,
                                                const GridOutput& out) const {
    // Patches whose corner 0 is the quad's: the others go place by place.
    std::array<uint32_t, 64> patches;
    uint32_t count = 0;
    for (; count < patches.size() && begin + count < end; ++count) {
        const PatchPlace& place = places_[begin + count];
        const bool whole = place.turned.origin == glm::dvec2(0.0) && place.turned.x == glm::dvec2(1.0, 0.0);
        if (!whole || patchOf(place.face) == cage::kNone) {
            break;
        }
        patches[count] = patchOf(place.face);
    }
    const PatchPose& posed = static_cast<const PosedCatmullClark&>(pose).patches();
    return {count, !regular_.grid(std::span(patches).first(count), rate, posed, out)};
}

} // namespace

Built catmullClarkSurface(const surface::Recipe& recipe, const cage::Cage& cage, Patches patches) {
    Result<Isolation> isolation =
        surface::subdivision::isolateCage(cage, surface::subdivision::Subdivision::catmullClark);
    if (!isolation) {
        return isolation.error();
    }
    const bool fragments = recipe.scheme == surface::SchemeId::fragments;
    if (const Status fits = fragments ? checkFragments(isolation->mesh) : success(); !fits) {
        return fits.error();
    }
    auto made = std::make_unique<CatmullClarkSurface>(cage, std::move(*isolation), patches);
    if (const Status found = made->findPatches(cage, fragments); !found) {
        return found.error();
    }
    return std::unique_ptr<const Surface>(std::move(made));
}

} // namespace supple::cpu
