// Indexed mesh: evaluates the samples along sides of Loop patches, each once, and at corners, each with one of the sides that begin
// there (evaluate/edge.comp). Frames are those of sectors: along the side and towards the centre.
// Narrow mapping: one lane per side. Wide mapping: one lane per sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define POOL_READ_ONLY
#define PUSH_CONSTANTS EdgePush
#include "shaders/surface/tables.glsl"
#include "shaders/shared/chains.h"
#include "shaders/surface/pool.glsl"
#include "shaders/evaluate/pairs.glsl"
#include "shaders/evaluate/surface_vertex.glsl"
#include "shaders/surface/net.glsl"

layout(constant_id = kKindConstant) const uint kKind = kIrregularTriangleEdges;
const bool kIrregular = kKind != kTriangleEdges, kSemiSharp = kKind == kSharpTriangleEdges;

struct PatchPlace {
    uint record, base;
};
vec3 poolPoint(const PatchPlace at, uint i) { return poolVector(at.base + i); }
#define ONE_TRIANGLE
#include "shaders/loop/place.glsl"

// Sample k of a side, which runs from its corner to the next one.
void storeSample(const PatchPlace at, Triangle t, Leaf leaf, uvec4 edge, uint instance, uint side, uint k) {
    if (k == 0u && edge.x == kNoEdgeSample) return; // another edge stores the corner
    TrianglePoint s = pointOnSide(side, parameterPair(k, fixedRate()));
    vec3 position;
    Frame frame;
    if (kIrregular) irregularTriangle(at, t, s, side, position, frame);
    else regularTriangle(at, t, laneCage, leaf, s, side, position, frame);
    uint to = k == 0u ? push.firstCorner + edge.x : push.firstVertex + edge.y * (fixedRate() - 1u) + k - 1u;
    storeSurfaceVertex(instance * push.verticesPerInstance + to, to, position, ofSector(frame));
}

void main() {
#ifdef WIDE
    uint id = invocationIndex(), lanes = push.count * fixedRate();
    if (id >= lanes * instanceCount()) return;
    uint entry = id / lanes, lane = id - entry * lanes, instance = instanceSlot(entry);
    uint element = lane / fixedRate(), k = lane - element * fixedRate(), end = k + 1u;
#else
    uint item = itemOfLane(), instance = instanceOf(item), element = elementOf(item), k = 0u, end = fixedRate();
#endif
    uint record = push.table + element * kEdgeElements;
    uvec4 source = tableElement(record), edge = tableElement(record + 2u);
    PatchPlace at = PatchPlace(source.x, instance * header.poolStride);
    Triangle t = triangleOf(at.record, kIrregular);
    laneCage = cageLeaf(at, t);
    Leaf leaf;
    if (!kIrregular) leaf = leafOf(laneCage);
    do storeSample(at, t, leaf, edge, instance, source.y, k);
    while (++k < end);
}
