// The triangles of the cage's polygons.
#include "frame.glsl"
#include "cage_input.glsl"

CageCorner cageCorner() {
    uint word = (push.primitive + gl_VertexIndex) * 8u;
    return CageCorner(cageWords[word], cageWords[word + 1u], cageWords[word + 2u], cageWords[word + 3u],
                      uintBitsToFloat(cageWords[word + 4u]), uintBitsToFloat(cageWords[word + 5u]),
                      uintBitsToFloat(cageWords[word + 6u]), uintBitsToFloat(cageWords[word + 7u]));
}
