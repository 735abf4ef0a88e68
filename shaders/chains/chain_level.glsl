// Levels of chains (docs/catmull_clark.md, docs/loop.md).

// 2^n of a small integer.
float powerOfTwo(float n) { return uintBitsToFloat(uint(127 + int(n)) << 23u); }

// At levels of detail samples come as near to a vertex as they like, but chains end. In the last cell at the vertex the surface is
// a cone (docs/catmull_clark.md, (5)): a share of the way from the limit point to the cell's rim. On a border both patches do the same, for they have the same
// vertex, and an instance has one last level.
vec3 onCone(vec3 limit, vec3 rim, float share) {
    precise vec3 p = limit + share * (rim - limit);
    return p;
}

// Where a sample lies among the leaves of a chain.
struct ChainPlace {
    uint level;
    float scale; // from distances to parameters of the net
};
ChainPlace chainPlace(float far, uint lastLevel) {
    uint level = uint(clamp(127 - int(floatBitsToUint(far) >> 23u), 2, int(lastLevel))); // 2^-level <= far < 2^(1 - level)
    return ChainPlace(level, powerOfTwo(float(level)));
}
