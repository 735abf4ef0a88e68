#include "runtime/view.h"

#include "gpu/barriers.h"
#include "runtime/culling/bounds_kernels.h"
#include "runtime/culling/culling.h"
#include "surface/lod/grid.h"
#include "surface/lod/tables.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace supple::runtime {

using namespace supple::shared;
using surface::lod::Form;

namespace {

static_assert(SUPPLE_GRID_QUAD == kLodQuadForm && SUPPLE_GRID_TRIANGLE_RINGS == kLodTriangleForm &&
              SUPPLE_GRID_QUAD_RINGS == kLodQuadRingsForm && SUPPLE_GRID_PENTAGON_RINGS == kLodPentagonForm);
static_assert(SUPPLE_PRIORITY_COUNT == kPriorityCount);
static_assert(sizeof(LodSolution) <= 16 * sizeof(uint32_t) &&
              sizeof(LodCamera) == (kLodSolution - kLodCamera) * sizeof(uint32_t));
static_assert(kLodAlignment * 4 == 256 && SUPPLE_LOD_BUCKETS(kRunStep) % kLodAlignment == 0 &&
              SUPPLE_LOD_RECORDS(kRunStep) % kLodAlignment == 0 && 4 * kLodBucketStride % kLodAlignment == 0 &&
              kLodBucketStride > kCapacityCount);
static_assert(kMaxViewRuns % kRunStep == 0 && kMaxViewRuns < kNoDispatch && kMaxViewRuns == SUPPLE_MAX_VIEW_RUNS);

constexpr uint32_t kMinSamples = 3;              ///< of a patch: a triangle at capacity 1
constexpr uint32_t kPaddingOfRun = 3 * 64;       ///< surface vertices that whole draw instances may cost a run
constexpr uint32_t kFreeRun = kNoDispatch << 16; ///< the second word of a run of no dispatch
constexpr uint32_t kDefaultRuns = 1024;
/// A patch counts kSplitUnit in 32 bits, and all that have room at their coarsest may fall into one bin.
constexpr uint32_t kMostVertices = kMinSamples * (0xFFFFFFFFu / kSplitUnit + 1u);
static_assert(kMostVertices == SUPPLE_MAX_VIEW_VERTICES);
constexpr VkDeviceSize kCountBytes = VkDeviceSize{kListHeaderWords} * 4; ///< of a group
constexpr VkDeviceSize kSizeBytes = 2 * VkDeviceSize{kSizeRanks} * 4;
/// Where the view's pool ends, and the solution behind it.
constexpr VkDeviceSize kSolvedBytes = (kLodSolution - kLodPoolEnd) * VkDeviceSize{4} + sizeof(LodSolution);
constexpr VkDeviceSize kRecordBytes = VkDeviceSize{kLodRecordWords} * 4;
constexpr VkDeviceSize kRunBytes = VkDeviceSize{kLodRunWords} * 4;
static_assert(sizeof(LodDispatch) == 4 * kLodDispatchWords &&
              sizeof(VkDrawIndexedIndirectCommand) == 4 * kLodDrawWords);

constexpr VkDeviceSize kWordBytesOfRun =
    VkDeviceSize{SUPPLE_LOD_RECORDS(kRunStep) - SUPPLE_LOD_RECORDS(0)} * 4 / kRunStep;

/// How much of a view's words a device can bind: narrow ones read them as texels.
VkDeviceSize wordLimitOf(const gpu::Device& device) {
    return device.mapping.wide ? device.limits.maxStorageBufferRange : device.bufferWindow(16);
}

/// As many as are asked for. Else as many as `maxVertices` has padding for, up to a default and to a quarter of what
/// the device can bind.
uint32_t roomForRuns(const gpu::Device& device, const SuppleViewDesc& desc) {
    const uint32_t most =
        std::min(static_cast<uint32_t>(wordLimitOf(device) / 4 / kWordBytesOfRun) / kRunStep * kRunStep, kDefaultRuns);
    const uint32_t wanted =
        desc.maxRuns > 0 ? desc.maxRuns : std::clamp(desc.maxVertices / kPaddingOfRun + 1, 1u, std::max(most, 1u));
    return std::min((wanted + kRunStep - 1) / kRunStep * kRunStep, kMaxViewRuns);
}

} // namespace

