#include "tools/supple/render.h"

#include "tools/supple/command.h"
#include "tools/supple/render_stage.h"

namespace supple::tools {

namespace {

constexpr float kMargin = 0.07f;
/// Poses looked at to find the floor a clip is played on.
constexpr uint32_t kFloorPoses = 9;

Status render(Session& session, const RenderOptions& options, VkExtent2D size, uint32_t view) {
    Result<std::unique_ptr<Stage>> opened = Stage::open(session, options.file, size, options.draw);
    if (!opened)
        return opened.error();
    Stage& stage = **opened;
    const Result<uint32_t> clip = stage.figure().findClip(options.clip);
    if (!clip)
        return clip.error();
    const bool cage = options.draw.scheme == "cage";

    host::Scene scene;
    if (options.draw.ground) {
        const Result<Extent> played = stage.measure(spreadTimes(stage.figure(), *clip, kFloorPoses), cage);
        if (!played)
            return played.error();
        scene.ground = played->bounds.min.y;
    }
    const ClipTime shown[] = {{*clip, options.time}};
    const Result<Extent> figure = stage.measure(shown, cage);
    if (!figure)
        return figure.error();
    scene.camera = host::frameCamera(figure->points, radians(options.draw.yaw), radians(options.draw.pitch),
                                     static_cast<float>(size.width) / static_cast<float>(size.height), kMargin);
    scene.bounds = figure->bounds;
    if (scene.ground)
        scene.ground = std::min(*scene.ground, figure->bounds.min.y);
    scene.lightYaw = scene.camera.yaw;
    scene.view = view;
    scene.cageFaces = cage;
    scene.cageEdges = cage || options.draw.cageOverlay;
    scene.pixelScale = pixelScale(size);
    Result<host::Picture> picture = stage.draw(scene);
    if (!picture)
        return picture.error();
    return host::writePng(*picture, options.output);
}

} // namespace

int runRender(const RenderOptions& options) {
    const Result<VkExtent2D> size = parseSize(options.size);
    if (!size)
        return fail(kExitUsage, "--size: " + size.error().message);
    const Result<uint32_t> view = parseView(options.draw.view);
    if (!view)
        return fail(kExitUsage, "--view: " + view.error().message);
    return withSession(deviceFlags(options.draw),
                       [&](Session& session) { return render(session, options, *size, *view); });
}

} // namespace supple::tools
