// The deformed cage, read.
layout(set = 0, binding = kCageBinding, std430) readonly buffer Cage { vec4 cage[]; };
layout(set = 0, binding = kCageTexelBinding) uniform samplerBuffer cageTexels;

vec3 cageVertex(uint i) {
    if (kWide) return cage[i].xyz;
    return texelFetch(cageTexels, int(i)).xyz;
}
