// What every drawing shader sees.
#include "draw.h"

layout(set = 0, binding = kFrameBinding, std430) readonly buffer Frame { FrameUniforms frame; };
#ifndef PUSH
#define PUSH DrawPush
#endif
layout(push_constant) uniform Push { PUSH push; };
// A constant, as what the material has is (material.glsl): lavapipe compiles a shader anew for every draw, and keeps it, if
// numbers from a uniform buffer or push constants leave out much of it. A storage buffer it does not look into.
layout(constant_id = 2) const uint kView = kViewShaded;
