// The material of a draw, and its textures but for the trim: see surface_trim.glsl.
layout(set = 2, binding = kMaterialBinding, std140) uniform MaterialBlock { MaterialUniforms materialData; };

layout(constant_id = 3) const uint kMaterialHas = 0u;

bool materialHas(uint flag) { return (kMaterialHas & flag) != 0u; }

/// Where a texture is looked up; uvs: both sets of texture coordinates.
vec2 placed(uint which, vec4 uvs) {
    TexturePlace place = materialData.places[which];
    vec3 uv = vec3(place.u.w != 0.0 ? uvs.zw : uvs.xy, 1.0);
    return vec2(dot(place.u.xyz, uv), dot(place.v.xyz, uv));
}

bool hasTexture(uint which) { return materialHas(kMaterialTexture << which); }
