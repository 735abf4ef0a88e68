// What glTF's extensions lay over a material, and what goes through it: clearcoat, sheen, transmission as of thin glass, light
// that is scattered through, what a dielectric mirrors, and highlights that are stretched. See material.glsl and studio.glsl.

layout(set = 2, binding = kLayerTextureBinding) uniform sampler2D layerTextures[kLayerTextureCount];

// Where each of a layer's textures is in the array: constants, so that no device has to index it by what it computes.
layout(constant_id = 5) const uint kLayerSlots0 = kNoLayerSlots;
layout(constant_id = 6) const uint kLayerSlots1 = kNoLayerSlots;
const uint kClearcoatSlot = SUPPLE_LAYER_SLOT(kLayerSlots0, kClearcoat);
const uint kClearcoatRoughnessSlot = SUPPLE_LAYER_SLOT(kLayerSlots0, kClearcoatRoughness);
const uint kClearcoatNormalSlot = SUPPLE_LAYER_SLOT(kLayerSlots0, kClearcoatNormal);
const uint kSheenColorSlot = SUPPLE_LAYER_SLOT(kLayerSlots0, kSheenColor);
const uint kSheenRoughnessSlot = SUPPLE_LAYER_SLOT(kLayerSlots0, kSheenRoughness);
const uint kTransmissionSlot = SUPPLE_LAYER_SLOT(kLayerSlots0, kTransmission);
const uint kAnisotropySlot = SUPPLE_LAYER_SLOT(kLayerSlots0, kAnisotropy);
const uint kDiffuseTransmissionColorSlot = SUPPLE_LAYER_SLOT(kLayerSlots0, kDiffuseTransmissionColor);
const uint kSpecularSlot = SUPPLE_LAYER_SLOT(kLayerSlots1, kSpecular);
const uint kSpecularColorSlot = SUPPLE_LAYER_SLOT(kLayerSlots1, kSpecularColor);
const uint kIridescenceSlot = SUPPLE_LAYER_SLOT(kLayerSlots1, kIridescence);
const uint kIridescenceThicknessSlot = SUPPLE_LAYER_SLOT(kLayerSlots1, kIridescenceThickness);
const uint kDiffuseTransmissionSlot = SUPPLE_LAYER_SLOT(kLayerSlots1, kDiffuseTransmission);
const uint kThicknessSlot = SUPPLE_LAYER_SLOT(kLayerSlots1, kThickness);

