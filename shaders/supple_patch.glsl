// Evaluating patches while drawing, for hosts: with SUPPLE_GROUP_DIRECT a vertex or mesh shader makes its vertices of patch
// coefficients, and none are stored. Positions have the very bits of stored vertices. docs/direct.md says when that pays.
//
// One draw a SuppleDrawRange, as supple_surface.glsl has it, with the range's SupplePatchRange (supple_direct.h):
//
//     #define SUPPLE_SURFACE_SET 1
//     #define SUPPLE_PATCH_SET 1
//     #include "supple_patch.glsl" // and with it supple_surface.glsl and supple_patch_layout.h, which lie beside it
//     layout(push_constant) uniform Push { SupplePatchRange range; };
//
//     void main() {
//         SuppleRange drawn = suppleRangeOf(range);
//         SuppleVertex at = suppleVertex(drawn, gl_InstanceIndex, gl_VertexIndex); // slot, and the index of attributes
//         SuppleSample s = suppleEvaluate(range, suppleDrawnPatch(drawn, 0u, gl_InstanceIndex), at.slot, gl_VertexIndex);
//         vec3 position = s.position, normal = s.normal;
//         vec2 uv = suppleUv(at); // with SUPPLE_GROUP_ATTRIBUTES
//     }
//
// Bind SuppleDirectOutput.tables and .coefficients at SUPPLE_PATCH_TABLES_BINDING and SUPPLE_COEFFICIENTS_BINDING as storage
// buffers; or, with SUPPLE_PATCH_TEXELS defined, as uniform texel buffers of R32G32B32A32_UINT and R32G32B32A32_SFLOAT, which CPU
// devices read several times as fast. Without SUPPLE_PATCH_SET nothing is declared. Then the shader defines, before the include,
//
//     uvec4 suppleTableElement(uint i);
//     vec3 suppleCoefficient(uint i); // the first three floats
//
// If a pipeline draws patches of one class alone, let SUPPLE_PATCH_CLASS be its number, a constant: the code of other classes is left
// out. Mesh shaders call the same function, for every sample of a patch's grid (SuppleDomain says how they are numbered).
// SUPPLE_GROUP_WINDOWS: write the window's first slot into range.firstSlot, and bind its part of the coefficients from the byte
// firstSlot * coefficientsPerInstance * 16 on.
//
// What feeds a position is `precise` here. Let no tool take that away: the pass loop-unroll of spirv-opt does, so there are no loops.
#ifndef SUPPLE_PATCH_GLSL
#define SUPPLE_PATCH_GLSL

#include "supple_patch_layout.h"
#include "supple_surface.glsl"

/// supple_direct.h
struct SupplePatchRange {
    uint patchClass;
    uint firstRecord;
    uint recordElements;
    uint tangents;
    uint faces;
    uint coefficientsPerInstance;
    uint rate;
    uint firstPair;
    uint patchCount;
    uint firstVertex;
    uint samplesPerPatch;
    uint firstSlot;
};

/// A sample of a patch. The normal is a unit vector that points outwards, or zero where the derivatives vanish. The derivatives are
/// those in the two parameters of the patch; of P_m patches along the side of the sample's sector, and from its first corner to the
/// centre of the patch. In polar patches du lacks the factor 1 - v, with which it would vanish at the apex.
struct SuppleSample {
    vec3 position, du, dv, normal;
};

/// SupplePatchClass
const uint SUPPLE_CLASS_PERTURBED = 1u, SUPPLE_CLASS_POLAR = 2u, SUPPLE_CLASS_P3 = 3u, SUPPLE_CLASS_P4 = 4u, SUPPLE_CLASS_P5 = 5u;

