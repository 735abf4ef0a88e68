#include "gpu/mapping.h"

namespace supple::gpu {

Mapping chooseMapping(VkPhysicalDeviceType type, VkDriverId driver, MappingChoice choice) {
    Mapping mapping;
    mapping.wide =
        choice == MappingChoice::wide || (choice == MappingChoice::automatic && type != VK_PHYSICAL_DEVICE_TYPE_CPU);
    // Vulkan allows 2.5 ulp. llvmpipe compiles to the CPU's own division, which IEEE 754 rounds correctly, and dividing
    // is cheaper there than a load; the wide mapping reads the table everywhere so that it is tested here too.
    mapping.exactDivision = !mapping.wide && driver == VK_DRIVER_ID_MESA_LLVMPIPE;
    // Narrow: one lane a patch; 32 lanes keep the count of workgroups low, each of which costs a fixed time on
    // lavapipe. Wide: four subgroups of 32, enough to hide latency with a few patches in shared memory.
    mapping.localSize = mapping.wide ? 128 : 32;
    return mapping;
}

} // namespace supple::gpu
