// What every pass sees: SceneUniforms of drawing.h; and the light: a low sun with one shadow map, and the sky.
const uint kPoints = 22u;
layout(set = 0, binding = 0, std140) uniform Scene {
    mat4 viewProjection;
    mat4 sunViewProjection;
    vec4 eye;
    vec4 sun;           // towards it; w: a texel of its map in the world
    vec4 viewport;      // width, height, and their reciprocals
    vec4 body[kPoints]; // balls that take the sky from the ground; w: radius
    vec4 mark;          // where the player has pointed; w: 0 without
} scene;

#ifdef FRAGMENT
#include "../../../host/shaders/pbr.glsl"

layout(set = 0, binding = 1) uniform sampler2DShadow sunMap;

const float kPi = 3.14159265;
const vec3 kSun = vec3(3.7, 3.1, 2.3); // radiance of a white surface that faces it
const vec3 kSkyAbove = vec3(0.46, 0.58, 0.80), kSkyBeside = vec3(0.62, 0.60, 0.58), kGroundLight = vec3(0.30, 0.25, 0.20);

/// Interleaved gradient noise (Jimenez, SIGGRAPH 2014).
float pixelNoise(vec2 pixel) { return fract(52.9829189 * fract(dot(floor(pixel), vec2(0.06711056, 0.00583715)))); }

vec3 skyLight(vec3 n) { return mix(mix(kGroundLight, kSkyBeside, smoothstep(-0.6, 0.1, n.y)), kSkyAbove, max(n.y, 0.0)); }

/// How much of the sun comes here: looks into its map over a disk, turned from pixel to pixel.
float sunVisibility(vec3 position, vec3 normal) {
    vec4 clip = scene.sunViewProjection * vec4(position + normal * (2.0 * scene.sun.w), 1.0);
    vec2 at = clip.xy * 0.5 + 0.5;
    if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0)))) return 1.0;
    vec2 texel = 1.0 / vec2(textureSize(sunMap, 0));
    float turn = 2.0 * kPi * pixelNoise(gl_FragCoord.xy), visible = 0.0;
    const int kLooks = 12;
    for (int i = 0; i < kLooks; ++i) {
        float r = 4.5 * sqrt((float(i) + 0.5) / float(kLooks)), a = turn + 2.39996 * float(i);
        visible += texture(sunMap, vec3(at + r * texel * vec2(cos(a), sin(a)), clip.z - 0.0006));
    }
    return visible / float(kLooks);
}

/// What the balls of the body leave of the sky (Quilez, sphere ambient occlusion).
float skyVisibility(vec3 position, vec3 normal) {
    float visible = 1.0;
    for (uint i = 0u; i < kPoints; ++i) {
        vec3 way = scene.body[i].xyz - position;
        float away = length(way), radius = scene.body[i].w;
        float hidden = clamp(dot(normal, way) / max(away, 1e-4), 0.0, 1.0) * radius * radius / max(away * away, radius * radius);
        visible *= 1.0 - 0.8 * hidden;
    }
    return visible;
}

/// open: the part of the sky that is seen.
vec3 lit(Material material, vec3 position, vec3 n, vec3 surface, float open) {
    vec3 v = normalize(scene.eye.xyz - position), l = scene.sun.xyz;
    float nl = max(dot(n, l), 0.0);
    float sun = nl > 0.0 && dot(surface, l) > 0.0 ? sunVisibility(position, surface) : 0.0;
    vec3 f0 = mirrorColor(material), share = mirroredShare(f0, material.roughness, clamp(dot(n, v), 1e-3, 1.0));
    vec3 diffuse = 0.42 * kSun * sun * nl + skyLight(n) * (0.7 * open);
    vec3 mirrored = 0.42 * kSun * sun * mirroredLight(n, v, l, max(material.roughness, 0.12), f0) +
                    share * skyLight(reflect(-v, n)) * (0.7 * open);
    return material.albedo * (1.0 - material.metallic) * (1.0 - share) * diffuse + mirrored;
}

/// The air far away, which has no horizon.
vec3 background(vec2 pixel) {
    vec2 off = (pixel * scene.viewport.zw - vec2(0.5, 0.38)) * vec2(0.9, 1.0);
    return mix(vec3(0.24, 0.33, 0.46), vec3(0.72, 0.70, 0.67), exp(-2.6 * dot(off, off)));
}

/// Linear to what the picture holds.
vec4 shown(vec3 color) {
    vec3 mapped = neutralTone(color);
    vec3 low = 12.92 * mapped, high = 1.055 * pow(mapped, vec3(1.0 / 2.4)) - 0.055;
    return vec4(mix(high, low, lessThan(mapped, vec3(0.0031308))) + (pixelNoise(gl_FragCoord.xy) - 0.5) / 255.0, 1.0);
}
#endif
