// What an instance plays: its layers at the group's time, applied in order to the rest pose; as skinning/layers.h has it.
// Needs tables.glsl and `const bool kAdds`, `kRoots`: whether layers may be additive, and roots move.
#include "shaders/pose/time.glsl"
#include "shaders/pose/rotation.glsl"
#include "shaders/pose/affine.glsl"
#include "shaders/pose/clip.glsl"
#include "shaders/pose/root.glsl"

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
    vec2 now = vec2(push.timeHigh, push.timeLow);
    precise Layer layer;
    layer.first = first;
    layer.clip = ids.x;
    layer.flags = ids.y;
    layer.mask = ids.z;
    layer.time = timeSum(begin.zw, timeProduct(timeSum(now, -begin.xy), course.x));
    layer.weight = course.y;
    if (course.w > 0.0) {
        vec2 since = timeSum(now, -stateFloats(first + 3u).xy);
        precise float faded = since.x / course.w;
        precise float weight = course.y + (course.z - course.y) * faded;
        layer.weight = faded <= 0.0 ? course.y : faded >= 1.0 ? course.z : weight;
    }
    return layer;
}

vec2 clipDuration(uint clip) { return tableFloats(push.clips + clip).zw; }

vec2 clipTime(Layer layer, vec2 time) {
    vec2 result = time;
    if ((layer.flags & kLayerLoops) != 0u) result = loopTime(time, clipDuration(layer.clip)).time;
    return result;
}
vec2 referenceTime(Layer layer) { return stateFloats(layer.first + 3u).zw; }

// A weight of the layer's mask: of a node, or behind the nodes of a morph target.
float masked(Layer layer, uint element, uint i) {
    precise float weight = layer.weight;
    if (layer.mask != 0u) {
        weight = weight * component(maskValues((layer.mask - 1u) * push.maskStride + element + i / 4u), i & 3u);
    }
    return weight;
}

// The layer's clip at a time of the clip; with kRoots, of the root, with its movement taken out.
Transform layerTransform(uvec4 header, Layer layer, vec2 time, uint node, inout Motion motion) {
    precise Transform t;
    if (kRoots) {
        RootFrame now = rootFrame(layer.clip, time, node, header.w, t);
        precise Motion moved =
            motionSince(stateFloats(layer.first + 4u).xyz, stateFloats(layer.first + 5u), now, header.w);
        t = stayingRoot(now, moved, t, header.w);
        motion = moved;
    } else {
        t = clipTransform(layer.clip, time, node);
    }
    return t;
}

Transform blended(Transform pose, Transform to, float weight) {
    precise Transform t = to;
    if (weight != 1.0) {
        t.translation = pose.translation + (to.translation - pose.translation) * weight;
        t.rotation = slerp(unit(pose.rotation), unit(to.rotation), weight);
        t.scale = pose.scale + (to.scale - pose.scale) * weight;
    }
    return t;
}

float scaledBy(float scale, float to, float reference, float weight) {
    precise float result = scale;
    if (reference != 0.0) result = scale * (1.0 + weight * (to / reference - 1.0)); // of nothing, no factor makes something
    return result;
}
Transform added(Transform pose, Transform to, Transform reference, float weight) {
    precise Transform t;
    t.translation = pose.translation + (to.translation - reference.translation) * weight;
    t.rotation = pose.rotation;
    if (to.rotation != reference.rotation) {
        vec4 difference = turned(conjugated(unit(reference.rotation)), unit(to.rotation));
        t.rotation = turned(unit(pose.rotation), slerp(vec4(0.0, 0.0, 0.0, 1.0), difference, weight));
    }
    t.scale = vec3(scaledBy(pose.scale.x, to.scale.x, reference.scale.x, weight),
                   scaledBy(pose.scale.y, to.scale.y, reference.scale.y, weight),
                   scaledBy(pose.scale.z, to.scale.z, reference.scale.z, weight));
    return t;
}

// `sinceBegin`: with kRoots, what the first layer's root has moved by, whatever the layer's weight.
Transform posedTransform(uint first, uint node, inout Motion sinceBegin) {
    uvec4 header = state(first);
    precise Transform pose = restTransform(node);
    for (uint i = 0u; i < header.x; ++i) {
        Layer layer = layerAt(first + kStateElements + i * kLayerElements);
        float weight = masked(layer, 0u, node);
        bool travels = kRoots && i == 0u;
        if (weight != 0.0 || travels) {
            precise Motion motion = sinceBegin;
            // A loop, so that the code is there once: what the layer adds to, then what it shows.
            bool adds = kAdds && (layer.flags & kLayerAdds) != 0u;
            precise Transform reference = pose, to = pose;
            if (kAdds) {
                for (uint sampled = adds ? 0u : 1u; sampled < 2u; ++sampled) {
                    vec2 time = layer.time;
                    if (sampled == 0u) time = referenceTime(layer);
                    reference = to;
                    to = layerTransform(header, layer, clipTime(layer, time), node, motion);
                }
            } else {
                to = layerTransform(header, layer, clipTime(layer, layer.time), node, motion);
            }
            if (travels) sinceBegin = motion;
            if (weight != 0.0) {
                if (adds) {
                    pose = added(pose, to, reference, weight);
                } else {
                    pose = blended(pose, to, weight);
                }
            }
        }
    }
    return pose;
}

float posedMorphWeight(uint first, uint target) {
    uvec4 header = state(first);
    precise float pose = packedFloat(push.restWeights, target);
    for (uint i = 0u; i < header.x; ++i) {
        Layer layer = layerAt(first + kStateElements + i * kLayerElements);
        float weight = masked(layer, (push.nodeCount + 3u) / 4u, target);
        if (weight != 0.0) {
            float to = clipMorphWeight(layer.clip, clipTime(layer, layer.time), target);
            if (kAdds && (layer.flags & kLayerAdds) != 0u) {
                float from = clipMorphWeight(layer.clip, clipTime(layer, referenceTime(layer)), target);
                pose = pose + (to - from) * weight;
            } else if (weight == 1.0) {
                pose = to;
            } else {
                pose = pose + (to - pose) * weight;
            }
        }
    }
    return pose;
}

Affine transformOf(uint first) {
    precise Affine m = Affine(stateFloats(first + 1u), stateFloats(first + 2u), stateFloats(first + 3u));
    return m;
}
