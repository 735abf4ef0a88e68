// The deformed cage alone: no patches, and every surface pass is empty.
#include "runtime/tessellation/tessellation.h"

namespace supple::runtime {

namespace {

class NoTessellation final : public Tessellation {
public:
    explicit NoTessellation(const TessellationDesc& desc) : Tessellation(desc) {
        built_.outputs.streams.remove(Stream::previousPositions);
        evaluation_.rate = built_.askedRate;
    }

    [[nodiscard]] SuppleTessellation kind() const override { return SUPPLE_TESSELLATION_NONE; }
    [[nodiscard]] HashedPart hashedPart(uint32_t) const override { return {}; }
    [[nodiscard]] Status prepareRate(uint32_t rate) override { return checkRate(rate, built_.askedRate); }
    PassCost recordEvaluate(surface::Round&) const override { return {}; }
    PassCost recordMotion(surface::Round&) const override { return {}; }

protected:
    void bindOutput(const SurfaceSets::Which&, SetContents&) const override {}
};

} // namespace

std::unique_ptr<Tessellation> makeNoTessellation(const TessellationDesc& desc) {
    return std::make_unique<NoTessellation>(desc);
}

} // namespace supple::runtime
