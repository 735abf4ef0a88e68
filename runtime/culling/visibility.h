// Which instances the passes behind `deform` work on: all that the host shows, or those that a view sees.
#pragma once

#include "runtime/instance_windows.h"
#include "runtime/pass_cost.h"
#include "runtime/transfers.h"
#include "supple/supple.h"
#include "surface/program.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace supple::runtime {

/// The list of instances that surface passes bind.
struct InstanceList {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize bytes = 0;    ///< that surface passes read
    uint32_t drawnEntries = 0; ///< from the beginning on, that draws read

    /// What draws read.
    [[nodiscard]] SuppleBufferRange slots() const {
        return {buffer, 0, VkDeviceSize{drawnEntries} * sizeof(uint32_t), sizeof(uint32_t)};
    }
};

class Visibility {
public:
    Visibility() = default;
    virtual ~Visibility() = default;
    Visibility(const Visibility&) = delete;
    Visibility& operator=(const Visibility&) = delete;

    /// Where a frame's instances are listed. `all` and `byWindow` have room for all instances, `byPart` for all
    /// instances of each part of `windows`.
    struct Lists {
        std::span<uint32_t> all, byWindow, byPart;
    };
    /// Lists this frame's instances, for the device and in `windows`.
    virtual void list(InstanceSlots& slots, const Lists& lists, InstanceWindows& windows) = 0;
    /// What it uploads itself when the list has changed; returns the bytes.
    virtual VkDeviceSize recordUpload(VkCommandBuffer commandBuffer) = 0;

    [[nodiscard]] virtual InstanceList list() const = 0;
    /// The instances of a window, for the passes of the group's n-th surface. The sets are the caller's.
    [[nodiscard]] virtual surface::Window window(uint32_t window, size_t surface) const = 0;
    /// The cost of a pass, given what it writes per instance.
    [[nodiscard]] virtual PassCost cost(uint64_t points, uint64_t bytes) const = 0;

    virtual void addTransfers(Transfers& transfers) const = 0;
};

/// All instances that the host shows.
class ListedByHost final : public Visibility {
public:
    /// Both must outlive this. `list`: the list of instances on the device (runtime/instance_windows.h).
    ListedByHost(const InstanceWindows& windows, InstanceList list) : windows_(&windows), list_(list) {}

    void list(InstanceSlots& slots, const Lists& lists, InstanceWindows& windows) override {
        windows.visible = slots.list(lists.all, lists.byWindow, windows.size, windows.listed);
        windows.partEntries = 0;
        std::fill(windows.parts.begin(), windows.parts.end(), PartList{0, windows.visible});
        if (windows.parts.empty() || !slots.hiddenParts().any()) {
            return;
        }
        for (const uint32_t part : slots.hiddenParts().order()) {
            if (slots.isHidden(part)) {
                const uint32_t count = slots.listPart(part, lists.byPart.subspan(windows.partEntries));
                windows.parts[part] = {windows.firstPartEntry() + windows.partEntries, count};
                windows.partEntries += count;
            }
        }
    }
    VkDeviceSize recordUpload(VkCommandBuffer) override { return 0; }
    [[nodiscard]] InstanceList list() const override { return list_; }
    [[nodiscard]] surface::Window window(uint32_t window, size_t) const override {
        surface::Window result;
        result.push.firstInstance = windows_->firstEntry(window);
        result.push.instanceCount = windows_->listed[window].count;
        result.push.firstSlot = windows_->firstSlot(window);
        return result;
    }
    [[nodiscard]] PassCost cost(uint64_t points, uint64_t bytes) const override {
        return {points * windows_->visible, bytes * windows_->visible};
    }
    void addTransfers(Transfers&) const override {}

private:
    const InstanceWindows* windows_;
    InstanceList list_;
};

} // namespace supple::runtime
