#include "tools/supple/limit_distance.h"

#include "host/patches.h"
#include "tools/supple/limit_surface.h"
#include "tools/supple/surface_batches.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace supple::tools {

namespace {

constexpr int kLeastPower = -6, kMostPower = -2; ///< of 10, at the ends of the scale

float onScale(double fraction) {
    const double power = std::log10(std::max(fraction, 1e-12));
    return static_cast<float>(std::clamp((power - kLeastPower) / (kMostPower - kLeastPower), 0.0, 1.0));
}

} // namespace

Result<PosedSurfaces> readPosed(const host::FigureGroup& group) {
    Result<std::vector<glm::vec3>> vertices = group.readSurface();
    Result<std::vector<glm::vec3>> cage = group.readCage();
    if (!vertices || !cage)
        return !vertices ? vertices.error() : cage.error();
    PosedSurfaces posed{group.figure().path(), std::move(*vertices), std::move(*cage), {}};
    for (uint32_t s = 0; s < group.surfaces().size(); ++s) {
        const host::GroupOutput& output = group.surfaces()[s].output;
        const std::span<const SuppleDrawRange> ranges(output.grid.drawRanges, output.grid.drawRangeCount);
        PosedSurfaces::Surface& surface = posed.surfaces.emplace_back();
        surface.vertexCount = output.grid.vertexCount;
        if (ranges.empty() || ranges.front().domain == SUPPLE_DOMAIN_MESH)
            continue;
        surface.ranges.assign(ranges.begin(), ranges.end());
        surface.scheme = output.surface.scheme;
        surface.rate = output.grid.rate;
        surface.parts.assign(output.surface.parts, output.surface.parts + output.surface.partCount);
        Result<std::vector<SupplePatchInfo>> patches = host::patchesOf(group.figure().context(), group.handle(), s);
        if (!patches)
            return patches.error();
        surface.patches = std::move(*patches);
    }
    return posed;
}

Result<std::vector<float>> distancesToLimit(const PosedSurfaces& posed, const cage::Cage& cage) {
    const std::vector<glm::dvec3> positions(posed.cage.begin(), posed.cage.end());
    const Result<LimitSurface> limit = LimitSurface::build(cage, positions);
    if (!limit)
        return Error{limit.error().code, posed.path + ": " + limit.error().message};
    const double extent = 2.0 * static_cast<double>(host::boundsOf(posed.cage).radius());
    std::vector<float> values(posed.vertices.size(), -1.0f);
    size_t first = 0;
    for (const PosedSurfaces::Surface& surface : posed.surfaces) {
        inThreads(patchBatches(surface.ranges), [&](const PatchBatch& batch, size_t) {
            LimitSurface::Probe probe(*limit);
            batch.forEachVertex([&](uint32_t patch, size_t vertex) {
                const glm::dvec3 position(posed.vertices[first + vertex]);
                const double distance = probe.measure(surface.patches[patch].face, position, glm::dvec3(0.0)).distance;
                values[first + vertex] = onScale(distance / extent);
            });
        });
        first += surface.vertexCount;
    }
    return values;
}

std::vector<Legend::Mark> distanceMarks() {
    std::vector<Legend::Mark> marks;
    for (int power = kLeastPower; power <= kMostPower; ++power)
        marks.push_back({static_cast<float>(power - kLeastPower) / static_cast<float>(kMostPower - kLeastPower),
                         "1e" + std::to_string(power)});
    return marks;
}

} // namespace supple::tools
