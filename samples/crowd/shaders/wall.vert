#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

layout(push_constant) uniform Push { vec4 wall; }; // half its width, its height, half its thickness, its angle

layout(location = 0) out vec3 outPosition;

// A box, two triangles a side.
void main() {
    uint face = gl_VertexIndex / 6u, axis = face >> 1u;
    const uvec2 kCorners[6] = uvec2[6](uvec2(0u, 0u), uvec2(1u, 0u), uvec2(1u, 1u), uvec2(0u, 0u), uvec2(1u, 1u), uvec2(0u, 1u));
    uvec2 at = kCorners[gl_VertexIndex % 6u];
    vec3 corner;
    corner[axis] = float(face & 1u);
    corner[(axis + 1u) % 3u] = float(at.x);
    corner[(axis + 2u) % 3u] = float(at.y);
    vec3 place = vec3((2.0 * corner.x - 1.0) * wall.x, corner.y * wall.y, (2.0 * corner.z - 1.0) * wall.z);
    float c = cos(wall.w), s = sin(wall.w);
    outPosition = vec3(c * place.x + s * place.z, place.y, c * place.z - s * place.x);
    gl_Position = scene.viewProjection * vec4(outPosition, 1.0);
}
