// Evaluates irregular quads of exact Catmull-Clark patches (docs/catmull_clark.md): every sample is that of a leaf.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define POOL_READ_ONLY
#include "shaders/surface/tables.glsl"
#include "shaders/shared/chains.h"
#include "shaders/shared/lod.h"

layout(constant_id = kKindConstant) const uint kClass = kIrregularPatch;
const bool kChains = kClass != kCreasedPatch, kSharp = kClass != kIrregularPatch;
const uint kRecordElements = kSharp ? kSharpQuadElements : kQuadRecordElements;
const uint kForm = kLodQuadForm;
#define OWN_WIDE
#ifdef LEVELS
#define DEPTH_OF_INSTANCE
#endif
#include "shaders/evaluate/harness.glsl"
#include "shaders/evaluate/pairs.glsl"
#include "shaders/evaluate/basis.glsl"
#include "shaders/surface/net.glsl"

vec3 poolPoint(const PatchPlace at, uint i) { return coefficient(at.base + i, at.isNew); }

layout(constant_id = kInteriorConstant) const bool kInterior = false; // edges have the samples on borders

uint last;

#if !defined(WIDE) || !defined(LEVELS)
const bool kInside = true;
const bool kSides = !kInterior;
void store(const PatchPlace at, bool own, uint i, uint j, vec3 position, Frame frame) {
    uint to = kInterior ? (j - 1u) * (last - 1u) + i - 1u : j * (last + 1u) + i;
    if (own) storeSurfaceVertex(at.vertex + to, at.own + to, SELECT3(at.empty, vec3(0.0), position), frame);
}
#include "shaders/catmull_clark/nets.glsl"

#if defined(WIDE)
// Four lanes have a quad, each a quarter. Lanes beside each other have the same quarters: quads lie in the order of their chains.
void evaluateWide() {
    uint lane = gl_LocalInvocationID.x, corner = lane / push.patchesPerGroup;
    uint item = workgroupIndex() * push.patchesPerGroup + lane - corner * push.patchesPerGroup;
    if (item >= push.count * instanceCount()) return;
    last = push.rate;
    evaluateQuarter(placeOf(item), corner);
}
#elif defined(LEVELS)
void evaluatePatch(const PatchPlace at, uint lodRecord) {
    last = at.capacity;
    for (uint k = 0u; k < 6u; ++k) patterns[k] = recordPattern(lodRecord, k, at.capacityIndex);
    evaluateQuad(at);
}
#else
void evaluatePatch(const PatchPlace at) {
    last = push.rate;
    evaluateQuad(at);
}
#endif
#else
#include "shaders/catmull_clark/lines.glsl"
#endif
