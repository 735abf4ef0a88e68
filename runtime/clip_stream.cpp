#include "runtime/clip_stream.h"

#include "shaders/shared/pose.h"
#include "skinning/packed_clip.h"

#include <algorithm>
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
    : whole_(std::move(whole)), shown_(*whole_), versions_(whole_->streamedClips.size(), 1),
      segments_(whole_->streamedSegments.size()), poolSize_(poolSize(*whole_, poolBytes)), free_(poolSize_) {
    for (const skinning::StreamedClip& clip : whole_->streamedClips) {
        for (uint32_t s = 0; s < clip.segmentCount; ++s) {
            twins_.push_back(clip.twin);
            frames_.push_back(whole_->words[4 * size_t{whole_->streamedSegments[clip.firstSegment + s].element} + 2]);
        }
    }
    for (std::vector<uint32_t>* const list :
         {&placed_, &waiting_, &leaving_, &byRequest_, &due_, &planned_, &written_, &moved_}) {
        list->reserve(segments_.size()); // frames allocate nothing
    }
    for (uint32_t s = 0; s < segments_.size(); ++s) {
        setThere(s, false);
    }
}

size_t ClipStream::find(uint32_t clip) const {
    const std::vector<skinning::StreamedClip>& clips = whole_->streamedClips; // by clip
    const auto found = std::lower_bound(clips.begin(), clips.end(), clip,
                                        [](const skinning::StreamedClip& own, uint32_t at) { return own.clip < at; });
    return found != clips.end() && found->clip == clip ? static_cast<size_t>(found - clips.begin()) : cage::kNone;
}

size_t ClipStream::clipOf(uint32_t segment) const {
    const std::vector<skinning::StreamedClip>& clips = whole_->streamedClips;
    const auto behind =
        std::upper_bound(clips.begin(), clips.end(), segment,
                         [](uint32_t at, const skinning::StreamedClip& own) { return at < own.firstSegment; });
    return static_cast<size_t>(behind - clips.begin()) - 1;
}

uint64_t ClipStream::versionOf(uint32_t clip) const {
    const size_t own = find(clip);
    return own != cage::kNone ? versions_[own] : 1;
}

ClipStream::Run ClipStream::runOf(const skinning::StreamedClip& clip, const ClipRequest& request) {
    const auto segmentAt = [&](double part) {
        const auto frame = static_cast<uint32_t>(std::clamp(part, 0.0, 1.0) * clip.frames);
        return clip.firstSegment + std::min(frame / shared::kSegmentFrames, clip.segmentCount - 1);
    };
    return {segmentAt(request.begin), segmentAt(request.end) + 1};
}

Status ClipStream::request(const ClipRequest& request) {
    const size_t clip = find(request.clip);
    if (clip == cage::kNone) { // all of it is always there
        return success();
    }
    const Run run = runOf(whole_->streamedClips[clip], request);
    if (request.use == ClipRequest::Use::pinned) {
        VkDeviceSize pinned = 0;
        for (uint32_t s = 0; s < segments_.size(); ++s) {
            pinned += segments_[s].pinned || (s >= run.first && s < run.end) ? bytes(s) : 0;
        }
        if (pinned > poolSize_ * kElement) {
            return Error{ErrorCode::limit, "what is pinned would take " + std::to_string(pinned) +
                                               " bytes, and the pool has " + std::to_string(poolSize_ * kElement)};
        }
    }
    const bool wanted = request.use != ClipRequest::Use::released;
    for (uint32_t s = run.first; s < run.end; ++s) {
        segments_[s].stamp = wanted ? request.stamp : 0;
        segments_[s].pinned = request.use == ClipRequest::Use::pinned;
        if (!wanted && !segments_[s].there) { // it goes when room is needed; what is on its way is of no use
            letGo(s);
        }
    }
    asked_ = true;
    if (!started_) {
        placeAll();
    }
    return success();
}

ClipStream::Bytes ClipStream::bytesOf(uint32_t clip) const {
    Bytes sum;
    const size_t found = find(clip);
    if (found == cage::kNone) {
        return sum;
    }
    const skinning::StreamedClip& own = whole_->streamedClips[found];
    for (uint32_t s = own.firstSegment; s < own.firstSegment + own.segmentCount; ++s) {
        sum.all += bytes(s);
        sum.there += segments_[s].there ? bytes(s) : 0;
    }
    return sum;
}

