// What a surface vertex has that no pose changes. See surface_input.glsl and material.glsl.
layout(set = 1, binding = kSurfaceAttributeBinding, std430) readonly buffer Attributes { uvec4 attributes[]; };
layout(set = 1, binding = kSurfaceUv1Binding, std430) readonly buffer Uvs1 { vec2 uvs1[]; };
layout(set = 1, binding = kSurfaceFaceUvBinding, std430) readonly buffer FaceUvs { vec2 faceUvs[]; };

/// Both texture coordinates. The second ones are looked up only if a texture asks for them: there may be none.
vec4 surfaceUvs() {
    vec2 uv = uintBitsToFloat(attributes[surfaceVertex()].xy);
    return vec4(uv, materialHas(kMaterialUvs1) ? uvs1[surfaceVertex()] : uv);
}

vec4 surfaceColor() {
    return suppleUnpackColor(attributes[surfaceVertex()].zw);
}

/// Where the trim is looked up (UV or face UV), and what multiplies it.
vec3 surfaceTrim() {
    if (!materialHas(kMaterialTrim | kMaterialTranslucent)) return vec3(0.0);
    vec2 at = materialHas(kMaterialTrimFace) ? faceUvs[surfaceVertex()] : placed(kTrim, surfaceUvs());
    return vec3(at, materialHas(kMaterialTrimAlpha) ? materialData.baseColor.a * surfaceColor().a : 1.0);
}
