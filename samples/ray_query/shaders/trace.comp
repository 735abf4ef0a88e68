// A picture by ray queries alone: what a pixel sees, whether the lamp sees it (a disk, so shadows are soft), and how much of the
// sky does (ambient occlusion).
#version 460
#extension GL_EXT_ray_query : require
#extension GL_GOOGLE_include_directive : require
#include "supple_surface.glsl"
#include "trace.h"
layout(local_size_x = kGroupSize, local_size_y = kGroupSize) in;

layout(set = 0, binding = kSceneBinding) uniform accelerationStructureEXT scene;
layout(set = 0, binding = kVertexBinding, std430) readonly buffer Vertices { uvec4 vertices[]; };
layout(set = 0, binding = kIndexBinding, std430) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = kAttributeBinding, std430) readonly buffer Attributes { uvec4 attributes[]; };
layout(set = 0, binding = kGeometryBinding, std430) readonly buffer Geometries { Geometry geometries[]; };
layout(set = 0, binding = kPictureBinding, std430) writeonly buffer Picture { uint pixels[]; };
layout(push_constant) uniform Constants { Push push; };

const float kFar = 1e4, kPi = 3.14159265;
const vec3 kToLamp = vec3(-0.46, 0.74, 0.49);
const float kLampSize = 0.09; // the tangent of half its angle
const vec3 kLampColor = vec3(2.6, 2.35, 2.0);
const vec3 kFloorColor = vec3(0.30, 0.31, 0.33);

// A hash of three numbers, whose words are as good as random (Jarzynski and Olano, JCGT 2020).
uvec3 state;
vec2 random() {
    state = state * 1664525u + 1013904223u;
    state.x += state.y * state.z;
    state.y += state.z * state.x;
    state.z += state.x * state.y;
    state ^= state >> 16u;
    state.x += state.y * state.z;
    state.y += state.z * state.x;
    return vec2(state.xy >> 8u) / 16777216.0;
}

// Two axes across a unit vector.
mat3 axesAlong(vec3 n) {
    vec3 x = normalize(abs(n.x) > 0.5 ? vec3(n.y, -n.x, 0.0) : vec3(0.0, n.z, -n.y));
    return mat3(x, cross(n, x), n);
}

vec3 skyColor(vec3 direction) { return mix(vec3(0.50, 0.52, 0.55), vec3(0.50, 0.62, 0.82), max(direction.y, 0.0)); }

bool isOpen(vec3 origin, vec3 direction) {
    rayQueryEXT query;
    rayQueryInitializeEXT(query, scene, gl_RayFlagsOpaqueEXT | gl_RayFlagsTerminateOnFirstHitEXT, 0xFF, origin, 0.0, direction, kFar);
    while (rayQueryProceedEXT(query)) {
    }
    return rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT;
}

struct Place {
    vec3 position, normal, flatNormal, color;
    bool isThere;
};

// Slot, geometry, triangle and barycentrics are all that is needed to find what was hit.
Place figureAt(rayQueryEXT query, vec3 origin, vec3 direction) {
    Geometry geometry = geometries[rayQueryGetIntersectionGeometryIndexEXT(query, true)];
    uint first = geometry.firstIndex + 3u * uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
    uint slot = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true));
    vec2 b = rayQueryGetIntersectionBarycentricsEXT(query, true);
    vec3 weights = vec3(1.0 - b.x - b.y, b), corners[3], normal = vec3(0.0), color = vec3(0.0);
    for (uint i = 0u; i < 3u; ++i) {
        uint own = indices[first + i]; // within the instance, as attributes are counted
        uvec4 vertex = vertices[slot * push.verticesPerInstance + own];
        corners[i] = uintBitsToFloat(vertex.xyz);
        normal += weights[i] * suppleOctahedralNormal(vertex.w);
        color += weights[i] * suppleUnpackColor(attributes[own].zw).rgb;
    }
    Place place;
    place.isThere = true;
    place.position = origin + rayQueryGetIntersectionTEXT(query, true) * direction;
    place.flatNormal = normalize(cross(corners[1] - corners[0], corners[2] - corners[0]));
    place.normal = normalize(normal);
    place.color = color * geometry.color.rgb;
    if (!rayQueryGetIntersectionFrontFaceEXT(query, true)) { // a sleeve from inside
        place.flatNormal = -place.flatNormal;
        place.normal = -place.normal;
    }
    return place;
}

Place floorAt(vec3 origin, vec3 direction) {
    float t = (push.eye.w - origin.y) / direction.y;
    return Place(origin + t * direction, vec3(0.0, 1.0, 0.0), vec3(0.0, 1.0, 0.0), kFloorColor, direction.y < 0.0 && t > 0.0);
}

Place seenFrom(vec3 origin, vec3 direction) {
    rayQueryEXT query;
    rayQueryInitializeEXT(query, scene, gl_RayFlagsOpaqueEXT, 0xFF, origin, 0.0, direction, kFar);
    while (rayQueryProceedEXT(query)) {
    }
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionTriangleEXT)
        return figureAt(query, origin, direction);
    return floorAt(origin, direction);
}

// Light that comes to a place from a point of the lamp and from one direction of the sky.
vec3 lightAt(Place place) {
    vec3 start = place.position + push.right.w * place.flatNormal;
    vec2 r = random();
    vec3 lamp = normalize(axesAlong(normalize(kToLamp)) * vec3(kLampSize * sqrt(r.x) * vec2(cos(2.0 * kPi * r.y), sin(2.0 * kPi * r.y)), 1.0));
    vec3 light = vec3(0.0);
    float facing = dot(place.normal, lamp);
    if (facing > 0.0 && dot(place.flatNormal, lamp) > 0.0 && isOpen(start, lamp))
        light += facing * kLampColor;
    r = random(); // by the cosine
    vec3 sky = axesAlong(place.normal) * vec3(sqrt(r.x) * vec2(cos(2.0 * kPi * r.y), sin(2.0 * kPi * r.y)), sqrt(1.0 - r.x));
    if (sky.y < 0.0)
        light += 0.35 * kFloorColor; // from the floor
    else if (dot(place.flatNormal, sky) > 0.0 && isOpen(start, sky))
        light += 0.8 * skyColor(sky);
    return light;
}

vec3 seen(vec3 direction) {
    vec3 backdrop = 0.62 * skyColor(vec3(0.0, clamp(2.0 * direction.y + 0.3, 0.0, 1.0), 0.0));
    Place place = seenFrom(push.eye.xyz, direction);
    if (!place.isThere)
        return backdrop;
    vec3 lit = place.color * lightAt(place);
    // The floor ends in the backdrop.
    float away = length(place.position.xz - push.eye.xz) / length(push.eye.xz);
    return place.normal == vec3(0.0, 1.0, 0.0) ? mix(lit, backdrop, smoothstep(1.2, 3.0, away)) : lit;
}

vec3 toSrgb(vec3 x) { return mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, 12.92 * x, lessThan(x, vec3(0.0031308))); }

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x >= push.width || pixel.y >= push.height) return;
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < push.samples; ++i) {
        state = uvec3(pixel, i + 1u);
        vec2 at = 2.0 * (vec2(pixel) + random()) / vec2(push.width, push.height) - 1.0;
        sum += seen(normalize(push.ahead.xyz + at.x * push.right.xyz - at.y * push.up.xyz));
    }
    vec3 color = 1.0 - exp(-1.15 * sum / float(push.samples)); // bright places stay below white
    pixels[pixel.y * push.width + pixel.x] = packUnorm4x8(vec4(toSrgb(color), 1.0));
}
