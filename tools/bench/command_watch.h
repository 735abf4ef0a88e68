// Watches a context record: how many commands cross to the driver.
#pragma once

#include <cstdint>
#include <vulkan/vulkan.h>

namespace supple::bench {

struct WatchedCommands {
    uint32_t dispatches = 0; ///< direct and indirect
    uint32_t barriers = 0;   ///< vkCmdPipelineBarrier
    uint32_t copies = 0;     ///< of buffers: copies, fills and updates
};

/// While one lives, contexts made with getInstanceProcAddr() are watched. One at a time, one thread: Vulkan's functions
/// take no user data, so the table behind it is the process's.
class CommandWatch {
public:
    CommandWatch();
    ~CommandWatch();
    CommandWatch(const CommandWatch&) = delete;
    CommandWatch& operator=(const CommandWatch&) = delete;

    [[nodiscard]] static PFN_vkGetInstanceProcAddr getInstanceProcAddr();
    /// Since it was asked last.
    [[nodiscard]] WatchedCommands take();

private:
    friend struct WatchedRecording;
    WatchedCommands commands_;
};

} // namespace supple::bench
