// A low sun, whose shadows soften with distance, and a sky.
#include "../../../host/shaders/pbr.glsl"

layout(set = 0, binding = 1) uniform sampler2DShadow sunMap;
layout(set = 0, binding = 2) uniform sampler2D sunDepths;

const float kPi = 3.14159265;
const vec3 kSun = vec3(3.3, 2.95, 2.5);
const vec3 kSkyAbove = vec3(0.50, 0.60, 0.78);
const vec3 kSkyBelow = vec3(0.30, 0.25, 0.21);

/// The horizon's color, which the floor fades into.
vec3 background(vec2 pixel) {
    vec2 at = pixel * frame.viewport.zw;
    float glow = exp(-3.0 * dot(at - vec2(0.5, 0.42), at - vec2(0.5, 0.42)));
    return mix(vec3(0.22, 0.27, 0.36), vec3(0.62, 0.66, 0.72), glow);
}

/// Interleaved gradient noise (Jimenez, SIGGRAPH 2014), another one every frame: temporal anti-aliasing averages it away.
float pixelNoise(vec2 pixel) {
    pixel += frame.noise.x * vec2(5.588238, 5.588238);
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

/// Evenly over a disk, turned by the pixel's noise.
vec2 diskSample(int i, int count, float noise) {
    float radius = sqrt((float(i) + 0.5) / float(count));
    float angle = 2.39996323 * float(i) + 2.0 * kPi * noise;
    return radius * vec2(cos(angle), sin(angle));
}

/// The visible share of the sun: first how far away what hides it is, then as wide a filter as that casts.
float sunVisibility(vec3 position, vec3 normal, vec2 pixel) {
    float texel = frame.noise.y;
    vec4 clip = frame.sunViewProjection * vec4(position + normal * (1.5 * texel), 1.0);
    vec2 at = clip.xy * 0.5 + 0.5;
    if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0))))
        return 1.0;
    const int kSearches = 6, kSamples = 10;
    float noise = pixelNoise(pixel);
    float texels = 1.0 / float(textureSize(sunDepths, 0).x);
    float search = 0.10 / texel * texels; // as wide as the widest penumbra, 10 cm
    float sum = 0.0, count = 0.0;
    for (int i = 0; i < kSearches; ++i) {
        float depth = textureLod(sunDepths, at + diskSample(i, kSearches, noise) * search, 0.0).r;
        if (depth < clip.z) {
            sum += depth;
            count += 1.0;
        }
    }
    if (count == 0.0)
        return 1.0;
    float gap = (clip.z - sum / count) * frame.noise.z; // to what hides the sun, in the world
    float radius = clamp(gap * frame.sunDirection.w, 1.2 * texel, 0.10) / texel * texels;
    // A wide filter looks across sloping receivers: step towards the sun by as much as it may be off.
    float slope = clamp(1.0 - dot(normal, frame.sunDirection.xyz), 0.0, 1.0);
    float bias = radius / texels * texel * slope / frame.noise.z;
    float visible = 0.0;
    for (int i = 0; i < kSamples; ++i)
        visible += texture(sunMap, vec3(at + diskSample(i, kSamples, noise) * radius, clip.z - bias));
    return visible / float(kSamples);
}

/// How much of the sky the characters take from a place on the floor.
float skyVisibility(vec3 position) {
    float visible = 1.0;
    for (int i = 0; i < 4; ++i) {
        vec4 foot = frame.feet[i];
        if (foot.w <= 0.0)
            continue;
        vec2 away = (position.xz - foot.xz) / foot.w;
        visible *= 1.0 - 0.62 * exp(-1.6 * dot(away, away)) * exp(-2.0 * max(position.y - foot.y, 0.0) / foot.w);
    }
    return visible;
}

vec3 skyLight(vec3 n) { return mix(kSkyBelow, kSkyAbove, 0.5 + 0.5 * n.y); }

/// What a place of a character sends to the eye.
vec3 lit(Material material, vec3 position, vec3 n) {
    vec3 v = normalize(frame.eye.xyz - position);
    vec3 l = frame.sunDirection.xyz;
    float nl = max(dot(n, l), 0.0);
    float sun = nl > 0.0 ? sunVisibility(position, n, gl_FragCoord.xy) : 0.0;
    // Light from the floor, and less sky near it.
    float near = mix(0.55, 1.0, clamp(position.y * 1.4, 0.0, 1.0));
    vec3 sunLight = kSun * (sun / kPi * 1.6); // radiance of a white surface that faces it
    vec3 diffuse = sunLight * nl + skyLight(n) * mix(near, 1.0, 0.5 + 0.5 * n.y) * 0.75;
    vec3 f0 = mirrorColor(material);
    vec3 share = mirroredShare(f0, material.roughness, clamp(dot(n, v), 1e-3, 1.0));
    vec3 mirrored = sunLight * mirroredLight(n, v, l, material.roughness, f0) + share * skyLight(reflect(-v, n)) * near;
    return material.albedo * (1.0 - material.metallic) * (1.0 - share) * diffuse + mirrored;
}

/// Motion in texture coordinates: where it is, less where it was.
vec2 motion(vec4 now, vec4 before) { return 0.5 * (now.xy / now.w - before.xy / before.w); }
