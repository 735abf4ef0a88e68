// The list of instances a dispatch works on: entries of a buffer that both the deform pass and the surface passes bind, each
// the slot of an instance within the window of slots that the other buffers are bound by.
#ifndef SUPPLE_SHARED_INSTANCES_H
#define SUPPLE_SHARED_INSTANCES_H

#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// Set 0 of either layout, above all other bindings.
SUPPLE_SHARED_CONST kInstanceBinding = 15u;
SUPPLE_SHARED_CONST kInstanceTexelBinding = 16u;

SUPPLE_SHARED_END

#endif
