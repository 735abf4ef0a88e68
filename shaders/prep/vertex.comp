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

// Everything is summed over differences to the vertex: far from the origin that keeps the tangents, and with them the
// normals, several times more exact. The weights of a point sum to 1 and those of a vector to 0, so that the centre's own
// weight never appears.

// eq. (4), relative to p0.
vec3 faceCoefficient(vec3 spoke, vec3 nextSpoke, vec3 diagonal) {
    precise vec3 r = (2.0 * (spoke + nextSpoke) + diagonal) * (1.0 / 9.0);
    return r;
}

void storePoint(uint i, vec3 p0, vec3 relative) {
    precise vec3 p = p0 + relative;
    storePool(i, p);
}

void regularVertex(uint base, uint slot, uint words, uint cageBase, uint vertex) {
    vec3 p0 = cageVertex(cageBase + vertex);
    precise vec3 e[4], d[4];
    for (uint k = 0u; k < 4u; ++k) {
        e[k] = cageVertex(cageBase + tableWord(words + 2u * k)) - p0;
        d[k] = cageVertex(cageBase + tableWord(words + 2u * k + 1u)) - p0;
    }
    // eq. (2) and (3) with n = 4: the uniform bicubic B-spline.
    precise vec3 x = (4.0 * ((e[0] + e[2]) + (e[1] + e[3])) + ((d[0] + d[2]) + (d[1] + d[3]))) * (1.0 / 36.0);
    precise vec3 e1 = (4.0 * (e[0] - e[2]) + ((d[0] - d[2]) + (d[3] - d[1]))) * (1.0 / 36.0);
    precise vec3 e2 = (4.0 * (e[1] - e[3]) + ((d[0] - d[2]) + (d[1] - d[3]))) * (1.0 / 36.0);
    storePoint(base + vertex, p0, x);
    uint tangent = base + push.tangents + slot, face = base + push.faces + slot;
    precise vec3 t[4] = vec3[4](x + e1, x + e2, x - e1, x - e2);
    for (uint k = 0u; k < 4u; ++k) storePoint(tangent + k, p0, t[k]);
    for (uint k = 0u; k < 4u; ++k) storePoint(face + k, p0, faceCoefficient(e[k], e[(k + 1u) & 3u], d[k]));
}

void anyVertex(uint base, uint slot, uint words, uint cageBase, uint vertex, uint weights) {
    uint header = tableElement(weights).x;
    bool boundary = (header & kBoundaryClass) != 0u;
    uint sectors = header & ~kBoundaryClass;
    uint spokes = boundary ? sectors + 1u : sectors;
    uint tangent = base + push.tangents + slot, face = base + push.faces + slot;

    vec3 p0 = cageVertex(cageBase + vertex);
    precise vec3 x = vec3(0.0), e1 = vec3(0.0), e2 = vec3(0.0);
    vec3 firstSpoke = vec3(0.0), lastSpoke = vec3(0.0), lastDiagonal = vec3(0.0);
    for (uint k = 0u; k < spokes; ++k) {
        precise vec3 spoke = cageVertex(cageBase + tableWord(words + 2u * k)) - p0;
        precise vec3 diagonal = cageVertex(cageBase + tableWord(words + 2u * k + 1u)) - p0;
        vec4 a = uintBitsToFloat(tableElement(weights + 1u + 2u * k));
        vec4 b = uintBitsToFloat(tableElement(weights + 2u + 2u * k));
        x = x + (a.x * spoke + a.y * diagonal);
        e1 = e1 + (a.z * spoke + a.w * diagonal);
        e2 = e2 + (b.x * spoke + b.y * diagonal);
        if (k == 0u) firstSpoke = spoke;
        else storePoint(face + k - 1u, p0, faceCoefficient(lastSpoke, spoke, lastDiagonal));
        lastSpoke = spoke;
        lastDiagonal = diagonal;
    }
    storePoint(base + vertex, p0, x);
    for (uint k = 0u; k < spokes; ++k) {
        vec4 b = uintBitsToFloat(tableElement(weights + 2u + 2u * k));
        precise vec3 t = x + (e1 * b.z + e2 * b.w);
        storePoint(tangent + k, p0, t);
    }
    if (boundary) {
        // The boundary curve is the cubic B-spline of the boundary polygon, whatever the interior does.
        precise vec3 first = firstSpoke * (1.0 / 3.0);
        precise vec3 last = lastSpoke * (1.0 / 3.0);
        storePoint(tangent, p0, first);
        storePoint(tangent + sectors, p0, last);
        pool[face + sectors] = vec4(cross(e1, e2), 0.0); // a normal, no position: shared/prep.h
    } else {
        storePoint(face + sectors - 1u, p0, faceCoefficient(lastSpoke, firstSpoke, lastDiagonal));
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
