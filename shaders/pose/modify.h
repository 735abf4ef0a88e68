// Modifiers of an instance (shaders/shared/pose.h), in order, each after the one before. Needs state(), what nodes.h needs,
// `push`, and what is posed: nodeLocal(), keepTranslation(), keepRotation(), placement(), heldAt(), keepHeld(). Loops with one turn
// stand for branches: where no lane needs one, lavapipe does not step through it.
#include "shaders/pose/nodes.h"

struct Modifier {
    uint kind;
    uint flags;
    uint chainLength;
    uvec4 chain; // nodes, two a word
    float weight;
    float share;       // of what is still missing, that joints above the last one take
    vec2 limit;        // cosine and sine of half the angle; to lower: the distance
    vec3 target;       // in model space
    float poleWeight;
    vec3 pole;         // in model space; to aim: the eye, in the joint's frame
    float soft;
    vec4 rotation;
    vec3 axis;
};

uint chainNode(Modifier own, uint i) {
    uint word = i < 2u ? own.chain.x : i < 4u ? own.chain.y : i < 6u ? own.chain.z : own.chain.w;
    return (i & 1u) == 0u ? word & 0xFFFFu : word >> 16u;
}

Modifier modifierAt(uint element, Affine place) {
    uvec4 ids = state(element);
    vec4 course = stateFloats(element + 2u), limits = stateFloats(element + 3u);
    vec4 target = stateFloats(element + 4u), pole = stateFloats(element + 5u);
    vec2 now = posedTime();
    SUPPLE_PRECISE Modifier own;
    own.kind = ids.x & 255u;
    own.flags = ids.x >> 8u;
    own.chainLength = min(ids.y, kMaxChain);
    own.chain = state(element + 1u);
    own.weight = fadedWeight(course.x, course.y, course.z, timeSum(now, -vec2(limits)).x);
    own.share = course.w;
    own.limit = lastTwo(limits);
    own.target = vec3(target);
    own.poleWeight = target.w;
    own.pole = vec3(pole);
    own.soft = pole.w;
    own.rotation = stateFloats(element + 6u);
    own.axis = vec3(stateFloats(element + 7u));
    if ((own.flags & kModifierWorld) != 0u) {
        own.target = within(place, own.target);
        if (own.kind == kModifierTwoBone || own.kind == kModifierPlant) own.pole = within(place, own.pole);
    }
    return own;
}

// A joint in model space: a point of its frame, the rotation of what it hangs on, and its own.
struct Placed {
    vec3 position;
    vec4 above;
    vec4 rotation;
};
Placed nowhere() {
    Placed placed;
    placed.position = vec3(0.0f);
    placed.above = noTurn();
    placed.rotation = noTurn();
    return placed;
}
vec4 localRotation(uint node, Transform t) {
    SUPPLE_PRECISE vec4 q = unit(t.rotation);
    if (isFixed(node)) q = tableFloats(table(kNodeElements * node).z);
    return q;
}
Placed placedPoint(uint node, vec3 point) {
    SUPPLE_PRECISE Placed placed;
    placed.position = point;
    placed.above = noTurn();
    placed.rotation = noTurn();
    vec4 own = noTurn();
    for (uint n = node, k = 0u; n != kNoNode && k <= push.nodeCount; n = parentOf(n), ++k) {
        Transform t = nodeLocal(n);
        vec4 rotation = localRotation(n, t);
        placed.position = through(localMatrix(n, t), placed.position);
        if (k == 0u) own = rotation;
        if (k != 0u) placed.above = turned(rotation, placed.above);
    }
    placed.rotation = turned(placed.above, own);
    return placed;
}

Affine globalAbove(uint node) {
    SUPPLE_PRECISE Affine global = identity();
    for (uint n = parentOf(node), k = 0u; n != kNoNode && k < push.nodeCount; n = parentOf(n), ++k) {
        global = combined(localMatrix(n, nodeLocal(n)), global);
    }
    return global;
}

