// What every pass sees: SceneUniforms of drawing.h; and the light of a late afternoon: a low sun with one shadow map, a blue sky,
// what the ground throws back.
const uint kMostFigures = 60u;
layout(set = 0, binding = 0, std140) uniform Scene {
    mat4 viewProjection;
    mat4 sunViewProjection;
    vec4 eye;   // w: time
    vec4 sun;   // towards it; w: a texel of its map in the world
    vec4 right; // of the camera; right and up reach to the picture's edges
    vec4 up;
    vec4 ahead;
    vec4 feet[kMostFigures]; // where figures stand; w: how wide
    uvec4 counts;            // of figures
} scene;

layout(push_constant) uniform Push {
    uint first; // figures: of the call; props: the shape
    uint sun;   // 1: into the sun's map
    uint paint; // 1: capacities as colors
} push;

#ifdef FRAGMENT
layout(set = 0, binding = 1) uniform sampler2DShadow sunMap;

const float kPi = 3.14159265;
const vec3 kSun = vec3(5.2, 4.1, 2.75);
const vec3 kSkyAbove = vec3(0.40, 0.60, 1.0), kSkyBeside = vec3(0.92, 0.86, 0.78);
const vec3 kGroundLight = vec3(0.34, 0.27, 0.20);

float hash(vec2 p) { return fract(sin(dot(p, vec2(127.1, 311.7))) * 43758.5453); }

float noise(vec2 p) {
    vec2 cell = floor(p), f = fract(p);
    f = f * f * (3.0 - 2.0 * f);
    return mix(mix(hash(cell), hash(cell + vec2(1, 0)), f.x), mix(hash(cell + vec2(0, 1)), hash(cell + vec2(1, 1)), f.x), f.y);
}

// Light from a direction, without the sun.
vec3 skyLight(vec3 direction) {
    float h = direction.y;
    vec3 sky = mix(kSkyBeside, kSkyAbove, smoothstep(0.0, 0.55, h));
    float glow = max(dot(direction, scene.sun.xyz), 0.0);
    sky += vec3(0.55, 0.36, 0.16) * pow(glow, 6.0);
    return mix(kGroundLight, sky, smoothstep(-0.12, 0.08, h));
}

// How much of the sun comes here: eight looks into its map, turned from pixel to pixel.
float sunVisibility(vec3 position, vec3 normal) {
    vec4 clip = scene.sunViewProjection * vec4(position + normal * (2.0 * scene.sun.w), 1.0);
    vec2 at = clip.xy * 0.5 + 0.5;
    if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0)))) return 1.0;
    vec2 texel = 1.0 / vec2(textureSize(sunMap, 0));
    float turn = 2.0 * kPi * hash(gl_FragCoord.xy), visible = 0.0;
    for (int i = 0; i < 8; ++i) {
        float r = 2.2 * sqrt((float(i) + 0.5) / 8.0), a = turn + 2.39996 * float(i);
        visible += texture(sunMap, vec3(at + r * texel * vec2(cos(a), sin(a)), clip.z - 0.0003));
    }
    return visible / 8.0;
}

// What figures that stand close by take of the open sky, down at the ground.
float openness(vec3 position) {
    float open = 1.0;
    for (uint i = 0u; i < scene.counts.x; ++i) {
        vec3 away = position - scene.feet[i].xyz;
        float r = scene.feet[i].w, d2 = dot(away.xz, away.xz) / (r * r);
        open *= 1.0 - 0.62 * exp(-1.5 * d2) * clamp(1.0 - 1.2 * away.y, 0.0, 1.0);
    }
    return open;
}

vec3 lit(vec3 albedo, float metallic, float roughness, vec3 position, vec3 n, float open, float wrap) {
    vec3 v = normalize(scene.eye.xyz - position), l = scene.sun.xyz, h = normalize(v + l);
    float nl = max((dot(n, l) + wrap) / (1.0 + wrap), 0.0), nv = max(dot(n, v), 0.03), nh = max(dot(n, h), 0.0);
    float visible = nl > 0.0 ? sunVisibility(position, n) : 0.0;
    vec3 f0 = mix(vec3(0.04), albedo, metallic);
    float a2 = pow(max(roughness, 0.08), 4.0), d = a2 / (kPi * pow(nh * nh * (a2 - 1.0) + 1.0, 2.0));
    float g = 0.5 / max(mix(2.0 * nl * nv, nl + nv, roughness), 0.02);
    vec3 f = f0 + (1.0 - f0) * pow(1.0 - max(dot(v, h), 0.0), 5.0);
    vec3 diffuse = albedo * (1.0 - metallic);
    vec3 direct = kSun * visible * nl * (diffuse / kPi * 1.9 + f * min(d * g, 8.0));
    // The sky as a hemisphere, and its mirror image, which is blurred where the surface is rough.
    vec3 ambient = mix(kGroundLight, mix(kSkyBeside, kSkyAbove, 0.5), 0.5 + 0.5 * n.y) * open;
    vec3 mirrored = mix(skyLight(reflect(-v, n)), ambient, roughness);
    vec3 fresnel = f0 + (max(vec3(1.0 - roughness), f0) - f0) * pow(1.0 - nv, 5.0);
    return direct + 0.62 * ambient * diffuse + 0.62 * open * mirrored * fresnel;
}

vec3 hazed(vec3 color, vec3 position) {
    float away = length(position - scene.eye.xyz);
    return mix(vec3(0.86, 0.80, 0.72), color, exp(-0.0075 * max(away - 9.0, 0.0)));
}

// Linear to what the picture holds.
vec4 shown(vec3 color) {
    color *= 0.6;
    vec3 mapped = clamp(color * (2.51 * color + 0.03) / (color * (2.43 * color + 0.59) + 0.14), 0.0, 1.0);
    vec3 low = 12.92 * mapped, high = 1.055 * pow(mapped, vec3(1.0 / 2.4)) - 0.055;
    return vec4(mix(high, low, lessThan(mapped, vec3(0.0031308))), 1.0);
}
#endif
