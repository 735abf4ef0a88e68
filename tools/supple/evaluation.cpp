#include "tools/supple/evaluation.h"

#include <utility>

namespace supple::tools {
namespace {

/// Reads a buffer of the group's output; one that the group was made without stays empty.
Status readBack(host::Device& device, const SuppleBufferView& view, std::vector<std::byte>& bytes) {
    if (view.buffer == VK_NULL_HANDLE) {
        return success();
    }
    Result<std::vector<std::byte>> read = device.readBuffer(view);
    if (!read) {
        return read.error();
    }
    bytes = std::move(*read);
    return success();
}

} // namespace

Result<Evaluation> evaluate(Session& session, SuppleAsset asset, const SurfaceFlags& surface, const Pose& pose,
                            uint32_t groupFlags) {
    host::Context& context = *session.context;
    SuppleGroupDesc desc{};
    desc.structSize = sizeof desc;
    desc.flags = groupFlags;
    desc.asset = asset;
    desc.capacity = 1;
    desc.scheme = schemeOf(surface.scheme);
    desc.rate = surface.rate;
    desc.vertexFormat = SUPPLE_VERTEX_24;
    describeSurface(surface, desc);
    SuppleGroup group{};
    Status status = context.check(suppleCreateGroup(context.handle(), &desc, &group), "suppleCreateGroup");
    SuppleInstance instance{};
    if (status) {
        status = context.check(suppleCreateInstance(context.handle(), group, &instance), "suppleCreateInstance");
    }
    if (status) {
        status =
            context.check(suppleSetClipPose(context.handle(), instance, pose.clip, pose.time), "suppleSetClipPose");
    }
    if (status) {
        const SuppleGroup groups[] = {group};
        status = context.evaluate(groups);
    }
    Evaluation result;
    result.output.structSize = sizeof result.output;
    if (status) {
        status = context.check(suppleGetGroupOutput(context.handle(), group, &result.output), "suppleGetGroupOutput");
    }
    if (status) {
        uint32_t count = result.output.patchCount;
        result.patches.resize(count);
        status =
            context.check(suppleGetPatches(context.handle(), group, result.patches.data(), &count), "suppleGetPatches");
    }
    const std::pair<const SuppleBufferView*, std::vector<std::byte>*> buffers[] = {
        {&result.output.surfaceVertices, &result.surfaceVertices},
        {&result.output.attributes, &result.attributes},
        {&result.output.gridIndices, &result.gridIndices},
        {&result.output.patchCoefficients, &result.coefficients},
        {&result.output.deformedCage, &result.deformedCage},
    };
    for (const auto& [view, bytes] : buffers) {
        if (status) {
            status = readBack(*session.device, *view, *bytes);
        }
    }
    if (!status) {
        return status.error();
    }
    return result;
}

} // namespace supple::tools
