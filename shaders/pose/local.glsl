// The scratch memory of nodes, written. Needs tables.glsl and affine.h.
BUFFER(writeonly, Scratch, kScratchPoseBinding, std430, vec4, scratch)

void storePlace(uint i, Affine m) {
    precise Affine place = m;
    ROWS scratch.at[i + k] = rowAt(place, k);
}
void storeLocal(uint i, Transform t) {
    precise Transform local = t;
    storePlace(i, rowsOf(local));
}
