// Points on the surfaces of a group's instances, and their frames on the device.
#pragma once

#include "gpu/bound_sets.h"
#include "gpu/buffer_plan.h"
#include "gpu/static_buffers.h"
#include "gpu/tasks.h"
#include "runtime/instance_listing.h"
#include "runtime/pass_cost.h"
#include "runtime/points/vertex_copies.h"
#include "runtime/recorded_once.h"
#include "runtime/transfers.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace supple::runtime {

/// What a host says of a set, kept so that it can be made anew.
struct PointRecipe {
    SupplePointFormat format = SUPPLE_POINT_FRAME_48;
    bool onVertices = false; ///< SUPPLE_POINT_SET_ON_VERTICES
    std::vector<SuppleSurfacePoint> points;
    std::vector<float> tangents; ///< three a point, or none
};

/// What the device has of the points of a set: shared by the sets that take each other's place.
struct PointTable {
    gpu::StaticBuffers buffers;          ///< their weights, then those that lie on vertices, if the set asks for it
    std::vector<VertexPoints::Run> runs; ///< of these
};
using PointTableBuffer = std::shared_ptr<PointTable>;
[[nodiscard]] Result<PointTableBuffer> makePointTable(const gpu::Device& device, std::vector<uint32_t> words,
                                                      VertexPoints onVertices);
/// How many elements of one the device binds.
[[nodiscard]] uint64_t mostTableElements(const gpu::Device& device);

/// Where a set of a group takes its cages from. What it points to must outlive the set.
struct PointSource {
    const gpu::Device* device = nullptr;
    const InstanceListing* listing = nullptr;
    VkBuffer cages = VK_NULL_HANDLE; ///< deformed, of all instances
    uint32_t cageStride = 0;         ///< vertices
    const Surfaces* surfaces = nullptr;
};

/// Recording allocates nothing.
class PointSet final : public gpu::FrameMember {
public:
    /// Whether so many points have room, before anything is made.
    [[nodiscard]] static Status check(const PointSource& source, uint32_t points, SupplePointFormat format);
    /// check() has been asked. `group`: the handle's number.
    [[nodiscard]] static Result<std::shared_ptr<PointSet>> create(const PointSource& source, PointKernels& kernels,
                                                                  PointRecipe recipe, PointTableBuffer table,
                                                                  uint64_t group);

    [[nodiscard]] const PointRecipe& recipe() const { return recipe_; }
    [[nodiscard]] const PointTableBuffer& table() const { return table_; }
    [[nodiscard]] uint64_t group() const { return group_; }
    [[nodiscard]] uint32_t pointCount() const { return static_cast<uint32_t>(recipe_.points.size()); }
    void fill(SupplePointOutput& out) const;
    [[nodiscard]] gpu::MemoryUse memoryUse() const;
    [[nodiscard]] gpu::TaskNeeds taskNeeds() const;
    [[nodiscard]] uint64_t lastRecordedFrame() const { return lastRecordedFrame_; }
    void addTransfers(Transfers& transfers) const { transfers.add(output_.buffer(0)); }

    [[nodiscard]] bool hasPasts() const { return recipe_.format == SUPPLE_POINT_FRAME_64; }
    /// Whether its next recording is its first.
    [[nodiscard]] bool begins() const { return first_.due() && !staticsPending(); }

    /// Frames of instances that the listing has, unless the table is not there yet. `pastStep`: how far the origin of
    /// the coordinates has moved since the group's last recording.
    PassCost record(gpu::Dispatches& dispatches, uint64_t frame, const glm::vec3& pastStep);
    /// Whether some points have the positions of surface vertices.
    [[nodiscard]] bool copiesVertices() const { return copies_ && copies_->count() > 0; }
    /// Behind record() and the surface vertices of the frame.
    PassCost recordCopies(gpu::Dispatches& dispatches) const;
    /// The surfaces have other buffers, or are about to free theirs.
    [[nodiscard]] Status bindVertices() { return copies_ ? copies_->bind() : success(); }
    void unbindVertices();

    [[nodiscard]] bool staticsPending() const override {
        return table_->buffers.staticsPending() || clear_.staticsPending();
    }
    VkDeviceSize recordStatics(VkCommandBuffer commandBuffer, uint64_t frame) override;
    void countStatics(gpu::StaticCount& count) const override { table_->buffers.countStatics(count); }
    [[nodiscard]] Status stageStatics() override { return table_->buffers.stageStatics(); }
    void recordWarmUp(VkCommandBuffer commandBuffer) const override;
    void beginFrame(uint64_t completedFrame) override { table_->buffers.beginFrame(completedFrame); }
    void cancelFrame(uint64_t frame) override;

private:
    /// What descriptors reach of a window of instances.
    struct Reach {
        uint32_t window = 0;
        uint32_t firstSlot = 0, slotCount = 0; ///< in the window
        uint32_t firstElement = 0, firstPast = 0;
    };
    [[nodiscard]] Status createBuffers();
    void findReaches();
    [[nodiscard]] Status createSets();
    [[nodiscard]] Status createCopies();
    [[nodiscard]] shared::PointPush pushOf(const Reach& reach) const;
    /// What is written of a reach, as descriptors take it, and the elements where it begins there.
    struct Written {
        VkDescriptorBufferInfo points{}, pasts{};
        uint32_t firstElement = 0, firstPast = 0;
    };
    [[nodiscard]] Written writtenOf(const Reach& reach) const;

    PointSource source_;
    const PointKernels* kernels_ = nullptr;
    PointRecipe recipe_;
    PointTableBuffer table_;
    uint64_t group_ = 0;
    gpu::BufferSet output_; ///< what the host reads; where points were, if the format tells
    ZeroedOnce clear_;      ///< instances that no frame has listed have frames of zeros
    RecordedOnce first_;    ///< the first frame: no point has a past
    bool isFirst_ = false;  ///< the newest frame is
    std::vector<Reach> reaches_;
    gpu::TexelViews views_;
    gpu::BoundSets sets_;                ///< by reach
    std::optional<VertexCopies> copies_; ///< if the set asks for it
    uint64_t lastRecordedFrame_ = 0;
};

} // namespace supple::runtime
