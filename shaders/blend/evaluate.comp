// Evaluation of the blending surface: four local geometries a face, blended by Hermite weights (docs/blend.md). Where samples
// lie in the charts is read from tables: no transcendental here. Narrow mapping: one lane a patch, all of its coefficients in
// registers. Wide mapping: a workgroup takes a few patches into shared memory, its lanes share the samples. Both use
// blend() and normalAt(), so positions agree bit for bit.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define POOL_READ_ONLY
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/evaluate/surface_vertex.glsl"
#include "shaders/shared/blend.h"

layout(constant_id = 3) const uint kClass = kBlendPatch;
const bool kSharp = kClass == kBlendSharpPatch; // some chart is creased, or the surface lies still somewhere

struct Corner {
    uint flags, samples, creaseSamples;
    vec4 directions; // of its spoke, of the next
    vec3 c[9];
};

uint coordinateCount() { return push.rate + 3u; }
uint mirrored(uint i) { return i <= push.rate ? push.rate - i : 2u * push.rate + 3u - i; }

vec2 product(vec2 a, vec2 b) {
    precise vec2 p = vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
    return p;
}

// The local geometry's offset from c_00 and its derivatives by the corner's coordinates, at coordinates x and y.
void localGeometry(Corner corner, uint x, uint y, out vec3 offset, out vec3 dx, out vec3 dy) {
    uint at = y * coordinateCount() + x;
    vec4 entry = uintBitsToFloat(tableElement(corner.samples + at));
    vec2 direction = corner.directions.xy;
    vec2 toward = x == 0u && y > 0u ? corner.directions.zw : direction;
    vec2 zeta = product(entry.xy, toward), slope = product(entry.zw, direction);
    float u = zeta.x, v = zeta.y;
    // T, which takes U's place where V has no part: U itself, or the parameter of the crease.
    float t = u, tx = slope.x, ty = -slope.y;
    if (kSharp && (corner.flags & kCreasedChart) != 0u) {
        vec4 crease = uintBitsToFloat(tableElement(corner.creaseSamples + 2u * at));
        t = product(crease.xy, toward).x;
        tx = product(crease.zw, direction).x;
        ty = product(uintBitsToFloat(tableElement(corner.creaseSamples + 2u * at + 1u).xy), direction).x;
    }
    precise vec3 c0 = corner.c[1] + u * (corner.c[4] + u * corner.c[7]); // of V, and of V^2
    precise vec3 c1 = corner.c[2] + u * (corner.c[5] + u * corner.c[8]);
    precise vec3 value = t * (corner.c[3] + t * corner.c[6]) + v * (c0 + v * c1);
    vec3 dt = corner.c[3] + 2.0 * (t * corner.c[6]);
    vec3 du = v * ((corner.c[4] + 2.0 * (u * corner.c[7])) + v * (corner.c[5] + 2.0 * (u * corner.c[8])));
    vec3 dv = c0 + 2.0 * (v * c1);
    offset = value;
    dx = tx * dt + (slope.x * du + slope.y * dv);
    dy = ty * dt + (slope.x * dv - slope.y * du);
}

void blend(Corner corners[4], uint coordinates, uint i, uint j, out vec3 position, out vec3 du, out vec3 dv) {
    uint iBack = mirrored(i), jBack = mirrored(j);
    uvec2 at[4] = uvec2[4](uvec2(i, j), uvec2(j, iBack), uvec2(iBack, jBack), uvec2(jBack, i));
    precise vec3 points[4];
    vec3 dx[4], dy[4];
    for (uint k = 0u; k < 4u; ++k) {
        vec3 offset, localX, localY;
        localGeometry(corners[k], at[k].x, at[k].y, offset, localX, localY);
        vec3 x = uintBitsToFloat(tableElement(coordinates + at[k].x).xyz);
        vec3 y = uintBitsToFloat(tableElement(coordinates + at[k].y).xyz);
        precise float weight = x.y * y.y;
        precise vec3 p = weight * (corners[k].c[0] + offset);
        points[k] = p;
        // The slopes of the four weights add up to nothing, so that derivatives need not see coordinates.
        precise vec3 relative = (corners[k].c[0] - corners[0].c[0]) + offset;
        dx[k] = (x.z * y.y) * relative + weight * localX;
        dy[k] = (x.y * y.z) * relative + weight * localY;
    }
    // Opposite corners together: on an edge one of the two is zero, and the sum reads the same from both faces.
    precise vec3 sum = ((points[0] + points[2]) + (points[1] + points[3])) + 0.0;
    position = sum;
    du = (dx[0] - dx[2]) + (dy[3] - dy[1]);
    dv = (dy[0] - dy[2]) + (dx[1] - dx[3]);
}

const float kTinyNormal = 1e-12; // against the face's diagonals, squared

// Whether the surface has no derivative at a sample, by connectivity alone.
bool liesStill(Corner corners[4], uint i, uint j) {
    bool onEdge[4] = bool[4](j == 0u, i == push.rate, j == push.rate, i == 0u);
    bool still = false;
    for (uint k = 0u; k < 4u; ++k) {
        still = still || (onEdge[k] && (corners[k].flags & kStillEdge) != 0u);
        still = still || (onEdge[k] && onEdge[(k + 3u) & 3u] && (corners[k].flags & kStillCorner) != 0u);
    }
    return still;
}

