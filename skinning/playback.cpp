#include "skinning/playback.h"

#include "skinning/bits.h"
#include "skinning/pose.h"
#include "skinning/rotation.h"
#include "skinning/split_time.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace supple::skinning {
namespace {

using namespace shared;

static_assert(uint32_t{kRootGround} == kGroundAxes && uint32_t{kRootHeight} == kHeightAxis &&
              uint32_t{kRootYaw} == kYawAxis);

constexpr uint32_t kModifierCountBits = 31u << kStateModifierShift;
static_assert(kMaxModifiers < 32);
/// Flags that stay whatever plays.
constexpr uint32_t kNotPlayed = kStateHostWeights | kModifierCountBits;

/// The time of the clip at `start`. Of a loop without the whole loops in it: the device's floats could not tell more
/// than 2^24 of them apart.
double beginOf(const cage::Character& character, const PlaybackLayer& layer) {
    return layer.loop ? loopTime(layer.offset, character.clips[layer.clip].duration).time : layer.offset;
}

/// Where the morph targets begin in a run of the masks.
size_t firstTarget(const ClipTable& table) {
    return (table.nodes.size() + 3) / 4 * 4;
}

} // namespace

uint32_t PlaybackState::elements(uint32_t morphCount, uint32_t modifierCount) {
    return modifiersBegin(morphCount) + modifierCount * kModifierElements;
}

void PlaybackState::put(uint32_t element, float x, float y, float z, float w) {
    const std::array<uint32_t, 4> values = {bits(x), bits(y), bits(z), bits(w)};
    std::copy(values.begin(), values.end(), words_.begin() + static_cast<ptrdiff_t>(4 * size_t{element}));
}

void PlaybackState::setBindPose() {
    words_[0] = 0;
    words_[1] = (words_[1] & kNotPlayed) | kStateBindPose;
    words_[2] = kNoNode;
    words_[3] = 0;
}

void PlaybackState::set(const cage::Character& character, const ClipTable& table, const PlaybackDesc& desc) {
    assert(desc.layers.size() <= kMaxPlaybackLayers);
    const bool rooted = desc.root.axes != 0 && desc.root.node != cage::kNone;
    const bool travels = desc.travels && rooted && !desc.layers.empty();
    words_[0] = static_cast<uint32_t>(desc.layers.size());
    words_[1] = (words_[1] & kNotPlayed) | (travels ? kStateTravels : 0u);
    words_[2] = rooted ? table.places[desc.root.node] : kNoNode;
    words_[3] = rooted ? desc.root.axes : 0;
    for (uint32_t i = 0; i < desc.layers.size(); ++i) {
        const PlaybackLayer& layer = desc.layers[i];
        const uint32_t first = kStateElements + i * kLayerElements;
        const std::array<uint32_t, 4> ids = {
            layer.clip, (layer.loop ? kLayerLoops : 0u) | (layer.mode == LayerMode::additive ? kLayerAdds : 0u),
            layer.mask, 0u};
        std::copy(ids.begin(), ids.end(), words_.begin() + static_cast<ptrdiff_t>(4 * size_t{first}));
        const SplitTime start = splitTime(layer.start), offset = splitTime(beginOf(character, layer)),
                        fade = splitTime(layer.fadeStart), reference = splitTime(layer.referenceTime);
        put(first + 1, start.high, start.low, offset.high, offset.low);
        put(first + 2, layer.speed, layer.weight, layer.fadeWeight, layer.fadeDuration);
        put(first + 3, fade.high, fade.low, reference.high, reference.low);
        if (rooted) {
            const RootPlace begin = rootPlaceAt(character, character.clips[layer.clip], desc.root.node, 0.0);
            const glm::vec3 p(begin.position);
            const glm::dquat& q = begin.rotation;
            put(first + 4, p.x, p.y, p.z, 0.0f);
            put(first + 5, static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
                static_cast<float>(q.w));
        }
    }
    if (travels) {
        setTravel(character, desc.layers.front(), desc.root);
    }
}

void PlaybackState::setTravel(const cage::Character& character, const PlaybackLayer& layer, const RootSelection& root) {
    const cage::Clip& clip = character.clips[layer.clip];
    const RootMotion back = inverse(rootMotionBetween(character, clip, root, 0.0, beginOf(character, layer), false));
    put(4, static_cast<float>(back.translation.x), static_cast<float>(back.translation.y),
        static_cast<float>(back.translation.z), 0.0f);
    const RootMotion loop = rootMotionBetween(character, clip, root, 0.0, clip.duration, false);
    // What turns by less than this walks straight on for longer than floats count loops.
    constexpr double kStraight = 1e-9;
    const bool straight = std::abs(loop.yaw) < kStraight;
    const SplitTime turns = splitTime(straight ? 0.0 : loop.yaw / (2.0 * kTurn));
    put(5, static_cast<float>(std::sin(0.5 * back.yaw)), static_cast<float>(std::cos(0.5 * back.yaw)), turns.high,
        turns.low);
    glm::dvec3 center = loop.translation;
    if (!straight) {
        // The point on the ground that the loop turns about: c = R c + translation.
        const double half = 0.5 * std::cos(0.5 * loop.yaw) / std::sin(0.5 * loop.yaw);
        const double x = loop.translation.x, z = loop.translation.z;
        center = {0.5 * x + half * z, loop.translation.y, 0.5 * z - half * x};
    }
    put(6, static_cast<float>(center.x), static_cast<float>(center.y), static_cast<float>(center.z),
        straight ? 1.0f : 0.0f);
}