/// A texel, or white where the material has no such texture. It may stand in a branch: which one is taken is a constant.
#define LAYER_TEXEL(name, uvs)                                                                                         \
    (name##Slot == kNoLayerSlot ? vec4(1.0) : texture(layerTextures[name##Slot & (kNoLayerSlot - 1u)], placed(name, uvs)))

// Glass is drawn twice: what is behind it is multiplied by a color, then what it sends itself is added.
layout(constant_id = 4) const bool kThrough = false;

/// What layers a material has at one place.
struct Layers {
    float coat; // its share
    float coatRoughness;
    vec3 sheen;
    float sheenRoughness;
    float transmission;
    vec3 dielectric; // what it mirrors if it is looked at straight
    float grazing;   // and along the surface
    float film;      // how much a thin film colors that
    float filmThickness; // in nanometres
    float scattersThrough; // the share of scattered light that comes through
    float thickness; // of what lies behind the surface
    vec3 stretch;    // which way highlights are stretched, of a tangent, a bitangent; z: how much
    vec3 inside;     // the color of light that has gone through
};

/// A place of a surface, and who looks at it.
struct Place {
    vec3 position;
    vec3 n;       // that is shaded
    vec3 coat;    // of the clearcoat
    vec3 surface; // of the surface itself; all three face the viewer's side
    vec3 v;
    vec3 stretch; // which way highlights are stretched
    vec3 noise;   // of the pixel
};

bool isLayered() {
    return materialHas(kMaterialClearcoat | kMaterialSheen | kMaterialTransmission | kMaterialSpecular |
                       kMaterialAnisotropy | kMaterialDiffuseTransmission | kMaterialIridescence);
}

/// The share of light that goes through, before anything is mirrored.
float transmissionAt(vec4 uvs) {
    if (!materialHas(kMaterialTransmission))
        return 0.0;
    return materialData.transmission * LAYER_TEXEL(kTransmission, uvs).r;
}

Layers layersAt(vec4 uvs) {
    Layers layers = Layers(0.0, 0.0, vec3(0.0), 0.0, transmissionAt(uvs), vec3(0.04), 1.0, 0.0, 0.0, 0.0, 0.0, vec3(0.0), vec3(0.0));
    if (materialHas(kMaterialClearcoat)) {
        layers.coat = materialData.clearcoat * LAYER_TEXEL(kClearcoat, uvs).r;
        layers.coatRoughness = materialData.clearcoatRoughness * LAYER_TEXEL(kClearcoatRoughness, uvs).g;
    }
    if (materialHas(kMaterialSheen)) {
        layers.sheen = materialData.sheen.rgb * LAYER_TEXEL(kSheenColor, uvs).rgb;
        layers.sheenRoughness = materialData.sheen.a * LAYER_TEXEL(kSheenRoughness, uvs).a;
    }
    if (materialHas(kMaterialSpecular)) {
        layers.grazing = materialData.dielectric.a * LAYER_TEXEL(kSpecular, uvs).a;
        layers.dielectric = min(materialData.dielectric.rgb * LAYER_TEXEL(kSpecularColor, uvs).rgb, 1.0) * layers.grazing;
    }
    if (materialHas(kMaterialIridescence)) {
        layers.filmThickness =
            mix(materialData.iridescence.z, materialData.iridescence.w, LAYER_TEXEL(kIridescenceThickness, uvs).g);
        layers.film = layers.filmThickness > 0.0 ? materialData.iridescence.x * LAYER_TEXEL(kIridescence, uvs).r : 0.0;
    }
    if (materialHas(kMaterialAnisotropy)) {
        vec3 texel = vec3(1.0, 0.0, 1.0);
        if (kAnisotropySlot != kNoLayerSlot) {
            texel = LAYER_TEXEL(kAnisotropy, uvs).rgb;
            texel.xy = 2.0 * texel.xy - 1.0;
        }
        float c = materialData.anisotropy.y, s = materialData.anisotropy.z;
        layers.stretch = vec3(c * texel.x - s * texel.y, s * texel.x + c * texel.y, materialData.anisotropy.x * texel.z);
    }
    if (materialHas(kMaterialDiffuseTransmission)) {
        layers.inside = materialData.diffuseTransmission.rgb * LAYER_TEXEL(kDiffuseTransmissionColor, uvs).rgb;
        layers.scattersThrough = materialData.diffuseTransmission.a * LAYER_TEXEL(kDiffuseTransmission, uvs).a;
    }
    layers.thickness = materialData.extinction.w * LAYER_TEXEL(kThickness, uvs).g;
    return layers;
}

/// n: the unit normal of the front. tangent: a vector of any length; up: how the bitangent lies beside it.
vec3 stretchedAlong(Layers layers, vec3 n, vec3 tangent, float up) {
    vec3 t = tangent - n * dot(n, tangent);
    t *= inversesqrt(max(dot(t, t), 1e-30));
    vec3 along = layers.stretch.x * t + layers.stretch.y * up * cross(n, t);
    return along * inversesqrt(max(dot(along, along), 1e-30));
}

/// The coat's own normal map, in tangent space.
vec3 clearcoatTexelAt(vec2 uv) {
    vec3 texel = texture(layerTextures[kClearcoatNormalSlot & (kNoLayerSlot - 1u)], uv).xyz;
    return (2.0 * texel - 1.0) * vec3(vec2(materialData.clearcoatNormalScale), 1.0);
}

/// Over all directions: what fibers send back. A fit of the "Charlie" distribution (Estevez and Kulla, 2017), as three.js has it.
float sheenShare(float roughness, float nv) {
    float r = max(roughness, 0.07);
    bool smoothly = r < 0.25;
    float a = smoothly ? -339.2 * r * r + 161.4 * r - 25.9 : -8.48 * r * r + 14.3 * r - 9.95;
    float b = smoothly ? 44.0 * r * r - 23.7 * r + 3.26 : 1.97 * r * r - 3.27 * r + 0.72;
    return clamp(exp(a * nv + b) + (smoothly ? 0.0 : 0.1 * (r - 0.25)), 0.0, 1.0);
}

/// The same under one soft box, times n.l; with Neubelt's and Pettineo's visibility. Pi is left out, as in mirroredLight().
float sheenLight(vec3 n, vec3 v, vec3 l, float roughness) {
    float nl = softLambert(dot(n, l)), nv = clamp(abs(dot(n, v)), 1e-3, 1.0);
    float nh = clamp(dot(n, normalize(v + l)), 0.0, 1.0);
    float sharpness = 1.0 / max(roughness * roughness, 0.005);
    float d = (2.0 + sharpness) * pow(1.0 - nh * nh, 0.5 * sharpness) * 0.5;
    return d / (4.0 * (nl + nv - nl * nv)) * nl;
}

/// What a material with layers shows. No part is exposed yet.
struct Layered {
    vec3 lit;     // radiance towards the eye
    vec3 through; // what comes through of each unit of light behind it
    float glow;   // the share of its emission that leaves
};

/// Fresnel's reflectance by Schlick.
vec3 schlick(vec3 f0, float cosine) { return f0 + (1.0 - f0) * pow(clamp(1.0 - cosine, 0.0, 1.0), 5.0); }

/// What an eye sees of a wave that comes back with this delay (nanometres) and these shifts (radians), in linear RGB. Gaussians
/// fitted to CIE's curves, in the space of frequencies: Belcour and Barla, "A Practical Extension to Microfacet Theory for the
/// Modeling of Varying Iridescence" (2017), with numbers from their code.
vec3 seenOfDelay(float delay, vec3 shift) {
    float phase = 2.0 * kPi * 1e-9 * delay;
    vec3 height = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13), middle = vec3(1.6810e6, 1.7953e6, 2.2084e6);
    vec3 variance = vec3(4.3278e9, 9.3046e9, 6.6121e9);
    vec3 xyz = height * sqrt(2.0 * kPi * variance) * cos(middle * phase + shift) * exp(-phase * phase * variance);
    xyz.x += 9.7470e-14 * sqrt(2.0 * kPi * 4.5282e9) * cos(2.2399e6 * phase + shift.x) * exp(-4.5282e9 * phase * phase);
    return mat3(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314, 0.0415560, 1.0572252) *
           (xyz / 1.0685e-7);
}

