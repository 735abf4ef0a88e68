// The corners of bicubic patches, of the pool's coefficients (shared/surface.h).

// Where what a corner is made of lies: its coefficients are 0 itself, 1 towards the next corner, 2 towards the last, 3 of the face.
const uvec4 kCorner0 = uvec4(0u, 1u, 4u, 5u), kCorner1 = uvec4(3u, 7u, 2u, 6u), kCorner2 = uvec4(15u, 14u, 11u, 10u),
            kCorner3 = uvec4(12u, 8u, 13u, 9u);
vec3 netVector(const PatchPlace at, NetRecord net, uint k) { return coefficient(at.base + netIndex(net, kPolar, k), at.isNew); }
// The apex of a polar patch is all of its row v = 1: nothing lies between its two corners there.
Corner loadCorner(const PatchPlace at, NetRecord net, uvec4 k) {
    return Corner(netVector(at, net, k.x), kPolar && cornerOf(k.y) == k.y ? vec3(0.0) : netVector(at, net, k.y),
                  kPolar && cornerOf(k.z) == k.z ? vec3(0.0) : netVector(at, net, k.z), netVector(at, net, k.w));
}
// Where lanes ask for different corners.
Corner loadCorner(const PatchPlace at, NetRecord net, uint corner) {
    if (kPolar)
        return loadCorner(at, net, corner == 0u ? kCorner0 : corner == 1u ? kCorner1 : corner == 2u ? kCorner2 : kCorner3);
    uint spoke = componentOf(net.spokes, corner), tangents = at.base + header.tangents, faces = at.base + header.faces;
    return Corner(coefficient(at.base + componentOf(net.points, corner), at.isNew),
                  coefficient(tangents + SUPPLE_SPOKE(spoke), at.isNew), coefficient(tangents + SUPPLE_NEXT_SPOKE(spoke), at.isNew),
                  coefficient(faces + SUPPLE_SPOKE(spoke), at.isNew));
}
void loadCorners(const PatchPlace at, inout Patch c) {
    NetRecord net = netRecord(at.record);
    c.c0 = loadCorner(at, net, kCorner0);
    c.c1 = loadCorner(at, net, kCorner1);
    c.c2 = loadCorner(at, net, kCorner2);
    c.c3 = loadCorner(at, net, kCorner3);
}
// What of a corner lies in its pool by itself: of a polar patch's last one the point and the coefficient behind it.
Corner storedCorner(const PatchPlace at, uint corner) {
    uint first = 4u * at.record + corner, point = at.base + tableWord(first), spoke = tableWord(first + 4u);
    uint tangents = at.base + header.tangents;
    if (kPolar && corner == 3u) // it has no spoke
        return Corner(coefficient(point, at.isNew), coefficient(point + 1u, at.isNew), vec3(0.0), vec3(0.0));
    return Corner(coefficient(point, at.isNew), coefficient(tangents + SUPPLE_SPOKE(spoke), at.isNew),
                  coefficient(tangents + SUPPLE_NEXT_SPOKE(spoke), at.isNew),
                  coefficient(at.base + header.faces + SUPPLE_SPOKE(spoke), at.isNew));
}
vec3 cornerNormal(uint base, uint slot) { return poolVector(base + slot); }
