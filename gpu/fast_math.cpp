#include "gpu/fast_math.h"

#include <algorithm>
#include <cstring>

namespace supple::gpu {
namespace {

constexpr size_t kHeaderWords = 5;
constexpr uint32_t kOpExtension = 10, kOpEntryPoint = 15, kOpExecutionMode = 16, kOpCapability = 17;
constexpr uint32_t kSignedZeroInfNanPreserveCapability = 4466, kSignedZeroInfNanPreserveMode = 4461;

constexpr uint32_t instruction(uint32_t words, uint32_t op) {
    return words << 16 | op;
}

/// The OpExtension that names float controls. From 1.4 on SPIR-V has them without it.
std::vector<uint32_t> floatControls() {
    constexpr char kName[] = "SPV_KHR_float_controls";
    std::vector<uint32_t> words(1 + (sizeof(kName) + 3) / 4);
    words[0] = instruction(static_cast<uint32_t>(words.size()), kOpExtension);
    std::memcpy(words.data() + 1, kName, sizeof(kName));
    return words;
}

} // namespace

bool hasFastMath(const Functions& vk, VkPhysicalDevice physicalDevice) {
    VkPhysicalDeviceFloatControlsProperties floats{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES};
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    driver.pNext = &floats;
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    properties.pNext = &driver;
    vk.GetPhysicalDeviceProperties2(physicalDevice, &properties);
    return driver.driverID == VK_DRIVER_ID_MOLTENVK && floats.shaderSignedZeroInfNanPreserveFloat32 == VK_TRUE;
}

std::vector<uint32_t> withoutFastMath(std::span<const uint32_t> spirv) {
    std::vector<uint32_t> words(spirv.begin(), spirv.begin() + kHeaderWords);
    words.insert(words.end(), {instruction(2, kOpCapability), kSignedZeroInfNanPreserveCapability});
    const std::vector<uint32_t> extension = floatControls();
    bool extended = false;
    for (size_t at = kHeaderWords; at < spirv.size();) {
        const uint32_t length = std::max(spirv[at] >> 16, 1u), op = spirv[at] & 0xFFFFu;
        const size_t end = std::min<size_t>(at + length, spirv.size());
        if (op != kOpCapability && !extended) { // extensions come right behind the capabilities
            words.insert(words.end(), extension.begin(), extension.end());
            extended = true;
        }
        words.insert(words.end(), spirv.begin() + static_cast<ptrdiff_t>(at),
                     spirv.begin() + static_cast<ptrdiff_t>(end));
        if (op == kOpEntryPoint && length > 2) { // (execution model, function, ..); execution modes come right behind
            words.insert(words.end(),
                         {instruction(4, kOpExecutionMode), spirv[at + 2], kSignedZeroInfNanPreserveMode, 32u});
        }
        at = end;
    }
    return words;
}

} // namespace supple::gpu
