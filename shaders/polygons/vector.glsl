// Vector algebra with the same bits in both mappings: the built-in functions may be contracted.
vec3 crossProduct(vec3 a, vec3 b) {
    precise vec3 c = a.yzx * b.zxy - a.zxy * b.yzx;
    return c;
}

float dotProduct(vec3 a, vec3 b) {
    precise float d = (a.x * b.x + a.y * b.y) + a.z * b.z;
    return d;
}

// The unit vector of a vector of any length; of one that vanishes zero.
vec3 directionOf(vec3 v) {
    float size = max(max(abs(v.x), abs(v.y)), abs(v.z));
    if (!(size > 1e-37)) return vec3(0.0); // above the denormals, which devices may flush
    precise vec3 scaled = v / size;
    precise vec3 unit = scaled / sqrt(dotProduct(scaled, scaled));
    return unit;
}
