// Bounds and culling: which instances a view sees, found from their deformed cages, and the list of them that later passes
// and draws work from.
//
//   bounds   one pass a window of instances: the box of every listed instance's deformed cage, made larger by what the
//            surface may lie outside, and whether it is seen
//   list     one workgroup a group, after the bounds of all its windows: those that are seen, in order, and the arguments of
//            the indirect dispatches and draws
//
// Host list: an entry an instance, slots of the group rising: slot | priority << kInstancePriorityShift | kInstanceIsNew
// where the frame before did not list it.
// State: two words a slot: whether it is seen (kNotSeen ..); and whether it was when it was listed last, which counts as a past only where
// the host list does not say kInstanceIsNew.
// List: at `all` the slots that are seen, rising; at a window's target its entries as shaders/shared/instances.h has them,
// those with a past first, either kind rising.
// Between the two, `occlude` may take more instances out of sight, by a depth pyramid.
// Table (uvec4 elements): windows, then arguments.
//   window     (first entry in the host list, entries, first slot, first entry in the list)
//   argument   (elements an instance, elements a workgroup or 0 for a draw, ListCount, word in the argument buffer); those of
//              window w stand argumentStride * w words further. A dispatch is (x, y, 1), a draw its instance count alone
// Arguments: four words in all: seen, of those with a past, listed, occluded; the same four of every window; then as the
// table says.
#ifndef SUPPLE_SHARED_BOUNDS_H
#define SUPPLE_SHARED_BOUNDS_H

#include "shaders/shared/instances.h"
#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// Descriptor bindings, set 0. The cage is bound by window, all else for the whole group.
SUPPLE_SHARED_CONST kBoundsCageBinding = 0u;
SUPPLE_SHARED_CONST kBoundsCageTexelBinding = 1u;
SUPPLE_SHARED_CONST kBoundsBinding = 2u;
SUPPLE_SHARED_CONST kBoundsStateBinding = 3u;
SUPPLE_SHARED_CONST kBoundsStateTexelBinding = 4u; // R32G32_UINT
SUPPLE_SHARED_CONST kHostListBinding = 5u;
SUPPLE_SHARED_CONST kHostListTexelBinding = 6u; // R32_UINT
SUPPLE_SHARED_CONST kListBinding = 7u;
SUPPLE_SHARED_CONST kListArgumentBinding = 8u;
SUPPLE_SHARED_CONST kListTableBinding = 9u;
SUPPLE_SHARED_CONST kCullViewBinding = 10u;

SUPPLE_SHARED_CONST kNotSeen = 0u;
SUPPLE_SHARED_CONST kSeen = 1u;
SUPPLE_SHARED_CONST kOccluded = 2u; // would be seen but for the pyramid

// What a view sees; all zero: everything.
struct CullView {
    float planes[24]; // six of (normal, offset); a point is inside where dot(normal, point) + offset >= 0
    float camera[3];
    float farthest; // nothing beyond this distance is seen; 0: no limit
    float focal;    // pixels a unit at distance 1; orthographic: pixels a unit
    float smallest; // radius in pixels below which nothing is seen; 0: no limit
    uint orthographic;
    uint reserved;
};

// Bounds of an instance, two vec4: the least corner and 0; the greatest corner and 1 where a vertex is not finite. Such
// vertices are left out of the box, which says little then: the instance counts as seen. No finite vertex: a box from
// kFloatMax to -kFloatMax.
struct BoundsPush {
    uint vertexCount;
    uint cageStride; // vertices an instance in the deformed cage
    uint firstEntry; // of the host list
    uint instanceCount;
    uint firstSlot; // of the window
    float margin;   // the box is made larger by this much of its size on every side
};

// Which instances an argument counts.
SUPPLE_SHARED_CONST kCountWindow = 0u;
SUPPLE_SHARED_CONST kCountWithPast = 1u; // of the window
SUPPLE_SHARED_CONST kCountNew = 2u;      // of the window
SUPPLE_SHARED_CONST kCountAll = 3u;      // of the group; written once

struct ListPush {
    uint windowCount;
    uint argumentCount;
    uint all; // first entry in the list
    uint argumentStride;
    uint maxGroups; // of a dispatch in x
};

// Occlusion has a layout of its own: bounds, states and the host's list as above, and the pyramid.
SUPPLE_SHARED_CONST kPyramidBinding = 11u;

// Texel (x, y) of level l holds the farthest depth of all that its rectangle, (x..x+1, y..y+1) / size of the level, touches
// in the picture; levels halve in size, rounded down.
struct OcclusionPush {
    float columns[16]; // to clip space, of the picture that the pyramid was made of
    uint firstEntry;   // of the host list
    uint instanceCount;
    uint width, height; // of level 0
    uint levels;
    uint reversed; // near is 1 and far 0
};

SUPPLE_SHARED_CONST kListHeaderWords = 4u; // of all, and of every window

SUPPLE_SHARED_END

#endif
