#include "tools/supple/render.h"

#include "tools/common/figure_file.h"
#include "tools/supple/command.h"
#include "tools/supple/output_files.h"
#include "tools/supple/progress.h"
#include "tools/supple/render_stage.h"
#include "tools/supple/sheet_style.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

namespace supple::tools {

namespace {

/// Poses looked at to find the floor a clip is played on.
constexpr uint32_t kFloorPoses = 9;
/// Sheets are laid out to come near to this shape, width by height, with few places left empty.
constexpr double kSheetShape = 1.8;

/// A scheme's surface (or the cage) and where it is.
struct Shown {
    std::string name;
    std::unique_ptr<Stage> stage;
    Extent figure;
    std::optional<float> ground;
};

Result<Shown> open(Session& session, const RenderOptions& options, const std::string& scheme, VkExtent2D size) {
    DrawOptions draw = options.draw;
    draw.scheme = scheme;
    Shown shown;
    shown.name = scheme;
    Result<std::unique_ptr<Stage>> opened = Stage::open(session, options.file, size, draw);
    if (!opened)
        return opened.error();
    shown.stage = std::move(*opened);
    Stage& stage = *shown.stage;
    const Result<uint32_t> clip = host::findClip(stage.figure(), options.clip);
    if (!clip)
        return clip.error();
    const bool cage = scheme == "cage";
    if (options.draw.ground) {
        const Result<Extent> played = stage.measure(spreadTimes(stage.figure(), *clip, kFloorPoses), cage);
        if (!played)
            return played.error();
        shown.ground = played->bounds.min.y;
    }
    const ClipTime pose[] = {{*clip, options.time, {}, options.time - options.draw.simulate}};
    Result<Extent> figure = stage.measure(pose, cage); // and leaves it in this pose
    if (!figure)
        return figure.error();
    shown.figure = std::move(*figure);
    if (shown.ground)
        shown.ground = std::min(*shown.ground, shown.figure.bounds.min.y);
    return shown;
}

/// Brings the camera's picture closer, about a place in it.
void closeUp(host::Camera& camera, const RenderOptions& options, float aspect) {
    double x = 0.5;
    double y = 0.5;
    if (!parsePlace(options.at, x, y))
        return; // the command line has checked it
    const float tangent = std::tan(camera.fieldOfView * 0.5f);
    const float height = 2.0f * camera.distance * tangent;
    const glm::mat3 toWorld = glm::transpose(glm::mat3(camera.view()));
    camera.target += toWorld[0] * (static_cast<float>(x) - 0.5f) * height * aspect;
    camera.target += toWorld[1] * (0.5f - static_cast<float>(y)) * height;
    camera.fieldOfView = 2.0f * std::atan(tangent / static_cast<float>(options.zoom));
}

/// The camera of --eye. What is in focus is as far away as the figure's middle, so that near and far enclose it.
host::Camera placedCamera(const RenderOptions& options, const host::Bounds& bounds) {
    glm::vec3 eye, lookAt, up;
    if (!parsePoint(options.eye, eye) || !parsePoint(options.lookAt, lookAt) || !parsePoint(options.up, up))
        return {}; // the command line has checked them
    const glm::vec3 ahead = glm::normalize(lookAt - eye);
    const float distance = std::max(glm::dot(bounds.center() - eye, ahead), bounds.radius() * 0.1f);
    host::Camera camera = host::lookAt(eye, eye + ahead * distance, up);
    camera.fieldOfView = radians(options.fieldOfView);
    return camera;
}

/// What all of them are drawn with: one camera, one floor, one light, so that only the surfaces differ.
host::Scene sceneFor(const std::vector<Shown>& all, const RenderOptions& options, VkExtent2D size, uint32_t view) {
    const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
    const float framed = options.draw.split ? 0.5f * aspect : aspect;
    host::Scene scene;
    std::vector<glm::vec3> points;
    for (const Shown& shown : all) {
        const std::vector<glm::vec3> own = shown.figure.framed(options.draw.split);
        points.insert(points.end(), own.begin(), own.end());
        if (shown.ground)
            scene.ground = std::min(scene.ground.value_or(*shown.ground), *shown.ground);
    }
    scene.bounds = host::boundsOf(points);
    scene.camera = options.eye.empty() ? host::frameCamera(points, radians(options.draw.yaw),
                                                           radians(options.draw.pitch), framed, kPictureMargin)
                                       : placedCamera(options, scene.bounds);
    scene.lightYaw = scene.camera.yaw;
    if (options.zoom > 1.0)
        closeUp(scene.camera, options, aspect);
    scene.view = view;
    const bool cage = all.size() == 1 && all.front().name == "cage";
    scene.cageFaces = cage;
    scene.cageEdges = cage || options.draw.cageOverlay;
    if (options.draw.split)
        scene.split = 0.0f;
    fitToPixels(scene, size);
    return scene;
}

uint32_t sheetColumns(uint32_t count, VkExtent2D cell) {
    uint32_t best = 1;
    double least = std::numeric_limits<double>::max();
    for (uint32_t columns = 1; columns <= count; ++columns) {
        const uint32_t rows = (count + columns - 1) / columns;
        const double shape = static_cast<double>(columns) * cell.width / (static_cast<double>(rows) * cell.height);
        const double empty = static_cast<double>(columns) * rows / count; // 1: every place is taken
        const double cost = std::abs(std::log(shape / kSheetShape)) + 2.0 * std::log(empty);
        if (cost <= least) {
            best = columns;
            least = cost;
        }
    }
    return best;
}

Status drawSheet(std::vector<Shown>& all, const host::Scene& scene, const RenderOptions& options, VkExtent2D cell) {
    const auto count = static_cast<uint32_t>(all.size());
    const uint32_t columns = sheetColumns(count, cell);
    const uint32_t rows = (count + columns - 1) / columns;
    const uint32_t stepX = cell.width + kSheetGap;
    const uint32_t stepY = kSheetLabelHeight + cell.height + kSheetGap;
    host::Picture sheet = blankSheet(kSheetGap + columns * stepX, kSheetGap + rows * stepY);
    for (uint32_t i = 0; i < count; ++i) {
        showProgress("drawing schemes", i + 1, count);
        const Result<host::Picture> picture = all[i].stage->draw(scene, options.draw.alpha);
        if (!picture)
            return picture.error();
        const uint32_t x = kSheetGap + i % columns * stepX;
        const uint32_t y = kSheetGap + i / columns * stepY;
        sheet.drawText(x + 4, y + 2, all[i].name, 2, kSheetInk);
        sheet.paste(*picture, x, y + kSheetLabelHeight);
    }
    return host::writePng(sheet, options.output);
}

Status render(Session& session, const RenderOptions& options, VkExtent2D size, uint32_t view) {
    std::vector<Shown> all;
    if (options.draw.scheme != kAllSchemes) {
        Result<Shown> shown = open(session, options, options.draw.scheme, size);
        if (!shown)
            return shown.error();
        all.push_back(std::move(*shown));
        showProgress("drawing");
        const Result<host::Picture> picture =
            all.front().stage->draw(sceneFor(all, options, size, view), options.draw.alpha);
        if (!picture)
            return picture.error();
        return host::writePng(*picture, options.output);
    }
    std::vector<Error> refusals;
    for (const Scheme& scheme : kSchemes) {
        Result<Shown> shown = open(session, options, scheme.name, size);
        if (shown)
            all.push_back(std::move(*shown));
        else if (shown.error().code != ErrorCode::asset && shown.error().code != ErrorCode::limit)
            return shown.error(); // not the cage's fault
        else
            refusals.push_back(shown.error());
    }
    if (all.empty())
        return refusals.front();
    for (const Error& refusal : refusals)
        warn(refusal.message);
    return drawSheet(all, sceneFor(all, options, size, view), options, size);
}

} // namespace

bool parsePlace(const std::string& text, double& x, double& y) {
    int read = 0;
    return std::sscanf(text.c_str(), "%lf,%lf%n", &x, &y, &read) == 2 && static_cast<size_t>(read) == text.size() &&
           x >= 0.0 && x <= 1.0 && y >= 0.0 && y <= 1.0;
}

bool parsePoint(const std::string& text, glm::vec3& point) {
    int read = 0;
    return std::sscanf(text.c_str(), "%f,%f,%f%n", &point.x, &point.y, &point.z, &read) == 3 &&
           static_cast<size_t>(read) == text.size() && std::isfinite(point.x) && std::isfinite(point.y) &&
           std::isfinite(point.z);
}

Status renderPicture(Session& session, const RenderOptions& options) {
    const Result<VkExtent2D> size = parseSize(options.size);
    const Result<uint32_t> view = parseView(options.draw.view);
    if (!size || !view)
        return !size ? size.error() : view.error();
    return render(session, options, *size, *view);
}

int runRender(const RenderOptions& options) {
    const Result<PictureKind> picture = parsePicture("--size", options.size, options.draw.view);
    if (!picture)
        return fail(kExitUsage, picture.error().message);
    if (options.draw.trace && options.draw.scheme == "cage")
        return fail(kExitUsage, "--trace: rays meet a surface, and --scheme cage has none");
    if (options.draw.trace && picture->view == host::shared::kViewLevels)
        return fail(kExitUsage, "--trace: rays meet a surface of one rate, and --view levels has levels");
    const OutputPath output[] = {{"--output", options.output}};
    if (const Status writable = canWrite(output); !writable)
        return fail(writable.error());
    const int code = withSession(deviceFlags(options.draw), [&](Session& session) {
        return render(session, options, picture->size, picture->view);
    });
    if (code == kExitOk)
        tellWritten(options.output);
    return code;
}

} // namespace supple::tools
