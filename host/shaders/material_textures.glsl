// What a material's textures say at a fragment. See material.glsl.
layout(set = 2, binding = kBaseColorBinding) uniform sampler2D baseColorTexture;
layout(set = 2, binding = kMetallicRoughnessBinding) uniform sampler2D metallicRoughnessTexture;

vec4 baseColorAt(vec2 uv, vec4 vertexColor) { return materialData.baseColor * vertexColor * texture(baseColorTexture, uv); }

/// x: metallic, y: roughness.
vec2 metallicRoughnessAt(vec2 uv) {
    vec2 factors = vec2(materialData.metallic, materialData.roughness);
    return materialHas(kMaterialMetallicRoughness) ? factors * texture(metallicRoughnessTexture, uv).bg : factors;
}
