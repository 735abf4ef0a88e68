// Bindings of all passes of bounds and culling.
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/bounds.h"

#ifdef PUSH_CONSTANTS
#include "shaders/shared/push.glsl"
#endif

BUFFER(, States, kBoundsStateBinding, std430, uvec2, states)

LOADED_BUFFER(uint, hostEntry, HostList, kHostListBinding, usamplerBuffer, kHostListTexelBinding, x)
