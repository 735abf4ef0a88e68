// The vertex of the deformed cage that an instance draws.
#include "cage_buffers.glsl"
#include "instances.glsl"

vec4 cageVertex(uint vertex) {
    return deformedCage[instanceSlots[gl_InstanceIndex] * push.cageVerticesPerInstance + vertex];
}

vec3 cagePosition(uint vertex) { return cageVertex(vertex).xyz; }
