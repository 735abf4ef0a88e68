#include "tools/supple/session.h"

#include "tools/supple/command.h"

namespace supple::tools {

int withSession(const DeviceFlags& flags, const std::function<Status(Session&)>& work) {
    std::shared_ptr<const host::ValidationLog> validation;
    Status status = success();
    {
        Result<std::unique_ptr<host::Device>> device =
            host::Device::create({.device = flags.device, .validation = flags.validate});
        if (!device) {
            return fail(device.error());
        }
        validation = (*device)->validation();
        Result<std::unique_ptr<host::Context>> context = host::Context::create(**device, {.mapping = mappingOf(flags)});
        if (!context) {
            return fail(context.error());
        }
        Session session{std::move(*device), std::move(*context)};
        status = work(session);
        // What is destroyed below may still be in use by a frame that a failure left behind.
        vkDeviceWaitIdle(session.device->handle());
    }
    if (!status) {
        return fail(status.error());
    }
    if (validation->messageCount() != 0) {
        return fail(kExitBadInput, std::to_string(validation->messageCount()) + " validation messages");
    }
    return kExitOk;
}

} // namespace supple::tools
