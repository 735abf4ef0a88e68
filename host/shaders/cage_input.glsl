// The deformed cage: one float4 per cage vertex, slot after slot.
#include "instances.glsl"

layout(set = 1, binding = kDeformedCageBinding, std430) readonly buffer DeformedCage { vec4 deformedCage[]; };

vec4 cageVertex(uint vertex) {
    return deformedCage[instanceSlots[gl_InstanceIndex] * push.cageVerticesPerInstance + vertex];
}

vec3 cagePosition(uint vertex) { return cageVertex(vertex).xyz; }
