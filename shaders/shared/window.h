// What the surface passes are told about the window of instances that a dispatch works on. It stands first in the push
// constants of all of them, and is the only part that changes from frame to frame and from window to window, but for a
// view's camera.
#ifndef SUPPLE_SHARED_WINDOW_H
#define SUPPLE_SHARED_WINDOW_H

#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

struct WindowPush {
    uint firstInstance; // of the window, in the list of instances (shared/instances.h)
    uint instanceCount; // or kCountOnDevice and where the count stands
    uint slots;         // of the window: no count and no slot that the device has written is taken for more
    // Level of detail:
    uint firstSlot; // of the window, in the group
    uint firstRun;  // of the window, in the view (shared/lod.h)
    // Coefficients in the pool of a view (shared/surface.h):
    uint pools;            // in the list of instances, where the places of its slots begin; 0: the pool is the group's
    uint lastPool;         // places behind this one are read as this one
    uint firstCoefficient; // of the surface, in an instance's place
    // Previous positions: how far the origin of the coordinates has moved since the frame that they come from.
    float pastX, pastY, pastZ;
};

SUPPLE_SHARED_END

#endif
