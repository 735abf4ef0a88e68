#version 460
#extension GL_GOOGLE_include_directive : require
#include "attachment.glsl"

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec4 outColor;  // w: how much of it shines by itself
layout(location = 3) out vec2 outFinish; // roughness, metallic

void main() {
    AttachmentVertex v = vertices[gl_VertexIndex];
    mat4x3 place = frameOf(0u);
    outPosition = place * vec4(push.scale * v.a.xyz, 1.0);
    outNormal = mat3(place) * v.b.xyz;
    outColor = vec4(v.c.rgb, v.b.w);
    outFinish = vec2(v.a.w, v.c.w);
    gl_Position = push.light == kNoLight ? frame.viewProjection * vec4(outPosition, 1.0)
                                         : frame.lights[push.light].shadow * vec4(outPosition, 1.0);
}
