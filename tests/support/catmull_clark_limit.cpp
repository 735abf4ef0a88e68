#include "tests/support/catmull_clark_limit.h"

#include "tests/support/bfr_surfaces.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace supple::test {

namespace {

using namespace OpenSubdiv;

/// Steps along a side of a part's grid.
constexpr uint32_t kGrid = 8;

} // namespace

struct CatmullClarkLimit::Surfaces : BfrSurfaces {
    using BfrSurfaces::BfrSurfaces;
};

CatmullClarkLimit::CatmullClarkLimit(const cage::Cage& cage, const std::vector<glm::dvec3>& positions)
    : surfaces_(std::make_unique<Surfaces>(cage, positions, Sdc::SCHEME_CATMARK)), near_(cage.faceCount()) {
    std::vector<std::vector<uint32_t>> partsOfFace(cage.faceCount()), facesOfVertex(cage.vertexCount());
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            facesOfVertex[cage.faceVertices[c]].push_back(f);
        }
        if (!surfaces_->faces[f].surface.IsValid()) {
            continue;
        }
        for (uint32_t i = 0; i < (cage.sides(f) == 4 ? 1 : cage.sides(f)); ++i) {
            Part part{f, i, {}};
            for (uint32_t k = 0; k < (kGrid + 1) * (kGrid + 1); ++k) {
                part.grid.push_back(
                    at(f, i, k % (kGrid + 1) / double(kGrid), k / (kGrid + 1) / double(kGrid)).position);
            }
            partsOfFace[f].push_back(static_cast<uint32_t>(parts_.size()));
            parts_.push_back(std::move(part));
        }
    }
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        std::set<uint32_t> faces;
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            const std::vector<uint32_t>& around = facesOfVertex[cage.faceVertices[c]];
            faces.insert(around.begin(), around.end());
        }
        for (const uint32_t g : faces) {
            near_[f].insert(near_[f].end(), partsOfFace[g].begin(), partsOfFace[g].end());
        }
    }
}

CatmullClarkLimit::~CatmullClarkLimit() = default;

CatmullClarkLimit::Point CatmullClarkLimit::at(uint32_t face, uint32_t part, double u, double v) const {
    const Surfaces::Face& f = surfaces_->faces[face];
    const double within[2] = {u, v};
    double uv[2] = {u, v};
    const Bfr::Parameterization parameters = f.surface.GetParameterization();
    if (parameters.HasSubFaces()) {
        parameters.ConvertNormalizedSubFaceToCoord(static_cast<int>(part), within, uv);
    }
    Point point;
    f.surface.Evaluate(uv, f.points.data(), 3, &point.position.x, &point.du.x, &point.dv.x);
    return point;
}

CatmullClarkLimit::Point CatmullClarkLimit::nearestFrom(const Part& part, double u, double v,
                                                        const glm::dvec3& p) const {
    Point best = at(part.face, part.part, u, v);
    Point point = best;
    for (int round = 0; round < 12; ++round) {
        const glm::dvec3 off = p - point.position;
        const double gu = glm::dot(point.du, off), gv = glm::dot(point.dv, off);
        // A parameter at its bound that would leave the part stays.
        const bool fixedU = (u <= 0.0 && gu < 0.0) || (u >= 1.0 && gu > 0.0);
        const bool fixedV = (v <= 0.0 && gv < 0.0) || (v >= 1.0 && gv > 0.0);
        const double uu = glm::dot(point.du, point.du), vv = glm::dot(point.dv, point.dv);
        const double uv = fixedU || fixedV ? 0.0 : glm::dot(point.du, point.dv);
        const double determinant = uu * vv - uv * uv;
        if (!(determinant > 0.0)) {
            break;
        }
        const double stepU = fixedU ? 0.0 : (vv * gu - uv * gv) / determinant;
        const double stepV = fixedV ? 0.0 : (uu * gv - uv * gu) / determinant;
        u = std::clamp(u + stepU, 0.0, 1.0);
        v = std::clamp(v + stepV, 0.0, 1.0);
        point = at(part.face, part.part, u, v);
        if (glm::distance(point.position, p) < glm::distance(best.position, p)) {
            best = point;
        }
        if (std::abs(stepU) + std::abs(stepV) < 1e-10) {
            break;
        }
    }
    return best;
}

CatmullClarkLimit::Point CatmullClarkLimit::nearest(uint32_t face, const glm::dvec3& p) const {
    struct Start {
        double distance = 0.0;
        uint32_t part = 0, sample = 0;
    };
    std::vector<Start> starts;
    for (const uint32_t i : near_[face]) {
        Start start{glm::distance(parts_[i].grid[0], p), i, 0};
        for (uint32_t k = 1; k < parts_[i].grid.size(); ++k) {
            const double distance = glm::distance(parts_[i].grid[k], p);
            if (distance < start.distance) {
                start.distance = distance;
                start.sample = k;
            }
        }
        starts.push_back(start);
    }
    const size_t tried = std::min<size_t>(3, starts.size());
    std::partial_sort(starts.begin(), starts.begin() + static_cast<ptrdiff_t>(tried), starts.end(),
                      [](const Start& a, const Start& b) { return a.distance < b.distance; });
    Point best;
    for (size_t i = 0; i < tried; ++i) {
        const uint32_t k = starts[i].sample;
        const Point point =
            nearestFrom(parts_[starts[i].part], k % (kGrid + 1) / double(kGrid), k / (kGrid + 1) / double(kGrid), p);
        if (i == 0 || glm::distance(point.position, p) < glm::distance(best.position, p)) {
            best = point;
        }
    }
    return best;
}

} // namespace supple::test
