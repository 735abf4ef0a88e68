#include "tools/supple/memory_report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

namespace supple::tools {
namespace {

struct Purpose {
    const char* name;
    VkDeviceSize SuppleMemoryUse::*bytes;
};
constexpr Purpose kOnDevice[] = {
    {"tables", &SuppleMemoryUse::tables},     {"poses", &SuppleMemoryUse::poses},
    {"cages", &SuppleMemoryUse::cages},       {"coefficients", &SuppleMemoryUse::coefficients},
    {"vertices", &SuppleMemoryUse::vertices}, {"streams", &SuppleMemoryUse::streams},
    {"lists", &SuppleMemoryUse::lists},       {"scratch", &SuppleMemoryUse::scratch},
    {"spare", &SuppleMemoryUse::spare}};
constexpr Purpose kMapped[] = {{"staging", &SuppleMemoryUse::staging},
                               {"readback", &SuppleMemoryUse::readback},
                               {"spareVisible", &SuppleMemoryUse::spareVisible}};

std::string mebibytes(VkDeviceSize bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", bytes < (VkDeviceSize{1} << 20) ? 3 : 1,
                  static_cast<double>(bytes) / (1024.0 * 1024.0));
    return text;
}

/// " (vertices 8.0, tables 0.123)"
std::string listed(const SuppleMemoryUse& use, std::span<const Purpose> purposes) {
    std::vector<Purpose> sorted(purposes.begin(), purposes.end());
    std::ranges::stable_sort(sorted, [&](const Purpose& a, const Purpose& b) { return use.*a.bytes > use.*b.bytes; });
    std::string text;
    for (const Purpose& purpose : sorted) {
        if (use.*purpose.bytes > 0) {
            text += (text.empty() ? " (" : ", ") + (purpose.name + (" " + mebibytes(use.*purpose.bytes)));
        }
    }
    return text.empty() ? text : text + ")";
}

} // namespace

std::string memoryText(const SuppleMemoryUse& use) {
    return mebibytes(use.deviceLocal) + " MiB on the device" + listed(use, kOnDevice) + ", " +
           mebibytes(use.hostVisible) + " MiB mapped" + listed(use, kMapped) + ", in " +
           std::to_string(use.allocationCount) + (use.allocationCount == 1 ? " allocation" : " allocations");
}

std::string heldText(const SuppleMemoryUse& use) {
    return mebibytes(use.deviceLocal) + " MiB" + listed(use, kOnDevice) +
           (use.givenBack > 0 ? ", " + mebibytes(use.givenBack) + " of it goes back" : "");
}

std::vector<MemoryPurpose> memoryPurposes(const SuppleMemoryUse& use) {
    std::vector<MemoryPurpose> purposes;
    for (const Purpose& purpose : kOnDevice) {
        purposes.push_back({purpose.name, use.*purpose.bytes});
    }
    for (const Purpose& purpose : kMapped) {
        purposes.push_back({purpose.name, use.*purpose.bytes});
    }
    return purposes;
}

nlohmann::ordered_json memoryJson(const SuppleMemoryUse& use) {
    nlohmann::ordered_json json = {{"deviceLocalBytes", use.deviceLocal},
                                   {"hostVisibleBytes", use.hostVisible},
                                   {"allocations", use.allocationCount}};
    for (const MemoryPurpose& purpose : memoryPurposes(use)) {
        json[std::string(purpose.name) + "Bytes"] = purpose.bytes;
    }
    return json;
}

} // namespace supple::tools
