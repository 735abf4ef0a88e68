// What takes device memory, by purpose, as a line and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <supple/supple.h>
#include <vector>

namespace supple::tools {

/// "12.3 MiB on the device (vertices 8.0, ..), 0.5 MiB mapped (staging 0.5), in 9 allocations"; the largest come first.
[[nodiscard]] std::string memoryText(const SuppleMemoryUse& use);
/// The same of what is on the device, and what of it goes back: "12.3 MiB (vertices 8.0, ..), 8.1 of it goes back".
[[nodiscard]] std::string heldText(const SuppleMemoryUse& use);
struct MemoryPurpose {
    const char* name;
    VkDeviceSize bytes = 0;
};
/// All purposes, also those of none.
[[nodiscard]] std::vector<MemoryPurpose> memoryPurposes(const SuppleMemoryUse& use);
/// In bytes, purposes of none included.
[[nodiscard]] nlohmann::ordered_json memoryJson(const SuppleMemoryUse& use);

} // namespace supple::tools
