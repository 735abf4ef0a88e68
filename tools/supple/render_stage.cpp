#include "tools/supple/render_stage.h"

#include "host/material_uniforms.h"
#include "tools/common/simulation.h"

#include "tools/common/figure_file.h"
#include "tools/supple/legend.h"
#include "tools/supple/progress.h"
#include "tools/supple/views.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace supple::tools {

Result<uint32_t> parseView(const std::string& name) {
    std::string all;
    for (const NamedView& known : kViews) {
        if (name == known.name)
            return known.view;
        all += (all.empty() ? "" : ", ") + std::string(known.name);
    }
    return Error{ErrorCode::argument, name + " is no view (" + all + ")"};
}

Result<PictureKind> parsePicture(const char* option, const std::string& size, const std::string& view) {
    const Result<VkExtent2D> extent = parseSize(size);
    if (!extent)
        return Error{ErrorCode::argument, std::string(option) + ": " + extent.error().message};
    const Result<uint32_t> known = parseView(view);
    if (!known)
        return Error{ErrorCode::argument, "--view: " + known.error().message};
    return PictureKind{*extent, *known};
}

DeviceFlags deviceFlags(const DrawOptions& options) {
    return {.device = options.device,
            .mapping = options.mapping,
            .validate = options.validate,
            .record = options.record,
            .rayTracing = options.trace};
}

float radians(double degrees) {
    return static_cast<float>(degrees) * glm::pi<float>() / 180.0f;
}

void fitToPixels(host::Scene& scene, VkExtent2D extent) {
    const float height = static_cast<float>(extent.height);
    scene.pixelScale = std::clamp(height / 900.0f, 0.6f, 4.0f);
    scene.lightTubes = std::clamp(std::round(height / 80.0f), 4.0f, 10.0f);
}

std::vector<ClipTime> spreadTimes(const host::Figure& figure, uint32_t clip, uint32_t count) {
    if (clip == SUPPLE_REST_POSE || count <= 1)
        return {{clip, 0.0}};
    std::vector<ClipTime> times;
    for (uint32_t i = 0; i < count; ++i)
        times.push_back({clip, figure.clipDuration(clip) * i / (count - 1)});
    return times;
}

namespace {

Status show(host::FigureGroup& group, const ClipTime& pose) {
    host::Context& context = group.figure().context();
    if (pose.transition)
        return host::playTransition(context, group.handle(), group.instance(0), *pose.transition, pose.time);
    return group.plays() ? host::simulate(context, group.handle(), group.instance(0), pose.clip,
                                          pose.since.value_or(pose.time), pose.time)
                         : group.pose(0, pose.clip, pose.time);
}

} // namespace

Result<std::optional<host::PlannedTransition>> Stage::transition() const {
    return host::planTransition(options_.transition,
                                [&](const std::string& clip) { return host::findClip(*figure_, clip); });
}

Result<Extent> measureGroup(host::FigureGroup& group, std::span<const ClipTime> poses, bool cage, bool beside) {
    Extent extent;
    const SuppleGroup groups[] = {group.handle()};
    for (const ClipTime& clipTime : poses) {
        if (const Status status = show(group, clipTime); !status)
            return status.error();
        if (const Status status = group.figure().context().evaluate(groups); !status)
            return status.error();
        const Result<std::vector<glm::vec3>> points = cage ? group.readCage() : group.readSurface();
        const Result<std::vector<glm::vec3>> cagePoints = beside ? group.readCage() : std::vector<glm::vec3>();
        if (!points || !cagePoints)
            return !points ? points.error() : cagePoints.error();
        for (const glm::vec3& point : *points)
            extent.bounds.add(point);
        extent.points.insert(extent.points.end(), points->begin(), points->end());
        extent.cagePoints.insert(extent.cagePoints.end(), cagePoints->begin(), cagePoints->end());
    }
    return extent;
}

std::vector<glm::vec3> Extent::framed(bool split) const {
    std::vector<glm::vec3> all = points;
    if (split)
        all.insert(all.end(), cagePoints.begin(), cagePoints.end());
    return all;
}

