// Where a grid sample of a P_m patch lies among its sectors (docs/pm.md). Needs evaluate/domain.glsl.

// Sector and (k, l): the sample has the weights (rate - k - l, k, l) / rate of the sector's corners and the centre. Points on a
// ray belong to the sector after it, the centre to sector 0.
uvec3 sectorOf(uint domain, uint rate, uint index) {
    uvec3 at = gridSample(domain, rate, index);
    if (domain == kPentagonDomain) return at;
    if (domain == kQuadDomain) {
        uint i = at.x, j = at.y;
        uint d = min(min(i, j), rate - max(i, j));
        if (j == d && (i < rate - d || 2u * d == rate)) return uvec3(i - d, 2u * d, 0u);
        if (i == rate - d && j < rate - d) return uvec3(j - d, 2u * d, 1u);
        if (j == rate - d && i > d) return uvec3(rate - d - i, 2u * d, 2u);
        return uvec3(rate - d - j, 2u * d, 3u);
    }
    uint w[3] = uint[3](rate - at.x - at.y, at.x, at.y);
    uint d = min(w[0], min(w[1], w[2]));
    if (3u * d == rate) return uvec3(0u, rate, 0u);
    uint s = w[2] == d && w[0] > d ? 0u : w[0] == d && w[1] > d ? 1u : 2u;
    return uvec3((s == 0u ? w[1] : s == 1u ? w[2] : w[0]) - d, 3u * d, s);
}
