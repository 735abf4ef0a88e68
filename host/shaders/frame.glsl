// What every drawing shader sees.
#include "draw.h"

layout(set = 0, binding = kFrameBinding, std140) uniform Frame { FrameUniforms frame; };
layout(push_constant) uniform Push { DrawPush push; };
