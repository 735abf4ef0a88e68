#include "runtime/tessellation/tessellation.h"

#include <algorithm>
#include <utility>

namespace supple::runtime {

using namespace supple::shared;

Result<std::unique_ptr<Tessellation>> Tessellation::create(const TessellationDesc& desc) {
    if (desc.group.scheme == SUPPLE_SCHEME_CAGE) {
        return makeNoTessellation(desc);
    }
    const surface::Scheme& row = surface::schemeOf(schemeIdOf(desc.group, desc.group.scheme));
    if (desc.view != nullptr && !row.hasLevels && !row.hasRates()) {
        return Error{ErrorCode::argument,
                     desc.asset->character.name + ": " + row.name + " cannot be drawn in a view yet"};
    }
    if (desc.view != nullptr) {
        return row.hasLevels ? makeLevels(desc) : makeRates(desc);
    }
    if ((desc.group.flags & SUPPLE_GROUP_DIRECT) != 0) {
        return makeDirect(desc);
    }
    const bool indexed = row.isMesh() || (desc.group.flags & SUPPLE_GROUP_INDEXED_MESH) != 0;
    return indexed ? makeIndexedMesh(desc) : makeFixedRate(desc);
}

Tessellation::Tessellation(TessellationDesc desc) : desc_(std::move(desc)), built_(askedSurface(desc_)) {}

Status Tessellation::buildTables() {
    Result<BuiltSurface> built = buildSurface(desc_);
    if (!built) {
        return built.error();
    }
    built_ = std::move(*built);
    desc_.group.prep = nullptr; // the caller's
    desc_.group.blend = nullptr;
    desc_.group.fragments = nullptr;
    evaluation_.rate = built_.beginRate;
    return success();
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
    Result<surface::Program> program = desc_.programs->prepare(tables, options, evaluation);
    if (!program) {
        return Error{program.error().code, desc_.asset->character.name + ": " + program.error().message};
    }
    return program;
}

Status Tessellation::checkVertices(uint64_t vertices) const {
    // Vertex indices are 32 bits on the device.
    if ((vertices + kVertexPadding) * desc_.group.capacity > 0xFFFFFFFFull) {
        return Error{ErrorCode::limit, desc_.asset->character.name + ": " + std::to_string(desc_.group.capacity) +
                                           " instances at rate " + std::to_string(built_.askedRate) +
                                           " need more than 2^32 surface vertices"};
    }
    return success();
}

Status Tessellation::checkBinding(const InstanceWindows& windows, VkDeviceSize bytes, const char* what) const {
    const VkDeviceSize limit = desc_.device->limits.maxStorageBufferRange, all = bytes * windows.drawSize;
    if (all <= limit) {
        return success();
    }
    std::string text = std::to_string(windows.capacity) + " instances at rate " + std::to_string(built_.askedRate) +
                       " have " + std::to_string(all) + " bytes of " + what + ", but the device binds at most " +
                       std::to_string(limit) + " at a time: the largest capacity is " + std::to_string(limit / bytes);
    if (view() == nullptr) {
        text += ", or draw by windows (SUPPLE_GROUP_WINDOWS)";
    }
    return Error{ErrorCode::limit, text};
}

Status Tessellation::cutDraws(InstanceWindows& windows, bool byWindows) {
    windows.drawSize = byWindows ? windows.size : windows.capacity;
    const VkDeviceSize bytes = built_.outputs.patches ? tables().patches.size() * kPatchStride * gpu::kVec4Bytes : 0;
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
        built_.outputs.patches ? tables().patches.size() * kPatchStride * gpu::kVec4Bytes : 0;
    const uint32_t poolStride = sharedPools()[0].buffer() != VK_NULL_HANDLE ? 0 : tables().poolStride;
    return {std::max(poolStride, scratchStride()) * gpu::kVec4Bytes, patchBytes};
}

bool Tessellation::fits(const Tessellation& leader) const {
    const auto writesPast = [](const Tessellation& surface) {
        return surface.built_.outputs.streams.has(Stream::previousPositions);
    };
    // How deep chains go is the view's affair, and stands among the coefficients.
    return view() != nullptr && leader.view() != nullptr && view()->poolUnits() == 0 && leader.hasBuffers() &&
           leader.view()->poolUnits() == 0 && built_.scheme == leader.built_.scheme && !findsDepths() &&
           !tables().patches.empty() && writesPast(*this) == writesPast(leader);
}

void Tessellation::plan(gpu::BufferPlan& device, gpu::BufferPlan&) {
    const Tessellation* const followed = std::exchange(desc_.leader, nullptr);
    leader_ = followed != nullptr && fits(*followed) ? followed : nullptr;
    SurfaceMemory::Desc desc{desc_.device, desc_.programs, desc_.pairs, desc_.group.capacity, view() != nullptr};
    desc.motion = built_.outputs.streams.has(Stream::previousPositions) && !tables().patches.empty();
    desc.patches = built_.outputs.patches;
    desc.patchCount = static_cast<uint32_t>(tables().patches.size());
    desc.poolStride = tables().poolStride;
    desc.pools = sharedPools();
    desc.leader = leader_ != nullptr ? &leader_->memory_ : nullptr;
    desc.cageStride = tables().cageStride;
    desc.scratchStride = scratchStride();
    desc.sizesInScratch = !program_.deepen.empty();
    memory_.plan(desc, device);
}

Status Tessellation::createSets(const SurfaceInput& input, const InstanceListing& listing,
                                const Visibility& visibility) {
    listing_ = &listing;
    visibility_ = &visibility;
    memory_.attach(input, listing, visibility.list());
    addMember(memory_.clear());
    addMember(built_.scheme->buffers);
    return makeSets(sets_, *built_.scheme, program_);
}

void Tessellation::freeSets() {
    memory_.detach();
    sets_ = {};
}

Status Tessellation::remakeSets() {
    memory_.attach();
    return makeSets(sets_, *built_.scheme, program_);
}

Status Tessellation::makeSets(SurfaceSets& target, const SchemeTables& scheme, const surface::Program& program) const {
    return memory_.makeSets(
        target, scheme.buffers, program,
        [&](const SurfaceSets::Which& which, SetContents& contents) { bindOutput(which, contents); });
}

void Tessellation::addTransfers(Transfers&, uint64_t) const {}

void Tessellation::recordWarmUp(VkCommandBuffer commandBuffer) const {
    if (hasBuffers_) {
        recordWarmUp(commandBuffer, program_, sets_);
    }
}

void Tessellation::recordWarmUp(VkCommandBuffer commandBuffer, const surface::Program& program,
                                const SurfaceSets& sets) const {
    gpu::OwnDispatches dispatches(*desc_.device, commandBuffer);
    const auto nothing = [&](const surface::Steps& steps, const surface::Sets& bound) {
        surface::Window window; // of no instances
        window.sets = bound;
        dispatches->computeBarrier();
        surface::record(*dispatches, steps, window);
    };
    for (const surface::Steps* steps :
         {&program.vertex, &program.assemble, &program.patch, &program.attributes, &program.edgeLevels,
          &program.patchLevels, &program.depths, &program.places, &program.deepen, &program.evaluate}) {
        nothing(*steps, sets.at({0, 0, false}));
    }
    if (writesMotion()) {
        nothing(program.motion, sets.at({0, 1, true}));
    }
}

gpu::TaskNeeds Tessellation::taskNeedsOf(const surface::Program& program) const {
    size_t steps = 2 * program.motion.size(); // instances with a past and without
    for (const surface::Steps* own :
         {&program.vertex, &program.assemble, &program.patch, &program.attributes, &program.edgeLevels,
          &program.patchLevels, &program.depths, &program.places, &program.deepen, &program.evaluate}) {
        steps += own->size();
    }
    const auto windows = listing_->windows().count();
    return {static_cast<uint32_t>(steps) * windows, kSetsOfWindow * windows};
}

VkDeviceSize Tessellation::recordUpload(VkCommandBuffer, uint64_t, bool) {
    if (writesMotion()) {
        pool_ = leader_ != nullptr ? leader_->pool_ : 1 - pool_;
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

PassCost Tessellation::recordStage(surface::Round& round, surface::Stage stage) const {
    if (!constructs_) {
        return {};
    }
    windows().forEach([&](uint32_t w) {
        surface::Window window = visibility_->constructed(w, desc_.surface);
        window.sets = sets(w);
        surface::record(round, stepsOf(stage), window);
    });
    uint64_t points = 0, coefficients = 0;
    for (const surface::Construction& construction : tables().constructions) {
        if (construction.stage == stage) {
            points += isByStencils(construction) ? construction.coefficients : construction.section.count;
            coefficients += construction.coefficients;
        }
    }
    return visibility_->cost(points, coefficients * gpu::kVec4Bytes);
}

PassCost Tessellation::recordPatch(gpu::Dispatches& dispatches) const {
    if (!writesPatches()) {
        return {};
    }
    windows().forEach([&](uint32_t w) { surface::record(dispatches, program_.patch, seen(w)); });
    const uint64_t points = tables().patches.size();
    return visibility_->cost(points, points * kPatchStride * gpu::kVec4Bytes);
}

HashedPart Tessellation::hashedPositions(const VertexStreams& streams) {
    HashedPart part;
    part.words = streams.buffer(Stream::vertices);
    part.elementWords = streams.bytes(Stream::vertices) / sizeof(uint32_t);
    part.keptWords = 3;
    return part;
}

} // namespace supple::runtime
