#include "skinning/clip_table.h"

#include "shaders/shared/pose.h"
#include "skinning/bits.h"
#include "skinning/contacts.h"
#include "skinning/driver_table.h"
#include "skinning/packed_clip.h"
#include "skinning/pose.h"
#include "skinning/rotation.h"
#include "skinning/soft_nodes.h"
#include "skinning/split_time.h"
#include "skinning/spring_table.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>

namespace supple::skinning {
namespace {

using namespace shared;
using cage::Channel;
using cage::ChannelPath;

uint32_t interpolationOf(const Channel& channel) {
    switch (channel.interpolation) {
    case cage::Interpolation::step:
        return kStepKeys;
    case cage::Interpolation::linear:
        return kLinearKeys;
    case cage::Interpolation::cubicSpline:
        return kCubicKeys;
    }
    return kStepKeys;
}

/// Puts the table together, element by element.
class Builder {
public:
    Builder(const cage::Character& character, ClipTable& table)
        : character_(character), table_(table), contacts_(findContacts(character)) {
        NodeOrder order = nodeOrder(character);
        table_.nodes = std::move(order.nodes);
        table_.places = std::move(order.places);
        levelEnds_ = std::move(order.levelEnds);
    }

    void putNodes() {
        const uint32_t nodesEnd = kNodeElements * static_cast<uint32_t>(table_.nodes.size());
        std::vector<glm::dquat> fixed;
        for (const uint32_t node : table_.nodes) {
            const cage::Node& from = character_.skeleton.nodes[node];
            const uint32_t rotation = from.hasMatrix ? nodesEnd + static_cast<uint32_t>(fixed.size()) : 0u;
            put({from.parent == cage::kNone ? kNoNode : table_.places[from.parent], from.hasMatrix ? kNodeFixed : 0u,
                 rotation, footNumber(node)});
            if (from.hasMatrix) {
                putRows(from.matrix);
                fixed.push_back(nearestRotation(glm::dmat3(glm::dmat4(from.matrix))));
            } else {
                const glm::vec3 &t = from.translation, &s = from.scale;
                const glm::quat& q = from.rotation;
                put({bits(t.x), bits(t.y), bits(t.z), 0u});
                put({bits(q.x), bits(q.y), bits(q.z), bits(q.w)});
                put({bits(s.x), bits(s.y), bits(s.z), 0u});
            }
        }
        for (const glm::dquat& q : fixed) {
            put({bits(static_cast<float>(q.x)), bits(static_cast<float>(q.y)), bits(static_cast<float>(q.z)),
                 bits(static_cast<float>(q.w))});
        }
    }

    void putSkin() {
        const cage::Skin& skin = character_.skin;
        table_.jointCount = static_cast<uint32_t>(skin.joints.size());
        table_.joints = next();
        for (size_t j = 0; j < skin.joints.size(); ++j) {
            putRows(skin.inverseBinds[j]);
            put({table_.places[skin.joints[j]], 0u, 0u, 0u});
        }
        table_.levels = next();
        table_.levelCount = static_cast<uint32_t>(levelEnds_.size());
        uint32_t begin = 0;
        for (const uint32_t end : levelEnds_) {
            put({begin, end, 0u, 0u});
            begin = end;
        }
        table_.targetCount = static_cast<uint32_t>(character_.morphs.targets.size());
        table_.restWeights = putPacked(character_.morphs.weights);
    }

    void putClips() {
        const std::vector<cage::Clip>& clips = character_.clips;
        table_.clips = next();
        table_.words.resize(table_.words.size() + 4 * clips.size(), 0u);
        for (size_t c = 0; c < clips.size(); ++c) {
            const cage::Clip& clip = clips[c];
            const uint32_t packed = clip.packed.words.empty()         ? 0
                                    : clip.packed.coarseWords.empty() ? putPackedClip(clip.packed.words)
                                                                      : putStreamedClip(c, clip.packed);
            const uint32_t nodes = packed == 0 || movesNodes(clip) ? putNodeChannels() : 0;
            const uint32_t weights = putChannels(clip, nodes);
            if (packed != 0) {
                table_.words[4 * size_t{packed + 2}] = nodes;
            }
            const SplitTime duration = splitTime(clip.duration);
            const uint32_t element[] = {packed != 0 ? kPackedClip | packed : nodes, weights, bits(duration.high),
                                        bits(duration.low)};
            std::copy(std::begin(element), std::end(element),
                      table_.words.begin() + static_cast<ptrdiff_t>(4 * (table_.clips + c)));
        }
    }

