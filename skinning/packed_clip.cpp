#include "skinning/packed_clip.h"

#include "shaders/pose/knots.h"
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
constexpr uint32_t kMostWidth = 20, kMostPairBits = 129; // 2 elements, from any bit of the first
constexpr int kMostShift = 15;
constexpr size_t kMostDataBits = size_t{1} << 19;
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
MaskBits maskOf(const PackedProperty& own) {
    return kMasks[own.isConstant ? 1 : 0][own.path == ChannelPath::weights ? 0 : static_cast<size_t>(own.path)];
}

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

bool valuesFit(const PackedProperty& property) {
    return std::all_of(property.values.begin(), property.values.end(), fits);
}

/// Where the sections of a clip begin, in elements.
struct Sections {
    Sections(size_t places, size_t constants, size_t animated, uint32_t last)
        : masks(kPackedHeadElements), groups((places + 15) / 16), constantsBegin(masks + groups),
          segments(constantsBegin + (constants + 1) / 2), records(segments + segmentsOf(last)),
          data(records + animated * segmentsOf(last)) {}

    size_t masks, groups, constantsBegin, segments, records, data;
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

bool isOuter(size_t knot, size_t last) {
    return knot % 2 == 0 || knot == last;
}
/// An inner knot, but for what it is off the line between its neighbors.
glm::ivec3 lineAt(const std::array<uint32_t, 3>& frames, const glm::ivec3& before, const glm::ivec3& behind) {
    return glm::ivec3(onLine(glm::vec3(before), glm::vec3(behind), frames[1] - frames[0], frames[2] - frames[0]));
}

/// Bits of three numbers.
using Widths = std::array<uint32_t, 3>;
uint32_t bitsOf(const Widths& widths) {
    return widths[0] + widths[1] + widths[2];
}
/// What numbers from `low` to `high`, 0 among them, take when halvesOf() is added.
uint32_t signedWidth(int low, int high) {
    return static_cast<uint32_t>(
        std::max(std::bit_width(static_cast<uint32_t>(low < 0 ? -low - 1 : 0)) + (low < 0 ? 1 : 0),
                 std::bit_width(static_cast<uint32_t>(std::max(high, 0))) + (high > 0 ? 1 : 0)));
}

/// What is added to numbers of both signs, so that none is negative.
glm::ivec3 halvesOf(const Widths& widths) {
    return {1 << widths[0] >> 1, 1 << widths[1] >> 1, 1 << widths[2] >> 1};
}

/// What a property has in one segment.
struct SegmentKnots {
    uint32_t first = 0; ///< frame of the segment
    std::span<const uint32_t> frames;
    std::span<const glm::ivec3> values;
    std::vector<glm::ivec3> offs; ///< one for each inner knot: what it is off the line
    glm::ivec3 low{0};            ///< of the outer ones

    [[nodiscard]] size_t last() const { return frames.size() - 1; }
    [[nodiscard]] uint32_t mask() const {
        uint32_t mask = 0;
        for (const uint32_t frame : frames.first(last())) {
            mask |= 1u << (frame - first);
        }
        return mask;
    }
    [[nodiscard]] Widths innerWidths() const {
        glm::ivec3 least(0), most(0);
        for (const glm::ivec3& off : offs) {
            least = glm::min(least, off);
            most = glm::max(most, off);
        }
        return {signedWidth(least.x, most.x), signedWidth(least.y, most.y), signedWidth(least.z, most.z)};
    }
    /// From `from` on, which is not above the lowest.
    [[nodiscard]] Widths outerWidths(const glm::ivec3& from) const {
        glm::ivec3 most(0);
        for (size_t k = 0; k < values.size(); ++k) {
            most = isOuter(k, last()) ? glm::max(most, values[k] - from) : most;
        }
        const auto width = [](int number) {
            return static_cast<uint32_t>(std::bit_width(static_cast<uint32_t>(number)));
        };
        return {width(most.x), width(most.y), width(most.z)};
    }
};
SegmentKnots knotsOf(const PackedProperty& property, uint32_t first, uint32_t end) {
    const auto begin = std::lower_bound(property.frames.begin(), property.frames.end(), first),
               last = std::lower_bound(begin, property.frames.end(), end);
    SegmentKnots knots{first, {begin, last + 1}, {}, {}, {}};
    knots.values =
        std::span(property.values).subspan(static_cast<size_t>(begin - property.frames.begin()), knots.frames.size());
    knots.low = glm::min(knots.values.front(), knots.values.back());
    for (size_t k = 0; k < knots.values.size(); ++k) {
        if (isOuter(k, knots.last())) {
            knots.low = glm::min(knots.low, knots.values[k]);
        } else {
            knots.offs.push_back(knots.values[k] - lineAt({knots.frames[k - 1], knots.frames[k], knots.frames[k + 1]},
                                                          knots.values[k - 1], knots.values[k + 1]));
        }
    }
    return knots;
}

/// How a property keeps the lowest number of a segment's outer knots, by axis: as a number of 5 bits, behind `base`
/// times 16, times 2^shift.
struct LowScale {
    Widths base{16u, 16u, 16u}; ///< 16 is none; rotations have none
    Widths shift{};

