#include "runtime/api/entry.h"

namespace supple::api {

Verdict verdictOf(ErrorCode code) {
    switch (code) {
    case ErrorCode::argument:
        return {SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_CONFLICT};
    case ErrorCode::nullPointer:
        return {SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_NULL_POINTER};
    case ErrorCode::structSize:
        return {SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_STRUCT_SIZE};
    case ErrorCode::staleHandle:
        return {SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_STALE_HANDLE};
    case ErrorCode::range:
        return {SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_OUT_OF_RANGE};
    case ErrorCode::notFinite:
        return {SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_NOT_FINITE};
    case ErrorCode::order:
        return {SUPPLE_ERROR_ARGUMENT, SUPPLE_MESSAGE_OUT_OF_ORDER};
    case ErrorCode::asset:
    case ErrorCode::io:
        return {SUPPLE_ERROR_ASSET, SUPPLE_MESSAGE_ASSET_REFUSED};
    case ErrorCode::unsupported:
        return {SUPPLE_ERROR_UNSUPPORTED, SUPPLE_MESSAGE_DEVICE_UNSUITED};
    case ErrorCode::disabled:
        return {SUPPLE_ERROR_UNSUPPORTED, SUPPLE_MESSAGE_FEATURE_DISABLED};
    case ErrorCode::limit:
        return {SUPPLE_ERROR_LIMIT, SUPPLE_MESSAGE_LIMIT};
    case ErrorCode::hostMemory:
        return {SUPPLE_ERROR_HOST_MEMORY, SUPPLE_MESSAGE_HOST_MEMORY};
    case ErrorCode::deviceMemory:
        return {SUPPLE_ERROR_DEVICE_MEMORY, SUPPLE_MESSAGE_DEVICE_MEMORY};
    case ErrorCode::deviceLost:
        return {SUPPLE_ERROR_DEVICE_LOST, SUPPLE_MESSAGE_DEVICE_LOST};
    case ErrorCode::vulkan:
        return {SUPPLE_ERROR_VULKAN, SUPPLE_MESSAGE_VULKAN};
    }
    return {SUPPLE_ERROR_VULKAN, SUPPLE_MESSAGE_VULKAN};
}

SuppleResult report(Context& context, const Error& error) {
    const Verdict verdict = verdictOf(error.code);
    if (verdict.result == SUPPLE_ERROR_DEVICE_LOST) {
        context.setLost();
    }
    context.log(SUPPLE_SEVERITY_ERROR, verdict.message, error.message);
    return verdict.result;
}

SuppleResult refuse(Context& context, ErrorCode code, const char* function, const std::string& reason) {
    return report(context, {code, std::string(function) + ": " + reason});
}

SuppleResult refuse(Context& context, const Group& group, ErrorCode code, const char* function,
                    const std::string& reason) {
    return refuse(context, code, function, group.asset().character.name + ": " + reason);
}

SuppleResult reportStatus(Context& context, const Status& status) {
    return status ? SUPPLE_OK : report(context, status.error());
}

} // namespace supple::api
