// Bindings of all passes of bounds and culling.
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/bounds.h"

layout(set = 0, binding = kBoundsStateBinding, std430) buffer States { uvec2 states[]; };

LOADED_BUFFER(uint, hostEntry, HostList, kHostListBinding, usamplerBuffer, kHostListTexelBinding, x)
