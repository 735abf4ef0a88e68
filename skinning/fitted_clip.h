// A clip of one skeleton as another one plays it, by its followers (skinning/followers.h).
#pragma once

#include "cage/character.h"
#include "skinning/followers.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::skinning {

/// Two skeletons and what the one does of the other's clips. What they refer to must outlive them.
struct FittedSkeletons {
    const cage::Skeleton &from, &to;
    const Followers& followers;
    RestPlaces fromRest, toRest;
    std::vector<uint32_t> needed; ///< nodes of `to` that follow, and those above them; parents first

    FittedSkeletons(const cage::Skeleton& leading, const cage::Skeleton& own, const Followers& following);
};

/// Makes clips for `to`, one after the other. Everything it is given must outlive it.
class ClipFitter {
public:
    /// `clips`: how many there will be. `numbers`: of keys and values that all of them have together. By these, clips
    /// may take some number of poses: so that a few keys far apart do not ask for any.
    ClipFitter(const cage::Skeleton& from, const cage::Skeleton& to, const Followers& followers, uint64_t clips,
               uint64_t numbers);

    /// Whether ankles are brought where those of the clip are, by the legs' bends.
    enum class Feet : uint8_t { free, placed };

    struct Fitted {
        cage::Clip clip;        ///< of `to`; markers and curves of sharpness are those of the given clip
        double miss = 0.0;      ///< how far a leg ends short of where its ankle should be, in heights of the hips
        bool isCoarse = false;  ///< it has fewer keys than it needs, as there was no room for more poses
        std::string whyLeftOut; ///< empty, or there is no clip
    };
    /// Channels of weights are left out. Legs that end more than `mostMissed` short of their goal in some frame keep
    /// the clip's angles, and so does the other leg.
    [[nodiscard]] Fitted fit(const cage::Clip& clip, Feet feet, double mostMissed);

private:
    FittedSkeletons of_;
    uint64_t clipsLeft_;
    uint64_t left_; ///< poses of nodes
};

} // namespace supple::skinning
