// A vertex that jiggles: a spring holds it to its goal, where joints have it. Its step is exact, so it is stable for every
// stiffness: within a step the goal goes straight, and the offset from it is that of a damped spring.
#ifndef SUPPLE_SOFT_JIGGLE_H
#define SUPPLE_SOFT_JIGGLE_H

#include "shaders/pose/limbs.h"
#include "shaders/pose/swing.h"
#include "shaders/shared/jiggle.h"
#include "shaders/shared/pose.h"

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
};

// `spring`: the exponential of a step; `limit`: of the offset.
SUPPLE_SHARED_FUNCTION Jiggling jiggledStep(Jiggling own, vec3 goal, JiggleStep now, vec4 spring, float limit) {
    SUPPLE_PRECISE Jiggling next = own;
    SUPPLE_PRECISE vec3 goalSpeed = (goal - through(now.move, own.goal)) * float(kSpringSteps);
    SUPPLE_PRECISE vec3 speedBefore = directionThrough(now.move, own.goalSpeed);
    if (now.jumps) goalSpeed = speedBefore;
    // What the goal is faster by, the vertex is slower by. Behind the first step nobody knows how fast the goal has been.
    SUPPLE_PRECISE vec3 kick = goalSpeed - speedBefore;
    if (own.known < 2.0f) kick = vec3(0.0f);
    SUPPLE_PRECISE vec3 y = directionThrough(now.move, own.offset);
    SUPPLE_PRECISE vec3 z = directionThrough(now.move, own.speed) - kick;
    SUPPLE_PRECISE vec3 offset = y * spring.x + z * spring.y;
    SUPPLE_PRECISE vec3 speed = y * spring.z + z * spring.w;
    SUPPLE_PRECISE float squares = dot3(offset, offset);
    SUPPLE_PRECISE float held = limit * rsqrt(max(squares, 1e-30f));
    if (squares > limit * limit) {
        offset = offset * held;
        speed = speed * held;
    }
    // A spring decays for ever, and numbers that a host has made absurd must not stay.
    SUPPLE_PRECISE float energy = dot3(offset, offset) + dot3(speed, speed);
    bool moves = energy >= 1e-20f && energy < 1e24f;
    next.offset = moves ? offset : vec3(0.0f);
    next.speed = moves ? speed : vec3(0.0f);
    next.before = own.offset;
    next.goal = goal;
    next.goalSpeed = goalSpeed;
    next.known = now.jumps ? own.known : 2.0f;
    if (now.settles || own.known == 0.0f) next = settledAt(goal);
    return next;
}

// What is added to the shown vertex: `part` of the way from the last step but one to the last.
SUPPLE_SHARED_FUNCTION vec3 shownOffset(Jiggling own, float part, float weight, Affine place) {
    SUPPLE_PRECISE vec3 offset = (own.before + (own.offset - own.before) * part) * weight;
    return directionThrough(place, offset);
}

SUPPLE_SHARED_END

#endif
