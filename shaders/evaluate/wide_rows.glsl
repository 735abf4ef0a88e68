// The wide mapping of patches at a rate whose samples are cheaper by rows: a lane a row, in registers. Lanes load the parts of patches
// into workgroup memory before. As these are not needed any more then, positions take their place on their way to be stored by
// neighboring lanes side by side.
//
// Before the include, beside what harness.glsl needs:
//   kRowParts, localElements      parts a patch; workgroup memory for SUPPLE_WIDE_ELEMENTS(kVertexFormat) elements
//   kHasRows                      whether this is called at all: else it takes no memory
//   kInterior                     whether samples on borders are left out
//   void loadRowPart(uint place, const PatchPlace at, uint part)
//   void makeRow(uint place, uint j, uint rate)                             which the lane keeps
//   void sampleOfRow(Share share, uint place, uint i, uint j, uint rate, out vec3 position, out Frame frame)
//   uint rowRate()

// Samples of a row that are stored together: what there is room for, and an odd number, so that rows begin in different banks.
const uint kMostTogether = kVertexFormat == kVertex24 ? 3u : 5u;
shared uint localNormals[kHasRows ? kMaxLanes * kMostTogether * (kNormalWords == 0u ? 1u : kNormalWords) : 1u];
shared uint localRows[kHasRows ? kMaxLanes : 1u]; // the first surface vertex of each

void evaluateWideRows() {
    const uint kInset = kInterior ? 1u : 0u;
    uint rate = rowRate(), side = rate + 1u - 2u * kInset, lane = gl_LocalInvocationID.x;
    Share share = shareOfGroup();
    if (share.count == 0u) return;
    uint rows = share.count * side;
    for (uint n = lane; n < kRowParts * share.count; n += gl_WorkGroupSize.x) {
        uint place = n / kRowParts, part = n - place * kRowParts;
        PatchPlace at = PATCH_IN_PLACE(share, place);
        loadRowPart(place, at, part);
        for (uint j = part; j < side; j += kRowParts) localRows[place * side + j] = at.vertex + j * side;
    }
    barrier();
    uint place = lane / side, j = lane - place * side + kInset;
    if (lane < rows) makeRow(place, j, rate);
    uint rounds = (side + kMostTogether - 1u) / kMostTogether, chunk = ((side + rounds - 1u) / rounds) | 1u;
    for (uint from = 0u; from < side; from += chunk) {
        barrier();
        if (lane < rows) {
            [[unroll]] for (uint c = 0u; c < chunk; ++c) {
                uint i = from + c + kInset, to = lane * chunk + c;
                if (from + c >= side) break;
                vec3 position;
                Frame frame;
                sampleOfRow(share, place, i, j, rate, position, frame);
                if (kTangents) {
                    PatchPlace at = PATCH_IN_PLACE(share, place);
                    uint own = (j - kInset) * side + from + c;
                    storeTangent(at.vertex + own, at.own + own, frame);
                }
                localElements[to].xyz = position;
                uvec3 words = normalWords(frame.normal);
                for (uint k = 0u; k < kNormalWords; ++k) localNormals[kNormalWords * to + k] = words[k];
            }
        }
        barrier();
        for (uint n = lane; n < rows * chunk * kVertexStores; n += gl_WorkGroupSize.x) {
            uint at = n / kVertexStores, slot = at / chunk, c = at - slot * chunk;
            if (from + c >= side) continue;
            uint vertex = localRows[slot] + from + c, word = kNormalWords * at;
            if (n - at * kVertexStores == 0u)
                storePosition(vertex, localElements[at].xyz, kNormalWords == 1u ? localNormals[word] : 0u);
            else
                storeNormal(vertex, uvec3(localNormals[word], localNormals[word + 1u], localNormals[word + 2u]));
        }
    }
}
