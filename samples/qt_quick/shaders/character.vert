#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "range.glsl"

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec4 outColor;
layout(location = 3) out vec2 outUv;

void main() {
    SuppleVertex at = suppleVertex(range, gl_InstanceIndex, gl_VertexIndex);
    outPosition = supplePosition(at);
    outNormal = suppleNormal(at);
    outColor = suppleColor(at) * baseColorFactor;
    vec3 uv = vec3(suppleUv(at), 1.0);
    outUv = vec2(dot(uvRows[0].xyz, uv), dot(uvRows[1].xyz, uv));
    gl_Position = frame.viewProjection * vec4(outPosition, 1.0);
}
