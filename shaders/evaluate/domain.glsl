// Samples of triangles and pentagons by number (surface/grid.h). Quads and polar domains count row by row.

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
