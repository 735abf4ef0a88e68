// What the passes of bounds and culling share: loads, one function each (storage buffers on GPUs, texels on CPU devices).
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/bounds.h"

layout(set = 0, binding = kHostListBinding, std430) readonly buffer HostList { uint hostEntries[]; };
layout(set = 0, binding = kHostListTexelBinding) uniform usamplerBuffer hostListTexels;
layout(set = 0, binding = kBoundsStateBinding, std430) buffer States { uvec2 states[]; };

uint hostEntry(uint i) {
    if (kWide) return hostEntries[i];
    return texelFetch(hostListTexels, int(i)).x;
}
