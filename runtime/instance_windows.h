// Windows of instances: runs of slots that one descriptor can reach, and which entries of the instance list each has.
#pragma once

#include "runtime/instance_slots.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace supple::runtime {

/// A device bounds storage buffers (at 128 MiB, say). A group too large for that has several windows, and every pass
/// has a dispatch per window. The list of instances (shaders/shared/instances.h) has `capacity` entries for all
/// instances, then as many by window, then as many for every part that instances may hide.
struct InstanceWindows {
    uint32_t capacity = 0;
    uint32_t size = 0;                         ///< slots of a window; the last may have fewer
    std::vector<InstanceSlots::Listed> listed; ///< by window, of the frame that is recorded
    uint32_t visible = 0;                      ///< instances in all of them
    std::vector<PartList> parts;               ///< by part: what draws of it read. None if the device lists parts
    uint32_t partEntries = 0;                  ///< of the lists of parts, together

    [[nodiscard]] uint32_t count() const { return static_cast<uint32_t>(listed.size()); }
    [[nodiscard]] uint32_t firstSlot(uint32_t window) const { return window * size; }
    [[nodiscard]] uint32_t slots(uint32_t window) const { return std::min(size, capacity - firstSlot(window)); }
    /// Its first entry in the list.
    [[nodiscard]] uint32_t firstEntry(uint32_t window) const { return capacity + firstSlot(window); }
    /// The first entry of the first part's list.
    [[nodiscard]] uint32_t firstPartEntry() const { return 2 * capacity; }

    /// Calls record(window) for each window that has instances in this frame.
    template <class F>
    void forEach(F&& record) const {
        for (uint32_t w = 0; w < count(); ++w) {
            if (listed[w].count > 0) {
                record(w);
            }
        }
    }
};

} // namespace supple::runtime