    void putContacts() {
        const size_t feet = contacts_.feet.size();
        table_.contacts = next();
        table_.footCount = static_cast<uint32_t>(feet);
        for (const Foot& foot : contacts_.feet) {
            put({table_.places[foot.node], floatBits(foot.height), floatBits(foot.sole), 0u});
            table_.longestLeg = std::max(table_.longestLeg, foot.leg);
        }
        uint32_t element = next() + static_cast<uint32_t>(contacts_.ofClips.size());
        for (const std::vector<Contact>& own : contacts_.ofClips) {
            const auto count = static_cast<uint32_t>(own.size());
            put({element, count, 0u, 0u});
            element += kContactElements * count;
        }
        for (const std::vector<Contact>& own : contacts_.ofClips) {
            for (const Contact& contact : own) {
                constexpr double kHold = 0.1, kHoldOf = 0.25; // seconds; of the contact
                const double hold = std::min(kHold, kHoldOf * (contact.end - contact.begin));
                put({floatBits(contact.place.x), floatBits(contact.place.y), floatBits(contact.drift.x),
                     floatBits(contact.drift.y)});
                put({floatBits(contact.begin), floatBits(contact.end), floatBits(1.0 / std::max(hold, 1e-6)), 0u});
            }
        }
    }

    /// Those of clips with a twin: behind everything else.
    void putSegments() {
        table_.segments = next();
        for (const StreamedClip& own : table_.streamedClips) {
            const std::span<const uint32_t> words = character_.clips[own.clip].packed.words;
            const std::vector<SegmentPlaces> segments = segmentsIn(words);
            for (uint32_t s = 0; s < own.segmentCount; ++s) {
                const SegmentPlaces& from = segments[s];
                StreamedSegment& to = table_.streamedSegments[own.firstSegment + s];
                to.records = putElements(words, from.records, from.recordsEnd);
                to.data = putElements(words, from.data, from.dataEnd);
                to.end = next();
                uint32_t* const element = &table_.words[4 * size_t{to.element}];
                element[0] = to.records;
                element[1] = to.data;
            }
        }
        if (!table_.streamedClips.empty()) {
            table_.words.resize(table_.words.size() + 4 * size_t{kPackedPadding}, 0u);
        }
    }

private:
    static uint32_t floatBits(double x) { return bits(static_cast<float>(std::clamp(x, -1e30, 1e30))); }
    [[nodiscard]] uint32_t footNumber(uint32_t node) const {
        const std::vector<Foot>& feet = contacts_.feet;
        const auto found = std::find_if(feet.begin(), feet.end(), [&](const Foot& foot) { return foot.node == node; });
        return found != feet.end() ? 1u + static_cast<uint32_t>(found - feet.begin()) : 0u;
    }

    static_assert(static_cast<int>(ChannelPath::translation) == 0 && static_cast<int>(ChannelPath::rotation) == 1 &&
                  static_cast<int>(ChannelPath::scale) == 2);