/// What a film of this index and thickness (nanometres) mirrors over what mirrors `base`, as an f0: Belcour and Barla, section
/// 4.2, with two bounces inside the film, as KHR_materials_iridescence has it.
vec3 filmMirrors(float index, float thickness, vec3 base, float nv) {
    index = mix(1.0, index, smoothstep(0.0, 0.03, thickness)); // a film of no thickness mirrors nothing
    float inside = sqrt(max(1.0 - (1.0 - nv * nv) / (index * index), 0.0)); // Snell: the cosine there
    float side = (index - 1.0) / (index + 1.0);
    float first = schlick(vec3(side * side), nv).x;
    vec3 root = sqrt(min(base, 0.9999));
    vec3 below = (1.0 + root) / (1.0 - root);
    vec3 rise = (below - index) / (below + index);
    vec3 second = schlick(rise * rise, inside);
    // A wave is turned where the index rises: of the film's back, and inside, of its front.
    vec3 shift = kPi + mix(vec3(0.0), vec3(kPi), lessThan(below, vec3(index)));
    float delay = 2.0 * index * thickness * inside, passes = (1.0 - first) * (1.0 - first);
    vec3 both = clamp(first * second, 1e-5, 0.9999), all = passes * second / (1.0 - both);
    vec3 mirrored = first + all, bounce = (all - (1.0 - first)) * sqrt(both);
    mirrored += bounce * 2.0 * seenOfDelay(delay, shift);
    mirrored += bounce * sqrt(both) * 2.0 * seenOfDelay(2.0 * delay, 2.0 * shift);
    float rim = min(pow(clamp(1.0 - nv, 0.0, 1.0), 5.0), 0.9999); // Schlick, the other way round
    return clamp((max(mirrored, 0.0) - rim) / (1.0 - rim), 0.0, 1.0);
}

