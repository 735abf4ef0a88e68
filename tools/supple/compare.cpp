#include "tools/supple/compare.h"

#include "tools/supple/limit_surface.h"
#include "tools/supple/surface_batches.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace supple::tools {
namespace {

/// Of so many samples one is asked how well it was measured.
constexpr size_t kDoubted = 5;

/// Figures of some samples; distances and angles are sums until they are finished.
struct Sums {
    uint64_t samples = 0, normals = 0;
    double max = -1.0, sum = 0.0, maxDegrees = -1.0, sumDegrees = 0.0, doubt = 0.0;
    uint32_t worstFace = 0, worstNormalFace = 0;

    void add(const LimitSurface::Deviation& deviation, uint32_t face) {
        ++samples;
        sum += deviation.distance;
        doubt = std::max(doubt, deviation.doubt);
        if (deviation.distance > max) {
            max = deviation.distance;
            worstFace = face;
        }
        if (deviation.degrees < 0.0) {
            return;
        }
        ++normals;
        sumDegrees += deviation.degrees;
        if (deviation.degrees > maxDegrees) {
            maxDegrees = deviation.degrees;
            worstNormalFace = face;
        }
    }
    void add(const Sums& other) {
        samples += other.samples;
        normals += other.normals;
        sum += other.sum;
        doubt = std::max(doubt, other.doubt);
        sumDegrees += other.sumDegrees;
        if (other.max > max) {
            max = other.max;
            worstFace = other.worstFace;
        }
        if (other.maxDegrees > maxDegrees) {
            maxDegrees = other.maxDegrees;
            worstNormalFace = other.worstNormalFace;
        }
    }
};

Sums measure(const EvaluatedSurface& evaluation, const LimitSurface& limit, const PatchBatch& batch) {
    Sums sums;
    LimitSurface::Probe probe(limit);
    batch.forEachVertex([&](uint32_t patch, size_t i) {
        const uint32_t face = evaluation.patches[patch].face;
        const SuppleBufferRange& view = evaluation.output.streams.vertices;
        const auto position = element<glm::vec3>(evaluation.vertices, view, i);
        const auto normal = element<glm::vec3>(evaluation.vertices, view, i, sizeof(glm::vec3));
        sums.add(probe.measure(face, position, normal, i % kDoubted == 0), face);
    });
    return sums;
}

/// Batches are added up in order: the figures do not depend on the number of threads.
Sums measure(const EvaluatedSurface& evaluation, const LimitSurface& limit) {
    const std::vector<PatchBatch> batches =
        patchBatches(std::span(evaluation.output.grid.drawRanges, evaluation.output.grid.drawRangeCount));
    std::vector<Sums> parts(batches.size());
    inThreads(batches,
              [&](const PatchBatch& batch, size_t index) { parts[index] = measure(evaluation, limit, batch); });
    Sums all;
    for (const Sums& part : parts) {
        all.add(part);
    }
    return all;
}

std::vector<glm::dvec3> cagePositions(const Evaluation& evaluation) {
    std::vector<glm::dvec3> positions;
    const SuppleGroupInfo& info = evaluation.surfaces.front().output.info;
    for (uint32_t v = 0; v < info.cageVertexCount; ++v) {
        positions.emplace_back(element<glm::vec3>(evaluation.deformedCage, info.deformedCage, v));
    }
    return positions;
}

double extentOf(const std::vector<glm::dvec3>& positions) {
    glm::dvec3 low = positions.front(), high = low;
    for (const glm::dvec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::distance(low, high);
}

std::vector<std::string> notesFor(SuppleScheme scheme, const cage::Cage& cage) {
    if (scheme == SUPPLE_SCHEME_CATMULL_CLARK || scheme == SUPPLE_SCHEME_FRAGMENTS) {
        return {"the same surface: what is left is float's rounding and the error of measuring"};
    }
    if (scheme != SUPPLE_SCHEME_LOOP) {
        return {};
    }
    uint32_t split = 0;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        split += cage.sides(face) > 3 ? 1 : 0;
    }
    std::string note = "another surface by definition, not an approximation of this one";
    if (split > 0) {
        note += ": " + std::to_string(split) + " faces of four and more sides are split into triangles";
    }
    return {note};
}

} // namespace

Result<Comparison> compareSchemes(Session& session, const host::CharacterFile& file, const SurfaceFlags& surface,
                                  const Pose& pose) {
    const Result<SuppleAsset> asset = host::createAsset(*session.context, file);
    if (!asset) {
        return asset.error();
    }
    Comparison comparison;
    std::optional<LimitSurface> limit;
    for (const Scheme& scheme : kSchemes) {
        if (!scheme.smooth) {
            continue; // its vertices are the cage's
        }
        SchemeDeviation deviation;
        deviation.scheme = scheme.name;
        SurfaceFlags flags = surface;
        flags.scheme = scheme.name;
        const Result<Evaluation> evaluation = evaluate(session, *asset, file.character, flags, pose, 0);
        if (!evaluation) {
            const ErrorCode code = evaluation.error().code;
            if (code != ErrorCode::asset && code != ErrorCode::limit) { // not the cage's fault
                return evaluation.error();
            }
            deviation.refusal = evaluation.error().message;
            comparison.schemes.push_back(std::move(deviation));
            continue;
        }
        if (!limit) {
            // Of the cage as the device deformed it, so that nothing but the surfaces is compared.
            const std::vector<glm::dvec3> positions = cagePositions(*evaluation);
            Result<LimitSurface> built = LimitSurface::build(file.character.cage, positions);
            if (!built) {
                return Error{built.error().code, file.path + ": " + built.error().message};
            }
            limit.emplace(std::move(*built));
            comparison.extent = extentOf(positions);
        }
        const Sums sums = measure(evaluation->surfaces.front(), *limit);
        comparison.measuringError = std::max(comparison.measuringError, sums.doubt);
        deviation.patches = evaluation->surfaces.front().output.surface.patchCount;
        deviation.samples = sums.samples;
        deviation.max = std::max(sums.max, 0.0);
        deviation.mean = sums.sum / static_cast<double>(std::max<uint64_t>(sums.samples, 1));
        deviation.worstFace = sums.worstFace;
        deviation.normals = sums.normals;
        deviation.maxDegrees = std::max(sums.maxDegrees, 0.0);
        deviation.meanDegrees = sums.sumDegrees / static_cast<double>(std::max<uint64_t>(sums.normals, 1));
        deviation.worstNormalFace = sums.worstNormalFace;
        deviation.notes = notesFor(scheme.scheme, file.character.cage);
        comparison.schemes.push_back(std::move(deviation));
    }
    if (!limit) {
        return Error{ErrorCode::asset, comparison.schemes.front().refusal + "; no scheme takes it"};
    }
    return comparison;
}

} // namespace supple::tools
