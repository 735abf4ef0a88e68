#include "runtime/surface_outputs.h"

#include "surface/patch_class.h"

#include <algorithm>

namespace supple::runtime {

Result<SurfaceOutputs> surfaceOutputs(const OutputWish& wish, const surface::Tables& tables, const char* scheme) {
    SurfaceOutputs outputs;
    outputs.streams = wish.viewFlags ? StreamSet::ofView(*wish.viewFlags) : StreamSet::ofGroup(wish.groupFlags);
    if ((wish.groupFlags & SUPPLE_GROUP_DIRECT) != 0) {
        outputs.streams.remove(Stream::vertices);
    }
    const bool hasCoefficients =
        !tables.ranges.empty() &&
        std::all_of(tables.ranges.begin(), tables.ranges.end(),
                    [](const surface::PatchRange& range) { return surface::rowOf(range.patchClass).coefficients > 0; });
    outputs.patches = (wish.groupFlags & SUPPLE_GROUP_PATCHES) != 0;
    if (outputs.patches && !hasCoefficients) {
        if (!wish.schemeChosen) {
            return Error{ErrorCode::argument, wish.name + ": " + scheme + " has no patch coefficients"};
        }
        outputs.patches = false;
    }
    if (!tables.hasTangents()) { // there is nothing to draw
        outputs.streams.remove(Stream::tangents);
    }
    outputs.streams.keepAttributes(tables.attributeOutputs());
    if (tables.patches.empty()) {
        outputs.streams.remove(Stream::previousPositions);
    }
    return outputs;
}

uint32_t beginRate(uint32_t asked, const surface::Tables& tables, surface::RateRule rates) {
    if (tables.rate != 0 && rates == surface::RateRule::upTo) { // they may be those of a higher rate
        return (asked + (1u << tables.isolationSteps) - 1) >> tables.isolationSteps;
    }
    return tables.rate == 0 ? asked : tables.rate;
}

surface::ProgramOptions programOptionsOf(const OutputWish& wish, const SurfaceOutputs& outputs, uint32_t rate) {
    surface::ProgramOptions options;
    options.vertexFormat = static_cast<uint32_t>(wish.format);
    options.vertices = outputs.streams.has(Stream::vertices);
    options.motion = outputs.streams.has(Stream::previousPositions);
    options.patches = outputs.patches;
    options.tangents = outputs.streams.has(Stream::tangents);
    options.attributes = outputs.streams.has(Stream::attributes);
    options.attributeOutputs = outputs.streams.attributeOutputs();
    options.rate = rate; // though another may be set later
    return options;
}

} // namespace supple::runtime
