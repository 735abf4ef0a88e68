// Deform pass: linear blend skinning of the control cage. One invocation a cage vertex and instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/deform.h"
#include "shaders/shared/mapping.glsl"

layout(set = 0, binding = kDeformTableBinding, std430) readonly buffer Table { uvec4 tableElements[]; };
layout(set = 0, binding = kDeformTableTexelBinding) uniform usamplerBuffer tableTexels;
layout(set = 0, binding = kPaletteBinding, std430) readonly buffer Palette { vec4 paletteRows[]; };
layout(set = 0, binding = kPaletteTexelBinding) uniform samplerBuffer paletteTexels;
layout(set = 0, binding = kDeformedCageBinding, std430) writeonly buffer DeformedCage { vec4 deformedCage[]; };

layout(push_constant) uniform Push { DeformPush push; };

uvec4 table(uint i) {
    if (kWide) return tableElements[i];
    return texelFetch(tableTexels, int(i));
}
vec4 paletteRow(uint i) {
    if (kWide) return paletteRows[i];
    return texelFetch(paletteTexels, int(i));
}

// weight * (matrix * (p, 1)). `precise`: both mappings must give the same cage, bit for bit.
vec3 transformed(uint joint, float weight, vec3 p) {
    vec4 a = paletteRow(3u * joint), b = paletteRow(3u * joint + 1u), c = paletteRow(3u * joint + 2u);
    precise vec3 q = vec3((a.x * p.x + a.y * p.y) + (a.z * p.z + a.w), (b.x * p.x + b.y * p.y) + (b.z * p.z + b.w),
                          (c.x * p.x + c.y * p.y) + (c.z * p.z + c.w));
    precise vec3 r = weight * q;
    return r;
}

void main() {
    // Clamped, not returned early: a divergent return makes every later load slow on CPU devices.
    uint id = min(invocationIndex(), push.vertexCount * push.instanceCount - 1u);
    uint instance = id / push.vertexCount;
    uint index = id - instance * push.vertexCount;
    uvec4 vertex = table(index);
    vec3 rest = uintBitsToFloat(vertex.xyz);
    uint joints = instance * push.jointCount;

    uint end = table(index + 1u).w;
    precise vec3 p = vec3(0.0);
    // Tested at the top: in a do-while, Mesa 22.3's lavapipe goes on adding for lanes that have finished.
    for (uint element = vertex.w; element < end; ++element) {
        uvec4 pair = table(element);
        precise vec3 first = transformed(joints + pair.x, uintBitsToFloat(pair.y), rest);
        precise vec3 second = transformed(joints + pair.z, uintBitsToFloat(pair.w), rest);
        p = p + (first + second);
    }
    deformedCage[instance * push.cageStride + index] = vec4(p, 1.0);
}
