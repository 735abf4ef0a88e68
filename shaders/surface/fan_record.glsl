// The records of fans that the pool has instead of coefficients (shared/prep.h), and what corners of patches are made of them: by the
// operations of surface/vertex.glsl, so positions have the same bits. Offsets may be -0 here where the pool has 0. Positions do not
// show that, as limit points are no -0. Needs tables.glsl, pool.glsl, corner.glsl and shared/prep.h.
#include "shaders/surface/face.glsl"

struct FanRecord {
    vec3 p0, x, e1, e2; // the vertex of the cage; the limit point, relative to it; two tangents
};
FanRecord fanRecord(uint base, uint vertex) {
    uint at = base + kFanRecordElements * vertex;
    vec4 a = poolElement(at), b = poolElement(at + 1u), c = poolElement(at + 2u);
    return FanRecord(a.xyz, vec3(a.w, b.xy), vec3(b.zw, c.x), c.yzw);
}
vec3 fanVertex(uint base, uint vertex) { return poolElement(base + kFanRecordElements * vertex).xyz; }

vec3 limitOf(FanRecord r) {
    precise vec3 p = r.p0 + r.x;
    return withPositiveZeros(p);
}
// `turn`: the spoke's cosine and sine.
vec3 spokeTangent(FanRecord r, vec2 turn) {
    precise vec3 t = r.e1 * turn.x + r.e2 * turn.y;
    return t;
}
// A border is the cubic B-spline of the control polygon. `far`: where the spoke ends.
vec3 borderTangent(FanRecord r, vec3 far) {
    precise vec3 third = (far - r.p0) * (1.0 / 3.0);
    precise vec3 t = third - r.x;
    return t;
}
vec3 faceOffset(FanRecord r, vec3 next, vec3 across, vec3 last) {
    precise vec3 spoke = next - r.p0, nextSpoke = last - r.p0, diagonal = across - r.p0;
    precise vec3 offset = faceCoefficient(spoke, nextSpoke, diagonal) - r.x;
    return offset;
}

// A corner of a patch, from the word of its turn and the vertices of the other three. What lies on borders, setBorders() sets.
Corner cornerOfFan(FanRecord r, uint word, vec3 next, vec3 across, vec3 last) {
    vec4 turn = uintBitsToFloat(tableElement(word & kTurnMask));
    return Corner(limitOf(r), spokeTangent(r, turn.xy), spokeTangent(r, turn.zw), faceOffset(r, next, across, last));
}
bool hasBorders(uint words) { return (words & (kBorderSpoke | kBorderNextSpoke)) != 0u; }
void setBorders(FanRecord r, uint word, vec3 next, vec3 last, inout Corner c) {
    if ((word & kBorderSpoke) != 0u) c.next = borderTangent(r, next);
    if ((word & kBorderNextSpoke) != 0u) c.last = borderTangent(r, last);
}
// A corner of the patch whose record begins at an element.
Corner cornerOfPatch(uint base, uint record, uint corner) {
    uint first = 4u * record, word = tableWord(first + 4u + corner);
    FanRecord r = fanRecord(base, tableWord(first + corner));
    vec3 next = fanVertex(base, tableWord(first + (corner + 1u & 3u)));
    vec3 across = fanVertex(base, tableWord(first + (corner + 2u & 3u)));
    vec3 last = fanVertex(base, tableWord(first + (corner + 3u & 3u)));
    Corner c = cornerOfFan(r, word, next, across, last);
    if (hasBorders(word)) setBorders(r, word, next, last, c);
    return c;
}
