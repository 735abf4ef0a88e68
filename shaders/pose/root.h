// Root motion on the device, as skinning/root_motion.h defines it: what a clip has moved its root by since it began.

// A turn about +Y, given as sine and cosine of half of it, then a translation.
struct Motion {
    vec3 translation;
    vec2 halfTurn;
};

Motion motionOf(vec3 translation, vec2 halfTurn) {
    Motion motion;
    motion.translation = translation;
    motion.halfTurn = halfTurn;
    return motion;
}
Motion standing() { return motionOf(vec3(0.0f), vec2(0.0f, 1.0f)); }

vec3 turnedAboutY(vec2 halfTurn, vec3 p) {
    SUPPLE_PRECISE float s = 2.0f * (halfTurn.x * halfTurn.y);
    SUPPLE_PRECISE float c = halfTurn.y * halfTurn.y - halfTurn.x * halfTurn.x;
    SUPPLE_PRECISE vec3 q = vec3(c * p.x + s * p.z, p.y, c * p.z - s * p.x);
    return q;
}

// b, then a.
Motion combinedMotion(Motion a, Motion b) {
    SUPPLE_PRECISE Motion m;
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
RootFrame rootFrame(uint clip, vec2 time, uint root, uint axes, SUPPLE_INOUT(Transform) local) {
    SUPPLE_PRECISE RootFrame frame;
    frame.parent = identity();
    SUPPLE_PRECISE Affine own = identity();
    // The root first: one loop, so that the code is there once.
    uint node = root;
    do { // see clip.h
        if (node != kNoNode) {
            SUPPLE_PRECISE Transform t = clipTransform(clip, time, node);
            SUPPLE_PRECISE Affine m = localMatrix(node, t);
            if (node == root) {
                local = t;
                own = m;
            } else {
                frame.parent = combined(m, frame.parent);
            }
            node = parentOf(node);
        }
    } while (node != kNoNode);
    SUPPLE_PRECISE Affine global = combined(frame.parent, own);
    frame.position = vec3(global.x.w, global.y.w, global.z.w);
    frame.rotation = frame.parentRotation = vec4(0.0f, 0.0f, 0.0f, 1.0f);
    // A loop, so that the code is there once; only turns need it.
    uint rotations = (axes & kYawAxis) != 0u ? 2u : 0u, i = 0u;
    do { // see clip.h
        if (i < rotations) {
            SUPPLE_PRECISE Affine m = global;
            if (i != 0u) m = frame.parent;
            SUPPLE_PRECISE vec4 rotation = rotationOf(m);
            if (i == 0u) frame.rotation = rotation;
            if (i != 0u) frame.parentRotation = rotation;
        }
        ++i;
    } while (i < rotations);
    return frame;
}

// From the clip's beginning, where the root stands at `position` with `rotation`, to the frame.
Motion motionSince(vec3 position, vec4 rotation, RootFrame now, uint axes) {
    SUPPLE_PRECISE Motion motion;
    motion.translation = vec3(0.0f);
    motion.halfTurn = vec2(0.0f, 1.0f);
    if ((axes & kYawAxis) != 0u) {
        SUPPLE_PRECISE vec4 turn = turned(now.rotation, conjugated(rotation));
        SUPPLE_PRECISE float squares = turn.y * turn.y + turn.w * turn.w;
        if (squares > 1e-30f) motion.halfTurn = vec2(turn.y, turn.w) * rsqrt(squares);
    }
    SUPPLE_PRECISE vec3 way = now.position - turnedAboutY(motion.halfTurn, position);
    if ((axes & kGroundAxes) != 0u) {
        motion.translation.x = way.x;
        motion.translation.z = way.z;
    }
    if ((axes & kHeightAxis) != 0u) motion.translation.y = way.y;
    return motion;
}

// The root's local transform without that motion: it stays where the clip begins.
Transform stayingRoot(RootFrame now, Motion motion, Transform local, uint axes) {
    SUPPLE_PRECISE Transform result = local;
    if (!flattens(now.parent)) { // else nobody sees it
        vec2 back = vec2(-motion.halfTurn.x, motion.halfTurn.y);
        SUPPLE_PRECISE vec3 position = turnedAboutY(back, now.position - motion.translation);
        result.translation = within(now.parent, position);
        if ((axes & kYawAxis) != 0u) {
            vec4 parent = now.parentRotation;
            vec4 turn = vec4(0.0f, back.x, 0.0f, back.y);
            result.rotation = turned(turned(conjugated(parent), turn), turned(parent, unit(local.rotation)));
        }
    }
    return result;
}

// `count` loops, of which one turns by `turn` (in double turns, high and low) about `center` or, without a turn, moves by
// it: see the header of a playback in shaders/shared/pose.h.
Motion loopsMotion(float count, vec2 turn, vec4 center) {
    SUPPLE_PRECISE vec2 turns = timeProduct(turn, count);
    turns = timeSum(turns, vec2(-floor(turns.x + 0.5f), 0.0f));
    SUPPLE_PRECISE float angle = 6.28318530718f * (turns.x + turns.y); // half of what all of them turn by
    SUPPLE_PRECISE Motion motion;
    motion.halfTurn = vec2(sine(angle), cosine(angle));
    // Straight on; or c - R c = 2 sin(angle) R(angle) (-c.z, c.x), with c in the plane: no difference of near equals.
    SUPPLE_PRECISE float twice = 2.0f * motion.halfTurn.x;
    SUPPLE_PRECISE vec3 round = vec3(twice * (motion.halfTurn.x * center.x - motion.halfTurn.y * center.z), count * center.y,
                              twice * (motion.halfTurn.y * center.x + motion.halfTurn.x * center.z));
    SUPPLE_PRECISE vec3 straight = vec3(center) * count;
    motion.translation = center.w != 0.0f ? straight : round;
    return motion;
}
