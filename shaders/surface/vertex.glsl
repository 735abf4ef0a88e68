// The vertex stage of p-rep and P_m: limit point, tangent points and face coefficients of a fan whose weights depend on
// connectivity alone. Needs tables.glsl, pool.glsl, store.glsl, ring.glsl, and from the scheme
//   vec3 ringDiagonal(uint word, uint cageBase, vec3 p0)   opposite corner of a spoke's facet, relative to p0
// Everything is summed over differences to the vertex: far from the origin that keeps the tangents, and with them the
// normals, several times more exact. The weights of a point sum to 1 and those of a vector to 0, so that the centre's own
// weight never appears.

#include "shaders/surface/face.glsl"

void storeLimit(uint i, vec3 p0, vec3 relative) {
    precise vec3 p = p0 + relative;
    storePool(i, p);
}

// An offset from the limit point, of a point given relative to p0 as the limit point is.
void storeOffset(uint i, vec3 point, vec3 limit) {
    precise vec3 offset = point - limit;
    storePool(i, offset);
}

// What the spokes of a fan add up to: the limit point and the two tangents, relative to p0.
struct Fan {
    vec3 x, e1, e2;
};

// A closed fan of four: the uniform bicubic B-spline. These fans come first, and their ring is all there is of them.
struct RegularFacets {
    uint vertex;
    vec3 p0, e[4], d[4]; // spokes and diagonals, relative to p0
};
RegularFacets regularFacets(uint index, uint cageBase) {
    uvec4 words = tableElement(header.ring / 4u + index);
    uint vertex = ringCorner(words.x, kRingVertex);
    vec3 p0 = meshPoint(cageBase + vertex);
    precise vec3 e[4], d[4];
    for (uint k = 0u; k < 4u; ++k) {
        e[k] = ringSpoke(words[k], cageBase) - p0;
        d[k] = ringDiagonal(words[k], cageBase, p0);
    }
    return RegularFacets(vertex, p0, e, d);
}
Fan fanOfRegular(vec3 e[4], vec3 d[4]) {
    precise vec3 x = (4.0 * ((e[0] + e[2]) + (e[1] + e[3])) + ((d[0] + d[2]) + (d[1] + d[3]))) * (1.0 / 36.0);
    precise vec3 e1 = (4.0 * (e[0] - e[2]) + ((d[0] - d[2]) + (d[3] - d[1]))) * (1.0 / 36.0);
    precise vec3 e2 = (4.0 * (e[1] - e[3]) + ((d[0] - d[2]) + (d[1] - d[3]))) * (1.0 / 36.0);
    return Fan(x, e1, e2);
}
void storeRegular(RegularFacets f, uint index, uint base) {
    Fan fan = fanOfRegular(f.e, f.d);
    uint slot = 4u * index, tangent = base + header.tangents + slot, face = base + header.faces + slot;
    storeLimit(base + f.vertex, f.p0, fan.x);
    storePool(tangent, fan.e1);
    storePool(tangent + 1u, fan.e2);
    storePool(tangent + 2u, -fan.e1);
    storePool(tangent + 3u, -fan.e2);
    for (uint k = 0u; k < 4u; ++k) storeOffset(face + k, faceCoefficient(f.e[k], f.e[(k + 1u) & 3u], f.d[k]), fan.x);
}
void regularFan(uint index, uint base, uint cageBase) { storeRegular(regularFacets(index, cageBase), index, base); }

void addSpoke(inout Fan fan, uint word, uint cageBase, vec3 p0, uint weights) {
    precise vec3 spoke = ringSpoke(word, cageBase) - p0;
    precise vec3 diagonal = ringDiagonal(word, cageBase, p0);
    vec4 a = uintBitsToFloat(tableElement(weights)), b = uintBitsToFloat(tableElement(weights + 1u));
    precise vec3 x = fan.x + (a.x * spoke + a.y * diagonal);
    precise vec3 e1 = fan.e1 + (a.z * spoke + a.w * diagonal);
    precise vec3 e2 = fan.e2 + (b.x * spoke + b.y * diagonal);
    fan = Fan(x, e1, e2);
}

// Spoke k's tangent; and of the facet behind it, if there is one, the coefficient: `near` lies at the spoke's far end and then
// at the next one's.
void storeSpoke(Fan fan, uint tangent, uint face, uint words, uint cageBase, vec3 p0, uint weights, uint k, uint spokes,
                bool facet, inout vec3 near) {
    vec4 b = uintBitsToFloat(tableElement(weights + 1u + 2u * k));
    precise vec3 t = fan.e1 * b.z + fan.e2 * b.w;
    storePool(tangent + k, t);
    precise vec3 far = ringSpoke(tableWord(words + (k + 1u == spokes ? 0u : k + 1u)), cageBase) - p0;
    if (facet) storeOffset(face + k, faceCoefficient(near, far, ringDiagonal(tableWord(words + k), cageBase, p0)), fan.x);
    near = far;
}

// Any fan, with the weights of its class (two elements a spoke from `weights` on). `few`: of no more than kFewSpokes spokes, on CPU
// devices without a loop: rounds that lanes go through for others' sake cost as much there as their own. What comes behind a fan's
// last spoke adds nothing.
Fan fanOf(uint words, uint cageBase, vec3 p0, uint weights, uint spokes, bool few) {
    Fan fan = Fan(vec3(0.0), vec3(0.0), vec3(0.0));
    if (few && !kWide) {
        [[unroll]] for (uint k = 0u; k < kFewSpokes; ++k) {
            uint own = min(k, spokes - 1u);
            Fan more = fan;
            addSpoke(more, tableWord(words + own), cageBase, p0, weights + 2u * own);
            if (k < spokes) fan = more;
        }
    } else {
        for (uint k = 0u; k < spokes; ++k) addSpoke(fan, tableWord(words + k), cageBase, p0, weights + 2u * k);
    }
    return fan;
}

// The same, with all that is stored of it. Gives e1 x e2. What comes behind a fan's last spoke stores the last one's once more.
vec3 weightedFan(uint limit, uint tangent, uint face, uint words, uint cageBase, vec3 p0, uint weights, uint sectors,
                 bool open, bool few) {
    uint spokes = open ? sectors + 1u : sectors;
    Fan fan = fanOf(words, cageBase, p0, weights, spokes, few);
    storeLimit(limit, p0, fan.x);
    vec3 near = ringSpoke(tableWord(words), cageBase) - p0;
    precise vec3 first = near * (1.0 / 3.0);
    if (few && !kWide) {
        [[unroll]] for (uint k = 0u; k < kFewSpokes; ++k) {
            uint own = min(k, spokes - 1u);
            vec3 before = near;
            storeSpoke(fan, tangent, face, words, cageBase, p0, weights, own, spokes, own < sectors, near);
            if (k + 1u >= spokes) near = before;
        }
    } else {
        for (uint k = 0u; k < spokes; ++k)
            storeSpoke(fan, tangent, face, words, cageBase, p0, weights, k, spokes, k < sectors, near);
    }
    if (open) {
        // The curve at its end is the cubic B-spline of the control polygon, whatever the inside does.
        precise vec3 lastSpoke = ringSpoke(tableWord(words + sectors), cageBase) - p0;
        precise vec3 last = lastSpoke * (1.0 / 3.0);
        storeOffset(tangent, first, fan.x);
        storeOffset(tangent + sectors, last, fan.x);
    }
    return cross(fan.e1, fan.e2);
}
