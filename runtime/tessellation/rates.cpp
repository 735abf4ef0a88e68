// Groups of a view whose scheme subdivides: each instance has one of several rates, by the level that its bounds ask
// for. The scheme polygons has one rate, of which an instance is one mesh.
//
// All rates share the isolated mesh, and with it the coefficient pools and all that comes before evaluation. Each has
// its own tables, program, draw ranges and list of instances, and a place in every instance's vertices. So the
// attributes of all rates are made once, and a host draws a rate as it draws a group of that rate alone.
//
// All surfaces of a group have the rates of the group's ladder. Where a surface lacks one, it is drawn at the nearest
// that it has.
#include "runtime/tessellation/own_vertices.h"
#include "surface/table_check.h"

#include <algorithm>

namespace supple::runtime {

using namespace supple::shared;

namespace {

class Rates final : public OwnVertices {
public:
    explicit Rates(const TessellationDesc& desc) : OwnVertices(desc) {}
    ~Rates() override;
    [[nodiscard]] Status begin();

    [[nodiscard]] Ladder ladder() const override;
    void setLadder(Ladder ladder) override;
    [[nodiscard]] Status join(const InstanceWindows& windows) override;
    [[nodiscard]] Culling::Surface culledSurface() const override;
    [[nodiscard]] Status createSets(const SurfaceInput& input, const InstanceListing& listing,
                                    const Visibility& visibility) override;
    void freeSets() override;
    [[nodiscard]] Status remakeSets() override;
    [[nodiscard]] SuppleTessellation kind() const override { return SUPPLE_TESSELLATION_RATES; }
    void fillGrid(SuppleGridOutput& output) const override;
    [[nodiscard]] Status prepareRate(uint32_t rate) override;

    [[nodiscard]] gpu::TaskNeeds taskNeeds() const override;
    void recordWarmUp(VkCommandBuffer commandBuffer) const override;
    PassCost recordEvaluate(surface::Round& round) const override;
    PassCost recordMotion(surface::Round& round) const override;
    [[nodiscard]] uint32_t hashedParts() const override { return static_cast<uint32_t>(places_.size()); }
    [[nodiscard]] HashedPart hashedPart(uint32_t part) const override;
    [[nodiscard]] bool isBudgeted() const override { return view()->countsRates(); }
    [[nodiscard]] uint32_t leastVertices() const override { return own_.front().vertices; }

protected:
    [[nodiscard]] uint32_t scratchStride() const override;
    void recordAttributeSteps(gpu::Dispatches& dispatches) const override;

private:
    /// A rate that instances may have. Its vertices lie in the instance's behind those of the coarser rates.
    struct Rate {
        std::shared_ptr<SchemeTables> scheme;
        surface::Evaluation evaluation;
        surface::Program program;
        SurfaceSets sets;
        uint32_t firstVertex = 0, vertices = 0; ///< of an instance
        std::vector<SuppleDrawRange> draws;
    };
    [[nodiscard]] Status buildRates();
    [[nodiscard]] Status layOutDraws();
    [[nodiscard]] const Culling& culling() const { return static_cast<const Culling&>(*visibility_); }
    /// Rates take turns, so all they need is recorded in the first round.
    void recordRates(const surface::Round& round, bool previous) const;

