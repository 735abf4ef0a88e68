// The list of instances a dispatch works on: entries of a buffer that both the deform pass and the surface passes bind,
// each the slot of an instance within the window of slots that the other buffers are bound by, and what the passes must
// know of it.
#ifndef SUPPLE_SHARED_INSTANCES_H
#define SUPPLE_SHARED_INSTANCES_H

#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// Set 0 of either layout.
SUPPLE_SHARED_CONST kInstanceBinding = 15u;
SUPPLE_SHARED_CONST kInstanceTexelBinding = 16u;

SUPPLE_SHARED_CONST kInstanceSlotMask = 0x0FFFFFFFu;
SUPPLE_SHARED_CONST kInstancePriorityShift = 28u; // two bits
#define SUPPLE_INSTANCE_PRIORITY(entry) (((entry) >> kInstancePriorityShift) & 3u)
SUPPLE_SHARED_CONST kInstanceHidesParts = 0x40000000u; // groups of a view: its mask of parts (shared/bounds.h) is not 0
SUPPLE_SHARED_CONST kInstanceIsNew = 0x80000000u;      // has no past: its previous positions are its positions

// A count of instances that is a word of the list's buffer: this bit and the word's index.
SUPPLE_SHARED_CONST kCountOnDevice = 0x80000000u;

SUPPLE_SHARED_END

#endif
