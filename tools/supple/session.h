// A device and a Supple context for one run of a subcommand.
#pragma once

#include "base/result.h"
#include "host/context.h"
#include "host/device.h"
#include "tools/supple/options.h"

#include <functional>
#include <memory>

namespace supple::tools {

struct Session {
    std::unique_ptr<host::Device> device;
    std::unique_ptr<host::Context> context; ///< goes before the device
};

/// Opens a session, does the work and closes the session; validation messages make it fail.
[[nodiscard]] Status inSession(const DeviceFlags& flags, const std::function<Status(Session&)>& work);

/// Opens a session, does the work, closes the session and returns the exit code: any failure is reported on stderr, and
/// so are validation messages, which fail the command too.
int withSession(const DeviceFlags& flags, const std::function<Status(Session&)>& work);

} // namespace supple::tools
