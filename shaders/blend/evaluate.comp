// Evaluates the blending surface: four local geometries per face, blended by Hermite weights (docs/blend.md). At a rate, tables
// say where samples lie in the charts: nothing transcendental is computed here. Narrow mapping: a lane has all coefficients of a
// patch in registers. Wide mapping: the parts that lanes load are single coefficients. Both use blend() and checkedFrame(), so
// positions agree bit for bit.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define POOL_READ_ONLY
#include "shaders/surface/tables.glsl"
#include "shaders/shared/blend.h"
#include "shaders/shared/lod.h"

const uint kRecordElements = 4u;
const uint kForm = kLodQuadForm;
const uint kParts = 4u * kChartCoefficients; // coefficients
#include "shaders/evaluate/harness.glsl"

layout(constant_id = kKindConstant) const uint kClass = kBlendPatch;
const bool kSharp = kClass == kBlendSharpPatch; // some chart is creased, or the surface lies still somewhere
#include "shaders/evaluate/rate.glsl"
#include "shaders/blend/sample.glsl"

#ifndef WIDE
Corner[4] loadCorners(const PatchPlace at) {
    Corner corners[4];
    for (uint k = 0u; k < 4u; ++k) {
        uint poolIndex;
        corners[k] = cornerOf(at.record + k, poolIndex);
        for (uint c = 0u; c < 9u; ++c) corners[k].c[c] = coefficient(at.base + poolIndex + c, at.isNew);
    }
    return corners;
}

#ifndef LEVELS
void evaluatePatch(const PatchPlace at) {
    Corner corners[4] = loadCorners(at);
    uint side = dispatchRate() + 1u, vertex = at.vertex, j = 0u;
    do {
        uint i = 0u;
        do {
            vec3 position;
            Frame frame;
            evaluateAtRate(corners, i, j, false, position, frame);
            storeSurfaceVertex(vertex + j * side + i, at.own + j * side + i, position, frame);
        } while (++i < side);
    } while (++j < side);
    if (!kSharp) return;
    // Once more along the border: lanes pay for a second blend, and inside none asks for it.
    for (uint n = 0u; n < 4u * dispatchRate(); ++n) {
        uint edge = n / dispatchRate(), along = n - edge * dispatchRate();
        uint i = edge == 0u ? along : edge == 1u ? dispatchRate() : edge == 2u ? dispatchRate() - along : 0u;
        uint j = edge == 0u ? 0u : edge == 1u ? along : edge == 2u ? dispatchRate() : dispatchRate() - along;
        vec3 position;
        Frame frame;
        evaluateAtRate(corners, i, j, true, position, frame);
        if (liesStill(corners, i, j)) storeSurfaceVertex(vertex + j * side + i, at.own + j * side + i, position, frame);
    }
}

#else
// Loops are tested at the bottom, see evaluate/bicubic.comp.
void evaluatePatch(const PatchPlace at, uint lodRecord) {
    uint last = at.capacity, side = last + 1u;
    Corner corners[4] = loadCorners(at);
    LodPattern patterns[6];
    for (uint k = 0u; k < 6u; ++k) patterns[k] = recordPattern(lodRecord, k, at.capacityIndex);
    uint j = 0u;
    do {
        uint i = 0u;
        do {
            vec2 u = vec2(i == 0u ? 0.0 : 1.0, i == 0u ? 1.0 : 0.0), v = vec2(j == 0u ? 0.0 : 1.0, j == 0u ? 1.0 : 0.0);
            if (i > 0u && i < last) u = lodPair(j == 0u ? patterns[2] : j == last ? patterns[4] : patterns[0], i, last);
            if (j > 0u && j < last) v = lodPair(i == last ? patterns[3] : i == 0u ? patterns[5] : patterns[1], j, last);
            vec3 position;
            Frame frame;
            evaluateLevels(corners, u, v, position, frame);
            uint own = at.vertex + j * side + i;
            storeSurfaceVertex(own, own, at.empty ? vec3(0.0) : position, frame);
        } while (++i < side);
    } while (++j < side);
}

#endif
#else
shared vec4 localCoefficients[kMaxPatchesPerGroup * kParts];

void loadPart(uint to, const PatchPlace at, uint c) {
    uint poolIndex = tableElement(at.record + c / kChartCoefficients).x & kPoolIndexMask;
    localCoefficients[to] = vec4(coefficient(at.base + poolIndex + c % kChartCoefficients, at.isNew), 0.0);
}

void evaluateSample(uint place, const PatchPlace at, uint index, out vec3 position, out Frame frame) {
    Corner corners[4];
    for (uint k = 0u; k < 4u; ++k) {
        uint poolIndex;
        corners[k] = cornerOf(at.record + k, poolIndex);
        for (uint c = 0u; c < 9u; ++c) corners[k].c[c] = localCoefficients[place * kParts + 9u * k + c].xyz;
    }
#ifdef LEVELS
    uint j = index / (at.capacity + 1u), i = index - j * (at.capacity + 1u);
    evaluateLevels(corners, lodU(place, at.capacity, i, j), lodV(place, at.capacity, i, j), position, frame);
#else
    uint j = index / (dispatchRate() + 1u), i = index - j * (dispatchRate() + 1u);
    evaluateAtRate(corners, i, j, kSharp && liesStill(corners, i, j), position, frame);
#endif
}
#endif
