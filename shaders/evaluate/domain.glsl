// Samples of triangles and pentagons by number (surface/grid.h). Quads and polar domains count row by row. Where samples are
// shared, a patch has only those on none of its edges, and counts these.
layout(constant_id = kInteriorConstant) const bool kInterior = false;

/// Samples before row j of a triangle whose rows have n, n - 1, ... samples.
uint rowStart(uint n, uint j) { return j * n - (j * (j + 1u) - 2u * j) / 2u; }

/// (i, j) of sample `index` in a triangle whose rows have n, n - 1, ... samples. The square root only guesses.
uvec2 triangleSample(uint n, uint index) {
    float b = float(2u * n + 1u);
    uint j = uint(max((b - sqrt(max(b * b - 8.0 * float(index), 0.0))) * 0.5, 0.0));
    j = min(j, n - 1u);
    if (rowStart(n, j) > index) --j;
    else if (j + 1u < n && rowStart(n, j + 1u) <= index) ++j;
    return uvec2(index - rowStart(n, j), j);
}

/// (i, j, sector) of a pentagon's sample; its last is the centre, (0, rate) of sector 0.
uvec3 pentagonSample(uint rate, uint index) {
    uint perSector = rate * (rate + 1u) / 2u;
    if (index == 5u * perSector) return uvec3(0u, rate, 0u);
    uint sector = index / perSector;
    return uvec3(triangleSample(rate, index - sector * perSector), sector);
}

/// (i, j, sector) of a patch's sample, which is on no edge where kInterior.
uvec3 gridSample(uint domain, uint rate, uint index) {
    if (domain == kTriangleDomain) {
        if (kInterior) return uvec3(triangleSample(rate - 2u, index) + 1u, 0u);
        return uvec3(triangleSample(rate + 1u, index), 0u);
    }
    if (domain == kPentagonDomain) {
        if (kInterior) return pentagonSample(rate - 1u, index) + uvec3(0u, 1u, 0u);
        return pentagonSample(rate, index);
    }
    uint first = kInterior ? 1u : 0u, side = rate + 1u - 2u * first, j = index / side;
    return uvec3(index - j * side + first, j + first, 0u);
}
