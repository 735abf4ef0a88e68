// What a record says of a triangle of a Loop patch, and its leaves (docs/loop.md). Before the include: tables.glsl, frame.glsl,
// net.glsl and what chain_place.glsl and creases.glsl need.
#include "shaders/loop/box_spline.glsl"
#include "shaders/chains/chain_level.glsl"
#include "shaders/chains/chain_place.glsl"
#include "shaders/subdivision/sharpness.glsl"
#include "shaders/loop/creases.glsl"

struct Triangle {
    uvec4 corners; // limit points; then flags
    bool irregular;
    uvec4 chains, netLists, normals; // of an irregular one
    uint first; // what its net counts from
    vec3 sharpness; // of its sides on level 1; of smooth and endless ones 0
};
Triangle triangleOf(uint record, bool irregular) {
    Triangle t;
    t.corners = tableElement(record + kTriangleCornerElement);
    t.irregular = irregular;
    t.chains = t.netLists = t.normals = uvec4(0u);
    t.first = 0u;
    t.sharpness = vec3(0.0);
    if (kSemiSharp) t.sharpness = uintBitsToFloat(tableElement(record + kTriangleSharpnessElement).xyz);
    if (irregular) {
        t.chains = tableElement(record + kTriangleChainElement);
        t.netLists = tableElement(record + kTriangleChainElement + 1u);
        uvec4 end = tableElement(record + kTriangleNetElement + kTriangleNetListElements - 1u);
        t.normals = normalsBefore(t.chains, end.yz);
        t.first = end.w;
    }
    return t;
}
uint triangleFlags(Triangle t, uint first) { return t.corners.w >> first & 7u; }
bool hasFlag(Triangle t, uint first, uint k) { return (t.corners.w >> (first + k) & 1u) != 0u; }
uint nextOf(uint k) { return k == 2u ? 0u : k + 1u; }
uint lastOf(uint k) { return k == 0u ? 2u : k - 1u; }

// The vertices round it.
LeafPoints cageLeaf(const PatchPlace at, Triangle t) {
    LeafPoints leaf;
    [[unroll]] for (uint e = 0u; e < 3u; ++e) {
        uvec4 words = tableElement(at.record + kTriangleCageElement + e);
        [[unroll]] for (uint c = 0u; c < 4u; ++c) leaf.p[4u * e + c] = poolPoint(at, words[c]);
    }
    mirror(leaf, triangleFlags(t, kSharpTriangleSide), triangleFlags(t, kCreasedTriangleCorner));
    return leaf;
}

Chain chainOf(const PatchPlace at, Triangle t, uint corner) {
    return chainOf(at, componentOf(t.netLists, corner), componentOf(t.chains, corner), kTriangleNetListLastWord);
}
vec3 cornerLimit(const PatchPlace at, Triangle t, uint corner) { return poolPoint(at, componentOf(t.corners, corner)); }
Frame withCornerNormal(const PatchPlace at, Triangle t, uint corner, Frame frame) {
    uint normal = componentOf(t.normals, corner);
    if (normal == kNoNormal) return frame;
    return withNormal(frame, poolPoint(at, normal));
}

// A net: the triangle's own, of points of level 1, or that of a level of a chain. `net list`: which points from `first` on.
// A bit a side that is an endless crease, and a corner that one passes. Of its sides also the sharpness, 0 of endless ones.
struct NetSource {
    uint netList, first;
    uint sides, corners;
    vec3 sharpness, origin;
};
NetSource ownNet(const PatchPlace at, Triangle t) {
    return NetSource(at.record + kTriangleNetElement, t.first, triangleFlags(t, kSharpTriangleSide),
                     triangleFlags(t, kCreasedTriangleCorner), t.sharpness, vec3(0.0));
}
NetSource chainNet(const PatchPlace at, Triangle t, Chain chain, uint corner, uint level) {
    uint sides = (hasFlag(t, kSharpTriangleSide, corner) ? 1u : 0u) | (hasFlag(t, kSharpTriangleSide, lastOf(corner)) ? 4u : 0u);
    vec3 sharpness = vec3(0.0);
    if (kSemiSharp) {
        sharpness.x = softened(componentOf3(t.sharpness, corner), level - 1u);
        sharpness.z = softened(componentOf3(t.sharpness, lastOf(corner)), level - 1u);
    }
    return NetSource(chain.netLists, levelPoints(chain, level), sides, 0u, sharpness, chainOrigin(at, chain));
}
// The points of the leaf in a cell, by their numbers in the net.
const uint kCellPoints[4][12] = uint[4][12](uint[12](0u, 3u, 5u, 6u, 1u, 11u, 9u, 4u, 14u, 12u, 2u, 17u),
                                            uint[12](3u, 1u, 4u, 9u, 7u, 2u, 12u, 10u, 5u, 15u, 13u, 0u),
                                            uint[12](5u, 4u, 2u, 0u, 10u, 8u, 3u, 13u, 11u, 1u, 16u, 14u),
                                            uint[12](4u, 5u, 3u, 13u, 14u, 12u, 2u, 0u, 1u, 11u, 9u, 10u));
// Which of four, one a cell: for arrays in registers, which lanes cannot index.
#define OF_CELL(SELECTION, cell, a, k)                                                                                           \
    SELECTION((cell) < 2u, SELECTION((cell) == 0u, a[kCellPoints[0][k]], a[kCellPoints[1][k]]),                                  \
              SELECTION((cell) == 2u, a[kCellPoints[2][k]], a[kCellPoints[3][k]]))
// Where the points of a net lie in the pool.
uint[kTriangleNetPoints] netIndices(NetSource net) {
    uint indices[kTriangleNetPoints];
    [[unroll]] for (uint e = 0u; e < kTriangleNetListElements; ++e) {
        uvec4 words = tableElement(net.netList + e);
        [[unroll]] for (uint c = 0u; c < 8u; ++c) {
            uint k = 8u * e + c, word = words[c / 2u];
            if (k < kTriangleNetPoints) indices[k] = net.first + halfOf(word, c);
        }
    }
    return indices;
}
// Endless creases at the leaf in a cell.
void mirrorInCell(inout LeafPoints leaf, NetSource net, uint cell) {
    uint own = 1u << cell, beside = 1u << cell | 1u << lastOf(cell);
    bool middle = cell == kMiddleCell;
    // Corner v of the leaf in the middle is that of side v + 1.
    uint passing = (net.sides >> 1u | net.sides << 2u) & 7u;
    mirror(leaf, middle ? 0u : net.sides & beside, middle ? passing : net.corners & own);
}

// The derivatives along the two edges from corner `from`, along those from corner `to`; the normal is the same.
Frame seenFrom(uint from, uint to, vec3 da, vec3 db) {
    bool once = to == nextOf(from), twice = to == lastOf(from);
    vec3 normal = cross(da, db);
    return Frame(SELECT3(once, db - da, SELECT3(twice, -db, da)), SELECT3(once, -da, SELECT3(twice, da - db, db)), normal);
}
