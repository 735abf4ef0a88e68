// The fan of a vertex as the ring has it (shared/surface.h): every spoke's word says where its facet's corners stand. Needs
// tables.glsl and mesh.glsl.
uint ringCorner(uint word, uint which) {
    return SUPPLE_POINT(tableElement(SUPPLE_RING_ELEMENT(word))[SUPPLE_RING_PLACE(word, which)]);
}
vec3 ringPoint(uint word, uint which, uint cageBase) { return meshPoint(cageBase + ringCorner(word, which)); }
vec3 ringSpoke(uint word, uint cageBase) { return ringPoint(word, kRingFarEnd, cageBase); }
