// Where poses go: what is shown to the deform pass, an end to mix.comp, a step to what jiggles. Needs rows.glsl.

BUFFER(writeonly, Posed, kPosedBinding, std430, vec4, posed)
BUFFER(writeonly, PosedEnds, kEndsBinding, std430, vec4, posedEnds)

// `i`: within the pose.
void storePosed(uint i, vec4 value) {
    precise vec4 element = value;
    if (isShown()) {
        posed.at[posedSlot() * push.poseStride + i] = element;
    } else {
        posedEnds.at[firstUnshown() + i] = element;
    }
}
void storePosed(uint i, Affine m) {
    precise Affine rows = m;
    ROWS storePosed(i + k, rowAt(rows, k));
}
