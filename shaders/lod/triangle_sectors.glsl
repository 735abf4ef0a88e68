// A quartic box spline as three sectors of degree 4, as P_m's triangles have them (docs/loop.md, "On the device"): its samples lie in
// the same rings round its centre. Before the include: shaders/loop/box_spline.glsl and shaders/pm/sector.glsl.

// Bezier coefficients of a leaf, relative to corner 0: that of x^j y^k at 5 k + j, with x and y the weights of corners 1 and 2.
struct TriangleNet {
    vec3 b[25];
};
TriangleNet triangleNet(Leaf l) {
    TriangleNet net;
    [[unroll]] for (uint i = 0u; i < 25u; ++i) net.b[i] = vec3(0.0);
    // x^m y^n is a sum of Bernstein polynomials: C(j, m) C(k, n) m! n! (4 - m - n)! / 4!, for all j >= m and k >= n.
    net.b[0] = l.c00;
    net.b[1] = l.c10 / 4.0, net.b[5] = l.c01 / 4.0;
    net.b[2] = l.c20 / 6.0, net.b[6] = l.c11 / 12.0, net.b[10] = l.c02 / 6.0;
    net.b[3] = l.c30 / 4.0, net.b[7] = l.c21 / 12.0, net.b[11] = l.c12 / 12.0, net.b[15] = l.c03 / 4.0;
    net.b[4] = l.c40, net.b[8] = l.c40 / 2.0, net.b[16] = l.c04 / 2.0, net.b[20] = l.c04;
    // Binomials by Pascal's rule, along x and then along y.
    [[unroll]] for (uint round = 1u; round <= 4u; ++round) {
        [[unroll]] for (uint j = 4u; j >= round; --j) {
            [[unroll]] for (uint k = 0u; k + j <= 4u; ++k) net.b[5u * k + j] += net.b[5u * k + j - 1u];
        }
    }
    [[unroll]] for (uint round = 1u; round <= 4u; ++round) {
        [[unroll]] for (uint k = 4u; k >= round; --k) {
            [[unroll]] for (uint j = 0u; k + j <= 4u; ++j) net.b[5u * k + j] += net.b[5u * k + j - 5u];
        }
    }
    return net;
}
// Seen from the next corner.
TriangleNet turnedOnce(TriangleNet net) {
    TriangleNet turned;
    [[unroll]] for (uint k = 0u; k <= 4u; ++k) {
        [[unroll]] for (uint j = 0u; j + k <= 4u; ++j) turned.b[5u * k + j] = net.b[5u * j + 4u - j - k];
    }
    return turned;
}
// The sector at the side from corner 0 to corner 1. De Casteljau's algorithm at the centre: every round leaves a row of it.
Sector sectorOf(TriangleNet net, vec3 first) {
    const uint kRows[5] = uint[5](0u, 5u, 9u, 12u, 14u);
    Sector s;
    [[unroll]] for (uint round = 0u; round <= 4u; ++round) {
        [[unroll]] for (uint j = 0u; j + round <= 4u; ++j) s.c[kRows[round] + j] = net.b[j];
        [[unroll]] for (uint k = 0u; k + round < 4u; ++k) {
            [[unroll]] for (uint j = 0u; j + k + round < 4u; ++j)
                net.b[5u * k + j] = (net.b[5u * k + j] + net.b[5u * k + j + 1u] + net.b[5u * k + j + 5u]) * (1.0 / 3.0);
        }
    }
    vec3 centre = s.c[14];
    [[unroll]] for (uint i = 0u; i < 15u; ++i) s.c[i] -= centre;
    s.centre = first + centre;
    return s;
}
