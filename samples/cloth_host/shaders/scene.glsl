// An evening: a low sun with a shadow map, a sky, and the ground's warmth. SceneUniforms of scene.h.
layout(set = 0, binding = 0, std140) uniform Scene {
    mat4 viewProjection;
    mat4 sunViewProjection;
    vec4 eye;
    vec4 sunDirection;
    vec4 viewport; // width, height, and their reciprocals
} scene;

#ifdef FRAGMENT
layout(set = 0, binding = 1) uniform sampler2DShadow sunMap;

const vec3 kSun = vec3(3.4, 2.55, 1.75);

vec3 sky(vec2 pixel) {
    float up = 1.0 - pixel.y * scene.viewport.w;
    vec3 color = mix(vec3(0.95, 0.62, 0.38), vec3(0.52, 0.55, 0.66), smoothstep(0.05, 0.45, up));
    return mix(color, vec3(0.16, 0.26, 0.46), smoothstep(0.35, 1.1, up));
}

vec3 skyLight(vec3 n) { return mix(vec3(0.26, 0.19, 0.14), vec3(0.34, 0.42, 0.58), 0.5 + 0.5 * n.y); }

float sunVisibility(vec3 position) {
    vec4 at = scene.sunViewProjection * vec4(position, 1.0);
    vec2 uv = at.xy * 0.5 + 0.5;
    if (any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0))))
        return 1.0;
    float texel = 1.0 / float(textureSize(sunMap, 0).x), sum = 0.0;
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x)
            sum += texture(sunMap, vec3(uv + vec2(x, y) * texel, at.z));
    return sum / 25.0;
}

/// A filmic curve (Narkowicz's fit of the ACES reference), and sRGB.
vec4 developed(vec3 x) {
    x *= 0.7;
    x = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    x = mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, 12.92 * x, lessThan(x, vec3(0.0031308)));
    float noise = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715)))) - 0.5;
    return vec4(x + noise / 255.0, 1.0);
}
#endif
