// Hashes of what a frame has written (docs/recording.md): two sums over all words of all instances, so that neither the
// order of lanes nor how instances are cut into windows makes a difference.
#ifndef SUPPLE_SHARED_WORD_HASH_H
#define SUPPLE_SHARED_WORD_HASH_H

#include "shaders/shared/elementary.h"
#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// A mix of a word and its place. The two sums have different ones.
SUPPLE_SHARED_FUNCTION uint wordMix(uint word, uint place, uint factor, uint shift) {
    uint h = word ^ ((place + shift) * factor);
    h ^= h >> 16u;
    h *= 0x85EBCA6Bu;
    h ^= h >> 13u;
    h *= 0xC2B2AE35u;
    h ^= h >> 16u;
    h = ((h + place) * factor) ^ (word >> 7u);
    h ^= h >> 15u;
    h *= 0x2C1B3C6Du;
    return h ^ (h >> 12u);
}
SUPPLE_SHARED_FUNCTION uint lowWordMix(uint word, uint place) {
    return wordMix(word, place, 0x9E3779B1u, 0u);
}
SUPPLE_SHARED_FUNCTION uint highWordMix(uint word, uint place) {
    return wordMix(word, place, 0x85EBCA77u, 0x165667B1u);
}

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
