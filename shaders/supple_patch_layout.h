/* The words that patches are evaluated from: what the records of bicubic and P_m patches say of an instance's coefficients. One
 * definition for the library, its kernels and hosts (supple_patch.glsl), so it has macros alone. C++ and GLSL read it.
 *
 * Hosts compile it into their shaders. If a record or the order of coefficients changes, SUPPLE_PATCH_LAYOUT rises, and with it
 * SuppleDirectOutput.layout (supple_direct.h): compare the two when a group is made.
 *
 * The coefficients of an instance, four floats each: limit points; then tangents, from `tangents` on, and face coefficients, from
 * `faces` on: one of either a spoke (an edge, as it is seen from one of its ends). Both are offsets from the limit point of their end.
 *
 * Bicubic records (regular, perturbed, polar), in elements of four words:
 *   0  of corners 0..3 the index of the limit point. Of polar patches, corner 3: the first of two inner coefficients
 *   1  of corners 0..3 the spokes, SUPPLE_SPOKE and SUPPLE_NEXT_SPOKE: the corner's edge to the next corner, and to the last one
 *   2  perturbed patches: of sides 0..3 what SUPPLE_PREP_EDGE_INDEX reads
 *   and behind these, if the group keeps corner normals: of corners 0..3 the index of a normal, or 0xFFFFFFFF
 * P_m records of m sides, in words:
 *   SUPPLE_PM_POINT_WORD(i), SUPPLE_PM_SPOKE_WORD(i)  of corner i, as above; of the first SUPPLE_POINT
 *   SUPPLE_PM_INNER_WORD(m)  SUPPLE_INNER: the index of the centre b004, which b211 b121 b112 of each sector follow; SUPPLE_SINGULAR: a
 *                            bit a corner whose normal is taken a step inside */
#ifndef SUPPLE_PATCH_LAYOUT_H
#define SUPPLE_PATCH_LAYOUT_H

#define SUPPLE_PATCH_LAYOUT 1u

/* Spokes in records of bicubic and P_m patches. Limit points have a bit less: every one has two spokes and more. */
#define SUPPLE_SPOKE_BITS 22u
#define SUPPLE_SPOKE(word) ((word) & ((1u << SUPPLE_SPOKE_BITS) - 1u))
#define SUPPLE_NEXT_SPOKE(word) (SUPPLE_SPOKE(word) + uint(int(word) >> int(SUPPLE_SPOKE_BITS)))
#define SUPPLE_POINT_BITS (SUPPLE_SPOKE_BITS - 1u)
#define SUPPLE_POINT(word) ((word) & ((1u << SUPPLE_POINT_BITS) - 1u))
#define SUPPLE_NO_NORMAL 0xFFFFFFFFu

/* Table elements of a record, without corner normals. */
#define SUPPLE_BICUBIC_RECORD_ELEMENTS 2u
#define SUPPLE_PERTURBED_RECORD_ELEMENTS 3u
#define SUPPLE_PM_RECORD_ELEMENTS(m) ((m)-1u)

/* Perturbed patches: the pool index of the s-th coefficient of a side, local (2,0), (3,0), (2,1), (3,1), s = 0..3. */
#define SUPPLE_PREP_EDGE_MASK 0x3FFFFFFFu
#define SUPPLE_PREP_EDGE_INDEX(word, s) (((word)&SUPPLE_PREP_EDGE_MASK) + ((s) ^ ((word) >> 31)))
/* Evaluation order of the 16 perturbation coefficients (h_2j, h_3j for j = 0, 1, 4, 5; h_i2, h_i3 for i = 0, 1, 4, 5) to 4 side + s:
 * 0, 2, 11, 9, 1, 3, 10, 8, 13, 12, 15, 14, 6, 7, 4, 5: four bits a coefficient. */
#define SUPPLE_PREP_FACE_EDGE(k) (((k) < 8u ? 0x8A319B20u : 0x5476EFCDu) >> 4u * ((k)&7u) & 15u)

/* P_m: words of a record, of corner i and of m corners. */
#define SUPPLE_PM_POINT_WORD(i) ((i) < 4u ? (i) : 8u)
#define SUPPLE_PM_SPOKE_WORD(i) ((i) < 4u ? 4u + (i) : 9u)
#define SUPPLE_PM_INNER_WORD(m) ((m) == 5u ? 10u : (m) == 4u ? 8u : 3u)
#define SUPPLE_INNER_BITS 27u
#define SUPPLE_INNER(word) ((word) & ((1u << SUPPLE_INNER_BITS) - 1u))
#define SUPPLE_SINGULAR(word) ((word) >> SUPPLE_INNER_BITS)

/* P_m: where the derivatives at a corner are parallel, those of so far along the border stand for them. */
#define SUPPLE_PM_SINGULAR_STEP 1e-3
/* P_m: k0 and k1 of (3) in docs/pm.md, for facets of m sides. */
#define SUPPLE_PM_RAY_SIDE(m) ((m) == 5u ? 0.7236067977499790 : (m) == 4u ? 0.5 : 1.0 / 3.0)
#define SUPPLE_PM_RAY_MIDDLE(m) ((m) == 5u ? -0.4472135954999579 : (m) == 4u ? 0.0 : 1.0 / 3.0)

#endif
