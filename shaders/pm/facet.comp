// Facet stage of P_m: the coefficients inside a patch that no other patch shares (docs/pm.md, (18)-(22)). One invocation a
// facet and instance; polar facets get h12 and h22, triangles, quads and pentagons b004 and b211, b121, b112 a sector.
// Summed relative to the first corner's limit point: all formulas are affine. Like the tangents, all but b004 are stored
// as offsets: h12, h22 from the apex, b211 from v_i, b121 from v_i+1, b112 from b004.
#version 460
#extension GL_GOOGLE_include_directive : require
#define PUSH_CONSTANTS ConstructPush
#include "shaders/surface/tables.glsl"
#include "shaders/surface/pool.glsl"
#include "shaders/surface/store.glsl"
#include "shaders/pm/pm.glsl"
#include "shaders/pm/record.glsl"
#include "shaders/pm/alphas.glsl"

void polarFacet(uint record, uint base, uint instance) {
    uvec4 points = tableElement(record), spokes = tableElement(record + 1u);
    uvec4 apex = tableElement(spokes.w);
    vec4 w = uintBitsToFloat(apex);
    if (apex.w != 0u) {
        float alpha = alphaOfSet(instance, apex.w & kAlphaSetMask), back = alphaOfSet(instance, apex.w >> kBackSetShift);
        if (alpha >= 0.0) w.y = 1.5 * alpha;
        if (back >= 0.0) w.z = 1.5 * back;
    }
    uint tangents = base + header.tangents, target = base + points.w;
    vec3 h02 = poolVector(tangents + SUPPLE_SPOKE(spokes.z)), h32 = poolVector(tangents + SUPPLE_NEXT_SPOKE(spokes.z));
    precise float scale = 1.0 / (2.0 + w.x);
    precise vec3 h12 = (2.0 * h02 + h32) * scale, h22 = (h02 + 2.0 * h32) * scale;          // (18)
    precise vec3 creased12 = w.y * h12 + (1.0 - w.y) * h02, creased22 = w.z * h22 + (1.0 - w.z) * h32; // (19)
    storePool(target, creased12);
    storePool(target + 1u, creased22);
}

void innerFacet(uint record, uint base) {
    const uint m = kSides;
    vec3 origin = poolVector(base + pointIndex(record, 0u));
    vec3 v[kSides];
    vec3 t0[kSides], t1[kSides];    // from v_i
    vec3 own[kSides], back[kSides]; // f - f_across over edge i and over edge i - 1, or f - t where the edge ends the sector
    uint edgeClass[kSides];
    precise vec3 centre = vec3(0.0);
    uint tangents = base + header.tangents, faces = base + header.faces;
    uint target = base + SUPPLE_INNER(innerWord(record, m));
    for (uint i = 0u; i < m; ++i) {
        uint point = pointWord(record, i), spoke = SUPPLE_SPOKE(spokeWord(record, i));
        uint behind = SUPPLE_NEXT_SPOKE(spokeWord(record, i));
        int step = SUPPLE_ACROSS_STEP(point);
        bool ends = step == 0, endsBehind = (point & kEndsBehind) != 0u;
        precise vec3 vi = poolVector(base + SUPPLE_POINT(point)) - origin;
        vec3 a = poolVector(tangents + spoke), b = poolVector(tangents + behind), f = poolVector(faces + spoke);
        vec3 fa = poolVector(ends ? tangents + spoke : faces + uint(int(spoke) + step));
        vec3 fb = poolVector((endsBehind ? tangents : faces) + behind);
        precise vec3 ea = (f + fa) * 0.5, eb = (f + fb) * 0.5;
        if (ends) ea = a;
        if (endsBehind) eb = b;
        centre = centre + ((kCentreWeight + 15.0) * vi + (3.0 * (ea + eb) + 9.0 * f)); // (20)
        v[i] = vi;
        t0[i] = a;
        t1[i] = b;
        own[i] = f - fa;
        back[i] = f - fb;
        edgeClass[i] = header.edgeClasses + 2u * SUPPLE_EDGE_CLASS(classWord(record, m, i), i);
    }
    precise vec3 b004 = centre * kCentreScale;
    precise vec3 centrePoint = origin + b004;
    storePool(target, centrePoint);

    vec3 b211[kSides], b121[kSides], b202[kSides], b310[kSides], b130[kSides];
    for (uint i = 0u; i < m; ++i) { // (20)
        uint n = i + 1u == m ? 0u : i + 1u;
        vec4 w0 = uintBitsToFloat(tableElement(edgeClass[i])), w1 = uintBitsToFloat(tableElement(edgeClass[i] + 1u));
        precise vec3 o310 = 0.75 * t0[i], o130 = 0.75 * t1[n];
        precise vec3 along = (v[n] - v[i]) + (t1[n] - t0[i]);
        precise vec3 o211 = o310 + ((w0.x * along + w0.y * t0[i]) + w0.z * own[i]);
        precise vec3 o121 = o130 + ((w1.y * t1[n] - w1.x * along) + w0.w * back[n]);
        uint slot = target + 1u + 3u * i;
        storePool(slot, o211);
        storePool(slot + 1u, o121);
        precise vec3 p310 = v[i] + o310, p130 = v[n] + o130, p211 = v[i] + o211, p121 = v[n] + o121;
        b310[i] = p310;
        b130[i] = p130;
        b211[i] = p211;
        b121[i] = p121;
    }
    for (uint i = 0u; i < m; ++i) { // (3)
        uint l = i == 0u ? m - 1u : i - 1u;
        precise vec3 b301 = kRayMiddle * v[i] + kRaySide * (b310[i] + b130[l]);
        precise vec3 p = kRayMiddle * b301 + kRaySide * (b211[i] + b121[l]);
        b202[i] = p;
    }
    for (uint i = 0u; i < m; ++i) {
        uint n1 = (i + 1u) % m, n2 = (i + 2u) % m, n3 = (i + 3u) % m, n4 = (i + 4u) % m;
        precise vec3 o112;
        if (m == 3u) {
            o112 = 0.5 * (b004 - b202[n2]);
        } else if (m == 4u) { // (21); n3 is the side before
            o112 = (3.0 / 16.0) * ((b211[i] + b121[i]) - (b121[n1] + b211[n3])) +
                   (1.0 / 16.0) * ((b211[n1] + b121[n3]) - (b211[n2] + b121[n2]));
        } else { // (22)
            precise vec3 sum = b202[n3] - 4.0 * kD * (b202[i] + b202[n1]) - 4.0 * kD * kD * (b202[n2] + b202[n4]);
            o112 = (kMu - 1.0) * b004 + (kMu * 0.2) * sum;
        }
        storePool(target + 3u + 3u * i, o112);
    }
}

void main() {
    uint item = itemOfLane(), facet = elementOf(item), instance = instanceOf(item), base = poolBase(instance);
    if (kClass == kPolarPatch) polarFacet(push.table + 2u * facet, base, instance);
    else innerFacet(push.table + SUPPLE_PM_RECORD_ELEMENTS(kSides) * facet, base);
}
