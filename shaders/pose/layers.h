// What an instance plays: its layers at the group's time, applied in order to the rest pose; as skinning/layers.h has it.
// Needs state(), maskValues() and what clip.h needs, and `const bool kAdds`, `kRoots`: whether layers may be additive, and
// roots move.
#include "shaders/pose/clip.h"
#include "shaders/pose/root.h"

struct Layer {
    uint first; // state element
    uint clip;
    uint flags;
    uint mask;
    float weight;
    vec2 time; // runs on
};

Layer layerAt(uint first) {
    uvec4 ids = state(first);
    vec4 begin = stateFloats(first + 1u), course = stateFloats(first + 2u);
    vec2 now = posedTime();
    SUPPLE_PRECISE Layer layer;
    layer.first = first;
    layer.clip = ids.x;
    layer.flags = ids.y;
    layer.mask = ids.z;
    layer.time = timeSum(vec2(begin.z, begin.w), timeProduct(timeSum(now, -vec2(begin)), course.x));
    layer.weight = fadedWeight(course.y, course.z, course.w, timeSum(now, -vec2(stateFloats(first + 3u))).x);
    return layer;
}

vec2 clipDuration(uint clip) { return lastTwo(tableFloats(push.clips + clip)); }

vec2 clipTime(Layer layer, vec2 time) {
    vec2 result = time;
    if ((layer.flags & kLayerLoops) != 0u) result = loopTime(time, clipDuration(layer.clip)).time;
    return result;
}
vec2 referenceTime(Layer layer) { return lastTwo(stateFloats(layer.first + 3u)); }

// A weight of the layer's mask: of a node, or behind the nodes of a morph target.
float masked(Layer layer, uint element, uint i) {
    SUPPLE_PRECISE float weight = layer.weight;
    if (layer.mask != 0u) {
        weight = weight * component(maskValues((layer.mask - 1u) * push.maskStride + element + i / 4u), i & 3u);
    }
    return weight;
}

// The layer's clip at a time of the clip; with kRoots, of the root, with its movement taken out.
Transform layerTransform(uvec4 header, Layer layer, vec2 time, uint node, SUPPLE_INOUT(Motion) motion) {
    SUPPLE_PRECISE Transform t;
    if (kRoots) {
        RootFrame now = rootFrame(layer.clip, time, node, header.w, t);
        SUPPLE_PRECISE Motion moved =
            motionSince(vec3(stateFloats(layer.first + 4u)), stateFloats(layer.first + 5u), now, header.w);
        t = stayingRoot(now, moved, t, header.w);
        motion = moved;
    } else {
        t = clipTransform(layer.clip, time, node);
    }
    return t;
}

Transform blended(Transform pose, Transform to, float weight) {
    SUPPLE_PRECISE Transform t = to;
    if (weight != 1.0f) {
        t.translation = pose.translation + (to.translation - pose.translation) * weight;
        t.rotation = slerp(unit(pose.rotation), unit(to.rotation), weight);
        t.scale = pose.scale + (to.scale - pose.scale) * weight;
    }
    return t;
}

float scaledBy(float scale, float to, float reference, float weight) {
    SUPPLE_PRECISE float result = scale;
    // Of nothing, no factor makes something.
    if (abs(reference) > 1e-30f) result = scale * (1.0f + weight * (to * wideRecip(reference) - 1.0f));
    return result;
}
Transform added(Transform pose, Transform to, Transform reference, float weight) {
    SUPPLE_PRECISE Transform t;
    t.translation = pose.translation + (to.translation - reference.translation) * weight;
    t.rotation = pose.rotation;
    if (to.rotation != reference.rotation) {
        vec4 difference = turned(conjugated(unit(reference.rotation)), unit(to.rotation));
        t.rotation = turned(unit(pose.rotation), turnedTimes(difference, weight));
    }
    t.scale = vec3(scaledBy(pose.scale.x, to.scale.x, reference.scale.x, weight),
                   scaledBy(pose.scale.y, to.scale.y, reference.scale.y, weight),
                   scaledBy(pose.scale.z, to.scale.z, reference.scale.z, weight));
    return t;
}

// The pose with a layer applied to it. `travels`: `sinceBegin` is asked for, whatever the weight.
Transform withLayer(uvec4 header, Layer layer, float weight, bool travels, uint node, Transform pose,
                    SUPPLE_INOUT(Motion) sinceBegin) {
    SUPPLE_PRECISE Motion motion = sinceBegin;
    bool adds = kAdds && (layer.flags & kLayerAdds) != 0u;
    SUPPLE_PRECISE Transform reference = pose, to = pose;
    if (kAdds) {
        // A loop, so that the code is there once: what the layer adds to, then what it shows.
        uint sampled = adds ? 0u : 1u;
        do { // see clip.h
            if (sampled < 2u) {
                vec2 time = layer.time;
                if (sampled == 0u) time = referenceTime(layer);
                reference = to;
                to = layerTransform(header, layer, clipTime(layer, time), node, motion);
            }
            ++sampled;
        } while (sampled < 2u);
    } else {
        to = layerTransform(header, layer, clipTime(layer, layer.time), node, motion);
    }
    if (travels) sinceBegin = motion;
    SUPPLE_PRECISE Transform result = pose;
    if (weight != 0.0f) {
        if (adds) {
            result = added(pose, to, reference, weight);
        } else {
            result = blended(pose, to, weight);
        }
    }
    return result;
}

