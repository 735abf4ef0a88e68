#include "runtime/group.h"

#include "runtime/group_buffers.h"
#include "surface/grid.h"
#include "surface/lod/tables.h"
#include "surface/shared_samples.h"

#include <algorithm>
#include <bit>

namespace supple::runtime {

namespace {

using namespace supple::shared;
using surface::SchemeId;

// supple.h repeats for C what the shaders and the schemes share.
static_assert(SUPPLE_MAX_RATE == surface::kMaxRate);
static_assert(SUPPLE_MAX_SIDES == surface::kMaxSides);
static_assert(SUPPLE_PATCH_STRIDE == kPatchStride);
static_assert(SUPPLE_DOMAIN_QUAD == kQuadDomain && SUPPLE_DOMAIN_POLAR == kPolarDomain &&
              SUPPLE_DOMAIN_TRIANGLE == kTriangleDomain && SUPPLE_DOMAIN_PENTAGON == kPentagonDomain);
static_assert(SUPPLE_PATCH_REGULAR == kRegularPatch && SUPPLE_PATCH_PERTURBED == kPerturbedPatch &&
              SUPPLE_PATCH_POLAR == kPolarPatch && SUPPLE_PATCH_P3 == kP3Patch && SUPPLE_PATCH_P4 == kP4Patch &&
              SUPPLE_PATCH_P5 == kP5Patch && SUPPLE_PATCH_CATMULL_CLARK == kCatmullClarkPatch &&
              SUPPLE_PATCH_LOOP == kLoopPatch && SUPPLE_PATCH_BLEND == kBlendPatch &&
              SUPPLE_PATCH_BLEND_SHARP == kBlendSharpPatch);
static_assert(SUPPLE_SCHEME_PREP == static_cast<int>(SchemeId::prep) &&
              SUPPLE_SCHEME_PM == static_cast<int>(SchemeId::pm) &&
              SUPPLE_SCHEME_CATMULL_CLARK == static_cast<int>(SchemeId::catmullClark) &&
              SUPPLE_SCHEME_LOOP == static_cast<int>(SchemeId::loop) &&
              SUPPLE_SCHEME_BLEND == static_cast<int>(SchemeId::blend));
static_assert(SUPPLE_DOMAIN_MESH == surface::kDomainCount);
static_assert(SUPPLE_VERTEX_16 == kVertex16 && SUPPLE_VERTEX_24 == kVertex24);

// Descriptor offsets need at most 256-byte alignment (VkPhysicalDeviceLimits): instances of the pool, the deformed
// cage, the surface vertices (16 or 24 bytes each) and their previous positions (12) start on such multiples. Poses do
// where there is more than one window.
constexpr uint32_t kCagePadding = 16;
constexpr uint32_t kVertexPadding = 64;
constexpr uint32_t kPosePadding = 16;
constexpr uint32_t kScratchPadding = 16;

surface::Recipe recipeOf(const SuppleGroupDesc& desc, uint32_t rate, const View* view) {
    surface::Recipe recipe;
    recipe.shared = (desc.flags & SUPPLE_GROUP_SHARED_SAMPLES) != 0;
    recipe.attributes = view != nullptr ? (view->desc().flags & SUPPLE_VIEW_ATTRIBUTES) != 0
                                        : (desc.flags & SUPPLE_GROUP_ATTRIBUTES) != 0;
    if (desc.scheme != SUPPLE_SCHEME_AUTO) {
        recipe.scheme = static_cast<SchemeId>(desc.scheme);
    }
    recipe.lod = view != nullptr && !surface::subdivides(recipe.scheme);
    if (surface::subdivides(recipe.scheme)) {
        recipe.rate = std::bit_ceil(rate);
    } else if (recipe.scheme == SchemeId::blend) {
        recipe.rate = recipe.lod ? 0 : rate;
        recipe.blend.creases = desc.creaseMode == SUPPLE_CREASES_CURVE ? surface::blend::CreaseMode::curve
                                                                       : surface::blend::CreaseMode::cut;
        recipe.blend.sharpThreshold = desc.sharpThreshold > 0.0f ? desc.sharpThreshold : 1.0f;
    } else if (recipe.scheme == SchemeId::prep) {
        recipe.prep.tangentMode = desc.tangentMode == SUPPLE_TANGENTS_PRINTED ? surface::prep::TangentMode::printed
                                                                              : surface::prep::TangentMode::standard;
        recipe.prep.cornerRule = desc.cornerRule == SUPPLE_CORNERS_SMOOTH ? surface::prep::CornerRule::smooth
                                                                          : surface::prep::CornerRule::sharp;
    }
    return recipe;
}

skinning::SkinningMode skinningOf(const SuppleGroupDesc& desc) {
    return desc.skinning == SUPPLE_SKINNING_DUAL_QUATERNION ? skinning::SkinningMode::dualQuaternion
                                                            : skinning::SkinningMode::linear;
}

bool hasCoefficients(const surface::Tables& tables) {
    return std::all_of(tables.ranges.begin(), tables.ranges.end(), [](const surface::PatchRange& range) {
        return surface::coefficientCount(range.patchClass) > 0;
    });
}

} // namespace

Result<std::shared_ptr<Group>> Group::create(const GroupShared& shared, std::shared_ptr<Asset> asset,
                                             const SuppleGroupDesc& desc) {
    auto group = std::make_shared<Group>();
    group->shared_ = shared;
    group->asset_ = std::move(asset);
    group->view_ = shared.view;
    group->capacity_ = desc.capacity;
    group->poseSource_ = desc.poseSource;
    group->oneLevel_ = shared.view && (desc.flags & SUPPLE_GROUP_ONE_LEVEL) != 0;
    const SuppleVertexFormat format = shared.view ? shared.view->desc().vertexFormat : desc.vertexFormat;
    group->output_.vertexFormat = format;
    group->output_.surfaceVertices.stride = format == SUPPLE_VERTEX_24 ? 24 : 16;
    const std::string& name = group->asset_->character.name;
    const uint32_t rate = desc.rate == 0 ? 8 : desc.rate;
    if (desc.scheme == SUPPLE_SCHEME_CAGE) {
        group->scheme_ = std::make_shared<SchemeTables>(); // no patches: every surface pass is empty
    } else {
        const surface::Recipe recipe = recipeOf(desc, rate, shared.view.get());
        Result<std::shared_ptr<SchemeTables>> scheme = group->asset_->tablesFor(*shared.device, recipe);
        if (!scheme) {
            return scheme.error();
        }
        group->scheme_ = *scheme;
        if (shared.view != nullptr && surface::subdivides(recipe.scheme)) {
            const Status rates = group->createRates(recipe);
            if (!rates) {
                return rates.error();
            }
        }
    }
    const surface::Tables& tables = group->scheme_->tables;
    const char* schemeName = surface::schemeName(group->scheme_->recipe.scheme);
    if ((desc.flags & SUPPLE_GROUP_PATCHES) != 0 && !hasCoefficients(tables)) {
        return Error{ErrorCode::argument, name + ": " + schemeName + " has no patch coefficients"};
    }

    group->anyRate_ = tables.rate == 0 && !tables.sharesSamples();
    group->askedRate_ = rate;
    group->maxRate_ = tables.rate == 0 ? rate : tables.rate;
    if (tables.rate != 0) {
        const uint32_t taken = tables.rate << tables.isolationSteps;
        if (taken != rate) {
            const char* rule =
                surface::subdivides(group->scheme_->recipe.scheme) ? " has 2, 4, 8.." : " has an even number of";
            group->rateNote_ = "rate " + std::to_string(rate) + ": " + schemeName + rule +
                               " segments an edge of the cage, here " + std::to_string(taken);
        }
    }
    group->evaluation_.rate = group->maxRate_;
    const uint64_t vertices = group->layOutVertices();
    // Vertex indices are 32 bits on the device.
    if ((vertices + kVertexPadding) * desc.capacity > 0xFFFFFFFFull) {
        return Error{ErrorCode::limit, name + ": " + std::to_string(desc.capacity) + " instances at rate " +
                                           std::to_string(rate) + " need more than 2^32 surface vertices"};
    }
    group->vertexCount_ = static_cast<uint32_t>(vertices);
    if (tables.sharesSamples()) {
        if (vertices > shared.device->limits.maxDrawIndexedIndexValue) {
            return Error{ErrorCode::limit, name + ": " + std::to_string(vertices) + " vertices of a mesh; an index of" +
                                               " this device is at most " +
                                               std::to_string(shared.device->limits.maxDrawIndexedIndexValue)};
        }
        group->mesh_ = surface::sharedMesh(tables, group->evaluation_);
    }
    group->evaluation_.verticesPerInstance = roundUp(group->vertexCount_, kVertexPadding);
    group->evaluation_.cageStride = roundUp(group->asset_->character.cage.vertexCount(), kCagePadding);

    surface::Needs needs;
    needs.vertexFormat = static_cast<uint32_t>(format);
    needs.motion = group->wants(desc, SUPPLE_GROUP_MOTION, SUPPLE_VIEW_MOTION);
    needs.rate = group->evaluation_.rate;
    needs.patches = (desc.flags & SUPPLE_GROUP_PATCHES) != 0;
    needs.view = group->view_ != nullptr;
    needs.lod = group->hasLevels();
    needs.attributes = group->wants(desc, SUPPLE_GROUP_ATTRIBUTES, SUPPLE_VIEW_ATTRIBUTES);
    if (group->view_ != nullptr) {
        const uint32_t flags = group->view_->desc().flags;
        group->evaluation_.attributeOutputs = ((flags & SUPPLE_VIEW_UVS1) != 0 ? kOutputUvs1 : 0) |
                                              ((flags & SUPPLE_VIEW_FACE_UVS) != 0 ? kOutputFaceUvs : 0);
    }
    needs.attributeOutputs = group->evaluation_.attributeOutputs;
    needs.backFaces = needs.view && group->view_->leavesBackFaces();
    Status status = success();
    for (Rate& rate : group->rates_) {
        rate.evaluation.verticesPerInstance = group->evaluation_.verticesPerInstance;
        rate.evaluation.cageStride = group->evaluation_.cageStride;
        rate.evaluation.attributeOutputs = group->evaluation_.attributeOutputs;
    }
    group->forSchemes(
        [&](const SchemeTables& scheme) { status = status ? shared.surface->prepare(scheme.tables, needs) : status; });
    const skinning::SkinningMode mode = skinningOf(desc);
    if (status && group->deforms()) {
        status = shared.deform->prepare(mode, group->asset_->firstInfluences != 0);
    }
    if (status && group->plays()) {
        status = shared.pose->prepare(mode);
        status = status ? group->asset_->makeClips(*shared.device) : status;
    }
    if (status && group->hasRates()) {
        status = shared.bounds->prepareRates();
    }
    if (status) {
        status = group->layOutWindows(desc);
    }
    if (status) {
        if (group->hasLevels()) {
            const auto windows = static_cast<uint32_t>(group->windows_.size());
            std::vector<bool> doubleSided;
            for (const surface::LodTables::Run& run : tables.lod.runs) {
                const std::vector<cage::Material>& materials = group->asset_->character.materials;
                doubleSided.push_back(run.material < materials.size() && materials[run.material].doubleSided);
            }
            const Result<uint32_t> first = group->view_->takeRuns(tables.lod, doubleSided, windows);
            if (!first) {
                return Error{first.error().code, name + ": " + first.error().message};
            }
            group->firstRun_ = *first;
            group->hasRuns_ = true;
        } else if (group->hasRates()) {
            group->hasRuns_ = group->view_->takeGroup(vertices * desc.capacity);
            if (!group->hasRuns_) {
                return Error{ErrorCode::limit, name + ": the view is full: it has " + std::to_string(kMaxRuns) +
                                                   " groups of subdivision, or they have 2^32 vertices"};
            }
        }
        group->slots_ = InstanceSlots(desc.capacity, shared.firstGeneration);
        group->listed_.resize(group->windows_.size());
        const std::vector<uint16_t> indices = group->layOutGrids();
        group->layOutDraws();
        status = group->createBuffers(desc, indices);
    }
    group->mesh_ = {};
    if (status && group->plays()) {
        status = group->createPlayback();
    }
    if (status) {
        status = group->createSets();
    }
    if (!status) {
        return Error{status.error().code, name + ": " + status.error().message};
    }
    group->fillOutput();
    return group;
}

Status Group::layOutWindows(const SuppleGroupDesc& desc) {
    const gpu::Device& device = *shared_.device;
    const surface::Tables& tables = scheme_->tables;
    const skinning::SkinningMode mode = skinningOf(desc);
    // Poses that the host writes on the device need no memory here.
    const uint32_t posed = poseSource_ == SUPPLE_POSES_SET ? capacity_ : 0;
    poses_ = InstancePoses(*asset_, posed, mode, 1);

    // As many instances a window as every bound range can hold.
    const VkDeviceSize texelLimit = device.bufferWindow(16), storageLimit = device.limits.maxStorageBufferRange;
    const VkDeviceSize patchBytes =
        (desc.flags & SUPPLE_GROUP_PATCHES) != 0 ? tables.patches.size() * kPatchStride * kVec4Bytes : 0;
    const VkDeviceSize largest = std::max({VkDeviceSize{evaluation_.cageStride}, VkDeviceSize{tables.poolStride},
                                           VkDeviceSize{scratchElements()}, VkDeviceSize{1}}) *
                                 kVec4Bytes;
    const VkDeviceSize played = plays() ? Playback::windowBytes(*asset_, poses_.layout()) : 0;
    VkDeviceSize fit = texelLimit / std::max<VkDeviceSize>({largest, poses_.instanceBytes(), played});
    for (const VkDeviceSize bytes : {surfaceBytes(), patchBytes}) {
        fit = bytes > 0 ? std::min(fit, storageLimit / bytes) : fit;
    }
    if (fit < capacity_) {
        poses_ = InstancePoses(*asset_, posed, mode, kPosePadding);
        fit = std::min<VkDeviceSize>(fit, texelLimit / poses_.instanceBytes());
    }
    // Two lists, or what the view sees of them: with levels, and once more a rate.
    const VkDeviceSize lists = 2 + (view_ != nullptr ? 1 + 2 * rates_.size() : 0);
    if (!device.mapping.wide && lists * capacity_ > device.limits.maxTexelBufferElements) {
        return Error{ErrorCode::limit,
                     std::to_string(capacity_) + " instances exceed the device's texel-buffer elements"};
    }
    if (fit == 0) {
        return Error{ErrorCode::limit, "one instance exceeds the device's storage-buffer range of " +
                                           std::to_string(storageLimit) + " bytes"};
    }
    windowSize_ = static_cast<uint32_t>(std::min<VkDeviceSize>(fit, capacity_));
    windows_.resize((capacity_ + windowSize_ - 1) / windowSize_);
    for (uint32_t w = 0; w < windows_.size(); ++w) {
        windows_[w].index = w;
    }
    return success();
}

Group::~Group() {
    if (hasRuns_ && hasRates()) {
        view_->giveGroup(uint64_t{vertexCount_} * capacity_);
    } else if (hasRuns_) {
        view_->giveRuns(firstRun_, static_cast<uint32_t>(scheme_->tables.lod.runs.size() * windows_.size()));
    }
}

bool Group::wants(const SuppleGroupDesc& desc, uint32_t groupFlag, uint32_t viewFlag) const {
    return view_ != nullptr ? (view_->desc().flags & viewFlag) != 0 : (desc.flags & groupFlag) != 0;
}

uint32_t Group::scratchElements() const {
    if (!hasLevels()) {
        uint32_t most = 0; // rates take turns
        forSchemes(
            [&](const SchemeTables& scheme) { most = std::max(most, shared_.surface->scratchStride(scheme.tables)); });
        return most;
    }
    const surface::LodTables& lod = scheme_->tables.lod;
    return roundUp((lod.edges.count + kLodPatchLevelWords * lod.patches.count + 3) / 4, kScratchPadding);
}

VkDeviceSize Group::surfaceBytes() const {
    return VkDeviceSize{evaluation_.verticesPerInstance} * output_.surfaceVertices.stride;
}

VkDeviceSize Group::poseUploadBytes() const {
    return poseSource_ == SUPPLE_POSES_SET ? buffers_.size(kPoses) : 0;
}

VkDeviceSize Group::cullUploadBytes() const {
    return culls() ? VkDeviceSize{capacity_} * sizeof(uint32_t) + culling_.tableBytes() : 0;
}

VkDeviceSize Group::listUploadBytes() const {
    return buffers_.size(kInstances) + buffers_.size(kIndirect);
}

Status Group::createBuffers(const SuppleGroupDesc& desc, std::span<const uint16_t> indices) {
    const gpu::Device& device = *shared_.device;
    const surface::Tables& tables = scheme_->tables;
    const VkDeviceSize n = capacity_;
    const bool motion = wants(desc, SUPPLE_GROUP_MOTION, SUPPLE_VIEW_MOTION) && !tables.patches.empty();
    constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    constexpr VkBufferUsageFlags kTexels = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    constexpr VkBufferUsageFlags kCopied = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    constexpr VkBufferUsageFlags kOutput = kStorage | kTexels | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    constexpr VkBufferUsageFlags kVertices = kOutput | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;

    std::vector<gpu::BufferRequest> requests(kBufferCount);
    // What a group with levels has no vertices of its own for is the view's.
    const VkDeviceSize attributeBytes =
        wants(desc, SUPPLE_GROUP_ATTRIBUTES, SUPPLE_VIEW_ATTRIBUTES) ? VkDeviceSize{vertexCount_} * 16 : 0;
    const auto attributesOf = [&](bool present, uint32_t output) {
        return present && (evaluation_.attributeOutputs & output) != 0 ? attributeBytes / 2 : 0;
    };
    const VkDeviceSize poolBytes = n * tables.poolStride * kVec4Bytes;
    requests[kPoses] = {"supple poses", deforms() ? n * poses_.instanceBytes() : 0, kOutput | kCopied};
    requests[kDeformedCage] = {"supple deformed cage", n * evaluation_.cageStride * kVec4Bytes, kVertices | kCopied};
    requests[kPool] = {"supple coefficient pool", poolBytes, kStorage | kTexels | kCopied};
    requests[kSecondPool] = {"supple second coefficient pool", motion ? poolBytes : 0, kStorage | kTexels | kCopied};
    requests[kSurface] = {"supple surface vertices", n * surfaceBytes(), kVertices};
    requests[kPreviousPositions] = {"supple previous positions",
                                    motion ? n * evaluation_.verticesPerInstance * kPreviousPositionBytes : 0,
                                    kVertices};
    requests[kPatchCoefficients] = {
        "supple patch coefficients",
        (desc.flags & SUPPLE_GROUP_PATCHES) != 0 ? n * tables.patches.size() * kPatchStride * kVec4Bytes : 0, kOutput};
    requests[kAttributes] = {"supple surface attributes", attributeBytes, kVertices};
    requests[kUvs1] = {"supple second UV set", attributesOf(tables.uvSets == 2, kOutputUvs1), kVertices};
    requests[kFaceUvs] = {"supple face UVs", attributesOf(tables.faceUvs, kOutputFaceUvs), kVertices};
    requests[kScratch] = {hasLevels() ? "supple levels" : "supple fragments", n * scratchElements() * kVec4Bytes,
                          kStorage | kTexels};
    requests[kInstances] = {"supple instances", 2 * n * sizeof(uint32_t), kOutput | kCopied};
    requests[kIndirect] = {"supple indirect arguments",
                           view_ != nullptr ? 0 : drawRanges_.size() * sizeof(VkDrawIndexedIndirectCommand),
                           kOutput | kCopied | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT};
    attributesPending_ = attributeBytes > 0;
    if (attributeBytes > device.limits.maxStorageBufferRange) {
        return Error{ErrorCode::limit, "surface attributes exceed the device's storage-buffer range"};
    }
    Result<gpu::BufferSet> buffers = gpu::BufferSet::create(device, requests, gpu::MemoryKind::deviceLocal);
    if (!buffers) {
        return buffers.error();
    }
    buffers_ = std::move(*buffers);

    Status culling = createCulling();
    if (!culling) {
        return culling;
    }
    std::vector<gpu::BufferRequest> staging(kStagingCount);
    staging[kCullStaging] = {"supple list staging of culling", cullUploadBytes() * shared_.framesInFlight,
                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    staging[kPoseStaging] = {"supple pose staging", poseUploadBytes() * shared_.framesInFlight,
                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    staging[kListStaging] = {"supple list staging", listUploadBytes() * shared_.framesInFlight,
                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
    Result<gpu::BufferSet> stagingSet = gpu::BufferSet::create(device, staging, gpu::MemoryKind::upload);
    if (!stagingSet) {
        return stagingSet.error();
    }
    staging_ = std::move(*stagingSet);

    if (hasLevels()) {
        return success(); // the view has them
    }
    return createStatics(tables.sharesSamples() ? std::as_bytes(std::span(mesh_.indices)) : std::as_bytes(indices));
}

std::vector<uint16_t> Group::layOutGrids() {
    // The indices of every domain in use and every rate that may be set or chosen, one after the other.
    std::vector<uint32_t> rates;
    for (const Rate& rate : rates_) {
        rates.push_back(rate.evaluation.rate);
    }
    const bool none = hasLevels() || hasRates() || scheme_->tables.sharesSamples();
    for (uint32_t rate = anyRate_ ? 1 : maxRate_; !none && rate <= maxRate_; ++rate) {
        rates.push_back(rate);
    }
    std::vector<uint16_t> indices;
    for (const uint32_t rate : rates) {
        std::array<Grid, surface::kDomainCount>& grids = grids_.emplace_back();
        for (const surface::DrawRange& range : scheme_->tables.drawRanges) {
            Grid& grid = grids[static_cast<size_t>(range.domain)];
            if (grid.indexCount == 0) {
                const std::vector<uint16_t> own = surface::gridIndices(range.domain, rate);
                grid = {static_cast<uint32_t>(indices.size()), static_cast<uint32_t>(own.size())};
                indices.insert(indices.end(), own.begin(), own.end());
            }
        }
    }
    return indices;
}

Status Group::createStatics(std::span<const std::byte> indices) {
    const gpu::StaticRequest request{"supple grid indices",
                                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
                                         VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                                     indices};
    Result<gpu::StaticBuffers> statics = gpu::StaticBuffers::create(*shared_.device, {&request, 1});
    if (!statics) {
        return statics.error();
    }
    static_ = std::move(*statics);
    return success();
}

Status Group::createCulling() {
    if (view_ == nullptr) {
        return success();
    }
    const surface::Tables& tables = scheme_->tables;
    std::vector<uint32_t> elements;
    for (const surface::Construction& c : tables.constructions) {
        elements.push_back(c.section.count);
    }
    if (hasLevels()) {
        elements.push_back(tables.lod.edges.count);
        elements.push_back(tables.lod.patches.count);
    }
    const std::vector<Culling::Rate> rates = cullingRates();
    const cage::Cage& cage = asset_->character.cage;
    Culling::Desc desc;
    desc.device = shared_.device;
    desc.pass = shared_.bounds;
    desc.occlusion = (view_->desc().flags & SUPPLE_VIEW_OCCLUSION) != 0 ? shared_.occlusion : nullptr;
    desc.framesInFlight = shared_.framesInFlight;
    desc.capacity = capacity_;
    desc.windowSize = windowSize_;
    desc.windows = static_cast<uint32_t>(windows_.size());
    desc.cageVertices = cage.vertexCount();
    desc.cageStride = evaluation_.cageStride;
    desc.margin = surface::boundsMargin(scheme_->recipe.scheme, cage);
    desc.cages = buffers_.buffer(kDeformedCage);
    desc.hostList = buffers_.buffer(kInstances);
    desc.view = view_->buffer(View::kCull);
    desc.sizes = view_->buffer(View::kSizes);
    desc.words = view_->buffer(View::kWords);
    // Rates count along edges of the cage, levels along those of patches.
    desc.measure = surface::lod::measureInstance(cage, hasLevels() ? tables.isolationSteps : 0, tables.lod.charts);
    for (const surface::LodTables::Run& run : tables.lod.runs) {
        desc.leastVertices += run.patchCount * surface::lod::sampleCount(surface::lod::formOf(run.patchClass), 1);
    }
    if (hasRates()) {
        desc.leastVertices = rates.front().vertices;
    }
    desc.elements = elements;
    desc.firstRate = 1u << tables.isolationSteps;
    desc.rates = rates;
    Result<Culling> culling = Culling::create(desc);
    if (!culling) {
        return culling.error();
    }
    culling_ = std::move(*culling);
    return success();
}

Status Group::createPlayback() {
    Result<Playback> playback = Playback::create(
        {shared_.device, shared_.pose, asset_.get(), poses_.layout(), capacity_, windowSize_, shared_.framesInFlight,
         buffers_.buffer(kPoses), buffers_.buffer(kInstances), buffers_.size(kInstances)});
    if (!playback) {
        return playback.error();
    }
    playback_ = std::move(*playback);
    return success();
}

Status Group::setRate(uint32_t rate) {
    const std::string& name = asset_->character.name;
    if (hasLevels()) {
        return Error{ErrorCode::argument, name + ": the group has its view's levels, not a rate"};
    }
    if (!anyRate_) {
        if (rate == askedRate_) {
            return success();
        }
        if (scheme_->tables.sharesSamples()) {
            return Error{ErrorCode::argument, name + ": the indices of shared samples are made for rate " +
                                                  std::to_string(askedRate_) + " alone"};
        }
        return Error{ErrorCode::argument, name + ": the tables of " + surface::schemeName(scheme_->recipe.scheme) +
                                              " are made for rate " + std::to_string(askedRate_) + " alone"};
    }
    if (rate == 0 || rate > maxRate_) {
        return Error{ErrorCode::range, name + ": rate " + std::to_string(rate) + " of at most " +
                                           std::to_string(maxRate_) + ", with which the group was created"};
    }
    if (rate == evaluation_.rate) {
        return success(); // the attributes stand
    }
    evaluation_.rate = rate;
    vertexCount_ = static_cast<uint32_t>(evaluation_.layOut(scheme_->tables));
    attributesPending_ = buffers_.size(kAttributes) > 0;
    layOutDraws();
    fillRates();
    return success();
}

void Group::layOutDraws() {
    if (hasLevels()) {
        for (size_t w = 0; w < windows_.size(); ++w) {
            for (const surface::LodTables::Run& run : scheme_->tables.lod.runs) {
                for (const uint32_t capacity : surface::lod::kCapacities) {
                    const surface::lod::Form form = surface::lod::formOf(run.patchClass);
                    const uint32_t samples = surface::lod::sampleCount(form, capacity);
                    lodDraws_.push_back({run.material, static_cast<SuppleGrid>(form), capacity, samples,
                                         samples * surface::lod::patchesPerDraw(form, capacity)});
                }
            }
        }
        output_.lodDraws = lodDraws_.data();
        output_.lodDrawCount = static_cast<uint32_t>(lodDraws_.size());
        return;
    }
    drawsChanged_ = true;
    output_.rate = evaluation_.rate;
    output_.vertexCount = vertexCount_;
    if (scheme_->tables.sharesSamples()) {
        for (const surface::SharedMesh::Range& from : mesh_.ranges) {
            drawRanges_.push_back(
                {0, 1, from.material, SUPPLE_DOMAIN_MESH, vertexCount_, 0, from.firstIndex, from.indexCount});
        }
        rateOutputs_.push_back({evaluation_.rate, 0, static_cast<uint32_t>(drawRanges_.size()), {}});
        output_.drawRanges = drawRanges_.data();
        output_.drawRangeCount = static_cast<uint32_t>(drawRanges_.size());
        return;
    }
    drawRanges_.clear();
    rateOutputs_.clear();
    uint32_t firstVertex = 0;
    const auto add = [&](uint32_t rate, const std::array<Grid, surface::kDomainCount>& grids) {
        SuppleRate output{rate, static_cast<uint32_t>(drawRanges_.size()), 0, {}};
        for (const surface::DrawRange& from : scheme_->tables.drawRanges) {
            const Grid& grid = grids[static_cast<size_t>(from.domain)];
            SuppleDrawRange range{};
            range.domain = static_cast<SuppleDomain>(from.domain);
            range.firstPatch = from.firstPatch;
            range.patchCount = from.patchCount;
            range.material = from.material;
            range.samplesPerPatch = surface::sampleCount(from.domain, rate);
            range.firstVertex = firstVertex;
            range.firstIndex = grid.firstIndex;
            range.indexCount = grid.indexCount;
            firstVertex += range.patchCount * range.samplesPerPatch;
            drawRanges_.push_back(range);
            ++output.drawRangeCount;
        }
        rateOutputs_.push_back(output);
    };
    for (size_t r = 0; r < rates_.size(); ++r) {
        add(rates_[r].evaluation.rate, grids_[r]);
    }
    if (rates_.empty()) {
        add(evaluation_.rate, grids_[anyRate_ ? evaluation_.rate - 1 : 0]);
    }
    output_.drawRanges = drawRanges_.data();
    output_.drawRangeCount = static_cast<uint32_t>(drawRanges_.size());
}

void Group::fillOutput() {
    const auto whole = [&](BufferIndex index, VkDeviceSize stride) {
        return SuppleBufferView{buffers_.buffer(index), 0, buffers_.size(index), static_cast<uint32_t>(stride)};
    };
    SuppleGroupOutput& o = output_;
    o.structSize = sizeof(o);
    o.capacity = capacity_;
    o.patchCount = static_cast<uint32_t>(scheme_->tables.patches.size());
    o.verticesPerInstance = evaluation_.verticesPerInstance;
    o.cageVertexCount = asset_->character.cage.vertexCount();
    o.cageVerticesPerInstance = evaluation_.cageStride;
    o.surfaceVertices = whole(kSurface, o.surfaceVertices.stride);
    o.attributes = whole(kAttributes, 16);
    o.uvs1 = whole(kUvs1, 8);
    o.faceUvs = whole(kFaceUvs, 8);
    o.deformedCage = whole(kDeformedCage, 16);
    o.patchCoefficients = whole(kPatchCoefficients, 16);
    o.previousPositions = whole(kPreviousPositions, kPreviousPositionBytes);
    o.poses = whole(kPoses, poses_.instanceBytes());
    o.instances = whole(kInstances, sizeof(uint32_t));
    o.instances.size /= 2; // the second list is the passes'
    o.indirect = whole(kIndirect, sizeof(VkDrawIndexedIndirectCommand));
    o.deviceBytes = buffers_.allocatedBytes() + static_.deviceBytes() + playback_.deviceBytes();
    if (culls()) {
        o.deviceBytes += culling_.deviceBytes();
        o.instances = {culling_.list(), 0, VkDeviceSize{capacity_} * sizeof(uint32_t), sizeof(uint32_t)};
        o.bounds = {culling_.bounds(), 0, culling_.boundsBytes(), 32};
    }
    fillRates();
    if (!hasLevels()) {
        o.gridIndices = {static_.buffer(kGridIndices), 0, static_.size(kGridIndices),
                         scheme_->tables.sharesSamples() ? 4u : 2u};
        return;
    }
    const auto ofView = [&](View::BufferIndex index, VkDeviceSize stride) {
        return SuppleBufferView{view_->buffer(index), 0, view_->size(index), static_cast<uint32_t>(stride)};
    };
    o.surfaceVertices = ofView(View::kSurface, o.surfaceVertices.stride);
    o.previousPositions = ofView(View::kPreviousPositions, kPreviousPositionBytes);
    o.attributes = ofView(View::kAttributes, 16);
    o.uvs1 = ofView(View::kUvs1, 8);
    o.faceUvs = ofView(View::kFaceUvs, 8);
    o.gridIndices = {view_->indices(), 0, view_->indexBytes(), 2};
    const auto words = [&](VkDeviceSize first, VkDeviceSize count, uint32_t stride) {
        return SuppleBufferView{view_->buffer(View::kWords), first * 4, count * stride, stride};
    };
    const VkDeviceSize firstDraw = VkDeviceSize{firstRun_} * kCapacityCount;
    o.indirect = words(kLodDraws + 5 * firstDraw, lodDraws_.size(), sizeof(VkDrawIndexedIndirectCommand));
    o.lodBuckets = words(kLodBuckets + 4 * VkDeviceSize{firstRun_} * kLodBucketStride, lodDraws_.size(), 16);
    o.lodPatches =
        words(kLodRecords, (view_->size(View::kWords) / 4 - kLodRecords) / kLodRecordWords, kLodRecordWords * 4);
}

} // namespace supple::runtime
