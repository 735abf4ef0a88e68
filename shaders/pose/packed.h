// Sampling a packed clip (skinning/packed_clip.h), in the layout of shaders/shared/pose.h: no state and no search. Needs what
// clip.h needs.

uint wordAt(uvec4 v, uint k) {
    uint low = (k & 1u) == 0u ? v.x : v.y, high = (k & 1u) == 0u ? v.z : v.w;
    return (k & 2u) == 0u ? low : high;
}
uint packedWord(uint first, uint i) { return wordAt(table(first + i / 4u), i & 3u); }

// `count` bits, at most 20, from bit `at` of two elements on.
uint bitsOf(uvec4 a, uvec4 b, uint at, uint count) {
    uint k = at >> 5u, shift = at & 31u;
    uint low = k < 4u ? wordAt(a, k) : wordAt(b, k - 4u);
    uint high = k < 3u ? wordAt(a, k + 1u) : wordAt(b, (k + 1u) & 3u);
    uint word = (low >> shift) | ((high << 1u) << (31u - shift));
    return word & ((1u << count) - 1u);
}
// The number that the low 20 bits are, with a sign.
int wholeOf(uint word) { return int((word & 0xFFFFFu) ^ 0x80000u) - 0x80000; }
float powerOfHalf(int exponent) { return uintBitsToFloat(uint(127 - exponent) << 23u); }

// Where a time falls: in a frame of a segment, and how far to the next one.
struct PackedTime {
    uint segment;
    uint frame;
    float part;
};
PackedTime packedTime(uvec4 head, float rateLow, vec2 time) {
    SUPPLE_PRECISE float low = time.x * rateLow;
    vec2 at = timeSum(timeProduct(time, uintBitsToFloat(head.x)), vec2(low, 0.0f));
    SUPPLE_PRECISE float whole = floor(at.x);
    SUPPLE_PRECISE float part = (at.x - whole) + at.y;
    if (part < 0.0f) {
        whole = whole - 1.0f;
        part = part + 1.0f;
    }
    float last = float(head.y);
    if (whole < 0.0f) part = 0.0f;
    if (whole >= last) part = 1.0f;
    uint frame = uint(min(max(whole, 0.0f), last - 1.0f));
    PackedTime result;
    result.segment = frame / kSegmentFrames;
    result.frame = frame % kSegmentFrames;
    result.part = min(part, 1.0f);
    return result;
}

// A property that changes: its number among those of the clip.
vec4 changingValue(uvec4 sections, uvec4 segment, PackedTime at, uint property, bool turns) {
    uint own = packedWord(sections.z, property);
    uvec4 record = table(segment.x + property);
    uint upTo = record.x & (0xFFFFFFFFu >> (31u - at.frame)), later = record.x ^ upTo;
    uint before = uint(findMSB(upTo)), rank = uint(bitCount(upTo)) - 1u;
    uint after = later != 0u ? uint(findLSB(later)) : segment.z;
    SUPPLE_PRECISE float t = (float(at.frame - before) + at.part) * recip(float(after - before));
    uvec4 widths = (record >> 20u) & 31u;
    uint width = widths.y + widths.z + widths.w;
    uint offset = (record.y >> 25u) | (record.z >> 25u) << 7u | (record.w >> 25u) << 14u;
    uint place = offset + rank * width, element = segment.y + place / 128u;
    uvec4 a = table(element), b = table(element + 1u);
    place = place & 127u;
    float step = powerOfHalf(int(own >> 27u) - 8);
    SUPPLE_PRECISE vec3 from = vec3(0.0f);
    SUPPLE_PRECISE vec3 to = vec3(0.0f);
    // A loop over the numbers of both knots, so that the code is there once.
    for (uint k = 0u; k < 6u; ++k) {
        uint axis = k < 3u ? k : k - 3u;
        uint word = wordAt(record, axis + 1u), count = (word >> 20u) & 31u;
        SUPPLE_PRECISE float number = float(wholeOf(word) + int(bitsOf(a, b, place, count))) * step;
        place += count;
        if (k == 0u) from.x = number;
        if (k == 1u) from.y = number;
        if (k == 2u) from.z = number;
        if (k == 3u) to.x = number;
        if (k == 4u) to.y = number;
        if (k == 5u) to.z = number;
    }
    SUPPLE_PRECISE vec3 mixed = from + (to - from) * t;
    SUPPLE_PRECISE vec4 value = vec4(mixed, 0.0f);
    if (turns) {
        vec4 q = quarterTangentTurn(from), p = quarterTangentTurn(to);
        SUPPLE_PRECISE float d = dot4(q, p);
        SUPPLE_PRECISE vec4 nearer = p * (d < 0.0f ? -1.0f : 1.0f);
        SUPPLE_PRECISE vec4 between = q + (nearer - q) * slerpShare(t, min(abs(d), 1.0f));
        SUPPLE_PRECISE vec3 reference =
            vec3(float(own & 511u) - 255.0f, float((own >> 9u) & 511u) - 255.0f, float((own >> 18u) & 511u) - 255.0f);
        reference = reference * 0.003921568627f;
        value = turned(quarterTangentTurn(reference), between);
    }
    return value;
}

