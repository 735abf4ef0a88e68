// The floor has the backdrop's color, so that it has no edge; only the light that the figure keeps from it shows.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "studio.glsl"
#include "ground.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 0) out vec4 outColor;

void main() {
    float away = length(inPosition.xz - frame.target.xz) / frame.target.w;
    vec3 color = backdrop(gl_FragCoord.xy);
    if (away > kFarthestShadow) {
        outColor = vec4(dither(color, gl_FragCoord.xy), 1.0);
        return;
    }
    vec3 lit = vec3(0.0), all = vec3(0.0);
    vec3 noise = pixelNoise(gl_FragCoord.xy);
#ifdef TRACED
    vec3 receiver = inPosition + vec3(0.0, kRayOffset * frame.target.w, 0.0);
#else
    vec3 receiver = inPosition + vec3(0.0, frame.shadowTexel, 0.0);
#endif
    for (uint i = 0u; i < frame.lightCount; ++i) {
        vec4 light = frame.lights[i].color;
        float weight = max(frame.lights[i].direction.y, 0.0);
        // The rim would throw a long shadow towards the viewer that tells nothing of the figure.
        if (weight <= 0.0 || uint(light.w) == kLightRim)
            continue;
        bool sky = uint(light.w) == kLightSky;
        all += light.rgb * weight;
        if (sky && away > kFarthestSkyShadow) {
            lit += light.rgb * weight;
            continue;
        }
        noise = nextNoise(noise);
#ifdef TRACED
        float visible = tracedVisibility(i, receiver, noise);
#else
        // What stands above this place is about as far away as the light comes from aside.
        float aside = sqrt(max(1.0 - frame.lights[i].direction.y * frame.lights[i].direction.y, 0.09));
        float nearby = frame.target.w * clamp(away / aside, 0.1, 1.2);
        float visible = areCones()
                            ? coneVisibility(i, receiver, vec3(0.0, 1.0, 0.0), frame.lights[i].direction.y, noise, nearby)
                            : lightVisibility(i, receiver);
#endif
        // A few directions of sky are no soft shadow yet: far from the figure they fade, near it they hold it down.
        if (sky)
            visible = mix(visible, 1.0,
                          frame.softShadows > 0.0 ? smoothstep(0.15, 0.9, away) : smoothstep(0.9, kFarthestSkyShadow, away));
        lit += light.rgb * weight * visible;
    }
    if (frame.openSky.w != 0.0) { // near the figure some of the sky is hidden
        all += frame.openSky.rgb;
        lit += frame.openSky.rgb * mix(0.8, 1.0, smoothstep(0.15, 0.9, away));
    }
    vec3 shade = mix(lit / max(all, vec3(1e-4)), vec3(1.0), smoothstep(1.5, kFarthestShadow, away));
    outColor = vec4(dither(color * mix(vec3(1.0), shade, 0.86), gl_FragCoord.xy), 1.0);
}