#ifdef SUPPLE_PATCH_SET
#ifndef SUPPLE_PATCH_TABLES_BINDING
#define SUPPLE_PATCH_TABLES_BINDING 6
#endif
#ifndef SUPPLE_COEFFICIENTS_BINDING
#define SUPPLE_COEFFICIENTS_BINDING 7
#endif
#ifdef SUPPLE_PATCH_TEXELS
layout(set = SUPPLE_PATCH_SET, binding = SUPPLE_PATCH_TABLES_BINDING) uniform usamplerBuffer supplePatchTables;
layout(set = SUPPLE_PATCH_SET, binding = SUPPLE_COEFFICIENTS_BINDING) uniform samplerBuffer suppleCoefficients;
uvec4 suppleTableElement(uint i) { return texelFetch(supplePatchTables, int(i)); }
vec3 suppleCoefficient(uint i) { return texelFetch(suppleCoefficients, int(i)).xyz; }
#else
layout(set = SUPPLE_PATCH_SET, binding = SUPPLE_PATCH_TABLES_BINDING, std430) readonly buffer SupplePatchTables {
    uvec4 supplePatchTables[];
};
layout(set = SUPPLE_PATCH_SET, binding = SUPPLE_COEFFICIENTS_BINDING, std430) readonly buffer SuppleCoefficients {
    vec4 suppleCoefficients[];
};
uvec4 suppleTableElement(uint i) { return supplePatchTables[i]; }
vec3 suppleCoefficient(uint i) { return suppleCoefficients[i].xyz; }
#endif
#endif

/// For the functions of supple_surface.glsl. There are no stored vertices, so SuppleVertex.index and .previous mean nothing.
SuppleRange suppleRangeOf(SupplePatchRange r) {
    return SuppleRange(r.patchCount, r.firstVertex, r.samplesPerPatch, 0u, r.firstSlot, 0u);
}

// What follows is evaluation as docs/prep.md and docs/pm.md have it, of one sample. Positions on borders come from the border's
// coefficients alone, by sums that are symmetric under reversal. Inside, and for derivatives, offsets are summed up, as they keep
// their digits far from the origin. Where a sum feeds a position, its order counts.

uint suppleTableWord(uint i) { return suppleTableElement(i / 4u)[i % 4u]; }
/// (k / rate, (rate - k) / rate), correctly rounded.
vec2 suppleParameters(SupplePatchRange r, uint k) {
    uint pair = r.firstPair + k;
    uvec4 two = suppleTableElement(pair / 2u);
    return uintBitsToFloat((pair & 1u) == 0u ? two.xy : two.zw);
}
vec3 suppleAdd(vec3 a, vec3 b) {
    precise vec3 r = a + b;
    return r;
}
vec3 suppleSubtract(vec3 a, vec3 b) {
    precise vec3 r = a - b;
    return r;
}
vec3 suppleChosen(bool first, vec3 a, vec3 b) { return mix(b, a, bvec3(first)); }

vec4 suppleBernstein3(vec2 pair) {
    precise float t = pair.x, s = pair.y;
    precise float tt = t * t, ss = s * s;
    precise vec4 b = vec4(ss * s, 3.0 * (t * ss), 3.0 * (s * tt), tt * t);
    return b;
}
vec3 suppleSlopes3(vec2 pair) { return vec3(3.0 * (pair.y * pair.y), 6.0 * (pair.x * pair.y), 3.0 * (pair.x * pair.x)); }
// Degree 5: B0, B1, B4, B5, and B2, B3.
vec4 suppleOuter5(vec2 pair) {
    precise float t = pair.x, s = pair.y;
    precise float tt = t * t, ss = s * s;
    precise float t4 = tt * tt, s4 = ss * ss;
    precise vec4 outer = vec4(s4 * s, 5.0 * (t * s4), 5.0 * (s * t4), t4 * t);
    return outer;
}
vec2 suppleInner5(vec2 pair) {
    precise float t = pair.x, s = pair.y;
    precise float tt = t * t, ss = s * s;
    precise float t3 = tt * t, s3 = ss * s;
    precise vec2 inner = vec2(10.0 * (tt * s3), 10.0 * (ss * t3));
    return inner;
}
void suppleSlopes5(vec2 pair, out vec4 outer, out vec2 inner) {
    float t = pair.x, s = pair.y, tt = t * t, ss = s * s;
    float a = ss * ss, b = 4.0 * (t * (ss * s)), c = 6.0 * (tt * ss), d = 4.0 * (s * (tt * t)), e = tt * tt;
    outer = 5.0 * vec4(-a, a - b, d - e, e);
    inner = 5.0 * vec2(b - c, c - d);
}

