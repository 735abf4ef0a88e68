#include "tools/supple/evaluation.h"

#include <utility>

namespace supple::tools {
namespace {

/// Reads a buffer of the group's output; one that the group was made without stays empty.
Status readBack(host::Device& device, const SuppleBufferRange& view, std::vector<std::byte>& bytes) {
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
    SchemeOptions options;
    describeSurface(surface, options, desc);
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
    if (status && !pose.morphWeights.empty()) {
        status = context.check(suppleSetMorphWeights(context.handle(), instance, pose.morphWeights.data(),
                                                     static_cast<uint32_t>(pose.morphWeights.size())),
                               "suppleSetMorphWeights");
    }
    if (status) {
        const SuppleGroup groups[] = {group};
        status = context.evaluate(groups);
    }
    Evaluation result;
    if (status) {
        status = context.check(host::getGroupOutput(context.handle(), group, result.output), "suppleGetGroupInfo");
    }
    if (status) {
        uint32_t count = result.output.info.patchCount;
        result.patches.resize(count);
        status =
            context.check(suppleGetPatches(context.handle(), group, result.patches.data(), &count), "suppleGetPatches");
    }
    const std::pair<const SuppleBufferRange*, std::vector<std::byte>*> buffers[] = {
        {&result.output.streams.vertices, &result.surfaceVertices},
        {&result.output.streams.attributes, &result.attributes},
        {&result.output.indices(), &result.gridIndices},
        {&result.output.info.patchCoefficients, &result.coefficients},
        {&result.output.info.deformedCage, &result.deformedCage},
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
