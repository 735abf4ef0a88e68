#version 460
#extension GL_GOOGLE_include_directive : require
// A workgroup per bin: gathers the bin's commands that draw something, in their order, and counts them.
#include "view_draws.h"

const uint kLanes = 256u;
layout(local_size_x = 256) in;

layout(set = 0, binding = 0, std430) readonly buffer Source { uint source[]; };
layout(set = 0, binding = 1, std430) readonly buffer Draws { ViewDraw draws[]; };
layout(set = 0, binding = 2, std430) readonly buffer Bins { uvec2 bins[]; }; // the first of draws, and how many
layout(set = 0, binding = 3, std430) writeonly buffer Commands { uint commands[]; };
layout(set = 0, binding = 4, std430) writeonly buffer Drawn { ViewDraw drawn[]; };
layout(set = 0, binding = 5, std430) writeonly buffer Counts { uint counts[]; };

shared uint sums[kLanes];

// How many lanes up to this one have something; all of them are here.
uint countedUpTo(uint lane, bool has) {
    sums[lane] = has ? 1u : 0u;
    barrier();
    for (uint distance = 1u; distance < kLanes; distance *= 2u) {
        uint before = lane >= distance ? sums[lane - distance] : 0u;
        barrier();
        sums[lane] += before;
        barrier();
    }
    return sums[lane];
}

void copyCommand(uint from, uint to) {
    for (uint w = 0u; w < kCommandWords; ++w)
        commands[kCommandWords * to + w] = source[from + w];
}

void main() {
    uint lane = gl_LocalInvocationID.x, first = bins[gl_WorkGroupID.x].x, count = bins[gl_WorkGroupID.x].y;
    uint placed = 0u;
    for (uint begin = 0u; begin < count; begin += kLanes) {
        bool inside = begin + lane < count;
        uint own = first + min(begin + lane, count - 1u);
        bool has = inside && source[draws[own].command + kInstanceCountWord] != 0u;
        uint upTo = countedUpTo(lane, has);
        if (has) {
            uint place = first + placed + upTo - 1u;
            copyCommand(draws[own].command, place);
            drawn[place] = draws[own];
        }
        placed += sums[kLanes - 1u];
        barrier();
    }
    // For devices that issue all commands, whatever the count is.
    for (uint i = placed + lane; i < count; i += kLanes)
        for (uint w = 0u; w < kCommandWords; ++w)
            commands[kCommandWords * (first + i) + w] = 0u;
    if (lane == 0u)
        counts[gl_WorkGroupID.x] = placed;
}
