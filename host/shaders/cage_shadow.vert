#version 460
#extension GL_GOOGLE_include_directive : require
#include "cage_face.glsl"

void main() { gl_Position = frame.lights[push.light].shadow * vec4(cagePosition(cageCorner().vertex), 1.0); }
