// To the screen: a filmic curve, sRGB, and noise of one step that breaks the bands of 8 bits.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D color;
layout(set = 0, binding = 1, rgba8) uniform writeonly image2D picture;

layout(push_constant) uniform Push { ivec2 size; };

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, size)))
        return;
    vec3 x = 0.62 * texelFetch(color, pixel, 0).rgb;
    // Narkowicz's fit of the ACES reference.
    x = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    vec2 at = vec2(pixel) / vec2(size) - 0.5;
    x *= 1.0 - 0.28 * dot(at, at);
    x = mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, 12.92 * x, lessThan(x, vec3(0.0031308)));
    float noise = fract(52.9829189 * fract(dot(vec2(pixel), vec2(0.06711056, 0.00583715)))) - 0.5;
    imageStore(picture, pixel, vec4(x + noise / 255.0, 1.0));
}
