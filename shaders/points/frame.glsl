// Frames of points. Every device has the same bits: no quotient and no root of its own, and `precise` throughout.
#include "shaders/shared/vectors.h"

// A power of two that makes the largest part of a vector about 1: products with it lose nothing. Of zero and of what is
// too small to matter it is 2^100.
float evenScaleOf(vec3 v) {
    int exponent = int(floatBitsToUint(largestOf(abs(v))) >> 23u);
    return uintBitsToFloat(uint(254 - clamp(exponent, 27, 227)) << 23u);
}
vec3 unitOf(vec3 v) {
    precise vec3 scaled = v * evenScaleOf(v);
    precise vec3 unit = scaled * rsqrt(dot3(scaled, scaled));
    return unit;
}
// A unit vector across another one: the axis that has least of it decides.
vec3 acrossOf(vec3 unit) {
    vec3 size = abs(unit);
    vec3 other = SELECT3(size.y <= size.z, vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
    vec3 axis = SELECT3(size.x <= size.y && size.x <= size.z, vec3(1.0, 0.0, 0.0), other);
    return unitOf(crossed(axis, unit));
}

struct PointFrame {
    vec3 tangent, bitangent, normal;
    float area; // against the bind pose
};

// The nearest rotation of the bind pose's frame in the tangent plane: A + B x n, which is never 0 where there is a plane.
// |A + B x n|^2 = |J|^2 + 2 det J, of the deformation J in the plane. Where A and B span none, the frame keeps the longer of
// them; where both are zero, it has the axes. Of what a pose mirrors the normal is turned round, and the matrix is a mirror.
PointFrame frameOf(vec3 a, vec3 b, bool isMirrored) {
    const float kFlat = 1e-13; // of a sine, squared: rounding alone
    vec3 largest = max(abs(a), abs(b));
    float scale = evenScaleOf(largest);
    precise vec3 along = a * scale, across = b * scale;
    vec3 product = crossed(along, across);
    float alongSquare = dot3(along, along), acrossSquare = dot3(across, across);
    precise float leastSquare = kFlat * alongSquare * acrossSquare;
    bool isFlat = !(dot3(product, product) > leastSquare);
    bool isNothing = !(largestOf(max(abs(along), abs(across))) > 0.25);
    // What stands for the two where they are no frame.
    vec3 longer = SELECT3(alongSquare >= acrossSquare, along, across);
    vec3 kept = unitOf(SELECT3(isNothing, vec3(1.0, 0.0, 0.0), longer));
    vec3 keptNormal = SELECT3(isNothing, vec3(0.0, 0.0, 1.0), acrossOf(kept));
    vec3 normal = unitOf(SELECT3(isFlat, keptNormal, product));
    precise vec3 turned = along + crossed(across, normal);
    // Where A and B are nearly parallel, rounding has leaned the normal towards them.
    turned = turned - dot3(turned, normal) * normal;
    vec3 tangent = unitOf(SELECT3(isFlat, kept, turned));
    // The scale is a power of two, and so is its inverse.
    float back = uintBitsToFloat((254u << 23u) - floatBitsToUint(scale));
    precise float area = ((dot3(product, normal) * back) * back);
    return PointFrame(tangent, crossed(normal, tangent), SELECT3(isMirrored, -normal, normal), SELECT(isFlat, 0.0, area));
}
