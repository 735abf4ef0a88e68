// Modifiers of an instance (shaders/shared/pose.h), in order, each after the one before. Needs state(), what nodes.h needs,
// `push`, and what is posed: nodeLocal(), keepLocal(), placement(), heldAt(), keepHeld(). Loops with one turn stand for
// branches: where no lane needs one, lavapipe does not step through it.
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

Modifier modifierAt(uint element) {
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
        own.target = within(placement(), own.target);
        if (own.kind == kModifierTwoBone || own.kind == kModifierPlant) own.pole = within(placement(), own.pole);
    }
    return own;
}

// A joint in model space: a point of its frame, the rotation of what it hangs on, and its own.
struct Placed {
    vec3 position;
    vec4 above;
    vec4 rotation;
};
vec4 localRotation(uint node, Transform t) {
    SUPPLE_PRECISE vec4 q = unit(t.rotation);
    if (isFixed(node)) q = tableFloats(table(kNodeElements * node).z);
    return q;
}
Placed placedPoint(uint node, vec3 point) {
    Transform t = nodeLocal(node);
    SUPPLE_PRECISE Placed placed;
    placed.position = through(localMatrix(node, t), point);
    vec4 own = localRotation(node, t);
    placed.above = noTurn();
    for (uint n = parentOf(node), k = 0u; n != kNoNode && k < push.nodeCount; n = parentOf(n), ++k) {
        Transform parent = nodeLocal(n);
        placed.position = through(localMatrix(n, parent), placed.position);
        placed.above = turned(localRotation(n, parent), placed.above);
    }
    placed.rotation = turned(placed.above, own);
    return placed;
}
Placed placedNode(uint node) { return placedPoint(node, vec3(0.0f)); }

Affine globalAbove(uint node) {
    SUPPLE_PRECISE Affine global = identity();
    for (uint n = parentOf(node), k = 0u; n != kNoNode && k < push.nodeCount; n = parentOf(n), ++k) {
        global = combined(localMatrix(n, nodeLocal(n)), global);
    }
    return global;
}

void keepRotation(uint node, vec4 rotation) {
    SUPPLE_PRECISE Transform t = nodeLocal(node);
    t.rotation = rotation;
    keepLocal(node, t);
}

void setJoint(Modifier own) {
    uint node = chainNode(own, 0u);
    vec4 from = unit(nodeLocal(node).rotation);
    SUPPLE_PRECISE vec4 to = own.rotation;
    if ((own.flags & kModifierModel) != 0u) to = turned(conjugated(placedNode(node).above), to);
    SUPPLE_PRECISE vec4 rotation = to;
    if (own.weight != 1.0f) rotation = slerp(from, to, own.weight);
    keepRotation(node, rotation);
}

void turnJoint(Modifier own) {
    uint node = chainNode(own, 0u);
    vec4 from = unit(nodeLocal(node).rotation);
    vec4 turn = partOfTurn(own.rotation, own.weight);
    SUPPLE_PRECISE vec4 rotation = turned(from, turn);
    if ((own.flags & kModifierModel) != 0u) {
        Placed placed = placedNode(node);
        rotation = turned(turned(conjugated(placed.above), turn), placed.rotation);
    }
    keepRotation(node, rotation);
}

void aimChain(Modifier own) {
    uint last = chainNode(own, own.chainLength - 1u);
    SUPPLE_PRECISE float weight = own.weight;
    for (uint i = 0u; i < own.chainLength; ++i) {
        uint node = chainNode(own, i);
        Placed joint = placedNode(node), eye = placedPoint(last, own.pole);
        vec3 forward = turnedVector(eye.rotation, own.axis);
        SUPPLE_PRECISE vec3 way = own.target - joint.position;
        if (i == 0u) weight = weight * aheadWeight(forward, direction(way));
        vec4 turn = aimedTurn(joint.position, eye.position, forward, own.target, vec3(0.0f, 1.0f, 0.0f));
        SUPPLE_PRECISE float part = weight * (node == last ? 1.0f : own.share);
        turn = partOfTurn(limitedTurn(turn, own.limit.x, own.limit.y), part);
        keepRotation(node, turned(turned(conjugated(joint.above), turn), joint.rotation));
    }
}

// Where the ground is under a foot, in model space, as its normal: what is steeper counts as a slope of 75 degrees.
vec3 groundNormal(Modifier own) {
    SUPPLE_PRECISE vec3 normal = turnedVector(own.rotation, vec3(0.0f, 1.0f, 0.0f));
    if ((own.flags & kModifierWorld) != 0u) {
        Affine m = placement();
        normal = direction((vec3(m.x) * normal.x + vec3(m.y) * normal.y) + vec3(m.z) * normal.z);
    }
    normal.y = max(normal.y, 0.2588f);
    return direction(normal);
}

// Where a foot goes from where it is: to the place where its clips hold it, and up or down by what the ground differs from the
// plane that it has in the rest pose. On a slope the joint stands higher, so that the sole keeps its distance.
vec3 plantedPlace(Modifier own, vec3 joint) {
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
    vec3 normal = groundNormal(own);
    SUPPLE_PRECISE float perUp = recip(normal.y);
    SUPPLE_PRECISE float rise =
        (normal.x * (place.x - own.target.x) + normal.z * (place.z - own.target.z)) * perUp;
    SUPPLE_PRECISE float ground = own.target.y - rise;
    place.y = (ground + (place.y - sole.y)) + sole.x * (perUp - 1.0f);
    return place;
}