    [[nodiscard]] uint32_t next() const { return static_cast<uint32_t>(table_.words.size() / 4); }
    void put(const std::array<uint32_t, 4>& element) {
        table_.words.insert(table_.words.end(), element.begin(), element.end());
    }
    /// Elements of a packed clip as they are; where they now begin.
    uint32_t putElements(std::span<const uint32_t> words, uint32_t first, uint32_t end) {
        const uint32_t begin = next();
        const std::span<const uint32_t> own = words.subspan(size_t{4} * first, size_t{4} * (end - first));
        table_.words.insert(table_.words.end(), own.begin(), own.end());
        return begin;
    }
    void putRows(const glm::mat4& matrix) {
        for (const glm::vec4& row : toAffine(matrix).rows) {
            put({bits(row.x), bits(row.y), bits(row.z), bits(row.w)});
        }
    }
    uint32_t putPacked(std::span<const float> values) {
        const uint32_t first = next();
        std::transform(values.begin(), values.end(), std::back_inserter(table_.words), bits);
        table_.words.resize((table_.words.size() + 3) / 4 * 4, 0u);
        return first;
    }
    /// An element per node: no channel moves it yet.
    uint32_t putNodeChannels() {
        const uint32_t first = next();
        table_.words.resize(table_.words.size() + 4 * table_.nodes.size(), 0u);
        return first;
    }
    /// Whether a packed clip has channels of nodes beside what is packed.
    [[nodiscard]] bool movesNodes(const cage::Clip& clip) const {
        return std::any_of(
            clip.channels.begin() + clip.packed.channelCount, clip.channels.end(), [&](const Channel& channel) {
                return channel.path != ChannelPath::weights && table_.places[channel.node] != cage::kNone;
            });
    }
    /// The channels that are not packed; returns the first element of the morph targets, or 0.
    uint32_t putChannels(const cage::Clip& clip, uint32_t nodes) {
        uint32_t weights = 0;
        for (size_t c = clip.packed.channelCount; c < clip.channels.size(); ++c) {
            const Channel& channel = clip.channels[c];
            if (channel.path == ChannelPath::weights) {
                weights = weights == 0 ? putTargets() : weights;
                putWeights(channel, weights);
            } else if (const uint32_t place = table_.places[channel.node]; place != cage::kNone) {
                // If several channels have one property, the last one counts, as in sampleClip.
                const uint32_t record = putChannel(channel, channel.path == ChannelPath::rotation ? 4 : 3);
                table_.words[4 * size_t{nodes + place} + static_cast<size_t>(channel.path)] = record;
            }
        }
        return weights;
    }
    /// Words whose offsets count from their first element.
    uint32_t putPackedClip(std::span<const uint32_t> words) {
        const uint32_t first = putHead(words, words.size());
        const auto move = [&](size_t word) { table_.words[4 * size_t{first} + word] += first; };
        for (uint32_t segment = 0; segment < words[3]; ++segment) {
            move(4 * size_t{words[6] + segment});
            move(4 * size_t{words[6] + segment} + 1);
        }
        return first;
    }
    /// The first of the words, `count` of them, with the sections of the head in the table.
    uint32_t putHead(std::span<const uint32_t> words, size_t count) {
        const uint32_t first = next();
        table_.words.insert(table_.words.end(), words.begin(), words.begin() + static_cast<ptrdiff_t>(count));
        for (size_t section = 4; section < 7; ++section) {
            table_.words[4 * size_t{first} + section] += first;
        }
        return first;
    }
    /// A clip whose segments putSegments() puts, and its twin behind it.
    uint32_t putStreamedClip(size_t clip, const cage::PackedChannels& packed) {
        const std::vector<SegmentPlaces> segments = segmentsIn(packed.words);
        const uint32_t first = putHead(packed.words, 4 * size_t{segments.front().records});
        const uint32_t twin = putPackedClip(packed.coarseWords);
        table_.streamedClips.push_back({static_cast<uint32_t>(clip), twin, packed.words[1],
                                        static_cast<uint32_t>(table_.streamedSegments.size()), packed.words[3]});
        for (uint32_t s = 0; s < packed.words[3]; ++s) {
            table_.streamedSegments.push_back({first + packed.words[6] + s});
        }
        return first;
    }
    /// An element per morph target, for putWeights(): no channel moves it yet.
    uint32_t putTargets() {
        const uint32_t first = next();
        table_.words.resize(table_.words.size() + 4 * table_.targetCount, 0u);
        return first;
    }
    void putWeights(const Channel& channel, uint32_t targets) {
        const auto width = static_cast<uint32_t>(channel.width());
        const uint32_t record = putChannel(channel, width);
        for (uint32_t target = 0; target < width; ++target) {
            const uint32_t element[] = {record, target, width, 0u};
            std::copy(std::begin(element), std::end(element),
                      table_.words.begin() +
                          static_cast<ptrdiff_t>(4 * size_t{targets + channel.firstTarget + target}));
        }
    }
    /// `width`: floats a value; four and three have an element each, others (morph weights) are packed.
    uint32_t putChannel(const Channel& channel, uint32_t width) {
        uint32_t& times = times_[channel.times];
        if (times == 0) { // many channels have the same; no element 0 is one of them
            times = putPacked(channel.times);
        }
        uint32_t values = 0;
        if (channel.path == ChannelPath::weights) {
            values = putPacked(channel.values);
        } else {
            values = next();
            for (size_t i = 0; i < channel.values.size(); i += width) {
                const float* v = &channel.values[i];
                put({bits(v[0]), bits(v[1]), bits(v[2]), width == 4 ? bits(v[3]) : 0u});
            }
        }
        const uint32_t record = next();
        const auto keys = static_cast<uint32_t>(channel.times.size());
        const float last = channel.times.back();
        const float rate = keys > 1 && last > 0.0f ? static_cast<float>(keys - 1) / last : 0.0f;
        put({4 * keys + interpolationOf(channel), bits(rate), times, values});
        return record;
    }

