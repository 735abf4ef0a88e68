// supple.h, device: version, requirements, context.
#include "gpu/ray_tracing.h"
#include "runtime/api/entry.h"

#include <cstdio>
#include <cstring>

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

uint32_t suppleGetVersion(void) {
    return SUPPLE_VERSION;
}

const char* suppleResultString(SuppleResult result) {
    switch (result) {
    case SUPPLE_OK:
        return "SUPPLE_OK";
    case SUPPLE_NOT_READY:
        return "SUPPLE_NOT_READY";
    case SUPPLE_INCOMPLETE:
        return "SUPPLE_INCOMPLETE";
    case SUPPLE_ERROR_ARGUMENT:
        return "SUPPLE_ERROR_ARGUMENT";
    case SUPPLE_ERROR_ASSET:
        return "SUPPLE_ERROR_ASSET";
    case SUPPLE_ERROR_UNSUPPORTED:
        return "SUPPLE_ERROR_UNSUPPORTED";
    case SUPPLE_ERROR_LIMIT:
        return "SUPPLE_ERROR_LIMIT";
    case SUPPLE_ERROR_HOST_MEMORY:
        return "SUPPLE_ERROR_HOST_MEMORY";
    case SUPPLE_ERROR_DEVICE_MEMORY:
        return "SUPPLE_ERROR_DEVICE_MEMORY";
    case SUPPLE_ERROR_DEVICE_LOST:
        return "SUPPLE_ERROR_DEVICE_LOST";
    case SUPPLE_ERROR_VULKAN:
        return "SUPPLE_ERROR_VULKAN";
    case SUPPLE_RESULT_MAX_ENUM:
        break;
    }
    return "unknown SuppleResult";
}

namespace {

/// What contexts with these flags need besides.
void fillOptional(uint32_t contextFlags, SuppleRequirements& out) {
    out.contextFlags = contextFlags;
    out.accelerationStructure.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
    if ((contextFlags & (SUPPLE_CONTEXT_SHARED_DISPATCHES | SUPPLE_CONTEXT_RAY_TRACING)) != 0) {
        out.features12.bufferDeviceAddress = VK_TRUE;
    }
    if ((contextFlags & SUPPLE_CONTEXT_RAY_TRACING) != 0) {
        out.accelerationStructure.accelerationStructure = VK_TRUE;
        out.extensions = gpu::rayTracingExtensions().data();
        out.extensionCount = static_cast<uint32_t>(gpu::rayTracingExtensions().size());
    }
}

} // namespace

SuppleResult suppleQueryRequirements(VkInstance instance, VkPhysicalDevice physicalDevice,
                                     PFN_vkGetInstanceProcAddr getInstanceProcAddr, SuppleRequirements* out) {
    if (out == nullptr) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    // There is no log, so the reason says it. All versions of the struct have room for it at the same place, also those
    // whose size the host has forgotten to set.
    const auto refused = [out](const std::string& reason) {
        std::snprintf(out->reason, sizeof(out->reason), "%s", reason.c_str());
        return SUPPLE_ERROR_ARGUMENT;
    };
    try {
        if (!runtime::isPossibleSize<SuppleRequirements>(out->structSize)) {
            return out->structSize != 0 ? SUPPLE_ERROR_ARGUMENT
                                        : refused(faultOfSize<SuppleRequirements>("out", out->structSize));
        }
        if (instance == VK_NULL_HANDLE || physicalDevice == VK_NULL_HANDLE || getInstanceProcAddr == nullptr) {
            return refused("instance, physicalDevice or getInstanceProcAddr is null");
        }
        SuppleRequirements filled{};
        filled.apiVersion = gpu::kVulkanVersion;
        filled.features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
        filled.features13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
        SuppleRequirements given{};
        if (!runtime::readSized(*out, given)) { // in a newer struct the rest may hold anything
            std::memcpy(&given, out, sizeof(given));
        }
        filled.instanceVersion = given.instanceVersion;
        const bool tracesRays = (given.contextFlags & SUPPLE_CONTEXT_RAY_TRACING) != 0;
        fillOptional(given.contextFlags, filled);
        std::string missing =
            gpu::missingInInstance(instance, physicalDevice, getInstanceProcAddr, given.instanceVersion);
        if (missing.empty()) {
            missing = gpu::missingRequirement(instance, physicalDevice, getInstanceProcAddr);
        }
        if (missing.empty() && (given.contextFlags & SUPPLE_CONTEXT_SHARED_DISPATCHES) != 0) {
            missing = gpu::missingForAddresses(instance, physicalDevice, getInstanceProcAddr);
        }
        if (missing.empty() && tracesRays) {
            missing = gpu::missingForRayTracing(instance, physicalDevice, getInstanceProcAddr);
        }
        std::snprintf(filled.reason, sizeof(filled.reason), "%s", missing.c_str());
        runtime::writeSized(filled, *out);
        return missing.empty() ? SUPPLE_OK : SUPPLE_ERROR_UNSUPPORTED;
    } catch (const std::exception&) {
        return SUPPLE_ERROR_HOST_MEMORY;
    }
}

