// What takes device memory, by purpose, as a line and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <supple/supple.h>
#include <vector>

namespace supple::tools {

/// "12.3 MiB on the device (vertices 8.0, ..), 0.5 MiB mapped (staging 0.5), in 9 allocations"; the largest come first.
[[nodiscard]] std::string memoryText(const SuppleMemoryUse& use);
struct MemoryPurpose {
    const char* name;
    VkDeviceSize bytes = 0;
};
/// All purposes, also those of none.
[[nodiscard]] std::vector<MemoryPurpose> memoryPurposes(const SuppleMemoryUse& use);
/// In bytes, purposes of none included.
[[nodiscard]] nlohmann::ordered_json memoryJson(const SuppleMemoryUse& use);

} // namespace supple::tools
