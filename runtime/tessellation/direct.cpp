// Grids of samples that nobody stores: the host's shaders evaluate patches while they draw (supple_direct.h).
#include "runtime/tessellation/fixed_rate.h"
#include "surface/direct_tables.h"
#include "surface/patch_records.h"

#include <algorithm>

namespace supple::runtime {

namespace {

class Direct final : public FixedRate {
public:
    explicit Direct(const TessellationDesc& desc) : FixedRate(desc) {}
    [[nodiscard]] Status begin();
    [[nodiscard]] SuppleTessellation kind() const override { return SUPPLE_TESSELLATION_DIRECT; }
    [[nodiscard]] uint32_t gridRate() const override { return 0; } // nobody stores vertices
    // NOLINTNEXTLINE(bugprone-parent-virtual-call): there are no vertices to bind
    [[nodiscard]] BoundBytes boundBytes() const override { return Tessellation::boundBytes(); }
    [[nodiscard]] Status cutDraws(InstanceWindows& windows, bool byWindows) override;
    [[nodiscard]] Status createSets(const SurfaceInput& input, const InstanceListing& listing,
                                    const Visibility& visibility) override;
    [[nodiscard]] gpu::MemoryUse memoryUse() const override;
    void fillDirect(SuppleDirectOutput& output) const override;
    void addTransfers(Transfers& transfers, uint64_t frame) const override;
    void takeRate() override;
    VkDeviceSize recordUpload(VkCommandBuffer commandBuffer, uint64_t frame, bool changed) override;
    PassCost recordEvaluate(surface::Round&) const override { return {}; }
    PassCost recordMotion(surface::Round&) const override { return {}; }
    [[nodiscard]] HashedPart hashedPart(uint32_t) const override { return {}; }

protected:
    void bindOutput(const SurfaceSets::Which& which, SetContents& contents) const override {
        bindStatics(which, contents);
    }
    [[nodiscard]] std::vector<SuppleDrawRange> drawsAt(uint32_t rate) const override;

private:
    [[nodiscard]] Result<surface::DirectTables> makeTables() const;
    void setRanges();

    gpu::StaticBuffers tables_;
    RecordedOnce tablesRelease_;         ///< to the queue family that draws
    std::vector<uint32_t> firstRecords_; ///< by patch range
    std::vector<SupplePatchRange> ranges_;
};

Status Direct::begin() {
    if (Status begun = FixedRate::begin(); !begun) {
        return begun;
    }
    Result<surface::DirectTables> direct = makeTables();
    if (!direct) {
        return direct.error();
    }
    firstRecords_ = std::move(direct->firstRecords);
    setRanges();
    IndexBytes words(std::move(direct->words));
    const gpu::StaticRequest request{"supple patch tables",
                                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                         VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                     words.bytes, std::move(words.keeper)};
    Result<gpu::StaticBuffers> made = gpu::StaticBuffers::create(*desc_.device, {&request, 1});
    if (!made) {
        return made.error();
    }
    tables_ = std::move(*made);
    return success();
}

/// An asset that has not been prepared beforehand lets go of the words of its tables when they are uploaded. Then they
/// are built once more.
Result<surface::DirectTables> Direct::makeTables() const {
    if (!tables().words.empty()) {
        return surface::directTables(tables(), mostRate());
    }
    const std::shared_ptr<const PreparedPiece> piece = desc_.piece != nullptr ? desc_.piece->prepared : nullptr;
    const Result<std::shared_ptr<PreparedTables>> built = desc_.asset->prepared->build(built_.scheme->recipe(), piece);
    return built ? Result<surface::DirectTables>(surface::directTables((*built)->tables, mostRate())) : built.error();
}

/// Ranges of one domain may have patches of several classes.
std::vector<SuppleDrawRange> Direct::drawsAt(uint32_t rate) const {
    std::vector<SuppleDrawRange> draws;
    for (const SuppleDrawRange& all : FixedRate::drawsAt(rate)) {
        const uint32_t end = all.firstPatch + all.patchCount;
        for (uint32_t patch = all.firstPatch; patch < end;) {
            const surface::PatchRange& sameClass = tables().rangeOf(patch);
            SuppleDrawRange draw = all;
            draw.firstPatch = patch;
            draw.patchCount = std::min(end, sameClass.firstPatch + sameClass.section.count) - patch;
            draw.firstVertex = all.firstVertex + (patch - all.firstPatch) * all.samplesPerPatch;
            draws.push_back(draw);
            patch += draw.patchCount;
        }
    }
    return draws;
}

void Direct::setRanges() {
    ranges_.clear();
    for (const SuppleDrawRange& draw : draws_) {
        const surface::PatchRange& of = tables().rangeOf(draw.firstPatch);
        const uint32_t elements = surface::recordElements(tables(), of.patchClass);
        SupplePatchRange range{};
        range.patchClass = static_cast<uint32_t>(of.patchClass);
        range.firstRecord = firstRecords_[&of - tables().ranges.data()] + elements * (draw.firstPatch - of.firstPatch);
        range.recordElements = elements;
        range.tangents = tables().tangents;
        range.faces = tables().faces;
        range.coefficientsPerInstance = tables().poolStride;
        range.rate = evaluation_.rate;
        range.firstPair = SUPPLE_FIRST_PAIR(evaluation_.rate);
        range.patchCount = draw.patchCount;
        range.firstVertex = draw.firstVertex;
        range.samplesPerPatch = draw.samplesPerPatch;
        ranges_.push_back(range);
    }
}

Status Direct::cutDraws(InstanceWindows& windows, bool byWindows) {
    // NOLINTNEXTLINE(bugprone-parent-virtual-call): nor to cut windows by
    const Status cut = Tessellation::cutDraws(windows, byWindows);
    drawWindows_ = windows.drawCount();
    return cut ? checkBinding(windows, tables().poolStride * gpu::kVec4Bytes, "coefficients") : cut;
}

Status Direct::createSets(const SurfaceInput& input, const InstanceListing& listing, const Visibility& visibility) {
    addMember(tables_);
    addMember(tablesRelease_);
    return FixedRate::createSets(input, listing, visibility);
}

gpu::MemoryUse Direct::memoryUse() const {
    gpu::MemoryUse use = FixedRate::memoryUse();
    use += tables_.use();
    return use;
}

void Direct::fillDirect(SuppleDirectOutput& output) const {
    output.layout = SUPPLE_PATCH_LAYOUT;
    output.rangeCount = static_cast<uint32_t>(ranges_.size());
    output.ranges = ranges_.data();
    output.tables = {tables_.buffer(0), 0, tables_.size(0), gpu::kVec4Bytes};
    output.coefficients = {memory_.pool(0).buffer(), 0, memory_.pool(0).size(), gpu::kVec4Bytes};
}

void Direct::addTransfers(Transfers& transfers, uint64_t frame) const {
    FixedRate::addTransfers(transfers, frame);
    transfers.add(memory_.pool(0).buffer());
    if (tablesRelease_.recordedIn(frame)) {
        transfers.add(tables_.buffer(0));
    }
}

void Direct::takeRate() {
    FixedRate::takeRate();
    setRanges();
}

VkDeviceSize Direct::recordUpload(VkCommandBuffer commandBuffer, uint64_t frame, bool changed) {
    if (tablesRelease_.due()) { // they are on the device by now
        tablesRelease_.record(frame);
    }
    return FixedRate::recordUpload(commandBuffer, frame, changed);
}

} // namespace

Result<std::unique_ptr<Tessellation>> makeDirect(const TessellationDesc& desc) {
    return begun(std::make_unique<Direct>(desc));
}

} // namespace supple::runtime
