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

// Where lanes ask for different components.
uint componentOf(uvec4 v, uint i) { return v[i]; }

// Of coefficient k, row by row in v.
uint netIndex(NetRecord r, bool polar, uint k) {
    uint corner = SUPPLE_NET_CORNER(k), kind = SUPPLE_NET_KIND(k);
    if (polar) corner = SUPPLE_POLAR_NET_CORNER(k), kind = SUPPLE_POLAR_NET_KIND(k);
    uint point = componentOf(r.points, corner), spoke = componentOf(r.spokes, corner);
    if (kind == kNetPoint) return point;
    if (kind == kNetBehind) return point + 1u;
    if (kind == kNetFace) return header.faces + SUPPLE_SPOKE(spoke);
    return header.tangents + (kind == kNetTangent ? SUPPLE_SPOKE(spoke) : SUPPLE_NEXT_SPOKE(spoke));
}

// Of h[k] of a perturbed patch, in evaluation order; `edges`: the element behind the corners.
uint perturbationIndex(uvec4 edges, uint k) {
    uint at = SUPPLE_PREP_FACE_EDGE(k);
    return SUPPLE_PREP_EDGE_INDEX(componentOf(edges, at / 4u), at % 4u);
}
