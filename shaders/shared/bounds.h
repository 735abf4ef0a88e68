// Bounds and culling: which instances a view sees, found from their deformed cages, and the list of them that later
// passes and draws work from.
//
//   bounds   one pass a window of instances: the box of every listed instance's deformed cage, made larger by what the
//            surface may lie outside, and whether it is seen
//   size     only where not all may have room even at their coarsest: how many vertices those that are seen need, by size
//   list     one workgroup a group, after the bounds of all its windows: those that are seen, in order, and the
//            arguments of the indirect dispatches and draws
//   demand   where instances have one of several rates and count in the budget: the vertices they need, by how far their levels
//            are above what a rate is enough for (shaders/shared/lod.h)
//   rates    one workgroup a group, when the budget is solved: as list, once more for every rate
//
// Host list: an entry an instance, slots of the group rising: slot | priority << kInstancePriorityShift |
// kInstanceIsNew where the frame before did not list it. State: two words a slot: 0 where it is not seen, else 1 + its
// rank, the smaller the sooner it is left out where there is no room: rank of its priority * kSizeBins + bin of its
// size; and kDrawn or kDrawnWithPast where it was when it was listed last, which counts as a past only where the host
// list does not say kInstanceIsNew; between `occlude` and `list` kOccluded where it is the pyramid alone that hides it.
// List: at `all` the slots that are seen, rising; at a window's target its entries as shaders/shared/instances.h has
// them, those with a past first, either kind rising; `levels` entries further on each of these has its instance's
// level. Where instances have one of several rates (subdivision): the same once more a rate, without levels,
// `rateStride` words from each other, in the order of slots alone; behind these, `capacity` entries each, the slots of
// those that show a part, for every part that some instance hides. An instance has the smallest rate that is not below
// its level as the budget scales it, or the last. Between the two, `occlude` may take more instances out of sight, by a
// depth pyramid. Table (uvec4 elements): windows, then arguments, then draws.
//   window     (first entry in the host list, entries, first slot, first entry in the list)
//   argument   of a dispatch (x, y, 1): (elements an instance, elements a workgroup, which instances it counts, word in the
//              argument buffer); those of window w stand argumentStride * w words further
//   draw       (indices, first index, patches an instance, rate | number of its part's list << kDrawListShift): a whole
//              VkDrawIndexedIndirectCommand for all windows. Number 0: no instance hides the part, and the draw reads
//              the list of all instances at the rate
//   part       (part, -, -, -): has list 1, 2, .. at every rate
// Groups that draw the same instances in other views may read the coefficients of the group that they follow. Then the latter
// constructs what any of them sees: `bounds` of such a group notes that in its own run of the followed group's states, `sharerStride`
// slots behind the run before, where 0 in the first word says that the slot is not seen. `list` of the followed group lists those
// besides, clears the notes, and counts them in word kConstructedWord of a window's header. The order is that of slots.
// Masks, a part of the list that the host writes: for every slot wordsOf(parts) words (runtime/hidden_parts.h), how many
// patches it hides and a bit for every part that it hides. They are read only where the entry in the host's list says
// kInstanceHidesParts.
// Pools, another part of the list: two words a slot, where its coefficients begin in the pool of the view (shaders/shared/surface.h).
// Frames write the one and the other in turns, so that the place in the frame before is known too.
// Arguments: kListHeaderWords words in all: seen, of those with a past, listed, left out for want of room, occluded;
// the same of every window; then as the table says. Then, from rateCounts on, how many instances a rate and window has,
// [rate][window]; from firstDraw on the draws.
#ifndef SUPPLE_SHARED_BOUNDS_H
#define SUPPLE_SHARED_BOUNDS_H

#include "shaders/shared/camera.h"
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
SUPPLE_SHARED_CONST kSizeBinding = 12u;
SUPPLE_SHARED_CONST kViewWordsBinding = 13u; // shaders/shared/lod.h
SUPPLE_SHARED_CONST kWantedBinding = 14u;    // a run of another group's states

SUPPLE_SHARED_CONST kOccluded = 0xFFFFFFFFu;
SUPPLE_SHARED_CONST kDrawn = 1u;
SUPPLE_SHARED_CONST kDrawnWithPast = 3u;

// What a view sees; without planes and limits everything.
struct CullView {
    float planes[24]; // six of (normal, offset); a point is inside where dot(normal, point) + offset >= 0
    LodCamera camera;
    float farthest; // nothing beyond this distance is seen; 0: no limit
    float smallest; // radius in pixels below which nothing is seen; 0: no limit
    uint ranks;     // of priorities, eight bits each: the larger go later
    uint reserved;
};

