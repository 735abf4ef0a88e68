#include "gpu/mapping.h"

#include "shaders/shared/specialization.h"

namespace supple::gpu {

Mapping chooseMapping(VkPhysicalDeviceType type, VkDriverId driver, uint32_t texels, MappingChoice choice) {
    // Vulkan promises 65,536 texels, which SwiftShader has: a single character may have more. lavapipe has 128 million.
    constexpr uint32_t kEnoughTexels = 1u << 20;
    const bool prefersNarrow = type == VK_PHYSICAL_DEVICE_TYPE_CPU && texels >= kEnoughTexels;
    Mapping mapping;
    mapping.wide = choice == MappingChoice::wide || (choice == MappingChoice::automatic && !prefersNarrow);
    mapping.lacksTexels = choice == MappingChoice::automatic && type == VK_PHYSICAL_DEVICE_TYPE_CPU && mapping.wide;
    // Vulkan allows 2.5 ulp. llvmpipe compiles to the CPU's own division, which IEEE 754 rounds correctly, and dividing
    // is cheaper there than a load; the wide mapping reads the table everywhere so that it is tested here too.
    mapping.exactDivision = !mapping.wide && driver == VK_DRIVER_ID_MESA_LLVMPIPE;
    // Narrow: one lane a patch; 32 lanes keep the count of workgroups low, each of which costs a fixed time on
    // lavapipe. Wide: four subgroups of 32, enough to hide latency with a few patches in shared memory.
    mapping.localSize = mapping.wide ? shared::kMaxLanes : 32;
    // A wide GPU of today has some 140 multiprocessors; nine subgroups of 32 on each hide latency by what every lane
    // does by itself. No driver tells this number.
    mapping.lanesToFill = type == VK_PHYSICAL_DEVICE_TYPE_CPU ? 64 : 40'000;
    // lavapipe has its rasterizer write timestamps once anything has been drawn, whenever the next barrier makes it
    // run: a pass without a barrier behind it would end with the next one. And its vkGetQueryPoolResults waits for the
    // device to be idle. There a barrier and a copy cost next to nothing, because commands run one after another
    // anyway. A GPU loses by both: the barrier lets it run empty, and a copy that waits for timestamps stalls whatever
    // reads its commands. It needs neither, because its timestamps are in order and reading them never waits.
    mapping.lazyTimestamps = type == VK_PHYSICAL_DEVICE_TYPE_CPU;
    return mapping;
}

} // namespace supple::gpu
