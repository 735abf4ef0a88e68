// What every pass sees: SceneUniforms of scene.h; and the light: a low sun with one shadow map, a pale sky, haze.
layout(set = 0, binding = 0, std140) uniform Scene {
    mat4 viewProjection;
    mat4 sunViewProjection;
    vec4 eye;
    vec4 sunDirection; // towards the sun; w: the sun map's texel in the world
    vec4 viewport;     // width, height, and their reciprocals
} scene;
layout(set = 0, binding = 1) uniform sampler2DShadow sunMap;

const vec3 kSun = vec3(3.1, 2.7, 2.2);
const vec3 kSky = vec3(0.62, 0.72, 0.86);
const vec3 kGround = vec3(0.34, 0.30, 0.25);
const vec3 kHaze = vec3(0.80, 0.84, 0.88);

float sunVisibility(vec3 position, vec3 normal) {
    vec4 clip = scene.sunViewProjection * vec4(position + normal * (1.5 * scene.sunDirection.w), 1.0);
    vec2 at = clip.xy * 0.5 + 0.5;
    if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0)))) return 1.0;
    vec2 texel = 1.0 / vec2(textureSize(sunMap, 0));
    float visible = 0.0;
    for (int i = 0; i < 4; ++i)
        visible += texture(sunMap, vec3(at + (vec2(i & 1, i >> 1) - 0.5) * texel, clip.z - 0.0004));
    return 0.25 * visible;
}

vec3 hazed(vec3 color, vec3 position) {
    float away = length(position - scene.eye.xyz);
    return mix(kHaze, color, exp(-0.0009 * away * away / (1.0 + 0.012 * away)));
}

// Linear to what the picture holds.
vec3 shown(vec3 color) {
    vec3 mapped = color / (1.0 + 0.25 * color);
    return pow(clamp(mapped, 0.0, 1.0), vec3(1.0 / 2.2));
}
