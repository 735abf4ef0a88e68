// A Supple context on a host device, freed when it goes, whose failures come back as Status with Supple's own words.
#pragma once

#include "base/result.h"
#include "host/device.h"
#include "host/recording.h"

#include <supple/supple.h>

#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace supple::host {

struct ContextOptions {
    SuppleMapping mapping = SUPPLE_MAPPING_AUTO;
    uint32_t framesInFlight = 2;
    uint32_t flags = 0; ///< SuppleContextFlags, beside those of contextDesc()
    /// Print Supple's warnings and its notes about rates that were rounded up on stderr, each once.
    bool printWarnings = true;
    std::string record; ///< a file for a recording of all that is done to the context; empty: none
};

/// What Supple borrows of the device, and debug utils where it has them; all else is left at its default.
[[nodiscard]] SuppleContextDesc contextDesc(const Device& device);

class Context {
public:
    /// The device must outlive the context.
    [[nodiscard]] static Result<std::unique_ptr<Context>> create(Device& device, const ContextOptions& options = {});
    /// Nothing that uses the context may be pending on the device.
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    [[nodiscard]] SuppleContext handle() const { return context_; }
    [[nodiscard]] Device& device() const { return device_; }

    /// Success for SUPPLE_OK; otherwise the error with the line Supple logged about it.
    [[nodiscard]] Status check(SuppleResult result, const char* call);

    /// Fills a group with `count` instances.
    [[nodiscard]] Status createInstances(SuppleGroup group, uint32_t count, std::vector<SuppleInstance>& out);

    /// A frame number not used before; every frame of the context takes its number here.
    [[nodiscard]] uint64_t nextFrame() { return ++frame_; }
    [[nodiscard]] uint64_t lastFrame() const { return frame_; }
    /// One whole frame: records the groups as they are posed, submits and waits. For hosts that do not overlap frames.
    [[nodiscard]] Status evaluate(std::span<const SuppleGroup> groups, uint32_t recordFlags = 0);

private:
    explicit Context(Device& device) : device_(device) {}
    static void log(SuppleSeverity severity, SuppleMessage message, const char* text, void* user);

    Device& device_;
    SuppleContext context_ = nullptr;
    std::unique_ptr<Recording> recording_;
    uint64_t frame_ = 0;
    bool printWarnings_ = true;
    std::string lastError_;
    std::set<std::string> printed_;
};

} // namespace supple::host
