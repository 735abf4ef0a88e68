// Quartic box splines over a triangle of a regular lattice (docs/loop.md): what a leaf of a Loop patch is.
//
// A leaf has 12 points: those of the triangle and all round it. In lattice steps (a, b) along the directions to corners 1 and 2:
//   0..2    the corners            (0, 0) (1, 0) (0, 1)
//   3..5    beside side r, first   (0,-1) (2, 0) (-1, 2)
//   6..8    opposite side r        (1,-1) (1, 1) (-1, 1)
//   9..11   beside side r, last    (2,-1) (0, 2) (-1, 0)
// Side r runs from corner r to the next one, and r counts from 0 to 2 in each row. Seen from the next corner, every row moves on
// by one.

#include "shaders/chains/offset.glsl"

struct LeafPoints {
    vec3 p[12];
};

// The fourth point of a parallelogram.
vec3 completed(vec3 a, vec3 b, vec3 across) {
    precise vec3 p = a + b - across;
    return p;
}
// What lies across an endless crease is the mirror image of what lies on this side: it completes a parallelogram. A bit a leaf
// side that is a crease, and a bit a corner that a crease passes outside of the leaf.
void mirror(inout LeafPoints leaf, uint sides, uint corners) {
    if ((sides | corners) == 0u) return;
    [[unroll]] for (uint r = 0u; r < 3u; ++r) {
        const uint next = (r + 1u) % 3u, last = (r + 2u) % 3u;
        vec3 first = completed(leaf.p[9u + last], leaf.p[r], leaf.p[6u + last]);
        vec3 opposite = completed(leaf.p[r], leaf.p[next], leaf.p[last]);
        vec3 end = completed(leaf.p[next], leaf.p[3u + next], leaf.p[6u + next]);
        bool onSide = (sides >> r & 1u) != 0u;
        leaf.p[3u + r] = SELECT3(onSide, first, leaf.p[3u + r]);
        leaf.p[6u + r] = SELECT3(onSide, opposite, leaf.p[6u + r]);
        leaf.p[9u + r] = SELECT3(onSide, end, leaf.p[9u + r]);
    }
    [[unroll]] for (uint r = 0u; r < 3u; ++r) {
        const uint next = (r + 1u) % 3u, last = (r + 2u) % 3u;
        vec3 before = completed(leaf.p[r], leaf.p[6u + last], leaf.p[last]);
        vec3 behind = completed(leaf.p[r], leaf.p[6u + r], leaf.p[next]);
        bool passes = (corners >> r & 1u) != 0u;
        leaf.p[9u + last] = SELECT3(passes, before, leaf.p[9u + last]);
        leaf.p[3u + r] = SELECT3(passes, behind, leaf.p[3u + r]);
    }
}

// A leaf in powers of the weights x and y of corners 1 and 2: the coefficient of x^m y^n, from corner 0. Those of x^3 y and x y^3
// are twice those of x^4 and y^4, and that of x^2 y^2 is 0.
struct Leaf {
    vec3 first; // corner 0
    vec3 c00, c10, c01, c20, c11, c02, c30, c21, c12, c03, c40, c04;
};
Leaf leafOf(LeafPoints points) {
    vec3 d[12];
    [[unroll]] for (uint k = 1u; k < 12u; ++k) d[k] = offsetFrom(points.p[0], points.p[k]);
    // Round corner 0, counter-clockwise.
    vec3 e1 = d[1], e2 = d[2], e3 = d[8], e4 = d[11], e5 = d[3], e6 = d[6];
    precise vec3 along1 = e1 + e4, along2 = e2 + e5, along3 = e3 + e6;
    precise vec3 c00 = ((along1 + along2) + along3) * (1.0 / 12.0);
    precise vec3 c10 = (2.0 * (e1 - e4) + ((e2 + e6) - (e3 + e5))) * (1.0 / 6.0);
    precise vec3 c01 = (2.0 * (e2 - e5) + ((e1 + e3) - (e4 + e6))) * (1.0 / 6.0);
    precise vec3 c20 = 0.5 * along1, c02 = 0.5 * along2, c11 = 0.5 * ((along1 + along2) - along3);
    precise vec3 low = (e3 + e5) + (d[9] + d[7]), left = (e4 + e6) + (d[5] + d[7]);
    precise vec3 c30 = (low - 2.0 * (along1 + (e2 + e6))) * (1.0 / 6.0), c03 = (left - 2.0 * (along2 + (e1 + e3))) * (1.0 / 6.0);
    precise vec3 c21 = 0.5 * ((e3 + d[7]) - along1) - e2, c12 = 0.5 * ((e6 + d[7]) - along2) - e1;
    precise vec3 c40 = (((e4 + d[4]) - e1) + 2.0 * (e2 + e6) - low) * (1.0 / 12.0);
    precise vec3 c04 = (((e5 + d[10]) - e2) + 2.0 * (e1 + e3) - left) * (1.0 / 12.0);
    return Leaf(points.p[0], c00, c10, c01, c20, c11, c02, c30, c21, c12, c03, c40, c04);
}

