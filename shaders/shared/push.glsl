// The push constants of a kernel, PUSH_CONSTANTS. In a shared dispatch they are the task's. Needs mapping.glsl.
#ifdef TASKS
layout(buffer_reference, std430) readonly buffer Push { PUSH_CONSTANTS constants; };
PUSH_CONSTANTS push = Push(task.push).constants;
#else
layout(push_constant) uniform Push { PUSH_CONSTANTS push; };
#endif
