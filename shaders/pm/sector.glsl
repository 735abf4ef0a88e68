// A sector of a P_3, P_4 or P_5 patch, expanded from the patch's coefficients (docs/pm.md).

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

// What a side of a patch brings to the sectors beside it: its first corner, the tangents along it at both ends, and what the
// facet stage has put behind it.
struct SectorSide {
    vec3 v, t0, t1;
    vec3 o211, o121, p112;
};

// The sector of a side between its neighbors; ray: the weights of (3), of the ray's own point and of either side's.
Sector makeSector(vec2 ray, vec3 centre, SectorSide last, SectorSide own, SectorSide next) {
    Sector s;
    s.centre = centre;
    precise vec3 border1 = own.v + own.t0, border2 = next.v + own.t1;
    s.border = vec3[4](own.v, border1, border2, next.v);
    precise vec3 a = own.v - centre, d = next.v - centre;
    precise vec3 p211 = a + own.o211, p121 = d + own.o121, last121 = a + last.o121, next211 = d + next.o211;
    precise vec3 p310 = a + 0.75 * own.t0, p130 = d + 0.75 * own.t1;
    precise vec3 last130 = a + 0.75 * last.t1, next310 = d + 0.75 * next.t0;
    precise vec3 p220 = ((a + own.t0) + (d + own.t1)) * 0.5;
    vec3 left[3] = rayPoints(ray, a, p310, last130, p211, last121, own.p112, last.p112);
    vec3 right[3] = rayPoints(ray, d, next310, p130, next211, p121, next.p112, own.p112);
    s.c = vec3[15](a, p310, p220, p130, d, left[0], p211, p121, right[0], left[1], own.p112, right[1], left[2], right[2],
                   vec3(0.0));
    return s;
}