vec3 suppleSum4(vec4 w, vec3 a, vec3 b, vec3 c, vec3 d) {
    precise vec3 r = (w.x * a + w.w * d) + (w.y * b + w.z * c);
    return r;
}
vec3 suppleSum2(vec2 w, vec3 a, vec3 b) {
    precise vec3 r = w.x * a + w.y * b;
    return r;
}
vec3 suppleBlend4(vec4 w, vec3 a, vec3 b, vec3 c, vec3 d) { return w.x * a + w.y * b + w.z * c + w.w * d; }
vec3 suppleBlend3(vec3 w, vec3 a, vec3 b, vec3 c) { return w.x * a + w.y * b + w.z * c; }
vec3 suppleBlend2(vec2 w, vec3 a, vec3 b) { return w.x * a + w.y * b; }

/// A unit vector along one of any length; zero stays zero.
vec3 suppleUnit(vec3 v) {
    uint exponent = floatBitsToUint(max(max(abs(v.x), abs(v.y)), abs(v.z))) >> 23u;
    vec3 n = v * uintBitsToFloat((254u - clamp(exponent, 1u, 253u)) << 23u);
    return n * inversesqrt(max(dot(n, n), 1e-37));
}

// A bicubic patch: of its corners, in their order round the patch, the limit point, and the offsets to the coefficients towards the
// next corner, towards the last one, and of the face.
struct SuppleCorner {
    vec3 point, next, last, face;
};
SuppleCorner suppleCorner(SupplePatchRange r, uint base, uint point, uint spoke) {
    uint tangents = base + r.tangents;
    return SuppleCorner(suppleCoefficient(base + point), suppleCoefficient(tangents + SUPPLE_SPOKE(spoke)),
                        suppleCoefficient(tangents + SUPPLE_NEXT_SPOKE(spoke)),
                        suppleCoefficient(base + r.faces + SUPPLE_SPOKE(spoke)));
}

// A column of coefficients at v: its point; what its offsets add to its corners; its slope.
struct SuppleColumn {
    vec3 point, offset, slope;
};
struct SuppleColumnWeights {
    vec4 b;
    vec3 slopes;
    vec3 polar; // of the first three rows: derivatives in u without the factor 1 - v. Only if isPolar
    bool isPolar;
};
SuppleColumn suppleBorderColumn(SuppleColumnWeights w, vec3 lower, vec3 upper, vec3 o1, vec3 o2, vec3 side) {
    SuppleColumn c;
    c.point = suppleSum4(w.b, lower, suppleAdd(lower, o1), suppleAdd(upper, o2), upper);
    c.offset = w.isPolar ? w.polar.y * o1 + w.polar.z * o2 : w.b.y * o1 + w.b.z * o2;
    c.slope = w.slopes.y * side + (w.slopes.x - w.slopes.y) * o1 + (w.slopes.y - w.slopes.z) * o2;
    return c;
}
vec3 suppleOffset4(vec4 b, vec3 o0, vec3 o1, vec3 o2, vec3 o3) {
    precise vec3 offset = fma(vec3(b.y), o1, b.x * o0);
    offset = fma(vec3(b.z), o2, offset);
    offset = fma(vec3(b.w), o3, offset);
    return offset;
}
vec3 suppleFirstSide(vec4 b, vec3 side) {
    precise float w = b.z + b.w;
    precise vec3 r = w * side;
    return r;
}
vec3 suppleSecondSide(vec4 b, vec3 side, vec3 fromFirst) {
    precise float w = b.z + b.w;
    precise vec3 r = fma(vec3(w), side, fromFirst);
    return r;
}
// `corners`: by one of the two functions above, from `first`. The point is right inside the patch alone.
SuppleColumn suppleInnerColumn(SuppleColumnWeights w, vec3 first, vec3 corners, vec3 o0, vec3 o1, vec3 o2, vec3 o3, vec3 side) {
    SuppleColumn c;
    vec3 offset = suppleOffset4(w.b, o0, o1, o2, o3);
    c.point = suppleAdd(first, suppleAdd(corners, offset));
    c.offset = w.isPolar ? suppleBlend3(w.polar, o0, o1, o2) : offset;
    c.slope = w.slopes.y * side + (w.slopes.x - w.slopes.y) * o1 + (w.slopes.y - w.slopes.z) * o2 + w.slopes.z * o3 -
              w.slopes.x * o0;
    return c;
}

