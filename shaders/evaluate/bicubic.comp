// Evaluates bicubic patches: regular ones, those of p-rep with the sparse bi-5 perturbation (docs/prep.md), and polar ones
// (docs/pm.md). Coefficients are gathered from the pool by index (pool_corners.glsl), or with FAN_RECORDS made of what the pool has of
// fans (record_corners.glsl). A patch is collapsed to rows or columns first, then each of these
// is sampled. There are three forms, which all use the functions of rows.glsl, so positions agree bit for bit between the mappings:
//
//   whole_patches.glsl   at a rate a lane takes a patch
//   net_rows.glsl        at a rate a lane of the wide mapping takes a row, where there are few patches
//   lines.glsl           at levels a lane of the wide mapping takes a side or a column of samples inside, of polar patches a row; one of
//                        the narrow mapping takes a patch
#version 460
#extension GL_GOOGLE_include_directive : require
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

#ifdef FAN_RECORDS
#include "shaders/evaluate/record_corners.glsl"
#else
#include "shaders/evaluate/pool_corners.glsl"
#endif
Patch loadPatch(const PatchPlace at) {
    Patch c;
    loadCorners(at, c);
    c.left = between(c.c0.point, c.c3.point);
    c.right = between(c.c1.point, c.c2.point);
    c.bottom = between(c.c0.point, c.c1.point);
    if (kPerturbed) {
        uvec4 edges = tableElement(at.record + 2u);
        for (uint k = 0u; k < 16u; ++k) c.h[k] = coefficient(at.base + perturbationIndex(edges, k), at.isNew);
    }
    return c;
}

Frame withCornerNormal(Frame frame, uint corner, uvec4 slots, uint base) {
    uint slot = componentOf(slots, corner);
    if (slot == kNoNormal) return frame;
    return withNormal(frame, cornerNormal(base, slot));
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
