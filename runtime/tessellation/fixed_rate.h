// Grids of samples, patch by patch, at one rate for all instances.
#pragma once

#include "runtime/tessellation/one_rate.h"

namespace supple::runtime {

class FixedRate : public OneRate {
public:
    explicit FixedRate(const TessellationDesc& desc) : OneRate(desc) {}
    [[nodiscard]] Status begin();
    [[nodiscard]] SuppleTessellation kind() const override { return SUPPLE_TESSELLATION_GRIDS; }
    [[nodiscard]] uint32_t gridRate() const override { return evaluation_.rate; }
    [[nodiscard]] std::vector<uint32_t> verticesOf(uint32_t patch, uint32_t rate) const override;
    [[nodiscard]] Status prepareRate(uint32_t rate) override;
    void takeRate() override;

protected:
    [[nodiscard]] virtual std::vector<SuppleDrawRange> drawsAt(uint32_t rate) const;
    [[nodiscard]] uint32_t mostRate() const { return maxRate_; }

private:
    /// What another rate brings.
    struct OtherRate {
        surface::Evaluation evaluation;
        uint32_t vertexCount = 0;
        surface::Program program;
        std::vector<SuppleDrawRange> draws;
    };

    /// The tables serve all rates up to the one that the group begins with.
    [[nodiscard]] bool canChange() const {
        return tables().rate == 0 || surface::schemeOf(built_.scheme->recipe().scheme).rates == surface::RateRule::upTo;
    }
    /// Segments along a patch edge, from those along an edge of the cage.
    [[nodiscard]] uint32_t patchRate(uint32_t rate) const {
        const uint32_t patches = 1u << tables().isolationSteps;
        return (rate + patches - 1) / patches;
    }

    uint32_t maxRate_ = 0;
    GridDraws grids_; ///< of rates 1.., or of the one rate
    std::optional<OtherRate> next_;
};

} // namespace supple::runtime
