#include "runtime/clip_stream.h"

#include "shaders/shared/pose.h"
#include "skinning/packed_clip.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

namespace supple::runtime {

namespace {

constexpr VkDeviceSize kUpdateBytes = 65536; // that vkCmdUpdateBuffer takes

/// Elements of the pool.
uint64_t poolSize(const skinning::ClipTable& table, VkDeviceSize bytes) {
    uint64_t largest = 0, all = 0;
    for (const skinning::StreamedSegment& segment : table.streamedSegments) {
        largest = std::max<uint64_t>(largest, segment.size());
        all += segment.size();
    }
    return std::clamp<uint64_t>(bytes / 16, largest, all);
}

} // namespace

ClipStream::ClipStream(std::shared_ptr<const skinning::ClipTable> whole, VkDeviceSize poolBytes)
    : whole_(std::move(whole)), shown_(*whole_), pool_(poolSize(*whole_, poolBytes)),
      segments_(whole_->streamedSegments.size()) {
    for (const skinning::StreamedClip& clip : whole_->streamedClips) {
        for (uint32_t s = 0; s < clip.segmentCount; ++s) {
            twins_.push_back(clip.twin);
            frames_.push_back(whole_->words[4 * size_t{whole_->streamedSegments[clip.firstSegment + s].element} + 2]);
        }
    }
    for (std::vector<uint32_t>* const list : {&due_, &written_, &planned_}) {
        list->reserve(segments_.size());
    }
    for (size_t s = 0; s < segments_.size(); ++s) {
        setThere(s, false);
    }
}

const skinning::StreamedClip* ClipStream::find(uint32_t clip) const {
    const auto found = std::find_if(whole_->streamedClips.begin(), whole_->streamedClips.end(),
                                    [&](const skinning::StreamedClip& own) { return own.clip == clip; });
    return found != whole_->streamedClips.end() ? &*found : nullptr;
}

ClipStream::Run ClipStream::runOf(const skinning::StreamedClip& clip, const ClipRequest& request) {
    const auto segmentAt = [&](double part) {
        const auto frame = static_cast<uint32_t>(std::clamp(part, 0.0, 1.0) * clip.frames);
        return clip.firstSegment + std::min(frame / shared::kSegmentFrames, clip.segmentCount - 1);
    };
    return {segmentAt(request.begin), segmentAt(request.end) + 1};
}

Status ClipStream::request(const ClipRequest& request) {
    const skinning::StreamedClip* const clip = find(request.clip);
    if (clip == nullptr) { // all of it is always there
        return success();
    }
    const Run run = runOf(*clip, request);
    if (request.use == ClipRequest::Use::pinned) {
        VkDeviceSize pinned = 0;
        for (uint32_t s = 0; s < segments_.size(); ++s) {
            pinned += segments_[s].pinned || (s >= run.first && s < run.end) ? bytes(s) : 0;
        }
        if (pinned > pool_.size() * kElement) {
            return Error{ErrorCode::limit, "what is pinned would take " + std::to_string(pinned) +
                                               " bytes, and the pool has " + std::to_string(pool_.size() * kElement)};
        }
    }
    const bool wanted = request.use != ClipRequest::Use::released;
    ++stamp_;
    for (uint32_t s = run.first; s < run.end; ++s) {
        segments_[s].stamp = wanted ? stamp_ : 0;
        segments_[s].pinned = request.use == ClipRequest::Use::pinned;
        if (!wanted && !segments_[s].there) { // it goes when room is needed; what is on its way is of no use
            letGo(s);
        }
    }
    if (!started_) {
        meet();
    }
    return success();
}

ClipStream::Bytes ClipStream::bytesOf(uint32_t clip) const {
    Bytes sum;
    const skinning::StreamedClip* const own = find(clip);
    for (uint32_t s = 0; own != nullptr && s < own->segmentCount; ++s) {
        sum.all += bytes(own->firstSegment + s);
        sum.there += segments_[own->firstSegment + s].there ? bytes(own->firstSegment + s) : 0;
    }
    return sum;
}

std::array<uint32_t, 4> ClipStream::elementOf(size_t s) const {
    if (!segments_[s].there) {
        return {0u, 0u, frames_[s], twins_[s]};
    }
    const skinning::StreamedSegment& segment = whole_->streamedSegments[s];
    const uint32_t records = whole_->segments + static_cast<uint32_t>(segments_[s].place);
    return {records, records + (segment.data - segment.records), frames_[s], 0u};
}

void ClipStream::setThere(size_t s, bool there) {
    Segment& own = segments_[s];
    own.there = there;
    shown_.words[4 * size_t{whole_->streamedSegments[s].element} + 3] = there ? 0u : twins_[s];
    ++version_;
    if (!own.due) {
        own.due = true;
        due_.push_back(static_cast<uint32_t>(s));
    }
}

void ClipStream::letGo(size_t s) {
    Segment& own = segments_[s];
    if (own.place != kNowhere) {
        pool_.give(own.place, whole_->streamedSegments[s].size());
        own.place = kNowhere;
    }
    own.sent = own.planned = 0;
    if (own.there) {
        setThere(s, false);
    }
}

std::vector<uint32_t> ClipStream::inOrder() const {
    std::vector<uint32_t> order;
    for (uint32_t s = 0; s < segments_.size(); ++s) {
        if (segments_[s].stamp != 0) {
            order.push_back(s);
        }
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return segments_[a].stamp < segments_[b].stamp; });
    return order;
}

