// The description of a group with all that it points to, so that the group can be made anew.
#pragma once

#include "cage/character.h"
#include "supple/supple.h"

#include <cstdint>
#include <span>
#include <vector>

namespace supple::runtime {

class GroupRecipe {
public:
    GroupRecipe() = default;
    explicit GroupRecipe(const SuppleGroupDesc& desc) : desc_(desc) {
        if (desc.prep != nullptr) {
            prep_ = *desc.prep;
        }
        if (desc.blend != nullptr) {
            blend_ = *desc.blend;
        }
        if (desc.fragments != nullptr) {
            fragments_ = *desc.fragments;
        }
        partSchemes_.assign(desc.partSchemes, desc.partSchemes + desc.partSchemeCount);
    }

    /// It points into this, which must stay where it is as long as the description is used.
    [[nodiscard]] SuppleGroupDesc desc() const {
        SuppleGroupDesc desc = desc_;
        desc.prep = desc_.prep != nullptr ? &prep_ : nullptr;
        desc.blend = desc_.blend != nullptr ? &blend_ : nullptr;
        desc.fragments = desc_.fragments != nullptr ? &fragments_ : nullptr;
        desc.partSchemes = partSchemes_.data();
        desc.partSchemeCount = static_cast<uint32_t>(partSchemes_.size());
        return desc;
    }
    void setCapacity(uint32_t capacity) { desc_.capacity = capacity; }
    /// The schemes of single parts move along. `parts`: by new number the old one, or kNone.
    void renumberParts(std::span<const uint32_t> parts) {
        std::vector<SuppleScheme> moved;
        for (const uint32_t before : parts) {
            const bool named = before != cage::kNone && before < partSchemes_.size();
            moved.push_back(named ? partSchemes_[before] : SUPPLE_SCHEME_AUTO);
        }
        if (!partSchemes_.empty()) {
            partSchemes_ = std::move(moved);
        }
    }

private:
    SuppleGroupDesc desc_{};
    SupplePrepOptions prep_{};
    SuppleBlendOptions blend_{};
    SuppleFragmentsOptions fragments_{};
    std::vector<SuppleScheme> partSchemes_;
};

} // namespace supple::runtime
