// Levels of patches: the largest of a patch's edges and of what its inside asks for, counted into the histograms that the
// budget is solved with (docs/lod.md, sections 4 and 6). One invocation a patch and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#define POOL_READ_ONLY
#define LOD_WRITE
#define PUSH_CONSTANTS LodPush
#include "shaders/shared/lod.h"
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/lod/lod.glsl"
#include "shaders/lod/levels.glsl"

layout(constant_id = 3) const bool kCharts = false; // patches of the blending surface
const bool kSharp = true;
#include "shaders/blend/blend.glsl"

// What the inside of a bicubic patch asks for along u and along v: its net's largest second differences.
vec2 bicubicLevels(uint record, uint base, bool polar) {
    vec3 g[16];
    for (uint row = 0u; row < 4u; ++row) {
        uvec4 indices = base + tableElement(record + row);
        g[4u * row] = poolVector(indices.x);
        g[4u * row + 1u] = poolVector(indices.y);
        g[4u * row + 2u] = poolVector(indices.z);
        g[4u * row + 3u] = poolVector(indices.w);
    }
    // Offsets from their corners (shared/surface.h); the rows of corners last. A polar patch has its apex all along row 3.
    for (uint k = 4u; k < 8u; ++k) g[k] += g[k / 2u % 2u * 3u];
    for (uint k = 8u; k < 12u; ++k) g[k] += g[12u + k / 2u % 2u * 3u];
    g[1] += g[0];
    g[2] += g[3];
    if (!polar) {
        g[13] += g[12];
        g[14] += g[15];
    }
    vec2 bend = vec2(0.0), curveLength = vec2(0.0);
    for (uint k = 0u; k < 4u; ++k) {
        vec3 a = g[4u * k], b = g[4u * k + 1u], c = g[4u * k + 2u], d = g[4u * k + 3u];
        bend.x = max(bend.x, max(lengthOf(a - 2.0 * b + c), lengthOf(b - 2.0 * c + d)));
        curveLength.x = max(curveLength.x, lengthOf(b - a) + lengthOf(c - b) + lengthOf(d - c));
        a = g[k], b = g[4u + k], c = g[8u + k], d = g[12u + k];
        bend.y = max(bend.y, max(lengthOf(a - 2.0 * b + c), lengthOf(b - 2.0 * c + d)));
        curveLength.y = max(curveLength.y, lengthOf(b - a) + lengthOf(c - b) + lengthOf(d - c));
    }
    vec3 centre = 0.25 * ((g[0] + g[15]) + (g[3] + g[12]));
    float pixels = pixelsPerUnit(centre, 0.25 * (curveLength.x + curveLength.y));
    return vec2(levelOf(curveLength.x, bend.x, pixels), levelOf(curveLength.y, bend.y, pixels));
}

// And of a patch of sectors: how far its centre lies from the mean of its corners.
float sectorLevel(uint record, uint sides, uint base) {
    vec3 corners[5], mean = vec3(0.0);
    for (uint i = 0u; i < sides; ++i) {
        corners[i] = poolVector(base + tableElement(record + i).x);
        mean += corners[i] / float(sides);
    }
    vec3 centre = poolVector(base + tableElement(record).w);
    float reach = 0.0;
    for (uint i = 0u; i < sides; ++i) reach = max(reach, lengthOf(corners[i] - centre));
    // A cubic's second differences b make a sag of 3/4 b.
    return levelOf(2.0 * reach, lengthOf(mean - centre) * (4.0 / 3.0), pixelsPerUnit(centre, reach));
}

// And of a blend of charts: along the middle, by quarters.
vec2 chartLevels(uint record, uint base) {
    Corner corners[4];
    for (uint k = 0u; k < 4u; ++k) {
        uint poolIndex;
        corners[k] = cornerOf(record + k, poolIndex);
        for (uint c = 0u; c < 9u; ++c) corners[k].c[c] = poolVector(base + poolIndex + c);
    }
    vec2 bend = vec2(0.0), curveLength = vec2(0.0);
    vec3 centre = vec3(0.0);
    for (uint axis = 0u; axis < 2u; ++axis) {
        vec3 first = vec3(0.0), second = vec3(0.0); // the last point but one, the last
        for (uint i = 0u; i < 5u; ++i) {
            vec2 along = vec2(0.25 * float(i), 1.0 - 0.25 * float(i));
            vec3 point, du, dv;
            blendAt(corners, axis == 0u ? along : vec2(0.5), axis == 0u ? vec2(0.5) : along, point, du, dv);
            if (i > 0u) curveLength[axis] += lengthOf(point - second);
            if (i > 1u) bend[axis] = max(bend[axis], lengthOf((first + point) - 2.0 * second));
            if (i == 2u) centre = point;
            first = second;
            second = point;
        }
    }
    bend *= 16.0 / 6.0;
    float pixels = pixelsPerUnit(centre, 0.25 * (curveLength.x + curveLength.y));
    return vec2(levelOf(curveLength.x, bend.x, pixels), levelOf(curveLength.y, bend.y, pixels));
}

void main() {
    uint id = invocationIndex();
    if (id >= push.count * instanceCount()) return;
    uint entry = id / push.count, listed = instanceEntry(entry), patchIndex = id - entry * push.count;
    uint instance = listed & kInstanceSlotMask, priority = (listed >> kInstancePriorityShift) & (kPriorityCount - 1u);
    uint words = levelBase(instance), base = instance * push.poolStride;
    uvec4 edges = tableElement(push.patches + 2u * patchIndex), more = tableElement(push.patches + 2u * patchIndex + 1u);
    uint run = push.firstRun + more.y, form = lodWord(kLodRuns + run) & 255u;
    uint sides = formSides(form);
    float level = 0.0;
    vec2 own;
    if (push.levels != 0u) {
        level = levelOfEntry(entry);
        own = vec2(level);
    } else {
        for (uint k = 0u; k < sides; ++k)
            level = max(level, uintBitsToFloat(levelWord(words + (k < 4u ? edges[k] : more.x))));
        if (kCharts) own = chartLevels(more.z, base);
        else if (form == kLodQuadForm) own = bicubicLevels(more.z, base, more.w == kPolarPatch);
        else own = vec2(sectorLevel(more.z, sides, base));
        level = max(level, max(own.x, own.y));
    }

    float at = (clamp(log2(max(level, 1e-3)), -float(kOctavesBelow), 7.99) + float(kOctavesBelow)) * float(kBinsPerOctave);
    uint bin = uint(at), weight = uint((at - float(bin)) * float(kSplitUnit));
    uint target = words + push.edgeCount + kLodPatchLevelWords * patchIndex;
    scratchWords[target] = bin;
    scratchWords[target + 1u] = floatBitsToUint(own.x);
    scratchWords[target + 2u] = floatBitsToUint(own.y);
    uint split = kLodSplit + (priority * kLodForms + form) * kLodBinStride + bin;
    atomicAdd(lodWords[split], kSplitUnit - weight);
    if (weight > 0u) atomicAdd(lodWords[split + 1u], weight);
    atomicAdd(lodWords[kLodCounts + (run * kPriorityCount + priority) * kLodBinStride + bin], 1u);
}
