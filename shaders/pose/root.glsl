// Root motion on the device, as skinning/root_motion.h defines it: what a clip has moved its root by since it began.

// A turn about +Y, given as sine and cosine of half of it, then a translation.
struct Motion {
    vec3 translation;
    vec2 halfTurn;
};

Motion standing() { return Motion(vec3(0.0), vec2(0.0, 1.0)); }

vec3 turnedAboutY(vec2 halfTurn, vec3 p) {
    precise float s = 2.0 * (halfTurn.x * halfTurn.y);
    precise float c = halfTurn.y * halfTurn.y - halfTurn.x * halfTurn.x;
    precise vec3 q = vec3(c * p.x + s * p.z, p.y, c * p.z - s * p.x);
    return q;
}

// b, then a.
Motion combinedMotion(Motion a, Motion b) {
    precise Motion m;
    m.translation = turnedAboutY(a.halfTurn, b.translation) + a.translation;
    m.halfTurn = vec2(a.halfTurn.x * b.halfTurn.y + a.halfTurn.y * b.halfTurn.x,
                      a.halfTurn.y * b.halfTurn.y - a.halfTurn.x * b.halfTurn.x);
    return m;
}

struct RootFrame {
    Affine parent; // global matrix of what the root hangs on
    vec4 parentRotation;
    vec3 position;
    vec4 rotation;
};
// `local`: the root's own transform.
RootFrame rootFrame(uint clip, vec2 time, uint root, uint axes, out Transform local) {
    precise RootFrame frame;
    frame.parent = identity();
    precise Affine own = identity();
    // The root first: one loop, so that the code is there once.
    for (uint node = root; node != kNoNode; node = parentOf(node)) {
        precise Transform t = clipTransform(clip, time, node);
        precise Affine m = localMatrix(node, t);
        if (node == root) {
            local = t;
            own = m;
        } else {
            frame.parent = combined(m, frame.parent);
        }
    }
    precise Affine global = combined(frame.parent, own);
    frame.position = vec3(global.x.w, global.y.w, global.z.w);
    frame.rotation = frame.parentRotation = vec4(0.0, 0.0, 0.0, 1.0);
    // A loop, so that the code is there once; only turns need it.
    uint rotations = (axes & kYawAxis) != 0u ? 2u : 0u;
    for (uint i = 0u; i < rotations; ++i) {
        precise Affine m = global;
        if (i != 0u) m = frame.parent;
        precise vec4 rotation = rotationOf(m);
        if (i == 0u) frame.rotation = rotation;
        if (i != 0u) frame.parentRotation = rotation;
    }
    return frame;
}

// From the clip's beginning, where the root stands at `position` with `rotation`, to the frame.
Motion motionSince(vec3 position, vec4 rotation, RootFrame now, uint axes) {
    precise Motion motion;
    motion.translation = vec3(0.0);
    motion.halfTurn = vec2(0.0, 1.0);
    if ((axes & kYawAxis) != 0u) {
        precise vec4 turn = turned(now.rotation, conjugated(rotation));
        precise float size = sqrt(turn.y * turn.y + turn.w * turn.w);
        if (size > 0.0) motion.halfTurn = turn.yw / size;
    }
    precise vec3 way = now.position - turnedAboutY(motion.halfTurn, position);
    if ((axes & kGroundAxes) != 0u) motion.translation.xz = way.xz;
    if ((axes & kHeightAxis) != 0u) motion.translation.y = way.y;
    return motion;
}

// The root's local transform without that motion: it stays where the clip begins.
Transform stayingRoot(RootFrame now, Motion motion, Transform local, uint axes) {
    vec3 a = now.parent.x.xyz, b = now.parent.y.xyz, c = now.parent.z.xyz;
    precise vec3 bc = crossed(b, c), ca = crossed(c, a), ab = crossed(a, b);
    precise float determinant = dot3(a, bc);
    precise Transform result = local;
    if (determinant != 0.0) { // else nobody sees it
        vec2 back = vec2(-motion.halfTurn.x, motion.halfTurn.y);
        precise vec3 position = turnedAboutY(back, now.position - motion.translation);
        precise vec3 d = position - vec3(now.parent.x.w, now.parent.y.w, now.parent.z.w);
        result.translation = ((bc * d.x + ca * d.y) + ab * d.z) / determinant;
        if ((axes & kYawAxis) != 0u) {
            vec4 parent = now.parentRotation;
            vec4 turn = vec4(0.0, back.x, 0.0, back.y);
            result.rotation = turned(turned(conjugated(parent), turn), turned(parent, unit(local.rotation)));
        }
    }
    return result;
}

// `count` loops, of which one turns by `turn` (in double turns, high and low) about `center` or, without a turn, moves by
// it: see the header of a playback in shaders/shared/pose.h.
Motion loopsMotion(float count, vec2 turn, vec4 center) {
    precise vec2 turns = timeProduct(turn, count);
    turns = timeSum(turns, vec2(-floor(turns.x + 0.5), 0.0));
    precise float angle = 6.28318530718 * (turns.x + turns.y); // half of what all of them turn by
    precise Motion motion;
    motion.halfTurn = vec2(sine(angle), cosine(angle));
    // Straight on; or c - R c = 2 sin(angle) R(angle) (-c.z, c.x), with c in the plane: no difference of near equals.
    precise float twice = 2.0 * motion.halfTurn.x;
    precise vec3 round = vec3(twice * (motion.halfTurn.x * center.x - motion.halfTurn.y * center.z), count * center.y,
                              twice * (motion.halfTurn.y * center.x + motion.halfTurn.x * center.z));
    precise vec3 straight = count * center.xyz;
    motion.translation = center.w != 0.0 ? straight : round;
    return motion;
}
