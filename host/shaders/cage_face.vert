#version 460
#extension GL_GOOGLE_include_directive : require
#include "cage_face.glsl"

layout(location = 0) out vec3 outPosition;
layout(location = 1) flat out vec3 outNormal;
layout(location = 2) out vec4 outUvs; // the first and the second
layout(location = 3) out vec4 outColor;
layout(location = 4) flat out uint outMirrored; // by the pose: winding shows the inside as the outside

/// Newell's normal: one for the whole polygon, flat or not. `sides`: of its vertices, -1 where the pose mirrors, else 1.
vec3 faceNormal(CageCorner corner, out float sides) {
    sides = 0.0;
    vec3 sum = vec3(0.0);
    vec3 first = cagePosition(cageWords[corner.faceStart]);
    vec3 previous = cagePosition(cageWords[corner.faceStart + corner.faceSides - 1u]) - first;
    for (uint i = 0u; i < corner.faceSides; ++i) {
        vec4 vertex = cageVertex(cageWords[corner.faceStart + i]);
        sides += vertex.w;
        vec3 next = vertex.xyz - first;
        sum += cross(previous, next);
        previous = next;
    }
    return sum;
}

void main() {
    CageCorner corner = cageCorner();
    outPosition = cagePosition(corner.vertex);
    float sides;
    outNormal = faceNormal(corner, sides);
    outMirrored = (push.flags & kDrawMayMirror) != 0u && sides <= 0.0 ? 1u : 0u;
    if (outMirrored != 0u)
        outNormal = -outNormal;
    outUvs = vec4(corner.u0, corner.v0, corner.u1, corner.v1);
    outColor = unpackUnorm4x8(corner.color);
    gl_Position = frame.viewProjection * vec4(outPosition, 1.0);
}
