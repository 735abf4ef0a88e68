// Transitions: an instance goes over from what it has shown to what it plays now. What was shown, and how fast it moved, was
// kept when that began (skinning/transition.h), so that it is a function of the group's time. Two kinds:
//   dead blending (Holden 2023): what was shown moves on, ever more slowly, and what is played is blended in;
//   quintic (Bollo 2018): the difference between the two goes to zero, by a polynomial whose second derivative is 0 at the end.
// Needs what layers.h needs, and `const bool kTransitions`: whether an instance may be in one.

struct Transition {
    uint kind;   // kNoTransition: none, or it has not begun, or it is over
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
        vec2 now = posedTime();
        own.seconds = course.z;
        own.since = timeSum(now, -vec2(course)).x;
        if (own.since >= 0.0f && own.since < own.seconds) own.kind = state(first + push.transition).w;
        own.phase = min(max(own.since * recip(max(own.seconds, 1e-30f)), 0.0f), 1.0f);
    }
    return own;
}

// How long the speed that was kept has moved what was shown: at most kTransitionReach seconds, however late it is.
float carriedFor(Transition own) {
    SUPPLE_PRECISE float slowed = 1.0f + own.since * kTransitionDecay;
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
    SUPPLE_PRECISE float phase = min(max(own.since * recip(max(seconds, 1e-30f)), 0.0f), 1.0f);
    SUPPLE_PRECISE float rest = 1.0f - phase;
    SUPPLE_PRECISE float drifted = seconds * ((phase * ((rest * rest) * rest)) * (1.0f + 3.0f * phase));
    return drifted;
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

// What moves on must not leave what clips say: 0 to 1, or as far as one of the two weights is beyond.
float keptInside(float moved, float a, float b) {
    return min(max(moved, min(min(a, b), 0.0f)), max(max(a, b), 1.0f));
}
vec4 allKeptInside(vec4 moved, vec4 a, vec4 b) {
    return vec4(keptInside(moved.x, a.x, b.x), keptInside(moved.y, a.y, b.y), keptInside(moved.z, a.z, b.z),
                keptInside(moved.w, a.w, b.w));
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
            SUPPLE_PRECISE vec4 before = allKeptInside(moved, from, from);
            shown = before + (played - before) * blendedIn(own);
        } else {
            SUPPLE_PRECISE vec4 unmoved = played + from * differenceLeft(own);
            SUPPLE_PRECISE vec4 moved = unmoved + speed * driftedFor(own, own.seconds);
            shown = allKeptInside(moved, unmoved, played);
        }
    }
    return shown;
}
