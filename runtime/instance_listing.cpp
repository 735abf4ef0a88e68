#include "runtime/instance_listing.h"

#include "runtime/culling/out_of_sight.h"
#include "shaders/shared/instances.h"

namespace supple::runtime {

InstanceListing::InstanceListing(InstanceWindows windows, const DrawnParts* parts)
    : windows_(std::move(windows)), parts_(parts), lives_(windows_.capacity, 0) {
    windows_.parts.resize(size_t{partCount()} * windows_.drawCount());
}

void InstanceListing::plan(gpu::BufferPlan& device, gpu::BufferPlan& staging, uint32_t framesInFlight) {
    const VkDeviceSize bytes = passBytes() + VkDeviceSize{partCount()} * windows_.capacity * sizeof(uint32_t);
    list_ = device.add({"supple instances", bytes,
                        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                            VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    staging_.plan(staging, "supple list staging", bytes, framesInFlight);
}

InstanceListing::Lists InstanceListing::next() {
    const std::span entries(reinterpret_cast<uint32_t*>(staging_.next()), list_.size() / sizeof(uint32_t));
    const uint32_t n = windows_.capacity;
    return {entries.first(n), entries.subspan(n, n), entries.subspan(windows_.firstPartEntry())};
}

bool InstanceListing::worksOn(const InstanceSlots& slots, uint32_t slot) const {
    return !leavesOutAll_ && slots.shows(slot) && (unseen_ == nullptr || !unseen_->holds(slot));
}

void InstanceListing::list(const InstanceSlots& slots, std::span<uint32_t> byWindow) {
    listedVersion_ = slots.version();
    settles_ = false;
    priorities_ = 0;
    windows_.visible = 0;
    for (uint32_t w = 0; w < windows_.count(); ++w) {
        const uint32_t first = windows_.firstSlot(w), last = std::min(first + windows_.size, slots.end());
        InstanceWindows::Listed listed;
        for (const bool past : {true, false}) {
            for (uint32_t s = first; s < last; ++s) {
                if (worksOn(slots, s) && hasPast(slots, s) == past) {
                    byWindow[first + listed.count++] = (s - first) |
                                                       slots.priority(s) << shared::kInstancePriorityShift |
                                                       (past ? 0 : shared::kInstanceIsNew);
                    priorities_ |= 1u << slots.priority(s);
                }
            }
            if (past) {
                listed.withPast = listed.count;
            }
        }
        windows_.listed[w] = listed;
        windows_.visible += listed.count;
        settles_ = settles_ || listed.withPast < listed.count;
    }
    for (uint32_t s = 0; s < slots.end(); ++s) {
        lives_[s] = worksOn(slots, s) ? slots.life(s) : 0;
    }
    windows_.allEntries = windows_.visible;
    windows_.partEntries = 0;
}

void InstanceListing::listDrawn(const InstanceSlots& slots, const Lists& lists) {
    const uint32_t parts = partCount();
    windows_.allEntries = 0;
    for (uint32_t w = 0; w < windows_.drawCount(); ++w) {
        const uint32_t first = windows_.firstDrawnSlot(w), last = std::min(first + windows_.drawSize, slots.end());
        uint32_t end = first;
        for (uint32_t s = first; s < last; ++s) {
            if (worksOn(slots, s)) {
                lists.all[end++] = s;
            }
        }
        windows_.allEntries = end > first ? end : windows_.allEntries;
        std::fill_n(windows_.parts.begin() + w * parts, parts, PartList{first, end - first});
    }
    if (parts == 0 || !slots.hiddenParts().any()) {
        return;
    }
    for (const uint32_t part : parts_->order()) {
        if (!slots.isHidden(part)) {
            continue;
        }
        for (uint32_t w = 0; w < windows_.drawCount(); ++w) {
            const uint32_t count = listPart(slots, part, w, lists.byPart.subspan(windows_.partEntries));
            windows_.parts[w * parts + part] = {windows_.firstPartEntry() + windows_.partEntries, count};
            windows_.partEntries += count;
        }
    }
}

void InstanceListing::listForCulling(const InstanceSlots& slots, std::span<uint32_t> all) const {
    uint32_t count = 0;
    for (uint32_t s = 0; s < slots.end(); ++s) {
        if (worksOn(slots, s)) {
            all[count++] = s | slots.priority(s) << shared::kInstancePriorityShift |
                           (hasPast(slots, s) ? 0 : shared::kInstanceIsNew) |
                           (slots.hiddenParts().hidesAny(s) ? shared::kInstanceHidesParts : 0);
        }
    }
}

uint32_t InstanceListing::listPart(const InstanceSlots& slots, uint32_t part, uint32_t window,
                                   std::span<uint32_t> out) const {
    const uint32_t first = windows_.firstDrawnSlot(window), last = std::min(first + windows_.drawSize, slots.end());
    uint32_t count = 0;
    for (uint32_t s = first; s < last; ++s) {
        if (worksOn(slots, s) && !slots.hiddenParts().hides(s, part)) {
            out[count++] = s;
        }
    }
    return count;
}

void InstanceListing::forgetAll() {
    settles_ = true;
    std::fill(lives_.begin(), lives_.end(), 0);
}

VkDeviceSize InstanceListing::recordCopies(const gpu::Device& device, VkCommandBuffer commandBuffer) const {
    VkDeviceSize bytes = 0;
    const auto copy = [&](VkDeviceSize first, VkDeviceSize count) {
        const VkDeviceSize at = first * sizeof(uint32_t);
        bytes += staging_.recordCopy(device, commandBuffer, at, list_.buffer(), at, count * sizeof(uint32_t));
    };
    copy(0, windows_.allEntries);
    windows_.forEach([&](uint32_t w) { copy(windows_.firstEntry(w), windows_.listed[w].count); });
    copy(windows_.firstPartEntry(), windows_.partEntries);
    return bytes;
}

} // namespace supple::runtime
