// The machine that a measurement was taken on.
#pragma once

#include <string>

namespace supple::host {
class Device;
}

namespace supple::tools {

struct Machine {
    std::string device, driver, driverInfo, mapping, cpu;
    bool cpuDevice = false;
};
[[nodiscard]] Machine describeMachine(const host::Device& device, const std::string& mapping);

} // namespace supple::tools
