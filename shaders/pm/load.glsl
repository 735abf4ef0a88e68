// Loads the sectors of a P_3, P_4 or P_5 patch. Needs tables.glsl, `tangents` in the push constants and a function
// coefficient(index, today) that loads from the pool.
#include "shaders/pm/record.glsl"
#include "shaders/pm/sector.glsl"

SectorSide loadSide(uint m, uint record, uint base, uint inner, uint i, bool today) {
    uint at = inner + 1u + 3u * i, tangents = base + header.tangents;
    uint t0 = SUPPLE_SPOKE(spokeWord(record, i)), t1 = SUPPLE_NEXT_SPOKE(spokeWord(record, i + 1u == m ? 0u : i + 1u));
    return SectorSide(coefficient(base + pointIndex(record, i), today), coefficient(tangents + t0, today),
                      coefficient(tangents + t1, today), coefficient(at, today), coefficient(at + 1u, today),
                      coefficient(at + 2u, today));
}

// Of a patch of m sides, from its record.
Sector loadSector(uint m, vec2 ray, uint record, uint base, uint i, bool today) {
    uint inner = base + centreIndex(record, m), l = i == 0u ? m - 1u : i - 1u, n = i + 1u == m ? 0u : i + 1u;
    return makeSector(ray, coefficient(inner, today), loadSide(m, record, base, inner, l, today),
                      loadSide(m, record, base, inner, i, today), loadSide(m, record, base, inner, n, today));
}
