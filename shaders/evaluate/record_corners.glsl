// The corners of bicubic patches, of the pool's fan records (shared/prep.h). Only groups at a rate have these.
#include "shaders/surface/fan_record.glsl"

void loadCorners(const PatchPlace at, inout Patch c) {
    NetRecord net = netRecord(at.record);
    FanRecord r0 = fanRecord(at.base, net.points.x), r1 = fanRecord(at.base, net.points.y), r2 = fanRecord(at.base, net.points.z),
              r3 = fanRecord(at.base, net.points.w);
    c.c0 = cornerOfFan(r0, net.spokes.x, r1.p0, r2.p0, r3.p0);
    c.c1 = cornerOfFan(r1, net.spokes.y, r2.p0, r3.p0, r0.p0);
    c.c2 = cornerOfFan(r2, net.spokes.z, r3.p0, r0.p0, r1.p0);
    c.c3 = cornerOfFan(r3, net.spokes.w, r0.p0, r1.p0, r2.p0);
    if (!hasBorders(net.spokes.x | net.spokes.y | net.spokes.z | net.spokes.w)) return; // as most patches
    setBorders(r0, net.spokes.x, r1.p0, r3.p0, c.c0);
    setBorders(r1, net.spokes.y, r2.p0, r0.p0, c.c1);
    setBorders(r2, net.spokes.z, r3.p0, r1.p0, c.c2);
    setBorders(r3, net.spokes.w, r0.p0, r2.p0, c.c3);
}
Corner storedCorner(const PatchPlace at, uint corner) { return cornerOfPatch(at.base, at.record, corner); }
vec3 cornerNormal(uint base, uint vertex) {
    FanRecord r = fanRecord(base, vertex);
    return cross(r.e1, r.e2);
}