// The point of a row that lies inside: halves that mirrored samples share.
vec3 suppleInsideRow(vec4 b, vec3 g0, vec3 g1, vec3 g2, vec3 g3) {
    precise vec2 even = 0.5 * vec2(b.x + b.w, b.y + b.z), odd = 0.5 * vec2(b.w - b.x, b.z - b.y);
    precise vec3 e0 = g0 + g3, e1 = g1 + g2, o0 = g3 - g0, o1 = g2 - g1;
    precise vec3 e = fma(vec3(even.x), e0, even.y * e1);
    precise vec3 o = fma(vec3(odd.x), o0, odd.y * o1);
    precise vec3 p = e + o;
    return p;
}

// p-rep: the perturbation of degree 5, which is added last.
void supplePerturb(uint base, uvec4 sides, vec2 u, vec2 v, inout SuppleSample s) {
#define SUPPLE_SIDE_COEFFICIENT(k)                                                                                               \
    suppleCoefficient(base + SUPPLE_PREP_EDGE_INDEX(sides[SUPPLE_PREP_FACE_EDGE(k) / 4u], SUPPLE_PREP_FACE_EDGE(k) % 4u))
    vec3 h0 = SUPPLE_SIDE_COEFFICIENT(0u), h1 = SUPPLE_SIDE_COEFFICIENT(1u), h2 = SUPPLE_SIDE_COEFFICIENT(2u),
         h3 = SUPPLE_SIDE_COEFFICIENT(3u), h4 = SUPPLE_SIDE_COEFFICIENT(4u), h5 = SUPPLE_SIDE_COEFFICIENT(5u),
         h6 = SUPPLE_SIDE_COEFFICIENT(6u), h7 = SUPPLE_SIDE_COEFFICIENT(7u), h8 = SUPPLE_SIDE_COEFFICIENT(8u),
         h9 = SUPPLE_SIDE_COEFFICIENT(9u), h10 = SUPPLE_SIDE_COEFFICIENT(10u), h11 = SUPPLE_SIDE_COEFFICIENT(11u),
         h12 = SUPPLE_SIDE_COEFFICIENT(12u), h13 = SUPPLE_SIDE_COEFFICIENT(13u), h14 = SUPPLE_SIDE_COEFFICIENT(14u),
         h15 = SUPPLE_SIDE_COEFFICIENT(15u);
#undef SUPPLE_SIDE_COEFFICIENT
    vec4 outerU = suppleOuter5(u), outerV = suppleOuter5(v), outerDu, outerDv;
    vec2 innerU = suppleInner5(u), innerV = suppleInner5(v), innerDu, innerDv;
    suppleSlopes5(u, outerDu, innerDu);
    suppleSlopes5(v, outerDv, innerDv);
    vec3 inner2 = suppleSum4(outerV, h0, h1, h2, h3), inner3 = suppleSum4(outerV, h4, h5, h6, h7);
    vec3 outer0 = suppleSum2(innerV, h8, h9), outer1 = suppleSum2(innerV, h10, h11), outer4 = suppleSum2(innerV, h12, h13),
         outer5 = suppleSum2(innerV, h14, h15);
    precise vec3 h = suppleSum2(innerU, inner2, inner3) + suppleSum4(outerU, outer0, outer1, outer4, outer5);
    s.position = suppleAdd(s.position, h);
    s.du += suppleBlend2(innerDu, inner2, inner3) + suppleBlend4(outerDu, outer0, outer1, outer4, outer5);
    s.dv += suppleBlend2(innerU, suppleBlend4(outerDv, h0, h1, h2, h3), suppleBlend4(outerDv, h4, h5, h6, h7)) +
            suppleBlend4(outerU, suppleBlend2(innerDv, h8, h9), suppleBlend2(innerDv, h10, h11), suppleBlend2(innerDv, h12, h13),
                         suppleBlend2(innerDv, h14, h15));
}

