// A step of a cloth: extended position based dynamics (Macklin, Mueller, Chentanez: XPBD, MIG 2016) in substeps of one iteration
// (Macklin and others: Small Steps in Physics Simulation, SCA 2019), so that multipliers begin at 0 and a constraint's step is
// closed. Lanes of a workgroup share a cloth, and each keeps to vertices of its own. Constraints of a color touch different
// vertices, and sums are those of a tree, so the bits are the same for any number of lanes, a power of two up to kClothSums. Needs
// colliders.h, soft.h; clothTable(); of the instance clothState(), keepClothState(); of the step goalOf(), posedJoint(); of the
// workgroup placeAt(), keepPlace(), sumAt(), keepSum(), colliderAt(), keepCollider(), meet(), laneOf(), laneCount(). In C++ this
// is the inside of a class (skinning/cloth_twin.cpp).

struct ClothStep {
    Affine move;   // of the model's frame at the step before; as that one's, if the instance has not moved there
    Affine before; // the same of the step before
    vec3 down;     // of the world, in the model's frame
    vec3 wind;     // the same
    bool begins;   // at rest
    bool goesOn;   // as it hung, behind steps that are left out
    bool jumps;    // the instance is elsewhere, or has another pose, and has not moved there
    bool kicks;    // both moves are known
    bool light;    // a spring in the place of constraints: it is far away
};

vec4 clothFloats(uint i) { return uintBitsToFloat(clothTable(i)); }

struct ClothTables {
    uint vertexCount, hangingCount, vertices, vertexElements, colorCount, colors, faceCount, faces, colliderCount, colliders;
    uint substeps, state;
    float seconds, kept, lostToAir, farthest, perSecond, gravity, volume, volumeCompliance, hitRadius;
    vec4 spring;
};
ClothTables clothTables(uint cloth) {
    uint i = kClothHeadElements * cloth;
    uvec4 a = clothTable(i), b = clothTable(i + 1u), c = clothTable(i + 2u);
    vec4 d = clothFloats(i + 3u), e = clothFloats(i + 4u);
    ClothTables all;
    all.vertexCount = min(a.x, kMostClothVertices);
    all.hangingCount = a.y;
    all.vertices = a.z;
    all.vertexElements = a.w;
    all.colorCount = b.x;
    all.colors = b.y;
    all.faceCount = b.z;
    all.faces = b.w;
    all.colliderCount = min(c.x, kMostClothColliders);
    all.colliders = c.y;
    all.substeps = c.z;
    all.state = c.w;
    all.seconds = d.x;
    all.kept = d.y;
    all.lostToAir = d.z;
    all.farthest = d.w;
    all.perSecond = e.x;
    all.gravity = e.y;
    all.volume = e.z;
    all.volumeCompliance = e.w;
    all.hitRadius = clothFloats(i + 5u).x;
    all.spring = clothFloats(i + 6u);
    return all;
}
uint clothVertexState(ClothTables all, uint vertex) {
    return all.state + kClothVertices + all.vertexElements * vertex;
}

// No farther than that, in the same direction.
vec3 shortened(vec3 way, float most) {
    float squares = dot3(way, way);
    SUPPLE_PRECISE vec3 held = way * (most * rsqrt(max(squares, 1e-30f)));
    return squares > most * most ? held : way;
}
// Numbers that a host has made absurd must not stay: false for those, too.
bool isNear(vec3 way, float squaresBelow) { return dot3(way, way) < squaresBelow; }

// The speed of the model's frame at a point of it.
vec3 frameSpeed(Affine move, vec3 at) {
    SUPPLE_PRECISE vec3 speed = (at - through(move, at)) * float(kStepsASecond);
    return speed;
}
// The speed in the frame that a vertex gains where the frame's motion changes: in the world it goes on as before.
vec3 kickOf(ClothStep now, vec3 at, vec3 speed) {
    SUPPLE_PRECISE vec3 goesOn = directionThrough(now.move, speed + frameSpeed(now.before, at));
    SUPPLE_PRECISE vec3 kick = shortened((goesOn - frameSpeed(now.move, at)) - speed, kMostClothKick);
    return now.kicks && isNear(kick, 1e6f) ? kick : vec3(0.0f);
}

