// Groups of a view whose scheme has them: patches at real-valued levels. Their vertices are the view's,
// and which patches are drawn at which capacity is found anew in every frame (docs/lod.md).
#include "runtime/tessellation/tessellation.h"
#include "surface/lod/grid.h"
#include "surface/lod/tables.h"

#include <algorithm>

namespace supple::runtime {

using namespace supple::shared;

namespace {

class Levels final : public Tessellation {
public:
    explicit Levels(const TessellationDesc& desc) : Tessellation(desc) {}
    ~Levels() override;
    [[nodiscard]] Status begin();

    [[nodiscard]] Status join(const InstanceWindows& windows) override;
    [[nodiscard]] Culling::Surface culledSurface() const override;
    [[nodiscard]] SuppleTessellation kind() const override { return SUPPLE_TESSELLATION_LEVELS; }
    [[nodiscard]] const VertexStreams* streams() const override { return &view()->streams(); }
    void fillLevels(SuppleLevelOutput& output) const override;
    [[nodiscard]] Status prepareRate(uint32_t rate) override;

    VkDeviceSize recordUpload(VkCommandBuffer commandBuffer, uint64_t frame, bool changed) override;
    PassCost recordEdgeLevels(surface::Round& round) const override;
    PassCost recordPatchLevels(gpu::Dispatches& dispatches) const override;
    PassCost recordDepths(gpu::Dispatches& dispatches) const override;
    PassCost recordPlaces(gpu::Dispatches& dispatches) const override;
    PassCost recordDeepen(surface::Round& round) const override;
    [[nodiscard]] bool writesLevelAttributes() const override { return built_.outputs.streams.has(Stream::attributes); }
    PassCost recordLevelAttributes(gpu::Dispatches& dispatches) const override;
    PassCost recordEvaluate(surface::Round& round) const override;
    [[nodiscard]] bool usesScratch() const override { return false; } // it holds levels
    PassCost recordMotion(surface::Round& round) const override;
    [[nodiscard]] HashedPart hashedPart(uint32_t part) const override;
    [[nodiscard]] bool isBudgeted() const override { return true; }
    [[nodiscard]] uint32_t leastVertices() const override { return leastVertices_; }
    [[nodiscard]] uint32_t patchesAtLevels() const override { return static_cast<uint32_t>(tables().patches.size()); }

protected:
    void bindOutput(const SurfaceSets::Which& which, SetContents& contents) const override;

    [[nodiscard]] SharedPools sharedPools() const override { return view()->pools(); }

private:
    [[nodiscard]] uint32_t partCount() const { return static_cast<uint32_t>(desc_.asset->character.parts.size()); }
    [[nodiscard]] uint32_t runs() const { return static_cast<uint32_t>(tables().lod.runs.size()); }
    void layOutDraws(uint32_t windowCount);
    [[nodiscard]] surface::ProgramOptions levelOptions() const;
    /// The instances of a window with what the level passes are told of the view.
    [[nodiscard]] surface::Window levelWindow(uint32_t window) const;
    /// The patches that the view has placed for a window.
    [[nodiscard]] surface::Window placed(uint32_t window, const surface::Sets& sets) const;

