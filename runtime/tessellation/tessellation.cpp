#include "runtime/tessellation/tessellation.h"

#include <algorithm>

namespace supple::runtime {

using namespace supple::shared;
using surface::SetKind;

namespace {

constexpr VkFormat kUint1 = VK_FORMAT_R32_UINT;

StreamSet wantedBy(const TessellationDesc& desc) {
    return desc.view != nullptr ? StreamSet::ofView(desc.view->desc().flags) : StreamSet::ofGroup(desc.group.flags);
}

/// The kinds of sets that a program binds.
std::vector<SetKind> setKindsOf(const surface::Program& program) {
    std::vector<SetKind> kinds;
    for (const surface::Steps* steps :
         {&program.vertex, &program.assemble, &program.patch, &program.attributes, &program.edgeLevels,
          &program.patchLevels, &program.places, &program.deepen, &program.evaluate, &program.motion}) {
        for (const surface::Step& step : *steps) {
            if (std::find(kinds.begin(), kinds.end(), step.sets) == kinds.end()) {
                kinds.push_back(step.sets);
            }
        }
    }
    return kinds;
}

} // namespace

Result<std::unique_ptr<Tessellation>> Tessellation::create(const TessellationDesc& asked) {
    if (asked.group.scheme == SUPPLE_SCHEME_CAGE) {
        return makeNoTessellation(asked);
    }
    TessellationDesc desc = asked;
    const cage::Cage& cage = desc.asset->cageOf(desc.piece);
    desc.drawer = surface::drawerOf(static_cast<surface::SchemeId>(desc.group.scheme), cage);
    const surface::Scheme& row = surface::schemeOf(desc.drawer.scheme);
    if (desc.view != nullptr && !row.hasLevels && !row.hasRates()) {
        return Error{ErrorCode::argument,
                     desc.asset->character.name + ": " + row.name + " cannot be drawn in a view yet"};
    }
    if (desc.view != nullptr) {
        return row.hasLevels ? makeLevels(desc) : makeRates(desc);
    }
    const bool indexed = row.isMesh() || (desc.group.flags & SUPPLE_GROUP_INDEXED_MESH) != 0;
    return indexed ? makeIndexedMesh(desc) : makeFixedRate(desc);
}

Tessellation::Tessellation(TessellationDesc desc)
    : desc_(std::move(desc)), askedRate_(askedRate(desc_.group)), scheme_(std::make_shared<SchemeTables>()) {
    scheme_->prepared = std::make_shared<PreparedTables>();
    wanted_ = wantedBy(desc_);
}

Status Tessellation::buildTables() {
    std::optional<uint32_t> viewFlags;
    if (view() != nullptr) {
        viewFlags = view()->desc().flags;
    }
    Result<SurfaceRecipe> recipe =
        surfaceRecipe({desc_.asset->character, desc_.parts, cage(), desc_.group, desc_.drawer.scheme,
                       desc_.schemeChosen, viewFlags, desc_.device->mapping.wide});
    if (!recipe) {
        return recipe.error();
    }
    uvNote_ = std::move(recipe->uvNote);
    Result<std::shared_ptr<SchemeTables>> built = desc_.asset->tablesFor(*desc_.device, recipe->recipe, desc_.piece);
    if (!built) {
        return built.error();
    }
    scheme_ = std::move(*built);
    desc_.group.prep = nullptr; // the caller's
    desc_.group.blend = nullptr;
    const surface::Tables& own = tables();
    const surface::Scheme& scheme = surface::schemeOf(scheme_->recipe().scheme);
    Result<SurfaceOutputs> outputs = surfaceOutputs(outputWish(), own, scheme.name);
    if (!outputs) {
        return outputs.error();
    }
    wanted_ = outputs->streams;
    if (!outputs->patches) {
        desc_.group.flags &= ~uint32_t{SUPPLE_GROUP_PATCHES};
    }
    beginRate_ = beginRate(askedRate_, own, scheme.rates);
    const uint32_t taken = beginRate_ << own.isolationSteps;
    if (own.rate != 0 && taken != askedRate_ && !scheme.isMesh()) {
        rateNote_ = "rate " + std::to_string(askedRate_) + ": " + scheme.name + " has " + scheme.ratesInWords +
                    " segments an edge of the cage, here " + std::to_string(taken);
    }
    evaluation_.rate = beginRate_;
    return success();
}

OutputWish Tessellation::outputWish() const {
    OutputWish wish{desc_.asset->character.name};
    wish.groupFlags = desc_.group.flags;
    wish.format = desc_.group.vertexFormat;
    wish.schemeChosen = desc_.schemeChosen;
    if (view() != nullptr) {
        wish.viewFlags = view()->desc().flags;
        wish.format = view()->desc().vertexFormat;
    }
    return wish;
}

surface::ProgramOptions Tessellation::programOptions() const {
    return programOptionsOf(outputWish(), {wanted_, (desc_.group.flags & SUPPLE_GROUP_PATCHES) != 0}, beginRate_);
}

Status Tessellation::prepare() {
    Result<surface::Program> program = programFor(tables(), programOptions(), evaluation_);
    if (!program) {
        return program.error();
    }
    program_ = std::move(*program);
    return success();
}

Result<surface::Program> Tessellation::programFor(const surface::Tables& tables, const surface::ProgramOptions& options,
                                                  const surface::Evaluation& evaluation) const {
    Result<surface::Program> program = desc_.passes->prepare(tables, options, evaluation);
    if (!program) {
        return Error{program.error().code, desc_.asset->character.name + ": " + program.error().message};
    }
    return program;
}

Status Tessellation::checkVertices(uint64_t vertices) const {
    // Vertex indices are 32 bits on the device.
    if ((vertices + kVertexPadding) * desc_.group.capacity > 0xFFFFFFFFull) {
        return Error{ErrorCode::limit, desc_.asset->character.name + ": " + std::to_string(desc_.group.capacity) +
                                           " instances at rate " + std::to_string(askedRate_) +
                                           " need more than 2^32 surface vertices"};
    }
    return success();
}

Status Tessellation::checkBinding(const InstanceWindows& windows, VkDeviceSize bytes, const char* what) const {
    const VkDeviceSize limit = desc_.device->limits.maxStorageBufferRange, all = bytes * windows.drawSize;
    if (all <= limit) {
        return success();
    }
    std::string text = std::to_string(windows.capacity) + " instances at rate " + std::to_string(askedRate_) +
                       " have " + std::to_string(all) + " bytes of " + what + ", but the device binds at most " +
                       std::to_string(limit) + " at a time: the largest capacity is " + std::to_string(limit / bytes);
    if (view() == nullptr) {
        text += ", or draw by windows (SUPPLE_GROUP_WINDOWS)";
    }
    return Error{ErrorCode::limit, text};
}

Status Tessellation::cutDraws(InstanceWindows& windows, bool byWindows) {
    windows.drawSize = byWindows ? windows.size : windows.capacity;
    const bool patches = (desc_.group.flags & SUPPLE_GROUP_PATCHES) != 0;
    const VkDeviceSize bytes = patches ? tables().patches.size() * kPatchStride * gpu::kVec4Bytes : 0;
    return bytes > 0 ? checkBinding(windows, bytes, "patch coefficients") : success();
}

Status Tessellation::checkRate(uint32_t rate, uint32_t most) const {
    if (rate == 0 || rate > most) {
        return Error{ErrorCode::range, desc_.asset->character.name + ": rate " + std::to_string(rate) + " of at most " +
                                           std::to_string(most) + ", with which the group was created"};
    }
    return success();
}

BoundBytes Tessellation::boundBytes() const {
    const VkDeviceSize patchBytes =
        (desc_.group.flags & SUPPLE_GROUP_PATCHES) != 0 ? tables().patches.size() * kPatchStride * gpu::kVec4Bytes : 0;
    return {std::max(tables().poolStride, scratchStride()) * gpu::kVec4Bytes, patchBytes};
}

void Tessellation::plan(gpu::BufferPlan& device, gpu::BufferPlan&) {
    constexpr VkBufferUsageFlags kScratch =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    const VkDeviceSize n = desc_.group.capacity;
    const VkDeviceSize poolBytes = n * tables().poolStride * gpu::kVec4Bytes;
    const bool motion = wanted_.has(Stream::previousPositions) && !tables().patches.empty();
    const bool patches = (desc_.group.flags & SUPPLE_GROUP_PATCHES) != 0;
    constexpr gpu::MemoryPurpose kCoefficients = gpu::MemoryPurpose::coefficients;
    pools_[0] =
        device.add({"supple coefficient pool", poolBytes, kScratch | VK_BUFFER_USAGE_TRANSFER_DST_BIT, kCoefficients});
    pools_[1] = device.add({"supple second coefficient pool", motion ? poolBytes : 0,
                            kScratch | VK_BUFFER_USAGE_TRANSFER_DST_BIT, kCoefficients});
    patches_ = device.add({"supple patch coefficients",
                           patches ? n * tables().patches.size() * kPatchStride * gpu::kVec4Bytes : 0,
                           kScratch | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, kCoefficients});
    const VkBufferUsageFlags sizes = program_.deepen.empty() ? 0 : VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    scratch_ = device.add(
        {"supple scratch", n * scratchStride() * gpu::kVec4Bytes, kScratch | sizes, gpu::MemoryPurpose::scratch});
}

Status Tessellation::createSets(const gpu::PlannedBuffer& cages, const InstanceListing& listing,
                                const Visibility& visibility) {
    cages_ = cages;
    listing_ = &listing;
    visibility_ = &visibility;
    for (const gpu::PlannedBuffer& pool : pools_) {
        clear_.add(*desc_.device, pool);
    }
    addMember(clear_);
    addMember(scheme_->buffers);
    return makeSets(sets_, *scheme_, program_);
}

Status Tessellation::makeSets(SurfaceSets& target, const SchemeTables& scheme, const surface::Program& program) const {
    const std::vector<SetKind> kinds = setKindsOf(program);
    return target.create({desc_.device, desc_.passes, kinds, windows().count(), writesMotion()},
                         [&](const SurfaceSets::Which& which, SetContents& contents) {
                             bindInput(which, scheme, contents);
                             bindOutput(which, contents);
                         });
}

void Tessellation::bindInput(const SurfaceSets::Which& which, const SchemeTables& scheme, SetContents& contents) const {
    const VkDeviceSize first = windows().firstSlot(which.window), count = windows().slots(which.window);
    const auto bind = [&](uint32_t binding, uint32_t texels, const gpu::PlannedBuffer& buffer, uint32_t stride,
                          const char* name) {
        const VkDeviceSize bytes = stride * gpu::kVec4Bytes;
        contents.buffer(binding, buffer.buffer(), first * bytes, count * bytes);
        contents.texels(texels, gpu::kFloat4, buffer.buffer(), first * bytes, count * bytes, name);
    };
    const VkBuffer table = scheme.buffers.buffer(0);
    const VkDeviceSize tableBytes = scheme.buffers.size(0);
    contents.buffer(kTableHeaderBinding, table, 0, sizeof(TableHeader));
    contents.buffer(kTableBinding, table, 0, tableBytes);
    contents.texels(kTable4TexelBinding, gpu::kUint4, table, 0, tableBytes, "supple surface tables");
    contents.texels(kTable1TexelBinding, kUint1, table, 0, tableBytes, "supple surface table words");
    const uint32_t poolStride = tables().poolStride;
    bind(kPoolBinding, kPoolTexelBinding, pools_[which.pool], poolStride, "supple pool");
    // Without previous positions in a view kernels name it, but do not read it.
    const bool today = which.previous && view() != nullptr;
    bind(kTodaysPoolBinding, kTodaysPoolTexelBinding, pools_[today ? 1 - which.pool : which.pool], poolStride,
         "supple pool");
    bind(kCageBinding, kCageTexelBinding, cages_, tables().cageStride, "supple deformed cage");
    if (scratch_.size() > 0) {
        bind(kScratchBinding, kScratchTexelBinding, scratch_, scratchStride(), "supple scratch");
    } else { // some kernels name it but never read it
        bind(kScratchBinding, kScratchTexelBinding, pools_[which.pool], poolStride, "supple pool");
    }
    if (patches_.size() > 0) {
        const VkDeviceSize bytes = tables().patches.size() * kPatchStride * gpu::kVec4Bytes;
        contents.buffer(kPatchCoefficientBinding, patches_.buffer(), first * bytes, count * bytes);
    }
    contents.buffer(kPairBinding, desc_.pairs->buffer(0), 0, desc_.pairs->size(0));
    const InstanceList list = visibility_->list();
    contents.buffer(kInstanceBinding, list.buffer, 0, VK_WHOLE_SIZE);
    contents.texels(kInstanceTexelBinding, kUint1, list.buffer, 0, list.bytes, "supple instances seen");
}

void Tessellation::addTransfers(Transfers&, uint64_t) const {}

void Tessellation::recordWarmUp(VkCommandBuffer commandBuffer) const {
    recordWarmUp(commandBuffer, program_, sets_);
}

void Tessellation::recordWarmUp(VkCommandBuffer commandBuffer, const surface::Program& program,
                                const SurfaceSets& sets) const {
    const auto nothing = [&](const surface::Steps& steps, const surface::Sets& bound) {
        surface::Window window; // of no instances
        window.sets = bound;
        gpu::computeBarrier(*desc_.device, commandBuffer);
        record(commandBuffer, steps, window);
    };
    for (const surface::Steps* steps :
         {&program.vertex, &program.assemble, &program.patch, &program.attributes, &program.edgeLevels,
          &program.patchLevels, &program.places, &program.deepen, &program.evaluate}) {
        nothing(*steps, sets.at({0, 0, false}));
    }
    if (writesMotion()) {
        nothing(program.motion, sets.at({0, 1, true}));
    }
}

VkDeviceSize Tessellation::recordUpload(VkCommandBuffer, uint64_t, bool) {
    if (writesMotion()) {
        pool_ = 1 - pool_;
    }
    return 0;
}

const surface::Steps& Tessellation::stepsOf(surface::Stage stage) const {
    return stage == surface::Stage::vertex ? program_.vertex : program_.assemble;
}

surface::Window Tessellation::seen(uint32_t window) const {
    surface::Window result = visibility_->window(window, desc_.surface);
    result.sets = sets(window);
    return result;
}

PassCost Tessellation::recordStage(VkCommandBuffer commandBuffer, surface::Stage stage) const {
    windows().forEach([&](uint32_t w) { record(commandBuffer, stepsOf(stage), seen(w)); });
    uint64_t points = 0, coefficients = 0;
    for (const surface::Construction& construction : tables().constructions) {
        if (construction.stage == stage) {
            points += construction.section.count;
            coefficients += construction.coefficients;
        }
    }
    return visibility_->cost(points, coefficients * gpu::kVec4Bytes);
}

PassCost Tessellation::recordPatch(VkCommandBuffer commandBuffer) const {
    if (!writesPatches()) {
        return {};
    }
    windows().forEach([&](uint32_t w) { record(commandBuffer, program_.patch, seen(w)); });
    const uint64_t points = tables().patches.size();
    return visibility_->cost(points, points * kPatchStride * gpu::kVec4Bytes);
}

} // namespace supple::runtime
