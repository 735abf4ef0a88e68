#include "skinning/packed_clip.h"

#include "shaders/shared/pose.h"
#include "skinning/bits.h"
#include "skinning/rotation.h"
#include "skinning/split_time.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace supple::skinning {
namespace {

using namespace shared;
using cage::ChannelPath;

constexpr uint32_t kLow20 = 0xFFFFFu;
constexpr int kMostWhole = (1 << 19) - 1;
constexpr int kMostConstantExponent = 27, kLeastConstantExponent = -3;
constexpr double kLeastRate = 1e-6, kMostRate = 1e6; // frames a second

uint32_t segmentsOf(uint32_t last) {
    return (last + kSegmentFrames - 1) / kSegmentFrames;
}

int signExtended(uint32_t low20) {
    return static_cast<int>((low20 & kLow20) ^ 0x80000u) - 0x80000;
}

/// Where the masks of 16 nodes have a path: of properties that change, and of constants.
struct MaskBits {
    size_t word;
    uint32_t shift;
};
constexpr MaskBits kMasks[2][3] = {{{0, 0}, {0, 16}, {1, 0}}, {{2, 0}, {2, 16}, {1, 16}}};

/// Frames a second.
double rateOf(uint32_t last, double duration) {
    return static_cast<double>(last) / duration;
}
bool isRate(double rate) {
    return rate >= kLeastRate && rate <= kMostRate;
}

bool fits(const glm::ivec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= kMostWhole;
}

/// Where the sections of a clip begin, in elements.
struct Sections {
    Sections(size_t nodeCount, size_t constants, size_t animated, uint32_t last)
        : masks(kPackedHeadElements), groups((nodeCount + 15) / 16), constantsBegin(masks + groups),
          statics(constantsBegin + (constants + 1) / 2), segments(statics + (animated + 3) / 4),
          records(segments + segmentsOf(last)), data(records + animated * segmentsOf(last)) {}

    size_t masks, groups, constantsBegin, statics, segments, records, data;
};

/// Bits behind each other, from the lowest of a word up.
class BitWriter {
public:
    void put(uint32_t value, uint32_t count) {
        for (uint32_t b = 0; b < count; ++b, ++length_) {
            if (length_ / 32 == words_.size()) {
                words_.push_back(0);
            }
            words_[length_ / 32] |= (value >> b & 1u) << (length_ % 32);
        }
    }
    [[nodiscard]] size_t length() const { return length_; }
    /// Up to a whole element.
    [[nodiscard]] std::vector<uint32_t>& whole() {
        words_.resize((words_.size() + 3) / 4 * 4, 0u);
        return words_;
    }

private:
    std::vector<uint32_t> words_;
    size_t length_ = 0;
};

uint32_t bitsAt(std::span<const uint32_t> words, size_t at, uint32_t count) {
    uint32_t value = 0;
    for (uint32_t b = 0; b < count; ++b) {
        value |= (words[(at + b) / 32] >> ((at + b) % 32) & 1u) << b;
    }
    return value;
}

/// The knots of a segment: places in the property's lists.
std::pair<size_t, size_t> knotsIn(const PackedProperty& property, uint32_t first, uint32_t end) {
    const auto begin = std::lower_bound(property.frames.begin(), property.frames.end(), first),
               last = std::lower_bound(begin, property.frames.end(), end);
    return {static_cast<size_t>(begin - property.frames.begin()),
            static_cast<size_t>(last - property.frames.begin()) + 1};
}

class ClipWriter {
public:
    ClipWriter(const PackedClip& clip, size_t nodeCount) : clip_(clip) {
        for (const PackedProperty& property : clip.properties) {
            (property.isConstant ? constants_ : animated_).push_back(&property);
        }
        sections_ = Sections(nodeCount, constants_.size(), animated_.size(), clip.last);
    }

    std::optional<std::vector<uint32_t>> write(double duration) {
        const double rate = rateOf(clip_.last, duration);
        if (animated_.size() > 0xFFFF || constants_.size() > 0xFFFF || !isRate(rate)) {
            return std::nullopt;
        }
        const SplitTime split = splitTime(rate);
        words_.assign(4 * sections_.data, 0u);
        words_[0] = bits(split.high);
        words_[9] = bits(split.low);
        words_[1] = clip_.last;
        words_[2] = static_cast<uint32_t>(animated_.size()) | static_cast<uint32_t>(constants_.size()) << 16;
        words_[3] = segmentsOf(clip_.last);
        const size_t sections[] = {sections_.masks, sections_.constantsBegin, sections_.statics, sections_.segments};
        std::transform(std::begin(sections), std::end(sections), words_.begin() + 4,
                       [](size_t at) { return static_cast<uint32_t>(at); });
        putMasks();
        const bool fit = putConstants() && putStatics();
        for (uint32_t segment = 0; fit && segment < segmentsOf(clip_.last); ++segment) {
            if (!putSegment(segment)) {
                return std::nullopt;
            }
        }
        words_.insert(words_.end(), 4 * size_t{kPackedPadding}, 0u);
        return fit ? std::optional(std::move(words_)) : std::nullopt;
    }

private:
    [[nodiscard]] uint32_t& word(size_t element, size_t i) { return words_[4 * element + i]; }

