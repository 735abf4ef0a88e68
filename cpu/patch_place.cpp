#include "cpu/patch_place.h"

#include "cpu/grid_places.h"
#include "cpu/patch_faces.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace supple::cpu {

void Turned::apply(Place& place) const {
    const double px = place.x, py = place.y;
    const glm::dvec2 sx = place.xSlope, sy = place.ySlope;
    place.x = origin.x + (x.x * px + x.y * py);
    place.y = origin.y + (y.x * px + y.y * py);
    place.xSlope = x.x * sx + x.y * sy;
    place.ySlope = y.x * sx + y.y * sy;
}

Turned turnedQuad(uint32_t firstCorner) {
    const std::array<Turned, 4> turned{{{},
                                        {{1.0, 0.0}, {0.0, -1.0}, {1.0, 0.0}},
                                        {{1.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}},
                                        {{0.0, 1.0}, {0.0, 1.0}, {-1.0, 0.0}}}};
    return turned[firstCorner];
}

Turned turnedTriangle(uint32_t firstCorner) {
    // The patch's weights are (1 - x - y, x, y) of the corners firstCorner, the next and the last.
    const std::array<Turned, 3> turned{
        {{}, {{1.0, 0.0}, {-1.0, -1.0}, {1.0, 0.0}}, {{0.0, 1.0}, {0.0, 1.0}, {-1.0, -1.0}}}};
    return turned[firstCorner];
}

Status PatchPlaces::find(const cage::Cage& mesh, std::span<const uint32_t> sourceFaces, uint32_t cageVertices,
                         std::span<const surface::PatchInfo> patches, Turned (*turned)(uint32_t firstCorner)) {
    FaceFinder finder;
    finder.addAll(mesh, sourceFaces, cageVertices);
    const Result<std::vector<PatchFace>> found = finder.find(patches);
    if (!found) {
        return found.error();
    }
    for (const PatchFace& patch : *found) {
        add({patch.face, turned(patch.firstCorner)});
    }
    return success();
}

Place PatchPlaces::ofSample(uint32_t patch, surface::Domain domain, uint32_t rate, uint32_t sample,
                            double inside) const {
    Place place = gridPlace(domain, rate, sample, inside);
    place.piece = places_[patch].face;
    places_[patch].turned.apply(place);
    return place;
}

std::vector<uint32_t> drawnFaces(const cage::Cage& isolated) {
    std::vector<uint32_t> faces;
    for (uint32_t f = 0; f < isolated.faceCount(); ++f) {
        if (!std::binary_search(isolated.holes.begin(), isolated.holes.end(), f)) {
            faces.push_back(f);
        }
    }
    const auto key = [&](uint32_t f) {
        return std::tuple(isolated.faceMaterials.empty() ? cage::kNone : isolated.faceMaterials[f],
                          isolated.faceParts.empty() ? 0 : isolated.faceParts[f]);
    };
    std::stable_sort(faces.begin(), faces.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    return faces;
}

} // namespace supple::cpu
