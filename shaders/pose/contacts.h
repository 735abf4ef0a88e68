// Where the clips that are played hold a foot: found when they were loaded (skinning/contacts.h), so that a foot that
// stands keeps its place on the ground without a memory of what it did. Needs what layers.h needs, with `kRoots`.

// (x, 0, z) of model space as the clip has it, and how firmly, 0..1. Contacts of a foot do not overlap, and rise.
vec4 contactAt(uint clip, float time, uint foot) {
    uvec4 range = table(push.contacts + push.footCount * (1u + clip) + foot);
    uint low = 0u, high = range.y;
    while (low < high) { // the first that begins later
        uint middle = (low + high) / 2u;
        if (time < tableFloats(range.x + kContactElements * middle + 1u).x) {
            high = middle;
        } else {
            low = middle + 1u;
        }
    }
    SUPPLE_PRECISE vec4 held = vec4(0.0f);
    if (low > 0u) {
        uint element = range.x + kContactElements * (low - 1u);
        vec4 place = tableFloats(element), times = tableFloats(element + 1u);
        // It takes hold, and lets go, while the foot stands: so it is never pulled through the air.
        SUPPLE_PRECISE float inside = min(time - times.x, times.y - time);
        SUPPLE_PRECISE float part = min(max(inside * times.z, 0.0f), 1.0f);
        held = vec4(place.x + place.z * time, 0.0f, place.y + place.w * time, (part * part) * (3.0f - 2.0f * part));
    }
    return held;
}

// The same with the movement of the root taken out, where root motion takes it: the root stands at `position` with
// `rotation` where the clip begins.
vec4 heldInClip(uint clip, vec2 time, uint foot, uint root, uint axes, vec3 position, vec4 rotation) {
    vec2 duration = clipDuration(clip);
    // Outside of the clip its first or its last pose stands.
    SUPPLE_PRECISE float within = min(max(time.x + time.y, 0.0f), duration.x + duration.y);
    SUPPLE_PRECISE vec4 held = contactAt(clip, within, foot);
    bool moves = held.w > 0.0f && axes != 0u && hangsOn(table(push.contacts + foot).x, root);
    if (moves) {
        SUPPLE_PRECISE Transform own;
        RootFrame now = rootFrame(clip, time, root, axes, own);
        Motion motion = motionSince(position, rotation, now, axes);
        vec2 back = vec2(-motion.halfTurn.x, motion.halfTurn.y);
        SUPPLE_PRECISE vec3 place = turnedAboutY(back, vec3(held) - motion.translation);
        held.x = place.x;
        held.z = place.z;
    }
    return held;
}

// Mixes what a layer holds into what those before it do. All but the last number are multiplied by it.
vec4 heldMix(vec4 before, vec4 held, float weight) {
    SUPPLE_PRECISE vec4 own = vec4(held.x * held.w, 0.0f, held.z * held.w, held.w);
    SUPPLE_PRECISE vec4 mixed = before + (own - before) * weight;
    return mixed;
}

// What all layers hold, mixed as they are played. A transition lets go of what was held before, and takes hold of what is
// played as it blends that in.
vec4 heldFoot(uint first, uint foot) {
    uvec4 header = state(first);
    uint node = table(push.contacts + foot).x;
    SUPPLE_PRECISE vec4 held = vec4(0.0f);
    uint i = 0u;
    do { // see clip.h
        if (i < header.x) {
            Layer layer = layerAt(first + kStateElements + i * kLayerElements);
            float weight = masked(layer, 0u, node);
            if (weight != 0.0f && (layer.flags & kLayerAdds) == 0u) {
                vec4 own = heldInClip(layer.clip, clipTime(layer, layer.time), foot, header.z, header.w,
                                      vec3(stateFloats(layer.first + 4u)), stateFloats(layer.first + 5u));
                held = heldMix(held, own, weight);
            }
        }
        ++i;
    } while (i < header.x);
    Transition transition = transitionOf(first);
    if (transition.kind != kNoTransition) held = held * blendedIn(transition);
    return held;
}
