#include "tools/supple/session.h"

#include "tools/supple/command.h"
#include "tools/supple/progress.h"

namespace supple::tools {

Status inSession(const DeviceFlags& flags, const std::function<Status(Session&)>& work) {
    std::shared_ptr<const host::ValidationLog> validation;
    Status status = success();
    {
        Result<std::unique_ptr<host::Device>> device = host::Device::create(
            {.device = flags.device, .validation = flags.validate, .rayTracing = flags.rayTracing});
        if (!device) {
            return device.error();
        }
        validation = (*device)->validation();
        Result<std::unique_ptr<host::Context>> context =
            host::Context::create(**device, {.mapping = mappingOf(flags), .record = flags.record});
        if (!context) {
            return context.error();
        }
        Session session{std::move(*device), std::move(*context)};
        status = work(session);
        // What is destroyed below may still be in use by a frame that a failure left behind.
        vkDeviceWaitIdle(session.device->handle());
    }
    if (status && validation->messageCount() != 0) {
        return Error{ErrorCode::vulkan, std::to_string(validation->messageCount()) + " validation messages"};
    }
    return status;
}

int withSession(const DeviceFlags& flags, const std::function<Status(Session&)>& work) {
    const Status status = inSession(flags, work);
    endProgress();
    return status ? kExitOk : fail(status.error());
}

} // namespace supple::tools
