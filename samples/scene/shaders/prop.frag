#version 460
#extension GL_GOOGLE_include_directive : require
#define FRAGMENT
#include "scene.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec3 inLocal;
layout(location = 3) in vec3 inLocalNormal;
layout(location = 4) flat in vec4 inColor;
layout(location = 5) flat in vec4 inSize;
layout(location = 0) out vec4 outColor;

// Surface of props.h
const uint kPlain = 0u, kStripes = 1u, kWood = 2u, kTimbered = 3u, kTiles = 4u, kWater = 5u, kStone = 6u, kCloth = 7u;

struct Paint {
    vec3 albedo;
    float roughness;
};

// A soft step of a pixel's width.
float line(float distance, float width) { return 1.0 - smoothstep(-0.7, 0.7, (abs(distance) - width) / max(fwidth(distance), 1e-4)); }

// The two coordinates that lie in the side which is seen; the second one up where that is possible.
vec2 onSide() {
    vec3 n = abs(inLocalNormal);
    return n.x > max(n.y, n.z) ? inLocal.zy : n.y > n.z ? inLocal.xz : inLocal.xy;
}

Paint wood() {
    vec3 s = inSize.xyz; // planks along the longest side
    vec2 at = s.x >= max(s.y, s.z) ? vec2(inLocal.x, inLocal.y + inLocal.z) : s.y >= s.z ? vec2(inLocal.y, inLocal.x + inLocal.z)
                                                                                      : vec2(inLocal.z, inLocal.x + inLocal.y);
    float plank = floor(at.y / 0.14), grain = noise(vec2(at.x * 3.0 + 17.0 * inSize.w, at.y * 70.0 + plank * 9.0));
    float gap = line(fract(at.y / 0.14) - 0.5 - 0.46, 0.03);
    return Paint(inColor.rgb * mix(0.72, 1.2, grain) * mix(0.85, 1.15, hash(vec2(plank, inSize.w))) * mix(1.0, 0.4, gap), 0.75);
}

Paint timbered() {
    vec2 at = onSide();
    bool isFront = abs(inLocalNormal.z) > 0.5 || abs(inLocalNormal.x) > 0.5;
    float bottom = at.y + 0.5 * inSize.y;
    vec3 plaster = inColor.rgb * mix(0.86, 1.06, noise(at * 2.3 + 31.0 * inSize.w)) * mix(0.8, 1.0, smoothstep(0.4, 1.6, bottom));
    if (!isFront) return Paint(plaster, 0.9);
    const float kBay = 1.3, kStorey = 1.75;
    vec2 bay = vec2(fract(at.x / kBay + 0.5) - 0.5, fract((bottom - 0.65) / kStorey) - 0.5) * vec2(kBay, kStorey);
    vec2 cell = vec2(floor(at.x / kBay + 0.5), floor((bottom - 0.65) / kStorey));
    float beams = max(line(abs(bay.x) - 0.5 * kBay, 0.07), line(abs(bay.y) - 0.5 * kStorey, 0.08));
    beams = max(beams, line(abs(at.x) - 0.5 * inSize.x, 0.11));
    float kind = hash(cell + 41.0 * inSize.w);
    vec3 color = plaster;
    if (kind < 0.3) { // a brace
        float side = kind < 0.15 ? 1.0 : -1.0;
        beams = max(beams, line((bay.x * side / kBay - bay.y / kStorey) * 1.0, 0.05));
    } else if (cell.y >= 0.0 && abs(cell.x) * kBay + 0.4 < 0.5 * inSize.x) { // a window of four panes
        vec2 pane = abs(bay - vec2(0.0, 0.08));
        float frame = max(pane.x - 0.36, pane.y - 0.48);
        if (frame < 0.0) {
            float bars = max(max(line(pane.x, 0.025), line(pane.y - 0.1, 0.02)), line(frame, 0.05));
            float lights = hash(cell + 7.0 + 13.0 * inSize.w) > 0.72 ? 1.0 : 0.0;
            vec3 glass = mix(vec3(0.035, 0.05, 0.065), vec3(0.85, 0.46, 0.14), lights * 0.8);
            return Paint(mix(glass, vec3(0.10, 0.06, 0.035), bars), mix(0.08, 0.7, bars));
        }
    }
    color = mix(color, vec3(0.095, 0.055, 0.032) * mix(0.8, 1.2, noise(at * vec2(40.0, 5.0))), beams);
    return Paint(color, 0.88);
}

Paint tiles() {
    vec2 at = vec2(inLocal.z, inLocal.x) / vec2(0.22, 0.26);
    float row = floor(at.y);
    at.x += 0.5 * mod(row, 2.0);
    float shade = hash(vec2(floor(at.x), row) + 19.0 * inSize.w), lip = fract(inLocal.x < 0.0 ? at.y : 1.0 - at.y);
    return Paint(inColor.rgb * mix(0.7, 1.3, shade) * mix(0.55, 1.0, smoothstep(0.0, 0.25, lip)) * mix(0.8, 1.0, smoothstep(0.0, 0.12, abs(fract(at.x) - 0.5) * -1.0 + 0.5)),
                 0.8);
}

Paint stone() {
    vec2 at = abs(inLocalNormal.y) > 0.5 ? inLocal.xz : vec2(inSize.x > 3.2 || inSize.z > 3.2 ? onSide().x : atan(inLocal.z, inLocal.x) * 0.5 * inSize.x, inLocal.y);
    vec2 block = at / vec2(0.46, 0.24);
    float row = floor(block.y);
    block.x += 0.5 * mod(row, 2.0);
    float joint = max(line(fract(block.x) - 0.5 - 0.47, 0.03), line(fract(block.y) - 0.5 - 0.45, 0.05));
    return Paint(inColor.rgb * mix(0.8, 1.15, hash(vec2(floor(block.x), row))) * mix(0.85, 1.1, noise(at * 21.0)) * mix(1.0, 0.5, joint), 0.85);
}

Paint painted(uint surface) {
    switch (surface) {
    case kStripes: {
        float s = fract(inLocal.x / 0.46 + 0.25) - 0.5, w = fwidth(inLocal.x / 0.46);
        float stripe = smoothstep(-0.7, 0.7, (abs(s) - 0.25) / max(w, 1e-4));
        return Paint(mix(inColor.rgb, vec3(0.60, 0.55, 0.45), stripe), 0.95);
    }
    case kWood: return wood();
    case kTimbered: return timbered();
    case kTiles: return tiles();
    case kStone: return stone();
    case kWater: return Paint(inColor.rgb, 0.06);
    case kCloth: return Paint(inColor.rgb, 0.95);
    default: return Paint(inColor.rgb, 0.42);
    }
}

void main() {
    uint surface = uint(inColor.w);
    vec3 n = normalize(gl_FrontFacing ? inNormal : -inNormal);
    n = dot(n, scene.eye.xyz - inPosition) < 0.0 ? -n : n; // thin things have two sides
    if (surface == kWater) {
        vec2 p = inPosition.xz * 9.0 + scene.eye.w * vec2(0.6, 0.9);
        n = normalize(n + 0.10 * vec3(noise(p) - 0.5, 0.0, noise(p + 40.0) - 0.5));
    }
    Paint paint = painted(surface);
    float open = mix(openness(inPosition), 1.0, 0.4) * mix(0.62, 1.0, smoothstep(0.0, 0.9, inPosition.y));
    outColor = shown(hazed(lit(paint.albedo, 0.0, paint.roughness, inPosition, n, open, surface == kStripes || surface == kCloth ? 0.25 : 0.0),
                           inPosition));
}
