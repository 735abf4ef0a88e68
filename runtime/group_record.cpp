// What a group puts into a command buffer: its uploads and its share of every pass.
#include "runtime/group.h"
#include "runtime/group_buffers.h"

#include <algorithm>
#include <cstring>

namespace supple::runtime {

using namespace supple::shared;

bool Group::staticsPending() const {
    bool tables = false;
    forSchemes([&](const SchemeTables& scheme) { tables = tables || scheme.buffers.uploadPending(); });
    return asset_->buffers.uploadPending() || asset_->clips.uploadPending() || tables || static_.uploadPending() ||
           (!cleared_ && buffers_.size(kPool) > 0) || (view_ != nullptr && view_->staticsPending());
}

VkDeviceSize Group::recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) {
    VkDeviceSize bytes = asset_->buffers.recordUpload(commandBuffer, frame);
    bytes += asset_->clips.recordUpload(commandBuffer, frame);
    forSchemes([&](SchemeTables& scheme) { bytes += scheme.buffers.recordUpload(commandBuffer, frame); });
    const VkDeviceSize own = static_.recordUpload(commandBuffer, frame);
    indicesToRelease_ = indicesToRelease_ || own > 0;
    if (!cleared_) {
        if (culling_.active()) {
            culling_.recordClear(commandBuffer);
        }
        // The zero coefficient and the slots no stage writes.
        for (const BufferIndex pool : {kPool, kSecondPool}) {
            if (buffers_.size(pool) > 0) {
                shared_.device->vk.CmdFillBuffer(commandBuffer, buffers_.buffer(pool), 0, VK_WHOLE_SIZE, 0);
            }
        }
        cleared_ = true;
        clearedFrame_ = frame;
    }
    lastRecordedFrame_ = frame;
    return bytes + own;
}

Group::PassCost Group::recordUpload(VkCommandBuffer commandBuffer, uint64_t frame) {
    const gpu::Device& device = *shared_.device;
    passesFrame_ = lastRecordedFrame_ = frame;
    if (indicesToRelease_) {
        indicesToRelease_ = false;
        indicesReleaseFrame_ = frame;
    }
    if (writesMotion()) {
        pool_ = 1 - pool_;
    }
    PassCost cost;
    const auto copy = [&](StagingIndex staging, BufferIndex target, VkDeviceSize from, VkDeviceSize to,
                          VkDeviceSize bytes) {
        if (bytes > 0) {
            const VkBufferCopy region{from, to, bytes};
            device.vk.CmdCopyBuffer(commandBuffer, staging_.buffer(staging), buffers_.buffer(target), 1, &region);
            cost.bytes += bytes;
        }
    };

    if (poseSource_ == SUPPLE_POSES_SET) {
        const uint32_t end = slots_.end();
        const VkDeviceSize run = frame % shared_.framesInFlight * poseUploadBytes();
        poses_.write(end, staging_.mapped(kPoseStaging) + run);
        copy(kPoseStaging, kPoses, run, 0, end * poses_.instanceBytes());
        cost.points = uint64_t{poses_.layout().jointCount} * end;
    } else if (plays()) {
        cost.bytes += playback_.recordUpload(commandBuffer, frame);
    }

    // Lists and draws stand on the device until something changes. Their runs are taken up one a change, so that the
    // newest is whole even where it is copied again: the run overwritten was last read before as many changes, and
    // thus frames, as there may be frames in flight.
    const bool listed = slots_.changed() || drawsChanged_;
    if (listed) {
        listRun_ = (listRun_ + 1) % shared_.framesInFlight;
    }
    const VkDeviceSize lists = listRun_ * listUploadBytes(), list = buffers_.size(kInstances) / 2;
    const VkDeviceSize draws = lists + 2 * list;
    if (listed) {
        auto* const all = reinterpret_cast<uint32_t*>(staging_.mapped(kListStaging) + lists);
        uint32_t* const culled =
            culls() ? reinterpret_cast<uint32_t*>(staging_.mapped(kCullStaging) + listRun_ * cullUploadBytes())
                    : nullptr;
        if (culls()) {
            slots_.listForCulling({culled, capacity_});
        }
        visible_ = slots_.list({all, capacity_}, {all + capacity_, capacity_}, windowSize_, listed_);
        if (culls()) {
            culling_.writeTable(listed_, reinterpret_cast<std::byte*>(culled + capacity_));
        }
        std::byte* target = staging_.mapped(kListStaging) + draws;
        for (const SuppleDrawRange& range : view_ == nullptr ? std::span(drawRanges_) : std::span<SuppleDrawRange>()) {
            const VkDrawIndexedIndirectCommand command{range.indexCount, range.patchCount * visible_, range.firstIndex,
                                                       0, 0};
            std::memcpy(target, &command, sizeof(command));
            target += sizeof(command);
        }
        drawsChanged_ = false;
    }
    if (listed || shared_.handsOver) {
        if (culls()) {
            // In the place of the slots: what is seen of them is the device's to list.
            const VkDeviceSize run = listRun_ * cullUploadBytes(), entries = VkDeviceSize{capacity_} * sizeof(uint32_t);
            copy(kCullStaging, kInstances, run, 0, visible_ * sizeof(uint32_t));
            const VkBufferCopy region{run + entries, 0, culling_.tableBytes()};
            device.vk.CmdCopyBuffer(commandBuffer, staging_.buffer(kCullStaging), culling_.table(), 1, &region);
            cost.bytes += region.size;
        } else {
            copy(kListStaging, kInstances, lists, 0, visible_ * sizeof(uint32_t));
        }
        for (uint32_t w = 0; w < windows_.size(); ++w) {
            const VkDeviceSize at = list + VkDeviceSize{w} * windowSize_ * sizeof(uint32_t);
            copy(kListStaging, kInstances, lists + at, at, listed_[w].count * sizeof(uint32_t));
        }
        copy(kListStaging, kIndirect, draws, 0, buffers_.size(kIndirect));
    }
    return cost;
}

