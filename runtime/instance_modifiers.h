// The modifiers of a group's instances: their words lie in the states that are executed, on the device or by the twin.
#pragma once

#include "shaders/shared/pose.h"
#include "skinning/clip_table.h"
#include "skinning/modifiers.h"
#include "skinning/playback.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace supple::runtime {

/// A modifier as skinning/ has it, but for its points, target and pole: with shared::kModifierWorld they are doubles of
/// the host's space, however far off.
struct PlacedModifier {
    skinning::Modifier modifier;
    std::array<glm::dvec3, 2> points{};
};
/// What of a modifier may change while all else stays. A fade ends.
struct ModifierGoal {
    std::array<glm::dvec3, 2> points{};
    glm::vec4 rotation{0.0f, 0.0f, 0.0f, 1.0f};
    float weight = 0.0f;
};

/// Setting allocates nothing.
class InstanceModifiers {
public:
    InstanceModifiers() = default;
    /// `morphCount`: morph weights that stand before the modifiers in a state.
    InstanceModifiers(uint32_t capacity, uint32_t morphCount)
        : morphCount_(morphCount), points_(size_t{capacity} * shared::kMaxModifiers) {}

    /// False: the group's instances have none, ever.
    [[nodiscard]] bool areTaken() const { return !points_.empty(); }

    /// `origin`: where the coordinates of the device begin.
    void set(uint32_t slot, skinning::PlaybackState state, const skinning::ClipTable& table,
             std::span<const PlacedModifier> modifiers, const glm::dvec3& origin) {
        state.setModifierCount(static_cast<uint32_t>(modifiers.size()));
        for (uint32_t i = 0; i < modifiers.size(); ++i) {
            skinning::writeModifier(table, modifiers[i].modifier, state.modifier(morphCount_, i));
            pointsOf(slot, i) = modifiers[i].points;
        }
        place(slot, state, origin);
    }
    void setGoal(uint32_t slot, skinning::PlaybackState state, uint32_t index, const ModifierGoal& goal,
                 const glm::dvec3& origin) {
        pointsOf(slot, index) = goal.points;
        skinning::writeModifierTurn(goal.rotation, goal.weight, state.modifier(morphCount_, index));
        place(slot, state, origin);
    }
    /// Puts the points where they are from another origin.
    void place(uint32_t slot, skinning::PlaybackState state, const glm::dvec3& origin) {
        for (uint32_t i = 0; i < state.modifierCount(); ++i) {
            const std::span<uint32_t> words = state.modifier(morphCount_, i);
            const bool world = (skinning::modifierFlags(words) & shared::kModifierWorld) != 0;
            const glm::dvec3 from = world ? origin : glm::dvec3(0.0);
            const std::array<glm::dvec3, 2>& points = pointsOf(slot, i);
            skinning::writeModifierPoints(glm::vec3(points[0] - from), glm::vec3(points[1] - from), words);
        }
    }
    [[nodiscard]] bool anyInWorld(skinning::PlaybackState state) const {
        for (uint32_t i = 0; i < state.modifierCount(); ++i) {
            if ((skinning::modifierFlags(state.modifier(morphCount_, i)) & shared::kModifierWorld) != 0) {
                return true;
            }
        }
        return false;
    }
    [[nodiscard]] std::span<const uint32_t> words(skinning::PlaybackState state, uint32_t index) const {
        return state.modifier(morphCount_, index);
    }

    /// Takes over those of an instance of another version of the asset: `moved` gives a node's place here by the one
    /// there, or kNone. Those that lack a node, or a foot, are left out. `table`: the one here.
    template <class Moved>
    void takeOver(uint32_t slot, skinning::PlaybackState state, const skinning::ClipTable& table,
                  const InstanceModifiers& other, skinning::PlaybackState before, Moved&& moved) {
        uint32_t count = 0;
        for (uint32_t i = 0; i < before.modifierCount(); ++i) {
            const std::span<const uint32_t> words = before.modifier(other.morphCount_, i);
            skinning::ChainPlaces room;
            const std::span<uint32_t> places = skinning::modifierPlaces(words, room);
            std::transform(places.begin(), places.end(), places.begin(), moved);
            const bool known = std::find(places.begin(), places.end(), cage::kNone) == places.end();
            const bool plants = skinning::modifierKind(words) == shared::kModifierPlant;
            if (known && (!plants || table.isFoot(table.nodes[places.back()]))) {
                const std::span<uint32_t> target = state.modifier(morphCount_, count);
                std::copy(words.begin(), words.end(), target.begin());
                skinning::writeModifierPlaces(places, target);
                pointsOf(slot, count) = other.pointsOf(slot, i);
                ++count;
            }
        }
        state.setModifierCount(count);
    }
    /// The same of the first `count` slots of the same asset, whose states were copied.
    void takeOver(const InstanceModifiers& other, uint32_t count) {
        std::copy_n(other.points_.begin(), areTaken() ? size_t{count} * shared::kMaxModifiers : 0, points_.begin());
    }

private:
    [[nodiscard]] std::array<glm::dvec3, 2>& pointsOf(uint32_t slot, uint32_t i) {
        return points_[size_t{slot} * shared::kMaxModifiers + i];
    }
    [[nodiscard]] const std::array<glm::dvec3, 2>& pointsOf(uint32_t slot, uint32_t i) const {
        return points_[size_t{slot} * shared::kMaxModifiers + i];
    }

    uint32_t morphCount_ = 0;
    std::vector<std::array<glm::dvec3, 2>> points_; ///< kMaxModifiers a slot
};

} // namespace supple::runtime
