// The records of bicubic patches: where their coefficients lie in the pool (shared/surface.h). Needs tables.glsl and `tangents`,
// `faces` in the push constants.
#include "shaders/shared/prep.h"

struct NetRecord {
    uvec4 points, spokes; // of the corners
};
NetRecord netRecord(uint record) {
    uvec4 a = tableElement(record), b = tableElement(record + 1u);
    return NetRecord(a, b);
}

// Of coefficient k, row by row in v.
uint netIndex(NetRecord r, bool polar, uint k) {
    const uint kCorners[16] = uint[16](SUPPLE_NET_CORNERS), kPolarCorners[16] = uint[16](SUPPLE_POLAR_NET_CORNERS);
    const uint kKinds[16] = uint[16](SUPPLE_NET_KINDS), kPolarKinds[16] = uint[16](SUPPLE_POLAR_NET_KINDS);
    uint corner = kCorners[k], kind = kKinds[k];
    if (polar) corner = kPolarCorners[k], kind = kPolarKinds[k];
    uint point = r.points[corner], spoke = r.spokes[corner];
    if (kind == kNetPoint) return point;
    if (kind == kNetBehind) return point + 1u;
    if (kind == kNetFace) return push.faces + SUPPLE_SPOKE(spoke);
    return push.tangents + (kind == kNetTangent ? SUPPLE_SPOKE(spoke) : SUPPLE_NEXT_SPOKE(spoke));
}

// Of h[k] of a perturbed patch, in evaluation order; `edges`: the element behind the corners.
uint perturbationIndex(uvec4 edges, uint k) {
    const uint kFaceEdgeOrder[16] = uint[16](SUPPLE_PREP_FACE_EDGE_ORDER);
    uint at = kFaceEdgeOrder[k];
    return SUPPLE_PREP_EDGE_INDEX(edges[at / 4u], at % 4u);
}