SuppleResult suppleCreateContext(const SuppleContextDesc* given, SuppleContext* out) {
    if (out != nullptr) {
        *out = nullptr;
    }
    // A struct that says another size than any version's has no callback to tell. Without a size it is one of ours.
    SuppleContextDesc desc{};
    if (given == nullptr ||
        (given->structSize != 0 && !runtime::isPossibleSize<SuppleContextDesc>(given->structSize))) {
        return SUPPLE_ERROR_ARGUMENT;
    }
    try {
        const auto refused = [&](ErrorCode code, const std::string& text) {
            const Verdict verdict = verdictOf(code);
            if (given->log != nullptr) {
                given->log(SUPPLE_SEVERITY_ERROR, verdict.message, text.c_str(), given->logUser);
            }
            return verdict.result;
        };
        const auto refusedHere = [&](ErrorCode code, const std::string& reason) {
            return refused(code, "suppleCreateContext: " + reason);
        };
        if (!runtime::readSized(*given, desc)) {
            return refusedHere(ErrorCode::structSize, faultOfSize<SuppleContextDesc>("desc", given->structSize));
        }
        if (out == nullptr || desc.instance == VK_NULL_HANDLE || desc.physicalDevice == VK_NULL_HANDLE ||
            desc.device == VK_NULL_HANDLE || desc.getInstanceProcAddr == nullptr) {
            return refusedHere(ErrorCode::nullPointer,
                               "out, instance, physicalDevice, device or getInstanceProcAddr is null");
        }
        constexpr uint32_t kFlags = SUPPLE_CONTEXT_DEBUG_UTILS | SUPPLE_CONTEXT_ASYNC_COMPUTE |
                                    SUPPLE_CONTEXT_SHARED_DISPATCHES | SUPPLE_CONTEXT_RECORDABLE |
                                    SUPPLE_CONTEXT_FAN_RECORDS | SUPPLE_CONTEXT_RAY_TRACING;
        if (desc.framesInFlight > SUPPLE_MAX_FRAMES_IN_FLIGHT || !within(desc.mapping, SUPPLE_MAPPING_WIDE) ||
            (desc.flags & ~kFlags) != 0) {
            return refusedHere(
                ErrorCode::range,
                "framesInFlight must be 0..4, mapping one of SuppleMapping, flags of SuppleContextFlags");
        }
        if (desc.memory != nullptr && (desc.memory->allocate == nullptr || desc.memory->free == nullptr)) {
            return refusedHere(ErrorCode::nullPointer, "memory->allocate or memory->free is null");
        }
        Result<std::unique_ptr<Context>> context = Context::create(desc);
        if (!context) {
            return refused(context.error().code, context.error().message);
        }
        *out = new SuppleContext_T{std::move(*context)};
        return SUPPLE_OK;
    } catch (const std::exception&) {
        return SUPPLE_ERROR_HOST_MEMORY;
    }
}

void suppleDestroyContext(SuppleContext context) {
    delete context;
}

SuppleResult suppleGetMapping(SuppleContext handle, SuppleMapping* out) {
    return guarded(handle, "suppleGetMapping", [&](Context& context) {
        if (out == nullptr) {
            return refuse(context, ErrorCode::nullPointer, "suppleGetMapping", "out is null");
        }
        *out = context.isWide() ? SUPPLE_MAPPING_WIDE : SUPPLE_MAPPING_NARROW;
        return SUPPLE_OK;
    });
}