SuppleSample suppleBicubic(SupplePatchRange r, uint patchClass, uint record, uint base, uint index) {
    bool isPolar = patchClass == SUPPLE_CLASS_POLAR;
    uint side = r.rate + 1u, j = index / side, i = index - j * side;
    vec2 u = suppleParameters(r, i), v = suppleParameters(r, j);
    uvec4 points = suppleTableElement(record), spokes = suppleTableElement(record + 1u);
    SuppleCorner c0 = suppleCorner(r, base, points.x, spokes.x), c1 = suppleCorner(r, base, points.y, spokes.y),
                 c2 = suppleCorner(r, base, points.z, spokes.z), c3;
    if (isPolar) { // all of the row v = 1 is the apex
        c3 = SuppleCorner(c2.point, c2.next, vec3(0.0), suppleCoefficient(base + points.w));
        c2 = SuppleCorner(c2.point, vec3(0.0), c2.last, suppleCoefficient(base + points.w + 1u));
    } else {
        c3 = suppleCorner(r, base, points.w, spokes.w);
    }
    vec3 left = suppleSubtract(c3.point, c0.point), right = suppleSubtract(c2.point, c1.point),
         bottom = suppleSubtract(c1.point, c0.point);
    vec3 polar = vec3(v.y * v.y, 3.0 * (v.x * v.y), 3.0 * (v.x * v.x));
    SuppleColumnWeights w = SuppleColumnWeights(suppleBernstein3(v), suppleSlopes3(v), polar, isPolar);
    // Columns 0 and 1 have their corners in common, and so have 2 and 3.
    vec3 firstCorners = suppleFirstSide(w.b, left), secondCorners = suppleSecondSide(w.b, right, bottom);
    SuppleColumn g0 = suppleBorderColumn(w, c0.point, c3.point, c0.last, c3.next, left);
    SuppleColumn g1 = suppleInnerColumn(w, c0.point, firstCorners, c0.next, c0.face, c3.face, c3.last, left);
    SuppleColumn g2 = suppleInnerColumn(w, c0.point, secondCorners, c1.last, c1.face, c2.face, c2.next, right);
    SuppleColumn g3 = suppleBorderColumn(w, c1.point, c2.point, c1.next, c2.last, right);

    vec4 b = suppleBernstein3(u);
    bool isFirst = i == 0u, isLow = j == 0u, onSide = isFirst || i == r.rate, onRow = isLow || j == r.rate;
    vec3 from = suppleChosen(isLow, c0.point, c3.point), to = suppleChosen(isLow, c1.point, c2.point);
    vec3 row = suppleSum4(b, from, suppleAdd(from, suppleChosen(isLow, c0.next, c3.last)),
                          suppleAdd(to, suppleChosen(isLow, c1.last, c2.next)), to);
    if (isPolar && !isLow) row = c2.point;
    SuppleSample s;
    s.position = suppleChosen(onRow, row,
                              suppleChosen(onSide, suppleChosen(isFirst, g0.point, g3.point),
                                           suppleInsideRow(b, g0.point, g1.point, g2.point, g3.point)));
    vec3 apart = isPolar ? (polar.x + polar.y) * bottom : secondCorners - firstCorners;
    s.du = suppleBlend3(suppleSlopes3(u), g1.offset - g0.offset, apart + (g2.offset - g1.offset), g3.offset - g2.offset);
    s.dv = suppleBlend4(b, g0.slope, g1.slope, g2.slope, g3.slope);
    if (patchClass == SUPPLE_CLASS_PERTURBED) supplePerturb(base, suppleTableElement(record + 2u), u, v, s);
    s.normal = cross(s.du, s.dv);
    uint own = patchClass == SUPPLE_CLASS_PERTURBED ? SUPPLE_PERTURBED_RECORD_ELEMENTS : SUPPLE_BICUBIC_RECORD_ELEMENTS;
    if (r.recordElements > own && onSide && onRow) {
        uvec4 normals = suppleTableElement(record + own);
        uint normal = isLow ? (isFirst ? normals.x : normals.y) : (isFirst ? normals.w : normals.z);
        if (normal != SUPPLE_NO_NORMAL) s.normal = suppleCoefficient(base + normal);
    }
    s.normal = suppleUnit(s.normal);
    return s;
}

