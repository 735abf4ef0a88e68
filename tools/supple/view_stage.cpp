#include "tools/supple/view_stage.h"

#include "host/patches.h"
#include "tools/common/character_file.h"
#include "tools/common/figure_file.h"
#include "tools/common/formatted.h"
#include "tools/supple/measured_views.h"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

namespace supple::tools {

namespace {

constexpr float kWindowMargin = 0.10f;
constexpr float kSteepest = 1.5f; ///< radians; the camera never looks straight up or down
/// Poses of each clip that the camera has to hold and the floor has to carry.
constexpr uint32_t kMeasuredPoses = 5;
constexpr uint32_t kMostTimings = 512; ///< of a frame of one group

} // namespace

Result<std::unique_ptr<ViewStage>> ViewStage::create(host::Context& context, host::SurfaceRenderer& renderer,
                                                     const DrawOptions& options) {
    std::unique_ptr<ViewStage> stage(new ViewStage(context, renderer));
    const Result<uint32_t> view = parseView(options.view);
    if (!view)
        return view.error();
    stage->settings.view = *view;
    stage->settings.cageFaces = options.scheme == "cage";
    stage->settings.cageOverlay = options.cageOverlay;
    stage->settings.split = options.split;
    stage->settings.soft = options.soft;
    stage->settings.levels = options.levels;
    stage->settings.chordError = options.chordError;
    stage->settings.ground = options.ground;
    // The cage is only the first thing shown: the surface is a key away.
    stage->scheme_ = options.scheme == "cage" ? SUPPLE_SCHEME_AUTO : schemeOf(options.scheme);
    stage->skinning_ = skinningOf(options.skinning);
    stage->creaseMode_ = creaseModeOf(options.creases);
    stage->sharpThreshold_ = options.sharpThreshold;
    stage->fragmentRules_ = rulesOf(options.rules);
    stage->uvInterpolation_ = uvInterpolationOf(options.uvMode);
    stage->reading_ = options.reading;
    stage->morphSettings_ = options.morphs;
    stage->parts_ = options.parts;
    stage->partSchemes_ = options.partSchemes;
    stage->sharedSamples_ = options.sharedSamples;
    stage->settings.rate = static_cast<int>(stage->offeredRate(options.rate));
    stage->startYaw_ = radians(options.yaw);
    stage->startPitch_ = radians(options.pitch);
    return stage;
}

Status ViewStage::open(const std::string& file, const std::string& clip, float aspect) {
    Result<host::CharacterFile> character = host::readCharacterFile(file, reading_);
    if (!character)
        return character.error();
    const auto read = std::make_shared<const host::CharacterFile>(std::move(*character));
    Result<std::unique_ptr<host::Figure>> figure = host::createFigure(context_, *read);
    if (!figure)
        return figure.error();
    Result<std::vector<float>> weights = host::morphWeights(**figure, morphSettings_);
    if (!weights)
        return weights.error();
    const Result<uint32_t> chosen = host::findClip(**figure, clip);
    if (!chosen)
        return chosen.error();
    Result<std::vector<bool>> shownParts = host::findParts(file, (*figure)->partNames(), parts_);
    if (!shownParts)
        return shownParts.error();
    // It is measured, so it has no levels yet.
    Result<std::unique_ptr<host::FigureGroup>> group =
        createGroup(**figure, static_cast<uint32_t>(settings.rate), false, false);
    if (!group)
        return group.error();
    std::vector<ClipTime> poses;
    std::vector<size_t> measuredEnds;
    const auto clipCount = static_cast<uint32_t>((*figure)->clips().size());
    for (uint32_t i = 0; i < clipCount; ++i) {
        const std::vector<ClipTime> times = spreadTimes(**figure, i, kMeasuredPoses);
        poses.insert(poses.end(), times.begin(), times.end());
        measuredEnds.push_back(poses.size());
    }
    if (poses.empty())
        poses.push_back({});
    Result<Extent> extent = measureGroup(**group, poses, false, true);
    if (!extent)
        return extent.error();
    Result<host::FigureBinding> binding = renderer_.bind(**group);
    if (!binding)
        return binding.error();

    retired_.clear();
    ++version_;
    attachments_.reset();
    attached_.clear();
    binding_ = std::move(*binding);
    group_ = std::move(*group);
    playback_.forget();
    figure_ = std::move(*figure);
    file_ = read;
    cage_ = {read, &read->character.cage};
    softFacts_ = SoftFacts(read->character);
    warnings_ = read->character.warnings;
    morphs_ = host::targetsByName(*figure_);
    settings.morphWeights = std::move(*weights);
    extent_ = std::move(*extent);
    measuredEnds_ = std::move(measuredEnds);
    settings.clip = *chosen != SUPPLE_REST_POSE || clipCount == 0 ? *chosen : 0;
    settings.fadeClip = SUPPLE_REST_POSE;
    settings.joint = 0;
    settings.time = 0.0;
    settings.simulate = softFacts_.any();
    settings.tuning = {};
    settings.shownParts = std::move(*shownParts);
    settings.rate = static_cast<int>(group_->edgeRate());
    passTimes_.clear();
    partTimes_.clear();
    frameFigure(aspect);
    return readPartShares();
}

uint32_t ViewStage::offeredRate(uint32_t rate) const {
    return ratesArePowersOfTwo() ? std::bit_ceil(std::max(rate, 2u)) : rate;
}

Result<std::unique_ptr<host::FigureGroup>> ViewStage::createGroup(host::Figure& figure, uint32_t rate, bool levels,
                                                                  bool plays) const {
    Result<std::vector<SuppleScheme>> partSchemes = host::partSchemes(figure.path(), figure.partNames(), partSchemes_);
    if (!partSchemes)
        return partSchemes.error();
    return host::FigureGroup::create(figure, {.scheme = scheme_,
                                              .rate = rate,
                                              .skinning = skinning_,
                                              .creaseMode = creaseMode_,
                                              .sharpThreshold = sharpThreshold_,
                                              .fragmentRules = fragmentRules_,
                                              .uvInterpolation = uvInterpolation_,
                                              .sharedSamples = sharedSamples_,
                                              .partSchemes = std::move(*partSchemes),
                                              .levels = levels,
                                              .plays = plays,
                                              .springs = plays && wantsSimulation()});
}

Status ViewStage::setRate(uint32_t rate, uint64_t lastFrame) {
    return remakeGroup(rate, lastFrame);
}

Status ViewStage::setScheme(SuppleScheme scheme, uint64_t lastFrame) {
    const SuppleScheme before = std::exchange(scheme_, scheme);
    Status made = remakeGroup(offeredRate(static_cast<uint32_t>(settings.rate)), lastFrame);
    if (!made)
        scheme_ = before;
    return made;
}

Status ViewStage::setSkinning(SuppleSkinning skinning, uint64_t lastFrame) {
    const SuppleSkinning before = std::exchange(skinning_, skinning);
    Status made = remakeGroup(static_cast<uint32_t>(settings.rate), lastFrame);
    if (!made)
        skinning_ = before;
    return made;
}

Status ViewStage::tune(uint64_t lastFrame) {
    Result<host::CharacterFile> file = host::tunedFile(*file_, settings.tuning);
    Result<std::unique_ptr<host::Figure>> figure =
        file ? host::createFigure(context_, std::move(*file)) : Result<std::unique_ptr<host::Figure>>(file.error());
    if (!figure)
        return figure.error();
    std::swap(figure_, *figure);
    Status made = remakeGroup(static_cast<uint32_t>(settings.rate), lastFrame);
    if (made)
        retired_.back().figure = std::move(*figure);
    else
        std::swap(figure_, *figure);
    return made;
}

Status ViewStage::remakeGroup(uint32_t rate, uint64_t lastFrame) {
    Result<std::unique_ptr<host::FigureGroup>> group = createGroup(*figure_, rate, wantsLevels(), wantsPlayback());
    if (!group)
        return group.error();
    Result<host::FigureBinding> binding = renderer_.bind(**group);
    if (!binding)
        return binding.error();
    Result<std::unique_ptr<host::Attachments>> attachments = createAttachments(**group);
    if (!attachments)
        return attachments.error();
    ++version_;
    group_->release();
    retired_.push_back({lastFrame, nullptr, std::move(group_), std::move(binding_), std::move(attachments_)});
    attachments_ = std::move(*attachments);
    group_ = std::move(*group);
    binding_ = std::move(*binding);
    playback_.forget();
    // At levels a rate counts for some schemes only, and then it is the largest.
    settings.rate = static_cast<int>(group_->hasLevels() ? rate : group_->edgeRate());
    return readPartShares();
}

Result<std::unique_ptr<host::Attachments>> ViewStage::createAttachments(const host::FigureGroup& group) const {
    if (attached_.empty())
        return std::unique_ptr<host::Attachments>();
    Result<std::unique_ptr<host::Attachments>> made = renderer_.createAttachments(group);
    for (size_t k = 0; made && k < attached_.size(); ++k) {
        if (const Status status = tools::attach(**made, attached_[k], extent_.bounds.radius()); !status)
            return status.error();
    }
    return made;
}

Status ViewStage::attach(const AttachedProp& what) {
    if (attachments_ == nullptr) {
        Result<std::unique_ptr<host::Attachments>> made = renderer_.createAttachments(*group_);
        if (!made)
            return made.error();
        attachments_ = std::move(*made);
    }
    Status added = tools::attach(*attachments_, what, extent_.bounds.radius());
    if (added) {
        attached_.push_back(what);
        ++attachedChanges_;
    }
    return added;
}

Status ViewStage::takeOff(uint64_t lastFrame) {
    if (attached_.empty())
        return success();
    const AttachedProp last = attached_.back();
    attached_.pop_back();
    Result<std::unique_ptr<host::Attachments>> rest = createAttachments(*group_);
    if (!rest) {
        attached_.push_back(last);
        return rest.error();
    }
    ++attachedChanges_;
    retired_.push_back({lastFrame, nullptr, nullptr, {}, std::move(attachments_)});
    attachments_ = std::move(*rest);
    return success();
}

float ViewStage::morphWeight(const host::NamedTargets& morph) const {
    const uint32_t first = morph.targets.front();
    return settings.morphWeights.empty() ? figure_->morphTargets()[first].weight : settings.morphWeights[first];
}

void ViewStage::setMorphWeight(const host::NamedTargets& morph, float weight) {
    if (settings.morphWeights.empty()) {
        for (const host::Figure::MorphTarget& target : figure_->morphTargets())
            settings.morphWeights.push_back(target.weight);
    }
    for (const uint32_t target : morph.targets)
        settings.morphWeights[target] = weight;
}

void ViewStage::retire(uint64_t completedFrame) {
    std::erase_if(retired_, [&](const Retired& retired) { return retired.frame <= completedFrame; });
}

void ViewStage::advance(double seconds) {
    const double duration = hasFigure() ? figure_->clipDuration(settings.clip) : 0.0;
    if (!settings.playing || duration <= 0.0)
        return;
    settings.time += seconds * static_cast<double>(settings.speed);
    playback_.advance(seconds * static_cast<double>(settings.speed));
    if (settings.fadeClip == SUPPLE_REST_POSE) // two clips wrap each by its own duration
        settings.time = std::fmod(settings.time, duration);
}

void ViewStage::frameFigure(float aspect) {
    camera_.yaw = startYaw_;
    camera_.pitch = startPitch_;
    fitFigure(aspect);
}

Extent ViewStage::reach() const {
    if (settings.clip >= measuredEnds_.size())
        return extent_;
    const size_t first = settings.clip == 0 ? 0 : measuredEnds_[settings.clip - 1], end = measuredEnds_[settings.clip];
    const auto part = [&](const std::vector<glm::vec3>& points) {
        const size_t each = points.size() / measuredEnds_.back();
        return std::vector<glm::vec3>(points.begin() + static_cast<ptrdiff_t>(first * each),
                                      points.begin() + static_cast<ptrdiff_t>(end * each));
    };
    return {part(extent_.points), part(extent_.cagePoints), extent_.bounds};
}

void ViewStage::fitFigure(float aspect) {
    const float shape = aspect * (1.0f - covered_) * (settings.split ? 0.5f : 1.0f);
    camera_ = host::frameCamera(reach().framed(settings.split), camera_.yaw, camera_.pitch, shape, kWindowMargin);
    aside_ = 0.5f * covered_ * aspect;
    pan(-aside_, 0.0f);
}

glm::vec3 ViewStage::centeredTarget() const {
    const glm::vec3 right = glm::transpose(glm::mat3(camera_.view()))[0];
    return camera_.target + right * (aside_ * 2.0f * camera_.distance * std::tan(camera_.fieldOfView * 0.5f));
}

void ViewStage::orbit(float yaw, float pitch) {
    camera_.yaw += yaw;
    camera_.pitch = std::clamp(camera_.pitch + pitch, -kSteepest, kSteepest);
}

void ViewStage::pan(float right, float up) {
    const glm::mat3 toWorld = glm::transpose(glm::mat3(camera_.view()));
    const float height = 2.0f * camera_.distance * std::tan(camera_.fieldOfView * 0.5f);
    camera_.target += (toWorld[0] * right + toWorld[1] * up) * height;
}

void ViewStage::zoom(float steps) {
    const float radius = extent_.bounds.radius();
    camera_.distance = std::clamp(camera_.distance * std::pow(0.88f, steps), radius * 0.05f, radius * 20.0f);
}

Status ViewStage::record(VkCommandBuffer commands, uint32_t slot, uint64_t frame, uint64_t completedFrame,
                         const host::DrawTarget& target) {
    if (const Status status = evaluate(commands, frame, completedFrame, target.extent().height); !status)
        return status.error();
    const host::Scene drawn = scene(target.extent());
    if (const Status status = renderer_.prepare(drawn); !status)
        return status.error();
    renderer_.record(commands, slot, target, drawn);
    return success();
}

Status ViewStage::evaluate(VkCommandBuffer commands, uint64_t frame, uint64_t completedFrame, uint32_t height) {
    if (const Status status =
            context_.check(suppleBeginFrame(context_.handle(), frame, completedFrame), "suppleBeginFrame");
        !status)
        return status.error();
    readTimings();
    if (!hasFigure())
        return success();
    for (const Status& status : {pose(), showParts(), chooseLevels(height)}) {
        if (!status)
            return status.error();
    }
    const SuppleGroup groups[] = {group_->handle()};
    SuppleRecordDesc desc{};
    desc.structSize = sizeof desc;
    desc.flags = SUPPLE_RECORD_TIMINGS;
    desc.groups = groups;
    desc.groupCount = 1;
    desc.before = host::kRendererReads;
    desc.after = host::kRendererReads;
    recordedVersion_ = version_;
    return context_.check(suppleRecord(context_.handle(), commands, &desc), "suppleRecord");
}

ViewStage::Shown ViewStage::shown() const {
    Shown shown{settings, camera_, levelCamera_, version_, shownValues_, attachedChanges_};
    // What is drawn over the picture changes nothing of it.
    shown.settings.panel = shown.settings.keys = shown.settings.joints = false;
    shown.settings.soft = {};
    shown.settings.prop = Prop::none;
    shown.settings.timingsPaused = shown.settings.timingsByPart = false;
    shown.settings.budgetMs = 0.0f;
    return shown;
}

Status ViewStage::showParts() const {
    Status status = success();
    for (uint32_t p = 0; p < settings.shownParts.size() && status; ++p)
        status = group_->setPartVisible(p, settings.shownParts[p]);
    return status;
}

Status ViewStage::chooseLevels(uint32_t height) {
    if (!settings.levelsFrozen)
        levelCamera_ = camera_;
    return group_->hasLevels() ? group_->setLevelCamera(levelCamera_, height, settings.chordError) : success();
}

Status ViewStage::pose() {
    if (const Status status = group_->setMorphWeights(0, settings.morphWeights); !status)
        return status.error();
    if (group_->plays())
        return playback_.show(*group_, settings.clip, settings.time, settings.playing ? settings.change : std::nullopt,
                              static_cast<double>(settings.changeSeconds));
    if (settings.fadeClip == SUPPLE_REST_POSE || settings.fade <= 0.0f || settings.clip >= figure_->clips().size())
        return group_->pose(0, settings.clip, settings.time);
    SuppleClipLayer layers[2]{};
    layers[0].clip = settings.clip;
    layers[0].time = settings.time;
    layers[0].weight = 1.0f;
    layers[1].clip = settings.fadeClip;
    layers[1].time = settings.time;
    layers[1].weight = settings.fade;
    layers[0].flags = layers[1].flags = SUPPLE_LAYER_LOOP;
    SupplePoseDesc desc{};
    desc.structSize = sizeof desc;
    desc.layers = layers;
    desc.layerCount = 2;
    return context_.check(suppleSetPose(context_.handle(), group_->instance(0), &desc), "suppleSetPose");
}

bool ViewStage::wantsLevels() const {
    // Measured values are those of the vertices of a rate.
    const bool measured = settings.view == host::shared::kViewWeights || isMeasured(settings.view);
    return settings.view == host::shared::kViewLevels || (settings.levels && !measured);
}

bool ViewStage::wantsPlayback() const {
    // Weights are measured in poses that are set, and two clips one over the other are set as well.
    return (settings.change || wantsSimulation()) && settings.view != host::shared::kViewWeights &&
           settings.fadeClip == SUPPLE_REST_POSE;
}

bool ViewStage::wantsSimulation() const {
    return settings.simulate && softFacts_.any();
}

bool ViewStage::needsOtherGroup() const {
    return hasFigure() && (group_->hasLevels() != wantsLevels() || group_->plays() != wantsPlayback() ||
                           group_->swings() != (wantsPlayback() && wantsSimulation()));
}

Status ViewStage::changeGroup(uint64_t lastFrame) {
    return remakeGroup(static_cast<uint32_t>(settings.rate), lastFrame);
}

ViewStage::Values ViewStage::wantedValues() const {
    Values wanted;
    wanted.version = version_;
    wanted.view = settings.view;
    if (settings.view == host::shared::kViewWeights) {
        wanted.joint = settings.joint;
        return wanted;
    }
    wanted.clip = settings.clip;
    wanted.fadeClip = settings.fadeClip;
    wanted.time = settings.time;
    wanted.fade = settings.fade;
    wanted.morphWeights = settings.morphWeights;
    return wanted;
}

bool ViewStage::needsValues() const {
    if (!hasFigure() || group_->hasLevels())
        return false;
    if (measured_.valid())
        return measured_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    const bool plays = settings.playing && figure_->clipDuration(settings.clip) > 0.0;
    if (settings.view == host::shared::kViewWeights)
        return !figure_->jointNames().empty() && values_ != wantedValues();
    if (!isMeasured(settings.view))
        return false;
    return plays ? values_.version != version_ || values_.view != settings.view : values_ != wantedValues();
}

Status ViewStage::measureValues(bool wait) {
    if (measured_.valid())
        return showMeasured();
    const bool first = values_.version != version_ || values_.view != settings.view;
    values_ = wantedValues(); // also if it fails: once is enough
    if (settings.view == host::shared::kViewWeights) {
        const Status status = group_->showWeights(settings.joint);
        return status ? bind() : status;
    }
    Status status = startMeasuring();
    if (status && wait)
        return showMeasured();
    if (status && first) { // none yet
        const Result<std::vector<glm::vec3>> vertices = group_->readSurface();
        status = vertices ? group_->setValues(std::vector<float>(vertices->size(), -1.0f)) : vertices.error();
        status = status ? bind() : status;
    }
    return status;
}

Status ViewStage::startMeasuring() {
    if (const Status status = pose(); !status)
        return status.error();
    const SuppleGroup groups[] = {group_->handle()};
    if (const Status status = context_.evaluate(groups); !status)
        return status.error();
    Result<PosedSurfaces> posed = readPosed(*group_);
    if (!posed)
        return posed.error();
    const SurfaceRules rules{creaseMode_, sharpThreshold_, fragmentRules_};
    measured_ = std::async(std::launch::async, [view = settings.view, cage = cage_, rules, posed = std::move(*posed)] {
        return measuredValues(view, posed, *cage, rules);
    });
    return success();
}

Status ViewStage::showMeasured() {
    const Result<std::vector<float>> values = measured_.get();
    if (values_.version != version_ || values_.view != settings.view) {
        values_ = {}; // something else is looked at by now
        return success();
    }
    const Status status = values ? group_->setValues(*values) : values.error();
    return status ? bind() : status;
}

Status ViewStage::bind() {
    Result<host::FigureBinding> binding = renderer_.bind(*group_);
    if (!binding)
        return binding.error();
    binding_ = std::move(*binding);
    ++shownValues_;
    return success();
}

std::string ViewStage::measuredPose() const {
    const std::string pose = values_.clip < figure_->clips().size()
                                 ? figure_->clips()[values_.clip].name + formatted(" at %.2f s", values_.time)
                                 : "rest pose";
    return measured_.valid() ? "measuring " + pose : pose;
}

std::vector<ViewStage::ShownJoint> ViewStage::shownJoints(float aspect) const {
    std::vector<ShownJoint> joints(figure_->jointNames().size());
    const glm::mat4 view = camera_.projection(aspect, extent_.bounds.radius()) * camera_.view();
    const glm::vec2 shift(surfaceShift(), 0.0f);
    for (uint32_t i = 0; i < joints.size(); ++i) {
        glm::mat4 place(1.0f);
        if (suppleGetJointTransform(context_.handle(), group_->instance(0), i, &place[0][0]) != SUPPLE_OK)
            continue;
        const glm::vec4 at = view * place[3];
        joints[i] = {at.w > 0.0f, shift + glm::vec2(0.5f + 0.5f * at.x / at.w, 0.5f - 0.5f * at.y / at.w)};
    }
    return joints;
}

std::vector<PlacedStroke> ViewStage::shownStrokes(float aspect) const {
    if (recordedVersion_ != version_)
        return {};
    const Result<std::vector<Stroke>> strokes = softStrokes(softFacts_, *group_, settings.soft);
    if (!strokes)
        return {};
    const glm::mat4 view = camera_.projection(aspect, extent_.bounds.radius()) * camera_.view();
    std::vector<PlacedStroke> placed = placeStrokes(*strokes, view);
    for (PlacedStroke& stroke : placed) {
        stroke.from.x += surfaceShift();
        stroke.to.x += surfaceShift();
    }
    return placed;
}

host::Scene ViewStage::scene(VkExtent2D extent) const {
    host::Scene scene;
    if (!hasFigure()) {
        scene.bounds = {glm::vec3(-1.0f, 0.0f, -1.0f), glm::vec3(1.0f, 2.0f, 1.0f)};
        scene.camera = host::frameCamera(std::array{scene.bounds.min, scene.bounds.max}, startYaw_, startPitch_, 1.0f,
                                         kWindowMargin);
        scene.ground = 0.0f;
        return scene;
    }
    scene.group = group_.get();
    scene.binding = &binding_;
    scene.attachments = attachments_.get();
    scene.camera = camera_;
    scene.bounds = extent_.bounds;
    if (settings.ground)
        scene.ground = extent_.bounds.min.y;
    // A turntable: the lights stay with the viewer.
    scene.lightYaw = camera_.yaw;
    scene.view = settings.view;
    scene.cageFaces = settings.cageFaces;
    scene.cageEdges = settings.cageFaces || settings.cageOverlay;
    if (settings.split)
        scene.split = covered_;
    fitToPixels(scene, extent);
    return scene;
}

Status ViewStage::readPartShares() {
    partShares_.clear();
    const uint32_t surfaces = group_->surfaces().front().output.info.surfaceCount;
    for (uint32_t surface = 0; surface < surfaces; ++surface) {
        const Result<std::vector<uint32_t>> patches = host::patchesByPart(
            context_, group_->handle(), surface, figure_->cage().parts, figure_->partNames().size());
        if (!patches)
            return patches.error();
        const float all = static_cast<float>(std::max(std::accumulate(patches->begin(), patches->end(), 0u), 1u));
        std::vector<float>& shares = partShares_.emplace_back();
        for (const uint32_t count : *patches)
            shares.push_back(static_cast<float>(count) / all);
    }
    return success();
}

void ViewStage::readTimings() {
    std::vector<SuppleTiming> timings(kMostTimings);
    uint32_t count = kMostTimings;
    if (settings.timingsPaused ||
        suppleGetTimings(context_.handle(), sizeof(SuppleTiming), timings.data(), &count) != SUPPLE_OK)
        return;
    std::vector<std::pair<std::string, double>> byPass, byPart; // in the order of the frame
    for (uint32_t i = 0; i < count; ++i) {
        const double time = (timings[i].gpuEnd - timings[i].gpuBegin) * 1e-6;
        byPass.emplace_back(suppleGetPassName(timings[i].pass), time);
        if (!hasFigure() || timings[i].group.id != group_->handle().id)
            continue; // the group before this one
        if (timings[i].surface == SUPPLE_NO_SURFACE) {
            byPart.emplace_back("the whole", time);
            continue;
        }
        for (uint32_t part = 0; part < partShares_[timings[i].surface].size(); ++part) {
            const std::string& name = figure_->partNames()[part];
            if (partShares_[timings[i].surface][part] > 0.0f)
                byPart.emplace_back(name.empty() ? "part " + std::to_string(part) : name,
                                    time * static_cast<double>(partShares_[timings[i].surface][part]));
        }
    }
    passTimes_.add(timings[0].frame, byPass);
    if (!byPart.empty())
        partTimes_.add(timings[0].frame, byPart);
}

} // namespace supple::tools
