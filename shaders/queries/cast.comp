// What many rays meet first: a lane a ray, which goes through the trees of this turn one after the other. It finds what the picks of
// pick.comp find: of equal hits the first lane's, and by the same sums.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/mapping.glsl"
#include "shaders/queries/queries.glsl"
#include "shaders/queries/piece.glsl"
#include "shaders/queries/tree.glsl"

LOADED_BUFFER(vec4, node, Nodes, kTreeBinding, samplerBuffer, kTreeTexelBinding, xyzw)

// Where a ray is among the trees.
struct Walk {
    uint place;   // of the tree
    uint node;
    uint pending; // by level, from the node's up: its sibling is still to be looked at
};
// Goes to the next node that is to be looked at.
void leave(inout Walk walk) {
    uint up = walk.pending != 0u ? uint(findLSB(walk.pending)) : 0u;
    bool isOver = walk.pending == 0u;
    walk.place += isOver ? 1u : 0u;
    walk.node = isOver ? 1u : walk.node >> up ^ 1u;
    walk.pending = walk.pending >> up & ~1u;
}
// Looks at a node. The number of its piece, if it is a leaf that the ray may meet; or kNoPiece.
const uint kNoPiece = 0xFFFFFFFFu;
uint visit(Ray ray, float beside, inout Walk walk) {
    uint at = 2u * (firstNode(walk.place) + walk.node);
    vec4 low = node(at), high = node(at + 1u);
    bool isMet = low.x <= high.x && mayMeet(ray, low.xyz, high.xyz, beside), isLeaf = walk.node >= push.pieceCount;
    if (!isMet || isLeaf) {
        leave(walk);
        return isMet ? uint(low.w) : kNoPiece;
    }
    uint code = uint(low.w);
    bool isSecond = (ray.along[code & kTreeAxis] < 0.0) != ((code & kTreeTurned) != 0u);
    walk.node = 2u * walk.node + (isSecond ? 1u : 0u);
    walk.pending = walk.pending << 1u | 1u;
    return kNoPiece;
}

void main() {
    uint r = invocationIndex();
    if (r >= push.rayCount) return;
    Ray ray = rayOf(r);
    if (!ray.sound) return;
    uint trees = treesOfTurn(), most = 2u * push.pieceCount * trees;
    float beside = toleranceFor(vec3(0.0), vec3(0.0), ray.origin); // boxes have what it comes to without the origin
    uvec2 found = best.at[r];
    Walk walk = Walk(0u, 1u, 0u);
    for (uint steps = 0u; steps < most && walk.place < trees;) {
        // To the next leaf, so that lanes of a CPU device come to their leaves together.
        Ray rest = upTo(ray, found.x);
        uint number = kNoPiece, place = 0u;
        for (; steps < most && walk.place < trees && number == kNoPiece; ++steps) {
            place = walk.place;
            number = visit(rest, beside, walk);
        }
        if (number == kNoPiece) break;
        uint listed = listedInTree(place), lane = push.firstLane + listed * push.pieceCount + number;
        vec3 low, high, c[kPieceCoefficients];
        loadBox(listed, low, high);
        Piece own = pieceOf(number, slotOfListed(listed));
        loadCoefficients(own, c);
        uint t = firstMet(ray, own, c, low, high);
        if (t == kNothingMet) continue;
        if (t < found.x || (t == found.x && lane < found.y)) found = uvec2(t, lane);
    }
    best.at[r] = found;
}
