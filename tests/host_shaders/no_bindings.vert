// shaders/supple_surface.glsl in a shader that has its own way to buffers: no bindings are declared.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "supple_surface.glsl"

layout(push_constant) uniform Push { SuppleRange range; uint slot; uint firstPatch; };
layout(set = 0, binding = 0, std430) readonly buffer Vertices { uvec4 vertices[]; };
layout(location = 0) flat out uvec2 outIds;

void main() {
    uint own = suppleSharedVertex(range, gl_InstanceIndex, gl_VertexIndex);
    uvec4 words = vertices[suppleSurfaceVertex(range, slot, own)];
    outIds = uvec2(suppleDrawnInstance(range, gl_InstanceIndex), suppleDrawnPatch(range, firstPatch, gl_InstanceIndex));
    gl_Position = vec4(uintBitsToFloat(words.xyz) + suppleOctahedralNormal(words.w), 1.0);
}
