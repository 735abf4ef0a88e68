// Which instances the passes behind `deform` work on: all that the host shows, or those that a view sees.
#pragma once

#include "runtime/instance_listing.h"
#include "runtime/pass_cost.h"
#include "runtime/transfers.h"
#include "supple/supple.h"
#include "surface/program.h"

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

    /// Lists this frame's instances.
    virtual void list(const InstanceSlots& slots, InstanceListing& listing) = 0;
    /// What it uploads itself when the list has changed; returns the bytes.
    virtual VkDeviceSize recordUpload(VkCommandBuffer commandBuffer) = 0;

    [[nodiscard]] virtual InstanceList list() const = 0;
    /// The instances of a window, for the passes of the group's n-th surface. The sets are the caller's.
    [[nodiscard]] virtual surface::Window window(uint32_t window, size_t surface) const = 0;
    /// The same of those that have coefficients constructed: other groups may draw some of them.
    [[nodiscard]] virtual surface::Window constructed(uint32_t window, size_t surface) const {
        return this->window(window, surface);
    }
    /// Where instances of the surface have their coefficients.
    virtual void tellPool(shared::WindowPush& push, size_t surface) const = 0;
    /// The cost of a pass, given what it writes per instance.
    [[nodiscard]] virtual PassCost cost(uint64_t points, uint64_t bytes) const = 0;

    virtual void addTransfers(Transfers& transfers) const = 0;
};

/// All instances that the host shows.
class ListedByHost final : public Visibility {
public:
    /// `listing` must outlive this.
    explicit ListedByHost(const InstanceListing& listing) : listing_(&listing) {}

    void list(const InstanceSlots& slots, InstanceListing& listing) override {
        const InstanceListing::Lists lists = listing.next();
        listing.list(slots, lists.byWindow);
        listing.listDrawn(slots, lists);
    }
    VkDeviceSize recordUpload(VkCommandBuffer) override { return 0; }
    [[nodiscard]] InstanceList list() const override {
        return {listing_->buffer().buffer(), listing_->passBytes(), listing_->drawnEntries()};
    }
    [[nodiscard]] surface::Window window(uint32_t window, size_t) const override {
        const InstanceWindows& windows = listing_->windows();
        surface::Window result;
        result.push.firstInstance = windows.firstEntry(window);
        result.push.instanceCount = windows.listed[window].count;
        result.push.slots = windows.slots(window);
        result.push.firstSlot = windows.firstSlot(window);
        return result;
    }
    void tellPool(shared::WindowPush&, size_t) const override {} // by slot
    [[nodiscard]] PassCost cost(uint64_t points, uint64_t bytes) const override {
        const uint32_t visible = listing_->windows().visible;
        return {points * visible, bytes * visible};
    }
    void addTransfers(Transfers&) const override {}

private:
    const InstanceListing* listing_;
};

} // namespace supple::runtime
