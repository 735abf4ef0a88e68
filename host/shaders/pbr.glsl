// Shading as glTF 2.0 describes it, without bindings: a base color, metallic and roughness under lights and a blurred
// environment.
#ifndef SUPPLE_HOST_PBR_GLSL
#define SUPPLE_HOST_PBR_GLSL

/// What is seen of a material at one place. All colors are linear.
struct Material {
    vec3 albedo;
    float metallic;
    float roughness; // perceptual: its square is the alpha of GGX
    float occlusion; // of light from all round: 1 is open
    vec3 emission;
};

Material plainMaterial(vec3 albedo, float roughness) { return Material(albedo, 0.0, roughness, 1.0, vec3(0.0)); }

/// What a surface mirrors if it is looked at straight.
vec3 mirrorColor(Material material) { return mix(vec3(0.04), material.albedo, material.metallic); }

/// Over all directions: the share of light that a surface mirrors (x for each unit of mirrorColor, y besides). Karis'
/// fit of GGX with Smith's shadowing ("Physically Based Shading on Mobile", 2014).
vec2 environmentShare(float roughness, float nv) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float grazing = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
    return vec2(-1.04, 1.04) * grazing + r.zw;
}

/// The same as one color, with what leaves after more than one reflection: rough metals would be too dark without it.
/// grazing: what is mirrored along the surface.
vec3 mirroredShareOf(vec3 f0, float grazing, float roughness, float nv) {
    vec2 share = environmentShare(roughness, nv);
    return (f0 * share.x + share.y * grazing) * (1.0 + f0 * (1.0 / (share.x + share.y) - 1.0));
}
vec3 mirroredShare(vec3 f0, float roughness, float nv) { return mirroredShareOf(f0, 1.0, roughness, nv); }

/// GGX under one small light, with the height-correlated Smith term and Schlick's Fresnel; times n.l. The light's color is
/// the radiance of a white surface that faces it, so pi is left out of both terms.
vec3 mirroredLight(vec3 n, vec3 v, vec3 l, float roughness, vec3 f0) {
    vec3 h = normalize(v + l);
    float nh = clamp(dot(n, h), 0.0, 1.0), nl = clamp(dot(n, l), 0.0, 1.0);
    float nv = clamp(abs(dot(n, v)), 1e-3, 1.0), vh = clamp(dot(v, h), 0.0, 1.0);
    float a2 = roughness * roughness * roughness * roughness;
    float d = nh * nh * (a2 - 1.0) + 1.0;
    float visibility = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
    return (f0 + (1.0 - f0) * pow(1.0 - vh, 5.0)) * (a2 / (d * d) * visibility * nl);
}

/// Khronos' PBR Neutral: colors up to 0.76 keep their hue and their brightness, all above is led to white.
vec3 neutralTone(vec3 color) {
    const float kFirst = 0.8 - 0.04;
    float least = min(color.r, min(color.g, color.b));
    color -= least < 0.08 ? least - 6.25 * least * least : 0.04;
    float peak = max(color.r, max(color.g, color.b));
    if (peak < kFirst)
        return color;
    const float kRest = 1.0 - kFirst;
    float shown = 1.0 - kRest * kRest / (peak + kRest - kFirst);
    return mix(color * (shown / peak), vec3(shown), 1.0 - 1.0 / (0.15 * (peak - shown) + 1.0));
}

#endif
