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
    /// The tables serve all rates.
    [[nodiscard]] bool anyRate() const { return tables().rate == 0; }

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
    for (uint32_t rate = anyRate() ? 1 : maxRate_; rate <= maxRate_; ++rate) {
        grids_.addRate(tables(), rate);
    }
    indexData_ = grids_.takeIndices();
    layOutDraws();
    return success();
}

void FixedRate::layOutDraws() {
    std::vector<SuppleDrawRange> draws;
    uint32_t firstVertex = 0;
    grids_.append(tables(), anyRate() ? evaluation_.rate - 1 : 0, firstVertex, draws);
    setDraws(std::move(draws));
}

Status FixedRate::canSetRate(uint32_t rate) const {
    const std::string& name = desc_.asset->character.name;
    if (!anyRate() && rate != askedRate_) {
        return Error{ErrorCode::argument, name + ": the tables of " + surface::schemeOf(scheme_->recipe.scheme).name +
                                              " are made for rate " + std::to_string(askedRate_) + " alone"};
    }
    return anyRate() ? checkRate(rate, maxRate_) : success();
}

Status FixedRate::setRate(uint32_t rate) {
    if (!anyRate() || rate == evaluation_.rate) {
        return success(); // the attributes stand
    }
    evaluation_.rate = rate;
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
