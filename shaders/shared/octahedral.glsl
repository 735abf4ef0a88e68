// Unit vectors in 2 x 16 bits. With OCTAHEDRAL_PRECISE defined as `precise`, every device has the same bits.
#ifndef OCTAHEDRAL_PRECISE
#define OCTAHEDRAL_PRECISE
#endif

// Cigolle, Donow, Evangelakos, Mara, McGuire, Meyer, "A Survey of Efficient Representations for Independent Unit
// Vectors" (JCGT 2014): octahedral coordinates. `scale`: 1 / (|x| + |y| + |z|).
vec2 octahedralOf(vec3 n, float scale) {
    OCTAHEDRAL_PRECISE vec2 p = n.xy * scale;
    // Where z < 0, 1 - |y| = |x| + |z| with the sign of x, and so for y.
    uint fold = floatBitsToUint(max(-n.z, 0.0) * scale);
    OCTAHEDRAL_PRECISE vec2 folded = p + uintBitsToFloat((floatBitsToUint(p) & 0x80000000u) | fold);
    return folded;
}
// packSnorm2x16 of what needs no clamping: adding 3/2 2^23 rounds to integers, which stand in the low bits then.
uvec2 roundedBits(vec2 p, vec2 most) {
    OCTAHEDRAL_PRECISE vec2 rounded = p * most + 12582912.0;
    return floatBitsToUint(rounded);
}
