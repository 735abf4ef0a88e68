// Which instances of a group its view sees: bounds of their deformed cages, the list of those that are left, and the
// arguments of what is dispatched and drawn for them (shaders/shared/bounds.h).
#pragma once

#include "base/result.h"
#include "gpu/bound_sets.h"
#include "gpu/buffer_plan.h"
#include "runtime/change_staging.h"
#include "runtime/culling/bounds_kernels.h"
#include "runtime/culling/occlusion_kernels.h"
#include "runtime/culling/sharers.h"
#include "runtime/culling/visibility.h"
#include "runtime/recorded_once.h"
#include "surface/lod/instance.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace supple::runtime {

/// Recording allocates nothing.
class Culling final : public Visibility, public gpu::FrameMembers {
public:
    static constexpr uint32_t kGroupPasses = 4; ///< beside the bounds of windows: sizes, list, demand, rates
    /// What is dispatched and drawn for the instances of one rate.
    struct Rate {
        uint32_t vertices = 0; ///< of an instance
        std::vector<surface::DispatchSize> sizes;
        std::span<const SuppleDrawRange> draws; ///< of all windows
    };
    /// What a surface of the group asks for.
    struct Surface {
        std::vector<surface::DispatchSize> sizes; ///< dispatched for what is seen, by argument number
        uint32_t constructions = 0;               ///< the first of these make coefficients
        surface::lod::InstanceMeasure measure;
        float margin = 0.0f;       ///< how far the surface may lie outside the box of its cage, as a part of its size
        uint32_t coefficients = 0; ///< that an instance takes of the view's pool; 0: the group has a pool of its own
        /// None if levels are real numbers. Surfaces that have rates have equally many.
        std::vector<Rate> rates;
    };
    struct Desc {
        const gpu::Device* device = nullptr;
        const BoundsKernels* kernels = nullptr;
        const OcclusionKernels* occlusion = nullptr; ///< null: nothing hides
        uint32_t framesInFlight = 2;
        const InstanceWindows* windows = nullptr; ///< must outlive this, as all here
        uint32_t cageVertices = 0, cageStride = 0;
        const DrawnParts* parts = nullptr;
        uint32_t firstRate = 0; ///< segments along an edge of the cage; each further rate has twice as many
        uint32_t poolUnits = 0; ///< of the view's pool (shared::kPoolUnit)
        // If surfaces of the group read the coefficients of the group that it follows:
        const Culling* leader = nullptr; ///< during creation: that of the followed group
        SharerPlace place;
    };
    /// `surfaces`: what every surface of the group asks for.
    [[nodiscard]] static std::unique_ptr<Culling> create(Desc desc, std::span<const Surface> surfaces);
    void plan(gpu::BufferPlan& device, gpu::BufferPlan& staging);
    /// What the passes read and write beside the group's own, once the plans are carried out.
    struct Buffers {
        VkBuffer cages = VK_NULL_HANDLE;
        VkBuffer hostList = VK_NULL_HANDLE; ///< capacity entries, as shaders/shared/bounds.h has them
        VkBuffer view = VK_NULL_HANDLE;     ///< shared::CullView
        VkBuffer sizes = VK_NULL_HANDLE;    ///< of all groups of the view
        VkBuffer words = VK_NULL_HANDLE;    ///< of the view (shaders/shared/lod.h)
    };
    [[nodiscard]] Status createSets(const Buffers& buffers);

    // Visibility
    void list(const InstanceSlots& slots, InstanceListing& listing) override;
    VkDeviceSize recordUpload(VkCommandBuffer commandBuffer) override;
    [[nodiscard]] InstanceList list() const override { return {list_.buffer(), list_.size(), windows_->capacity}; }
    [[nodiscard]] surface::Window window(uint32_t window, size_t surface) const override;
    [[nodiscard]] surface::Window constructed(uint32_t window, size_t surface) const override;
    void tellPool(shared::WindowPush& push, size_t surface) const override;
    [[nodiscard]] PassCost cost(uint64_t points, uint64_t bytes) const override;
    void addTransfers(Transfers& transfers) const override;

    void recordWarmUp(VkCommandBuffer commandBuffer) const override {
        kernels_->recordWarmUp(commandBuffer, boundsSets_[0], listSets_[0]);
    }
    PassCost recordBounds(gpu::Dispatches& dispatches) const;
    /// Behind the bounds, before sizes and list. `place`: of the frame among those in flight, whose descriptor set no
    /// frame uses any more; `generation` tells whether that set has this pyramid.
    PassCost recordOcclusion(VkCommandBuffer commandBuffer, uint64_t place, const SuppleDepthPyramidDesc& pyramid,
                             uint64_t generation);
    /// Who reads the coefficients that the group constructs. recordList() and constructed() take them as they are now.
    [[nodiscard]] const std::shared_ptr<Sharers>& sharers() const { return sharers_; }
    /// Units of the view's pool that an instance takes.
    [[nodiscard]] uint32_t instanceUnits() const { return instanceUnits_; }
    /// The frame writes this one of the view's two pools.
    void takePool(uint32_t pool) { pool_ = pool; }
    /// What the listed instances need, each `leastVertices` at least. Only if that may be more than there is.
    void recordSizes(gpu::Dispatches& dispatches, uint32_t leastVertices) const;
    /// `room`: vertices, or shared::kRoomForAll. `number`: of the group among those of the view.
    PassCost recordList(gpu::Dispatches& dispatches, uint32_t room, uint32_t number) const;
    /// With rates, behind the list: what the listed instances need in the budget.
    PassCost recordDemand(gpu::Dispatches& dispatches) const;
    /// With rates, behind the view's solution: the lists of all rates. `counted`: the budget scales levels.
    PassCost recordRates(gpu::Dispatches& dispatches, bool counted) const;