template <class F>
void Group::forWindows(F&& record) const {
    for (uint32_t w = 0; w < windows_.size(); ++w) {
        if (listed_[w].count > 0) {
            record(windows_[w], capacity_ + w * windowSize_, listed_[w]);
        }
    }
}

template <class F>
void Group::forSurfaceWindows(F&& record) const {
    forWindows([&](const Window& window, uint32_t first, const InstanceSlots::Listed& listed) {
        const VkDescriptorSet set = window.surface[pool_];
        record(window, culls() ? culling_.window(window.index, set) : surface::Window{set, first, listed.count});
    });
}

Group::PassCost Group::costOfSeen(uint64_t points, uint64_t bytes) const {
    if (culls()) {
        return {0, 0, points > 0 && visible_ > 0};
    }
    return {points * visible_, bytes * visible_};
}

Group::PassCost Group::recordBounds(VkCommandBuffer commandBuffer) const {
    if (!culls()) {
        return {};
    }
    culling_.recordBounds(commandBuffer, listed_);
    return {visible_, visible_ * VkDeviceSize{32}};
}

Group::PassCost Group::recordOcclusion(VkCommandBuffer commandBuffer) {
    if (!occludes()) {
        return {};
    }
    culling_.recordOcclusion(commandBuffer, passesFrame_ % shared_.framesInFlight, *view_->depthPyramid(),
                             view_->pyramidGeneration(), visible_);
    return {0, 0, true};
}

Group::PassCost Group::recordSeen(VkCommandBuffer commandBuffer, uint32_t room) const {
    if (!culls()) {
        return {};
    }
    culling_.recordList(commandBuffer, isBudgeted() ? room : kRoomForAll);
    return {0, 0, true};
}

Group::PassCost Group::recordAttributes(VkCommandBuffer commandBuffer) {
    if (!attributesPending_) {
        return {};
    }
    attributesPending_ = false;
    attributesFrame_ = passesFrame_;
    for (const Rate& rate : rates_) {
        shared_.surface->recordAttributes(commandBuffer, rate.scheme->tables,
                                          {rate.windows.front().surface[pool_], 0, 1}, rate.evaluation);
    }
    if (!hasRates()) {
        shared_.surface->recordAttributes(commandBuffer, scheme_->tables, {windows_.front().surface[pool_], 0, 1},
                                          evaluation_);
    }
    return {vertexCount_, buffers_.size(kAttributes) + buffers_.size(kUvs1) + buffers_.size(kFaceUvs)};
}

