#include "skinning/modifiers.h"

#include "skinning/bits.h"
#include "skinning/pose.h"
#include "skinning/rotation.h"
#include "skinning/split_time.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <vector>

namespace supple::skinning {
namespace {

using namespace shared;

void putElement(std::span<uint32_t> words, size_t element, const glm::vec4& v) {
    for (size_t i = 0; i < 4; ++i) {
        words[4 * element + i] = bits(v[static_cast<int>(i)]);
    }
}

/// From joints, the end first.
std::optional<Modifier> modifierOf(const cage::Character& character, std::span<const uint32_t> fromEnd) {
    Modifier modifier;
    modifier.chainLength = static_cast<uint32_t>(fromEnd.size());
    for (size_t i = 0; i < fromEnd.size(); ++i) {
        const uint32_t node = character.skin.joints[fromEnd[i]];
        if (character.skeleton.nodes[node].hasMatrix) {
            return std::nullopt;
        }
        modifier.chain[fromEnd.size() - 1 - i] = node;
    }
    return modifier;
}

/// Rest transforms in model space: where nodes are, and the rotation of all above and of themselves.
struct RestFrames {
    explicit RestFrames(const cage::Character& character) : globals(character.skeleton.nodes.size()) {
        restPose(character.skeleton, globals);
        globalTransforms(character.skeleton, globals, globals);
    }
    [[nodiscard]] glm::dvec3 position(uint32_t node) const { return glm::dvec3(globals[node][3]); }
    /// A direction of model space in the node's frame.
    [[nodiscard]] glm::vec3 within(uint32_t node, const glm::dvec3& direction) const {
        const glm::dquat turn = nearestRotation(glm::dmat3(glm::dmat4(globals[node])));
        return glm::vec3(glm::normalize(glm::conjugate(turn) * direction));
    }

    std::vector<glm::mat4> globals;
};

} // namespace

std::optional<Modifier> chainOf(const cage::Character& character, std::span<const uint32_t> jointParents,
                                uint32_t joint, uint32_t length) {
    assert(length >= 1 && length <= kMaxChain);
    std::vector<uint32_t> fromEnd;
    for (uint32_t own = joint; own != cage::kNone && fromEnd.size() < length; own = jointParents[own]) {
        fromEnd.push_back(own);
    }
    return fromEnd.size() == length ? modifierOf(character, fromEnd) : std::nullopt;
}

std::optional<Modifier> limbOf(const cage::Character& character, const Rig& rig, uint32_t joint) {
    const uint32_t parent = rig.jointParents[joint];
    if (parent == cage::kNone) {
        return std::nullopt;
    }
    // If all joints of a chain are called alike, each is a bone.
    if (rig.boneStarts[joint] != joint) {
        return chainOf(character, rig.jointParents, joint, 3);
    }
    const uint32_t middle = rig.boneStarts[parent], above = rig.jointParents[middle];
    return above != cage::kNone ? modifierOf(character, std::array{joint, middle, rig.boneStarts[above]})
                                : chainOf(character, rig.jointParents, joint, 3);
}

glm::vec3 restForward(const cage::Character& character, uint32_t node) {
    return RestFrames(character).within(node, {0.0, 0.0, 1.0});
}

glm::vec3 restHinge(const cage::Character& character, const Modifier& limb) {
    const RestFrames rest(character);
    const glm::dvec3 root = rest.position(limb.chain[0]), middle = rest.position(limb.chain[1]),
                     end = rest.position(limb.chain[2]);
    const glm::dvec3 upper = middle - root, lower = end - middle;
    glm::dvec3 hinge = glm::cross(upper, lower);
    constexpr double kStraight = 1e-2; // the sine of the bend
    if (glm::length(hinge) <= kStraight * glm::length(upper) * glm::length(lower)) {
        const glm::dvec3 along = end - root;
        const bool upright = std::abs(along.y) > 0.7 * glm::length(along);
        hinge = glm::cross(glm::dvec3(0.0, 0.0, upright ? 1.0 : -1.0), along);
        if (!(glm::length(hinge) > 1e-6 * glm::length(along))) {
            hinge = {1.0, 0.0, 0.0};
        }
    }
    return rest.within(limb.chain[1], hinge);
}

void writeModifier(const ClipTable& table, const Modifier& modifier, std::span<uint32_t> words) {
    std::fill(words.begin(), words.begin() + 4 * kModifierElements, 0u);
    words[0] = modifier.kind | modifier.flags << 8;
    ChainPlaces places{};
    for (uint32_t i = 0; i < modifier.chainLength; ++i) {
        places[i] = table.places[modifier.chain[i]];
    }
    writeModifierPlaces(std::span(places).first(modifier.chainLength), words);
    const SplitTime fade = splitTime(modifier.fadeStart);
    const bool limited = modifier.limit > 0.0f, lowers = modifier.kind == kModifierLower;
    const double half = 0.5 * static_cast<double>(modifier.limit);
    const glm::vec2 turn = limited ? glm::vec2(std::cos(half), std::sin(half)) : glm::vec2(-1.0f, 0.0f);
    const glm::vec2 limit = lowers ? glm::vec2(modifier.limit, 0.0f) : turn;
    const bool aims = modifier.kind == kModifierAim;
    putElement(words, 2, {modifier.weight, modifier.fadeWeight, modifier.fadeDuration, modifier.share});
    putElement(words, 3, {fade.high, fade.low, limit.x, limit.y});
    putElement(words, 4, glm::vec4(modifier.target, modifier.poleWeight));
    putElement(words, 5, glm::vec4(aims ? modifier.eye : modifier.pole, aims ? 0.0f : modifier.soft));
    putElement(words, 6, modifier.rotation);
    putElement(words, 7, glm::vec4(modifier.axis, 0.0f));
}

void writeModifierTurn(const glm::vec4& rotation, float weight, std::span<uint32_t> words) {
    words[8] = bits(weight);
    words[10] = bits(0.0f);
    putElement(words, 6, rotation);
}

void writeModifierPoints(const glm::vec3& target, const glm::vec3& pole, std::span<uint32_t> words) {
    for (size_t axis = 0; axis < 3; ++axis) {
        words[16 + axis] = bits(target[static_cast<int>(axis)]);
        if (modifierKind(words) == kModifierTwoBone || modifierKind(words) == kModifierPlant) {
            words[20 + axis] = bits(pole[static_cast<int>(axis)]);
        }
    }
}

uint32_t modifierKind(std::span<const uint32_t> words) {
    return words[0] & 255u;
}
uint32_t modifierFlags(std::span<const uint32_t> words) {
    return words[0] >> 8;
}
float loweredBy(std::span<const uint32_t> words) {
    return modifierKind(words) == kModifierLower ? std::bit_cast<float>(words[14]) : 0.0f;
}

std::span<uint32_t> modifierPlaces(std::span<const uint32_t> words, ChainPlaces& room) {
    for (uint32_t i = 0; i < words[1]; ++i) {
        room[i] = i % 2 == 0 ? words[4 + i / 2] & 0xFFFFu : words[4 + i / 2] >> 16;
    }
    return std::span(room).first(words[1]);
}

void writeModifierPlaces(std::span<const uint32_t> places, std::span<uint32_t> words) {
    words[1] = static_cast<uint32_t>(places.size());
    for (uint32_t i = 0; i < places.size(); ++i) {
        const uint32_t other = i % 2 == 0 ? 0u : words[4 + i / 2];
        words[4 + i / 2] = other | places[i] << (16 * (i % 2));
    }
}

} // namespace supple::skinning
