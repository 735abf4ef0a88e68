// A device for tests that count what the validation layer says.
#pragma once

#include "host/device.h"

#include <memory>
#include <utility>

namespace supple::host {

/// Under the validation layer where it is installed.
inline Result<std::unique_ptr<Device>> createValidatedDevice(DeviceOptions options = {}) {
    options.validation = true;
    Result<std::unique_ptr<Device>> device = Device::create(options);
    if (!device.ok()) {
        options.validation = false;
        device = Device::create(options);
    }
    return device;
}

} // namespace supple::host
