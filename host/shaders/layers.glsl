// What glTF's extensions lay over a material, and what goes through it: clearcoat, sheen, transmission as of thin glass, light
// that is scattered through, what a dielectric mirrors, and highlights that are stretched. See material.glsl and studio.glsl.

layout(set = 2, binding = kFirstTextureBinding + kClearcoat) uniform sampler2D clearcoatTexture;
layout(set = 2, binding = kFirstTextureBinding + kClearcoatRoughness) uniform sampler2D clearcoatRoughnessTexture;
layout(set = 2, binding = kFirstTextureBinding + kClearcoatNormal) uniform sampler2D clearcoatNormalTexture;
layout(set = 2, binding = kFirstTextureBinding + kSheenColor) uniform sampler2D sheenColorTexture;
layout(set = 2, binding = kFirstTextureBinding + kSheenRoughness) uniform sampler2D sheenRoughnessTexture;
layout(set = 2, binding = kFirstTextureBinding + kTransmission) uniform sampler2D transmissionTexture;
layout(set = 2, binding = kFirstTextureBinding + kAnisotropy) uniform sampler2D anisotropyTexture;
layout(set = 2, binding = kFirstTextureBinding + kDiffuseTransmissionColor) uniform sampler2D diffuseTransmissionColorTexture;

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
                       kMaterialAnisotropy | kMaterialDiffuseTransmission);
}

/// The share of light that goes through, before anything is mirrored.
float transmissionAt(vec4 uvs) {
    if (!materialHas(kMaterialTransmission))
        return 0.0;
    return materialData.transmission * (hasTexture(kTransmission) ? texture(transmissionTexture, placed(kTransmission, uvs)).r : 1.0);
}

Layers layersAt(vec4 uvs) {
    Layers layers = Layers(0.0, 0.0, vec3(0.0), 0.0, transmissionAt(uvs), vec3(0.04), 1.0, vec3(0.0), vec3(0.0));
    if (materialHas(kMaterialClearcoat)) {
        layers.coat = materialData.clearcoat;
        layers.coatRoughness = materialData.clearcoatRoughness;
        if (hasTexture(kClearcoat))
            layers.coat *= texture(clearcoatTexture, placed(kClearcoat, uvs)).r;
        if (hasTexture(kClearcoatRoughness))
            layers.coatRoughness *= texture(clearcoatRoughnessTexture, placed(kClearcoatRoughness, uvs)).g;
    }
    if (materialHas(kMaterialSheen)) {
        layers.sheen = materialData.sheen.rgb;
        layers.sheenRoughness = materialData.sheen.a;
        if (hasTexture(kSheenColor))
            layers.sheen *= texture(sheenColorTexture, placed(kSheenColor, uvs)).rgb;
        if (hasTexture(kSheenRoughness))
            layers.sheenRoughness *= texture(sheenRoughnessTexture, placed(kSheenRoughness, uvs)).a;
    }
    if (materialHas(kMaterialSpecular)) {
        layers.dielectric = materialData.dielectric.rgb;
        layers.grazing = materialData.dielectric.a;
    }
    if (materialHas(kMaterialAnisotropy)) {
        vec3 texel = vec3(1.0, 0.0, 1.0);
        if (hasTexture(kAnisotropy)) {
            texel = texture(anisotropyTexture, placed(kAnisotropy, uvs)).rgb;
            texel.xy = 2.0 * texel.xy - 1.0;
        }
        float c = materialData.anisotropy.y, s = materialData.anisotropy.z;
        layers.stretch = vec3(c * texel.x - s * texel.y, s * texel.x + c * texel.y, materialData.anisotropy.x * texel.z);
    }
    if (materialHas(kMaterialDiffuseTransmission)) {
        layers.inside = materialData.diffuseTransmission.rgb;
        if (hasTexture(kDiffuseTransmissionColor))
            layers.inside *= texture(diffuseTransmissionColorTexture, placed(kDiffuseTransmissionColor, uvs)).rgb;
    }
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
    return (2.0 * texture(clearcoatNormalTexture, uv).xyz - 1.0) * vec3(vec2(materialData.clearcoatNormalScale), 1.0);
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
    vec3 share = mirroredShareOf(f0, mix(layers.grazing, 1.0, material.metallic), material.roughness, nv);
    vec3 enters = (1.0 - material.metallic) * (1.0 - share);
    vec3 body = material.albedo * enters;
    vec3 scattered = body * studioScattered(material.occlusion, light, n, surface);
    if (materialHas(kMaterialDiffuseTransmission)) {
        vec3 inside = studioInside(light, materialData.extinction, at.position, surface, at.noise);
        scattered = mix(scattered, enters * layers.inside * inside, materialData.diffuseTransmission.a);
    }
    Layered shown;
    shown.lit = (1.0 - layers.transmission) * scattered + share * layeredMirror(material, layers, light, at);
    shown.through = body * layers.transmission;
    if (materialHas(kMaterialTransmission))
        shown.through *= exp(-materialData.extinction.rgb * materialData.extinction.w);
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