// Sizes are radii in pixels: kSizeBinsPerOctave bins an octave from 2^-kSizeOctavesBelow on. The buffer has the
// vertices that instances of a rank need at least, then the units of the view's pool that they take.
SUPPLE_SHARED_CONST kSizeBins = 1024u;
SUPPLE_SHARED_CONST kSizeBinsPerOctave = 64u;
SUPPLE_SHARED_CONST kSizeOctavesBelow = 4u;
SUPPLE_SHARED_CONST kSizeRanks = 4u * kSizeBins;

// Bounds of an instance, two vec4: the least corner and the level that the instance asks for as a whole; the greatest
// corner and 1 where a vertex is not finite. Such vertices are left out of the box, which says little then: the
// instance counts as seen. No finite vertex: a box from kFloatMax to -kFloatMax.
struct BoundsPush {
    uint vertexCount;
    uint cageStride; // vertices an instance in the deformed cage
    uint firstEntry; // of the host list
    uint instanceCount;
    uint firstSlot; // of the window
    float margin;   // the box is made larger by this much of its size on every side
    float longest;  // edge of the cage in its bind pose, as a part of the diagonal of the cage's box
    float bend;     // and the largest second difference (surface/lod/instance.h)
    uint wanted;    // 1: what is seen is noted for the group that constructs it
};
struct SizePush {
    uint firstEntry; // of the host list
    uint instanceCount;
    uint vertices;  // that an instance needs at least
    uint poolUnits; // and what it takes of the view's pool
};

// Which instances an argument counts.
SUPPLE_SHARED_CONST kCountWindow = 0u; // all of the window
SUPPLE_SHARED_CONST kCountRate = 1u;   // of the window at this rate; the next at the next one
SUPPLE_SHARED_CONST kMaxRates = 7u;    // 1, 2, 4 .. 64 segments along an edge
SUPPLE_SHARED_CONST kCountConstructed = 8u; // those of the window that have coefficients constructed
SUPPLE_SHARED_CONST kMaxSharers = 7u;       // groups that read the coefficients of one
SUPPLE_SHARED_CONST kDrawListShift = 8u;

struct ListPush {
    uint windowCount;
    uint argumentCount;
    uint all; // first entry in the list
    uint argumentStride;
    uint levels;    // from entries to their levels
    uint room;      // for vertices, of all groups of the view; kRoomForAll: there is no size pass
    uint poolRoom;  // the same for coefficients: units of the view's pool
    uint poolUnits; // that an instance takes of it; 0: none
    uint pools;     // words of the list in which slots have their places: every second from here on
    uint maxGroups; // of a dispatch in x
    uint counts;    // shared dispatches: word of the sizes that the header of all windows is written to as well
    uint sharers;   // runs behind the states to look at; 0: what is drawn is constructed, and has no list of its own
    uint sharerStride;
    uint constructed; // first entry of the list of what is constructed, by window
};
struct DemandPush {
    uint firstEntry; // of the host list
    uint instanceCount;
    uint rateCount;
    uint firstRate;           // segments along an edge of the cage; each further rate has twice as many
    uint vertices[kMaxRates]; // of an instance
};
struct RatesPush {
    uint windowCount;
    uint argumentCount;
    uint argumentStride;
    uint maxGroups; // of a dispatch in x
    uint rateCount;
    uint firstRate;
    uint rateLists; // first word of the first rate's list
    uint rateStride;
    uint rateCounts; // words of the argument buffer
    uint firstDraw;
    uint drawCount;
    uint counted; // 1: the budget scales levels, and has what they take
    uint capacity;
    uint partCount; // that some instance hides
    uint masks;     // first word in the list
    uint maskWords; // a slot
    uint vertices[kMaxRates];
};
SUPPLE_SHARED_CONST kRoomForAll = 0xFFFFFFFFu;

// Occlusion has a layout of its own: bounds, states and the host's list as above, and the pyramid.
SUPPLE_SHARED_CONST kPyramidBinding = 11u;

// Texel (x, y) of level l holds the farthest depth of all that its rectangle, (x..x+1, y..y+1) / size of the level,
// touches in the picture; levels halve in size, rounded down.
struct OcclusionPush {
    float columns[16]; // to clip space, of the picture that the pyramid was made of
    uint firstEntry;   // of the host list
    uint instanceCount;
    uint width, height; // of level 0
    uint levels;
    uint reversed; // near is 1 and far 0
};

SUPPLE_SHARED_CONST kListHeaderWords = 8u; // of all, and of every window
SUPPLE_SHARED_CONST kConstructedWord = 5u; // of a window's

SUPPLE_SHARED_END

#endif
