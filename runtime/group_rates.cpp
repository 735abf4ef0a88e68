// Subdivision in views: groups whose instances have one of several rates each, by the level that their bounds ask for.
//
// Rates share the isolated level, and with it the coefficient pools and all that comes before evaluation. Tables, draw
// ranges and lists of instances they have each their own, and each a place in every instance's vertices: the attributes
// of all rates are made once, and a host draws a rate as it draws a group of that rate alone.
#include "runtime/group.h"
#include "runtime/group_buffers.h"

namespace supple::runtime {

using namespace supple::shared;

Status Group::createRates(const surface::Recipe& recipe) {
    const surface::Tables& finest = scheme_->tables;
    surface::Recipe own = recipe;
    for (uint32_t rate = 1; rate <= finest.rate; rate *= 2) {
        own.rate = rate << finest.isolationSteps;
        Result<std::shared_ptr<SchemeTables>> scheme = asset_->tablesFor(*shared_.device, own);
        if (!scheme) {
            return scheme.error();
        }
        rates_.push_back({std::move(*scheme), {}, {}});
        rates_.back().evaluation.rate = rate;
    }
    scheme_ = rates_.back().scheme;
    return success();
}

uint64_t Group::layOutVertices() {
    if (hasLevels()) {
        return 0;
    }
    if (!hasRates()) {
        return evaluation_.layOut(scheme_->tables);
    }
    uint64_t vertices = 0;
    for (Rate& rate : rates_) {
        vertices = rate.evaluation.layOut(rate.scheme->tables, vertices);
    }
    return vertices;
}

uint32_t Group::ownVertices(size_t rate) const {
    const SuppleRate& output = rateOutputs_[rate];
    const SuppleDrawRange &first = drawRanges_[output.firstDrawRange],
                          &last = drawRanges_[output.firstDrawRange + output.drawRangeCount - 1];
    return last.firstVertex + last.patchCount * last.samplesPerPatch - first.firstVertex;
}

std::vector<Culling::Rate> Group::cullingRates() const {
    std::vector<Culling::Rate> rates;
    for (size_t r = 0; r < rates_.size(); ++r) {
        const auto first = drawRanges_.begin() + rateOutputs_[r].firstDrawRange;
        rates.push_back({ownVertices(r),
                         shared_.surface->kernel().dispatches(rates_[r].scheme->tables.fragments),
                         {first, first + rateOutputs_[r].drawRangeCount}});
    }
    return rates;
}

void Group::fillRates() {
    for (uint32_t r = 0; r < rateOutputs_.size(); ++r) {
        SuppleBufferView& instances = rateOutputs_[r].instances;
        instances = output_.instances;
        if (hasRates()) {
            instances.offset = culling_.rateListOffset(r);
        }
    }
    if (hasRates()) {
        output_.indirect = {culling_.list(), culling_.drawOffset(),
                            drawRanges_.size() * sizeof(VkDrawIndexedIndirectCommand),
                            sizeof(VkDrawIndexedIndirectCommand)};
    }
    output_.rates = rateOutputs_.data();
    output_.rateCount = static_cast<uint32_t>(rateOutputs_.size());
}

void Group::recordRates(VkCommandBuffer commandBuffer, bool previous) const {
    const uint32_t format = previous ? kVertexPosition : static_cast<uint32_t>(output_.vertexFormat);
    bool first = true;
    for (uint32_t r = 0; r < rates_.size(); ++r) {
        const Rate& rate = rates_[r];
        for (const Window& window : windows_) {
            if (listed_[window.index].count == 0) {
                continue;
            }
            if (!first && usesScratch()) {
                gpu::computeBarrier(*shared_.device, commandBuffer);
            }
            first = false;
            const SurfaceSets& sets = rate.windows[window.index];
            surface::Window own =
                culling_.window(window.index, previous ? sets.motion[1 - pool_] : sets.surface[pool_], r);
            own.today = previous;
            shared_.surface->recordEvaluate(commandBuffer, rate.scheme->tables, own, rate.evaluation, format);
        }
    }
}

} // namespace supple::runtime
