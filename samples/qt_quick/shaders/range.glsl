// What a draw knows: DrawPush of pipelines.h.
#define SUPPLE_SURFACE_SET 1
#include "supple_surface.glsl"

layout(push_constant) uniform Push {
    SuppleRange range;
    float metallic;
    float roughness;
    vec4 baseColorFactor;
    vec4 uvRows[2]; // SuppleTextureInfo's transform
};