void beginVertex(ClothTables all, ClothStep now, uint vertex) {
    uint element = all.vertices + kClothVertexElements * vertex, at = clothVertexState(all, vertex);
    uvec4 own = clothTable(element);
    float mobility = uintBitsToFloat(own.y);
    vec3 goal = goalOf(own.x), settled = vec3(clothFloats(element + 1u));
    vec4 a = clothState(at), b = clothState(at + 1u);
    SUPPLE_PRECISE vec3 place = vec3(a);
    SUPPLE_PRECISE vec3 speed = vec3(b);
    SUPPLE_PRECISE vec3 before = vec3(clothState(at + 2u));
    bool sound = isNear(place - goal, 1e8f) && isNear(before, 1e8f) && isNear(speed, 1e12f);
    bool anew = now.begins || !sound, hangs = mobility <= 0.0f;
    SUPPLE_PRECISE vec3 goalBefore = place - before;
    if (anew) before = settled;
    if (anew || now.goesOn || now.jumps) {
        place = goal + before;
        goalBefore = goal;
    }
    if (anew || now.goesOn) speed = vec3(0.0f);
    SUPPLE_PRECISE vec3 air = frameSpeed(now.move, place) - now.wind; // by how much the frame is faster
    if (!isNear(air, 1e12f)) air = vec3(0.0f);
    speed = speed + kickOf(now, place, speed);
    if (hangs) speed = goal;
    keepPlace(vertex, vec4(place, mobility));
    keepClothState(at, vec4(now.light ? goalBefore : place, before.x));
    keepClothState(at + 1u, vec4(speed, before.y));
    keepClothState(at + 2u, vec4(goal, before.z)); // the offset, once the step is done
    keepClothState(at + 3u, vec4(air, 0.0f));
}

// A collider, where the pose has it.
void poseClothCollider(ClothTables all, uint collider) {
    uint element = all.colliders + kColliderElements * collider;
    uvec4 ids = clothTable(element);
    SUPPLE_PRECISE Affine m = identity();
    if (ids.x != kClothFree) m = posedJoint(ids.x);
    PosedCollider posed = colliderThrough(m, ids.y, clothFloats(element + 1u), clothFloats(element + 2u));
    keepCollider(collider, posed.point, posed.way);
}

void predict(ClothTables all, ClothStep now, uint vertex, uint substep) {
    uint at = clothVertexState(all, vertex);
    vec4 own = placeAt(vertex), other = clothState(at);
    vec3 old = vec3(own), speed = vec3(clothState(at + 1u));
    SUPPLE_PRECISE vec3 place = speed; // where one that hangs goes to, straight within the step
    if (own.w > 0.0f) {
        SUPPLE_PRECISE vec3 next = (speed + now.down * all.gravity) * all.kept;
        next = next - (next + vec3(clothState(at + 3u))) * all.lostToAir;
        place = old + shortened(next * all.seconds, all.farthest);
    } else if (substep + 1u < all.substeps) {
        place = old + (speed - old) * recip(float(all.substeps - substep));
    }
    keepClothState(at, vec4(old, other.w));
    keepPlace(vertex, vec4(place, own.w));
}

void holdDistance(uint element) {
    uvec4 own = clothTable(element);
    vec4 a = placeAt(own.x), b = placeAt(own.y);
    SUPPLE_PRECISE vec3 way = vec3(a) - vec3(b);
    SUPPLE_PRECISE float squares = max(dot3(way, way), 1e-12f);
    SUPPLE_PRECISE float root = rsqrt(squares);
    SUPPLE_PRECISE float more = squares * root - uintBitsToFloat(own.z);
    SUPPLE_PRECISE float force = (more * uintBitsToFloat(own.w)) * root;
    SUPPLE_PRECISE vec3 first = vec3(a) - way * (a.w * force);
    SUPPLE_PRECISE vec3 second = vec3(b) + way * (b.w * force);
    keepPlace(own.x, vec4(first, a.w));
    keepPlace(own.y, vec4(second, b.w));
}

// The sum of what lanes have put into kClothSums.
float summed() {
    meet();
    for (uint width = kClothSums / 2u; width > 0u; width = width / 2u) {
        for (uint i = laneOf(); i < width; i += laneCount()) {
            SUPPLE_PRECISE float sum = sumAt(i) + sumAt(i + width);
            keepSum(i, sum);
        }
        meet();
    }
    float sum = sumAt(0u);
    meet();
    return sum;
}

