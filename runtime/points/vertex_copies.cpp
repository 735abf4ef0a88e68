#include "runtime/points/vertex_copies.h"

#include <algorithm>
#include <utility>

namespace supple::runtime {

using namespace supple::shared;

namespace {

uint32_t vertexStride(const Tessellation& surface) {
    SuppleGridOutput grid{};
    surface.fillGrid(grid);
    return grid.verticesPerInstance;
}
uint32_t bytesOfVertex(const Tessellation& surface) {
    return surface.streams()->bytes(Stream::vertices);
}

} // namespace

VertexCopies::VertexCopies(const Source& source, std::vector<Target> targets)
    : source_(source), targets_(std::move(targets)) {
    for (const VertexPoints::Run& run : source_.runs) {
        if (surfaces_.empty() || surfaces_.back() != run.surface) {
            surfaces_.push_back(run.surface);
        }
    }
}

uint32_t VertexCopies::count() const {
    return static_cast<uint32_t>(surfaces_.size() * targets_.size());
}

Status VertexCopies::bind() {
    unbind();
    const auto hasVertices = [&](uint32_t surface) {
        return (*source_.surfaces)[surface].streams()->buffer(Stream::vertices) != VK_NULL_HANDLE;
    };
    if (count() == 0 || !std::all_of(surfaces_.begin(), surfaces_.end(), hasVertices)) {
        return success();
    }
    Status status = sets_.create(*source_.device, source_.kernels->copyLayout(), count(), "supple points on vertices");
    const VkBufferView instances = views_.make(*source_.device, source_.listing->buffer().buffer(), VK_FORMAT_R32_UINT,
                                               0, source_.listing->passBytes(), "supple instances", status);
    if (!status) {
        unbind(); // sets that nothing was written to are not to be bound
        return status;
    }
    size_t set = 0;
    for (const uint32_t surface : surfaces_) {
        for (const Target& target : targets_) {
            writeSet(set++, surface, target, instances);
        }
    }
    return success();
}

void VertexCopies::unbind() {
    sets_ = {};
    views_ = {};
}

void VertexCopies::writeSet(size_t set, uint32_t surface, const Target& target, VkBufferView instances) {
    const Tessellation& own = (*source_.surfaces)[surface];
    const InstanceWindows& windows = source_.listing->windows();
    const VkDeviceSize bytes = VkDeviceSize{vertexStride(own)} * bytesOfVertex(own);
    const gpu::BoundResource resources[] = {
        {kPointVertexBinding,
         {own.streams()->buffer(Stream::vertices), windows.firstSlot(target.window) * bytes,
          windows.slots(target.window) * bytes},
         VK_NULL_HANDLE},
        {kVertexPointBinding, {source_.entries, 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
        {kPointBinding, target.points, VK_NULL_HANDLE},
        {kPointPastBinding, target.pasts, VK_NULL_HANDLE},
        {kInstanceBinding, {source_.listing->buffer().buffer(), 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
        {kInstanceTexelBinding, {}, instances},
    };
    sets_.write(*source_.device, source_.kernels->copyLayout(), set, resources);
}

const VertexPoints::Run* VertexCopies::runOf(uint32_t surface) const {
    const uint32_t rate = (*source_.surfaces)[surface].gridRate();
    const auto found = std::find_if(source_.runs.begin(), source_.runs.end(), [&](const VertexPoints::Run& run) {
        return run.surface == surface && run.rate == rate;
    });
    return found != source_.runs.end() ? &*found : nullptr;
}

uint64_t VertexCopies::points() const {
    uint64_t points = 0;
    for (const uint32_t surface : surfaces_) {
        const VertexPoints::Run* const run = runOf(surface);
        points += run != nullptr ? run->count : 0;
    }
    return points;
}

void VertexCopies::record(gpu::Dispatches& dispatches, size_t target, SupplePointFormat format,
                          VertexPointPush push) const {
    for (size_t s = 0; s < surfaces_.size() && !sets_.empty(); ++s) {
        const VertexPoints::Run* const run = runOf(surfaces_[s]);
        if (run == nullptr) {
            continue;
        }
        const Tessellation& own = (*source_.surfaces)[surfaces_[s]];
        push.firstEntry = run->first;
        push.entryCount = run->count;
        push.vertexWords = bytesOfVertex(own) / static_cast<uint32_t>(sizeof(uint32_t));
        push.instanceWords = vertexStride(own) * push.vertexWords;
        source_.kernels->recordCopies(dispatches, sets_[s * targets_.size() + target], format, push);
    }
}

void VertexCopies::recordWarmUp(gpu::Dispatches& dispatches, SupplePointFormat format) const {
    if (!sets_.empty()) {
        source_.kernels->recordCopies(dispatches, sets_[0], format, {}); // of no instances
    }
}

} // namespace supple::runtime
