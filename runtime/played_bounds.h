// Where instances that play on the device can be, found without a pose (skinning/reach.h).
#pragma once

#include "cage/character.h"
#include "skinning/playback.h"
#include "skinning/reach.h"
#include "skinning/skinned_bounds.h"

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace supple::runtime {

/// Asking allocates nothing.
class PlayedBounds {
public:
    PlayedBounds() = default;
    /// The character must outlive this, and what `skinned` points to.
    PlayedBounds(const cage::Character& character, const skinning::SkinnedBounds& skinned, bool modifiers,
                 uint32_t capacity)
        : character_(&character), skinned_(skinned), played_(capacity), turned_(modifiers ? capacity : 0) {}

    void setBindPose(uint32_t slot) { played_[slot] = {}; }
    void set(uint32_t slot, const skinning::PlaybackDesc& desc);
    /// Modifiers turn `nodes` of the slot, whatever it plays, lower some by a way, and perhaps move some elsewhere.
    void setTurned(uint32_t slot, std::span<const uint32_t> nodes, bool elsewhere, double lowered) {
        turned_[slot].nodes.assign(nodes.begin(), nodes.end());
        turned_[slot].elsewhere = elsewhere;
        turned_[slot].lowered = lowered;
    }

    struct Interval {
        double start = std::numeric_limits<double>::infinity(), end = -std::numeric_limits<double>::infinity();

        /// The device tells times within SUPPLE_MAX_TIME apart as finely as this.
        [[nodiscard]] bool holds(double time) const { return meets(time, time); }
        /// Whether it holds a time between two.
        [[nodiscard]] bool meets(double first, double last) const { return last > start - 1e-5 && first < end + 1e-5; }
    };
    /// In this time nobody knows where the slot is: what it has shown goes on as it moved. set() and setBindPose() end
    /// it.
    void setTransition(uint32_t slot, const Interval& interval) { played_[slot].transition = interval; }
    [[nodiscard]] const Interval& transition(uint32_t slot) const { return played_[slot].transition; }
    [[nodiscard]] bool anyInTransition(double first, double last) const {
        return std::any_of(played_.begin(), played_.end(),
                           [&](const Played& own) { return own.transition.meets(first, last); });
    }
    /// Springs turn these nodes of all slots.
    void setSwinging(std::span<const uint32_t> nodes) { swinging_.assign(nodes.begin(), nodes.end()); }

    /// Takes over the first `count` slots of the same character.
    void takeOver(const PlayedBounds& other, uint32_t count) {
        std::copy_n(other.played_.begin(), count, played_.begin());
        std::copy_n(other.turned_.begin(), other.turned_.empty() ? 0 : count, turned_.begin());
    }

    /// What of() depends on besides what is set: the number of the loop, if the instance travels; whether it is in a
    /// transition.
    [[nodiscard]] uint32_t loopOf(uint32_t slot, double time) const;

    /// A box that holds the instance's cage at a time, before the instance's transform, but with what it has travelled.
    /// Nothing if nobody knows: with additive layers, in a transition, if something else than the only anchor takes the
    /// movement of the root, or if modifiers or springs turn a node that no clip moves or carries. `hostWeights`: morph
    /// weights of the host's; empty: those of the clips.
    [[nodiscard]] std::optional<skinning::Box> of(uint32_t slot, double time, const skinning::Reach& reach,
                                                  std::span<const float> hostWeights) const;

private:
    enum class Kind { bindPose, blended, unbounded };
    struct Played {
        Kind kind = Kind::bindPose;
        bool travels = false; ///< the first layer's root motion goes into its transform
        Interval transition;
        skinning::PlaybackLayer first;
        skinning::RootSelection root;
    };

    const cage::Character* character_ = nullptr;
    /// What modifiers do. The reach of layers that blend holds for any rotations, at an anchor and below it.
    struct Turned {
        std::vector<uint32_t> nodes;
        bool elsewhere = false;
        double lowered = 0.0;
    };
    [[nodiscard]] bool leavesReach(uint32_t slot, const skinning::Reach& reach) const;

    skinning::SkinnedBounds skinned_;
    std::vector<Played> played_; ///< by slot
    std::vector<Turned> turned_; ///< by slot, where instances may have modifiers
    std::vector<uint32_t> swinging_;
};

} // namespace supple::runtime
