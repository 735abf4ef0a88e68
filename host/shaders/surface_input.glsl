// The surface vertex of a draw, found by the public include as docs/integration.md says. One pipeline reads both vertex formats,
// so the buffers are declared here.
#include "supple_surface.glsl"
#include "instances.glsl"

layout(set = 1, binding = kSurfaceVertexBinding, std430) readonly buffer SurfaceVertices { uint surfaceWords[]; };
layout(set = 1, binding = kSurfaceTangentBinding, std430) readonly buffer SurfaceTangents { uint surfaceTangents[]; };

layout(set = 1, binding = kSurfaceValueBinding, std430) readonly buffer SurfaceValues { float surfaceValues[]; };

// Groups with levels: SuppleLevelOutput's buckets and patches.
layout(set = 1, binding = kLevelBucketBinding, std430) readonly buffer LevelBuckets { uvec4 levelBuckets[]; };
layout(set = 1, binding = kLevelPatchBinding, std430) readonly buffer LevelPatches { uvec4 levelPatches[]; };

// What a pipeline never draws should cost it nothing.
#ifndef LEVELS_POSSIBLE
#define LEVELS_POSSIBLE true
#endif
bool hasLevels() { return LEVELS_POSSIBLE && (push.flags & kDrawLevels) != 0u; }

SuppleDraw drawnLevels() {
    return SuppleDraw(push.firstPatch, push.verticesPerInstance, push.samplesPerPatch, 0u);
}

// Among the vertices of the draw.
uint levelVertex() {
    return suppleLodSurfaceVertex(drawnLevels(), gl_InstanceIndex, gl_VertexIndex) - levelBuckets[push.firstPatch].y;
}

// The patch's record begins here.
uint levelRecord() { return 4u * (levelBuckets[push.firstPatch].x + levelVertex() / push.samplesPerPatch); }

// The largest of the patch's levels: of its inside, then of its edges. Records have the reciprocals.
float largestLevel() {
    uint record = levelRecord();
    vec2 inside = uintBitsToFloat(levelPatches[record + 1u].yw);
    vec4 edges = uintBitsToFloat(uvec4(levelPatches[record + 2u].yw, levelPatches[record + 3u].yw));
    float least = min(min(inside.x, inside.y), min(edges.x, edges.y));
    // Quads have two numbers for the inside and four edges. Rings have one, and as many edges as the patch has sides.
    if (push.domain == kDrawQuad || push.patchCount >= 4u) least = min(least, edges.z);
    if (push.domain == kDrawQuad || push.patchCount >= 5u) least = min(least, edges.w);
    return 1.0 / max(least, 1e-6);
}

SuppleRange drawnRange() {
    return SuppleRange(push.patchCount, push.firstVertex, push.samplesPerPatch, push.verticesPerInstance, 0u, 0u);
}

uint drawnPatch() {
    return hasLevels() ? levelPatches[levelRecord()].x
                       : suppleDrawnPatch(drawnRange(), push.firstPatch, gl_InstanceIndex);
}

// Counted within an instance; with levels among all.
uint surfaceVertex() {
    return hasLevels() ? suppleLodSurfaceVertex(drawnLevels(), gl_InstanceIndex, gl_VertexIndex)
                       : suppleSharedVertex(drawnRange(), gl_InstanceIndex, gl_VertexIndex);
}

uint drawnSlot() {
    return hasLevels() ? levelPatches[levelRecord()].y & 0x0FFFFFFFu
                       : instanceSlots[suppleDrawnInstance(drawnRange(), gl_InstanceIndex)];
}

uint posedVertex() {
    if (hasLevels()) return surfaceVertex();
    return suppleSurfaceVertex(drawnRange(), drawnSlot(), surfaceVertex());
}

uint surfaceWord() { return posedVertex() * ((push.flags & kDrawVertex24) != 0u ? 6u : 4u); }

vec3 surfacePosition(uint word) {
    return uintBitsToFloat(uvec3(surfaceWords[word], surfaceWords[word + 1u], surfaceWords[word + 2u]));
}

vec3 surfaceNormal(uint word) {
    if ((push.flags & kDrawVertex24) != 0u)
        return uintBitsToFloat(uvec3(surfaceWords[word + 3u], surfaceWords[word + 4u], surfaceWords[word + 5u]));
    return suppleOctahedralNormal(surfaceWords[word + 3u]);
}

// The host's own, for one instance.
float surfaceValue() { return surfaceValues[surfaceVertex()]; }

vec4 surfaceTangent() { return suppleDecodeTangent(surfaceTangents[posedVertex()]); }
