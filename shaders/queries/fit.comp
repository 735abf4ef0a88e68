// Boxes of pieces, of their Bezier coefficients: a lane a leaf and instance that has a tree in this turn.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/mapping.glsl"
#include "shaders/queries/queries.glsl"
#include "shaders/queries/piece.glsl"
#include "shaders/queries/tree.glsl"

BUFFER(writeonly, Nodes, kTreeBinding, std430, vec4, nodes)

const float kNoBox = 1e37;

void main() {
    uint id = invocationIndex(), place = id / push.pieceCount, leaf = id - place * push.pieceCount;
    if (place >= treesOfTurn()) return;
    uint number = piece(push.firstLeaf + leaf / 4u)[leaf % 4u];
    uint listed = listedInTree(place);
    Piece own = pieceOf(number, slotOfListed(listed));
    vec3 c[kPieceCoefficients], low, high;
    loadCoefficients(own, c);
    low = c[0];
    high = c[0];
    bool usable = finite(own.first);
    for (uint i = 0u; i < (own.kind == kSquarePiece ? 16u : 15u); ++i) {
        usable = usable && finite(c[i]);
        low = min(low, c[i]);
        high = max(high, c[i]);
    }
    // Hits lie a little beside their rays.
    vec3 lowOfAll, highOfAll;
    loadBox(listed, lowOfAll, highOfAll);
    float beside = 2.0 * toleranceFor(lowOfAll, highOfAll, vec3(0.0));
    // No ray meets what is not finite. Its box is empty, so that the others are found.
    uint at = 2u * (firstNode(place) + push.pieceCount + leaf);
    nodes.at[at] = vec4(usable ? low + own.first - beside : vec3(kNoBox), float(number));
    nodes.at[at + 1u] = vec4(usable ? high + own.first + beside : vec3(-kNoBox), 0.0);
}
