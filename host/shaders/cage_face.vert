#version 460
#extension GL_GOOGLE_include_directive : require
#include "cage_face.glsl"
#include "material.glsl"

layout(location = 0) out vec3 outPosition;
layout(location = 1) flat out vec3 outNormal;
layout(location = 2) out vec4 outUv; // of the base color; of metallic and roughness
layout(location = 3) out vec4 outColor;

/// Newell's normal: one for the whole polygon, flat or not.
vec3 faceNormal(CageCorner corner) {
    vec3 sum = vec3(0.0);
    vec3 first = cagePosition(cageWords[corner.faceStart]);
    vec3 previous = cagePosition(cageWords[corner.faceStart + corner.faceSides - 1u]) - first;
    for (uint i = 0u; i < corner.faceSides; ++i) {
        vec3 next = cagePosition(cageWords[corner.faceStart + i]) - first;
        sum += cross(previous, next);
        previous = next;
    }
    return sum;
}

void main() {
    CageCorner corner = cageCorner();
    outPosition = cagePosition(corner.vertex);
    outNormal = faceNormal(corner);
    outUv = vec4(placed(materialData.baseColorPlace, vec2(corner.baseColorU, corner.baseColorV)),
                 placed(materialData.metallicRoughnessPlace, vec2(corner.metallicRoughnessU, corner.metallicRoughnessV)));
    outColor = unpackUnorm4x8(corner.color);
    gl_Position = frame.viewProjection * vec4(outPosition, 1.0);
}
