#include "tools/supple/limit_distance.h"

#include "tools/supple/limit_surface.h"
#include "tools/supple/surface_batches.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace supple::tools {

namespace {

constexpr int kLeastPower = -6, kMostPower = -2; ///< of 10, at the ends of the scale

float onScale(double fraction) {
    const double power = std::log10(std::max(fraction, 1e-12));
    return static_cast<float>(std::clamp((power - kLeastPower) / (kMostPower - kLeastPower), 0.0, 1.0));
}

Result<std::vector<SupplePatchInfo>> patchesOf(const host::FigureGroup& group, uint32_t surface, uint32_t count) {
    host::Context& context = group.figure().context();
    std::vector<SupplePatchInfo> patches(count);
    const SuppleResult result = suppleGetPatches(context.handle(), group.handle(), surface, patches.data(), &count);
    const Status status = context.check(result, "suppleGetPatches");
    return status ? Result<std::vector<SupplePatchInfo>>(std::move(patches)) : status.error();
}

} // namespace

Result<std::vector<float>> distancesToLimit(const host::FigureGroup& group, const cage::Cage& cage) {
    const Result<std::vector<glm::vec3>> vertices = group.readSurface();
    const Result<std::vector<glm::vec3>> deformed = group.readCage();
    if (!vertices || !deformed)
        return !vertices ? vertices.error() : deformed.error();
    const std::vector<glm::dvec3> positions(deformed->begin(), deformed->end());
    const Result<LimitSurface> limit = LimitSurface::build(cage, positions);
    if (!limit)
        return Error{limit.error().code, group.figure().path() + ": " + limit.error().message};
    const double extent = 2.0 * static_cast<double>(host::boundsOf(*deformed).radius());

    std::vector<float> values(vertices->size(), -1.0f);
    size_t first = 0;
    for (uint32_t s = 0; s < group.surfaces().size(); ++s) {
        const host::GroupOutput& output = group.surfaces()[s].output;
        const Result<std::vector<SupplePatchInfo>> patches = patchesOf(group, s, output.surface.patchCount);
        if (!patches)
            return patches.error();
        const bool mesh = output.grid.drawRangeCount > 0 && output.grid.drawRanges[0].domain == SUPPLE_DOMAIN_MESH;
        const std::vector<PatchBatch> batches = mesh ? std::vector<PatchBatch>() : patchBatches(output.grid);
        inThreads(batches, [&](const PatchBatch& batch, size_t) {
            LimitSurface::Probe probe(*limit);
            batch.forEachVertex([&](uint32_t patch, size_t vertex) {
                const glm::dvec3 position((*vertices)[first + vertex]);
                const double distance = probe.measure((*patches)[patch].face, position, glm::dvec3(0.0)).distance;
                values[first + vertex] = onScale(distance / extent);
            });
        });
        first += output.grid.vertexCount;
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
