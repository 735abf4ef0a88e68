// What the kernels of queries read, and rays. Needs mapping.glsl.
#include "shaders/shared/queries.h"
#include "shaders/shared/surface.h"
#include "shaders/shared/vectors.h"

const uint kNoFace = 0xFFFFFFFFu;

BUFFER(readonly, Rays, kRayBinding, std430, vec4, rays)
BUFFER(, Best, kBestBinding, std430, uvec2, best)
BUFFER(, Boxes, kQueryBoxBinding, std430, uvec4, boxWords)

#define PUSH_CONSTANTS QueryPush
#include "shaders/shared/push.glsl"

LOADED_BUFFER(uint, listedEntry, Instances, kInstanceBinding, usamplerBuffer, kInstanceTexelBinding, x)
LOADED_BUFFER(uvec4, piece, Pieces, kPieceBinding, usamplerBuffer, kPieceTexelBinding, xyzw)
LOADED_BUFFER(vec4, cage, DeformedCage, kQueryCageBinding, samplerBuffer, kQueryCageTexelBinding, xyzw)

// The box of an instance's cage. `listed`: in the list of the window.
void loadBox(uint listed, out vec3 low, out vec3 high) {
    low = uintBitsToFloat(boxWords.at[2u * (push.firstBox + listed)].xyz);
    high = uintBitsToFloat(boxWords.at[2u * (push.firstBox + listed) + 1u].xyz);
}
uint slotOfListed(uint listed) { return listedEntry(push.firstEntry + listed) & kInstanceSlotMask; }

// By bits: compilers may take it that there is no NaN.
bool finite(vec3 p) { return all(lessThan(floatBitsToUint(p) & 0x7FFFFFFFu, uvec3(0x7F800000u))); }
bool isNumber(float x) { return (floatBitsToUint(x) & 0x7FFFFFFFu) <= 0x7F800000u; }

const float kShortestDirection = 1e-30, kLongestDirection = 1e30;
const float kFarthest = 1e18; // of coordinates: their squares are finite

// A ray with a direction of unit length, and two directions across it. What meets it is computed in several kernels, so all of that
// is rounded as it is written: then they agree on it.
struct Ray {
    vec3 origin, along, x, y;
    float from, to; // distances
    float unit;     // a t of 1 as a distance
    bool sound;     // else it meets nothing
};
float lengthOf(vec3 v) {
    precise float own = sqrt(dot3(v, v));
    return own;
}
Ray rayOf(uint number) {
    vec4 first = rays.at[2u * number], second = rays.at[2u * number + 1u];
    vec3 size = abs(second.xyz);
    float longest = max(size.x, max(size.y, size.z));
    precise Ray ray;
    ray.origin = first.xyz;
    ray.sound = finite(first.xyz) && finite(second.xyz) && isNumber(first.w) && isNumber(second.w);
    ray.sound = ray.sound && longest > kShortestDirection && longest < kLongestDirection;
    ray.sound = ray.sound && all(lessThan(abs(first.xyz), vec3(kFarthest)));
    if (!ray.sound) longest = 1.0;
    precise vec3 scaled = ray.sound ? second.xyz / longest : vec3(0.0, 0.0, 1.0);
    float scaledLength = lengthOf(scaled);
    ray.along = scaled / scaledLength;
    ray.unit = longest * scaledLength;
    ray.from = max(first.w, 0.0) * ray.unit;
    ray.to = second.w * ray.unit;
    size = abs(ray.along);
    vec3 least = size.x <= size.y && size.x <= size.z ? vec3(1.0, 0.0, 0.0) : size.y <= size.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
    vec3 across = crossed(ray.along, least);
    ray.x = across / lengthOf(across);
    ray.y = crossed(ray.along, ray.x);
    return ray;
}

// Whether the ray may meet what is in a box, or passes it by no more than `beside`. In the box's own frame nothing is divided by.
bool mayMeet(Ray ray, vec3 low, vec3 high, float beside) {
    vec3 half_ = 0.5 * high - 0.5 * low, middle = (0.5 * low + 0.5 * high) - ray.origin, size = abs(ray.along);
    float at = dot(middle, ray.along), reach = dot(half_, size);
    vec3 off = abs(cross(middle, ray.along));
    // What rounding leaves of far origins.
    float slack = 2.0 * beside + 4e-7 * (dot(abs(ray.origin), vec3(1.0)) + dot(abs(low) + abs(high), vec3(1.0)));
    vec3 most = vec3(half_.y * size.z + half_.z * size.y, half_.z * size.x + half_.x * size.z, half_.x * size.y + half_.y * size.x);
    return all(lessThanEqual(off, most + slack)) && at + reach + slack >= ray.from && at - reach - slack <= ray.to;
}
// The part of the ray that comes no farther than a hit that is known.
Ray upTo(Ray ray, uint least) {
    if (least != kNothingMet) ray.to = min(ray.to, uintBitsToFloat(least) * ray.unit * 1.000001);
    return ray;
}
// By how much a hit may lie beside its ray: a part of the instance's size, and what rounding leaves far from the origin.
float toleranceFor(vec3 low, vec3 high, vec3 origin) {
    vec3 farthest = max(max(abs(low), abs(high)), abs(origin));
    precise float tolerance = 2e-6 * lengthOf(high - low) + 5e-7 * max(farthest.x, max(farthest.y, farthest.z));
    return tolerance;
}

// Makes a box larger by a part of its size on each side.
void grow(inout vec3 low, inout vec3 high, float part) {
    vec3 by = part * (high - low);
    low -= by;
    high += by;
}
