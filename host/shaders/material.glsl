// The material of a draw, and its textures but for the trim: see surface_trim.glsl.
layout(set = 2, binding = kMaterialBinding, std140) uniform MaterialBlock { MaterialUniforms materialData; };

bool materialHas(uint flag) { return (materialData.flags & flag) != 0u; }

vec2 placed(TexturePlace place, vec2 uv) { return vec2(dot(place.u.xyz, vec3(uv, 1.0)), dot(place.v.xyz, vec3(uv, 1.0))); }
