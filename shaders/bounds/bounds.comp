// Bounds pass: the box of every listed instance's deformed cage, and whether a view sees it. Narrow mapping: one lane per
// instance. Wide mapping: one workgroup per instance.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PUSH_CONSTANTS BoundsPush
#include "shaders/bounds/cull.glsl"

BUFFER(writeonly, Bounds, kBoundsBinding, std430, vec4, bounds)
BUFFER(writeonly, Wanted, kWantedBinding, std430, uvec2, wanted)
BUFFER(readonly, View, kCullViewBinding, std430, CullView, views)
#define view views.at[0]

#define LOD_CAMERA view.camera
#include "shaders/lod/measure.glsl"

const float kFloatMax = 3.402823466e38;
shared vec3 lows[kMaxLanes], highs[kMaxLanes];
shared bool sounds[kMaxLanes];

LOADED_BUFFER(vec4, cage, Cage, kBoundsCageBinding, samplerBuffer, kBoundsCageTexelBinding, xyzw)
vec3 cageVertex(uint i) { return cage(i).xyz; }

struct Box {
    vec3 low, high;
    bool sound; // all vertices are finite
};

// By bits: compilers may take it that there is no NaN.
bool finite(vec3 p) { return all(lessThan(floatBitsToUint(p) & 0x7FFFFFFFu, uvec3(0x7F800000u))); }

// The box of every step-th vertex from `first` on.
Box boxOf(uint base, uint first, uint step) {
    Box box = Box(vec3(kFloatMax), vec3(-kFloatMax), true);
    for (uint v = first; v < push.vertexCount; v += step) {
        vec3 p = cageVertex(base + v);
        bool usable = finite(p);
        box.low = usable ? min(box.low, p) : box.low;
        box.high = usable ? max(box.high, p) : box.high;
        box.sound = box.sound && usable;
    }
    return box;
}

// 1 + the rank of an instance in a box, 0 where it is not seen. Comparisons say "outside", so that what is not a number is
// seen.
uint rankOf(vec3 low, vec3 high, uint priority) {
    vec3 middle = 0.5 * low + 0.5 * high, extent = 0.5 * high - 0.5 * low;
    bool seen = true;
    for (uint k = 0u; k < 6u; ++k) {
        vec3 normal = vec3(view.planes[4u * k], view.planes[4u * k + 1u], view.planes[4u * k + 2u]);
        seen = seen && !(dot(normal, middle) + view.planes[4u * k + 3u] + dot(abs(normal), extent) < 0.0);
    }
    vec3 camera = vec3(view.camera.position[0], view.camera.position[1], view.camera.position[2]);
    vec3 beyond = max(max(low - camera, camera - high), vec3(0.0));
    if (view.farthest > 0.0) seen = seen && !(length(beyond) > view.farthest);
    float away = view.camera.orthographic != 0u ? 1.0 : length(middle - camera), radius = length(extent) * view.camera.focal;
    if (!seen || radius < view.smallest * away) return 0u;
    float octave = log2(max(radius / max(away, 1e-30), 1e-30)) + float(kSizeOctavesBelow);
    const float kLast = float(kSizeBins - 1u);
    float bin = clamp(octave * float(kSizeBinsPerOctave), 0.0, kLast);
    uint rank = (view.ranks >> (8u * priority)) & 255u;
    return 1u + rank * kSizeBins + uint(bin >= 0.0 ? bin : kLast);
}

void store(uint entry, Box box) {
    uint slot = entry & kInstanceSlotMask, priority = SUPPLE_INSTANCE_PRIORITY(entry);
    precise vec3 grown = push.margin * (box.high - box.low);
    bool empty = box.low.x > box.high.x;
    precise vec3 low = empty ? box.low : box.low - grown;
    precise vec3 high = empty ? box.high : box.high + grown;
    float diagonal = empty ? 0.0 : lengthOf(box.high - box.low);
    float level = levelOf(push.longest * diagonal, push.bend * diagonal,
                          pixelsPerUnit(0.5 * box.low + 0.5 * box.high, 0.5 * diagonal));
    bounds.at[2u * slot] = vec4(low, level);
    bounds.at[2u * slot + 1u] = vec4(high, box.sound ? 0.0 : 1.0);
    uint last = ((view.ranks >> (8u * priority)) & 255u) * kSizeBins + kSizeBins; // not to be judged: the last to go
    uint rank = box.sound ? rankOf(low, high, priority) : last;
    states.at[slot].x = rank;
    if (push.wanted != 0u) wanted.at[slot] = uvec2(rank, 0u);
    if ((entry & kInstanceIsNew) != 0u) states.at[slot].y = 0u; // the memory may never have been written
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint index = kWide ? workgroupIndex() : invocationIndex();
    if (kWide && index >= push.instanceCount) return; // the whole workgroup
    uint entry = hostEntry(push.firstEntry + min(index, push.instanceCount - 1u));
    uint base = ((entry & kInstanceSlotMask) - push.firstSlot) * push.cageStride;
    if (!kWide) {
        store(entry, boxOf(base, 0u, 1u));
        return;
    }
    Box box = boxOf(base, lane, gl_WorkGroupSize.x);
    lows[lane] = box.low;
    highs[lane] = box.high;
    sounds[lane] = box.sound;
    barrier();
    for (uint width = gl_WorkGroupSize.x / 2u; width > 0u; width /= 2u) {
        if (lane < width) {
            lows[lane] = min(lows[lane], lows[lane + width]);
            highs[lane] = max(highs[lane], highs[lane + width]);
            sounds[lane] = sounds[lane] && sounds[lane + width];
        }
        barrier();
    }
    if (lane == 0u) store(entry, Box(lows[0], highs[0], sounds[0]));
}
