// The blending surface on the CPU, in double.
#include "cpu/blend.h"
#include "cpu/grid_places.h"
#include "cpu/held.h"
#include "cpu/limit_weights.h"
#include "cpu/normals.h"
#include "cpu/patch_faces.h"
#include "cpu/patch_place.h"
#include "cpu/quad_faces.h"
#include "cpu/stencils.h"
#include "cpu/surface.h"

#include <algorithm>

namespace supple::cpu {
namespace {

using surface::blend::ChartCoefficients;

constexpr uint32_t kChartsPerJob = 256;
constexpr uint32_t kVerticesPerJob = 4096;
/// A chart that is a polynomial in the parameters of its faces: derivatives exist at its vertex too.
bool isPolynomial(const surface::blend::ChartClass& chart) {
    using surface::blend::ChartKind;
    return (chart.kind == ChartKind::interior || chart.kind == ChartKind::boundary) && chart.turns() == 4;
}

bool isStill(const surface::blend::ChartClass& chart) {
    using surface::blend::ChartKind;
    return chart.kind == ChartKind::point || chart.kind == ChartKind::curve;
}

class BlendSurface final : public Surface {
public:
    BlendSurface(const cage::Cage& cage, surface::blend::Mesh mesh, Patches patches)
        : Surface(patches), mesh_(std::move(mesh)), faces_(cage, mesh_.refined) {
        for (const surface::blend::ChartClass& chartClass : mesh_.classes) {
            matrices_.push_back(surface::blend::makeFitMatrix(chartClass));
        }
    }

    Status findPatches(const cage::Cage& cage) {
        return places_.find(mesh_.cage, mesh_.sourceFaces, cage.vertexCount(), patches(), turnedQuad);
    }

    [[nodiscard]] std::unique_ptr<Pose> newPose() const override;
    [[nodiscard]] FoundPlace findPlace(const FacePoint& point) const override {
        FoundPlace found = faces_.find(point);
        if (found.fault != nullptr) {
            return found;
        }
        const uint32_t corner = nearestQuadCorner(found.place);
        if (!isPolynomial(mesh_.classOf(chartOf(found.place.piece, corner)))) {
            holdOff(found, kQuadCorners[corner], kQuadMiddle, kBesideSlowCorner);
        }
        return found;
    }
    [[nodiscard]] Place placeOfSample(uint32_t patch, uint32_t rate, uint32_t sample, double inside) const override {
        return places_.ofSample(patch, surface::Domain::quad, rate, sample, inside);
    }

    void weigh(const Place& place, PointWeights& out) const override {
        PointWeights ofQuads;
        const uint32_t chart = cornerChart(place);
        if (isAtCorner(place) && !isPolynomial(mesh_.classOf(chart))) {
            surface::blend::weighCoefficient(mesh_, matrices_, chart, 0, {0, 1.0, 0.0, 0.0}, ofQuads);
        } else {
            surface::blend::weighJet(mesh_, matrices_, place.piece, place.x, place.y, ofQuads);
            ofQuads.turn(place);
        }
        out = throughStencils(ofQuads, mesh_.stencils);
    }

    static bool isAtCorner(const Place& place) {
        return (place.x == 0.0 || place.x == 1.0) && (place.y == 0.0 || place.y == 1.0);
    }
    [[nodiscard]] uint32_t cornerChart(const Place& place) const {
        return chartOf(place.piece, nearestQuadCorner(place));
    }
    [[nodiscard]] bool hasFlatPlaces(uint32_t patch) const override {
        const uint32_t piece = placeOfSample(patch, 1, 0, 0.0).piece;
        for (uint32_t k = 0; k < 4; ++k) {
            if (isStill(classAt(piece, k)) || flatAcross(mesh_, 4 * piece + k)) {
                return true;
            }
        }
        return false;
    }
    /// By connectivity, as the device says it.
    [[nodiscard]] bool isFlat(const Place& place) const override {
        const std::array<bool, 4> onEdge{place.y == 0.0, place.x == 1.0, place.y == 1.0, place.x == 0.0};
        for (uint32_t k = 0; k < 4; ++k) {
            if (onEdge[k] &&
                (flatAcross(mesh_, 4 * place.piece + k) || (onEdge[(k + 3) % 4] && isStill(classAt(place.piece, k))))) {
                return true;
            }
        }
        return false;
    }
    /// Half a step inside: nearer to the border the surface may fold.
    [[nodiscard]] Place placeInside(uint32_t patch, uint32_t rate, uint32_t sample) const override {
        Place place = placeOfSample(patch, rate, sample, 0.0);
        const double half = 0.5 / rate;
        place.x = std::clamp(place.x, half, 1.0 - half);
        place.y = std::clamp(place.y, half, 1.0 - half);
        return place;
    }

