// What a record says of a triangle of a Loop patch, and its leaves (docs/loop.md). Before the include: tables.glsl, frame.glsl,
// net.glsl and
//   vec3 poolPoint(const PatchPlace at, uint i)       of the pool, as motion wants it
#include "shaders/exact/box_spline.glsl"
#include "shaders/exact/chain_level.glsl"

struct Triangle {
    uvec4 corners; // limit points; then flags
    bool irregular;
};
Triangle triangleOf(uint record, bool irregular) { return Triangle(tableElement(record), irregular); }
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

// The chain of a corner.
struct Chain {
    uint windows, points, size; // windows of its sector, 0 where there is none; pool index of the first point of level 2
    uint lastLevel;
};
Chain chainOf(const PatchPlace at, uint corner) {
    uint word = 4u * (at.record + kTriangleChainElement) + corner;
    uint size = tableWord(word + 8u);
    return Chain(tableWord(word + 4u), tableWord(word), size & ((1u << kChainLevelShift) - 1u), size >> kChainLevelShift);
}
vec3 cornerNormal(const PatchPlace at, uint corner) {
    return poolPoint(at, tableWord(4u * (at.record + kTriangleChainElement + 3u) + corner));
}

// A net: the triangle's own, of points of level 1, or that of a level of a chain. Words at `element` from `first` on in the pool.
// A bit a side that is a crease, and a corner that one passes.
struct NetSource {
    uint element, first;
    uint sides, corners;
    vec3 origin;
};
NetSource ownNet(const PatchPlace at, Triangle t) {
    return NetSource(at.record + kTriangleNetElement, 0u, triangleFlags(t, kSharpTriangleSide),
                     triangleFlags(t, kCreasedTriangleCorner), vec3(0.0));
}
NetSource chainNet(const PatchPlace at, Triangle t, Chain chain, uint corner, uint level) {
    uint sides = (hasFlag(t, kSharpTriangleSide, corner) ? 1u : 0u) | (hasFlag(t, kSharpTriangleSide, lastOf(corner)) ? 4u : 0u);
    return NetSource(chain.windows, chain.points + (level - 2u) * chain.size, sides, 0u, poolPoint(at, chain.points - 1u));
}
// Creases at the leaf in a cell.
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
    return Frame(once ? db - da : twice ? -db : da, once ? -da : twice ? da - db : db, normal);
}