    [[nodiscard]] int stepOf(size_t axis, int low) const {
        return (low >> shift[axis]) - 16 * (static_cast<int>(base[axis]) - 16);
    }
    [[nodiscard]] int number(size_t axis, int step) const {
        return (step + 16 * (static_cast<int>(base[axis]) - 16)) * (1 << shift[axis]);
    }
    /// The finest one that has room for a number.
    static LowScale of(const glm::ivec3& low, bool hasBase) {
        LowScale scale;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<size_t>(axis);
            const auto fits = [&] { return scale.stepOf(a, low[axis]) >= -16 && scale.stepOf(a, low[axis]) < 16; };
            for (uint32_t& shift = scale.shift[a]; shift <= kMostShift; ++shift) {
                const int base = (((low[axis] >> shift) + 8) >> 4) + 16;
                scale.base[a] = hasBase ? static_cast<uint32_t>(std::clamp(base, 0, 31)) : 16u;
                if (fits()) {
                    break;
                }
            }
        }
        return scale;
    }
};

/// A segment of a property that changes, as a record has it.
struct SegmentRecord {
    SegmentRecord(const PackedProperty& property, SegmentKnots own)
        : knots(std::move(own)), scale(LowScale::of(knots.low, property.path != ChannelPath::rotation)) {
        for (size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<int>(axis);
            steps[a] = scale.stepOf(axis, knots.low[a]);
            low[a] = scale.number(axis, steps[a]);
        }
        outer = knots.outerWidths(low);
        inner = knots.innerWidths();
    }
    [[nodiscard]] bool fits() const {
        return *std::max_element(outer.begin(), outer.end()) <= kMostWidth &&
               *std::max_element(inner.begin(), inner.end()) <= kMostWidth &&
               2 * bitsOf(outer) + bitsOf(inner) <= kMostPairBits;
    }

    SegmentKnots knots;
    LowScale scale;
    glm::ivec3 steps{0}, low{0};
    Widths outer{}, inner{};
};
std::vector<SegmentRecord> recordsOf(const PackedProperty& property) {
    std::vector<SegmentRecord> records;
    const uint32_t last = property.frames.back();
    for (uint32_t first = 0; first < last; first += kSegmentFrames) {
        records.emplace_back(property, knotsOf(property, first, std::min(first + kSegmentFrames, last)));
    }
    return records;
}

bool allFit(const std::vector<SegmentRecord>& records) {
    return std::all_of(records.begin(), records.end(), [](const SegmentRecord& own) { return own.fits(); });
}

class ClipWriter {
public:
    ClipWriter(const PackedClip& clip, const PackedPlaces& places) : clip_(clip) {
        for (const PackedProperty& property : clip.properties) {
            (property.isConstant ? constants_ : animated_).push_back(&property);
        }
        sections_ = Sections(places.count(), constants_.size(), animated_.size(), clip.last);
    }

    std::optional<std::vector<uint32_t>> write(double duration) {
        const double rate = rateOf(clip_.last, duration);
        if (animated_.size() > 0xFFFF || constants_.size() > 0xFFFF || !isRate(rate) ||
            !std::all_of(clip_.properties.begin(), clip_.properties.end(), valuesFit)) {
            return std::nullopt;
        }
        for (const PackedProperty* const property : animated_) {
            if (!allFit(records_.emplace_back(recordsOf(*property)))) {
                return std::nullopt;
            }
        }
        const SplitTime split = splitTime(rate);
        words_.assign(4 * sections_.data, 0u);
        words_[0] = bits(split.high);
        words_[9] = bits(split.low);
        words_[1] = clip_.last;
        words_[2] = static_cast<uint32_t>(animated_.size()) | static_cast<uint32_t>(constants_.size()) << 16;
        words_[3] = segmentsOf(clip_.last);
        const size_t sections[] = {sections_.masks, sections_.constantsBegin, sections_.segments};
        std::transform(std::begin(sections), std::end(sections), words_.begin() + 4,
                       [](size_t at) { return static_cast<uint32_t>(at); });
        putMasks();
        putConstants();
        for (uint32_t segment = 0; segment < segmentsOf(clip_.last); ++segment) {
            if (!putSegment(segment)) {
                return std::nullopt;
            }
        }
        words_.insert(words_.end(), 4 * size_t{kPackedPadding}, 0u);
        return std::move(words_);
    }

private:
    [[nodiscard]] uint32_t& word(size_t element, size_t i) { return words_[4 * element + i]; }

