// What the passes of bounds and culling share: loads, one function each (storage buffers on GPUs, texels on CPU devices).
#include "shaders/shared/mapping.glsl"
#include "shaders/shared/bounds.h"

layout(set = 0, binding = kBoundsStateBinding, std430) buffer States { uvec2 states[]; };

LOADED_BUFFER(uint, hostEntry, HostList, kHostListBinding, usamplerBuffer, kHostListTexelBinding, x)
