// Level of detail (docs/lod.md): what the passes that choose levels, the budget's solver and evaluation share.
#ifndef SUPPLE_SHARED_LOD_H
#define SUPPLE_SHARED_LOD_H

#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

SUPPLE_SHARED_CONST kCapacityCount = 10u;

// Forms of grids (surface/lod/grid.h).
SUPPLE_SHARED_CONST kLodQuadForm = 0u;
SUPPLE_SHARED_CONST kLodTriangleForm = 1u;
SUPPLE_SHARED_CONST kLodQuadRingsForm = 2u;
SUPPLE_SHARED_CONST kLodPentagonForm = 3u;
SUPPLE_SHARED_CONST kLodForms = 4u;

SUPPLE_SHARED_END

#endif
