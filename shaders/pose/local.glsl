// The scratch memory of nodes, written. Needs tables.glsl and affine.h.
layout(set = 0, binding = kScratchPoseBinding, std430) writeonly buffer Scratch { vec4 scratch[]; };

void storeLocal(uint i, Transform t) {
    precise Transform local = t;
    scratch[i] = vec4(local.translation, 0.0);
    scratch[i + 1u] = local.rotation;
    scratch[i + 2u] = vec4(local.scale, 0.0);
}
void storePlace(uint i, Affine m) {
    precise Affine place = m;
    scratch[i] = place.x;
    scratch[i + 1u] = place.y;
    scratch[i + 2u] = place.z;
}
