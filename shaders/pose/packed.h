// Sampling a packed clip (skinning/packed_clip.h), in the layout of shaders/shared/pose.h: no state and no search. Needs what
// clip.h needs, and `const bool kCoarseTwins`: whether some clip has a coarse twin.

// 32 bits of two words, from bit `shift` of the first on, which is at most 31.
uint bitsFrom(uint low, uint high, uint shift) { return (low >> shift) | ((high << 1u) << (31u - shift)); }
uint lowBits(uint word, uint count) { return word & ((1u << count) - 1u); }
// Three numbers of at most 20 bits each, from bit `at` of two elements on.
vec3 threeNumbers(uvec4 a, uvec4 b, uint at, uvec4 widths) {
    // The words at / 32 and the two behind it: moved to the front by 4, 2 and 1.
    bool four = (at & 128u) != 0u, two = (at & 64u) != 0u, one = (at & 32u) != 0u;
    uint w0 = SUPPLE_SELECT(four, b.x, a.x), w1 = SUPPLE_SELECT(four, b.y, a.y), w2 = SUPPLE_SELECT(four, b.z, a.z),
         w3 = SUPPLE_SELECT(four, b.w, a.w);
    w0 = SUPPLE_SELECT(two, w2, w0);
    w1 = SUPPLE_SELECT(two, w3, w1);
    w2 = SUPPLE_SELECT(two, b.x, w2);
    w3 = SUPPLE_SELECT(two, b.y, w3);
    w0 = SUPPLE_SELECT(one, w1, w0);
    w1 = SUPPLE_SELECT(one, w2, w1);
    w2 = SUPPLE_SELECT(one, w3, w2);
    uint low = bitsFrom(w0, w1, at & 31u), high = bitsFrom(w1, w2, at & 31u);
    uint x = lowBits(low, widths.x);
    low = bitsFrom(low, high, widths.x);
    high = high >> widths.x;
    uint y = lowBits(low, widths.y);
    uint z = lowBits(bitsFrom(low, high, widths.y), widths.z);
    return vec3(float(x), float(y), float(z));
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
    SUPPLE_PRECISE float latest = last - 1.0f;
    uint frame = uint(min(max(whole, 0.0f), latest));
    PackedTime result;
    result.segment = frame / kSegmentFrames;
    result.frame = frame % kSegmentFrames;
    result.part = min(part, 1.0f);
    return result;
}

// Where a packed clip, whose first element is `head`, is at a time.
struct PackedPlace {
    PackedTime at;
    uvec4 sections; // those of the clip or, while its segment is missing, of its twin
    uvec4 segment;
};
PackedPlace packedPlace(uint head, vec2 time) {
    PackedPlace place;
    uvec4 own = table(head);
    place.at = packedTime(own, tableFloats(head + 2u).y, time);
    place.sections = table(head + 1u);
    place.segment = table(place.sections.z + place.at.segment);
    uint twin = place.segment.w;
    if (kCoarseTwins && twin != 0u) { // it has the same frames
        place.sections = table(twin + 1u);
        place.segment = table(place.sections.z + place.at.segment);
    }
    return place;
}

// What a packed clip has of a node, or of three morph targets. By path, 1, 2 and 4: what changes, and what is constant; their
// first numbers among those of the clip.
struct PackedPaths {
    uint changing;
    uint constant;
    uint property;
    uint number;
};
PackedPaths packedPaths(uvec4 sections, uint node) {
    uvec4 masks = table(sections.x + node / 16u);
    uint bit = node & 15u, below = (1u << bit) - 1u, both = below | below << 16u;
    PackedPaths paths;
    paths.changing = ((masks.x >> bit) & 1u) | ((masks.x >> (16u + bit)) & 1u) << 1u | ((masks.y >> bit) & 1u) << 2u;
    paths.constant =
        ((masks.z >> bit) & 1u) | ((masks.z >> (16u + bit)) & 1u) << 1u | ((masks.y >> (16u + bit)) & 1u) << 2u;
    paths.property = (masks.w & 0xFFFFu) + uint(bitCount(masks.x & both)) + uint(bitCount(masks.y & below));
    paths.number = (masks.w >> 16u) + uint(bitCount(masks.z & both)) + uint(bitCount((masks.y >> 16u) & below));
    return paths;
}