bool Group::writesLodAttributes() const {
    return hasLevels() && view_->size(View::kAttributes) > 0;
}

Group::PassCost Group::recordLodAttributes(VkCommandBuffer commandBuffer) const {
    if (!writesLodAttributes()) {
        return {};
    }
    forWindows([&](const Window& window, uint32_t, const InstanceSlots::Listed&) {
        shared_.surface->recordLodAttributes(commandBuffer, scheme_->tables, lodWindow(window, window.surface[pool_]),
                                             evaluation_);
    });
    return {0, 0, visible_ > 0};
}

Group::PassCost Group::recordPose(VkCommandBuffer commandBuffer, Playback::Part part) const {
    if (!plays() || (part == Playback::Part::roots && !movesRoots())) {
        return {};
    }
    forWindows([&](const Window& own, uint32_t first, const InstanceSlots::Listed& listed) {
        playback_.record(commandBuffer, part, own.index, first, listed.count);
    });
    if (part != Playback::Part::palette) { // whose poses are what is counted
        return {0, 0, visible_ > 0};
    }
    return {uint64_t{poses_.layout().jointCount} * visible_, poses_.instanceBytes() * visible_};
}

Group::PassCost Group::recordDeform(VkCommandBuffer commandBuffer) const {
    if (!deforms()) {
        return {};
    }
    const skinning::PoseLayout& layout = poses_.layout();
    forWindows([&](const Window& window, uint32_t first, const InstanceSlots::Listed& listed) {
        shared_.deform->record(commandBuffer, window.deform, layout.mode,
                               {output_.cageVertexCount, first, listed.count, layout.stride, evaluation_.cageStride,
                                layout.morphWeights, asset_->firstInfluences});
    });
    const uint64_t points = uint64_t{output_.cageVertexCount} * visible_;
    return {points, points * kVec4Bytes};
}

Group::PassCost Group::recordStage(VkCommandBuffer commandBuffer, surface::Stage stage) const {
    forSurfaceWindows([&](const Window&, const surface::Window& window) {
        shared_.surface->recordStage(commandBuffer, stage, scheme_->tables, window, evaluation_);
    });
    uint64_t points = 0, coefficients = 0;
    for (const surface::Construction& c : scheme_->tables.constructions) {
        if (c.stage == stage) {
            points += c.section.count;
            coefficients += c.coefficients;
        }
    }
    return costOfSeen(points, coefficients * kVec4Bytes);
}

Group::PassCost Group::recordPatch(VkCommandBuffer commandBuffer) const {
    if (!writesPatches()) {
        return {};
    }
    forWindows([&](const Window& window, uint32_t first, const InstanceSlots::Listed& listed) {
        shared_.surface->recordPatch(commandBuffer, scheme_->tables, {window.surface[pool_], first, listed.count},
                                     evaluation_);
    });
    const uint64_t points = uint64_t{output_.patchCount} * visible_;
    return {points, points * kPatchStride * kVec4Bytes};
}

LodPush Group::levelPush(const Window& window) const {
    const surface::Tables& tables = scheme_->tables;
    const auto runs = static_cast<uint32_t>(tables.lod.runs.size());
    LodPush push{};
    push.camera = view_->lodCamera();
    push.levels = oneLevel_ ? culling_.levelOffset() : 0;
    push.count = tables.lod.patches.count;
    push.firstSlot = window.index * windowSize_;
    push.edges = tables.lod.edges.table;
    push.patches = tables.lod.patches.table;
    push.edgeCount = tables.lod.edges.count;
    push.poolStride = tables.poolStride;
    push.tangents = tables.tangents;
    push.faces = tables.faces;
    push.scratchStride = scratchElements();
    push.firstRun = firstRun_ + window.index * runs;
    push.runCount = runs;
    push.firstBucket = firstRun_ * kLodBucketStride + window.index * runs * kCapacityCount;
    if (view_->leavesBackFaces() && push.camera.orthographic != 0) {
        std::copy_n(view_->direction().begin(), 3, push.camera.position);
    }
    return push;
}