// Where the ground is under a foot, in model space, as its normal: what is steeper counts as a slope of 75 degrees.
vec3 groundNormal(Modifier own, Affine place) {
    SUPPLE_PRECISE vec3 normal = turnedVector(own.rotation, vec3(0.0f, 1.0f, 0.0f));
    if ((own.flags & kModifierWorld) != 0u) {
        normal = direction((vec3(place.x) * normal.x + vec3(place.y) * normal.y) + vec3(place.z) * normal.z);
    }
    normal.y = max(normal.y, 0.2588f);
    return direction(normal);
}

// Where a foot goes from where it is: to the place where its clips hold it, and up or down by what the ground differs from the
// plane that it has in the rest pose. On a slope the joint stands higher, so that the sole keeps its distance.
vec3 plantedPlace(Modifier own, vec3 joint, vec3 normal) {
    uint foot = table(kNodeElements * chainNode(own, 2u)).w; // 1 + its number
    SUPPLE_PRECISE vec3 place = joint;
    SUPPLE_PRECISE vec2 sole = vec2(0.0f);
    if (foot != 0u) {
        vec4 held = heldAt(foot - 1u); // y: how far it has been lowered
        place.x = joint.x + (held.x - held.w * joint.x);
        place.y = joint.y + held.y;
        place.z = joint.z + (held.z - held.w * joint.z);
        vec4 rest = tableFloats(push.contacts + foot - 1u);
        sole = vec2(rest.y, rest.z);
    }
    SUPPLE_PRECISE float perUp = recip(normal.y);
    SUPPLE_PRECISE float rise =
        (normal.x * (place.x - own.target.x) + normal.z * (place.z - own.target.z)) * perUp;
    SUPPLE_PRECISE float ground = own.target.y - rise;
    place.y = (ground + (place.y - sole.y)) + sole.x * (perUp - 1.0f);
    return place;
}

// Feet that hang on a joint which goes down are told, so that they still know how high their clips have them.
void lowerFeet(uint node, float lowered) {
    for (uint foot = 0u; foot < push.footCount; ++foot) {
        if (hangsOn(table(push.contacts + foot).x, node)) {
            SUPPLE_PRECISE vec4 held = heldAt(foot);
            held.y = held.y + lowered;
            keepHeld(foot, held);
        }
    }
}

// A modifier takes a turn for each joint of a chain that aims; to lower, one for each modifier behind it, and the last for itself;
// else one. In a turn it asks where up to three joints are, and changes up to three. Drivers compile a function once for every place
// that calls it. So what most kinds need is called in one place, and kinds are told apart around it.

// The number of turns of a modifier, by its words. `behind`: the modifiers behind it.
uint turnsOf(uvec4 ids, uint behind) {
    uint kind = ids.x & 255u, turns = 1u;
    if (kind == kModifierAim) turns = clamp(ids.y, 1u, kMaxChain);
    if (kind == kModifierLower) turns = behind + 1u;
    return turns;
}

// Joints as they are before a turn changes any.
struct Joints {
    Placed a, b, c;
};
// Joints `from` to before `end` of the three: of an aim the first is where the chain has come to, and the second the eye.
Joints placedJoints(Modifier own, uint from, uint end, uint step) {
    Joints joints;
    joints.a = nowhere();
    joints.b = nowhere();
    joints.c = nowhere();
    bool aims = own.kind == kModifierAim;
    for (uint k = from; k < end; ++k) {
        uint link = k;
        vec3 point = vec3(0.0f);
        if (aims) link = step;
        if (aims && k == 1u) {
            link = own.chainLength - 1u;
            point = own.pole;
        }
        Placed placed = placedPoint(chainNode(own, link), point);
        if (k == 0u) joints.a = placed;
        if (k == 1u) joints.b = placed;
        if (k == 2u) joints.c = placed;
    }
    return joints;
}