    uint32_t firstRun_ = 0; ///< in the view; all windows one after the other
    uint32_t takenRuns_ = 0;
    uint32_t leastVertices_ = 0;
    std::vector<SuppleLevelDraw> draws_;
};

Levels::~Levels() {
    if (takenRuns_ > 0) {
        view()->giveRuns(firstRun_, takenRuns_);
    }
}

Status Levels::begin() {
    Status built = buildTables();
    if (!built) {
        return built;
    }
    evaluation_.verticesPerInstance = view()->desc().maxVertices;
    Result<surface::Program> program = programFor(tables(), levelOptions(), evaluation_);
    if (!program) {
        return program.error();
    }
    program_ = std::move(*program);
    for (const surface::LodTables::PatchRun& run : tables().lod.runs) {
        leastVertices_ += run.patchCount * surface::lod::sampleCount(surface::rowOf(run.patchClass).form, 1);
    }
    return success();
}

surface::ProgramOptions Levels::levelOptions() const {
    surface::ProgramOptions options = programOptions();
    options.view = true;
    options.lod = true;
    options.viewRuns = view()->maxRuns();
    options.backFaces = view()->leavesBackFaces();
    // With one level an instance, that lies behind the list's entries (Culling::recordList).
    options.levelOffset = (desc_.group.flags & SUPPLE_GROUP_ONE_LEVEL) != 0 ? desc_.group.capacity : 0;
    options.firstMask = Culling::firstMask(desc_.group.capacity);
    options.maskWords = DrawnParts::wordsOf(partCount());
    options.countsHidden = desc_.countsHidden;
    return options;
}

Status Levels::join(const InstanceWindows& windows) {
    std::vector<bool> doubleSided;
    const std::vector<cage::Material>& materials = desc_.asset->character.materials;
    for (const surface::LodTables::PatchRun& run : tables().lod.runs) {
        doubleSided.push_back(run.material < materials.size() && materials[run.material].doubleSided);
    }
    const Result<uint32_t> first = view()->takeRuns(tables().lod, doubleSided, windows.count());
    if (!first) {
        return first.error();
    }
    firstRun_ = *first;
    takenRuns_ = runs() * windows.count();
    layOutDraws(windows.count());
    return success();
}

void Levels::layOutDraws(uint32_t windowCount) {
    for (uint32_t w = 0; w < windowCount; ++w) {
        for (const surface::LodTables::PatchRun& run : tables().lod.runs) {
            const surface::lod::Form form = surface::rowOf(run.patchClass).form;
            for (const uint32_t capacity : surface::lod::kCapacities) {
                const uint32_t samples = surface::lod::sampleCount(form, capacity);
                draws_.push_back({run.material, static_cast<SuppleGrid>(form), capacity, samples,
                                  samples * surface::lod::patchesPerDraw(form, capacity)});
            }
        }
    }
}

Culling::Surface Levels::culledSurface() const {
    Culling::Surface surface;
    surface.sizes = program_.constructionSizes();
    surface.constructions = program_.constructionCount();
    surface.coefficients = view()->poolUnits() > 0 ? tables().poolStride : 0;
    surface.measure = desc_.asset->prepared->measureOf(*built_.scheme->prepared);
    surface.margin = boundsMargin();
    return surface;
}

void Levels::bindOutput(const SurfaceSets::Which& which, SetContents& contents) const {
    const VertexStreams& streams = view()->streams();
    const Stream target = which.previous ? Stream::previousPositions : Stream::vertices;
    contents.buffer(kSurfaceBinding, streams.buffer(target), 0, VK_WHOLE_SIZE);
    // Without a stream, or where only positions are written, the kernels still name it, but do not touch it.
    const Stream tangents = streams.has(Stream::tangents) && !which.previous ? Stream::tangents : target;
    contents.buffer(kTangentBinding, streams.buffer(tangents), 0, VK_WHOLE_SIZE);
    const VkBuffer directions = streams.buffer(Stream::directions);
    contents.buffer(kDirectionBinding, directions != VK_NULL_HANDLE ? directions : memory_.pool(which.pool).buffer(), 0,
                    VK_WHOLE_SIZE);
    for (const StreamRow& row : kStreams) {
        if (row.written == Written::static_) {
            const VkBuffer buffer = streams.buffer(static_cast<Stream>(&row - kStreams));
            contents.buffer(row.binding, buffer != VK_NULL_HANDLE ? buffer : streams.buffer(Stream::vertices), 0,
                            VK_WHOLE_SIZE);
        }
    }
    const VkBuffer words = view()->words();
    contents.buffer(kLodBinding, words, 0, VK_WHOLE_SIZE);
    contents.texels(kLodTexelBinding, VK_FORMAT_R32G32B32A32_UINT, words, 0, view()->wordBytes(), "supple view");
}

void Levels::fillLevels(SuppleLevelOutput& output) const {
    output.draws = draws_.data();
    output.drawCount = static_cast<uint32_t>(draws_.size());
    view()->fillDraws(output, firstRun_);
}

Status Levels::prepareRate(uint32_t) {
    return Error{ErrorCode::argument, desc_.asset->character.name + ": the group has its view's levels, not a rate"};
}

VkDeviceSize Levels::recordUpload(VkCommandBuffer commandBuffer, uint64_t frame, bool changed) {
    if (!desc_.device->mapping.sharesDispatches) { // there it is read from the view's words
        program_.setCamera(view()->levelCamera());
    }
    const VkDeviceSize bytes = Tessellation::recordUpload(commandBuffer, frame, changed);
    pool_ = view()->poolUnits() > 0 ? view()->pool() : pool_;
    return bytes;
}

surface::Window Levels::levelWindow(uint32_t window) const {
    surface::Window result = seen(window);
    result.push.firstRun = firstRun_ + window * runs();
    return result;
}

surface::Window Levels::placed(uint32_t window, const surface::Sets& sets) const {
    surface::Window result;
    result.sets = sets;
    result.push.slots = windows().slots(window);
    result.push.firstSlot = windows().firstSlot(window);
    result.push.firstRun = firstRun_ + window * runs();
    visibility_->tellPool(result.push, desc_.surface);
    result.arguments = view()->words();
    result.firstArgument = view()->dispatchOffset(result.push.firstRun);
    result.argumentStride = sizeof(LodDispatch);
    return result;
}

PassCost Levels::recordEdgeLevels(surface::Round& round) const {
    windows().forEach([&](uint32_t w) { surface::record(round, program_.edgeLevels, levelWindow(w)); });
    return visibility_->cost(program_.edgeLevels.size(), 0);
}

PassCost Levels::recordPatchLevels(gpu::Dispatches& dispatches) const {
    windows().forEach([&](uint32_t w) { surface::record(dispatches, program_.patchLevels, levelWindow(w)); });
    return visibility_->cost(patchesAtLevels(), 0);
}

PassCost Levels::recordDepths(gpu::Dispatches& dispatches) const {
    windows().forEach([&](uint32_t w) { surface::record(dispatches, program_.depths, levelWindow(w)); });
    return {0, 0, findsDepths() && windows().visible > 0};
}

PassCost Levels::recordPlaces(gpu::Dispatches& dispatches) const {
    windows().forEach([&](uint32_t w) { surface::record(dispatches, program_.places, levelWindow(w)); });
    return visibility_->cost(patchesAtLevels(), 0);
}

PassCost Levels::recordDeepen(surface::Round& round) const {
    if (!deepens()) {
        return {};
    }
    windows().forEach([&](uint32_t w) {
        surface::Window listed = levelWindow(w);
        const VkDeviceSize scratch = windows().firstSlot(w) * VkDeviceSize{scratchStride()} * gpu::kVec4Bytes;
        listed.arguments = memory_.scratch().buffer();
        listed.firstArgument = scratch + sizeof(uint32_t) * VkDeviceSize{program_.firstDepthDispatch};
        listed.argumentStride = sizeof(VkDispatchIndirectCommand);
        surface::record(round, program_.deepen, listed);
    });
    return {0, 0, windows().visible > 0};
}

PassCost Levels::recordLevelAttributes(gpu::Dispatches& dispatches) const {
    if (!writesLevelAttributes()) {
        return {};
    }
    windows().forEach([&](uint32_t w) { surface::record(dispatches, program_.attributes, placed(w, sets(w))); });
    return {0, 0, windows().visible > 0};
}

PassCost Levels::recordEvaluate(surface::Round& round) const {
    // The device alone knows how many vertices: SuppleViewStatistics.
    windows().forEach([&](uint32_t w) { surface::record(round, program_.evaluate, placed(w, sets(w))); });
    return {0, 0, windows().visible > 0};
}

PassCost Levels::recordMotion(surface::Round& round) const {
    if (!writesMotion()) {
        return {};
    }
    windows().forEach([&](uint32_t w) { surface::record(round, program_.motion, ofPast(placed(w, pastSets(w)))); });
    return {0, 0, windows().visible > 0};
}

HashedPart Levels::hashedPart(uint32_t) const {
    HashedPart part = hashedPositions(view()->streams());
    part.by = HashedBy::records;
    part.elementCount = view()->desc().maxVertices;
    part.view = view();
    part.firstRun = firstRun_;
    part.runCount = takenRuns_;
    part.patchCount = patchesAtLevels();
    return part;
}

} // namespace

Result<std::unique_ptr<Tessellation>> makeLevels(const TessellationDesc& desc) {
    return begun(std::make_unique<Levels>(desc));
}

} // namespace supple::runtime
