// supple_playback.h, streaming.
#include "runtime/api/entry.h"

#include <cmath>
#include <limits>

using namespace supple;      // NOLINT
using namespace supple::api; // NOLINT

namespace {

/// What is wrong with a request, if anything is.
std::optional<Error> faultOf(const SuppleClipRequest& request) {
    if (!within(request.use, SUPPLE_CLIP_RELEASE)) {
        return Error{ErrorCode::range, "no such use"};
    }
    if (!std::isfinite(request.begin) || !std::isfinite(request.end)) {
        return Error{ErrorCode::notFinite, "begin or end is not finite"};
    }
    if (request.begin < 0.0 || request.end < 0.0 || (request.end > 0.0 && request.begin > request.end)) {
        return Error{ErrorCode::range, "begin or end is negative, or begin lies behind end"};
    }
    return std::nullopt;
}

runtime::ClipRequest inParts(uint32_t clip, double duration, const SuppleClipRequest& request) {
    const double scale = duration > 0.0 ? 1.0 / duration : 0.0;
    runtime::ClipRequest own;
    own.clip = clip;
    own.use = static_cast<runtime::ClipRequest::Use>(request.use);
    own.begin = std::min(request.begin * scale, 1.0);
    own.end = request.end > 0.0 ? std::min(request.end * scale, 1.0) : 1.0;
    return own;
}
static_assert(SUPPLE_CLIP_REQUEST == static_cast<int>(runtime::ClipRequest::Use::wanted) &&
              SUPPLE_CLIP_PIN == static_cast<int>(runtime::ClipRequest::Use::pinned) &&
              SUPPLE_CLIP_RELEASE == static_cast<int>(runtime::ClipRequest::Use::released));

} // namespace

SuppleResult suppleRequestClip(SuppleContext handle, SuppleAsset asset, uint32_t clip, const SuppleClipRequest* given) {
    constexpr const char* kHere = "suppleRequestClip";
    return withAsset(handle, asset, kHere, [&](Context& context, Asset& found) {
        const std::vector<cage::Clip>& clips = found.character.clips;
        const auto refused = [&](ErrorCode code, const std::string& reason) {
            return refuse(context, code, kHere, found.character.name + ": " + reason);
        };
        if (clip >= clips.size()) {
            return refused(ErrorCode::range, "clip " + std::to_string(clip) + " of " + std::to_string(clips.size()));
        }
        SuppleClipRequest request{};
        request.structSize = sizeof request;
        if (given != nullptr) {
            if (const auto fault = takeIn(context, kHere, "request", given, request)) {
                return *fault;
            }
        }
        if (const std::optional<Error> fault = faultOf(request)) {
            return refused(fault->code, fault->message);
        }
        const Status taken = context.requestClip(found, inParts(clip, clips[clip].duration, request));
        return taken ? noted(context, calls::RequestClip{asset, clip, request})
                     : refused(taken.error().code, "clip " + clips[clip].name + ": " + taken.error().message);
    });
}