// A property that changes, between two knots.
struct PackedSpan {
    vec3 from;
    vec3 to;
    float part; // of the way from one to the other
};
// The knots around a frame: outer ones, every second and the last, and one in between.
struct PackedKnots {
    uint first;
    uint middle;
    uint last;
    uint pair;   // which of the segment's pairs of an outer and an inner knot
    bool second; // the frame is behind the knot in between
};
PackedKnots packedKnots(uint mask, uint frame, uint frames) {
    uint upTo = mask & (0xFFFFFFFFu >> (31u - frame)), later = mask ^ upTo, beyond = later & (later - 1u);
    uint before = uint(findMSB(upTo)), rank = uint(bitCount(upTo)) - 1u;
    uint next = later != 0u ? uint(findLSB(later)) : frames;
    PackedKnots knots;
    knots.second = (rank & 1u) != 0u;
    knots.first = knots.second ? uint(findMSB(upTo ^ (1u << before))) : before;
    knots.middle = knots.second ? before : next;
    knots.last = knots.second ? next : beyond != 0u ? uint(findLSB(beyond)) : frames;
    knots.pair = rank >> 1u;
    return knots;
}
vec3 fiveBits(uint own) { return vec3(float(own & 31u), float((own >> 5u) & 31u), float((own >> 10u) & 31u)); }
float signedFive(uint word) { return float(int((word & 31u) ^ 16u) - 16); }
// The lowest numbers of a property's outer knots in a segment.
vec3 lowNumbers(uint own, uint lows, bool turns) {
    SUPPLE_PRECISE vec3 low = vec3(signedFive(lows), signedFive(lows >> 5u), signedFive(lows >> 10u));
    if (!turns) low = low + (fiveBits(own) - 16.0f) * 16.0f;
    low = low * vec3(powerOfHalf(-int((own >> 15u) & 15u)), powerOfHalf(-int((own >> 19u) & 15u)),
                     powerOfHalf(-int((own >> 23u) & 15u)));
    return low;
}
PackedSpan packedSpan(PackedPlace place, uvec4 record, bool turns) {
    PackedKnots knots = packedKnots(record.x, place.at.frame, place.segment.z);
    uint own = record.y, sizes = record.z, lows = record.w;
    uvec4 outer = (uvec4(sizes) >> uvec4(0u, 5u, 10u, 0u)) & 31u, inner = (uvec4(sizes) >> uvec4(15u, 20u, 25u, 0u)) & 31u;
    uint outerBits = outer.x + outer.y + outer.z, innerBits = inner.x + inner.y + inner.z;
    uint at = (sizes >> 30u | (lows >> 15u) << 2u) + knots.pair * (outerBits + innerBits), element = place.segment.y + at / 128u;
    uvec4 a = table(element), b = table(element + 1u);
    at = at & 127u;
    // The last two knots of an even number of knots have none in between.
    bool single = knots.middle == knots.last;
    SUPPLE_PRECISE vec3 low = lowNumbers(own, lows, turns);
    SUPPLE_PRECISE vec3 first = low + threeNumbers(a, b, at, outer);
    SUPPLE_PRECISE vec3 off = threeNumbers(a, b, at + outerBits, inner) -
                              vec3(float((1u << inner.x) >> 1u), float((1u << inner.y) >> 1u), float((1u << inner.z) >> 1u));
    SUPPLE_PRECISE vec3 last = low + threeNumbers(a, b, at + outerBits + (single ? 0u : innerBits), outer);
    SUPPLE_PRECISE vec3 middle = onLine(first, last, knots.middle - knots.first, knots.last - knots.first) + off;
    bool toLast = knots.second || single;
    uint begin = knots.second ? knots.middle : knots.first, end = toLast ? knots.last : knots.middle;
    SUPPLE_PRECISE float step = powerOfHalf(int(own >> 27u) - 8);
    SUPPLE_PRECISE vec3 from = first, to = middle;
    if (knots.second) from = middle;
    if (toLast) to = last;
    SUPPLE_PRECISE PackedSpan span;
    span.from = from * step;
    span.to = to * step;
    span.part = (float(place.at.frame - begin) + place.at.part) * recip(float(end - begin));
    return span;
}
vec3 packedVector(PackedSpan span) {
    SUPPLE_PRECISE vec3 mixed = span.from + (span.to - span.from) * span.part;
    return mixed;
}
vec4 packedTurn(PackedSpan span, uint own) {
    vec4 q = quarterTangentTurn(span.from), p = quarterTangentTurn(span.to);
    SUPPLE_PRECISE float d = dot4(q, p);
    SUPPLE_PRECISE vec4 nearer = p * (d < 0.0f ? -1.0f : 1.0f);
    SUPPLE_PRECISE vec4 between = q + (nearer - q) * slerpShare(span.part, min(abs(d), 1.0f));
    SUPPLE_PRECISE vec3 reference = (fiveBits(own) - 15.0f) * 0.06666666667f;
    return turned(quarterTangentTurn(reference), between);
}