    void putMasks() {
        for (const PackedProperty& property : clip_.properties) {
            const MaskBits half = kMasks[property.isConstant ? 1 : 0][static_cast<size_t>(property.path)];
            word(sections_.masks + property.place / 16, half.word) |= 1u << (half.shift + property.place % 16);
        }
        uint32_t animated = 0, constants = 0;
        for (size_t group = 0; group < sections_.groups; ++group) {
            const size_t element = sections_.masks + group;
            word(element, 3) = animated | constants << 16;
            animated +=
                static_cast<uint32_t>(std::popcount(word(element, 0)) + std::popcount(word(element, 1) & 0xFFFFu));
            constants += static_cast<uint32_t>(std::popcount(word(element, 2)) + std::popcount(word(element, 1) >> 16));
        }
    }

    bool putConstants() {
        for (size_t i = 0; i < constants_.size(); ++i) {
            const PackedProperty& own = *constants_[i];
            const glm::uvec3 v = glm::uvec3(own.values.front()) & kLow20;
            uint32_t* const two = &words_[4 * sections_.constantsBegin + 2 * i];
            two[0] = v.x | v.y << 20;
            two[1] = v.y >> 12 | v.z << 8 | static_cast<uint32_t>(kMostConstantExponent - own.exponent) / 2 << 28;
            if (!fitsLayout(own)) {
                return false;
            }
        }
        return true;
    }

    bool putStatics() {
        for (size_t i = 0; i < animated_.size(); ++i) {
            const PackedProperty& own = *animated_[i];
            words_[4 * sections_.statics + i] = own.reference[0] | own.reference[1] << 9 | own.reference[2] << 18 |
                                                static_cast<uint32_t>(own.exponent - kLeastExponent) << 27;
            if (!fitsLayout(own)) {
                return false;
            }
        }
        return true;
    }

    bool putSegment(uint32_t segment) {
        const uint32_t first = segment * kSegmentFrames, end = std::min(first + kSegmentFrames, clip_.last);
        const size_t record = sections_.records + segment * animated_.size();
        const uint32_t own[] = {static_cast<uint32_t>(record), static_cast<uint32_t>(words_.size() / 4), end - first,
                                0u};
        std::copy(std::begin(own), std::end(own), &words_[4 * (sections_.segments + segment)]);
        BitWriter data;
        for (size_t i = 0; i < animated_.size(); ++i) {
            if (data.length() >= 1u << 21 || !putRecord(*animated_[i], first, end, record + i, data)) {
                return false;
            }
        }
        const std::vector<uint32_t>& whole = data.whole();
        words_.insert(words_.end(), whole.begin(), whole.end());
        return words_.size() < UINT32_MAX;
    }

    bool putRecord(const PackedProperty& property, uint32_t first, uint32_t end, size_t element, BitWriter& data) {
        const auto [begin, stop] = knotsIn(property, first, end);
        glm::ivec3 low = property.values[begin], high = low;
        uint32_t mask = 0;
        for (size_t k = begin; k < stop; ++k) {
            low = glm::min(low, property.values[k]);
            high = glm::max(high, property.values[k]);
            mask |= property.frames[k] < end ? 1u << (property.frames[k] - first) : 0u;
        }
        word(element, 0) = mask;
        const auto offset = static_cast<uint32_t>(data.length());
        std::array<uint32_t, 3> widths{};
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<size_t>(axis);
            widths[a] = static_cast<uint32_t>(std::bit_width(static_cast<uint32_t>(high[axis] - low[axis])));
            word(element, 1 + a) =
                (static_cast<uint32_t>(low[axis]) & kLow20) | widths[a] << 20 | (offset >> 7 * a & 127u) << 25;
        }
        for (size_t k = begin; k < stop; ++k) {
            for (int axis = 0; axis < 3; ++axis) {
                data.put(static_cast<uint32_t>(property.values[k][axis] - low[axis]),
                         widths[static_cast<size_t>(axis)]);
            }
        }
        return true;
    }

    const PackedClip& clip_;
    std::vector<const PackedProperty*> animated_, constants_;
    Sections sections_{0, 0, 0, 1};
    std::vector<uint32_t> words_;
};

class ClipReader {
public:
    ClipReader(std::span<const uint32_t> words, size_t nodeCount) : words_(words), nodeCount_(nodeCount) {}

    Result<PackedClip> read(double duration) {
        if (!readHead(duration) || !readMasks()) {
            return Error{ErrorCode::asset, fault_};
        }
        readConstants();
        if (!readSegments()) {
            return Error{ErrorCode::asset, fault_};
        }
        return std::move(clip_);
    }

private:
    bool refuse(const char* fault) {
        fault_ = fault;
        return false;
    }
    [[nodiscard]] uint32_t word(size_t element, size_t i) const { return words_[4 * element + i]; }

    bool readHead(double duration) {
        if (words_.size() % 4 != 0 || words_.size() < 4 * kPackedHeadElements) {
            return refuse("a packed clip without a head");
        }
        clip_.last = words_[1];
        if (clip_.last < 1 || clip_.last > kMostPackedFrames || !(duration > 0.0) || !std::isfinite(duration)) {
            return refuse("a packed clip of no frames, or too many");
        }
        const size_t animated = words_[2] & 0xFFFFu, constants = words_[2] >> 16;
        sections_ = Sections(nodeCount_, constants, animated, clip_.last);
        const double rate = rateOf(clip_.last, duration);
        if (!isRate(rate)) {
            return refuse("a packed clip of no sound rate");
        }
        const SplitTime split = splitTime(rate);
        const bool sound = words_[0] == bits(split.high) && words_[9] == bits(split.low) &&
                           words_[3] == segmentsOf(clip_.last) && words_[4] == sections_.masks &&
                           words_[5] == sections_.constantsBegin && words_[6] == sections_.statics &&
                           words_[7] == sections_.segments && words_[8] == 0 && words_[10] == 0 && words_[11] == 0;
        if (!sound || words_.size() / 4 < sections_.data + kPackedPadding) {
            return refuse("a packed clip whose sections are elsewhere");
        }
        return true;
    }

    bool readMasks() {
        size_t animated = 0, constants = 0;
        for (size_t group = 0; group < sections_.groups; ++group) {
            const size_t element = sections_.masks + group;
            if (word(element, 3) != (animated | constants << 16)) {
                return refuse("a packed clip whose masks count wrongly");
            }
            for (uint32_t bit = 0; bit < 16; ++bit) {
                for (size_t path = 0; path < 3; ++path) {
                    const auto has = [&](const MaskBits& half) {
                        return (word(element, half.word) >> (half.shift + bit) & 1u) != 0;
                    };
                    const bool moves = has(kMasks[0][path]), stands = has(kMasks[1][path]);
                    const size_t place = 16 * group + bit;
                    if ((moves || stands) && (place >= nodeCount_ || (moves && stands))) {
                        return refuse("a packed clip of a node that is not there, or twice");
                    }
                    if (moves || stands) {
                        PackedProperty& own = clip_.properties.emplace_back();
                        own.place = static_cast<uint32_t>(place);
                        own.path = static_cast<ChannelPath>(path);
                        own.isConstant = stands;
                        ++(stands ? constants : animated);
                    }
                }
            }
            if (animated > (words_[2] & 0xFFFFu) || constants > words_[2] >> 16) {
                return refuse("a packed clip whose masks count wrongly");
            }
        }
        return (animated | constants << 16) == words_[2] || refuse("a packed clip whose masks count wrongly");
    }

    void readConstants() {
        size_t constant = 0, animated = 0;
        for (PackedProperty& own : clip_.properties) {
            if (own.isConstant) {
                const uint32_t* const two = &words_[4 * sections_.constantsBegin + 2 * constant++];
                own.exponent = kMostConstantExponent - 2 * static_cast<int>(two[1] >> 28);
                own.values = {
                    {signExtended(two[0]), signExtended(two[0] >> 20 | two[1] << 12), signExtended(two[1] >> 8)}};
            } else {
                const uint32_t w = words_[4 * sections_.statics + animated++];
                own.exponent = static_cast<int>(w >> 27) + kLeastExponent;
                own.reference = {w & 511u, w >> 9 & 511u, w >> 18 & 511u};
            }
        }
    }

    bool readSegments() {
        std::vector<PackedProperty*> changing;
        for (PackedProperty& own : clip_.properties) {
            if (!own.isConstant) {
                changing.push_back(&own);
            }
        }
        size_t begin = sections_.data;
        for (uint32_t segment = 0; segment < segmentsOf(clip_.last); ++segment) {
            const size_t element = sections_.segments + segment;
            const uint32_t first = segment * kSegmentFrames, frames = std::min(kSegmentFrames, clip_.last - first);
            const size_t record = sections_.records + segment * changing.size();
            if (word(element, 0) != record || word(element, 1) != begin || word(element, 2) != frames ||
                word(element, 3) != 0) {
                return refuse("a segment of a packed clip that is elsewhere");
            }
            size_t length = 0;
            for (size_t i = 0; i < changing.size(); ++i) {
                if (!readRecord(*changing[i], first, frames, record + i, begin, length)) {
                    return false;
                }
            }
            begin += (length + 127) / 128;
        }
        return begin + kPackedPadding == words_.size() / 4 ||
               refuse("a packed clip that is longer or shorter than its segments");
    }

    bool readRecord(PackedProperty& own, uint32_t first, uint32_t frames, size_t element, size_t begin,
                    size_t& length) {
        const uint32_t mask = word(element, 0);
        std::array<uint32_t, 3> widths{};
        glm::ivec3 low;
        uint32_t offset = 0;
        for (uint32_t axis = 0; axis < 3; ++axis) {
            const uint32_t w = word(element, 1 + axis);
            low[static_cast<int>(axis)] = signExtended(w);
            widths[axis] = w >> 20 & 31u;
            offset |= (w >> 25) << 7 * axis;
        }
        const bool sound = (mask & 1u) != 0 && (frames == 32 || mask >> frames == 0) && offset == length &&
                           *std::max_element(widths.begin(), widths.end()) <= 20;
        const uint32_t knots = static_cast<uint32_t>(std::popcount(mask)) + 1,
                       width = widths[0] + widths[1] + widths[2];
        const size_t end = length + size_t{knots} * width;
        // Equal values need no knots in between: what is read stays in proportion to its words.
        if (!sound || (width == 0 && mask != 1) || begin + (end + 127) / 128 + kPackedPadding > words_.size() / 4) {
            return refuse("a record of a packed clip that does not fit");
        }
        const std::span<const uint32_t> data = words_.subspan(4 * begin);
        for (uint32_t frame = 0; frame <= frames; ++frame) {
            if (frame < frames && (mask >> frame & 1u) == 0) {
                continue;
            }
            glm::ivec3 value = low;
            for (int axis = 0; axis < 3; ++axis) {
                value[axis] += static_cast<int>(bitsAt(data, length, widths[static_cast<size_t>(axis)]));
                length += widths[static_cast<size_t>(axis)];
            }
            if (!own.frames.empty() && own.frames.back() == first + frame) {
                if (own.values.back() != value) { // the border of two segments: both have it
                    return refuse("a packed clip that jumps between two segments");
                }
                continue;
            }
            own.frames.push_back(first + frame);
            own.values.push_back(value);
        }
        return true;
    }

    std::span<const uint32_t> words_;
    size_t nodeCount_;
    Sections sections_{0, 0, 0, 1};
    PackedClip clip_;
    const char* fault_ = "";
};

} // namespace

glm::dquat fromQuarterTangent(const glm::dvec3& r) {
    const double squares = glm::dot(r, r), scale = 1.0 / (1.0 + squares);
    return {(1.0 - squares) * scale, 2.0 * scale * r.x, 2.0 * scale * r.y, 2.0 * scale * r.z};
}

glm::dvec3 toQuarterTangent(const glm::dquat& q) {
    const glm::dquat own = unit(q);
    const double side = own.w < 0.0 ? -1.0 : 1.0;
    return glm::dvec3(own.x, own.y, own.z) * side / (1.0 + side * own.w);
}

glm::dquat referenceTurn(const std::array<uint32_t, 3>& reference) {
    return fromQuarterTangent((glm::dvec3(reference[0], reference[1], reference[2]) - 255.0) / 255.0);
}

std::array<uint32_t, 3> referenceNear(const glm::dquat& rotation) {
    const glm::dvec3 r = glm::round(toQuarterTangent(rotation) * 255.0) + 255.0;
    return {static_cast<uint32_t>(r.x), static_cast<uint32_t>(r.y), static_cast<uint32_t>(r.z)};
}

bool fitsLayout(const PackedProperty& property) {
    return std::all_of(property.values.begin(), property.values.end(), fits);
}

