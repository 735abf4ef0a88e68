// What the kernels of queries read, and rays. Needs mapping.glsl.
#include "shaders/shared/queries.h"
#include "shaders/shared/surface.h"

const uint kNoFace = 0xFFFFFFFFu;

BUFFER(readonly, Rays, kRayBinding, std430, vec4, rays)
BUFFER(, Best, kBestBinding, std430, uvec2, best)
BUFFER(, Boxes, kQueryBoxBinding, std430, vec4, boxes)

#define PUSH_CONSTANTS QueryPush
#include "shaders/shared/push.glsl"

LOADED_BUFFER(uint, listedEntry, Instances, kInstanceBinding, usamplerBuffer, kInstanceTexelBinding, x)
LOADED_BUFFER(uvec4, piece, Pieces, kPieceBinding, usamplerBuffer, kPieceTexelBinding, xyzw)
LOADED_BUFFER(vec4, cage, DeformedCage, kQueryCageBinding, samplerBuffer, kQueryCageTexelBinding, xyzw)

uint slotOfListed(uint listed) { return listedEntry(push.firstEntry + listed) & kInstanceSlotMask; }

// By bits: compilers may take it that there is no NaN.
bool finite(vec3 p) { return all(lessThan(floatBitsToUint(p) & 0x7FFFFFFFu, uvec3(0x7F800000u))); }
bool isNumber(float x) { return (floatBitsToUint(x) & 0x7FFFFFFFu) <= 0x7F800000u; }

const float kShortestDirection = 1e-30, kLongestDirection = 1e30;
const float kFarthest = 1e18; // of coordinates: their squares are finite

// A ray with a direction of unit length, and two directions across it.
struct Ray {
    vec3 origin, along, x, y;
    float from, to; // distances
    float unit;     // a t of 1 as a distance
    bool sound;     // else it meets nothing
};
Ray rayOf(uint number) {
    vec4 first = rays.at[2u * number], second = rays.at[2u * number + 1u];
    vec3 size = abs(second.xyz);
    float longest = max(size.x, max(size.y, size.z));
    Ray ray;
    ray.origin = first.xyz;
    ray.sound = finite(first.xyz) && finite(second.xyz) && isNumber(first.w) && isNumber(second.w);
    ray.sound = ray.sound && longest > kShortestDirection && longest < kLongestDirection;
    ray.sound = ray.sound && all(lessThan(abs(first.xyz), vec3(kFarthest)));
    if (!ray.sound) longest = 1.0;
    vec3 scaled = ray.sound ? second.xyz / longest : vec3(0.0, 0.0, 1.0);
    float scaledLength = length(scaled);
    ray.along = scaled / scaledLength;
    ray.unit = longest * scaledLength;
    ray.from = max(first.w, 0.0) * ray.unit;
    ray.to = second.w * ray.unit;
    size = abs(ray.along);
    vec3 least = size.x <= size.y && size.x <= size.z ? vec3(1.0, 0.0, 0.0) : size.y <= size.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
    ray.x = normalize(cross(ray.along, least));
    ray.y = cross(ray.along, ray.x);
    return ray;
}

// Whether the ray may meet what is in a box. In the box's own frame nothing is divided by.
bool mayMeet(Ray ray, vec3 low, vec3 high) {
    vec3 half_ = 0.5 * high - 0.5 * low, middle = (0.5 * low + 0.5 * high) - ray.origin, size = abs(ray.along);
    float at = dot(middle, ray.along), reach = dot(half_, size);
    vec3 off = abs(cross(middle, ray.along));
    // What rounding leaves of far origins.
    float slack = 4e-7 * (dot(abs(ray.origin), vec3(1.0)) + dot(abs(low) + abs(high), vec3(1.0)));
    vec3 most = vec3(half_.y * size.z + half_.z * size.y, half_.z * size.x + half_.x * size.z, half_.x * size.y + half_.y * size.x);
    return all(lessThanEqual(off, most + slack)) && at + reach + slack >= ray.from && at - reach - slack <= ray.to;
}

// Makes a box larger by a part of its size on each side.
void grow(inout vec3 low, inout vec3 high, float part) {
    vec3 by = part * (high - low);
    low -= by;
    high += by;
}
