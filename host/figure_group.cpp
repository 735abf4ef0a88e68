#include "host/figure.h"

#include "host/coarse_grid.h"
#include "host/patches.h"

#include <algorithm>
#include <cstring>

namespace supple::host {

namespace {

/// Triangles a shadow map may cost before its grid is made coarser: four segments to a side of 500 quads.
constexpr uint64_t kShadowTrianglesCpu = 16'500;
constexpr uint64_t kShadowTrianglesGpu = 1'500'000;

/// The first `used` positions of each instance. What fills its stride up to the next instance is never written.
std::vector<glm::vec3> positionsOf(const std::vector<std::byte>& bytes, uint32_t stride, uint32_t capacity,
                                   size_t perInstance, size_t used) {
    std::vector<glm::vec3> positions;
    positions.reserve(used * capacity);
    for (size_t instance = 0; instance < capacity; ++instance) {
        for (size_t i = 0; i < used; ++i)
            std::memcpy(&positions.emplace_back(), bytes.data() + (instance * perInstance + i) * stride,
                        sizeof(glm::vec3));
    }
    return positions;
}

/// What a surface that has several rates draws at one of them.
GroupOutput atRate(GroupOutput output, const SuppleRate& rate) {
    output.info.instances = rate.instances;
    output.grid.rate = rate.rate;
    output.grid.drawRanges += rate.firstDrawRange;
    output.grid.drawRangeCount = rate.drawRangeCount;
    output.grid.indirect.offset += VkDeviceSize{rate.firstDrawRange} * output.grid.indirect.stride;
    return output;
}

std::vector<SurfaceDraw> drawsOf(const SuppleGridOutput& grid) {
    std::vector<SurfaceDraw> draws;
    for (const SuppleDrawRange& range : std::span(grid.drawRanges, grid.drawRangeCount)) {
        SurfaceDraw& draw = draws.emplace_back();
        draw.material = range.material;
        draw.part = range.part;
        draw.push.rate = grid.rate;
        draw.push.verticesPerInstance = grid.verticesPerInstance;
        draw.push.firstPatch = range.firstPatch;
        draw.push.patchCount = range.patchCount;
        draw.push.domain = static_cast<uint32_t>(range.domain);
        draw.push.samplesPerPatch = range.samplesPerPatch;
        draw.push.firstVertex = range.firstVertex;
    }
    return draws;
}

std::vector<SurfaceDraw> drawsOf(const SuppleLevelOutput& levels) {
    std::vector<SurfaceDraw> draws;
    for (uint32_t i = 0; i < levels.drawCount; ++i) {
        const SuppleLevelDraw& from = levels.draws[i];
        const bool rings = from.grid != SUPPLE_GRID_QUAD;
        SurfaceDraw& draw = draws.emplace_back();
        draw.material = from.material;
        draw.part = kManyParts;
        draw.push.flags = shared::kDrawLevels;
        draw.push.rate = from.capacity;
        draw.push.verticesPerInstance = from.verticesPerInstance;
        draw.push.firstPatch = i;
        draw.push.patchCount = from.grid == SUPPLE_GRID_TRIANGLE_RINGS   ? 3u
                               : from.grid == SUPPLE_GRID_PENTAGON_RINGS ? 5u
                                                                         : 4u;
        draw.push.domain = rings ? shared::kDrawRings : shared::kDrawQuad;
        draw.push.samplesPerPatch = from.samplesPerPatch;
    }
    return draws;
}

/// The first cage vertex of the first face of a part.
uint32_t firstVertexOf(const CageMesh& cage, uint32_t part) {
    const auto face = std::find(cage.parts.begin(), cage.parts.end(), part);
    return cage.corners[face == cage.parts.end() ? 0 : cage.faceStarts[face - cage.parts.begin()]];
}

/// With tangents for normal maps, if the group can have them.
Status createWithTangents(Context& context, SuppleGroupDesc desc, bool tangents, SuppleGroup& group) {
    if (tangents) {
        desc.flags |= SUPPLE_GROUP_TANGENTS;
        Status status = context.check(suppleCreateGroup(context.handle(), &desc, &group), "suppleCreateGroup");
        if (status || status.error().code != ErrorCode::argument)
            return status;
        desc.flags &= ~uint32_t{SUPPLE_GROUP_TANGENTS}; // a scheme that was named may have none
    }
    return context.check(suppleCreateGroup(context.handle(), &desc, &group), "suppleCreateGroup");
}

} // namespace

Result<std::unique_ptr<FigureGroup>> FigureGroup::create(Figure& figure, const GroupOptions& options) {
    Context& context = figure.context();
    std::unique_ptr<FigureGroup> group(new FigureGroup(figure));
    const bool tangents = figure.materials().needTangents();
    SuppleGroupDesc desc{};
    desc.structSize = sizeof desc;
    if (options.levels) {
        Result<std::unique_ptr<LevelView>> levels = LevelView::create(context, options.vertexFormat, tangents);
        if (!levels)
            return levels.error();
        group->levels_ = std::move(*levels);
        desc.view = group->levels_->handle(); // which has the flags
    } else {
        desc.flags = SUPPLE_GROUP_ATTRIBUTES;
        if (options.sharedSamples)
            desc.flags |= SUPPLE_GROUP_INDEXED_MESH;
        if (options.traced)
            desc.flags |= SUPPLE_GROUP_RAY_TRACING;
    }
    if (options.plays) {
        desc.poseSource = SUPPLE_POSES_PLAYBACK;
        desc.flags |= SUPPLE_GROUP_TRANSITIONS;
        desc.flags |= options.springs ? SUPPLE_GROUP_SPRINGS | SUPPLE_GROUP_SOFT : 0;
        group->plays_ = true;
        group->swings_ = options.springs;
    }
    desc.asset = figure.asset();
    desc.capacity = options.instances;
    desc.scheme = options.scheme;
    desc.rate = options.rate;
    desc.vertexFormat = options.vertexFormat;
    desc.skinning = options.skinning;
    desc.uvInterpolation = options.uvInterpolation;
    desc.partSchemes = options.partSchemes.data();
    desc.partSchemeCount = static_cast<uint32_t>(options.partSchemes.size());
    SuppleBlendOptions blend{};
    blend.structSize = sizeof blend;
    blend.creaseMode = options.creaseMode;
    blend.sharpThreshold = options.sharpThreshold;
    desc.blend = &blend;
    SuppleFragmentsOptions fragments{};
    fragments.structSize = sizeof fragments;
    fragments.rules = options.fragmentRules;
    desc.fragments = &fragments;
    if (const Status status = createWithTangents(context, desc, tangents && !options.levels, group->group_); !status)
        return status.error();
    if (const Status status = context.createInstances(group->group_, options.instances, group->instances_); !status)
        return status.error();
    group->visible_.assign(options.instances, true);
    group->visibleParts_.assign(figure.partNames().size(), true);
    if (const Status status = group->readSurfaces(); !status)
        return status.error();
    return group;
}

Status FigureGroup::readSurfaces() {
    Context& context = figure_.context();
    // The renderer binds each output whole; a crowd larger than that would be drawn in windows of instances.
    const VkDeviceSize limit = context.device().properties().limits.maxStorageBufferRange;
    uint32_t count = 1;
    for (uint32_t index = 0; index < count; ++index) {
        GroupOutput output;
        const SuppleResult result = getGroupOutput(context.handle(), group_, output, index);
        if (const Status status = context.check(result, "suppleGetGroupInfo"); !status)
            return status.error();
        count = output.info.surfaceCount;
        for (const SuppleBufferRange& view : {output.streams.vertices, output.info.deformedCage}) {
            if (view.size > limit)
                return Error{ErrorCode::limit, figure_.path() + ": " + std::to_string(view.size) +
                                                   " bytes to draw at once; a storage buffer of this device holds " +
                                                   std::to_string(limit) + ": lower the rate or the instances"};
        }
        if (const Status status = addSurface(output, index); !status)
            return status.error();
    }
    return success();
}

Status FigureGroup::addSurface(const GroupOutput& output, uint32_t index) {
    const uint32_t copies = std::max(output.grid.rateCount, 1u); // levels, and a cage alone, have no rates
    for (uint32_t copy = 0; copy < copies; ++copy) {
        FigureSurface& surface = surfaces_.emplace_back();
        surface.output = output.grid.rateCount > 1 ? atRate(output, output.grid.rates[copy]) : output;
        surface.edgeRate = surface.output.grid.rate * surface.output.surface.patchesPerEdge;
        surface.draws = surface.output.hasLevels() ? drawsOf(output.levels) : drawsOf(surface.output.grid);
        if (const Status status = uploadTables(surface, index); !status)
            return status.error();
    }
    return success();
}

Status FigureGroup::setLevelCamera(const Camera& camera, uint32_t height, float chordError) {
    return levels_->setCamera(camera, height, chordError);
}

std::optional<SuppleViewStatistics> FigureGroup::levelStatistics() const {
    return levels_->statistics();
}

uint32_t FigureGroup::edgeRate() const {
    uint32_t most = 0;
    for (const FigureSurface& surface : surfaces_)
        most = std::max(most, surface.edgeRate);
    return most;
}

SuppleScheme FigureGroup::schemeOfPart(uint32_t part) const {
    const auto own = std::find_if(surfaces_.begin(), surfaces_.end(), [&](const FigureSurface& surface) {
        const std::span<const uint32_t> parts(surface.output.surface.parts, surface.output.surface.partCount);
        return std::binary_search(parts.begin(), parts.end(), part);
    });
    return own->output.surface.scheme; // every part has one
}

FigureGroup::~FigureGroup() {
    release();
}

void FigureGroup::release() {
    if (group_.id != 0)
        suppleDestroyGroup(figure_.context().handle(), group_);
    group_ = {};
}

Status FigureGroup::uploadTables(FigureSurface& surface, uint32_t index) const {
    Context& context = figure_.context();
    Device& device = context.device();
    const Result<std::vector<SupplePatchInfo>> patches = patchesOf(context, group_, index);
    if (!patches)
        return patches.error();
    const CageMesh& cage = figure_.cage();
    std::vector<uint32_t> words;
    words.reserve(shared::kPatchWords * patches->size() + 1);
    for (const SupplePatchInfo& patch : *patches) {
        words.insert(words.end(), {static_cast<uint32_t>(patch.patchClass), figure_.cageFaceStart(patch.face),
                                   cage.sides(patch.face)});
        surface.patchClasses |= 1u << patch.patchClass;
    }
    words.resize(std::max<size_t>(words.size(), 1));
    Result<Buffer> buffer =
        device.uploadBuffer(words.data(), words.size() * sizeof(uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    if (!buffer)
        return buffer.error();
    surface.patches = std::move(*buffer);
    for (SurfaceDraw& draw : surface.draws) {
        if (draw.push.domain == shared::kDrawMesh)
            draw.push.primitive = firstVertexOf(cage, draw.part);
    }
    return uploadCoarseGrids(surface);
}

Status FigureGroup::uploadCoarseGrids(FigureSurface& surface) const {
    Device& device = figure_.context().device();
    const SuppleGridOutput& grid = surface.output.grid;
    const uint64_t budget = device.isCpu() ? kShadowTrianglesCpu : kShadowTrianglesGpu;
    const uint64_t shown = uint64_t{surface.output.surface.patchCount} * surface.output.info.capacity;
    const uint32_t rate = std::max(grid.rate, 1u);           // a cage alone has none
    const uint32_t fewest = rate < surface.edgeRate ? 1 : 2; // two to an edge of the cage
    uint32_t segments = rate;
    while (segments > fewest && shown * 2 * segments * segments > budget &&
           halvedSegments(segments, rate, fewest) < segments)
        segments = halvedSegments(segments, rate, fewest);
    std::vector<uint16_t> indices;
    for (const SuppleDomain domain :
         {SUPPLE_DOMAIN_QUAD, SUPPLE_DOMAIN_POLAR, SUPPLE_DOMAIN_TRIANGLE, SUPPLE_DOMAIN_PENTAGON}) {
        const std::vector<uint16_t> own = coarseGrid(domain, rate, segments);
        surface.coarseGrids[domain] = {static_cast<uint32_t>(indices.size()), static_cast<uint32_t>(own.size())};
        indices.insert(indices.end(), own.begin(), own.end());
    }
    Result<Buffer> indexBuffer =
        device.uploadBuffer(indices.data(), indices.size() * sizeof(uint16_t), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    if (!indexBuffer)
        return indexBuffer.error();
    surface.coarseIndices = std::move(*indexBuffer);
    return success();
}

Status FigureGroup::pose(uint32_t instance, uint32_t clip, double time) {
    Context& context = figure_.context();
    return context.check(suppleSetClipPose(context.handle(), instances_[instance], clip, time), "suppleSetClipPose");
}

Status FigureGroup::setMorphWeights(uint32_t instance, std::span<const float> weights) {
    Context& context = figure_.context();
    return context.check(suppleSetMorphWeights(context.handle(), instances_[instance],
                                               weights.empty() ? nullptr : weights.data(),
                                               static_cast<uint32_t>(weights.size())),
                         "suppleSetMorphWeights");
}

Status FigureGroup::setVisible(uint32_t instance, bool visible) {
    Context& context = figure_.context();
    visible_[instance] = visible;
    return context.check(suppleSetVisible(context.handle(), instances_[instance], visible ? 1 : 0), "suppleSetVisible");
}

Status FigureGroup::setPartVisible(uint32_t part, bool visible) {
    if (visibleParts_[part] == visible)
        return success();
    Context& context = figure_.context();
    for (const SuppleInstance& instance : instances_) {
        const SuppleResult result = suppleSetPartVisible(context.handle(), instance, part, visible ? 1 : 0);
        if (const Status status = context.check(result, "suppleSetPartVisible"); !status)
            return status.error();
    }
    visibleParts_[part] = visible;
    return success();
}

uint32_t FigureGroup::visibleCount() const {
    return static_cast<uint32_t>(std::count(visible_.begin(), visible_.end(), true));
}

Result<std::vector<glm::vec3>> FigureGroup::readSurface() const {
    std::vector<glm::vec3> all;
    for (const FigureSurface& surface : surfaces_) {
        const SuppleBufferRange& vertices = surface.output.streams.vertices;
        Result<std::vector<std::byte>> bytes = figure_.context().device().readBuffer(vertices);
        if (!bytes)
            return bytes.error();
        const std::vector<glm::vec3> own =
            positionsOf(*bytes, vertices.stride, surface.output.info.capacity, surface.output.grid.verticesPerInstance,
                        surface.output.grid.vertexCount);
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

Status FigureGroup::setValues(std::span<const float> values) {
    largestValue_ = values.empty() ? 0.0f : *std::max_element(values.begin(), values.end());
    size_t first = 0;
    for (FigureSurface& surface : surfaces_) {
        const uint32_t used = surface.output.grid.vertexCount;
        const std::vector<float> own = used > 0
                                           ? std::vector<float>(values.begin() + first, values.begin() + first + used)
                                           : std::vector<float>(1);
        first += used;
        Result<Buffer> buffer = figure_.context().device().uploadBuffer(own.data(), own.size() * sizeof(float),
                                                                        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        if (!buffer)
            return buffer.error();
        surface.values = std::move(*buffer);
    }
    return success();
}

Result<std::vector<glm::vec3>> FigureGroup::readCage() const {
    const SuppleGroupInfo& info = surfaces_.front().output.info;
    Result<std::vector<std::byte>> bytes = figure_.context().device().readBuffer(info.deformedCage);
    if (!bytes)
        return bytes.error();
    return positionsOf(*bytes, info.deformedCage.stride, info.capacity, info.cageVerticesPerInstance,
                       info.cageVertexCount);
}

Result<std::vector<glm::mat4>> FigureGroup::readPalette() const {
    const SuppleGroupInfo& info = surfaces_.front().output.info;
    Result<std::vector<std::byte>> bytes = figure_.context().device().readBuffer(info.poses);
    if (!bytes)
        return bytes.error();
    const auto rowsAt = [&](size_t first) {
        glm::mat4 matrix(1.0f);
        for (int row = 0; row < 3; ++row) {
            glm::vec4 read;
            std::memcpy(&read, bytes->data() + first + 16 * static_cast<size_t>(row), sizeof read);
            for (int column = 0; column < 4; ++column)
                matrix[column][row] = read[column];
        }
        return matrix;
    };
    const bool linear = info.skinning == SUPPLE_SKINNING_LINEAR;
    const size_t each = linear ? 48 : 64, first = linear ? 0 : 48;
    const glm::mat4 transform = linear ? glm::mat4(1.0f) : rowsAt(0);
    std::vector<glm::mat4> palette(figure_.jointNames().size());
    for (size_t j = 0; j < palette.size(); ++j)
        palette[j] = transform * rowsAt(first + each * j);
    return palette;
}

} // namespace supple::host
