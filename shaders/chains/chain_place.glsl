// Where the chain of a corner lies (docs/catmull_clark.md). Before the include: chain_level.glsl, and
//   vec3 poolPoint(const PatchPlace at, uint i)       of the pool, as motion wants it
//   DEPTH_OF_INSTANCE                                 a macro, if an instance's pool says how far its chains go (lod/depth.comp)

struct Chain {
    uint netLists, points; // net lists of its sector, 0 where there is none; pool index of the first point of level 2
    uint size;            // points of a level
    uint lastLevel;
};
// `lastWord`: of a net list; it says how long chains are (surface/chains/fan_tables.cpp). Where there is no chain, `netLists` is 0, and
// the word that is read then is not used.
Chain chainOf(const PatchPlace at, uint netLists, uint points, uint lastWord) {
    uint size = tableWord(4u * netLists + lastWord), last = size >> kChainLevelShift;
#ifdef DEPTH_OF_INSTANCE
    // An empty record's instance may have whatever the memory holds.
    last = min(last, max(uint(poolPoint(at, header.depth).x), kFirstDepth - 1u));
#endif
    return Chain(netLists, points, size & ((1u << kChainLevelShift) - 1u), last);
}
// Normals of corners, `back` before their chains.
uvec4 normalsBefore(uvec4 chains, uvec2 back) {
    uvec4 by = uvec4(halfOf(back.x, 0u), halfOf(back.x, 1u), halfOf(back.y, 0u), halfOf(back.y, 1u));
    return mix(chains - by, uvec4(kNoNormal), equal(by, uvec4(0u)));
}
// Point k of a net list.
uint netListPoint(uint netList, uint k) { return halfOf(tableWord(4u * netList + k / 2u), k); }
uint levelPoints(Chain chain, uint level) { return chain.points + (level - 2u) * chain.size; }
vec3 chainOrigin(const PatchPlace at, Chain chain) { return poolPoint(at, chain.points - 1u); }
