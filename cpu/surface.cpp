#include "cpu/surface.h"

#include "cpu/normals.h"
#include "surface/grid.h"
#include "surface/schemes.h"

#include <algorithm>
#include <array>
#include <string>

namespace supple::cpu {
namespace {

/// Places that are evaluated at a time.
constexpr uint32_t kBatch = 64;
/// Where a surface has no normal, that of a point so far inside is taken.
constexpr double kInside = 1e-3;

glm::vec3 normalOf(const SurfaceJet& jet) {
    return glm::vec3(unitNormal(jet.du, jet.dv));
}

} // namespace

Built Surface::create(const surface::Recipe& recipe, const cage::Cage& cage, Patches patches) {
    using surface::SchemeId;
    switch (recipe.scheme) {
    case SchemeId::prep:
        return prepSurface(recipe, cage, patches);
    case SchemeId::pm:
        return pmSurface(cage, patches);
    case SchemeId::catmullClark:
    case SchemeId::fragments:
        return catmullClarkSurface(recipe, cage, patches);
    case SchemeId::loop:
    case SchemeId::loopFragments:
        return loopSurface(recipe, cage, patches);
    case SchemeId::blend:
        return blendSurface(recipe, cage, patches);
    case SchemeId::polygons:
        return polygonsSurface(cage, patches);
    default:
        return Error{ErrorCode::argument,
                     std::string(surface::schemeOf(recipe.scheme).name) + " has no evaluator on the CPU"};
    }
}

void Surface::grid(const Pose& pose, uint32_t begin, uint32_t end, uint32_t rate, const GridOutput& out) const {
    size_t vertex = 0;
    for (uint32_t patch = begin; patch < end;) {
        const GridOutput rest = out.from(vertex);
        const FastGrid fast = fastGrid(pose, patch, end, rate, rest);
        const uint32_t behind = patch + std::max(fast.patches, 1u);
        if (fast.patches == 0) {
            slowGrid(pose, patch, rate, rest);
        }
        for (; patch < behind; ++patch) {
            const uint32_t samples = samplesOf(patch, rate);
            if (!out.normals.empty() && (fast.patches == 0 || fast.lacksNormals || hasFlatPlaces(patch))) {
                mendNormals(pose, patch, rate, out.normals.subspan(vertex, samples));
            }
            vertex += samples;
        }
    }
}

Place Surface::placeInside(uint32_t patch, uint32_t rate, uint32_t sample) const {
    return placeOfSample(patch, rate, sample, kInside);
}

void Surface::slowGrid(const Pose& pose, uint32_t patch, uint32_t rate, const GridOutput& out) const {
    std::array<Place, kBatch> places;
    std::array<SurfaceJet, kBatch> jets;
    const uint32_t samples = samplesOf(patch, rate);
    for (uint32_t first = 0; first < samples; first += kBatch) {
        const uint32_t count = std::min(kBatch, samples - first);
        for (uint32_t k = 0; k < count; ++k) {
            places[k] = placeOfSample(patch, rate, first + k, 0.0);
        }
        pose.evaluate(std::span(places).first(count), jets);
        for (uint32_t k = 0; k < count; ++k) {
            out.positions[first + k] = glm::vec3(jets[k].position);
            if (!out.normals.empty()) {
                out.normals[first + k] = normalOf(jets[k]);
            }
        }
    }
}

void Surface::mendNormals(const Pose& pose, uint32_t patch, uint32_t rate, std::span<glm::vec3> normals) const {
    const bool flatPlaces = hasFlatPlaces(patch);
    for (uint32_t sample = 0; sample < normals.size(); ++sample) {
        if (flatPlaces && isFlat(placeOfSample(patch, rate, sample, 0.0))) {
            normals[sample] = glm::vec3(0.0f);
        }
        if (normals[sample] == glm::vec3(0.0f)) {
            normals[sample] = glm::vec3(pose.limitNormal(placeOfSample(patch, rate, sample, 0.0)));
        }
        if (normals[sample] == glm::vec3(0.0f)) {
            const Place near = placeInside(patch, rate, sample);
            SurfaceJet jet;
            pose.evaluate({&near, 1}, {&jet, 1});
            normals[sample] = normalOf(jet);
        }
    }
}

} // namespace supple::cpu
