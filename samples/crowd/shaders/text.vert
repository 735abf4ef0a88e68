#version 460
layout(push_constant) uniform Push { vec2 scale; };
layout(set = 0, binding = 0, std430) readonly buffer Corners { vec4 corners[]; }; // x, y, -, color

layout(location = 0) out vec4 outColor;

// Quads, two triangles each.
void main() {
    const uint kOrder[6] = uint[6](0u, 1u, 2u, 0u, 2u, 3u);
    vec4 corner = corners[4u * (gl_VertexIndex / 6u) + kOrder[gl_VertexIndex % 6u]];
    outColor = unpackUnorm4x8(floatBitsToUint(corner.w));
    gl_Position = vec4(corner.xy * scale - 1.0, 0.0, 1.0);
}
