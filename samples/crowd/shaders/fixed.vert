// Characters of one rate: their stored vertices or, with DIRECT, vertices that are made here of their patches.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SUPPLE_SURFACE_SET 1
#define SUPPLE_USER_DATA_BINDING 8
#ifdef DIRECT
#define SUPPLE_PATCH_SET 1
#include "supple_patch.glsl"
#else
#include "supple_surface.glsl"
#endif
#include "scene.glsl"
#include "tint.glsl"

layout(push_constant) uniform Push {
#ifdef DIRECT
    SupplePatchRange range;
#else
    SuppleRange range;
    uint unused[6];
#endif
    uint sun; // 1: into the sun's map
};

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec3 outColor;

void main() {
#ifdef DIRECT
    SuppleRange drawn = suppleRangeOf(range);
    SuppleVertex at = suppleVertex(drawn, gl_InstanceIndex, gl_VertexIndex);
    SuppleSample s = suppleEvaluate(range, suppleDrawnPatch(drawn, 0u, gl_InstanceIndex), at.slot, gl_VertexIndex);
    outPosition = s.position;
    outNormal = s.normal;
#else
    SuppleVertex at = suppleVertex(range, gl_InstanceIndex, gl_VertexIndex);
    outPosition = supplePosition(at);
    outNormal = suppleNormal(at);
#endif
    outColor = vec3(0.0);
    if (sun != 0u) {
        gl_Position = scene.sunViewProjection * vec4(outPosition, 1.0);
        return;
    }
    outColor = tinted(suppleColor(at).rgb, suppleUserData(at).xy);
    gl_Position = scene.viewProjection * vec4(outPosition, 1.0);
}