// A P_m patch: what a side brings to the sectors beside it: its first corner, the tangents along it, what lies behind it.
struct SuppleSide {
    vec3 v, t0, t1, o211, o121, p112;
};
SuppleSide suppleSide(SupplePatchRange r, uint sides, uint record, uint base, uint inner, uint i) {
    uint next = i + 1u == sides ? 0u : i + 1u, at = inner + 1u + 3u * i, tangents = base + r.tangents;
    uint point = suppleTableWord(4u * record + SUPPLE_PM_POINT_WORD(i));
    uint spoke = suppleTableWord(4u * record + SUPPLE_PM_SPOKE_WORD(i));
    uint nextSpoke = suppleTableWord(4u * record + SUPPLE_PM_SPOKE_WORD(next));
    return SuppleSide(suppleCoefficient(base + SUPPLE_POINT(point)), suppleCoefficient(tangents + SUPPLE_SPOKE(spoke)),
                      suppleCoefficient(tangents + SUPPLE_NEXT_SPOKE(nextSpoke)), suppleCoefficient(at), suppleCoefficient(at + 1u),
                      suppleCoefficient(at + 2u));
}
vec3 suppleRayPoint(vec2 ray, vec3 own, vec3 after, vec3 before) {
    precise vec3 p = ray.x * own + ray.y * (after + before);
    return p;
}
// A sum over the even and the odd halves of a cubic. The last even one of those towards the centre is left out: it is zero.
vec3 suppleEvenHalves(vec4 w, vec2 v, vec3 a, vec3 b, vec3 c, vec3 d, vec3 e, vec3 f) {
    precise vec3 r = w.x * a;
    r = fma(vec3(w.y), b, r);
    r = fma(vec3(w.z), c, r);
    r = fma(vec3(w.w), d, r);
    r = fma(vec3(v.x), e, r);
    r = fma(vec3(v.y), f, r);
    return r;
}
vec3 suppleEvenHalvesInwards(vec4 w, float v, vec3 a, vec3 b, vec3 c, vec3 d, vec3 e) {
    precise vec3 r = w.x * a;
    r = fma(vec3(w.y), b, r);
    r = fma(vec3(w.z), c, r);
    r = fma(vec3(w.w), d, r);
    r = fma(vec3(v), e, r);
    return r;
}
vec3 suppleOddHalves(vec4 w, vec3 a, vec3 b, vec3 c, vec3 d) {
    precise vec3 r = w.x * a;
    r = fma(vec3(w.y), b, r);
    r = fma(vec3(w.z), c, r);
    r = fma(vec3(w.w), d, r);
    return r;
}
vec3 suppleSectorPoint(vec3 centre, vec3 w, vec3 sum, vec3 along, vec3 inwards) {
    precise float s = 0.5 * (w.x + w.y), d = 0.5 * (w.y - w.x);
    precise vec3 p = centre + fma(vec3(s), sum, fma(vec3(d), along, w.z * inwards));
    return p;
}
// The sample of a sector, of weights of its corners and the centre.
SuppleSample suppleInsideSector(vec2 ray, vec3 centre, vec3 w, SuppleSide last, SuppleSide own, SuppleSide next) {
    // The 15 coefficients less the centre, as they are mirrored if the corners swap: a, b of the first and of the second corner.
    vec3 a400 = suppleSubtract(own.v, centre), b400 = suppleSubtract(next.v, centre);
    vec3 a211 = suppleAdd(a400, own.o211), b211 = suppleAdd(b400, own.o121);
    precise vec3 a310 = a400 + 0.75 * own.t0, b310 = b400 + 0.75 * own.t1;
    precise vec3 last310 = a400 + 0.75 * last.t1, next310 = b400 + 0.75 * next.t0;
    precise vec3 middle = ((a400 + own.t0) + (b400 + own.t1)) * 0.5;
    vec3 a301 = suppleRayPoint(ray, a400, a310, last310), b301 = suppleRayPoint(ray, b400, next310, b310);
    vec3 a202 = suppleRayPoint(ray, a301, a211, suppleAdd(a400, last.o121)),
         b202 = suppleRayPoint(ray, b301, suppleAdd(b400, next.o211), b211);
    vec3 a103 = suppleRayPoint(ray, a202, own.p112, last.p112), b103 = suppleRayPoint(ray, b202, next.p112, own.p112);

    precise vec3 e0 = a400 + b400, e1 = a310 + b310, e2 = a301 + b301, e3 = a211 + b211, e4 = a202 + b202, e5 = a103 + b103;
    precise vec3 o0 = b400 - a400, o1 = b310 - a310, o2 = b301 - a301, o3 = b211 - a211, o4 = b202 - a202, o5 = b103 - a103;
    precise vec3 middles = middle + middle, behind = own.p112 + own.p112;
    precise vec3 s0 = e0 + e1, s1 = e1 + middles, s2 = e2 + e3, s3 = e4 + behind, s4 = o0 + o1, s5 = o2 + o3;
    precise vec3 d0 = o0 - o1, d1 = o2 - o3, d2 = e0 - e1, d3 = e1 - middles, d4 = e2 - e3, d5 = e4 - behind;

    precise float x = w.x, y = w.y, z = w.z;
    precise float xx = x * x, yy = y * y, s = x + y, d = y - x;
    precise float xy = 1.5 * (x * y), near = 1.5 * z, far = 1.5 * (z * z);
    precise vec4 even = vec4(0.5 * (xx * x + yy * y), xy * s, near * (xx + yy), far * s);
    precise vec2 centred = vec2(4.0 * (xy * z), (z * z) * z);
    precise vec4 odd = vec4(0.5 * (yy * y - xx * x), xy * d, near * (yy - xx), far * d);
    vec3 sum = suppleAdd(suppleEvenHalves(even, centred, s0, s1, s2, s3, e3, e5), suppleOddHalves(odd, s4, o1, s5, o4));
    vec3 along = suppleAdd(suppleEvenHalves(even, centred, d0, o1, d1, o4, o3, o5), suppleOddHalves(odd, d2, d3, d4, d5));
    vec3 inwards =
        suppleAdd(suppleEvenHalvesInwards(even, centred.x, e2, e3, e4, e5, own.p112), suppleOddHalves(odd, o2, o3, o4, o5));
    SuppleSample sampled;
    sampled.position = suppleSectorPoint(centre, w, sum, along, inwards);
    sampled.du = 4.0 * along;
    sampled.dv = 4.0 * (inwards - 0.5 * sum + 0.5 * along);
    return sampled;
}

