// The weights of a joint on the smooth surface, as the product itself makes them.
#include "host/figure.h"

#include <algorithm>

namespace supple::host {

namespace {

using Matrix = std::array<float, 16>;

Result<std::vector<Matrix>> bindPose(const Figure& figure) {
    Context& context = figure.context();
    SuppleAssetInfo info{};
    info.structSize = sizeof info;
    SuppleResult result = suppleGetAssetInfo(context.handle(), figure.asset(), &info);
    std::vector<Matrix> pose(info.jointCount);
    for (uint32_t joint = 0; result == SUPPLE_OK && joint < info.jointCount; ++joint) {
        SuppleJointInfo own{};
        own.structSize = sizeof own;
        result = suppleGetJointInfo(context.handle(), figure.asset(), joint, &own);
        std::copy(std::begin(own.bindTransform), std::end(own.bindTransform), pose[joint].begin());
    }
    if (const Status status = context.check(result, "suppleGetJointInfo"); !status)
        return status.error();
    return pose;
}

} // namespace

Status FigureGroup::showWeights(uint32_t joint) {
    Context& context = figure_.context();
    Result<std::vector<Matrix>> pose = bindPose(figure_);
    if (!pose)
        return pose.error();
    if (joint >= pose->size())
        return Error{ErrorCode::argument, figure_.path() + ": it has " + std::to_string(pose->size()) + " joints, no " +
                                              std::to_string(joint)};
    const auto evaluate = [&]() -> Result<std::vector<glm::vec3>> {
        const SuppleResult result = suppleSetMatrixPose(context.handle(), instances_[0], pose->front().data(),
                                                        static_cast<uint32_t>(pose->size()));
        if (const Status status = context.check(result, "suppleSetMatrixPose"); !status)
            return status.error();
        const SuppleGroup groups[] = {group_};
        if (const Status status = context.evaluate(groups); !status)
            return status.error();
        return readSurface();
    };
    const Result<std::vector<glm::vec3>> still = evaluate();
    if (!still)
        return still.error();
    // Aside by the figure's own size: large against rounding.
    const float aside = boundsOf(*still).radius();
    (*pose)[joint][12] += aside;
    const Result<std::vector<glm::vec3>> moved = evaluate();
    if (!moved)
        return moved.error();
    std::vector<float> weights(still->size());
    for (size_t i = 0; i < weights.size(); ++i)
        weights[i] = std::max(((*moved)[i].x - (*still)[i].x) / aside, 0.0f); // below 0 there would be none
    return setValues(weights);
}

} // namespace supple::host
