// What a host tells Supple about itself.
#pragma once

#include "device.h"

#include <supple/supple.hpp>

#include <cstdio>

namespace sample {

inline void onLog(SuppleSeverity severity, SuppleMessage message, const char* text, void*) {
    if (severity != SUPPLE_SEVERITY_INFO)
        std::fprintf(stderr, "supple %d: %s\n", static_cast<int>(message), text);
}

inline supple::Context createContext(const Device& device) {
    auto desc = supple::sized<SuppleContextDesc>();
    desc.instance = device.instance();
    desc.physicalDevice = device.physicalDevice();
    desc.device = device.handle();
    desc.queueFamily = device.queueFamily();
    desc.getInstanceProcAddr = vkGetInstanceProcAddr;
    desc.framesInFlight = static_cast<uint32_t>(kFramesInFlight);
    desc.enabledFeatures = device.enabledFeatures();
    desc.log = onLog;
    supple::Context context;
    check(supple::Context::create(desc, context), "suppleCreateContext");
    return context;
}

} // namespace sample