    std::vector<Rate> own_;        ///< rising; the last one's tables are built_.scheme
    std::vector<uint32_t> places_; ///< by rate of the group's ladder, in own_
    IndexBytes indexData_;         ///< until the index buffer is made
    bool joined_ = false;
};

Rates::~Rates() {
    if (joined_) {
        view()->giveGroup(uint64_t{vertexCount_} * desc_.group.capacity);
    }
}

Status Rates::begin() {
    Status status = buildTables();
    status = status ? buildRates() : status;
    if (!status) {
        return status;
    }
    surface::ProgramOptions options = programOptions();
    options.view = true;
    for (size_t r = 0; r < own_.size(); ++r) {
        Rate& rate = own_[r];
        rate.evaluation.verticesPerInstance = evaluation_.verticesPerInstance;
        Result<surface::Program> program = programFor(rate.scheme->tables(), options, rate.evaluation);
        if (!program) {
            return program.error();
        }
        rate.program = std::move(*program);
    }
    // Construction is that of the finest rate, and the same for all.
    program_.vertex = own_.back().program.vertex;
    program_.assemble = own_.back().program.assemble;
    status = layOutDraws();
    return status ? desc_.bounds->prepareRates() : status;
}

Status Rates::layOutDraws() {
    if (isMesh()) {
        Rate& only = own_.front();
        Result<IndexBytes> indices = layOutMesh(only.evaluation, only.vertices);
        if (!indices) {
            return indices.error();
        }
        indexData_ = std::move(*indices);
        only.draws = std::move(draws_);
        return success();
    }
    GridDraws grids;
    for (const Rate& rate : own_) {
        grids.addRate(tables(), rate.evaluation.rate);
    }
    indexData_ = grids.takeIndices();
    for (size_t r = 0; r < own_.size(); ++r) {
        uint32_t firstVertex = own_[r].firstVertex;
        grids.append(tables(), r, firstVertex, own_[r].draws);
    }
    return success();
}

Tessellation::Ladder Rates::ladder() const {
    return {1u << tables().isolationSteps, static_cast<uint32_t>(own_.size()), isMesh()};
}

void Rates::setLadder(Ladder ladder) {
    draws_.clear();
    for (uint32_t r = 0; r < ladder.count; ++r) {
        const uint32_t last = static_cast<uint32_t>(own_.size()) - 1;
        uint32_t place = 0;
        while (place < last && this->ladder().first << place < ladder.first << r) {
            ++place;
        }
        places_.push_back(place);
        const Rate& own = own_[place];
        const auto count = static_cast<uint32_t>(own.draws.size());
        rates_.push_back({own.evaluation.rate, static_cast<uint32_t>(draws_.size()), count, {}});
        draws_.insert(draws_.end(), own.draws.begin(), own.draws.end());
    }
}

Status Rates::buildRates() {
    uint64_t vertices = 0;
    for (const surface::Recipe& recipe : ratesBelow(built_.scheme->recipe(), tables())) {
        Result<std::shared_ptr<SchemeTables>> scheme = desc_.asset->tablesFor(*desc_.device, recipe, desc_.piece);
        if (!scheme) {
            return scheme.error();
        }
        Rate& rate = own_.emplace_back();
        rate.scheme = std::move(*scheme);
        rate.evaluation.rate = recipe.rate >> tables().isolationSteps;
        // They may come from a file, where each stands for itself.
        const surface::Tables& own = rate.scheme->tables();
        if (own.rate != rate.evaluation.rate || !surface::areOfOneMesh(own, tables())) {
            return Error{ErrorCode::asset, desc_.asset->character.name + ": the tables for rate " +
                                               std::to_string(recipe.rate) +
                                               " are of another mesh than those for rate " +
                                               std::to_string(built_.scheme->recipe().rate)};
        }
        rate.firstVertex = static_cast<uint32_t>(vertices);
        vertices = rate.evaluation.layOut(rate.scheme->tables(), vertices);
        rate.vertices = static_cast<uint32_t>(vertices) - rate.firstVertex;
    }
    built_.scheme = own_.back().scheme;
    return setVertexCount(vertices);
}

Status Rates::join(const InstanceWindows&) {
    joined_ = view()->takeGroup(uint64_t{vertexCount_} * desc_.group.capacity);
    if (!joined_) {
        return Error{ErrorCode::limit, "the view is full: it has " + std::to_string(view()->maxRuns()) +
                                           " groups of subdivision, or they have 2^32 vertices"};
    }
    return success();
}

Culling::Surface Rates::culledSurface() const {
    Culling::Surface surface;
    surface.sizes = program_.constructionSizes();
    surface.constructions = program_.constructionCount();
    surface.measure = desc_.asset->prepared->measureOf(*built_.scheme->prepared);
    surface.margin = boundsMargin();
    for (const uint32_t place : places_) {
        const Rate& own = own_[place];
        surface.rates.push_back({own.vertices, own.program.evaluationSizes(), own.draws});
    }
    return surface;
}

Status Rates::createSets(const SurfaceInput& input, const InstanceListing& listing, const Visibility& visibility) {
    Status status = createIndices(std::exchange(indexData_, {}), {}); // no view is traced
    status = status ? OwnVertices::createSets(input, listing, visibility) : status;
    for (Rate& rate : own_) {
        addMember(rate.scheme->buffers);
        status = status ? makeSets(rate.sets, *rate.scheme, rate.program) : status;
    }
    for (uint32_t r = 0; status && r < rates_.size(); ++r) {
        rates_[r].instances = culling().rateList(r);
    }
    return status;
}

void Rates::freeSets() {
    for (Rate& rate : own_) {
        rate.sets = {};
    }
    OwnVertices::freeSets();
}

Status Rates::remakeSets() {
    Status status = OwnVertices::remakeSets();
    for (Rate& rate : own_) {
        status = status ? makeSets(rate.sets, *rate.scheme, rate.program) : status;
    }
    return status;
}

void Rates::fillGrid(SuppleGridOutput& output) const {
    OwnVertices::fillGrid(output);
    output.indirect = {culling().list().buffer, culling().drawOffset(desc_.surface),
                       draws_.size() * sizeof(VkDrawIndexedIndirectCommand), sizeof(VkDrawIndexedIndirectCommand)};
}

Status Rates::prepareRate(uint32_t rate) {
    if (rate == built_.askedRate) {
        return success();
    }
    return Error{ErrorCode::argument, desc_.asset->character.name + ": the tables of " +
                                          surface::schemeOf(built_.scheme->recipe().scheme).name +
                                          " are made for rate " + std::to_string(built_.askedRate) + " alone"};
}

uint32_t Rates::scratchStride() const {
    uint32_t most = 0; // rates take turns
    for (const Rate& rate : own_) {
        most = std::max(most, rate.program.scratchStride);
    }
    return most;
}

gpu::TaskNeeds Rates::taskNeeds() const {
    gpu::TaskNeeds needs = OwnVertices::taskNeeds();
    for (const Rate& rate : own_) { // attributes
        needs += taskNeedsOf(rate.program);
    }
    for (const uint32_t place : places_) { // several may draw one rate
        needs += taskNeedsOf(own_[place].program);
    }
    return needs;
}

void Rates::recordWarmUp(VkCommandBuffer commandBuffer) const {
    if (!hasBuffers()) {
        return;
    }
    OwnVertices::recordWarmUp(commandBuffer);
    for (const Rate& rate : own_) {
        Tessellation::recordWarmUp(commandBuffer, rate.program, rate.sets);
    }
}

void Rates::recordAttributeSteps(gpu::Dispatches& dispatches) const {
    for (const Rate& rate : own_) {
        surface::record(dispatches, rate.program.attributes, oneInstance(rate.sets.at({0, pool_, false})));
    }
}

void Rates::recordRates(const surface::Round& round, bool previous) const {
    if (round.number > 0) {
        return;
    }
    bool first = true;
    for (uint32_t r = 0; r < places_.size(); ++r) {
        const Rate& rate = own_[places_[r]];
        windows().forEach([&](uint32_t w) {
            if (!first && usesScratch()) {
                round.dispatches.computeBarrier();
            }
            first = false;
            surface::Window window = culling().window(w, desc_.surface, r);
            window.sets = rate.sets.at({w, previous ? 1 - pool_ : pool_, previous});
            surface::record(round.dispatches, previous ? rate.program.motion : rate.program.evaluate,
                            previous ? ofPast(window) : window);
        });
    }
}

PassCost Rates::recordEvaluate(surface::Round& round) const {
    recordRates(round, false);
    return {0, 0, windows().visible > 0};
}

PassCost Rates::recordMotion(surface::Round& round) const {
    if (!writesMotion()) {
        return {};
    }
    recordRates(round, true);
    return {0, 0, windows().visible > 0};
}

HashedPart Rates::hashedPart(uint32_t part) const {
    const Rate& rate = own_[places_[part]];
    HashedPart result = hashedPositions(streams_);
    result.by = HashedBy::rateList;
    result.slotStride = evaluation_.verticesPerInstance * result.elementWords;
    result.firstWord = rate.firstVertex * result.elementWords;
    result.elementCount = rate.vertices;
    result.surface = desc_.surface;
    result.rate = part;
    return result;
}

} // namespace

Result<std::unique_ptr<Tessellation>> makeRates(const TessellationDesc& desc) {
    return begun(std::make_unique<Rates>(desc));
}

} // namespace supple::runtime