// Of unit length, from the derivatives at a sample; at a corner from its chart, where the blend's derivatives have a limit.
vec3 normalAt(Corner corners[4], uint i, uint j, vec3 du, vec3 dv, bool still) {
    bool onEdge[4] = bool[4](j == 0u, i == push.rate, j == push.rate, i == 0u);
    vec3 n = cross(du, dv);
    for (uint k = 0u; k < 4u; ++k) {
        if (!still && onEdge[k] && onEdge[(k + 3u) & 3u]) n = cross(corners[k].c[3], corners[k].c[1]);
    }
    vec3 diagonal = corners[2].c[0] - corners[0].c[0], other = corners[3].c[0] - corners[1].c[0];
    if (!(dot(n, n) > kTinyNormal * (dot(diagonal, diagonal) * dot(other, other)))) n = cross(diagonal, other);
    return unitNormal(n);
}

// Half a step inside, for samples on a border.
uint inside(uint i) { return i == 0u ? push.rate + 1u : i == push.rate ? push.rate + 2u : i; }

void evaluateSample(Corner corners[4], uint i, uint j, bool still, out vec3 position, out vec3 normal) {
    vec3 du, dv;
    blend(corners, push.ring, i, j, position, du, dv);
    if (kSharp && still) {
        vec3 unused;
        blend(corners, push.ring, inside(i), inside(j), unused, du, dv);
    }
    normal = normalAt(corners, i, j, du, dv, still);
}

void evaluateNarrow() {
    uint id = min(invocationIndex(), push.count * instanceCount() - 1u);
    uint entry = id / push.count, instance = instanceSlot(entry);
    uint patchIndex = id - entry * push.count;
    uint base = instance * push.poolStride;
    Corner corners[4];
    for (uint k = 0u; k < 4u; ++k) {
        uvec4 record = tableElement(push.table + 4u * patchIndex + k);
        corners[k].flags = record.x & ~kPoolIndexMask;
        corners[k].directions = uintBitsToFloat(tableElement(record.y));
        corners[k].samples = record.z;
        corners[k].creaseSamples = record.w;
        for (uint c = 0u; c < 9u; ++c) corners[k].c[c] = poolVector(base + (record.x & kPoolIndexMask) + c);
    }
    uint side = push.rate + 1u;
    uint vertex = instance * push.verticesPerInstance + push.firstVertex + patchIndex * push.samples;
    for (uint j = 0u; j < side; ++j) {
        for (uint i = 0u; i < side; ++i) {
            vec3 position, normal;
            evaluateSample(corners, i, j, false, position, normal);
            storeSurfaceVertex(vertex + j * side + i, position, normal);
        }
    }
    if (!kSharp) return;
    // Once more along the border: lanes pay for a second blend, and inside none asks for it.
    for (uint n = 0u; n < 4u * push.rate; ++n) {
        uint edge = n / push.rate, along = n - edge * push.rate;
        uint i = edge == 0u ? along : edge == 1u ? push.rate : edge == 2u ? push.rate - along : 0u;
        uint j = edge == 0u ? 0u : edge == 1u ? along : edge == 2u ? push.rate : push.rate - along;
        vec3 position, normal;
        evaluateSample(corners, i, j, true, position, normal);
        if (liesStill(corners, i, j)) storeSurfaceVertex(vertex + j * side + i, position, normal);
    }
}

shared vec4 sharedCoefficients[kMaxPatchesPerGroup * 36u];

void evaluateWide() {
    uint total = push.count * instanceCount();
    uint first = workgroupIndex() * push.patchesPerGroup;
    uint here = first < total ? min(push.patchesPerGroup, total - first) : 0u;
    for (uint n = gl_LocalInvocationID.x; n < here * 36u; n += gl_WorkGroupSize.x) {
        uint slot = n / 36u, c = n - slot * 36u;
        uint id = first + slot;
        uint entry = id / push.count, instance = instanceSlot(entry);
        uint word = tableElement(push.table + 4u * (id - entry * push.count) + c / 9u).x;
        sharedCoefficients[n] = vec4(poolVector(instance * push.poolStride + (word & kPoolIndexMask) + c % 9u), 0.0);
    }
    barrier();
    uint side = push.rate + 1u;
    for (uint n = gl_LocalInvocationID.x; n < here * push.samples; n += gl_WorkGroupSize.x) {
        uint slot = n / push.samples, sampleIndex = n - slot * push.samples;
        uint j = sampleIndex / side, i = sampleIndex - j * side;
        uint id = first + slot;
        uint entry = id / push.count, instance = instanceSlot(entry);
        uint patchIndex = id - entry * push.count;
        Corner corners[4];
        for (uint k = 0u; k < 4u; ++k) {
            uvec4 record = tableElement(push.table + 4u * patchIndex + k);
            corners[k].flags = record.x & ~kPoolIndexMask;
            corners[k].directions = uintBitsToFloat(tableElement(record.y));
            corners[k].samples = record.z;
            corners[k].creaseSamples = record.w;
            for (uint c = 0u; c < 9u; ++c) corners[k].c[c] = sharedCoefficients[slot * 36u + 9u * k + c].xyz;
        }
        vec3 position, normal;
        evaluateSample(corners, i, j, kSharp && liesStill(corners, i, j), position, normal);
        storeSurfaceVertex(instance * push.verticesPerInstance + push.firstVertex + patchIndex * push.samples + sampleIndex,
                           position, normal);
    }
}

void main() {
    if (kWide) evaluateWide();
    else evaluateNarrow();
}
