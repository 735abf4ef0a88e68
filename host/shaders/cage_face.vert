#version 460
#extension GL_GOOGLE_include_directive : require
#include "cage_face.glsl"

layout(location = 0) out vec3 outPosition;
layout(location = 1) flat out vec3 outNormal;
layout(location = 2) out vec4 outUvs; // the first and the second
layout(location = 3) out vec4 outColor;
layout(location = 4) flat out uint outMirrored; // by the pose: winding shows the inside as the outside

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
    bool mirrored = isFaceMirrored(instanceSlots[gl_InstanceIndex], corner.faceStart, corner.faceSides);
    if (mirrored)
        outNormal = -outNormal;
    outMirrored = mirrored ? 1u : 0u;
    outUvs = vec4(corner.u0, corner.v0, corner.u1, corner.v1);
    outColor = unpackUnorm4x8(corner.color);
    gl_Position = frame.viewProjection * vec4(outPosition, 1.0);
}
