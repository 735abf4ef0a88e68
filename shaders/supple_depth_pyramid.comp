// A level of a depth pyramid (suppleSetDepthPyramid), for hosts that have none: from the depth picture to level 0, from each
// level to the next. Self-contained: compile it as it is, for Vulkan 1.0 and later. Compiled for 1.3, it needs the feature
// maintenance4. For sizes of any kind, level 0 smaller than the picture too: a texel takes the farthest of all that its
// rectangle touches.
//
// A level is a dispatch of ((width + 7) / 8, (height + 7) / 8, 1) groups with
//   binding 0   sampled image: the picture's depth aspect, of one sample a pixel, or a view of the level before alone
//   binding 1   storage image, R32_SFLOAT: a view of the level alone
//   push        uint: 1 where near is 1 and far is 0
// and a barrier from compute shader writes to compute shader reads between two levels.
#version 450
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D source;
layout(set = 0, binding = 1, r32f) uniform writeonly image2D target;
layout(push_constant) uniform Push { uint reversed; };

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(target), from = textureSize(source, 0);
    if (any(greaterThanEqual(at, size))) return;
    ivec2 first = at * from / size, last = ((at + 1) * from + size - 1) / size - 1;
    float farthest = texelFetch(source, first, 0).x;
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            float depth = texelFetch(source, ivec2(x, y), 0).x;
            farthest = reversed != 0u ? min(farthest, depth) : max(farthest, depth);
        }
    }
    imageStore(target, at, vec4(farthest));
}