// What a turn gives up to three joints.
struct Rotations {
    vec4 a, b, c;
};
void keepRotations(Modifier own, uint node, uint count, Rotations rotations) {
    for (uint k = 0u; k < count; ++k) {
        SUPPLE_PRECISE vec4 rotation = rotations.a;
        if (k == 1u) rotation = rotations.b;
        if (k == 2u) rotation = rotations.c;
        keepRotation(k == 0u ? node : chainNode(own, k), rotation);
    }
}

// What an aim turns a joint by, without its limit.
vec4 aimed(Modifier own, Joints joints, uint step, SUPPLE_INOUT(float) weight) {
    vec3 forward = turnedVector(joints.b.rotation, own.axis);
    SUPPLE_PRECISE vec3 way = own.target - joints.a.position;
    SUPPLE_PRECISE float ahead = own.weight * aheadWeight(forward, direction(way));
    if (step == 0u) weight = ahead;
    return aimedTurn(joints.a.position, joints.b.position, forward, own.target, vec3(0.0f, 1.0f, 0.0f));
}

// Two bones bring their end to a target. `end`: its rotation in model space.
Rotations bentRotations(Modifier own, Joints joints, vec3 target, vec4 end) {
    SUPPLE_PRECISE vec3 goal = joints.c.position + (target - joints.c.position) * own.weight;
    if (own.weight == 1.0f) goal = target;
    SUPPLE_PRECISE float poleWeight = own.poleWeight * own.weight;
    LimbTurns turns = bentLimb(joints.a.position, joints.b.position, joints.c.position, goal,
                               turnedVector(joints.b.rotation, own.axis), own.pole, poleWeight, own.soft);
    Rotations rotations;
    rotations.a = turned(turned(conjugated(joints.a.above), turns.root), joints.a.rotation);
    rotations.b =
        turned(conjugated(turned(turns.root, joints.b.above)), turned(turns.middle, joints.b.rotation));
    rotations.c = turned(conjugated(turned(turns.middle, joints.c.above)), end);
    return rotations;
}

// What kinds share of a turn's work: rotations on the way from one to another, and parts of turns.
struct Shares {
    vec4 part;  // of what a joint is turned by
    vec4 mixed; // between a joint's rotation and the modifier's
};
Shares sharesOf(Modifier own, Joints joints, bool sets, vec4 local, vec4 turn, float weight) {
    Shares shares;
    shares.part = partOfTurn(turn, weight);
    vec4 from = joints.a.rotation;
    SUPPLE_PRECISE vec4 to = own.rotation;
    if (sets) from = local;
    if (sets && (own.flags & kModifierModel) != 0u) to = turned(conjugated(joints.a.above), to);
    if (own.kind == kModifierTwoBone) from = joints.c.rotation;
    SUPPLE_PRECISE vec4 mixed = to;
    if (own.weight != 1.0f) mixed = slerp(from, to, own.weight);
    shares.mixed = mixed;
    return shares;
}

// One joint's rotation, in the frame of what it hangs on.
vec4 newRotation(Modifier own, Placed joint, vec4 local, Shares shares) {
    SUPPLE_PRECISE vec4 rotation = shares.mixed; // to set
    if (own.kind == kModifierHandOver) rotation = turned(conjugated(joint.above), shares.mixed);
    bool inModel = own.kind == kModifierAim || (own.flags & kModifierModel) != 0u;
    if (own.kind == kModifierAim || own.kind == kModifierAdd) {
        SUPPLE_PRECISE vec4 behind = turned(local, shares.part);
        rotation = behind;
        if (inModel) rotation = turned(turned(conjugated(joint.above), shares.part), joint.rotation);
    }
    return rotation;
}