// A leaf at one y: the coefficients of x^n, of the offset from corner 0 and of the derivative in y.
struct LeafRow {
    vec3 p[5], slope[4];
};
LeafRow leafRow(Leaf l, float y) {
    LeafRow row;
    precise vec3 p0 = l.c00 + y * (l.c01 + y * (l.c02 + y * (l.c03 + y * l.c04)));
    precise vec3 p1 = l.c10 + y * (l.c11 + y * (l.c12 + (2.0 * y) * l.c04));
    precise vec3 p2 = l.c20 + y * l.c21, p3 = l.c30 + (2.0 * y) * l.c40;
    row.p = vec3[5](p0, p1, p2, p3, l.c40);
    row.slope[0] = l.c01 + y * (2.0 * l.c02 + y * (3.0 * l.c03 + (4.0 * y) * l.c04));
    row.slope[1] = l.c11 + y * (2.0 * l.c12 + (6.0 * y) * l.c04);
    row.slope[2] = l.c21;
    row.slope[3] = 2.0 * l.c40;
    return row;
}
vec3 rowOffset(LeafRow row, float x) {
    precise vec3 p = row.p[0] + x * (row.p[1] + x * (row.p[2] + x * (row.p[3] + x * row.p[4])));
    return p;
}
vec3 rowAlongX(LeafRow row, float x) { return row.p[1] + x * (2.0 * row.p[2] + x * (3.0 * row.p[3] + (4.0 * x) * row.p[4])); }
vec3 rowAlongY(LeafRow row, float x) { return row.slope[0] + x * (row.slope[1] + x * (row.slope[2] + x * row.slope[3])); }

// What a side of a leaf is made of: four points of the line, from one before the side to one behind it, and what lies beside its
// segments, either side of the line added up. Both triangles at the side have the same sums.
struct LeafSide {
    vec3 line[4], beside[3];
};
// Side r, seen from corner r, or with `back` side r - 1, which ends there.
LeafSide leafSide(LeafPoints leaf, uint r, bool back, bool sharp) {
    // Turned so that r is 0.
    vec3 p[12];
    [[unroll]] for (uint k = 0u; k < 12u; ++k) {
        const uint row = k / 3u * 3u, at = k % 3u;
        p[k] = SELECT3(r == 0u, leaf.p[k], SELECT3(r == 1u, leaf.p[row + (at + 1u) % 3u], leaf.p[row + (at + 2u) % 3u]));
    }
    LeafSide side;
    side.line[0] = SELECT3(back, p[3], p[11]);
    side.line[1] = p[0];
    side.line[2] = SELECT3(back, p[2], p[1]);
    side.line[3] = SELECT3(back, p[10], p[4]);
    precise vec3 first = SELECT3(back, p[11], p[3]) + SELECT3(back, p[6], p[8]);
    precise vec3 middle = SELECT3(back, p[8], p[6]) + SELECT3(back, p[1], p[2]), last = SELECT3(back, p[5], p[9]) + p[7];
    // At a crease they are the mirror images of each other.
    precise vec3 ends[3] = vec3[3](side.line[0] + side.line[1], side.line[1] + side.line[2], side.line[2] + side.line[3]);
    side.beside[0] = SELECT3(sharp, ends[0], first);
    side.beside[1] = SELECT3(sharp, ends[1], middle);
    side.beside[2] = SELECT3(sharp, ends[2], last);
    return side;
}
// At a pair (t, 1 - t) from where the side begins. Reversal, and exchanging both sides of the line, change no bit.
vec3 onSide(LeafSide side, vec2 pair) {
    precise float t = pair.x, s = pair.y;
    precise float tt = t * t, ss = s * s, st = s * t;
    precise float t4 = tt * tt, s4 = ss * ss, t3s = tt * st, s3t = ss * st, s2t2 = ss * tt;
    precise float nearLine = (6.0 * s4 + t4) + (24.0 * (s3t + s2t2) + 8.0 * t3s), nearBeside = s4 + 2.0 * s3t;
    precise float farLine = (6.0 * t4 + s4) + (24.0 * (t3s + s2t2) + 8.0 * s3t), farBeside = t4 + 2.0 * t3s;
    precise float middle = (s4 + t4) + (6.0 * (s3t + t3s) + 12.0 * s2t2);
    precise vec3 line = (s4 * side.line[0] + t4 * side.line[3]) + (nearLine * side.line[1] + farLine * side.line[2]);
    precise vec3 p = (line + ((nearBeside * side.beside[0] + farBeside * side.beside[2]) + middle * side.beside[1])) * (1.0 / 12.0);
    return p;
}
// At a point of the lattice, the middle of three on a line.
vec3 onLine(vec3 before, vec3 own, vec3 behind, vec3 firstBeside, vec3 secondBeside) {
    precise vec3 p = (6.0 * own + ((firstBeside + secondBeside) + (before + behind))) * (1.0 / 12.0);
    return p;
}
