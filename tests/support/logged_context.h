// A context whose log lines can be looked at, a character small enough for a thousand frames, and what a group's
// surface came out as, to the bit.
#pragma once

#include "host/context.h"
#include "host/group_output.h"

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <supple/supple.h>
#include <vector>

namespace supple::test {

struct LogLine {
    SuppleSeverity severity;
    SuppleMessage message;
    std::string text;
};

class LoggedContext {
public:
    /// `adjust` changes what the context is created with. A refusal is for the test to look at: result().
    explicit LoggedContext(host::Device& device, const std::function<void(SuppleContextDesc&)>& adjust = {});
    ~LoggedContext();
    LoggedContext(const LoggedContext&) = delete;
    LoggedContext& operator=(const LoggedContext&) = delete;

    [[nodiscard]] SuppleContext handle() const { return context_; }
    [[nodiscard]] host::Device& device() const { return device_; }
    [[nodiscard]] SuppleResult result() const { return result_; }

    /// The lines since the last call.
    std::vector<LogLine> takeLines();
    /// How many of the lines since the last call are about this.
    uint32_t takeCount(SuppleMessage message);

    uint64_t frame = 0; ///< the newest begun
    /// Begins the next frame; all before it are complete.
    void beginFrame();
    [[nodiscard]] SuppleResult record(VkCommandBuffer commands, std::span<const SuppleGroup> groups,
                                      uint32_t flags = 0) const;
    /// One whole frame.
    void evaluate(std::span<const SuppleGroup> groups, uint32_t flags = 0);

private:
    static void log(SuppleSeverity severity, SuppleMessage message, const char* text, void* user);

    host::Device& device_;
    SuppleContext context_ = nullptr;
    SuppleResult result_ = SUPPLE_OK;
    std::mutex mutex_;
    std::vector<LogLine> lines_;
};

/// All a frame's reads and writes, for tests that are about something else.
inline constexpr SuppleSyncScope kAnyUse{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                         VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};

/// A device of its own whose Supple calls go through `functions`; validation as SUPPLE_VALIDATION says, or on.
[[nodiscard]] std::unique_ptr<host::Device> deviceThrough(PFN_vkGetInstanceProcAddr functions, bool validation = true);

/// A tube of quads in a GLB: 3 joints, 4 morph targets with weights of their own, a clip, a material with an image.
[[nodiscard]] const std::vector<std::byte>& tubeFile();
[[nodiscard]] SuppleAssetDesc tubeDesc(const char* name = "tube");
[[nodiscard]] SuppleResult createTube(SuppleContext context, SuppleAsset& asset);

struct SmallGroup {
    SuppleGroup group{};
    std::vector<SuppleInstance> instances; ///< as many as the capacity
    SuppleResult result = SUPPLE_OK;
};
/// `desc` but for structSize and asset; rate 0 is 2, capacity 0 is 1.
[[nodiscard]] SmallGroup createGroup(SuppleContext context, SuppleAsset asset, SuppleGroupDesc desc = {});

[[nodiscard]] host::GroupOutput outputOf(SuppleContext context, SuppleGroup group);
/// The deformed cages and surface vertices of all slots, without the padding between them.
[[nodiscard]] std::vector<std::byte> surfaceBits(const LoggedContext& context, SuppleGroup group);

} // namespace supple::test
