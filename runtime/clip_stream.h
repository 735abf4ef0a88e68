// Which segments of an asset's clips are on the device, if not all are: SuppleAssetDesc.clipPoolBytes,
// suppleRequestClip.
//
// The device's clip table ends with a pool. A segment is copied there over one or more frames, and the element of the
// table that says where it is changes in a later one. Until then the element leads to the clip's coarse twin. What
// happens follows from requests and from which frames record the asset, so that a replay repeats it.
#pragma once

#include "base/result.h"
#include "gpu/device.h"
#include "gpu/free_ranges.h"
#include "skinning/clip_table.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace supple::runtime {

/// What a host says of a stretch of a clip.
struct ClipRequest {
    enum class Use : uint32_t { wanted, pinned, released };
    uint32_t clip = 0;
    Use use = Use::wanted;
    double begin = 0.0, end = 0.0; ///< in parts of the clip's duration, 0..1
};

class ClipStream {
public:
    /// `whole` has all segments. The pool has room for the largest of them, whatever `poolBytes` says, and for no more
    /// than all.
    ClipStream(std::shared_ptr<const skinning::ClipTable> whole, VkDeviceSize poolBytes);

    /// What the CPU poses by: it says the same of segments as the device's table will in the next recording. It stays
    /// where it is.
    [[nodiscard]] const skinning::ClipTable& table() const { return shown_; }
    /// Rises whenever that changes.
    [[nodiscard]] uint64_t version() const { return version_; }
    /// What the device's table is to begin with. Until then a request is met at once.
    [[nodiscard]] std::vector<uint32_t> start();

    /// Refuses to pin more than the pool has.
    [[nodiscard]] Status request(const ClipRequest& request);
    struct Bytes {
        VkDeviceSize all = 0, there = 0;
    };
    /// What the segments of a clip take, and those of them that play; nothing of clips without a twin.
    [[nodiscard]] Bytes bytesOf(uint32_t clip) const;

    /// A frame begins: what has been copied plays from now on. Decides what the frame copies, at most `most` bytes;
    /// returns them. `ready`: the device has the table.
    VkDeviceSize beginFrame(uint64_t frame, VkDeviceSize most, bool ready);
    /// Records what is due in the frame, once, into the device's table; bytes of segments. Transfers; the caller puts
    /// the barriers around it.
    VkDeviceSize record(const gpu::Device& device, VkCommandBuffer commandBuffer, VkBuffer table, uint64_t frame);
    /// Whether that would record anything.
    [[nodiscard]] bool hasWork(uint64_t frame) const {
        return ready_ && recordedFrame_ != frame && !(due_.empty() && planned_.empty());
    }
    void cancelFrame(uint64_t frame);

    /// Makes the requests that were made of another version of the asset. `clips`: by its numbers, the own or kNone.
    void takeOver(const ClipStream& other, std::span<const uint32_t> clips);
    /// Lets all segments go, and asks for them again by the requests that it returns: another stream that gets these
    /// does the same in the frames to come.
    [[nodiscard]] std::vector<ClipRequest> restart();

private:
    struct Segment {
        uint64_t stamp = 0; ///< of the last request; 0: nobody wants it
        uint64_t place = kNowhere;
        VkDeviceSize sent = 0, planned = 0; ///< bytes: recorded; to record in this frame
        bool pinned = false, there = false, due = false;
    };
    static constexpr uint64_t kNowhere = ~uint64_t{0};
    static constexpr VkDeviceSize kElement = 16;
    /// From so many idle frames on, copies would keep bytes from others for nobody.
    static constexpr uint32_t kIdle = 8;

    [[nodiscard]] VkDeviceSize bytes(size_t s) const { return whole_->streamedSegments[s].size() * kElement; }
    [[nodiscard]] const skinning::StreamedClip* find(uint32_t clip) const;
    /// Segments [first, end) of the request.
    struct Run {
        uint32_t first = 0, end = 0;
    };
    [[nodiscard]] static Run runOf(const skinning::StreamedClip& clip, const ClipRequest& request);
    [[nodiscard]] std::vector<uint32_t> inOrder() const; ///< those that are wanted, by their requests
    [[nodiscard]] std::vector<ClipRequest> requests() const;
    [[nodiscard]] bool makeRoom(size_t s);
    void setThere(size_t s, bool there);
    void letGo(size_t s);
    [[nodiscard]] std::array<uint32_t, 4> elementOf(size_t s) const; ///< of the device's table
    void settle();
    void meet(); ///< wanted segments get places
    void copy(const gpu::Device& device, VkCommandBuffer commandBuffer, VkBuffer table, size_t s);

    std::shared_ptr<const skinning::ClipTable> whole_;
    skinning::ClipTable shown_;
    std::vector<uint32_t> twins_, frames_; ///< by segment: the first element of its twin; its frames
    gpu::FreeRanges pool_;                 ///< in elements
    std::vector<Segment> segments_;
    std::vector<uint32_t> due_, written_; ///< segments whose element is to be written; that the last frame has written
    std::vector<uint32_t> planned_;       ///< segments that the frame copies
    uint64_t stamp_ = 0, version_ = 1;
    uint64_t frame_ = 0, recordedFrame_ = 0;
    uint32_t idleFrames_ = kIdle; ///< that have begun since a frame recorded the asset
    bool started_ = false;
    bool ready_ = false; ///< when the frame began, the device had the table
};

} // namespace supple::runtime
