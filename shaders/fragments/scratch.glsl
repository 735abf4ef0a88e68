// Points of fragments in the scratch buffer, and the lane's place in its block (shared/subdivision.h).
layout(constant_id = kSourceConstant) const uint kSource = kFromScratch; // the level that is read
layout(constant_id = kWorkConstant) const uint kKind = kInBulk;        // of work

BUFFER(, Scratch, kScratchBinding, std430, vec4, scratch)
#ifdef WIDE
vec3 scratchPoint(uint i) { return scratch.at[i].xyz; }
#else
layout(set = 0, binding = kScratchTexelBinding) uniform samplerBuffer scratchTexels;
vec3 scratchPoint(uint i) { return texelFetch(scratchTexels, int(i)).xyz; }
#endif

struct Lane {
    uint listed; // the entry of the list
    uint instance, record;
    uint rows, list;
    uint read, write; // runs
    uint fragments, place, fragment;
    bool idle; // past the last place
};
Lane lane;

void findLane() {
    uint id = invocationIndex();
    uint block = min(id / kBlockLanes, itemCount() - 1u);
    lane.listed = entryOf(block);
    lane.instance = slotOf(lane.listed);
    lane.record = push.table + 3u * elementOf(block);
    uvec4 where = tableElement(lane.record), what = tableElement(lane.record + 1u);
    lane.rows = where.x;
    lane.list = where.y;
    lane.read = what.x;
    lane.write = what.y;
    lane.fragments = what.z;
    uint beyond = where.w + id % kBlockLanes;
    // Small counts: the half keeps the quotient right however a device rounds.
    uint past = uint((float(beyond) + 0.5) / float(what.z));
    lane.place = where.z + past;
    lane.fragment = beyond - past * what.z;
    lane.idle = lane.place >= what.w || id / kBlockLanes != block;
    lane.place = min(lane.place, what.w - 1u);
}

vec3 point(uint i) {
    uint at = lane.read + i * lane.fragments + lane.fragment;
    if (kSource != kFromScratch)
        return netPoint(lane.instance * header.poolStride + tableWord(at), lane.listed, kSource == kFromPastNet);
    return scratchPoint(lane.instance * header.scratchStride + at);
}