std::array<uint32_t, 4> ClipStream::elementOf(uint32_t s) const {
    if (!segments_[s].there) {
        return {0u, 0u, frames_[s], twins_[s]};
    }
    const skinning::StreamedSegment& segment = whole_->streamedSegments[s];
    const uint32_t records = whole_->segments + static_cast<uint32_t>(segments_[s].place);
    return {records, records + (segment.data - segment.records), frames_[s], 0u};
}

void ClipStream::setDue(uint32_t s) {
    if (!segments_[s].due) {
        segments_[s].due = true;
        due_.push_back(s);
    }
}

void ClipStream::setThere(uint32_t s, bool there) {
    segments_[s].there = there;
    segments_[s].moved = false;
    shown_.words[4 * size_t{whole_->streamedSegments[s].element} + 3] = there ? 0u : twins_[s];
    versions_[clipOf(s)] = ++version_;
    setDue(s);
}

/// Where nothing is; kNowhere: it has none.
void ClipStream::setPlace(uint32_t s, uint64_t place) {
    const auto byPlace = [&](uint32_t other, uint64_t at) { return segments_[other].place < at; };
    uint64_t& own = segments_[s].place;
    if (own != kNowhere) {
        placed_.erase(std::lower_bound(placed_.begin(), placed_.end(), own, byPlace));
        free_ += size(s);
    }
    own = place;
    if (own != kNowhere) {
        placed_.insert(std::lower_bound(placed_.begin(), placed_.end(), own, byPlace), s);
        free_ -= size(s);
    }
}

void ClipStream::letGo(uint32_t s) {
    setPlace(s, kNowhere);
    segments_[s].sent = segments_[s].planned = 0;
    if (segments_[s].there) {
        setThere(s, false);
    }
}

/// The pool is for what is pinned, and for what was asked for last, as far as there is room.
void ClipStream::choose() {
    asked_ = false;
    byRequest_.clear();
    waiting_.clear();
    leaving_.clear();
    for (uint32_t s = 0; s < segments_.size(); ++s) {
        if (segments_[s].stamp != 0 || segments_[s].place != kNowhere) {
            byRequest_.push_back(s);
        }
    }
    std::sort(byRequest_.begin(), byRequest_.end(), [&](uint32_t a, uint32_t b) {
        const Segment &first = segments_[a], &second = segments_[b];
        return first.pinned != second.pinned ? first.pinned
               : first.stamp != second.stamp ? first.stamp > second.stamp
                                             : a < b;
    });
    uint64_t room = poolSize_;
    for (const uint32_t s : byRequest_) {
        const bool stays = segments_[s].stamp != 0 && size(s) <= room;
        room -= stays ? size(s) : 0;
        if (stays && !segments_[s].there) {
            waiting_.push_back(s);
        } else if (!stays && segments_[s].place != kNowhere) {
            leaving_.push_back(s);
        }
    }
    std::sort(waiting_.begin(), waiting_.end(), [&](uint32_t a, uint32_t b) {
        return segments_[a].stamp != segments_[b].stamp ? segments_[a].stamp < segments_[b].stamp : a < b;
    });
}

/// Before the device has anything.
void ClipStream::placeAll() {
    choose();
    while (!leaving_.empty()) {
        letGo(leaving_.back());
        leaving_.pop_back();
    }
    uint64_t end = 0;
    const auto put = [&](uint32_t s) {
        segments_[s].place = end;
        end += size(s);
    };
    std::for_each(placed_.begin(), placed_.end(), put);
    for (const uint32_t s : waiting_) {
        setPlace(s, end);
        end += size(s);
        segments_[s].sent = bytes(s);
        setThere(s, true);
    }
    waiting_.clear();
}

std::vector<uint32_t> ClipStream::words() const {
    const std::vector<uint32_t>& all = whole_->words;
    std::vector<uint32_t> words(all.begin(), all.begin() + 4 * static_cast<ptrdiff_t>(whole_->segments));
    words.resize(words.size() + 4 * (poolSize_ + skinning::kPackedPadding), 0u);
    for (uint32_t s = 0; s < segments_.size(); ++s) {
        const skinning::StreamedSegment& segment = whole_->streamedSegments[s];
        const std::array<uint32_t, 4> element = elementOf(s);
        std::copy(element.begin(), element.end(), words.begin() + 4 * static_cast<ptrdiff_t>(segment.element));
        if (segments_[s].there) {
            std::copy(all.begin() + 4 * static_cast<ptrdiff_t>(segment.records),
                      all.begin() + 4 * static_cast<ptrdiff_t>(segment.end),
                      words.begin() + 4 * static_cast<ptrdiff_t>(element[0]));
        }
    }
    return words;
}

