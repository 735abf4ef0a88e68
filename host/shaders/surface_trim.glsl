// The trim's value at a fragment; `trim` is surfaceTrim(), interpolated. See material.glsl.
#include "trim.glsl"

layout(set = 2, binding = kFirstTextureBinding + kTrim) uniform sampler2D trimTexture;

float trimValue(vec3 trim) {
    bool face = materialHas(kMaterialTrimFace);
    vec2 at = face ? suppleTrimTile(trim.xy, materialData.trimTiles, textureSize(trimTexture, 0)) : trim.xy;
    float value = trim.z * texture(trimTexture, at)[materialData.trimChannel];
    return face && !suppleTrimHasTile(trim.xy) ? 1.0 : value;
}
