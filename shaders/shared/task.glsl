// The task of a workgroup, in a dispatch that several groups share (shared/tasks.h). All of a workgroup's lanes find the same one.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "shaders/shared/tasks.h"

layout(push_constant) uniform Tasks { TasksPush dispatched; };
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer TaskList { Task at[]; };
layout(buffer_reference, std430, buffer_reference_align = 8) readonly buffer TaskBuffers { uvec2 at[kTaskBindings]; };

uint dispatchedWorkgroup() { return gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x; }

// The last task that begins at the workgroup or before it. A dispatch in rows may have more workgroups than its tasks: these belong
// to the last task that has any.
Task taskOfWorkgroup() {
    TaskList list = TaskList(dispatched.tasks);
    uint first = 0u, end = dispatched.count, workgroup = min(dispatchedWorkgroup(), list.at[end].firstGroup - 1u);
    for (uint n = 0u; n < kTaskHalvings && end - first > 1u; ++n) {
        uint middle = (first + end) / 2u;
        bool isBefore = list.at[middle].firstGroup <= workgroup;
        first = isBefore ? middle : first;
        end = isBefore ? end : middle;
    }
    return list.at[first];
}
Task task = taskOfWorkgroup();
uvec2 bufferOfTask(uint binding) { return TaskBuffers(task.buffers).at[binding]; }
