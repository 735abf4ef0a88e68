// Every public function, in the order of a host: cold, and then with frames in flight. Each call is made as a test
// wants it: as it is, or first with every position in it failing.
#pragma once

#include "host/device.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <supple/supple.h>
#include <vector>

namespace supple::test {

/// Something in a call that fails: an allocation, a call of Vulkan.
struct Fault {
    std::function<void(uint64_t n)> arm; ///< the n-th from now on fails
    std::function<bool()> lift;          ///< ends that, and says whether it came
    SuppleResult result = SUPPLE_OK;     ///< what the call returns then
};

/// Makes a call with position 0 failing, then 1 and so on, until nothing in it failed.
class Calls {
public:
    explicit Calls(Fault fault, uint64_t stride = 1) : fault_(std::move(fault)), stride_(stride) {}
    /// `good`: what the call returns without a failure.
    void make(const char* name, const std::function<SuppleResult()>& call, SuppleResult good = SUPPLE_OK);
    [[nodiscard]] uint64_t positions() const { return positions_; }

private:
    Fault fault_;
    uint64_t stride_;
    uint64_t positions_ = 0;
};

/// How one call is made, and what it may return.
using MakeCall = std::function<void(const char* name, const std::function<SuppleResult()>& call, SuppleResult good)>;
/// Each call as it is.
void makeOnce(const char* name, const std::function<SuppleResult()>& call, SuppleResult good);

/// What a context is created with.
using Adjust = std::function<void(SuppleContextDesc&)>;
/// A log that keeps nothing, and async compute.
void quiet(SuppleContextDesc& desc);

/// Makes every call in a context of its own. Returns what the frames came out as; nothing if the device is lost.
/// `recorded`: all of it is recorded. A call that finds no memory for its note succeeds all the same, and ends the
/// recording: where host memory runs out, the recording ends before the other calls.
std::vector<std::byte> makeEveryCall(host::Device& device, const MakeCall& make, const Adjust& adjust = quiet,
                                     bool recorded = true);

[[nodiscard]] uint64_t deviceMemoryOf(SuppleContext context);

} // namespace supple::test
