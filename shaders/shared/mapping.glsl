// The constants that lay the same code on a CPU device or a GPU; chosen in gpu/mapping.cpp.
#include "shaders/shared/specialization.h"

layout(local_size_x_id = kLocalSizeConstant) in;
// Many lanes a patch, storage-buffer loads. A macro: what one mapping does without need not be compiled for it.
#ifdef WIDE
const bool kWide = true;
#else
const bool kWide = false;
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
