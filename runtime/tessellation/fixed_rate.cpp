// Grids of samples, patch by patch, at one rate for all instances.
#include "runtime/tessellation/one_rate.h"

namespace supple::runtime {

namespace {

class FixedRate final : public OneRate {
public:
    explicit FixedRate(const TessellationDesc& desc) : OneRate(desc) {}
    [[nodiscard]] Status begin();
    [[nodiscard]] SuppleTessellation kind() const override { return SUPPLE_TESSELLATION_GRIDS; }
    [[nodiscard]] Status canSetRate(uint32_t rate) const override;
    [[nodiscard]] Status setRate(uint32_t rate) override;

private:
    void layOutDraws();
    /// The tables serve all rates up to the one that the group begins with.
    [[nodiscard]] bool canChange() const {
        return tables().rate == 0 || surface::schemeOf(scheme_->recipe.scheme).rates == surface::RateRule::upTo;
    }
    /// Segments along a patch edge, from those along an edge of the cage.
    [[nodiscard]] uint32_t patchRate(uint32_t rate) const {
        const uint32_t patches = 1u << tables().isolationSteps;
        return (rate + patches - 1) / patches;
    }

    uint32_t maxRate_ = 0;
    GridDraws grids_; ///< of rates 1.., or of the one rate
};

Status FixedRate::begin() {
    Status status = buildTables();
    if (!status) {
        return status;
    }
    maxRate_ = evaluation_.rate;
    status = setVertexCount(evaluation_.layOut(tables()));
    status = status ? prepare() : status;
    if (!status) {
        return status;
    }
    // The grids of every rate that may be set.
    for (uint32_t rate = canChange() ? 1 : maxRate_; rate <= maxRate_; ++rate) {
        grids_.addRate(tables(), rate);
    }
    indexData_ = grids_.takeIndices();
    layOutDraws();
    return success();
}

void FixedRate::layOutDraws() {
    std::vector<SuppleDrawRange> draws;
    uint32_t firstVertex = 0;
    grids_.append(tables(), canChange() ? evaluation_.rate - 1 : 0, firstVertex, draws);
    setDraws(std::move(draws));
}

Status FixedRate::canSetRate(uint32_t rate) const {
    const std::string& name = desc_.asset->character.name;
    if (!canChange() && rate != askedRate_) {
        return Error{ErrorCode::argument, name + ": the tables of " + surface::schemeOf(scheme_->recipe.scheme).name +
                                              " are made for rate " + std::to_string(askedRate_) + " alone"};
    }
    return canChange() ? checkRate(rate, maxRate_ << tables().isolationSteps) : success();
}

Status FixedRate::setRate(uint32_t rate) {
    if (!canChange() || patchRate(rate) == evaluation_.rate) {
        return success(); // the attributes stand
    }
    evaluation_.rate = patchRate(rate);
    vertexCount_ = static_cast<uint32_t>(evaluation_.layOut(tables()));
    attributes_.renew(wanted_.has(Stream::attributes));
    layOutDraws();
    return prepare();
}

} // namespace

Result<std::unique_ptr<Tessellation>> makeFixedRate(const TessellationDesc& desc) {
    return begun(std::make_unique<FixedRate>(desc));
}

} // namespace supple::runtime
