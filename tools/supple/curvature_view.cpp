#include "tools/supple/curvature_view.h"

#include "cage/piece.h"
#include "host/shaders/draw.h"
#include "tools/supple/surface_batches.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace supple::tools {
namespace {

constexpr double kMost = 300.0; ///< at the ends of the scale
constexpr double kEven = 1.0;    ///< up to about here the scale is even

double placeOf(double curvature) {
    return std::clamp(0.5 + 0.5 * std::asinh(curvature / kEven) / std::asinh(kMost / kEven), 0.0, 1.0);
}

float shown(const surface::Curvature& curvature, uint32_t view, double extent) {
    if (!curvature.exists)
        return -1.0f;
    const double gaussian = std::copysign(std::sqrt(std::abs(curvature.gaussian)), curvature.gaussian);
    const double own = view == host::shared::kViewMeanCurvature ? curvature.mean : gaussian;
    return static_cast<float>(placeOf(own * extent));
}

/// A surface's own cage: all of the figure's, or the faces of its parts.
struct SurfaceCage {
    SurfaceCage(const PosedSurfaces& posed, const PosedSurfaces::Surface& surface, const cage::Cage& whole)
        : patches(surface.patches) {
        if (posed.surfaces.size() == 1) {
            cage = &whole;
            positions.assign(posed.cage.begin(), posed.cage.end());
            return;
        }
        std::vector<uint32_t> faces;
        for (uint32_t f = 0; f < whole.faceCount(); ++f) {
            if (std::binary_search(surface.parts.begin(), surface.parts.end(), whole.faceParts[f]))
                faces.push_back(f);
        }
        piece = cage::takeFaces(whole, faces);
        cage = &piece->cage;
        for (const uint32_t v : piece->vertices)
            positions.emplace_back(posed.cage[v]);
        const auto among = [](const std::vector<uint32_t>& all, uint32_t one) {
            return static_cast<uint32_t>(std::lower_bound(all.begin(), all.end(), one) - all.begin());
        };
        for (SupplePatchInfo& patch : patches) {
            patch.face = among(piece->faces, patch.face);
            for (uint32_t i = 0; i < patch.cornerCount; ++i) {
                if (patch.corners[i] != SUPPLE_NO_VERTEX)
                    patch.corners[i] = among(piece->vertices, patch.corners[i]);
            }
        }
    }
    std::optional<cage::CagePiece> piece;
    const cage::Cage* cage = nullptr;
    std::vector<glm::dvec3> positions;
    std::vector<SupplePatchInfo> patches;
};

} // namespace

Status visitSamples(const PosedSurfaces& posed, const cage::Cage& cage, const SurfaceRules& rules,
                    const JetVisitor& visit) {
    size_t first = 0;
    for (const PosedSurfaces::Surface& surface : posed.surfaces) {
        if (!surface.ranges.empty()) {
            const SurfaceCage own(posed, surface, cage);
            const Result<Jets> jets =
                surfaceJets({surface.scheme, surface.rate, own.patches, rules}, *own.cage, own.positions);
            if (!jets)
                return Error{jets.error().code, posed.path + ": " + jets.error().message};
            inThreads(patchBatches(surface.ranges), [&](const PatchBatch& batch, size_t) {
                batch.forEachVertex([&](uint32_t patch, size_t vertex) {
                    const size_t inRange = vertex - batch.range->firstVertex;
                    visit(first + vertex, *jets, patch, static_cast<uint32_t>(inRange % batch.range->samplesPerPatch));
                });
            });
        }
        first += surface.vertexCount;
    }
    return success();
}

Result<std::vector<float>> curvatures(const PosedSurfaces& posed, const cage::Cage& cage, const SurfaceRules& rules,
                                      uint32_t view) {
    const double extent = 2.0 * static_cast<double>(host::boundsOf(posed.cage).radius());
    std::vector<float> values(posed.vertices.size(), -1.0f);
    const Status status =
        visitSamples(posed, cage, rules, [&](size_t vertex, const Jets& jets, uint32_t patch, uint32_t sample) {
            values[vertex] = shown(curvatureAt(jets, patch, sample), view, extent);
        });
    return status ? Result<std::vector<float>>(std::move(values)) : status.error();
}

std::vector<Legend::Mark> curvatureMarks() {
    std::vector<Legend::Mark> marks;
    for (const int value : {-300, -30, -3, 0, 3, 30, 300})
        marks.push_back({static_cast<float>(placeOf(value)), std::to_string(value)});
    return marks;
}

} // namespace supple::tools