void PlaybackState::setTransform(const glm::mat4& transform) {
    const Affine rows = toAffine(transform);
    for (uint32_t row = 0; row < 3; ++row) {
        const glm::vec4& r = rows.rows[row];
        put(1 + row, r.x, r.y, r.z, r.w);
    }
}

void PlaybackState::setMorphWeights(const float* weights, size_t count) {
    words_[1] = (words_[1] & ~kStateHostWeights) | (weights != nullptr ? kStateHostWeights : 0u);
    const size_t first = 4 * size_t{kStateElements + kMaxPlaybackLayers * kLayerElements};
    for (size_t i = 0; weights != nullptr && i < count; ++i) {
        words_[first + i] = bits(weights[i]);
    }
}

void PlaybackState::setModifierCount(uint32_t count) {
    words_[1] = (words_[1] & ~kModifierCountBits) | count << kStateModifierShift;
}

uint32_t PlaybackState::modifierCount() const {
    return (words_[1] & kModifierCountBits) >> kStateModifierShift;
}

void PlaybackState::setInTransition(bool isInIt) {
    words_[1] = (words_[1] & ~kStateTransition) | (isInIt ? kStateTransition : 0u);
}

bool PlaybackState::isInTransition() const {
    return (words_[1] & kStateTransition) != 0;
}

std::span<uint32_t> PlaybackState::modifier(uint32_t morphCount, uint32_t index) const {
    return words_.subspan(4 * size_t{elements(morphCount, index)}, 4 * size_t{kModifierElements});
}

const float* PlaybackState::morphWeights() const {
    static_assert(sizeof(float) == sizeof(uint32_t));
    const size_t first = 4 * size_t{kStateElements + kMaxPlaybackLayers * kLayerElements};
    return (words_[1] & kStateHostWeights) != 0 ? reinterpret_cast<const float*>(&words_[first]) : nullptr;
}

glm::vec4 PlaybackState::floats(uint32_t element) const {
    glm::vec4 values;
    for (uint32_t i = 0; i < 4; ++i) {
        values[static_cast<int>(i)] = std::bit_cast<float>(words_[4 * size_t{element} + i]);
    }
    return values;
}

bool PlaybackState::inBindPose() const {
    return (words_[1] & kStateBindPose) != 0;
}

glm::mat4 PlaybackState::transform() const {
    return glm::transpose(glm::mat4(floats(1), floats(2), floats(3), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)));
}

void PlaybackState::nameMasksBefore() {
    for (uint32_t i = 0; i < words_[0]; ++i) {
        uint32_t& mask = words_[4 * size_t{kStateElements + i * kLayerElements} + 2];
        mask += mask != 0 ? kMaxMasks : 0;
    }
}

PlaybackDesc PlaybackState::read(const ClipTable& table, Layers& layers) const {
    for (uint32_t i = 0; i < words_[0]; ++i) {
        const uint32_t first = kStateElements + i * kLayerElements;
        const uint32_t* const ids = &words_[4 * size_t{first}];
        const glm::vec4 begin = floats(first + 1), course = floats(first + 2), fade = floats(first + 3);
        PlaybackLayer& layer = layers[i];
        layer.clip = ids[0];
        layer.loop = (ids[1] & kLayerLoops) != 0;
        layer.mode = (ids[1] & kLayerAdds) != 0 ? LayerMode::additive : LayerMode::blend;
        layer.mask = ids[2];
        layer.start = joinedTime(begin.x, begin.y);
        layer.offset = joinedTime(begin.z, begin.w);
        layer.speed = course.x;
        layer.weight = course.y;
        layer.fadeWeight = course.z;
        layer.fadeDuration = course.w;
        layer.fadeStart = joinedTime(fade.x, fade.y);
        layer.referenceTime = joinedTime(fade.z, fade.w);
    }
    PlaybackDesc desc;
    desc.layers = {layers.data(), words_[0]};
    desc.root = {words_[2] == kNoNode ? cage::kNone : table.nodes[words_[2]], words_[3]};
    desc.travels = (words_[1] & kStateTravels) != 0;
    return desc;
}

std::span<const float> morphMaskOf(const ClipTable& table, std::span<const float> values) {
    return values.subspan(firstTarget(table), table.targetCount);
}

uint32_t maskElements(const ClipTable& table) {
    return static_cast<uint32_t>((table.nodes.size() + 3) / 4 + (table.targetCount + 3) / 4);
}

void writeMask(const ClipTable& table, const Rig& rig, std::span<const float> jointMask,
               std::span<const float> morphMask, std::span<float> values) {
    for (size_t place = 0; place < table.nodes.size(); ++place) {
        const uint32_t joint = rig.maskJoints[table.nodes[place]];
        values[place] = jointMask.empty() || joint == cage::kNone ? 1.0f : jointMask[joint];
    }
    const std::span<float> targets = values.subspan(firstTarget(table));
    for (size_t target = 0; target < table.targetCount; ++target) {
        targets[target] = !morphMask.empty() ? morphMask[target] : jointMask.empty() ? 1.0f : 0.0f;
    }
}

} // namespace supple::skinning
