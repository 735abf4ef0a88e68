// The trim's value at a fragment; `trim` is surfaceTrim(), interpolated.
#include "trim.glsl"

layout(set = 2, binding = kTrimBinding) uniform sampler2D trimTexture;

float trimValue(vec3 trim) {
    bool face = (push.flags & kDrawTrimFace) != 0u;
    vec2 at = face ? suppleTrimTile(trim.xy, push.trimTiles, textureSize(trimTexture, 0)) : trim.xy;
    float value = trim.z * texture(trimTexture, at)[push.trimChannel];
    return face && !suppleTrimHasTile(trim.xy) ? 1.0 : value;
}
