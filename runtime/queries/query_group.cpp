#include "runtime/queries/query_group.h"

#include "runtime/queries/triangle_faces.h"

#include <algorithm>
#include <utility>

namespace supple::runtime {

using namespace supple::shared;

namespace {

constexpr VkDeviceSize kBoxBytes = 32;
/// 256 MiB.
constexpr uint64_t kMostPieceElements = uint64_t{1} << 24;

} // namespace

uint64_t QueryPieces::mostElements(const gpu::Device& device) {
    return std::min<uint64_t>(kMostPieceElements, device.mapping.wide
                                                      ? device.limits.maxStorageBufferRange / gpu::kVec4Bytes
                                                      : device.limits.maxTexelBufferElements);
}

Result<std::shared_ptr<QueryPieces>> QueryPieces::create(const gpu::Device& device, PieceTable table) {
    const auto keeper = std::make_shared<const std::vector<uint32_t>>(std::move(table.words));
    const gpu::StaticRequest request{"supple query pieces",
                                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                                     std::as_bytes(std::span(*keeper)), keeper};
    Result<gpu::StaticBuffers> made = gpu::StaticBuffers::create(device, {&request, 1});
    if (!made) {
        return made.error();
    }
    auto pieces = std::make_shared<QueryPieces>();
    pieces->table = std::move(*made);
    pieces->ofFaces = std::move(table.ofFaces);
    pieces->count = table.pieceCount;
    pieces->reach = table.reach;
    return pieces;
}

Result<std::shared_ptr<QueryGroup>> QueryGroup::create(QuerySource source, const QueryKernels& kernels,
                                                       std::shared_ptr<QueryPieces> pieces,
                                                       const QueryBuffers& buffers) {
    auto group = std::make_shared<QueryGroup>();
    group->source_ = std::move(source);
    group->kernels_ = &kernels;
    group->pieces_ = std::move(pieces);
    Status status = buffers.areMany() ? group->createTree() : success();
    status = status ? group->createBuffers() : status;
    status = status ? group->createSets(buffers) : status;
    if (!status) {
        return status.error();
    }
    return group;
}

Status QueryGroup::createTree() {
    const InstanceWindows& windows = source_.listing->windows();
    const Result<QueryTree::Plan> plan = QueryTree::planFor(*source_.device, pieces_->count, windows.size);
    if (!plan) {
        return plan.error();
    }
    tree_ = std::make_unique<QueryTree>();
    return tree_->create(*source_.device, kernels_->trees(), pieces_->count, *plan, windows.count());
}

Status QueryGroup::createBuffers() {
    const VkDeviceSize dispatches = VkDeviceSize{dispatchesEach()} * windowCount() * gpu::kVec4Bytes;
    const gpu::BufferRequest request{"supple query boxes", kBoxBytes * source_.listing->windows().capacity + dispatches,
                                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                                     gpu::MemoryPurpose::scratch};
    Result<gpu::BufferSet> made = gpu::BufferSet::create(*source_.device, {&request, 1}, gpu::MemoryKind::deviceLocal);
    if (!made) {
        return made.error();
    }
    boxes_ = std::move(*made);
    const auto words =
        std::make_shared<const std::vector<uint32_t>>(triangleFaces(*source_.surfaces, pieces_->ofFaces));
    const gpu::StaticRequest triangles{"supple query triangles", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                       std::as_bytes(std::span(*words)), words};
    Result<gpu::StaticBuffers> table = gpu::StaticBuffers::create(*source_.device, {&triangles, 1});
    if (!table) {
        return table.error();
    }
    triangles_ = std::make_unique<gpu::StaticBuffers>(std::move(*table));
    return success();
}

Status QueryGroup::createSets(const QueryBuffers& buffers) {
    const gpu::Device& device = *source_.device;
    const InstanceWindows& windows = source_.listing->windows();
    const VkBuffer list = source_.listing->buffer().buffer(), pieces = pieces_->table.buffer(0);
    const VkDeviceSize cageBytes = VkDeviceSize{source_.cageStride} * gpu::kVec4Bytes,
                       pieceBytes = pieces_->table.size(0);
    Status status = sets_.create(device, kernels_->layout(), windows.count(), "supple queries");
    const auto view = [&](VkBuffer buffer, VkFormat format, VkDeviceSize offset, VkDeviceSize size, const char* name) {
        return views_.make(device, buffer, format, offset, size, name, status);
    };
    const VkBufferView table = view(pieces, gpu::kUint4, 0, pieceBytes, "supple query pieces");
    const VkBufferView instances = view(list, VK_FORMAT_R32_UINT, 0, source_.listing->passBytes(), "supple instances");
    for (uint32_t w = 0; w < windows.count() && status; ++w) {
        const VkDeviceSize first = windows.firstSlot(w) * cageBytes, bytes = windows.slots(w) * cageBytes;
        const VkBufferView cages = view(source_.cages, gpu::kFloat4, first, bytes, "supple deformed cage");
        const gpu::BoundResource resources[] = {
            {kPieceBinding, {pieces, 0, pieceBytes}, VK_NULL_HANDLE},
            {kPieceTexelBinding, {}, table},
            {kQueryCageBinding, {source_.cages, first, bytes}, VK_NULL_HANDLE},
            {kQueryCageTexelBinding, {}, cages},
            {kRayBinding, {buffers.rays, 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
            {kBestBinding, {buffers.best, 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
            {kQueryBoxBinding, {boxes_.buffer(0), 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
            {kHitBinding, {buffers.hits, 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
            {kInstanceBinding, {list, 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
            {kInstanceTexelBinding, {}, instances},
            {kTriangleBinding, {triangles_->buffer(0), 0, VK_WHOLE_SIZE}, VK_NULL_HANDLE},
        };
        if (status) {
            sets_.write(device, kernels_->layout(), w, resources);
        }
        if (status && tree_ != nullptr) {
            tree_->write(device, w, resources);
        }
    }
    return status;
}

uint64_t QueryGroup::mostLanes() const {
    return uint64_t{pieces_->count} * source_.listing->windows().capacity;
}

uint32_t QueryGroup::lanes() const {
    uint32_t instances = 0;
    source_.listing->windows().forEach([&](uint32_t w) { instances += source_.listing->windows().listed[w].count; });
    return pieces_->count * instances;
}

template <class F>
void QueryGroup::forWindows(const Batch& batch, F&& record) const {
    const InstanceWindows& windows = source_.listing->windows();
    QueryPush push{};
    push.pieceCount = pieces_->count;
    push.cageStride = source_.cageStride;
    push.vertexCount = source_.vertexCount;
    push.rayCount = batch.rayCount;
    push.firstLane = batch.firstLane;
    push.group = batch.group;
    push.reach = pieces_->reach;
    push.firstTriangle = batch.firstTriangle;
    push.rate = batch.rate;
    push.firstLeaf = pieces_->firstLeaf;
    push.treeCount = tree_ != nullptr ? tree_->plan().count : 0;
    push.turns = tree_ != nullptr ? tree_->plan().turns : 0;
    for (uint32_t w = 0; w < windows.count(); ++w) {
        push.firstEntry = windows.firstEntry(w);
        push.instanceCount = batch.isEmpty ? 0 : windows.listed[w].count;
        push.firstBox = push.firstSlot = windows.firstSlot(w);
        push.writesMisses = batch.writesMisses && w == 0 ? 1 : 0;
        push.firstDispatch = 2 * windows.capacity + dispatchesEach() * w;
        record(sets_[w], push);
        push.firstLane += push.pieceCount * push.instanceCount;
    }
}

void QueryGroup::recordBoxes(gpu::Dispatches& dispatches, const Batch& batch) const {
    forWindows(batch, [&](const gpu::BoundSet& set, const QueryPush& push) {
        if (push.instanceCount > 0) {
            kernels_->recordBoxes(dispatches, set, push);
        }
    });
}

void QueryGroup::recordAim(gpu::Dispatches& dispatches, const Batch& batch) const {
    forWindows(batch, [&](const gpu::BoundSet& set, const QueryPush& push) {
        if (push.instanceCount > 0) {
            kernels_->recordAim(dispatches, set, push);
        }
    });
}

void QueryGroup::recordList(gpu::Dispatches& dispatches, const Batch& batch) const {
    forWindows(batch, [&](const gpu::BoundSet& set, const QueryPush& push) {
        if (push.instanceCount > 0) {
            kernels_->recordList(dispatches, set, push);
        }
    });
}

void QueryGroup::recordPick(gpu::Dispatches& dispatches, const Batch& batch, uint32_t work) const {
    forWindows(batch, [&](const gpu::BoundSet& set, QueryPush push) {
        push.work = work;
        if (push.instanceCount > 0 && push.pieceCount > 0) {
            kernels_->recordPick(dispatches, set, push, boxes_.buffer(0));
        }
    });
}

void QueryGroup::recordTree(gpu::Dispatches& dispatches, const Batch& batch, TreeKernels::Pass pass,
                            uint32_t turn) const {
    const InstanceWindows& windows = source_.listing->windows();
    forWindows(batch, [&](const gpu::BoundSet& /*set*/, QueryPush push) {
        // Windows have the trees one after the other.
        const uint32_t window = push.firstSlot / windows.size;
        push.turn = turn % push.turns;
        // No more instances can be met than are listed: turns behind them would have nothing to do.
        const bool isNeeded = uint64_t{push.turn} * push.treeCount < push.instanceCount;
        if (isNeeded && push.pieceCount > 0 && turn / push.turns == window) {
            tree_->record(dispatches, pass, window, push, boxes_.buffer(0));
        }
    });
}

void QueryGroup::recordNearest(gpu::Dispatches& dispatches, const Batch& batch, uint32_t work) const {
    forWindows(batch, [&](const gpu::BoundSet& set, QueryPush push) {
        push.work = work;
        if (push.instanceCount > 0 && push.pieceCount > 0) {
            kernels_->nearest().recordFind(dispatches, set, push);
        }
    });
}

void QueryGroup::recordNearestFinish(gpu::Dispatches& dispatches, const Batch& batch) const {
    forWindows(batch, [&](const gpu::BoundSet& set, const QueryPush& push) {
        if (push.instanceCount > 0 || push.writesMisses != 0) {
            kernels_->nearest().recordFinish(dispatches, set, push);
        }
    });
}

void QueryGroup::recordRefine(gpu::Dispatches& dispatches, const Batch& batch) const {
    const InstanceWindows& windows = source_.listing->windows();
    forWindows(batch, [&](const gpu::BoundSet& set, QueryPush push) {
        if (push.instanceCount > 0) {
            push.instanceCount = windows.slots(push.firstSlot / windows.size);
            kernels_->recordRefine(dispatches, set, push);
        }
    });
}

void QueryGroup::recordFinish(gpu::Dispatches& dispatches, const Batch& batch) const {
    forWindows(batch, [&](const gpu::BoundSet& set, const QueryPush& push) {
        if (push.instanceCount > 0 || push.writesMisses != 0) {
            kernels_->recordFinish(dispatches, set, push);
        }
    });
}

} // namespace supple::runtime
