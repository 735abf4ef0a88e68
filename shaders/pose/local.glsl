// The scratch memory of nodes, written. Needs tables.glsl and affine.h.
BUFFER(writeonly, Scratch, kScratchPoseBinding, std430, vec4, scratch)

void storeLocal(uint i, Transform t) {
    precise Transform local = t;
    scratch.at[i] = vec4(local.translation, 0.0);
    scratch.at[i + 1u] = local.rotation;
    scratch.at[i + 2u] = vec4(local.scale, 0.0);
}
void storePlace(uint i, Affine m) {
    precise Affine place = m;
    scratch.at[i] = place.x;
    scratch.at[i + 1u] = place.y;
    scratch.at[i + 2u] = place.z;
}
