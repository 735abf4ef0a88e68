// Joints that swing: steps of an instance on the grid of times, then what it shows between the last two. Needs what nodes.h
// needs; colliders.h; of what is stepped or shown nodeLocal(), keepLocal(), nodeGlobal(), keepGlobal(),
// posedCollider(), keepCollider(); of the instance springRows(), keepSpringRows(), keepSpring().
#include "shaders/pose/nodes.h"

struct SpringTables {
    uint levels, levelCount, chains, chainCount, colliders, colliderCount;
};
SpringTables springTables() {
    uvec4 nodes = table(push.springs), others = table(push.springs + 1u);
    SpringTables all;
    all.levelCount = nodes.x;
    all.levels = nodes.y;
    all.chainCount = nodes.z;
    all.chains = nodes.w;
    all.colliderCount = others.x;
    all.colliders = others.y;
    return all;
}

bool isInChain(uint node) { return (table(kNodeElements * node).y & kNodeInChain) != 0u; }
Affine globalOfParent(uint node) {
    uint parent = parentOf(node);
    SUPPLE_PRECISE Affine global = identity();
    if (parent != kNoNode) global = nodeGlobal(parent);
    return global;
}

// Before chains are stepped: the matrix of a node that stands above them or beside them.
void poseSpringNode(uint node) { keepGlobal(node, combined(globalOfParent(node), localMatrix(node, nodeLocal(node)))); }

// Behind those: a collider, where the pose has it. Chains have not swung, nor what hangs on them.
void poseCollider(uint collider, uint element) {
    uvec4 ids = table(element);
    vec4 point = tableFloats(element + 1u), end = tableFloats(element + 2u);
    SUPPLE_PRECISE Affine m = identity();
    uint node = ids.x;
    for (uint k = 0u; node != kNoNode && k < push.nodeCount && isInChain(node); ++k) {
        m = combined(localMatrix(node, nodeLocal(node)), m);
        node = parentOf(node);
    }
    if (node != kNoNode) m = combined(nodeGlobal(node), m);
    PosedCollider posed = colliderThrough(m, ids.y, point, end);
    keepCollider(collider, posed.point, posed.way);
}

// The number of a collider, by its reference.
uint colliderAt(uint reference) {
    uvec4 four = table(reference / 4u);
    uint k = reference & 3u;
    return k < 2u ? (k == 0u ? four.x : four.y) : (k == 2u ? four.z : four.w);
}

// What joints of a step have in common.
struct SpringStep {
    Affine move;   // of the model's frame at the step before
    Affine place;  // where the instance stands
    vec3 wind;     // in the model's frame
    bool settles;  // tails at rest in the pose
};

// A joint of a chain swings; its rotation then.
vec4 swungRotation(uint element, uvec4 ids, Affine above, Transform own, SpringStep now) {
    vec4 tail = tableFloats(element + 1u), gravity = tableFloats(element + 2u), ways = tableFloats(element + 3u);
    uint center = table(element + 3u).z, at = kSpringJoints + kSpringJointElements * ids.y;
    SUPPLE_PRECISE vec3 along = directionThrough(composed(own), vec3(tail));
    SUPPLE_PRECISE vec3 rest = direction(along);
    SUPPLE_PRECISE vec3 head = through(above, own.translation);
    SUPPLE_PRECISE vec3 bone = directionThrough(above, along);
    SUPPLE_PRECISE float squares = max(dot3(bone, bone), 1e-24f);
    SUPPLE_PRECISE float root = rsqrt(squares);
    SUPPLE_PRECISE float size = squares * root;
    SUPPLE_PRECISE vec3 axis = bone * root;
    SUPPLE_PRECISE Affine frame = identity();
    SUPPLE_PRECISE Affine move = now.move;
    if (center != kNoNode) {
        frame = nodeGlobal(center);
        move = frame;
    }
    Affine kept = springRows(at); // the tails of the last two steps, the offset of the last
    SUPPLE_PRECISE vec3 last = through(move, vec3(kept.x));
    SUPPLE_PRECISE vec3 before = through(move, vec3(kept.y));
    SUPPLE_PRECISE vec3 pull = worldDirection(now.place, vec3(gravity)) * gravity.w;
    SUPPLE_PRECISE vec3 carried = now.wind * (kStepSeconds * (1.0f - ways.x)); // what drag takes, the air gives
    pull = pull + carried;
    SUPPLE_PRECISE vec3 way = directionOr(swungTail(last, before, axis, tail.w, ways.x, pull) - head, axis);
    SUPPLE_PRECISE vec3 next = head + way * size;
    for (uint k = 0u; k < ids.w; ++k) {
        PosedCollider posed = posedCollider(colliderAt(ids.z + k));
        next = pushedOut(next, ways.y, posed.point, posed.way);
        way = directionOr(next - head, way);
        next = head + way * size;
    }
    SUPPLE_PRECISE vec3 turnedWay = directionWithin(above, way, rest);
    SUPPLE_PRECISE vec4 offset = vec4(turnedWay - rest, 0.0f);
    SUPPLE_PRECISE vec4 offsetBefore = kept.z;
    SUPPLE_PRECISE vec4 rotation = turned(swingTurn(rest, turnedWay), unit(own.rotation));
    if (now.settles) {
        next = head + bone;
        last = next;
        offset = vec4(0.0f);
        offsetBefore = vec4(0.0f);
        rotation = own.rotation;
    }
    if (center != kNoNode) {
        next = within(frame, next);
        last = within(frame, last);
    }
    keepSpringRows(at, rowsOf(vec4(next, 0.0f), vec4(last, 0.0f), offset));
    keepSpring(at + 3u, offsetBefore);
    return rotation;
}

// The nodes of a chain, each behind those above it; most hang on the one before.
void stepChain(uvec4 chain, SpringStep now) {
    uint last = kNoNode;
    SUPPLE_PRECISE Affine global = identity();
    for (uint element = chain.x; element < chain.y; element += kSpringNodeElements) {
        uvec4 ids = table(element);
        SUPPLE_PRECISE Affine above = global;
        if (last == kNoNode || parentOf(ids.x) != last) above = globalOfParent(ids.x);
        SUPPLE_PRECISE Transform own = nodeLocal(ids.x);
        if (ids.y != kNoNode) own.rotation = swungRotation(element, ids, above, own, now);
        global = combined(above, localMatrix(ids.x, own));
        keepGlobal(ids.x, global);
        last = ids.x;
    }
}

// What is shown of a node of a chain, `part` of the way from the last step but one to the last; of that, `fade`.
void showSpringNode(uint element, float part, float fade) {
    uvec4 ids = table(element);
    for (bool swings = ids.y != kNoNode; swings; swings = false) {
        Affine kept = springRows(kSpringJoints + kSpringJointElements * ids.y + 1u);
        vec3 now = vec3(kept.y), before = vec3(kept.z);
        SUPPLE_PRECISE vec3 offset = (before + (now - before) * part) * fade;
        SUPPLE_PRECISE Transform own = nodeLocal(ids.x);
        SUPPLE_PRECISE vec3 rest = direction(directionThrough(composed(own), vec3(tableFloats(element + 1u))));
        SUPPLE_PRECISE vec3 way = directionOr(rest + offset, rest);
        if (offset != vec3(0.0f)) own.rotation = turned(swingTurn(rest, way), unit(own.rotation));
        keepLocal(ids.x, own);
    }
}
