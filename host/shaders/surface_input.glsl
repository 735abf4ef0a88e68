// The surface vertex of a draw, found by the public include as docs/integration.md says. One pipeline reads both vertex formats,
// so the buffers are declared here.
#include "supple_surface.glsl"
#include "instances.glsl"

layout(set = 1, binding = kSurfaceVertexBinding, std430) readonly buffer SurfaceVertices { uint surfaceWords[]; };
layout(set = 1, binding = kSurfaceTangentBinding, std430) readonly buffer SurfaceTangents { uint surfaceTangents[]; };

layout(set = 1, binding = kSurfaceValueBinding, std430) readonly buffer SurfaceValues { float surfaceValues[]; };

SuppleRange drawnRange() {
    return SuppleRange(push.patchCount, push.firstVertex, push.samplesPerPatch, push.verticesPerInstance, 0u, 0u);
}

uint drawnPatch() { return suppleDrawnPatch(drawnRange(), push.firstPatch, gl_InstanceIndex); }

// Counted within an instance.
uint surfaceVertex() { return suppleSharedVertex(drawnRange(), gl_InstanceIndex, gl_VertexIndex); }

uint posedVertex() {
    uint slot = instanceSlots[suppleDrawnInstance(drawnRange(), gl_InstanceIndex)];
    return suppleSurfaceVertex(drawnRange(), slot, surfaceVertex());
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
