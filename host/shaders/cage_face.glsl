// The triangles of the cage's polygons. The table is one run of words: the corners (CageCorner, eight words each), then the
// vertex lists of the faces, which begin at CageCorner::faceStart.
#include "frame.glsl"
#include "cage_input.glsl"

layout(set = 1, binding = kCageCornerBinding, std430) readonly buffer CageCorners { uint cageWords[]; };

CageCorner cageCorner() {
    uint word = (push.primitive + gl_VertexIndex) * 8u;
    return CageCorner(cageWords[word], cageWords[word + 1u], cageWords[word + 2u], cageWords[word + 3u],
                      uintBitsToFloat(cageWords[word + 4u]), uintBitsToFloat(cageWords[word + 5u]),
                      uintBitsToFloat(cageWords[word + 6u]), uintBitsToFloat(cageWords[word + 7u]));
}
