// Evaluation of bicubic patches: regular, p-rep's with the sparse bi-5 perturbation (docs/prep.md), polar (docs/pm.md).
// Coefficients are gathered from the pool by index. Narrow mapping: one lane a patch, everything in registers, rows collapsed
// in v first. Wide mapping: a workgroup takes a few patches into shared memory, its lanes share the samples. Both use the functions
// collapse() and finish(), so positions agree bit for bit.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define POOL_READ_ONLY
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/evaluate/basis.glsl"
#include "shaders/evaluate/surface_vertex.glsl"
#include "shaders/evaluate/bicubic.glsl"

const bool kPerturbed = kClass == kPerturbedPatch;
const bool kPolar = kClass == kPolarPatch;
const uint kCoefficients = kPerturbed ? 32u : 16u;

// A row of the patch at one v: the cubic row points and their v-derivatives, and the same for the perturbation.
// The perturbation rows are h_i., i = 0, 1, 4, 5 (outer) and 2, 3 (inner). Derivatives come from coefficients relative to g00:
// far from the origin that keeps normals several times more exact. Positions come from the coefficients as they are, so
// that neighbours, whose g00 differ, agree bit for bit.
struct Row {
    vec3 g[4], relative[4], gv[4];
    vec3 outer[4], outerV[4];
    vec3 inner[2], innerV[2];
};

// Order of the 16 perturbation coefficients (pool gather and shared memory): h_2j then h_3j for j = 0, 1, 4, 5, then
// h_i2, h_i3 for i = 0, 1, 4, 5.
Row collapse(vec3 c[32], vec2 v) {
    Row row;
    vec4 b = bernstein3(v), d = bernsteinDerivative3(v);
    // Du of a polar patch has the factor 1 - v, which vanishes at the apex: it is left out.
    vec4 along = kPolar ? vec4(v.y * v.y, 3.0 * (v.x * v.y), 3.0 * (v.x * v.x), 0.0) : b;
    for (uint i = 0u; i < 4u; ++i) {
        precise vec3 g = sum4(b, c[i], c[4u + i], c[8u + i], c[12u + i]);
        row.g[i] = g;
        vec3 r0 = c[i] - c[0], r1 = c[4u + i] - c[0], r2 = c[8u + i] - c[0], r3 = c[12u + i] - c[0];
        row.relative[i] = blend4(along, r0, r1, r2, r3);
        row.gv[i] = blend4(d, r0, r1, r2, r3);
    }
    if (kPerturbed) {
        Basis5 b5 = bernstein5(v), d5 = bernsteinDerivative5(v);
        for (uint i = 0u; i < 2u; ++i) {
            row.inner[i] = sum4(b5.outer, c[16u + 4u * i], c[17u + 4u * i], c[18u + 4u * i], c[19u + 4u * i]);
            row.innerV[i] = blend4(d5.outer, c[16u + 4u * i], c[17u + 4u * i], c[18u + 4u * i], c[19u + 4u * i]);
        }
        for (uint i = 0u; i < 4u; ++i) {
            row.outer[i] = sum2(b5.inner, c[24u + 2u * i], c[25u + 2u * i]);
            row.outerV[i] = blend2(d5.inner, c[24u + 2u * i], c[25u + 2u * i]);
        }
    }
    return row;
}

// The sample of a row at u. The perturbation is added to the bicubic total last.
void finish(Row row, vec2 u, out vec3 position, out vec3 normal) {
    vec4 b = bernstein3(u), d = bernsteinDerivative3(u);
    precise vec3 p = sum4(b, row.g[0], row.g[1], row.g[2], row.g[3]);
    vec3 du = blend4(d, row.relative[0], row.relative[1], row.relative[2], row.relative[3]);
    vec3 dv = blend4(b, row.gv[0], row.gv[1], row.gv[2], row.gv[3]);
    if (kPerturbed) {
        Basis5 b5 = bernstein5(u), d5 = bernsteinDerivative5(u);
        precise vec3 h = sum2(b5.inner, row.inner[0], row.inner[1]) +
                         sum4(b5.outer, row.outer[0], row.outer[1], row.outer[2], row.outer[3]);
        p = p + h;
        du += blend2(d5.inner, row.inner[0], row.inner[1]) +
              blend4(d5.outer, row.outer[0], row.outer[1], row.outer[2], row.outer[3]);
        dv += blend2(b5.inner, row.innerV[0], row.innerV[1]) +
              blend4(b5.outer, row.outerV[0], row.outerV[1], row.outerV[2], row.outerV[3]);
    }
    position = p;
    normal = unitNormal(cross(du, dv)); // outwards
}

