// Bindings of all passes of bounds and culling. Needs PUSH_CONSTANTS.
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/bounds.h"

#include "shaders/shared/push.glsl"

BUFFER(, States, kBoundsStateBinding, std430, uvec2, states)

LOADED_BUFFER(uint, hostEntry, HostList, kHostListBinding, usamplerBuffer, kHostListTexelBinding, x)
