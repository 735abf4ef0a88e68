// Where samples lie at a real-valued level (surface/lod/pattern.h). Counts are integers and a - n is exact, so that a level
// gives the same bits whatever the capacity; samples i and capacity - i have the pair swapped, bit for bit.
struct LodPattern {
    uint full, fresh; // segments of full width, and the one that grows, as bits from the corner on
    float part;       // its width
    float inverse;    // 1 / L
};

LodPattern lodPattern(vec2 level, uint capacityIndex) {
    uint words = kLodPatterns + SUPPLE_LOD_FIRST_WORD(capacityIndex), last = (capacityOf(capacityIndex) - 1u) / 2u;
    uint n = min(uint(level.x), last);
    uint full = lodWord(words + n);
    precise float part = level.x - float(n);
    return LodPattern(full, lodWord(words + min(n + 1u, last)) ^ full, part, level.y);
}

// (t, 1 - t) of sample i. The complement is taken in the near half only: there t <= 1/2.
vec2 lodPair(LodPattern p, uint i, uint capacity) {
    uint low = (1u << min(i, capacity - i)) - 1u;
    precise float x = (float(bitCount(p.full & low)) + SELECT((p.fresh & low) != 0u, p.part, 0.0)) * p.inverse;
    precise float y = 1.0 - x;
    return SELECT2(2u * i <= capacity, vec2(x, y), vec2(y, x));
}
