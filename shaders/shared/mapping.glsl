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

#ifdef TASKS
#include "shaders/shared/task.glsl"
#endif

// A buffer of set 0 that a kernel only loads from, by `T load(uint i)`. GPUs bind it as a storage buffer. CPU devices bind it as
// texels, of which an element is what `part` names: their drivers gather texels without a loop over the lanes. In a shared
// dispatch it is the task's buffer, at an address.
#ifdef TASKS
#define LOADED_BUFFER(T, load, Block, bufferBinding, sampler, texelBinding, part)                                                \
    layout(buffer_reference, std430) readonly buffer Block { T at[]; };                                                          \
    Block load##Buffer = Block(bufferOfTask(bufferBinding));                                                                      \
    T load(uint i) { return load##Buffer.at[i]; }
#elif defined(WIDE)
#define LOADED_BUFFER(T, load, Block, bufferBinding, sampler, texelBinding, part)                                                \
    layout(set = 0, binding = bufferBinding, std430) readonly buffer Block { T load##Elements[]; };                              \
    T load(uint i) { return load##Elements[i]; }
#else
#define LOADED_BUFFER(T, load, Block, bufferBinding, sampler, texelBinding, part)                                                \
    layout(set = 0, binding = texelBinding) uniform sampler load##Texels;                                                        \
    T load(uint i) { return texelFetch(load##Texels, int(i)).part; }
#endif
// Any other buffer of set 0: its elements are name.at[].
#ifdef TASKS
#define BUFFER(access, Block, bufferBinding, rules, T, name)                                                                     \
    layout(buffer_reference, rules) access buffer Block { T at[]; };                                                             \
    Block name = Block(bufferOfTask(bufferBinding));
#else
#define BUFFER(access, Block, bufferBinding, rules, T, name)                                                                     \
    layout(set = 0, binding = bufferBinding, rules) access buffer Block { T at[]; } name;
#endif

layout(constant_id = kExactDivisionConstant) const bool kExactDivision = false; // the device rounds k / rate correctly

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
// In a shared dispatch they are those of the task.
#ifdef TASKS
uint workgroupIndex() { return dispatchedWorkgroup() - task.firstGroup; }
#else
uint workgroupIndex() { return gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x; }
#endif
// Beyond the first one of a kernel that is dispatched as one: the rows of a shared dispatch may have more.
bool isFurtherWorkgroup() { return workgroupIndex() > 0u; }
uint invocationIndex() { return workgroupIndex() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }
