// Which instances rays are aimed at: a lane an instance and some rays. What no ray meets costs no more than this.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/mapping.glsl"
#include "shaders/queries/queries.glsl"

void main() {
    uint id = invocationIndex(), block = id / push.instanceCount, listed = id - block * push.instanceCount;
    uint first = push.firstRay + block * kRaysPerLane, end = min(first + kRaysPerLane, push.rayCount);
    if (first >= push.rayCount) return;
    vec3 low, high;
    loadBox(listed, low, high);
    if (!(length(high - low) >= 0.0) || low.x > high.x) return; // nothing in it is finite
    grow(low, high, push.reach);
    bool isAimedAt = false;
    for (uint r = first; r < end; ++r) {
        Ray ray = rayOf(r);
        isAimedAt = isAimedAt || (ray.sound && mayMeet(ray, low, high, toleranceFor(low, high, ray.origin)));
    }
    if (isAimedAt) boxWords.at[2u * (push.firstBox + listed)].w = 1u;
}