/// What it mirrors below its layers.
vec3 layeredMirror(Material material, Layers layers, Incident light, Place at) {
    if (!materialHas(kMaterialAnisotropy))
        return studioMirrored(material.roughness, material.occlusion, light, at.n, at.surface, at.v);
    return studioMirroredAlong(vec4(at.stretch, layers.stretch.z), material.roughness, material.occlusion, light, at.n, at.surface,
                               at.v, at.noise);
}

Layered layeredShade(Material material, Layers layers, Incident light, Place at) {
    vec3 n = at.n, surface = at.surface, v = at.v;
    float nv = clamp(dot(n, v), 1e-3, 1.0);
    vec3 f0 = mix(layers.dielectric, material.albedo, material.metallic);
    if (materialHas(kMaterialIridescence))
        f0 = mix(f0, filmMirrors(materialData.iridescence.y, layers.filmThickness, f0, nv), layers.film);
    vec3 share = mirroredShareOf(f0, mix(layers.grazing, 1.0, material.metallic), material.roughness, nv);
    vec3 enters = (1.0 - material.metallic) * (1.0 - share);
    vec3 body = material.albedo * enters;
    vec3 scattered = body * studioScattered(material.occlusion, light, n, surface);
    if (materialHas(kMaterialDiffuseTransmission)) {
        vec3 inside = studioInside(light, materialData.extinction, at.position, surface, at.noise);
        scattered = mix(scattered, enters * layers.inside * inside, layers.scattersThrough);
    }
    Layered shown;
    shown.lit = (1.0 - layers.transmission) * scattered + share * layeredMirror(material, layers, light, at);
    shown.through = body * layers.transmission;
    if (materialHas(kMaterialTransmission))
        shown.through *= exp(-materialData.extinction.rgb * layers.thickness);
    shown.glow = 1.0;
    if (materialHas(kMaterialTransmission)) {
        // Rough glass sends on what comes from all round behind it, as ground glass does.
        float ground = smoothstep(0.05, 0.65, material.roughness);
        shown.lit += shown.through * ground * studioBehind(light, surface, v);
        shown.through *= 1.0 - ground;
    }
    float passes = 1.0;
    if (materialHas(kMaterialSheen)) {
        float fibers = sheenShare(layers.sheenRoughness, nv);
        vec3 fuzz = frame.keyColor.rgb * light.key * sheenLight(n, v, frame.keyDirection.xyz, layers.sheenRoughness) +
                    frame.rimColor.rgb * light.rim * sheenLight(n, v, frame.rimDirection.xyz, layers.sheenRoughness) +
                    studioAmbient(light, n, surface) * (material.occlusion * fibers);
        passes = 1.0 - max(layers.sheen.r, max(layers.sheen.g, layers.sheen.b)) * fibers;
        shown.lit = shown.lit * passes + layers.sheen * fuzz;
    }
    if (materialHas(kMaterialClearcoat)) {
        float coated = layers.coat * mirroredShare(vec3(0.04), layers.coatRoughness, clamp(dot(at.coat, v), 1e-3, 1.0)).x;
        shown.lit = shown.lit * (1.0 - coated) +
                    coated * studioMirrored(layers.coatRoughness, material.occlusion, light, at.coat, surface, v);
        passes *= 1.0 - coated;
    }
    shown.through *= passes;
    shown.glow = passes;
    return shown;
}

/// What is written for it: a color; or of glass, for either of its two draws, what it is blended by.
vec3 layeredColor(Material material, Layered shown, float alpha) {
    if (kThrough)
        return 1.0 - alpha + alpha * shown.through;
    material.emission *= shown.glow;
    vec3 color = studioTone(material, shown.lit);
    return materialHas(kMaterialTransmission) ? color * alpha : color;
}
