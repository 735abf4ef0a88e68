// By how much cages may leave the boxes that hold them linearly skinned: an account per way of skinning.
#pragma once

#include "skinning/reach.h"
#include "skinning/skinning_mode.h"

#include <memory>
#include <span>

namespace supple::skinning {

class SkinnedBounds {
public:
    SkinnedBounds() = default; ///< linear
    /// What the way of skinning needs must outlive this.
    explicit SkinnedBounds(const Skinning& skinning);

    /// The box of the cages in poses that layers make of the clips (Reach::blended); `linear`: that of linear skinning.
    [[nodiscard]] Box reached(const Reach& reach, const Box& linear) const;
    /// The box of the cages that a palette makes. `morphWeights`: one per target.
    [[nodiscard]] Box posed(const Reach& reach, std::span<const Affine> palette,
                            std::span<const float> morphWeights) const;

private:
    /// `sizeOf(joint)`: the norm of its matrix, at most; `morphed`: how far morph targets take a vertex, at most.
    template <class F>
    [[nodiscard]] Box grown(const Reach& reach, const Box& linear, double morphed, F&& sizeOf) const;

    SkinningMode mode_ = SkinningMode::linear;
    std::span<const double> arms_; ///< by joint; none: the mode needs none
    double share_ = 0.0;           ///< how far a vertex of an arm of 1 may be from where linear skinning takes it
};

} // namespace supple::skinning