    [[nodiscard]] SuppleBufferRange bounds() const; ///< by slot
    /// The draws of all surfaces that have rates become none, until a frame lists instances.
    void recordNoDraws(VkCommandBuffer commandBuffer) const;
    [[nodiscard]] bool hasRates() const { return rateCount_ > 0; }

    /// The instances of a rate in a window. Argument 0 is that of the rate's first step of the surface.
    [[nodiscard]] surface::Window window(uint32_t window, size_t surface, uint32_t rate) const;
    /// In list(): the slots at a rate with the lists of parts behind them.
    [[nodiscard]] SuppleBufferRange rateList(uint32_t rate) const;
    /// The draws of a surface: those of all its rates.
    [[nodiscard]] VkDeviceSize drawOffset(size_t surface) const;
    /// In list(): what the list pass has found out of all windows, kListHeaderWords words (shaders/shared/bounds.h).
    [[nodiscard]] VkDeviceSize countOffset() const { return VkDeviceSize{firstArgument()} * sizeof(uint32_t); }
    /// In list(): the word at which masks of parts begin.
    [[nodiscard]] static uint32_t firstMask(uint32_t capacity) { return 3 * capacity; }
    /// How many times `capacity` words lie before the arguments.
    [[nodiscard]] static uint32_t lists(uint32_t parts, uint32_t rates) {
        const uint32_t words = 3 + DrawnParts::wordsOf(parts) + 2 + 1 + rates * (2 + parts);
        return std::max(words, kStateRuns + 1); // and states, each run of which begins at an aligned offset
    }

private:
    static constexpr uint32_t kStateRuns = 1 + shared::kMaxSharers;
    /// Where what a surface needs begins.
    struct Place {
        uint32_t firstArgument = 0;               ///< of its construction, in arguments_
        std::vector<uint32_t> firstRateArguments; ///< by rate
        uint32_t firstDraw = 0;                   ///< in draws_
        uint32_t coefficients = 0;                ///< as in Surface
        uint32_t firstCoefficient = 0;            ///< of the surface, of those of an instance
    };
    void add(const Surface& surface);
    [[nodiscard]] uint32_t argumentStride() const { return 3 * static_cast<uint32_t>(arguments_.size()); }
    [[nodiscard]] uint32_t partCount() const { return drawnParts_->count(); }
    void listParts(const InstanceSlots& slots);
    // Words of the list: all that are seen, those of every window, their levels; masks of parts; two a slot for its
    // places in the view's pool; what every window constructs; for every rate all, those of every window, those that
    // show a part; then the arguments, the counts of rates and their draws.
    [[nodiscard]] uint32_t firstPool() const;
    [[nodiscard]] uint32_t firstConstructed() const { return firstPool() + 2 * windows_->capacity; }
    [[nodiscard]] uint32_t stateStride() const; ///< slots from one run of states to the next
    [[nodiscard]] uint32_t firstRateList() const;
    [[nodiscard]] uint32_t rateStride() const;
    [[nodiscard]] uint32_t firstArgument() const { return firstRateList() + rateCount_ * rateStride(); }
    // Words from firstArgument() on.
    [[nodiscard]] uint32_t headerWords() const { return shared::kListHeaderWords * (1 + windows_->count()); }
    [[nodiscard]] uint32_t firstRateCount() const { return headerWords() + argumentStride() * windows_->count(); }
    [[nodiscard]] uint32_t firstDraw() const { return firstRateCount() + rateCount_ * windows_->count(); }

    const gpu::Device* device_ = nullptr;
    const BoundsKernels* kernels_ = nullptr;
    const OcclusionKernels* occlusion_ = nullptr;
    const InstanceWindows* windows_ = nullptr;
    const DrawnParts* drawnParts_ = nullptr;
    uint32_t framesInFlight_ = 2;
    shared::BoundsPush push_{};
    std::vector<ListWindow> listed_; ///< of the table written last
    std::vector<ListArgument> arguments_;
    uint32_t firstRate_ = 0, rateCount_ = 0;
    std::array<uint32_t, shared::kMaxRates> rateVertices_{};
    std::vector<Place> places_; ///< by surface
    std::vector<ListDraw> draws_;
    std::vector<uint32_t> drawParts_; ///< by draw
    std::vector<ListPart> parts_;     ///< room for all parts
    uint32_t hiddenParts_ = 0;        ///< entries of parts_ in use
    uint32_t poolUnits_ = 0, instanceUnits_ = 0;
    uint32_t pool_ = 0;
    VkDeviceSize maskBytes_ = 0; ///< to upload

    gpu::PlannedBuffer bounds_, states_, list_, table_;
    ChangeStaging tables_, masks_;
    ZeroedOnce clear_; ///< of states_
    std::shared_ptr<Sharers> sharers_ = std::make_shared<Sharers>();
    const Culling* leader_ = nullptr; ///< until there are sets
    SharerPlace place_;
    gpu::TexelViews views_;
    gpu::BoundSets boundsSets_;      ///< by window
    gpu::BoundSets listSets_;        ///< one
    gpu::BoundSets occlusionSets_;   ///< by frame in flight
    std::vector<uint64_t> pyramids_; ///< by frame in flight: the generation of the one that its set binds; 0: none
};

} // namespace supple::runtime