Result<std::unique_ptr<host::FigureGroup>> Stage::createGroup(bool levels) const {
    const std::string& file = figure_->path();
    Result<std::vector<SuppleScheme>> partSchemes = host::partSchemes(file, figure_->partNames(), options_.partSchemes);
    const Result<std::vector<float>> weights = host::morphWeights(*figure_, options_.morphs);
    const Result<std::vector<bool>> shown = host::findParts(file, figure_->partNames(), options_.parts);
    if (!partSchemes || !weights || !shown)
        return !partSchemes ? partSchemes.error() : !weights ? weights.error() : shown.error();
    Result<std::unique_ptr<host::FigureGroup>> group =
        host::FigureGroup::create(*figure_, {.scheme = schemeOf(options_.scheme),
                                             .rate = options_.rate,
                                             .skinning = skinningOf(options_.skinning),
                                             .creaseMode = creaseModeOf(options_.creases),
                                             .sharpThreshold = options_.sharpThreshold,
                                             .fragmentRules = rulesOf(options_.rules),
                                             .uvInterpolation = uvInterpolationOf(options_.uvMode),
                                             .sharedSamples = options_.sharedSamples,
                                             .partSchemes = std::move(*partSchemes),
                                             .levels = levels,
                                             .plays = options_.transition.isThere() || options_.simulate > 0.0,
                                             .springs = options_.simulate > 0.0,
                                             .traced = options_.trace});
    if (!group)
        return group.error();
    Status status = (*group)->setMorphWeights(0, *weights);
    for (uint32_t p = 0; p < shown->size() && status; ++p)
        status = (*group)->setPartVisible(p, (*shown)[p]);
    return status ? std::move(group) : status.error();
}

