// Needs `const bool kTangents`: whether derivatives matter by themselves, and not for their product alone.
const float kTiny = 1e-37; // above the denormals, which devices may flush

// A power of two that makes the largest part of a vector about 1, so that squares of what is left are numbers still, however
// small the surface is. Products with it have the bits that they have without it. A zero vector stays zero.
float evenScale(vec3 v) {
    uint exponent = floatBitsToUint(max(max(abs(v.x), abs(v.y)), abs(v.z))) >> 23u;
    return uintBitsToFloat((254u - clamp(exponent, 1u, 253u)) << 23u);
}
// A normal of any length, made a unit vector; a vanishing one stays zero instead of becoming NaN.
vec3 unitNormal(vec3 normal) {
    vec3 n = normal * evenScale(normal);
    return n * inversesqrt(max(dot(n, n), kTiny));
}

// What a sample's normal and tangent are made of: the derivatives in the two parameters of its patch. Both may lack one common
// positive factor. The normal points outwards and has any length.
struct Frame {
    vec3 du, dv, normal;
};
Frame frameOf(vec3 du, vec3 dv) { return Frame(du, dv, cross(du, dv)); }
// With a normal that comes from elsewhere. Tangents are orthogonal to it.
Frame withNormal(Frame f, vec3 normal) {
    f.normal = normal;
    if (kTangents) {
        vec3 n = normal * evenScale(normal);
        vec3 scaled = n / max(dot(n, n), kTiny);
        f.du -= dot(f.du, n) * scaled;
        f.dv -= dot(f.dv, n) * scaled;
    }
    return f;
}
