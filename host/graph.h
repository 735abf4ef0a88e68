// A small render graph. Passes declare what they read and write and in which stages; the graph derives every barrier
// from that, across frames too, and times the passes. Nobody else records a barrier then, Supple included. What fails
// here ends the process (host/must.h).
#pragma once

#include "host/swapchain.h"

#include <string>

namespace supple::host {

/// Stages and accesses on memory. Supple's own SuppleSyncScope is the same thing.
using Scope = SuppleSyncScope;

/// An image, or a number of buffers that are used together.
struct Resource {
    uint32_t index = UINT32_MAX;
};

/// One pass's use of one resource.
struct Use {
    Resource resource;
    Scope first{}; ///< what the pass does with it at the earliest
    Scope last{};  ///< its writes; empty: the pass only reads
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    bool discard = false; ///< what was in the image does not matter
};

/// A pass that only reads.
Use reads(Resource resource, Scope scope, VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED);
/// A pass that writes, and perhaps reads, in one scope.
Use writes(Resource resource, Scope scope, VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED, bool discard = false);
/// A pass of several steps that synchronizes them itself: what comes first, and what its writes are.
Use writesWithin(Resource resource, Scope first, Scope last);

inline constexpr Scope kColorAttachment{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                        VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
inline constexpr Scope kDepthAttachment{
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
inline constexpr Scope kSampledInFragment{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
inline constexpr Scope kSampledInCompute{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
inline constexpr Scope kStorageInCompute{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
inline constexpr Scope kCopied{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
/// How a group's buffers are drawn from.
inline constexpr Scope kDrawn{
    VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT,
    VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT};

struct PassTime {
    const char* name;
    double milliseconds;
};

class Graph {
public:
    explicit Graph(Device& device);

    Resource addBuffers();
    Resource addImage(VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT);
    /// Which image it is now; what was there is forgotten. `before`: where a semaphore or the like has waited.
    void setImage(Resource resource, VkImage image, Scope before = {});

    /// name: a literal. Passes run in the order in which they were added.
    void add(const char* name, std::vector<Use> uses, std::function<void(VkCommandBuffer)> record);
    /// Records and forgets the passes. slot: which of the frames in flight this is.
    void execute(VkCommandBuffer commands, uint32_t slot);
    /// The passes of the frame that was recorded with this slot before; it must be complete.
    const std::vector<PassTime>& readTimes(uint32_t slot);

private:
    struct State {
        bool isImage = false;
        VkImage image = VK_NULL_HANDLE;
        VkImageAspectFlags aspect = 0;
        VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
        Scope write{};   ///< the last write
        Scope visible{}; ///< who has waited for it
        VkPipelineStageFlags2 readers = 0;
    };
    struct Pass {
        const char* name;
        std::vector<Use> uses;
        std::function<void(VkCommandBuffer)> record;
    };

    void barriers(VkCommandBuffer commands, const Pass& pass);

    Device& device_;
    std::vector<State> states_;
    std::vector<Pass> passes_;
    VkQueryPool queries_[kFramesInFlight]{};
    std::vector<const char*> timed_[kFramesInFlight];
    std::vector<PassTime> times_;
};

/// Passes that copy the picture to the swapchain's image that was acquired and make it ready to be shown. `use`: of the
/// image.
void addPresent(Graph& graph, const Swapchain& swapchain, Resource use, const Image& picture, Resource pictureUse);

} // namespace supple::host
