#version 460
#extension GL_GOOGLE_include_directive : require
#define SUPPLE_SURFACE_SET 1
#include "supple_surface.glsl"
#include "frame.glsl"

layout(push_constant) uniform Push {
    SuppleRange range;
    float metallic;
    float roughness;
    vec4 baseColor;
};

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec3 outColor;
layout(location = 3) out vec4 outNow;
layout(location = 4) out vec4 outBefore;

void main() {
    SuppleVertex at = suppleVertex(range, gl_InstanceIndex, gl_VertexIndex);
    outPosition = supplePosition(at);
    outNormal = suppleNormal(at);
    outColor = suppleColor(at).rgb * baseColor.rgb;
    outNow = frame.viewProjection * vec4(outPosition, 1.0);
    outBefore = frame.previousViewProjection * vec4(supplePreviousPosition(at), 1.0);
    gl_Position = frame.jitteredViewProjection * vec4(outPosition, 1.0);
}