vec3 fromFirst(uint vertex) {
    SUPPLE_PRECISE vec3 way = vec3(placeAt(vertex)) - vec3(placeAt(0u));
    return way;
}
void sumVolume(ClothTables all, uint leaf) {
    SUPPLE_PRECISE float sum = 0.0f;
    for (uint face = leaf; face < all.faceCount; face += kClothSums) {
        uvec4 own = clothTable(all.faces + face);
        SUPPLE_PRECISE float six = dot3(fromFirst(own.x), crossed(fromFirst(own.y), fromFirst(own.z)));
        sum = sum + six;
    }
    keepSum(leaf, sum);
}
void sumGradient(ClothTables all, uint leaf) {
    SUPPLE_PRECISE float sum = 0.0f;
    for (uint vertex = leaf; vertex < all.vertexCount; vertex += kClothSums) {
        uvec4 around = clothTable(all.vertices + kClothVertexElements * vertex + 2u);
        SUPPLE_PRECISE vec3 gradient = vec3(0.0f);
        for (uint face = around.x; face < around.y; ++face) {
            uvec4 own = clothTable(face);
            gradient = gradient + crossed(fromFirst(own.x), fromFirst(own.y));
        }
        keepClothState(clothVertexState(all, vertex) + kClothElements, vec4(gradient, 0.0f));
        SUPPLE_PRECISE float part = placeAt(vertex).w * dot3(gradient, gradient);
        sum = sum + part;
    }
    keepSum(leaf, sum);
}
// What all faces enclose, with the cone from the first vertex over a border.
void holdVolume(ClothTables all) {
    for (uint leaf = laneOf(); leaf < kClothSums; leaf += laneCount()) sumVolume(all, leaf);
    SUPPLE_PRECISE float more = summed() - all.volume;
    for (uint leaf = laneOf(); leaf < kClothSums; leaf += laneCount()) sumGradient(all, leaf);
    SUPPLE_PRECISE float force = more * recip(max(summed() + all.volumeCompliance, 1e-30f));
    for (uint leaf = laneOf(); leaf < kClothSums; leaf += laneCount()) {
        for (uint vertex = leaf; vertex < all.vertexCount; vertex += kClothSums) {
            vec4 own = placeAt(vertex);
            vec3 gradient = vec3(clothState(clothVertexState(all, vertex) + kClothElements));
            SUPPLE_PRECISE vec3 place = vec3(own) - gradient * (own.w * force);
            keepPlace(vertex, vec4(place, own.w));
        }
    }
    meet();
}

// Behind all else: the tether, which nothing moves the other end of; colliders.
vec3 heldPlace(ClothTables all, uint vertex) {
    uvec4 own = clothTable(all.vertices + kClothVertexElements * vertex);
    SUPPLE_PRECISE vec3 place = vec3(placeAt(vertex));
    if (own.z != kClothFree) {
        vec3 held = vec3(placeAt(own.z));
        SUPPLE_PRECISE vec3 way = place - held;
        place = held + shortened(way, uintBitsToFloat(own.w));
    }
    for (uint collider = 0u; collider < all.colliderCount; ++collider) {
        place = pushedOut(place, all.hitRadius, colliderAt(2u * collider), colliderAt(2u * collider + 1u));
    }
    return place;
}
// And the speed that comes of it all.
void finish(ClothTables all, uint vertex) {
    uint at = clothVertexState(all, vertex);
    SUPPLE_PRECISE vec3 place = heldPlace(all, vertex);
    SUPPLE_PRECISE vec3 speed = (place - vec3(clothState(at))) * all.perSecond;
    keepClothState(at + 1u, vec4(speed, clothState(at + 1u).w));
    keepPlace(vertex, vec4(place, placeAt(vertex).w));
}

void runSubstep(ClothTables all, ClothStep now, uint substep) {
    for (uint i = laneOf(); i < all.vertexCount; i += laneCount()) predict(all, now, i, substep);
    meet();
    for (uint color = 0u; color < all.colorCount; ++color) {
        uvec4 own = clothTable(all.colors + color);
        for (uint element = own.x + laneOf(); element < own.y; element += laneCount()) holdDistance(element);
        meet();
    }
    if (all.faceCount > 0u) holdVolume(all);
    for (uint i = laneOf(); i < all.vertexCount; i += laneCount()) { // a lane keeps to the state of its own vertices
        if (i >= all.hangingCount) finish(all, i);
    }
    meet();
}

