// A vertex that jiggles: a spring holds it to its goal, where joints have it. Its step is exact, so it is stable for every
// stiffness: within a step the goal goes straight, and the offset from it is that of a damped spring.
#ifndef SUPPLE_SOFT_JIGGLE_H
#define SUPPLE_SOFT_JIGGLE_H

#include "shaders/pose/limbs.h"
#include "shaders/pose/swing.h"
#include "shaders/shared/pose.h"
#include "shaders/shared/soft.h"

SUPPLE_SHARED_BEGIN

struct Jiggling {
    vec3 offset, speed, goal, goalSpeed, before;
    float known;
};

SUPPLE_SHARED_FUNCTION Jiggling jigglingOf(vec4 a, vec4 b, vec4 c, vec4 d) {
    Jiggling own;
    own.offset = vec3(a);
    own.speed = vec3(b);
    own.goal = vec3(c);
    own.goalSpeed = vec3(d);
    own.before = vec3(a.w, b.w, c.w);
    own.known = d.w;
    return own;
}

// At rest where the pose has it.
SUPPLE_SHARED_FUNCTION Jiggling settledAt(vec3 goal) {
    Jiggling own;
    own.offset = own.speed = own.goalSpeed = own.before = vec3(0.0f);
    own.goal = goal;
    own.known = 1.0f;
    return own;
}

struct JiggleStep {
    Affine move;  // of the model's frame at the step before
    bool settles; // at rest in the pose
    bool jumps;   // the instance is elsewhere and has not moved there: what jiggles goes on as if nothing had happened
    uint skipped; // if it settles: steps that are left out since the last, over which what there was swings on; 0: at rest
};

// The product of two such matrices, which have their rows one after the other.
SUPPLE_SHARED_FUNCTION vec4 springProduct(vec4 a, vec4 b) {
    SUPPLE_PRECISE vec4 product =
        vec4(a.x * b.x + a.y * b.z, a.x * b.y + a.y * b.w, a.z * b.x + a.w * b.z, a.z * b.y + a.w * b.w);
    return product;
}

SUPPLE_SHARED_FUNCTION Jiggling sprung(Jiggling own, vec4 spring) {
    SUPPLE_PRECISE Jiggling next = own;
    SUPPLE_PRECISE vec3 offset = own.offset * spring.x + own.speed * spring.y;
    SUPPLE_PRECISE vec3 speed = own.offset * spring.z + own.speed * spring.w;
    next.offset = offset;
    next.speed = speed;
    return next;
}

SUPPLE_SHARED_FUNCTION Jiggling heldWithin(Jiggling own, float limit) {
    SUPPLE_PRECISE Jiggling next = own;
    SUPPLE_PRECISE float squares = dot3(own.offset, own.offset);
    SUPPLE_PRECISE float held = limit * rsqrt(max(squares, 1e-30f));
    if (squares > limit * limit) {
        next.offset = own.offset * held;
        next.speed = own.speed * held;
    }
    return next;
}

// A spring decays for ever, and numbers that a host has made absurd must not stay.
SUPPLE_SHARED_FUNCTION Jiggling stilled(Jiggling own) {
    SUPPLE_PRECISE Jiggling next = own;
    SUPPLE_PRECISE float energy = dot3(own.offset, own.offset) + dot3(own.speed, own.speed);
    bool moves = energy >= 1e-20f && energy < 1e24f;
    if (!moves) next.offset = next.speed = vec3(0.0f);
    return next;
}

// Steps in which nobody knows how the goal has moved, by the bits of their number.
SUPPLE_SHARED_FUNCTION Jiggling sprungOften(Jiggling own, vec4 spring, uint steps, float limit) {
    SUPPLE_PRECISE Jiggling next = own;
    SUPPLE_PRECISE vec4 power = spring;
    for (uint bit = 1u; bit <= min(steps, kMostSkippedSteps); bit = bit << 1u) {
        if ((steps & bit) != 0u) next = sprung(next, power);
        power = springProduct(power, power);
    }
    return stilled(heldWithin(next, limit));
}

// `spring`: the exponential of a step; `limit`: of the offset.
SUPPLE_SHARED_FUNCTION Jiggling jiggledStep(Jiggling before, vec3 goal, JiggleStep now, vec4 spring, float limit) {
    bool goesOn = now.settles && now.skipped != 0u && before.known != 0.0f;
    SUPPLE_PRECISE Jiggling own = before;
    SUPPLE_PRECISE Affine move = now.move;
    if (goesOn) {
        own = sprungOften(before, spring, now.skipped - 1u, limit);
        move = identity();
    }
    SUPPLE_PRECISE vec3 goalSpeed = (goal - through(move, own.goal)) * float(kStepsASecond);
    SUPPLE_PRECISE vec3 speedBefore = directionThrough(move, own.goalSpeed);
    if (now.jumps) goalSpeed = speedBefore;
    // What the goal is faster by, the vertex is slower by. The first speed is not believed: the host may have placed the
    // instance since the step behind which it began, or have moved it for a part of the next one only.
    SUPPLE_PRECISE vec3 kick = goalSpeed - speedBefore;
    if (own.known < 3.0f || goesOn) kick = vec3(0.0f);
    SUPPLE_PRECISE Jiggling next = own;
    next.offset = directionThrough(move, own.offset);
    next.speed = directionThrough(move, own.speed) - kick;
    next = stilled(heldWithin(sprung(next, spring), limit));
    next.before = own.offset;
    next.goal = goal;
    next.goalSpeed = goalSpeed;
    next.known = now.jumps ? own.known : min(own.known + 1.0f, 3.0f);
    if (goesOn) {
        next.goalSpeed = vec3(0.0f);
        next.known = 1.0f;
    } else if (now.settles || own.known == 0.0f) {
        next = settledAt(goal);
    }
    return next;
}

// What is added to the shown vertex: `part` of the way from the last step but one to the last.
SUPPLE_SHARED_FUNCTION vec3 shownOffset(Jiggling own, float part, float weight, Affine place) {
    SUPPLE_PRECISE vec3 offset = (own.before + (own.offset - own.before) * part) * weight;
    return directionThrough(place, offset);
}

SUPPLE_SHARED_END

#endif