/// Those that were asked for before it make room, the earliest first.
bool ClipStream::makeRoom(size_t s) {
    Segment& own = segments_[s];
    const uint32_t size = whole_->streamedSegments[s].size();
    while (true) {
        if (const std::optional<uint64_t> place = pool_.take(size, 1)) {
            own.place = *place;
            return true;
        }
        size_t earliest = segments_.size();
        for (size_t other = 0; other < segments_.size(); ++other) {
            const Segment& victim = segments_[other];
            if (victim.place != kNowhere && !victim.pinned && victim.stamp < own.stamp &&
                (earliest == segments_.size() || victim.stamp < segments_[earliest].stamp)) {
                earliest = other;
            }
        }
        if (earliest == segments_.size()) {
            return false;
        }
        segments_[earliest].stamp = 0;
        letGo(earliest);
    }
}

void ClipStream::meet() {
    for (const uint32_t s : inOrder()) {
        // What made room for one before it is no longer wanted.
        const bool lacks = segments_[s].stamp != 0 && segments_[s].place == kNowhere;
        if (lacks && makeRoom(s) && !started_) {
            segments_[s].sent = bytes(s);
            setThere(s, true);
        }
    }
}

std::vector<uint32_t> ClipStream::start() {
    started_ = true;
    const std::vector<uint32_t>& all = whole_->words;
    std::vector<uint32_t> words(all.begin(), all.begin() + 4 * static_cast<ptrdiff_t>(whole_->segments));
    words.resize(words.size() + 4 * (pool_.size() + skinning::kPackedPadding), 0u);
    for (size_t s = 0; s < segments_.size(); ++s) {
        const skinning::StreamedSegment& segment = whole_->streamedSegments[s];
        const std::array<uint32_t, 4> element = elementOf(s);
        std::copy(element.begin(), element.end(), words.begin() + 4 * static_cast<ptrdiff_t>(segment.element));
        if (segments_[s].there) {
            std::copy(all.begin() + 4 * static_cast<ptrdiff_t>(segment.records),
                      all.begin() + 4 * static_cast<ptrdiff_t>(segment.end),
                      words.begin() + 4 * static_cast<ptrdiff_t>(element[0]));
        }
        segments_[s].due = false;
    }
    due_.clear();
    return words;
}

/// What earlier frames have copied plays.
void ClipStream::settle() {
    for (size_t s = 0; s < segments_.size(); ++s) {
        if (!segments_[s].there && segments_[s].place != kNowhere && segments_[s].sent == bytes(s)) {
            setThere(s, true);
        }
        segments_[s].planned = 0;
    }
}

VkDeviceSize ClipStream::beginFrame(uint64_t frame, VkDeviceSize most, bool ready) {
    if (frame == frame_) { // of another group
        return 0;
    }
    const bool isUsed = idleFrames_ < kIdle;
    idleFrames_ += isUsed ? 1 : 0;
    frame_ = frame;
    ready_ = ready;
    planned_.clear();
    if (!started_) {
        return 0;
    }
    settle();
    if (!ready || !isUsed) {
        return 0;
    }
    meet();
    VkDeviceSize left = most;
    for (const uint32_t s : inOrder()) {
        Segment& own = segments_[s];
        if (own.place != kNowhere && !own.there) {
            own.planned = std::min(left, bytes(s) - own.sent) / 4 * 4;
            left -= own.planned;
            if (own.planned > 0) {
                planned_.push_back(s);
            }
        }
    }
    return most - left;
}