vec3 cornerNormal(vec3 normal, uint i, uint j, uvec4 slots, uint base) {
    bool left = i == 0u, right = i == push.rate, bottom = j == 0u, top = j == push.rate;
    if (!((left || right) && (bottom || top))) return normal;
    uint slot = bottom ? (left ? slots.x : slots.y) : (left ? slots.w : slots.z);
    return slot == kNoNormal ? normal : unitNormal(poolVector(base + slot));
}

void evaluateNarrow() {
    uint id = min(invocationIndex(), push.count * push.instanceCount - 1u);
    uint instance = id / push.count;
    uint patchIndex = id - instance * push.count;
    uint record = push.table + patchIndex * recordElements();
    uint base = instance * push.poolStride;
    vec3 c[32];
    for (uint k = 0u; k < kCoefficients / 4u; ++k) {
        uvec4 indices = base + tableElement(record + k);
        c[4u * k] = poolVector(indices.x);
        c[4u * k + 1u] = poolVector(indices.y);
        c[4u * k + 2u] = poolVector(indices.z);
        c[4u * k + 3u] = poolVector(indices.w);
    }
    uvec4 normalSlots = uvec4(kNoNormal);
    if (kCornerNormals) normalSlots = tableElement(record + recordElements() - 1u);

    uint side = push.rate + 1u;
    uint vertex = instance * push.verticesPerInstance + push.firstVertex + patchIndex * (side * side);
    for (uint j = 0u; j < side; ++j) {
        Row row = collapse(c, parameterPair(j, push.rate, push.pairs));
        for (uint i = 0u; i < side; ++i) {
            vec3 position, normal;
            finish(row, parameterPair(i, push.rate, push.pairs), position, normal);
            if (kPolar && j == push.rate) position = c[12]; // the apex itself, from every patch round it
            if (kCornerNormals) normal = cornerNormal(normal, i, j, normalSlots, base);
            storeSurfaceVertex(vertex, position, normal);
            ++vertex;
        }
    }
}

shared vec4 sharedCoefficients[kMaxPatchesPerGroup * 32u];

void evaluateWide() {
    uint total = push.count * push.instanceCount;
    uint first = workgroupIndex() * push.patchesPerGroup;
    uint here = first < total ? min(push.patchesPerGroup, total - first) : 0u;
    for (uint k = gl_LocalInvocationID.x; k < here * kCoefficients; k += gl_WorkGroupSize.x) {
        uint slot = k / kCoefficients, coefficient = k - slot * kCoefficients;
        uint id = first + slot;
        uint instance = id / push.count;
        uint record = push.table + (id - instance * push.count) * recordElements();
        uint index = instance * push.poolStride + tableWord(4u * record + coefficient);
        sharedCoefficients[slot * 32u + coefficient] = vec4(poolVector(index), 0.0);
    }
    barrier();
    uint side = push.rate + 1u, samples = side * side;
    for (uint k = gl_LocalInvocationID.x; k < here * samples; k += gl_WorkGroupSize.x) {
        uint slot = k / samples, sampleIndex = k - slot * samples;
        uint j = sampleIndex / side, i = sampleIndex - j * side;
        uint id = first + slot;
        uint instance = id / push.count;
        uint patchIndex = id - instance * push.count;
        vec3 c[32];
        for (uint n = 0u; n < kCoefficients; ++n) c[n] = sharedCoefficients[slot * 32u + n].xyz;
        Row row = collapse(c, parameterPair(j, push.rate, push.pairs));
        vec3 position, normal;
        finish(row, parameterPair(i, push.rate, push.pairs), position, normal);
        if (kPolar && j == push.rate) position = c[12];
        if (kCornerNormals) {
            uvec4 slots = tableElement(push.table + patchIndex * recordElements() + recordElements() - 1u);
            normal = cornerNormal(normal, i, j, slots, instance * push.poolStride);
        }
        storeSurfaceVertex(instance * push.verticesPerInstance + push.firstVertex + patchIndex * samples + sampleIndex,
                           position, normal);
    }
}

void main() {
    if (kWide) evaluateWide();
    else evaluateNarrow();
}
