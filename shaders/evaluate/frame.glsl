// Needs `const bool kTangents`: whether derivatives matter by themselves, and not for their product alone.
const float kTiny = 1e-37; // above the denormals, which devices may flush

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
        vec3 scaled = normal / max(dot(normal, normal), kTiny);
        f.du -= dot(f.du, normal) * scaled;
        f.dv -= dot(f.dv, normal) * scaled;
    }
    return f;
}
