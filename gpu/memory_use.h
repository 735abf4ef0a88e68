// Device memory by purpose, and the ledger of all that a device has given: totals and the host's budget.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vulkan/vulkan_core.h>

namespace supple::gpu {

/// What memory is for. Staging, readback and spareVisible are host visible, all others are not.
enum class MemoryPurpose : uint32_t {
    tables,       ///< static data
    poses,        ///< palettes, morph weights, what instances play
    cages,        ///< deformed cages
    coefficients, ///< pools, patch coefficients
    vertices,     ///< surface vertices
    streams,      ///< what surface vertices have beside: previous positions, attributes
    lists,        ///< of instances and patches, with bounds, levels and indirect arguments
    scratch,      ///< what one pass leaves for the next
    staging,
    readback,
    spare,        ///< in blocks, and free for what comes
    spareVisible, ///< the same of what is mapped
    count
};
inline constexpr size_t kMemoryPurposes = static_cast<size_t>(MemoryPurpose::count);

struct MemoryUse {
    std::array<VkDeviceSize, kMemoryPurposes> bytes{};
    uint32_t allocations = 0;

    [[nodiscard]] VkDeviceSize& of(MemoryPurpose purpose) { return bytes[static_cast<size_t>(purpose)]; }
    [[nodiscard]] VkDeviceSize of(MemoryPurpose purpose) const { return bytes[static_cast<size_t>(purpose)]; }
    [[nodiscard]] VkDeviceSize total() const { return std::accumulate(bytes.begin(), bytes.end(), VkDeviceSize{0}); }
    [[nodiscard]] VkDeviceSize hostVisible() const {
        return of(MemoryPurpose::staging) + of(MemoryPurpose::readback) + of(MemoryPurpose::spareVisible);
    }
    MemoryUse& operator+=(const MemoryUse& other) {
        for (size_t i = 0; i < kMemoryPurposes; ++i) {
            bytes[i] += other.bytes[i];
        }
        allocations += other.allocations;
        return *this;
    }
    MemoryUse& operator-=(const MemoryUse& other) {
        for (size_t i = 0; i < kMemoryPurposes; ++i) {
            bytes[i] -= other.bytes[i];
        }
        allocations -= other.allocations;
        return *this;
    }
};

/// What is asked of the host when an allocation would exceed the budget.
struct MemoryRequest {
    const char* name = "";
    VkDeviceSize bytes = 0;
    bool hostVisible = false;
    VkDeviceSize used = 0, budget = 0;
};

/// Everything that is allocated and not yet freed, whoever holds it. One thread at a time.
struct MemoryLedger {
    MemoryUse use;
    VkDeviceSize budget = 0;                              ///< 0: none
    std::function<bool(const MemoryRequest&)> allowsMore; ///< empty: never
};

} // namespace supple::gpu
