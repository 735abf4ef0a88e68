// Device work recorded once and submitted again and again.
#pragma once

#include "base/result.h"
#include "host/device.h"
#include "tools/bench/rounds.h"

#include <functional>
#include <memory>
#include <string>

namespace supple::bench {

class Replay {
public:
    [[nodiscard]] static Result<std::unique_ptr<Replay>> create(host::Device& device,
                                                                const std::function<void(VkCommandBuffer)>& record);
    ~Replay();
    Replay(const Replay&) = delete;
    Replay& operator=(const Replay&) = delete;

    /// Submits and waits, so many times.
    [[nodiscard]] Status run(uint32_t times) { return submit(plain_, times); }

    /// What rounds are run with; valid as long as this lives.
    [[nodiscard]] Contestant contestant(const std::string& name, uint64_t points);

    /// Whether the queue has timestamps.
    [[nodiscard]] bool hasTimestamps() const { return queries_ != VK_NULL_HANDLE; }
    /// Mean seconds between two timestamps round the work.
    [[nodiscard]] Result<double> deviceSeconds(uint32_t times);

private:
    explicit Replay(host::Device& device) : device_(device) {}
    [[nodiscard]] VkResult createObjects();
    [[nodiscard]] Status submit(VkCommandBuffer commands, uint32_t times);

    host::Device& device_;
    VkCommandBuffer plain_ = VK_NULL_HANDLE, timed_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    VkQueryPool queries_ = VK_NULL_HANDLE;
    uint64_t tickMask_ = 0;
};

} // namespace supple::bench
