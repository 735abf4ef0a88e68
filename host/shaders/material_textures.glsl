// What a material's textures say at a fragment; uvs: both sets of texture coordinates. What a material lacks is white. See
// material.glsl.
#include "pbr.glsl"
#include "normal_map.glsl"

layout(set = 2, binding = kFirstTextureBinding + kBaseColor) uniform sampler2D baseColorTexture;
layout(set = 2, binding = kFirstTextureBinding + kMetallicRoughness) uniform sampler2D metallicRoughnessTexture;
layout(set = 2, binding = kFirstTextureBinding + kNormal) uniform sampler2D normalTexture;
layout(set = 2, binding = kFirstTextureBinding + kOcclusion) uniform sampler2D occlusionTexture;
layout(set = 2, binding = kFirstTextureBinding + kEmissive) uniform sampler2D emissiveTexture;

// The material has a normal, an occlusion or an emissive map.
layout(constant_id = 1) const bool kMaps = false;

vec4 baseColorAt(vec4 uvs, vec4 vertexColor) {
    return materialData.baseColor * vertexColor * texture(baseColorTexture, placed(kBaseColor, uvs));
}

/// A translucent material is drawn twice. Where it is solid, it hides what is behind it, as anything else does.
bool isLeftOut(float alpha) { return (push.flags & kDrawSolid) != 0u && alpha < kSolidAlpha; }
bool isOtherSide(bool back) { return (push.flags & (back ? kDrawFrontSide : kDrawBackSide)) != 0u; }

Material materialAt(vec3 albedo, vec4 uvs) {
    vec2 metallicRoughness = texture(metallicRoughnessTexture, placed(kMetallicRoughness, uvs)).bg;
    Material material = plainMaterial(albedo, materialData.roughness * metallicRoughness.y);
    material.metallic = materialData.metallic * metallicRoughness.x;
    material.emission = materialData.emissive.rgb;
    if (kMaps) {
        material.emission *= texture(emissiveTexture, placed(kEmissive, uvs)).rgb;
        float occlusion = texture(occlusionTexture, placed(kOcclusion, uvs)).r;
        material.occlusion = 1.0 + materialData.occlusionStrength * (occlusion - 1.0);
    }
    return material;
}

/// In tangent space.
vec3 normalTexelAt(vec2 uv) {
    return (2.0 * texture(normalTexture, uv).xyz - 1.0) * vec3(vec2(materialData.normalScale), 1.0);
}