    void putMasks() {
        for (const PackedProperty& property : clip_.properties) {
            const MaskBits half = maskOf(property);
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

    void putConstants() {
        for (size_t i = 0; i < constants_.size(); ++i) {
            const PackedProperty& own = *constants_[i];
            const glm::uvec3 v = glm::uvec3(own.values.front()) & kLow20;
            uint32_t* const two = &words_[4 * sections_.constantsBegin + 2 * i];
            two[0] = v.x | v.y << 20;
            two[1] = v.y >> 12 | v.z << 8 | static_cast<uint32_t>(kMostConstantExponent - own.exponent) / 2 << 28;
        }
    }

    bool putSegment(uint32_t segment) {
        const size_t record = sections_.records + segment * animated_.size();
        const auto data = static_cast<uint32_t>(words_.size() / 4);
        BitWriter numbers;
        for (size_t i = 0; i < animated_.size(); ++i) {
            if (numbers.length() >= kMostDataBits) {
                return false;
            }
            putRecord(*animated_[i], records_[i][segment], record + i, numbers);
        }
        const uint32_t own[] = {static_cast<uint32_t>(record), data,
                                std::min(kSegmentFrames, clip_.last - segment * kSegmentFrames), 0u};
        std::copy(std::begin(own), std::end(own), &words_[4 * (sections_.segments + segment)]);
        const std::vector<uint32_t>& whole = numbers.whole();
        words_.insert(words_.end(), whole.begin(), whole.end());
        return words_.size() < UINT32_MAX;
    }

    void putRecord(const PackedProperty& property, const SegmentRecord& record, size_t element, BitWriter& data) {
        const SegmentKnots& own = record.knots;
        const Widths& base = property.path == ChannelPath::rotation ? property.reference : record.scale.base;
        const auto offset = static_cast<uint32_t>(data.length());
        uint32_t* const words = &words_[4 * element];
        words[0] = own.mask();
        words[1] = static_cast<uint32_t>(property.exponent - kLeastExponent) << 27;
        words[2] = offset << 30;
        words[3] = offset >> 2 << 15;
        for (uint32_t axis = 0; axis < 3; ++axis) {
            words[1] |= base[axis] << 5 * axis | record.scale.shift[axis] << (15 + 4 * axis);
            words[2] |= record.outer[axis] << 5 * axis | record.inner[axis] << (15 + 5 * axis);
            words[3] |= (static_cast<uint32_t>(record.steps[static_cast<int>(axis)]) & 31u) << 5 * axis;
        }
        const auto put = [&](const glm::ivec3& numbers, const Widths& widths) {
            for (uint32_t axis = 0; axis < 3; ++axis) {
                data.put(static_cast<uint32_t>(numbers[static_cast<int>(axis)]), widths[axis]);
            }
        };
        auto off = own.offs.begin();
        for (size_t k = 0; k < own.values.size(); ++k) {
            if (isOuter(k, own.last())) {
                put(own.values[k] - record.low, record.outer);
            } else {
                put(*off++ + halvesOf(record.inner), record.inner);
            }
        }
    }

    const PackedClip& clip_;
    std::vector<const PackedProperty*> animated_, constants_;
    std::vector<std::vector<SegmentRecord>> records_; ///< of those that are animated, by segment
    Sections sections_{0, 0, 0, 1};
    std::vector<uint32_t> words_;
};

class ClipReader {
public:
    ClipReader(std::span<const uint32_t> words, const PackedPlaces& places) : words_(words), places_(places) {}

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
        sections_ = Sections(places_.count(), constants, animated, clip_.last);
        const double rate = rateOf(clip_.last, duration);
        if (!isRate(rate)) {
            return refuse("a packed clip of no sound rate");
        }
        const SplitTime split = splitTime(rate);
        const bool sound = words_[0] == bits(split.high) && words_[9] == bits(split.low) &&
                           words_[3] == segmentsOf(clip_.last) && words_[4] == sections_.masks &&
                           words_[5] == sections_.constantsBegin && words_[6] == sections_.segments && words_[7] == 0 &&
                           words_[8] == 0 && words_[10] == 0 && words_[11] == 0;
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
                    const bool isThere = place < places_.nodes || (place < places_.count() && path == 0);
                    if ((moves || stands) && (!isThere || (moves && stands))) {
                        return refuse("a packed clip of a node that is not there, or twice");
                    }
                    if (moves || stands) {
                        PackedProperty& own = clip_.properties.emplace_back();
                        own.place = static_cast<uint32_t>(place);
                        own.path = place < places_.nodes ? static_cast<ChannelPath>(path) : ChannelPath::weights;
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
        size_t constant = 0;
        for (PackedProperty& own : clip_.properties) {
            if (own.isConstant) {
                const uint32_t* const two = &words_[4 * sections_.constantsBegin + 2 * constant++];
                own.exponent = kMostConstantExponent - 2 * static_cast<int>(two[1] >> 28);
                own.values = {
                    {signExtended(two[0]), signExtended(two[0] >> 20 | two[1] << 12), signExtended(two[1] >> 8)}};
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
                if (!readRecord(*changing[i], record + i, {first, first + frames}, begin, length)) {
                    return false;
                }
            }
            begin += (length + 127) / 128;
        }
        return begin + kPackedPadding == words_.size() / 4 ||
               refuse("a packed clip that is longer or shorter than its segments");
    }

    struct Record {
        uint32_t mask = 0, offset = 0;
        int exponent = 0;
        Widths reference{}, outer{}, inner{};
        glm::ivec3 low{0};
    };
    [[nodiscard]] Record recordAt(size_t element, bool isRotation) const {
        const uint32_t* const words = &words_[4 * element];
        Record record;
        record.mask = words[0];
        record.offset = words[2] >> 30 | words[3] >> 15 << 2;
        record.exponent = static_cast<int>(words[1] >> 27) + kLeastExponent;
        LowScale scale;
        for (uint32_t axis = 0; axis < 3; ++axis) {
            record.reference[axis] = isRotation ? words[1] >> 5 * axis & 31u : 15u;
            scale.base[axis] = isRotation ? 16u : words[1] >> 5 * axis & 31u;
            scale.shift[axis] = words[1] >> (15 + 4 * axis) & 15u;
            record.outer[axis] = words[2] >> 5 * axis & 31u;
            record.inner[axis] = words[2] >> (15 + 5 * axis) & 31u;
            const int step = static_cast<int>((words[3] >> 5 * axis & 31u) ^ 16u) - 16;
            record.low[static_cast<int>(axis)] = scale.number(axis, step);
        }
        return record;
    }
    /// `segment`: its first frame and its last one. `length`: bits of its data so far.
    bool readRecord(PackedProperty& own, size_t element, std::pair<uint32_t, uint32_t> segment, size_t begin,
                    size_t& length) {
        const Record record = recordAt(element, own.path == ChannelPath::rotation);
        if (own.frames.empty()) {
            own.exponent = record.exponent;
            own.reference = record.reference;
        } else if (own.exponent != record.exponent || own.reference != record.reference) {
            return refuse("a packed clip whose segments have other steps");
        }
        const uint32_t frames = segment.second - segment.first;
        const uint32_t outer = bitsOf(record.outer), inner = bitsOf(record.inner);
        const bool sound = (record.mask & 1u) != 0 && (frames == 32 || record.mask >> frames == 0) &&
                           record.offset == length &&
                           *std::max_element(record.outer.begin(), record.outer.end()) <= kMostWidth &&
                           *std::max_element(record.inner.begin(), record.inner.end()) <= kMostWidth &&
                           2 * outer + inner <= kMostPairBits;
        const auto last = static_cast<size_t>(std::popcount(record.mask));
        const size_t taken = (last / 2 + 1 + last % 2) * outer + last / 2 * inner;
        // Equal values need no knots in between: what is read stays in proportion to its words.
        if (!sound || (taken == 0 && record.mask != 1) ||
            begin + (length + taken + 127) / 128 + kPackedPadding > words_.size() / 4) {
            return refuse("a record of a packed clip that does not fit");
        }
        std::vector<uint32_t> knots;
        for (uint32_t frame = 0; frame < frames; ++frame) {
            if ((record.mask >> frame & 1u) != 0) {
                knots.push_back(segment.first + frame);
            }
        }
        knots.push_back(segment.second);
        return takeKnots(own, knots, readNumbers(record, knots, words_.subspan(4 * begin), length));
    }
    static std::vector<glm::ivec3> readNumbers(const Record& record, std::span<const uint32_t> knots,
                                               std::span<const uint32_t> data, size_t& length) {
        std::vector<glm::ivec3> numbers;
        for (size_t k = 0; k < knots.size(); ++k) {
            const bool isInner = !isOuter(k, knots.size() - 1);
            const Widths& widths = isInner ? record.inner : record.outer;
            glm::ivec3& number = numbers.emplace_back(isInner ? -halvesOf(widths) : record.low);
            for (int axis = 0; axis < 3; ++axis) {
                number[axis] += static_cast<int>(bitsAt(data, length, widths[static_cast<size_t>(axis)]));
                length += widths[static_cast<size_t>(axis)];
            }
        }
        for (size_t k = 1; k + 1 < knots.size(); k += 2) {
            numbers[k] += lineAt({knots[k - 1], knots[k], knots[k + 1]}, numbers[k - 1], numbers[k + 1]);
        }
        return numbers;
    }
    bool takeKnots(PackedProperty& own, std::span<const uint32_t> frames, std::span<const glm::ivec3> values) {
        if (!std::all_of(values.begin(), values.end(), fits)) {
            return refuse("a number of a packed clip that is too large");
        }
        if (!own.frames.empty()) { // the border of two segments: both have it
            if (own.values.back() != values.front()) {
                return refuse("a packed clip that jumps between two segments");
            }
            frames = frames.subspan(1);
            values = values.subspan(1);
        }
        own.frames.insert(own.frames.end(), frames.begin(), frames.end());
        own.values.insert(own.values.end(), values.begin(), values.end());
        return true;
    }

    std::span<const uint32_t> words_;
    PackedPlaces places_;
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
    return fromQuarterTangent((glm::dvec3(reference[0], reference[1], reference[2]) - 15.0) / 15.0);
}

std::array<uint32_t, 3> referenceNear(const glm::dquat& rotation) {
    const glm::dvec3 r = glm::round(toQuarterTangent(rotation) * 15.0) + 15.0;
    return {static_cast<uint32_t>(r.x), static_cast<uint32_t>(r.y), static_cast<uint32_t>(r.z)};
}

bool fitsLayout(const PackedProperty& property) {
    return valuesFit(property) && (property.isConstant || allFit(recordsOf(property)));
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

std::optional<std::vector<uint32_t>> packedWords(const PackedClip& clip, double duration, const PackedPlaces& places) {
    return ClipWriter(clip, places).write(duration);
}

Result<PackedClip> readPackedWords(std::span<const uint32_t> words, double duration, const PackedPlaces& places) {
    return ClipReader(words, places).read(duration);
}

std::vector<SegmentPlaces> segmentsIn(std::span<const uint32_t> words) {
    const uint32_t animated = words[2] & 0xFFFFu, count = words[3];
    const std::span<const uint32_t> elements = words.subspan(4 * size_t{words[6]});
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

std::vector<cage::Channel> channelsOf(const PackedClip& clip, double duration, std::span<const uint32_t> nodes,
                                      size_t targets) {
    std::vector<cage::Channel> channels;
    for (const PackedProperty& property : clip.properties) {
        cage::Channel& channel = channels.emplace_back();
        channel.path = property.path;
        size_t width = 3;
        if (property.path == ChannelPath::weights) {
            channel.firstTarget = 3 * (property.place - static_cast<uint32_t>(nodes.size()));
            width = std::min<size_t>(width, targets - channel.firstTarget);
        } else {
            channel.node = nodes[property.place];
        }
        const bool turns = property.path == ChannelPath::rotation;
        const glm::dquat reference =
            turns && !property.isConstant ? referenceTurn(property.reference) : glm::dquat(1, 0, 0, 0);
        for (size_t k = 0; k < property.values.size(); ++k) {
            const double part = property.isConstant ? 0.0 : static_cast<double>(property.frames[k]) / clip.last;
            channel.times.push_back(static_cast<float>(duration * part));
            const glm::dvec3 v = glm::dvec3(property.values[k]) * std::ldexp(1.0, -property.exponent);
            const glm::vec4 value = turns ? floatsOf(reference * fromQuarterTangent(v)) : glm::vec4(v, 0.0);
            for (size_t axis = 0; axis < (turns ? 4 : width); ++axis) {
                channel.values.push_back(value[static_cast<int>(axis)]);
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