void moveJoint(uint node, vec3 position) {
    SUPPLE_PRECISE Transform t = nodeLocal(node);
    t.translation = within(globalAbove(node), position);
    keepLocal(node, t);
}

// The joint goes down until every foot below it that is planted later, by one of `count` modifiers from `element` on, reaches
// its ground. Feet are told, so that they still know how high their clips have them.
void lowerJoint(Modifier own, uint element, uint count) {
    uint node = chainNode(own, 0u);
    SUPPLE_PRECISE float missing = 0.0f;
    for (uint i = 0u; i < count; ++i) {
        Modifier other = modifierAt(element + i * kModifierElements);
        if (other.kind == kModifierPlant && other.weight != 0.0f && hangsOn(chainNode(other, 2u), node)) {
            vec3 joint = placedNode(chainNode(other, 2u)).position;
            SUPPLE_PRECISE float below = (joint.y - plantedPlace(other, joint).y) * other.weight;
            missing = max(missing, below);
        }
    }
    SUPPLE_PRECISE float lowered = min(missing, own.limit.x) * own.weight;
    for (uint foot = 0u; foot < push.footCount; ++foot) {
        if (hangsOn(table(push.contacts + foot).x, node)) {
            SUPPLE_PRECISE vec4 held = heldAt(foot);
            held.y = held.y + lowered;
            keepHeld(foot, held);
        }
    }
    SUPPLE_PRECISE vec3 position = placedNode(node).position;
    position.y = position.y - lowered;
    if (missing > 0.0f) moveJoint(node, position);
}

// Two bones bring their end to a target, or to where it is planted.
void bendLimb(Modifier own) {
    uint a = chainNode(own, 0u), b = chainNode(own, 1u), c = chainNode(own, 2u);
    Placed root = placedNode(a), middle = placedNode(b), end = placedNode(c);
    bool plants = own.kind == kModifierPlant;
    SUPPLE_PRECISE vec3 target = own.target;
    if (plants) target = plantedPlace(own, end.position);
    SUPPLE_PRECISE vec3 goal = end.position + (target - end.position) * own.weight;
    if (own.weight == 1.0f) goal = target;
    SUPPLE_PRECISE float poleWeight = own.poleWeight * own.weight;
    LimbTurns turns = bentLimb(root.position, middle.position, end.position, goal,
                               turnedVector(middle.rotation, own.axis), own.pole, poleWeight, own.soft);
    keepRotation(a, turned(turned(conjugated(root.above), turns.root), root.rotation));
    keepRotation(b, turned(conjugated(turned(turns.root, middle.above)), turned(turns.middle, middle.rotation)));
    SUPPLE_PRECISE vec4 kept = end.rotation;
    if ((own.flags & kModifierEndRotation) != 0u) {
        kept = own.rotation;
        if (own.weight != 1.0f) kept = unit(slerp(end.rotation, own.rotation, own.weight));
    }
    if (plants) {
        vec4 tilt = turnFromTo(vec3(0.0f, 1.0f, 0.0f), groundNormal(own));
        tilt = partOfTurn(limitedTurn(tilt, own.limit.x, own.limit.y), own.weight);
        kept = turned(tilt, end.rotation);
    }
    keepRotation(c, turned(conjugated(turned(turns.middle, end.above)), kept));
}

void handOver(Modifier own) {
    uint node = chainNode(own, 0u);
    Placed placed = placedNode(node);
    SUPPLE_PRECISE vec3 position = own.target;
    SUPPLE_PRECISE vec4 rotation = own.rotation;
    if (own.weight != 1.0f) {
        position = placed.position + (own.target - placed.position) * own.weight;
        rotation = slerp(placed.rotation, own.rotation, own.weight);
    }
    moveJoint(node, position);
    keepRotation(node, turned(conjugated(placed.above), rotation));
}

void modifyInstance(uint first) {
    uint flags = state(first).y;
    uint count = (flags & kStateBindPose) != 0u ? 0u : min((flags >> kStateModifierShift) & 31u, kMaxModifiers);
    uint element = first + modifiersBegin(push.morphCount);
    for (uint i = 0u; i < count; ++i) {
        Modifier own = modifierAt(element + i * kModifierElements);
        bool acts = own.weight != 0.0f;
        for (bool it = acts && own.kind == kModifierSet; it; it = false) setJoint(own);
        for (bool it = acts && own.kind == kModifierAdd; it; it = false) turnJoint(own);
        for (bool it = acts && own.kind == kModifierAim; it; it = false) aimChain(own);
        bool bends = own.kind == kModifierTwoBone || own.kind == kModifierPlant;
        for (bool it = acts && bends; it; it = false) bendLimb(own);
        for (bool it = acts && own.kind == kModifierHandOver; it; it = false) handOver(own);
        for (bool it = acts && own.kind == kModifierLower; it; it = false) {
            lowerJoint(own, element + (i + 1u) * kModifierElements, count - i - 1u);
        }
    }
}