// A light cloth: in the place of constraints, a spring takes each vertex to where it comes to rest. It begins with the place and the
// speed that constraints have left, and leaves its own to them.
void springVertex(ClothTables all, uint vertex) {
    uint at = clothVertexState(all, vertex);
    vec4 own = placeAt(vertex), a = clothState(at), b = clothState(at + 1u), c = clothState(at + 2u);
    vec3 settled = vec3(clothFloats(all.vertices + kClothVertexElements * vertex + 1u));
    SUPPLE_PRECISE vec3 goalSpeed = (vec3(c) - vec3(a)) * float(kStepsASecond);
    SUPPLE_PRECISE vec3 offset = vec3(a.w, b.w, c.w) - settled;
    SUPPLE_PRECISE vec3 speed = vec3(b) - goalSpeed;
    speed = speed - (vec3(b) + vec3(clothState(at + 3u))) * min(all.lostToAir * float(all.substeps), 1.0f);
    SUPPLE_PRECISE vec3 next = offset * all.spring.x + speed * all.spring.y;
    SUPPLE_PRECISE vec3 nextSpeed = (offset * all.spring.z + speed * all.spring.w) + goalSpeed;
    SUPPLE_PRECISE vec3 place = vec3(c);
    if (own.w > 0.0f) {
        place = place + (settled + next);
        keepClothState(at + 1u, vec4(nextSpeed, b.w));
    }
    keepPlace(vertex, vec4(place, own.w));
}

void finishSpring(ClothTables all, uint vertex) {
    uint at = clothVertexState(all, vertex);
    vec4 own = placeAt(vertex), b = clothState(at + 1u);
    SUPPLE_PRECISE vec3 place = heldPlace(all, vertex);
    SUPPLE_PRECISE vec3 speed = vec3(b) + (place - vec3(own)) * float(kStepsASecond);
    keepClothState(at + 1u, vec4(speed, b.w));
    keepPlace(vertex, vec4(place, own.w));
}

void endVertex(ClothTables all, uint vertex) {
    uint at = clothVertexState(all, vertex);
    vec4 a = clothState(at), b = clothState(at + 1u), c = clothState(at + 2u);
    SUPPLE_PRECISE vec3 place = vec3(placeAt(vertex));
    SUPPLE_PRECISE vec3 offset = place - vec3(c);
    bool sound = isNear(offset, 1e8f);
    if (!sound) place = vec3(c);
    if (!sound) offset = vec3(0.0f);
    keepClothState(at, vec4(place, a.w));
    if (!sound && vertex >= all.hangingCount) keepClothState(at + 1u, vec4(vec3(0.0f), b.w));
    keepClothState(at + 2u, vec4(offset, c.w));
}

void runClothStep(ClothTables all, ClothStep now) {
    for (uint i = laneOf(); i < all.vertexCount; i += laneCount()) beginVertex(all, now, i);
    for (uint i = laneOf(); i < all.colliderCount; i += laneCount()) poseClothCollider(all, i);
    if (now.light) {
        for (uint i = laneOf(); i < all.vertexCount; i += laneCount()) springVertex(all, i); // a lane keeps to its own
        meet();
        for (uint i = laneOf(); i < all.vertexCount; i += laneCount()) {
            if (i >= all.hangingCount) finishSpring(all, i);
        }
    }
    meet();
    uint substeps = now.light ? 0u : all.substeps;
    for (uint substep = 0u; substep < substeps; ++substep) runSubstep(all, now, substep);
    for (uint i = laneOf(); i < all.vertexCount; i += laneCount()) endVertex(all, i);
    meet();
}

// How the step lies to those before; what is known then. `move`: as stepMove() has it; `known`: before the step. Down, the
// wind and whether it is light are left to the caller.
ClothStep clothStep(Affine move, Affine before, bool settles, bool hasSkipped, bool jumps, float known) {
    SUPPLE_PRECISE ClothStep now;
    now.begins = known == 0.0f || (settles && !hasSkipped);
    now.goesOn = settles && !now.begins;
    now.jumps = jumps;
    now.kicks = !settles && known >= 3.0f;
    now.before = before;
    now.move = jumps ? before : move;
    if (now.begins || now.goesOn || (jumps && known < 2.0f)) now.move = identity();
    return now;
}
float knownAfter(ClothStep now, float known) {
    return now.begins || now.goesOn ? 1.0f : now.jumps ? known : min(known + 1.0f, 3.0f);
}

// What is added to a shown vertex: `part` of the way from the last step but one to the last.
vec3 shownClothOffset(ClothTables all, uint vertex, float part, Affine place) {
    uint at = clothVertexState(all, vertex);
    vec4 a = clothState(at), b = clothState(at + 1u), c = clothState(at + 2u);
    SUPPLE_PRECISE vec3 before = vec3(a.w, b.w, c.w);
    SUPPLE_PRECISE vec3 offset = before + (vec3(c) - before) * part;
    return directionThrough(place, offset);
}