Status Stage::openRays() {
    const host::FigureMaterials& materials = figure_->materials();
    host::RayGroupOptions options;
    options.isOpaque = [&materials](uint32_t material) {
        return !host::isGlass(materials.of(material), materials.layersOf(material));
    };
    Result<std::unique_ptr<host::RayGroup>> group =
        host::RayGroup::create(*session_.context, group_->handle(), options);
    if (!group)
        return group.error();
    rayGroup_ = std::move(*group);
    Result<std::unique_ptr<host::RayScene>> scene =
        host::RayScene::create(*session_.device, 1, 1, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
    if (!scene)
        return scene.error();
    rayScene_ = std::move(*scene);
    const Result<std::vector<bool>> shown = host::findParts(figure_->path(), figure_->partNames(), options_.parts);
    for (uint32_t part = 0; shown && part < shown->size(); ++part) {
        if (!(*shown)[part])
            hiddenParts_.push_back(part);
    }
    return shown ? success() : Status(shown.error());
}

Status Stage::buildRays() {
    const host::TracedInstance instance{.slot = group_->instance(0).slot, .hiddenParts = hiddenParts_};
    const host::RayScene::Part part{rayGroup_.get(), {&instance, 1}};
    return session_.device->submitAndWait([&](VkCommandBuffer commands) {
        host::memoryBarrier(commands, {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT},
                            host::kBuildUse);
        rayScene_->record(commands, {&part, 1});
    });
}

Status Stage::openRenderer(VkExtent2D size) {
    host::Device& device = *session_.device;
    Result<std::unique_ptr<host::SurfaceRenderer>> renderer = host::SurfaceRenderer::create(
        device, {.quality = host::StudioQuality::still(size.height, device.isCpu()), .rays = rayScene_.get()});
    if (!renderer)
        return renderer.error();
    renderer_ = std::move(*renderer);
    Result<host::DrawTarget> target = host::DrawTarget::create(device, size, renderer_->samples());
    if (!target)
        return target.error();
    target_ = std::move(*target);
    return success();
}

Result<std::unique_ptr<Stage>> Stage::open(Session& session, const std::string& file, VkExtent2D size,
                                           const DrawOptions& options) {
    showProgress("reading " + file);
    Result<host::CharacterFile> character = host::readCharacterFile(file, options.reading);
    return character ? open(session, std::move(*character), size, options) : character.error();
}

Result<std::unique_ptr<Stage>> Stage::open(Session& session, host::CharacterFile character, VkExtent2D size,
                                           const DrawOptions& options) {
    std::unique_ptr<Stage> stage(new Stage(session, options));
    const std::string file = character.path;
    const Result<uint32_t> view = parseView(options.view);
    if (!view)
        return view.error();
    if (isMeasured(*view))
        stage->cage_ = character.character.cage;
    if (options.soft.any())
        stage->softFacts_ = SoftFacts(character.character);
    stage->rules_ = {creaseModeOf(options.creases), options.sharpThreshold, rulesOf(options.rules)};
    Result<std::unique_ptr<host::Figure>> figure = host::createFigure(*session.context, std::move(character));
    if (!figure)
        return figure.error();
    stage->figure_ = std::move(*figure);
    showProgress("making the surface of " + file);
    Result<std::unique_ptr<host::FigureGroup>> group = stage->createGroup(false);
    if (!group)
        return group.error();
    stage->group_ = std::move(*group);
    showProgress("compiling kernels and posing; the first time takes longest");
    if (const Status status = options.trace ? stage->openRays() : success(); !status)
        return status.error();
    if (const Status status = stage->openRenderer(size); !status)
        return status.error();
    if (options.view == "weights") {
        const Result<uint32_t> joint = host::findNamed(file, "joint", stage->figure_->jointNames(), options.joint);
        if (!joint)
            return joint.error();
        stage->joint_ = *joint;
        if (const Status status = stage->group_->showWeights(*joint); !status)
            return status.error();
    }
    const Status bound = stage->bind();
    return bound ? std::move(stage) : Result<std::unique_ptr<Stage>>(bound.error());
}

Status Stage::pose(const ClipTime& pose) {
    pose_ = pose;
    if (const Status status = show(*group_, pose); !status)
        return status.error();
    const SuppleGroup groups[] = {group_->handle()};
    return session_.context->evaluate(groups);
}

Status Stage::bind() {
    Result<host::FigureBinding> binding = renderer_->bind(levels_ ? *levels_ : *group_);
    if (!binding)
        return binding.error();
    binding_ = std::move(*binding);
    return success();
}

Status Stage::prepare(const host::Scene& scene) {
    if (const Status status = rayScene_ ? buildRays() : success(); !status)
        return status.error();
    if ((options_.levels || options_.view == "levels") && options_.scheme != "cage")
        return chooseLevels(scene);
    if (!cage_ || scene.cageFaces)
        return success();
    const Result<PosedSurfaces> posed = readPosed(*group_);
    if (!posed)
        return posed.error();
    const Result<std::vector<float>> values = measuredValues(scene.view, *posed, *cage_, rules_);
    const Status status = values ? group_->setValues(*values) : values.error();
    return status ? bind() : status;
}

Status Stage::chooseLevels(const host::Scene& scene) {
    if (!levels_) {
        Result<std::unique_ptr<host::FigureGroup>> levels = createGroup(true);
        if (!levels)
            return levels.error();
        levels_ = std::move(*levels);
        if (const Status status = bind(); !status)
            return status.error();
    }
    Status status = levels_->setLevelCamera(scene.camera, target_.extent().height, options_.chordError);
    if (status)
        status = show(*levels_, pose_);
    const SuppleGroup groups[] = {levels_->handle()};
    return status ? session_.context->evaluate(groups) : status;
}

Result<host::Picture> Stage::draw(host::Scene scene, bool alpha) {
    if (const Status status = prepare(scene); !status)
        return status.error();
    if (!alpha) {
        Result<host::Picture> picture = drawPasses(scene);
        if (picture && options_.legend && !scene.cageFaces)
            drawLegendOf(scene.view, *picture);
        const Status soft = picture && options_.soft.any() ? drawSoft(scene, *picture) : success();
        return soft ? std::move(picture) : soft.error();
    }
    scene.backdrop = glm::vec3(0.0f);
    const Result<host::Picture> overBlack = drawPasses(scene);
    if (!overBlack)
        return overBlack.error();
    scene.backdrop = glm::vec3(1.0f);
    const Result<host::Picture> overWhite = drawPasses(scene);
    if (!overWhite)
        return overWhite.error();
    return host::pictureWithAlpha(*overBlack, *overWhite);
}

void Stage::drawLegendOf(uint32_t view, host::Picture& picture) const {
    const std::optional<Legend> legend = legendOf(view, viewFactsOf(levels_ ? *levels_ : *group_, joint_));
    if (legend)
        drawLegend(picture, *legend);
}

Status Stage::drawSoft(const host::Scene& scene, host::Picture& picture) const {
    const Result<std::vector<Stroke>> strokes = softStrokes(softFacts_, levels_ ? *levels_ : *group_, options_.soft);
    if (!strokes)
        return strokes.error();
    const float aspect = static_cast<float>(picture.width) / static_cast<float>(picture.height);
    // Beside the cage, the surface stands a quarter of the picture to the right.
    const glm::mat4 shift = glm::translate(glm::mat4(1.0f), {scene.split ? 0.5f : 0.0f, 0.0f, 0.0f});
    const glm::mat4 view = scene.camera.projection(aspect, scene.bounds.radius()) * scene.camera.view();
    drawStrokes(picture, *strokes, options_.legend ? softKeys(softFacts_, options_.soft) : std::vector<SoftKey>(),
                shift * view);
    return success();
}

Result<host::Picture> Stage::drawPasses(host::Scene scene) {
    scene.group = levels_ ? levels_.get() : group_.get();
    scene.binding = &binding_;
    if (const Status status = renderer_->prepare(scene); !status)
        return status.error();
    host::PictureAverage average(target_.extent().width, target_.extent().height);
    const uint32_t passes = scene.quality.value_or(renderer_->quality()).passes;
    for (scene.pass = 0; scene.pass < passes; ++scene.pass) {
        const Status status = session_.device->submitAndWait(
            [&](VkCommandBuffer commands) { renderer_->record(commands, 0, target_, scene); });
        if (!status)
            return status.error();
        Result<host::Picture> pass =
            host::readPicture(*session_.device, target_.color().handle(), target_.extent(), host::kPictureFormat);
        if (!pass)
            return pass.error();
        average.add(*pass);
    }
    return average.picture();
}

} // namespace supple::tools
