// Hits as hosts have them (SuppleHit). Needs queries.glsl and piece.glsl.
BUFFER(writeonly, Hits, kHitBinding, std430, uvec4, hits)

const uint kNoHit = 0xFFFFFFFFu, kHitBack = 1u;

void storeMiss(uint number) {
    hits.at[4u * number] = uvec4(0x7F800000u, kNoHit, 0u, 0u); // infinity
    hits.at[4u * number + 1u] = uvec4(kNoFace, 0u, 0u, 0u);
    hits.at[4u * number + 2u] = uvec4(0u);
    hits.at[4u * number + 3u] = uvec4(0u);
}

// The handle of a place in a piece: face, side, and two numbers as bits.
uvec4 handleOf(uint number, uint kind, vec2 at) {
    uint first = kPieceElements * number;
    vec4 part = uintBitsToFloat(piece(first + 1u)), low = uintBitsToFloat(piece(first + 2u)), high = uintBitsToFloat(piece(first + 4u));
    uvec4 diagonal = piece(first + 3u), other = piece(first + 5u);
    vec2 p = part.xy + part.z * at, numbers;
    uint side = diagonal.z;
    if (kind == kTrianglePiece) {
        numbers = low.xy + p.x * low.zw + p.y * high.zw;
    } else if (p.x >= p.y) {
        numbers = low.xy + (p.x - p.y) * low.zw + p.y * uintBitsToFloat(diagonal.xy);
    } else {
        side = diagonal.w;
        numbers = high.xy + (p.y - p.x) * high.zw + p.x * uintBitsToFloat(other.xy);
    }
    return uvec4(piece(first).x, side, floatBitsToUint(clamp(numbers, vec2(0.0), vec2(1.0))));
}

// `slot`: of the window. `c`: the coefficients of its piece, less the first vertex.
void storeHit(uint number, uint t, uint slot, uint pieceNumber, const Piece own, vec3 c[kPieceCoefficients], vec3 along, vec2 at) {
    Jet jet = jetAt(own.kind, c, at);
    vec3 normal = cross(jet.du, jet.dv), position = jet.position + own.first;
    float longest = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
    normal = longest > 0.0 ? normalize(normal / longest) : vec3(0.0);
    if (cage(own.base + piece(own.vertices).x).w < 0.0) normal = -normal; // a pose that mirrors
    hits.at[4u * number] = uvec4(t, push.group, push.firstSlot + slot, dot(normal, along) > 0.0 ? kHitBack : 0u);
    hits.at[4u * number + 1u] = handleOf(pieceNumber, own.kind, at);
    hits.at[4u * number + 2u] = uvec4(floatBitsToUint(position), 0u);
    hits.at[4u * number + 3u] = uvec4(floatBitsToUint(normal), 0u);
}
