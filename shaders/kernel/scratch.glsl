// Points of fragments in the scratch buffer, and the block a lane works in (shared/kernel.h).
layout(constant_id = 5) const bool kFromNet = false; // the level that is read is the isolated one

layout(set = 0, binding = kScratchBinding, std430) buffer Scratch { vec4 scratch[]; };
layout(set = 0, binding = kScratchTexelBinding) uniform samplerBuffer scratchTexels;

struct Lane {
    uint instance;
    uint rows, neighbours; // elements
    uint read, write;      // runs
    uint fragments, header;
    uint row, fragment;
    bool idle; // past the class's last row
};
Lane lane;

void findLane() {
    uint id = invocationIndex();
    uint block = min(id / kBlockLanes, push.count * push.instanceCount - 1u);
    lane.instance = block / push.count;
    uint record = push.records + 3u * (block - lane.instance * push.count);
    uvec4 where = tableElement(record), what = tableElement(record + 1u);
    uint rows = tableElement(record + 2u).x;
    lane.rows = where.x;
    lane.neighbours = where.y;
    lane.read = what.x;
    lane.write = what.y;
    lane.fragments = what.z;
    lane.header = what.w;
    uint beyond = where.w + id % kBlockLanes;
    // Small counts: the half keeps the quotient right however a device rounds.
    uint past = uint((float(beyond) + 0.5) / float(what.z));
    lane.row = where.z + past;
    lane.fragment = beyond - past * what.z;
    lane.idle = lane.row >= rows || id / kBlockLanes != block;
    lane.row = min(lane.row, rows - 1u);
}

vec3 point(uint i) {
    uint at = lane.read + i * lane.fragments + lane.fragment;
    if (kFromNet) return poolVector(lane.instance * push.poolStride + tableWord(at));
    at += lane.instance * push.scratchStride;
    if (kWide) return scratch[at].xyz;
    return texelFetch(scratchTexels, int(at)).xyz;
}
