// Temporal anti-aliasing: the frame's one jittered sample a pixel, and what the pixel showed before, followed along its motion
// and held to the colors that are around it now.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D colors;
layout(set = 0, binding = 1) uniform sampler2D motions;
layout(set = 0, binding = 2) uniform sampler2D depths;
layout(set = 0, binding = 3) uniform sampler2D history;
layout(set = 0, binding = 4, rgba16f) uniform writeonly image2D result;

layout(push_constant) uniform Push {
    ivec2 size;
    uint hasHistory;
};

vec3 toYCoCg(vec3 c) {
    return vec3(dot(c, vec3(0.25, 0.5, 0.25)), dot(c, vec3(0.5, 0.0, -0.5)), dot(c, vec3(-0.25, 0.5, -0.25)));
}

vec3 fromYCoCg(vec3 c) { return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z); }

/// Bright samples would flicker: averages are taken of colors that are squeezed below 1 (Karis, SIGGRAPH 2014).
vec3 squeeze(vec3 c) { return c / (1.0 + dot(c, vec3(0.25, 0.5, 0.25))); }
vec3 unsqueeze(vec3 c) { return c / max(1.0 - dot(c, vec3(0.25, 0.5, 0.25)), 1e-3); }

/// Catmull-Rom in five bilinear lookups (Jimenez, SIGGRAPH 2016), without the corners: linear filtering alone would blur the
/// history a little more every frame.
vec3 sampleHistory(vec2 uv) {
    vec2 at = uv * vec2(size) - 0.5;
    vec2 whole = floor(at), f = at - whole;
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
    vec2 w2 = f * (0.5 + f * (2.0 - 1.5 * f)), w3 = f * f * (-0.5 + 0.5 * f);
    vec2 w12 = w1 + w2, texel = 1.0 / vec2(size);
    vec2 p0 = (whole - 0.5) * texel, p3 = (whole + 2.5) * texel, p12 = (whole + 0.5 + w2 / w12) * texel;
    vec4 sum = vec4(textureLod(history, vec2(p12.x, p0.y), 0.0).rgb, 1.0) * (w12.x * w0.y) +
               vec4(textureLod(history, vec2(p0.x, p12.y), 0.0).rgb, 1.0) * (w0.x * w12.y) +
               vec4(textureLod(history, p12, 0.0).rgb, 1.0) * (w12.x * w12.y) +
               vec4(textureLod(history, vec2(p3.x, p12.y), 0.0).rgb, 1.0) * (w3.x * w12.y) +
               vec4(textureLod(history, vec2(p12.x, p3.y), 0.0).rgb, 1.0) * (w12.x * w3.y);
    return max(sum.rgb / sum.a, 0.0);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size)))
        return;

    // What is around: mean and spread in YCoCg, and the motion of the nearest surface, so that a silhouette's soft pixels go
    // with the figure.
    vec3 sum = vec3(0.0), squares = vec3(0.0), here = vec3(0.0);
    ivec2 nearest = pixel;
    float depth = 2.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 at = clamp(pixel + ivec2(x, y), ivec2(0), size - 1);
            vec3 c = toYCoCg(squeeze(texelFetch(colors, at, 0).rgb));
            sum += c;
            squares += c * c;
            if (x == 0 && y == 0)
                here = c;
            float d = texelFetch(depths, at, 0).r;
            if (d < depth) {
                depth = d;
                nearest = at;
            }
        }
    }
    vec3 mean = sum / 9.0;
    vec3 spread = sqrt(max(squares / 9.0 - mean * mean, 0.0)) * 1.25;

    vec2 uv = (vec2(pixel) + 0.5) / vec2(size);
    vec2 moved = texelFetch(motions, nearest, 0).rg;
    vec2 before = uv - moved;
    vec3 color = here;
    if (hasHistory != 0u && all(greaterThan(before, vec2(0.0))) && all(lessThan(before, vec2(1.0)))) {
        vec3 old = toYCoCg(squeeze(sampleHistory(before)));
        // Into the box about the mean, straight towards it (Salvi, GDC 2016).
        vec3 off = old - mean, over = abs(off) / max(spread, 1e-4);
        old = mean + off / max(1.0, max(over.x, max(over.y, over.z)));
        // What moves fast is seen less exactly, and wants less history.
        float speed = length(moved * vec2(size));
        color = mix(old, here, mix(0.07, 0.2, clamp(speed / 20.0, 0.0, 1.0)));
    }
    imageStore(result, pixel, vec4(unsqueeze(fromYCoCg(color)), 1.0));
}
