// Hashes of what a frame has written: joint palettes, deformed cages, surface vertices. They come back to the host when
// the frame is complete.
#pragma once

#include "base/result.h"
#include "gpu/bound_sets.h"
#include "gpu/memory.h"
#include "gpu/pipelines.h"
#include "runtime/culling/culling.h"
#include "runtime/instance_windows.h"
#include "runtime/recording/format.h"
#include "runtime/view.h"
#include "shaders/shared/word_hash.h"

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace supple::runtime {

/// Which instances a hash is of.
enum class HashedBy : uint32_t {
    hostList, ///< those that the group works on: each has words at its slot
    rateList, ///< those that the view draws at a rate: the same
    records   ///< those that the view draws at levels: its records tell where their vertices are
};
/// A part of what is hashed: elements of elementWords, of which the first keptWords count.
struct HashedPart {
    VkBuffer words = VK_NULL_HANDLE; ///< null: there is nothing
    HashedBy by = HashedBy::hostList;
    uint32_t elementWords = 1, keptWords = 1;
    // Words of slots:
    uint32_t slotStride = 0;                  ///< words from one slot to the next
    uint32_t firstWord = 0, elementCount = 0; ///< of an instance
    uint32_t surface = 0, rate = 0;           ///< of the list of a rate
    // Records:
    const View* view = nullptr;
    uint32_t firstRun = 0, runCount = 0;
    uint32_t patchCount = 0; ///< of an instance
};

class HashKernels {
public:
    /// `pipelines` must outlive the pass.
    [[nodiscard]] static Result<HashKernels> create(const gpu::Device& device, gpu::Pipelines& pipelines);
    /// Makes the pipelines if they are not there.
    [[nodiscard]] Status prepare();
    [[nodiscard]] const gpu::ComputeLayout& layout() const { return layout_; }
    [[nodiscard]] const gpu::Kernel& slots() const { return slots_; }
    [[nodiscard]] const gpu::Kernel& records() const { return records_; }

private:
    gpu::Pipelines* pipelines_ = nullptr;
    gpu::ComputeLayout layout_;
    gpu::Kernel slots_, records_;
};

/// The hashes of a context. Recording allocates nothing.
class StageHashes {
public:
    /// In a frame. What it has beyond these is not hashed.
    static constexpr uint32_t kMost = 8192;

    [[nodiscard]] static Result<std::shared_ptr<StageHashes>>
    create(const gpu::Device& device, const HashKernels& kernels, uint32_t framesInFlight);
    [[nodiscard]] const gpu::ComputeLayout& layout() const { return kernels_->layout(); }
    [[nodiscard]] VkBuffer sums() const { return local_.buffer(0); }

    /// Tells of every frame that is complete, in their order.
    void takeCompleted(uint64_t completedFrame, const std::function<void(const FrameHashes&)>& tell);
    void cancelFrame(uint64_t frame);
    /// What was recorded until now, nobody is told.
    void forget();

    /// What one suppleRecord hashes.
    class Recording {
    public:
        /// At most `count` hashes. Waits for all passes before.
        Recording(StageHashes& hashes, VkCommandBuffer commandBuffer, uint64_t frame, uint32_t count);
        /// Begins another hash. False: there is no room for it.
        [[nodiscard]] bool next(const StageHash& which);
        /// What a window adds to it, or a part.
        void add(VkDescriptorSet set, shared::SlotHashPush push);
        void add(VkDescriptorSet set, shared::RecordHashPush push);
        /// Copies all to where the host reads it.
        void end();

    private:
        [[nodiscard]] uint32_t target() const { return static_cast<uint32_t>(place_ * kMost) + first_ + taken_ - 1; }
        StageHashes* hashes_;
        VkCommandBuffer commandBuffer_;
        size_t place_;               ///< of the frame among those in flight
        uint32_t first_ = 0;         ///< hash of the frame
        uint32_t taken_ = 0, count_; ///< of this recording
    };

private:
    struct Frame {
        uint64_t number = 0; ///< 0: none
        std::vector<StageHash> hashes;
    };
    [[nodiscard]] VkDeviceSize offsetOf(size_t place, uint32_t hash) const {
        return (place * kMost + hash) * sizeof(StageHash::sums);
    }

    const gpu::Device* device_ = nullptr;
    const HashKernels* kernels_ = nullptr;
    gpu::BufferSet local_, readback_;
    std::mutex mutex_; ///< of frames_: several threads may record
    std::vector<Frame> frames_;
};

/// What a group hashes, with the descriptor sets for it.
class HashedParts {
public:
    /// All but the hashes must outlive it. `culling`: null unless the group belongs to a view.
    HashedParts(const gpu::Device& device, std::shared_ptr<const StageHashes> hashes, const InstanceWindows& windows,
                const Culling* culling)
        : device_(&device), hashes_(std::move(hashes)), windows_(&windows), culling_(culling) {}
    /// `list`: all instances that the group works on, by slot.
    [[nodiscard]] Status create(std::span<const HashedPart> parts, VkBuffer list);
    /// `number`: of the part in create(). `part`: what it is now.
    void record(StageHashes::Recording& recording, size_t number, const HashedPart& part) const;

private:
    [[nodiscard]] size_t placeOf(size_t number, uint32_t window) const { return number * windows_->count() + window; }
    void write(size_t place, const HashedPart& part, uint32_t window, VkBuffer list);

    const gpu::Device* device_;
    std::shared_ptr<const StageHashes> hashes_;
    const InstanceWindows* windows_;
    const Culling* culling_;
    gpu::BoundSets sets_; ///< by part and window
};

} // namespace supple::runtime
