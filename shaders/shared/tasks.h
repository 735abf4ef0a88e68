// Shared dispatches (docs/shared_dispatches.md): the tasks of several groups that one dispatch works on, and how a
// workgroup finds its own. A task is what a step does for one window of instances.
#ifndef SUPPLE_SHARED_TASKS_H
#define SUPPLE_SHARED_TASKS_H

#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

#ifdef __cplusplus
using TaskAddress = uint64_t;
#else
#define TaskAddress uvec2
#endif

struct Task {
    TaskAddress buffers;   // where the addresses of what a set would bind stand, by binding
    TaskAddress push;      // where its push constants stand
    TaskAddress arguments; // where the device has written how many workgroups it takes, in three words; or 0
    uint firstGroup;       // its first workgroup in the dispatch; it ends where the next task begins
    uint unused;           // whole addresses
};
// The push constants of a shared dispatch. Behind its tasks stands one that is none: it begins where the last one ends.
struct TasksPush {
    TaskAddress tasks;
    uint count; // of tasks, at least 1
};
// A run of tasks, or of lists of tasks.
struct TaskRun {
    uint first, count;
};
// What counts the workgroups of dispatches whose sizes the device has written.
struct CountTasksPush {
    TaskAddress tasks, lists, arguments; // of all dispatches
    uint phase;                          // where the run of lists to count stands, behind `lists`
    uint maxGroups;                      // of a dispatch in x
};
SUPPLE_SHARED_CONST kMaxTasks = 65536u; // of a dispatch: a search takes kTaskHalvings halvings at most
SUPPLE_SHARED_CONST kTaskHalvings = 16u;
SUPPLE_SHARED_CONST kTaskBindings = 32u; // of layouts

SUPPLE_SHARED_END

#endif
