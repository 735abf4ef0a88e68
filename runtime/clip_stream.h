// Which segments of an asset's clips are on the device, if not all are: SuppleAssetDesc.clipPoolBytes,
// suppleRequestClip.
//
// The device's clip table ends with a pool. A segment is copied there over one or more frames, and the element of the
// table that says where it is changes in a later one. Until then the element leads to the clip's coarse twin. Segments
// move to the pool's beginning when what is free lies in pieces that are too small; they play meanwhile. What happens
// follows from requests and from which frames record the asset, so that a replay repeats it.
#pragma once

#include "base/result.h"
#include "gpu/device.h"
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
    uint64_t stamp = 0;            ///< higher than that of any request before, of any asset
};

class ClipStream {
public:
    /// `whole` has all segments. The pool has room for the largest of them, whatever `poolBytes` says, and for no more
    /// than all.
    ClipStream(std::shared_ptr<const skinning::ClipTable> whole, VkDeviceSize poolBytes);

    /// What the CPU poses by: it says the same of segments as the device's table will in the next recording. It stays
    /// where it is, and its words are a copy of those of `whole`.
    [[nodiscard]] const skinning::ClipTable& table() const { return shown_; }
    /// Rises whenever that changes.
    [[nodiscard]] uint64_t version() const { return version_; }
    /// The version() that came when a segment of the clip came or went last.
    [[nodiscard]] uint64_t versionOf(uint32_t clip) const;

    /// Until start(), requests are met at once.
    [[nodiscard]] bool isStarted() const { return started_; }
    /// What the device's table is to begin with. If that is version() no longer when it starts, it must be made anew.
    [[nodiscard]] std::vector<uint32_t> words() const;
    /// The device gets these words.
    void start();

    /// Refuses to pin more than the pool has.
    [[nodiscard]] Status request(const ClipRequest& request);
    struct Bytes {
        VkDeviceSize all = 0, there = 0;
    };
    /// What the segments of a clip take, and those of them that play; nothing of clips without a twin.
    [[nodiscard]] Bytes bytesOf(uint32_t clip) const;

    /// A frame begins: what has been copied plays from now on. `ready`: the device has the table. False: the frame has
    /// begun already, or plan() has nothing to do.
    [[nodiscard]] bool beginFrame(uint64_t frame, bool ready);
    /// The request that has waited longest, if beginFrame() was true.
    [[nodiscard]] uint64_t firstStamp() const { return segments_[waiting_.front()].stamp; }
    /// No frame has recorded the asset for a while: what is planned may wait for long.
    [[nodiscard]] bool isIdle() const { return idleFrames_ >= kIdle; }
    /// Decides what the frame copies, at most `left` bytes; returns them. `most`: what `left` can be in other frames.
    VkDeviceSize plan(VkDeviceSize most, VkDeviceSize left);

    /// Records what is due in the frame, once, into the device's table; bytes of segments, of those that come at most
    /// `most`. Transfers; the caller puts the barriers around it.
    VkDeviceSize record(const gpu::Device& device, VkCommandBuffer commandBuffer, VkBuffer table, uint64_t frame,
                        VkDeviceSize most);
    /// Whether that would record anything.
    [[nodiscard]] bool hasWork(uint64_t frame) const {
        return recordedFrame_ != frame && !(due_.empty() && (frame_ != frame || planned_.empty()));
    }
    void cancelFrame(uint64_t frame);

    /// Requests that bring about what is asked for, the earliest first; without stamps.
    [[nodiscard]] std::vector<ClipRequest> requests() const;
    /// Lets all segments go, and forgets all requests: in the frames to come another stream that has not begun yet does
    /// the same, if it gets the same requests.
    void restart();

private:
    struct Segment {
        uint64_t stamp = 0; ///< of the last request; 0: nobody wants it
        uint64_t place = kNowhere;
        VkDeviceSize sent = 0, planned = 0; ///< bytes: recorded; to record in this frame, or recorded in it
        bool pinned = false, there = false;
        bool due = false;   ///< its element is to be written
        bool moved = false; ///< with all its bytes
    };
    static constexpr uint64_t kNowhere = ~uint64_t{0};
    static constexpr VkDeviceSize kElement = 16;
    static constexpr uint32_t kIdle = 8;

    [[nodiscard]] uint32_t size(size_t s) const { return whole_->streamedSegments[s].size(); } ///< elements
    [[nodiscard]] VkDeviceSize bytes(size_t s) const { return size(s) * kElement; }
    [[nodiscard]] size_t find(uint32_t clip) const; ///< among those of the table, or kNone
    [[nodiscard]] size_t clipOf(uint32_t segment) const;
    /// Segments [first, end) of the request.
    struct Run {
        uint32_t first = 0, end = 0;
    };
    [[nodiscard]] static Run runOf(const skinning::StreamedClip& clip, const ClipRequest& request);
    void choose();
    void placeAll();
    [[nodiscard]] bool findPlace(uint32_t s, VkDeviceSize most, VkDeviceSize& left);
    [[nodiscard]] bool slide(VkDeviceSize most, VkDeviceSize& left);
    void setPlace(uint32_t s, uint64_t place);
    void setThere(uint32_t s, bool there);
    void setDue(uint32_t s);
    void letGo(uint32_t s);
    [[nodiscard]] std::array<uint32_t, 4> elementOf(uint32_t s) const; ///< of the device's table
    void settle();
    void copy(const gpu::Device& device, VkCommandBuffer commandBuffer, VkBuffer table, uint32_t s, VkDeviceSize first,
              VkDeviceSize end) const;

    std::shared_ptr<const skinning::ClipTable> whole_;
    skinning::ClipTable shown_;
    std::vector<uint32_t> twins_, frames_; ///< by segment: the first element of its twin; its frames
    std::vector<uint64_t> versions_;       ///< by streamed clip
    std::vector<Segment> segments_;
    uint64_t poolSize_ = 0, free_ = 0; ///< in elements
    std::vector<uint32_t> placed_;     ///< segments that have a place, by it

    // What choose() has decided:
    bool asked_ = false;              ///< it is to be asked again
    std::vector<uint32_t> waiting_;   ///< the pool has room for them; the earliest first
    std::vector<uint32_t> leaving_;   ///< they have a place, and go when room is needed; the first goes last
    std::vector<uint32_t> byRequest_; ///< memory of it

    std::vector<uint32_t> due_, planned_;   ///< segments: Segment::due; that the frame copies
    std::vector<uint32_t> written_, moved_; ///< whose elements recordedFrame_ has written; and all bytes
    uint64_t version_ = 1;
    uint64_t frame_ = 0, recordedFrame_ = 0;
    uint32_t idleFrames_ = kIdle; ///< that have begun since a frame recorded the asset
    bool started_ = false;
    bool restarted_ = false;       ///< no frame has recorded it since restart()
    bool restartedBefore_ = false; ///< the same, before recordedFrame_
};

} // namespace supple::runtime
