// The cage's shadow, with the holes that a mask makes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "cage_face.glsl"
#include "material.glsl"

layout(location = 0) out vec3 outTrim; // see surface_attributes.glsl

void main() {
    CageCorner corner = cageCorner();
    outTrim = vec3(placed(kTrim, vec4(corner.u0, corner.v0, corner.u1, corner.v1)),
                   materialData.baseColor.a * unpackUnorm4x8(corner.color).a);
    gl_Position = frame.lights[push.light].shadow * vec4(cagePosition(corner.vertex), 1.0);
}
