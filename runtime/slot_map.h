// Generation-checked handles: an id is (generation << 32 | index + 1), so that 0 is never valid and a stale id is
// caught. Generations begin at a number made of the map's address: ids of another map (another context's, or another
// kind of handle) do not fit.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace supple::runtime {

template <class T>
class SlotMap {
public:
    SlotMap() = default;
    SlotMap(const SlotMap&) = delete;
    SlotMap& operator=(const SlotMap&) = delete;

    uint64_t insert(std::shared_ptr<T> value) {
        uint32_t index = 0;
        if (free_.empty()) {
            index = static_cast<uint32_t>(slots_.size());
            // So that remove() needs no memory: what is destroyed must not be lost halfway.
            free_.reserve(slots_.capacity() > slots_.size() ? slots_.capacity() : 2 * slots_.size() + 8);
            slots_.push_back({nullptr, firstGeneration()});
        } else {
            index = free_.back();
            free_.pop_back();
        }
        slots_[index].value = std::move(value);
        return (static_cast<uint64_t>(slots_[index].generation) << 32) | (index + 1u);
    }
    /// Values there are room for without another slot.
    [[nodiscard]] size_t slotCount() const { return slots_.size(); }
    [[nodiscard]] bool empty() const { return free_.size() == slots_.size(); }
    /// Null for a stale or foreign id.
    [[nodiscard]] std::shared_ptr<T> find(uint64_t id) const noexcept {
        return isKnown(id) ? slots_[indexOf(id)].value : nullptr;
    }
    /// The same for who does not keep it.
    [[nodiscard]] T* at(uint64_t id) const noexcept { return isKnown(id) ? slots_[indexOf(id)].value.get() : nullptr; }
    std::shared_ptr<T> remove(uint64_t id) noexcept {
        if (at(id) == nullptr) {
            return nullptr;
        }
        const uint32_t index = indexOf(id);
        std::shared_ptr<T> value = std::move(slots_[index].value);
        ++slots_[index].generation;
        free_.push_back(index);
        return value;
    }
    /// Puts another value into the place of one that is there, which is returned.
    std::shared_ptr<T> replace(uint64_t id, std::shared_ptr<T> value) {
        std::swap(slots_[indexOf(id)].value, value);
        return value;
    }
    template <class F>
    void forEachId(F&& visit) const {
        for (size_t i = 0; i < slots_.size(); ++i) {
            if (slots_[i].value != nullptr) {
                visit((static_cast<uint64_t>(slots_[i].generation) << 32) | (i + 1u), *slots_[i].value);
            }
        }
    }
    template <class F>
    void forEach(F&& visit) const {
        for (const Slot& slot : slots_) {
            if (slot.value != nullptr) {
                visit(*slot.value);
            }
        }
    }

private:
    struct Slot {
        std::shared_ptr<T> value;
        uint32_t generation = 0;
    };
    /// Beyond all slots for 0.
    [[nodiscard]] static uint32_t indexOf(uint64_t id) { return static_cast<uint32_t>(id) - 1u; }
    [[nodiscard]] bool isKnown(uint64_t id) const noexcept {
        return indexOf(id) < slots_.size() && slots_[indexOf(id)].generation == id >> 32;
    }
    [[nodiscard]] uint32_t firstGeneration() const {
        const uint64_t hashed = (reinterpret_cast<uintptr_t>(this) >> 3) * 0x9E3779B97F4A7C15ull;
        return static_cast<uint32_t>(hashed >> 33) | 1u; // 31 bits: room to count up
    }

    std::vector<Slot> slots_;
    std::vector<uint32_t> free_;
};

} // namespace supple::runtime