    [[nodiscard]] const surface::blend::Mesh& mesh() const { return mesh_; }
    [[nodiscard]] uint32_t chartOf(uint32_t face, uint32_t corner) const {
        return mesh_.corners[4 * size_t{face} + corner].chart;
    }
    [[nodiscard]] std::span<const surface::blend::FitMatrix> matrices() const { return matrices_; }

private:
    [[nodiscard]] const surface::blend::ChartClass& classAt(uint32_t face, uint32_t corner) const {
        return mesh_.classOf(chartOf(face, corner));
    }

    surface::blend::Mesh mesh_;
    std::vector<surface::blend::FitMatrix> matrices_; ///< by class of charts
    QuadFaces faces_;
    PatchPlaces places_;
};

class PosedBlend final : public Pose {
public:
    explicit PosedBlend(const BlendSurface& surface)
        : surface_(surface), vertices_(surface.mesh().cage.vertexCount()), charts_(surface.mesh().charts.size()) {}

    Status build(std::span<const glm::vec3> cage, const RunJobs& runJobs) override {
        const surface::blend::Mesh& mesh = surface_.mesh();
        positions_.assign(cage.begin(), cage.end());
        const std::span<const glm::dvec3> positions = positions_;
        if (Status made = inRanges(runJobs, mesh.cage.vertexCount(), kVerticesPerJob,
                                   [&](uint32_t begin, uint32_t end) {
                                       for (uint32_t v = begin; v < end; ++v) {
                                           vertices_[v] = surface::applyStencil<double>(mesh.stencils, v, positions);
                                       }
                                   });
            !made) {
            return made;
        }
        return inRanges(runJobs, static_cast<uint32_t>(mesh.charts.size()), kChartsPerJob,
                        [&](uint32_t begin, uint32_t end) {
                            for (uint32_t chart = begin; chart < end; ++chart) {
                                charts_[chart] =
                                    surface::blend::coefficientsOf<double>(mesh, surface_.matrices(), chart, vertices_);
                            }
                        });
    }
    void evaluate(std::span<const Place> places, std::span<SurfaceJet> out) const override {
        for (size_t p = 0; p < places.size(); ++p) {
            const Place& place = places[p];
            const uint32_t chart = surface_.cornerChart(place);
            if (BlendSurface::isAtCorner(place) && !isPolynomial(surface_.mesh().classOf(chart))) {
                out[p] = {};
                out[p].position = charts_[chart][0];
                continue;
            }
            out[p] = surface::blend::evaluateJet(surface_.mesh(), charts_, place.piece, place.x, place.y);
            turn(place, out[p]);
        }
    }
    [[nodiscard]] glm::dvec3 limitNormal(const Place& place) const override {
        const uint32_t chart = surface_.cornerChart(place);
        const bool hasPlane = BlendSurface::isAtCorner(place) && !surface_.isFlat(place); // of its own
        return hasPlane ? unitNormal(charts_[chart][3], charts_[chart][1]) : glm::dvec3(0.0);
    }

private:
    const BlendSurface& surface_;
    std::vector<glm::dvec3> positions_; ///< of the cage
    std::vector<glm::dvec3> vertices_;  ///< of the quads
    std::vector<ChartCoefficients<double>> charts_;
};

std::unique_ptr<Pose> BlendSurface::newPose() const {
    return std::make_unique<PosedBlend>(*this);
}

} // namespace

Built blendSurface(const surface::Recipe& recipe, const cage::Cage& cage, Patches patches) {
    Result<surface::blend::Mesh> mesh = surface::blend::buildMesh(cage, recipe.blend);
    if (!mesh) {
        return mesh.error();
    }
    auto made = std::make_unique<BlendSurface>(cage, std::move(*mesh), patches);
    if (const Status found = made->findPatches(cage); !found) {
        return found.error();
    }
    return std::unique_ptr<const Surface>(std::move(made));
}

} // namespace supple::cpu
