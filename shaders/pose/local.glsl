// The scratch memory of local matrices, written. Needs tables.glsl and affine.glsl.
layout(set = 0, binding = kScratchPoseBinding, std430) writeonly buffer Scratch { vec4 scratch[]; };

void storeLocal(uint i, Affine m) {
    precise Affine local = m;
    scratch[i] = local.x;
    scratch[i + 1u] = local.y;
    scratch[i + 2u] = local.z;
}
