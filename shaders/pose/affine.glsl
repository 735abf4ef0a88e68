// Transforms of nodes: as translation, rotation, scale, and as the three rows of a matrix.

struct Transform {
    vec3 translation;
    vec4 rotation; // of any length; zero counts as none
    vec3 scale;
};
struct Affine {
    vec4 x, y, z;
};

Affine identity() { return Affine(vec4(1.0, 0.0, 0.0, 0.0), vec4(0.0, 1.0, 0.0, 0.0), vec4(0.0, 0.0, 1.0, 0.0)); }

vec4 rowTimes(vec4 row, Affine m) {
    precise vec4 r = (row.x * m.x + row.y * m.y) + row.z * m.z;
    r.w = r.w + row.w;
    return r;
}
// b, then a.
Affine combined(Affine a, Affine b) {
    precise Affine m;
    m.x = rowTimes(a.x, b);
    m.y = rowTimes(a.y, b);
    m.z = rowTimes(a.z, b);
    return m;
}

Affine composed(Transform t) {
    vec4 q = t.rotation;
    precise float squared = dot4(q, q);
    precise float s = squared > 1e-30 ? 2.0 / squared : 0.0;
    precise vec3 d = s * (q.xyz * q.xyz);
    precise vec3 mixed = s * (q.xyz * q.yzx); // xy, yz, zx
    precise vec3 spun = s * (q.w * q.xyz);
    precise Affine m;
    m.x = vec4((1.0 - (d.y + d.z)) * t.scale.x, (mixed.x - spun.z) * t.scale.y, (mixed.z + spun.y) * t.scale.z,
               t.translation.x);
    m.y = vec4((mixed.x + spun.z) * t.scale.x, (1.0 - (d.x + d.z)) * t.scale.y, (mixed.y - spun.x) * t.scale.z,
               t.translation.y);
    m.z = vec4((mixed.z - spun.y) * t.scale.x, (mixed.y + spun.x) * t.scale.y, (1.0 - (d.x + d.y)) * t.scale.z,
               t.translation.z);
    return m;
}

vec4 rotationOf(Affine m) {
    return nearestRotation(vec3(m.x.x, m.y.x, m.z.x), vec3(m.x.y, m.y.y, m.z.y), vec3(m.x.z, m.y.z, m.z.z));
}
