// The isolated level. Where previous positions are asked for at a rate that was chosen today, instances without a past come
// from today's coefficients, which are bound in the place of the cage. Needs pool.glsl, cage.glsl.
// `ofPast`: previous positions are evaluated.
vec3 netPoint(uint i, uint entry, bool ofPast) {
    if (ofPast && push.today != 0u && (entry & kInstanceIsNew) != 0u) return cageVertex(i);
    return poolVector(i);
}