void removeEqualKnots(PackedProperty& property) {
    const std::vector<uint32_t> frames = std::move(property.frames);
    const std::vector<glm::ivec3> values = std::move(property.values);
    property.frames.clear();
    property.values.clear();
    for (size_t begin = 0; begin + 1 < frames.size();) {
        const uint32_t border = (frames[begin] / kSegmentFrames + 1) * kSegmentFrames;
        size_t end = begin + 1;
        while (end + 1 < frames.size() && frames[end] < border) {
            ++end;
        }
        const bool equal = std::all_of(values.begin() + static_cast<ptrdiff_t>(begin),
                                       values.begin() + static_cast<ptrdiff_t>(end) + 1,
                                       [&](const glm::ivec3& v) { return v == values[begin]; });
        for (size_t k = begin; k < (equal ? begin + 1 : end); ++k) {
            property.frames.push_back(frames[k]);
            property.values.push_back(values[k]);
        }
        begin = end;
    }
    property.frames.push_back(frames.back());
    property.values.push_back(values.back());
}

int constantExponent(const glm::dvec3& value) {
    const double largest = std::max({std::abs(value.x), std::abs(value.y), std::abs(value.z)});
    int exponent = kMostConstantExponent;
    while (exponent > kLeastConstantExponent && std::ldexp(largest, exponent) > kMostWhole) {
        exponent -= 2;
    }
    return exponent;
}

std::optional<std::vector<uint32_t>> packedWords(const PackedClip& clip, double duration, size_t nodeCount) {
    return ClipWriter(clip, nodeCount).write(duration);
}

Result<PackedClip> readPackedWords(std::span<const uint32_t> words, double duration, size_t nodeCount) {
    return ClipReader(words, nodeCount).read(duration);
}

std::vector<SegmentPlaces> segmentsIn(std::span<const uint32_t> words) {
    const uint32_t animated = words[2] & 0xFFFFu, count = words[3];
    const std::span<const uint32_t> elements = words.subspan(4 * size_t{words[7]});
    const auto end = static_cast<uint32_t>(words.size() / 4) - kPackedPadding;
    std::vector<SegmentPlaces> places(count);
    for (uint32_t s = 0; s < count; ++s) {
        const uint32_t records = elements[4 * size_t{s}], data = elements[4 * size_t{s} + 1];
        places[s] = {records, records + animated, data, s + 1 < count ? elements[4 * size_t{s} + 5] : end};
    }
    return places;
}

size_t segmentWords(std::span<const uint32_t> words) {
    return words.size() - 4 * (size_t{segmentsIn(words).front().records} + kPackedPadding);
}

bool areTwins(std::span<const uint32_t> fine, std::span<const uint32_t> coarse) {
    return fine.size() > 1 && coarse.size() > 1 && fine[1] == coarse[1];
}

std::vector<cage::Channel> channelsOf(const PackedClip& clip, double duration, std::span<const uint32_t> nodes) {
    std::vector<cage::Channel> channels;
    for (const PackedProperty& property : clip.properties) {
        cage::Channel& channel = channels.emplace_back();
        channel.node = nodes[property.place];
        channel.path = property.path;
        const bool turns = property.path == ChannelPath::rotation;
        const glm::dquat reference =
            turns && !property.isConstant ? referenceTurn(property.reference) : glm::dquat(1, 0, 0, 0);
        for (size_t k = 0; k < property.values.size(); ++k) {
            const double part = property.isConstant ? 0.0 : static_cast<double>(property.frames[k]) / clip.last;
            channel.times.push_back(static_cast<float>(duration * part));
            const glm::dvec3 v = glm::dvec3(property.values[k]) * std::ldexp(1.0, -property.exponent);
            if (turns) {
                const glm::dquat q = reference * fromQuarterTangent(v);
                channel.values.insert(channel.values.end(), {static_cast<float>(q.x), static_cast<float>(q.y),
                                                             static_cast<float>(q.z), static_cast<float>(q.w)});
            } else {
                channel.values.insert(channel.values.end(),
                                      {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
            }
        }
    }
    const bool stands = std::all_of(clip.properties.begin(), clip.properties.end(),
                                    [](const PackedProperty& own) { return own.isConstant; });
    if (stands && !channels.empty()) { // a key at the end, from which others take the duration
        cage::Channel& first = channels.front();
        const std::vector<float> values = first.values;
        first.times.push_back(static_cast<float>(duration));
        first.values.insert(first.values.end(), values.begin(), values.end());
    }
    return channels;
}

} // namespace supple::skinning