Result<std::shared_ptr<View>> View::create(const gpu::Device& device, surface::Programs& passes,
                                           uint32_t framesInFlight, const SuppleViewDesc& desc) {
    if (desc.maxVertices > kMostVertices) {
        return Error{ErrorCode::limit, "maxVertices is " + std::to_string(desc.maxVertices) + ": a view has at most " +
                                           std::to_string(kMostVertices)};
    }
    auto view = std::make_shared<View>();
    view->device_ = &device;
    view->framesInFlight_ = framesInFlight;
    view->desc_ = desc;
    if (std::all_of(std::begin(desc.elasticities), std::end(desc.elasticities), [](float e) { return e == 0.0f; })) {
        std::copy_n(std::array{1.0f, 0.5f, 0.25f, 0.0f}.begin(), kPriorityCount, view->desc_.elasticities);
    }
    view->hostWords_.resize(kLodSolution);
    const std::vector<uint32_t> patterns = surface::lod::patternWords();
    std::copy(patterns.begin(), patterns.end(), view->hostWords_.begin() + kLodPatterns);
    view->takenRuns_.resize(roomForRuns(device, desc));
    view->runWords_.resize(view->takenRuns_.size() * kLodRunWords);
    view->giveRuns(0, view->maxRuns());
    view->solved_.resize(framesInFlight);
    for (Solved& solved : view->solved_) {
        solved.of.resize(2 * view->takenRuns_.size());
    }
    Status status = view->createBuffers();
    status = status ? view->createSolver(passes) : status;
    if (!status) {
        return status.error();
    }
    return view;
}

