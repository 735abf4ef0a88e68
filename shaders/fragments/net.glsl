// The isolated level. Where previous positions are asked for at a rate that was chosen today, instances without a past come
// from today's coefficients, which have a binding of their own. Needs pool.glsl, todays_pool.glsl.
// `ofPast`: previous positions are evaluated.
vec3 netPoint(uint i, uint entry, bool ofPast) {
    if (ofPast && push.today != 0u && (entry & kInstanceIsNew) != 0u) return todaysVector(i);
    return poolVector(i);
}
