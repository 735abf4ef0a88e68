// The studio: a warm key, a cool rim from behind, a soft sky, light from the floor. Each light is one direction of a
// sampled environment and has its own small shadow map, so that shadows soften with distance and corners darken.
layout(set = 0, binding = kShadowBinding) uniform sampler2DArrayShadow shadowMaps;

const float kPi = 3.14159265;

/// 0 where the light is hidden from the position, 1 where it is seen.
float lightVisibility(uint light, vec3 position) {
    vec4 at = frame.lights[light].shadow * vec4(position, 1.0);
    vec2 uv = at.xy * 0.5 + 0.5;
    float depth = min(at.z, 1.0);
    if (frame.softShadows == 0.0)
        return texture(shadowMaps, vec4(uv, float(light), depth));
    // Few directions: four looks spread over the neighboring texels round off the steps of the map.
    float sum = 0.0;
    for (uint i = 0u; i < 4u; ++i) {
        vec2 corner = vec2(i & 1u, i >> 1) * 2.0 - 1.0;
        vec2 turned = vec2(corner.x * 0.89 - corner.y * 0.45, corner.x * 0.45 + corner.y * 0.89);
        sum += texture(shadowMaps, vec4(uv + turned * frame.softShadows, float(light), depth));
    }
    return sum * 0.25;
}

/// GGX with Schlick's Fresnel and the Hammon approximation of the joint Smith term (PBR Diffuse Lighting for GGX+Smith
/// Microsurfaces, GDC 2017); times n.l.
vec3 glossy(vec3 n, vec3 v, vec3 l, float roughness, vec3 f0) {
    vec3 h = normalize(v + l);
    float nh = clamp(dot(n, h), 0.0, 1.0), nl = clamp(dot(n, l), 0.0, 1.0);
    float nv = clamp(abs(dot(n, v)), 1e-3, 1.0), vh = clamp(dot(v, h), 0.0, 1.0);
    float a = roughness * roughness, a2 = a * a;
    float d = nh * nh * (a2 - 1.0) + 1.0;
    float distribution = a2 / (kPi * d * d);
    vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - vh, 5.0);
    float visibility = 0.5 / mix(2.0 * nl * nv, nl + nv, a);
    return fresnel * (distribution * visibility * nl);
}

/// What a mirror would show: a broad soft box overhead, the horizon, the floor. Only for sheen.
vec3 studioReflection(vec3 r) {
    vec3 ceiling = mix(vec3(0.30, 0.33, 0.38), vec3(1.1, 1.1, 1.12), smoothstep(0.15, 0.8, r.y));
    return mix(vec3(0.16, 0.15, 0.14), ceiling, smoothstep(-0.35, 0.25, r.y));
}

/// What the rig sends to a place: a few numbers that vary slowly, so that dense vertices may carry them.
struct Incident {
    vec3 sky;   // irradiance
    float key;  // visible share of the key
    float rim;  // and of the rim
    float open; // visible share of the sky
};

Incident gatherLight(vec3 position, vec3 n) {
    vec3 sky = vec3(0.0);
    float seen[3] = float[3](0.0, 0.0, 0.0), all[3] = float[3](1e-4, 1e-4, 1e-4);
    // Receivers step off the surface: along the normal by a good texel, so that a map's own steps cast no shadow.
    vec3 receiver = position + n * (frame.shadowTexel * 1.6);
    for (uint i = 0u; i < frame.lightCount; ++i) {
        float nl = dot(n, frame.lights[i].direction.xyz);
        if (nl <= 0.0)
            continue;
        vec4 color = frame.lights[i].color;
        uint part = uint(color.w);
        float visible = lightVisibility(i, receiver) * nl;
        seen[part] += visible;
        all[part] += nl;
        if (part == kLightSky)
            sky += color.rgb * visible;
    }
    return Incident(sky, seen[kLightKey] / all[kLightKey], seen[kLightRim] / all[kLightRim],
                    seen[kLightSky] / all[kLightSky]);
}

/// Lambert's law for a soft box: the light sinks behind the horizon bit by bit.
float softLambert(float nl) {
    const float soft = 0.18;
    return nl < soft ? (max(nl + soft, 0.0) * max(nl + soft, 0.0)) / (4.0 * soft) : nl;
}

struct Material {
    vec3 albedo;
    float roughness;
    float metallic;
};

/// Radiance towards the eye, before the tone curve. n faces the viewer's side of the surface.
vec3 studioShade(Material material, Incident light, vec3 n, vec3 v) {
    vec3 key = frame.keyDirection.xyz, rim = frame.rimDirection.xyz;
    vec3 keyLight = frame.keyColor.rgb * light.key, rimLight = frame.rimColor.rgb * light.rim;
    float down = 0.5 - 0.5 * n.y;
    vec3 diffuse = keyLight * softLambert(dot(n, key)) + rimLight * softLambert(dot(n, rim)) + light.sky +
                   frame.bounce.rgb * down * mix(0.35, 1.0, light.open);
    // A metal reflects in its color, and nothing leaves it diffusely.
    vec3 f0 = mix(vec3(0.04), material.albedo, material.metallic);
    float roughness = max(material.roughness, 0.1); // lamps are no points
    vec3 specular =
        kPi * (keyLight * glossy(n, v, key, roughness, f0) + rimLight * glossy(n, v, rim, roughness, f0));
    float nv = clamp(dot(n, v), 0.0, 1.0);
    vec3 fresnel = f0 + (1.0 - f0) * (pow(1.0 - nv, 5.0) * (1.0 - 0.6 * roughness));
    vec3 sheen = studioReflection(reflect(-v, n)) * fresnel * mix(0.15, 1.0, light.open) * 0.9;
    return material.albedo * (1.0 - material.metallic) * diffuse + specular + sheen;
}

/// A filmic curve: Narkowicz's fit of the ACES reference, which keeps blacks firm and rolls highlights off.
vec3 toneMap(vec3 x) {
    x *= frame.exposure;
    return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

vec3 fromSrgb(vec3 x) { return mix(pow((x + 0.055) / 1.055, vec3(2.4)), x / 12.92, lessThan(x, vec3(0.04045))); }

/// The backdrop as it is shown: brighter behind the figure, so that dark and light figures both stand out from it.
vec3 backdrop(vec2 pixel) {
    vec2 at = pixel * frame.viewport.zw;
    vec2 off = (at - vec2(0.5, 0.46)) * vec2(1.0, 1.1);
    float glow = exp(-dot(off, off) * 3.4);
    vec3 color = mix(vec3(0.050, 0.058, 0.072), vec3(0.36, 0.385, 0.42), glow);
    color *= mix(vec3(1.0), vec3(0.86, 0.83, 0.80), smoothstep(0.5, 1.0, at.y));
    return color;
}

/// Breaks the steps of 8 bits in slow gradients: interleaved gradient noise (Jimenez, SIGGRAPH 2014) of one step, whose size
/// in linear light goes about with the root.
vec3 dither(vec3 color, vec2 pixel) {
    float noise = fract(52.9829189 * fract(dot(floor(pixel), vec2(0.06711056, 0.00583715)))) - 0.5;
    return max(color + sqrt(color) * (noise * (2.0 / 255.0)), 0.0);
}
