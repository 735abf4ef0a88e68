// The cage itself as a surface: for groups that draw none.
#include "cpu/surface.h"

namespace supple::cpu {
namespace {

class CageSurface final : public Surface {
public:
    explicit CageSurface(const cage::Cage& cage)
        : Surface({}), starts_(cage.faceStarts), vertices_(cage.faceVertices), holes_(cage.faceCount(), false) {
        for (const uint32_t face : cage.holes) {
            holes_[face] = true;
        }
    }

    [[nodiscard]] std::unique_ptr<Pose> newPose() const override;
    [[nodiscard]] FoundPlace findPlace(const FacePoint& point) const override {
        FoundPlace found;
        found.fault = holes_[point.face] ? kHole : nullptr;
        found.place.piece = point.face;
        found.place.sector = point.side;
        found.place.x = point.a;
        found.place.y = point.b;
        return found;
    }
    [[nodiscard]] Place placeOfSample(uint32_t patch, uint32_t, uint32_t, double) const override {
        Place place; // there are no patches
        place.piece = patch;
        return place;
    }
    void weigh(const Place& place, PointWeights& out) const override {
        const std::span<const uint32_t> corners = cornersOf(place.piece);
        const double x = place.x, y = place.y;
        if (corners.size() == 4) {
            out.add({corners[0], (1.0 - x) * (1.0 - y), y - 1.0, x - 1.0});
            out.add({corners[1], x * (1.0 - y), 1.0 - y, -x});
            out.add({corners[2], x * y, y, x});
            out.add({corners[3], (1.0 - x) * y, -y, 1.0 - x});
        } else if (corners.size() == 3) {
            out.add({corners[0], (1.0 - x) - y, -1.0, -1.0});
            out.add({corners[1], x, 1.0, 0.0});
            out.add({corners[2], y, 0.0, 1.0});
        } else {
            const size_t next = (place.sector + 1) % corners.size();
            const double share = 1.0 / static_cast<double>(corners.size()); // of the middle
            for (const uint32_t corner : corners) {
                out.append({corner, share * y, 0.0, share});
            }
            out.append({corners[place.sector], (1.0 - x) - y, -1.0, -1.0});
            out.append({corners[next], x, 1.0, 0.0});
            out.merge();
        }
        out.turn(place);
    }

    [[nodiscard]] uint32_t faceCount() const { return static_cast<uint32_t>(holes_.size()); }
    [[nodiscard]] std::span<const uint32_t> cornersOf(uint32_t face) const {
        return std::span(vertices_).subspan(starts_[face], starts_[face + 1] - starts_[face]);
    }

private:
    std::vector<uint32_t> starts_, vertices_; ///< the cage's faceStarts and faceVertices
    std::vector<bool> holes_;
};

/// Second derivatives are 0.
class PosedCage final : public Pose {
public:
    explicit PosedCage(const CageSurface& surface) : surface_(surface) {}

    Status build(std::span<const glm::vec3> cage, const RunJobs& /*runJobs*/) override {
        cage_.assign(cage.begin(), cage.end());
        middles_.resize(surface_.faceCount());
        for (uint32_t face = 0; face < surface_.faceCount(); ++face) {
            const std::span<const uint32_t> corners = surface_.cornersOf(face);
            if (corners.size() > 4) {
                middles_[face] = middleOf(corners);
            }
        }
        return success();
    }
    void evaluate(std::span<const Place> places, std::span<SurfaceJet> out) const override {
        PointWeights weights;
        for (size_t p = 0; p < places.size(); ++p) {
            if (surface_.cornersOf(places[p].piece).size() > 4) {
                out[p] = inTriangle(places[p]);
                continue;
            }
            weights.clear();
            surface_.weigh(places[p], weights);
            const glm::dvec3 first(cage_[weights.entries()[0].vertex]);
            out[p] = {};
            out[p].position = first;
            for (const VertexWeight& entry : weights.entries()) {
                const glm::dvec3 d = glm::dvec3(cage_[entry.vertex]) - first;
                out[p].position += entry.position * d;
                out[p].du += entry.du * d;
                out[p].dv += entry.dv * d;
            }
        }
    }

private:
    /// Relative to its first corner: differences keep their digits far from the origin.
    [[nodiscard]] glm::dvec3 middleOf(std::span<const uint32_t> corners) const {
        const glm::dvec3 first(cage_[corners[0]]);
        glm::dvec3 sum(0.0);
        for (const uint32_t corner : corners) {
            sum += glm::dvec3(cage_[corner]) - first;
        }
        return first + sum / static_cast<double>(corners.size());
    }
    /// In the triangle that a side makes with the middle of its face.
    [[nodiscard]] SurfaceJet inTriangle(const Place& place) const {
        const std::span<const uint32_t> corners = surface_.cornersOf(place.piece);
        const glm::dvec3 first(cage_[corners[place.sector]]);
        SurfaceJet jet;
        jet.du = glm::dvec3(cage_[corners[(place.sector + 1) % corners.size()]]) - first;
        jet.dv = middles_[place.piece] - first;
        jet.position = first + place.x * jet.du + place.y * jet.dv;
        turn(place, jet);
        return jet;
    }

    const CageSurface& surface_;
    std::vector<glm::vec3> cage_;
    std::vector<glm::dvec3> middles_; ///< of faces of more than four sides
};

std::unique_ptr<Pose> CageSurface::newPose() const {
    return std::make_unique<PosedCage>(*this);
}

} // namespace

std::unique_ptr<const Surface> cageSurface(const cage::Cage& cage) {
    return std::make_unique<CageSurface>(cage);
}

} // namespace supple::cpu
