// Bicubic patches at a rate, of which a lane has a whole one in registers: in the narrow mapping, and in the wide one where a rate has
// patches enough for all lanes of a GPU (kLanePatch). There the samples of a row pass through workgroup memory, so that neighboring
// lanes store neighboring ones.
#ifdef WIDE
layout(constant_id = kLanePatchConstant) const bool kLanePatch = false;
// Lanes keep their rows an odd number of elements apart: then they do not meet in one bank.
const uint kRowStride = (kInterior ? kRate - 1u : kRate + 1u) | 1u;
shared uvec4 localSamples[kLanePatch ? kPatchLanes * kRowStride : 1u];
const uint kNoVertex = 0xFFFFFFFFu;
shared uint localPatches[kLanePatch ? kPatchLanes : 1u]; // the first surface vertex of each
uint patchesHere; // in the workgroup
// Where the samples of a row go that the lane stores for others: the surface vertex in row 0, and the element of localSamples.
uint storesTo[kMaxLanePatchRate + 1u], storesFrom[kMaxLanePatchRate + 1u];
#endif

// Sample i of a row that a lane stores, of which `vertex` and `own` are the first ones.
void keepSample(uint vertex, uint own, uint i, vec3 position, Frame frame) {
#ifdef WIDE
    localSamples[gl_LocalInvocationID.x * kRowStride + i] = uvec4(floatBitsToUint(position), encodeOctahedral(frame.normal));
    if (gl_LocalInvocationID.x < patchesHere) storeTangent(vertex + i, own + i, frame);
#else
    storeSurfaceVertex(vertex + i, own + i, position, frame);
#endif
}
// Behind row j of all lanes' patches, of `side` samples each.
void storeRow(uint j, uint side) {
#ifdef WIDE
    barrier();
    if (patchesHere == kPatchLanes) {
        [[unroll]] for (uint s = 0u; s < side; ++s) surface16.at[storesTo[s] + j * side] = localSamples[storesFrom[s]];
    } else {
        for (uint s = 0u; s < side; ++s)
            if (storesTo[s] != kNoVertex) surface16.at[storesTo[s] + j * side] = localSamples[storesFrom[s]];
    }
    barrier();
#endif
}

// All samples of row j. `isInside`: it is on no border.
void evaluateRow(const PatchPlace at, Patch c, Row row, uint j, uint rate, bool isInside) {
    uint inset = kInterior ? 1u : 0u, side = rate + 1u - 2u * inset, first = (j - inset) * side;
    uint vertex = at.vertex + first, own = at.own + first;
    bool isApex = kPolar && !isInside && j == rate; // the apex itself, from every patch round it
    vec3 position, farPosition;
    Frame frame, farFrame;
    if (!kInterior) {
        endSample(row, false, position, frame);
        endSample(row, true, farPosition, farFrame);
        if (isApex) position = farPosition = c.c2.point;
        if (kCornerNormals && !isInside) {
            uvec4 slots = normalSlots(at.record);
            frame = withCornerNormal(frame, j == 0u ? 0u : 3u, slots, at.base);
            farFrame = withCornerNormal(farFrame, j == 0u ? 1u : 2u, slots, at.base);
        }
        keepSample(vertex, own, 0u, position, frame);
        keepSample(vertex, own, rate, farPosition, farFrame);
        if (rate == 1u) return;
    }
    PointHalves points = pointHalves(row);
    SlopeHalves slopes = slopeHalves(row);
    uint i = 1u, pairs = rate / 2u;
    [[unroll]] do {
        mirroredSamples(row, points, slopes, parameterPair(i, rate), isInside, position, frame, farPosition, farFrame);
        if (isApex) position = farPosition = c.c2.point;
        keepSample(vertex, own, i - inset, position, frame);
        if (2u * i != rate) keepSample(vertex, own, rate - i - inset, farPosition, farFrame);
    } while (++i <= pairs);
}

// Rows v = 0 and v = 1, then those between. Loops are tested at the bottom: one tested at the top costs lavapipe one more time
// round with nothing to do.
void evaluateRows(const PatchPlace at) {
    Patch c = loadPatch(at);
    uint rate = fixedRate(), inset = kInterior ? 1u : 0u, side = rate + 1u - 2u * inset, j = 0u;
    if (!kInterior) {
        do {
            evaluateRow(at, c, borderRow(c, j == rate), j, rate, false);
            storeRow(j, side);
            j += rate;
        } while (j <= rate);
        if (rate == 1u) return;
    }
    j = 1u;
    do {
        evaluateRow(at, c, collapse(c, parameterPair(j, rate), kInnerRow), j, rate, true);
        storeRow(j - inset, side);
    } while (++j < rate);
}

#ifdef WIDE
// A lane a patch.
void evaluatePatches() {
    Share share = shareOfGroup();
    if (share.count == 0u) return;
    patchesHere = share.count;
    PatchPlace at = PATCH_IN_PLACE(share, min(gl_LocalInvocationID.x, share.count - 1u)); // idle lanes repeat the last
    localPatches[gl_LocalInvocationID.x] = at.vertex;
    barrier();
    const uint kSide = kInterior ? kRate - 1u : kRate + 1u;
    [[unroll]] for (uint s = 0u; s < kSide; ++s) {
        uint n = s * kPatchLanes + gl_LocalInvocationID.x, place = n / kSide, i = n - place * kSide;
        storesFrom[s] = place * kRowStride + i;
        storesTo[s] = place < share.count ? localPatches[place] + i : kNoVertex;
    }
    evaluateRows(at);
}
#else
void evaluatePatch(const PatchPlace at) { evaluateRows(at); }
#endif
