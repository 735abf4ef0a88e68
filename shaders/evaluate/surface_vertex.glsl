// The surface vertex: 16 bytes (position, octahedral normal in 2 x snorm16), 24 (position, normal) or 12 (position); and its
// tangent, in a word of its own.
layout(constant_id = kVertexFormatConstant) const uint kVertexFormat = kVertex16;

BUFFER(writeonly, Surface16, kSurfaceBinding, std430, uvec4, surface16)
BUFFER(writeonly, SurfaceFloats, kSurfaceBinding, std430, float, surfaceFloats)

layout(constant_id = kTangentsConstant) const bool kTangents = false;
BUFFER(writeonly, Tangents, kTangentBinding, std430, uint, tangents)
BUFFER(readonly, Directions, kDirectionBinding, std430, uint, directions)

#include "shaders/evaluate/frame.glsl"
#include "shaders/shared/octahedral.glsl"

// Of normals of any length. A zero one is +z.
uint encodeOctahedral(vec3 n) {
    uvec2 bits = roundedBits(octahedralOf(n, 1.0 / max(abs(n.x) + abs(n.y) + abs(n.z), kTiny)), vec2(32767.0));
    return (bits.x & 0xFFFFu) | bits.y << 16u;
}

// The tangent points where the second texture coordinate stands still (docs/tangents.md). Of the direction only the ratio of its
// parts counts.
uint tangentWord(uint direction, Frame f) {
    const float kRatio = 32767.0 / (2.0 * 16383.0); // of a, which stands in the high half here, to b, which has a bit less
    vec3 t = float(int(direction << 16u)) * f.du + kRatio * float(int(direction << 1u & 0xFFFE0000u)) * f.dv;
    float size = abs(t.x) + abs(t.y) + abs(t.z);
    if (!(size > kTiny)) { // any direction on the surface
        t = vec3(f.normal.z, 0.0, -f.normal.x);
        size = abs(t.x) + abs(t.z);
        if (!(size > kTiny)) t.x = size = 1.0;
    }
    uvec2 bits = roundedBits(octahedralOf(t, 1.0 / size), vec2(32767.0, 16383.0));
    return (bits.x & 0xFFFFu) | (bits.y & 0x7FFFu) << 16u | (direction & kNegativeFrame);
}
void storeTangent(uint vertex, uint own, Frame f) {
    if (kTangents) tangents.at[vertex] = tangentWord(directions.at[own], f);
}

// Previous positions lie in the space of this frame: they are less by what the origin has moved since the frame they come from.
// Those of instances without a past are this frame's own.
vec3 pastStep = vec3(push.window.pastX, push.window.pastY, push.window.pastZ);
void setPast(bool isNew) {
    if (kVertexFormat == kVertexPosition)
        pastStep = isNew ? vec3(0.0) : vec3(push.window.pastX, push.window.pastY, push.window.pastZ);
}

// Three floats one behind the other: vectors of three would need the feature scalarBlockLayout to lie so densely.
void storeVector(uint at, vec3 v) {
    surfaceFloats.at[3u * at] = v.x;
    surfaceFloats.at[3u * at + 1u] = v.y;
    surfaceFloats.at[3u * at + 2u] = v.z;
}

// `normal`: of any length; a vanishing one stays zero instead of becoming NaN.
void storeSurfaceVertex(uint vertex, vec3 position, vec3 normal) {
    if (kVertexFormat == kVertexPosition) {
        precise vec3 past = position - pastStep; // the same bits if that is zero
        storeVector(vertex, past);
    } else if (kVertexFormat == kVertex24) {
        storeVector(2u * vertex, position);
        storeVector(2u * vertex + 1u, unitNormal(normal));
    } else {
        surface16.at[vertex] = uvec4(floatBitsToUint(position), encodeOctahedral(normal));
    }
}

// `own`: the vertex within its instance.
void storeSurfaceVertex(uint vertex, uint own, vec3 position, Frame f) {
    storeSurfaceVertex(vertex, position, f.normal);
    storeTangent(vertex, own, f);
}

// The same in two steps: the normal's words, and their storing by another lane. Where a vertex takes two stores, neighboring
// lanes do one each.
const uint kNormalWords = kVertexFormat == kVertex16 ? 1u : kVertexFormat == kVertex24 ? 3u : 0u;
const uint kVertexStores = kVertexFormat == kVertex24 ? 2u : 1u;
uvec3 normalWords(vec3 normal) {
    if (kVertexFormat == kVertex16) return uvec3(encodeOctahedral(normal), 0u, 0u);
    return floatBitsToUint(unitNormal(normal));
}
void storePosition(uint vertex, vec3 position, uint word) {
    if (kVertexFormat == kVertex16) surface16.at[vertex] = uvec4(floatBitsToUint(position), word);
    else if (kVertexFormat == kVertexPosition) storeSurfaceVertex(vertex, position, vec3(0.0));
    else storeVector(kVertexStores * vertex, position);
}
void storeNormal(uint vertex, uvec3 words) { storeVector(kVertexStores * vertex + 1u, uintBitsToFloat(words)); }
