// Nets of irregular quads, and rows of samples (docs/catmull_clark.md): a net collapsed at one distance from an edge. Before the
// include, what quad.glsl needs, and
//   uint last                                         number of the last sample along a side
#include "shaders/catmull_clark/quad.glsl"

// Where the points of a net lie in the pool. `netList`: which points from `first` on.
struct NetIndices {
    uint of[kNetPoints];
};
NetIndices netIndices(uint netList, uint first) {
    NetIndices net;
    [[unroll]] for (uint e = 0u; e < kNetListElements; ++e) {
        uvec4 words = tableElement(netList + e);
        [[unroll]] for (uint c = 0u; c < 8u; ++c) {
            uint k = 8u * e + c;
            if (k < kNetPoints) net.of[k] = first + halfOf(words[c / 2u], c);
        }
    }
    return net;
}

// All columns of a net at one y, in the lower or the upper cells; from the net's middle.
struct NetRow {
    vec3 point[kNetSide], slope[kNetSide];
};
// The columns of the left or the right cells.
struct CellRow {
    vec3 point[4], slope[4];
};
CellRow cellRow(NetRow row, bool right) {
    CellRow cell;
    [[unroll]] for (uint k = 0u; k < 4u; ++k) {
        cell.point[k] = SELECT3(right, row.point[k + 1u], row.point[k]);
        cell.slope[k] = SELECT3(right, row.slope[k + 1u], row.slope[k]);
    }
    return cell;
}
vec3 rowPoint(CellRow row, vec4 w) { return sumInside(w, row.point[0], row.point[1], row.point[2], row.point[3]); }
vec3 rowAlongX(CellRow row, vec4 d) { return blend4(d, row.point[0], row.point[1], row.point[2], row.point[3]); }
vec3 rowAlongY(CellRow row, vec4 w) { return blend4(w, row.slope[0], row.slope[1], row.slope[2], row.slope[3]); }
vec3 rowAlongX(NetRow row, bool right, vec4 d) { return rowAlongX(cellRow(row, right), d); }
vec3 rowAlongY(NetRow row, bool right, vec4 w) { return rowAlongY(cellRow(row, right), w); }

// Sample (a, b) of a quarter, counted from its corner along its two edges.
uvec2 placeInQuad(uint corner, uint a, uint b) {
    uint x = (corner & 1u) == 0u ? a : b, y = (corner & 1u) == 0u ? b : a;
    return uvec2(SELECT(isRight(corner), last - x, x), SELECT(isUpper(corner), last - y, y));
}
