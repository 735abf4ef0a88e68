// The cage: its deformed vertices (one float4 each, slot after slot), and the table of its triangles. That is one run of words: the
// corners (CageCorner, eight words each), then the vertex lists of the faces, which begin at CageCorner::faceStart.
layout(set = 1, binding = kDeformedCageBinding, std430) readonly buffer DeformedCage { vec4 deformedCage[]; };
layout(set = 1, binding = kCageCornerBinding, std430) readonly buffer CageCorners { uint cageWords[]; };

// Whether the pose mirrors a face. Winding and normals follow the deformed cage, so they show its inside as the outside then.
bool isFaceMirrored(uint slot, uint faceStart, uint faceSides) {
    if ((push.flags & kDrawMayMirror) == 0u) return false;
    float sides = 0.0;
    for (uint i = 0u; i < faceSides; ++i)
        sides += deformedCage[slot * push.cageVerticesPerInstance + cageWords[faceStart + i]].w;
    return isMirrored(sides);
}
