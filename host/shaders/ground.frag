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
    vec3 receiver = inPosition + vec3(0.0, frame.shadowTexel, 0.0);
    for (uint i = 0u; i < frame.lightCount; ++i) {
        vec4 light = frame.lights[i].color;
        // The rim would throw a long shadow towards the viewer that tells nothing of the figure.
        float weight = max(frame.lights[i].direction.y, 0.0) * (uint(light.w) == kLightRim ? 0.15 : 1.0);
        if (weight <= 0.0)
            continue;
        float visible = lightVisibility(i, receiver);
        // A few directions of sky are no soft shadow yet: far from the figure they fade, near it they hold it down.
        if (frame.softShadows > 0.0 && uint(light.w) == kLightSky)
            visible = mix(visible, 1.0, smoothstep(0.15, 0.9, away));
        all += light.rgb * weight;
        lit += light.rgb * weight * visible;
    }
    if (frame.openSky.w != 0.0) { // near the figure some of the sky is hidden
        all += frame.openSky.rgb;
        lit += frame.openSky.rgb * mix(0.8, 1.0, smoothstep(0.15, 0.9, away));
    }
    vec3 shade = mix(lit / max(all, vec3(1e-4)), vec3(1.0), smoothstep(1.5, kFarthestShadow, away));
    outColor = vec4(dither(color * mix(vec3(1.0), shade, 0.86), gl_FragCoord.xy), 1.0);
}