vec4 constantValue(uvec4 sections, uint constant, bool turns) {
    uint x = packedWord(sections.y, 2u * constant), y = packedWord(sections.y, 2u * constant + 1u);
    float step = powerOfHalf(27 - 2 * int(y >> 28u));
    SUPPLE_PRECISE vec3 v =
        vec3(float(wholeOf(x)), float(wholeOf(x >> 20u | y << 12u)), float(wholeOf(y >> 8u))) * step;
    SUPPLE_PRECISE vec4 value = vec4(v, 0.0f);
    if (turns) value = quarterTangentTurn(v);
    return value;
}

// The node's transform in a packed clip, whose first element is `head`. Properties without data keep the rest pose.
Transform packedTransform(uint head, vec2 time, uint node, Transform rest) {
    uvec4 sections = table(head + 1u);
    PackedTime at = packedTime(table(head), tableFloats(head + 2u).y, time);
    uvec4 segment = table(sections.w + at.segment);
    // The segment is missing; its twin has the same frames. A loop, so that lavapipe can leave it out.
    for (uint twin = segment.w; twin != 0u; twin = 0u) {
        sections = table(twin + 1u);
        segment = table(sections.w + at.segment);
    }
    uvec4 masks = table(sections.x + node / 16u);
    uint bit = node & 15u, below = (1u << bit) - 1u, both = below | below << 16u;
    // By path, 1, 2 and 4: what changes, and what is constant.
    uint changing = ((masks.x >> bit) & 1u) | ((masks.x >> (16u + bit)) & 1u) << 1u | ((masks.y >> bit) & 1u) << 2u;
    uint constant = ((masks.z >> bit) & 1u) | ((masks.z >> (16u + bit)) & 1u) << 1u | ((masks.y >> (16u + bit)) & 1u) << 2u;
    uint property = (masks.w & 0xFFFFu) + uint(bitCount(masks.x & both)) + uint(bitCount(masks.y & below));
    uint number = (masks.w >> 16u) + uint(bitCount(masks.z & both)) + uint(bitCount((masks.y >> 16u) & below));
    SUPPLE_PRECISE Transform t = rest;
    for (uint paths = changing | constant; paths != 0u; paths &= paths - 1u) {
        uint path = uint(findLSB(paths));
        bool changes = ((changing >> path) & 1u) != 0u;
        SUPPLE_PRECISE vec4 value = vec4(0.0f);
        if (changes) {
            value = changingValue(sections, segment, at, property, path == 1u);
            property += 1u;
        } else {
            value = constantValue(sections, number, path == 1u);
            number += 1u;
        }
        if (path == 0u) t.translation = vec3(value);
        if (path == 1u) t.rotation = value;
        if (path == 2u) t.scale = vec3(value);
    }
    return t;
}
