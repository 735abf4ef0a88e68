// How the model's frame has moved from step to step, of the list of what is posed. Needs instances.glsl and affine.h.
Affine movedRows(uint word) {
    vec4 rows[3];
    for (uint i = 0u; i < 3u; ++i) {
        uint w = word + 4u * i;
        rows[i] = uintBitsToFloat(uvec4(instanceWord(w), instanceWord(w + 1u), instanceWord(w + 2u), instanceWord(w + 3u)));
    }
    return rowsOf(rows[0], rows[1], rows[2]);
}
