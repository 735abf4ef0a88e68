#version 460
#extension GL_GOOGLE_include_directive : require
#include "attachment.glsl"

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec3 outTangent;
layout(location = 3) out vec3 outBitangent;
layout(location = 4) out vec3 outPlace; // u, v, opacity

void main() {
    mat4x3 place = frameOf(gl_VertexIndex);
    outTangent = place[0];
    outBitangent = place[1];
    outNormal = place[2];
    outPosition = place[3];
    vec4 own = vertices[gl_VertexIndex].a;
    outPlace = own.xyz;
    // The drawn surface consists of triangles, and so does this. What is moved along the ray to the eye stays where it is in the
    // picture, and comes before them. Levels of detail lie within a pixel of the surface.
    vec3 toEye = frame.eye.xyz - outPosition;
    float away = length(toEye), facing = max(dot(outNormal, toEye) / max(away, 1e-20), 0.15);
    mat4 m = frame.viewProjection;
    float pixel = 2.0 * away * frame.viewport.w / length(vec3(m[0][1], m[1][1], m[2][1]));
    vec3 lifted = outPosition + toEye * min((push.lift + own.w + pixel) / (facing * max(away, 1e-20)), 0.5);
    gl_Position = m * vec4(lifted, 1.0);
}
