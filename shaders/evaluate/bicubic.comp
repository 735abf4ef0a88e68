// Evaluates bicubic patches: regular ones, those of p-rep with the sparse bi-5 perturbation (docs/prep.md), and polar ones
// (docs/pm.md). Coefficients are gathered from the pool by index. A patch is collapsed to rows or columns first, then each of these
// is sampled. There are three forms, which all use the functions of rows.glsl, so positions agree bit for bit between the mappings:
//
//   whole_patches.glsl   at a rate a lane takes a patch
//   net_rows.glsl        at a rate a lane of the wide mapping takes a row, where there are few patches
//   lines.glsl           at levels a lane of the wide mapping takes a side or a column of samples inside, of polar patches a row; one of
//                        the narrow mapping takes a patch
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#define POOL_READ_ONLY
#define OWN_WIDE
#include "shaders/surface/tables.glsl"
#include "shaders/evaluate/bicubic.glsl"
#include "shaders/shared/lod.h"

const uint kForm = kLodQuadForm;
#include "shaders/evaluate/harness.glsl"
#include "shaders/evaluate/pairs.glsl"
#include "shaders/evaluate/basis.glsl"
#include "shaders/evaluate/domain.glsl"

#include "shaders/evaluate/rows.glsl"

Frame withCornerNormal(Frame frame, uint corner, uvec4 slots, uint base) {
    uint slot = componentOf(slots, corner);
    if (slot == kNoNormal) return frame;
    return withNormal(frame, poolVector(base + slot));
}

// Where what a corner is made of lies: its coefficients are 0 itself, 1 towards the next corner, 2 towards the last, 3 of the face.
const uvec4 kCorner0 = uvec4(0u, 1u, 4u, 5u), kCorner1 = uvec4(3u, 7u, 2u, 6u), kCorner2 = uvec4(15u, 14u, 11u, 10u),
            kCorner3 = uvec4(12u, 8u, 13u, 9u);
vec3 netVector(const PatchPlace at, NetRecord net, uint k) { return coefficient(at.base + netIndex(net, kPolar, k), at.isNew); }
// The apex of a polar patch is all of its row v = 1: nothing lies between its two corners there.
Corner loadCorner(const PatchPlace at, NetRecord net, uvec4 k) {
    return Corner(netVector(at, net, k.x), kPolar && cornerOf(k.y) == k.y ? vec3(0.0) : netVector(at, net, k.y),
                  kPolar && cornerOf(k.z) == k.z ? vec3(0.0) : netVector(at, net, k.z), netVector(at, net, k.w));
}
// Where lanes ask for different corners.
Corner loadCorner(const PatchPlace at, NetRecord net, uint corner) {
    if (kPolar)
        return loadCorner(at, net, corner == 0u ? kCorner0 : corner == 1u ? kCorner1 : corner == 2u ? kCorner2 : kCorner3);
    uint spoke = componentOf(net.spokes, corner), tangents = at.base + header.tangents, faces = at.base + header.faces;
    return Corner(coefficient(at.base + componentOf(net.points, corner), at.isNew),
                  coefficient(tangents + SUPPLE_SPOKE(spoke), at.isNew), coefficient(tangents + SUPPLE_NEXT_SPOKE(spoke), at.isNew),
                  coefficient(faces + SUPPLE_SPOKE(spoke), at.isNew));
}
Patch loadPatch(const PatchPlace at) {
    Patch c;
    NetRecord net = netRecord(at.record);
    c.c0 = loadCorner(at, net, kCorner0);
    c.c1 = loadCorner(at, net, kCorner1);
    c.c2 = loadCorner(at, net, kCorner2);
    c.c3 = loadCorner(at, net, kCorner3);
    c.left = between(c.c0.point, c.c3.point);
    c.right = between(c.c1.point, c.c2.point);
    c.bottom = between(c.c0.point, c.c1.point);
    if (kPerturbed) {
        uvec4 edges = tableElement(at.record + 2u);
        for (uint k = 0u; k < 16u; ++k) c.h[k] = coefficient(at.base + perturbationIndex(edges, k), at.isNew);
    }
    return c;
}

uvec4 normalSlots(uint record) {
    return kCornerNormals ? tableElement(record + kRecordElements - 1u) : uvec4(kNoNormal);
}

#ifdef LEVELS
#include "shaders/evaluate/lines.glsl"
#else
#include "shaders/evaluate/whole_patches.glsl"
#ifdef WIDE
#include "shaders/evaluate/net_rows.glsl"

void evaluateWide() {
    if (kLanePatch) evaluatePatches();
    else evaluateWideRows();
}
#endif
#endif
