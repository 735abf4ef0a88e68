// Where instances that play on the device can be, found without a pose (skinning/reach.h).
#pragma once

#include "cage/character.h"
#include "skinning/playback.h"
#include "skinning/reach.h"

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace supple::runtime {

/// Asking allocates nothing.
class PlayedBounds {
public:
    PlayedBounds() = default;
    /// The character must outlive this.
    PlayedBounds(const cage::Character& character, bool dualQuaternions, uint32_t capacity)
        : character_(&character), dualQuaternions_(dualQuaternions), played_(capacity) {}

    void setBindPose(uint32_t slot) { played_[slot] = {}; }
    void set(uint32_t slot, const skinning::PlaybackDesc& desc);

    /// Takes over the first `count` slots of the same character.
    void takeOver(const PlayedBounds& other, uint32_t count) {
        std::copy_n(other.played_.begin(), count, played_.begin());
    }

    /// What of() depends on besides what is set: the number of the loop, if the instance travels.
    [[nodiscard]] uint32_t loopOf(uint32_t slot, double time) const;

    /// A box that holds the instance's cage at a time, before the instance's transform, but with what it has travelled.
    /// Nothing if nobody knows: with additive layers, or if something else than the only anchor takes the movement of
    /// the root. `hostWeights`: morph weights of the host's; empty: those of the clips.
    [[nodiscard]] std::optional<skinning::Box> of(uint32_t slot, double time, const skinning::Reach& reach,
                                                  std::span<const float> hostWeights) const;

private:
    enum class Kind { bindPose, blended, unbounded };
    struct Played {
        Kind kind = Kind::bindPose;
        bool travels = false; ///< the first layer's root motion goes into its transform
        skinning::PlaybackLayer first;
        skinning::RootSelection root;
    };

    const cage::Character* character_ = nullptr;
    bool dualQuaternions_ = false;
    std::vector<Played> played_; ///< by slot
};

} // namespace supple::runtime
