// Where the chain of a corner lies (docs/catmull_clark.md). Before the include: chain_level.glsl, and
//   vec3 poolPoint(const PatchPlace at, uint i)       of the pool, as motion wants it
//   DEPTH_OF_INSTANCE                                 a macro, if an instance's pool says how far its chains go (lod/depth.comp)

struct Chain {
    uint windows, points; // windows of its sector, 0 where there is none; pool index of the first point of level 2
    uint size;            // points of a level
    uint lastLevel;
};
// `size`: with the last level, as records have it (surface/exact/chain_tables.h).
Chain chainOf(const PatchPlace at, uint windows, uint points, uint size) {
    uint last = size >> kChainLevelShift;
#ifdef DEPTH_OF_INSTANCE
    last = uint(poolPoint(at, push.pairs).x);
#endif
    return Chain(windows, points, size & ((1u << kChainLevelShift) - 1u), last);
}
uint levelPoints(Chain chain, uint level) { return chain.points + (level - 2u) * chain.size; }
vec3 chainOrigin(const PatchPlace at, Chain chain) { return poolPoint(at, chain.points - 1u); }
