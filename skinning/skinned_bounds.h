// By how much cages may leave the boxes that hold them linearly skinned: an account per way of skinning.
#pragma once

#include "skinning/centers.h"
#include "skinning/reach.h"
#include "skinning/skinning_mode.h"

#include <memory>
#include <span>

namespace supple::skinning {

class SkinnedBounds {
public:
    SkinnedBounds() = default; ///< linear
    /// `centers`: of centers of rotation. They must outlive this.
    SkinnedBounds(SkinningMode mode, const Centers* centers) : mode_(mode), centers_(centers) {}

    /// Of a box that holds the cages in poses that layers make of the clips (Reach::blended).
    [[nodiscard]] Box reached(const Reach& reach, const Box& linear) const;
    /// Of a box that holds the cages that the palette makes (paletteBounds).
    [[nodiscard]] Box posed(const Reach& reach, std::span<const Affine> palette, const Box& linear) const;

private:
    /// `sizeOf(joint)`: the norm of its matrix, at most.
    template <class F>
    [[nodiscard]] Box grown(const Reach& reach, const Box& linear, F&& sizeOf) const;

    SkinningMode mode_ = SkinningMode::linear;
    const Centers* centers_ = nullptr;
};

} // namespace supple::skinning
