// Vertex stage of p-rep: limit point, spoke tangents, face coefficients (SMI 2008, eqs. (2)-(4), corrected as docs/prep.md).
// One invocation a cage vertex and instance. kRegular: interior vertices of valence 4, with the weights as constants.
#version 460
#extension GL_GOOGLE_include_directive : require
#define POOL_WRITE_ONLY
#include "shaders/prep/tables.glsl"
#include "shaders/prep/pool.glsl"
#include "shaders/prep/store.glsl"

layout(constant_id = 3) const bool kRegular = false;

layout(set = 0, binding = kCageBinding, std430) readonly buffer Cage { vec4 cage[]; };
layout(set = 0, binding = kCageTexelBinding) uniform samplerBuffer cageTexels;

vec3 cageVertex(uint i) {
    if (kWide) return cage[i].xyz;
    return texelFetch(cageTexels, int(i)).xyz;
}

vec3 faceCoefficient(vec3 p0, vec3 spoke, vec3 nextSpoke, vec3 diagonal) { // eq. (4)
    precise vec3 r = ((4.0 * p0 + 2.0 * (spoke + nextSpoke)) + diagonal) * (1.0 / 9.0);
    return r;
}

void regularVertex(uint base, uint slot, uint words, uint cageBase, uint vertex) {
    vec3 p0 = cageVertex(cageBase + vertex);
    vec3 e[4], d[4];

    for (uint k = 0u; k < 4u; ++k) {
        e[k] = cageVertex(cageBase + tableWord(words + 2u * k));
        d[k] = cageVertex(cageBase + tableWord(words + 2u * k + 1u));
    }
    // eq. (2) and (3) with n = 4: the uniform bicubic B-spline.
    precise vec3 edges = (e[0] + e[2]) + (e[1] + e[3]);
    precise vec3 faces = (d[0] + d[2]) + (d[1] + d[3]);
    precise vec3 x = (16.0 * p0 + (4.0 * edges + faces)) * (1.0 / 36.0);
    precise vec3 e1 = (4.0 * (e[0] - e[2]) + ((d[0] - d[2]) + (d[3] - d[1]))) * (1.0 / 36.0);
    precise vec3 e2 = (4.0 * (e[1] - e[3]) + ((d[0] - d[2]) + (d[1] - d[3]))) * (1.0 / 36.0);
    storePool(base + vertex, x);
    uint tangent = base + push.tangents + slot, face = base + push.faces + slot;
    storePool(tangent, x + e1);
    storePool(tangent + 1u, x + e2);
    storePool(tangent + 2u, x - e1);
    storePool(tangent + 3u, x - e2);
    for (uint k = 0u; k < 4u; ++k) storePool(face + k, faceCoefficient(p0, e[k], e[(k + 1u) & 3u], d[k]));
}

void anyVertex(uint base, uint slot, uint words, uint cageBase, uint vertex, uint weights) {
    uvec4 header = tableElement(weights);
    bool boundary = (header.x & kBoundaryClass) != 0u;
    uint sectors = header.x & ~kBoundaryClass;
    uint spokes = boundary ? sectors + 1u : sectors;
    uint tangent = base + push.tangents + slot, face = base + push.faces + slot;

    vec3 p0 = cageVertex(cageBase + vertex);
    precise vec3 x = uintBitsToFloat(header.y) * p0;
    precise vec3 e1 = vec3(0.0);
    precise vec3 e2 = uintBitsToFloat(header.z) * p0;
    vec3 firstSpoke = vec3(0.0), lastSpoke = vec3(0.0), lastDiagonal = vec3(0.0);
    for (uint k = 0u; k < spokes; ++k) {
        vec3 spoke = cageVertex(cageBase + tableWord(words + 2u * k));
        vec3 diagonal = cageVertex(cageBase + tableWord(words + 2u * k + 1u));
        vec4 a = uintBitsToFloat(tableElement(weights + 1u + 2u * k));
        vec4 b = uintBitsToFloat(tableElement(weights + 2u + 2u * k));
        x = x + (a.x * spoke + a.y * diagonal);
        e1 = e1 + (a.z * spoke + a.w * diagonal);
        e2 = e2 + (b.x * spoke + b.y * diagonal);
        if (k == 0u) firstSpoke = spoke;
        else storePool(face + k - 1u, faceCoefficient(p0, lastSpoke, spoke, lastDiagonal));
        lastSpoke = spoke;
        lastDiagonal = diagonal;
    }
    storePool(base + vertex, x);
    for (uint k = 0u; k < spokes; ++k) {
        vec4 b = uintBitsToFloat(tableElement(weights + 2u + 2u * k));
        precise vec3 t = x + (e1 * b.z + e2 * b.w);
        storePool(tangent + k, t);
    }
    if (boundary) {
        // The boundary curve is the cubic B-spline of the boundary polygon, whatever the interior does.
        precise vec3 first = (2.0 * p0 + firstSpoke) * (1.0 / 3.0);
        precise vec3 last = (2.0 * p0 + lastSpoke) * (1.0 / 3.0);
        storePool(tangent, first);
        storePool(tangent + sectors, last);
        storePool(face + sectors, cross(e1, e2));
    } else {
        storePool(face + sectors - 1u, faceCoefficient(p0, lastSpoke, firstSpoke, lastDiagonal));
    }
}

void main() {
    uint id = min(invocationIndex(), push.count * push.instanceCount - 1u);
    uint instance = id / push.count;
    uvec4 record = tableElement(push.table + (id - instance * push.count));
    uint base = instance * push.poolStride, cageBase = instance * push.cageStride;
    uint words = push.ring + 2u * record.y;
    if (kRegular) regularVertex(base, record.y, words, cageBase, record.x);
    else anyVertex(base, record.y, words, cageBase, record.x, record.z);
}
