// Casts rays into a RayScene: the nearest hit of each.
#version 460
#extension GL_EXT_ray_query : require
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform accelerationStructureEXT scene;

struct Ray {
    vec4 origin; // and the least t
    vec4 direction; // and the largest t
};
struct Hit {
    float t; // negative: nothing is hit
    uint slot, geometry, triangle, front;
};
layout(set = 0, binding = 1, std430) readonly buffer Rays { Ray rays[]; };
layout(set = 0, binding = 2, std430) writeonly buffer Hits { Hit hits[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rays.length()) return;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, scene, gl_RayFlagsOpaqueEXT, 0xFF, rays[i].origin.xyz, rays[i].origin.w, rays[i].direction.xyz,
                          rays[i].direction.w);
    while (rayQueryProceedEXT(query)) {
    }
    Hit hit = Hit(-1.0, 0u, 0u, 0u, 0u);
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionTriangleEXT) {
        hit.t = rayQueryGetIntersectionTEXT(query, true);
        hit.slot = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true));
        hit.geometry = uint(rayQueryGetIntersectionGeometryIndexEXT(query, true));
        hit.triangle = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
        hit.front = rayQueryGetIntersectionFrontFaceEXT(query, true) ? 1u : 0u;
    }
    hits[i] = hit;
}