void ClipStream::start() {
    if (!started_) {
        started_ = true;
        for (const uint32_t s : due_) {
            segments_[s].due = false;
        }
        due_.clear();
    }
}

/// What earlier frames have copied plays.
void ClipStream::settle() {
    for (const uint32_t s : planned_) {
        if (segments_[s].place != kNowhere && !segments_[s].there && segments_[s].sent == bytes(s)) {
            setThere(s, true);
        }
        segments_[s].planned = 0;
    }
    planned_.clear();
    std::erase_if(waiting_, [&](uint32_t s) { return segments_[s].there; });
}

bool ClipStream::beginFrame(uint64_t frame, bool ready) {
    if (frame == frame_ || !started_) { // it is another group's as well
        return false;
    }
    frame_ = frame;
    idleFrames_ += isIdle() ? 0 : 1;
    settle();
    if (!ready || restarted_) {
        return false;
    }
    if (asked_) {
        choose();
    }
    return !waiting_.empty();
}

VkDeviceSize ClipStream::plan(VkDeviceSize most, VkDeviceSize left) {
    const VkDeviceSize before = left;
    for (const uint32_t s : due_) { // what no frame has recorded yet
        left -= segments_[s].moved ? std::min(left, bytes(s)) : 0;
    }
    for (const uint32_t s : waiting_) {
        if (left < sizeof(uint32_t) || (segments_[s].place == kNowhere && !findPlace(s, most, left))) {
            break;
        }
        Segment& own = segments_[s];
        own.planned = std::min(left, bytes(s) - own.sent) / sizeof(uint32_t) * sizeof(uint32_t);
        left -= own.planned;
        if (own.planned > 0) {
            planned_.push_back(s);
        }
    }
    return before - left;
}

/// The smallest piece that is free and large enough. False: it is for later frames to make one.
bool ClipStream::findPlace(uint32_t s, VkDeviceSize most, VkDeviceSize& left) {
    while (free_ < size(s)) { // choose() has left room for it
        segments_[leaving_.back()].stamp = 0;
        letGo(leaving_.back());
        leaving_.pop_back();
    }
    while (true) {
        uint64_t end = 0, place = kNowhere, smallest = kNowhere;
        const auto look = [&](uint64_t next) {
            if (next - end >= size(s) && next - end < smallest) {
                place = end;
                smallest = next - end;
            }
        };
        for (const uint32_t other : placed_) {
            look(segments_[other].place);
            end = segments_[other].place + size(other);
        }
        look(poolSize_);
        if (place != kNowhere) {
            setPlace(s, place);
            return true;
        }
        if (!slide(most, left)) {
            return false;
        }
    }
}

/// Closes the first gap by moving the segment behind it. What it plays stays the same, so it goes as a whole.
bool ClipStream::slide(VkDeviceSize most, VkDeviceSize& left) {
    uint64_t end = 0;
    const auto behindGap = std::find_if(placed_.begin(), placed_.end(), [&](uint32_t s) {
        const bool touches = segments_[s].place == end;
        end += touches ? size(s) : 0;
        return !touches;
    });
    const uint32_t s = *behindGap; // free pieces that are too small, but not together, have segments between them
    Segment& own = segments_[s];
    if (!own.there) { // it begins anew
        own.sent = 0;
        setPlace(s, end);
        return true;
    }
    if (bytes(s) > most) { // no frame can move it: its twin plays until it is there again
        letGo(s);
        std::erase(leaving_, s);
        asked_ = true;
        return true;
    }
    const VkDeviceSize cost = own.moved ? 0 : bytes(s);
    if (cost > left) {
        return false;
    }
    left -= cost;
    own.moved = true;
    setPlace(s, end);
    setDue(s);
    return true;
}