    const cage::Character& character_;
    ClipTable& table_;
    Contacts contacts_;
    std::vector<uint32_t> levelEnds_;
    std::map<std::vector<float>, uint32_t> times_; ///< element of key times already put
};

} // namespace

uint32_t ClipTable::footPlace(uint32_t number) const {
    return words[4 * size_t{contacts + number}];
}

uint32_t ClipTable::footNumber(uint32_t place) const {
    return words[4 * size_t{kNodeElements * place} + 3] - 1;
}

NodeOrder nodeOrder(const cage::Character& character) {
    const cage::Skeleton& skeleton = character.skeleton;
    std::vector<bool> moves(skeleton.nodes.size(), false);
    const auto take = [&](uint32_t node) {
        for (; node != cage::kNone && !moves[node]; node = skeleton.nodes[node].parent) {
            moves[node] = true;
        }
    };
    for (const uint32_t joint : character.skin.joints) {
        take(joint);
    }
    for (const cage::PoseDriver& driver : character.drivers) {
        for (const cage::DriverInput& input : driver.inputs) {
            take(input.node);
        }
    }
    NodeOrder order;
    order.targetCount = static_cast<uint32_t>(character.morphs.targets.size());
    std::vector<uint32_t> depths(skeleton.nodes.size(), 0);
    for (const uint32_t node : skeleton.parentsFirst) {
        const uint32_t parent = skeleton.nodes[node].parent;
        depths[node] = parent == cage::kNone ? 0 : depths[parent] + 1;
        if (moves[node]) {
            order.nodes.push_back(node);
        }
    }
    std::stable_sort(order.nodes.begin(), order.nodes.end(),
                     [&](uint32_t a, uint32_t b) { return depths[a] < depths[b]; });
    order.places.assign(skeleton.nodes.size(), cage::kNone);
    for (uint32_t place = 0; place < order.nodes.size(); ++place) {
        order.places[order.nodes[place]] = place;
        const uint32_t depth = depths[order.nodes[place]];
        order.levelEnds.resize(depth + 1);
        order.levelEnds[depth] = place + 1;
    }
    return order;
}

ClipKinds clipKinds(const cage::Character& character) {
    ClipKinds kinds;
    for (const cage::Clip& clip : character.clips) {
        kinds.keyed = kinds.keyed || clip.packed.channelCount < clip.channels.size();
        kinds.packed = kinds.packed || !clip.packed.words.empty();
        kinds.coarse = kinds.coarse || !clip.packed.coarseWords.empty();
    }
    return kinds;
}

size_t clipBytes(const NodeOrder& order, const cage::Clip& clip) {
    constexpr size_t kElement = 16;
    size_t elements = 1, words = clip.packed.words.size() + clip.packed.coarseWords.size();
    bool moves = clip.packed.words.empty(), morphs = false;
    std::set<std::vector<float>> times;
    for (size_t c = clip.packed.channelCount; c < clip.channels.size(); ++c) {
        const Channel& channel = clip.channels[c];
        const bool weights = channel.path == ChannelPath::weights;
        if (weights || order.places[channel.node] != cage::kNone) {
            elements += 1 + (weights ? (channel.values.size() + 3) / 4 : channel.values.size() / channel.width());
            words += times.insert(channel.times).second ? channel.times.size() : 0;
            moves = moves || !weights;
            morphs = morphs || weights;
        }
    }
    return kElement * (elements + (moves ? order.nodes.size() : 0) + (morphs ? order.targetCount : 0)) +
           sizeof(uint32_t) * words;
}

bool ClipTable::isFoot(uint32_t node) const {
    const uint32_t place = places[node];
    return place != cage::kNone && words[4 * size_t{kNodeElements * place} + 3] != 0;
}

ClipTable buildClipTable(const cage::Character& character) {
    ClipTable table;
    Builder builder(character, table);
    builder.putNodes();
    builder.putSkin();
    builder.putClips();
    builder.putContacts();
    putSprings(character, table);
    putDrivers(character, table);
    markSoftNodes(character, table);
    builder.putSegments();
    return table;
}

} // namespace supple::skinning