/// (i, j) of a sample in a triangle whose rows have n, n - 1, .. samples. The square root only guesses.
uvec2 suppleTriangleSample(uint n, uint index) {
    float b = float(2u * n + 1u);
    uint j = min(uint(max((b - sqrt(max(b * b - 8.0 * float(index), 0.0))) * 0.5, 0.0)), n - 1u);
    uint first = (j * (2u * n + 1u - j)) / 2u;
    if (first > index) {
        --j;
        first -= n - j;
    } else if (index - first >= n - j) {
        first += n - j;
        ++j;
    }
    return uvec2(index - first, j);
}
/// (k, l, sector) of a sample of a P_m patch: its weights are (rate - k - l, k, l) / rate of the sector's corners and the centre.
/// Points on a ray belong to the sector behind it, and the centre to the first one.
uvec3 suppleSectorSample(uint sides, uint rate, uint index) {
    if (sides == 5u) {
        uint perSector = rate * (rate + 1u) / 2u, sector = index / perSector;
        return sector == 5u ? uvec3(0u, rate, 0u) : uvec3(suppleTriangleSample(rate, index - sector * perSector), sector);
    }
    if (sides == 4u) {
        uint j = index / (rate + 1u), i = index - j * (rate + 1u), d = min(min(i, j), rate - max(i, j));
        if (j == d && (i < rate - d || 2u * d == rate)) return uvec3(i - d, 2u * d, 0u);
        if (i == rate - d && j < rate - d) return uvec3(j - d, 2u * d, 1u);
        if (j == rate - d && i > d) return uvec3(rate - d - i, 2u * d, 2u);
        return uvec3(rate - d - j, 2u * d, 3u);
    }
    uvec2 at = suppleTriangleSample(rate + 1u, index);
    uint first = rate - at.x - at.y, d = min(first, min(at.x, at.y));
    if (3u * d == rate) return uvec3(0u, rate, 0u);
    if (at.y == d && first > d) return uvec3(at.x - d, 3u * d, 0u);
    if (first == d && at.x > d) return uvec3(at.y - d, 3u * d, 1u);
    return uvec3(first - d, 3u * d, 2u);
}

