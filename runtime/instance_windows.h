// Windows of instances: runs of slots that one descriptor can reach, and which entries of the instance list each has.
#pragma once

#include "base/result.h"
#include "gpu/device.h"
#include "runtime/hidden_parts.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace supple::runtime {

/// What the passes bind of an instance; it decides how many instances fit a window.
struct BoundBytes {
    VkDeviceSize texels = 0;  ///< of the largest buffer that is read as texels
    VkDeviceSize storage = 0; ///< of the largest buffer that is only written

    /// What holds both.
    [[nodiscard]] BoundBytes with(BoundBytes other) const {
        return {std::max(texels, other.texels), std::max(storage, other.storage)};
    }
};

/// A device bounds storage buffers (at 128 MiB, say). A group too large for that has several windows, and every pass
/// has a dispatch per window. The list of instances (shaders/shared/instances.h) has `capacity` entries for draws, then
/// as many by window, then as many for every part that instances may hide.
///
/// A host that draws by windows (SUPPLE_GROUP_WINDOWS) has the same windows. For other hosts one window holds all
/// slots.
struct InstanceWindows {
    /// A window of slots in a frame: first those that were evaluated in the frame before, then the new ones.
    struct Listed {
        uint32_t count = 0;
        uint32_t withPast = 0;
    };
    uint32_t capacity = 0;
    uint32_t size = 0;           ///< slots of a window; the last may have fewer
    uint32_t drawSize = 0;       ///< the same of the windows that draws have
    std::vector<Listed> listed;  ///< by window, of the frame that is recorded
    uint32_t visible = 0;        ///< instances in all of them
    uint32_t allEntries = 0;     ///< of the entries for draws, those before this one are in use
    std::vector<PartList> parts; ///< by draw window and part: what draws of it read. None if the device lists parts
    uint32_t partEntries = 0;    ///< of the lists of parts, together

    /// As many slots a window as the device can bind of every buffer. An error if not even one fits.
    [[nodiscard]] static Result<InstanceWindows> layOut(const gpu::Device& device, uint32_t capacity, BoundBytes bound);

    [[nodiscard]] uint32_t count() const { return static_cast<uint32_t>(listed.size()); }
    [[nodiscard]] uint32_t firstSlot(uint32_t window) const { return window * size; }
    [[nodiscard]] uint32_t slots(uint32_t window) const { return std::min(size, capacity - firstSlot(window)); }
    /// Its first entry in the list.
    [[nodiscard]] uint32_t firstEntry(uint32_t window) const { return capacity + firstSlot(window); }
    /// The first entry of the first part's list.
    [[nodiscard]] uint32_t firstPartEntry() const { return 2 * capacity; }

    [[nodiscard]] uint32_t drawCount() const { return (capacity + drawSize - 1) / drawSize; }
    /// The first slot of a window that draws have. Its visible slots begin in the list at the same number.
    [[nodiscard]] uint32_t firstDrawnSlot(uint32_t window) const { return window * drawSize; }

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
