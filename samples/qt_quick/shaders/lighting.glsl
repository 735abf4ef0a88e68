// A warm lamp high up in front, a cool room around, and what the screen makes of it.
#include "../../../host/shaders/pbr.glsl"

layout(set = 0, binding = 1) uniform sampler2DShadow sunMap;

const vec3 kLamp = vec3(3.1, 2.75, 2.25);
const vec3 kRoomAbove = vec3(0.62, 0.70, 0.84);
const vec3 kRoomBelow = vec3(0.44, 0.32, 0.28);

/// The wall behind, linear: lighter in the middle, where everybody stands.
vec3 wall(vec2 pixel) {
    vec2 at = pixel * frame.viewport.xy;
    vec2 away = (at - vec2(frame.viewport.w, 0.38)) * vec2(1.5, 1.1);
    return mix(vec3(0.040, 0.030, 0.075), vec3(0.46, 0.27, 0.27), exp(-2.6 * dot(away, away)));
}

/// The visible share of the lamp. Wide and even, so that the edge of the shadow is soft and shows no pattern.
float lampVisibility(vec3 position, vec3 normal) {
    vec4 clip = frame.sunViewProjection * vec4(position + normal * 0.012, 1.0);
    vec2 at = clip.xy * 0.5 + 0.5;
    const int kReach = 3;
    vec2 texel = 1.25 / vec2(textureSize(sunMap, 0));
    float visible = 0.0;
    for (int y = -kReach; y <= kReach; ++y)
        for (int x = -kReach; x <= kReach; ++x)
            visible += texture(sunMap, vec3(at + vec2(x, y) * texel, clip.z - 0.0006));
    return visible / float((2 * kReach + 1) * (2 * kReach + 1));
}

/// How much of the room's light those who stand there leave to a place near the floor.
float roomVisibility(vec3 position) {
    float visible = 1.0;
    for (int i = 0; i < int(frame.viewport.z); ++i) {
        vec2 away = (position.xz - frame.feet[i].xz) / frame.feet[i].w;
        visible *= 1.0 - 0.55 * exp(-1.5 * dot(away, away)) * exp(-3.0 * max(position.y, 0.0));
    }
    return visible;
}

vec3 roomLight(vec3 n) { return mix(kRoomBelow, kRoomAbove, 0.5 + 0.5 * n.y); }

/// Qt Quick mixes sRGB values as they are, so the picture holds these: a filmic curve (Narkowicz' fit of ACES), then sRGB.
vec4 onScreen(vec3 x) {
    x *= 0.66;
    x = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    return vec4(mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, 12.92 * x, lessThan(x, vec3(0.0031308))), 1.0);
}
