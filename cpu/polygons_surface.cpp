// Polygons on the CPU: the flat triangles of the cage's faces.
#include "cpu/cut_faces.h"
#include "cpu/grid_places.h"
#include "cpu/surface.h"

namespace supple::cpu {
namespace {

class PolygonsSurface final : public Surface {
public:
    PolygonsSurface(const cage::Cage& cage, Patches patches) : Surface(patches), faces_(cage) {
        for (uint32_t p = 0; p < patches.size(); ++p) {
            faces_.add(cage, patches[p].face, p, std::span(patches[p].corners).first(3));
        }
    }

    [[nodiscard]] std::unique_ptr<Pose> newPose() const override;
    [[nodiscard]] FoundPlace findPlace(const FacePoint& point) const override {
        FoundPlace found;
        if (faces_.has(point.face)) {
            found.place = faces_.find(point);
        } else {
            found.fault = kHole;
        }
        return found;
    }
    [[nodiscard]] Place placeOfSample(uint32_t patch, uint32_t rate, uint32_t sample, double inside) const override {
        Place place = gridPlace(surface::Domain::triangle, rate, sample, inside);
        place.piece = patch;
        return place;
    }
    void weigh(const Place& place, PointWeights& out) const override {
        const auto& corners = patches()[place.piece].corners;
        out.add({corners[0], (1.0 - place.x) - place.y, -1.0, -1.0});
        out.add({corners[1], place.x, 1.0, 0.0});
        out.add({corners[2], place.y, 0.0, 1.0});
        out.turn(place);
    }

private:
    CutFaces faces_;
};

class PosedPolygons final : public Pose {
public:
    explicit PosedPolygons(const PolygonsSurface& surface) : surface_(surface) {}

    Status build(std::span<const glm::vec3> cage, const RunJobs& /*runJobs*/) override {
        cage_.assign(cage.begin(), cage.end());
        return success();
    }
    void evaluate(std::span<const Place> places, std::span<SurfaceJet> out) const override {
        for (size_t p = 0; p < places.size(); ++p) {
            const auto& corners = surface_.patches()[places[p].piece].corners;
            const glm::dvec3 first(cage_[corners[0]]);
            out[p] = {};
            out[p].du = glm::dvec3(cage_[corners[1]]) - first;
            out[p].dv = glm::dvec3(cage_[corners[2]]) - first;
            out[p].position = first + places[p].x * out[p].du + places[p].y * out[p].dv;
            turn(places[p], out[p]);
        }
    }

private:
    const PolygonsSurface& surface_;
    std::vector<glm::vec3> cage_;
};

std::unique_ptr<Pose> PolygonsSurface::newPose() const {
    return std::make_unique<PosedPolygons>(*this);
}

} // namespace

Built polygonsSurface(const cage::Cage& cage, Patches patches) {
    return std::unique_ptr<const Surface>(std::make_unique<PolygonsSurface>(cage, patches));
}

} // namespace supple::cpu