VkDeviceSize Group::levelArguments(const surface::Window& window) const {
    return window.firstArgument + scheme_->tables.constructions.size() * sizeof(VkDispatchIndirectCommand);
}

surface::LodWindow Group::lodWindow(const Window& window, VkDescriptorSet set) const {
    const auto runs = static_cast<uint32_t>(scheme_->tables.lod.runs.size());
    return {set, view_->buffer(View::kWords), window.index * windowSize_, firstRun_ + window.index * runs};
}

Group::PassCost Group::recordEdgeLevels(VkCommandBuffer commandBuffer) const {
    if (!hasLevels() || oneLevel_) {
        return {};
    }
    forSurfaceWindows([&](const Window& own, const surface::Window& window) {
        shared_.surface->lod().recordEdges(commandBuffer, scheme_->tables.lod, window, levelArguments(window),
                                           levelPush(own));
    });
    const uint64_t points = scheme_->tables.lod.edges.count;
    return costOfSeen(points, points * sizeof(float));
}

Group::PassCost Group::recordPatchLevels(VkCommandBuffer commandBuffer) const {
    if (hasRates() && isBudgeted()) {
        gpu::disjointBarrier(*shared_.device, commandBuffer);
        culling_.recordDemand(commandBuffer, visible_);
        return {0, 0, visible_ > 0};
    }
    if (!hasLevels()) {
        return {};
    }
    forSurfaceWindows([&](const Window& own, const surface::Window& window) {
        // All count into one buffer, with atomics.
        gpu::disjointBarrier(*shared_.device, commandBuffer);
        shared_.surface->lod().recordPatches(commandBuffer, scheme_->tables.lod, window, levelArguments(window),
                                             levelPush(own), view_->leavesBackFaces());
    });
    const uint64_t points = output_.patchCount;
    return costOfSeen(points, points * kLodPatchLevelWords * sizeof(uint32_t));
}

Group::PassCost Group::recordPlaces(VkCommandBuffer commandBuffer) const {
    if (hasRates()) {
        // Behind the solver; and all add to the view's count of vertices, each with one lane.
        gpu::computeBarrier(*shared_.device, commandBuffer);
        culling_.recordRates(commandBuffer, isBudgeted());
        return {0, 0, visible_ > 0};
    }
    if (!hasLevels()) {
        return {};
    }
    forSurfaceWindows([&](const Window& own, const surface::Window& window) {
        // Behind the solver. Between windows places are taken with atomics, but to synchronization validation the
        // view's words are one resource.
        gpu::computeBarrier(*shared_.device, commandBuffer);
        shared_.surface->lod().recordPlaces(commandBuffer, window, levelArguments(window), levelPush(own));
    });
    const uint64_t points = output_.patchCount;
    return costOfSeen(points, points * kLodRecordWords * sizeof(uint32_t));
}

Group::PassCost Group::recordEvaluate(VkCommandBuffer commandBuffer) const {
    if (hasRates()) {
        recordRates(commandBuffer, false);
        return {0, 0, visible_ > 0};
    }
    if (view_ != nullptr) {
        // How many vertices is known on the device alone: SuppleViewStatistics.
        forWindows([&](const Window& window, uint32_t, const InstanceSlots::Listed&) {
            shared_.surface->recordLodEvaluate(commandBuffer, scheme_->tables, lodWindow(window, window.surface[pool_]),
                                               evaluation_, static_cast<uint32_t>(output_.vertexFormat));
        });
        return {0, 0, visible_ > 0};
    }
    forWindows([&](const Window& window, uint32_t first, const InstanceSlots::Listed& listed) {
        shared_.surface->recordEvaluate(commandBuffer, scheme_->tables, {window.surface[pool_], first, listed.count},
                                        evaluation_, static_cast<uint32_t>(output_.vertexFormat));
    });
    const uint64_t points = uint64_t{vertexCount_} * visible_;
    return {points, points * output_.surfaceVertices.stride};
}

