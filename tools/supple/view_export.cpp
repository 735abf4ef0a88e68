#include "tools/supple/view_export.h"

#include "base/utf8_path.h"
#include "tools/common/formatted.h"
#include "tools/supple/command.h"
#include "tools/supple/views.h"
#include "tools/supple/webp_animation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/gtc/constants.hpp>

namespace supple::tools {

namespace {

namespace fs = std::filesystem;

/// Seconds that what is soft has moved before a picture.
constexpr double kSimulated = 3.0;

/// As few digits as lead back to the same angle.
double degrees(float angle) {
    const auto exact = static_cast<double>(angle) * 180.0 / glm::pi<double>();
    const double rounded = std::round(exact * 1e3) / 1e3;
    return radians(rounded) == angle ? rounded : exact;
}

std::string sizeText(VkExtent2D size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

/// As --clip takes it.
std::string clipText(const host::Figure& figure, uint32_t clip) {
    const std::vector<host::Figure::Clip>& clips = figure.clips();
    if (clip >= clips.size())
        return {};
    const auto sameName = [&](const host::Figure::Clip& other) { return other.name == clips[clip].name; };
    return !clips[clip].name.empty() && std::count_if(clips.begin(), clips.end(), sameName) == 1 ? clips[clip].name
                                                                                                 : std::to_string(clip);
}

std::string pointText(const glm::vec3& p) {
    return formatted("%.9g,%.9g,%.9g", static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z));
}

DrawOptions shownDraw(const ViewStage& stage, const DrawOptions& given, const ExportWish& wish) {
    const ViewSettings& settings = stage.settings;
    DrawOptions draw = given;
    draw.scheme = settings.cageFaces ? "cage" : schemeName(stage.scheme());
    draw.rate = static_cast<uint32_t>(settings.rate);
    draw.skinning = skinningName(stage.skinning());
    draw.view = kViews[settings.view].name;
    if (settings.view == host::shared::kViewWeights)
        draw.joint = std::to_string(settings.joint);
    draw.cageOverlay = settings.cageOverlay;
    draw.split = settings.split;
    draw.levels = settings.levels;
    draw.chordError = settings.chordError;
    draw.ground = settings.ground;
    draw.alpha = wish.alpha;
    draw.soft = wish.alpha ? SoftShown() : settings.soft;
    if (settings.simulate && stage.softFacts().any())
        draw.simulate = kSimulated;
    draw.parts.clear();
    if (std::find(settings.shownParts.begin(), settings.shownParts.end(), false) != settings.shownParts.end()) {
        for (size_t part = 0; part < settings.shownParts.size(); ++part) {
            if (settings.shownParts[part])
                draw.parts.push_back(std::to_string(part));
        }
    }
    draw.morphs.clear();
    for (const host::NamedTargets& morph : stage.morphs()) {
        if (!settings.morphWeights.empty())
            draw.morphs.push_back({morph.name, stage.morphWeight(morph)});
    }
    return draw;
}

Status makePicture(const RenderOptions& options) {
    return inSession(deviceFlags(options.draw), [&](Session& session) { return renderPicture(session, options); });
}

Status makeFrames(const AnimateOptions& options) {
    return inSession(deviceFlags(options.draw), [&](Session& session) { return animate(session, options); });
}

} // namespace

std::string freeName(const std::string& stem, const std::string& ending) {
    std::error_code unknown;
    std::string name = stem + ending;
    const auto isTaken = [&] {
        return fs::exists(utf8Path(frameFile(name, 0).empty() ? name : frameFile(name, 0)), unknown);
    };
    for (int number = 2; isTaken(); ++number)
        name = stem + "_" + std::to_string(number) + ending;
    return name;
}

RenderOptions shownPicture(const ViewStage& stage, const DrawOptions& given, const ExportWish& wish) {
    const DrawOptions usual;
    RenderOptions options;
    options.file = stage.figure().path();
    options.clip = clipText(stage.figure(), stage.settings.clip);
    options.time = options.clip.empty() ? 0.0 : stage.settings.time;
    options.size = sizeText(wish.size);
    host::Camera camera = stage.camera();
    camera.target = stage.centeredTarget();
    options.eye = pointText(camera.eye());
    options.lookAt = pointText(camera.target);
    options.fieldOfView = degrees(camera.fieldOfView);
    options.draw = shownDraw(stage, given, wish);
    options.draw.yaw = usual.yaw; // --eye has them
    options.draw.pitch = usual.pitch;
    return options;
}

AnimateOptions shownClip(const ViewStage& stage, const DrawOptions& given, const ExportWish& wish) {
    AnimateOptions options;
    options.file = stage.figure().path();
    options.clip = clipText(stage.figure(), stage.settings.clip);
    options.size = sizeText(wish.size);
    options.draw = shownDraw(stage, given, wish);
    options.draw.yaw = degrees(stage.camera().yaw);
    options.draw.pitch = degrees(stage.camera().pitch);
    return options;
}

void ViewExport::start(const ViewStage& stage, const DrawOptions& given, const ExportWish& wish) {
    if (isBusy())
        return;
    const bool frames = wish.kind == ExportKind::sequence || wish.kind == ExportKind::animation;
    const char* const ending = wish.kind == ExportKind::animation  ? ".webp"
                               : wish.kind == ExportKind::sequence ? "_####.png"
                                                                   : ".png";
    output_ = freeName(utf8Text(utf8Path(stage.figure().path()).stem()), ending);
    if (frames) {
        AnimateOptions options = shownClip(stage, given, wish);
        options.output = output_;
        if (const std::string fault = animateOutputFault(output_); !fault.empty()) {
            report_ = fault;
            return;
        }
        work_ = std::async(std::launch::async, [options] { return makeFrames(options); });
    } else {
        RenderOptions options = shownPicture(stage, given, wish);
        options.output = output_;
        if (wish.kind == ExportKind::commandLine) {
            report_ = commandLine(options);
            std::printf("%s\n", report_.c_str());
            std::fflush(stdout);
            return;
        }
        work_ = std::async(std::launch::async, [options] { return makePicture(options); });
    }
    report_ = "writing " + output_;
}

const std::string& ViewExport::report() {
    if (isBusy() && work_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        const Status status = work_.get();
        report_ = status ? "wrote " + output_ : status.error().message;
        if (status)
            note(report_);
        else
            fail(status.error());
    }
    return report_;
}

} // namespace supple::tools