Status View::createBuffers() {
    constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    constexpr VkBufferUsageFlags kOutput =
        kStorage | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    const gpu::Device& device = *device_;
    const VkDeviceSize vertices = desc_.maxVertices;
    const VkDeviceSize fixed = recordOffset();
    const VkDeviceSize wordBytes = fixed + vertices / kMinSamples * kRecordBytes;
    const VkDeviceSize wordLimit = wordLimitOf(device);
    const VkDeviceSize records = wordLimit > fixed ? (wordLimit - fixed) / kRecordBytes : 0;
    const VkDeviceSize most = std::min<VkDeviceSize>(
        (records + 1) * kMinSamples - 1, device.limits.maxStorageBufferRange / vertexBytes(desc_.vertexFormat));
    if (records == 0 || vertices > most) {
        return Error{ErrorCode::limit, "maxVertices is " + std::to_string(desc_.maxVertices) +
                                           ": the device's storage-buffer range or its texel-buffer elements allow at "
                                           "most " +
                                           std::to_string(records == 0 ? 0 : most)};
    }
    const std::vector<uint16_t> indices = layOutGrids();
    gpu::BufferPlan plan(buffers_);
    words_ = plan.add(
        {"supple view", wordBytes, kOutput | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT});
    cull_ = plan.add({"supple view, frustum", sizeof(CullView), kStorage | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    sizes_ = plan.add({"supple view, sizes", kSizeBytes + (countsOfView() ? 2 * maxRuns() * kCountBytes : 0),
                       kStorage | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT});
    streams_.plan(plan, StreamSet::ofView(desc_.flags), desc_.vertexFormat, vertices, vertices, 1);
    Status status = planPools(plan, indices.size() * sizeof(uint16_t));
    status = status ? plan.create(device, gpu::MemoryKind::deviceLocal) : status;
    if (!status) {
        return status;
    }
    const gpu::StaticRequest request{"supple view, grid indices", kOutput | VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                                     std::as_bytes(std::span(indices))};
    Result<gpu::StaticBuffers> statics = gpu::StaticBuffers::create(device, {&request, 1});
    if (!statics) {
        return statics.error();
    }
    static_ = std::move(*statics);
    // The host's words are uploaded in the same pass.
    const VkDeviceSize counts = SUPPLE_LOD_COUNTS(maxRuns()) * VkDeviceSize{4};
    clear_.add(device, words_, kLodSolution * VkDeviceSize{4}, (kLodRuns - kLodSolution) * VkDeviceSize{4});
    clear_.add(device, words_, counts, recordOffset() - counts);
    addMember(clear_);
    addMember(static_);
    addMember(indicesRelease_);
    return createMapped();
}

Result<VkDeviceSize> View::poolBytes(VkDeviceSize others, VkDeviceSize most, uint32_t pools) const {
    if (desc_.memoryBytes == 0) {
        return desc_.coefficientBytes;
    }
    const VkDeviceSize least = others + pools * std::max<VkDeviceSize>(desc_.coefficientBytes, kPoolUnitBytes);
    if (least > desc_.memoryBytes) {
        return Error{ErrorCode::limit, "memoryBytes is " + std::to_string(desc_.memoryBytes) +
                                           ": vertices and lists take " + std::to_string(others) +
                                           ", with coefficients at least " + std::to_string(least)};
    }
    return desc_.coefficientBytes > 0 ? desc_.coefficientBytes : std::min((desc_.memoryBytes - others) / pools, most);
}

Status View::planPools(gpu::BufferPlan& plan, VkDeviceSize indexBytes) {
    const VkDeviceSize most = device_->bufferWindow(gpu::kVec4Bytes);
    if (desc_.coefficientBytes > most) {
        return Error{ErrorCode::limit, "coefficientBytes is " + std::to_string(desc_.coefficientBytes) +
                                           ": the device's storage-buffer range or its texel-buffer elements allow at "
                                           "most " +
                                           std::to_string(most)};
    }
    const uint32_t pools = (desc_.flags & SUPPLE_VIEW_MOTION) != 0 ? 2 : 1;
    const Result<VkDeviceSize> bytes = poolBytes(plan.bytes(kPoolUnitBytes) + indexBytes, most, pools);
    if (!bytes) {
        return bytes.error();
    }
    poolUnits_ = static_cast<uint32_t>(*bytes / kPoolUnitBytes);
    for (uint32_t p = 0; poolUnits_ > 0 && p < pools; ++p) {
        pools_[p] = plan.add({"supple view, coefficients", poolUnits_ * kPoolUnitBytes,
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                              gpu::MemoryPurpose::coefficients});
    }
    return success();
}

Status View::createMapped() {
    const gpu::BufferRequest staging{"supple view staging", uploadBytes() * framesInFlight_,
                                     VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    const gpu::BufferRequest readback{"supple view statistics", readbackBytes() * framesInFlight_,
                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    const struct {
        gpu::BufferSet* target;
        const gpu::BufferRequest& wanted;
        gpu::MemoryKind kind;
    } sets[] = {{&staging_, staging, gpu::MemoryKind::upload}, {&readback_, readback, gpu::MemoryKind::readback}};
    for (const auto& [target, wanted, kind] : sets) {
        Result<gpu::BufferSet> set = gpu::BufferSet::create(*device_, {&wanted, 1}, kind);
        if (!set) {
            return set.error();
        }
        *target = std::move(*set);
    }
    return success();
}

std::vector<uint16_t> View::layOutGrids() {
    std::vector<uint16_t> indices;
    for (uint32_t form = 0; form < kLodForms; ++form) {
        for (uint32_t c = 0; c < kCapacityCount; ++c) {
            const std::vector<uint16_t> own =
                surface::lod::gridIndices(static_cast<Form>(form), surface::lod::kCapacities[c]);
            uint32_t* const entry = &hostWords_[kLodGrids + 2 * (form * kCapacityCount + c)];
            entry[0] = static_cast<uint32_t>(indices.size());
            entry[1] = static_cast<uint32_t>(own.size());
            indices.insert(indices.end(), own.begin(), own.end());
        }
    }
    return indices;
}

Status View::createSolver(surface::Programs& passes) {
    const Result<surface::Programs::Solver> solver = passes.prepareSolver();
    if (!solver) {
        return solver.error();
    }
    solver_ = *solver;
    const gpu::ComputeLayout& layout = passes.solverLayout();
    Result<gpu::DescriptorPoolHandle> pool = gpu::createDescriptorPool(*device_, layout, 1, "supple view");
    if (!pool) {
        return pool.error();
    }
    descriptorPool_ = std::move(*pool);
    const Result<VkDescriptorSet> set = gpu::allocateSet(*device_, layout, descriptorPool_.get(), "supple view");
    if (!set) {
        return set.error();
    }
    solverSet_ = *set;
    const gpu::BoundResource words{kLodBinding, {words_.buffer(), 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE};
    gpu::writeSet(*device_, layout, solverSet_, {&words, 1});
    return success();
}

void View::setCamera(const SuppleCameraDesc& camera) {
    camera_ = camera;
    hasCamera_ = true;
}

void View::setDepthPyramid(const std::optional<SuppleDepthPyramidDesc>& pyramid) {
    pyramid_ = pyramid;
    ++pyramidGeneration_;
}

Result<uint32_t> View::takeRuns(const surface::LodTables& lod, const std::vector<bool>& doubleSided, uint32_t windows) {
    const auto each = static_cast<uint32_t>(lod.runs.size());
    const uint64_t wanted = uint64_t{each} * windows;
    uint32_t first = 0, length = 0;
    for (uint32_t r = 0; r < maxRuns() && length < wanted; ++r) {
        length = takenRuns_[r] ? 0 : length + 1;
        first = r + 1 - length;
    }
    if (length < wanted) {
        const auto free = std::count(takenRuns_.begin(), takenRuns_.end(), false);
        return Error{ErrorCode::limit, "the view is full: the group has " + std::to_string(wanted) +
                                           " runs of patches, which must lie side by side; " + std::to_string(free) +
                                           " of the view's " + std::to_string(maxRuns()) + " are free" +
                                           (free >= static_cast<int64_t>(wanted) ? ", but not side by side" : "")};
    }
    const uint32_t end = std::max(endOfRuns_, first + static_cast<uint32_t>(wanted));
    if (end * kPaddingOfRun >= desc_.maxVertices) {
        return Error{ErrorCode::limit, "the view has too few vertices: " + std::to_string(end) +
                                           " runs of patches take " + std::to_string(end * kPaddingOfRun) +
                                           " for padding, maxVertices is " + std::to_string(desc_.maxVertices)};
    }
    for (uint32_t w = 0; w < windows; ++w) {
        uint32_t range = 0;
        for (uint32_t r = 0; r < each; ++r) {
            range += r > 0 && lod.runs[r].patchClass != lod.runs[r - 1].patchClass ? 1 : 0;
            const surface::PatchClass patchClass = lod.runs[r].patchClass;
            const auto form = static_cast<uint32_t>(surface::rowOf(patchClass).form);
            const uint32_t run = first + w * each + r;
            takenRuns_[run] = true;
            runWords_[kLodRunWords * run] =
                form | (doubleSided[r] ? kRunIsDoubleSided : 0) | (surface::hasLines(patchClass) ? kRunHasLines : 0);
            runWords_[kLodRunWords * run + 1] = first | (first + w * each + range) << 16;
            forms_ |= 1u << form;
        }
    }
    endOfRuns_ = end;
    return first;
}

void View::giveRuns(uint32_t first, uint32_t count) {
    for (uint32_t r = first; r < first + count; ++r) {
        takenRuns_[r] = false;
        runWords_[kLodRunWords * r + 1] = kFreeRun | r; // empty buckets of its own
    }
    while (endOfRuns_ > 0 && !takenRuns_[endOfRuns_ - 1]) {
        --endOfRuns_;
    }
}

bool View::takeGroup(uint64_t vertices) {
    if (groupsWithoutRuns_ == maxRuns() || verticesWithoutRuns_ + vertices > 0xFFFFFFFFull) {
        return false;
    }
    ++groupsWithoutRuns_;
    verticesWithoutRuns_ += vertices;
    return true;
}

void View::giveGroup(uint64_t vertices) {
    --groupsWithoutRuns_;
    verticesWithoutRuns_ -= vertices;
}

LodCamera View::lodCamera() const {
    LodCamera camera{};
    camera.orthographic = (camera_.flags & SUPPLE_CAMERA_ORTHOGRAPHIC) != 0 ? 1 : 0;
    std::copy_n(camera_.position, 3, camera.position);
    camera.focal = camera_.pixelsPerUnit;
    camera.nearest = camera_.nearest > 0.0f ? camera_.nearest : 0.01f;
    if (camera_.edgeLength > 0.0f) {
        camera.lengthScale = 1.0f / camera_.edgeLength;
    } else {
        camera.errorScale = 0.75f / (camera_.chordError > 0.0f ? camera_.chordError : 0.25f);
        camera.lengthScale = 1.0f / (camera_.smallestEdge > 0.0f ? camera_.smallestEdge : 3.0f);
    }
    return camera;
}

LodCamera View::levelCamera() const {
    LodCamera camera = lodCamera();
    if (leavesBackFaces() && camera.orthographic != 0) {
        std::copy_n(camera_.direction, 3, camera.position);
    }
    return camera;
}

uint32_t View::budget() const {
    return camera_.vertexBudget > 0 ? std::min(camera_.vertexBudget, desc_.maxVertices) : desc_.maxVertices;
}

uint32_t View::room() const {
    const uint32_t padding = endOfRuns_ * kPaddingOfRun;
    return budget() > padding ? budget() - padding : 0;
}

void View::findRoom() {
    const bool fit = verticesNeeded_ <= room() && poolUnitsNeeded_ <= poolUnits();
    roomInFrame_ = fit ? kRoomForAll : room();
    verticesNeeded_ = poolUnitsNeeded_ = 0;
    groupsInFrame_ = 0;
}

VkDeviceSize View::recordUpload(VkCommandBuffer commandBuffer, uint64_t frame) {
    recordedBefore_ = recordedFrame_;
    recordedFrame_ = frame;
    pool_ = pools_[1].buffer() != VK_NULL_HANDLE ? 1 - pool_ : 0;
    noDraws_.renew();
    if (indicesRelease_.due()) { // they are on the device by now
        indicesRelease_.record(frame);
    }
    VkDeviceSize from = frame % framesInFlight_ * uploadBytes(), bytes = 0;
    const auto copy = [&](VkBuffer target, VkDeviceSize to, const void* source, VkDeviceSize size) {
        std::memcpy(staging_.mapped(0) + from, source, size);
        const VkBufferCopy region{from, to, size};
        device_->vk.CmdCopyBuffer(commandBuffer, staging_.buffer(0), target, 1, &region);
        from += size;
        bytes += size;
    };
    const LodCamera camera = levelCamera();
    std::memcpy(&hostWords_[kLodCamera], &camera, sizeof(camera));
    const CullView cull = cullView();
    copy(cull_.buffer(), 0, &cull, sizeof(cull));
    copy(words_.buffer(), 0, hostWords_.data(), kLodSolution * VkDeviceSize{4});
    if (endOfRuns_ > 0) {
        copy(words_.buffer(), kLodRuns * VkDeviceSize{4}, runWords_.data(), endOfRuns_ * kRunBytes);
    }
    device_->vk.CmdFillBuffer(commandBuffer, sizes_.buffer(), 0, VK_WHOLE_SIZE, 0); // counts of groups too
    return bytes;
}

VkDeviceSize View::uploadBytes() const {
    return kLodSolution * VkDeviceSize{4} + cull_.size() + maxRuns() * kRunBytes;
}

VkDeviceSize View::readbackBytes() const {
    return kSolvedBytes + 2 * maxRuns() * kCountBytes; // of groups with and without runs
}

VkDeviceSize View::recordOffset() const {
    return SUPPLE_LOD_RECORDS(maxRuns()) * VkDeviceSize{4};
}

VkDeviceSize View::dispatchOffset(uint32_t dispatch) const {
    return SUPPLE_LOD_DISPATCHES(maxRuns()) * VkDeviceSize{4} + sizeof(LodDispatch) * VkDeviceSize{dispatch};
}

CullView View::cullView() const {
    CullView view{};
    if (culls()) {
        std::array<float, 16> columns{};
        std::copy_n(camera_.viewProjection, 16, columns.begin());
        const std::array<float, 24> planes = frustumPlanes(columns);
        std::copy(planes.begin(), planes.end(), view.planes);
        view.farthest = camera_.farthest;
        view.smallest = camera_.smallestRadius;
    }
    view.camera = lodCamera();
    // Who takes more of the scaling down goes sooner.
    for (uint32_t p = 0; p < kPriorityCount; ++p) {
        const auto rank =
            static_cast<uint32_t>(std::count_if(std::begin(desc_.elasticities), std::end(desc_.elasticities),
                                                [&](float elasticity) { return elasticity > desc_.elasticities[p]; }));
        view.ranks |= rank << (8 * p);
    }
    return view;
}

void View::recordSolve(VkCommandBuffer commandBuffer, uint32_t priorities) const {
    LodSolvePush push{};
    push.runs = maxRuns();
    push.runCount = endOfRuns_;
    push.limit = room();
    push.room = budget();
    push.priorities = priorities;
    push.forms = forms_;
    push.maxGroups = gpu::maxGroupsInX(*device_);
    push.rated = countsRates() ? 1 : 0;
    std::copy_n(desc_.elasticities, kPriorityCount, push.elasticity);
    const auto dispatch = [&](const gpu::Kernel& kernel, uint64_t workgroups) {
        gpu::bind(*device_, commandBuffer, kernel, solverSet_, push);
        gpu::dispatchLinear(*device_, commandBuffer, workgroups);
    };
    dispatch(solver_.solve, 1);
    gpu::computeBarrier(*device_, commandBuffer);
    dispatch(solver_.count, endOfRuns_);
    gpu::computeBarrier(*device_, commandBuffer);
    dispatch(solver_.place, 1);
}

void View::recordWarmUp(VkCommandBuffer commandBuffer) const {
    gpu::computeBarrier(*device_, commandBuffer);
    for (const gpu::Kernel& kernel : {solver_.solve, solver_.count, solver_.place}) {
        gpu::bind(*device_, commandBuffer, kernel, solverSet_, LodSolvePush{});
        device_->vk.CmdDispatch(commandBuffer, 0, 1, 1);
    }
}

gpu::MemoryUse View::memoryUse() const {
    gpu::MemoryUse use = buffers_.use();
    use += staging_.use();
    use += readback_.use();
    use += static_.use();
    return use;
}

void View::recordReadback(VkCommandBuffer commandBuffer) {
    const uint64_t place = recordedFrame_ % framesInFlight_;
    solved_[place].frame = recordedFrame_;
    solved_[place].groups = 0;
    const VkBufferCopy region{kLodPoolEnd * VkDeviceSize{4}, place * readbackBytes(), kSolvedBytes};
    device_->vk.CmdCopyBuffer(commandBuffer, words_.buffer(), readback_.buffer(0), 1, &region);
}

void View::recordReadback(VkCommandBuffer commandBuffer, const Culling& culling, SolvedGroup group) {
    const uint64_t place = recordedFrame_ % framesInFlight_;
    const uint32_t index = solved_[place].groups++;
    solved_[place].of[index] = group;
    if (!countsOfView()) {
        const VkBufferCopy region{culling.countOffset(), place * readbackBytes() + kSolvedBytes + kCountBytes * index,
                                  kCountBytes};
        device_->vk.CmdCopyBuffer(commandBuffer, culling.list().buffer, readback_.buffer(0), 1, &region);
    }
}

void View::recordCounts(VkCommandBuffer commandBuffer) const {
    const uint64_t place = recordedFrame_ % framesInFlight_;
    if (countsOfView()) {
        const VkBufferCopy region{kSizeBytes, place * readbackBytes() + kSolvedBytes,
                                  kCountBytes * solved_[place].groups};
        device_->vk.CmdCopyBuffer(commandBuffer, sizes_.buffer(), readback_.buffer(0), 1, &region);
    }
}

bool View::countsOfView() const {
    return device_->mapping.sharesDispatches;
}

SuppleViewStatistics View::read(size_t place) const {
    const Solved& solved = solved_[place];
    const std::byte* from = readback_.mapped(0) + place * readbackBytes();
    LodSolution solution;
    std::memcpy(&solution, from + kSolvedBytes - sizeof(solution), sizeof(solution));
    uint32_t units = 0;
    std::memcpy(&units, from, sizeof(units));
    SuppleViewStatistics read{};
    read.coefficientBytes = units * kPoolUnitBytes;
    read.frame = solved.frame;
    std::copy_n(solution.scale, kPriorityCount, read.levelScales);
    read.vertexCount = solution.vertices;
    read.patchCount = solution.patches;
    uint64_t wanted = solution.wanted;
    uint32_t patches = 0;
    for (uint32_t g = 0; g < solved.groups; ++g) {
        std::array<uint32_t, kListHeaderWords> counts{};
        std::memcpy(counts.data(), from + kSolvedBytes + g * kCountBytes, sizeof(counts));
        read.drawnInstanceCount += counts[0];
        read.instanceCount += counts[2] + solved.of[g].unposed;
        read.unposedInstanceCount += solved.of[g].unposed;
        read.droppedInstanceCount += counts[3];
        read.occludedInstanceCount += counts[4];
        patches += counts[0] * solved.of[g].patches;
        wanted += uint64_t{counts[3]} * solved.of[g].leastVertices;
    }
    read.wantedVertexCount = static_cast<uint32_t>(std::min<uint64_t>(wanted, UINT32_MAX));
    read.backFaceCount = patches - solution.counted - solution.hidden;
    read.hiddenPatchCount = solution.hidden;
    read.shortfall = solution.shortfall != 0 || read.droppedInstanceCount > 0 ? 1 : 0;
    return read;
}

std::optional<SuppleViewStatistics> View::statisticsOf(uint64_t completedFrame) const {
    for (size_t place = 0; place < solved_.size(); ++place) {
        if (solved_[place].frame == completedFrame) {
            return read(place);
        }
    }
    return std::nullopt;
}

void View::beginFrame(uint64_t completedFrame) {
    FrameMembers::beginFrame(completedFrame);
    for (size_t i = 0; i < solved_.size(); ++i) {
        if (solved_[i].frame > newest_.frame && solved_[i].frame <= completedFrame) {
            newest_ = read(i);
        }
    }
}

void View::cancelFrame(uint64_t frame) {
    FrameMembers::cancelFrame(frame);
    noDraws_.cancelFrame(frame);
    for (Solved& solved : solved_) {
        solved.frame = solved.frame == frame ? 0 : solved.frame;
    }
}

void View::recordNoDraws(VkCommandBuffer commandBuffer, uint64_t frame) {
    if (!noDraws_.due()) {
        return;
    }
    noDraws_.record(frame);
    if (clear_.recordedIn(frame)) {
        return; // of the same words
    }
    const VkDeviceSize draws = SUPPLE_LOD_DRAWS(maxRuns()) * VkDeviceSize{4};
    device_->vk.CmdFillBuffer(commandBuffer, words_.buffer(), draws, recordOffset() - draws, 0);
}

void View::addTransfers(Transfers& transfers, uint64_t frame) const {
    transfers.add(words_.buffer(), SUPPLE_LOD_BUCKETS(maxRuns()) * VkDeviceSize{4});
    streams_.addTransfers(transfers, true);
    if (indicesRelease_.recordedIn(frame)) {
        transfers.add(static_.buffer(0));
    }
}

void View::fillDraws(SuppleLevelOutput& output, uint32_t firstRun) const {
    const auto words = [&](VkDeviceSize first, VkDeviceSize count, uint32_t stride) {
        return SuppleBufferRange{words_.buffer(), first * 4, count * stride, stride};
    };
    const VkDeviceSize firstDraw = VkDeviceSize{firstRun} * kCapacityCount;
    output.indices = {static_.buffer(0), 0, static_.size(0), 2};
    output.indirect = words(SUPPLE_LOD_DRAWS(maxRuns()) + kLodDrawWords * firstDraw, output.drawCount,
                            sizeof(VkDrawIndexedIndirectCommand));
    output.buckets = words(SUPPLE_LOD_BUCKETS(maxRuns()) + 4 * VkDeviceSize{firstRun} * kLodBucketStride,
                           output.drawCount, sizeof(LodBucket));
    output.patches =
        words(recordOffset() / 4, (words_.size() - recordOffset()) / kRecordBytes, static_cast<uint32_t>(kRecordBytes));
}

} // namespace supple::runtime
