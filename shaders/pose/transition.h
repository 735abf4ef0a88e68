// Transitions: an instance goes over from what it has shown to what it plays now. What was shown, and how fast it moved, was
// kept when that began (skinning/transition.h), so that it is a function of the group's time. Two kinds:
//   dead blending (Holden 2023): what was shown moves on, ever more slowly, and what is played is blended in;
//   quintic (Bollo 2018): the difference between the two goes to zero, by a polynomial whose second derivative is 0 at the end.
// Needs what layers.h needs, and `const bool kTransitions`: whether an instance may be in one.

struct Transition {
    uint kind;   // kNoTransition: none, or it is over
    float since; // seconds
    float seconds;
    float phase; // 0..1
};

Transition transitionOf(uint first) {
    SUPPLE_PRECISE Transition own;
    own.kind = kNoTransition;
    own.since = 0.0f;
    own.seconds = 0.0f;
    own.phase = 0.0f;
    if (kTransitions && (state(first).y & kStateTransition) != 0u) {
        vec4 course = stateFloats(first + push.transition);
        vec2 now = vec2(push.timeHigh, push.timeLow);
        own.seconds = course.z;
        own.since = timeSum(now, -vec2(course)).x;
        if (own.since < own.seconds) own.kind = state(first + push.transition).w;
        // Just before it began, speeds are as they were: whoever asks for the speed then finds it.
        own.since = max(own.since, -kTransitionStep);
        own.phase = clamp(own.since * recip(max(own.seconds, 1e-30f)), 0.0f, 1.0f);
    }
    return own;
}

// How long the speed that was kept has moved what was shown: at most kTransitionReach seconds, however late it is.
float carriedFor(Transition own) {
    SUPPLE_PRECISE float slowed = 1.0f + max(own.since, 0.0f) * kTransitionDecay;
    SUPPLE_PRECISE float seconds = own.since * recip(slowed);
    return seconds;
}
// The part of what is played.
float blendedIn(Transition own) {
    SUPPLE_PRECISE float part = (own.phase * own.phase) * (3.0f - 2.0f * own.phase);
    return part;
}
// The part of the difference that is left.
float differenceLeft(Transition own) {
    SUPPLE_PRECISE float rest = 1.0f - own.phase;
    SUPPLE_PRECISE float left = ((rest * rest) * rest) * (1.0f + own.phase * (3.0f + 6.0f * own.phase));
    return left;
}
// How long the difference of speeds has moved it, if it takes so many seconds until it has stopped.
float driftedFor(Transition own, float seconds) {
    SUPPLE_PRECISE float phase = clamp(own.since * recip(max(seconds, 1e-30f)), 0.0f, 1.0f);
    SUPPLE_PRECISE float rest = 1.0f - phase;
    SUPPLE_PRECISE float drifted = seconds * ((phase * ((rest * rest) * rest)) * (1.0f + 3.0f * phase));
    if (own.since < 0.0f) drifted = own.since;
    return drifted;
}

// A rotation by its axis, as long as the tangent of a quarter of its angle.
vec4 quarterTangentTurn(vec3 r) {
    SUPPLE_PRECISE float squares = dot3(r, r);
    SUPPLE_PRECISE float scale = recip(1.0f + squares);
    SUPPLE_PRECISE vec3 axis = r * (scale + scale);
    SUPPLE_PRECISE float w = (1.0f - squares) * scale;
    return vec4(axis, w);
}

// The local transform of a node that is shown, where `played` is what the layers say.
Transform shownTransform(uint first, uint node, Transform played) {
    SUPPLE_PRECISE Transform shown = played;
    Transition own = transitionOf(first);
    if (own.kind != kNoTransition) {
        uint element = first + push.transition + 1u + kTransitionElements * node;
        vec4 turn = stateFloats(element), spin = stateFloats(element + 1u), place = stateFloats(element + 2u),
             speed = stateFloats(element + 3u);
        SUPPLE_PRECISE vec3 scale = vec3(spin.w, place.w, speed.w);
        if (own.kind == kDeadBlending) {
            float carried = carriedFor(own);
            SUPPLE_PRECISE Transform before = played;
            before.translation = vec3(place) + vec3(speed) * carried;
            SUPPLE_PRECISE vec3 along = vec3(spin) * carried;
            before.rotation = turned(quarterTangentTurn(along), turn);
            before.scale = scale;
            shown = blended(before, played, blendedIn(own));
        } else {
            float left = differenceLeft(own);
            SUPPLE_PRECISE vec3 tangent = vec3(turn) * left + vec3(spin) * driftedFor(own, turn.w);
            shown.translation =
                (played.translation + vec3(place) * left) + vec3(speed) * driftedFor(own, own.seconds);
            shown.rotation = turned(quarterTangentTurn(tangent), unit(played.rotation));
            shown.scale = played.scale + scale * left;
        }
    }
    return shown;
}

// Between the smaller of `weight` and 0, and the larger of it and 1: what moves on must not leave what clips say.
float keptInside(float moved, float weight) { return clamp(moved, min(weight, 0.0f), max(weight, 1.0f)); }
vec4 allKeptInside(vec4 moved, vec4 weights) {
    return vec4(keptInside(moved.x, weights.x), keptInside(moved.y, weights.y), keptInside(moved.z, weights.z),
                keptInside(moved.w, weights.w));
}

// Four morph weights; those that the host has set stand before transitions.
vec4 shownWeights(uint first, uint quad, vec4 played) {
    SUPPLE_PRECISE vec4 shown = played;
    Transition own = transitionOf(first);
    if (own.kind != kNoTransition && (state(first).y & kStateHostWeights) == 0u) {
        uint element = first + push.transition + 1u + kTransitionElements * push.nodeCount + 2u * quad;
        vec4 from = stateFloats(element), speed = stateFloats(element + 1u);
        if (own.kind == kDeadBlending) {
            SUPPLE_PRECISE vec4 moved = from + speed * carriedFor(own);
            SUPPLE_PRECISE vec4 before = allKeptInside(moved, from);
            shown = before + (played - before) * blendedIn(own);
        } else {
            SUPPLE_PRECISE vec4 moved = (played + from * differenceLeft(own)) + speed * driftedFor(own, own.seconds);
            shown = allKeptInside(moved, played);
        }
    }
    return shown;
}