SuppleSample suppleSectors(SupplePatchRange r, uint sides, uint record, uint base, uint index) {
    uvec3 at = suppleSectorSample(sides, r.rate, index);
    uint sector = at.z, before = sector == 0u ? sides - 1u : sector - 1u, behind = sector + 1u == sides ? 0u : sector + 1u;
    uint innerWord = suppleTableWord(4u * record + SUPPLE_PM_INNER_WORD(sides)), inner = base + SUPPLE_INNER(innerWord);
    SuppleSide last = suppleSide(r, sides, record, base, inner, before), own = suppleSide(r, sides, record, base, inner, sector),
               next = suppleSide(r, sides, record, base, inner, behind);
    vec2 along = suppleParameters(r, at.x);
    vec3 w = vec3(suppleParameters(r, r.rate - at.x - at.y).x, along.x, suppleParameters(r, at.y).x);
    bool onBorder = at.y == 0u;
    if (onBorder && at.x == 0u && (SUPPLE_SINGULAR(innerWord) & (1u << sector)) != 0u) {
        const float kStep = SUPPLE_PM_SINGULAR_STEP / 3.0; // the derivatives at the corner are parallel
        w = vec3(1.0 - 2.0 * kStep, kStep, kStep);
    }
    vec2 ray = vec2(SUPPLE_PM_RAY_MIDDLE(sides), SUPPLE_PM_RAY_SIDE(sides));
    SuppleSample s = suppleInsideSector(ray, suppleCoefficient(inner), w, last, own, next);
    vec3 border = suppleSum4(suppleBernstein3(along), own.v, suppleAdd(own.v, own.t0), suppleAdd(next.v, own.t1), next.v);
    s.position = suppleChosen(onBorder, border, s.position);
    s.normal = suppleUnit(cross(s.du, s.dv));
    return s;
}

/// Sample `sampleIndex` (gl_VertexIndex) of a patch of the range, 0 to patchCount - 1 (suppleDrawnPatch with a first patch of 0), of the
/// instance in a slot.
SuppleSample suppleEvaluate(SupplePatchRange range, uint patchInRange, uint slot, uint sampleIndex) {
#ifdef SUPPLE_PATCH_CLASS
    uint patchClass = SUPPLE_PATCH_CLASS;
#else
    uint patchClass = range.patchClass;
#endif
    uint record = range.firstRecord + range.recordElements * patchInRange;
    uint base = (slot - range.firstSlot) * range.coefficientsPerInstance;
    if (patchClass < SUPPLE_CLASS_P3) return suppleBicubic(range, patchClass, record, base, sampleIndex);
    return suppleSectors(range, patchClass, record, base, sampleIndex); // a class's number is that of its sides
}

#endif
