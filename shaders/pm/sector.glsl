// A sector of a P_3, P_4 or P_5 patch, expanded from the patch's coefficients (docs/pm.md). Needs tables.glsl and a function
// coefficient(index, today) that loads from the pool.

// One sector. c is relative to the centre and stands in the order 400 310 220 130 040 | 301 211 121 031 | 202 112 022 |
// 103 013 | 004; indices count corner i, corner i + 1, centre.
struct Sector {
    vec3 centre;
    vec3 border[4];
    vec3 c[15];
};

// A ray of (3): the points 301, 202, 103 of the sector after it (031, 022, 013 of the sector before), from b310, b211, b112
// after it and b130, b121, b112 before it.
vec3[3] rayPoints(vec2 ray, vec3 v, vec3 p310, vec3 p130, vec3 p211, vec3 p121, vec3 after112, vec3 before112) {
    precise vec3 x1 = ray.x * v + ray.y * (p310 + p130);
    precise vec3 x2 = ray.x * x1 + ray.y * (p211 + p121);
    precise vec3 x3 = ray.x * x2 + ray.y * (after112 + before112);
    return vec3[3](x1, x2, x3);
}

// Of a patch of m sides, from its record; ray: the weights of (3), of the ray's own point and of either side's.
Sector loadSector(uint m, vec2 ray, uint record, uint base, uint i, bool today) {
    uint n = i + 1u == m ? 0u : i + 1u, l = i == 0u ? m - 1u : i - 1u;
    uint inner = base + tableElement(record).w;
    uvec4 own = base + tableElement(record + i), next = base + tableElement(record + n), last = base + tableElement(record + l);
    Sector s;
    s.centre = coefficient(inner, today);
    vec3 v0 = coefficient(own.x, today), t0 = coefficient(own.y, today), t1 = coefficient(own.z, today), v1 = coefficient(next.x, today);
    precise vec3 border1 = v0 + t0, border2 = v1 + t1;
    s.border = vec3[4](v0, border1, border2, v1);
    precise vec3 a = v0 - s.centre, d = v1 - s.centre;
    uint at = inner + 1u + 3u * i, atNext = inner + 1u + 3u * n, atLast = inner + 1u + 3u * l;
    precise vec3 p211 = a + coefficient(at, today), p121 = d + coefficient(at + 1u, today), p112 = coefficient(at + 2u, today);
    precise vec3 last121 = a + coefficient(atLast + 1u, today), last112 = coefficient(atLast + 2u, today);
    precise vec3 next211 = d + coefficient(atNext, today), next112 = coefficient(atNext + 2u, today);
    precise vec3 p310 = a + 0.75 * t0, p130 = d + 0.75 * t1;
    precise vec3 last130 = a + 0.75 * coefficient(last.z, today), next310 = d + 0.75 * coefficient(next.y, today);
    precise vec3 p220 = ((a + t0) + (d + t1)) * 0.5;
    vec3 left[3] = rayPoints(ray, a, p310, last130, p211, last121, p112, last112);
    vec3 right[3] = rayPoints(ray, d, next310, p130, next211, p121, next112, p112);
    s.c = vec3[15](a, p310, p220, p130, d, left[0], p211, p121, right[0], left[1], p112, right[1], left[2], right[2], vec3(0.0));
    return s;
}
