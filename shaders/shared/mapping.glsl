// The mapping of the work to lanes, for CPU devices and for GPUs. gpu/mapping.cpp chooses it.
#include "shaders/shared/select.glsl"
#include "shaders/shared/specialization.h"

layout(local_size_x_id = kLocalSizeConstant) in;
// Many lanes per patch, loads from storage buffers. It is a macro: what one mapping does without need not be compiled for it.
#ifdef WIDE
const bool kWide = true;
#else
const bool kWide = false;
#endif

// A buffer of set 0 that a kernel only loads from, by `T load(uint i)`. GPUs bind it as a storage buffer. CPU devices bind it as
// texels, of which an element is what `part` names: their drivers gather texels without a loop over the lanes.
#ifdef WIDE
#define LOADED_BUFFER(T, load, Block, bufferBinding, sampler, texelBinding, part)                                                \
    layout(set = 0, binding = bufferBinding, std430) readonly buffer Block { T load##Elements[]; };                              \
    T load(uint i) { return load##Elements[i]; }
#else
#define LOADED_BUFFER(T, load, Block, bufferBinding, sampler, texelBinding, part)                                                \
    layout(set = 0, binding = texelBinding) uniform sampler load##Texels;                                                        \
    T load(uint i) { return texelFetch(load##Texels, int(i)).part; }
#endif

layout(constant_id = kExactDivisionConstant) const bool kExactDivision = false; // the device rounds k / rate correctly

const uint kMaxLanes = 128u; // of gl_WorkGroupSize.x: gpu/mapping.cpp

// -0 as +0: sides of a border may come to different zeros. Vulkan lets a compiler drop x + 0.0, as the sign of a zero need not
// be kept; lavapipe keeps it, and it is cheaper there.
vec3 withPositiveZeros(vec3 v) {
    if (!kWide) {
        precise vec3 sum = v + 0.0;
        return sum;
    }
    uvec3 bits = floatBitsToUint(v);
    return uintBitsToFloat(mix(bits, uvec3(0u), equal(bits, uvec3(0x80000000u))));
}

// Linear invocation and workgroup indices of a dispatch that was split at the device's limit of groups in x.
uint workgroupIndex() { return gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x; }
uint invocationIndex() { return workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }
