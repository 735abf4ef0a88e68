#include "host/level_view.h"

#include <cmath>
#include <cstring>

namespace supple::host {

namespace {

/// For one character that fills a window. If that is not enough, all levels are scaled down.
constexpr uint32_t kMostVertices = 1u << 20;

} // namespace

Result<std::unique_ptr<LevelView>> LevelView::create(Context& context, SuppleVertexFormat format, bool tangents) {
    std::unique_ptr<LevelView> view(new LevelView(context));
    SuppleViewDesc desc{};
    desc.structSize = sizeof desc;
    desc.flags = SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_UVS1 | SUPPLE_VIEW_FACE_UVS;
    if (tangents)
        desc.flags |= SUPPLE_VIEW_TANGENTS;
    desc.maxVertices = kMostVertices;
    desc.vertexFormat = format;
    const SuppleResult result = suppleCreateView(context.handle(), &desc, &view->view_);
    if (const Status status = context.check(result, "suppleCreateView"); !status)
        return status.error();
    return view;
}

LevelView::~LevelView() {
    if (view_.id != 0)
        suppleDestroyView(context_.handle(), view_);
}

Status LevelView::setCamera(const Camera& camera, uint32_t height, float chordError) {
    SuppleCameraDesc desc{};
    desc.structSize = sizeof desc;
    const glm::vec3 eye = camera.eye();
    std::memcpy(desc.position, &eye, sizeof desc.position);
    desc.pixelsPerUnit = static_cast<float>(height) / (2.0f * std::tan(0.5f * camera.fieldOfView));
    desc.chordError = chordError;
    return context_.check(suppleSetCamera(context_.handle(), view_, &desc), "suppleSetCamera");
}

std::optional<SuppleViewStatistics> LevelView::statistics() const {
    SuppleViewStatistics statistics{};
    statistics.structSize = sizeof statistics;
    if (suppleGetViewStatistics(context_.handle(), view_, &statistics) != SUPPLE_OK)
        return std::nullopt;
    return statistics;
}

} // namespace supple::host
