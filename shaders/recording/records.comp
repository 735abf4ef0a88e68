// Adds up the hashes of the vertices of patches that a view has placed, wherever these lie: a place is that of a sample in its
// patch and instance. A workgroup takes a share of a bucket of records (shaders/shared/lod.h).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lod/runs.glsl"
#include "shaders/recording/hash.glsl"

layout(push_constant) uniform Push { RecordHashPush push; };

void main() {
    uint bucket = workgroupIndex() / kRecordHashShares, share = workgroupIndex() % kRecordHashShares;
    uint run = push.firstRun + bucket / kCapacityCount, c = bucket % kCapacityCount;
    if (run >= push.firstRun + push.runCount) return; // the whole workgroup
    uint ofRun = kLodRuns + kLodRunWords * run, first = firstOfGroup(list.at[ofRun + 1u], run);
    uint at = SUPPLE_LOD_BUCKETS(push.runs) + 4u * bucketIndex(first, run, c);
    uint samples = formSamples(runForm(list.at[ofRun]), capacityOf(c));
    uint begin = list.at[at], count = min(list.at[at + 2u], list.at[at + 4u] - begin);
    uint most = (uint(list.at.length()) - SUPPLE_LOD_RECORDS(push.runs)) / kLodRecordWords; // records that there is room for
    uint end = min(begin + count, most);
    uvec2 sum = uvec2(0u);
    for (uint record = begin + share; record < end; record += kRecordHashShares) {
        uint head = SUPPLE_LOD_RECORDS(push.runs) + kLodRecordWords * record;
        uint vertex = min(list.at[head + 2u], push.vertexCount - samples);
        uint patchPlace = (list.at[head + 1u] & kInstanceSlotMask) * push.patchCount + list.at[head];
        uint place = patchPlace * kMostPatchSamples * push.keptWords;
        for (uint i = gl_LocalInvocationID.x; i < samples; i += gl_WorkGroupSize.x) {
            for (uint k = 0u; k < push.keptWords; ++k) {
                sum += hashOf(words.at[(vertex + i) * push.elementWords + k], place + i * push.keptWords + k);
            }
        }
    }
    addTo(push.target, sum);
}
