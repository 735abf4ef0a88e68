// Rows of transforms that lie in a buffer, one after the other. Needs affine.h. On CPU devices each load and store of a buffer is a
// loop over the lanes, of which drivers compile one for every place in the code: there elements take turns in one place.
#ifdef WIDE
#define TURNS(count) [[unroll]] for (uint k = 0u; k < count; ++k)
#else
#define TURNS(count) [[dont_unroll]] for (uint k = 0u; k < count; ++k)
#endif
#define ROWS TURNS(3u)

vec4 rowAt(Affine m, uint k) {
    if (k == 0u) return m.x;
    if (k == 1u) return m.y;
    return m.z;
}
Affine withRow(Affine m, uint k, vec4 row) {
    if (k == 0u) m.x = row;
    if (k == 1u) m.y = row;
    if (k == 2u) m.z = row;
    return m;
}
Affine rowsOf(Transform t) { return Affine(vec4(t.translation, 0.0), t.rotation, vec4(t.scale, 0.0)); }
Transform transformAt(Affine rows) {
    Transform t;
    t.translation = rows.x.xyz;
    t.rotation = rows.y;
    t.scale = rows.z.xyz;
    return t;
}