vec3 packedConstant(uvec4 sections, uint constant) {
    uvec4 two = table(sections.y + constant / 2u);
    uint x = (constant & 1u) == 0u ? two.x : two.z, y = (constant & 1u) == 0u ? two.y : two.w;
    float step = powerOfHalf(27 - 2 * int(y >> 28u));
    SUPPLE_PRECISE vec3 v =
        vec3(float(wholeOf(x)), float(wholeOf(x >> 20u | y << 12u)), float(wholeOf(y >> 8u))) * step;
    return v;
}

// The node's transform in a packed clip. Properties without data keep the rest pose.
Transform packedTransform(uint head, vec2 time, uint node, Transform rest) {
    PackedPlace place = packedPlace(head, time);
    PackedPaths own = packedPaths(place.sections, node);
    SUPPLE_PRECISE Transform t = rest;
    uint paths = own.changing | own.constant;
    do { // see clip.h
        if (paths != 0u) {
            uint path = uint(findLSB(paths));
            SUPPLE_PRECISE vec4 value = vec4(0.0f);
            if (((own.changing >> path) & 1u) != 0u) {
                uvec4 record = table(place.segment.x + own.property);
                PackedSpan span = packedSpan(place, record, path == 1u);
                value = vec4(packedVector(span), 0.0f);
                if (path == 1u) value = packedTurn(span, record.y);
                own.property += 1u;
            } else {
                SUPPLE_PRECISE vec3 v = packedConstant(place.sections, own.number);
                value = vec4(v, 0.0f);
                if (path == 1u) value = quarterTangentTurn(v);
                own.number += 1u;
            }
            if (path == 0u) t.translation = vec3(value);
            if (path == 1u) t.rotation = value;
            if (path == 2u) t.scale = vec3(value);
            paths &= paths - 1u;
        }
    } while (paths != 0u);
    return t;
}

vec4 withComponent(vec4 v, uint k, float x) {
    SUPPLE_PRECISE vec4 result = v;
    if (k == 0u) result.x = x;
    if (k == 1u) result.y = x;
    if (k == 2u) result.z = x;
    if (k == 3u) result.w = x;
    return result;
}
// Four morph weights. They are packed in threes, as translations of nodes behind the last.
vec4 packedWeights(uint head, vec2 time, uint quad, vec4 rest) {
    PackedPlace place = packedPlace(head, time);
    SUPPLE_PRECISE vec4 weights = rest;
    uint three = 4u * quad / 3u, end = min(three + 2u, (push.morphCount + 2u) / 3u);
    do { // see clip.h
        if (three < end) {
            PackedPaths own = packedPaths(place.sections, push.nodeCount + three);
            SUPPLE_PRECISE vec3 values = vec3(0.0f);
            if (own.changing != 0u) {
                values = packedVector(packedSpan(place, table(place.segment.x + own.property), false));
            } else if (own.constant != 0u) {
                values = packedConstant(place.sections, own.number);
            }
            uint count = (own.changing | own.constant) != 0u ? 3u : 0u;
            for (uint k = 0u; k < count; ++k) {
                uint target = 3u * three + k;
                if (target / 4u == quad) {
                    weights = withComponent(weights, target & 3u, k == 0u ? values.x : k == 1u ? values.y : values.z);
                }
            }
        }
        ++three;
    } while (three < end);
    return weights;
}