void ClipStream::copy(const gpu::Device& device, VkCommandBuffer commandBuffer, VkBuffer table, size_t s) {
    Segment& own = segments_[s];
    const auto* const from =
        reinterpret_cast<const std::byte*>(&whole_->words[4 * size_t{whole_->streamedSegments[s].records}]);
    const VkDeviceSize to = (whole_->segments + own.place) * kElement, end = own.sent + own.planned;
    while (own.sent < end) {
        const VkDeviceSize piece = std::min(end - own.sent, kUpdateBytes);
        device.vk.CmdUpdateBuffer(commandBuffer, table, to + own.sent, piece, from + own.sent);
        own.sent += piece;
    }
}

VkDeviceSize ClipStream::record(const gpu::Device& device, VkCommandBuffer commandBuffer, VkBuffer table,
                                uint64_t frame) {
    const bool works = hasWork(frame);
    recordedFrame_ = frame;
    idleFrames_ = 0;
    if (!works) {
        return 0;
    }
    written_.clear();
    for (const uint32_t s : due_) {
        const std::array<uint32_t, 4> element = elementOf(s);
        device.vk.CmdUpdateBuffer(commandBuffer, table, whole_->streamedSegments[s].element * kElement, kElement,
                                  element.data());
        segments_[s].due = false;
        written_.push_back(s);
    }
    due_.clear();
    VkDeviceSize bytes = 0;
    for (const uint32_t s : planned_) {
        copy(device, commandBuffer, table, s);
        bytes += segments_[s].planned;
    }
    return bytes;
}

void ClipStream::cancelFrame(uint64_t frame) {
    if (recordedFrame_ != frame) {
        return;
    }
    recordedFrame_ = 0;
    idleFrames_ = kIdle;
    for (const uint32_t s : written_) {
        if (!segments_[s].due) {
            segments_[s].due = true;
            due_.push_back(s);
        }
    }
    written_.clear();
    for (const uint32_t s : planned_) {
        segments_[s].sent -= segments_[s].planned;
        segments_[s].planned = 0;
    }
    planned_.clear();
}

std::vector<ClipRequest> ClipStream::requests() const {
    std::vector<ClipRequest> all;
    const skinning::StreamedClip* clip = nullptr;
    uint32_t next = cage::kNone; // behind the last segment
    for (const uint32_t s : inOrder()) {
        const Segment& own = segments_[s];
        const bool goesOn = s == next && own.stamp == segments_[s - 1].stamp && own.pinned == segments_[s - 1].pinned &&
                            s < clip->firstSegment + clip->segmentCount;
        next = s + 1;
        if (!goesOn) {
            clip = &*std::prev(std::upper_bound(
                whole_->streamedClips.begin(), whole_->streamedClips.end(), s,
                [](uint32_t at, const skinning::StreamedClip& other) { return at < other.firstSegment; }));
            const double first = shared::kSegmentFrames * (s - clip->firstSegment);
            all.push_back({clip->clip, own.pinned ? ClipRequest::Use::pinned : ClipRequest::Use::wanted,
                           (first + 0.5) / clip->frames, 0.0});
        }
        const uint32_t end = std::min(shared::kSegmentFrames * (s + 1 - clip->firstSegment), clip->frames);
        all.back().end = (end - 0.5) / clip->frames;
    }
    return all;
}

void ClipStream::takeOver(const ClipStream& other, std::span<const uint32_t> clips) {
    for (ClipRequest own : other.requests()) {
        own.clip = clips[own.clip];
        if (own.clip != cage::kNone && !request(own)) {
            own.use = ClipRequest::Use::wanted; // there is less room than there was
            (void)request(own);
        }
    }
}

std::vector<ClipRequest> ClipStream::restart() {
    const std::vector<ClipRequest> asked = requests();
    for (size_t s = 0; s < segments_.size(); ++s) {
        segments_[s].stamp = 0;
        segments_[s].pinned = false;
        letGo(s);
    }
    recordedFrame_ = 0;
    idleFrames_ = kIdle;
    for (const ClipRequest& own : asked) {
        (void)request(own); // it has been pinned before
    }
    return asked;
}

} // namespace supple::runtime