// `sinceBegin`: with kRoots, what the first layer's root has moved by, whatever the layer's weight.
Transform posedTransform(uint first, uint node, SUPPLE_INOUT(Motion) sinceBegin) {
    uvec4 header = state(first);
    SUPPLE_PRECISE Transform pose = restTransform(node);
    uint i = 0u;
    do { // see clip.h
        if (i < header.x) {
            Layer layer = layerAt(first + kStateElements + i * kLayerElements);
            float weight = masked(layer, 0u, node);
            bool travels = kRoots && i == 0u;
            if (weight != 0.0f || travels) pose = withLayer(header, layer, weight, travels, node, pose, sinceBegin);
        }
        ++i;
    } while (i < header.x);
    return pose;
}

// Four morph weights with a layer applied to them, of which `count` are there.
vec4 withMorphLayer(Layer layer, vec4 shares, uint quad, uint count, vec4 pose) {
    bool adds = kAdds && (layer.flags & kLayerAdds) != 0u;
    SUPPLE_PRECISE vec4 from = pose, to = pose, result = pose;
    // A loop, so that the code is there once: what the layer adds to, then what it shows.
    uint sampled = adds ? 0u : 1u;
    do { // see clip.h
        if (sampled < 2u) {
            vec2 time = layer.time;
            if (sampled == 0u) time = referenceTime(layer);
            from = to;
            to = clipMorphWeights(layer.clip, clipTime(layer, time), quad);
        }
        ++sampled;
    } while (sampled < 2u);
    for (uint k = 0u; k < count; ++k) {
        float share = component(shares, k), before = component(pose, k), after = component(to, k);
        SUPPLE_PRECISE float mixed = before + (after - (adds ? component(from, k) : before)) * share;
        if (share == 1.0f && !adds) mixed = after;
        if (share != 0.0f) result = withComponent(result, k, mixed);
    }
    return result;
}
// Four morph weights of what is played.
vec4 playedMorphWeights(uint first, uint quad) {
    uvec4 header = state(first);
    uint count = min(push.morphCount - 4u * quad, 4u);
    SUPPLE_PRECISE vec4 pose = tableFloats(push.restWeights + quad);
    uint i = 0u;
    do { // see clip.h
        if (i < header.x) {
            Layer layer = layerAt(first + kStateElements + i * kLayerElements);
            SUPPLE_PRECISE vec4 shares = vec4(layer.weight);
            if (layer.mask != 0u) {
                shares = shares * maskValues((layer.mask - 1u) * push.maskStride + (push.nodeCount + 3u) / 4u + quad);
            }
            if (shares != vec4(0.0f)) pose = withMorphLayer(layer, shares, quad, count, pose);
        }
        ++i;
    } while (i < header.x);
    return pose;
}

Affine transformOf(uint first) {
    SUPPLE_PRECISE Affine m = rowsOf(stateFloats(first + 1u), stateFloats(first + 2u), stateFloats(first + 3u));
    return m;
}

// Four of the weights that the deform pass reads: the host's, or those of what is played.
vec4 morphWeights(uint first, uint quad) {
    uint flags = state(first).y;
    SUPPLE_PRECISE vec4 weights = vec4(0.0f);
    if ((flags & kStateHostWeights) != 0u) {
        weights = stateFloats(first + kStateElements + kMaxPlaybackLayers * kLayerElements + quad);
    } else if ((flags & kStateBindPose) == 0u) {
        weights = playedMorphWeights(first, quad);
    }
    return weights;
}

// A place, after what the first layer's root has moved by since its clip began.
Affine travelled(uint first, Affine from, Motion sinceBegin) {
    Layer layer = layerAt(first + kStateElements);
    vec4 before = stateFloats(first + 4u), turns = stateFloats(first + 5u), center = stateFloats(first + 6u);
    SUPPLE_PRECISE float loops = 0.0f;
    if ((layer.flags & kLayerLoops) != 0u) loops = loopTime(layer.time, clipDuration(layer.clip)).loops;
    SUPPLE_PRECISE Motion motion = combinedMotion(loopsMotion(loops, lastTwo(turns), center), sinceBegin);
    motion = combinedMotion(motionOf(vec3(before), vec2(turns)), motion);
    vec3 x = turnedAboutY(motion.halfTurn, vec3(1.0f, 0.0f, 0.0f));
    vec3 z = turnedAboutY(motion.halfTurn, vec3(0.0f, 0.0f, 1.0f));
    return combined(from, rowsOf(vec4(x.x, 0.0f, z.x, motion.translation.x),
                                 vec4(0.0f, 1.0f, 0.0f, motion.translation.y),
                                 vec4(x.z, 0.0f, z.z, motion.translation.z)));
}
