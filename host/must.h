// For hosts that stop at the first failure, as samples may: the process ends and takes everything with it.
#pragma once

#include "base/result.h"
#include "host/device.h"

#include <supple/supple.hpp>
#include <vector>

namespace supple::host {

/// Prints the line on stderr and ends the process.
[[noreturn]] void fail(const std::string& what, int exitCode = 1);
/// Exit code 3 for ErrorCode::unsupported, as the tools have it.
[[noreturn]] void fail(const Error& error);

/// The value, or the end.
template <class T>
T must(Result<T> result) {
    if (!result)
        fail(result.error());
    return std::move(*result);
}
void must(VkResult result, const char* what);
void must(SuppleResult result, const char* what);

/// All bytes of a file, or the end.
[[nodiscard]] std::vector<char> mustReadFile(const std::string& path);

/// A device as the environment wants it: with SUPPLE_VALIDATION=1 the validation layer runs along.
[[nodiscard]] std::unique_ptr<Device> mustCreateDevice(DeviceOptions options = {});
/// A context for kFramesInFlight frames, which prints its warnings and errors. `record`: a file for a recording of it,
/// or empty; `recordingFlags`: SuppleRecordingFlags of that, besides its hashes. It must go before the device.
[[nodiscard]] supple::Context mustCreateContext(Device& device, const std::string& record = {},
                                                uint32_t recordingFlags = 0);
/// Ends the process with exit code 1 if the validation layer has said anything. The device must be gone.
void mustBeSilent(const ValidationLog& validation);

} // namespace supple::host
