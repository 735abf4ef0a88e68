// shaders/supple_patch.glsl in a shader that has its own way to buffers, for patches of one class.
#version 460
#extension GL_GOOGLE_include_directive : require
layout(set = 0, binding = 0, std430) readonly buffer Tables { uvec4 tables[]; };
layout(set = 0, binding = 1, std430) readonly buffer Coefficients { vec4 coefficients[]; };
uvec4 suppleTableElement(uint i) { return tables[i]; }
vec3 suppleCoefficient(uint i) { return coefficients[i].xyz; }
#define SUPPLE_PATCH_CLASS 4u
#include "supple_patch.glsl"

layout(push_constant) uniform Push { SupplePatchRange range; uint slot; };
layout(location = 0) out vec3 outNormal;

void main() {
    SuppleSample s = suppleEvaluate(range, suppleDrawnPatch(suppleRangeOf(range), 0u, gl_InstanceIndex), slot, gl_VertexIndex);
    outNormal = s.normal;
    gl_Position = vec4(s.position, 1.0);
}