void ClipStream::copy(const gpu::Device& device, VkCommandBuffer commandBuffer, VkBuffer table, uint32_t s,
                      VkDeviceSize first, VkDeviceSize end) const {
    const auto* const from =
        reinterpret_cast<const std::byte*>(&whole_->words[4 * size_t{whole_->streamedSegments[s].records}]);
    const VkDeviceSize to = (whole_->segments + segments_[s].place) * kElement;
    while (first < end) {
        const VkDeviceSize piece = std::min(end - first, kUpdateBytes);
        device.vk.CmdUpdateBuffer(commandBuffer, table, to + first, piece, from + first);
        first += piece;
    }
}

VkDeviceSize ClipStream::record(const gpu::Device& device, VkCommandBuffer commandBuffer, VkBuffer table,
                                uint64_t frame, VkDeviceSize most) {
    if (recordedFrame_ == frame) {
        return 0;
    }
    recordedFrame_ = frame;
    idleFrames_ = 0;
    restartedBefore_ = restarted_;
    restarted_ = false;
    written_.clear();
    moved_.clear();
    VkDeviceSize sum = 0;
    for (const uint32_t s : due_) {
        const std::array<uint32_t, 4> element = elementOf(s);
        device.vk.CmdUpdateBuffer(commandBuffer, table, whole_->streamedSegments[s].element * kElement, kElement,
                                  element.data());
        written_.push_back(s);
        segments_[s].due = false;
        if (segments_[s].moved) {
            copy(device, commandBuffer, table, s, 0, bytes(s));
            sum += bytes(s);
            moved_.push_back(s);
            segments_[s].moved = false;
        }
    }
    due_.clear();
    for (size_t k = 0; frame_ == frame && k < planned_.size(); ++k) { // else they are those of an earlier frame
        const uint32_t s = planned_[k];
        Segment& own = segments_[s];
        own.planned = std::min(own.planned, most / sizeof(uint32_t) * sizeof(uint32_t));
        copy(device, commandBuffer, table, s, own.sent, own.sent + own.planned);
        own.sent += own.planned;
        most -= own.planned;
        sum += own.planned;
    }
    return sum;
}

void ClipStream::cancelFrame(uint64_t frame) {
    if (recordedFrame_ != frame) {
        return;
    }
    recordedFrame_ = 0;
    idleFrames_ = kIdle;
    restarted_ = restartedBefore_;
    for (const uint32_t s : moved_) {
        segments_[s].moved = segments_[s].there;
    }
    for (const uint32_t s : written_) {
        setDue(s);
    }
    written_.clear();
    moved_.clear();
    if (frame_ == frame) {
        for (const uint32_t s : planned_) {
            segments_[s].sent -= segments_[s].planned;
            segments_[s].planned = 0;
        }
        planned_.clear();
    }
}

std::vector<ClipRequest> ClipStream::requests() const {
    std::vector<uint32_t> order;
    for (uint32_t s = 0; s < segments_.size(); ++s) {
        if (segments_[s].stamp != 0) {
            order.push_back(s);
        }
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return segments_[a].stamp < segments_[b].stamp; });
    std::vector<ClipRequest> all;
    const skinning::StreamedClip* clip = nullptr;
    uint32_t next = cage::kNone; // behind the last segment
    for (const uint32_t s : order) {
        const Segment& own = segments_[s];
        const bool goesOn = s == next && own.stamp == segments_[s - 1].stamp && own.pinned == segments_[s - 1].pinned &&
                            s < clip->firstSegment + clip->segmentCount;
        next = s + 1;
        if (!goesOn) {
            clip = &whole_->streamedClips[clipOf(s)];
            const double first = shared::kSegmentFrames * (s - clip->firstSegment);
            all.push_back({clip->clip, own.pinned ? ClipRequest::Use::pinned : ClipRequest::Use::wanted,
                           (first + 0.5) / clip->frames, 0.0});
        }
        const uint32_t end = std::min(shared::kSegmentFrames * (s + 1 - clip->firstSegment), clip->frames);
        all.back().end = (end - 0.5) / clip->frames;
    }
    return all;
}

void ClipStream::restart() {
    for (uint32_t s = 0; s < segments_.size(); ++s) {
        segments_[s].stamp = 0;
        segments_[s].pinned = false;
        letGo(s);
        if (started_) { // whatever the open frame has recorded may be cancelled
            setDue(s);
        }
    }
    waiting_.clear();
    leaving_.clear();
    planned_.clear();
    recordedFrame_ = 0;
    idleFrames_ = kIdle;
    restarted_ = true;
}

} // namespace supple::runtime
