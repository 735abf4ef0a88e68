// Where the tasks of shared dispatches begin and how many workgroups these have, if only the device knows how large their tasks
// are (docs/shared_dispatches.md). A workgroup takes a dispatch, and its lanes runs of tasks.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/tasks.h"

layout(buffer_reference, std430, buffer_reference_align = 8) buffer Tasks { Task at[]; };
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer Lists { TaskRun at[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) buffer Words { uint at[]; };
layout(push_constant) uniform Push { CountTasksPush push; };

shared uint sumsOf[kMaxLanes];

uint groupsOf(Task task) {
    Words size = Words(task.arguments);
    return size.at[0] * size.at[1] * size.at[2];
}

void main() {
    Tasks tasks = Tasks(push.tasks);
    Lists lists = Lists(push.lists);
    Words arguments = Words(push.arguments);
    TaskRun phase = lists.at[push.phase];
    uint lane = gl_LocalInvocationID.x, lanes = gl_WorkGroupSize.x;
    for (uint l = gl_WorkGroupID.x; l < phase.count; l += gl_NumWorkGroups.x) {
        TaskRun list = lists.at[phase.first + l];
        uint each = (list.count + lanes - 1u) / lanes;
        uint begin = list.first + min(lane * each, list.count), end = list.first + min((lane + 1u) * each, list.count);
        uint own = 0u;
        for (uint i = begin; i < end; ++i) own += groupsOf(tasks.at[i]);
        sumsOf[lane] = own;
        barrier();
        uint first = 0u;
        for (uint k = 0u; k < lane; ++k) first += sumsOf[k];
        for (uint i = begin; i < end; ++i) {
            tasks.at[i].firstGroup = first;
            first += groupsOf(tasks.at[i]);
        }
        if (lane == lanes - 1u) {
            tasks.at[list.first + list.count].firstGroup = first;
            uint at = 3u * (phase.first + l);
            uint rows = max(first / push.maxGroups + (first % push.maxGroups != 0u ? 1u : 0u), 1u);
            arguments.at[at] = first / rows + (first % rows != 0u ? 1u : 0u);
            arguments.at[at + 1u] = rows;
            arguments.at[at + 2u] = 1u;
        }
        barrier();
    }
}
