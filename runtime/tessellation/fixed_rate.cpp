#include "runtime/tessellation/fixed_rate.h"

#include "surface/grid.h"

#include <numeric>

namespace supple::runtime {

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
    if (isTraced()) {
        status = checkRayIndices(surface::gridMeshIndices(tables(), evaluation_));
        if (!status) {
            return status;
        }
        surface::IndexedMesh whole = surface::gridMesh(tables(), evaluation_);
        setRayRanges(whole);
        wholeIndexData_ = IndexBytes(std::move(whole.indices));
    }
    setDraws(drawsAt(maxRate_));
    return success();
}

std::vector<SuppleDrawRange> FixedRate::drawsAt(uint32_t rate) const {
    std::vector<SuppleDrawRange> draws;
    uint32_t firstVertex = 0;
    grids_.append(tables(), canChange() ? rate - 1 : 0, firstVertex, draws);
    return draws;
}

std::vector<uint32_t> FixedRate::verticesOf(uint32_t patch, uint32_t rate) const {
    if (rate > maxRate_ || (!canChange() && rate != maxRate_)) {
        return {};
    }
    uint32_t first = 0;
    for (const surface::DrawRange& range : tables().drawRanges) {
        const uint32_t samples = surface::sampleCount(range.domain, rate);
        if (patch - range.firstPatch < range.patchCount) {
            std::vector<uint32_t> vertices(samples);
            std::iota(vertices.begin(), vertices.end(), first + (patch - range.firstPatch) * samples);
            return vertices;
        }
        first += range.patchCount * samples;
    }
    return {};
}

Status FixedRate::prepareRate(uint32_t rate) {
    next_.reset();
    const std::string& name = desc_.asset->character.name;
    if (!canChange() && rate != built_.askedRate) {
        return Error{ErrorCode::argument, name + ": the tables of " +
                                              surface::schemeOf(built_.scheme->recipe().scheme).name +
                                              " are made for rate " + std::to_string(built_.askedRate) + " alone"};
    }
    if (isTraced() && rate != built_.askedRate) {
        return Error{ErrorCode::argument, name + ": the triangles that are traced are made for rate " +
                                              std::to_string(built_.askedRate) + " alone"};
    }
    Status takes = canChange() ? checkRate(rate, maxRate_ << tables().isolationSteps) : success();
    if (!takes || !canChange() || patchRate(rate) == evaluation_.rate) {
        return takes; // the attributes stand
    }
    OtherRate next;
    next.evaluation = evaluation_;
    next.evaluation.rate = patchRate(rate);
    next.vertexCount = static_cast<uint32_t>(next.evaluation.layOut(tables()));
    Result<surface::Program> program = programFor(tables(), programOptions(), next.evaluation);
    if (!program) {
        return program.error();
    }
    next.program = std::move(*program);
    next.draws = drawsAt(next.evaluation.rate);
    next_ = std::move(next);
    return success();
}

void FixedRate::takeRate() {
    if (!next_) {
        return;
    }
    evaluation_ = std::move(next_->evaluation);
    vertexCount_ = next_->vertexCount;
    program_ = std::move(next_->program);
    setDraws(std::move(next_->draws));
    attributes_.renew(built_.outputs.streams.has(Stream::attributes));
    next_.reset();
}

Result<std::unique_ptr<Tessellation>> makeFixedRate(const TessellationDesc& desc) {
    return begun(std::make_unique<FixedRate>(desc));
}

} // namespace supple::runtime
