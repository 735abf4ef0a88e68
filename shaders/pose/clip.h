// Sampling a clip, node by node: the keys of a channel, STEP, LINEAR and CUBICSPLINE as glTF has them, clamped outside.
// Needs table(), tableFloats(), packedFloat() and `push`: GLSL has them from tables.glsl; in C++ this is the inside of a
// class (skinning/pose_twin.cpp), as nodes.h, layers.h and root.h are. Needs `const bool kKeyedClips`, `kPackedClips`: whether
// some clips have channels of keys, and some are packed.
//
// Loops of much code are tested at the bottom: one that is tested at the top costs lavapipe one more turn, with no lane. What a turn
// does stands in an `if`, for two reasons: there may be no turn at all, and lavapipe goes on computing lanes that have left while
// others go round. The `if` compares anew: if it asked the very bool by which the loop is left, Mesa would take it for true and leave
// it out.
#include "shaders/pose/knots.h"
#include "shaders/pose/nodes.h"
#include "shaders/pose/packed.h"

// Where a time falls among a channel's keys: at key `key`, or at fraction `t` of the `seconds` from it to the next one.
struct KeySpan {
    uint key;
    float t;
    float seconds; // 0: the key's own value
};
KeySpan keysAt(uvec4 channel, vec2 time) {
    // The last key that is not later than the time; a key's own time gives its value as it is. Most clips have keys at even times,
    // so that the first guess is right; else the key is one of `low` to `high`, which are the same if the time is outside of all.
    uint low = 0u, high = max(channel.x >> 2u, 1u) - 1u;
    uint key = uint(clamp(time.x * uintBitsToFloat(channel.y), 0.0f, float(max(high, 1u) - 1u)));
    float begin = 0.0f, end = 0.0f;
    bool between = false;
    do {
        if (low < high) {
            begin = packedFloat(channel.z, key);
            end = packedFloat(channel.z, key + 1u);
            bool before = earlier(time, vec2(begin, 0.0f)), behind = !earlier(time, vec2(end, 0.0f));
            between = !before && !behind;
            if (before) high = key;
            if (behind) low = key + 1u;
            if (between) high = low;
            if (!between) key = (low + high) / 2u;
        }
    } while (low < high);
    KeySpan span;
    span.key = between ? key : low;
    span.t = 0.0f;
    span.seconds = 0.0f;
    if (between && (channel.x & 3u) != kStepKeys) {
        SUPPLE_PRECISE float seconds = end - begin;
        SUPPLE_PRECISE float passed = (time.x - begin) + time.y;
        SUPPLE_PRECISE float t = passed * recip(max(seconds, 1e-30f));
        if (passed > 0.0f) {
            span.t = t;
            span.seconds = seconds;
        }
    }
    return span;
}

// Hermite's weights of a key, its tangent on leaving, the next key and its tangent on arriving.
vec4 splineWeights(KeySpan span) {
    SUPPLE_PRECISE float t = span.t;
    SUPPLE_PRECISE float t2 = t * t;
    SUPPLE_PRECISE float t3 = t2 * t;
    SUPPLE_PRECISE vec4 weights = vec4((2.0f * t3 - 3.0f * t2) + 1.0f, span.seconds * ((t3 - 2.0f * t2) + t), 3.0f * t2 - 2.0f * t3,
                                span.seconds * (t3 - t2));
    return weights;
}

vec4 channelAt(uint record, vec2 time, bool turns) {
    uvec4 channel = table(record);
    KeySpan span = keysAt(channel, time);
    bool cubic = (channel.x & 3u) == kCubicKeys;
    uint own = channel.w + (cubic ? 3u * span.key + 1u : span.key);
    uint next = own + (cubic ? 3u : 1u);
    SUPPLE_PRECISE vec4 value = tableFloats(own);
    if (span.seconds > 0.0f) {
        vec4 other = tableFloats(next);
        if (cubic) {
            vec4 w = splineWeights(span);
            value = (value * w.x + tableFloats(own + 1u) * w.y) + (other * w.z + tableFloats(next - 1u) * w.w);
        } else if (turns) {
            value = slerp(value, other, span.t);
        } else {
            value = value + (other - value) * span.t;
        }
    }
    return value;
}

Transform clipTransform(uint clip, vec2 time, uint node) {
    uint nodes = table(push.clips + clip).x;
    SUPPLE_PRECISE Transform t = restTransform(node);
    if (kPackedClips && (nodes & kPackedClip) != 0u) {
        uint head = nodes ^ kPackedClip;
        t = packedTransform(head, time, node, t);
        nodes = table(head + 2u).x;
    }
    if (kKeyedClips) {
        uvec4 channels = nodes != 0u ? table(nodes + node) : uvec4(0u);
        // A loop over those that are there, so that the code is there once.
        uint paths = (channels.x != 0u ? 1u : 0u) | (channels.y != 0u ? 2u : 0u) | (channels.z != 0u ? 4u : 0u);
        do {
            if (paths != 0u) {
                uint path = uint(findLSB(paths));
                uint record = path == 0u ? channels.x : path == 1u ? channels.y : channels.z;
                SUPPLE_PRECISE vec4 value = channelAt(record, time, path == 1u);
                if (path == 0u) t.translation = vec3(value);
                if (path == 1u) t.rotation = value;
                if (path == 2u) t.scale = vec3(value);
                paths &= paths - 1u;
            }
        } while (paths != 0u);
    }
    return t;
}

// A morph target's weight, of a channel that is not packed.
float channelWeight(uvec4 entry, vec2 time) { // (channel, place in a value, numbers of a value, 0)
    uvec4 channel = table(entry.x);
    KeySpan span = keysAt(channel, time);
    bool cubic = (channel.x & 3u) == kCubicKeys;
    uint stride = entry.z;
    uint own = (cubic ? 3u * span.key + 1u : span.key) * stride + entry.y;
    uint next = own + (cubic ? 3u : 1u) * stride;
    SUPPLE_PRECISE float weight = packedFloat(channel.w, own);
    if (span.seconds > 0.0f) {
        float other = packedFloat(channel.w, next);
        if (cubic) {
            vec4 w = splineWeights(span);
            weight = (weight * w.x + packedFloat(channel.w, own + stride) * w.y) +
                     (other * w.z + packedFloat(channel.w, next - stride) * w.w);
        } else {
            weight = weight + (other - weight) * span.t;
        }
    }
    return weight;
}
// Four morph weights.
vec4 clipMorphWeights(uint clip, vec2 time, uint quad) {
    uvec4 own = table(push.clips + clip);
    SUPPLE_PRECISE vec4 weights = tableFloats(push.restWeights + quad);
    if (kPackedClips && (own.x & kPackedClip) != 0u) {
        weights = packedWeights(own.x ^ kPackedClip, time, quad, weights);
    }
    if (kKeyedClips) {
        uint count = own.y != 0u ? min(push.morphCount - 4u * quad, 4u) : 0u, k = 0u;
        do {
            if (k < count) {
                uvec4 entry = table(own.y + 4u * quad + k);
                if (entry.x != 0u) weights = withComponent(weights, k, channelWeight(entry, time));
            }
            ++k;
        } while (k < count);
    }
    return weights;
}