// A turn of a modifier whose joint is `node`. `own` is the modifier or, if it measures, the one behind it that is asked how far the
// joint must go down.
void takeTurn(Modifier own, Affine place, uint node, uint step, bool measures, SUPPLE_INOUT(float) carried) {
    bool plants = own.kind == kModifierPlant, acts = own.weight != 0.0f;
    bool bends = !measures && (plants || own.kind == kModifierTwoBone);
    bool aims = own.kind == kModifierAim, sets = own.kind == kModifierSet, adds = own.kind == kModifierAdd;
    bool hands = own.kind == kModifierHandOver, lowers = !measures && own.kind == kModifierLower;
    if (measures) acts = acts && plants && hangsOn(chainNode(own, 2u), node);
    if (aims) acts = acts && step < own.chainLength;
    uint end = 0u;
    if (hands || lowers || ((sets || adds) && (own.flags & kModifierModel) != 0u)) end = 1u;
    if (aims) end = 2u;
    if (bends || measures) end = 3u;
    if (!acts) end = 0u;
    Joints joints = placedJoints(own, measures ? 2u : 0u, end, step);

    SUPPLE_PRECISE vec3 target = own.target;
    SUPPLE_PRECISE vec4 turn = own.rotation;
    SUPPLE_PRECISE float weight = own.weight;
    for (bool it = acts && plants; it; it = false) {
        vec3 normal = groundNormal(own, place);
        target = plantedPlace(own, joints.c.position, normal);
        turn = limitedTurn(turnFromTo(vec3(0.0f, 1.0f, 0.0f), normal), own.limit.x, own.limit.y);
    }
    for (bool it = acts && aims; it; it = false) {
        turn = limitedTurn(aimed(own, joints, step, carried), own.limit.x, own.limit.y);
        weight = carried * (step + 1u == own.chainLength ? 1.0f : own.share);
    }
    for (bool it = acts && measures; it; it = false) {
        SUPPLE_PRECISE float below = (joints.c.position.y - target.y) * own.weight;
        carried = max(carried, below);
    }
    SUPPLE_PRECISE vec3 position = joints.a.position + (target - joints.a.position) * own.weight;
    if (own.weight == 1.0f) position = target;
    for (bool it = acts && lowers; it; it = false) {
        SUPPLE_PRECISE float lowered = min(carried, own.limit.x) * own.weight;
        lowerFeet(node, lowered);
        position = joints.a.position;
        position.y = position.y - lowered;
    }
    for (bool it = acts && (hands || (lowers && carried > 0.0f)); it; it = false) {
        keepTranslation(node, within(globalAbove(node), position));
    }

    if (aims) node = chainNode(own, step);
    vec4 local = unit(nodeLocal(node).rotation);
    Shares shares = sharesOf(own, joints, sets, local, turn, weight);
    Rotations rotations;
    rotations.a = newRotation(own, joints.a, local, shares);
    rotations.b = noTurn();
    rotations.c = noTurn();
    for (bool it = acts && bends; it; it = false) {
        SUPPLE_PRECISE vec4 kept = joints.c.rotation;
        if ((own.flags & kModifierEndRotation) != 0u) kept = own.weight != 1.0f ? unit(shares.mixed) : shares.mixed;
        if (plants) kept = turned(shares.part, joints.c.rotation);
        rotations = bentRotations(own, joints, target, kept);
    }
    uint count = bends ? 3u : sets || adds || aims || hands ? 1u : 0u;
    keepRotations(own, node, acts ? count : 0u, rotations);
}

void modifyInstance(uint first) {
    uint flags = state(first).y;
    uint count = (flags & kStateBindPose) != 0u ? 0u : min((flags >> kStateModifierShift) & 31u, kMaxModifiers);
    uint element = first + modifiersBegin(push.morphCount), step = 0u;
    Affine place = placement();
    SUPPLE_PRECISE float carried = 0.0f; // from turn to turn: the weight of an aim, or how far a joint must go down
    for (uint i = 0u; i < count;) {
        uint at = element + i * kModifierElements, read = at;
        uvec4 ids = state(at);
        uint turns = turnsOf(ids, count - i - 1u), node = state(at + 1u).x & 0xFFFFu;
        bool measures = (ids.x & 255u) == kModifierLower && step + 1u < turns;
        if (measures) read = at + (step + 1u) * kModifierElements;
        takeTurn(modifierAt(read, place), place, node, step, measures, carried);
        ++step;
        if (step >= turns) {
            step = 0u;
            carried = 0.0f;
            ++i;
        }
    }
}
