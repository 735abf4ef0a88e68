// How the model's frame has moved from step to step, of the list of what is posed. Needs instances.glsl and swing.h.
Affine movedRows(uint word) {
    vec4 rows[3];
    for (uint i = 0u; i < 3u; ++i) {
        uint w = word + 4u * i;
        rows[i] = uintBitsToFloat(uvec4(instanceWord(w), instanceWord(w + 1u), instanceWord(w + 2u), instanceWord(w + 3u)));
    }
    return rowsOf(rows[0], rows[1], rows[2]);
}

// How the frame of the step before lies in that of step `k`. `moves`: the word of the list where they begin, or 0; `before`,
// `way`: what root motion had travelled then, and now; `jumps`: it has not moved there.
Affine stepMove(Affine before, Affine way, uint moves, uint k, bool jumps) {
    precise Affine move = before;
    if (moves != 0u) move = combined(movedRows(moves + kMoveWords * k), move);
    move = combined(undone(way), move);
    if (jumps) move = identity();
    return move;
}

// Three words from one on.
vec3 movedVector(uint w) { return uintBitsToFloat(uvec3(instanceWord(w), instanceWord(w + 1u), instanceWord(w + 2u))); }
// At a step, in the frame that the host places: the world's down, and the wind. `word`: where its move begins.
vec3 downRow(uint word) { return movedVector(word + 12u); }
vec3 windRow(uint word) { return movedVector(word + 15u); }
