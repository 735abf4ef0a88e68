// Hashes of what a frame has written (docs/recording.md): two sums over all words of all instances, so that neither the
// order of lanes nor how instances are cut into windows makes a difference.
#ifndef SUPPLE_SHARED_WORD_HASH_H
#define SUPPLE_SHARED_WORD_HASH_H

#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// Set 0.
SUPPLE_SHARED_CONST kHashedWordBinding = 0u;
SUPPLE_SHARED_CONST kHashListBinding = 1u; // of instances (shared/instances.h), or the words of a view (shared/lod.h)
SUPPLE_SHARED_CONST kHashSumBinding = 2u;  // two words a hash

// Elements that a workgroup hashes, at most.
SUPPLE_SHARED_CONST kHashedElements = 2048u;

// Words that instances have.
struct SlotHashPush {
    uint firstEntry;   // in the list
    uint entryCount;   // or kCountOnDevice and the word of the list that has it
    uint mostEntries;  // that there may be
    uint firstListed;  // what entries of the list count slots from
    uint firstSlot;    // of the window
    uint slotStride;   // words from one instance to the next
    uint firstWord;    // of an instance
    uint elementCount; // of an instance
    uint elementWords; // from one element to the next
    uint keptWords;    // of an element, the first ones
    uint shares;       // workgroups an instance
    uint target;       // number of the hash
};

// Vertices of the patches that a view has placed.
SUPPLE_SHARED_CONST kRecordHashShares = 16u;   // workgroups a bucket of records
SUPPLE_SHARED_CONST kMostPatchSamples = 8192u; // no capacity has as many
struct RecordHashPush {
    uint runs;     // of the view
    uint firstRun; // of the group
    uint runCount;
    uint patchCount;   // of an instance
    uint vertexCount;  // that there is room for
    uint elementWords; // as above
    uint keptWords;
    uint target;
};

SUPPLE_SHARED_END

#endif