bool Group::usesScratch() const {
    return !hasLevels() && buffers_.size(kScratch) > 0;
}

bool Group::writesMotion() const {
    return buffers_.size(kSecondPool) > 0;
}

Group::PassCost Group::recordMotion(VkCommandBuffer commandBuffer) const {
    if (!writesMotion()) {
        return {};
    }
    if (hasRates()) {
        recordRates(commandBuffer, true);
        return {0, 0, visible_ > 0};
    }
    if (view_ != nullptr) {
        forWindows([&](const Window& window, uint32_t, const InstanceSlots::Listed&) {
            shared_.surface->recordLodEvaluate(commandBuffer, scheme_->tables,
                                               lodWindow(window, window.motion[1 - pool_]), evaluation_,
                                               kVertexPosition);
        });
        return {0, 0, visible_ > 0};
    }
    bool first = true;
    const auto evaluate = [&](VkDescriptorSet set, uint32_t from, uint32_t count) {
        if (count == 0) {
            return;
        }
        if (!first) {
            gpu::disjointBarrier(*shared_.device, commandBuffer); // other instances
        }
        first = false;
        shared_.surface->recordEvaluate(commandBuffer, scheme_->tables, {set, from, count}, evaluation_,
                                        kVertexPosition);
    };
    // Instances with a past from the coefficients of the frame before, new ones from today's.
    forWindows([&](const Window& window, uint32_t from, const InstanceSlots::Listed& listed) {
        evaluate(window.motion[1 - pool_], from, listed.withPast);
        evaluate(window.motion[pool_], from + listed.withPast, listed.count - listed.withPast);
    });
    const uint64_t points = uint64_t{vertexCount_} * visible_;
    return {points, points * kPreviousPositionBytes};
}

uint32_t Group::transfers(Transfers& out) const {
    uint32_t count = 0;
    const auto add = [&](VkBuffer buffer, bool written) {
        if (buffer != VK_NULL_HANDLE && written) {
            out[count++] = gpu::bufferBarrier(buffer);
        }
    };
    const bool attributes = attributesFrame_ == passesFrame_;
    add(buffers_.buffer(kSurface), true);
    add(buffers_.buffer(kPreviousPositions), true);
    add(buffers_.buffer(kDeformedCage), deforms());
    add(buffers_.buffer(kInstances), true);
    add(buffers_.buffer(kIndirect), true);
    if (culls()) {
        add(culling_.list(), true);
        add(culling_.bounds(), true);
    }
    add(buffers_.buffer(kAttributes), attributes);
    add(buffers_.buffer(kUvs1), attributes);
    add(buffers_.buffer(kFaceUvs), attributes);
    if (!hasLevels()) {
        add(static_.buffer(kGridIndices), indicesReleaseFrame_ == passesFrame_);
    }
    return count;
}

void Group::cancelFrame(uint64_t frame) {
    asset_->buffers.cancelUpload(frame);
    asset_->clips.cancelUpload(frame);
    playback_.cancelUpload(frame);
    forSchemes([&](SchemeTables& scheme) { scheme.buffers.cancelUpload(frame); });
    static_.cancelUpload(frame);
    if (clearedFrame_ == frame) {
        cleared_ = false;
    }
    if (indicesReleaseFrame_ == frame) {
        indicesToRelease_ = true;
    }
    if (attributesFrame_ == frame) {
        attributesPending_ = true;
    }
    if (passesFrame_ == frame) {
        slots_.forgetAll();
    }
}

void Group::releaseStaging(uint64_t completedFrame) {
    asset_->buffers.releaseStaging(completedFrame);
    asset_->clips.releaseStaging(completedFrame);
    forSchemes([&](SchemeTables& scheme) { scheme.buffers.releaseStaging(completedFrame); });
    static_.releaseStaging(completedFrame);
}

} // namespace supple::runtime
